// SPDX-License-Identifier: GPL-2.0-or-later
#include "connection.h"

#include "messages.h"

#include <QJsonArray>
#include <QJsonDocument>

namespace wedm {

namespace {

/// Bytes of the end of the log that are kept for the message about the process's end.
constexpr int LAST_WORDS = 2000;

QByteArray idText(const QJsonValue &id)
{
    return id.isString() ? toJson(id.toString()) : QByteArray::number(qint64(id.toDouble()));
}

} // namespace

Connection::Connection(QObject *parent)
    : QObject(parent)
{
    connect(&m_process, &QProcess::started, this, &Connection::started);
    connect(&m_process, &QProcess::readyReadStandardOutput, this, &Connection::read);
    connect(&m_process, &QProcess::readyReadStandardError, this, [this] {
        m_lastWords = (m_lastWords + m_process.readAllStandardError()).right(LAST_WORDS);
    });
    connect(&m_process, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
        if (error == QProcess::FailedToStart)
            end(tr("it could not be started: %1").arg(m_process.errorString()), false);
    });
    connect(&m_process, QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished), this, [this](int code, QProcess::ExitStatus status) {
        read();
        const QString words = QString::fromUtf8(m_lastWords).trimmed().section('\n', -1);
        const QString how = status == QProcess::CrashExit ? tr("it was killed or has crashed") : tr("it ended with code %1").arg(code);
        end(words.isEmpty() ? how : how + QStringLiteral(": ") + words);
    });
}

Connection::~Connection()
{
    m_over = true;
    disconnect(&m_process, nullptr, this, nullptr);
    if (m_process.state() != QProcess::NotRunning) {
        m_process.kill();
        m_process.waitForFinished(500);
    }
}

void Connection::start(const QString &program)
{
    m_process.start(program, QStringList());
}

void Connection::request(const QByteArray &method, const QByteArray &params, Handler handler)
{
    const int id = m_next++;
    if (m_over) {
        Answer answer;
        answer.failed = true;
        answer.code = ENDED;
        handler(answer);
        return;
    }
    m_waiting.insert(id, handler);
    send("{\"jsonrpc\":\"2.0\",\"id\":" + QByteArray::number(id) + ",\"method\":\"" + method + "\",\"params\":" + params + "}");
}

void Connection::notify(const QByteArray &method, const QByteArray &params)
{
    send("{\"jsonrpc\":\"2.0\",\"method\":\"" + method + "\",\"params\":" + params + "}");
}

void Connection::reply(const QJsonValue &id, const QByteArray &result)
{
    send("{\"jsonrpc\":\"2.0\",\"id\":" + idText(id) + ",\"result\":" + result + "}");
}

void Connection::replyUnknown(const QJsonValue &id, const QString &method)
{
    send("{\"jsonrpc\":\"2.0\",\"id\":" + idText(id) + ",\"error\":{\"code\":-32601,\"message\":"
         + toJson(QStringLiteral("this client does not know %1").arg(method)) + "}}");
}

void Connection::stop(int patience)
{
    if (m_process.state() == QProcess::NotRunning) {
        m_over = true;
        return;
    }
    send("{\"jsonrpc\":\"2.0\",\"id\":0,\"method\":\"shutdown\"}");
    send("{\"jsonrpc\":\"2.0\",\"method\":\"exit\"}");
    m_over = true;
    disconnect(&m_process, nullptr, this, nullptr);
    m_process.closeWriteChannel();
    if (!m_process.waitForFinished(patience)) {
        m_process.kill();
        m_process.waitForFinished(patience);
    }
}

void Connection::send(const QByteArray &body)
{
    if (!m_over)
        m_process.write(frame(body));
}

void Connection::read()
{
    const QList<QByteArray> bodies = m_reader.feed(m_process.readAllStandardOutput());
    for (const QByteArray &body : bodies)
        take(body);
    if (!m_reader.damage().isEmpty())
        endBabbling(m_reader.damage());
}

void Connection::endBabbling(const QString &what)
{
    if (m_over)
        return;
    end(tr("it does not speak the language server protocol: %1").arg(what));
    m_process.kill();
}

void Connection::take(const QByteArray &body)
{
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(body, &error);
    // What is too large for Qt may be a message all the same.
    if (!document.isObject() && error.error != QJsonParseError::DocumentTooLarge)
        endBabbling(document.isNull() ? error.errorString() : QStringLiteral("no object"));
    if (m_over || !document.isObject())
        return;
    const QJsonObject message = document.object();
    const QString method = message.value("method").toString();
    if (!method.isEmpty()) {
        const QJsonObject params = message.value("params").toObject();
        if (message.contains("id"))
            emit requested(message.value("id"), method, params);
        else
            emit notified(method, params);
        return;
    }
    const Handler handler = m_waiting.take(message.value("id").toInt(-1));
    if (!handler)
        return;
    Answer answer;
    answer.result = message.value("result");
    if (message.contains("error")) {
        const QJsonObject fault = message.value("error").toObject();
        answer.failed = true;
        answer.code = fault.value("code").toInt();
        answer.message = fault.value("message").toString();
        answer.data = fault.value("data").toObject();
    }
    handler(answer);
}

void Connection::end(const QString &reason, bool hasRun)
{
    if (m_over)
        return;
    m_over = true;
    const QHash<int, Handler> waiting = m_waiting;
    m_waiting.clear();
    Answer answer;
    answer.failed = true;
    answer.code = ENDED;
    answer.message = reason;
    for (const Handler &handler : waiting)
        handler(answer);
    emit ended(reason, hasRun);
}

} // namespace wedm
