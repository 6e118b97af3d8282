// SPDX-License-Identifier: GPL-2.0-or-later
// JSON-RPC with one process over its stdin and stdout. Knows nothing of what the messages mean, and never waits for an answer.
#pragma once

#include "frame.h"

#include <QHash>
#include <QJsonObject>
#include <QObject>
#include <QProcess>

#include <functional>

namespace wedm {

/// What came back: `result`, or an error with its code.
struct Answer {
    bool failed = false;
    int code = 0;
    QString message;
    QJsonValue result;
    QJsonObject data;
};

class Connection : public QObject {
    Q_OBJECT
public:
    using Handler = std::function<void(const Answer &)>;

    /// The code of an answer that never came, because the process ended.
    static constexpr int ENDED = -1;

    explicit Connection(QObject *parent = nullptr);
    ~Connection() override;

    void start(const QString &program);
    /// `params` is JSON text. The handler is called once, with the answer or with `ENDED`.
    void request(const QByteArray &method, const QByteArray &params, Handler handler);
    void notify(const QByteArray &method, const QByteArray &params);
    void reply(const QJsonValue &id, const QByteArray &result);
    void replyUnknown(const QJsonValue &id, const QString &method);
    /// Ends the process the way LSP wants it, and by force when it is not gone after `patience` ms. No `ended` follows.
    void stop(int patience);
    qint64 processId() const { return m_process.processId(); }

signals:
    void started();
    void notified(const QString &method, const QJsonObject &params);
    void requested(const QJsonValue &id, const QString &method, const QJsonObject &params);
    /// The process could not be started, has ended, or has sent something that is no message. `hasRun` is false for the first of these.
    void ended(const QString &reason, bool hasRun);

private:
    void send(const QByteArray &body);
    void read();
    void take(const QByteArray &body);
    void end(const QString &reason, bool hasRun = true);
    void endBabbling(const QString &what);

    QProcess m_process;
    FrameReader m_reader;
    QHash<int, Handler> m_waiting;
    QByteArray m_lastWords;
    int m_next = 1;
    bool m_over = false;
};

} // namespace wedm
