//! Differences between a program and its drawing: their numbers and sentences.

use super::lengths::mm;
use crate::geometry::Side;
use std::sync::Arc;

/// A difference between a program and its drawing, as one of the two has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Unlike {
    /// The name of the other document.
    pub(crate) other: Arc<str>,
    /// At the drawing: the line of the program, from 1.
    pub(crate) line: Option<usize>,
    /// At the program: the segment of the drawing, and the handle of its entity, where they are known.
    pub(crate) segment: usize,
    pub(crate) handle: String,
    /// In mm, at the drawing in its unit.
    pub(crate) off: f64,
    pub(crate) kind: DifferenceKind,
}

told! {
    /// What is different.
    enum DifferenceKind;
    fn sentence(at: &Unlike, unit_mm: f64);

    /// The block leads elsewhere than its segment.
    Block => match at.line {
        Some(line) => say!(the_program_does_not_follow_this_segment, at.other, line, mm(at.off * unit_mm)),
        None => say!(the_block_does_not_follow_its_drawing, at.segment, at.handle, at.other, mm(at.off)),
    };
    /// Its contour lies elsewhere.
    Moved => match at.line {
        Some(line) => say!(the_program_begins_this_contour_elsewhere, at.other, line, mm(at.off * unit_mm)),
        None => say!(the_contour_does_not_begin_where_its_drawing_has_it, at.handle, at.other, mm(at.off)),
    };
    /// The contour goes on, with this segment, where the program does not.
    Unfinished => match at.line {
        Some(line) => say!(the_program_leaves_this_contour_before_this_segment, at.other, line),
        None => say!(the_contour_is_left_before_it_is_cut_all_round, at.segment, at.handle, at.other),
    };
    /// No contour of the drawing matches it.
    Foreign => say!(no_contour_of_the_drawing_is_like_this, at.other);
    /// A way in or out, or between contours, of a program of ours.
    Lead => say!(the_way_does_not_lead_where_its_drawing_has_it, at.other, mm(at.off));
    /// The coordinates after a block of such a program differ from its end.
    Stated => say!(the_coordinates_are_not_where_its_drawing_has_the_end, at.other, mm(at.off));
    /// The control lets the wire run on one side, or none, and should on another.
    Side { stated: Option<Side>, ideal: Option<Side> }
        => say!(the_correction_is_on_another_side, switch(*stated), switch(*ideal), at.other);
    /// A pass takes its correction from the place of another one.
    Register { stated: u32, ideal: u32 } => say!(the_correction_is_that_of_another_pass, stated, ideal, at.other);
    /// A contour is cut at another correction than the others of its program, nm.
    Correction { stated: u32, ideal: u32 } => {
        let [stated, ideal] = [stated, ideal].map(|nm| f64::from(*nm) / 1e6);
        say!(the_contour_is_cut_at_another_correction, at.handle, at.other, stated, ideal)
    };
    /// The machine should stop before this block.
    Unstopped => say!(a_stop_is_missing_before_this_block, at.other);
    /// The wire runs on the other side of an arc of 4B; it should run inside of it, or outside.
    Turned { inside: bool } => {
        let [stated, ideal] = if *inside { ["D", "DD"] } else { ["DD", "D"] };
        say!(the_arc_has_the_wire_on_its_other_side, stated, ideal, at.other)
    };
    /// A way in ends this far beside the path of its contour, which goes on from there.
    Astray => say!(the_way_in_ends_beside_its_contour, at.other, mm(at.off));
    /// The wire runs on the other side of its contour than the settings say.
    OtherSide => say!(it_is_cut_on_the_other_side, at.other);
    /// The two have nothing in common.
    Nothing => say!(nothing_is_like_the_other, at.other);
    /// It is milled differently from what the drawing's settings say, so its blocks are not compared.
    Milled => say!(it_is_milled_otherwise, at.other);
    /// From here on nothing is compared: the steps of the comparison are used up.
    Beyond => say!(it_is_compared_as_far_as_here, at.other);
    /// The other document cannot be read.
    Unreadable { reason: String } => say!(it_is_not_held_against_its_other, at.other, reason);
    /// The program may belong to `more` as well.
    Several { more: String } => say!(it_is_held_against_the_first, at.other, more);
}

/// The word that switches the correction.
fn switch(side: Option<Side>) -> &'static str {
    match side {
        Some(Side::Left) => "G41",
        Some(Side::Right) => "G42",
        None => "G40",
    }
}

impl Unlike {
    pub(crate) fn sentence(&self, unit_mm: f64) -> String {
        self.kind.sentence(self, unit_mm)
    }

    /// The distance, in the unit of its document.
    pub fn off(&self) -> Option<f64> {
        use DifferenceKind::{Astray, Block, Lead, Moved, Stated};
        let is_apart = matches!(self.kind, Block | Moved | Lead | Stated | Astray);
        is_apart.then_some(self.off)
    }

    /// Concerns both documents as a whole, which is no error of either.
    pub(crate) fn is_of_whole(&self) -> bool {
        use DifferenceKind::{Beyond, Milled, Nothing, Several, Unreadable};
        let kind = &self.kind;
        matches!(
            kind,
            Nothing | Milled | Beyond | Unreadable { .. } | Several { .. }
        )
    }
}
