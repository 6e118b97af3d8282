// SPDX-License-Identifier: GPL-2.0-or-later
// What is tried in LibreCAD. Each scenario runs in a LibreCAD of its own.
#include "driver.h"

#include <QAbstractButton>
#include <QAction>
#include <QDialog>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QListWidget>
#include <QMap>
#include <QMdiArea>
#include <QMdiSubWindow>
#include <QRegularExpression>
#include <QSet>
#include <QTableView>
#include <QtTest>

#include <csignal>

void Driver::scenario(const QString &name)
{
    const QMap<QString, void (Driver::*)()> scenarios{
        {"check", &Driver::check},
        {"fix", &Driver::fix},
        {"fixChain", &Driver::fixChain},
        {"fixOne", &Driver::fixOne},
        {"generate", &Driver::generate},
        {"formats", &Driver::formats},
        {"counterbore", &Driver::counterbore},
        {"pair", &Driver::pair},
        {"fit", &Driver::fit},
        {"drill", &Driver::drill},
        {"figures", &Driver::figures},
        {"report", &Driver::report},
        {"chinese", &Driver::chinese},
        {"path", &Driver::path},
        {"hole", &Driver::hole},
        {"stale", &Driver::stale},
        {"colours", &Driver::colours},
        {"marks", &Driver::marks},
        {"live", &Driver::live},
        {"missing", &Driver::missing},
        {"windows", &Driver::windows},
        {"settings", &Driver::settings},
        {"otherVersion", &Driver::otherVersion},
        {"killed", &Driver::killed},
        {"undoOnTheWay", &Driver::undoOnTheWay},
        {"editOnTheWay", &Driver::editOnTheWay},
        {"large", &Driver::large},
        {"largeLines", &Driver::large},
        {"zoom", &Driver::zoom},
        {"watch", &Driver::watch},
    };
    if (scenarios.contains(name))
        (this->*scenarios.value(name))();
    else
        expect("there is a scenario " + name, false);
}

/// The environment variable has made the plugin trigger its own action; nobody has touched the menu.
void Driver::check()
{
    expectSoon("the radius list has come by itself", [this] { return rows() > 0; });
    expect("R 0.0800 is at fault", verdictOf("0.0800").contains("small-radius"), verdictOf("0.0800"));
    expect("R 5.0000 is not", verdictOf("5.0000") == "ok", verdictOf("5.0000"));
    expect("what happens at the machine is said", findings().join('\n').contains("0.080 mm is below the correction 0.100 mm"), findings().join('\n'));
    bool plain = true;
    for (const char *name : {"wedm_message", "wedm_server", "wedm_unchecked", "wedm_count", "wedm_live", "wedm_in_force"})
        plain = plain && m_main->findChild<QLabel *>(name)->textFormat() == Qt::PlainText;
    expect("what comes out of a drawing is no mark-up", plain);
    const QTableView *view = m_main->findChild<QTableView *>("wedm_radii");
    const int right = view->columnViewportPosition(VERDICT) + view->columnWidth(VERDICT);
    expect("entity, vertex, radius and verdict are seen without scrolling", right <= view->viewport()->width(),
           QStringLiteral("%1 of %2").arg(right).arg(view->viewport()->width()));
    expect("the entity has the number of the findings", cell(0, ENTITY) == "1 polyline", cell(0, ENTITY));
    expect("the server says who it is", text("wedm_server").startsWith("wedm "), text("wedm_server"));
    expect("the plugin's own actions are not in the menu", !action("wedm look") && !action("wedm apply"));
}

void Driver::fix()
{
    save();
    const QString radii = saved("radii");
    const QString layers = saved("layers");
    choose("Fix");
    expectSoon("the repair is done, and counted", [this] { return text("wedm_message").startsWith("Done: 1 finding repaired, none left."); },
               [this] { return text("wedm_message"); });
    expectSoon("no fault is left", [this] { return verdictOf("0.1010") == "ok"; }, [this] { return verdictOf("0.1010"); });
    save();
    expect("the file has R 0.101 in place of R 0.080", saved("radii") == QString(radii).replace("0.0800", "0.1010"), saved("radii"));
    choose("Mark faults");
    expectSoon("there is nothing to mark", [this] { return text("wedm_message").startsWith("There is nothing to mark"); },
               [this] { return text("wedm_message"); });
    save();
    expect("and no layer is made for it", isSaved("DIE") && !isSaved("WEDM_MARKS"));
    expect("it lies on its layer", saved("layers") == layers, saved("layers"));
    expectSoon("no fault is found any more", [this] { return text("wedm_count").startsWith("no fault found"); }, [this] { return text("wedm_count"); });
    press("EditUndo");
    expectSoon("of what was undone nothing is said that was said before", [this] { return text("wedm_count").contains("not checked") && text("wedm_message").isEmpty(); },
               [this] { return text("wedm_count") + " / " + text("wedm_message"); });
    save();
    expect("one undo takes all of it back", saved("radii") == radii, saved("radii"));
    expect("and there is nothing more to undo", !action("EditUndo")->isEnabled());
    press("EditRedo");
    save();
    expect("redo brings it again", saved("radii") == QString(radii).replace("0.0800", "0.1010"), saved("radii"));
    expect("which is not checked either", text("wedm_count").contains("not checked"), text("wedm_count"));
    choose("Check radii");
    expectSoon("until it is looked at", [this] { return text("wedm_count").startsWith("no fault found"); }, [this] { return text("wedm_count"); });
    QTableView *view = m_main->findChild<QTableView *>("wedm_radii");
    const QString head = view->model()->headerData(RADIUS, Qt::Horizontal).toString();
    expect("the list says the unit of its radii", head == "Radius mm", head);
}

void Driver::fixChain()
{
    save();
    const QString radii = saved("radii");
    choose("Fix");
    expectSoon("the repair is done", [this] { return text("wedm_message").startsWith("Done"); }, [this] { return text("wedm_message"); });
    expectSoon("no fault is left", [this] { return verdictOf("0.1010") == "ok"; }, [this] { return verdictOf("0.1010"); });
    save();
    expect("still lines and arcs", entitiesSaved("LINE") == 4 && entitiesSaved("ARC") == 2, QString::number(entitiesSaved("ARC")));
    expect("R 0.101 in place of R 0.080", saved("radii") == QString(radii).replace("0.0800", "0.1010"), saved("radii"));
    expect("all on their layer", saved("layers") == "DIE DIE DIE DIE DIE DIE", saved("layers"));
    press("EditUndo");
    save();
    expect("one undo takes all of it back", saved("radii") == radii && !action("EditUndo")->isEnabled(), saved("radii"));
}

/// The button beside the list repairs the selected segment only.
void Driver::fixOne()
{
    choose("Check radii");
    expectSoon("two faults are listed", [this] { return text("wedm_count").startsWith("errors: 2"); }, [this] { return text("wedm_count"); });
    QTableView *view = m_main->findChild<QTableView *>("wedm_radii");
    expectSoon("both in the radius list", [this] { return rows() == 2; });
    view->selectRow(1);
    QAbstractButton *button = m_main->findChild<QAbstractButton *>("wedm_fix_one");
    expectSoon("it can be repaired", [&] { return button->isEnabled(); });
    button->click();
    expectSoon("the repair is done", [this] { return text("wedm_message").startsWith("Done"); }, [this] { return text("wedm_message"); });
    expectSoon("the other fault is left", [this] { return text("wedm_count").startsWith("errors: 1"); }, [this] { return text("wedm_count"); });
    expectSoon("the first arc is as it was", [this] { return cell(0, RADIUS) == "0.0800" && cell(1, RADIUS) == "0.1010"; },
        [this] { return cell(0, RADIUS) + " " + cell(1, RADIUS); });
}

/// The wire's path is drawn on a layer of its own, which is no part of the drawing, here and in the saved file.
void Driver::path()
{
    choose("Draw wire path");
    expectSoon("without a side there is none, and it is said why", [this] { return text("wedm_message").startsWith("There is no path of the wire"); },
               [this] { return text("wedm_message"); });
    answer("wedm_side_asked", "Opening: wire inside");
    expectSoon("once it is answered there is one", [this] { return text("wedm_message").startsWith("The wire path is on the layer"); }, [this] { return text("wedm_message"); });
    choose("Clear wire path");
    choose("Fix");
    expectSoon("the repair is done", [this] { return text("wedm_message").startsWith("Done"); }, [this] { return text("wedm_message"); });
    save();
    const QString findings = checked();
    choose("Draw wire path");
    expectSoon("the path is drawn, with its lengths", [this] { return text("wedm_message").startsWith("The wire path is on the layer WEDM_PATH: cut "); },
               [this] { return text("wedm_message"); });
    save();
    const int arcs = entitiesSaved("ARC");
    const int lines = entitiesSaved("LINE");
    expect("of lines and arcs", arcs > 0 && lines > 0, QStringLiteral("%1 arcs, %2 lines").arg(arcs).arg(lines));
    expect("whose layer is in the file", isSaved("WEDM_PATH"));
    expect("the saved file is judged as without it", checked() == findings, checked());
    choose("Check radii");
    expectSoon("it is no part of the drawing", [this] { return text("wedm_count").startsWith("no fault found"); }, [this] { return text("wedm_count"); });
    const QString picture = qEnvironmentVariable("WEDM_TEST_PICTURE");
    if (!picture.isEmpty()) {
        press("ZoomAuto");
        QTest::qWait(300);
        m_main->grab().save(picture);
    }
    forgetMessage();
    choose("Draw wire path");
    expectSoon("it is drawn again", [this] { return text("wedm_message").startsWith("The wire path is on the layer"); }, [this] { return text("wedm_message"); });
    save();
    expect("drawn again it takes the place of the old one", entitiesSaved("ARC") == arcs && entitiesSaved("LINE") == lines,
           QStringLiteral("%1 arcs, %2 lines").arg(entitiesSaved("ARC")).arg(entitiesSaved("LINE")));
    press("EditUndo");
    press("EditUndo");
    save();
    expect("two steps of undo take both away", entitiesSaved("LINE") == 0, QString::number(entitiesSaved("LINE")));
    press("EditRedo");
    press("EditRedo");
    choose("Clear wire path");
    save();
    expect("cleared, it is gone", entitiesSaved("ARC") == 0 && entitiesSaved("LINE") == 0);
}

/// A thread hole is picked, and kept beside the drawing by a point of its contour.
void Driver::hole()
{
    choose("Check radii");
    set("wedm_side", "opening");
    choose("Fix");
    expectSoon("the repair is done", [this] { return text("wedm_message").startsWith("Done"); }, [this] { return text("wedm_message"); });
    QString asked;
    const QString asks = "click where the wire is threaded";
    whenAsked(asks, [&] {
        asked = text("wedm_message");
        type("8,4");
    });
    choose("Pick thread hole");
    expect("the click is asked for", asked.contains(asks), asked);
    expectSoon("the hole is kept", [this] { return text("wedm_message").startsWith("Thread hole 8, 4 for the contour at "); }, [this] { return text("wedm_message"); });
    const QString path = QFileInfo(m_file).absoluteDir().filePath("wedm.toml");
    QFile file(path);
    expect("beside the drawing", file.open(QIODevice::ReadOnly));
    const QByteArray first = file.readAll();
    file.close();
    expect("by a point of its contour", first.contains("[drawings.\"plate.dxf\".contours.\"") && first.contains("thread = [8, 4]"), first);
    const QString program = QFileInfo(m_file).absoluteDir().filePath("plate.iso");
    choose("Generate ISO…");
    acceptFile(program);
    expectSoon("a program is written", [this] { return text("wedm_message").startsWith("Written"); }, [this] { return text("wedm_message"); });
    QFile written(program);
    const QByteArray blocks = written.open(QIODevice::ReadOnly) ? written.readAll() : QByteArray();
    expect("that begins there", blocks.contains("G92 X8.") && blocks.contains("Y4."), blocks);
    whenAsked(asks, [&] { type("9,5"); });
    choose("Pick thread hole");
    expectSoon("another one takes its place", [this] { return text("wedm_message").startsWith("Thread hole 9, 5"); }, [this] { return text("wedm_message"); });
    expect("in the same line", file.open(QIODevice::ReadOnly) && file.readAll() == QByteArray(first).replace("[8, 4]", "[9, 5]"));
    file.close();
    whenAsked(asks, [&] { QTest::keyClick(view(), Qt::Key_Escape); });
    choose("Pick thread hole");
    expectSoon("Escape changes nothing", [this] { return text("wedm_message").contains("nothing was changed"); }, [this] { return text("wedm_message"); });
    choose("Check radii");
    expectSoon("and the plugin goes on", [this] { return text("wedm_count").startsWith("no fault found"); }, [this] { return text("wedm_count"); });
}

/// What was found before the drawing changed is grey, and said to be old.
void Driver::stale()
{
    QTableView *view = nullptr;
    const auto ground = [&] { return view->model()->index(0, 0).data(Qt::BackgroundRole).value<QColor>(); };
    const auto isGrey = [](const QColor &colour) { return colour.isValid() && colour.red() == colour.green() && colour.green() == colour.blue(); };
    choose("Check radii");
    expectSoon("the fault is found", [this] { return verdictOf("0.0800").contains("small-radius"); });
    view = m_main->findChild<QTableView *>("wedm_radii");
    QTest::qWait(400);
    expect("red, and it stays so while nothing changes", text("wedm_count").startsWith("errors: 1") && !isGrey(ground()), ground().name());
    press("ZoomAuto");
    QTest::qWait(400);
    expect("whatever is looked at", text("wedm_count").startsWith("errors: 1"), text("wedm_count"));
    drawLine();
    expectSoon("a line is drawn: it is not checked", [this] { return text("wedm_count") == "not checked since the last change"; }, [this] { return text("wedm_count"); });
    expect("and grey", isGrey(ground()), ground().name());
    const QString picture = qEnvironmentVariable("WEDM_TEST_PICTURE");
    if (!picture.isEmpty())
        m_main->grab().save(picture);
    choose("Check radii");
    expectSoon("checked, it has its colour again", [&] { return text("wedm_count").startsWith("errors: 2") && !isGrey(ground()); }, [this] { return text("wedm_count"); });
    choose("Mark faults");
    QTest::qWait(400);
    expect("the plugin's own marks are no change", text("wedm_count").startsWith("errors: 2"), text("wedm_count"));
    choose("Clear marks");
    QTest::qWait(400);
    expect("nor is their going", text("wedm_count").startsWith("errors: 2"), text("wedm_count"));
    ::kill(pid_t(controller()->property("serverProcessId").toLongLong()), SIGSTOP);
    drawLine();
    choose("Check radii");
    expectSoon("while the server does not answer, nothing is said of what it has not seen",
               [&] { return text("wedm_count").contains("not checked") && isGrey(ground()); }, [this] { return text("wedm_count"); });
    ::kill(pid_t(controller()->property("serverProcessId").toLongLong()), SIGCONT);
    expectSoon("then it is", [this] { return text("wedm_count").startsWith("errors:"); }, [this] { return text("wedm_count"); });
}

/// One colour for each severity, in the list and in the table.
void Driver::colours()
{
    choose("Check radii");
    expectSoon("something is found", [this] { return !findings().isEmpty() && rows() > 0; });
    const QListWidget *list = m_main->findChild<QListWidget *>("wedm_findings");
    QMap<QString, QColor> colours;
    for (int i = 0; i < list->count(); ++i)
        colours.insert(list->item(i)->text().section(QRegularExpression("[,:]"), 0, 0), list->item(i)->background().color());
    expect("errors, warnings and notes", colours.contains("error") && colours.contains("warning") && colours.contains("note"), colours.keys().join(' '));
    expect("each in its own colour", QSet<QString>({colours["error"].name(), colours["note"].name(), colours["warning"].name()}).size() == 3);
    const QTableView *view = m_main->findChild<QTableView *>("wedm_radii");
    QSet<QString> inTable;
    for (int i = 0; i < view->model()->rowCount(); ++i) {
        const QColor colour = view->model()->index(i, 0).data(Qt::BackgroundRole).value<QColor>();
        if (colour.isValid())
            inTable.insert(colour.name());
    }
    expect("the same in the table", inTable.contains(colours["error"].name()) && inTable.contains(colours["warning"].name()), inTable.values().join(' '));
    const QString picture = qEnvironmentVariable("WEDM_TEST_PICTURE");
    if (!picture.isEmpty())
        m_main->grab().save(picture);
}

void Driver::marks()
{
    choose("Check radii");
    expectSoon("the fault is found", [this] { return verdictOf("0.0800").contains("small-radius"); });
    save();
    expect("nothing is drawn unasked", entitiesSaved("CIRCLE") == 0);
    choose("Mark faults");
    save();
    expect("a circle marks it", entitiesSaved("CIRCLE") == 1, QString::number(entitiesSaved("CIRCLE")));
    expect("whose layer is in the file", isSaved("WEDM_MARKS"));
    expect("on the layer of marks", saved("layers").contains("WEDM_MARKS"), saved("layers"));
    choose("Check radii");
    QTest::qWait(500);
    expect("marks are no part of the drawing", !verdictOf("0.0800").startsWith("no arc") && text("wedm_count").startsWith("errors: 1"), text("wedm_count"));
    choose("Clear marks");
    save();
    expect("and go again", entitiesSaved("CIRCLE") == 0);
}

void Driver::live()
{
    choose("Live check");
    expectSoon("the fault is found", [this] { return verdictOf("0.0800").contains("small-radius"); }, [this] { return verdictOf("0.0800"); });
    expect("the menu shows that it is on", action("Live check")->isChecked());
    const int before = findings().size();
    drawLine();
    expectSoon("a line that is drawn is seen without any command", [this] { return findings().join('\n').contains("open"); },
               [this] { return findings().join('\n'); });
    press("EditUndo");
    touch();
    expectSoon("after an undo it waits", [this] { return text("wedm_live").contains("Redo"); }, [this] { return text("wedm_live"); });
    expect("so that redo stays possible", action("EditRedo")->isEnabled());
    press("EditRedo");
    touch();
    expectSoon("then it goes on", [this] { return !text("wedm_live").contains("Redo"); }, [this] { return text("wedm_live"); });
    press("SelectAll");
    press("ModifyDelete");
    confirm();
    expectSoon("what is deleted is no longer found", [this] { return rows() == 0; }, [this] { return QString::number(rows()); });
    expect("there was something to find before", before > 0);
    choose("Live check");
    expect("it can be switched off", !action("Live check")->isChecked());
}

/// The dock's correction holds, until a wedm.toml beside the drawing says otherwise.
void Driver::settings()
{
    choose("Check radii");
    expectSoon("R 0.0800 is at fault", [this] { return verdictOf("0.0800").contains("small-radius"); });
    expectSoon("the correction in force is said", [this] { return text("wedm_in_force").contains("correction 0.100 mm (default), both sides (default), mm (drawing)"); },
               [this] { return text("wedm_in_force"); });
    m_main->findChild<QDoubleSpinBox *>("wedm_correction")->setValue(0.05);
    expectSoon("with a correction of 0.05 mm it is not", [this] { return verdictOf("0.0800") == "ok"; }, [this] { return verdictOf("0.0800"); });
    expectSoon("said to be the dock's", [this] { return text("wedm_in_force").contains("0.050 mm (this dock)"); },
               [this] { return text("wedm_in_force"); });
    QFile file(QFileInfo(m_file).absoluteDir().filePath("wedm.toml"));
    expect("a wedm.toml is written beside the drawing", file.open(QIODevice::WriteOnly) && file.write("correction = 0.09\n") > 0);
    file.close();
    m_main->findChild<QDoubleSpinBox *>("wedm_correction")->setValue(0.04);
    expectSoon("it comes first", [this] { return verdictOf("0.0800").contains("small-radius"); }, [this] { return verdictOf("0.0800"); });
    expectSoon("and is named", [this] { return text("wedm_in_force").contains("0.090 mm (wedm.toml)"); },
               [this] { return text("wedm_in_force"); });
    expect("it is edited", file.open(QIODevice::WriteOnly) && file.write("correction = 0.07\n") > 0);
    file.close();
    choose("Check radii");
    expectSoon("and read again with the next check", [this] { return verdictOf("0.0800") == "ok"; }, [this] { return text("wedm_in_force"); });
}

/// Several drawings, of which each has its own list; and none at all.
void Driver::windows()
{
    choose("Live check");
    expectSoon("the fault is found", [this] { return verdictOf("0.0800").contains("small-radius"); });
    QMdiArea *area = m_main->findChild<QMdiArea *>();
    QMdiSubWindow *first = area->currentSubWindow();
    press("FileNew");
    expectSoon("a new drawing has come to the front", [&] { return area->currentSubWindow() != first; });
    touch();
    expectSoon("its list is empty", [this] { return rows() == 0; }, [this] { return QString::number(rows()); });
    QMdiSubWindow *second = area->currentSubWindow();
    choose("Fix");
    area->setActiveSubWindow(first);
    expectSoon("a repair that comes when another drawing is in front is refused", [this] { return text("wedm_message").contains("othing"); },
               [this] { return text("wedm_message"); });
    touch();
    expectSoon("back in the first, its list is there again", [this] { return verdictOf("0.0800").contains("small-radius"); },
               [this] { return verdictOf("0.0800"); });
    choose("Fix");
    area->setActiveSubWindow(second);
    expectSoon("so is one of the first while the second is in front", [this] { return text("wedm_message").contains("nothing was changed"); },
               [this] { return text("wedm_message"); });
    second->close();
    expectSoon("the second is closed", [&] { return area->subWindowList().size() == 1; });
    expectSoon("and the first shown as it was", [this] { return verdictOf("0.0800").contains("small-radius"); }, [this] { return verdictOf("0.0800"); });
    choose("Fix");
    first->close();
    expectSoon("it is closed while a repair is on its way", [&] { return area->subWindowList().isEmpty(); });
    touch();
    expectSoon("LibreCAD goes on without a drawing", [this] { return rows() <= 0; }, [this] { return QString::number(rows()); });
    press("FileNew");
    touch();
    expectSoon("and with a new one", [&] { return area->subWindowList().size() == 1; });
    QTest::qWait(300);
}

/// A double click shows the place and selects what lies there.
void Driver::zoom()
{
    choose("Check radii");
    expectSoon("the list is there", [this] { return rows() > 0; });
    QTableView *view = m_main->findChild<QTableView *>("wedm_radii");
    QTest::qWait(200);
    emit view->doubleClicked(view->model()->index(0, 0));
    QTest::qWait(300);
    const QString path = qEnvironmentVariable("WEDM_TEST_PICTURE");
    if (!path.isEmpty())
        m_main->grab().save(path);
    press("ModifyDelete");
    confirm();
    save();
    expect("the entity under it was selected: Delete took it away", saved("radii").isEmpty(), saved("radii"));
    press("EditUndo");
    expect("nothing but the deletion is to undo", !action("EditUndo")->isEnabled());
}

/// Somebody else has the mouse: only reports, again and again, what can be clicked where and what can be read.
void Driver::watch()
{
    const QString folder = qEnvironmentVariable("WEDM_TEST_FOLDER");
    while (!QFile::exists(folder + "/stop")) {
        writePlaces(folder + "/places");
        QTest::qWait(100);
    }
}
