// SPDX-License-Identifier: GPL-2.0-or-later
#include "programs.h"

#include <QCoreApplication>
#include <QDir>

#include <cmath>

namespace wedm {
namespace programs {

namespace {

/// The number of findings that are named in one message.
constexpr int NAMED = 5;

QString tr(const char *text)
{
    return QCoreApplication::translate("wedm::programs", text);
}

/// A drift that rounds to zero has no sign.
QString micrometres(double drift)
{
    return QString::number(std::round(drift * 100) / 100 + 0.0, 'f', 2);
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
    if (!program.warnings.isEmpty())
        text += QLatin1Char('\n') + tr("Findings in the drawing: %1").arg(program.warnings.mid(0, NAMED).join(QStringLiteral("; ")));
    return text;
}

QString refused(const QString &reason, const QStringList &findings)
{
    return (QStringList{reason} + findings.mid(0, NAMED)).join(QLatin1Char('\n'));
}

} // namespace programs
} // namespace wedm
