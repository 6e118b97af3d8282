// SPDX-License-Identifier: GPL-2.0-or-later
#include "language.h"

#include <QCoreApplication>
#include <QLocale>
#include <QSettings>
#include <QTranslator>

namespace wedm {

QString language()
{
    // LibreCAD's own settings: it has given the application its names.
    const bool isNamed = !QCoreApplication::organizationName().isEmpty();
    const QString set = isNamed ? QSettings().value(QStringLiteral("Appearance/Language")).toString() : QString();
    const QLocale locale = set.isEmpty() ? QLocale::system() : QLocale(set);
    return locale.language() == QLocale::C ? QStringLiteral("en") : locale.bcp47Name();
}

void speakLanguage()
{
    // Qt finds wedm_zh.qm for zh, zh-CN and zh-Hans.
    auto *translator = new QTranslator(QCoreApplication::instance());
    if (translator->load(QLocale(language()), QStringLiteral("wedm"), QStringLiteral("_"), QStringLiteral(":/wedm/translations")))
        QCoreApplication::installTranslator(translator);
    else
        delete translator;
}

} // namespace wedm
