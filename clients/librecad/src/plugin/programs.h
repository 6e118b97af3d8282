// SPDX-License-Identifier: GPL-2.0-or-later
// The message about a program that was written, or was not.
#pragma once

#include "core/session.h"

namespace wedm {
namespace programs {

QString written(const Program &program);
QString refused(const QString &reason, const QStringList &findings);

} // namespace programs
} // namespace wedm
