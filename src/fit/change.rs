//! How a list went over into another by an edit: one stretch of it has changed.

/// How a list went over into another: what stands before and behind the stretch that has changed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    front: usize,
    back: usize,
    before: usize,
    now: usize,
}

impl Change {
    pub(super) fn of<T>(before: &[T], now: &[T], is_same: impl Fn(&T, &T) -> bool) -> Change {
        let most = before.len().min(now.len());
        let same = |pair: &(&T, &T)| is_same(pair.0, pair.1);
        let front = before.iter().zip(now).take_while(same).count();
        let from_behind = before.iter().rev().zip(now.iter().rev());
        let back = from_behind.take(most - front).take_while(same).count();
        Change {
            front,
            back,
            before: before.len(),
            now: now.len(),
        }
    }

    /// Where one of now stood before.
    pub(super) fn was(&self, index: usize) -> Option<usize> {
        match index {
            _ if index < self.front => Some(index),
            _ if index >= self.now - self.back => Some(index + self.before - self.now),
            _ => None,
        }
    }

    /// Where one that is still there stands now.
    pub(super) fn is(&self, index: usize) -> Option<usize> {
        let turned = Change {
            before: self.now,
            now: self.before,
            ..*self
        };
        turned.was(index)
    }

    /// What is gone, and what is new in its place.
    pub(super) fn stretches<'a, T>(&self, before: &'a [T], now: &'a [T]) -> [&'a [T]; 2] {
        let gone = &before[self.front..self.before - self.back];
        [gone, &now[self.front..self.now - self.back]]
    }

    /// How many there were.
    pub(super) fn before(&self) -> usize {
        self.before
    }

    /// How many there are.
    pub(super) fn now(&self) -> usize {
        self.now
    }
}
