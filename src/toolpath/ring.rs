//! The path that is left when neighbours are cut with each other and what they use up is taken out.

use super::cores::{each, extend};
use super::corners::{Element, Joint, Raw, between, close_up, nearer_to_both, nearly_meetings};
use crate::geometry::{Point, Segment};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Elements that one core takes at a time.
const AT_A_TIME: usize = 2048;

/// The pieces of a path, each with the raw element that it is a part of.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    pub(super) elements: Vec<Element>,
    pub(super) raw: Vec<u32>,
}

impl Pieces {
    pub(super) fn of(path: Vec<(usize, Element)>) -> Pieces {
        let (raw, elements) = path
            .into_iter()
            .map(|(raw, element)| (raw as u32, element))
            .unzip();
        Pieces { elements, raw }
    }

    pub(super) fn pairs(&self) -> impl Iterator<Item = (usize, Element)> {
        let raw = self.raw.iter().map(|raw| *raw as usize);
        raw.zip(self.elements.iter().copied())
    }
}

/// The path that is left where neighbours are cut with each other and what they use up goes, each piece with the index of the
/// element that it is of. Right wherever corners do not reach past their neighbours; whether it is, `proof` says. `None`
/// where nothing is left or neighbours do not meet.
pub(super) fn trimmed(raw: &Raw) -> Option<Pieces> {
    Ring::new(raw).resolve()
}

/// The elements round a contour, from which what is used up is taken out.
struct Ring<'a> {
    raw: &'a Raw<'a>,
    /// After each element.
    joints: Vec<Joint>,
    before: Vec<u32>,
    after: Vec<u32>,
    alive: Vec<bool>,
    count: usize,
}

impl<'a> Ring<'a> {
    fn new(raw: &'a Raw<'a>) -> Ring<'a> {
        let count = raw.len();
        let last = count.saturating_sub(1) as u32;
        Ring {
            raw,
            joints: each(count, AT_A_TIME, |index| raw.offsets.joint(raw.key(index))),
            before: std::iter::once(last).chain(0..last).collect(),
            after: (1..=last).chain([0]).collect(),
            alive: vec![true; count],
            count,
        }
    }

    fn before(&self, index: usize) -> usize {
        self.before[index] as usize
    }

    fn after(&self, index: usize) -> usize {
        self.after[index] as usize
    }

    /// Takes out what is used up until every element runs forward; `None` when nothing is left or neighbours do not meet.
    fn resolve(mut self) -> Option<Pieces> {
        self.remove_tight()?;
        self.settle_all();
        let waiting = self.not_forward();
        self.resolve_beside(waiting)
    }

    /// Takes out what the wire's centre cannot follow at all.
    fn remove_tight(&mut self) -> Option<()> {
        if self.count < 2 {
            return None;
        }
        let raw = self.raw;
        for &(index, center) in &raw.tight {
            self.remove(index, center)?;
        }
        Some(())
    }

    /// The elements that do not run forward between what is settled, from the last of the contour to its first. The others are looked at again only beside
    /// what goes.
    fn not_forward(&self) -> Vec<usize> {
        let settled = |index: usize| match self.joints[index] {
            Joint::At(point) => Some(point),
            Joint::CrossNear(_) => None,
        };
        let runs_forward = |index: usize| {
            let ends = settled(self.before(index)).zip(settled(index));
            ends.is_some_and(|(start, end)| !self.runs_backwards(index, start, end))
        };
        let is_fine = each(self.raw.len(), AT_A_TIME, |index| {
            !self.alive[index] || runs_forward(index)
        });
        let all = (0..self.raw.len()).rev();
        all.filter(|&index| !is_fine[index]).collect()
    }

    /// Looks at the elements that are `waiting`, from the last to the first, and at the neighbours of those that go.
    fn resolve_beside(mut self, mut waiting: Vec<usize>) -> Option<Pieces> {
        while let Some(index) = waiting.pop() {
            if !self.alive[index] {
                continue;
            }
            let gone = match (self.settle(self.before(index)), self.settle(index)) {
                (Err(shorter), _) | (_, Err(shorter)) => shorter,
                (Ok(start), Ok(end)) if self.runs_backwards(index, start, end) => index,
                _ => continue,
            };
            let near = self.raw.geometry(gone).point_at(0.5);
            let (before, after) = (self.before(gone), self.after(gone));
            self.remove(gone, near)?;
            waiting.extend([after, before, index]);
        }
        self.pieces()
    }

    fn remove(&mut self, index: usize, near: Point) -> Option<()> {
        let (before, after) = (self.before(index), self.after(index));
        self.alive[index] = false;
        self.count -= 1;
        self.after[before] = after as u32;
        self.before[after] = before as u32;
        self.joints[before] = Joint::CrossNear(near);
        (self.count >= 2).then_some(())
    }

    /// The points after all elements, where they meet the next.
    fn settle_all(&mut self) {
        let Ring {
            raw,
            joints,
            after,
            alive,
            ..
        } = self;
        let joints = joints.par_iter_mut().with_min_len(AT_A_TIME).enumerate();
        joints.for_each(|(index, joint)| {
            if let Joint::CrossNear(near) = *joint
                && alive[index]
            {
                let next = raw.geometry(after[index] as usize);
                if let Some(point) = meeting(&raw.geometry(index), &next, near) {
                    *joint = Joint::At(point);
                }
            }
        });
    }

    /// The point after element `index`; where the two do not meet, the shorter one.
    fn settle(&mut self, index: usize) -> Result<Point, usize> {
        let near = match self.joints[index] {
            Joint::At(point) => return Ok(point),
            Joint::CrossNear(near) => near,
        };
        let next = self.after(index);
        let (a, b) = (self.raw.geometry(index), self.raw.geometry(next));
        let shorter = if a.length() < b.length() { index } else { next };
        let point = meeting(&a, &b, near).ok_or(shorter)?;
        self.joints[index] = Joint::At(point);
        Ok(point)
    }

    fn runs_backwards(&self, index: usize, start: Point, end: Point) -> bool {
        let key = self.raw.key(index);
        self.raw.offsets.runs_backwards(key, start, end)
    }

    fn pieces(self) -> Option<Pieces> {
        let all = 0..self.raw.len() as u32;
        let raw: Vec<u32> = match self.count == self.raw.len() {
            true => all.collect(),
            false => all.filter(|&index| self.alive[index as usize]).collect(),
        };
        let (is_torn, is_any_point) = (AtomicBool::new(false), AtomicBool::new(false));
        let settled = |index: usize| match self.joints[index] {
            Joint::At(point) => point,
            Joint::CrossNear(near) => {
                is_torn.store(true, Relaxed);
                near
            }
        };
        let piece = |at: usize| {
            let index = raw[at] as usize;
            let start = settled(raw[if at == 0 { self.count } else { at } - 1] as usize);
            let geometry = between(&self.raw.geometry(index), start, settled(index));
            let piece = self.raw.offsets.element(self.raw.key(index), geometry);
            if is_point(&piece) {
                is_any_point.store(true, Relaxed);
            }
            piece
        };
        // A path that is entered in the middle of a piece has one piece more.
        let mut elements = Vec::with_capacity(self.count + 1);
        extend(&mut elements, self.count, AT_A_TIME, piece);
        if is_torn.into_inner() {
            return None;
        }
        let mut pieces = Pieces { elements, raw };
        if is_any_point.into_inner() {
            pieces = without_points(&pieces);
        }
        let path = &mut pieces.elements;
        if let (Some(head), Some(last)) = (
            path.first().map(|first| first.geometry.start()),
            path.last_mut(),
        ) {
            close_up(last, head);
        }
        (path.len() >= 2).then_some(pieces)
    }
}

/// Where two consecutive elements meet; of several places, the one nearest to a point.
pub(super) fn meeting(a: &Segment, b: &Segment, near: Point) -> Option<Point> {
    let is_on = |segment: &Segment, point: Point| {
        segment.spans(point) || (-1e-9..=1.0 + 1e-9).contains(&segment.share_of(point))
    };
    let is_on_both = |point: Point| is_on(a, point) && is_on(b, point);
    let away = |point: Point| (point - near).norm_squared();
    let exact = |point: Point| nearer_to_both(a, b, point);
    let met = nearly_meetings(a, b);
    let best = match met[..] {
        [one, other] => {
            let (nearer, farther) = match away(other) < away(one) {
                true => (exact(other), one),
                false => (exact(one), other),
            };
            let farther = (!is_on_both(nearer)).then(|| exact(farther));
            farther.filter(|at| is_on_both(*at)).unwrap_or(nearer)
        }
        _ => exact(*met.first()?),
    };
    (best.x.is_finite() && best.y.is_finite()).then_some(best)
}

/// True for a piece of a path that is no more than a point.
pub(super) fn is_point(piece: &Element) -> bool {
    piece.geometry.length() <= 1e-9
}

/// What follows a piece without length begins where that is; what comes before it ends there, so nothing is left between.
fn without_points(pieces: &Pieces) -> Pieces {
    let mut kept = Pieces::default();
    for (piece, &raw) in pieces.elements.iter().zip(&pieces.raw) {
        if !is_point(piece) {
            kept.elements.push(*piece);
            kept.raw.push(raw);
        } else if let Some(last) = kept.elements.last_mut() {
            close_up(last, piece.geometry.end());
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::super::corners::{Joining, Offsets};
    use super::super::offset::Wall;
    use super::super::path::Source;
    use super::*;
    use crate::drawing::EntityId;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    /// A closed contour of lines and arcs about the origin, its corners in and out, some of its pieces shorter than the correction.
    fn walls(corners: &[(f64, f64)]) -> Vec<Wall> {
        let count = corners.len();
        let at = |index: usize| {
            let (away, _) = corners[index % count];
            let (sin, cos) = (TAU * (index % count) as f64 / count as f64).sin_cos();
            Point::new(cos, sin) * (0.03 * count as f64 + away)
        };
        let wall = |index: usize| Wall {
            geometry: Segment::from_bulge(at(index), at(index + 1), corners[index].1),
            source: Source::Segment {
                entity: EntityId(0),
                segment: index,
            },
        };
        (0..count).map(wall).collect()
    }

    fn corner() -> impl Strategy<Value = (f64, f64)> {
        let bulge = prop_oneof![3 => Just(0.0), 1 => -0.9..0.9];
        (prop_oneof![2 => Just(0.0), 1 => 0.0..0.4], bulge)
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// What is settled at once, over the cores, leaves the path that one element after the other leaves.
        #[test]
        fn the_path_is_that_of_one_element_after_the_other(
            corners in prop::collection::vec(corner(), 3..400),
            times in prop_oneof![9 => Just(1_usize), 1 => Just(20)],
            left in any::<bool>(),
        ) {
            let walls = walls(&corners.repeat(times));
            let ends = |wall: &Wall| [wall.geometry.start_tangent(), wall.geometry.end_tangent()];
            let tangents: Vec<_> = walls.iter().map(ends).collect();
            let joining = Joining {
                correction: 0.1,
                side: if left { 1.0 } else { -1.0 },
                touch: 1e-7,
                tolerance: 1e-6,
            };
            let raw = Raw::new(Offsets {
                walls: &walls,
                tangents: &tangents,
                joining: &joining,
            });
            let told = |path: Option<Pieces>| format!("{path:?}");
            let mut one_by_one = Ring::new(&raw);
            let one_by_one = match one_by_one.remove_tight() {
                Some(()) => {
                    let all = (0..raw.len()).rev().collect();
                    one_by_one.resolve_beside(all)
                }
                None => None,
            };
            prop_assert_eq!(told(super::trimmed(&raw)), told(one_by_one));
        }
    }
}
