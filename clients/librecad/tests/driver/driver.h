// SPDX-License-Identifier: GPL-2.0-or-later
// Plays the user in a real LibreCAD: triggers the menu's actions, reads the dock, saves, undoes. Sees the plugin from outside only.
#pragma once

#include <QElapsedTimer>
#include <QMainWindow>
#include <QObject>
#include <QTimer>
#include <QUrl>
#include <QtPlugin>

#include <functional>

class QAction;
class QDialog;

/// Longer than anything takes here, also on a busy machine with a server that is not optimised, in ms: a wait ends as soon as its condition holds.
constexpr int PATIENCE = 300000;

class Driver : public QObject {
    Q_OBJECT
    Q_PLUGIN_METADATA(IID "wedm.test.Driver" FILE "driver.json")
public:
    Driver();

public slots:
    /// Takes the place of the browser.
    void shown(const QUrl &url) { m_shown = url; }

private:
    void run();
    void scenario(const QString &name);

    void check();
    void fix();
    void fixChain();
    void fixOne();
    void generate();
    void formats();
    void counterbore();
    void pair();
    void fit();
    void drill();
    void figures();
    void report();
    void chinese();
    void path();
    void hole();
    void stale();
    void colours();
    void marks();
    void live();
    void missing();
    void windows();
    void settings();
    void otherVersion();
    void killed();
    void undoOnTheWay();
    void editOnTheWay();
    void large();
    void zoom();
    void watch();
    void writePlaces(const QString &path) const;

    // What a user does.
    QAction *action(const QString &name) const;
    void choose(const QString &menuEntry);
    void press(const QString &hostAction);
    void type(const QString &line);
    /// Acts once the message in the dock contains these words; for commands that run an event loop of their own.
    void whenAsked(const QString &words, std::function<void()> act);
    /// Takes the message away that stands in the dock, so that the next one is seen to come.
    void forgetMessage();
    void confirm();
    void drawLine();
    void touch();
    QWidget *view() const;
    QObject *controller() const;
    void save();
    void acceptFile(const QString &path);
    void acceptFolder(const QString &path);
    void accept(const char *name, const QString &what, const QString &path);
    /// Presses the button of an open box that bears this text.
    void answer(const char *box, const QString &button);
    void set(const char *combo, const QVariant &value);

    // What a user sees.
    enum Column { ENTITY, VERTEX, RADIUS, VERDICT };
    QString text(const char *label) const;
    QString cell(int row, int column) const;
    /// The window of that name with a table, once it is there.
    QDialog *sheet(const char *name);
    QString cellOf(QDialog *sheet, int row, const QString &head) const;
    int rows() const;
    QStringList findings() const;
    QString verdictOf(const QString &radius) const;

    // What stands in the saved file, as the command line sees it.
    QString saved(const QString &key);
    /// What the command line writes to stdout about the saved file.
    QByteArray told(const QStringList &arguments);
    /// What the command line finds in the saved file.
    QString checked();
    int entitiesSaved(const QByteArray &type);
    /// Whether the saved file has a line that is exactly this.
    bool isSaved(const QByteArray &line);

    bool wait(const std::function<bool()> &condition, int milliseconds = PATIENCE);
    void expect(const QString &what, bool good, const QString &seen = QString());
    void expectSoon(const QString &what, const std::function<bool()> &condition, const std::function<QString()> &seen = {}, int milliseconds = PATIENCE);
    void print(const QString &what);

    QMainWindow *m_main = nullptr;
    QString m_file;
    QUrl m_shown;
    int m_failed = 0;
};

/// The longest time in which the event loop did not come round, and what of it one painting of the drawing took.
class Blocks : public QObject {
public:
    explicit Blocks(QObject *parent);
    qint64 longest() const { return m_longest; }
    qint64 painting() const { return m_painting; }
    /// The longest single event that was no painting of the drawing.
    qint64 other() const { return m_other; }
    void restart();

protected:
    bool eventFilter(QObject *object, QEvent *event) override;

private:
    QTimer m_timer;
    QElapsedTimer m_clock;
    QElapsedTimer m_sinceEvent;
    bool m_isPainting = false;
    qint64 m_longest = 0;
    qint64 m_painting = 0;
    qint64 m_other = 0;
};
