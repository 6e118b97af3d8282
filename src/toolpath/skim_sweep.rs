//! The path of a later pass along the same offsets and ways round corners as that of the first, made and proved in one sweep.
//!
//! The corrections of two passes differ by little, so nearly always the same pieces are left. The
//! proof decides whether that is so; where it is not, the path is made from scratch.

use super::corners::{
    AT_A_TIME, Element, Joining, Joint, Offsets, Way, between, goes_backwards, is_all_of, is_roll,
};
use super::nest::Before;
use super::proof::{Proof, There};
use super::quick_tests::is_rest_about_foot;
use super::ring::{is_point, meeting};
use crate::geometry::{Point, Segment};
use rayon::iter::{
    IndexedParallelIterator, IntoParallelIterator, IntoParallelRefIterator, ParallelExtend,
    ParallelIterator,
};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Pieces between two questions whether the path is still wanted.
const STEP: usize = 1024;

/// The path along what an earlier one follows; `None` where that is not possible, or fails its proof.
pub(super) fn along_before(
    proof: &Proof,
    before: Before,
    goes_on: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<Element>> {
    (proof.place.own).know_about(proof.place.correction - proof.place.rounding);
    let sweep = Sweep::new(proof, before, goes_on);
    let path = sweep.path();
    if path.is_some() || !sweep.is_through.load(Relaxed) {
        return path;
    }
    // At corners that hardly turn no way round is left.
    let is_there = |element: &&Element| {
        !element.is_roll() || matches!(proof.offsets.way(element.wall), Way::Roll(_))
    };
    let path: Vec<Element> = before.path.iter().filter(is_there).copied().collect();
    let before = Before {
        path: &path,
        ..before
    };
    Sweep::new(proof, before, goes_on).path()
}

struct Sweep<'a> {
    proof: &'a Proof<'a>,
    before: Before<'a>,
    /// How the corners of the first path were made.
    of_first: Joining,
    goes_on: &'a (dyn Fn() -> bool + Sync),
    /// The path cannot be found like this.
    fails: AtomicBool,
    /// For a corner about which there is no way round any longer.
    is_through: AtomicBool,
    /// The pieces at or after which it is not obvious that nothing is missing.
    waiting: Mutex<Vec<usize>>,
}

/// What is known of a piece from the one before it.
struct Begun {
    at: usize,
    whole: Segment,
    start: Point,
}

impl<'a> Sweep<'a> {
    fn new(
        proof: &'a Proof<'a>,
        before: Before<'a>,
        goes_on: &'a (dyn Fn() -> bool + Sync),
    ) -> Sweep<'a> {
        Sweep {
            proof,
            before,
            of_first: Joining {
                correction: before.correction,
                ..*proof.offsets.joining
            },
            goes_on,
            fails: AtomicBool::new(false),
            is_through: AtomicBool::new(false),
            waiting: Mutex::default(),
        }
    }

    fn path(&self) -> Option<Vec<Element>> {
        let count = self.before.path.len();
        if count < 3 {
            return None;
        }
        let piece = |begun: &mut Option<Begun>, at: usize| {
            if at.is_multiple_of(STEP) && !(self.goes_on)() {
                self.fails.store(true, Relaxed);
            }
            let laid = match self.fails.load(Relaxed) {
                true => None,
                false => self.piece(begun, at),
            };
            laid.unwrap_or_else(|| {
                self.fails.store(true, Relaxed);
                self.before.path[at]
            })
        };
        let all = (0..count).into_par_iter().with_min_len(AT_A_TIME);
        // One that is entered in the middle of a piece has one more.
        let mut path = Vec::with_capacity(count + 1);
        path.par_extend(all.map_init(|| None, piece));
        if self.fails.load(Relaxed) {
            return None;
        }
        let waiting = std::mem::take(&mut *self.waiting.lock().ok()?);
        let is_missing = |&at: &usize| self.is_missing(&path, at);
        let is_any_missing = waiting.par_iter().any(is_missing);
        (!is_any_missing).then_some(path)
    }

    fn before(&self, at: usize) -> usize {
        at.checked_sub(1).unwrap_or(self.before.path.len() - 1)
    }

    fn behind(&self, at: usize) -> usize {
        match at + 1 == self.before.path.len() {
            true => 0,
            false => at + 1,
        }
    }

    fn key(&self, at: usize) -> usize {
        let element = &self.before.path[at];
        2 * element.wall + usize::from(element.is_roll())
    }

    /// The whole element that a piece is cut from.
    fn whole(&self, at: usize) -> Option<Segment> {
        let (key, offsets) = (self.key(at), &self.proof.offsets);
        if !is_roll(key) {
            return offsets.along(key / 2);
        }
        let Way::Roll(ends) = offsets.way(key / 2) else {
            self.is_through.store(true, Relaxed);
            return None;
        };
        let of_first = Offsets {
            joining: &self.of_first,
            ..*offsets
        };
        let [from, to] = of_first.ends(key);
        let first = self.before.path[at].geometry;
        let first = first.as_arc().filter(|_| is_all_of(&first, from, to));
        let angles = first.map(|first| [first.start_angle, first.sweep]);
        Some(offsets.roll_between(key / 2, ends, angles))
    }

    /// Where a piece ends, and whether the one after it is what comes next of all; of both what they are cut from.
    fn joint(&self, at: usize, whole: &Segment, behind: &Segment) -> Option<(Point, bool)> {
        let (key, next) = (self.key(at), self.key(self.behind(at)));
        let offsets = &self.proof.offsets;
        if is_roll(next) && next == key + 1 {
            return Some((behind.start(), true));
        }
        let leads_on = next == 2 * offsets.behind(key / 2);
        if is_roll(key) && leads_on {
            return Some((whole.end(), true));
        }
        let (near, leads_on) = match offsets.way(key / 2) {
            Way::Through(Joint::At(point)) if leads_on => return Some((point, true)),
            Way::Through(Joint::CrossNear(near)) if leads_on => (near, true),
            _ => (self.before.path[at].geometry.end(), false),
        };
        Some((meeting(whole, behind, near)?, leads_on))
    }

    /// The piece, proved but for what is waiting.
    fn piece(&self, begun: &mut Option<Begun>, at: usize) -> Option<Element> {
        let path = self.before.path;
        let (before, behind) = (self.before(at), self.behind(at));
        let Begun { whole, start, .. } = match begun.take() {
            Some(begun) if begun.at == at => begun,
            _ => {
                let whole = self.whole(at)?;
                let (start, _) = self.joint(before, &self.whole(before)?, &whole)?;
                Begun { at, whole, start }
            }
        };
        let whole_behind = self.whole(behind)?;
        let (end, leads_on) = self.joint(at, &whole, &whole_behind)?;
        *begun = Some(Begun {
            at: at + 1,
            whole: whole_behind,
            start: end,
        });
        let is_all = start == whole.start() && end == whole.end();
        if !is_all && goes_backwards(&whole, start, end) {
            return None;
        }
        let element = Element {
            geometry: between(&whole, start, end),
            ..path[at]
        };
        // In the order of the contour from the first on.
        if is_point(&element) || behind != 0 && self.key(at) >= self.key(behind) {
            return None;
        }
        let place = &self.proof.place;
        let beside = place.beside_wall(element.wall);
        let beyond = self.before.beyond(beside, &element, &path[at]);
        place.holds_beyond(&element, beyond).ok()?;
        let pieces = [element];
        let is_taken = |whole: &Segment, pieces: &[Element], walls: [usize; 2]| {
            let mut left_out = self.proof.left_out(whole, pieces);
            left_out.all(|(stretch, is_at_end)| {
                self.proof.is_taken(&stretch, walls.map(Some), is_at_end)
            })
        };
        // Most is cut off at a corner, by the wall that comes next.
        let is_cut = |from: Point, to: Point, by: usize| {
            let by = &place.walls[path[by].wall].geometry;
            from == to || is_rest_about_foot(&whole, [from, to], by, place.correction)
        };
        let is_taken = (is_all
            || is_cut(start, whole.start(), before) && is_cut(end, whole.end(), behind)
            || is_taken(&whole, &pieces, [path[before].wall, path[behind].wall]))
            && (leads_on
                || self.between(at).all(|key| {
                    let walls = [element.wall, path[behind].wall];
                    is_taken(&self.proof.offsets.geometry(key), &[], walls)
                }));
        if !is_taken {
            self.waiting.lock().ok()?.push(at);
        }
        Some(element)
    }

    /// The keys of what is left out after a piece.
    fn between(&self, at: usize) -> impl Iterator<Item = usize> {
        let (key, next) = (self.key(at), self.key(self.behind(at)));
        let offsets = &self.proof.offsets;
        let all = match key < next {
            true => (key + 1..next).chain(0..0),
            false => (key + 1..2 * offsets.walls.len()).chain(0..next),
        };
        all.filter(|&key| !is_roll(key) || offsets.roll(key / 2).is_some())
    }

    /// True where something is missing at or after a piece.
    fn is_missing(&self, path: &[Element], at: usize) -> bool {
        let own = [path[at]];
        let (before, behind) = (&path[self.before(at)], &path[self.behind(at)]);
        let is_missing = |key: usize, there: There| {
            let whole = self.proof.offsets.geometry(key);
            self.proof.is_any_missing(key, &whole, &there)
        };
        let there = There {
            pieces: &own,
            before: Some(before),
            behind: Some(behind),
        };
        is_missing(self.key(at), there)
            || self.between(at).any(|key| {
                let there = There {
                    pieces: &[],
                    before: Some(&own[0]),
                    behind: Some(behind),
                };
                is_missing(key, there)
            })
    }
}

#[cfg(test)]
mod tests {
    use super::super::clearance::Walls;
    use super::super::corners::Raw;
    use super::super::offset::Wall;
    use super::super::path::Source;
    use super::super::proof::Beside;
    use super::super::ring::trimmed;
    use super::*;
    use crate::drawing::EntityId;
    use proptest::prelude::*;
    use std::cell::Cell;
    use std::f64::consts::TAU;

    const ROUNDING: f64 = 1e-6;

    /// Every piece of one path lies along another.
    fn lies_along(one: &[Element], other: &[Element], tolerance: f64) -> bool {
        let is_near = |at: Point| {
            let mut away = other.iter().map(|own| own.geometry.distance_to(at));
            away.any(|away| away <= tolerance)
        };
        let mut pieces = one.iter();
        pieces.all(|piece| {
            [0.0, 0.5, 1.0].map(|share| is_near(piece.geometry.point_at(share))) == [true; 3]
        })
    }

    /// A path along that of a first pass is the one that is made from scratch, on contours of which some lose pieces from one correction to the
    /// next, or gain them; on most there is one.
    #[test]
    fn what_is_laid_along_a_first_pass_is_what_is_laid_from_nothing() {
        let (laid, left) = (Cell::new(0), Cell::new(0));
        let corner = (0.0..0.2, prop_oneof![Just(0.0), -0.9..0.3]);
        let corners = prop::collection::vec(corner, 8..60);
        let config = ProptestConfig {
            cases: 48,
            failure_persistence: None,
            ..ProptestConfig::default()
        };
        let mut runner = proptest::test_runner::TestRunner::new(config);
        let checked = runner.run(&(corners, 0.3..1.0), |(corners, share)| {
            let count = corners.len();
            let at = |index: usize| {
                let (sin, cos) = (TAU * (index % count) as f64 / count as f64).sin_cos();
                Point::new(cos, sin) * (0.025 * count as f64 + corners[index % count].0)
            };
            let wall = |segment: usize| Wall {
                geometry: Segment::from_bulge(at(segment), at(segment + 1), corners[segment].1),
                source: Source::Segment {
                    entity: EntityId(0),
                    segment,
                },
            };
            let walls: Vec<Wall> = (0..count).map(wall).collect();
            let own = Walls::of(&walls);
            let joining = |correction: f64| Joining {
                correction,
                side: -1.0,
                touch: 1e-7,
                tolerance: 1e-6,
            };
            let [first, later] = [joining(0.1), joining(0.1 * share)];
            let offsets = |joining| Offsets {
                walls: &walls,
                tangents: own.tangents(),
                joining,
            };
            let Some(rough) = trimmed(&Raw::new(offsets(&first))) else {
                return Ok(());
            };
            let proof = Proof {
                place: Beside {
                    walls: &walls,
                    own: &own,
                    correction: later.correction,
                    side: -1.0,
                    rounding: ROUNDING,
                    closed: true,
                },
                offsets: offsets(&later),
            };
            let before = Before {
                path: &rough.elements,
                correction: first.correction,
            };
            // What an earlier pass is said to keep clear of must be proved.
            let of_first = Proof {
                place: Beside {
                    correction: first.correction,
                    ..proof.place
                },
                offsets: offsets(&first),
            };
            if of_first.pieces_hold(rough.elements.iter(), None).is_err() {
                return Ok(());
            }
            let Some(path) = along_before(&proof, before, &|| true) else {
                left.set(left.get() + 1);
                return Ok(());
            };
            laid.set(laid.get() + 1);
            let fresh = trimmed(&Raw::new(offsets(&later))).map(|pieces| pieces.elements);
            let fresh = fresh.unwrap_or_default();
            // Where three pieces meet in one point but for rounding, one of the two paths may do without the middle one.
            let are_near =
                || lies_along(&path, &fresh, ROUNDING) && lies_along(&fresh, &path, ROUNDING);
            let is_same = format!("{path:?}") == format!("{fresh:?}") || are_near();
            prop_assert!(is_same, "{path:?}\n{fresh:?}");
            Ok(())
        });
        assert_eq!(checked, Ok(()));
        assert!(laid.get() > 5 && left.get() > 5, "{laid:?} {left:?}");
    }
}
