// SPDX-License-Identifier: GPL-2.0-or-later
// The core apart from LibreCAD: framing, differences, messages, the search for the server, and sessions with the real one.
#include "core/connection.h"
#include "core/difference.h"
#include "core/kept_hole.h"
#include "core/session.h"

#include <QJsonArray>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QUrl>
#include <QtTest>

#include <algorithm>
#include <csignal>

using namespace wedm;

namespace {

/// A busy machine may be slow; a test that waits so long has failed.
constexpr int LONG = 90000;

QString serverProgram()
{
    return qEnvironmentVariable("WEDM");
}

Entity polyline(quint64 identity, const QVector<Vertex> &vertices, const QString &layer = "DIE")
{
    Entity entity;
    entity.identity = identity;
    entity.layer = layer;
    entity.kind = Kind::Polyline;
    entity.closed = true;
    entity.vertices = vertices;
    return entity;
}

Entity line(quint64 identity, Vertex start, Vertex end)
{
    Entity entity;
    entity.identity = identity;
    entity.layer = "DIE";
    entity.kind = Kind::Line;
    entity.vertices = {start, end};
    return entity;
}

Entity arc(quint64 identity, double x, double y, double radius, double startAngle, double endAngle)
{
    Entity entity;
    entity.identity = identity;
    entity.layer = "DIE";
    entity.kind = Kind::Arc;
    entity.x = x;
    entity.y = y;
    entity.radius = radius;
    entity.startAngle = startAngle;
    entity.endAngle = endAngle;
    return entity;
}

const double QUARTER = 0.41421356237309503; // tan(90° / 4)

/// A 20 × 10 opening of which the corner at 20, 0 has a fillet of `radius`.
QVector<Vertex> opening(double radius)
{
    return {{0, 0, 0}, {20 - radius, 0, QUARTER}, {20, radius, 0}, {20, 10, 0}, {0, 10, 0}};
}

double radiusOf(const QVector<Vertex> &vertices)
{
    for (int i = 0; i < vertices.size(); ++i) {
        const double bulge = vertices.at(i).bulge;
        const Vertex &a = vertices.at(i);
        const Vertex &b = vertices.at((i + 1) % vertices.size());
        if (bulge != 0)
            return std::hypot(b.x - a.x, b.y - a.y) * (1 + bulge * bulge) / (4 * std::abs(bulge));
    }
    return 0;
}

QStringList described(const QVector<Change> &changes)
{
    QStringList result;
    for (const Change &change : changes) {
        if (change.what == Change::What::Splice)
            result += QStringLiteral("%1: %2 at %3 for %4").arg(change.handle).arg(change.insert.size()).arg(change.start).arg(change.deleteCount);
        else
            result += change.handle + (change.what == Change::What::Put ? ": put" : ": gone");
    }
    return result;
}

/// A session with the signals that it has sent.
struct Talk {
    Session session;
    QSignalSpy states{&session, &Session::stateChanged};
    QSignalSpy started{&session, &Session::serverStarted};
    QSignalSpy found{&session, &Session::found};
    QSignalSpy inspected{&session, &Session::inspected};
    QSignalSpy repairs{&session, &Session::repairReady};
    QSignalSpy noRepairs{&session, &Session::repairFailed};
    QSignalSpy programs{&session, &Session::generated};
    QSignalSpy noPrograms{&session, &Session::generateFailed};
    QSignalSpy paths{&session, &Session::toolpathReady};
    QSignalSpy noPaths{&session, &Session::toolpathFailed};
    QSignalSpy contours{&session, &Session::contourFound};
    QSignalSpy confirmed{&session, &Session::holeConfirmed};

    void start(const QString &program = serverProgram())
    {
        ProgramSearch search;
        search.setting = program;
        session.start(search);
    }
    Server::State state() const { return states.isEmpty() ? Server::State::Stopped : states.last().at(0).value<Server::State>(); }
    bool hasWaited() const
    {
        return std::any_of(states.begin(), states.end(), [](const QList<QVariant> &each) { return each.at(0).value<Server::State>() == Server::State::Waiting; });
    }
    QString text() const { return states.isEmpty() ? QString() : states.last().at(1).toString(); }
    QStringList rules() const
    {
        QStringList result;
        if (found.isEmpty())
            return {"nothing came"};
        for (const Finding &finding : found.last().at(2).value<QVector<Finding>>())
            if (finding.severity <= Severity::Warning)
                result += QStringLiteral("%1 %2/%3").arg(finding.rule, finding.handle).arg(finding.segment);
        return result;
    }
    int version() const { return found.isEmpty() ? -1 : found.last().at(1).toInt(); }
};

/// A program of this text.
QString program(const QTemporaryDir &folder, const QByteArray &script)
{
    const QString path = folder.filePath("wedm");
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly))
        return QString();
    file.write(script);
    file.close();
    file.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    return path;
}

/// A program that answers the first message with `answer` and then reads on.
QString fakeServer(const QTemporaryDir &folder, const QByteArray &answer)
{
    const QByteArray reply = "printf 'Content-Length: " + QByteArray::number(answer.size()) + "\\r\\n\\r\\n%s' '" + answer + "'\n";
    return program(folder, "#!/bin/sh\nread header\n" + reply + "exec cat >/dev/null\n");
}

} // namespace

class Unit : public QObject {
    Q_OBJECT
private slots:
    void initTestCase()
    {
        registerSessionTypes();
        QVERIFY2(QFileInfo(serverProgram()).isExecutable(), "WEDM names no program");
    }

    void framing_data()
    {
        QTest::addColumn<QByteArrayList>("pieces");
        QTest::addColumn<QByteArrayList>("bodies");
        QTest::addColumn<bool>("sound");
        QTest::newRow("one") << QByteArrayList{frame("{}")} << QByteArrayList{"{}"} << true;
        QTest::newRow("two at once") << QByteArrayList{frame("{}") + frame("[]")} << QByteArrayList{"{}", "[]"} << true;
        QByteArrayList bytes;
        for (char byte : frame("\xc3\xa4"))
            bytes += QByteArray(1, byte);
        QTest::newRow("byte by byte, bytes not characters") << bytes << QByteArrayList{"\xc3\xa4"} << true;
        QTest::newRow("other headers, other case")
            << QByteArrayList{"content-type: x\r\ncontent-length:2\r\n\r\n{}"} << QByteArrayList{"{}"} << true;
        QTest::newRow("half a body") << QByteArrayList{"Content-Length: 5\r\n\r\n{}"} << QByteArrayList{} << true;
        QTest::newRow("no length") << QByteArrayList{"Hello\r\n\r\n{}"} << QByteArrayList{} << false;
        QTest::newRow("negative") << QByteArrayList{"Content-Length: -1\r\n\r\n"} << QByteArrayList{} << false;
        QTest::newRow("too large") << QByteArrayList{"Content-Length: 99999999999\r\n\r\n"} << QByteArrayList{} << false;
        QTest::newRow("no header at all") << QByteArrayList{QByteArray(9000, 'x')} << QByteArrayList{} << false;
    }
    void framing()
    {
        QFETCH(QByteArrayList, pieces);
        QFETCH(QByteArrayList, bodies);
        QFETCH(bool, sound);
        FrameReader reader;
        QByteArrayList got;
        for (const QByteArray &piece : pieces)
            got += reader.feed(piece);
        QCOMPARE(got, bodies);
        QCOMPARE(reader.damage().isEmpty(), sound);
    }

    void differences_data()
    {
        QTest::addColumn<QVector<Entity>>("before");
        QTest::addColumn<QVector<Entity>>("after");
        QTest::addColumn<QStringList>("expected");
        const QVector<Vertex> vertices = opening(0.08);
        QVector<Vertex> moved = vertices;
        moved[3].x = 21;
        QVector<Vertex> noisy = vertices;
        noisy[1].bulge += 1e-14;
        noisy[2].x -= 3e-15;
        QVector<Vertex> longer = vertices;
        longer.insert(4, Vertex{10, 11, 0});
        const Entity edge = line(7, {0, 0, 0}, {5, 0, 0});
        QTest::newRow("the same") << QVector<Entity>{polyline(1, vertices)} << QVector<Entity>{polyline(1, vertices)} << QStringList{};
        QTest::newRow("only noise") << QVector<Entity>{polyline(1, vertices)} << QVector<Entity>{polyline(2, noisy)} << QStringList{};
        QTest::newRow("a vertex moved in place")
            << QVector<Entity>{polyline(1, vertices)} << QVector<Entity>{polyline(1, moved)} << QStringList{"1: 1 at 3 for 1"};
        QTest::newRow("replaced by the host under another number, behind others")
            << QVector<Entity>{polyline(1, vertices), edge} << QVector<Entity>{edge, polyline(9, moved)} << QStringList{"1: 1 at 3 for 1"};
        QTest::newRow("a vertex more") << QVector<Entity>{polyline(1, vertices)} << QVector<Entity>{polyline(2, longer)}
                                       << QStringList{"1: 1 at 4 for 0"};
        QTest::newRow("a line dragged at one end") << QVector<Entity>{edge} << QVector<Entity>{line(8, {0, 0, 0}, {6, 0, 0})} << QStringList{"1: put"};
        QTest::newRow("a line gone, one elsewhere come")
            << QVector<Entity>{edge} << QVector<Entity>{line(8, {50, 50, 0}, {60, 50, 0})} << QStringList{"1: gone", "2: put"};
        QTest::newRow("another layer") << QVector<Entity>{polyline(1, vertices)} << QVector<Entity>{polyline(1, vertices, "PUNCH")}
                                       << QStringList{"1: put"};
        QTest::newRow("an arc of another radius") << QVector<Entity>{arc(3, 1, 1, 0.08, 0, 90)} << QVector<Entity>{arc(4, 1, 1, 0.2, 0, 90)}
                                                  << QStringList{"1: put"};
        QTest::newRow("all gone") << QVector<Entity>{polyline(1, vertices), edge} << QVector<Entity>{} << QStringList{"1: gone", "2: gone"};
    }
    void differences()
    {
        QFETCH(QVector<Entity>, before);
        QFETCH(QVector<Entity>, after);
        QFETCH(QStringList, expected);
        HandleGiver handles;
        Drawing known;
        known.entities = difference({}, before, handles).entities;
        const Difference found = difference(known.entities, after, handles);
        QCOMPARE(described(found.changes), expected);
        // What the server makes of the changes is what was seen.
        QString failure;
        const Drawing there = applied(known, found.changes, &failure);
        QCOMPARE(failure, QString());
        QCOMPARE(there.entities.size(), found.entities.size());
        for (int i = 0; i < there.entities.size(); ++i) {
            QCOMPARE(there.entities.at(i).handle, found.entities.at(i).handle);
            QVERIFY(alike(there.entities.at(i), found.entities.at(i)));
        }
    }

    /// Undo brings the old entity back under its old number, and redo the new one: the handle stays the same all the way.
    void handleSurvivesUndo()
    {
        HandleGiver handles;
        QVector<Vertex> moved = opening(0.08);
        moved[3].x = 21;
        QVector<Entity> known = difference({}, {polyline(1, opening(0.08))}, handles).entities;
        const QVector<Entity> steps{polyline(2, moved), polyline(1, opening(0.08)), polyline(2, moved)};
        for (const Entity &step : steps) {
            known = difference(known, {step}, handles).entities;
            QCOMPARE(known.at(0).handle, QString("1"));
        }
    }

    /// Deleted and brought back: the same handle; copied: another one.
    void handleOfWhatComesBack()
    {
        HandleGiver handles;
        QVector<Entity> known = difference({}, {polyline(1, opening(0.08))}, handles).entities;
        known = difference(known, {}, handles).entities;
        known = difference(known, {polyline(1, opening(0.08)), polyline(5, opening(0.08))}, handles).entities;
        QCOMPARE(known.at(0).handle, QString("1"));
        QCOMPARE(known.at(1).handle, QString("2"));
    }

    void changesThatDoNotApply_data()
    {
        QTest::addColumn<QString>("json");
        QTest::newRow("no such handle") << R"([{"handle":"9","vertices":{"start":0,"deleteCount":0,"insert":[[0,0]]}}])";
        QTest::newRow("out of range") << R"([{"handle":"1","vertices":{"start":4,"deleteCount":2,"insert":[]}}])";
        QTest::newRow("negative") << R"([{"handle":"1","vertices":{"start":-1,"deleteCount":1,"insert":[]}}])";
        QTest::newRow("no number") << R"([{"handle":"1","vertices":{"start":0,"deleteCount":1,"insert":[["a",0]]}}])";
        QTest::newRow("half a vertex") << R"([{"handle":"1","vertices":{"start":0,"deleteCount":1,"insert":[[1]]}}])";
        QTest::newRow("no handle") << R"([{"entity":null}])";
        QTest::newRow("radius 0") << R"([{"handle":"1","entity":{"type":"circle","center":[0,0],"radius":0}}])";
        QTest::newRow("unknown kind") << R"([{"handle":"1","entity":{"type":"spline"}}])";
        QTest::newRow("before nothing")
            << R"([{"handle":"5","before":"8","entity":{"handle":"5","type":"line","start":[0,0],"end":[1,1]}}])";
        QTest::newRow("the second one") << R"([{"handle":"1","entity":null},{"handle":"1","entity":null}])";
    }
    void changesThatDoNotApply()
    {
        QFETCH(QString, json);
        HandleGiver handles;
        Drawing known;
        known.entities = difference({}, {polyline(1, opening(0.08))}, handles).entities;
        QString failure;
        const QVector<Change> changes = changesFromJson(QJsonDocument::fromJson(json.toUtf8()).array(), &failure);
        const Drawing result = failure.isEmpty() ? applied(known, changes, &failure) : known;
        QVERIFY(!failure.isEmpty());
        QCOMPARE(result.entities.size(), 1);
        QVERIFY(alike(result.entities.at(0), known.entities.at(0)));
    }

    /// Numbers go out so that they come back the same to the last bit; names with quotes and umlauts survive.
    void drawingAsJson()
    {
        Drawing drawing;
        drawing.uri = "librecad:1/\"ä\"";
        drawing.version = 3;
        drawing.units = Units::Inch;
        drawing.entities = {polyline(1, {{0.1, 1.0 / 3, QUARTER}, {-1e-7, 1e9 + 1.0 / 7, 0}}, "Umriß \\ \"1\"")};
        drawing.entities[0].handle = "1";
        const QJsonObject back = QJsonDocument::fromJson(toJson(drawing)).object();
        QCOMPARE(back.value("uri").toString(), drawing.uri);
        QCOMPARE(back.value("units").toString(), QString("inch"));
        const QJsonObject entity = back.value("entities").toArray().at(0).toObject();
        QCOMPARE(entity.value("layer").toString(), drawing.entities.at(0).layer);
        const QJsonArray first = entity.value("vertices").toArray().at(0).toArray();
        const QJsonArray second = entity.value("vertices").toArray().at(1).toArray();
        QVERIFY(first.at(0).toDouble() == 0.1 && first.at(1).toDouble() == 1.0 / 3 && first.at(2).toDouble() == QUARTER);
        QVERIFY(second.at(0).toDouble() == -1e-7 && second.at(1).toDouble() == 1e9 + 1.0 / 7 && second.size() == 2);
    }

    void search()
    {
        QTemporaryDir beside;
        QTemporaryDir path;
        QTemporaryDir home;
        const QByteArray oldPath = qgetenv("PATH");
        const QByteArray oldHome = qgetenv("HOME");
        qputenv("PATH", path.path().toLocal8Bit());
        qputenv("HOME", home.path().toLocal8Bit());
        const auto look = [&](const QString &setting) {
            QString message;
            const QString found = findProgram({setting, beside.path()}, &message);
            return found.isEmpty() ? message : found;
        };
        const QString nowhere = look("");
        // A relative folder of PATH depends on where LibreCAD was started.
        const QString workedIn = QDir::currentPath();
        QDir::setCurrent(path.path());
        QDir(path.path()).mkpath("bin");
        QFile::copy("/bin/true", path.filePath("bin/wedm"));
        qputenv("PATH", "bin:./bin::" + path.path().toLocal8Bit());
        const QString relative = look("");
        QDir::setCurrent(workedIn);
        const QString ofCargo = home.filePath(".cargo/bin/wedm");
        QDir(home.path()).mkpath(".cargo/bin");
        QDir(beside.path()).mkpath("wedm-server");
        const QStringList places{ofCargo, path.filePath("wedm"), beside.filePath("wedm"), beside.filePath("wedm-server/wedm")};
        QStringList found;
        for (const QString &place : places) {
            QFile::copy("/bin/true", place);
            found += look("");
        }
        const QString wrong = look("/no/such/wedm");
        const QString set = look("/bin/true");
        qputenv("PATH", oldPath);
        qputenv("HOME", oldHome);
        QCOMPARE(found, places);
        QCOMPARE(set, QString("/bin/true"));
        QCOMPARE(relative, nowhere);
        QVERIFY2(nowhere.contains("cargo install") && nowhere.contains(beside.path()), qPrintable(nowhere));
        QVERIFY2(wrong.contains("/no/such/wedm") && wrong.contains("cargo install"), qPrintable(wrong));
    }

    /// A polyline is opened, edited, repaired; each time the server says what it finds.
    void checkAndRepair()
    {
        Talk talk;
        talk.start();
        talk.session.look("librecad:1", {polyline(1, opening(0.3))}, Units::Millimetre);
        talk.session.watchRadii("librecad:1", true);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, LONG);
        QVERIFY(!talk.rules().join(' ').contains("small-radius"));
        talk.session.look("librecad:1", {polyline(2, opening(0.08))}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 2, LONG);
        QVERIFY2(talk.rules().contains("small-radius 1/1"), qPrintable(talk.rules().join(' ')));
        QTRY_VERIFY_WITH_TIMEOUT(!talk.inspected.isEmpty() && talk.inspected.last().at(1).toInt() == 2, LONG);
        const auto inspection = talk.inspected.last().at(2).value<QSharedPointer<Inspection>>();
        QCOMPARE(inspection->rows.size(), 5);
        QVERIFY(std::abs(inspection->rows.at(1).radius - 0.08) < 1e-9);
        QVERIFY(inspection->rows.at(1).verdict.contains("small-radius"));

        talk.session.requestRepair("librecad:1", "1", 1);
        QTRY_COMPARE_WITH_TIMEOUT(talk.repairs.size() + talk.noRepairs.size(), 1, LONG);
        talk.session.requestRepair("librecad:1", QString(), -1);
        QTRY_COMPARE_WITH_TIMEOUT(talk.repairs.size() + talk.noRepairs.size(), 2, LONG);
        QCOMPARE(talk.repairs.size(), 2);
        for (const QList<QVariant> &each : talk.repairs) {
            const Repair repair = each.at(0).value<Repair>();
            QCOMPARE(repair.version, 2);
            QVERIFY2(std::abs(radiusOf(repair.after.at(0).vertices) - 0.101) < 1e-6, qPrintable(repair.title));
        }
        const Repair repair = talk.repairs.last().at(0).value<Repair>();
        QVector<Entity> repaired = repair.after;
        repaired[0].identity = 3;
        talk.session.look("librecad:1", repaired, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 3, LONG);
        QVERIFY2(!talk.rules().join(' ').contains("small-radius"), qPrintable(talk.rules().join(' ')));
        talk.session.requestRepair("librecad:1", QString(), -1);
        QTRY_COMPARE_WITH_TIMEOUT(talk.noRepairs.size(), 1, LONG);
    }

    /// A contour of lines and arcs is repaired too, entity by entity.
    void chainIsRepaired()
    {
        Talk talk;
        talk.start();
        const double r = 0.08;
        const QVector<Entity> chain{line(1, {0, 0, 0}, {20 - r, 0, 0}), arc(2, 20 - r, r, r, 270, 0), line(3, {20, r, 0}, {20, 10, 0}),
                                    line(4, {20, 10, 0}, {0, 10, 0}), line(5, {0, 10, 0}, {0, 0, 0})};
        talk.session.look("librecad:1", chain, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, LONG);
        QVERIFY2(talk.rules().contains("small-radius 2/0"), qPrintable(talk.rules().join(' ')));
        talk.session.requestRepair("librecad:1", "2", 0);
        QTRY_COMPARE_WITH_TIMEOUT(talk.repairs.size(), 1, LONG);
        const Repair repair = talk.repairs.last().at(0).value<Repair>();
        QCOMPARE(repair.after.size(), 5);
        QVERIFY(std::abs(repair.after.at(1).radius - 0.101) < 1e-6);
        QVERIFY(std::abs(repair.after.at(0).vertices.at(1).x - (20 - 0.101)) < 1e-6);
        QVERIFY(std::abs(repair.after.at(2).vertices.at(0).y - 0.101) < 1e-6);
    }

    /// The drawing changes between the question and its answer: the answer is refused.
    void changedWhileTheRepairWasOnItsWay()
    {
        Talk talk;
        talk.start();
        talk.session.look("librecad:1", {polyline(1, opening(0.08))}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, LONG);
        talk.session.requestRepair("librecad:1", QString(), -1);
        talk.session.look("librecad:1", {polyline(2, opening(0.07))}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.noRepairs.size(), 1, LONG);
        QVERIFY2(talk.noRepairs.last().at(1).toString().contains("nothing was changed", Qt::CaseInsensitive),
                 qPrintable(talk.noRepairs.last().at(1).toString()));
        QCOMPARE(talk.repairs.size(), 0);
    }

    /// What is asked while the server starts is answered once it is there.
    void askedTooEarly()
    {
        Talk talk;
        talk.start();
        talk.session.look("librecad:1", {polyline(1, opening(0.08))}, Units::Millimetre);
        talk.session.requestRepair("librecad:1", QString(), -1);
        QTRY_COMPARE_WITH_TIMEOUT(talk.repairs.size(), 1, LONG);
    }

    void programIsWritten()
    {
        QTemporaryDir folder;
        const QString path = folder.filePath("plate.3b");
        Talk talk;
        talk.start();
        talk.session.look("librecad:1", {polyline(1, opening(0.08))}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, LONG);
        talk.session.generate("librecad:1", "3b", path, false);
        QTRY_COMPARE_WITH_TIMEOUT(talk.noPrograms.size(), 1, LONG);
        QVERIFY(talk.noPrograms.last().at(4).toStringList().join(' ').contains("0.080"));
        QVERIFY(!QFile::exists(path));

        QFile old(path);
        QVERIFY(old.open(QIODevice::WriteOnly));
        old.write("what was there before");
        old.close();
        talk.session.setSettings(QJsonObject{{"side", "opening"}});
        talk.session.look("librecad:1", {polyline(1, opening(0.3))}, Units::Millimetre);
        talk.session.generate("librecad:1", "3b", path, false);
        QTRY_COMPARE_WITH_TIMEOUT(talk.programs.size() + talk.noPrograms.size(), 2, LONG);
        QVERIFY2(talk.programs.size() == 1, qPrintable(talk.noPrograms.last().at(3).toString()));
        QFile file(path);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QByteArray text = file.readAll();
        QVERIFY2(text.contains("GXL") && text.trimmed().endsWith("DD"), text.constData());
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList{"plate.3b"});

        talk.session.generate("librecad:1", "3b", folder.filePath("no/such/folder/plate.3b"), false);
        QTRY_COMPARE_WITH_TIMEOUT(talk.noPrograms.size(), 2, LONG);
        QVERIFY(talk.noPrograms.last().at(3).toString().contains("no/such/folder"));
    }

    void programsOfEachFormat_data()
    {
        QTest::addColumn<QString>("format");
        QTest::addColumn<QByteArray>("holds");
        QTest::newRow("3B") << "3b" << QByteArray("GXL1");
        QTest::newRow("4B") << "4b" << QByteArray("B");
        QTest::newRow("ISO") << "iso" << QByteArray("G92");
        QTest::newRow("milling") << "milling" << QByteArray("G01 Z-0.0");
    }

    void programsOfEachFormat()
    {
        QFETCH(QString, format);
        QFETCH(QByteArray, holds);
        QTemporaryDir folder;
        const QString path = folder.filePath("plate." + format);
        Talk talk;
        talk.start();
        const QJsonObject electrode{{"toolDiameter", 0.2}, {"gap", 0.05}, {"layer", 0.05}, {"depth", 0.2}, {"wear", 0.0001}};
        talk.session.setSettings(QJsonObject{{"side", "opening"}, {"correction", 0.1}, {"milling", electrode}});
        talk.session.look("librecad:1", {polyline(1, opening(0.3))}, Units::Millimetre);
        talk.session.generate("librecad:1", format, path, false);
        QTRY_COMPARE_WITH_TIMEOUT(talk.programs.size() + talk.noPrograms.size(), 1, LONG);
        QVERIFY2(talk.programs.size() == 1, qPrintable(talk.noPrograms.value(0).value(3).toString()));
        const Program written = talk.programs.last().at(1).value<Program>();
        QCOMPARE(written.format, format);
        QVERIFY(written.cut > 50 && written.jumps == 0);
        QCOMPARE(written.layers, format == "milling" ? 4 : 0);
        QVERIFY(written.floorMost >= written.floorLeast && (written.floorLeast > 0.1) == (format == "milling"));
        QFile file(path);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QByteArray text = file.readAll();
        QVERIFY2(text.contains(holds), text.constData());
    }

    /// Every piece of the path begins where the one before it ends, and what is not refused can be drawn.
    void pathOfTheWire()
    {
        Talk talk;
        talk.start();
        talk.session.look("librecad:1", {polyline(1, opening(0.3))}, Units::Millimetre);
        talk.session.requestToolpath("librecad:1");
        QTRY_COMPARE_WITH_TIMEOUT(talk.noPaths.size(), 1, LONG);
        QVERIFY(talk.noPaths.last().at(1).toString().startsWith("There is no path of the wire: "));
        talk.session.setSettings(QJsonObject{{"side", "opening"}});
        talk.session.requestToolpath("librecad:1");
        QTRY_COMPARE_WITH_TIMEOUT(talk.paths.size(), 1, LONG);
        const Toolpath path = talk.paths.last().at(1).value<Toolpath>();
        const auto kinds = [&](Kind kind) { return std::count_if(path.pieces.begin(), path.pieces.end(), [=](const Entity &each) { return each.kind == kind; }); };
        QCOMPARE(int(kinds(Kind::Arc)), 1);
        QVERIFY(kinds(Kind::Line) >= 6);
        const auto fillet = std::find_if(path.pieces.begin(), path.pieces.end(), [](const Entity &each) { return each.kind == Kind::Arc; });
        QVERIFY(std::abs(fillet->radius - 0.2) < 1e-9 && std::abs(fillet->x - 19.7) < 1e-9);
        QVERIFY(std::abs(std::remainder(fillet->startAngle - 270, 360.0)) < 1e-6 && std::abs(std::remainder(fillet->endAngle, 360.0)) < 1e-6);
        QCOMPARE(path.holes.size(), 1);
        QVERIFY(path.cut > 50 && path.jumped == 0 && path.jumps.isEmpty());
    }

    /// A hole belongs to the nearest contour, which is kept by a point of it; the next hole of it goes by the same name.
    void holeIsKeptByAPoint()
    {
        QTemporaryDir folder;
        const QString drawing = folder.filePath("plate.dxf");
        const QString uri = QUrl::fromLocalFile(drawing).toString(QUrl::FullyEncoded);
        QFile(drawing).open(QIODevice::WriteOnly);
        Talk talk;
        talk.start();
        QVector<Vertex> other = opening(0.3);
        for (Vertex &vertex : other)
            vertex.x += 40;
        talk.session.setSettings(QJsonObject{{"side", "opening"}});
        talk.session.look(uri, {polyline(1, opening(0.3)), polyline(2, other)}, Units::Millimetre);
        talk.session.requestContour(uri, {45, 5});
        QTRY_COMPARE_WITH_TIMEOUT(talk.contours.size(), 1, LONG);
        const QString name = talk.contours.last().at(1).toString();
        // The middle of the longest side.
        QCOMPARE(name, QString("50,10"));
        KeptHole kept;
        QCOMPARE(kept.keep(QString(), drawing, name, {45, 5}), QString());
        talk.session.reloadSettings();
        talk.session.confirmHole(uri, name, {45, 5});
        QTRY_COMPARE_WITH_TIMEOUT(talk.confirmed.size(), 1, LONG);
        QVERIFY(talk.confirmed.last().at(1).toBool());
        talk.session.requestToolpath(uri);
        QTRY_COMPARE_WITH_TIMEOUT(talk.paths.size() + talk.noPaths.size(), 1, LONG);
        const Toolpath path = talk.paths.value(0).value(1).value<Toolpath>();
        QVERIFY(std::any_of(path.holes.begin(), path.holes.end(), [](const ThreadHole &hole) { return hole.at == QPointF(45, 5); }));
        QCOMPARE(path.jumps.size(), 1);
        QVERIFY(path.jumped > 0);

        // Another point of the same contour is its name from then on.
        QFile file(kept.file());
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write("side = \"opening\" # inside\n[drawings.\"plate.dxf\".contours.\"40,5\"]\nentry = [40, 5]\n");
        file.close();
        talk.session.reloadSettings();
        talk.session.requestContour(uri, {46, 5});
        QTRY_COMPARE_WITH_TIMEOUT(talk.contours.size(), 2, LONG);
        QCOMPARE(talk.contours.last().at(1).toString(), QString("40,5"));

        // A file that cannot take it becomes what it was.
        const QByteArray inLine = "drawings = { \"plate.dxf\" = { contours = { \"40,5\" = { order = 1 } } } }\n";
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(inLine);
        file.close();
        QCOMPARE(kept.keep(file.fileName(), drawing, "40,5", {46, 5}), QString());
        talk.session.reloadSettings();
        talk.session.confirmHole(uri, "40,5", {46, 5});
        QTRY_COMPARE_WITH_TIMEOUT(talk.confirmed.size(), 2, LONG);
        QVERIFY(!talk.confirmed.last().at(1).toBool());
        kept.takeBack();
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(file.readAll(), inLine);
    }

    void threadHoleInAText_data()
    {
        QTest::addColumn<QByteArray>("before");
        QTest::addColumn<QByteArray>("after");
        const QByteArray head = "[drawings.\"a.dxf\".contours.\"1,2\"]";
        QTest::newRow("an empty file") << QByteArray() << head + "\nthread = [3.5, -4]\n";
        QTest::newRow("at the end") << QByteArray("correction = 0.1") << "correction = 0.1\n\n" + head + "\nthread = [3.5, -4]\n";
        QTest::newRow("lines end as they did") << QByteArray("side = \"auto\"\r\n") << "side = \"auto\"\r\n\r\n" + head + "\r\nthread = [3.5, -4]\r\n";
        QTest::newRow("in its table") << head + " # left\norder = 1\n\n[rules]\n" << head + " # left\norder = 1\nthread = [3.5, -4]\n\n[rules]\n";
        QTest::newRow("in place of another") << head + "\nthread = [1, 1] # drilled\n" << head + "\nthread = [3.5, -4] # drilled\n";
        QTest::newRow("not that of another contour") << QByteArray("[drawings.\"a.dxf\".contours.2A]\nthread = [1, 1]\n")
                                                     << "[drawings.\"a.dxf\".contours.2A]\nthread = [1, 1]\n\n" + head + "\nthread = [3.5, -4]\n";
        QTest::newRow("not understood") << head + "\nthread = [1,\n1]\n" << QByteArray();
    }

    void threadHoleInAText()
    {
        QFETCH(QByteArray, before);
        QFETCH(QByteArray, after);
        QString failure;
        const QByteArray kept = withThread(before, "a.dxf", "1,2", {3.5, -4}, &failure);
        QCOMPARE(failure, after.isEmpty() ? QString("line 2 is not understood") : QString());
        QCOMPARE(kept, after.isEmpty() ? before : after);
    }

    /// The server is killed; a drawing that changed in the meantime is right again in the next one.
    void killedAndBackAgain()
    {
        Talk talk;
        talk.start();
        talk.session.look("librecad:1", {polyline(1, opening(0.3))}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, LONG);
        const qint64 first = talk.started.last().at(0).toLongLong();
        talk.session.requestRepair("librecad:1", QString(), -1);
        ::kill(pid_t(first), SIGKILL);
        talk.session.look("librecad:1", {polyline(2, opening(0.08))}, Units::Millimetre);
        QTRY_VERIFY_WITH_TIMEOUT(talk.hasWaited(), LONG);
        QCOMPARE(talk.noRepairs.size() + talk.repairs.size(), 1);
        talk.session.look("librecad:1", {polyline(3, opening(0.07))}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 3, LONG);
        QVERIFY(talk.started.last().at(0).toLongLong() != first);
        QVERIFY2(talk.rules().contains("small-radius 1/1"), qPrintable(talk.rules().join(' ')));
    }

    /// What every client does when its server ends.
    void restarts()
    {
        QFile file(QFINDTESTDATA("../../../restarts.json"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QJsonArray cases = QJsonDocument::fromJson(file.readAll()).object().value("cases").toArray();
        QVERIFY(!cases.isEmpty());
        for (const QJsonValue &each : cases) {
            const QJsonArray lives = each.toObject().value("lives").toArray();
            Restarts restarts;
            QJsonArray pauses;
            for (const QJsonValue &life : lives) {
                const std::optional<int> pause = restarts.afterLifeOf(qRound64(life.toDouble() * 1000));
                pauses += pause ? QJsonValue(*pause / 1000.0) : QJsonValue();
            }
            QCOMPARE(pauses, each.toObject().value("pauses").toArray());
        }
    }

    /// A server that dies at every start is given up, and tried again when the user wants it.
    void givenUp()
    {
        Talk talk;
        talk.start("/bin/false");
        QTRY_COMPARE_WITH_TIMEOUT(talk.state(), Server::State::GivenUp, LONG);
        QStringList waits;
        for (const QList<QVariant> &each : talk.states) {
            if (each.at(0).value<Server::State>() == Server::State::Waiting)
                waits += each.at(1).toString().section("again", -1);
        }
        QCOMPARE(waits, (QStringList{".", " in 0.5 s.", " in 1 s.", " in 2 s.", " in 4 s."}));
        QVERIFY2(talk.text().contains("has ended 6 times in a row (it ended with code 1)"), qPrintable(talk.text()));
        talk.session.look("librecad:1", {polyline(1, opening(0.08))}, Units::Millimetre);
        talk.start();
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, LONG);
    }

    void otherServers_data()
    {
        QTest::addColumn<QByteArray>("answer");
        QTest::addColumn<QString>("message");
        QTest::newRow("another protocol")
            << QByteArray(R"({"jsonrpc":"2.0","id":1,"result":{"serverInfo":{"name":"wedm","version":"9.1.0"},"capabilities":{"experimental":{"wedm":{"protocol":2}}}}})")
            << "wedm 9.1.0 at .* speaks protocol 2, this plugin speaks protocol 1";
        QTest::newRow("another language server")
            << QByteArray(R"({"jsonrpc":"2.0","id":1,"result":{"serverInfo":{"name":"clangd"},"capabilities":{}}})")
            << "is not a wedm server \\(it calls itself \"clangd\"\\)";
        QTest::newRow("an error") << QByteArray(R"({"jsonrpc":"2.0","id":1,"error":{"code":-32603,"message":"no room"}})") << "refuses to start: no room";
    }
    void otherServers()
    {
        QFETCH(QByteArray, answer);
        QFETCH(QString, message);
        QTemporaryDir folder;
        Talk talk;
        talk.start(fakeServer(folder, answer));
        QTRY_COMPARE_WITH_TIMEOUT(talk.state(), Server::State::Refused, LONG);
        QVERIFY2(QRegularExpression(message).match(talk.text()).hasMatch(), qPrintable(talk.text()));
        // It is not tried again until somebody asks for it.
        QTest::qWait(300);
        QCOMPARE(talk.state(), Server::State::Refused);
        talk.session.look("librecad:1", {polyline(1, opening(0.08))}, Units::Millimetre);
        talk.start(serverProgram());
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, LONG);
    }

    /// A program that sends what is no message is ended and tried again.
    void talks()
    {
        Talk talk;
        talk.start("/usr/bin/yes");
        // The first pause is none, the second one is seen.
        QTRY_VERIFY_WITH_TIMEOUT(talk.text().contains("again in 0.5 s"), LONG);
        QVERIFY2(talk.text().contains("does not speak the language server protocol"), qPrintable(talk.text()));
    }

    /// One that says nothing, or cannot be started, is not tried again by itself.
    void noServers_data()
    {
        QTest::addColumn<QByteArray>("script");
        QTest::addColumn<QString>("message");
        QTest::newRow("says nothing") << QByteArray("#!/bin/sh\nexec cat >/dev/null\n") << "does not answer: there was nothing within 3 s";
        QTest::newRow("cannot be started") << QByteArray("#!/no/such/interpreter\n") << "could not be started";
    }
    void noServers()
    {
        QFETCH(QByteArray, script);
        QFETCH(QString, message);
        QTemporaryDir folder;
        Talk talk;
        talk.session.setPatience(3000);
        talk.start(program(folder, script));
        QTRY_COMPARE_WITH_TIMEOUT(talk.state(), Server::State::Refused, LONG);
        QVERIFY2(talk.text().contains(message), qPrintable(talk.text()));
        QVERIFY(!talk.hasWaited());
    }

    void missing()
    {
        Talk talk;
        talk.start("/no/such/wedm");
        QCOMPARE(talk.state(), Server::State::Missing);
        QVERIFY2(talk.text().contains("cargo install"), qPrintable(talk.text()));
        talk.session.look("librecad:1", {polyline(1, opening(0.08))}, Units::Millimetre);
        talk.session.requestRepair("librecad:1", QString(), -1);
        QCOMPARE(talk.noRepairs.size(), 1);
        talk.start(serverProgram());
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, LONG);
    }

    /// 200,000 vertices: one that moves goes out as one vertex, and its fault comes back.
    void large()
    {
        QVector<Vertex> vertices;
        const int count = 200000;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * M_PI * i / count;
            vertices += Vertex{1000 * std::cos(angle), 1000 * std::sin(angle), 0};
        }
        Talk talk;
        talk.start();
        talk.session.look("librecad:1", {polyline(1, vertices)}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, 60000);
        vertices[1000].bulge = -0.9; // an arc of R 0.016 mm
        talk.session.look("librecad:1", {polyline(2, vertices)}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 2, 60000);
        QVERIFY2(talk.rules().contains("small-radius 1/1000"), qPrintable(talk.rules().mid(0, 5).join(' ')));
    }
};

QTEST_GUILESS_MAIN(Unit)
#include "unit.moc"
