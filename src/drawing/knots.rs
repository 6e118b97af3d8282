//! Places where several ends lie near each other: which of them are joined, whatever the order of the entities.
//!
//! A *strand* leads from one such place to another without a branch. Closing a loop takes precedence over going on:
//! first the strands that return to their start are closed, then those that lead nowhere are set aside, then the loops
//! among the others are walked from the outside. The rest is joined to open contours, nearest ends and straightest ways
//! first. Every choice depends on where the entities lie and what they are, never on when they were drawn.

use super::doubles::by_coordinates;
use super::ends::End;
use super::joints::Joints;
use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Two ways to close a loop that differ by less than this share of the distance at which ends certainly meet are equally
/// near: coordinates are rounded.
const ROUNDING: f64 = 0.1;

/// Entities that follow each other without a branch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strand {
    /// Where it begins and where it ends.
    pub(crate) ends: [End; 2],
    /// Number of its entities.
    pub(crate) count: usize,
    /// All of it lies within the join tolerance, and it does not lead round by itself.
    pub(crate) is_crumb: bool,
}

/// Strands that were joined, in order of travel, and whether each is travelled against its own direction.
#[derive(Clone, Debug)]
pub(super) struct Joined {
    pub(crate) strands: Vec<(usize, bool)>,
    pub(crate) closed: bool,
}

/// One end of a strand: twice the number of the strand; odd at its end.
type Tip = usize;

const NOWHERE: usize = usize::MAX;

/// Joins strands to contours; each strand goes into one of them.
pub(super) fn resolve(strands: &[Strand], joints: &Joints) -> Vec<Joined> {
    let mut tip_of = vec![
        u32::MAX;
        if strands.is_empty() {
            0
        } else {
            joints.end_count()
        }
    ];
    for (strand, Strand { ends, .. }) in strands.iter().enumerate() {
        ends.iter()
            .zip([2 * strand, 2 * strand + 1])
            .for_each(|(end, tip)| tip_of[end.index()] = tip as u32);
    }
    let mut knots = Knots {
        strands,
        joints,
        tip_of,
        is_free: vec![true; strands.len()],
        entered: vec![NOWHERE; 2 * strands.len()],
        left: Vec::new(),
        joined: Vec::new(),
    };
    knots.close_alone();
    knots.leave_dead_ends();
    knots.walk_loops();
    knots.join_open();
    knots.joined
}

struct Knots<'a> {
    strands: &'a [Strand],
    joints: &'a Joints<'a>,
    /// By end.
    tip_of: Vec<u32>,
    /// By strand: in no contour, on no path, and not left for the open contours.
    is_free: Vec<bool>,
    /// By tip: the place on the current path where it was entered.
    entered: Vec<usize>,
    /// Strands that are in no loop.
    left: Vec<usize>,
    joined: Vec<Joined>,
}

impl Knots<'_> {
    fn end(&self, tip: Tip) -> End {
        self.strands[tip / 2].ends[tip % 2]
    }

    /// The tips near a tip, with the distance. The two tips of a crumb are always near each other and do not count.
    fn near(&self, tip: Tip) -> Vec<(Tip, f64)> {
        let mut near = Vec::new();
        self.joints.each_near(self.end(tip), |end, distance| {
            let other = self.tip_of[end.index()] as Tip;
            if other != u32::MAX as Tip && (other != tip ^ 1 || !self.strands[tip / 2].is_crumb) {
                near.push((other, distance));
            }
        });
        near
    }

    /// The entity of a strand of one.
    fn only(&self, strand: usize) -> Option<u32> {
        let Strand { ends, count, .. } = self.strands.get(strand)?;
        (*count == 1).then(|| ends[0].entity())
    }

    /// The other one of an edge that two outlines share.
    fn twin(&self, strand: usize) -> Option<u32> {
        let borders = &self.joints.doubles.borders;
        borders.get(&self.only(strand)?).copied()
    }

    /// The direction in which the strand leaves a tip.
    fn heading(&self, tip: Tip) -> f64 {
        self.joints.heading(self.end(tip))
    }

    fn by_place(&self, one: Tip, other: Tip) -> Ordering {
        let [a, b] = [one, other].map(|tip| self.end(tip));
        // Of two ends of one entity, the one with the lower coordinates.
        self.joints
            .by_place(a.entity(), b.entity())
            .then_with(|| by_coordinates(&self.joints.place(a), &self.joints.place(b)))
            .then(a.cmp(&b))
    }

    /// Closes the strands that return to their start, unless another tip is nearer.
    fn close_alone(&mut self) {
        for (
            strand,
            &Strand {
                ends: [start, end],
                is_crumb,
                count,
            },
        ) in self.strands.iter().enumerate()
        {
            let home = self.joints.distance(start, end);
            if is_crumb
                || home > self.joints.join()
                || (count == 1 && !self.joints.leads_round(start.entity()))
            {
                continue;
            }
            let own = [2 * strand, 2 * strand + 1];
            let others = own
                .into_iter()
                .flat_map(|tip| self.near(tip))
                .filter(|(tip, _)| tip / 2 != strand);
            let nearest = others
                .map(|(_, distance)| distance)
                .fold(f64::INFINITY, f64::min);
            if home <= nearest
                || own
                    .into_iter()
                    .any(|tip| self.joints.is_crowded(self.end(tip)))
            {
                self.is_free[strand] = false;
                self.joined.push(Joined {
                    strands: vec![(strand, false)],
                    closed: true,
                });
            }
        }
    }

    /// Sets aside strands that lead nowhere, and those that lead only to such strands.
    fn leave_dead_ends(&mut self) {
        let free_near = |knots: &Knots, tip: Tip| {
            knots
                .near(tip)
                .iter()
                .filter(|(other, _)| knots.is_free[other / 2])
                .count()
        };
        let mut ways: Vec<usize> = (0..2 * self.strands.len())
            .map(|tip| {
                if self.is_free[tip / 2] {
                    free_near(self, tip)
                } else {
                    0
                }
            })
            .collect();
        let mut dead: Vec<usize> = (0..self.strands.len())
            .filter(|&strand| {
                self.is_free[strand] && (ways[2 * strand] == 0 || ways[2 * strand + 1] == 0)
            })
            .collect();
        while let Some(strand) = dead.pop() {
            if !std::mem::replace(&mut self.is_free[strand], false) {
                continue;
            }
            self.left.push(strand);
            for (tip, _) in [2 * strand, 2 * strand + 1]
                .into_iter()
                .flat_map(|tip| self.near(tip))
            {
                ways[tip] = ways[tip].saturating_sub(1);
                if ways[tip] == 0 && self.is_free[tip / 2] {
                    dead.push(tip / 2);
                }
            }
        }
    }

    /// Finds the loops among the free strands, each walk from the lowest place that is left.
    fn walk_loops(&mut self) {
        let mut begins: Vec<Tip> = (0..2 * self.strands.len())
            .filter(|tip| self.is_free[tip / 2])
            .collect();
        begins.sort_unstable_by(|&one, &other| {
            let [a, b] = [one, other].map(|tip| self.joints.place(self.end(tip)));
            by_coordinates(&a, &b).then_with(|| self.by_place(one, other))
        });
        for begin in begins {
            while self.is_free[begin / 2] {
                // The outside lies below: the first way in the counter-clockwise sense has it on its right.
                let near = self
                    .near(begin)
                    .into_iter()
                    .map(|(tip, _)| tip)
                    .filter(|tip| self.is_free[tip / 2]);
                let from_below = |tip: Tip| (self.heading(tip) + FRAC_PI_2).rem_euclid(TAU);
                let first = near.chain([begin]).min_by(|&one, &other| {
                    from_below(one)
                        .total_cmp(&from_below(other))
                        .then_with(|| self.by_place(one, other))
                });
                self.walk(first.unwrap_or(begin));
            }
        }
    }

    /// Walks from a tip along the outside, cuts off every loop as it closes, and leaves the ways that lead nowhere.
    fn walk(&mut self, begin: Tip) {
        let mut path: Vec<Tip> = Vec::new();
        // By place on the path: how many strands before it are no crumbs.
        let mut whole_before: Vec<usize> = vec![0];
        let rounding = ROUNDING * self.joints.certain();
        let mut next = Some(begin);
        loop {
            if let Some(tip) = next.take() {
                self.is_free[tip / 2] = false;
                self.entered[tip] = path.len();
                whole_before
                    .push(whole_before[path.len()] + usize::from(!self.strands[tip / 2].is_crumb));
                path.push(tip);
            }
            let Some(&last) = path.last() else { return };
            let tip = last ^ 1;
            let near = self.near(tip);
            let may_close = |place: usize, distance: f64| {
                let is_whole = whole_before[path.len()] > whole_before[place];
                is_whole || (distance == 0.0 && path.len() - place > 1)
            };
            let closings = near
                .iter()
                .map(|&(other, distance)| (self.entered[other], distance));
            let closings: Vec<(usize, f64)> = closings
                .filter(|&(place, distance)| place != NOWHERE && may_close(place, distance))
                .collect();
            let home = closings
                .iter()
                .map(|(_, distance)| *distance)
                .fold(f64::INFINITY, f64::min);
            // Among equally near ways to close, the one with the smallest loop.
            let closing = closings
                .iter()
                .filter(|(_, distance)| *distance <= home + rounding)
                .map(|(place, _)| *place)
                .max();
            let arriving = self.heading(tip) + PI;
            let turned = |other: Tip| {
                let turn = (self.heading(other) - arriving + PI).rem_euclid(TAU) - PI;
                // Straight back counts as the leftmost way, on whichever side rounding puts it.
                if turn < -PI + 1e-6 { turn + TAU } else { turn }
            };
            // Beside edges that two outlines share the nearest way to the left leads round one of these, but not straight back.
            let is_free = |(other, _): &&(Tip, f64)| self.is_free[other / 2];
            let is_shared = |(other, _): &(Tip, f64)| self.twin(other / 2).is_some();
            let are_shared = near.iter().filter(is_free).any(is_shared);
            let leads_back = |other: Tip| {
                let twin = self.twin(other / 2);
                twin.is_some() && twin == self.only(last / 2)
            };
            let onward = near
                .iter()
                .filter(is_free)
                .min_by(|(one, near), (other, far)| {
                    let turns = || turned(*one).total_cmp(&turned(*other));
                    let order = match are_shared {
                        true => leads_back(*one)
                            .cmp(&leads_back(*other))
                            .then_with(|| turns().reverse()),
                        false => near.total_cmp(far).then_with(turns),
                    };
                    order.then_with(|| self.by_place(*one, *other))
                });
            let onward = onward.copied();
            match (closing, onward) {
                (Some(place), onward)
                    if onward.is_none_or(|(_, distance)| home <= distance + rounding) =>
                {
                    let strands: Vec<(usize, bool)> = path
                        .drain(place..)
                        .map(|tip| (tip / 2, tip % 2 == 1))
                        .collect();
                    for &(strand, _) in &strands {
                        self.entered[2 * strand] = NOWHERE;
                        self.entered[2 * strand + 1] = NOWHERE;
                    }
                    whole_before.truncate(place + 1);
                    self.joined.push(Joined {
                        strands,
                        closed: true,
                    });
                }
                (_, Some((other, _))) => next = Some(other),
                (_, None) => {
                    path.pop();
                    whole_before.pop();
                    self.entered[last] = NOWHERE;
                    self.left.push(last / 2);
                }
            }
        }
    }

    /// Joins what is in no loop: ends in one point first, then the nearest, of equally near ones the straightest.
    fn join_open(&mut self) {
        let mut is_left = vec![false; self.strands.len()];
        self.left.iter().for_each(|&strand| is_left[strand] = true);
        let tips = 0..2 * self.strands.len();
        let mut open = Open {
            links: vec![NOWHERE; tips.len()],
            far: tips.clone().map(|tip| tip ^ 1).collect(),
            is_whole: tips.map(|tip| !self.strands[tip / 2].is_crumb).collect(),
        };
        // Each is asked about once for every end near it.
        let mut headings = vec![0.0; 2 * self.strands.len()];
        for &strand in &self.left {
            for tip in [2 * strand, 2 * strand + 1] {
                headings[tip] = self.heading(tip);
            }
        }
        let mut pairs: Vec<(f64, f64, Tip, Tip)> = Vec::new();
        for tip in self
            .left
            .iter()
            .flat_map(|&strand| [2 * strand, 2 * strand + 1])
        {
            let near: Vec<(Tip, f64)> = self
                .near(tip)
                .into_iter()
                .filter(|(other, _)| is_left[other / 2])
                .collect();
            let bend = |other: Tip| ((headings[other] - headings[tip]).abs() - PI).abs();
            let later = near.iter().filter(|(other, _)| *other > tip);
            pairs.extend(later.map(|&(other, distance)| (distance, bend(other), tip, other)));
        }
        let ordered = |one: Tip, other: Tip| {
            if self.by_place(one, other).is_le() {
                (one, other)
            } else {
                (other, one)
            }
        };
        pairs.sort_unstable_by(|a, b| {
            let by_place = || {
                let ((a, b), (c, d)) = (ordered(a.2, a.3), ordered(b.2, b.3));
                self.by_place(a, c).then_with(|| self.by_place(b, d))
            };
            a.0.total_cmp(&b.0)
                .then(a.1.total_cmp(&b.1))
                .then_with(by_place)
        });
        for (distance, _, one, other) in pairs {
            self.link(&mut open, one, other, distance);
        }
        self.join_crowds(&is_left, &mut open);
        self.collect_open(&open);
    }

    /// In a crowd, neighbours by direction are joined.
    fn join_crowds(&self, is_left: &[bool], open: &mut Open) {
        for crowd in self.joints.crowds() {
            let tips = crowd
                .iter()
                .map(|end| self.tip_of[end.index()])
                .filter(|&tip| tip != u32::MAX)
                .map(|tip| tip as Tip);
            let mut tips: Vec<Tip> = tips
                .filter(|&tip| is_left[tip / 2] && open.links[tip] == NOWHERE)
                .collect();
            let angle = |tip: Tip| self.heading(tip).rem_euclid(TAU);
            tips.sort_by(|&one, &other| {
                angle(one)
                    .total_cmp(&angle(other))
                    .then_with(|| self.by_place(one, other))
            });
            for pair in tips.windows(2) {
                let distance = self.joints.distance(self.end(pair[0]), self.end(pair[1]));
                if distance <= self.joints.join() {
                    self.link(open, pair[0], pair[1], distance);
                }
            }
        }
    }

    /// Joins two tips where both are free, unless that would close an empty loop.
    fn link(&self, open: &mut Open, one: Tip, other: Tip, distance: f64) {
        if open.links[one] != NOWHERE || open.links[other] != NOWHERE {
            return;
        }
        if open.far[one] == other && !open.is_whole[one] && (distance > 0.0 || one / 2 == other / 2)
        {
            return;
        }
        let (a, b) = (open.far[one], open.far[other]);
        let is_whole = open.is_whole[one] || open.is_whole[other];
        (open.is_whole[a], open.is_whole[b]) = (is_whole, is_whole);
        (open.links[one], open.links[other]) = (other, one);
        (open.far[a], open.far[b]) = (b, a);
    }

    fn collect_open(&mut self, open: &Open) {
        let mut is_done = vec![false; self.strands.len()];
        for at in 0..self.left.len() {
            let strand = self.left[at];
            if is_done[strand] {
                continue;
            }
            // Back to where the contour begins, or round.
            let mut begin = 2 * strand;
            while open.links[begin] != NOWHERE {
                begin = open.links[begin] ^ 1;
                if begin == 2 * strand {
                    break;
                }
            }
            let closed = open.links[begin] != NOWHERE;
            let mut strands = Vec::new();
            let mut entered = begin;
            loop {
                strands.push((entered / 2, entered % 2 == 1));
                is_done[entered / 2] = true;
                entered = open.links[entered ^ 1];
                if entered == NOWHERE || entered == begin {
                    break;
                }
            }
            self.joined.push(Joined { strands, closed });
        }
    }
}

/// Tips of strands that are joined to open contours.
struct Open {
    /// By tip: its partner.
    links: Vec<Tip>,
    /// By free tip: the free tip at the other end of its contour.
    far: Vec<Tip>,
    /// By free tip: its contour is more than crumbs.
    is_whole: Vec<bool>,
}
