// SPDX-License-Identifier: GPL-2.0-or-later
// A window with a sentence, a table and notes: figures of a drawing, whether punch and plate fit. Knows neither the drawing nor the server.
#pragma once

#include <QDialog>
#include <QPointF>
#include <QVector>

#include <functional>

class QBoxLayout;
class QTableWidget;

namespace wedm {

/// What such a window shows.
struct SheetContent {
    QString title;
    QString sentence;
    /// The sentence is green, else red; of something that is no verdict it is neither.
    enum class Verdict { None, Good, Bad } verdict = Verdict::None;
    QStringList heads;
    QVector<QStringList> rows;
    /// For each row what a double click shows: the middle and the size, in drawing units.
    QVector<QPair<QPointF, double>> places;
    QStringList notes;
};

class Sheet : public QDialog {
    Q_OBJECT
public:
    Sheet(const char *name, const SheetContent &content, QWidget *parent);

    void addButton(const char *name, const QString &text, const std::function<void()> &clicked);

signals:
    void placeWanted(const QPointF &middle, double size);

private:
    void copy();

    SheetContent m_content;
    QTableWidget *m_table;
    QBoxLayout *m_buttons;
};

} // namespace wedm
