//! What is known of a cut by itself, wherever it stands: whether it closes, whether it goes round, where it crosses
//! itself, and what an offset loses of it.

use super::contour::{Closing, Ends, closing, goes_round};
use super::crossing::{Crossing, Tangle, margin, step_across};
use super::offset_losses::{ControlOffset, Loss, losses};
use super::passes::{MOST_PASSES, passes};
use super::way::Way;
use crate::finding::{Detail, Fault, Finding, NotJudged, Place, Rule, Severity};
use crate::geometry::{Bounds, Segment};
use crate::text::SourceText;
use std::cell::Cell;
use std::ops::Range;

/// A cut of fewer blocks does not cross itself.
pub(in crate::program) const FEWEST_CROSSING: usize = 4;

/// Twice an area that no way to and fro reaches by rounding, µm²: 1 mm².
const LARGE: f64 = 2e6;

/// What is known of a cut by itself.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct Verdict {
    /// Its first and last nodes, from its start.
    pub(crate) ends: Ends,
    /// Twice the area between the way and its chord, µm²; above 0 where it runs to the left.
    pub(crate) twice_area: f64,
    /// Its box, µm, from its start.
    pub(crate) bounds: Bounds,
    pub(crate) closing: Closing,
    /// It encloses something: passes to and fro do not.
    pub(crate) goes_round: bool,
}

impl Default for Verdict {
    fn default() -> Verdict {
        Verdict::of(&Way::default())
    }
}

impl Verdict {
    pub(crate) fn of(way: &Way) -> Verdict {
        let (ends, closing) = (Ends::of(way), closing(way));
        let (start, mut bounds) = (way.node(0).ideal, Bounds::EMPTY);
        let mut twice_area = 0.0;
        for piece in way.pieces() {
            twice_area += piece.twice_area(start);
            bounds.merge(&piece.bounds());
        }
        let is_large = twice_area.abs() > LARGE && ends.close();
        Verdict {
            goes_round: is_large || goes_round(way, closing),
            closing,
            ends,
            twice_area,
            bounds: bounds.moved(-start.coords),
        }
    }

    pub(crate) fn closes(&self) -> bool {
        self.closing.closed || self.ends.close()
    }
}

/// Where a cut crosses itself, and what the offset of the control loses of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::program) struct Found {
    pub(crate) crossings: Vec<Crossing>,
    /// Too much lies on one place to look at all of it.
    pub(crate) is_crowded: bool,
    losses: Vec<Loss>,
    /// It has too many blocks to look for losses.
    is_too_long: bool,
}

impl Found {
    /// Searches a cut, offset by the control where that is known.
    pub(crate) fn of(way: &Way, offset: Option<ControlOffset>) -> Found {
        if way.count() < FEWEST_CROSSING {
            return Found::default();
        }
        let passes = passes(way);
        let first_pass = passes.first().map_or(way.count(), |pass| pass.end);
        let (aside, whole) = (aside_at_stop(way), 0..way.count());
        let whole = std::slice::from_ref(&whole);
        let searched = if passes.is_empty() { whole } else { &passes };
        let mut found = Found {
            is_crowded: passes.len() == MOST_PASSES,
            ..Found::default()
        };
        for pass in searched {
            let (crossings, is_all) = crossings_of_pass(way, pass, aside);
            found.is_crowded |= !is_all;
            found.crossings.extend(crossings);
        }
        if let Some(offset) = offset.filter(|_| found.is_clean()) {
            let losses = losses(way, first_pass, offset);
            found.is_too_long = losses.is_none();
            found.losses = losses.unwrap_or_default();
        }
        found
    }

    pub(crate) fn is_clean(&self) -> bool {
        let crosses = !self.crossings.is_empty() || self.is_crowded;
        !crosses && self.losses.is_empty() && !self.is_too_long
    }

    /// What there is to report, of a way whose blocks stand at some bytes of the text.
    pub(crate) fn findings(
        &self,
        way: &Way,
        ranges: &[Range<usize>],
        text: &SourceText,
    ) -> Vec<Finding> {
        let range = |block: usize| ranges.get(block).cloned();
        let related = |range: Option<Range<usize>>| {
            let place = range.map(|range| Place::Text { range });
            place.into_iter().collect()
        };
        let crossing = |crossing: &Crossing| {
            let (from, own) = (range(crossing.first)?, range(crossing.second)?);
            // The corner that a control makes after a block belongs to that block.
            let before = crossing.second.checked_sub(1);
            let is_corner = before.and_then(range) == Some(own.clone());
            let piece = way.pieces().get(crossing.second).filter(|_| !is_corner);
            let fault = Fault::PathCrossesItself {
                at: [crossing.at.x / 1000.0, crossing.at.y / 1000.0],
                from_block: piece.map(|piece| (crossing.at - piece.start()) / 1000.0),
                other: text.line_of(from.start),
            };
            Some(Finding {
                related: related(Some(from)),
                ..Finding::of(fault, own)
            })
        };
        let loss = |loss: &Loss| {
            let own = range(loss.block)?;
            Some(Finding {
                related: related(loss.other.and_then(range)),
                ..Finding::in_text(loss.rule, own, loss.detail.clone()).with(loss.severity)
            })
        };
        let blocks = way.count();
        let left_out = [
            (self.is_crowded, NotJudged::Crossings { blocks }),
            (self.is_too_long, NotJudged::Losses { blocks }),
        ];
        let left_out = left_out.into_iter().filter(|(is_it, _)| *is_it);
        let left_out = left_out.filter_map(|(_, what)| {
            let last = ranges.last()?.clone();
            let finding = Finding::in_text(Rule::NotJudged, last, Detail::NotJudged(what));
            Some(finding.with(Severity::Information))
        });
        let crossings = self.crossings.iter().filter_map(crossing);
        let losses = self.losses.iter().filter_map(loss);
        crossings.chain(losses).chain(left_out).collect()
    }
}

/// The crossings of one pass of a cut, by their blocks in the way, and whether all of it was looked at. It may coincide
/// with another pass, and ways in and out cross others.
fn crossings_of_pass(way: &Way, pass: &Range<usize>, aside: f64) -> (Vec<Crossing>, bool) {
    let own = &way.pieces()[pass.clone()];
    let is_arc = |piece: &&Segment| piece.as_arc().is_some();
    let (mut crossings, is_all) = Tangle {
        pieces: own,
        margin: margin(own.iter().filter(is_arc).count()),
        aside,
        next: way.pieces().get(pass.end).copied(),
        steps: Cell::new(0),
    }
    .all_crossings();
    for crossing in &mut crossings {
        crossing.first += pass.start;
        crossing.second += pass.start;
    }
    (crossings, is_all)
}

/// The step to the side after the stop, to cut the tab in another pass than the one before, µm; 0 where there is none.
fn aside_at_stop(way: &Way) -> f64 {
    let across = || {
        let behind = way.stop()?;
        let before = way.pieces().get(behind.checked_sub(1)?)?;
        step_across(before, way.pieces().get(behind)?)
    };
    across().unwrap_or(0.0)
}
