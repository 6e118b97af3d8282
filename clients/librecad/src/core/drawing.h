// SPDX-License-Identifier: GPL-2.0-or-later
// A drawing as the server knows it: entities with handles, in drawing units. Knows nothing of LibreCAD.
#pragma once

#include <QString>
#include <QVector>

namespace wedm {

/// A vertex of a polyline. `bulge` is tan(sweep / 4) of the arc to the next vertex, positive counter-clockwise, 0 for a line.
struct Vertex {
    double x = 0;
    double y = 0;
    double bulge = 0;
};

enum class Kind { Polyline, Line, Arc, Circle, Text, Point };

/// How the host shows an entity, as far as it decides whether it is cut. What the entity takes from its layer is the layer's.
struct EntityLook {
    /// Its name in DXF; empty for a continuous line.
    QString linetype;
    /// The linetype is the layer's: a role of the layer then counts for the entity all the same.
    bool linetypeByLayer = false;
    /// "#rrggbb"; empty where it is not known.
    QString color;

    bool operator==(const EntityLook &other) const { return linetype == other.linetype && linetypeByLayer == other.linetypeByLayer && color == other.color; }
    bool operator!=(const EntityLook &other) const { return !(*this == other); }
};

/// One entity. Which members mean something depends on `kind`:
/// a polyline has `closed` and `vertices`; a line two `vertices`, its ends; an arc and a circle `x`, `y` (the centre) and `radius`;
/// an arc also `startAngle` and `endAngle` in degrees, counter-clockwise; a text `x`, `y` and `text`; a point `x` and `y`.
struct Entity {
    /// The host's own number for it; 0 where there is none. It changes when the host replaces the entity.
    quint64 identity = 0;
    /// The server's name for it; empty until it has one. It stays when the host replaces the entity.
    QString handle;
    QString layer;
    EntityLook look;
    Kind kind = Kind::Polyline;
    bool closed = false;
    QVector<Vertex> vertices;
    double x = 0;
    double y = 0;
    double radius = 0;
    double startAngle = 0;
    double endAngle = 0;
    QString text;
};

/// Coordinates and bulges that differ by less are the same: a host that keeps an arc by centre and angles returns its ends and its
/// bulge with noise of this size. Absolute, in drawing units, and relative to the number.
constexpr double NOISE_ABSOLUTE = 1e-10;
constexpr double NOISE_RELATIVE = 4e-14;

/// Whether two numbers are the same but for noise.
bool alike(double one, double other);
bool alike(const Vertex &one, const Vertex &other);
/// Whether layer, look and geometry are the same but for noise; identity and handle are not looked at.
bool alike(const Entity &one, const Entity &other);

enum class Units { Unknown, Millimetre, Inch };

/// A drawing at one version, entities in machining order.
struct Drawing {
    QString uri;
    int version = 0;
    Units units = Units::Unknown;
    QVector<Entity> entities;
};

/// One change of a drawing, as in `wedm/didChangeDrawing`.
struct Change {
    enum class What { Splice, Put, Delete };

    What what = What::Splice;
    QString handle;
    /// Splice: `deleteCount` vertices from `start` on are replaced by `insert`.
    int start = 0;
    int deleteCount = 0;
    QVector<Vertex> insert;
    /// Put: the entity that is added, or takes the place of the one with its handle.
    Entity entity;
    /// Put of a new entity: the handle that it comes before; empty: last.
    QString before;
};

/// `drawing` with `changes` applied one after another. On a change that does not apply, `failure` says why and
/// the drawing is returned as it was.
Drawing applied(const Drawing &drawing, const QVector<Change> &changes, QString *failure);

} // namespace wedm
