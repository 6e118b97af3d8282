// SPDX-License-Identifier: GPL-2.0-or-later
// Looks at the drawing in front: at once, or for the live check in slices, between which LibreCAD goes on. The cost of a look is
// in the properties lookMilliseconds, slices, sliceMilliseconds and looks of the parent, for tests.
#pragma once

#include "live_check.h"
#include "snapshot.h"
#include "view.h"

#include <QMdiSubWindow>
#include <QPointer>

namespace wedm {

class Looks : public QObject {
    Q_OBJECT
public:
    explicit Looks(QObject *parent);

    LiveCheck &live() { return m_live; }
    /// Looks at all of it now.
    void whole(Document_Interface &drawing);
    /// Reads a slice; answers `sliceWanted`.
    void slice(Document_Interface &drawing);

signals:
    /// The plugin is to be called, so that a slice of the drawing can be read.
    void sliceWanted();
    /// The drawing in front as it is.
    void taken(const wedm::Snapshot &snapshot);

private:
    void nextSlice();
    void deliver(const Snapshot &snapshot, qint64 spent);

    LiveCheck m_live;
    SlicedSnapshot m_slices;
    QPointer<QMdiSubWindow> m_window;
    HeldPainting *m_held = nullptr;
    qint64 m_spent = 0;
};

} // namespace wedm
