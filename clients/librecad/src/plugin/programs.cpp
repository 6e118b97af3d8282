// SPDX-License-Identifier: GPL-2.0-or-later
#include "programs.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QJsonArray>

#include <algorithm>
#include <cmath>

namespace wedm {
namespace programs {

namespace {

/// The number of findings that are named in one message.
constexpr int NAMED = 5;
/// Decimals of lengths, and of what is left of a clearance.
constexpr int ROUGH = 3;
constexpr int FINE = 4;

QString tr(const char *text)
{
    return QCoreApplication::translate("wedm::programs", text);
}

/// A drift that rounds to zero has no sign.
QString micrometres(double drift)
{
    return QString::number(std::round(drift * 100) / 100 + 0.0, 'f', 2);
}

QString mm(double value, int decimals = ROUGH)
{
    return QString::number(value, 'f', decimals);
}

/// The parts of a tool have names in every language; a workpiece has the one that it was given.
QString partName(const QString &part)
{
    for (const char *known : {QT_TRANSLATE_NOOP("wedm::programs", "punch"), QT_TRANSLATE_NOOP("wedm::programs", "plate"),
                              QT_TRANSLATE_NOOP("wedm::programs", "stripper"), QT_TRANSLATE_NOOP("wedm::programs", "holder")}) {
        if (part == QLatin1String(known))
            return tr(known);
    }
    return part;
}

QString sideName(const QString &role)
{
    if (role == QLatin1String("line"))
        return tr("cut on the line");
    for (const char *known : {QT_TRANSLATE_NOOP("wedm::programs", "opening"), QT_TRANSLATE_NOOP("wedm::programs", "punch"),
                              QT_TRANSLATE_NOOP("wedm::programs", "left"), QT_TRANSLATE_NOOP("wedm::programs", "right")}) {
        if (role == QLatin1String(known))
            return tr(known);
    }
    return tr("both sides");
}

QString findings(const QStringList &warnings)
{
    return warnings.isEmpty() ? QString() : QLatin1Char('\n') + tr("Findings in the drawing: %1").arg(warnings.mid(0, NAMED).join(QStringLiteral("; ")));
}

QString offChords(const Program &program)
{
    return program.offChords > 0 ? QLatin1Char(' ') + tr("Chords of the drawing are cut as arcs: at most %1 µm from the outline.").arg(program.offChords, 0, 'f', 2)
                                 : QString();
}

} // namespace

QString written(const Program &program)
{
    QString text = tr("Written: %1, %2 blocks, cut %3 mm, jumps %4 mm. Every block was decoded again: at most %5 µm from the path.")
                       .arg(QDir::toNativeSeparators(program.path))
                       .arg(program.blocks)
                       .arg(program.cut, 0, 'f', 3)
                       .arg(program.jumps, 0, 'f', 3)
                       .arg(program.deviation, 0, 'f', 2);
    // ISO programs, those of an electrode included, state the end point of a block: there is no drift of counted lengths.
    if (program.format == QLatin1String("milling"))
        text += QLatin1Char(' ') + tr("%1 layers; simulated: the floor %2 to %3 mm deep, the electrode %4 mm shorter.")
                                       .arg(program.layers)
                                       .arg(program.floorLeast, 0, 'f', 4)
                                       .arg(program.floorMost, 0, 'f', 4)
                                       .arg(program.worn, 0, 'f', 4);
    else if (program.format != QLatin1String("iso"))
        text += QLatin1Char(' ') + tr("Rounding of J, added up: %1, %2 µm.").arg(micrometres(program.closureX), micrometres(program.closureY));
    return text + offChords(program) + findings(program.warnings);
}

QString writtenPair(const QVector<Program> &programs)
{
    QStringList lines;
    for (const Program &each : programs) {
        QStringList corrections;
        for (const double correction : each.corrections)
            corrections += mm(correction, FINE);
        QString text = tr("%1, %2: correction %3 mm").arg(QFileInfo(each.path).fileName(), partName(each.part), corrections.join(QStringLiteral(" / ")));
        if (each.otherSide)
            text += tr(", the wire on what is drawn or on its other side");
        lines += text + tr(", %1 blocks, cut %2 mm, jumps %3 mm").arg(each.blocks).arg(mm(each.cut), mm(each.jumps)) + offChords(each);
    }
    const QString folder = programs.isEmpty() ? QString() : QDir::toNativeSeparators(QFileInfo(programs.at(0).path).absolutePath());
    return tr("Written to %1:").arg(folder) + QLatin1Char('\n') + lines.join(QLatin1Char('\n')) + findings(programs.value(0).warnings);
}

SheetContent fit(const QJsonObject &fit)
{
    SheetContent content;
    content.title = tr("Whether punch and plate fit");
    const bool fits = fit.value("fits").toBool();
    const double least = fit.value("least").toDouble();
    const QString wanted = mm(fit.value("clearance").toDouble(), FINE);
    QVector<QJsonObject> places;
    const QJsonArray listed = fit.value("places").toArray();
    for (const QJsonValue &each : listed)
        places += each.toObject();
    std::stable_sort(places.begin(), places.end(), [](const QJsonObject &a, const QJsonObject &b) { return a.value("clearance").toDouble() < b.value("clearance").toDouble(); });
    const QJsonArray alone = fit.value("alone").toArray();
    if (!fits && places.isEmpty())
        content.sentence = tr("Nothing was compared: no contour has a partner.");
    else if (least < 0)
        content.sentence = tr("Does not fit: the parts overlap by %1 mm where it is tightest, %2 mm of clearance are wanted.").arg(mm(-least, FINE), wanted);
    else
        content.sentence = (fits ? tr("Fits: %1 mm of %2 mm are left where it is tightest.") : tr("Does not fit: %1 mm of %2 mm are left where it is tightest.")).arg(mm(least, FINE), wanted);
    content.verdict = fits ? SheetContent::Verdict::Good : SheetContent::Verdict::Bad;
    content.heads = QStringList{tr("mm left"), tr("Part"), tr("Entity"), tr("Vertex"), QStringLiteral("X"), QStringLiteral("Y")};
    for (const QJsonObject &each : qAsConst(places)) {
        const QJsonArray at = each.value("at").toArray();
        const QPointF point(at.at(0).toDouble(), at.at(1).toDouble());
        content.rows += QStringList{mm(each.value("clearance").toDouble(), FINE), partName(each.value("of").toString()), each.value("handle").toString(),
                                    QString::number(each.value("segment").toInt()), mm(point.x(), FINE), mm(point.y(), FINE)};
        content.places += qMakePair(point, 0.0);
    }
    QStringList lonely;
    for (const QJsonValue &each : alone)
        lonely += tr("%1 of %2").arg(each.toObject().value("handle").toString(), partName(each.toObject().value("of").toString()));
    if (!lonely.isEmpty())
        content.notes += tr("Without a partner: %1").arg(lonely.join(QStringLiteral(", ")));
    if (!content.rows.isEmpty())
        content.notes += tr("Less is left at these places than there should be. A double click shows one.");
    return content;
}

SheetContent figures(const Figures &figures)
{
    SheetContent content;
    content.title = tr("Figures");
    double drawn = 0;
    for (const ContourFigures &each : figures.contours)
        drawn += each.length;
    QStringList lines{tr("Contours: %1, %2 mm round").arg(figures.contours.size()).arg(mm(drawn))};
    for (const Work &work : figures.works) {
        QString text = work.part.isEmpty() ? QString() : tr("%1: ").arg(partName(work.part));
        text += tr("cut %1 mm, jumps %2 mm").arg(mm(work.cut), mm(work.jumps));
        if (work.minutes >= 0)
            text += tr(", %1 min on the machine").arg(work.minutes, 0, 'f', 1);
        if (work.cost >= 0)
            text += tr(", cost %1").arg(work.cost, 0, 'f', 2);
        lines += text;
    }
    content.sentence = lines.join(QLatin1Char('\n'));
    content.heads = QStringList{tr("Contour"), tr("Entity"),      tr("Layer"),     tr("Side"),   tr("Segments"), tr("Length mm"), tr("Area mm²"),
                                tr("Extents mm"), tr("Least R mm"), tr("Cut no."), tr("Cut mm"), tr("min"),      tr("Drops g")};
    const auto known = [](double value, int decimals) { return value < 0 ? QString() : mm(value, decimals); };
    for (int i = 0; i < figures.contours.size(); ++i) {
        const ContourFigures &each = figures.contours.at(i);
        const QPointF size = each.most - each.least;
        content.rows += QStringList{QString::number(i + 1),
                                    each.handle,
                                    each.layer,
                                    each.closed ? sideName(each.role) : tr("%1, open").arg(sideName(each.role)),
                                    QString::number(each.segments),
                                    mm(each.length),
                                    known(each.area, ROUGH),
                                    QStringLiteral("%1 × %2").arg(mm(size.x()), mm(size.y())),
                                    known(each.leastRadius, ROUGH),
                                    each.order < 0 ? QString() : QString::number(each.order),
                                    known(each.cut, ROUGH),
                                    known(each.minutes, 1),
                                    known(each.mass, 1)};
        content.places += qMakePair((each.least + each.most) / 2 / figures.unitsToMm, std::max(size.x(), size.y()) / figures.unitsToMm / 4);
    }
    content.notes += figures.largestWire < 0 ? tr("Largest wire: not known, since gap is not set") : tr("Largest wire: Ø %1 mm").arg(mm(figures.largestWire));
    if (!figures.noPath.isEmpty())
        content.notes += tr("There is no path of the wire: %1.").arg(figures.noPath);
    else if (!figures.works.isEmpty() && !figures.works.at(0).missing.isEmpty())
        content.notes += tr("Not known, since not set: %1").arg(figures.works.at(0).missing.join(QStringLiteral(", ")));
    return content;
}

QString refused(const QString &reason, const QStringList &findings)
{
    return (QStringList{reason} + findings.mid(0, NAMED)).join(QLatin1Char('\n'));
}

} // namespace programs
} // namespace wedm
