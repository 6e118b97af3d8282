//! The blocks one slip away from a block, those that are calculated from everything else, and those that an unreadable one may be.

use super::super::block::{Block, Motion, PartArc, Quadrant};
use super::super::decode::{decode, meant};
use super::super::encode::{counted, line_block};
use super::super::rules::{self, Counts};
use super::loose::{Loose, Number};
use super::{Suspect, Written};
use crate::finding::Rule;
use crate::geometry::{Arc, Point, Segment, Vector};
use crate::program::grid::Node;
use crate::program::path::tolerance;
use crate::program::repair::keys;
use crate::program::repair::slip::BLOCK_KEYS;
use crate::program::repair::slip::{self, Ends, Sort};
use crate::settings::Effective;

/// The largest distance of coordinates with three decimals from a block's end, µm.
const STATED: f64 = 4.0;

/// The part of a block that a repair changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Slip {
    /// Z: the quadrant, the turn, or a line for an arc.
    Motion,
    Axis,
    /// Two numbers exchanged.
    Exchanged([Number; 2]),
    /// One number; the other of two that were typed alike is changed with it.
    Number(Number),
    /// Everything that leads to the coordinates after the block.
    Coordinates,
    /// An unreadable block.
    Unread,
}

/// The intended end of a block, µm, and its tolerance.
#[derive(Clone, Copy, Debug)]
struct Wanted {
    by: Vector,
    near: f64,
    is_stated: bool,
}

impl Wanted {
    fn is_met(&self, block: &Block) -> bool {
        let piece = super::piece_of(block);
        (piece.by - self.by).norm() <= self.near || (piece.machine - self.by).norm() <= self.near
    }

    /// True where an arc would have to go all round.
    fn is_turn(&self) -> bool {
        self.by.iter().all(|um| um.abs() <= self.near)
    }
}

type Made = slip::Slip<(Block, Slip)>;

impl Suspect<'_> {
    /// The possible intended blocks for a readable one.
    pub(super) fn replaced(
        &self,
        index: usize,
        block: &Block,
        own: &Written,
        ends: &Ends,
    ) -> Vec<Made> {
        let mut found = Vec::new();
        let old = self.pieces.all[index].by;
        let may_lead = |changed: &Block| {
            // What cannot be run is wrong by itself.
            decode(changed, Point::origin()).is_ok_and(|way| {
                let by = way.end() - Point::origin() - old;
                ends.may_be(by, by)
            })
        };
        // Of a way that closes nothing no number is told by anything.
        let is_loose = self.is_jump && self.pieces.stated_before(index).is_none();
        let mut take = |changed: Block, slip: Slip, sort: Sort, keys: i32| {
            let is_along = (block.x == 0) != (block.y == 0);
            let sort = match slip {
                Slip::Axis if is_along => sort,
                _ if is_loose => Sort::Calculated,
                _ => sort,
            };
            if changed != *block
                && !is_odd_ratio(&changed)
                && may_lead(&changed)
                && is_sound(&changed, own.part, self.settings)
                && !self.lacks_a_part(&changed, own.part)
            {
                // J of a line is its larger number, though the control takes a little less.
                let largest = changed.x.max(changed.y);
                let is_odd = changed.motion.is_line() && largest > 0 && changed.j != largest;
                let keys = keys + i32::from(is_odd);
                found.push(self.slip(index, (changed, slip), sort, keys));
            }
        };
        one_word_away(block, &mut take);
        self.one_key_away(index, (block, own), ends, &mut take);
        let piece = &self.pieces.all[index];
        for wanted in self.wanted(index, ends) {
            let wants_more = wanted.is_stated || piece.is_unsound || self.is_open;
            if !wants_more {
                continue;
            }
            for number in [Number::X, Number::Y, Number::J] {
                let Some((value, _)) = solved(block, number, &wanted) else {
                    continue;
                };
                let changed = with(block, number, value);
                let is_scaled =
                    number == Number::J && block.motion.is_line() && value != block.x.max(block.y);
                // Neither does a full turn come from a number that was not nearly written.
                if is_scaled || is_full_turn(&changed) || !wanted.is_met(&changed) {
                    continue;
                }
                let is_sure = wanted.is_stated && number == Number::J;
                let sort = if is_sure {
                    Sort::Stated
                } else {
                    Sort::Calculated
                };
                let written = &own.digits[number as usize];
                let keys = 2 + different(written, &value.to_string());
                // Along an axis nothing of such a number is written.
                let is_along = number != Number::J && (block.x == 0 || block.y == 0);
                if is_along && block.motion.is_line() {
                    continue;
                }
                let keys = keys + if is_along { BLOCK_KEYS } else { 0 };
                take(changed, Slip::Number(number), sort, keys);
            }
            let is_line = own.part.is_none();
            if let Some(line) = straight([wanted.by.x, wanted.by.y])
                && wanted.is_stated
                && is_line
            {
                let is_sure = block.motion.is_line();
                let sort = if is_sure {
                    Sort::Stated
                } else {
                    Sort::Calculated
                };
                take(line, Slip::Coordinates, sort, BLOCK_KEYS);
            }
        }
        found
    }

    /// The blocks with one key of a number undone, or with two numbers exchanged.
    fn one_key_away(
        &self,
        index: usize,
        (block, own): (&Block, &Written),
        ends: &Ends,
        take: &mut impl FnMut(Block, Slip, Sort, i32),
    ) {
        let numbers = [Number::X, Number::Y, Number::J];
        let value = |number: Number| number.of(block);
        // Of a line that is sound only its smaller number, or two alike, may be another one.
        let is_sound_line = block.motion.is_line() && !self.pieces.all[index].is_unsound;
        let is_ratio = block.motion.is_line() && block.x.max(block.y) < block.j;
        for (nth, number) in numbers.into_iter().enumerate() {
            let others = &numbers[nth + 1..];
            for other in others {
                let changed = with(&with(block, number, value(*other)), *other, value(number));
                take(changed, Slip::Exchanged([number, *other]), Sort::Key, 1);
            }
            let is_twin = |other: &&Number| value(**other) == value(number) && value(number) != 0;
            let may_be_alone = !is_sound_line || is_ratio || value(number) != block.j;
            if !may_be_alone && !others.iter().any(|other| is_twin(&other)) {
                continue;
            }
            // Where the arc ends where its centre does not decide, nothing can be calculated.
            let is_centre = !block.motion.is_line() && number != Number::J;
            let is_any = ends.is_any || is_ratio || is_centre;
            let wanted = ends.all().iter().filter(|_| !is_any).map(|gap| Wanted {
                by: gap + self.pieces.all[index].by,
                near: ends.within(),
                is_stated: false,
            });
            let targets: Vec<(i64, i64)> = wanted
                .filter_map(|wanted| solved(block, number, &wanted))
                .collect();
            let is_padded = self.widths[nth] == own.digits[nth].len();
            for meant in keys::numbers(&own.digits[nth], is_padded) {
                let mut targets = targets.iter();
                if !is_any && !targets.any(|(target, within)| (meant - target).abs() <= *within) {
                    continue;
                }
                if may_be_alone {
                    take(
                        with(block, number, meant),
                        Slip::Number(number),
                        Sort::Key,
                        1,
                    );
                }
                // Typed once, and again as it was typed.
                for other in others.iter().filter(is_twin) {
                    let both = with(&with(block, number, meant), *other, meant);
                    take(both, Slip::Number(number), Sort::Alike, 2);
                }
            }
        }
    }

    /// The ends that a block must have for everything to be right.
    fn wanted(&self, index: usize, ends: &Ends) -> Vec<Wanted> {
        let piece = &self.pieces.all[index];
        if let Some((from, to)) = self.pieces.stated_before(index).zip(piece.stated) {
            let is_off = piece.is_unread || piece.is_unsound || self.pieces.is_off(index);
            let wanted = Wanted {
                by: to.at - from.at,
                near: STATED,
                is_stated: true,
            };
            return is_off.then_some(wanted).into_iter().collect();
        }
        let arcs = self.pieces.all.iter();
        let arcs = arcs
            .filter(|piece| piece.is_arc() || piece.is_unread)
            .count();
        let wanted = |gap: &Vector| Wanted {
            by: gap + piece.by,
            near: tolerance(arcs),
            is_stated: false,
        };
        match self.pieces.closes && self.pieces.all.len() >= 3 {
            true => ends.all().iter().map(wanted).collect(),
            false => Vec::new(),
        }
    }

    /// The possible intended blocks for an unreadable one.
    pub(super) fn restored(&self, index: usize, loose: &Loose, ends: &Ends) -> Vec<Made> {
        let mut found = Vec::new();
        let mut take = |block: Block, keys: usize| {
            let is_usual = is_usual(&block);
            if is_sound(&block, None, self.settings) && !self.lacks_a_part(&block, None) {
                // One written like a line is no arc, and a line is seldom a ratio.
                let is_like_a_line =
                    block.j == block.x.max(block.y) || (block.x, block.y) == (0, 0);
                let is_odd = is_like_a_line != block.motion.is_line();
                let keys = 2 * keys as i32 + i32::from(!is_usual) + 3 * i32::from(is_odd);
                found.push(self.slip(index, (block, Slip::Unread), Sort::Key, keys));
            }
        };
        for reading in loose.readings() {
            let Some(number) = reading.unknown else {
                take(reading.block, reading.keys);
                continue;
            };
            for wanted in self.wanted(index, ends) {
                if let Some((value, _)) = solved(&reading.block, number, &wanted) {
                    let made = with(&reading.block, number, value);
                    if wanted.is_met(&made) {
                        take(made, reading.keys);
                    }
                }
            }
        }
        found
    }
}

/// The blocks with another word for G or Z.
fn one_word_away(block: &Block, take: &mut impl FnMut(Block, Slip, Sort, i32)) {
    let axis = block.axis.other();
    take(Block { axis, ..*block }, Slip::Axis, Sort::Key, 1);
    // There the two turns have different quadrants.
    let is_on_axis = (block.x == 0) != (block.y == 0);
    for motion in Motion::all() {
        let is_line = motion.is_line();
        let is_same_quadrant = motion.quadrant() == block.motion.quadrant();
        let is_same_turn = std::mem::discriminant(&motion) == std::mem::discriminant(&block.motion);
        let changed = Block { motion, ..*block };
        let keys = 1 + i32::from(!is_usual(&changed));
        if is_line != block.motion.is_line() {
            take(changed, Slip::Motion, Sort::Kind, keys + 2);
        } else if is_same_quadrant || is_same_turn || is_on_axis {
            take(changed, Slip::Motion, Sort::Key, keys);
        }
    }
}

/// True for a line whose X and Y are reduced by no whole factor, or lie along an axis: nobody writes such a ratio.
pub(super) fn is_odd_ratio(block: &Block) -> bool {
    let largest = block.x.max(block.y);
    let counted = block.axis.of([block.x, block.y]);
    let is_along = block.x == 0 || block.y == 0;
    let is_whole = counted > 0 && block.j % counted == 0;
    block.motion.is_line() && largest > 0 && largest < block.j && (is_along || !is_whole)
}

/// How many characters of a number differ from those of another one.
fn different(one: &str, other: &str) -> i32 {
    let same = one
        .bytes()
        .zip(other.bytes())
        .filter(|(a, b)| a == b)
        .count();
    (one.len().max(other.len()) - same) as i32
}

/// True for a block in which no rule finds a fault.
pub(in super::super) fn is_sound(
    block: &Block,
    part: Option<PartArc>,
    settings: &Effective,
) -> bool {
    let is_fault = |observation: &rules::Observation| {
        observation.rule != Rule::SmallRadius
            && !matches!(observation.counts, Counts::IfInside { .. })
    };
    part.is_none_or(|part| part.fits(block))
        && !rules::check(block, None, settings).iter().any(is_fault)
}

/// True where the quadrant is the customary one for a start or a direction on an axis.
pub(super) fn is_usual(block: &Block) -> bool {
    let quadrant = block.motion.quadrant();
    let (sx, sy) = quadrant.signs();
    let (x, y) = (block.x * sx as i64, block.y * sy as i64);
    let usual = match block.motion {
        Motion::Clockwise(_) => Quadrant::clockwise(x, y),
        _ => Quadrant::counter_clockwise(x, y),
    };
    (x, y) == (0, 0) || quadrant == usual
}

/// How wide numbers are written with zeros in front.
pub(super) fn widths(blocks: &[Written]) -> [usize; 3] {
    [0, 1, 2].map(|nth| {
        let numbers = blocks.iter().map(|own| own.digits[nth].as_str());
        let padded = numbers.filter(|digits| digits.len() > 1 && digits.starts_with('0'));
        padded.map(str::len).max().unwrap_or(0)
    })
}

fn is_full_turn(block: &Block) -> bool {
    meant(block, Point::origin())
        .as_ref()
        .and_then(Segment::as_arc)
        .is_some_and(Arc::is_full_turn)
}

pub(super) fn with(block: &Block, number: Number, value: i64) -> Block {
    match number {
        Number::X => Block { x: value, ..*block },
        Number::Y => Block { y: value, ..*block },
        Number::J => Block { j: value, ..*block },
    }
}

/// The value of a number that leads to the intended end, and how far from it others may lie that lead there, µm.
fn solved(block: &Block, number: Number, wanted: &Wanted) -> Option<(i64, i64)> {
    let value = value_to(block, number, wanted)?;
    let near = wanted.near.ceil() as i64;
    let along = [wanted.by.x, wanted.by.y][usize::from(number == Number::Y)];
    let is_steep = !block.motion.is_line() && number != Number::J;
    let within = match is_steep {
        // Where the arc's end hardly moves with its centre, many lead there.
        true => {
            let known = if number == Number::X {
                block.y
            } else {
                block.x
            };
            let radius = (value as f64).hypot(known as f64);
            ((wanted.near * radius / along.abs().max(1.0)).ceil() as i64).clamp(near, 4 * near)
        }
        false => 2 * near,
    };
    Some((value, within))
}

fn value_to(block: &Block, number: Number, wanted: &Wanted) -> Option<i64> {
    let [dx, dy] = [wanted.by.x, wanted.by.y];
    // Coordinates are not exact: 0 may come out below.
    let whole = |value: f64| {
        (value.is_finite() && (-0.5..1e12).contains(&value))
            .then_some(value.round().max(0.0) as i64)
    };
    match (block.motion, number) {
        (Motion::Line(_), Number::X) => whole(dx.abs()),
        (Motion::Line(_), Number::Y) => whole(dy.abs()),
        (Motion::Line(_), Number::J) => {
            let along = wanted.by[block.axis as usize];
            let larger = block.x.max(block.y);
            // The projection if it leads there, without the errors that the others have added up.
            let near = (along.abs() - larger as f64).abs() <= wanted.near;
            if near {
                Some(larger)
            } else {
                whole(along.abs())
            }
        }
        (
            Motion::Clockwise(quadrant) | Motion::CounterClockwise(quadrant),
            Number::X | Number::Y,
        ) => {
            // |d + s P|² = |P|²: the end is as far from the centre as the start.
            let (sx, sy) = quadrant.signs();
            let (own, other, known) = match number {
                Number::X => (sx * dx, sy * dy, block.y as f64),
                _ => (sy * dy, sx * dx, block.x as f64),
            };
            if wanted.is_turn() {
                // A full turn counts 4R.
                let radius = block.j as f64 / 4.0;
                let value = whole((radius * radius - known * known).sqrt())?;
                return (value > 0).then_some(value);
            }
            let chord = dx * dx + dy * dy;
            if own.abs() < 1.0 || chord < 1.0 {
                return None;
            }
            whole(-(chord + 2.0 * other * known) / (2.0 * own))
        }
        (_, Number::J) => {
            let Some(Segment::Arc(arc)) = meant(&Block { j: 1, ..*block }, Point::origin()) else {
                return None;
            };
            let end = Point::from(wanted.by);
            if ((end - arc.center).norm() - arc.radius).abs() > wanted.near {
                return None;
            }
            let turns_left = matches!(block.motion, Motion::CounterClockwise(_));
            let about = Arc::about(arc.center, arc.start, end, turns_left);
            if wanted.is_turn() {
                return Some((4.0 * arc.radius).round() as i64);
            }
            Some(counted(&about, block.axis).round() as i64)
        }
    }
}

/// The straight block that leads there.
pub(super) fn straight(by: [f64; 2]) -> Option<Block> {
    let [x, y] = by.map(|um| um.round() as i64);
    ((x, y) != (0, 0)).then(|| line_block(Node { x: 0, y: 0 }, Node { x, y }))
}
