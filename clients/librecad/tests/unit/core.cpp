// SPDX-License-Identifier: GPL-2.0-or-later
// The core without a server: framing, differences, the messages of a drawing, the search for the server's program.
#include "core/difference.h"
#include "core/frame.h"
#include "core/messages.h"
#include "core/program_search.h"
#include "core/session.h"
#include "plates.h"
#include "unit.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>

using namespace wedm;

namespace {

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

} // namespace

class CoreTests : public QObject {
    Q_OBJECT
private slots:
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
};

QObject *coreTests()
{
    return new CoreTests;
}

#include "core.moc"
