// SPDX-License-Identifier: GPL-2.0-or-later
// What happens on each command: takes the drawing to the session, and what the session says to the dock and back to the drawing.
#pragma once

#include "core/session.h"
#include "live_check.h"
#include "panel.h"
#include "snapshot.h"
#include "view.h"

#include <QPointer>
#include <QThread>

class QAction;
class QMdiSubWindow;

namespace wedm {

/// The entries of the menu. The last two are the plugin's own: they are LibreCAD's only way to let a plugin at the drawing, and
/// are taken out of the menu.
namespace command {
extern const char CHECK[];
extern const char LIVE[];
extern const char FIX[];
extern const char GENERATE[];
extern const char MARK[];
extern const char CLEAR[];
extern const char LOOK[];
extern const char APPLY[];
} // namespace command

class Controller : public QObject {
    Q_OBJECT
public:
    /// `actions` holds LibreCAD's actions for the commands above as children.
    explicit Controller(QObject *actions);
    ~Controller() override;

    /// Does the command. `drawing` is not kept.
    void run(const QString &command, Document_Interface &drawing);

private:
    /// A drawing that has been looked at.
    struct Open {
        QString uri;
        bool seen = false;
        /// Changed by Undo or Redo since it was looked at.
        bool stale = false;
        int version = -1;
        QVector<Finding> findings;
        QSharedPointer<Inspection> inspection;
        QString unchecked;
        InForce settings;
    };

    void settle();
    void undone();
    void connectSession();
    void connectPanel();
    void trigger(const char *command);
    QAction *actionOf(const char *command) const;
    /// Hands a call to the session's thread.
    template <typename Call> void post(Call call)
    {
        QMetaObject::invokeMethod(m_session, [this, call] { call(*m_session); }, Qt::QueuedConnection);
    }

    Open &openFor(QMdiSubWindow *window);
    Open *openOf(const QString &uri, QMdiSubWindow **window = nullptr);
    Open *current();
    void look(Document_Interface &drawing);
    void lookInSlices();
    void lookSlice(Document_Interface &drawing);
    void deliver(const Snapshot &snapshot, qint64 spent);
    void startServer();
    void sendSettings();
    void showCurrent();
    void setLive(bool on);
    void askForFile(const QString &uri);
    void generateFailed(const QString &uri, const QString &path, const QString &reason, const QStringList &findings);
    void repairReady(const Repair &repair);
    void askBeforeRebuild(const Repair &repair, qint64 milliseconds);
    void applyNow(const Repair &repair);
    void apply(Document_Interface &drawing);
    void mark(Document_Interface &drawing);
    void chooseServer();
    void zoom(const QPointF &middle, double size);

    QObject *m_actions;
    QPointer<Panel> m_panel;
    QThread m_thread;
    Session *m_session;
    LiveCheck m_live;
    QHash<QMdiSubWindow *, Open> m_open;
    SlicedSnapshot m_slices;
    QPointer<QMdiSubWindow> m_sliced;
    HeldPainting *m_held = nullptr;
    qint64 m_spent = 0;
    Repair m_repair;
    bool m_running = false;
    int m_names = 0;
    QString m_program;
    QString m_lastFolder;
};

} // namespace wedm
