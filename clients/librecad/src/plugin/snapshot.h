// SPDX-License-Identifier: GPL-2.0-or-later
// A drawing out of LibreCAD's plugin interface and a repair back into it. The interface lives only during a call of the plugin:
// nothing of it is kept here.
#pragma once

#include "core/session.h"

#include <QHash>
#include <QMap>

class Document_Interface;

namespace wedm {

/// The layers that marks and the wire's path are drawn on. What lies on them is no part of the drawing, here and where the server reads
/// the saved file.
extern const char MARK_LAYER[];
extern const char PATH_LAYER[];

struct Snapshot {
    QVector<Entity> entities;
    Units units = Units::Unknown;
    /// A unit that the server does not know, by its number in the DXF variable $INSUNITS; 0 for none.
    int otherUnit = 0;
    /// What is in the drawing and not checked, by kind, with how many there are.
    QMap<QString, int> unchecked;
};

/// Everything visible that can be cut. Entities on layers that are off cannot be told from deleted ones and are left out.
Snapshot takeSnapshot(Document_Interface &drawing);

/// The same, taken in several calls of the plugin, between which the host goes on. The caller must see to it that the drawing stays
/// as it is meanwhile; only a drawing that has grown or shrunk is noticed here, and read from its beginning.
class SlicedSnapshot {
public:
    /// Reads on for `milliseconds`, beside the time that LibreCAD needs to list what there is.
    void read(Document_Interface &drawing, qint64 milliseconds);
    bool isBegun() const { return m_isBegun; }
    bool isComplete() const { return m_isBegun && m_next == m_size; }
    /// What was read; the next one begins again.
    Snapshot take();
    void drop() { take(); }
    /// The looks of layers are kept from one snapshot to the next until this is called.
    void forgetLayers() { m_layers.clear(); }

private:
    Snapshot m_snapshot;
    QHash<QString, EntityLook> m_layers;
    bool m_isBegun = false;
    int m_size = 0;
    int m_next = 0;
};

/// Makes the repair in `drawing`. All of it is one undo step, because LibreCAD counts a plugin's call as one.
/// When the drawing is no longer what the repair was made for, `failure` says so and nothing is changed.
bool applyRepair(Document_Interface &drawing, const Repair &repair, QString *failure);

/// How long LibreCAD would be busy with rebuilding the polylines that the repair changes, in ms. See the README, "Limits".
qint64 rebuildTime(const Repair &repair);

/// Draws a circle about each place on the layer of marks, radius in drawing units. The active layer stays what it was.
void drawMarks(Document_Interface &drawing, const QVector<QPointF> &places, double radius);

/// Draws the wire's path on its layer, in place of what lies there. The active layer stays what it was.
void drawPath(Document_Interface &drawing, const Toolpath &path);

/// Takes away what lies on one of the plugin's layers; returns how many entities that were.
int clearLayer(Document_Interface &drawing, const char *layer);

} // namespace wedm
