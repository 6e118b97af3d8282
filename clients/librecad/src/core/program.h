// SPDX-License-Identifier: GPL-2.0-or-later
// What the server makes of a drawing: programs, their files, and what is asked of the user where one is refused. Knows neither LibreCAD
// nor how the server is reached.
#pragma once

#include <QJsonObject>
#include <QStringList>
#include <QVector>

namespace wedm {

/// The figures of a program: `cut` and `jumps` in mm, the length that is cut and that of the ways between contours.
struct Program {
    QString path;
    /// "3b", "4b", "iso" or "milling".
    QString format;
    /// Of a pair: the part that it cuts, the corrections of its passes in mm, and whether the wire runs on the other side of what is drawn.
    QString part;
    QVector<double> corrections;
    bool otherSide = false;
    QByteArray text;
    int blocks = 0;
    double cut = 0;
    double jumps = 0;
    double deviation = 0;
    /// In µm: how far arcs that are cut in place of the drawing's chords lie from them; 0 without any.
    double offChords = 0;
    double closureX = 0;
    double closureY = 0;
    /// For an electrode, in mm: the highest and deepest place of the floor, and by how much the electrode is shorter at the end.
    int layers = 0;
    double floorLeast = 0;
    double floorMost = 0;
    double worn = 0;
    QStringList warnings;
};

/// The answer to `wedm/generate`, or one of the programs of `wedm/pair`.
Program programFromJson(const QJsonObject &result, const QString &format);

/// The name of the file of a part of a pair, as `wedm pair` names it: characters that a file name cannot hold become `_`.
QString partFile(const QString &base, const QString &part, const QString &ending);

/// Writes the file beside `path` and renames it. Says what is wrong; empty where it is written.
QString writeFile(const QString &path, const QByteArray &content);

/// Why the server has not made what it was asked for.
struct Refusal {
    QString reason;
    /// The errors that stand in the way; with some of them it can be made all the same.
    QStringList findings;
    /// The server has ended, or was not there.
    bool isEnded = false;

    /// Which side of a contour the wire runs on is not known.
    bool needsSide() const;
    /// Nothing says what the parts of a pair are, or how far apart.
    bool needsPair() const;
};

} // namespace wedm
