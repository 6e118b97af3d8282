// SPDX-License-Identifier: GPL-2.0-or-later
#include "program_search.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <QStringList>

namespace wedm {

namespace {

#ifdef Q_OS_WIN
const char NAME[] = "wedm.exe";
#else
const char NAME[] = "wedm";
#endif

/// Except on Windows, LibreCAD takes every file beside a plugin for a plugin, and complains if it is none; it ignores folders.
const char FOLDER[] = "wedm-server";

const char HOW_TO_GET_IT[] = QT_TRANSLATE_NOOP("wedm::ProgramSearch",
                             "Build it in wedm's folder with \"cargo install --path .\", or put the program into the folder wedm-server "
                             "beside the plugin, or choose it with the button \"Server…\".");

bool runs(const QString &path)
{
    const QFileInfo file(path);
    return file.isFile() && file.isExecutable();
}

/// The folders of PATH. A relative one depends on where LibreCAD was started, such as the folder of a drawing: it is skipped.
QStringList foldersOfPath()
{
    QStringList folders;
    for (const QString &folder : qEnvironmentVariable("PATH").split(QDir::listSeparator(), Qt::SkipEmptyParts)) {
        if (QDir::isAbsolutePath(folder))
            folders += folder;
    }
    return folders;
}

} // namespace

QString findProgram(const ProgramSearch &search, QString *message)
{
    if (!search.setting.isEmpty()) {
        if (runs(search.setting))
            return search.setting;
        if (message)
            *message = QCoreApplication::translate("wedm::ProgramSearch", "The wedm server is set to \"%1\", and there is no such program. %2")
                           .arg(QDir::toNativeSeparators(search.setting), QCoreApplication::translate("wedm::ProgramSearch", HOW_TO_GET_IT));
        return QString();
    }
    const QDir plugins(search.pluginFolder);
    for (const QString &beside : {plugins.filePath(QStringLiteral("%1/%2").arg(FOLDER, NAME)), plugins.filePath(NAME)}) {
        if (!search.pluginFolder.isEmpty() && runs(beside))
            return beside;
    }
    const QStringList folders = foldersOfPath();
    const QString onPath = folders.isEmpty() ? QString() : QStandardPaths::findExecutable(NAME, folders);
    if (!onPath.isEmpty())
        return onPath;
    // A desktop starts programs without the PATH of the user's shell, so cargo's folder is searched as well.
    const QString ofCargo = QDir::home().filePath(QStringLiteral(".cargo/bin/") + NAME);
    if (runs(ofCargo))
        return ofCargo;
    if (message)
        *message = QCoreApplication::translate("wedm::ProgramSearch", "The wedm server was not found: it is not set, not in \"%1\", not on PATH and not in \"%2\". %3")
                       .arg(QDir::toNativeSeparators(plugins.filePath(FOLDER)), QDir::toNativeSeparators(QFileInfo(ofCargo).path()),
                            QCoreApplication::translate("wedm::ProgramSearch", HOW_TO_GET_IT));
    return QString();
}

} // namespace wedm
