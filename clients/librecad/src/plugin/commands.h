// SPDX-License-Identifier: GPL-2.0-or-later
// The entries of the menu, by their names in it. The last two are the plugin's own: they are LibreCAD's only way to let a plugin at
// the drawing, and are taken out of the menu.
#pragma once

namespace wedm {
namespace command {

constexpr char CHECK[] = "Check radii";
constexpr char LIVE[] = "Live check";
constexpr char FIX[] = "Fix";
constexpr char GENERATE[] = "Generate 3B…";
constexpr char MARK[] = "Mark faults";
constexpr char CLEAR[] = "Clear marks";
constexpr char LOOK[] = "wedm look";
constexpr char APPLY[] = "wedm apply";

} // namespace command
} // namespace wedm
