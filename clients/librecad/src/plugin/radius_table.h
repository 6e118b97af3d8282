// SPDX-License-Identifier: GPL-2.0-or-later
// The radius list as a table: vertex, radius, verdict. Holds rows as they came; decides nothing.
#pragma once

#include "core/messages.h"

#include <QAbstractTableModel>
#include <QSharedPointer>

namespace wedm {

class RadiusTable : public QAbstractTableModel {
    Q_OBJECT
public:
    enum class Show { Faults, Arcs, All };
    enum Column { Vertex, Radius, Verdict, Sweep, Kind, X, Y, Entity, Layer, Columns };

    explicit RadiusTable(QObject *parent = nullptr);

    void setInspection(const QSharedPointer<Inspection> &inspection);
    void setShow(Show show);
    const Row *row(int index) const;
    int find(const QString &handle, int segment) const;
    /// Of all rows, shown or not.
    int faults() const { return m_faults; }

    int rowCount(const QModelIndex &parent = QModelIndex()) const override;
    int columnCount(const QModelIndex &parent = QModelIndex()) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    void choose();
    QString unit() const;

    QSharedPointer<Inspection> m_inspection;
    QVector<int> m_shown;
    Show m_show = Show::Arcs;
    int m_faults = 0;
};

} // namespace wedm
