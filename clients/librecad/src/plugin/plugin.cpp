// SPDX-License-Identifier: GPL-2.0-or-later
#include "plugin.h"

#include "controller.h"
#include "core/language.h"

namespace {

/// LibreCAD finds or makes a menu of this name.
const char MENU[] = "Wire EDM";

} // namespace

WedmPlugin::WedmPlugin()
    : m_controller((wedm::speakLanguage(), new wedm::Controller(this)))
{
}

QString WedmPlugin::name() const
{
    return QStringLiteral("wedm");
}

PluginCapabilities WedmPlugin::getCapabilities() const
{
    PluginCapabilities capabilities;
    const auto add = [&](const char *command) {
        capabilities.menuEntryPoints << PluginMenuLocation(QString::fromLatin1(MENU), QString::fromUtf8(command));
    };
    for (const char *command : wedm::command::SHOWN)
        add(command);
    add(wedm::command::LOOK);
    add(wedm::command::APPLY);
    return capabilities;
}

void WedmPlugin::execComm(Document_Interface *drawing, QWidget *, QString command)
{
    if (drawing)
        m_controller->run(command, *drawing);
}
