// SPDX-License-Identifier: GPL-2.0-or-later
// The settings that the plugin keeps from one start of LibreCAD to the next.
#pragma once

#include <QSettings>

namespace wedm {

class Kept {
public:
    Kept()
        : m_file(QSettings::IniFormat, QSettings::UserScope, QStringLiteral("wedm"), QStringLiteral("librecad"))
    {
    }

    QString server() const { return m_file.value("server").toString(); }
    void setServer(const QString &path) { m_file.setValue("server", path); }
    /// mm; 0 where none is set.
    double correction() const { return m_file.value("correction").toDouble(); }
    void setCorrection(double correction) { m_file.setValue("correction", correction); }
    QString side() const { return m_file.value("side").toString(); }
    void setSide(const QString &side) { m_file.setValue("side", side); }
    bool live() const { return m_file.value("live").toBool(); }
    void setLive(bool on) { m_file.setValue("live", on); }

private:
    QSettings m_file;
};

} // namespace wedm
