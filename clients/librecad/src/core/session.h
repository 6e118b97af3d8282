// SPDX-License-Identifier: GPL-2.0-or-later
// The session with the server: keeps its copy of every drawing up to date, and asks for lists, repairs and programs. Lives in a thread
// of its own, so that no list however long holds up the host. Knows nothing of LibreCAD.
#pragma once

#include "contours.h"
#include "difference.h"
#include "figures.h"
#include "messages.h"
#include "program.h"
#include "server.h"

#include <QSharedPointer>

namespace wedm {

/// What a repair is made of: the drawing that it was made for, and the drawing as it is to be.
struct Repair {
    QString uri;
    int version = 0;
    QString title;
    QVector<Entity> before;
    QVector<Entity> after;
};

/// Against what the server checks, and where each comes from: "default", "client", "file" or "drawing".
struct InForce {
    /// mm; of each pass.
    QVector<double> corrections;
    QString from;
    QString side;
    QString sideFrom;
    double unitsToMm = 1;
    /// Empty while the drawing is not read.
    QString unitsFrom;
    /// URI of the wedm.toml, where there is one.
    QString file;
};

class Session : public QObject {
    Q_OBJECT
public:
    explicit Session(QObject *parent = nullptr);

    /// How long a server may take to answer the greeting, in ms.
    void setPatience(int milliseconds) { m_server.setPatience(milliseconds); }

public slots:
    /// Starts the server, unless it runs. Also looks again for one that was missing, of another version, or has ended too often.
    void start(const wedm::ProgramSearch &search);
    /// Ends the server and forgets all drawings.
    void stop();
    /// `{correction, side, …}`; see "Settings" in the protocol.
    void setSettings(const QJsonObject &settings);
    /// Has the server read its settings again, a wedm.toml that was edited elsewhere included.
    void reloadSettings();
    /// The drawing as it is now; only differences go to the server. `looked` follows.
    void look(const QString &uri, const QVector<wedm::Entity> &entities, wedm::Units units);
    void close(const QString &uri);
    /// Asks for the radius list, now and after every change from now on.
    void watchRadii(const QString &uri, bool on);
    /// Asks for the repair of one finding, or, with an empty handle, of all that can be repaired safely.
    void requestRepair(const QString &uri, const QString &handle, int segment);
    /// Sends a request about a drawing, such as `wedm/generate`; `answered` or `refused` follows with the same number.
    void ask(int number, const QString &uri, const QString &method, const QJsonObject &params);
    /// Runs the server's program with these arguments in that folder, beside the server; `ran` follows with the same number.
    void run(int number, const QStringList &arguments, const QString &folder);
    /// Asks for the path of the wire, under these settings.
    void requestToolpath(const QString &uri, const QJsonObject &options);
    /// Asks for what the drawing comes to.
    void requestFigures(const QString &uri);
    /// Asks for the contour nearest to a thread hole, by which the hole is kept.
    void requestContour(const QString &uri, const QPointF &hole);
    /// Asks whether the settings hold the thread hole for the contour of that name, once they have been read again.
    void confirmHole(const QString &uri, const QString &contour, const QPointF &hole);

signals:
    void stateChanged(wedm::Server::State state, const QString &text);
    void serverStarted(qint64 processId);
    void looked(const QString &uri, int version, bool changed);
    void found(const QString &uri, int version, const QVector<wedm::Finding> &findings);
    void inspected(const QString &uri, int version, const QSharedPointer<wedm::Inspection> &inspection);
    void settingsInForce(const QString &uri, const wedm::InForce &settings);
    void repairReady(const wedm::Repair &repair);
    void repairFailed(const QString &uri, const QString &reason);
    void answered(int number, const QJsonObject &result);
    void refused(int number, const wedm::Refusal &refusal);
    /// `code` is that of the program's end, -1 where it did not run to it; `said` what it wrote about errors.
    void ran(int number, int code, const QString &said);
    void toolpathReady(const QString &uri, const wedm::Toolpath &path);
    void toolpathFailed(const QString &uri, const wedm::Refusal &refusal);
    void figuresReady(const QString &uri, const wedm::Figures &figures);
    void figuresFailed(const QString &uri, const QString &reason);
    /// `contour` is the name that the hole is kept by; empty where the drawing has no contour, or the server did not answer.
    void contourFound(const QString &uri, const QString &contour, const QPointF &hole);
    void holeConfirmed(const QString &uri, bool holds);
    void said(const QString &text);

private:
    struct Document {
        Drawing drawing;
        HandleGiver handles;
        QVector<Finding> findings;
        bool watched = false;
        bool inspecting = false;
        bool stale = false;
        int inspectedVersion = -1;
    };

    void serverChanged(Server::State state, const QString &text);
    void take(const QString &method, const QJsonObject &params);
    void answer(const QJsonValue &id, const QString &method, const QJsonObject &params);
    void open(Document &document);
    void sendSettings();
    void inspect(const QString &uri);
    void askSettings(const QString &uri);
    void askRepair(const QString &uri, const QString &handle, int segment);
    void takeRepair(const QString &uri, const QJsonArray &actions);
    /// Waits for a server that is starting, then calls `ask` where there is one and it knows the drawing, else `cannot`.
    void withServer(const QString &uri, std::function<void()> ask, std::function<void()> cannot);
    /// Does `call` now, or as soon as a server that is starting is ready or is not going to be.
    void whenSettled(std::function<void()> call);
    void settled();

    Server m_server;
    QHash<QString, QSharedPointer<Document>> m_documents;
    QJsonObject m_settings;
    QVector<std::function<void()>> m_waitingCalls;
};

/// Makes the types above known to queued signals. Called once, by whoever makes a session.
void registerSessionTypes();

} // namespace wedm

Q_DECLARE_METATYPE(wedm::Entity)
Q_DECLARE_METATYPE(wedm::Finding)
Q_DECLARE_METATYPE(QSharedPointer<wedm::Inspection>)
Q_DECLARE_METATYPE(wedm::InForce)
Q_DECLARE_METATYPE(wedm::ProgramSearch)
Q_DECLARE_METATYPE(wedm::Repair)
Q_DECLARE_METATYPE(wedm::Figures)
Q_DECLARE_METATYPE(wedm::Refusal)
Q_DECLARE_METATYPE(wedm::Toolpath)
Q_DECLARE_METATYPE(wedm::Units)
