// SPDX-License-Identifier: GPL-2.0-or-later
// Contours and paths as the server lists them, and the points that contours are kept by, because LibreCAD's numbers of entities do not
// last.
#pragma once

#include "drawing.h"

#include <QJsonArray>
#include <QJsonObject>
#include <QPointF>

namespace wedm {

/// The farthest that a point may lie from the contour that it names, in drawing units.
constexpr double ON_CONTOUR = 0.01;

/// A hole that the wire is threaded through; `radius` in drawing units.
struct ThreadHole {
    QPointF at;
    double radius = 0;
};

/// The path of the wire's centre, of all contours and passes, in drawing units.
struct Toolpath {
    QVector<Entity> pieces;
    QVector<ThreadHole> holes;
    /// The ways without a cut, from each contour to the next.
    QVector<Entity> jumps;
    /// mm that are cut, and mm between the contours.
    double cut = 0;
    double jumped = 0;
};

/// Of the result of `wedm/toolpath`.
Toolpath toolpathFromJson(const QJsonObject &result);

/// The index of the contour nearest to a point in the result of `wedm/contours`; −1 where there is none.
int nearestContour(const QJsonArray &contours, const QPointF &point);

/// The name by which a contour is kept: the one among `kept`, names from the settings, that lies on it, else the middle of its
/// longest segment, which stays on it when corners beside it are repaired. Names are points in mm; `unit` is the drawing's, mm.
QString nameOfContour(const QJsonObject &contour, double unit, const QStringList &kept);

/// A point as two numbers with `between` between them, without digits beyond a nanometre.
QString pointText(const QPointF &point, const char *between);

} // namespace wedm
