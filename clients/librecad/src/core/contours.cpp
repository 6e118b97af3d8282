// SPDX-License-Identifier: GPL-2.0-or-later
#include "contours.h"

#include <cmath>
#include <limits>

namespace wedm {

namespace {

constexpr int DECIMALS = 6;

QPointF toPoint(const QJsonValue &value)
{
    const QJsonArray pair = value.toArray();
    return QPointF(pair.at(0).toDouble(), pair.at(1).toDouble());
}

double length(const QPointF &way)
{
    return std::hypot(way.x(), way.y());
}

double degreesFrom(const QPointF &centre, const QPointF &point)
{
    return std::atan2(point.y() - centre.y(), point.x() - centre.x()) * 180 / M_PI;
}

Entity line(const QPointF &start, const QPointF &end)
{
    Entity entity;
    entity.kind = Kind::Line;
    entity.vertices = {Vertex{start.x(), start.y(), 0}, Vertex{end.x(), end.y(), 0}};
    return entity;
}

Entity circle(const QPointF &centre, double radius)
{
    Entity entity;
    entity.kind = Kind::Circle;
    entity.x = centre.x();
    entity.y = centre.y();
    entity.radius = radius;
    return entity;
}

/// A segment of a path as an entity of its own.
Entity entityOf(const QJsonObject &segment)
{
    const QPointF start = toPoint(segment.value("start"));
    const QPointF end = toPoint(segment.value("end"));
    if (!segment.value("center").isArray())
        return line(start, end);
    const QPointF centre = toPoint(segment.value("center"));
    Entity entity = circle(centre, segment.value("radius").toDouble());
    if (segment.value("kind").toString() == QLatin1String("circle"))
        return entity;
    const bool clockwise = segment.value("sweep").toDouble() < 0;
    entity.kind = Kind::Arc;
    entity.startAngle = degreesFrom(centre, clockwise ? end : start);
    entity.endAngle = degreesFrom(centre, clockwise ? start : end);
    return entity;
}

/// How far a point lies from a segment.
double distance(const QJsonObject &segment, const QPointF &point)
{
    const QPointF start = toPoint(segment.value("start"));
    const QPointF end = toPoint(segment.value("end"));
    const double ends = qMin(length(point - start), length(point - end));
    if (!segment.value("center").isArray()) {
        const QPointF way = end - start;
        const double square = QPointF::dotProduct(way, way);
        const double along = square > 0 ? QPointF::dotProduct(point - start, way) / square : 0;
        return along <= 0 || along >= 1 ? ends : length(point - start - along * way);
    }
    const QPointF centre = toPoint(segment.value("center"));
    const double sweep = segment.value("sweep").toDouble();
    const double turned = std::remainder(degreesFrom(centre, point) - degreesFrom(centre, start), 360.0);
    const double along = sweep < 0 ? -turned : turned;
    const bool beside = (along < 0 ? along + 360 : along) <= std::abs(sweep);
    return beside ? std::abs(length(point - centre) - segment.value("radius").toDouble()) : ends;
}

double distanceOf(const QJsonObject &contour, const QPointF &point)
{
    double least = std::numeric_limits<double>::infinity();
    const QJsonArray segments = contour.value("segments").toArray();
    for (const QJsonValue &each : segments)
        least = qMin(least, distance(each.toObject(), point));
    return least;
}

QPointF middleOf(const QJsonObject &segment)
{
    const QPointF start = toPoint(segment.value("start"));
    if (!segment.value("center").isArray())
        return (start + toPoint(segment.value("end"))) / 2;
    const QPointF centre = toPoint(segment.value("center"));
    const double angle = (degreesFrom(centre, start) + segment.value("sweep").toDouble() / 2) * M_PI / 180;
    return centre + segment.value("radius").toDouble() * QPointF(std::cos(angle), std::sin(angle));
}

QString numberText(double value)
{
    QString text = QString::number(value, 'f', DECIMALS);
    while (text.endsWith(QLatin1Char('0')))
        text.chop(1);
    if (text.endsWith(QLatin1Char('.')))
        text.chop(1);
    return text == QLatin1String("-0") ? QStringLiteral("0") : text;
}

} // namespace

Toolpath toolpathFromJson(const QJsonObject &result)
{
    Toolpath path;
    const double unit = result.value("unitsToMm").toDouble(1);
    const QJsonArray paths = result.value("paths").toArray();
    double wire = 0;
    for (const QJsonValue &each : paths) {
        const QJsonArray segments = each.toObject().value("segments").toArray();
        for (const QJsonValue &segment : segments) {
            // A lead from a hole that lies on the path has no length.
            if (segment.toObject().value("length").toDouble() > 0)
                path.pieces += entityOf(segment.toObject());
        }
        if (wire == 0)
            wire = each.toObject().value("correction").toDouble();
    }
    const QJsonArray holes = result.value("holes").toArray();
    for (const QJsonValue &each : holes) {
        const double diameter = each.toObject().value("diameter").toDouble();
        path.holes += ThreadHole{toPoint(each.toObject().value("at")), diameter > 0 ? diameter / 2 / unit : wire};
    }
    for (int i = 1; i < path.holes.size(); ++i) {
        if (path.holes.at(i - 1).at != path.holes.at(i).at)
            path.jumps += line(path.holes.at(i - 1).at, path.holes.at(i).at);
    }
    const QJsonObject work = result.value("work").toObject();
    path.cut = work.value("length").toDouble();
    path.jumped = work.value("jumps").toDouble();
    return path;
}

int nearestContour(const QJsonArray &contours, const QPointF &point)
{
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < contours.size(); ++i) {
        const double away = distanceOf(contours.at(i).toObject(), point);
        if (away < least) {
            least = away;
            nearest = i;
        }
    }
    return nearest;
}

QString nameOfContour(const QJsonObject &contour, double unit, const QStringList &kept)
{
    for (const QString &name : kept) {
        const QStringList pair = name.split(QLatin1Char(','));
        bool isX = false;
        bool isY = false;
        const QPointF point(pair.value(0).toDouble(&isX), pair.value(1).toDouble(&isY));
        if (pair.size() == 2 && isX && isY && distanceOf(contour, point / unit) * unit <= ON_CONTOUR)
            return name;
    }
    QJsonObject longest;
    const QJsonArray segments = contour.value("segments").toArray();
    for (const QJsonValue &each : segments) {
        if (longest.isEmpty() || each.toObject().value("length").toDouble() > longest.value("length").toDouble())
            longest = each.toObject();
    }
    return pointText(middleOf(longest) * unit, ",");
}

QString pointText(const QPointF &point, const char *between)
{
    return numberText(point.x()) + QLatin1String(between) + numberText(point.y());
}

} // namespace wedm
