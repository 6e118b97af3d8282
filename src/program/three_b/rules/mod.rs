//! The rules on 3B programs: one file each, with its check and its fixes.
//!
//! A rule on a single block sees that block alone ([`Outlook`]) and runs when its line is read; a rule on the whole
//! program sees the cuts that have been read. Fixes are made on demand, from the present text ([`Site`]).

mod arc_off_radius;
mod arc_without_radius;
mod block_number_as_b;
mod j_over_turn;
mod length_in_j;
mod missing_b;
mod projection;
mod reversed_arc;
mod small_radius;
mod too_many_digits;
mod wrong_counting_axis;
mod wrong_j;
mod wrong_quadrant;
mod zero_block;

pub(super) mod missing_end;
pub(super) mod position_mismatch;
pub(super) mod text_after_end;

use super::block::{Block, Motion, PartArc};
use super::decode::J_TOLERANCE;
use super::entry::BlockEntry;
use super::fault::{Flaw, SyntaxFault};
use super::fields::Fields;
use crate::drawing::wire_side;
use crate::finding::{Axis, Detail, Fault, Fix, FixKind, Rule};
use crate::program::path::{ControlOffset, MOST_BLOCKS, UM_IN_MM};
use crate::settings::{Compensation, Effective};
use crate::text::TextEdit;
use std::ops::Range;

/// This near to a tie of the two axes, µm, either G is accepted.
pub(super) const TIE: i64 = 1;

/// The same for the end of an arc: the end moves with the rounding of J, twice where both coordinates change.
pub(super) const ARC_TIE: f64 = 2.0 * J_TOLERANCE;

/// The program holds the part's contour, not the wire's path.
fn holds_part(settings: &Effective) -> bool {
    let asked = settings.compensation;
    matches!(asked, Compensation::None | Compensation::Controller)
}

/// The offset that the control makes of some blocks: in 4B their first arc says on which side the wire runs, in 3B that
/// holds the part's contour the settings do.
pub(super) fn control_offset<'a>(
    settings: &Effective,
    blocks: impl Iterator<Item = &'a BlockEntry>,
    twice_area: f64,
) -> Option<ControlOffset> {
    let mut sides = blocks
        .take(MOST_BLOCKS)
        .filter_map(BlockEntry::side_of_wire);
    let by_settings = || {
        let role = settings.side.role().filter(|_| holds_part(settings))?;
        wire_side(role, true, twice_area)
    };
    Some(ControlOffset {
        side: sides.next().or_else(by_settings)?,
        correction: settings.correction * UM_IN_MM,
    })
}

/// The part of a block that a fault lies in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spot {
    Block,
    X,
    Y,
    J,
    Radius,
    Axis,
    Motion,
}

impl Spot {
    /// Bytes of the spot, of `block` where the number is left out.
    pub(crate) fn range(self, fields: &Fields, block: Range<usize>) -> Range<usize> {
        let range = match self {
            Spot::Block => block.clone(),
            Spot::X => fields.x.clone(),
            Spot::Y => fields.y.clone(),
            Spot::J => fields.j.clone(),
            Spot::Radius => fields.radius.clone().unwrap_or_default(),
            Spot::Axis => fields.axis.clone(),
            Spot::Motion => fields.motion.clone(),
        };
        if range.is_empty() { block } else { range }
    }
}

/// When a fault of a block counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Counts {
    Always,
    /// Only where the contour does not close, and between contours: else the block is meant as it is.
    IfOpen,
    /// Where the contour closes, the block is meant in an unusual way, and the finding says so.
    MildIfClosed,
    /// Only where no block of the contour has a fault of its own.
    IfAlone,
    /// Only where the wire runs on the arc's centre side; the arc turns left or not.
    IfInside {
        turns_left: bool,
    },
}

/// A fault that a rule sees in a block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Observation {
    pub(crate) rule: Rule,
    pub(crate) spot: Spot,
    pub(crate) detail: Detail,
    pub(crate) counts: Counts,
}

impl Observation {
    pub(crate) fn at(spot: Spot, fault: Fault) -> Observation {
        Observation {
            rule: fault.rule(),
            spot,
            detail: Detail::Program(Box::new(fault)),
            counts: Counts::Always,
        }
    }

    /// The fault of a line as text.
    pub(crate) fn of(fault: &SyntaxFault) -> Observation {
        match fault.flaw {
            Flaw::MissingB { .. } => Observation::at(Spot::Block, Fault::MissingB),
            Flaw::BlockNumberAsB { number } => {
                Observation::at(Spot::Block, Fault::BlockNumberAsB { number })
            }
            _ => Observation {
                rule: Rule::Syntax,
                spot: Spot::Block,
                detail: Detail::Said(fault.sentence()),
                counts: Counts::Always,
            },
        }
    }
}

/// A block as a rule sees it.
pub(super) struct Outlook<'a> {
    pub(crate) block: &'a Block,
    pub(crate) part: Option<PartArc>,
    pub(crate) settings: &'a Effective,
}

impl Outlook<'_> {
    fn is_line(&self) -> bool {
        matches!(self.block.motion, Motion::Line(_))
    }

    fn radius(&self) -> f64 {
        (self.block.x as f64).hypot(self.block.y as f64)
    }
}

type Check = fn(&Outlook) -> Option<Observation>;

/// What leaves nothing else to be said of a block.
const ALONE: [Check; 3] = [
    zero_block::check,
    arc_without_radius::check,
    arc_off_radius::check,
];

const CHECKS: [Check; 7] = [
    length_in_j::check,
    wrong_j::check,
    j_over_turn::check,
    wrong_counting_axis::check,
    wrong_quadrant::check,
    too_many_digits::check,
    small_radius::check,
];

/// The faults of a block by itself.
pub(super) fn check(
    block: &Block,
    part: Option<PartArc>,
    settings: &Effective,
) -> Vec<Observation> {
    let outlook = Outlook {
        block,
        part,
        settings,
    };
    let seen = |check: &Check| check(&outlook);
    match ALONE.iter().find_map(seen) {
        Some(observation) => vec![observation],
        None => CHECKS.iter().filter_map(seen).collect(),
    }
}

/// A block in its text, for making fixes.
pub(super) struct Site<'a> {
    pub(crate) text: &'a [u8],
    /// The block's bytes, and those of its line with its line end.
    pub(crate) range: Range<usize>,
    pub(crate) line: Range<usize>,
    pub(crate) fields: Fields,
    pub(crate) block: Block,
    /// The largest number that the controller takes, µm.
    pub(crate) largest: i64,
    /// Whether a contour closes with other blocks in place of this one.
    pub(crate) closes_with: &'a dyn Fn(&[Block]) -> bool,
}

pub(super) use crate::finding::TextFix;

impl Site<'_> {
    fn replace(&self, range: &Range<usize>, text: impl Into<String>) -> TextEdit {
        TextEdit::new(range.clone(), text.into())
    }

    /// The fix that puts another block in its place.
    fn fix(&self, new: &Block, in_fix_all: bool) -> TextFix {
        let edits = self.fields.changed(self.text, &self.block, new);
        Fix::text(kind_of(&self.block, new), in_fix_all, edits)
    }

    /// Blocks that may be meant, the likeliest first. Those with which the contour closes come before the others: one that
    /// alone does is sure.
    fn one_of(&self, meant: impl IntoIterator<Item = Block>) -> Vec<TextFix> {
        let mut meant: Vec<(bool, Block)> = meant
            .into_iter()
            .map(|block| (!(self.closes_with)(&[block]), block))
            .collect();
        meant.sort_by_key(|(is_open, _)| *is_open);
        let is_sure = meant.iter().filter(|(is_open, _)| !is_open).count() == 1;
        let fixes = meant.iter().enumerate().map(|(nth, (_, block))| {
            let is_it = is_sure && nth == 0;
            self.fix(block, is_it).preferred_if(is_it)
        });
        fixes.collect()
    }

    /// The line with its line end where the block stands alone in it, else the block.
    fn whole(&self) -> Range<usize> {
        let outside = |range: Range<usize>| self.text.get(range).unwrap_or_default();
        let before = outside(self.line.start..self.range.start);
        let is_alone = before
            .iter()
            .all(|byte| !matches!(byte, b'B' | b'b' | b'D' | b'd'))
            && !outside(self.range.end..self.line.end)
                .iter()
                .any(|byte| matches!(byte, b'B' | b'b' | b'D' | b'd'));
        if is_alone {
            self.line.clone()
        } else {
            self.range.clone()
        }
    }

    fn delete(&self, kind: FixKind, in_fix_all: bool) -> TextFix {
        Fix::text(kind, in_fix_all, self.replace(&self.whole(), ""))
    }
}

/// What makes one block of another.
pub(super) fn kind_of(old: &Block, new: &Block) -> FixKind {
    let numbers = |block: &Block| [block.x, block.y, block.j];
    let pairs = numbers(old).into_iter().zip(numbers(new));
    let changed = pairs.filter(|(old, new)| old != new).count();
    let axis = new.axis;
    match () {
        _ if old.motion != new.motion => FixKind::SetMotion {
            name: new.motion.name(),
        },
        _ if old.axis != axis => FixKind::SetAxis {
            axis,
            j: (changed > 0).then_some(new.j),
        },
        _ if [old.x, old.y] == [new.y, new.x] && changed == 2 => FixKind::ExchangeXAndY,
        _ if changed > 1 => {
            let shown = |block: &Block| numbers(block).map(|number| format!("B{number}")).concat();
            FixKind::Rewrite {
                found: shown(old),
                meant: shown(new),
            }
        }
        _ if old.x != new.x => FixKind::SetEnd {
            axis: Axis::X,
            value: new.x,
        },
        _ if old.y != new.y => FixKind::SetEnd {
            axis: Axis::Y,
            value: new.y,
        },
        _ => FixKind::SetJ { j: new.j },
    }
}

/// The fixes of a fault in a block, the preferred one first.
pub(super) fn fixes(site: &Site, fault: &Fault) -> Vec<TextFix> {
    match fault.rule() {
        Rule::ZeroBlock => zero_block::fixes(site),
        Rule::ArcWithoutRadius => arc_without_radius::fixes(site),
        Rule::ArcOffRadius => arc_off_radius::fixes(site, fault),
        Rule::LengthInJ => length_in_j::fixes(site),
        Rule::WrongJ => wrong_j::fixes(site),
        Rule::JOverTurn => j_over_turn::fixes(site),
        Rule::WrongCountingAxis => wrong_counting_axis::fixes(site),
        Rule::WrongQuadrant => wrong_quadrant::fixes(site, fault),
        Rule::TooManyDigits => too_many_digits::fixes(site),
        Rule::MissingB => missing_b::fixes(site),
        Rule::BlockNumberAsB => block_number_as_b::fixes(site),
        Rule::ReversedArc => reversed_arc::fixes(site),
        _ => Vec::new(),
    }
}
