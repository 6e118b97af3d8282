// SPDX-License-Identifier: GPL-2.0-or-later
#include "server.h"

#include "language.h"

#include <QCoreApplication>
#include <QDir>
#include <QJsonDocument>

namespace wedm {

namespace {

/// How long the server may take to end.
constexpr int PATIENCE_AT_END = 800;

} // namespace

Server::Server(QObject *parent)
    : QObject(parent)
    , m_restart(this)
    , m_handshake(this)
{
    m_restart.setSingleShot(true);
    connect(&m_restart, &QTimer::timeout, this, &Server::launch);
    m_handshake.setSingleShot(true);
    connect(&m_handshake, &QTimer::timeout, this, [this] {
        if (m_connection)
            refuse(tr("%1 does not answer: there was nothing within %2 s.").arg(QDir::toNativeSeparators(m_program)).arg(m_patience / 1000.0, 0, 'g', 3));
    });
}

Server::~Server()
{
    drop();
}

void Server::start(const ProgramSearch &search)
{
    const bool other = search.setting != m_search.setting;
    m_search = search;
    if (m_connection && other)
        stop();
    if (!m_connection) {
        m_restarts.reset();
        launch();
    }
}

void Server::stop()
{
    m_restart.stop();
    m_handshake.stop();
    if (m_connection)
        m_connection->stop(PATIENCE_AT_END);
    drop();
    setState(State::Stopped, QString());
}

void Server::setState(State state, const QString &text)
{
    m_state = state;
    emit stateChanged(state, text);
}

void Server::launch()
{
    m_restart.stop();
    QString message;
    m_program = findProgram(m_search, &message);
    if (m_program.isEmpty()) {
        setState(State::Missing, message);
        return;
    }
    drop();
    m_connection = new Connection(this);
    connect(m_connection, &Connection::started, this, &Server::initialize);
    connect(m_connection, &Connection::ended, this, &Server::ended);
    connect(m_connection, &Connection::notified, this, &Server::notified);
    connect(m_connection, &Connection::requested, this, &Server::requested);
    setState(State::Starting, tr("Starting %1").arg(QDir::toNativeSeparators(m_program)));
    m_life.invalidate();
    m_handshake.start(m_patience);
    m_connection->start(m_program);
}

void Server::initialize()
{
    emit started(m_connection->processId());
    const QJsonObject params{
        {"processId", QCoreApplication::applicationPid()},
        {"clientInfo", QJsonObject{{"name", "wedm for LibreCAD"}, {"version", WEDM_PLUGIN_VERSION}}},
        {"locale", language()},
        {"rootUri", QJsonValue()},
        {"capabilities", QJsonObject{{"experimental", QJsonObject{{"wedm", QJsonObject{{"resendDrawing", true}}}}}}},
    };
    const QByteArray body = QJsonDocument(params).toJson(QJsonDocument::Compact);
    m_connection->request("initialize", body, [this](const Answer &answer) { initialized(answer); });
}

void Server::initialized(const Answer &answer)
{
    if (answer.code == Connection::ENDED)
        return;
    m_handshake.stop();
    if (answer.failed) {
        refuse(tr("%1 refuses to start: %2").arg(QDir::toNativeSeparators(m_program), answer.message));
        return;
    }
    const QJsonObject result = answer.result.toObject();
    const QJsonObject info = result.value("serverInfo").toObject();
    const QString version = info.value("version").toString();
    const QJsonValue protocol =
        result.value("capabilities").toObject().value("experimental").toObject().value("wedm").toObject().value("protocol");
    if (!protocol.isDouble()) {
        refuse(tr("%1 is not a wedm server (it calls itself \"%2\"). Choose the right program with the button \"Server…\".")
                   .arg(QDir::toNativeSeparators(m_program), info.value("name").toString()));
        return;
    }
    if (protocol.toInt() != PROTOCOL) {
        refuse(tr("wedm %1 at %2 speaks protocol %3, this plugin speaks protocol %4. Install the server and the plugin of the same "
                  "release, or choose another server with the button \"Server…\".")
                   .arg(version, QDir::toNativeSeparators(m_program))
                   .arg(protocol.toInt())
                   .arg(PROTOCOL));
        return;
    }
    m_life.start();
    m_connection->notify("initialized", "{}");
    setState(State::Ready, tr("wedm %1").arg(version));
}

void Server::refuse(const QString &text)
{
    m_connection->stop(PATIENCE_AT_END);
    drop();
    setState(State::Refused, text);
}

void Server::ended(const QString &reason, bool hasRun)
{
    m_handshake.stop();
    drop();
    if (!hasRun) {
        setState(State::Refused, tr("%1: %2.").arg(QDir::toNativeSeparators(m_program), reason));
        return;
    }
    const std::optional<int> pause = m_restarts.afterLifeOf(m_life.isValid() ? m_life.elapsed() : 0);
    if (!pause) {
        setState(State::GivenUp,
                 tr("The wedm server has ended 6 times in a row (%1) and is not started again before the next command.").arg(reason));
        return;
    }
    const QString when = *pause == 0 ? QString() : tr(" in %1 s").arg(*pause / 1000.0, 0, 'g', 3);
    setState(State::Waiting, tr("The wedm server has ended (%1). It is started again%2.").arg(reason, when));
    m_restart.start(*pause);
}

void Server::drop()
{
    if (!m_connection)
        return;
    // This may have been called from one of its own signals.
    disconnect(m_connection, nullptr, this, nullptr);
    m_connection->deleteLater();
    m_connection = nullptr;
}

} // namespace wedm
