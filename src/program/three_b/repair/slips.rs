//! The blocks that differ from a block by one slip and lead to the intended end.

use super::super::block::{Block, Motion, PartArc, Quadrant};
use super::super::decode::meant;
use super::super::encode::{counted, line_block};
use super::super::entry::{Move, travel_of};
use super::super::rules::{self, Counts, Limits};
use super::loose::{Loose, Number};
use super::{Piece, STATED, Suspect};
use crate::finding::Rule;
use crate::geometry::{Arc, Point, Segment};
use crate::program::grid::Node;
use crate::program::repair::keys::{self, Key};

/// The cost of each µm between a repair's end and the intended one.
const MISS: f64 = 0.2;

/// The cost of the other one of two quadrants when a start or a direction lies between them.
const UNUSUAL: f64 = 0.3;

/// The part of a block that a repair changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Slip {
    /// Z: the quadrant, the turn, or a line for an arc.
    Motion,
    Axis,
    /// X and Y exchanged.
    Exchanged,
    /// One digit of a number, or any other value of it.
    Number(Number, Digits),
    /// Everything that leads to the coordinates after the block.
    Coordinates,
    /// An unreadable block; `keys` are inserted or removed.
    Unread {
        keys: usize,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Digits {
    One,
    Any,
}

/// The intended end of a block, µm, and its tolerance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    pub(crate) by: [f64; 2],
    pub(crate) near: f64,
}

impl Wanted {
    pub(crate) fn is_met(&self, block: &Block) -> bool {
        self.is_met_by(travel_of(block))
    }

    fn is_met_by(&self, travel: Move) -> bool {
        let own = Move {
            machine: self.by.map(|um| um.round() as i64),
            meant: self.by.map(|um| (um * 1e3).round() as i64),
        };
        travel.minus(own).is_within(self.near)
    }

    /// How far a block ends from there, µm.
    pub(crate) fn miss(&self, block: &Block) -> f64 {
        let [x, y] = travel_of(block).meant_um();
        (x - self.by[0]).hypot(y - self.by[1])
    }

    /// True where an arc would have to go all round.
    fn is_turn(&self) -> bool {
        self.by.iter().all(|um| um.abs() <= self.near)
    }

    fn end(&self) -> Point {
        Point::new(self.by[0], self.by[1])
    }
}

/// True for a block in which no rule finds a fault.
pub(in super::super) fn is_sound(block: &Block, part: Option<PartArc>, limits: &Limits) -> bool {
    let is_fault = |observation: &rules::Observation| {
        observation.rule != Rule::SmallRadius
            && !matches!(observation.counts, Counts::IfInside { .. })
    };
    part.is_none_or(|part| part.fits(block))
        && !rules::check(block, None, limits).iter().any(is_fault)
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

/// The numbers of a block as they are written: X, Y and J, and how wide the program makes each with zeros in front; 0 where it does not.
#[derive(Clone, Copy)]
pub(super) struct Written<'a> {
    pub(crate) digits: &'a [String; 3],
    pub(crate) widths: [usize; 3],
}

/// How wide numbers are written with zeros in front.
pub(super) fn widths(pieces: &[Piece]) -> [usize; 3] {
    [0, 1, 2].map(|nth| {
        let numbers = pieces.iter().map(|piece| piece.digits[nth].as_str());
        let padded = numbers.filter(|digits| digits.len() > 1 && digits.starts_with('0'));
        padded.map(str::len).max().unwrap_or(0)
    })
}

/// Blocks with the numbers of another one, and where each leads, whatever end is wanted.
fn of_same_numbers(block: &Block) -> Vec<(Block, Slip, Move)> {
    let (axis, x, y) = (block.axis.other(), block.y, block.x);
    let motions = Motion::all().map(|motion| (Block { motion, ..*block }, Slip::Motion));
    let others = [
        (Block { axis, ..*block }, Slip::Axis),
        (Block { x, y, ..*block }, Slip::Exchanged),
    ];
    let all = motions.chain(others).filter(|(other, _)| other != block);
    all.map(|(other, slip)| (other, slip, travel_of(&other)))
        .collect()
}

/// The sound blocks that differ from one by a slip and lead to the intended end: those `of_same_numbers`, and others.
fn blocks_to(
    (block, part): (&Block, Option<PartArc>),
    of_same_numbers: &[(Block, Slip, Move)],
    written: Written<'_>,
    wanted: &Wanted,
    limits: &Limits,
) -> Vec<(Block, Slip)> {
    let same = of_same_numbers.iter();
    let same = same
        .filter(|(other, _, travel)| wanted.is_met_by(*travel) && is_sound(other, part, limits));
    let mut found: Vec<(Block, Slip)> = same.map(|(other, slip, _)| (*other, *slip)).collect();
    let mut take = |changed: Block, slip: Slip| {
        if changed != *block && wanted.is_met(&changed) && is_sound(&changed, part, limits) {
            found.push((changed, slip));
        }
    };
    for number in [Number::X, Number::Y, Number::J] {
        for (value, how) in values(block, number, written, wanted) {
            let changed = with(block, number, value);
            // A full turn, or a line in another scale, does not come from a number that was not nearly written.
            let is_scaled =
                number == Number::J && block.motion.is_line() && value != block.x.max(block.y);
            if how == Digits::One || !(is_scaled || is_full_turn(&changed)) {
                take(changed, Slip::Number(number, how));
            }
        }
    }
    found
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

/// Values of a number with which a block may lead to the intended end: those one digit from the written one first.
fn values(
    block: &Block,
    number: Number,
    Written { digits, widths }: Written<'_>,
    wanted: &Wanted,
) -> Vec<(i64, Digits)> {
    let Some((value, within)) = solved(block, number, wanted) else {
        return Vec::new();
    };
    let (digits, width) = (&digits[number as usize], widths[number as usize]);
    let mut slips = slips_near(digits, value, within);
    slips.extend(padded_near(digits, width, value, within));
    slips.sort_unstable_by_key(|slip| (slip.abs_diff(value), *slip));
    slips.dedup();
    let slips = slips.into_iter().map(|slip| (slip, Digits::One));
    slips.chain([(value, Digits::Any)]).collect()
}

/// The numbers one key from a written one that lie `within` so much of a value.
fn slips_near(digits: &str, value: i64, within: i64) -> Vec<i64> {
    let is_plain = digits.bytes().all(|byte| byte.is_ascii_digit())
        && !digits.is_empty()
        && (digits == "0" || !digits.starts_with('0'));
    // Without a zero in front a number has one way to be written: those near the value are few.
    if is_plain {
        let near = value.saturating_sub(within).max(0)..=value.saturating_add(within);
        let is_one = |slip: &i64| keys::is_slip(digits.as_bytes(), slip.to_string().as_bytes());
        return near.filter(is_one).collect();
    }
    let is_likely = |key: &Key| !matches!(key, Key::Sign | Key::Point);
    keys::meant(digits, None)
        .into_iter()
        .filter(|(_, key)| is_likely(key))
        .filter_map(|(text, _)| text.parse().ok())
        .filter(|slip: &i64| slip.abs_diff(value) <= within as u64)
        .collect()
}

/// The same among numbers that are filled up with zeros in front: of the first digit of 403990 a wrong key makes 003990.
fn padded_near(digits: &str, width: usize, value: i64, within: i64) -> impl Iterator<Item = i64> {
    let near = value.saturating_sub(within).max(0)..=value.saturating_add(within);
    let near = (width > 0).then_some(near).into_iter().flatten();
    let is_one =
        move |slip: &i64| keys::is_slip(digits.as_bytes(), format!("{slip:0width$}").as_bytes());
    near.filter(is_one)
}

/// How far from a solved value the nearly written one is searched for, µm.
const ROUND: i64 = 40;

/// The value of a number that leads to the intended end, and its uncertainty, µm.
pub(super) fn solved(block: &Block, number: Number, wanted: &Wanted) -> Option<(i64, i64)> {
    let [dx, dy] = wanted.by;
    // Coordinates are not exact: 0 may come out below.
    let whole = |value: f64| {
        (value.is_finite() && (-0.5..1e12).contains(&value))
            .then_some(value.round().max(0.0) as i64)
    };
    match (block.motion, number) {
        (Motion::Line(_), Number::X) => Some((whole(dx.abs())?, wanted.near.ceil() as i64)),
        (Motion::Line(_), Number::Y) => Some((whole(dy.abs())?, wanted.near.ceil() as i64)),
        (Motion::Line(_), Number::J) => {
            let along = wanted.by[block.axis as usize];
            let larger = block.x.max(block.y);
            // The projection if it leads there, without the errors that the others have added up.
            let near = (along.abs() - larger as f64).abs() <= wanted.near;
            Some((if near { larger } else { whole(along.abs())? }, 0))
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
                return (value > 0).then(|| {
                    let within = (radius / value as f64).ceil() as i64;
                    (value, within.clamp(2, ROUND))
                });
            }
            let chord = dx * dx + dy * dy;
            if own.abs() < 1.0 || chord < 1.0 {
                return None;
            }
            let value = whole(-(chord + 2.0 * other * known) / (2.0 * own))?;
            let radius = (value as f64).hypot(known);
            let within = (wanted.near * radius / own.abs()).ceil() as i64;
            Some((value, within.clamp(2, ROUND)))
        }
        (_, Number::J) => {
            let Some(Segment::Arc(arc)) = meant(&Block { j: 1, ..*block }, Point::origin()) else {
                return None;
            };
            let end = wanted.end();
            if ((end - arc.center).norm() - arc.radius).abs() > wanted.near {
                return None;
            }
            let turns_left = matches!(block.motion, Motion::CounterClockwise(_));
            let about = Arc::about(arc.center, arc.start, end, turns_left);
            if wanted.is_turn() {
                return Some(((4.0 * arc.radius).round() as i64, 2));
            }
            // Coordinates tell more exactly than a contour that closes.
            let within = if wanted.near <= STATED { 2 } else { 4 };
            Some((counted(&about, block.axis).round() as i64, within))
        }
    }
}

/// The straight block that leads there.
pub(super) fn straight(wanted: &Wanted) -> Option<Block> {
    let [x, y] = wanted.by.map(|um| um.round() as i64);
    ((x, y) != (0, 0)).then(|| line_block(Node { x: 0, y: 0 }, Node { x, y }))
}

impl Suspect<'_> {
    /// The possible intended blocks for a readable one.
    pub(super) fn replaced(
        &self,
        block: &Block,
        piece: &Piece,
        wanted: &[(Wanted, bool)],
    ) -> Vec<((Block, Slip), f64)> {
        let mut found = Vec::new();
        // What is written like a line is one.
        let is_like_line = block.j == block.x.max(block.y);
        let same = match wanted {
            [] => Vec::new(),
            _ => of_same_numbers(block),
        };
        for (wanted, is_stated) in wanted {
            let own = (block, piece.item.part);
            let limits = self.path.limits;
            let written = Written {
                digits: &piece.digits,
                widths: self.widths,
            };
            for (changed, slip) in blocks_to(own, &same, written, wanted, limits) {
                if self.lacks_a_part(&changed, own.1) {
                    continue;
                }
                let is_other_kind = block.motion.is_line() != changed.motion.is_line();
                let cost = match slip {
                    Slip::Number(Number::J, Digits::Any) => 1.6,
                    // Along an axis nothing of such a number is written.
                    Slip::Number(_, Digits::Any) if block.x == 0 || block.y == 0 => 3.4,
                    Slip::Number(_, Digits::Any) => 2.6,
                    Slip::Motion if is_other_kind && is_like_line && changed.motion.is_line() => {
                        0.9
                    }
                    Slip::Motion if is_other_kind && is_like_line => 2.2,
                    _ => 1.0,
                };
                let is_unusual = slip == Slip::Motion && !is_usual(&changed);
                let cost = cost + if is_unusual { UNUSUAL } else { 0.0 };
                found.push(((changed, slip), cost + MISS * wanted.miss(&changed)));
            }
            let is_line = piece.item.part.is_none();
            if let Some(line) =
                straight(wanted).filter(|line| *is_stated && is_line && line != block)
            {
                found.push(((line, Slip::Coordinates), 3.0));
            }
        }
        found
    }

    /// True for an arc without a radius among arcs of 4B, which have one.
    pub(super) fn lacks_a_part(&self, block: &Block, part: Option<PartArc>) -> bool {
        !block.motion.is_line() && part.is_none() && self.is_four_b
    }

    /// The possible intended blocks for an unreadable one.
    pub(super) fn restored(
        &self,
        loose: &Loose,
        wanted: &[(Wanted, bool)],
    ) -> Vec<((Block, Slip), f64)> {
        let readings = loose.readings();
        let mut found = Vec::new();
        let mut take = |block: Block, keys: usize, more: f64| {
            if is_sound(&block, None, self.path.limits) && !self.lacks_a_part(&block, None) {
                let slip = Slip::Unread { keys };
                found.push(((block, slip), restored(&block, keys) + more));
            }
        };
        for (wanted, _) in wanted {
            for reading in &readings {
                let made = match reading.unknown {
                    None => Some(reading.block),
                    Some(number) => solved(&reading.block, number, wanted)
                        .map(|(value, _)| with(&reading.block, number, value)),
                };
                if let Some(made) = made.filter(|made| wanted.is_met(made)) {
                    take(made, reading.keys, MISS * wanted.miss(&made));
                }
            }
        }
        // By its own content, where nothing tells its end.
        let whole = readings.iter().filter(|reading| reading.unknown.is_none());
        whole.for_each(|reading| take(reading.block, reading.keys, 1.0));
        found
    }
}

/// The cost of a block that is read with this many keys more or less: one written like a line is no arc, and a line is
/// seldom a ratio.
fn restored(block: &Block, keys: usize) -> f64 {
    let is_like_a_line = block.j == block.x.max(block.y) || (block.x, block.y) == (0, 0);
    let is_odd = is_like_a_line != block.motion.is_line();
    0.4 * keys as f64 + if is_odd { 0.8 } else { 0.0 } + if is_usual(block) { 0.0 } else { UNUSUAL }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_key_in_front_of_a_padded_number_is_one() {
        for (digits, width, value, expected) in [
            ("403990", 6, 3990, true),
            ("013990", 6, 3990, true),
            ("403990", 0, 3990, false),
            ("403990", 6, 3980, false),
        ] {
            let mut found = padded_near(digits, width, value, 4);
            assert_eq!(found.any(|slip| slip == 3990), expected, "{digits} {width}");
        }
    }

    proptest::proptest! {
        /// Both ways to find them agree.
        #[test]
        fn the_numbers_one_key_away_are_those_that_keys_make(digits in "0|[1-9][0-9]{0,7}", by in -200i64..200, scale in 0u32..7, within in 0i64..ROUND) {
            let written: i64 = digits.parse().unwrap();
            let value = (written + by * 10i64.pow(scale)).max(0);
            let all = keys::meant(&digits, None).into_iter().filter(|(_, key)| !matches!(key, Key::Sign | Key::Point));
            let near = all.filter_map(|(text, _)| text.parse().ok()).filter(|slip: &i64| slip.abs_diff(value) <= within as u64);
            let mut expected: Vec<i64> = near.collect();
            expected.sort_unstable();
            expected.dedup();
            proptest::prop_assert_eq!(slips_near(&digits, value, within), expected);
        }
    }
}
