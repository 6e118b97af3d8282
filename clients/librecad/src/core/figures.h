// SPDX-License-Identifier: GPL-2.0-or-later
// What a drawing comes to, in mm and minutes: of each contour, and on the machine. Knows nothing of who asks.
#pragma once

#include <QJsonObject>
#include <QPointF>
#include <QStringList>
#include <QVector>

namespace wedm {

/// A contour; what is not known is below 0.
struct ContourFigures {
    /// The entity that it begins with, and its layer.
    QString handle;
    QString layer;
    bool closed = false;
    QString role;
    int segments = 0;
    /// Its place among the cuts, from 1.
    int order = -1;
    double length = 0;
    double area = -1;
    double leastRadius = -1;
    QPointF least;
    QPointF most;
    /// The length that is cut for it, leads and all passes counted in, and how long that takes.
    double cut = -1;
    double minutes = -1;
    /// What drops out, in g.
    double mass = -1;
};

/// What it comes to on the machine; of a pair, for one part. What is not known is below 0.
struct Work {
    QString part;
    double cut = 0;
    double jumps = 0;
    double minutes = -1;
    double cost = -1;
    /// The keys of the settings that would be needed for the rest.
    QStringList missing;
};

struct Figures {
    double unitsToMm = 1;
    QVector<ContourFigures> contours;
    QVector<Work> works;
    /// The largest wire that passes everywhere, mm.
    double largestWire = -1;
    /// Why there is no path of the wire, and so no work; empty where there is one.
    QString noPath;
};

/// From the results of `wedm/contours`, `wedm/inspect` and `wedm/toolpath`.
Figures figuresFromJson(const QJsonObject &contours, const QJsonObject &inspection, const QJsonObject &toolpath);

} // namespace wedm
