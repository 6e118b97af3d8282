// SPDX-License-Identifier: GPL-2.0-or-later
// The settings that the plugin keeps from one start of LibreCAD to the next.
#pragma once

#include "dialogs.h"

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
    /// The sizes of the last pair, which are proposed for the next one.
    dialogs::PairSizes pairSizes() const
    {
        dialogs::PairSizes sizes;
        sizes.drawnAs = m_file.value("pair/drawnAs", sizes.drawnAs).toString();
        sizes.clearance = m_file.value("pair/clearance", sizes.clearance).toDouble();
        sizes.wireDiameter = m_file.value("pair/wireDiameter", sizes.wireDiameter).toDouble();
        sizes.gap = m_file.value("pair/gap", sizes.gap).toDouble();
        return sizes;
    }
    void setPairSizes(const dialogs::PairSizes &sizes)
    {
        m_file.setValue("pair/drawnAs", sizes.drawnAs);
        m_file.setValue("pair/clearance", sizes.clearance);
        m_file.setValue("pair/wireDiameter", sizes.wireDiameter);
        m_file.setValue("pair/gap", sizes.gap);
    }

private:
    QSettings m_file;
};

} // namespace wedm
