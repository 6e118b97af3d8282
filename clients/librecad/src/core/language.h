// SPDX-License-Identifier: GPL-2.0-or-later
// The language of the program that loads the plugin: the plugin and the server speak it.
#pragma once

#include <QString>

namespace wedm {

/// A tag as LSP has it, such as `zh-CN`: what LibreCAD is set to, else what the system speaks.
QString language();

/// Lets `tr` speak it, where there is a translation. For the thread of the windows, before the first window is made.
void speakLanguage();

} // namespace wedm
