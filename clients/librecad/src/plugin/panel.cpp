// SPDX-License-Identifier: GPL-2.0-or-later
#include "panel.h"

#include "commands.h"
#include "severity_looks.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QCoreApplication>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSplitter>
#include <QTableView>
#include <QUrl>

#include <algorithm>
#include <cmath>

namespace wedm {

namespace {

/// Pixels; entity, vertex, radius and verdict are seen without scrolling.
constexpr int WIDTH = 400;
constexpr double LARGEST_CORRECTION = 5.0;
constexpr int CORRECTION_DECIMALS = 4;
constexpr double CORRECTION_STEP = 0.005;
/// The number of findings that are listed, errors first: laying out wrapped lines blocks LibreCAD.
constexpr int MOST_LISTED = 100;

QString severityName(Severity severity)
{
    switch (severity) {
    case Severity::Error:
        return Panel::tr("error");
    case Severity::Warning:
        return Panel::tr("warning");
    case Severity::Information:
        return Panel::tr("note");
    case Severity::Hint:
        return Panel::tr("hint");
    }
    return QString();
}

/// Shows its text literally: names out of drawings are no mark-up.
QLabel *plain(const char *name)
{
    QLabel *label = new QLabel;
    label->setObjectName(QString::fromLatin1(name));
    label->setTextFormat(Qt::PlainText);
    return label;
}

QLabel *wrapped(const char *name)
{
    QLabel *label = plain(name);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    label->hide();
    return label;
}

void say(QLabel *label, const QString &text, const char *colours)
{
    label->setText(text);
    label->setStyleSheet(QStringLiteral("padding: 3px; %1").arg(QString::fromLatin1(colours)));
    label->setVisible(!text.isEmpty());
}

const char PLAIN[] = "";
const char GOOD[] = "background: #d8f0d8; color: #064006;";
const char BAD[] = "background: #ffd9d0; color: #6a1000;";

QString originOf(const QString &from)
{
    if (from == QLatin1String("file"))
        return QStringLiteral("wedm.toml");
    if (from == QLatin1String("client"))
        return Panel::tr("this dock");
    return from == QLatin1String("drawing") ? Panel::tr("drawing") : Panel::tr("default");
}

QString sideOf(const QString &side)
{
    if (side == QLatin1String("auto"))
        return Panel::tr("sides by nesting");
    if (side == QLatin1String("opening"))
        return Panel::tr("opening");
    if (side == QLatin1String("punch"))
        return Panel::tr("punch");
    if (side == QLatin1String("left"))
        return Panel::tr("wire on the left");
    return side == QLatin1String("right") ? Panel::tr("wire on the right") : Panel::tr("both sides");
}

QString unitOf(double mm)
{
    if (mm == 1)
        return QStringLiteral("mm");
    return mm == 25.4 ? Panel::tr("inches") : Panel::tr("units of %1 mm").arg(mm);
}

/// The middle of an arc or line, from its ends, its centre and the sign of its sweep.
QPointF middleOf(const Row &row)
{
    if (!row.hasCentre)
        return (row.start + row.end) / 2;
    const double from = std::atan2(row.start.y() - row.centre.y(), row.start.x() - row.centre.x());
    const double half = row.sweep * M_PI / 360;
    return row.centre + row.radius * QPointF(std::cos(from + half), std::sin(from + half));
}

} // namespace

Panel::Panel(QWidget *parent)
    : QDockWidget(tr("Wire EDM"), parent)
    , m_table(new RadiusTable(this))
    , m_view(new QTableView)
    , m_list(new QListWidget)
    , m_server(wrapped("wedm_server"))
    , m_inForce(wrapped("wedm_in_force"))
    , m_message(wrapped("wedm_message"))
    , m_live(plain("wedm_live"))
    , m_unchecked(wrapped("wedm_unchecked"))
    , m_count(plain("wedm_count"))
    , m_show(new QComboBox)
    , m_side(new QComboBox)
    , m_correction(new QDoubleSpinBox)
    , m_fixOne(new QPushButton(tr("Fix this")))
{
    setObjectName(QStringLiteral("wedm_dock"));
    setMinimumWidth(WIDTH);

    m_correction->setObjectName(QStringLiteral("wedm_correction"));
    m_correction->setDecimals(CORRECTION_DECIMALS);
    m_correction->setRange(0, LARGEST_CORRECTION);
    m_correction->setSingleStep(CORRECTION_STEP);
    m_correction->setSuffix(tr(" mm"));
    m_correction->setSpecialValueText(tr("not set here"));
    m_correction->setKeyboardTracking(false);
    m_correction->setToolTip(tr("Wire radius + spark gap. A wedm.toml beside the drawing comes first; without either it is 0.1 mm."));
    m_side->setObjectName(QStringLiteral("wedm_side"));
    m_side->addItem(tr("not set here"), QString());
    m_side->addItem(tr("opening: the wire runs inside"), QStringLiteral("opening"));
    m_side->addItem(tr("punch: the wire runs outside"), QStringLiteral("punch"));
    m_side->addItem(tr("by nesting"), QStringLiteral("auto"));
    m_side->addItem(tr("both sides"), QStringLiteral("both"));
    m_side->setToolTip(tr("Where the wire runs. A program can be made only where that is known."));

    m_show->setObjectName(QStringLiteral("wedm_show"));
    m_show->addItem(tr("Faults"), int(RadiusTable::Show::Faults));
    m_show->addItem(tr("Arcs and faults"), int(RadiusTable::Show::Arcs));
    m_show->addItem(tr("All vertices"), int(RadiusTable::Show::All));
    m_show->setCurrentIndex(1);
    m_live->setWordWrap(true);
    m_count->setWordWrap(true);

    m_view->setObjectName(QStringLiteral("wedm_radii"));
    m_view->setModel(m_table);
    m_view->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_view->setSelectionMode(QAbstractItemView::SingleSelection);
    m_view->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_view->setWordWrap(false);
    m_view->verticalHeader()->hide();
    // With a fixed height LibreCAD is not blocked by measuring 200,000 rows.
    m_view->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    m_view->verticalHeader()->setDefaultSectionSize(m_view->fontMetrics().height() + 5);
    m_view->horizontalHeader()->setStretchLastSection(true);
    // The head of a selected column would be bold, and wider than the column.
    m_view->horizontalHeader()->setHighlightSections(false);
    const int digit = m_view->fontMetrics().horizontalAdvance(QLatin1Char('0'));
    const QVector<int> widths{9, 6, 10, 11, 9, 7, 10, 10, 8};
    for (int i = 0; i < widths.size(); ++i)
        m_view->setColumnWidth(i, widths.at(i) * digit);
    m_list->setObjectName(QStringLiteral("wedm_findings"));
    m_list->setWordWrap(true);
    m_list->setUniformItemSizes(false);

    QPushButton *check = button(tr("Check"), command::CHECK, tr("Check the drawing now"));
    QPushButton *fix = button(tr("Fix all"), command::FIX, tr("Make every repair that is safe, in one undo step"));
    QPushButton *program = button(tr("Program"), nullptr, tr("Write the program to a file"));
    QMenu *formats = new QMenu(program);
    for (const char *each : {command::GENERATE, command::GENERATE_4B, command::GENERATE_ISO, command::GENERATE_MILLING, command::PAIR})
        connect(formats->addAction(QCoreApplication::translate("wedm::command", each)), &QAction::triggered, this, [this, each] { emit commandWanted(each); });
    program->setMenu(formats);
    QPushButton *more = button(tr("More"), nullptr, tr("Figures, the fit of punch and plate, the drill list, a report"));
    QMenu *made = new QMenu(more);
    for (const char *each : {command::FIGURES, command::FIT, command::DRILL, command::REPORT})
        connect(made->addAction(QCoreApplication::translate("wedm::command", each)), &QAction::triggered, this, [this, each] { emit commandWanted(each); });
    more->setMenu(made);
    QPushButton *hole = button(tr("Thread hole…"), command::HOLE, tr("Click where the wire is threaded for the contour nearest to that point; it is kept in wedm.toml"));
    QPushButton *path = button(tr("Wire path"), command::PATH, tr("Draw the path of the wire on the layer WEDM_PATH, which is never checked"));
    QPushButton *noPath = button(tr("Clear path"), command::CLEAR_PATH, tr("Remove the path of the wire"));
    QPushButton *mark = button(tr("Mark"), command::MARK, tr("Draw a circle about each fault, on the layer WEDM_MARKS"));
    QPushButton *unmark = button(tr("Clear marks"), command::CLEAR, tr("Remove the circles"));
    QPushButton *server = button(tr("Server…"), nullptr, tr("Choose the program of the wedm server"));
    m_fixOne->setToolTip(tr("Repair the selected segment"));
    m_fixOne->setObjectName(QStringLiteral("wedm_fix_one"));
    m_fixOne->setEnabled(false);

    QWidget *content = new QWidget;
    QVBoxLayout *layout = new QVBoxLayout(content);
    layout->setContentsMargins(4, 4, 4, 4);
    layout->addWidget(m_server);
    QFormLayout *form = new QFormLayout;
    form->addRow(tr("Correction"), m_correction);
    form->addRow(tr("Side"), m_side);
    layout->addLayout(form);
    layout->addWidget(m_inForce);
    QHBoxLayout *buttons = new QHBoxLayout;
    for (QPushButton *button : {check, fix, m_fixOne, program})
        buttons->addWidget(button);
    layout->addLayout(buttons);
    QHBoxLayout *wire = new QHBoxLayout;
    for (QPushButton *button : {hole, path, noPath, more})
        wire->addWidget(button);
    layout->addLayout(wire);
    layout->addWidget(m_message);
    QHBoxLayout *filter = new QHBoxLayout;
    filter->addWidget(m_count, 1);
    filter->addWidget(m_show);
    layout->addLayout(filter);
    QSplitter *splitter = new QSplitter(Qt::Vertical);
    splitter->addWidget(m_view);
    splitter->addWidget(m_list);
    splitter->setStretchFactor(0, 3);
    splitter->setStretchFactor(1, 2);
    layout->addWidget(splitter, 1);
    layout->addWidget(m_unchecked);
    QHBoxLayout *foot = new QHBoxLayout;
    foot->addWidget(m_live, 1);
    for (QPushButton *button : {mark, unmark, server})
        foot->addWidget(button);
    layout->addLayout(foot);
    setWidget(content);

    connect(server, &QPushButton::clicked, this, &Panel::serverWanted);
    connect(m_fixOne, &QPushButton::clicked, this, [this] {
        if (const Row *row = m_table->row(m_view->currentIndex().row()))
            emit fixOneWanted(row->handle, row->segment);
    });
    connect(m_correction, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &Panel::settingsChanged);
    connect(m_side, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &Panel::settingsChanged);
    connect(m_show, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this] {
        m_table->setShow(RadiusTable::Show(m_show->currentData().toInt()));
    });
    connect(m_view->selectionModel(), &QItemSelectionModel::currentRowChanged, this, &Panel::showDetails);
    connect(m_table, &QAbstractItemModel::modelReset, this, &Panel::showDetails);
    connect(m_view, &QTableView::doubleClicked, this, [this](const QModelIndex &index) {
        if (const Row *row = m_table->row(index.row()))
            placeOf(*row);
    });
    connect(m_list, &QListWidget::itemDoubleClicked, this, [this](QListWidgetItem *item) {
        const Finding finding = m_findings.value(m_list->row(item));
        const int row = m_table->find(finding.handle, finding.segment);
        if (row >= 0) {
            m_view->selectRow(row);
            placeOf(*m_table->row(row));
        } else if (finding.placed) {
            const QPointF along = finding.end - finding.start;
            emit placeWanted((finding.start + finding.end) / 2, std::hypot(along.x(), along.y()));
        }
    });
}

QPushButton *Panel::button(const QString &text, const char *command, const QString &tip)
{
    QPushButton *made = new QPushButton(text);
    made->setToolTip(tip);
    if (command)
        connect(made, &QPushButton::clicked, this, [this, command] { emit commandWanted(command); });
    return made;
}

void Panel::setServer(Server::State state, const QString &text)
{
    const bool bad = state != Server::State::Stopped && state != Server::State::Starting && state != Server::State::Ready;
    say(m_server, text, bad ? BAD : PLAIN);
}

void Panel::setInForce(const InForce &settings)
{
    QStringList corrections;
    for (const double each : settings.corrections)
        corrections += QString::number(each, 'f', 3);
    QStringList against{tr("correction %1 mm (%2)").arg(corrections.join(QStringLiteral(" / ")), originOf(settings.from)),
                        tr("%1 (%2)").arg(sideOf(settings.side), originOf(settings.sideFrom))};
    if (!settings.unitsFrom.isEmpty())
        against += tr("%1 (%2)").arg(unitOf(settings.unitsToMm), originOf(settings.unitsFrom));
    say(m_inForce, tr("against: %1").arg(against.join(tr(", "))), PLAIN);
    m_inForce->setToolTip(QDir::toNativeSeparators(QUrl(settings.file).toLocalFile()));
}

void Panel::setMessage(const QString &text, Tone tone)
{
    say(m_message, text, tone == Tone::Bad ? BAD : tone == Tone::Good ? GOOD : PLAIN);
}

void Panel::setLive(const QString &text)
{
    m_live->setText(text);
    m_isLive = !text.isEmpty();
    showCount();
}

void Panel::setStale(Stale stale)
{
    if (stale == m_stale)
        return;
    m_stale = stale;
    m_table->setStale(stale != Stale::No);
    colourList();
    showCount();
    showDetails();
}

void Panel::setUnchecked(const QString &text)
{
    say(m_unchecked, text, PLAIN);
}

void Panel::setFindings(const QVector<Finding> &findings)
{
    m_findings = findings;
    std::stable_sort(m_findings.begin(), m_findings.end(), [](const Finding &a, const Finding &b) { return a.severity < b.severity; });
    const int unlisted = m_findings.size() - MOST_LISTED;
    if (unlisted > 0)
        m_findings.resize(MOST_LISTED);
    m_list->clear();
    for (const Finding &finding : qAsConst(m_findings)) {
        QString place = finding.handle.isEmpty() ? QString() : tr(", entity %1").arg(finding.handle);
        if (!place.isEmpty() && finding.segment >= 0)
            place += tr(" vertex %1").arg(finding.segment);
        QListWidgetItem *item =
            new QListWidgetItem(QStringLiteral("%1%2: %3").arg(severityName(finding.severity), place, finding.message));
        item->setToolTip(finding.rule);
        m_list->addItem(item);
    }
    if (unlisted > 0)
        m_list->addItem(tr("and more: %1 that were sent are not listed").arg(unlisted));
    m_isChecked = true;
    for (int severity = 0; severity < 3; ++severity)
        m_counts[severity] = int(std::count_if(findings.begin(), findings.end(), [=](const Finding &each) { return int(each.severity) == severity + 1; }));
    m_table->setFindings(findings);
    colourList();
    showCount();
    showDetails();
}

void Panel::colourList()
{
    for (int i = 0; i < m_list->count(); ++i) {
        const Look look = m_stale != Stale::No ? staleLook() : i < m_findings.size() ? lookOf(m_findings.at(i).severity) : lookOf(Severity::Hint);
        m_list->item(i)->setForeground(look.text);
        m_list->item(i)->setBackground(look.ground);
    }
}

/// Green holds only for a drawing that was looked at and has not changed since.
void Panel::showCount()
{
    if (!m_isChecked) {
        m_count->clear();
        return;
    }
    if (m_stale != Stale::No) {
        m_count->setText(m_stale == Stale::Undone ? tr("not checked since Undo") : tr("not checked since the last change"));
        m_count->setToolTip(tr("The list is from an earlier check. Check looks at the drawing again; Redo is lost then."));
        m_count->setStyleSheet(QStringLiteral("font-weight: bold; padding: 2px; color: %1; background: %2").arg(staleLook().text.name(), staleLook().ground.name()));
        return;
    }
    const bool clean = m_counts[0] == 0 && m_counts[1] == 0;
    QString found = clean ? tr("no fault found") : tr("errors: %1   warnings: %2").arg(m_counts[0]).arg(m_counts[1]);
    if (m_counts[2] > 0)
        found += tr("   notes: %1").arg(m_counts[2]);
    m_count->setText(m_isLive ? found : tr("%1 at the last check").arg(found));
    m_count->setToolTip(QString());
    const Look look = lookOf(m_counts[0] > 0 ? Severity::Error : Severity::Warning);
    m_count->setStyleSheet(clean ? QStringLiteral("font-weight: bold; padding: 2px; %1").arg(QLatin1String(GOOD))
                                 : QStringLiteral("font-weight: bold; padding: 2px; color: %1; background: %2").arg(look.text.name(), look.ground.name()));
}

void Panel::setInspection(const QSharedPointer<Inspection> &inspection)
{
    const Row *chosen = m_table->row(m_view->currentIndex().row());
    const QString handle = chosen ? chosen->handle : QString();
    const int segment = chosen ? chosen->segment : -1;
    m_table->setInspection(inspection);
    const int row = handle.isEmpty() ? -1 : m_table->find(handle, segment);
    if (row >= 0)
        m_view->selectRow(row);
}

void Panel::clear()
{
    m_findings.clear();
    m_list->clear();
    m_isChecked = false;
    setStale(Stale::No);
    showCount();
    say(m_inForce, QString(), PLAIN);
    m_table->setInspection(QSharedPointer<Inspection>());
    setMessage(QString(), Tone::Plain);
    setUnchecked(QString());
}

void Panel::setSettings(double correction, const QString &side)
{
    const QSignalBlocker one(m_correction);
    const QSignalBlocker other(m_side);
    m_correction->setValue(correction);
    m_side->setCurrentIndex(qMax(0, m_side->findData(side)));
}

void Panel::chooseSide(const QString &side)
{
    m_side->setCurrentIndex(qMax(0, m_side->findData(side)));
}

double Panel::correction() const
{
    return m_correction->value();
}

QString Panel::side() const
{
    return m_side->currentData().toString();
}

void Panel::placeOf(const Row &row)
{
    const QPointF along = row.end - row.start;
    const double size = std::max(row.radius, std::hypot(along.x(), along.y()));
    emit placeWanted(middleOf(row), size);
}

void Panel::showDetails()
{
    const Row *row = m_table->row(m_view->currentIndex().row());
    bool repairable = false;
    for (int i = 0; row && i < m_findings.size(); ++i) {
        if (m_findings.at(i).handle == row->handle && m_findings.at(i).segment == row->segment) {
            repairable = true;
            const QSignalBlocker blocker(m_list);
            m_list->setCurrentRow(i);
            break;
        }
    }
    m_fixOne->setEnabled(repairable && m_stale == Stale::No);
}

} // namespace wedm
