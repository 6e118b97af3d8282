// SPDX-License-Identifier: GPL-2.0-or-later
// What happens on each command: takes the drawing to the session, and what the session says to the dock and back to the drawing.
#pragma once

#include "commands.h"
#include "drawings.h"
#include "kept.h"
#include "looks.h"
#include "panel.h"

#include <QThread>

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
    void askForFile(const QString &uri);
    void written(const Program &program);
    void generateFailed(const QString &uri, const QString &path, const QString &reason, const QStringList &findings);
    void repairReady(const Repair &repair);
    void applyNow(const Repair &repair);
    void apply(Document_Interface &drawing);
    void mark(Document_Interface &drawing);
    void chooseServer();
    void zoom(const QPointF &middle, double size);

    QObject *m_actions;
    Kept m_kept;
    QPointer<Panel> m_panel;
    QThread m_thread;
    Session *m_session;
    Looks m_looks;
    Drawings m_drawings;
    Repair m_repair;
    bool m_running = false;
    QString m_lastFolder;
};

} // namespace wedm
