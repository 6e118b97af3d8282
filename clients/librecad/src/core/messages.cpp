// SPDX-License-Identifier: GPL-2.0-or-later
#include "messages.h"

#include <QCoreApplication>
#include <QJsonArray>
#include <QJsonDocument>

#include <cmath>

namespace wedm {

namespace {

/// So many digits give a double back exactly.
constexpr int DIGITS = 17;

QByteArray number(double value)
{
    return QByteArray::number(value, 'g', DIGITS);
}

void write(QByteArray &out, double x, double y)
{
    out += '[';
    out += number(x);
    out += ',';
    out += number(y);
    out += ']';
}

void write(QByteArray &out, const QVector<Vertex> &vertices)
{
    out += '[';
    for (int i = 0; i < vertices.size(); ++i) {
        const Vertex &vertex = vertices.at(i);
        out += i == 0 ? "[" : ",[";
        out += number(vertex.x);
        out += ',';
        out += number(vertex.y);
        if (vertex.bulge != 0) {
            out += ',';
            out += number(vertex.bulge);
        }
        out += ']';
    }
    out += ']';
}

void write(QByteArray &out, const Entity &entity)
{
    out += "{\"handle\":";
    out += toJson(entity.handle);
    if (!entity.layer.isEmpty()) {
        out += ",\"layer\":";
        out += toJson(entity.layer);
    }
    if (!entity.look.linetype.isEmpty()) {
        out += ",\"linetype\":" + toJson(entity.look.linetype);
        if (entity.look.linetypeByLayer)
            out += ",\"linetypeByLayer\":true";
    }
    if (!entity.look.color.isEmpty())
        out += ",\"color\":" + toJson(entity.look.color);
    switch (entity.kind) {
    case Kind::Polyline:
        out += ",\"type\":\"polyline\",\"closed\":";
        out += entity.closed ? "true" : "false";
        out += ",\"vertices\":";
        write(out, entity.vertices);
        break;
    case Kind::Line: {
        const Vertex start = entity.vertices.value(0);
        const Vertex end = entity.vertices.value(1);
        out += ",\"type\":\"line\",\"start\":";
        write(out, start.x, start.y);
        out += ",\"end\":";
        write(out, end.x, end.y);
        break;
    }
    case Kind::Arc:
        out += ",\"type\":\"arc\",\"center\":";
        write(out, entity.x, entity.y);
        out += ",\"radius\":" + number(entity.radius);
        out += ",\"startAngle\":" + number(entity.startAngle);
        out += ",\"endAngle\":" + number(entity.endAngle);
        break;
    case Kind::Circle:
        out += ",\"type\":\"circle\",\"center\":";
        write(out, entity.x, entity.y);
        out += ",\"radius\":" + number(entity.radius);
        break;
    case Kind::Text:
        out += ",\"type\":\"text\",\"at\":";
        write(out, entity.x, entity.y);
        out += ",\"text\":" + toJson(entity.text);
        break;
    case Kind::Point:
        out += ",\"type\":\"point\",\"at\":";
        write(out, entity.x, entity.y);
        break;
    }
    out += '}';
}

void write(QByteArray &out, const Change &change)
{
    out += "{\"handle\":";
    out += toJson(change.handle);
    switch (change.what) {
    case Change::What::Splice:
        out += ",\"vertices\":{\"start\":" + QByteArray::number(change.start);
        out += ",\"deleteCount\":" + QByteArray::number(change.deleteCount);
        out += ",\"insert\":";
        write(out, change.insert);
        out += '}';
        break;
    case Change::What::Put:
        out += ",\"entity\":";
        write(out, change.entity);
        if (!change.before.isEmpty())
            out += ",\"before\":" + toJson(change.before);
        break;
    case Change::What::Delete:
        out += ",\"entity\":null";
        break;
    }
    out += '}';
}

/// A number, or NaN where there is none: a missing one must not become 0.
double toNumber(const QJsonValue &value)
{
    return value.isDouble() ? value.toDouble() : std::nan("");
}

QPointF toPoint(const QJsonValue &value, bool *sound)
{
    const QJsonArray pair = value.toArray();
    const QPointF point(toNumber(pair.at(0)), toNumber(pair.at(1)));
    if (!std::isfinite(point.x()) || !std::isfinite(point.y())) {
        *sound = false;
        return QPointF();
    }
    return point;
}

QVector<Vertex> toVertices(const QJsonValue &value, bool *sound)
{
    QVector<Vertex> vertices;
    const QJsonArray list = value.toArray();
    *sound = *sound && value.isArray();
    for (const QJsonValue &item : list) {
        const QJsonArray triple = item.toArray();
        Vertex vertex;
        vertex.x = toNumber(triple.at(0));
        vertex.y = toNumber(triple.at(1));
        vertex.bulge = triple.size() > 2 ? toNumber(triple.at(2)) : 0;
        *sound = *sound && std::isfinite(vertex.x) && std::isfinite(vertex.y) && std::isfinite(vertex.bulge);
        vertices += vertex;
    }
    return vertices;
}

Vertex toVertex(const QJsonValue &value, bool *sound)
{
    const QPointF point = toPoint(value, sound);
    return {point.x(), point.y(), 0};
}

Entity toEntity(const QJsonObject &object, bool *sound)
{
    Entity entity;
    entity.handle = object.value("handle").toString();
    entity.layer = object.value("layer").toString();
    entity.look.linetype = object.value("linetype").toString();
    entity.look.linetypeByLayer = object.value("linetypeByLayer").toBool();
    entity.look.color = object.value("color").toString();
    const QString type = object.value("type").toString();
    if (type == "polyline") {
        entity.kind = Kind::Polyline;
        entity.closed = object.value("closed").toBool();
        entity.vertices = toVertices(object.value("vertices"), sound);
    } else if (type == "line") {
        entity.kind = Kind::Line;
        entity.vertices = {toVertex(object.value("start"), sound), toVertex(object.value("end"), sound)};
    } else if (type == "arc" || type == "circle") {
        entity.kind = type == "arc" ? Kind::Arc : Kind::Circle;
        const QPointF centre = toPoint(object.value("center"), sound);
        entity.x = centre.x();
        entity.y = centre.y();
        entity.radius = toNumber(object.value("radius"));
        *sound = *sound && std::isfinite(entity.radius) && entity.radius > 0;
        if (entity.kind == Kind::Arc) {
            entity.startAngle = toNumber(object.value("startAngle"));
            entity.endAngle = toNumber(object.value("endAngle"));
            *sound = *sound && std::isfinite(entity.startAngle) && std::isfinite(entity.endAngle);
        }
    } else if (type == "text" || type == "point") {
        entity.kind = type == "text" ? Kind::Text : Kind::Point;
        const QPointF at = toPoint(object.value("at"), sound);
        entity.x = at.x();
        entity.y = at.y();
        entity.text = object.value("text").toString();
    } else {
        *sound = false;
    }
    return entity;
}

} // namespace

QByteArray toJson(const QString &text)
{
    // Qt writes only whole documents: an array of the one string, without its brackets.
    const QByteArray array = QJsonDocument(QJsonArray{text}).toJson(QJsonDocument::Compact);
    return array.mid(1, array.size() - 2);
}

QByteArray toJson(const Drawing &drawing)
{
    QByteArray out;
    out += "{\"uri\":" + toJson(drawing.uri);
    out += ",\"version\":" + QByteArray::number(drawing.version);
    if (drawing.units != Units::Unknown)
        out += drawing.units == Units::Inch ? ",\"units\":\"inch\"" : ",\"units\":\"mm\"";
    out += ",\"entities\":[";
    for (int i = 0; i < drawing.entities.size(); ++i) {
        if (i > 0)
            out += ',';
        write(out, drawing.entities.at(i));
    }
    out += "]}";
    return out;
}

QByteArray toJson(const QString &uri, int version, const QVector<Change> &changes)
{
    QByteArray out;
    out += "{\"drawing\":{\"uri\":" + toJson(uri);
    out += ",\"version\":" + QByteArray::number(version);
    out += "},\"changes\":[";
    for (int i = 0; i < changes.size(); ++i) {
        if (i > 0)
            out += ',';
        write(out, changes.at(i));
    }
    out += "]}";
    return out;
}

QVector<Change> changesFromJson(const QJsonArray &changes, QString *failure)
{
    QVector<Change> result;
    for (int i = 0; i < changes.size(); ++i) {
        const QJsonObject object = changes.at(i).toObject();
        Change change;
        change.handle = object.value("handle").toString();
        bool sound = !change.handle.isEmpty();
        if (object.contains("vertices")) {
            const QJsonObject splice = object.value("vertices").toObject();
            change.what = Change::What::Splice;
            change.start = splice.value("start").toInt(-1);
            change.deleteCount = splice.value("deleteCount").toInt(-1);
            change.insert = toVertices(splice.value("insert"), &sound);
            sound = sound && change.start >= 0 && change.deleteCount >= 0;
        } else if (object.value("entity").isNull()) {
            change.what = Change::What::Delete;
        } else {
            change.what = Change::What::Put;
            change.entity = toEntity(object.value("entity").toObject(), &sound);
            change.before = object.value("before").toString();
        }
        if (!sound) {
            if (failure)
                *failure = QCoreApplication::translate("wedm::Session", "change %1 of the fix is not understood").arg(i);
            return {};
        }
        result += change;
    }
    return result;
}

Finding findingFromJson(const QJsonObject &diagnostic)
{
    Finding finding;
    finding.severity = Severity(qBound(1, diagnostic.value("severity").toInt(1), 4));
    finding.rule = diagnostic.value("code").toString();
    finding.message = diagnostic.value("message").toString();
    const QJsonObject data = diagnostic.value("data").toObject();
    finding.handle = data.value("handle").toString();
    finding.segment = data.value("segment").toInt(-1);
    bool sound = data.contains("start") && data.contains("end");
    finding.start = toPoint(data.value("start"), &sound);
    finding.end = toPoint(data.value("end"), &sound);
    finding.placed = sound;
    finding.diagnostic = diagnostic;
    return finding;
}

Inspection inspectionFromJson(const QJsonObject &inspection)
{
    Inspection result;
    result.unitsToMm = inspection.value("unitsToMm").toDouble(1);
    const QJsonArray entities = inspection.value("entities").toArray();
    for (const QJsonValue &each : entities) {
        const QJsonObject entity = each.toObject();
        Row row;
        row.handle = entity.value("handle").toString();
        row.type = entity.value("type").toString();
        row.layer = entity.value("layer").toString();
        const QJsonArray segments = entity.value("segments").toArray();
        for (const QJsonValue &item : segments) {
            const QJsonObject segment = item.toObject();
            row.segment = segment.value("index").toInt();
            row.kind = segment.value("kind").toString();
            bool sound = true;
            row.start = toPoint(segment.value("start"), &sound);
            row.end = toPoint(segment.value("end"), &sound);
            row.hasCentre = segment.contains("center");
            bool centred = true;
            row.centre = row.hasCentre ? toPoint(segment.value("center"), &centred) : QPointF();
            row.hasRadius = segment.value("radius").isDouble();
            row.radius = segment.value("radius").toDouble();
            row.sweep = segment.value("sweep").toDouble();
            row.verdict = segment.value("verdict").toString();
            if (sound && centred)
                result.rows += row;
        }
    }
    return result;
}

} // namespace wedm
