// SPDX-License-Identifier: GPL-2.0-or-later
#include "snapshot.h"

#include "document_interface.h"
#include "layer_looks.h"

#include <QElapsedTimer>
#include <QHash>
#include <QSet>
#include <QtMath>

#include <cmath>
#include <limits>

namespace wedm {

const char MARK_LAYER[] = "WEDM_MARKS";
const char PATH_LAYER[] = "WEDM_PATH";

namespace {

/// The colours of marks and of the wire's path, 24 bits.
constexpr int MARK_COLOUR = 0xff00ff;
constexpr int PATH_COLOUR = 0x00a0ff;
/// Start holes are marked by the letter O; a longer text is no mark.
constexpr int LONGEST_START_MARK = 64;
/// Adding one vertex to a polyline makes LibreCAD 2.2.0 look at all before it, so the cost of a polyline grows with the square of its size:
/// ns for each pair of vertices. Measured, see the README.
constexpr double NS_PER_PAIR = 80;
/// What is read back may differ by this much from what was written, in drawing units and degrees.
constexpr double ARRIVED = 1e-8;
/// The number of entities that are read between two looks at the clock.
constexpr int AT_ONCE = 256;
/// Values of $INSUNITS.
constexpr int INSUNITS_INCH = 1;
constexpr int INSUNITS_MM = 4;

/// The wrappers that the host returns belong to the caller.
class Entities {
public:
    explicit Entities(Document_Interface &drawing) { drawing.getAllEntities(&m_list, true); }
    ~Entities() { qDeleteAll(m_list); }
    Entities(const Entities &) = delete;
    Entities &operator=(const Entities &) = delete;

    const QList<Plug_Entity *> &list() const { return m_list; }

private:
    QList<Plug_Entity *> m_list;
};

bool isOwn(const Data &data)
{
    const QString layer = data.value(DPI::LAYER).toString();
    return layer == QLatin1String(MARK_LAYER) || layer == QLatin1String(PATH_LAYER);
}

double number(const Data &data, int key)
{
    return data.value(key).toDouble();
}

double toDegrees(double radians)
{
    double degrees = std::fmod(qRadiansToDegrees(radians), 360.0);
    return degrees < 0 ? degrees + 360.0 : degrees;
}

const char *uncheckedKind(int type)
{
    switch (type) {
    case DPI::ELLIPSE:
        return QT_TRANSLATE_NOOP("wedm::Controller", "ellipse");
    case DPI::SPLINE:
    case DPI::SPLINEPOINTS:
        return QT_TRANSLATE_NOOP("wedm::Controller", "spline");
    case DPI::INSERT:
        return QT_TRANSLATE_NOOP("wedm::Controller", "block");
    case DPI::HATCH:
        return QT_TRANSLATE_NOOP("wedm::Controller", "hatch");
    case DPI::IMAGE:
        return QT_TRANSLATE_NOOP("wedm::Controller", "image");
    case DPI::SOLID:
        return QT_TRANSLATE_NOOP("wedm::Controller", "solid");
    default:
        return nullptr;
    }
}

QVector<Vertex> verticesOf(Plug_Entity &entity)
{
    QList<Plug_VertexData> list;
    entity.getPolylineData(&list);
    QVector<Vertex> vertices;
    vertices.reserve(list.size());
    for (const Plug_VertexData &vertex : list)
        vertices += Vertex{vertex.point.x(), vertex.point.y(), vertex.bulge};
    return vertices;
}

/// False for what cannot be cut.
bool read(Plug_Entity &source, const Data &data, LayerLooks &layers, Entity *entity)
{
    entity->identity = data.value(DPI::EID).toULongLong();
    entity->layer = data.value(DPI::LAYER).toString();
    entity->look = layers.of(data);
    entity->x = number(data, DPI::STARTX);
    entity->y = number(data, DPI::STARTY);
    switch (data.value(DPI::ETYPE).toInt()) {
    case DPI::POLYLINE:
        entity->kind = Kind::Polyline;
        entity->closed = data.value(DPI::CLOSEPOLY).toBool();
        entity->vertices = verticesOf(source);
        // The last vertex of an open polyline has no segment; LibreCAD repeats the bulge before it.
        if (!entity->closed && !entity->vertices.isEmpty())
            entity->vertices.last().bulge = 0;
        entity->x = entity->y = 0;
        return !entity->vertices.isEmpty();
    case DPI::LINE:
        entity->kind = Kind::Line;
        entity->vertices = {Vertex{entity->x, entity->y, 0}, Vertex{number(data, DPI::ENDX), number(data, DPI::ENDY), 0}};
        entity->x = entity->y = 0;
        return true;
    case DPI::ARC: {
        entity->kind = Kind::Arc;
        entity->radius = number(data, DPI::RADIUS);
        const bool clockwise = data.value(DPI::REVERSED).toBool();
        entity->startAngle = toDegrees(number(data, clockwise ? DPI::ENDANGLE : DPI::STARTANGLE));
        entity->endAngle = toDegrees(number(data, clockwise ? DPI::STARTANGLE : DPI::ENDANGLE));
        return entity->radius > 0;
    }
    case DPI::CIRCLE:
        entity->kind = Kind::Circle;
        entity->radius = number(data, DPI::RADIUS);
        return entity->radius > 0;
    case DPI::TEXT:
    case DPI::MTEXT:
        entity->kind = Kind::Text;
        entity->text = data.value(DPI::TEXTCONTENT).toString();
        return entity->text.size() <= LONGEST_START_MARK;
    case DPI::POINT:
        entity->kind = Kind::Point;
        return true;
    default:
        return false;
    }
}

void readUnits(Document_Interface &drawing, Snapshot *snapshot)
{
    int unit = 0;
    drawing.getVariableInt(QStringLiteral("$INSUNITS"), &unit);
    if (unit == INSUNITS_INCH)
        snapshot->units = Units::Inch;
    else if (unit == INSUNITS_MM)
        snapshot->units = Units::Millimetre;
    else
        snapshot->otherUnit = unit;
}

void readEntity(Plug_Entity &source, LayerLooks &layers, Snapshot *snapshot)
{
    Data data;
    source.getData(&data);
    if (isOwn(data))
        return;
    Entity entity;
    if (read(source, data, layers, &entity))
        snapshot->entities += entity;
    else if (const char *kind = uncheckedKind(data.value(DPI::ETYPE).toInt()))
        ++snapshot->unchecked[QString::fromLatin1(kind)];
}

Data geometry(const Entity &entity, bool clockwise)
{
    Data data;
    switch (entity.kind) {
    case Kind::Line:
        data.insert(DPI::STARTX, entity.vertices.value(0).x);
        data.insert(DPI::STARTY, entity.vertices.value(0).y);
        data.insert(DPI::ENDX, entity.vertices.value(1).x);
        data.insert(DPI::ENDY, entity.vertices.value(1).y);
        break;
    case Kind::Arc:
        data.insert(clockwise ? DPI::ENDANGLE : DPI::STARTANGLE, qDegreesToRadians(entity.startAngle));
        data.insert(clockwise ? DPI::STARTANGLE : DPI::ENDANGLE, qDegreesToRadians(entity.endAngle));
        Q_FALLTHROUGH();
    case Kind::Circle:
        data.insert(DPI::STARTX, entity.x);
        data.insert(DPI::STARTY, entity.y);
        data.insert(DPI::RADIUS, entity.radius);
        break;
    case Kind::Polyline:
        data.insert(DPI::CLOSEPOLY, entity.closed);
        break;
    default:
        break;
    }
    return data;
}

enum DPI::ETYPE typeOf(Kind kind)
{
    switch (kind) {
    case Kind::Polyline:
        return DPI::POLYLINE;
    case Kind::Line:
        return DPI::LINE;
    case Kind::Arc:
        return DPI::ARC;
    case Kind::Circle:
        return DPI::CIRCLE;
    default:
        break;
    }
    return DPI::UNKNOWN;
}

/// Adds `entity` with the layer and pen that `look` holds.
bool add(Document_Interface &drawing, const Entity &entity, const Data &look)
{
    // Once added, the entity belongs to the drawing, but the wrapper would still delete it: the wrapper is left alone. A few
    // bytes are lost for each repaired entity.
    Plug_Entity *added = drawing.newEntity(typeOf(entity.kind));
    if (!added)
        return false;
    Data data = geometry(entity, false);
    for (int key : {int(DPI::LAYER), int(DPI::LTYPE), int(DPI::LWIDTH), int(DPI::COLOR)}) {
        if (look.contains(key))
            data.insert(key, look.value(key));
    }
    added->updateData(&data);
    if (entity.kind == Kind::Polyline) {
        QList<Plug_VertexData> vertices;
        for (const Vertex &vertex : entity.vertices)
            vertices += Plug_VertexData(QPointF(vertex.x, vertex.y), vertex.bulge);
        added->updatePolylineData(&vertices);
    }
    drawing.addEntity(added);
    return true;
}

/// How things on a layer of the plugin's own look; the layer is made where it is not there yet.
Data ownLook(Document_Interface &drawing, const char *layer, int colour, const char *linetype)
{
    if (!drawing.getAllLayer().contains(QLatin1String(layer))) {
        const QString active = drawing.getCurrentLayer();
        drawing.setLayer(QString::fromLatin1(layer));
        drawing.setCurrentLayerProperties(colour, DPI::WidthByLayer, DPI::SolidLine);
        drawing.setLayer(active);
    }
    return {{DPI::LAYER, QString::fromLatin1(layer)},
            {DPI::COLOR, colour},
            {DPI::LTYPE, QString::fromLatin1(linetype)},
            {DPI::LWIDTH, QStringLiteral("0.00mm")}};
}

void addCircle(Document_Interface &drawing, const QPointF &centre, double radius, const Data &look)
{
    Entity circle;
    circle.kind = Kind::Circle;
    circle.x = centre.x();
    circle.y = centre.y();
    circle.radius = radius;
    add(drawing, circle, look);
}

/// Whether `found` is `meant` within the rounding of LibreCAD's angles and centres.
bool arrived(const Entity &meant, const Entity &found)
{
    const auto close = [](double one, double other) { return std::abs(one - other) <= ARRIVED + NOISE_RELATIVE * std::abs(one); };
    const auto sameAngle = [&](double one, double other) { return std::abs(std::remainder(one - other, 360.0)) <= ARRIVED; };
    if (meant.kind != found.kind || meant.closed != found.closed || meant.vertices.size() != found.vertices.size())
        return false;
    for (int i = 0; i < meant.vertices.size(); ++i) {
        const Vertex &one = meant.vertices.at(i);
        const Vertex &other = found.vertices.at(i);
        if (!close(one.x, other.x) || !close(one.y, other.y) || !close(one.bulge, other.bulge))
            return false;
    }
    return close(meant.x, found.x) && close(meant.y, found.y) && close(meant.radius, found.radius)
        && (meant.kind != Kind::Arc || (sameAngle(meant.startAngle, found.startAngle) && sameAngle(meant.endAngle, found.endAngle)));
}

} // namespace

Snapshot takeSnapshot(Document_Interface &drawing)
{
    SlicedSnapshot whole;
    whole.read(drawing, std::numeric_limits<qint64>::max());
    return whole.take();
}

void SlicedSnapshot::read(Document_Interface &drawing, qint64 milliseconds)
{
    // The wrappers live until the end of the call.
    const Entities entities(drawing);
    QElapsedTimer clock;
    clock.start();
    const int size = entities.list().size();
    if (!m_isBegun || size != m_size) {
        drop();
        m_isBegun = true;
        m_size = size;
        readUnits(drawing, &m_snapshot);
        m_snapshot.entities.reserve(size);
    }
    LayerLooks layers(drawing, m_layers);
    while (m_next < size) {
        const int end = qMin(m_next + AT_ONCE, size);
        for (; m_next < end; ++m_next)
            readEntity(*entities.list().at(m_next), layers, &m_snapshot);
        if (clock.elapsed() >= milliseconds)
            break;
    }
}

Snapshot SlicedSnapshot::take()
{
    m_isBegun = false;
    m_next = 0;
    m_size = 0;
    Snapshot taken;
    std::swap(taken, m_snapshot);
    return taken;
}

bool applyRepair(Document_Interface &drawing, const Repair &repair, QString *failure)
{
    const QString moved = QObject::tr("The drawing has changed while the repair was on its way; nothing was changed. Ask for it again.");
    QHash<QString, int> before;
    before.reserve(repair.before.size());
    for (int i = 0; i < repair.before.size(); ++i)
        before.insert(repair.before.at(i).handle, i);
    QVector<Entity> changed;
    QVector<Entity> fresh;
    QVector<bool> stays(repair.before.size(), false);
    for (const Entity &entity : repair.after) {
        const int old = before.value(entity.handle, -1);
        if (old < 0)
            fresh += entity;
        else if (!alike(repair.before.at(old), entity))
            changed += entity;
        if (old >= 0)
            stays[old] = true;
        if (old < 0 && typeOf(entity.kind) == DPI::UNKNOWN) {
            *failure = QObject::tr("The repair holds what this plugin cannot draw; nothing was changed.");
            return false;
        }
    }
    QSet<quint64> touched;
    QHash<quint64, int> identities;
    identities.reserve(repair.before.size());
    for (int i = 0; i < repair.before.size(); ++i) {
        identities.insert(repair.before.at(i).identity, i);
        if (!stays.at(i))
            touched.insert(repair.before.at(i).identity);
    }
    for (const Entity &entity : qAsConst(changed))
        touched.insert(repair.before.at(before.value(entity.handle)).identity);

    // Everything is checked before anything is changed.
    const Entities entities(drawing);
    QHash<quint64, Plug_Entity *> wrappers;
    QHash<quint64, Data> looks;
    QHash<QString, Data> layerLooks;
    QHash<QString, EntityLook> known;
    LayerLooks layers(drawing, known);
    int same = 0;
    for (Plug_Entity *each : entities.list()) {
        Data data;
        each->getData(&data);
        Entity entity;
        if (isOwn(data) || !read(*each, data, layers, &entity))
            continue;
        const int old = identities.value(entity.identity, -1);
        if (old < 0 || !alike(repair.before.at(old), entity)) {
            *failure = moved;
            return false;
        }
        ++same;
        if (touched.contains(entity.identity)) {
            wrappers.insert(entity.identity, each);
            looks.insert(entity.identity, data);
        }
        if (!layerLooks.contains(entity.layer))
            layerLooks.insert(entity.layer, data);
    }
    if (same != repair.before.size() || same == 0) {
        *failure = moved;
        return false;
    }

    for (const Entity &entity : qAsConst(changed)) {
        const Entity &old = repair.before.at(before.value(entity.handle));
        const Data look = looks.value(old.identity);
        Plug_Entity *wrapper = wrappers.value(old.identity);
        if (entity.kind == old.kind && entity.kind != Kind::Polyline) {
            // The host copies the entity, changes the copy, and keeps the old one for undo.
            Data data = geometry(entity, look.value(DPI::REVERSED).toBool());
            wrapper->updateData(&data);
            continue;
        }
        if (add(drawing, entity, look))
            drawing.removeEntity(wrapper);
    }
    for (const Entity &entity : qAsConst(fresh)) {
        // What a repair adds looks like an entity of its layer that is there already.
        Data look = layerLooks.value(entity.layer, *layerLooks.constBegin());
        if (!entity.layer.isEmpty())
            look.insert(DPI::LAYER, entity.layer);
        add(drawing, entity, look);
    }
    for (int i = 0; i < stays.size(); ++i) {
        if (!stays.at(i))
            drawing.removeEntity(wrappers.value(repair.before.at(i).identity));
    }
    if (changed.isEmpty() && fresh.isEmpty())
        return true;

    // What LibreCAD has made of it is read back and compared with what was meant.
    const Entities result(drawing);
    QVector<bool> there(changed.size() + fresh.size(), false);
    const QVector<Entity> meant = changed + fresh;
    for (int i = result.list().size() - 1, left = meant.size(); i >= 0 && left > 0; --i) {
        Data data;
        result.list().at(i)->getData(&data);
        Entity entity;
        if (!read(*result.list().at(i), data, layers, &entity))
            continue;
        for (int k = 0; k < meant.size(); ++k) {
            if (!there.at(k) && arrived(meant.at(k), entity)) {
                there[k] = true;
                --left;
                break;
            }
        }
    }
    if (there.contains(false)) {
        *failure = QObject::tr("LibreCAD has kept something other than the repair: press Undo, and repair the saved file with \"wedm fix\".");
        return false;
    }
    return true;
}

qint64 rebuildTime(const Repair &repair)
{
    QHash<QString, const Entity *> before;
    for (const Entity &entity : repair.before)
        before.insert(entity.handle, &entity);
    double nanoseconds = 0;
    for (const Entity &entity : repair.after) {
        const Entity *old = before.value(entity.handle);
        if (entity.kind == Kind::Polyline && (!old || !alike(*old, entity)))
            nanoseconds += NS_PER_PAIR * entity.vertices.size() * entity.vertices.size();
    }
    return qint64(nanoseconds / 1e6);
}

void drawMarks(Document_Interface &drawing, const QVector<QPointF> &places, double radius)
{
    // No layer is made where nothing is drawn.
    if (places.isEmpty())
        return;
    const Data look = ownLook(drawing, MARK_LAYER, MARK_COLOUR, "SolidLine");
    for (const QPointF &place : places)
        addCircle(drawing, place, radius, look);
}

void drawPath(Document_Interface &drawing, const Toolpath &path)
{
    clearLayer(drawing, PATH_LAYER);
    if (path.pieces.isEmpty())
        return;
    const Data look = ownLook(drawing, PATH_LAYER, PATH_COLOUR, "SolidLine");
    for (const Entity &piece : path.pieces)
        add(drawing, piece, look);
    for (const ThreadHole &hole : path.holes)
        addCircle(drawing, hole.at, hole.radius, look);
    const Data dashed = ownLook(drawing, PATH_LAYER, PATH_COLOUR, "DashLine");
    for (const Entity &jump : path.jumps)
        add(drawing, jump, dashed);
}

int clearLayer(Document_Interface &drawing, const char *layer)
{
    int count = 0;
    const Entities entities(drawing);
    for (Plug_Entity *each : entities.list()) {
        Data data;
        each->getData(&data);
        if (data.value(DPI::LAYER).toString() != QLatin1String(layer))
            continue;
        drawing.removeEntity(each);
        ++count;
    }
    return count;
}

} // namespace wedm
