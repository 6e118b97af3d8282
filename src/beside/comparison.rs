//! The differences between a program and its drawing.

use super::alongside::{Seen, words};
use super::anchor::{anchor, others};
use super::drawn::Drawn;
use super::foreign::{foreign, segments};
use super::gouges::gouges;
use super::infer;
use super::members::Members;
use super::placement::{Placement, SNAPPED};
use super::rounds::{Course, Rounds};
use super::single::single;
use super::traced::Traced;
use super::walk::{Kind, Unlike, Walk, Walked};
use super::{REACH, TOLERANCE};
use crate::geometry::Segment;
use crate::settings::{Compensation, Corner, Effective, LengthSetting};
use std::ops::Range;
use std::rc::Rc;

pub use super::difference::{Comparison, Difference};
pub use super::walk::Kind as DifferenceKind;

/// Up to this many differences are one change each, whatever their share.
pub(super) const FEW: usize = 6;
/// The deviation of a 4B block that another rounding of its transitions explains, µm.
const ROUNDED: f64 = 2.5;
/// Of several differing blocks one deviates by at least this, µm.
pub(super) const CHANGED: f64 = 2.5;
/// For each differing block this many must be as we write them: then it is a change, and not another writer's rounding.
const OWN: usize = 8;
/// For each of two differing blocks this many must follow, where one ends quite elsewhere.
const LIKE: usize = 4;
/// A larger deviation is no change where nothing was named, µm.
const MOST_UNNAMED: f64 = 50.0;
/// The most corrections that are found for further passes.
const FURTHER: usize = 4;

/// Compares a program with a drawing by its blocks' geometry, whoever wrote them; `None` where it follows nothing of
/// the drawing.
pub(super) fn looked_at(drawn: &Drawn, traced: &Traced) -> Option<Comparison> {
    if traced.is_empty() || drawn.contours().is_empty() {
        return None;
    }
    let courses = courses(&drawn.settings, traced);
    let own = try_with(drawn, traced, &courses, true);
    if own.is_sure {
        return own.told(drawn, traced);
    }
    let near = nearest(drawn, traced, &courses);
    let own = near.exactly(drawn, traced).or_better(|| own);
    let own = if own.unlike.len() <= 2 * FEW {
        own.surely(traced)
    } else {
        own
    };
    // The start of a contour in 4B decides how its transitions are rounded, and it is not known to the micrometre.
    let is_rounding = |unlike: &Unlike| match traced.four_b {
        true => unlike.off <= ROUNDED,
        // One that ends where it should has its centre elsewhere.
        false => (SNAPPED..=TOLERANCE).contains(&unlike.off),
    };
    let is_loose = near.is_clean() && own.unlike.iter().all(is_rounding);
    // Under settings that are not those of the drawing, a difference may be meant.
    let is_meant = |tried: &Tried| tried.is_guess && !tried.is_clean() && !tried.is_one_change();
    if own.is_own() && !is_loose && !is_meant(&own) {
        return own.told(drawn, traced);
    }
    let near = near.surely(traced);
    if is_meant(&near) {
        return None;
    }
    near.told(drawn, traced)
}

/// The placement of a program on its drawing that explains it best, with room for roundings.
fn nearest(drawn: &Drawn, traced: &Traced, courses: &[Course]) -> Tried {
    let mut best = try_with(drawn, traced, courses, false);
    if !best.is_clean() {
        let other = with_other_corner(drawn);
        best = best.or_better(|| try_with(&other, traced, courses, false).guessed());
    }
    if !best.is_sound(traced) {
        let blocks = longest_cut(traced);
        let scale = drawn.unit_mm * 1e3;
        let mut wanted: Vec<Vec<Course>> = Vec::new();
        if !courses.contains(&Course::Drawn) {
            wanted.push(vec![Course::Drawn]);
        }
        for mm in infer::corrections(drawn.contours().iter(), scale, &blocks) {
            wanted.push(vec![Course::Beside(mm)]);
        }
        for courses in wanted {
            best = best.or_better(|| try_with(drawn, traced, &courses, false).guessed());
            if best.is_clean() {
                break;
            }
        }
    }
    best
}

pub(super) fn courses(settings: &Effective, traced: &Traced) -> Vec<Course> {
    if traced.four_b {
        return vec![Course::FourB, Course::Drawn];
    }
    let is_offset = traced.blocks.iter().any(|block| block.is_offset());
    if is_offset || settings.compensation == Compensation::None {
        return vec![Course::Drawn];
    }
    let corrections = settings.each_correction();
    corrections.into_iter().map(Course::Beside).collect()
}

pub(super) fn with_other_corner(drawn: &Drawn) -> Drawn {
    let corner = match drawn.settings.corner {
        Corner::Arc => Corner::Intersection,
        Corner::Intersection => Corner::Arc,
    };
    drawn.under(Effective {
        corner,
        ..(*drawn.settings).clone()
    })
}

/// One placement of the program on the drawing.
pub(super) struct Tried {
    unlike: Vec<Unlike>,
    /// Blocks that follow.
    followed: usize,
    follows: Vec<usize>,
    on: Vec<Option<(usize, bool)>>,
    laid: Option<(Rc<Rounds>, Placement)>,
    /// Every block is known to follow.
    is_sure: bool,
    /// It is placed otherwise than the settings say.
    is_guess: bool,
}

/// `exact`: by the output of our own writers for the drawing.
fn try_with(drawn: &Drawn, traced: &Traced, courses: &[Course], exact: bool) -> Tried {
    let mut rounds = Rounds::default();
    rounds.add(drawn, courses, None);
    let placement = anchor(traced, &rounds).and_then(|placement| match exact {
        true => placement.exactly(),
        false => Some(placement),
    });
    match placement {
        Some(placement) => along(drawn, traced, courses, rounds, placement),
        None => Tried::nothing(),
    }
}

/// Walks along the present rounds, and along those of further corrections.
fn along(
    drawn: &Drawn,
    traced: &Traced,
    courses: &[Course],
    mut rounds: Rounds,
    placement: Placement,
) -> Tried {
    if placement.is_exact()
        && let Some(walked) = sound_somewhere(traced, &rounds, placement)
    {
        return Tried::of(traced, walked, &[], (Rc::new(rounds), placement)).sure();
    }
    let tabs = tabs(drawn);
    let mut walked = Walk::new(traced, &rounds, placement).go(&tabs);
    let mut foreign = foreign(traced, &walked);
    let mut is_guess = false;
    // A pass at a correction that the settings do not have.
    let of_passes = !traced.four_b
        && courses
            .iter()
            .any(|course| matches!(course, Course::Beside(_)));
    for _ in 0..FURTHER {
        let Some(stray) = foreign
            .first()
            .filter(|_| of_passes && !walked.contours.is_empty())
        else {
            break;
        };
        let mut contours = walked.contours.clone();
        contours.sort_unstable();
        contours.dedup();
        let blocks: Vec<Segment> = segments(&traced.blocks[stray.clone()]).collect();
        let own = contours.iter().map(|&index| &drawn.contours()[index]);
        let before = rounds.rounds.len();
        for mm in infer::corrections(own, drawn.unit_mm * 1e3, &blocks)
            .into_iter()
            .take(2)
        {
            for &contour in &contours {
                rounds.add(drawn, &[Course::Beside(mm)], Some(contour));
            }
        }
        if rounds.rounds.len() == before {
            break;
        }
        let again = Walk::new(traced, &rounds, placement).go(&tabs);
        let left = self::foreign(traced, &again);
        if left.len() >= foreign.len() {
            break;
        }
        (walked, foreign, is_guess) = (again, left, true);
    }
    Tried {
        is_guess,
        ..Tried::of(traced, walked, &foreign, (Rc::new(rounds), placement))
    }
}

/// All blocks of a program, each with its place on the drawing; and the sum of their deviations, µm.
pub(super) fn sound(
    traced: &Traced,
    rounds: &Rounds,
    placement: Placement,
) -> Option<(Walked, f64)> {
    let members = Members::all(traced, rounds, placement);
    members.filter(|(walked, _)| foreign(traced, walked).is_empty())
}

/// The same from any place where the program may lie.
fn sound_somewhere(traced: &Traced, rounds: &Rounds, placement: Placement) -> Option<Walked> {
    let mut placements = std::iter::once(placement).chain(others(traced, rounds, &placement));
    placements.find_map(|placement| Some(sound(traced, rounds, placement)?.0))
}

/// The lengths of the tabs that may be left standing, µm.
fn tabs(drawn: &Drawn) -> Vec<f64> {
    match &drawn.settings.tab {
        LengthSetting::One(tab) => vec![tab * 1e3],
        LengthSetting::ByHandle(tabs) => tabs.values().map(|tab| tab * 1e3).collect(),
    }
}

/// One finding for each cut that follows nothing.
fn followed_or_named(unlike: &mut Vec<Unlike>, foreign: &[Range<usize>]) {
    unlike.extend(foreign.iter().map(|blocks| Unlike {
        block: blocks.start,
        source: None,
        off: 0.0,
        kind: Kind::Foreign,
    }));
    unlike.sort_by_key(|unlike| unlike.block);
}

pub(super) fn longest_cut(traced: &Traced) -> Vec<Segment> {
    let longest = traced
        .cuts
        .iter()
        .map(|[all, _]| all.clone())
        .max_by_key(Range::len);
    longest.map_or_else(Vec::new, |blocks| {
        segments(&traced.blocks[blocks]).collect()
    })
}

impl Tried {
    fn nothing() -> Tried {
        Tried {
            unlike: Vec::new(),
            followed: 0,
            follows: Vec::new(),
            on: Vec::new(),
            laid: None,
            is_sure: false,
            is_guess: false,
        }
    }

    pub(super) fn of(
        traced: &Traced,
        mut walked: Walked,
        foreign: &[Range<usize>],
        laid: (Rc<Rounds>, Placement),
    ) -> Tried {
        // Another writer of 4B may round its transitions otherwise.
        let is_loose = traced.four_b && !laid.1.is_exact();
        walked
            .unlike
            .retain(|unlike| !is_loose || unlike.kind != Kind::Block || unlike.off > TOLERANCE);
        let mut unlike = walked.unlike;
        followed_or_named(&mut unlike, foreign);
        Tried {
            unlike,
            followed: walked.runs.iter().filter(|runs| **runs).count(),
            follows: walked.follows,
            on: walked.on,
            laid: Some(laid),
            is_sure: false,
            is_guess: false,
        }
    }

    fn sure(self) -> Tried {
        Tried {
            is_sure: true,
            ..self
        }
    }

    fn guessed(self) -> Tried {
        Tried {
            is_guess: true,
            ..self
        }
    }

    /// All blocks except one are as laid, and that one deviates by more than any rounding.
    fn is_one_change(&self) -> bool {
        let is_change = |one: &Unlike| one.kind == Kind::Block && one.off >= CHANGED;
        self.unlike.len() == 1 && self.is_own() && self.unlike.iter().all(is_change)
    }

    /// The same program by the output of our own writers for the drawing.
    fn exactly(&self, drawn: &Drawn, traced: &Traced) -> Tried {
        let laid = self.laid.as_ref();
        let laid =
            laid.and_then(|(rounds, placement)| Some((rounds.clone(), placement.exactly()?)));
        let Some((rounds, placement)) = laid else {
            return Tried::nothing();
        };
        if let Some(walked) = sound_somewhere(traced, &rounds, placement) {
            return Tried::of(traced, walked, &[], (rounds, placement)).sure();
        }
        let walked = Walk::new(traced, &rounds, placement).go(&tabs(drawn));
        let foreign = foreign(traced, &walked);
        Tried {
            is_guess: self.is_guess,
            ..Tried::of(traced, walked, &foreign, (rounds, placement))
        }
    }

    /// It is as we write it, except for what somebody has changed.
    fn is_own(&self) -> bool {
        let unlike = self.unlike.len();
        let own = if unlike > 2 { 4 * OWN } else { OWN };
        self.followed > 0 && self.followed >= own * unlike
    }

    /// The walk may be wrong about a block: perhaps all of the program follows, or all blocks except one.
    fn surely(mut self, traced: &Traced) -> Tried {
        if self.is_sure {
            return self;
        }
        let Some((rounds, placement)) = self.laid.clone() else {
            return self;
        };
        let whole = |traced: &Traced, placement: Placement| sound(traced, &rounds, placement);
        if whole(traced, placement).is_some() {
            self.unlike.clear();
            return self;
        }
        if !placement.is_exact() && self.unlike.is_empty() {
            return self;
        }
        let most = match self.unlike.is_empty() {
            true => MOST_UNNAMED,
            false => f64::INFINITY,
        };
        let mut placements = std::iter::once(placement).chain(others(traced, &rounds, &placement));
        let only = placements
            .find_map(|placement| single(traced, &rounds, placement, &self.unlike, most, &whole))
            .map(|only| only.unlike);
        // What is named needs no larger change elsewhere to explain it.
        let is_larger = |only: &Unlike| {
            let named = self.unlike.iter();
            !self.unlike.is_empty()
                && named
                    .clone()
                    .all(|named| named.kind == Kind::Block && named.block != only.block)
                && only.off > named.map(|named| named.off).sum::<f64>() + REACH
        };
        if let Some(only) = only.filter(|only| !is_larger(only)) {
            self.unlike = vec![only];
        }
        self
    }

    fn is_clean(&self) -> bool {
        self.followed > 0 && self.unlike.is_empty()
    }

    /// The differences may well be a change.
    fn is_sound(&self, traced: &Traced) -> bool {
        let count: usize = traced
            .cuts
            .iter()
            .map(|[_, contour]| contour.len())
            .sum::<usize>()
            .max(1);
        // Several small differences come from the guessed settings, not from a change.
        let is_change = |unlike: &Unlike| unlike.kind != Kind::Block || unlike.off >= CHANGED;
        let all = &self.unlike[..];
        // Of few blocks, two that end farther from their places than they are long may be those that another start has there.
        let goes_elsewhere = |unlike: &Unlike| {
            let own = traced.blocks[unlike.block].segment();
            own.is_some_and(|own| unlike.off > own.length())
        };
        let like = match all.len() > 1 && all.iter().any(goes_elsewhere) {
            true => LIKE,
            false => 1,
        };
        let is_likely = self.followed >= like * all.len().max(1)
            && (all.len() < 2 || all.iter().all(is_change))
            && (all.len() < 3 || self.is_own());
        2 * self.followed >= count && is_likely
    }

    fn or_better(self, other: impl FnOnce() -> Tried) -> Tried {
        let score = |tried: &Tried| tried.followed as i64 - tried.unlike.len() as i64;
        let other = other();
        if other.is_sure || score(&other) > score(&self) || self.followed == 0 {
            other
        } else {
            self
        }
    }

    pub(super) fn told(self, drawn: &Drawn, traced: &Traced) -> Option<Comparison> {
        if !self.is_sound(traced) {
            return None;
        }
        let beside = self.laid.as_ref().map(|(rounds, placement)| {
            let seen = Seen {
                drawn,
                traced,
                rounds,
                placement,
                on: &self.on,
            };
            let mut found = words(&seen);
            // Behind a change the program lies elsewhere.
            if self.unlike.is_empty() {
                found.extend(gouges(&seen));
            }
            found
        });
        let differences = self.unlike.into_iter().map(|unlike| {
            let block = &traced.blocks[unlike.block];
            Difference {
                range: block.range.clone(),
                line: block.line,
                segment: unlike.source,
                off: unlike.off / 1e3,
                kind: unlike.kind,
            }
        });
        let follows = self.follows.iter();
        let mut differences: Vec<Difference> = differences.collect();
        differences.extend(beside.into_iter().flatten());
        differences.sort_by_key(|difference| difference.range.start);
        Some(Comparison {
            differences,
            follows: follows
                .map(|&block| traced.blocks[block].range.clone())
                .collect(),
        })
    }
}
