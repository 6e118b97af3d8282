// SPDX-License-Identifier: GPL-2.0-or-later
// Sessions of the core with the real server.
#include "core/kept_hole.h"
#include "plates.h"
#include "talk.h"
#include "unit.h"

#include <QJsonArray>
#include <QTemporaryDir>
#include <QUrl>
#include <QtTest>

#include <cmath>

using namespace wedm;

namespace {

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

} // namespace

class SessionTests : public QObject {
    Q_OBJECT
private slots:
    void initTestCase()
    {
        registerSessionTypes();
        QVERIFY2(QFileInfo(serverProgram()).isExecutable(), "WEDM names no program");
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

    /// Of corners that one finding stands for, the one that is asked for is repaired.
    void oneOfSeveralCorners()
    {
        Talk talk;
        talk.start();
        talk.session.setSettings(QJsonObject{{"side", "opening"}});
        talk.session.look("librecad:1", {polyline(1, {{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}})}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.rules().filter("sharp-corner").size(), 1, LONG);
        for (int segment = 0; segment < 4; ++segment) {
            talk.session.requestRepair("librecad:1", "1", segment);
            QTRY_COMPARE_WITH_TIMEOUT(talk.repairs.size() + talk.noRepairs.size(), segment + 1, LONG);
            QVERIFY2(talk.noRepairs.isEmpty(), qPrintable(talk.noRepairs.value(0).value(1).toString()));
            const QVector<Vertex> after = talk.repairs.last().at(0).value<Repair>().after.at(0).vertices;
            const Vertex corner = QVector<Vertex>{{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}}.at(segment);
            QVERIFY2(std::none_of(after.begin(), after.end(), [&](const Vertex &each) { return each.x == corner.x && each.y == corner.y; }), qPrintable(QString::number(segment)));
        }
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
        talk.session.ask(1, "librecad:1", "wedm/generate", {{"format", "3b"}});
        QTRY_COMPARE_WITH_TIMEOUT(talk.refusals.size(), 1, LONG);
        QVERIFY(talk.refusal().findings.join(' ').contains("0.080"));
        talk.session.look("librecad:1", {polyline(1, opening(0.3))}, Units::Millimetre);
        talk.session.ask(2, "librecad:1", "wedm/generate", {{"format", "3b"}});
        QTRY_COMPARE_WITH_TIMEOUT(talk.refusals.size(), 2, LONG);
        QVERIFY2(talk.refusal().needsSide() && !talk.refusal().needsPair(), qPrintable(talk.refusal().reason));
        talk.session.ask(3, "librecad:1", "wedm/pair", {{"format", "3b"}});
        QTRY_COMPARE_WITH_TIMEOUT(talk.refusals.size(), 3, LONG);
        QVERIFY2(talk.refusal().needsPair() && !talk.refusal().needsSide(), qPrintable(talk.refusal().reason));
        talk.session.ask(4, "librecad:1", "wedm/fit", {});
        QTRY_COMPARE_WITH_TIMEOUT(talk.refusals.size(), 4, LONG);
        QVERIFY2(talk.refusal().needsPair(), qPrintable(talk.refusal().reason));

        QFile old(path);
        QVERIFY(old.open(QIODevice::WriteOnly));
        old.write("what was there before");
        old.close();
        talk.session.ask(5, "librecad:1", "wedm/generate", {{"format", "3b"}, {"options", QJsonObject{{"side", "opening"}}}});
        QTRY_COMPARE_WITH_TIMEOUT(talk.answers.size() + talk.refusals.size(), 5, LONG);
        QVERIFY2(talk.answers.size() == 1, qPrintable(talk.refusal().reason));
        QCOMPARE(talk.answers.last().at(0).toInt(), 5);
        const Program program = programFromJson(talk.answer(), "3b");
        QVERIFY2(program.text.contains("GXL") && program.text.trimmed().endsWith("DD"), program.text.constData());
        QCOMPARE(writeFile(path, program.text), QString());
        QFile file(path);
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(file.readAll(), program.text);
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList{"plate.3b"});
        QVERIFY(!writeFile(folder.filePath("no/such/folder/plate.3b"), program.text).isEmpty());
        QCOMPARE(writeFile(path, QByteArray()), QString("the server sent none"));
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
        Talk talk;
        talk.start();
        const QJsonObject electrode{{"toolDiameter", 0.2}, {"gap", 0.05}, {"layer", 0.05}, {"depth", 0.2}, {"wear", 0.0001}};
        talk.session.setSettings(QJsonObject{{"side", "opening"}, {"correction", 0.1}, {"milling", electrode}});
        talk.session.look("librecad:1", {polyline(1, opening(0.3))}, Units::Millimetre);
        talk.session.ask(1, "librecad:1", "wedm/generate", {{"format", format}});
        QTRY_COMPARE_WITH_TIMEOUT(talk.answers.size() + talk.refusals.size(), 1, LONG);
        QVERIFY2(talk.answers.size() == 1, qPrintable(talk.refusal().reason));
        const Program written = programFromJson(talk.answer(), format);
        QCOMPARE(written.format, format);
        QVERIFY(written.cut > 50 && written.jumps == 0);
        QCOMPARE(written.layers, format == "milling" ? 4 : 0);
        QVERIFY(written.floorMost >= written.floorLeast && (written.floorLeast > 0.1) == (format == "milling"));
        QVERIFY2(written.text.contains(holds), written.text.constData());
    }

    /// Every piece of the path begins where the one before it ends, and what is not refused can be drawn.
    void pathOfTheWire()
    {
        Talk talk;
        talk.start();
        talk.session.look("librecad:1", {polyline(1, opening(0.3))}, Units::Millimetre);
        talk.session.requestToolpath("librecad:1", {});
        QTRY_COMPARE_WITH_TIMEOUT(talk.noPaths.size(), 1, LONG);
        QVERIFY(talk.noPaths.last().at(1).value<Refusal>().needsSide());
        talk.session.setSettings(QJsonObject{{"side", "opening"}});
        talk.session.requestToolpath("librecad:1", {});
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
        talk.session.requestToolpath(uri, {});
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

    /// 20,000 vertices: one that moves goes out as one vertex, and its fault comes back.
    void large()
    {
        QVector<Vertex> vertices;
        const int count = 20000;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * M_PI * i / count;
            vertices += Vertex{100 * std::cos(angle), 100 * std::sin(angle), 0};
        }
        Talk talk;
        talk.start();
        talk.session.look("librecad:1", {polyline(1, vertices)}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 1, LONG);
        vertices[1000].bulge = -0.9; // an arc of R 0.016 mm
        talk.session.look("librecad:1", {polyline(2, vertices)}, Units::Millimetre);
        QTRY_COMPARE_WITH_TIMEOUT(talk.version(), 2, LONG);
        QVERIFY2(talk.rules().contains("small-radius 1/1000"), qPrintable(talk.rules().mid(0, 5).join(' ')));
    }
};

QObject *sessionTests()
{
    return new SessionTests;
}

#include "sessions.moc"
