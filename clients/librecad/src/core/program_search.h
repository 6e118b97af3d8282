// SPDX-License-Identifier: GPL-2.0-or-later
// Where the server's program is. Knows nothing of how it is started.
#pragma once

#include <QString>

namespace wedm {

struct ProgramSearch {
    /// The path that the user has set; empty: none.
    QString setting;
    /// The folder in which the plugin lies.
    QString pluginFolder;
};

/// The path of the program: what is set, else beside the plugin (best in a folder `wedm-server` there), else on PATH, else where cargo installs.
/// Empty when there is none; `message` then says where it was looked for and how to get it.
/// A setting that names no program is an answer too: nothing else is taken in its place.
QString findProgram(const ProgramSearch &search, QString *message);

} // namespace wedm
