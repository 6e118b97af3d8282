// SPDX-License-Identifier: GPL-2.0-or-later
#include "marks.h"

#include "snapshot.h"

namespace wedm {

namespace {

/// The size of a mark as a share of the drawing's.
constexpr double SHARE = 0.015;

/// The longer side of the box round all that can be cut.
double size(const QVector<Entity> &entities)
{
    double left = 0, right = 0, low = 0, high = 0;
    bool any = false;
    const auto reach = [&](double x, double y) {
        left = any ? qMin(left, x) : x;
        right = any ? qMax(right, x) : x;
        low = any ? qMin(low, y) : y;
        high = any ? qMax(high, y) : y;
        any = true;
    };
    for (const Entity &entity : entities) {
        for (const Vertex &vertex : entity.vertices)
            reach(vertex.x, vertex.y);
        if (entity.vertices.isEmpty()) {
            reach(entity.x - entity.radius, entity.y - entity.radius);
            reach(entity.x + entity.radius, entity.y + entity.radius);
        }
    }
    return qMax(right - left, high - low);
}

} // namespace

int markFaults(Document_Interface &drawing, const QVector<Finding> &findings)
{
    clearLayer(drawing, MARK_LAYER);
    QVector<QPointF> places;
    for (const Finding &finding : findings) {
        if (finding.placed && finding.severity <= Severity::Warning)
            places += (finding.start + finding.end) / 2;
    }
    drawMarks(drawing, places, size(takeSnapshot(drawing).entities) * SHARE);
    return places.size();
}

} // namespace wedm
