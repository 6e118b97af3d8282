// SPDX-License-Identifier: GPL-2.0-or-later
#include "drawing.h"

#include <QCoreApplication>
#include <QHash>

#include <cmath>

namespace wedm {

namespace {

bool finite(const QVector<Vertex> &vertices)
{
    for (const Vertex &vertex : vertices) {
        if (!std::isfinite(vertex.x) || !std::isfinite(vertex.y) || !std::isfinite(vertex.bulge))
            return false;
    }
    return true;
}

bool finite(const Entity &entity)
{
    return finite(entity.vertices) && std::isfinite(entity.x) && std::isfinite(entity.y) && std::isfinite(entity.radius)
        && std::isfinite(entity.startAngle) && std::isfinite(entity.endAngle);
}

int indexOf(const Drawing &drawing, const QString &handle)
{
    for (int i = 0; i < drawing.entities.size(); ++i) {
        if (drawing.entities.at(i).handle == handle)
            return i;
    }
    return -1;
}

QString splice(Entity &entity, const Change &change)
{
    const qint64 size = entity.vertices.size();
    if (entity.kind != Kind::Polyline)
        return QCoreApplication::translate("wedm::Drawing", "entity %1 is not a polyline").arg(change.handle);
    if (change.start < 0 || change.deleteCount < 0 || qint64(change.start) + change.deleteCount > size)
        return QCoreApplication::translate("wedm::Drawing", "vertices %1 to %2 of %3, which has %4")
            .arg(change.start)
            .arg(qint64(change.start) + change.deleteCount)
            .arg(change.handle)
            .arg(size);
    if (!finite(change.insert))
        return QCoreApplication::translate("wedm::Drawing", "a vertex of %1 is not finite").arg(change.handle);
    QVector<Vertex> vertices;
    vertices.reserve(int(size) - change.deleteCount + change.insert.size());
    vertices += entity.vertices.mid(0, change.start);
    vertices += change.insert;
    vertices += entity.vertices.mid(change.start + change.deleteCount);
    entity.vertices = vertices;
    return QString();
}

QString put(Drawing &drawing, const Change &change)
{
    if (!finite(change.entity))
        return QCoreApplication::translate("wedm::Drawing", "a number of %1 is not finite").arg(change.handle);
    Entity entity = change.entity;
    entity.handle = change.handle;
    const int there = indexOf(drawing, change.handle);
    if (there >= 0) {
        // A repair changes no look, and the server may write the same colour otherwise.
        entity.identity = drawing.entities.at(there).identity;
        entity.look = drawing.entities.at(there).look;
        drawing.entities[there] = entity;
        return QString();
    }
    int place = drawing.entities.size();
    if (!change.before.isEmpty()) {
        place = indexOf(drawing, change.before);
        if (place < 0)
            return QCoreApplication::translate("wedm::Drawing", "there is no entity %1 to put %2 before").arg(change.before, change.handle);
    }
    drawing.entities.insert(place, entity);
    return QString();
}

} // namespace

bool alike(double one, double other)
{
    return std::abs(one - other) <= NOISE_ABSOLUTE + NOISE_RELATIVE * std::abs(one);
}

bool alike(const Vertex &one, const Vertex &other)
{
    return alike(one.x, other.x) && alike(one.y, other.y) && alike(one.bulge, other.bulge);
}

bool alike(const Entity &one, const Entity &other)
{
    if (one.kind != other.kind || one.closed != other.closed || one.vertices.size() != other.vertices.size() || one.layer != other.layer
        || one.look != other.look || one.text != other.text || !alike(one.x, other.x) || !alike(one.y, other.y) || !alike(one.radius, other.radius)
        || !alike(one.startAngle, other.startAngle) || !alike(one.endAngle, other.endAngle))
        return false;
    const Vertex *a = one.vertices.constData();
    const Vertex *b = other.vertices.constData();
    if (a == b)
        return true;
    for (int i = 0; i < one.vertices.size(); ++i) {
        if (!alike(a[i], b[i]))
            return false;
    }
    return true;
}

Drawing applied(const Drawing &drawing, const QVector<Change> &changes, QString *failure)
{
    Drawing result = drawing;
    for (const Change &change : changes) {
        QString fault;
        if (change.what == Change::What::Put) {
            fault = put(result, change);
        } else {
            const int index = indexOf(result, change.handle);
            if (index < 0)
                fault = QCoreApplication::translate("wedm::Drawing", "there is no entity %1").arg(change.handle);
            else if (change.what == Change::What::Delete)
                result.entities.remove(index);
            else
                fault = splice(result.entities[index], change);
        }
        if (!fault.isEmpty()) {
            if (failure)
                *failure = fault;
            return drawing;
        }
    }
    return result;
}

} // namespace wedm
