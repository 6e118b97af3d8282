// SPDX-License-Identifier: GPL-2.0-or-later
#include "dialogs.h"

#include "host.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
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
    asked->setDefaultButton(asked->addButton(QMessageBox::Close));
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
    asked->setDefaultButton(asked->addButton(QMessageBox::Cancel));
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
