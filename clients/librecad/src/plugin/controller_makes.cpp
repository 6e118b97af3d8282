// SPDX-License-Identifier: GPL-2.0-or-later
// What is made of a drawing on a command: programs, those of a pair, the drill list, whether the parts fit, figures, a report.
#include "controller.h"

#include "dialogs.h"
#include "host.h"
#include "programs.h"
#include "sheet.h"

#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QJsonArray>
#include <QMainWindow>
#include <QMdiSubWindow>
#include <QTemporaryFile>
#include <QUrl>

namespace wedm {

void Controller::make(const QString &command, const QString &uri)
{
    const auto is = [&](const char *name) { return command == QString::fromUtf8(name); };
    if (is(command::GENERATE))
        generate(uri, QStringLiteral("3b"));
    else if (is(command::GENERATE_4B))
        generate(uri, QStringLiteral("4b"));
    else if (is(command::GENERATE_ISO))
        generate(uri, QStringLiteral("iso"));
    else if (is(command::GENERATE_MILLING))
        generate(uri, QStringLiteral("milling"));
    else if (is(command::PAIR))
        dialogs::pairFormat([this, uri](const QString &format) { generatePair(uri, format); });
    else if (is(command::DRILL))
        saveDrillList(uri);
    else if (is(command::FIT))
        showFit(uri);
    else if (is(command::FIGURES))
        post([uri](Session &session) { session.requestFigures(uri); });
    else if (is(command::REPORT))
        report(uri);
}

void Controller::say(const QString &text, Panel::Tone tone)
{
    if (m_panel)
        m_panel->setMessage(text, tone);
}

QPair<QString, QString> Controller::proposal(const QString &uri)
{
    QMdiSubWindow *window = nullptr;
    const OpenDrawing *open = m_drawings.find(uri, &window);
    const QString path = open ? host::filePath(window) : QString();
    const QString base = path.isEmpty() ? tr("drawing") : QFileInfo(path).completeBaseName();
    const QString folder = open && !open->folder.isEmpty() ? open->folder : m_lastFolder;
    return {folder.isEmpty() ? QDir::currentPath() : folder, base};
}

void Controller::choseFolder(const QString &uri, const QString &folder)
{
    m_lastFolder = folder;
    if (OpenDrawing *open = m_drawings.find(uri))
        open->folder = folder;
}

void Controller::generate(const QString &uri, const QString &format)
{
    say(tr("The program is being made…"), Panel::Tone::Plain);
    Wanted wanted;
    wanted.uri = uri;
    wanted.method = QStringLiteral("wedm/generate");
    wanted.params = QJsonObject{{"format", format}};
    wanted.mills = format == QLatin1String("milling");
    wanted.failure = tr("No program was made: %1.");
    wanted.made = [this, uri, format](const QJsonObject &result, const QJsonObject &) {
        const Program program = programFromJson(result, format);
        say(tr("The program is made and proved; it is not written yet."), Panel::Tone::Plain);
        const auto [folder, base] = proposal(uri);
        dialogs::programFile(format, folder, base, [this, uri, program](const QString &chosen) {
            choseFolder(uri, QFileInfo(chosen).absolutePath());
            Program written = program;
            written.path = chosen;
            const QString failure = writeFile(chosen, program.text);
            if (!failure.isEmpty())
                say(tr("No program was written to %1: %2.").arg(QDir::toNativeSeparators(chosen), failure), Panel::Tone::Bad);
            else
                say(programs::written(written), program.warnings.isEmpty() ? Panel::Tone::Good : Panel::Tone::Plain);
        });
    };
    m_attempts.begin(wanted);
}

void Controller::generatePair(const QString &uri, const QString &format)
{
    say(tr("The programs are being made…"), Panel::Tone::Plain);
    Wanted wanted;
    wanted.uri = uri;
    wanted.method = QStringLiteral("wedm/pair");
    wanted.params = QJsonObject{{"format", format}};
    wanted.failure = tr("No program was made: %1.");
    wanted.made = [this, uri, format](const QJsonObject &result, const QJsonObject &) {
        QVector<Program> programs;
        const QJsonArray listed = result.value("programs").toArray();
        for (const QJsonValue &each : listed)
            programs += programFromJson(each.toObject(), format);
        say(tr("The programs are made and proved; they are not written yet."), Panel::Tone::Plain);
        const auto [folder, base] = proposal(uri);
        dialogs::folder(tr("Save the programs of the pair"), folder, [this, uri, programs, format, base = base](const QString &chosen) {
            choseFolder(uri, chosen);
            savePair(programs, format, chosen, base);
        });
    };
    m_attempts.begin(wanted);
}

void Controller::savePair(const QVector<Program> &programs, const QString &format, const QString &folder, const QString &base)
{
    QVector<Program> placed = programs;
    QStringList names;
    QStringList there;
    for (Program &each : placed) {
        const QString name = partFile(base, each.part, format);
        if (names.contains(name, Qt::CaseInsensitive)) {
            say(tr("Two parts would be written to %1: give them other names.").arg(name), Panel::Tone::Bad);
            return;
        }
        names += name;
        each.path = QDir(folder).filePath(name);
        if (QFileInfo::exists(each.path))
            there += name;
    }
    const auto write = [this, placed] {
        for (const Program &each : placed) {
            const QString failure = writeFile(each.path, each.text);
            if (!failure.isEmpty()) {
                say(tr("No program was written to %1: %2.").arg(QDir::toNativeSeparators(each.path), failure), Panel::Tone::Bad);
                return;
            }
        }
        say(programs::writtenPair(placed), Panel::Tone::Good);
    };
    if (there.isEmpty())
        write();
    else
        dialogs::overwrite(there, write);
}

void Controller::saveDrillList(const QString &uri)
{
    const auto save = [this](const QString &path, const QJsonObject &result) {
        const QString failure = writeFile(path, QByteArray::fromBase64(result.value("data").toString().toLatin1()));
        const QString shown = QDir::toNativeSeparators(path);
        say(failure.isEmpty() ? tr("The drill list is saved: %1.").arg(shown) : tr("The drill list could not be saved to %1: %2.").arg(shown, failure),
            failure.isEmpty() ? Panel::Tone::Good : Panel::Tone::Bad);
    };
    Wanted wanted;
    wanted.uri = uri;
    wanted.method = QStringLiteral("wedm/holes");
    wanted.params = QJsonObject{{"format", "csv"}};
    wanted.failure = tr("There is no drill list: %1.");
    wanted.made = [this, uri, wanted, save](const QJsonObject &list, const QJsonObject &options) {
        const auto [folder, base] = proposal(uri);
        dialogs::drillFile(folder, base, [=](const QString &chosen) {
            choseFolder(uri, QFileInfo(chosen).absolutePath());
            if (!chosen.endsWith(QLatin1String(".dxf"), Qt::CaseInsensitive)) {
                save(chosen, list);
                return;
            }
            Wanted drawing = wanted;
            drawing.params = QJsonObject{{"format", "dxf"}, {"options", options}};
            drawing.made = [=](const QJsonObject &drawn, const QJsonObject &) { save(chosen, drawn); };
            m_attempts.begin(drawing);
        });
    };
    m_attempts.begin(wanted);
}

void Controller::showFit(const QString &uri)
{
    Wanted wanted;
    wanted.uri = uri;
    wanted.method = QStringLiteral("wedm/fit");
    wanted.failure = tr("Whether the parts fit is not known: %1.");
    wanted.made = [this](const QJsonObject &result, const QJsonObject &) {
        const SheetContent content = programs::fit(result);
        say(content.sentence, content.verdict == SheetContent::Verdict::Good ? Panel::Tone::Good : Panel::Tone::Bad);
        Sheet *sheet = new Sheet("wedm_fit", content, host::mainWindow());
        connect(sheet, &Sheet::placeWanted, this, &Controller::zoom);
        const QByteArray picture = result.value("svg").toString().toUtf8();
        sheet->addButton("wedm_fit_picture", tr("Show the picture"), [this, picture] {
            QTemporaryFile file(QDir::temp().filePath(QStringLiteral("wedm-fit-XXXXXX.svg")));
            file.setAutoRemove(false);
            const bool written = file.open() && file.write(picture) == picture.size();
            file.close();
            if (!written || !QDesktopServices::openUrl(QUrl::fromLocalFile(file.fileName())))
                say(tr("The picture could not be shown: %1.").arg(QDir::toNativeSeparators(file.fileName())), Panel::Tone::Bad);
        });
        sheet->show();
    };
    m_attempts.begin(wanted);
}

void Controller::showFigures(const QString &, const Figures &figures)
{
    const SheetContent content = programs::figures(figures);
    say(content.sentence, Panel::Tone::Plain);
    Sheet *sheet = new Sheet("wedm_figures", content, host::mainWindow());
    connect(sheet, &Sheet::placeWanted, this, &Controller::zoom);
    sheet->show();
}

/// The report is made by `wedm report`, which reads files: of the drawing as it was saved.
void Controller::report(const QString &uri)
{
    QMdiSubWindow *window = nullptr;
    const OpenDrawing *open = m_drawings.find(uri, &window);
    const QString path = open ? host::filePath(window) : QString();
    if (path.isEmpty() || isModified(window)) {
        say(tr("A report is made of the saved file: save the drawing first."), Panel::Tone::Bad);
        return;
    }
    say(tr("The report is being made…"), Panel::Tone::Plain);
    Wanted wanted;
    wanted.uri = uri;
    wanted.method = QStringLiteral("wedm/settings");
    wanted.failure = tr("No report was made: %1.");
    wanted.made = [this, path](const QJsonObject &settings, const QJsonObject &) {
        // On the command line an option wins over every wedm.toml: only what none of them sets is handed on.
        QStringList arguments{QStringLiteral("report")};
        if (settings.value("correctionFrom").toString() == QLatin1String("client"))
            arguments += {QStringLiteral("--correction"), QString::number(settings.value("correction").toDouble())};
        if (settings.value("sideFrom").toString() == QLatin1String("client"))
            arguments += {QStringLiteral("--side"), settings.value("side").toString()};
        const QFileInfo file(path);
        const QString pages = QStringLiteral("report");
        arguments += {QStringLiteral("--output"), pages, QStringLiteral("--"), file.fileName()};
        const int number = m_attempts.number();
        m_reports.insert(number, file.dir().filePath(pages + QStringLiteral("/index.html")));
        post([number, arguments, folder = file.absolutePath()](Session &session) { session.run(number, arguments, folder); });
    };
    m_attempts.begin(wanted);
}

/// The pages are also written where the drawing has errors: the program then ends with 1.
void Controller::reported(int number, int code, const QString &said)
{
    const QString index = m_reports.take(number);
    if (code != 0 && code != 1) {
        say(tr("No report was made: %1").arg(said.isEmpty() ? tr("it ended with code %1").arg(code) : said), Panel::Tone::Bad);
        return;
    }
    QString text = tr("The report is written: %1.").arg(QDir::toNativeSeparators(index));
    if (code == 1)
        text += QLatin1Char(' ') + tr("There are errors in the drawing.");
    const bool isShown = QDesktopServices::openUrl(QUrl::fromLocalFile(index));
    if (!isShown)
        text += QLatin1Char(' ') + tr("No program was found that shows it.");
    say(text, code == 0 && isShown ? Panel::Tone::Good : Panel::Tone::Plain);
}

} // namespace wedm
