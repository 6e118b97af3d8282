// SPDX-License-Identifier: GPL-2.0-or-later
// The entries of the menu, by their names in it, which are shown in the language of the windows. The last two are the plugin's own: they are LibreCAD's only way to let a plugin at
// the drawing, and are taken out of the menu.
#pragma once

#include <QtGlobal>

namespace wedm {
namespace command {

constexpr char CHECK[] = QT_TRANSLATE_NOOP("wedm::command", "Check radii");
constexpr char LIVE[] = QT_TRANSLATE_NOOP("wedm::command", "Live check");
constexpr char FIX[] = QT_TRANSLATE_NOOP("wedm::command", "Fix");
constexpr char GENERATE[] = QT_TRANSLATE_NOOP("wedm::command", "Generate 3B…");
constexpr char GENERATE_4B[] = QT_TRANSLATE_NOOP("wedm::command", "Generate 4B…");
constexpr char GENERATE_ISO[] = QT_TRANSLATE_NOOP("wedm::command", "Generate ISO…");
constexpr char GENERATE_MILLING[] = QT_TRANSLATE_NOOP("wedm::command", "Generate milling…");
constexpr char PAIR[] = QT_TRANSLATE_NOOP("wedm::command", "Generate the programs of the pair…");
constexpr char FIT[] = QT_TRANSLATE_NOOP("wedm::command", "Show whether punch and plate fit");
constexpr char DRILL[] = QT_TRANSLATE_NOOP("wedm::command", "Save drill list…");
constexpr char FIGURES[] = QT_TRANSLATE_NOOP("wedm::command", "Show figures");
constexpr char REPORT[] = QT_TRANSLATE_NOOP("wedm::command", "Make a report");
constexpr char HOLE[] = QT_TRANSLATE_NOOP("wedm::command", "Pick thread hole");
constexpr char PATH[] = QT_TRANSLATE_NOOP("wedm::command", "Draw wire path");
constexpr char CLEAR_PATH[] = QT_TRANSLATE_NOOP("wedm::command", "Clear wire path");
constexpr char MARK[] = QT_TRANSLATE_NOOP("wedm::command", "Mark faults");
constexpr char CLEAR[] = QT_TRANSLATE_NOOP("wedm::command", "Clear marks");
constexpr char LOOK[] = "wedm look";
constexpr char APPLY[] = "wedm apply";

/// Those of the menu, in its order.
constexpr const char *SHOWN[] = {CHECK,       LIVE,         FIX,              FIGURES, HOLE, PATH,  CLEAR_PATH, GENERATE,
                                 GENERATE_4B, GENERATE_ISO, GENERATE_MILLING, PAIR,    FIT,  DRILL, REPORT,     MARK,
                                 CLEAR};

} // namespace command
} // namespace wedm
