// SPDX-License-Identifier: GPL-2.0-or-later
// What the tests draw.
#pragma once

#include "core/drawing.h"

namespace wedm {

inline Entity entityOf(Kind kind, quint64 identity, const QString &layer = "DIE")
{
    Entity entity;
    entity.identity = identity;
    entity.layer = layer;
    entity.kind = kind;
    return entity;
}

inline Entity polyline(quint64 identity, const QVector<Vertex> &vertices, const QString &layer = "DIE")
{
    Entity entity = entityOf(Kind::Polyline, identity, layer);
    entity.closed = true;
    entity.vertices = vertices;
    return entity;
}

inline Entity line(quint64 identity, Vertex start, Vertex end)
{
    Entity entity = entityOf(Kind::Line, identity);
    entity.vertices = {start, end};
    return entity;
}

inline Entity arc(quint64 identity, double x, double y, double radius, double startAngle, double endAngle)
{
    Entity entity = entityOf(Kind::Arc, identity);
    entity.x = x;
    entity.y = y;
    entity.radius = radius;
    entity.startAngle = startAngle;
    entity.endAngle = endAngle;
    return entity;
}

inline Entity circle(quint64 identity, double x, double y, double radius)
{
    Entity entity = entityOf(Kind::Circle, identity);
    entity.x = x;
    entity.y = y;
    entity.radius = radius;
    return entity;
}

constexpr double QUARTER = 0.41421356237309503; // tan(90° / 4)

/// A 20 × 10 opening of which the corner at 20, 0 has a fillet of `radius`.
inline QVector<Vertex> opening(double radius)
{
    return {{0, 0, 0}, {20 - radius, 0, QUARTER}, {20, radius, 0}, {20, 10, 0}, {0, 10, 0}};
}

} // namespace wedm
