// SPDX-License-Identifier: GPL-2.0-or-later
// Scenarios of days on which things are not as they should be: servers, undo and edits in the middle of an answer, a drawing that is very large.
#include "driver.h"

#include <QAction>
#include <QDialog>
#include <QSet>
#include <QSettings>
#include <QtTest>

#include <csignal>

namespace {

/// ms that a busy machine may need for 200,000 vertices.
constexpr int LONG = 240000;
/// A look of so many slices takes long enough for a key to come between.
constexpr int SLICES_TO_BREAK_OFF = 4;

/// Calls with the number of slices that a look has taken so far, at 0 when it begins, and whenever that changes.
class EachSlice : public QObject
{
public:
    EachSlice(QObject *looks, std::function<void(int)> act)
        : m_act(std::move(act))
    {
        looks->installEventFilter(this);
    }

protected:
    bool eventFilter(QObject *looks, QEvent *event) override
    {
        if (event->type() == QEvent::DynamicPropertyChange && static_cast<QDynamicPropertyChangeEvent *>(event)->propertyName() == "slices")
            m_act(looks->property("slices").toInt());
        return false;
    }

private:
    std::function<void(int)> m_act;
};

} // namespace

void Driver::missing()
{
    choose("Check radii");
    expectSoon("it is said that the server is missing", [this] { return text("wedm_server").contains("no such program"); },
               [this] { return text("wedm_server"); });
    expect("and how to get it", text("wedm_server").contains("cargo install"), text("wedm_server"));
    choose("Fix");
    expectSoon("a repair is refused", [this] { return text("wedm_message").contains("nothing was changed"); }, [this] { return text("wedm_message"); });
    QSettings settings(QSettings::IniFormat, QSettings::UserScope, "wedm", "librecad");
    settings.setValue("server", qEnvironmentVariable("WEDM"));
    settings.sync();
    choose("Check radii");
    expectSoon("once it is set right, the next check works", [this] { return verdictOf("0.0800").contains("small-radius"); },
               [this] { return text("wedm_server"); });
}

void Driver::otherVersion()
{
    choose("Check radii");
    expectSoon("the other version is named", [this] { return text("wedm_server").contains("speaks protocol 2, this plugin speaks protocol 1"); },
               [this] { return text("wedm_server"); });
    choose("Fix");
    expectSoon("a repair is refused", [this] { return text("wedm_message").contains("nothing was changed"); }, [this] { return text("wedm_message"); });
}

void Driver::killed()
{
    choose("Live check");
    expectSoon("the fault is found", [this] { return verdictOf("0.0800").contains("small-radius"); });
    const qint64 first = controller()->property("serverProcessId").toLongLong();
    expect("the server is known", first > 0);
    if (first <= 0)
        return;
    press("DrawLine");
    type("100,100");
    ::kill(pid_t(first), SIGKILL);
    type("110,100");
    press("EditKillAllActions");
    touch();
    const auto another = [this](qint64 before) { return controller()->property("serverProcessId").toLongLong() != before && text("wedm_server").startsWith("wedm "); };
    expectSoon("another one runs at once", [&] { return another(first); }, [this] { return text("wedm_server"); });
    const qint64 second = controller()->property("serverProcessId").toLongLong();
    ::kill(pid_t(second), SIGKILL);
    expectSoon("it is said that the server has ended, and when it is started again", [this] { return text("wedm_server").contains("has ended (it was killed or has crashed). It is started again in 0.5 s"); },
               [this] { return text("wedm_server"); });
    expectSoon("a third one runs", [&] { return another(second); }, [this] { return text("wedm_server"); });
    expectSoon("it knows the drawing with the line that was drawn meanwhile",
               [this] { return findings().join('\n').contains("open") && findings().join('\n').contains("0.080"); },
               [this] { return findings().join('\n'); });
    choose("Fix");
    expectSoon("and repairs it", [this] { return text("wedm_message").startsWith("Done"); }, [this] { return text("wedm_message"); });
}

void Driver::undoOnTheWay()
{
    choose("Check radii");
    expectSoon("the fault is found", [this] { return verdictOf("0.0800").contains("small-radius"); });
    save();
    const QString radii = saved("radii");
    drawLine();
    // Between the question and its answer the event loop has not come round.
    choose("Fix");
    action("EditUndo")->trigger();
    expectSoon("the repair is refused", [this] { return text("wedm_message").contains("nothing was changed"); }, [this] { return text("wedm_message"); });
    expect("because of the undo", text("wedm_message").contains("Undo"), text("wedm_message"));
    save();
    expect("nothing was changed", saved("radii") == radii, saved("radii"));
    expect("redo is still possible", action("EditRedo")->isEnabled());
    press("EditRedo");
    choose("Fix");
    expectSoon("asked again it is done", [this] { return text("wedm_message").startsWith("Done"); }, [this] { return text("wedm_message"); });
}

void Driver::editOnTheWay()
{
    choose("Check radii");
    expectSoon("the fault is found", [this] { return verdictOf("0.0800").contains("small-radius"); });
    save();
    const QString radii = saved("radii");
    press("SelectAll");
    press("ModifyDelete");
    // Between the question and its answer the event loop has not come round.
    choose("Fix");
    confirm();
    expectSoon("the repair is refused", [this] { return text("wedm_message").contains("nothing was changed"); }, [this] { return text("wedm_message"); });
    save();
    expect("the drawing is empty, as the user left it", saved("radii").isEmpty(), saved("radii"));
    press("EditUndo");
    save();
    expect("and one undo brings everything back", saved("radii") == radii, saved("radii"));
}

/// Tens of thousands of vertices: how long is the longest time in which LibreCAD does not answer?
void Driver::large()
{
    Blocks blocks(this);
    const auto pause = [&] {
        QTest::qWait(1000);
        return blocks.longest();
    };
    pause();
    blocks.restart();
    press("ZoomRedraw");
    print(QStringLiteral("       longest block, LibreCAD's own repaint: %1 ms").arg(pause()));
    blocks.restart();
    drawLine();
    const qint64 alone = pause();
    print(QStringLiteral("       longest block, a line is drawn without the plugin: %1 ms").arg(alone));
    blocks.restart();
    choose("Live check");
    expectSoon("the fault among all the vertices is found", [this] { return findings().join('\n').contains("small-radius") || findings().join('\n').contains("below the correction"); },
               [this] { return findings().join('\n').left(300) + text("wedm_server"); }, LONG);
    expectSoon("and the radius list has come", [this] { return rows() > 0; }, {}, LONG);
    print(QStringLiteral("       longest block, first look, %1 rows listed: %2 ms").arg(rows()).arg(pause()));
    for (int i = 0; i < 3; ++i) {
        const int looks = controller()->property("looks").toInt();
        blocks.restart();
        drawLine();
        // A costly look waits for a quiet moment; it belongs to the measurement.
        wait([&] { return controller()->property("looks").toInt() > looks; }, LONG);
        const qint64 longest = pause();
        print(QStringLiteral("       longest block, a line is drawn under live check: %1 ms; LibreCAD's painting %2 ms, anything else at most %3 ms; "
                              "the look took %4 ms in %5 slices of at most %6 ms")
                   .arg(longest)
                   .arg(blocks.painting())
                   .arg(blocks.other())
                   .arg(controller()->property("lookMilliseconds").toInt())
                   .arg(controller()->property("slices").toInt())
                   .arg(controller()->property("sliceMilliseconds").toInt()));
    }
    const auto number = [this](const char *name) { return controller()->property(name).toInt(); };
    if (number("slices") >= SLICES_TO_BREAK_OFF) {
        const int looks = number("looks");
        // Somebody types at the first slice of the look. It is broken off where another one begins and none has ended.
        int begun = 0;
        EachSlice slices(controller(), [&](int slice) {
            begun += slice == 0 && number("looks") == looks;
            if (slice == 1 && begun == 1)
                QTimer::singleShot(0, this, &Driver::touch);
        });
        drawLine();
        expectSoon("a look is broken off when somebody types", [&] { return begun > 1; }, [&] { return QString::number(number("slices")); }, LONG);
        expectSoon("and taken when they rest", [&] { return number("looks") > looks; }, {}, LONG);
    }
    // A server that does not answer at all blocks nothing: if anything waited for it, this would never end.
    const pid_t server = pid_t(controller()->property("serverProcessId").toLongLong());
    ::kill(server, SIGSTOP);
    blocks.restart();
    drawLine();
    choose("Check radii");
    print(QStringLiteral("       longest block, a line is drawn and checked while the server hangs: %1 ms").arg(pause()));
    ::kill(server, SIGCONT);
    QElapsedTimer clock;
    clock.start();
    choose("Fix");
    expectSoon("a repair that would hold LibreCAD up is asked about first",
               [this] { return m_main->findChild<QDialog *>("wedm_rebuild") || text("wedm_message").startsWith("Done"); },
               [this] { return text("wedm_message"); }, LONG);
    if (QDialog *box = m_main->findChild<QDialog *>("wedm_rebuild"))
        box->reject();
    print(QStringLiteral("       after %1 ms, of them rebuilding %2 ms: %3")
               .arg(clock.elapsed())
               .arg(controller()->property("applyMilliseconds").toInt())
               .arg(text("wedm_message")));
}
