// SPDX-License-Identifier: GPL-2.0-or-later
// How LibreCAD shows an entity, in the server's words. What the entity takes from its layer is read from the layer.
#pragma once

#include "core/drawing.h"

#include <QHash>
#include <QVariant>

class Document_Interface;

namespace wedm {

/// An entity as LibreCAD hands it out, by the keys of DPI::EDATA.
using Data = QHash<int, QVariant>;

/// The looks of layers. The interface tells that of the active layer only: each layer is made that once, and what was active is so again
/// in the end.
class LayerLooks {
public:
    /// What is found is added to `known`, and not asked for again.
    LayerLooks(Document_Interface &drawing, QHash<QString, EntityLook> &known);
    ~LayerLooks();
    LayerLooks(const LayerLooks &) = delete;
    LayerLooks &operator=(const LayerLooks &) = delete;

    /// The look of an entity.
    EntityLook of(const Data &data);

private:
    EntityLook ofLayer(const QString &layer);

    Document_Interface &m_drawing;
    QHash<QString, EntityLook> &m_known;
    const QString m_active;
    QString m_now;
};

} // namespace wedm
