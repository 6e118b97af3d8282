//! Scale a program about the origin of its frame.
//!
//! ```text
//! B100B0B100GXL1       →     B2540B0B2540GXL1        (inch to mm)
//! B100B0B400GYNR1            B2540B0B10160GYNR1
//! ```
//!
//! Nodes are scaled and snapped to the µm grid in absolute coordinates, so that contours close again; arcs are calculated anew.

use super::Refactoring;
use super::rewrite::{Rewrite, encoded};
use super::sheet::Sheet;
use crate::geometry::{Arc, Point, Segment};
use crate::program::three_b::block::Node;
use crate::program::three_b::encode::snap;
use crate::text::TextEdit;

pub const INCH_TO_MM: Refactoring = Refactoring {
    id: "refactor.rewrite.scale.inchToMm",
    title: |_| "Scale by 25.4 (inch to mm)".into(),
    rewrite: |sheet| scaled(sheet, 25.4),
};
pub const MM_TO_INCH: Refactoring = Refactoring {
    id: "refactor.rewrite.scale.mmToInch",
    title: |_| "Scale by 1/25.4 (mm to inch)".into(),
    rewrite: |sheet| scaled(sheet, 1.0 / 25.4),
};

/// The edits that scale a program. Errors: a factor that is not above 0, or with which a block vanishes or grows too long.
pub fn scaled(sheet: &Sheet<'_>, factor: f64) -> Result<Vec<TextEdit>, String> {
    const LARGEST_FACTOR: f64 = 1e4;
    if !(factor.is_finite() && factor > 1.0 / LARGEST_FACTOR && factor < LARGEST_FACTOR) {
        return Err(format!(
            "the factor is {factor}, expected one between {} and {LARGEST_FACTOR}",
            1.0 / LARGEST_FACTOR
        ));
    }
    let content = sheet.content()?;
    content.refuse_four_b()?;
    let nodes = content.nodes()?;
    let node = |node: Node| {
        let point = Point::new(node.x as f64 * factor, node.y as f64 * factor);
        snap(point).ok_or_else(|| "the scaled path runs too far out for a program".to_owned())
    };
    let mut rewrite = Rewrite::default();
    for (index, row) in content.rows.iter().enumerate() {
        let (from, to) = (node(nodes[index].0)?, node(nodes[index].1)?);
        let piece = scaled_segment(&content.piece_from(index, nodes[index].0), factor);
        let news = encoded(&piece, from, to, None, index, content.largest)?;
        if news.is_empty() {
            return Err(format!(
                "line {}: the block becomes shorter than 1 µm",
                row.line + 1
            ));
        }
        rewrite.rows.insert(index, news);
        rewrite.end = Point::new(to.x as f64, to.y as f64);
    }
    rewrite.start = nodes.first().map(|(from, _)| node(*from)).transpose()?;
    rewrite.edits(sheet, content)
}

fn scaled_segment(segment: &Segment, factor: f64) -> Segment {
    let point = |point: Point| point * factor;
    match segment {
        Segment::Line(line) => Segment::line(point(line.start), point(line.end)),
        Segment::Arc(arc) => Segment::Arc(Arc {
            center: point(arc.center),
            radius: arc.radius * factor,
            start: point(arc.start),
            end: point(arc.end),
            ..*arc
        }),
    }
}
