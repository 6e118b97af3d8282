// SPDX-License-Identifier: GPL-2.0-or-later
#include "radius_table.h"

#include "severity_looks.h"

namespace wedm {

namespace {

const char OK[] = "ok";
constexpr int DECIMALS = 4;
constexpr int DEGREE_DECIMALS = 2;

/// Keeps the worse of two.
template <typename Key>
void worsen(QHash<Key, Severity> &known, const Key &key, Severity severity)
{
    known.insert(key, qMin(known.value(key, severity), severity));
}

/// What the user calls an entity or a segment that the server names by its type in DXF.
QString nameOf(const QString &type)
{
    const QString known = type.toLower();
    if (known.endsWith(QLatin1String("polyline")))
        return RadiusTable::tr("polyline");
    if (known == QLatin1String("line"))
        return RadiusTable::tr("line");
    if (known == QLatin1String("arc"))
        return RadiusTable::tr("arc");
    return known == QLatin1String("circle") ? RadiusTable::tr("circle") : known;
}

} // namespace

RadiusTable::RadiusTable(QObject *parent)
    : QAbstractTableModel(parent)
{
}

void RadiusTable::setInspection(const QSharedPointer<Inspection> &inspection)
{
    beginResetModel();
    m_inspection = inspection;
    choose();
    endResetModel();
}

void RadiusTable::setFindings(const QVector<Finding> &findings)
{
    m_bySegment.clear();
    m_byRule.clear();
    for (const Finding &finding : findings) {
        worsen(m_bySegment, qMakePair(finding.handle, finding.segment), finding.severity);
        worsen(m_byRule, finding.rule, finding.severity);
    }
    recolour();
}

void RadiusTable::setStale(bool stale)
{
    if (stale == m_isStale)
        return;
    m_isStale = stale;
    recolour();
}

void RadiusTable::recolour()
{
    if (!m_shown.isEmpty())
        emit dataChanged(index(0, 0), index(m_shown.size() - 1, Columns - 1), {Qt::BackgroundRole, Qt::ForegroundRole});
}

bool RadiusTable::severityOf(const Row &row, Severity *severity) const
{
    const auto there = m_bySegment.constFind(qMakePair(row.handle, row.segment));
    if (there != m_bySegment.constEnd()) {
        *severity = *there;
        return true;
    }
    if (row.verdict == QLatin1String(OK))
        return false;
    *severity = Severity::Hint;
    const QStringList rules = row.verdict.split(QLatin1Char(','));
    for (const QString &rule : rules)
        *severity = qMin(*severity, m_byRule.value(rule.trimmed(), Severity::Error));
    return true;
}

void RadiusTable::setShow(Show show)
{
    beginResetModel();
    m_show = show;
    choose();
    endResetModel();
}

const Row *RadiusTable::row(int index) const
{
    if (!m_inspection || index < 0 || index >= m_shown.size())
        return nullptr;
    return &m_inspection->rows.at(m_shown.at(index));
}

int RadiusTable::find(const QString &handle, int segment) const
{
    for (int i = 0; i < m_shown.size(); ++i) {
        const Row *each = row(i);
        if (each->segment == segment && each->handle == handle)
            return i;
    }
    return -1;
}

int RadiusTable::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : m_shown.size();
}

int RadiusTable::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : Columns;
}

QVariant RadiusTable::data(const QModelIndex &index, int role) const
{
    const Row *each = row(index.row());
    if (!each)
        return QVariant();
    if (role == Qt::BackgroundRole || role == Qt::ForegroundRole) {
        Severity severity;
        if (!severityOf(*each, &severity))
            return m_isStale && role == Qt::ForegroundRole ? QVariant(staleLook().text) : QVariant();
        const Look look = m_isStale ? staleLook() : lookOf(severity);
        return role == Qt::BackgroundRole ? look.ground : look.text;
    }
    const bool text = index.column() == Entity || index.column() == Layer || index.column() == Kind || index.column() == Verdict;
    if (role == Qt::TextAlignmentRole)
        return int((text ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    if (role != Qt::DisplayRole)
        return QVariant();
    switch (index.column()) {
    case Vertex:
        return each->segment;
    case Entity:
        return QStringLiteral("%1 %2").arg(each->handle, nameOf(each->type));
    case Layer:
        return each->layer;
    case X:
        return QString::number(each->start.x(), 'f', DECIMALS);
    case Y:
        return QString::number(each->start.y(), 'f', DECIMALS);
    case Kind:
        return nameOf(each->kind);
    case Radius:
        return each->hasRadius ? QString::number(each->radius, 'f', DECIMALS) : QString();
    case Sweep:
        return each->hasRadius ? QString::number(each->sweep, 'f', DEGREE_DECIMALS) : QString();
    case Verdict:
        return each->verdict == QLatin1String(OK) ? tr("ok") : each->verdict;
    }
    return QVariant();
}

QVariant RadiusTable::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (role != Qt::DisplayRole || orientation != Qt::Horizontal)
        return QVariant();
    switch (section) {
    case Vertex:
        return tr("Vertex");
    case Entity:
        return tr("Entity");
    case Layer:
        return tr("Layer");
    case X:
        return QStringLiteral("X %1").arg(unit());
    case Y:
        return QStringLiteral("Y %1").arg(unit());
    case Kind:
        return tr("Kind");
    case Radius:
        return tr("Radius %1").arg(unit());
    case Sweep:
        return tr("Sweep °");
    case Verdict:
        return tr("Verdict");
    }
    return QVariant();
}

/// The unit of the drawing's lengths, as it stands in the heads of the columns.
QString RadiusTable::unit() const
{
    const double millimetres = m_inspection ? m_inspection->unitsToMm : 1;
    if (millimetres == 1)
        return QStringLiteral("mm");
    if (millimetres == 25.4)
        return QStringLiteral("in");
    return tr("× %1 mm").arg(millimetres);
}

void RadiusTable::choose()
{
    m_shown.clear();
    m_faults = 0;
    if (!m_inspection)
        return;
    for (int i = 0; i < m_inspection->rows.size(); ++i) {
        const Row &each = m_inspection->rows.at(i);
        const bool fault = each.verdict != QLatin1String(OK);
        m_faults += fault;
        if (m_show == Show::All || fault || (m_show == Show::Arcs && each.hasRadius))
            m_shown += i;
    }
}

} // namespace wedm
