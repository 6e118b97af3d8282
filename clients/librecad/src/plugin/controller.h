// SPDX-License-Identifier: GPL-2.0-or-later
// What happens on each command: takes the drawing to the session, and the session's answers to the dock and back to the drawing.
#pragma once

#include "attempts.h"
#include "commands.h"
#include "core/kept_hole.h"
#include "drawings.h"
#include "kept.h"
#include "looks.h"
#include "panel.h"

#include <QThread>
#include <QTimer>

#include <functional>

class QAction;

namespace wedm {

class Controller : public QObject {
    Q_OBJECT
public:
    /// `actions` holds LibreCAD's actions for the commands above as children.
    explicit Controller(QObject *actions);
    ~Controller() override;

    /// Does the command. `drawing` is not kept.
    void run(const QString &command, Document_Interface &drawing);

private:
    void settle();
    void quit();
    void undone();
    /// Checks whether the drawing in front has changed since it was looked at.
    void compare();
    void becomesStale(Stale why);
    /// The drawing in front as it is now is the one that was looked at.
    void settleChanges();
    void connectSession();
    void connectPanel();
    void makePanel();
    void trigger(const char *command);
    QAction *actionOf(const char *command) const;
    /// Hands a call to the session's thread.
    template <typename Call> void post(Call call)
    {
        QMetaObject::invokeMethod(m_session, [this, call] { call(*m_session); }, Qt::QueuedConnection);
    }

    void looked(const Snapshot &snapshot);
    void startServer();
    void sendSettings();
    void showCurrent();
    void setLive(bool on);
    /// What is made of a drawing: programs, lists, figures, a report.
    void make(const QString &command, const QString &uri);
    void generate(const QString &uri, const QString &format);
    void generatePair(const QString &uri, const QString &format);
    void savePair(const QVector<Program> &programs, const QString &format, const QString &folder, const QString &base);
    void saveDrillList(const QString &uri);
    void showFit(const QString &uri);
    void showFigures(const QString &uri, const Figures &figures);
    void report(const QString &uri);
    void reported(int number, int code, const QString &said);
    void say(const QString &text, Panel::Tone tone);
    /// The folder and the name without its ending that are proposed for what is made of the drawing.
    QPair<QString, QString> proposal(const QString &uri);
    void choseFolder(const QString &uri, const QString &folder);
    void repairReady(const Repair &repair);
    void applyRepairTo(Document_Interface &drawing, const Repair &repair);
    void pathReady(const QString &uri, const Toolpath &path);
    void pathRefused(const QString &uri, const Refusal &refusal);
    void pickHole(Document_Interface &drawing, const QString &uri);
    void keepHole(const QString &uri, const QString &contour, const QPointF &hole);
    /// Says that the hole is kept, or why it is not.
    void holeKept(const QString &failure);
    /// Calls `write` with the drawing as soon as the user is in the middle of nothing.
    using Write = std::function<void(Document_Interface &)>;
    void writeInto(const QString &uri, const Write &write);
    void mark(Document_Interface &drawing);
    void chooseServer();
    void zoom(const QPointF &middle, double size);

    QObject *m_actions;
    Kept m_kept;
    QPointer<Panel> m_panel;
    /// The window whose drawing the panel shows.
    QPointer<QMdiSubWindow> m_front;
    QThread m_thread;
    Session *m_session;
    Looks m_looks;
    Drawings m_drawings;
    Write m_write;
    QTimer m_comparison;
    KeptHole m_hole;
    Attempts m_attempts;
    /// The first page of each report that is being made.
    QHash<int, QString> m_reports;
    bool m_running = false;
    /// A command has ended, and LibreCAD has not closed its step of undo yet.
    bool m_settling = false;
    QString m_lastFolder;
};

} // namespace wedm
