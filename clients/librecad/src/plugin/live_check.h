// SPDX-License-Identifier: GPL-2.0-or-later
// Says when the drawing should be looked at again. LibreCAD tells plugins of no change, so this goes by what the user does:
// nothing changes without a key or a mouse button. Knows nothing of what a look is.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

namespace wedm {

class LiveCheck : public QObject {
    Q_OBJECT
public:
    explicit LiveCheck(QObject *parent = nullptr);

    void setOn(bool on);
    bool isOn() const { return m_timer.isActive(); }
    /// How long the last look has kept LibreCAD busy, its repainting included. The longer it took, the later the next one comes.
    void looked(qint64 milliseconds);
    /// The look that was due was not finished. Another one is due when the user pauses.
    void broken();
    /// Looks soon even if the user does nothing.
    void wake() { m_touched = true; }
    /// Whether a look that was begun may go on: nobody has touched anything since, and nothing prevents it.
    bool mayGoOn() const;

signals:
    /// A look is to be taken; `looked` or `broken` answers.
    void due();
    /// Why no look is taken now; empty when one is.
    void held(const QString &reason);

protected:
    bool eventFilter(QObject *object, QEvent *event) override;

private:
    void tick();

    QTimer m_timer;
    QElapsedTimer m_sinceLook;
    QElapsedTimer m_sinceInput;
    qint64 m_cost = 0;
    bool m_touched = true;
    bool m_looking = false;
};

} // namespace wedm
