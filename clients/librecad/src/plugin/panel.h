// SPDX-License-Identifier: GPL-2.0-or-later
// The dock: the radius list, what was found, the settings, the buttons. Knows neither the drawing nor the server.
#pragma once

#include "drawings.h"
#include "radius_table.h"

#include <QDockWidget>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QListWidget;
class QPushButton;
class QTableView;

namespace wedm {

class Panel : public QDockWidget {
    Q_OBJECT
public:
    enum class Tone { Plain, Good, Bad };

    explicit Panel(QWidget *parent);

    /// What the server is doing; shown until the next.
    void setServer(Server::State state, const QString &text);
    /// The correction that radii are checked against, and where it comes from.
    void setInForce(const InForce &settings);
    /// The outcome of the last command.
    void setMessage(const QString &text, Tone tone);
    void setLive(const QString &text);
    void setFindings(const QVector<Finding> &findings);
    void setInspection(const QSharedPointer<Inspection> &inspection);
    /// Whether the drawing has changed since what is shown was found, and how: then it is grey, and marked as outdated.
    void setStale(Stale stale);
    /// What in the drawing is not checked; empty where everything is.
    void setUnchecked(const QString &text);
    /// Everything that belongs to a drawing goes.
    void clear();

    void setSettings(double correction, const QString &side);
    /// As if the user had chosen it.
    void chooseSide(const QString &side);
    double correction() const;
    QString side() const;

signals:
    /// One of those of the menu.
    void commandWanted(const char *command);
    void fixOneWanted(const QString &handle, int segment);
    void serverWanted();
    void settingsChanged();
    void placeWanted(const QPointF &middle, double size);

private:
    void placeOf(const Row &row);
    void showDetails();
    void showCount();
    void colourList();
    QPushButton *button(const QString &text, const char *command, const QString &tip);

    /// Errors, warnings and notes.
    int m_counts[3] = {};
    bool m_isChecked = false;
    Stale m_stale = Stale::No;
    bool m_isLive = false;

    RadiusTable *m_table;
    QTableView *m_view;
    QListWidget *m_list;
    QLabel *m_server;
    QLabel *m_inForce;
    QLabel *m_message;
    QLabel *m_live;
    QLabel *m_unchecked;
    QLabel *m_count;
    QComboBox *m_show;
    QComboBox *m_side;
    QDoubleSpinBox *m_correction;
    QPushButton *m_fixOne;
    QVector<Finding> m_findings;
};

} // namespace wedm
