// SPDX-License-Identifier: GPL-2.0-or-later
// What the plugin must know of LibreCAD's windows, found out through Qt alone. Nothing here touches a drawing.
#pragma once

#include <QString>

class QAction;
class QMainWindow;
class QMdiSubWindow;
class QObject;
class QWidget;

namespace wedm {
namespace host {

/// The version of LibreCAD whose headers this plugin was built with, as in "2.2.0".
QString builtFor();

/// Empty when this LibreCAD has the interface the plugin was built for, else what is wrong.
QString versionFault();

QMainWindow *mainWindow();

/// The window of the drawing that is worked on; null when there is none.
QMdiSubWindow *currentWindow();

/// Whether something undone could still be done again. A look at the drawing through the plugin interface would end that.
bool redoIsPossible();

/// Whether the user is in the middle of something a look at the drawing might disturb: a dialog, an open menu, a held button.
bool userIsBusy();

/// The file of the drawing in `window`: its title holds the name only, LibreCAD's list of recent files the path.
/// Empty when it has none, or when two recent files bear the name.
QString filePath(const QMdiSubWindow *window);

/// The folder that this plugin lies in.
QString pluginFolder();

/// LibreCAD's action of this name, as in "EditUndo"; null when there is none.
QAction *action(const char *name);

} // namespace host
} // namespace wedm
