// SPDX-License-Identifier: GPL-2.0-or-later
// What is said of what was made of a drawing: programs that were written or were not, whether a pair fits, figures.
#pragma once

#include "core/figures.h"
#include "core/program.h"
#include "sheet.h"

namespace wedm {
namespace programs {

QString written(const Program &program);
/// The programs of a pair, each in its file.
QString writtenPair(const QVector<Program> &programs);
/// The answer to `wedm/fit` as a window shows it.
SheetContent fit(const QJsonObject &fit);
SheetContent figures(const Figures &figures);
QString refused(const QString &reason, const QStringList &findings);

} // namespace programs
} // namespace wedm
