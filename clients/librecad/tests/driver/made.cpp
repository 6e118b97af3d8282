// SPDX-License-Identifier: GPL-2.0-or-later
// Scenarios of what is made of a drawing: programs, those of a pair, the drill list, figures, a report; and all of it in Chinese.
#include "driver.h"

#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QDesktopServices>
#include <QDialog>
#include <QDir>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QMessageBox>
#include <QRegularExpression>
#include <QTableView>
#include <QTableWidget>
#include <QtTest>

namespace {

QByteArray contentOf(const QString &path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// All that a window shows, each text by itself.
QStringList textsOf(const QWidget *window)
{
    QStringList texts{window->windowTitle()};
    for (const QLabel *each : window->findChildren<QLabel *>())
        texts += each->text();
    for (const QAbstractButton *each : window->findChildren<QAbstractButton *>())
        texts += each->text() + ' ' + each->toolTip();
    for (const QComboBox *each : window->findChildren<QComboBox *>())
        for (int i = 0; i < each->count(); ++i)
            texts += each->itemText(i);
    for (const QMenu *each : window->findChildren<QMenu *>())
        for (const QAction *action : each->actions())
            texts += action->text();
    for (const QAbstractItemView *each : window->findChildren<QAbstractItemView *>()) {
        const QAbstractItemModel *model = each->model();
        for (int column = 0; model && column < model->columnCount(); ++column) {
            texts += model->headerData(column, Qt::Horizontal).toString();
            for (int row = 0; row < model->rowCount(); ++row)
                texts += model->index(row, column).data().toString();
        }
    }
    return texts;
}

/// Those of them in which something is English that is no name: of a rule, a key, a layer, a format, a unit.
QStringList english(const QStringList &texts)
{
    static const QRegularExpression names(
        "</?(p|br)>|[a-z]+\\.[a-z-]+|[a-z]+(-[a-z]+)+|wedm|gap|WEDM_[A-Z]+|DIE|ISO|DXF|CSV|Undo|Redo|mm|min|auto|opening|punch|plate\\.dxf|Server|PATH|LibreCAD");
    static const QRegularExpression words("[A-Za-z]{2,}");
    QStringList found;
    for (const QString &each : texts) {
        if (QString(each).remove(names).contains(words))
            found += each;
    }
    return found;
}

} // namespace

/// What is refused is said before a file is asked for, and so is the side that is not known.
void Driver::generate()
{
    const QString path = QFileInfo(m_file).absoluteDir().filePath("plate.3b");
    choose("Generate 3B…");
    expectSoon("a drawing with a fault is refused", [this] { return text("wedm_message").startsWith("No program"); }, [this] { return text("wedm_message"); });
    expect("with the fault", text("wedm_message").contains("R 0.080"), text("wedm_message"));
    expect("no file was asked for", !m_main->findChild<QFileDialog *>("wedm_file"));
    expectSoon("the question whether to write it all the same is there", [this] { return m_main->findChild<QDialog *>("wedm_refused"); });
    if (QDialog *box = m_main->findChild<QDialog *>("wedm_refused"))
        box->reject();
    choose("Fix");
    expectSoon("the repair is done", [this] { return text("wedm_message").startsWith("Done"); }, [this] { return text("wedm_message"); });
    choose("Generate 3B…");
    expectSoon("the side is asked", [this] { return m_main->findChild<QDialog *>("wedm_side_asked"); }, [this] { return text("wedm_message"); });
    expect("before the file", !m_main->findChild<QFileDialog *>("wedm_file"));
    answer("wedm_side_asked", "Opening: wire inside");
    expect("the answer stands in the dock", m_main->findChild<QComboBox *>("wedm_side")->currentData() == "opening");
    expectSoon("the program is there before it has a file", [this] { return text("wedm_message").contains("not written yet"); }, [this] { return text("wedm_message"); });
    acceptFile(path);
    expectSoon("the program is written", [this] { return text("wedm_message").startsWith("Written"); }, [this] { return text("wedm_message"); });
    QFile file(path);
    expect("and is there", file.open(QIODevice::ReadOnly));
    const QByteArray program = file.readAll();
    expect("it is 3B, from the first block to DD", program.startsWith("B") && program.trimmed().endsWith("DD"), program);
    expect("nothing else lies beside it", QDir(QFileInfo(path).path()).entryList({"plate.3b*", "*.XXXXXX"}, QDir::Files).size() == 1);
    choose("Generate ISO…");
    acceptFile(QFileInfo(m_file).absoluteDir().filePath("no/such/folder/plate.iso"));
    QTest::qWait(200);
    expect("once it is known it is not asked again", !m_main->findChild<QDialog *>("wedm_side_asked"));
}

/// What is drawn to be read, by its linetype or its layer's, is not cut here either: the program is that of the file.
void Driver::counterbore()
{
    const QString path = QFileInfo(m_file).absoluteDir().filePath("plate.3b");
    choose("Check radii");
    set("wedm_side", "opening");
    choose("Generate 3B…");
    acceptFile(path);
    expectSoon("the program is written", [this] { return text("wedm_message").startsWith("Written"); }, [this] { return text("wedm_message"); });
    QFile file(path);
    const QByteArray program = file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    const QByteArray ofFile = told({"generate", "--side", "opening"});
    expect("it is that of the file", !program.isEmpty() && program == ofFile, program + "\n---\n" + ofFile);
}

/// ISO, 4B and milling, from the same drawing.
void Driver::formats()
{
    QFile said(QFileInfo(m_file).absoluteDir().filePath("wedm.toml"));
    const QByteArray both = "correction = 0.1\n[milling]\ntool-diameter = 0.1\ngap = 0.05\nlayer = 0.05\ndepth = 0.2\nwear = 0.0001\n";
    expect("wire and electrode are said beside the drawing", said.open(QIODevice::WriteOnly) && said.write(both) == both.size());
    said.close();
    choose("Check radii");
    set("wedm_side", "opening");
    choose("Fix");
    expectSoon("the repair is done", [this] { return text("wedm_message").startsWith("Done"); }, [this] { return text("wedm_message"); });
    const QString iso = QFileInfo(m_file).absoluteDir().filePath("plate.iso");
    choose("Generate ISO…");
    acceptFile(iso);
    expectSoon("an ISO program is written", [this] { return text("wedm_message").startsWith("Written") && text("wedm_message").contains("plate.iso"); },
               [this] { return text("wedm_message"); });
    expect("lengths have their one name", text("wedm_message").contains("cut ") && text("wedm_message").contains("jumps 0.000 mm"), text("wedm_message"));
    expect("nothing is counted in it", !text("wedm_message").contains("of J"), text("wedm_message"));
    QFile file(iso);
    expect("it is ISO", file.open(QIODevice::ReadOnly) && file.readAll().contains("G92"));
    choose("Generate 4B…");
    acceptFile(QFileInfo(m_file).absoluteDir().filePath("plate.4b"));
    expectSoon("a 4B program is written", [this] { return text("wedm_message").startsWith("Written") && text("wedm_message").contains("plate.4b"); },
               [this] { return text("wedm_message"); });
    expect("a drift that rounds to zero has no sign", text("wedm_message").contains("added up: 0.00, 0.00"), text("wedm_message"));
    const QString milled = QFileInfo(m_file).absoluteDir().filePath("milled.iso");
    choose("Generate milling…");
    acceptFile(milled);
    expectSoon("a program for an electrode is written", [this] { return text("wedm_message").startsWith("Written") && text("wedm_message").contains("milled.iso"); },
               [this] { return text("wedm_message"); });
    expect("with its layers", text("wedm_message").contains("4 layers; simulated: the floor 0.") && !text("wedm_message").contains("of J"), text("wedm_message"));
    QFile heights(milled);
    expect("it has heights", heights.open(QIODevice::ReadOnly) && heights.readAll().contains("G01 Z-0.0"));
}

/// The programs of punch and plate, as `wedm pair` writes them.
void Driver::pair()
{
    const QDir folder = QFileInfo(m_file).absoluteDir();
    choose("Generate the programs of the pair…");
    answer("wedm_pair_format", "3B");
    QDialog *sizes = sheet("wedm_pair_sizes");
    expect("what the parts are is asked before the folder", sizes && !m_main->findChild<QFileDialog *>("wedm_folder"));
    if (!sizes)
        return;
    sizes->findChild<QDoubleSpinBox *>("wedm_clearance")->setValue(0.02);
    sizes->accept();
    acceptFolder(folder.path());
    expectSoon("they are written", [this] { return text("wedm_message").startsWith("Written to"); }, [this] { return text("wedm_message"); });
    expect("with the correction of each part", text("wedm_message").contains("plate-punch.3b, punch: correction 0.1000 mm") && text("wedm_message").contains("plate-plate.3b, plate: correction 0.0800 mm"),
           text("wedm_message"));
    folder.mkdir("told");
    told({"pair", "--format", "3b", "--drawn-as", "punch", "--clearance", "0.02", "--wire-diameter", "0.18", "--gap", "0.01", "-o", folder.filePath("told")});
    for (const char *name : {"plate-punch.3b", "plate-plate.3b"}) {
        const QByteArray written = contentOf(folder.filePath(name));
        expect(QStringLiteral("%1 is that of the command line").arg(name), !written.isEmpty() && written == contentOf(folder.filePath(QStringLiteral("told/") + name)), written);
    }
    forgetMessage();
    choose("Generate the programs of the pair…");
    answer("wedm_pair_format", "3B");
    QTest::qWait(100);
    sizes = sheet("wedm_pair_sizes");
    expect("the sizes of the last pair are proposed", sizes && sizes->findChild<QDoubleSpinBox *>("wedm_clearance")->value() == 0.02);
    if (!sizes)
        return;
    sizes->accept();
    acceptFolder(folder.path());
    answer("wedm_overwrite", "Overwrite");
    expectSoon("what is there is overwritten once that is answered", [this] { return text("wedm_message").startsWith("Written to"); }, [this] { return text("wedm_message"); });
}

/// Whether punch and plate fit, by the same figures as `wedm fit`, with the places in the drawing.
void Driver::fit()
{
    QDesktopServices::setUrlHandler("file", this, "shown");
    choose("Show whether punch and plate fit");
    QDialog *sizes = sheet("wedm_pair_sizes");
    if (!sizes)
        return;
    sizes->accept();
    QDialog *fit = sheet("wedm_fit");
    const QByteArray json = told({"fit", "--format", "json", "--drawn-as", "punch", "--clearance", "0.01", "--wire-diameter", "0.18", "--gap", "0.01"});
    const QJsonObject expected = QJsonDocument::fromJson(json).object();
    const int places = expected.value("places").toArray().size();
    const QTableWidget *table = fit ? fit->findChild<QTableWidget *>("wedm_sheet_table") : nullptr;
    expect("they do not fit", text("wedm_message").startsWith("Does not fit: ") && !expected.value("fits").toBool(), text("wedm_message"));
    expect("with as many places as the command line has", table && places > 0 && table->rowCount() == places, QString::number(places));
    const QString least = QString::number(expected.value("least").toDouble(), 'f', 4);
    expect("the tightest first", cellOf(fit, 0, "mm left") == least, cellOf(fit, 0, "mm left") + " " + least);
    if (!fit)
        return;
    const QString picture = qEnvironmentVariable("WEDM_TEST_PICTURE");
    if (!picture.isEmpty())
        fit->grab().save(picture);
    fit->findChild<QAbstractButton *>("wedm_fit_picture")->click();
    expectSoon("its picture is shown", [this] { return m_shown.isLocalFile(); });
    expect("as SVG", contentOf(m_shown.toLocalFile()).startsWith("<svg"), m_shown.toString());
    QFile::remove(m_shown.toLocalFile());
    emit const_cast<QTableWidget *>(table)->cellDoubleClicked(0, 0);
    QTest::qWait(300);
    press("ModifyDelete");
    confirm();
    save();
    expect("a double click has shown and selected the place", saved("radii").isEmpty(), saved("radii"));
}

/// The start holes, as a list and as a drawing.
void Driver::drill()
{
    const QDir folder = QFileInfo(m_file).absoluteDir();
    choose("Save drill list…");
    answer("wedm_side_asked", "By nesting");
    acceptFile(folder.filePath("holes.csv"));
    expectSoon("the list is saved", [this] { return text("wedm_message").startsWith("The drill list is saved"); }, [this] { return text("wedm_message"); });
    const auto holes = [](const QByteArray &list) {
        QStringList found;
        for (const QByteArray &line : list.trimmed().split('\n').mid(1))
            found += line.split(',').value(1) + ' ' + line.split(',').value(2);
        return found.join("; ");
    };
    const QString expected = holes(told({"holes", "--side", "auto"}));
    const QString found = holes(contentOf(folder.filePath("holes.csv")));
    expect("with the holes of the command line", !expected.isEmpty() && found == expected, found + " / " + expected);
    forgetMessage();
    choose("Save drill list…");
    acceptFile(folder.filePath("holes.dxf"));
    expectSoon("the drawing is saved", [this] { return text("wedm_message").contains("holes.dxf"); }, [this] { return text("wedm_message"); });
    expect("with the holes on their layer", contentOf(folder.filePath("holes.dxf")).contains("START-HOLES"));
}

/// What the drawing comes to, in the figures of `wedm inspect`.
void Driver::figures()
{
    choose("Show figures");
    QDialog *figures = sheet("wedm_figures");
    expect("the length of the contour", cellOf(figures, 0, "Length mm") == "53.528", cellOf(figures, 0, "Length mm"));
    expect("its area", cellOf(figures, 0, "Area mm²") == "183.903", cellOf(figures, 0, "Area mm²"));
    expect("its extents", cellOf(figures, 0, "Extents mm") == "20.000 × 10.000", cellOf(figures, 0, "Extents mm"));
    expect("its least radius", cellOf(figures, 0, "Least R mm") == "0.080", cellOf(figures, 0, "Least R mm"));
    const QString notes = figures ? figures->findChild<QLabel *>("wedm_sheet_notes")->text() : QString();
    expect("and why there are no times yet", notes.contains("There is no path of the wire: side of contour"), notes);
    if (figures)
        figures->close();
    QTest::qWait(100);
    QFile said(QFileInfo(m_file).absoluteDir().filePath("wedm.toml"));
    const QByteArray job = "side = \"opening\"\ngap = 0.01\nwire-diameter = 0.18\n[job]\nthickness = 20\nmachine-rate = 60\n[passes]\nrates = [60]\n";
    expect("thickness and rate are said beside the drawing", said.open(QIODevice::WriteOnly) && said.write(job) == job.size());
    said.close();
    choose("Check radii");
    choose("Show figures");
    figures = sheet("wedm_figures");
    expect("the length that is cut", cellOf(figures, 0, "Cut mm") == "58.691", cellOf(figures, 0, "Cut mm"));
    const QString sentence = figures ? figures->findChild<QLabel *>("wedm_sheet_sentence")->text() : QString();
    expect("and how long it takes", sentence.contains("min on the machine") && sentence.contains("cost"), sentence);
    const QString picture = qEnvironmentVariable("WEDM_TEST_PICTURE");
    if (figures && !picture.isEmpty())
        figures->grab().save(picture);
}

/// The pages of `wedm report`, of the drawing as it was saved.
void Driver::report()
{
    QDesktopServices::setUrlHandler("file", this, "shown");
    const QDir folder = QFileInfo(m_file).absoluteDir();
    choose("Check radii");
    set("wedm_side", "opening");
    choose("Make a report");
    expectSoon("the report is written", [this] { return text("wedm_message").startsWith("The report is written"); }, [this] { return text("wedm_message"); });
    expect("the fault is said", text("wedm_message").contains("There are errors in the drawing."), text("wedm_message"));
    expect("it is shown", m_shown == QUrl::fromLocalFile(folder.filePath("report/index.html")), m_shown.toString());
    const QByteArray page = contentOf(folder.filePath("report/plate.html"));
    expect("it has a page of the drawing", page.contains("small-radius"), QString::number(page.size()));
    drawLine();
    choose("Make a report");
    expectSoon("what is not saved is in no report, and that is said", [this] { return text("wedm_message").contains("save the drawing first"); }, [this] { return text("wedm_message"); });
    save();
    choose("Make a report");
    expectSoon("once it is saved it is", [this] { return text("wedm_message").startsWith("The report is written"); }, [this] { return text("wedm_message"); });
    expect("with the line that was drawn", contentOf(folder.filePath("report/plate.html")).contains("open-contour"));
}

/// All windows of the plugin in Chinese: LibreCAD is set to it.
void Driver::chinese()
{
    choose("Check radii");
    expectSoon("the list is there", [this] { return rows() > 0; });
    expectSoon("and what it is checked against", [this] { return !text("wedm_in_force").isEmpty(); });
    const auto isChinese = [this](const QString &what, const QWidget *window) {
        const QStringList left = window ? english(textsOf(window)) : QStringList{"it is not there"};
        expect(what + " is in Chinese", left.isEmpty(), left.join(" | "));
    };
    const QString picture = qEnvironmentVariable("WEDM_TEST_PICTURE");
    const auto keep = [&](const QString &name, QWidget *window) {
        if (window && !picture.isEmpty())
            window->grab().save(QString(picture).replace(".png", "-" + name + ".png"));
    };
    QDockWidget *dock = m_main->findChild<QDockWidget *>("wedm_dock");
    isChinese("the dock", dock);
    keep("dock", dock);
    QStringList entries;
    for (const QMenu *menu : m_main->findChildren<QMenu *>()) {
        if (menu->actions().contains(action("Check radii")) && menu->title() != "wedm") {
            entries += menu->title();
            for (const QAction *each : menu->actions())
                entries += each->text();
        }
    }
    expect("the menu is in Chinese", entries.size() > 10 && english(entries).isEmpty(), english(entries).join(" | "));
    choose("Show figures");
    QDialog *figures = sheet("wedm_figures");
    isChinese("the window of figures", figures);
    keep("figures", figures);
    choose("Generate 3B…");
    QDialog *refused = sheet("wedm_refused");
    isChinese("the question whether to write it all the same", refused);
    if (refused)
        refused->reject();
    choose("Draw wire path");
    QDialog *side = sheet("wedm_side_asked");
    isChinese("the question for the side", side);
    keep("side", side);
    if (side)
        side->reject();
    choose("Show whether punch and plate fit");
    QDialog *sizes = sheet("wedm_pair_sizes");
    isChinese("the question for the sizes of a pair", sizes);
    keep("sizes", sizes);
    if (!sizes)
        return;
    sizes->accept();
    QDialog *fit = sheet("wedm_fit");
    isChinese("whether they fit", fit);
    keep("fit", fit);
    choose("Fix");
    expectSoon("what is repaired is said", [this] { return english({text("wedm_message")}).isEmpty() && text("wedm_message").startsWith("完成"); }, [this] { return text("wedm_message"); });
}
