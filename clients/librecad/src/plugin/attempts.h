// SPDX-License-Identifier: GPL-2.0-or-later
// Asks the session for something made of a drawing, and asks again as the user answers what was refused: on which side the wire runs,
// what the parts of a pair are, whether it is to be made all the same. Only what was made is handed on, so that no file name is asked for
// before there is something to be written.
#pragma once

#include "core/program.h"
#include "kept.h"
#include "panel.h"

#include <QHash>

#include <functional>

namespace wedm {

/// What is wanted, of which drawing.
struct Wanted {
    QString uri;
    QString method;
    QJsonObject params;
    /// An electrode mills it; no wire cuts it.
    bool mills = false;
    /// What the message begins with where it cannot be made.
    QString failure;
    /// Gets what was made, and the settings that the user has given on the way.
    std::function<void(const QJsonObject &result, const QJsonObject &options)> made;
};

class Attempts : public QObject {
    Q_OBJECT
public:
    Attempts(Kept &kept, QObject *parent);

    void begin(const Wanted &wanted);
    /// A number that no other question has.
    int number() { return ++m_last; }
    /// Asks on which side the wire runs. The answer also becomes the dock's; `go` gets it.
    void askSide(bool mills, const std::function<void(const QString &side)> &go);

public slots:
    void answered(int number, const QJsonObject &result);
    void refused(int number, const wedm::Refusal &refusal);

signals:
    /// For the session.
    void asked(int number, const QString &uri, const QString &method, const QJsonObject &params);
    void sideChosen(const QString &side);
    void said(const QString &text, wedm::Panel::Tone tone);

private:
    Kept &m_kept;
    QHash<int, Wanted> m_waiting;
    int m_last = 0;
};

} // namespace wedm
