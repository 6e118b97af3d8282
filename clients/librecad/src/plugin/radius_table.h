// SPDX-License-Identifier: GPL-2.0-or-later
// The radius list as a table: vertex, radius, verdict. Holds rows as they came; decides nothing.
#pragma once

#include "core/messages.h"

#include <QAbstractTableModel>
#include <QHash>
#include <QSharedPointer>

namespace wedm {

class RadiusTable : public QAbstractTableModel {
    Q_OBJECT
public:
    enum class Show { Faults, Arcs, All };
    enum Column { Entity, Vertex, Radius, Verdict, Sweep, Kind, X, Y, Layer, Columns };

    explicit RadiusTable(QObject *parent = nullptr);

    /// What was found, for the colours of the rows.
    void setFindings(const QVector<Finding> &findings);
    /// Whether the drawing has changed since: then all rows are grey.
    void setStale(bool stale);
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
    /// The worst of what was found on a segment. Of findings that are not sent, the severity is that of their rule elsewhere.
    bool severityOf(const Row &row, Severity *severity) const;
    void recolour();

    QSharedPointer<Inspection> m_inspection;
    QVector<int> m_shown;
    QHash<QPair<QString, int>, Severity> m_bySegment;
    QHash<QString, Severity> m_byRule;
    bool m_isStale = false;
    Show m_show = Show::Arcs;
    int m_faults = 0;
};

} // namespace wedm
