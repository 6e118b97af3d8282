// SPDX-License-Identifier: GPL-2.0-or-later
#include "live_check.h"

#include "host.h"

#include <QCoreApplication>
#include <QEvent>

namespace wedm {

namespace {

/// The interval of the timer, in ms.
constexpr int TICK = 150;
/// The pause after a look as a multiple of its time, so that looks never take more than a tenth of the time.
constexpr int REST = 9;
/// A look that costs more than this, in ms, waits for a moment in which the user does nothing.
constexpr qint64 NOTICEABLE = 80;
/// The length of that moment, as a multiple of the cost of a look, and at most, in ms.
constexpr qint64 QUIET_PER_COST = 3;
constexpr qint64 LONGEST_QUIET = 2000;
/// ms after which a look is taken even though nobody has touched anything: another plugin may have drawn.
constexpr qint64 LONGEST_SLEEP = 5000;
/// The same per ms that a look costs, for large drawings.
constexpr qint64 SLEEP_PER_COST = 100;

} // namespace

LiveCheck::LiveCheck(QObject *parent)
    : QObject(parent)
    , m_timer(this)
{
    m_timer.setInterval(TICK);
    connect(&m_timer, &QTimer::timeout, this, &LiveCheck::tick);
    m_sinceLook.start();
    m_sinceInput.start();
}

void LiveCheck::setOn(bool on)
{
    if (on == isOn())
        return;
    m_looking = false;
    if (on) {
        m_touched = true;
        m_timer.start();
        QCoreApplication::instance()->installEventFilter(this);
    } else {
        m_timer.stop();
        QCoreApplication::instance()->removeEventFilter(this);
    }
}

void LiveCheck::looked(qint64 milliseconds)
{
    m_cost = milliseconds;
    m_sinceLook.restart();
    m_looking = false;
}

void LiveCheck::broken()
{
    m_looking = false;
    m_touched = true;
}

bool LiveCheck::eventFilter(QObject *, QEvent *event)
{
    switch (event->type()) {
    case QEvent::MouseMove:
    case QEvent::Wheel:
        m_sinceInput.restart();
        break;
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::Drop:
        m_touched = true;
        m_sinceInput.restart();
        break;
    default:
        break;
    }
    return false;
}

bool LiveCheck::mayGoOn() const
{
    return isOn() && !m_touched && host::currentWindow() && !host::userIsBusy() && !host::redoIsPossible();
}

void LiveCheck::tick()
{
    if (m_looking)
        return;
    const qint64 rested = m_sinceLook.elapsed();
    const bool slept = rested > qMax(LONGEST_SLEEP, m_cost * SLEEP_PER_COST);
    if ((!m_touched && !slept) || rested < m_cost * REST)
        return;
    if (m_cost > NOTICEABLE && m_sinceInput.elapsed() < qMin(LONGEST_QUIET, m_cost * QUIET_PER_COST))
        return;
    if (!host::currentWindow() || host::userIsBusy())
        return;
    if (host::redoIsPossible()) {
        emit held(tr("paused: a check now would end Redo"));
        return;
    }
    m_touched = false;
    m_looking = true;
    emit held(QString());
    emit due();
}

} // namespace wedm
