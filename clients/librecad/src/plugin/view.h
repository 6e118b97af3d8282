// SPDX-License-Identifier: GPL-2.0-or-later
// Shows a place of the drawing, and tells that it has changed. The plugin interface has no way to do that, so this is the one file that uses
// LibreCAD's own view and document, by their virtual functions only; `host::versionFault` has made sure that it is the one the plugin was built for.
#pragma once

#include <QPointF>

class QMdiSubWindow;
class QWidget;

namespace wedm {

/// The numbers of changes that can be undone and redone: where they differ, the drawing has changed.
struct ChangeCount {
    int undo = -1;
    int redo = -1;
    bool operator==(const ChangeCount &other) const { return undo == other.undo && redo == other.redo; }
};

/// The counts of the drawing in `window`; both −1 where they are not known.
ChangeCount changesOf(QMdiSubWindow *window);

/// Whether the drawing in `window` differs from its file.
bool isModified(QMdiSubWindow *window);

/// Zooms `window` so that `half` drawing units are seen to each side of `centre`.
bool zoomTo(QMdiSubWindow *window, const QPointF &centre, double half);

/// Selects the entity that `zoomTo` has put in the middle of the view, as a click of the user would.
/// Does nothing while a command of LibreCAD is running, which would take the click for its own.
void selectInMiddle(QMdiSubWindow *window);

/// Keeps LibreCAD from repainting the drawing of `window`, which it does after each call of a plugin; ends with the object.
/// LibreCAD remembers the request and does it with the next repaint.
class HeldPainting {
public:
    explicit HeldPainting(QMdiSubWindow *window);
    ~HeldPainting();
    HeldPainting(const HeldPainting &) = delete;
    HeldPainting &operator=(const HeldPainting &) = delete;

    void release();

private:
    QWidget *m_view;
};

} // namespace wedm
