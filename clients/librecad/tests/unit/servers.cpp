// SPDX-License-Identifier: GPL-2.0-or-later
// Servers that die, and programs that are none.
#include "plates.h"
#include "talk.h"
#include "unit.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QtTest>

#include <csignal>

using namespace wedm;

namespace {

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

class ServerTests : public QObject {
    Q_OBJECT
private slots:
    void initTestCase()
    {
        registerSessionTypes();
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
    void talks_data()
    {
        QTest::addColumn<QByteArray>("script");
        QTest::newRow("without an end") << QByteArray("exec yes");
        QTest::newRow("a body that is no JSON") << QByteArray("printf 'Content-Length: 7\\r\\n\\r\\nno json'\nexec cat >/dev/null");
        QTest::newRow("JSON that is no message") << QByteArray("printf 'Content-Length: 2\\r\\n\\r\\n42'\nexec cat >/dev/null");
    }
    void talks()
    {
        QFETCH(QByteArray, script);
        QTemporaryDir folder;
        Talk talk;
        talk.start(program(folder, "#!/bin/sh\n" + script + "\n"));
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
};

QObject *serverTests()
{
    return new ServerTests;
}

#include "servers.moc"
