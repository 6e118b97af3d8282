//! `position-mismatch`: the coordinates after a block differ from its end, relative to those before.
//!
//! Each end point is compared with the one before it and the block between them, so that one wrong block is one
//! finding.

use super::super::around::StatedPoint;
use super::super::block::Block;
use super::super::entry::{BlockEntry, Move, travel_of};
use super::TextFix;
use crate::finding::FixKind;
use crate::text::{TextEdit, WIDEST_COLUMN};
use std::ops::Range;

/// The tolerance for coordinates of three decimals, µm: both ends are rounded, and J of an arc moves its end by two µm
/// on each axis.
const TOLERANCE: f64 = 4.0;

/// The displacement of the stated end from the block's, µm, on an axis on which it is too large.
pub(in super::super) fn mismatch(
    before: &StatedPoint,
    travel: &Move,
    stated: &StatedPoint,
) -> Option<[f64; 2]> {
    let rounding = 10_f64.powi(3 - i32::from(before.decimals.min(stated.decimals)));
    let allowed = TOLERANCE.max(TOLERANCE / 2.0 + rounding);
    let off = |moved: [f64; 2]| {
        let along = |axis: usize| (stated.at[axis] - before.at[axis]) * 1000.0 - moved[axis];
        [along(0), along(1)]
    };
    let is_far = |[x, y]: [f64; 2]| x.abs() > allowed || y.abs() > allowed;
    let (meant, machine) = (
        off(travel.meant_um()),
        off(travel.machine.map(|um| um as f64)),
    );
    (is_far(meant) && is_far(machine)).then_some(meant)
}

/// The end points that stand after the blocks of a cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in super::super) struct Positions {
    /// Pairs of end points in the cut that were compared.
    pub(crate) compared: usize,
    /// The wrong ones, by the entry, and the displacement in µm.
    pub(crate) off: Vec<(usize, [f64; 2])>,
    /// Entry, end point and displacement of the first block, if it has an end point and nothing in the cut before it
    /// decides what that is compared with.
    pub(crate) first: Option<Box<(usize, StatedPoint, Move)>>,
    /// The place with which the next end point is compared, where that is decided: that of a block or of the start, or none.
    pub(crate) last: Option<Option<StatedPoint>>,
}

impl Positions {
    pub(crate) fn block(&mut self, entry: usize, block: &BlockEntry) {
        let stated = block.stated_end();
        match (self.last, stated) {
            (Some(Some(before)), Some(stated)) => {
                self.compared += 1;
                let by = mismatch(&before, &block.travel(), &stated);
                self.off.extend(by.map(|by| (entry, by)));
            }
            (None, Some(stated)) => {
                self.first = Some(Box::new((entry, stated, block.travel())));
            }
            _ => {}
        }
        self.last = Some(stated);
    }

    /// The program says where it starts, mm.
    pub(crate) fn start(&mut self, at: [f64; 2]) {
        self.last = Some(Some(StatedPoint { at, decimals: 3 }));
    }

    /// They are compared with nothing, and nothing is compared with them.
    pub(crate) fn say_nothing(&self) -> bool {
        let is_stated = matches!(self.last, Some(Some(_)));
        self.compared == 0 && self.first.is_none() && self.off.is_empty() && !is_stated
    }

    /// Nothing says where the wire stands.
    pub(crate) fn lost(&mut self) {
        self.last = Some(None);
    }
}

/// If a larger share of the end points is wrong, the numbers are not end points.
pub(in super::super) const FOREIGN: f64 = 0.5;

/// A block with wrong coordinates, for making its fix.
pub(in super::super) struct Mismatched<'a> {
    pub(crate) text: &'a [u8],
    pub(crate) block: Block,
    /// Bytes of the coordinates after the block.
    pub(crate) coordinates: Range<usize>,
    pub(crate) before: StatedPoint,
    /// Whether the next block leads on from these coordinates (`true`) or from the end of this block; `None` where that
    /// is unknown.
    pub(crate) goes_on: Option<bool>,
    /// Whether the contour closes with its blocks as they are.
    pub(crate) closes: bool,
}

/// The coordinates become the block's end, where the next block does not go on from them. Made by "fix all" only where the
/// contour shows that it is they that are wrong; which block would lead there is for the search to say.
pub(in super::super) fn fixes(site: &Mismatched<'_>) -> Vec<TextFix> {
    let may_be_wrong = site.goes_on != Some(true);
    let coordinates = may_be_wrong.then(|| set_coordinates(site)).flatten();
    let fix = coordinates.map(|(kind, edit)| {
        let is_safe = site.closes && site.goes_on == Some(false);
        TextFix::text(kind, is_safe, edit).preferred_if(site.closes)
    });
    fix.into_iter().collect()
}

fn set_coordinates(site: &Mismatched<'_>) -> Option<(FixKind, Vec<TextEdit>)> {
    let [x, y] = travel_of(&site.block).meant_um();
    let at = [
        site.before.at[0] + x / 1000.0,
        site.before.at[1] + y / 1000.0,
    ];
    let bytes = site.text.get(site.coordinates.clone())?;
    // All of a number, `1e9` too.
    let is_part =
        |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e' | b'E');
    let mut edit = Vec::new();
    let mut from = 0;
    for value in at {
        let start = from + bytes.get(from..)?.iter().position(is_part)?;
        let length = bytes[start..]
            .iter()
            .position(|byte| !is_part(byte))
            .unwrap_or(bytes.len() - start);
        let number = std::str::from_utf8(&bytes[start..start + length]).ok()?;
        let places = number
            .split_once('.')
            .map_or(0, |(_, places)| places.len().min(WIDEST_COLUMN));
        // A zero has no sign.
        let text = format!("{:.places$}", value + 0.0);
        let text = if text
            .trim_start_matches('-')
            .bytes()
            .all(|byte| matches!(byte, b'0' | b'.'))
        {
            text.replace('-', "")
        } else {
            text
        };
        let range = site.coordinates.start + start..site.coordinates.start + start + length;
        edit.extend((text != number).then_some(TextEdit::new(range, text)));
        from = start + length;
    }
    (!edit.is_empty()).then_some((FixKind::SetCoordinates { at }, edit))
}
