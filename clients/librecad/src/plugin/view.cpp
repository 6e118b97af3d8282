// SPDX-License-Identifier: GPL-2.0-or-later
#include "view.h"

#include "host.h"

#include <QAction>
#include <QApplication>
#include <QLabel>
#include <QMainWindow>
#include <QMdiSubWindow>
#include <QMouseEvent>
#include <QWidget>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "rs_document.h"
#include "rs_graphicview.h"
#pragma GCC diagnostic pop

namespace wedm {

namespace {

QWidget *graphicView(QMdiSubWindow *window)
{
    if (!window)
        return nullptr;
    const QList<QWidget *> widgets = window->findChildren<QWidget *>();
    for (QWidget *widget : widgets) {
        if (widget->inherits("RS_GraphicView"))
            return widget;
    }
    return nullptr;
}

/// The prompt of the command line is "Command:" while none is running. That is a sentence of LibreCAD, which has its own translation:
/// in a name, so that it is not taken for one of the plugin's.
bool commandIsRunning()
{
    const char *const idle = "Command:";
    const QMainWindow *main = host::mainWindow();
    const QLabel *prompt = main ? main->findChild<QLabel *>(QStringLiteral("lCommand")) : nullptr;
    return !prompt || prompt->text() != QCoreApplication::translate("QG_CommandWidget", idle);
}

/// The constructors of RS_Vector are not exported by LibreCAD.
RS_Vector vector(double x, double y)
{
    RS_Vector result;
    result.x = x;
    result.y = y;
    result.valid = true;
    return result;
}

/// The function that returns it is not exported by LibreCAD.
struct Viewed : RS_GraphicView {
    static RS_EntityContainer *of(RS_GraphicView &view) { return view.*&Viewed::container; }
};

/// Null where it is not known: blocks are drawings of their own, in windows of their own.
RS_Document *documentOf(QMdiSubWindow *window)
{
    QWidget *widget = graphicView(window);
    RS_EntityContainer *shown = widget ? Viewed::of(*static_cast<RS_GraphicView *>(widget)) : nullptr;
    return shown && shown->isDocument() ? static_cast<RS_Document *>(shown) : nullptr;
}

} // namespace

ChangeCount changesOf(QMdiSubWindow *window)
{
    ChangeCount count;
    if (RS_Document *document = documentOf(window)) {
        count.undo = document->countUndoCycles();
        count.redo = document->countRedoCycles();
    }
    return count;
}

bool isModified(QMdiSubWindow *window)
{
    const RS_Document *document = documentOf(window);
    return document && document->isModified();
}

bool zoomTo(QMdiSubWindow *window, const QPointF &centre, double half)
{
    QWidget *widget = graphicView(window);
    if (!widget)
        return false;
    RS_GraphicView *view = static_cast<RS_GraphicView *>(widget);
    view->saveView();
    view->zoomWindow(vector(centre.x() - half, centre.y() - half), vector(centre.x() + half, centre.y() + half), true);
    return true;
}

void selectInMiddle(QMdiSubWindow *window)
{
    QWidget *widget = graphicView(window);
    QAction *deselect = host::action("DeselectAll");
    if (!widget || !deselect || commandIsRunning())
        return;
    deselect->trigger();
    const QPointF middle(widget->width() / 2.0, widget->height() / 2.0);
    QMouseEvent move(QEvent::MouseMove, middle, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QMouseEvent press(QEvent::MouseButtonPress, middle, Qt::LeftButton, Qt::LeftButton, Qt::NoModifier);
    QMouseEvent release(QEvent::MouseButtonRelease, middle, Qt::LeftButton, Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &move);
    QCoreApplication::sendEvent(widget, &press);
    QCoreApplication::sendEvent(widget, &release);
}

HeldPainting::HeldPainting(QMdiSubWindow *window)
    : m_view(graphicView(window))
{
    // `setUpdatesEnabled` would paint when it switches on again.
    if (m_view)
        m_view->setAttribute(Qt::WA_UpdatesDisabled, true);
}

HeldPainting::~HeldPainting()
{
    release();
}

void HeldPainting::release()
{
    if (m_view)
        m_view->setAttribute(Qt::WA_UpdatesDisabled, false);
    m_view = nullptr;
}

} // namespace wedm
