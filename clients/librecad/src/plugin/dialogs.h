// SPDX-License-Identifier: GPL-2.0-or-later
// What the user is asked, each in a window that blocks nothing; a callback gets the answer.
#pragma once

#include <QStringList>

#include <functional>

namespace wedm {
namespace dialogs {

/// Where the program of a format ("3b", "4b", "iso"; "milling", which is ISO for an electrode) is to be written; `base` is the name that is proposed, without its ending.
void programFile(const QString &format, const QString &folder, const QString &base, std::function<void(const QString &)> chosen);

/// Which program the server is; `now` is the one that is set.
void serverProgram(const QString &now, std::function<void(const QString &)> chosen);

/// A program was refused for these findings: whether it is to be written all the same.
void writeAllTheSame(const QString &reason, const QStringList &findings, std::function<void()> forced);

/// Whether to make a repair that would keep LibreCAD busy for this long.
void longRebuild(qint64 milliseconds, std::function<void()> go, std::function<void()> cancel);

} // namespace dialogs
} // namespace wedm
