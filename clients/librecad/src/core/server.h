// SPDX-License-Identifier: GPL-2.0-or-later
// The life of the server: found, started, greeted, and started again when it ends. Knows nothing of drawings.
#pragma once

#include "connection.h"
#include "program_search.h"
#include "restarts.h"

#include <QElapsedTimer>
#include <QTimer>

namespace wedm {

class Server : public QObject {
    Q_OBJECT
public:
    /// The version of the name space `wedm/` that this client speaks.
    static constexpr int PROTOCOL = 1;

    enum class State { Stopped, Missing, Starting, Ready, Waiting, GivenUp, Refused };
    Q_ENUM(State)

    explicit Server(QObject *parent = nullptr);
    ~Server() override;

    /// How long the answer to `initialize` may take, in ms.
    void setPatience(int milliseconds) { m_patience = milliseconds; }

    /// Starts the server, unless it runs. Also looks again for one that was missing, of another version, or has ended too often.
    void start(const ProgramSearch &search);
    void stop();
    State state() const { return m_state; }
    bool isReady() const { return m_state == State::Ready; }
    /// The path of the program; empty while none was found.
    QString program() const { return m_program; }
    /// The connection to a server that is ready.
    Connection &connection() { return *m_connection; }

signals:
    void stateChanged(wedm::Server::State state, const QString &text);
    void started(qint64 processId);
    void notified(const QString &method, const QJsonObject &params);
    void requested(const QJsonValue &id, const QString &method, const QJsonObject &params);

private:
    void launch();
    void initialize();
    void initialized(const Answer &answer);
    void ended(const QString &reason, bool hasRun);
    void refuse(const QString &text);
    void setState(State state, const QString &text);
    void drop();

    ProgramSearch m_search;
    QString m_program;
    Connection *m_connection = nullptr;
    State m_state = State::Stopped;
    int m_patience = 20000;
    Restarts m_restarts;
    QTimer m_restart;
    QTimer m_handshake;
    QElapsedTimer m_life;
};

} // namespace wedm
