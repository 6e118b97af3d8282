//! A step in the words of the shop.

use crate::geometry::Segment;
use crate::ide::amounts::{mm, point};
use crate::program::path::{Kind, Step};

/// `line to (9.900, 0.000)`, `arc R 9.900 to …`.
pub(super) fn in_words(step: &Step) -> String {
    match (step.kind, &step.ideal) {
        (Kind::Pause, _) => say!(pause).into(),
        (Kind::End, _) => say!(end).into(),
        (Kind::Rapid, _) => say!(way_to, point(step.end)),
        (_, None) => say!(block_that_leads_nowhere).into(),
        (_, Some(Segment::Line(_))) => say!(line_to, point(step.end)),
        (_, Some(Segment::Arc(arc))) if arc.is_full_turn() => say!(circle_r, mm(arc.radius)),
        (_, Some(Segment::Arc(arc))) => say!(arc_r_to, mm(arc.radius), point(step.end)),
    }
}
