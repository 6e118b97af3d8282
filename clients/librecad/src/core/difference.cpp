// SPDX-License-Identifier: GPL-2.0-or-later
#include "difference.h"

namespace wedm {

namespace {

/// More pairs than this are not compared: so many entities at once are another drawing, not an edit.
constexpr qint64 MOST_PAIRS = 4096;

struct Stretch {
    int head = 0; // vertices that are the same at the start
    int tail = 0; // and at the end
};

Stretch sameEnds(const QVector<Vertex> &one, const QVector<Vertex> &other)
{
    Stretch same;
    const int shorter = qMin(one.size(), other.size());
    const Vertex *a = one.constData();
    const Vertex *b = other.constData();
    while (same.head < shorter && alike(a[same.head], b[same.head]))
        ++same.head;
    while (same.tail < shorter - same.head && alike(a[one.size() - 1 - same.tail], b[other.size() - 1 - same.tail]))
        ++same.tail;
    return same;
}

/// How sure it is that `fresh` is what has become of `old`: 0 is not at all.
int likeness(const Entity &old, const Entity &fresh)
{
    if (old.kind != fresh.kind || old.layer != fresh.layer)
        return 0;
    switch (old.kind) {
    case Kind::Polyline: {
        const Stretch same = sameEnds(old.vertices, fresh.vertices);
        return same.head + same.tail;
    }
    case Kind::Line: {
        int shared = 0;
        for (const Vertex &a : old.vertices) {
            for (const Vertex &b : fresh.vertices)
                shared += alike(a, b);
        }
        return shared;
    }
    case Kind::Arc:
    case Kind::Circle: {
        const bool centre = alike(old.x, fresh.x) && alike(old.y, fresh.y);
        const bool angles = alike(old.startAngle, fresh.startAngle) && alike(old.endAngle, fresh.endAngle);
        return (centre ? 2 : 0) + (alike(old.radius, fresh.radius) ? 1 : 0) + (old.kind == Kind::Arc && angles ? 1 : 0);
    }
    case Kind::Point:
        return 1;
    case Kind::Text:
        return old.text == fresh.text ? 1 : 0;
    }
    return 0;
}

/// The change that makes `fresh` of `old`. Vertices of a polyline that are the same but for noise get their old numbers in `fresh` too:
/// the server has the old numbers, and noise that is never sent must not add up.
Change changeOf(const Entity &old, Entity &fresh)
{
    Change change;
    change.handle = fresh.handle;
    if (old.kind != Kind::Polyline || fresh.kind != Kind::Polyline || old.closed != fresh.closed || old.layer != fresh.layer
        || old.look != fresh.look) {
        change.what = Change::What::Put;
        change.entity = fresh;
        return change;
    }
    const Stretch same = sameEnds(old.vertices, fresh.vertices);
    change.what = Change::What::Splice;
    change.start = same.head;
    change.deleteCount = old.vertices.size() - same.head - same.tail;
    change.insert = fresh.vertices.mid(same.head, fresh.vertices.size() - same.head - same.tail);
    fresh.vertices = old.vertices.mid(0, same.head) + change.insert + old.vertices.mid(old.vertices.size() - same.tail);
    return change;
}

/// Which of `gone` each of `fresh` was, both as indices; -1 for none.
QVector<int> ancestors(const QVector<Entity> &known, const QVector<int> &gone, const QVector<Entity> &seen, const QVector<int> &fresh)
{
    QVector<int> result(fresh.size(), -1);
    if (gone.isEmpty() || fresh.isEmpty() || qint64(gone.size()) * fresh.size() > MOST_PAIRS)
        return result;
    QVector<bool> taken(gone.size(), false);
    for (int i = 0; i < fresh.size(); ++i) {
        int best = -1;
        int bestLikeness = 0;
        for (int j = 0; j < gone.size(); ++j) {
            if (taken.at(j))
                continue;
            const int found = likeness(known.at(gone.at(j)), seen.at(fresh.at(i)));
            if (found > bestLikeness) {
                best = j;
                bestLikeness = found;
            }
        }
        if (best >= 0) {
            taken[best] = true;
            result[i] = gone.at(best);
        }
    }
    return result;
}

} // namespace

QString HandleGiver::handleFor(const Entity &entity)
{
    const QString old = m_known.value(entity.identity);
    if (entity.identity != 0 && !old.isEmpty())
        return old;
    QString handle;
    do {
        handle = QString::number(m_next++);
    } while (m_given.contains(handle));
    remember(entity.identity, handle);
    return handle;
}

void HandleGiver::remember(quint64 identity, const QString &handle)
{
    if (identity != 0)
        m_known.insert(identity, handle);
    m_given.insert(handle);
}

Difference difference(const QVector<Entity> &known, const QVector<Entity> &seen, HandleGiver &handles)
{
    Difference result;
    QHash<quint64, int> places;
    places.reserve(seen.size());
    for (int i = 0; i < seen.size(); ++i)
        places.insert(seen.at(i).identity, i);

    // What each known entity is now, and what is left on both sides.
    QVector<int> now(known.size(), -1);
    QVector<bool> placed(seen.size(), false);
    QVector<int> gone;
    for (int i = 0; i < known.size(); ++i) {
        const int place = known.at(i).identity == 0 ? -1 : places.value(known.at(i).identity, -1);
        if (place >= 0 && !placed.at(place)) {
            now[i] = place;
            placed[place] = true;
        } else {
            gone += i;
        }
    }
    QVector<int> fresh;
    for (int i = 0; i < seen.size(); ++i) {
        if (!placed.at(i))
            fresh += i;
    }
    const QVector<int> before = ancestors(known, gone, seen, fresh);
    for (int i = 0; i < fresh.size(); ++i) {
        if (before.at(i) >= 0) {
            now[before.at(i)] = fresh.at(i);
            placed[fresh.at(i)] = true;
        }
    }

    QSet<QString> inUse;
    result.entities.reserve(seen.size());
    for (int i = 0; i < known.size(); ++i) {
        const Entity &old = known.at(i);
        if (now.at(i) < 0) {
            Change change;
            change.what = Change::What::Delete;
            change.handle = old.handle;
            result.changes += change;
            continue;
        }
        Entity entity = seen.at(now.at(i));
        handles.remember(entity.identity, old.handle);
        inUse.insert(old.handle);
        entity.handle = old.handle;
        if (!alike(old, entity)) {
            result.changes += changeOf(old, entity);
        } else {
            const quint64 identity = entity.identity;
            entity = old;
            entity.identity = identity;
        }
        result.entities += entity;
    }
    for (int place : fresh) {
        if (placed.at(place))
            continue;
        Entity entity = seen.at(place);
        entity.handle = handles.handleFor(entity);
        if (inUse.contains(entity.handle)) {
            // The host has brought back an entity whose handle its replacement bears.
            entity.identity = 0;
            entity.handle = handles.handleFor(entity);
            entity.identity = seen.at(place).identity;
            handles.remember(entity.identity, entity.handle);
        }
        inUse.insert(entity.handle);
        Change change;
        change.what = Change::What::Put;
        change.handle = entity.handle;
        change.entity = entity;
        result.changes += change;
        result.entities += entity;
    }
    return result;
}

} // namespace wedm
