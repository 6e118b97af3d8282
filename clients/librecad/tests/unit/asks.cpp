// SPDX-License-Identifier: GPL-2.0-or-later
// What is asked of a session beside programs: the parts of a pair, figures, the server's program run by itself.
#include "plates.h"
#include "talk.h"
#include "unit.h"

#include <QJsonArray>
#include <QTemporaryDir>
#include <QtTest>

#include <cmath>

using namespace wedm;

class AskTests : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { registerSessionTypes(); }

    void partsOfAPair()
    {
        Talk talk;
        talk.start();
        // Sharp corners would bind.
        talk.session.look("librecad:1", {circle(1, 5, 5, 4)}, Units::Millimetre);
        const QJsonObject options{{"pair", QJsonObject{{"drawnAs", "punch"}, {"clearance", 0.02}}}, {"wireDiameter", 0.18}, {"gap", 0.01}};
        talk.session.ask(1, "librecad:1", "wedm/pair", {{"format", "3b"}, {"options", options}});
        QTRY_COMPARE_WITH_TIMEOUT(talk.answers.size() + talk.refusals.size(), 1, LONG);
        QVERIFY2(talk.answers.size() == 1, qPrintable(talk.refusal().reason));
        const QJsonArray programs = talk.answer().value("programs").toArray();
        QCOMPARE(programs.size(), 2);
        const Program punch = programFromJson(programs.at(0).toObject(), "3b");
        const Program plate = programFromJson(programs.at(1).toObject(), "3b");
        QCOMPARE(punch.part + ' ' + plate.part, QString("punch plate"));
        QVERIFY(std::abs(punch.corrections.at(0) - 0.1) < 1e-9 && std::abs(plate.corrections.at(0) - 0.08) < 1e-9);
        QVERIFY(punch.text.endsWith("DD\n") && plate.text.endsWith("DD\n") && punch.text != plate.text);
    }

    void filesOfParts()
    {
        QCOMPARE(partFile("washer", "punch", "3b"), QString("washer-punch.3b"));
        QCOMPARE(partFile("washer", "upper/half 2", "iso"), QString("washer-upper_half_2.iso"));
        QCOMPARE(partFile("a", QStringLiteral("凸模"), "4b"), QStringLiteral("a-凸模.4b"));
    }

    /// In mm, whatever the drawing is in, and without times while nothing says how fast it is cut.
    void figuresOfADrawing()
    {
        Talk talk;
        talk.start();
        const double inch = 25.4;
        Entity hole = circle(2, 10, 5, 2);
        hole.layer = "HOLES";
        talk.session.look("librecad:1", {polyline(1, opening(0.3)), hole}, Units::Inch);
        talk.session.requestFigures("librecad:1");
        QTRY_COMPARE_WITH_TIMEOUT(talk.figures.size() + talk.noFigures.size(), 1, LONG);
        Figures figures = talk.figures.value(0).value(1).value<Figures>();
        QVERIFY2(figures.noPath.contains("side of contour"), qPrintable(figures.noPath));
        QVERIFY(figures.works.isEmpty());

        talk.session.setSettings(QJsonObject{{"side", "auto"}, {"wireDiameter", 0.18}, {"gap", 0.01}});
        talk.session.requestFigures("librecad:1");
        QTRY_COMPARE_WITH_TIMEOUT(talk.figures.size() + talk.noFigures.size(), 2, LONG);
        figures = talk.figures.value(1).value(1).value<Figures>();
        QCOMPARE(figures.contours.size(), 2);
        const ContourFigures outer = figures.contours.at(0);
        const ContourFigures inner = figures.contours.at(1);
        QCOMPARE(outer.layer + ' ' + inner.layer, QString("DIE HOLES"));
        QCOMPARE(outer.role + ' ' + inner.role, QString("punch opening"));
        QVERIFY(outer.closed && outer.segments == 5 && inner.segments == 1);
        QCOMPARE(QString::number(inner.length, 'f', 6), QString::number(2 * M_PI * 2 * inch, 'f', 6));
        QCOMPARE(QString::number(inner.area, 'f', 6), QString::number(M_PI * 4 * inch * inch, 'f', 6));
        QVERIFY(std::abs(outer.leastRadius - 0.3 * inch) < 1e-6);
        // A circle reaches beyond the point at which it starts and ends.
        QVERIFY(std::abs(inner.least.x() - 8 * inch) < 1e-9 && std::abs(inner.most.y() - 7 * inch) < 1e-9);
        QVERIFY(std::abs(outer.most.x() - 20 * inch) < 1e-9 && std::abs(outer.least.y()) < 1e-9);
        // What lies within is cut first.
        QCOMPARE(inner.order, 1);
        QCOMPARE(outer.order, 2);
        QCOMPARE(figures.works.size(), 1);
        const Work work = figures.works.at(0);
        QVERIFY(std::abs(work.cut - outer.cut - inner.cut) < 1e-6 && outer.cut > outer.length && work.jumps > 0);
        QVERIFY(work.minutes < 0 && work.missing.contains("job.thickness"));
        QVERIFY(figures.largestWire > 1);

        talk.session.setSettings(QJsonObject{{"side", "auto"}, {"job", QJsonObject{{"thickness", 20}}}, {"passes", QJsonObject{{"rates", QJsonArray{60}}}}});
        talk.session.requestFigures("librecad:1");
        QTRY_COMPARE_WITH_TIMEOUT(talk.figures.size() + talk.noFigures.size(), 3, LONG);
        figures = talk.figures.value(2).value(1).value<Figures>();
        QVERIFY(figures.works.at(0).minutes > 0 && figures.contours.at(0).minutes > 0);
        QCOMPARE(QString::number(figures.works.at(0).minutes, 'f', 6), QString::number(figures.contours.at(0).minutes + figures.contours.at(1).minutes, 'f', 6));
    }

    /// The program runs beside the server; what it says when it fails is handed on.
    void programByItself()
    {
        QTemporaryDir folder;
        Talk talk;
        talk.session.run(1, {"report"}, folder.path());
        QCOMPARE(talk.runs.size(), 1);
        QCOMPARE(talk.runs.at(0).at(1).toInt(), -1);
        talk.start();
        talk.session.run(2, {"report", "--output", "pages", "--", "no such.dxf"}, folder.path());
        QTRY_COMPARE_WITH_TIMEOUT(talk.runs.size(), 2, LONG);
        QCOMPARE(talk.runs.at(1).at(0).toInt(), 2);
        QVERIFY(talk.runs.at(1).at(1).toInt() > 0);
        QVERIFY2(talk.runs.at(1).at(2).toString().contains("no such.dxf"), qPrintable(talk.runs.at(1).at(2).toString()));
    }
};

QObject *askTests()
{
    return new AskTests;
}

#include "asks.moc"
