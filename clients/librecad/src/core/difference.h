// SPDX-License-Identifier: GPL-2.0-or-later
// What has changed between two looks at a drawing. The host's numbers change when it replaces an entity, so an entity that
// was edited is known again by its geometry, and keeps its handle. Knows neither the host nor the protocol.
#pragma once

#include "drawing.h"

#include <QHash>
#include <QSet>

namespace wedm {

/// What was seen, against what was known.
struct Difference {
    /// The changes that lead from the one to the other; empty when nothing has changed.
    QVector<Change> changes;
    /// What was seen, with handles, in the order in which the server has it.
    QVector<Entity> entities;
};

/// Gives handles to entities. A handle is never given twice within one drawing's life, unless the same entity comes back.
class HandleGiver {
public:
    QString handleFor(const Entity &entity);
    /// Remembers that this entity of the host bears that handle from now on.
    void remember(quint64 identity, const QString &handle);

private:
    QHash<quint64, QString> m_known;
    QSet<QString> m_given;
    quint64 m_next = 1;
};

/// Compares `seen`, entities as the host lists them, with `known`.
///
/// - An entity with the host number of a known one is that one.
/// - An entity that is new while another of its kind on its layer is gone, and shares vertices with it, takes its handle.
/// - A polyline of which a stretch of vertices differs is sent as a splice, everything else as a whole entity.
Difference difference(const QVector<Entity> &known, const QVector<Entity> &seen, HandleGiver &handles);

} // namespace wedm
