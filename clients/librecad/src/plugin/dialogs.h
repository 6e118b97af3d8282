// SPDX-License-Identifier: GPL-2.0-or-later
// What the user is asked, each in a window that blocks nothing; a callback gets the answer.
#pragma once

#include <QStringList>

#include <functional>

namespace wedm {
namespace dialogs {

/// Where the program of a format ("3b", "4b", "iso"; "milling", which is ISO for an electrode) is to be written; `base` is the name that is proposed, without its ending.
void programFile(const QString &format, const QString &folder, const QString &base, std::function<void(const QString &)> chosen);

/// Where the drill list is to be written: a file that ends in .csv or .dxf.
void drillFile(const QString &folder, const QString &base, std::function<void(const QString &)> chosen);

/// In which language the programs of a pair are to be written ("3b", "4b", "iso"), and then into which folder.
void pairFormat(std::function<void(const QString &)> chosen);
void folder(const QString &title, const QString &now, std::function<void(const QString &)> chosen);

/// Whether these files, which are there already, are to be overwritten.
void overwrite(const QStringList &names, std::function<void()> go);

/// On which side of the drawn contours the wire runs, or the electrode: "auto", "opening" or "punch".
void side(bool mills, std::function<void(const QString &)> chosen);

/// What the parts of a pair are made by; lengths in mm, the clearance on each side.
struct PairSizes {
    /// "punch" or "plate".
    QString drawnAs = QStringLiteral("punch");
    double clearance = 0.01;
    double wireDiameter = 0.18;
    double gap = 0.01;
};
void pairSizes(const PairSizes &proposed, std::function<void(const PairSizes &)> chosen);

/// Which program the server is; `now` is the one that is set.
void serverProgram(const QString &now, std::function<void(const QString &)> chosen);

/// A program was refused for these findings: whether it is to be written all the same.
void writeAllTheSame(const QString &reason, const QStringList &findings, std::function<void()> forced);

/// Whether to make a repair that would keep LibreCAD busy for this long.
void longRebuild(qint64 milliseconds, std::function<void()> go, std::function<void()> cancel);

} // namespace dialogs
} // namespace wedm
