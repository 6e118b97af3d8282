// SPDX-License-Identifier: GPL-2.0-or-later
#include "driver.h"

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QFile>
#include <QFileDialog>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMdiArea>
#include <QMdiSubWindow>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QProcess>
#include <QSaveFile>
#include <QTableView>
#include <QTableWidget>
#include <QtTest>

#include <algorithm>
#include <cstdio>

Blocks::Blocks(QObject *parent)
    : QObject(parent)
{
    m_timer.setTimerType(Qt::PreciseTimer);
    connect(&m_timer, &QTimer::timeout, this, [this] {
        m_longest = qMax(m_longest, m_clock.restart());
    });
    m_timer.start(1);
    QCoreApplication::instance()->installEventFilter(this);
    restart();
}

/// The time since the event before is what that one took: with the timer there is always another one.
bool Blocks::eventFilter(QObject *object, QEvent *event)
{
    qint64 &longest = m_isPainting ? m_painting : m_other;
    longest = qMax(longest, m_sinceEvent.restart());
    m_isPainting = event->type() == QEvent::Paint && object->inherits("QG_GraphicView");
    return false;
}

void Blocks::restart()
{
    m_clock.start();
    m_sinceEvent.start();
    m_longest = m_painting = m_other = 0;
}

Driver::Driver()
{
    if (!qEnvironmentVariable("WEDM_TEST").isEmpty())
        QTimer::singleShot(0, this, &Driver::run);
}

void Driver::run()
{
    // While LibreCAD starts, it lets events through before its files are open.
    if (QThread::currentThread()->loopLevel() == 0) {
        QTimer::singleShot(50, this, &Driver::run);
        return;
    }
    m_file = qEnvironmentVariable("WEDM_TEST_FILE");
    wait([this] {
        for (QWidget *window : QApplication::topLevelWidgets()) {
            if (window->inherits("QC_ApplicationWindow"))
                m_main = qobject_cast<QMainWindow *>(window);
        }
        QMdiArea *area = m_main ? m_main->findChild<QMdiArea *>() : nullptr;
        return area && area->currentSubWindow() && action("Check radii");
    });
    expect("LibreCAD has loaded the plugin and the drawing", m_main && action("Check radii"));
    if (m_main && action("Check radii"))
        scenario(qEnvironmentVariable("WEDM_TEST"));
    std::puts("scenario ended");
    std::fflush(stdout);
    QFile process(QFileInfo(m_file).absoluteDir().filePath("server"));
    if (process.open(QIODevice::WriteOnly))
        process.write(QByteArray::number(controller()->property("serverProcessId").toLongLong()));
    process.close();
    // LibreCAD would ask whether the drawing is to be saved.
    QCoreApplication::exit(m_failed == 0 ? 0 : 1);
}

QAction *Driver::action(const QString &name) const
{
    if (QAction *host = m_main->findChild<QAction *>(name))
        return host;
    // The actions for plugins belong to the plugin; the menu lists them.
    for (QMenu *menu : m_main->findChildren<QMenu *>()) {
        for (QAction *each : menu->actions()) {
            if (each->data().toString() == name)
                return each;
        }
    }
    return nullptr;
}

void Driver::choose(const QString &menuEntry)
{
    if (QAction *entry = action(menuEntry))
        entry->trigger();
    else
        expect("the menu has " + menuEntry, false);
}

void Driver::press(const QString &hostAction)
{
    choose(hostAction);
    QTest::qWait(20);
}

/// A line into LibreCAD's command line.
void Driver::type(const QString &line)
{
    for (QLineEdit *edit : m_main->findChildren<QLineEdit *>()) {
        if (!edit->inherits("QG_CommandEdit"))
            continue;
        edit->setText(line);
        QTest::keyClick(edit, Qt::Key_Return);
        QTest::qWait(20);
        return;
    }
    expect("there is a command line", false);
}

void Driver::whenAsked(const QString &words, std::function<void()> act)
{
    QTimer *looking = new QTimer(this);
    connect(looking, &QTimer::timeout, this, [=] {
        if (!text("wedm_message").contains(words))
            return;
        looking->stop();
        looking->deleteLater();
        act();
    });
    looking->start(50);
}

void Driver::forgetMessage()
{
    if (QLabel *message = m_main->findChild<QLabel *>("wedm_message"))
        message->clear();
}

void Driver::drawLine()
{
    press("DrawLine");
    type("100,100");
    type("110,100");
    QTest::keyClick(view(), Qt::Key_Escape);
    QTest::keyClick(view(), Qt::Key_Escape);
    QTest::qWait(20);
}

/// Enter, which ends a selection; without letting the event loop come round.
void Driver::confirm()
{
    QTest::keyClick(view(), Qt::Key_Enter);
}

/// A key that does nothing: the user is there.
void Driver::touch()
{
    QTest::keyClick(m_main, Qt::Key_Shift);
}

QObject *Driver::controller() const
{
    QObject *found = action("Live check")->parent()->findChild<QObject *>("wedm_controller");
    return found ? found : action("Live check");
}

QWidget *Driver::view() const
{
    for (QWidget *widget : m_main->findChild<QMdiArea *>()->currentSubWindow()->findChildren<QWidget *>()) {
        if (widget->inherits("QG_GraphicView"))
            return widget;
    }
    return m_main;
}

void Driver::save()
{
    press("FileSave");
    QTest::qWait(50);
}

void Driver::acceptFile(const QString &path)
{
    accept("wedm_file", "a file is asked for", path);
}

void Driver::acceptFolder(const QString &path)
{
    accept("wedm_folder", "a folder is asked for", path);
}

void Driver::accept(const char *name, const QString &what, const QString &path)
{
    QFileDialog *dialog = nullptr;
    expectSoon(what, [&] {
        dialog = m_main->findChild<QFileDialog *>(name);
        return dialog && dialog->isVisible();
    });
    if (!dialog)
        return;
    for (QLineEdit *edit : dialog->findChildren<QLineEdit *>("fileNameEdit"))
        edit->setText(path);
    QMetaObject::invokeMethod(dialog, "accept");
    QTest::qWait(50);
}

void Driver::answer(const char *box, const QString &button)
{
    QMessageBox *asked = nullptr;
    expectSoon(QStringLiteral("it is asked: %1").arg(box), [&] {
        asked = m_main->findChild<QMessageBox *>(box);
        return asked && asked->isVisible();
    });
    for (QAbstractButton *each : asked ? asked->buttons() : QList<QAbstractButton *>()) {
        if (each->text().remove('&') == button) {
            each->click();
            QTest::qWait(50);
            return;
        }
    }
    expect(QStringLiteral("%1 has a button %2").arg(box, button), false);
}

QDialog *Driver::sheet(const char *name)
{
    QDialog *found = nullptr;
    expectSoon(QStringLiteral("the window is there: %1").arg(name), [&] {
        found = m_main->findChild<QDialog *>(name);
        return found && found->isVisible();
    }, [this] { return text("wedm_message"); });
    return found;
}

QString Driver::cellOf(QDialog *sheet, int row, const QString &head) const
{
    const QTableWidget *table = sheet ? sheet->findChild<QTableWidget *>("wedm_sheet_table") : nullptr;
    for (int column = 0; table && column < table->columnCount(); ++column) {
        if (table->horizontalHeaderItem(column)->text() == head && row < table->rowCount())
            return table->item(row, column)->text();
    }
    return "no such cell";
}

void Driver::set(const char *combo, const QVariant &value)
{
    QComboBox *box = m_main->findChild<QComboBox *>(combo);
    if (box)
        box->setCurrentIndex(box->findData(value));
    QTest::qWait(50);
}

QString Driver::text(const char *label) const
{
    const QLabel *found = m_main->findChild<QLabel *>(label);
    return found ? found->text() : QString();
}

int Driver::rows() const
{
    const QTableView *view = m_main->findChild<QTableView *>("wedm_radii");
    return view ? view->model()->rowCount() : -1;
}

QString Driver::cell(int row, int column) const
{
    const QTableView *view = m_main->findChild<QTableView *>("wedm_radii");
    return view ? view->model()->index(row, column).data().toString() : QString();
}

QString Driver::verdictOf(const QString &radius) const
{
    for (int i = 0; i < rows(); ++i) {
        if (cell(i, RADIUS) == radius)
            return cell(i, VERDICT);
    }
    return "no arc of R " + radius;
}

QStringList Driver::findings() const
{
    QStringList result;
    const QListWidget *list = m_main->findChild<QListWidget *>("wedm_findings");
    for (int i = 0; list && i < list->count(); ++i)
        result += list->item(i)->text();
    return result;
}

QByteArray Driver::told(const QStringList &arguments)
{
    QProcess server;
    server.start(qEnvironmentVariable("WEDM"), arguments + QStringList{m_file});
    server.waitForFinished(PATIENCE);
    return server.readAllStandardOutput();
}

QString Driver::saved(const QString &key)
{
    const QJsonObject inspection = QJsonDocument::fromJson(told({"inspect", "--output", "json"})).object();
    QStringList result;
    for (const QJsonValue &each : inspection.value("entities").toArray()) {
        const QJsonObject entity = each.toObject();
        if (key == "layers") {
            result += entity.value("layer").toString();
            continue;
        }
        for (const QJsonValue &item : entity.value("segments").toArray()) {
            if (item.toObject().contains("radius"))
                result += QString::number(item.toObject().value("radius").toDouble(), 'f', 4);
        }
    }
    result.sort();
    return result.join(' ');
}

QString Driver::checked()
{
    // The note that something on the layer of the path is not cut is no finding about the drawing.
    QStringList lines = QString::fromUtf8(told({"check", "--side", "opening", "--output", "concise"})).split('\n');
    lines.erase(std::remove_if(lines.begin(), lines.end(), [](const QString &line) { return line.contains("WEDM_PATH") || line.contains("checked:"); }), lines.end());
    return lines.join('\n');
}

int Driver::entitiesSaved(const QByteArray &type)
{
    QFile file(m_file);
    if (!file.open(QIODevice::ReadOnly))
        return -1;
    const QList<QByteArray> lines = file.readAll().replace('\r', "").split('\n');
    int count = 0;
    for (int i = 1; i < lines.size(); ++i)
        count += lines.at(i) == type && lines.at(i - 1).trimmed() == "0";
    return count;
}

bool Driver::isSaved(const QByteArray &line)
{
    QFile file(m_file);
    return file.open(QIODevice::ReadOnly) && file.readAll().replace('\r', "").split('\n').contains(line);
}

bool Driver::wait(const std::function<bool()> &condition, int milliseconds)
{
    return QTest::qWaitFor(condition, milliseconds);
}

void Driver::expect(const QString &what, bool good, const QString &seen)
{
    m_failed += !good;
    print(QStringLiteral("%1 %2%3").arg(good ? "ok    " : "FAILED", what, good || seen.isEmpty() ? QString() : "\n       seen: " + seen));
}

void Driver::expectSoon(const QString &what, const std::function<bool()> &condition, const std::function<QString()> &seen, int milliseconds)
{
    const bool good = wait(condition, milliseconds);
    expect(what, good, seen ? seen() : QString());
}

/// One line for each: "place NAME X Y" on the screen, or "text NAME TEXT".
void Driver::writePlaces(const QString &path) const
{
    QString out;
    const auto place = [&](const QString &name, const QWidget *widget, const QPoint &at) {
        const QPoint global = widget->mapToGlobal(at);
        out += QStringLiteral("place %1 %2 %3\n").arg(QString(name).replace(' ', '_')).arg(global.x()).arg(global.y());
    };
    const QMenuBar *bar = m_main->menuBar();
    for (QAction *each : bar->actions())
        place("menu:" + each->text(), bar, bar->actionGeometry(each).center());
    for (QMenu *menu : m_main->findChildren<QMenu *>()) {
        for (QAction *each : menu->isVisible() ? menu->actions() : QList<QAction *>())
            place("entry:" + each->data().toString(), menu, menu->actionGeometry(each).center());
    }
    for (QAbstractButton *button : m_main->findChildren<QAbstractButton *>()) {
        if (button->isVisible() && !button->text().isEmpty())
            place("button:" + button->text(), button, button->rect().center());
    }
    if (QTableView *table = m_main->findChild<QTableView *>("wedm_radii")) {
        for (int i = 0; i < table->model()->rowCount(); ++i) {
            place(QStringLiteral("row:%1").arg(cell(i, RADIUS)), table->viewport(), table->visualRect(table->model()->index(i, RADIUS)).center());
            out += QStringLiteral("text row:%1 %2\n").arg(cell(i, RADIUS), cell(i, VERDICT));
        }
    }
    for (QLabel *label : m_main->findChildren<QLabel *>()) {
        if (label->objectName().startsWith("wedm_"))
            out += QStringLiteral("text %1 %2\n").arg(label->objectName(), label->text().replace('\n', ' '));
    }
    QSaveFile file(path);
    if (file.open(QIODevice::WriteOnly)) {
        file.write(out.toUtf8());
        file.commit();
    }
}

void Driver::print(const QString &what)
{
    std::printf("%s\n", qPrintable(what));
    std::fflush(stdout);
}
