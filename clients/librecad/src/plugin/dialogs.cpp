// SPDX-License-Identifier: GPL-2.0-or-later
#include "dialogs.h"

#include "host.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QLabel>
#include <QMainWindow>
#include <QMessageBox>
#include <QPushButton>
#include <QTextDocument>

namespace wedm {
namespace dialogs {

namespace {

/// The number of findings that are named; the dock has all of them.
constexpr int NAMED = 8;

QString tr(const char *text)
{
    return QCoreApplication::translate("wedm::dialogs", text);
}

QMessageBox *box(QMessageBox::Icon icon, const char *name, const QString &text)
{
    QMessageBox *made = new QMessageBox(icon, tr("Wire EDM"), text, QMessageBox::NoButton, host::mainWindow());
    made->setAttribute(Qt::WA_DeleteOnClose);
    made->setObjectName(QString::fromLatin1(name));
    // Names come out of drawings.
    made->setTextFormat(Qt::PlainText);
    return made;
}

} // namespace

void programFile(const QString &format, const QString &folder, const QString &base, std::function<void(const QString &)> chosen)
{
    const bool mills = format == QLatin1String("milling");
    const QString ending = mills ? QStringLiteral("iso") : format;
    const QString name = base + QLatin1Char('.') + ending;
    const QString title = mills ? tr("milling") : format.toUpper();
    const QString endings = ending == QLatin1String("iso") ? QStringLiteral("*.iso *.nc") : QStringLiteral("*.") + ending;
    QFileDialog *dialog = new QFileDialog(host::mainWindow(), tr("Write the %1 program").arg(title), QDir(folder).filePath(name),
                                          tr("%1 programs (%2);;All files (*)").arg(title, endings));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setObjectName(QStringLiteral("wedm_file"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(ending);
    dialog->selectFile(name);
    QObject::connect(dialog, &QFileDialog::fileSelected, chosen);
    dialog->open();
}

void drillFile(const QString &folder, const QString &base, std::function<void(const QString &)> chosen)
{
    const QString name = base + QStringLiteral("-holes.csv");
    QFileDialog *dialog = new QFileDialog(host::mainWindow(), tr("Save the drill list"), QDir(folder).filePath(name),
                                          tr("List for the drill (*.csv);;Drawing with the holes (*.dxf)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setObjectName(QStringLiteral("wedm_file"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(QStringLiteral("csv"));
    dialog->selectFile(name);
    QObject::connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString &filter) {
        dialog->setDefaultSuffix(filter.contains(QLatin1String("*.dxf")) ? QStringLiteral("dxf") : QStringLiteral("csv"));
    });
    QObject::connect(dialog, &QFileDialog::fileSelected, chosen);
    dialog->open();
}

void folder(const QString &title, const QString &now, std::function<void(const QString &)> chosen)
{
    QFileDialog *dialog = new QFileDialog(host::mainWindow(), title, now);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setObjectName(QStringLiteral("wedm_folder"));
    dialog->setFileMode(QFileDialog::Directory);
    dialog->setOption(QFileDialog::ShowDirsOnly);
    QObject::connect(dialog, &QFileDialog::fileSelected, chosen);
    dialog->open();
}

void pairFormat(std::function<void(const QString &)> chosen)
{
    QMessageBox *asked = box(QMessageBox::Question, "wedm_pair_format", tr("The programs of the pair: what does the machine read?"));
    QHash<QAbstractButton *, QString> formats;
    for (const char *format : {"3b", "4b", "iso"})
        formats.insert(asked->addButton(QString::fromLatin1(format).toUpper(), QMessageBox::AcceptRole), QString::fromLatin1(format));
    asked->setEscapeButton(asked->addButton(tr("Cancel"), QMessageBox::RejectRole));
    QObject::connect(asked, &QMessageBox::buttonClicked, [formats, chosen](QAbstractButton *button) {
        if (formats.contains(button))
            chosen(formats.value(button));
    });
    asked->open();
}

void overwrite(const QStringList &names, std::function<void()> go)
{
    const QString all = names.join(QStringLiteral(", "));
    QMessageBox *asked = box(QMessageBox::Warning, "wedm_overwrite",
                             names.size() == 1 ? tr("%1 is there already. Overwrite it?").arg(all) : tr("%1 are there already. Overwrite them?").arg(all));
    QPushButton *yes = asked->addButton(tr("Overwrite"), QMessageBox::DestructiveRole);
    QPushButton *no = asked->addButton(tr("Cancel"), QMessageBox::RejectRole);
    asked->setDefaultButton(no);
    asked->setEscapeButton(no);
    QObject::connect(asked, &QMessageBox::buttonClicked, [yes, go](QAbstractButton *button) {
        if (button == yes)
            go();
    });
    asked->open();
}

void side(bool mills, std::function<void(const QString &)> chosen)
{
    QMessageBox *asked =
        box(QMessageBox::Question, "wedm_side_asked", mills ? tr("Which side does the electrode run on?") : tr("Which side does the wire run on?"));
    const QString opening = mills ? tr("Opening: electrode inside") : tr("Opening: wire inside");
    const QString punch = mills ? tr("Punch: electrode outside") : tr("Punch: wire outside");
    const QString nesting = tr("By nesting");
    QStringList lines{tr("%1: what lies outermost is a punch, a contour within it an opening, and so on.").arg(nesting)};
    lines += mills ? tr("%1: it mills along the wall of a pocket.").arg(opening) : tr("%1: what falls out is scrap, as of a die's plate.").arg(opening);
    lines += mills ? tr("%1: it mills round what stays.").arg(punch) : tr("%1: what falls out is the part.").arg(punch);
    lines += tr("The answer holds for all contours that no setting covers, and stays in the dock under Side.");
    asked->setInformativeText(Qt::convertFromPlainText(lines.join(QLatin1Char('\n'))));
    QHash<QAbstractButton *, QString> sides;
    const auto offer = [&](const QString &text, const char *value) {
        QPushButton *button = asked->addButton(text, QMessageBox::AcceptRole);
        sides.insert(button, QString::fromLatin1(value));
    };
    offer(nesting, "auto");
    offer(opening, "opening");
    offer(punch, "punch");
    asked->setEscapeButton(asked->addButton(tr("Cancel"), QMessageBox::RejectRole));
    QObject::connect(asked, &QMessageBox::buttonClicked, [sides, chosen](QAbstractButton *button) {
        if (sides.contains(button))
            chosen(sides.value(button));
    });
    asked->open();
}

void pairSizes(const PairSizes &proposed, std::function<void(const PairSizes &)> chosen)
{
    QDialog *dialog = new QDialog(host::mainWindow());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setObjectName(QStringLiteral("wedm_pair_sizes"));
    dialog->setWindowTitle(tr("Punch and plate"));
    QComboBox *drawnAs = new QComboBox;
    drawnAs->setObjectName(QStringLiteral("wedm_drawn_as"));
    drawnAs->addItem(tr("punch"), QStringLiteral("punch"));
    drawnAs->addItem(tr("plate"), QStringLiteral("plate"));
    drawnAs->setCurrentIndex(qMax(0, drawnAs->findData(proposed.drawnAs)));
    const auto length = [](const char *name, double value) {
        QDoubleSpinBox *made = new QDoubleSpinBox;
        made->setObjectName(QString::fromLatin1(name));
        made->setDecimals(4);
        made->setRange(0, 5);
        made->setSingleStep(0.005);
        made->setSuffix(tr(" mm"));
        made->setValue(value);
        return made;
    };
    QDoubleSpinBox *clearance = length("wedm_clearance", proposed.clearance);
    QDoubleSpinBox *wire = length("wedm_wire", proposed.wireDiameter);
    QDoubleSpinBox *gap = length("wedm_gap", proposed.gap);
    QLabel *note = new QLabel(tr("For this time. Kept in a wedm.toml beside the drawing (pair.drawn-as, pair.clearance, wire-diameter, gap), they hold always."));
    note->setWordWrap(true);
    QDialogButtonBox *buttons = new QDialogButtonBox;
    buttons->addButton(tr("OK"), QDialogButtonBox::AcceptRole);
    buttons->addButton(tr("Cancel"), QDialogButtonBox::RejectRole);
    QFormLayout *form = new QFormLayout(dialog);
    form->addRow(tr("Drawn is the size of the"), drawnAs);
    form->addRow(tr("Clearance on each side"), clearance);
    form->addRow(tr("Diameter of the wire"), wire);
    form->addRow(tr("Spark gap"), gap);
    form->addRow(note);
    form->addRow(buttons);
    QObject::connect(buttons, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    QObject::connect(dialog, &QDialog::accepted, dialog, [=] {
        PairSizes sizes;
        sizes.drawnAs = drawnAs->currentData().toString();
        sizes.clearance = clearance->value();
        sizes.wireDiameter = wire->value();
        sizes.gap = gap->value();
        chosen(sizes);
    });
    dialog->open();
}

void serverProgram(const QString &now, std::function<void(const QString &)> chosen)
{
    QFileDialog *dialog = new QFileDialog(host::mainWindow(), tr("The program of the wedm server"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    if (!now.isEmpty())
        dialog->selectFile(now);
    QObject::connect(dialog, &QFileDialog::fileSelected, chosen);
    dialog->open();
}

void writeAllTheSame(const QString &reason, const QStringList &findings, std::function<void()> forced)
{
    QMessageBox *asked = box(QMessageBox::Warning, "wedm_refused", reason);
    // The informative text renders whatever looks like mark-up, whatever the format of the main text.
    asked->setInformativeText(Qt::convertFromPlainText(findings.mid(0, NAMED).join(QLatin1Char('\n'))));
    QPushButton *force = asked->addButton(tr("Write it all the same"), QMessageBox::DestructiveRole);
    QPushButton *close = asked->addButton(tr("Close"), QMessageBox::RejectRole);
    asked->setDefaultButton(close);
    asked->setEscapeButton(close);
    QObject::connect(asked, &QMessageBox::buttonClicked, [force, forced](QAbstractButton *button) {
        if (button == force)
            forced();
    });
    asked->open();
}

void longRebuild(qint64 milliseconds, std::function<void()> go, std::function<void()> cancel)
{
    QMessageBox *asked = box(QMessageBox::Question, "wedm_rebuild", tr("This repair rebuilds a large polyline."));
    asked->setInformativeText(tr("LibreCAD would be busy for about %1 s, because a plugin can only replace a polyline as a whole. "
                                 "Another way: save the drawing and repair the file with \"wedm fix FILE --in-place\", which takes no time.")
                                  .arg(qMax<qint64>(1, milliseconds / 1000)));
    QPushButton *here = asked->addButton(tr("Repair it here"), QMessageBox::AcceptRole);
    QPushButton *no = asked->addButton(tr("Cancel"), QMessageBox::RejectRole);
    asked->setDefaultButton(no);
    asked->setEscapeButton(no);
    QObject::connect(asked, &QMessageBox::buttonClicked, [here, go, cancel](QAbstractButton *button) {
        if (button == here)
            go();
        else
            cancel();
    });
    asked->open();
}

} // namespace dialogs
} // namespace wedm
