//! What speaks for a slip, and how exactly it explains a cut.

use super::beside::Beside;
use super::cut::{Against, Changed, Joints, Piece, Pieces, is_about_hole, is_mirrored, runs_on};
use super::slip::{Cut, Ends, Slip, Sort};
use crate::geometry::Vector;
use rustc_hash::FxHashMap;

/// What speaks against a slip, the strongest kind first; the less the better.
pub(super) type Evidence = [i32; 5];

/// Places of the kinds in [`Evidence`].
const LEADS: usize = 1;
pub(super) const JOINTS: usize = 3;
pub(super) const LAST: usize = 4;

pub(super) struct Candidate<M> {
    pub(super) slip: Slip<M>,
    pub(super) evidence: Evidence,
    pub(super) left: usize,
    /// The text itself contradicts what stands there.
    pub(super) speaks: bool,
    /// What stands there cannot be read, or is wrong by itself.
    pub(super) is_wrong: bool,
    /// The text says too little: its leads, or two of its joints, have to speak for it.
    pub(super) must_fit: bool,
    /// The wire no longer runs back on the way that it came, and every block ends where it did.
    pub(super) turns_round: bool,
    /// How many more joints are tangent.
    pub(super) smooth: i32,
    /// The wire runs back on the way that it came where it did not.
    pub(super) doubles: bool,
    /// Another reading leads nearly the same way, but not to the last digit.
    pub(super) has_double: bool,
    /// Its way in and its way out are no pair.
    pub(super) parts_leads: bool,
    /// It closes only nearly.
    pub(super) is_near: bool,
    /// How far from its end the cut closes, or a block ends from its stated place, µm.
    pub(super) miss: f64,
}

/// Whether two lines have one direction: they differ in their length alone.
fn is_along(one: &Piece, other: &Piece) -> bool {
    let (one, other) = (one.by, other.by);
    let across = one.x * other.y - one.y * other.x;
    across.abs() <= one.norm() + other.norm() && one.dot(&other) > 0.0
}

impl<M> Candidate<M> {
    pub(super) fn is_text(&self) -> bool {
        self.slip.is_text()
    }

    /// No kind of evidence is worse, and one is better.
    pub(super) fn beats(&self, other: &Candidate<M>) -> bool {
        let [worse, better] = self.kinds(other);
        worse == 0 && better > 0
    }

    /// By the leads, by two joints, or by two kinds of evidence.
    pub(super) fn beats_clearly(&self, other: &Candidate<M>) -> bool {
        let [worse, better] = self.kinds(other);
        let before = |kind: usize| self.evidence[..kind] <= other.evidence[..kind];
        let by_leads = self.evidence[LEADS] < other.evidence[LEADS] && before(LEADS);
        let by_joints = self.evidence[JOINTS] + 2 <= other.evidence[JOINTS] && worse == 0;
        by_leads || by_joints || (worse == 0 && better > 1)
    }

    /// Its leads or two of its joints speak for it.
    pub(super) fn fits(&self) -> bool {
        self.evidence[LEADS] < 0 || self.evidence[JOINTS] <= -2
    }

    /// How many kinds are worse, and how many better.
    fn kinds(&self, other: &Candidate<M>) -> [usize; 2] {
        let pairs = || self.evidence.iter().zip(&other.evidence);
        [
            pairs().filter(|(own, its)| own > its).count(),
            pairs().filter(|(own, its)| own < its).count(),
        ]
    }
}

/// A slip that closes this much worse than another, µm, may be meant all the same.
pub(super) const NEARLY: f64 = 15.0;

/// A search through a cut.
pub(super) struct Search<'a, C: Cut> {
    pub(super) cut: &'a C,
    pub(super) pieces: &'a Pieces,
    pub(super) beside: Beside,
    pub(super) before: Against,
    pub(super) gaps: Vec<Vector>,
    pub(super) ends: Ends,
    pub(super) is_mirrored: bool,
    pub(super) radii: FxHashMap<i64, i32>,
    pub(super) tolerance: f64,
    /// Pieces that may still be read.
    pub(super) left: usize,
    pub(super) is_complete: bool,
    pub(super) found: Vec<Candidate<C::Meant>>,
}

impl<C: Cut> Search<'_, C> {
    /// Weighs a slip that explains something: what speaks for it, and how exactly it does.
    pub(super) fn weigh(
        &mut self,
        mut slip: Slip<C::Meant>,
        after: Against,
        joints: Joints,
        is_near: bool,
        home: Vector,
    ) {
        let (pieces, index) = (self.pieces, slip.change.index());
        let count = pieces.all.len();
        let with = Changed {
            pieces: &pieces.all,
            index,
            count: slip.count,
            by: &slip.pieces,
        };
        let is_pair = is_mirrored(with.iter());
        let mirrored = is_pair && home.norm() <= self.tolerance;
        let likeness = self.beside.likeness(pieces, &with);
        let is_end = index == 0 || index + slip.count >= count;
        // How a way in meets the contour does not tell which of the two is wrong, nor what is lost beside it.
        let is_made_pair = is_end && mirrored && !self.is_mirrored;
        let is_beside_lead = slip.sort == Sort::Insertion && (index <= 1 || index + 1 >= count);
        let good = match is_made_pair || is_beside_lead {
            true => joints.good.min(0),
            false => joints.good,
        };
        let evidence = [
            -i32::from(self.is_witnessed(index, &slip)),
            -(i32::from(mirrored) + i32::from(is_about_hole(with.iter())) + likeness),
            self.odd_radii(index, &slip),
            -good.clamp(-2, 2),
            slip.keys,
        ];
        let own = pieces.all.get(index);
        let is_stated = self.before.off > after.off;
        let changed = with.replaced();
        let mut wrong = changed.iter().filter(|own| own.is_unread || own.is_unsound);
        let is_wrong = wrong.clone().count() > 0;
        let mut pairs = changed.iter().zip(&slip.pieces);
        let keeps_ends = pairs.all(|(was, is)| was.by == is.by);
        let speaks = is_wrong || is_stated || after.out_of_turn < self.before.out_of_turn;
        let miss = self.missed(&slip, home, index);
        let drift: f64 = slip
            .pieces
            .iter()
            .map(|piece| (piece.machine - piece.by).norm())
            .sum();
        // A contour is closed whatever its leads are, but these lead home.
        let astray = if mirrored { home.norm() } else { 0.0 };
        let is_arc = slip.pieces.iter().any(Piece::is_arc);
        let is_inexact = slip.is_text() && miss > self.exact(is_arc);
        // At its ends a cut has straight leads, or begins within a line.
        let is_lead = is_end && (mirrored || runs_on(with.iter()));
        if slip.sort == Sort::Stated && !slip.pieces.iter().all(Piece::is_arc) {
            let is_only_j =
                matches!((slip.pieces.as_slice(), own), ([new], Some(old)) if is_along(new, old));
            if !is_lead && !is_only_j && self.before.is_open {
                slip.sort = Sort::Calculated;
            }
        }
        self.found.push(Candidate {
            left: after.count() - usize::from(is_near),
            // What counts to its own end is likelier than what drifts; a thousandth of that is rounding.
            miss: ((miss + drift + astray) * 10.0).round() / 10.0,
            speaks,
            is_wrong,
            must_fit: match speaks {
                true => is_wrong && wrong.all(|own| own.is_off_circle),
                false => changed.iter().any(|own| own.is_placed),
            },
            turns_round: joints.doubled < 0 && keeps_ends,
            smooth: joints.smooth,
            doubles: joints.doubled > 0,
            has_double: false,
            parts_leads: pieces.closes
                && count >= 3
                && !is_pair
                && (self.is_mirrored || pieces.others_are_mirrored())
                && !runs_on(with.iter()),
            is_near: is_near || is_inexact,
            evidence,
            slip,
        });
    }

    /// How far a slip that is undone still misses what it should meet.
    fn missed(&self, slip: &Slip<C::Meant>, home: Vector, index: usize) -> f64 {
        let mut stated = slip
            .pieces
            .iter()
            .map(|piece| piece.miss)
            .fold(0.0, f64::max);
        let mut from = self.pieces.stated_before(index);
        for piece in &slip.pieces {
            if let Some((from, to)) = from.zip(piece.stated) {
                let by = to.at - from.at;
                stated = f64::max(
                    stated,
                    (by - piece.by).norm().min((by - piece.machine).norm()),
                );
            }
            from = piece.stated;
        }
        let by = |piece: &Piece| piece.by;
        let (first, last) = (slip.pieces.first().map(by), slip.pieces.last().map(by));
        let count = self.pieces.all.len();
        let old = |index: usize| self.pieces.all.get(index).map(by);
        let first = if index == 0 { first } else { old(0) }.unwrap_or_default();
        let is_last = index + slip.count >= count;
        let last = if is_last { last } else { old(count - 1) }.unwrap_or_default();
        let ends = [home, home - first, home - first - last];
        let open = match self.pieces.closes && count >= 3 {
            true => ends
                .iter()
                .map(|end| end.norm())
                .fold(f64::INFINITY, f64::min),
            false => 0.0,
        };
        stated.max(if open > self.tolerance { 0.0 } else { open })
    }

    /// How near a slip that is undone must meet what it should, µm: what is written to the micrometre meets within rounding.
    fn exact(&self, is_arc: bool) -> f64 {
        self.tolerance / 2.0 + if is_arc { 0.5 } else { 0.0 }
    }

    pub(super) fn is_way_in(&self, pieces: &[Piece]) -> bool {
        let last = self.pieces.all.last();
        matches!((pieces, last), ([own], Some(last)) if !last.is_arc() && (own.by + last.by).norm() <= 2.0)
    }

    /// Whether some pieces close but for a little.
    pub(super) fn is_nearly_closed(&self, pieces: &[Piece]) -> bool {
        let all = Pieces {
            all: pieces.to_vec(),
            ..Pieces::default()
        };
        let within = self.tolerance + NEARLY;
        all.gaps().iter().take(2).any(|gap| gap.norm() <= within)
    }

    /// Whether coordinates on both sides of a slip agree with it.
    fn is_witnessed(&self, index: usize, slip: &Slip<C::Meant>) -> bool {
        let before = self.pieces.stated_before(index);
        before.is_some() && slip.pieces.iter().any(|piece| piece.stated.is_some())
    }

    /// How many more arcs have a radius that nothing else speaks for: that of no other arc, and not round.
    fn odd_radii(&self, index: usize, slip: &Slip<C::Meant>) -> i32 {
        let count = |radius: i64| {
            let near = -2..=2;
            near.map(|by| self.radii.get(&(radius + by)).copied().unwrap_or(0))
                .sum::<i32>()
        };
        let is_round = |radius: i64| radius % 100 == 0 || radius % 10 == 0 && radius < 1000;
        let odd = |pieces: &[Piece], own: i32| {
            let radii = pieces.iter().filter_map(Piece::radius);
            let is_odd = |radius: &f64| {
                let radius = radius.round() as i64;
                count(radius) <= own && !is_round(radius)
            };
            radii.filter(is_odd).count() as i32
        };
        let was = self
            .pieces
            .all
            .get(index..index + slip.count)
            .unwrap_or_default();
        odd(&slip.pieces, 0) - odd(was, 1)
    }
}
