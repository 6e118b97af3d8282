// SPDX-License-Identifier: GPL-2.0-or-later
// What the session asks of the server where somebody has asked for it: programs and lists, the path of the wire, figures, reports.
#include "language.h"
#include "session.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QProcess>

namespace wedm {

namespace {

QByteArray paramsOf(const QString &uri, QJsonObject params)
{
    params.insert(QStringLiteral("uri"), uri);
    return QJsonDocument(params).toJson(QJsonDocument::Compact);
}

Refusal refusalOf(const Answer &answer)
{
    Refusal refusal;
    refusal.isEnded = answer.code == Connection::ENDED;
    refusal.reason = refusal.isEnded ? Session::tr("the server ended before it answered") : answer.message;
    const QJsonArray diagnostics = answer.data.value("diagnostics").toArray();
    for (const QJsonValue &each : diagnostics)
        refusal.findings += each.toObject().value("message").toString();
    return refusal;
}

Refusal noServer()
{
    Refusal refusal;
    refusal.isEnded = true;
    refusal.reason = Session::tr("the server is not running");
    return refusal;
}

} // namespace

void Session::ask(int number, const QString &uri, const QString &method, const QJsonObject &params)
{
    const auto ask = [=] {
        m_server.connection().request(method.toUtf8(), paramsOf(uri, params), [=](const Answer &answer) {
            if (answer.failed)
                emit refused(number, refusalOf(answer));
            else
                emit answered(number, answer.result.toObject());
        });
    };
    withServer(uri, ask, [=] { emit refused(number, noServer()); });
}

void Session::run(int number, const QStringList &arguments, const QString &folder)
{
    if (m_server.program().isEmpty()) {
        emit ran(number, -1, noServer().reason);
        return;
    }
    QProcess *process = new QProcess(this);
    process->setWorkingDirectory(folder);
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("NO_COLOR"), QStringLiteral("1"));
    process->setProcessEnvironment(environment);
    process->setStandardInputFile(QProcess::nullDevice());
    process->setStandardOutputFile(QProcess::nullDevice());
    connect(process, &QProcess::errorOccurred, this, [=](QProcess::ProcessError error) {
        if (error != QProcess::FailedToStart)
            return;
        emit ran(number, -1, process->errorString());
        process->deleteLater();
    });
    connect(process, QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished), this, [=](int code, QProcess::ExitStatus status) {
        emit ran(number, status == QProcess::NormalExit ? code : -1, QString::fromUtf8(process->readAllStandardError()).trimmed());
        process->deleteLater();
    });
    // It speaks as the server does.
    process->start(m_server.program(), QStringList{QStringLiteral("--lang"), language().startsWith(QLatin1String("zh")) ? "zh" : "en"} + arguments);
}

void Session::requestToolpath(const QString &uri, const QJsonObject &options)
{
    const auto ask = [=] {
        m_server.connection().request("wedm/toolpath", paramsOf(uri, {{"options", options}}), [=](const Answer &answer) {
            if (answer.failed)
                emit toolpathFailed(uri, refusalOf(answer));
            else
                emit toolpathReady(uri, toolpathFromJson(answer.result.toObject()));
        });
    };
    withServer(uri, ask, [=] { emit toolpathFailed(uri, noServer()); });
}

void Session::requestFigures(const QString &uri)
{
    const auto ask = [=](const QByteArray &method, std::function<void(const Answer &)> then) {
        withServer(uri, [=] { m_server.connection().request(method, paramsOf(uri, {}), then); }, [=] { emit figuresFailed(uri, noServer().reason); });
    };
    const auto asked = [=](const Answer &answer) {
        if (answer.failed)
            emit figuresFailed(uri, refusalOf(answer).reason);
        return !answer.failed;
    };
    ask("wedm/contours", [=](const Answer &contours) {
        if (!asked(contours))
            return;
        ask("wedm/inspect", [=](const Answer &inspection) {
            if (!asked(inspection))
                return;
            ask("wedm/toolpath", [=](const Answer &toolpath) {
                Figures figures = figuresFromJson(contours.result.toObject(), inspection.result.toObject(), toolpath.result.toObject());
                if (toolpath.failed)
                    figures.noPath = refusalOf(toolpath).reason;
                emit figuresReady(uri, figures);
            });
        });
    });
}

} // namespace wedm
