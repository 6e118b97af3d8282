//! What the offset of a contour loses where the control makes it: `narrow-slot`, `lost-pocket` and `offset-collapse` in
//! programs.
//!
//! The contour, without its ways in and out, is judged as that of a drawing, by the same rules. Of several passes the
//! first is looked at. Most contours are nowhere nearly as narrow as the wire needs: these are recognised before that.

use super::contour::closing;
use super::polyline::{is_halved, polyline};
use super::tight::{ROUNDING, UM_IN_MM};
use super::way::{Node, Way};
use crate::analysis::Analysis;
use crate::drawing::{Drawing, Entity, Unit};
use crate::finding::{Detail, Finding, Place, Rule, Severity, Side};
use crate::geometry::{Boxes, Point, Segment};
use crate::settings::{Effective, Settings, SideSetting};
use std::sync::{Arc, LazyLock};

/// Contours of more blocks are not looked at: it would take longer than an edit may take.
pub(in crate::program) const MOST_BLOCKS: usize = crate::toolpath::MOST_SEGMENTS_OF_MISFITS;

/// The most pairs of blocks whose boxes come near each other, for each block, before all is looked at.
const MOST_NEAR: usize = 32;

/// The offset that a control makes of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::program) struct ControlOffset {
    /// Where the wire runs.
    pub(crate) side: Side,
    /// µm.
    pub(crate) correction: f64,
}

impl ControlOffset {
    /// The correction of the check: programs are rounded to µm.
    fn checked(self) -> f64 {
        self.correction - ROUNDING
    }
}

/// Something that the offset loses of a contour.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct Loss {
    /// The blocks of the way that it is seen at.
    pub(super) block: usize,
    pub(super) other: Option<usize>,
    pub(super) rule: Rule,
    pub(super) severity: Severity,
    /// In mm; a place counts from the start of its block.
    pub(super) detail: Detail,
}

/// The losses of the first pass of a way, of `count` blocks; `None` where these are too many.
pub(super) fn losses(way: &Way, count: usize, offset: ControlOffset) -> Option<Vec<Loss>> {
    let is_nothing = offset.checked() <= 0.0;
    if is_nothing || count < 2 {
        return Some(Vec::new());
    }
    (count <= MOST_BLOCKS).then(|| Contour::of(way, count).losses(offset))
}

/// A closed contour: its blocks that have a length, with their numbers in the way.
struct Contour {
    pieces: Vec<Segment>,
    blocks: Vec<usize>,
}

impl Contour {
    /// The contour in the first blocks of a way.
    fn of(way: &Way, count: usize) -> Contour {
        let mut pass = Way::from(Node::at(way.node(0).ideal), way.writing());
        for piece in &way.pieces()[..count] {
            pass.push(*piece, piece.as_arc().is_some(), Node::at(piece.end()));
        }
        let closing = closing(if count == way.count() { way } else { &pass });
        let own = closing.lead_in..count - closing.lead_out;
        let (blocks, pieces) = own
            .map(|block| (block, way.pieces()[block]))
            .filter(|(_, piece)| closing.closed && piece.length() > 0.0)
            .unzip();
        Contour { pieces, blocks }
    }

    /// Twice the area, µm², above 0 where it runs counter-clockwise.
    fn twice_area(&self) -> f64 {
        let origin = self.pieces.first().map_or(Point::origin(), Segment::start);
        let shares = self.pieces.iter().map(|piece| piece.twice_area(origin));
        shares.sum()
    }

    fn losses(&self, offset: ControlOffset) -> Vec<Loss> {
        let is_inside = self.twice_area() * offset.side.sign() > 0.0;
        match self.may_lose(offset.checked(), is_inside) {
            true => self.judged(offset, is_inside),
            false => Vec::new(),
        }
    }

    /// By the rules of drawings.
    fn judged(&self, offset: ControlOffset, is_inside: bool) -> Vec<Loss> {
        let Some(geometry) = polyline(&self.pieces, true) else {
            return Vec::new();
        };
        let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
        drawing.push(Entity::new("0", "0", geometry));
        let settings = settings(offset.checked() / UM_IN_MM, is_inside);
        let (found, _) = Analysis::new(&drawing, settings).findings(&drawing, usize::MAX);
        // What touches itself has no sides.
        let touches =
            |found: &Finding| matches!(found.rule, Rule::SelfIntersection | Rule::Overlap);
        if found.iter().any(touches) {
            return Vec::new();
        }
        // The pieces of the polyline's segments.
        let halves = |(nth, piece): (usize, &Segment)| {
            std::iter::repeat_n(nth, if is_halved(piece) { 2 } else { 1 })
        };
        let pieces: Vec<usize> = self.pieces.iter().enumerate().flat_map(halves).collect();
        let piece_at = |place: &Place| match place {
            Place::Segment { segment, .. } => pieces.get(*segment).copied(),
            _ => Some(0),
        };
        let loss = |found: Finding| {
            let piece = piece_at(&found.place)?;
            let other = found.related.first().and_then(piece_at);
            Some(Loss {
                block: *self.blocks.get(piece)?,
                other: other.and_then(|other| self.blocks.get(other).copied()),
                rule: found.rule,
                severity: found.severity,
                detail: in_program(found.detail, self.pieces.get(piece)?, offset)?,
            })
        };
        found.into_iter().filter_map(loss).collect()
    }

    /// False where no two walls are nearer to each other than the wire needs, and the contour is no smaller either.
    fn may_lose(&self, correction: f64, is_inside: bool) -> bool {
        let length: f64 = self.pieces.iter().map(Segment::length).sum();
        // An outline that holds no disc of radius c has less area than its length times c.
        if is_inside && self.twice_area().abs() / 2.0 <= length * correction {
            return true;
        }
        let (count, needed) = (self.pieces.len(), 2.0 * correction);
        let boxes: Vec<_> = self.pieces.iter().map(Segment::bounds).collect();
        let all = Boxes::of(boxes.iter().copied());
        let mut left = MOST_NEAR * count;
        for (index, own) in boxes.iter().enumerate() {
            let mut is_near = false;
            all.touching(&own.grown(needed), index, &mut |earlier| {
                let is_next = earlier + 1 == index || index + 1 - earlier == count;
                is_near |= left == 0
                    || !is_next && apart(&self.pieces[earlier], &self.pieces[index]) < needed;
                left = left.saturating_sub(1);
            });
            if is_near {
                return true;
            }
        }
        false
    }
}

/// At most the distance of two pieces that do not cross.
fn apart(one: &Segment, other: &Segment) -> f64 {
    match (one, other) {
        (Segment::Line(_), Segment::Line(_)) => {
            let to = |of: &Segment, at: &Segment| {
                of.distance_to(at.start()).min(of.distance_to(at.end()))
            };
            to(one, other).min(to(other, one))
        }
        _ => 0.0,
    }
}

/// The rules of drawings that tell what an offset loses, for a contour that the wire runs inside of or outside of.
fn settings(correction: f64, is_inside: bool) -> Arc<Effective> {
    static RULES: LazyLock<Effective> = LazyLock::new(|| {
        let mut settings = Effective::of(&Settings::default());
        let asked = [
            Rule::NarrowSlot,
            Rule::LostPocket,
            Rule::OffsetCollapse,
            Rule::SelfIntersection,
            Rule::Overlap,
        ];
        for (rule, severity) in &mut settings.severities {
            severity.take_if(|_| !asked.contains(rule));
        }
        settings
    });
    Arc::new(Effective {
        correction,
        corrections: vec![correction],
        side: match is_inside {
            true => SideSetting::Opening,
            false => SideSetting::Punch,
        },
        ..RULES.clone()
    })
}

/// A detail of a drawing in mm at a piece as one of its block. `None` for one of another rule.
fn in_program(detail: Detail, piece: &Segment, offset: ControlOffset) -> Option<Detail> {
    let correction = offset.correction / UM_IN_MM;
    Some(match detail {
        Detail::NarrowSlot { width, middles, .. } => Detail::NarrowSlot {
            width,
            required: 2.0 * correction,
            middles,
        },
        Detail::OffsetCollapse { point, .. } => Detail::OffsetCollapse {
            required: correction,
            point,
        },
        Detail::LostPocket { near } => Detail::LostPocket {
            near: Point::from(near - piece.start() / UM_IN_MM),
        },
        _ => return None,
    })
}

#[cfg(test)]
mod tests;
