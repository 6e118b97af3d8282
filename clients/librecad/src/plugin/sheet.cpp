// SPDX-License-Identifier: GPL-2.0-or-later
#include "sheet.h"

#include <QApplication>
#include <QBoxLayout>
#include <QClipboard>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>

#include <algorithm>

namespace wedm {

namespace {

/// The number of rows that are shown: nobody reads more, and laying them out blocks LibreCAD. All of them are copied.
constexpr int MOST_SHOWN = 1000;
constexpr int WIDTH = 1180;
constexpr int HEIGHT = 420;

QLabel *label(const char *name, const QString &text)
{
    QLabel *made = new QLabel(text);
    made->setObjectName(QString::fromLatin1(name));
    // Names come out of drawings.
    made->setTextFormat(Qt::PlainText);
    made->setWordWrap(true);
    made->setTextInteractionFlags(Qt::TextSelectableByMouse);
    made->setVisible(!text.isEmpty());
    return made;
}

} // namespace

Sheet::Sheet(const char *name, const SheetContent &content, QWidget *parent)
    : QDialog(parent)
    , m_content(content)
    , m_table(new QTableWidget)
    , m_buttons(new QHBoxLayout)
{
    setAttribute(Qt::WA_DeleteOnClose);
    setObjectName(QString::fromLatin1(name));
    setWindowTitle(content.title);
    resize(WIDTH, HEIGHT);
    QLabel *sentence = label("wedm_sheet_sentence", content.sentence);
    const bool isGood = content.verdict == SheetContent::Verdict::Good;
    if (content.verdict != SheetContent::Verdict::None)
        sentence->setStyleSheet(isGood ? QStringLiteral("padding: 4px; background: #d8f0d8; color: #064006;")
                                       : QStringLiteral("padding: 4px; background: #ffd9d0; color: #6a1000;"));
    m_table->setObjectName(QStringLiteral("wedm_sheet_table"));
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->verticalHeader()->hide();
    m_table->setColumnCount(content.heads.size());
    m_table->setHorizontalHeaderLabels(content.heads);
    m_table->setRowCount(qMin(content.rows.size(), MOST_SHOWN));
    for (int i = 0; i < m_table->rowCount(); ++i)
        for (int column = 0; column < content.heads.size(); ++column)
            m_table->setItem(i, column, new QTableWidgetItem(content.rows.at(i).value(column)));
    // What is known of no row has no column.
    for (int column = 0; column < content.heads.size(); ++column)
        m_table->setColumnHidden(column, std::all_of(content.rows.begin(), content.rows.end(), [=](const QStringList &row) { return row.value(column).isEmpty(); }));
    m_table->resizeColumnsToContents();
    m_table->setVisible(!content.rows.isEmpty());
    QStringList notes = content.notes;
    if (content.rows.size() > MOST_SHOWN)
        notes.prepend(tr("and %1 more, which Copy takes along").arg(content.rows.size() - MOST_SHOWN));

    QVBoxLayout *layout = new QVBoxLayout(this);
    layout->addWidget(sentence);
    layout->addWidget(m_table, 1);
    layout->addWidget(label("wedm_sheet_notes", notes.join(QLatin1Char('\n'))));
    m_buttons->addStretch(1);
    layout->addLayout(m_buttons);
    addButton("wedm_sheet_copy", tr("Copy"), [this] { copy(); });
    addButton("wedm_sheet_close", tr("Close"), [this] { close(); });
    connect(m_table, &QTableWidget::cellDoubleClicked, this, [this](int row) {
        if (row < m_content.places.size())
            emit placeWanted(m_content.places.at(row).first, m_content.places.at(row).second);
    });
}

void Sheet::addButton(const char *name, const QString &text, const std::function<void()> &clicked)
{
    QPushButton *button = new QPushButton(text);
    button->setObjectName(QString::fromLatin1(name));
    button->setAutoDefault(false);
    connect(button, &QPushButton::clicked, this, clicked);
    m_buttons->addWidget(button);
}

/// Columns with tabs between them, as a spreadsheet takes them.
void Sheet::copy()
{
    QStringList lines{m_content.sentence, m_content.heads.join(QLatin1Char('\t'))};
    for (const QStringList &row : qAsConst(m_content.rows))
        lines += row.join(QLatin1Char('\t'));
    QApplication::clipboard()->setText((lines + m_content.notes).join(QLatin1Char('\n')));
}

} // namespace wedm
