// SPDX-License-Identifier: GPL-2.0-or-later
#include "session.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QTimer>

#include <algorithm>

namespace wedm {

namespace {

/// When more entities than this change at once, and most of the drawing, it is sent whole.
constexpr int MANY_CHANGES = 1000;
/// The pause before a list of radii is asked for again, as a multiple of the time for the last one, so that long lists do not
/// keep the server busy.
constexpr int REST = 3;
constexpr int SHORTEST_REST = 30;

QByteArray compact(const QJsonObject &object)
{
    return QJsonDocument(object).toJson(QJsonDocument::Compact);
}

QByteArray uriOnly(const QString &uri)
{
    return "{\"uri\":" + toJson(uri) + "}";
}

/// Whether the finding stands for one at that segment, too.
bool standsFor(const Finding &finding, const QString &handle, int segment)
{
    const QJsonArray others = finding.diagnostic.value("data").toObject().value("related").toArray();
    return std::any_of(others.begin(), others.end(), [&](const QJsonValue &each) {
        const QJsonObject other = each.toObject();
        return other.value("handle").toString() == handle && other.value("segment").toInt(-1) == segment;
    });
}

/// The diagnostic as if it were of that segment alone.
QJsonObject at(QJsonObject diagnostic, const QString &handle, int segment)
{
    QJsonObject data = diagnostic.value("data").toObject();
    data.insert("handle", handle);
    data.insert("segment", segment);
    diagnostic.insert("data", data);
    return diagnostic;
}

} // namespace

void registerSessionTypes()
{
    qRegisterMetaType<wedm::ProgramSearch>("wedm::ProgramSearch");
    qRegisterMetaType<wedm::Units>("wedm::Units");
    qRegisterMetaType<wedm::InForce>("wedm::InForce");
    qRegisterMetaType<wedm::Repair>("wedm::Repair");
    qRegisterMetaType<wedm::Figures>("wedm::Figures");
    qRegisterMetaType<wedm::Refusal>("wedm::Refusal");
    qRegisterMetaType<wedm::Toolpath>("wedm::Toolpath");
    qRegisterMetaType<wedm::Server::State>("wedm::Server::State");
    qRegisterMetaType<QVector<wedm::Entity>>("QVector<wedm::Entity>");
    qRegisterMetaType<QVector<wedm::Finding>>("QVector<wedm::Finding>");
    qRegisterMetaType<QSharedPointer<wedm::Inspection>>("QSharedPointer<wedm::Inspection>");
}

Session::Session(QObject *parent)
    : QObject(parent)
    , m_server(this)
{
    connect(&m_server, &Server::started, this, &Session::serverStarted);
    connect(&m_server, &Server::stateChanged, this, &Session::serverChanged);
    connect(&m_server, &Server::notified, this, &Session::take);
    connect(&m_server, &Server::requested, this, &Session::answer);
}

void Session::start(const ProgramSearch &search)
{
    m_server.start(search);
}

void Session::stop()
{
    m_server.stop();
    m_documents.clear();
}

void Session::setSettings(const QJsonObject &settings)
{
    if (settings == m_settings)
        return;
    m_settings = settings;
    reloadSettings();
}

void Session::reloadSettings()
{
    if (!m_server.isReady())
        return;
    sendSettings();
    // New settings change verdicts without a new version.
    for (auto each = m_documents.begin(); each != m_documents.end(); ++each)
        each.value()->inspectedVersion = -1;
}

void Session::look(const QString &uri, const QVector<Entity> &entities, Units units)
{
    QSharedPointer<Document> &document = m_documents[uri];
    if (!document) {
        document.reset(new Document);
        document->drawing.uri = uri;
    }
    const bool fresh = document->drawing.version == 0;
    const Difference difference = wedm::difference(document->drawing.entities, entities, document->handles);
    const bool otherUnits = units != document->drawing.units;
    const bool changed = fresh || otherUnits || !difference.changes.isEmpty();
    const int size = document->drawing.entities.size();
    // The host's numbers may have changed even where no geometry has.
    document->drawing.entities = difference.entities;
    document->drawing.units = units;
    if (changed)
        ++document->drawing.version;
    emit looked(uri, document->drawing.version, changed);
    if (!changed || !m_server.isReady())
        return;
    const bool whole = fresh || otherUnits || (difference.changes.size() > MANY_CHANGES && difference.changes.size() > size / 2);
    if (whole)
        open(*document);
    else
        m_server.connection().notify("wedm/didChangeDrawing", toJson(uri, document->drawing.version, difference.changes));
}

void Session::close(const QString &uri)
{
    if (!m_documents.remove(uri) || !m_server.isReady())
        return;
    m_server.connection().notify("wedm/didCloseDrawing", "{\"drawing\":" + uriOnly(uri) + "}");
}

void Session::watchRadii(const QString &uri, bool on)
{
    const QSharedPointer<Document> document = m_documents.value(uri);
    if (!document)
        return;
    document->watched = on;
    if (on && document->inspectedVersion != document->drawing.version)
        inspect(uri);
}

void Session::requestRepair(const QString &uri, const QString &handle, int segment)
{
    withServer(uri, [=] { askRepair(uri, handle, segment); },
               [=] { emit repairFailed(uri, tr("The server is not running; nothing was changed.")); });
}

void Session::askRepair(const QString &uri, const QString &handle, int segment)
{
    const QSharedPointer<Document> document = m_documents.value(uri);
    QJsonArray diagnostics;
    QJsonArray only{QStringLiteral("source.fixAll.wedm")};
    if (!handle.isEmpty()) {
        only = QJsonArray{QStringLiteral("quickfix")};
        for (const Finding &finding : document->findings) {
            if (finding.handle == handle && finding.segment == segment)
                diagnostics += finding.diagnostic;
            else if (standsFor(finding, handle, segment))
                diagnostics += at(finding.diagnostic, handle, segment);
        }
        if (diagnostics.isEmpty()) {
            emit repairFailed(uri, tr("Nothing was found at this segment; nothing was changed."));
            return;
        }
    }
    const int line = qMax(segment, 0);
    const int lastLine = handle.isEmpty() ? 0x7fffffff : line;
    const QJsonObject params{
        {"textDocument", QJsonObject{{"uri", uri}}},
        {"range",
         QJsonObject{{"start", QJsonObject{{"line", line}, {"character", 0}}}, {"end", QJsonObject{{"line", lastLine}, {"character", 0}}}}},
        {"context", QJsonObject{{"diagnostics", diagnostics}, {"only", only}}},
    };
    m_server.connection().request("textDocument/codeAction", compact(params), [this, uri](const Answer &answer) {
        if (answer.code == Connection::ENDED)
            emit repairFailed(uri, tr("The server ended before it answered; nothing was changed."));
        else if (answer.failed)
            emit repairFailed(uri, tr("No repair: %1. Nothing was changed.").arg(answer.message));
        else
            takeRepair(uri, answer.result.toArray());
    });
}

void Session::requestContour(const QString &uri, const QPointF &hole)
{
    const auto none = [=] { emit contourFound(uri, QString(), hole); };
    const auto ask = [=] {
        m_server.connection().request("wedm/contours", uriOnly(uri), [=](const Answer &answer) {
            const QJsonArray contours = answer.result.toObject().value("contours").toArray();
            const double unit = answer.result.toObject().value("unitsToMm").toDouble(1);
            const int nearest = nearestContour(contours, hole);
            if (nearest < 0 || !m_server.isReady()) {
                none();
                return;
            }
            const QJsonObject contour = contours.at(nearest).toObject();
            m_server.connection().request("wedm/settings", uriOnly(uri), [=](const Answer &answer) {
                emit contourFound(uri, nameOfContour(contour, unit, answer.result.toObject().value("contours").toObject().keys()), hole * unit);
            });
        });
    };
    withServer(uri, ask, none);
}

void Session::confirmHole(const QString &uri, const QString &contour, const QPointF &hole)
{
    const auto ask = [=] {
        m_server.connection().request("wedm/settings", uriOnly(uri), [=](const Answer &answer) {
            const QJsonArray thread =
                answer.result.toObject().value("contours").toObject().value(contour).toObject().value("thread").toArray();
            const QPointF kept(thread.at(0).toDouble(), thread.at(1).toDouble());
            emit holeConfirmed(uri, thread.size() == 2 && pointText(kept, ",") == pointText(hole, ","));
        });
    };
    // Without a server there is nobody who has refused it.
    withServer(uri, ask, [=] { emit holeConfirmed(uri, true); });
}

void Session::withServer(const QString &uri, std::function<void()> ask, std::function<void()> cannot)
{
    if (m_server.state() == Server::State::Starting)
        whenSettled([=] { withServer(uri, ask, cannot); });
    else if (m_documents.contains(uri) && m_server.isReady())
        ask();
    else
        cannot();
}

void Session::serverChanged(Server::State state, const QString &text)
{
    emit stateChanged(state, text);
    if (state == Server::State::Starting)
        return;
    for (auto each = m_documents.begin(); each != m_documents.end(); ++each) {
        each.value()->inspecting = false;
        each.value()->inspectedVersion = -1;
    }
    // A server that is ready gets the drawings first, then the requests that have waited.
    if (state == Server::State::Ready) {
        sendSettings();
        for (auto each = m_documents.begin(); each != m_documents.end(); ++each)
            open(*each.value());
    }
    settled();
}

void Session::whenSettled(std::function<void()> call)
{
    m_waitingCalls += call;
}

void Session::settled()
{
    const QVector<std::function<void()>> calls = m_waitingCalls;
    m_waitingCalls.clear();
    for (const std::function<void()> &call : calls)
        call();
}

void Session::take(const QString &method, const QJsonObject &params)
{
    if (method == "window/logMessage" || method == "window/showMessage") {
        if (method == "window/showMessage" || params.value("type").toInt() <= 2)
            emit said(params.value("message").toString());
        return;
    }
    if (method != "textDocument/publishDiagnostics")
        return;
    const QString uri = params.value("uri").toString();
    const QSharedPointer<Document> document = m_documents.value(uri);
    const int version = params.value("version").toInt(-1);
    // Findings of an older version would be shown at the wrong segments.
    if (!document || version != document->drawing.version)
        return;
    document->findings.clear();
    const QJsonArray diagnostics = params.value("diagnostics").toArray();
    for (const QJsonValue &each : diagnostics)
        document->findings += findingFromJson(each.toObject());
    emit found(uri, version, document->findings);
    askSettings(uri);
    if (document->watched)
        inspect(uri);
}

/// A change of settings, also in wedm.toml, is followed by new findings, so the settings are asked for with each of these.
void Session::askSettings(const QString &uri)
{
    m_server.connection().request("wedm/settings", uriOnly(uri), [this, uri](const Answer &answer) {
        if (answer.failed)
            return;
        const QJsonObject result = answer.result.toObject();
        InForce settings;
        const QJsonArray corrections = result.value("corrections").toArray();
        for (const QJsonValue &each : corrections)
            settings.corrections += each.toDouble();
        settings.from = result.value("correctionFrom").toString();
        settings.side = result.value("side").toString();
        settings.sideFrom = result.value("sideFrom").toString();
        settings.unitsToMm = result.value("unitsToMm").toDouble(1);
        settings.unitsFrom = result.value("unitsFrom").toString();
        settings.file = result.value("file").toString();
        emit settingsInForce(uri, settings);
    });
}

void Session::answer(const QJsonValue &id, const QString &method, const QJsonObject &params)
{
    if (method == "wedm/resendDrawing") {
        const QSharedPointer<Document> document = m_documents.value(params.value("uri").toString());
        if (document) {
            m_server.connection().reply(id, "{\"drawing\":" + toJson(document->drawing) + "}");
            return;
        }
    }
    if (method == "window/workDoneProgress/create" || method == "client/registerCapability") {
        m_server.connection().reply(id, "null");
        return;
    }
    m_server.connection().replyUnknown(id, method);
}

void Session::open(Document &document)
{
    if (document.drawing.version == 0)
        return;
    m_server.connection().notify("wedm/didOpenDrawing", "{\"drawing\":" + toJson(document.drawing) + "}");
}

void Session::sendSettings()
{
    const QJsonObject params{{"settings", QJsonObject{{"wedm", m_settings}}}};
    m_server.connection().notify("workspace/didChangeConfiguration", compact(params));
}

void Session::inspect(const QString &uri)
{
    const QSharedPointer<Document> document = m_documents.value(uri);
    if (!document || !m_server.isReady() || !document->watched)
        return;
    if (document->inspecting) {
        document->stale = true;
        return;
    }
    document->inspecting = true;
    document->stale = false;
    const int version = document->drawing.version;
    QElapsedTimer clock;
    clock.start();
    m_server.connection().request("wedm/inspect", uriOnly(uri), [this, uri, version, clock](const Answer &answer) {
        const QSharedPointer<Document> document = m_documents.value(uri);
        if (!document || answer.code == Connection::ENDED)
            return;
        if (!answer.failed) {
            document->inspectedVersion = version;
            const QSharedPointer<Inspection> inspection(new Inspection(inspectionFromJson(answer.result.toObject())));
            if (version == document->drawing.version)
                emit inspected(uri, version, inspection);
        }
        const int rest = qMax(SHORTEST_REST, int(clock.elapsed()) * REST);
        QTimer::singleShot(rest, this, [this, uri] {
            const QSharedPointer<Document> document = m_documents.value(uri);
            if (!document)
                return;
            document->inspecting = false;
            if (document->stale || document->inspectedVersion != document->drawing.version)
                inspect(uri);
        });
    });
}

void Session::takeRepair(const QString &uri, const QJsonArray &actions)
{
    QJsonObject chosen;
    for (const QJsonValue &each : actions) {
        const QJsonObject action = each.toObject();
        if (chosen.isEmpty() || action.value("isPreferred").toBool())
            chosen = action;
        if (action.value("isPreferred").toBool())
            break;
    }
    if (chosen.isEmpty()) {
        emit repairFailed(uri, tr("There is nothing that can be repaired safely; nothing was changed."));
        return;
    }
    const QJsonObject edit = chosen.value("command").toObject().value("arguments").toArray().at(0).toObject();
    const QSharedPointer<Document> document = m_documents.value(uri);
    if (!document || edit.value("version").toInt(-1) != document->drawing.version) {
        emit repairFailed(uri, tr("The drawing has changed while the repair was on its way; nothing was changed. Ask for it again."));
        return;
    }
    QString failure;
    const QVector<Change> changes = changesFromJson(edit.value("changes").toArray(), &failure);
    Drawing after;
    if (failure.isEmpty())
        after = applied(document->drawing, changes, &failure);
    if (!failure.isEmpty()) {
        emit repairFailed(uri, tr("The repair does not fit the drawing: %1. Nothing was changed.").arg(failure));
        return;
    }
    Repair repair;
    repair.uri = uri;
    repair.version = document->drawing.version;
    // Of all repairs at once the server says how many they are, and how much is left.
    const QString said = chosen.value("data").toObject().value("said").toString();
    repair.title = said.isEmpty() ? chosen.value("title").toString() : said;
    repair.before = document->drawing.entities;
    repair.after = after.entities;
    emit repairReady(repair);
}

} // namespace wedm
