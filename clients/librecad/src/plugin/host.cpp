// SPDX-License-Identifier: GPL-2.0-or-later
#include "host.h"

#include <QAction>
#include <QApplication>
#include <QFileInfo>
#include <QMainWindow>
#include <QMdiArea>
#include <QMdiSubWindow>
#include <QRegularExpression>
#include <QSet>

#ifdef Q_OS_WIN
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace wedm {
namespace host {

QString builtFor()
{
    return QStringLiteral(WEDM_LIBRECAD_VERSION);
}

QString versionFault()
{
    // Distributions add "-alpha", "-1" and the like to the same interface.
    const QString running = QCoreApplication::applicationVersion();
    const QString numbers = running.section(QRegularExpression(QStringLiteral("[^0-9.]")), 0, 0);
    if (numbers == builtFor() || running.startsWith(builtFor() + QLatin1Char('-')))
        return QString();
    return QObject::tr("This plugin was built for LibreCAD %1, and this is LibreCAD %2. The plugin interface changes between versions "
                       "without notice, so nothing is done. Build the plugin against the source of this version.")
        .arg(builtFor(), running);
}

QMainWindow *mainWindow()
{
    const QWidgetList windows = QApplication::topLevelWidgets();
    for (QWidget *window : windows) {
        if (window->inherits("QC_ApplicationWindow"))
            return qobject_cast<QMainWindow *>(window);
    }
    return nullptr;
}

QMdiSubWindow *currentWindow()
{
    const QMainWindow *window = mainWindow();
    const QMdiArea *area = window ? window->findChild<QMdiArea *>() : nullptr;
    return area ? area->currentSubWindow() : nullptr;
}

QAction *action(const char *name)
{
    const QMainWindow *window = mainWindow();
    return window ? window->findChild<QAction *>(QString::fromLatin1(name)) : nullptr;
}

bool redoIsPossible()
{
    const QAction *redo = action("EditRedo");
    return redo && redo->isEnabled();
}

bool userIsBusy()
{
    return QApplication::activeModalWidget() || QApplication::activePopupWidget() || QApplication::mouseButtons() != Qt::NoButton;
}

QString filePath(const QMdiSubWindow *window)
{
    const QMainWindow *main = mainWindow();
    if (!main || !window)
        return QString();
    const QString name = window->windowTitle().section(QStringLiteral("[*]"), 0, 0);
    QSet<QString> paths;
    const QList<QAction *> actions = main->findChildren<QAction *>();
    for (const QAction *each : actions) {
        const QFileInfo file(each->data().toString());
        if (file.isAbsolute() && file.fileName() == name && file.exists())
            paths.insert(file.canonicalFilePath());
    }
    return paths.size() == 1 ? *paths.begin() : QString();
}

QString pluginFolder()
{
#ifdef Q_OS_WIN
    HMODULE module = nullptr;
    wchar_t path[MAX_PATH] = {};
    GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                       reinterpret_cast<LPCWSTR>(&pluginFolder), &module);
    GetModuleFileNameW(module, path, MAX_PATH);
    return QFileInfo(QString::fromWCharArray(path)).absolutePath();
#else
    Dl_info info;
    if (dladdr(reinterpret_cast<void *>(&pluginFolder), &info) == 0 || !info.dli_fname)
        return QString();
    return QFileInfo(QFile::decodeName(info.dli_fname)).absolutePath();
#endif
}

} // namespace host
} // namespace wedm
