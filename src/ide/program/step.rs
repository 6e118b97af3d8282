//! A step in the words of the shop, and those that may come next.

use crate::geometry::{Point, Segment};
use crate::ide::amounts::{mm, point};
use crate::program::path::{Kind, Step, Way, closing};

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

/// Where a straight line may lead back to from the end of a cut in progress, each in words: the start of the cut, and the
/// end of its way in.
pub(super) fn ways_back(begun: &Way) -> Vec<(Point, &'static str)> {
    let mut targets = Vec::new();
    if begun.count() > 0 {
        let [begin, lead_in] = [0, 1].map(|node| begun.node(node).machine);
        targets.push((begin, say!(line_back_to_the_start_of_the_contour)));
        // Where the contour is closed, only the way out is left.
        if begun.count() == 1 || !closing(begun).closed {
            targets.push((lead_in, say!(line_to_the_end_of_the_lead_in)));
        }
    }
    targets
}
