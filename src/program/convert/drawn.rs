//! A program as a drawing: contours, the ways to them, and the ways between them on layers of their own.

use super::Cuts;
use super::rings::{Passes, Ring};
use crate::drawing::{Drawing, Entity, Geometry, Unit};
use crate::geometry::{Point, Segment};
use crate::program::path::polyline;

/// Layers of a drawing made from a program.
const CUT: &str = "CUT";
const LEAD: &str = "LEAD";
const WAY: &str = "WAY";

impl Cuts {
    /// The program as a drawing in mm: contours as polylines with bulges, ways in and out and moves without the wire as
    /// lines. Of several passes the last is the contour; the earlier ones lie on layers of their own.
    pub fn drawing(&self) -> Drawing {
        let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
        for contour in self.by_contour() {
            let cut = match contour {
                Passes::Several(passes) => {
                    push_passes(&mut drawing, &passes);
                    continue;
                }
                Passes::One(cut) => cut,
            };
            let way_out = cut.segments.len().saturating_sub(cut.lead_out);
            cut.segments[..cut.lead_in.min(way_out)]
                .iter()
                .for_each(|lead| push_lead(&mut drawing, lead));
            push_contour(&mut drawing, CUT, cut.contour(), cut.closed);
            cut.segments[way_out..]
                .iter()
                .for_each(|lead| push_lead(&mut drawing, lead));
        }
        for &ends in &self.ways {
            push_line(&mut drawing, WAY, ends);
        }
        drawing
    }
}

/// The last of several passes is the contour.
fn push_passes(drawing: &mut Drawing, passes: &[Ring]) {
    let last = passes.len();
    for (ring, number) in passes.iter().zip(1..) {
        let layer = if number == last {
            CUT.into()
        } else {
            format!("PASS{number}")
        };
        let leads = if number == last { &ring.leads[..] } else { &[] };
        leads.iter().for_each(|lead| push_lead(drawing, lead));
        push_contour(drawing, &layer, &ring.segments, true);
    }
}

fn push_contour(drawing: &mut Drawing, layer: &str, segments: &[Segment], closed: bool) {
    if let Some(geometry) = polyline(segments, closed) {
        drawing.push(Entity::new(layer, layer, geometry));
    }
}

fn push_lead(drawing: &mut Drawing, lead: &Segment) {
    if lead.as_arc().is_none() {
        return push_line(drawing, LEAD, [lead.start(), lead.end()]);
    }
    if let Some(geometry) = polyline(&[*lead], false) {
        drawing.push(Entity::new(LEAD, LEAD, geometry));
    }
}

fn push_line(drawing: &mut Drawing, layer: &str, [start, end]: [Point; 2]) {
    let geometry = Geometry::Line {
        start: start / 1e3,
        end: end / 1e3,
    };
    drawing.push(Entity::new(layer, layer, geometry));
}
