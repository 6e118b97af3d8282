// SPDX-License-Identifier: GPL-2.0-or-later
// What an answer of the session does to the drawing: a repair, a path of the wire, a thread hole.
#include "controller.h"

#include "dialogs.h"
#include "host.h"
#include "document_interface.h"
#include "marks.h"

#include <QDir>
#include <QElapsedTimer>
#include <QMdiSubWindow>
#include <QUrl>

namespace wedm {

namespace {

/// A repair that keeps LibreCAD busy for longer than this, in ms, is asked about first.
constexpr qint64 LONG_REBUILD = 1000;
/// How soon a repair is tried again that came while the user was in the middle of something.
constexpr int AGAIN = 100;

} // namespace

void Controller::repairReady(const Repair &repair)
{
    const auto write = [this, repair](Document_Interface &drawing) { applyRepairTo(drawing, repair); };
    const qint64 milliseconds = rebuildTime(repair);
    if (milliseconds <= LONG_REBUILD) {
        writeInto(repair.uri, write);
        return;
    }
    const auto go = [this, repair, write] { QTimer::singleShot(0, this, [this, repair, write] { writeInto(repair.uri, write); }); };
    dialogs::longRebuild(milliseconds, go, [this] { m_panel->setMessage(tr("Nothing was changed."), Panel::Tone::Plain); });
}

void Controller::writeInto(const QString &uri, const Write &write)
{
    const OpenDrawing *open = m_drawings.current();
    if (!open || open->uri != uri) {
        m_panel->setMessage(tr("Another drawing has come to the front while the answer was on its way; nothing was changed."), Panel::Tone::Bad);
        return;
    }
    // LibreCAD drops its list of redos when a plugin is called: after an undo the drawing is not even looked at.
    if (host::redoIsPossible()) {
        m_panel->setMessage(tr("The drawing was changed by Undo while the answer was on its way; nothing was changed. Ask for it again."),
                            Panel::Tone::Bad);
        return;
    }
    if (m_running || host::userIsBusy()) {
        QTimer::singleShot(AGAIN, this, [this, uri, write] { writeInto(uri, write); });
        return;
    }
    m_write = write;
    trigger(command::APPLY);
}

void Controller::applyRepairTo(Document_Interface &drawing, const Repair &repair)
{
    QString failure;
    QElapsedTimer clock;
    clock.start();
    const bool done = applyRepair(drawing, repair, &failure);
    setProperty("applyMilliseconds", clock.elapsed());
    m_looks.whole(drawing);
    if (done)
        m_panel->setMessage(tr("Done: %1. One Undo takes it back.").arg(repair.title), Panel::Tone::Good);
    else
        m_panel->setMessage(failure, Panel::Tone::Bad);
}

void Controller::pathReady(const QString &uri, const Toolpath &path)
{
    if (!m_panel)
        return;
    writeInto(uri, [this, uri, path](Document_Interface &drawing) {
        const OpenDrawing *open = m_drawings.find(uri);
        if (!open || open->stale != Stale::No || !(changesOf(host::currentWindow()) == open->changes)) {
            m_panel->setMessage(tr("The drawing has changed while the path was on its way; nothing was drawn. Ask for it again."), Panel::Tone::Bad);
            return;
        }
        drawPath(drawing, path);
        m_panel->setMessage(tr("The wire path is on the layer %1: cut %2 mm, jumps %3 mm. It is never checked, and saved with the drawing until it is cleared.")
                                .arg(QString::fromLatin1(PATH_LAYER))
                                .arg(path.cut, 0, 'f', 3)
                                .arg(path.jumped, 0, 'f', 3),
                            Panel::Tone::Good);
    });
}

void Controller::pathRefused(const QString &uri, const Refusal &refusal)
{
    say((refusal.isEnded ? tr("Nothing was drawn: %1.") : tr("There is no path of the wire: %1.")).arg(refusal.reason), Panel::Tone::Bad);
    if (refusal.needsSide())
        m_attempts.askSide(false, [this, uri](const QString &side) {
            post([uri, side](Session &session) { session.requestToolpath(uri, {{"side", side}}); });
        });
}

/// LibreCAD asks for the point, and goes on while it does.
void Controller::pickHole(Document_Interface &drawing, const QString &uri)
{
    if (host::filePath(host::currentWindow()).isEmpty()) {
        m_panel->setMessage(tr("A thread hole is kept in wedm.toml beside the drawing: save the drawing first."), Panel::Tone::Bad);
        return;
    }
    const QString question = tr("Thread hole: click where the wire is threaded");
    m_panel->setMessage(question, Panel::Tone::Plain);
    QPointF hole;
    const bool picked = drawing.getPoint(&hole, question);
    m_panel->setMessage(picked ? QString() : tr("No thread hole was picked; nothing was changed."), Panel::Tone::Plain);
    if (picked)
        post([uri, hole](Session &session) { session.requestContour(uri, hole); });
}

void Controller::keepHole(const QString &uri, const QString &contour, const QPointF &hole)
{
    if (!m_panel)
        return;
    QMdiSubWindow *window = nullptr;
    const OpenDrawing *open = m_drawings.find(uri, &window);
    const QString drawn = open ? host::filePath(window) : QString();
    if (contour.isEmpty() || drawn.isEmpty()) {
        m_panel->setMessage(tr("There is no contour that the thread hole could belong to; nothing was kept."), Panel::Tone::Bad);
        return;
    }
    const QString failure = m_hole.keep(QUrl(open->settings.file).toLocalFile(), drawn, contour, hole);
    if (!failure.isEmpty()) {
        holeKept(failure);
        return;
    }
    m_hole.told = tr("Thread hole %1 for the contour at %2, kept in %3.").arg(pointText(hole, ", "), contour, QDir::toNativeSeparators(m_hole.file()));
    post([uri, contour, hole](Session &session) {
        session.reloadSettings();
        session.confirmHole(uri, contour, hole);
    });
}

void Controller::holeKept(const QString &failure)
{
    if (!m_panel)
        return;
    if (failure.isEmpty())
        m_panel->setMessage(m_hole.told, Panel::Tone::Good);
    else
        m_panel->setMessage(tr("The thread hole could not be kept in %1: %2.").arg(QDir::toNativeSeparators(m_hole.file()), failure), Panel::Tone::Bad);
}

} // namespace wedm
