// SPDX-License-Identifier: GPL-2.0-or-later
#include "figures.h"

#include <QHash>
#include <QJsonArray>

#include <algorithm>
#include <cmath>

namespace wedm {

namespace {

QPointF pointOf(const QJsonValue &value)
{
    const QJsonArray point = value.toArray();
    return QPointF(point.at(0).toDouble(), point.at(1).toDouble());
}

/// Widens the extents by an arc, beyond its ends where it passes the highest, lowest, leftmost or rightmost point of its circle.
void widen(ContourFigures &contour, const QJsonObject &segment)
{
    const auto include = [&](const QPointF &point) {
        contour.least = QPointF(std::min(contour.least.x(), point.x()), std::min(contour.least.y(), point.y()));
        contour.most = QPointF(std::max(contour.most.x(), point.x()), std::max(contour.most.y(), point.y()));
    };
    const QPointF start = pointOf(segment.value("start"));
    include(start);
    include(pointOf(segment.value("end")));
    if (!segment.contains("center"))
        return;
    const QPointF centre = pointOf(segment.value("center"));
    const double radius = segment.value("radius").toDouble();
    const double sweep = segment.value("sweep").toDouble();
    const double from = std::atan2(start.y() - centre.y(), start.x() - centre.x()) * 180 / M_PI;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        const double turned = sweep < 0 ? from - quadrant * 90 : quadrant * 90 - from;
        if (std::fmod(std::fmod(turned, 360) + 360, 360) <= std::abs(sweep))
            include(centre + radius * QPointF(quadrant == 0 ? 1 : quadrant == 2 ? -1 : 0, quadrant == 1 ? 1 : quadrant == 3 ? -1 : 0));
    }
}

ContourFigures contourOf(const QJsonObject &listed, double unit)
{
    ContourFigures contour;
    const QJsonArray segments = listed.value("segments").toArray();
    const QJsonObject first = segments.at(0).toObject();
    contour.handle = first.value("handle").toString();
    contour.closed = listed.value("closed").toBool();
    contour.role = listed.value("role").toString();
    contour.segments = segments.size();
    contour.order = listed.contains("order") ? listed.value("order").toInt() + 1 : -1;
    contour.length = listed.value("length").toDouble() * unit;
    contour.area = listed.contains("area") ? listed.value("area").toDouble() * unit * unit : -1;
    contour.least = contour.most = pointOf(first.value("start"));
    for (const QJsonValue &each : segments) {
        const QJsonObject segment = each.toObject();
        widen(contour, segment);
        if (const double radius = segment.value("radius").toDouble(-1) * unit; radius >= 0)
            contour.leastRadius = contour.leastRadius < 0 ? radius : std::min(contour.leastRadius, radius);
    }
    contour.least *= unit;
    contour.most *= unit;
    return contour;
}

Work workOf(const QJsonObject &listed, const QString &part)
{
    Work work;
    work.part = part;
    work.cut = listed.value("length").toDouble();
    work.jumps = listed.value("jumps").toDouble();
    work.minutes = listed.value("minutes").toDouble(-1);
    work.cost = listed.value("cost").toDouble(-1);
    const QJsonArray missing = listed.value("missing").toArray();
    for (const QJsonValue &each : missing)
        work.missing += each.toString();
    return work;
}

} // namespace

Figures figuresFromJson(const QJsonObject &contours, const QJsonObject &inspection, const QJsonObject &toolpath)
{
    Figures figures;
    figures.unitsToMm = contours.value("unitsToMm").toDouble(1);
    QHash<QString, QString> layers;
    const QJsonArray entities = inspection.value("entities").toArray();
    for (const QJsonValue &each : entities)
        layers.insert(each.toObject().value("handle").toString(), each.toObject().value("layer").toString());
    QHash<QString, int> contourOfEntity;
    const QJsonArray listed = contours.value("contours").toArray();
    for (const QJsonValue &each : listed) {
        ContourFigures contour = contourOf(each.toObject(), figures.unitsToMm);
        contour.layer = layers.value(contour.handle);
        const QJsonArray segments = each.toObject().value("segments").toArray();
        for (const QJsonValue &segment : segments)
            contourOfEntity.insert(segment.toObject().value("handle").toString(), figures.contours.size());
        figures.contours += contour;
    }
    figures.largestWire = inspection.value("largestWire").toObject().value("diameter").toDouble(-1);
    const QJsonArray parts = toolpath.value("parts").toArray();
    for (const QJsonValue &each : parts)
        figures.works += workOf(each.toObject().value("work").toObject(), each.toObject().value("part").toString());
    if (!toolpath.contains("work"))
        return figures;
    const QJsonObject work = toolpath.value("work").toObject();
    figures.works += workOf(work, QString());
    const auto add = [](double &sum, const QJsonValue &more) {
        if (more.isDouble())
            sum = std::max(sum, 0.0) + more.toDouble();
    };
    const auto contourNamed = [&](const QJsonObject &named) -> ContourFigures * {
        const int index = contourOfEntity.value(named.value("contour").toString(), -1);
        return index < 0 ? nullptr : &figures.contours[index];
    };
    const QJsonArray cuts = work.value("cuts").toArray();
    for (const QJsonValue &each : cuts) {
        if (ContourFigures *contour = contourNamed(each.toObject())) {
            add(contour->cut, each.toObject().value("length"));
            add(contour->minutes, each.toObject().value("minutes"));
        }
    }
    const QJsonArray slugs = work.value("slugs").toArray();
    for (const QJsonValue &each : slugs) {
        if (ContourFigures *contour = contourNamed(each.toObject()))
            add(contour->mass, each.toObject().value("mass"));
    }
    return figures;
}

} // namespace wedm
