//! Differences between a program and its drawing: their numbers and sentences.

use super::lengths::mm;
use std::sync::Arc;

told! {
    /// A difference between a program and its drawing. `other` is the name of the other document.
    enum Unlike;
    fn sentence(unit_mm: f64);

    /// A block of the program does not lead to the end of a segment of the drawing; `off` is in mm.
    Block { other: Arc<str>, handle: String, segment: usize, off: f64 }
        => say!(the_block_does_not_follow_its_drawing, segment, handle, other, mm(*off));
    /// A contour of the program begins `off` mm from where the drawing has it.
    Moved { other: Arc<str>, handle: String, off: f64 }
        => say!(the_contour_does_not_begin_where_its_drawing_has_it, handle, other, mm(*off));
    /// The program leaves a contour before it is complete, where this segment of the drawing would be next.
    Unfinished { other: Arc<str>, handle: String, segment: usize }
        => say!(the_contour_is_left_before_it_is_cut_all_round, segment, handle, other);
    /// A contour, or a pass, of the program matches nothing in the drawing.
    Foreign { other: Arc<str> } => say!(no_contour_of_the_drawing_is_like_this, other);
    /// A way in or out, or between contours, does not lead where the drawing and its settings require; `off` is in mm.
    Lead { other: Arc<str>, off: f64 }
        => say!(the_way_does_not_lead_where_its_drawing_has_it, other, mm(*off));
    /// The coordinates after a block differ from the end in the drawing; `off` is in mm.
    Stated { other: Arc<str>, off: f64 }
        => say!(the_coordinates_are_not_where_its_drawing_has_the_end, other, mm(*off));
    /// A contour, a pass or a way is cut under one word of the correction where the drawing needs another.
    Side { other: Arc<str>, said: String, meant: String }
        => say!(the_correction_is_on_another_side, said, meant, other);
    /// A pass takes its correction from another register than the same pass elsewhere.
    Register { other: Arc<str>, said: u32, meant: u32 }
        => say!(the_correction_is_that_of_another_pass, said, meant, other);
    /// A contour is cut at another correction, mm, than the others of its program.
    Correction { other: Arc<str>, handle: String, said: f64, meant: f64 }
        => say!(the_contour_is_cut_at_another_correction, handle, other, said, meant);
    /// The machine should stop before this block.
    Unstopped { other: Arc<str> } => say!(a_stop_is_missing_before_this_block, other);
    /// The wire runs on the other side of an arc of 4B.
    Turned { other: Arc<str>, said: String, meant: String }
        => say!(the_arc_has_the_wire_on_its_other_side, said, meant, other);
    /// A way in ends beside the path of its contour, by `off` mm, and the contour goes on from there.
    Astray { other: Arc<str>, off: f64 } => say!(the_way_in_ends_beside_its_contour, other, mm(*off));
    /// The wire runs on the other side of its contours than the settings say.
    OtherSide { other: Arc<str> } => say!(it_is_cut_on_the_other_side, other);
    /// A block of the program, on a line from 1, does not follow this segment of the drawing; `off` is in the drawing's
    /// unit.
    Segment { other: Arc<str>, line: usize, off: f64 }
        => say!(the_program_does_not_follow_this_segment, other, line, mm(off * unit_mm));
    /// The program, on a line from 1, begins this contour elsewhere, this far off in the drawing's unit.
    Begin { other: Arc<str>, line: usize, off: f64 }
        => say!(the_program_begins_this_contour_elsewhere, other, line, mm(off * unit_mm));
    /// The program leaves this contour after a line, from 1, before it has cut this segment.
    Left { other: Arc<str>, line: usize }
        => say!(the_program_leaves_this_contour_before_this_segment, other, line);
    /// The two have nothing in common.
    Nothing { other: Arc<str> } => say!(nothing_is_like_the_other, other);
    /// It is milled differently from what the drawing's settings say, so its blocks are not compared.
    Milled { other: Arc<str> } => say!(it_is_milled_otherwise, other);
    /// From this block on it is not compared: that would take too many steps.
    Beyond { other: Arc<str> } => say!(it_is_compared_as_far_as_here, other);
    /// The other document cannot be read.
    Unreadable { other: Arc<str>, reason: String }
        => say!(it_is_not_held_against_its_other, other, reason);
    /// The program may belong to `more` as well.
    Several { other: Arc<str>, more: String } => say!(it_is_held_against_the_first, other, more);
}

impl Unlike {
    /// The distance, in the unit of its document.
    pub fn off(&self) -> Option<f64> {
        match self {
            Unlike::Block { off, .. }
            | Unlike::Moved { off, .. }
            | Unlike::Lead { off, .. }
            | Unlike::Stated { off, .. }
            | Unlike::Astray { off, .. }
            | Unlike::Segment { off, .. }
            | Unlike::Begin { off, .. } => Some(*off),
            _ => None,
        }
    }

    /// Concerns both documents as a whole, which is no error of either.
    pub(crate) fn is_of_whole(&self) -> bool {
        matches!(
            self,
            Unlike::Nothing { .. }
                | Unlike::Milled { .. }
                | Unlike::Beyond { .. }
                | Unlike::Unreadable { .. }
                | Unlike::Several { .. }
        )
    }
}
