// SPDX-License-Identifier: GPL-2.0-or-later
// What LibreCAD loads. It does nothing itself.
#pragma once

#include "document_interface.h"
#include "qc_plugininterface.h"

#include <QObject>

namespace wedm {
class Controller;
}

class WedmPlugin : public QObject, public QC_PluginInterface {
    Q_OBJECT
    Q_INTERFACES(QC_PluginInterface)
    Q_PLUGIN_METADATA(IID LC_DocumentInterface_iid FILE "wedm.json")
public:
    WedmPlugin();

    QString name() const override;
    PluginCapabilities getCapabilities() const override;
    void execComm(Document_Interface *drawing, QWidget *parent, QString command) override;

private:
    wedm::Controller *m_controller;
};
