// SPDX-License-Identifier: GPL-2.0-or-later
#include "looks.h"

#include "host.h"

#include <QElapsedTimer>
#include <QTimer>

namespace wedm {

namespace {

/// The live check looks at a large drawing in slices of this many ms, plus what LibreCAD needs to list the entities for each.
constexpr qint64 SLICE = 40;
/// The time for LibreCAD between two slices, in ms.
constexpr int BETWEEN_SLICES = 15;

} // namespace

Looks::Looks(QObject *parent)
    : QObject(parent)
    , m_live(this)
{
    connect(&m_live, &LiveCheck::due, this, &Looks::nextSlice);
}

void Looks::whole(Document_Interface &drawing)
{
    QElapsedTimer clock;
    clock.start();
    m_slices.drop();
    m_slices.forgetLayers();
    const Snapshot snapshot = takeSnapshot(drawing);
    parent()->setProperty("lookMilliseconds", clock.elapsed());
    deliver(snapshot, clock.elapsed());
}

/// Each call of the plugin reads a slice of the drawing, and LibreCAD goes on in between.
void Looks::nextSlice()
{
    if (!m_slices.isBegun()) {
        if (m_window != host::currentWindow())
            m_slices.forgetLayers();
        m_window = host::currentWindow();
        m_spent = 0;
        parent()->setProperty("slices", 0);
        parent()->setProperty("sliceMilliseconds", 0);
    }
    {
        HeldPainting held(m_window);
        m_held = &held;
        emit sliceWanted();
        m_held = nullptr;
    }
    if (!m_slices.isBegun()) {
        m_live.broken();
        return;
    }
    QElapsedTimer clock;
    clock.start();
    QTimer::singleShot(BETWEEN_SLICES, this, [this, clock] {
        // A command has looked at all of it meanwhile.
        if (!m_slices.isBegun())
            return;
        if (host::currentWindow() != m_window || (!m_slices.isComplete() && !m_live.mayGoOn())) {
            m_slices.drop();
            m_live.broken();
        } else if (m_slices.isComplete()) {
            // LibreCAD has painted now: comparing the drawing with the last one any earlier would have taken a core from it.
            deliver(m_slices.take(), m_spent + clock.elapsed());
        } else {
            nextSlice();
        }
    });
}

void Looks::slice(Document_Interface &drawing)
{
    QElapsedTimer clock;
    clock.start();
    m_slices.read(drawing, SLICE);
    // The only repaint that the look costs.
    if (m_slices.isComplete() && m_held)
        m_held->release();
    m_spent += clock.elapsed();
    parent()->setProperty("lookMilliseconds", m_spent);
    parent()->setProperty("slices", parent()->property("slices").toInt() + 1);
    parent()->setProperty("sliceMilliseconds", qMax(parent()->property("sliceMilliseconds").toLongLong(), clock.elapsed()));
}

/// LibreCAD was busy with the look for `spent` ms so far.
void Looks::deliver(const Snapshot &snapshot, qint64 spent)
{
    QElapsedTimer clock;
    clock.start();
    emit taken(snapshot);
    parent()->setProperty("looks", parent()->property("looks").toInt() + 1);
    // LibreCAD paints the drawing again after a call of a plugin; that is part of the cost of a look.
    QTimer::singleShot(0, this, [this, clock, spent] { m_live.looked(spent + clock.elapsed()); });
}

} // namespace wedm
