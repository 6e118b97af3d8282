//! Refactorings of 3B and 4B: how its moves are read and written, and the refactorings that it alone has.

mod correction;
mod layout;
mod rows;
mod slot;
mod split;
#[cfg(test)]
mod tests;
mod turned;

pub(in crate::program) use rows::Own;

use super::Document;
use super::block::{Motion, PartArc, Quadrant};
use super::decode::decode;
use super::encode::{ASIDE_TOLERANCE, Encoded, encode, point_of, runs_along, snap};
use crate::finding::Finding;
use crate::geometry::{Arc, Segment, equally_far, turn};
use crate::program::encode::aside;
use crate::program::grid::Node;
use crate::program::numbering::numbered;
use crate::program::path::{Cut, Trace};
use crate::program::refactor::{
    At, Change, Content, Edits, News, Notation, Refactoring, Rewrite, Row, Sheet, Transform,
};
use crate::program::write::scaled;
use crate::settings::Effective;
use crate::text::TextEdit;

/// 3B and 4B.
pub(in crate::program) struct ThreeB;

/// A block that replaces another.
#[derive(Clone, Debug)]
pub(in crate::program) struct New {
    pub(crate) encoded: Encoded,
    pub(crate) part: Option<PartArc>,
    /// The row whose comment it carries.
    pub(crate) source: usize,
    /// It runs exactly along its piece, to which it was not fitted: a block that was moved, mirrored, turned round.
    pub(crate) exact: bool,
}

/// Two contours' directions are the same within this, rad: a correction of 0.5 mm differs by 0.5 µm.
const ALONG: f64 = 1e-3;

/// How far an exact block may lie from its piece, µm: rounding.
const EXACT: f64 = 1e-3;

impl Notation for ThreeB {
    type Document = Document;
    type Own = Own;
    type New = New;
    type Extra = ();

    const STEP: f64 = 1.0;

    fn title_of_numbering() -> &'static str {
        say!(number_the_blocks_from_1)
    }

    fn read(bytes: Vec<u8>, settings: &Effective) -> Document {
        Document::read_with(bytes, settings)
    }

    fn findings(document: &Document) -> Vec<Finding> {
        document.findings()
    }

    fn rows(
        document: &Document,
        trace: &Trace,
        contours: &[Cut],
    ) -> Result<Vec<Row<ThreeB>>, String> {
        rows::rows(document, trace, contours)
    }

    fn refuse(sheet: &Sheet<'_, ThreeB>, change: Change) -> Result<(), String> {
        match change {
            Change::Scale => refuse_four_b(sheet.content()?),
            Change::Reverse | Change::StartHere { .. } => Ok(()),
        }
    }

    /// The way in to a contour of 4B ends on the wire's path, beside the contour by a correction that the program does not state.
    fn refuse_begin(content: &Content<ThreeB>, from: usize, to: usize) -> Result<(), String> {
        let is_of_part = content.rows.iter().any(|row| row.own.part.is_some());
        let along = |row: usize| content.rows.get(row).map(|row| row.piece.start_tangent());
        let turn = along(from).zip(along(to)).map(|(from, to)| turn(from, to));
        match turn.is_some_and(|turn| turn.abs() <= ALONG) {
            false if is_of_part => Err(say!(the_way_in_of_4b_ends_beside_the_contour).into()),
            _ => Ok(()),
        }
    }

    fn kept(at: At<'_, ThreeB>, _: usize) -> New {
        New {
            encoded: Encoded {
                block: at.own.block,
                from: at.from,
                to: at.to,
                piece: at.piece,
            },
            part: at.own.part,
            source: at.index,
            exact: true,
        }
    }

    fn reversed(at: At<'_, ThreeB>) -> News<ThreeB> {
        let (piece, ends) = (at.piece.reversed(), [at.to, at.from]);
        let Motion::Line(quadrant) = at.own.block.motion else {
            return encoded(at, &piece, ends, at.own.part);
        };
        // The same numbers into the opposite quadrant.
        let opposite = Quadrant::ALL[(quadrant as usize + 2) % 4];
        let mut new = at.kept();
        let [from, to] = ends;
        new.encoded = Encoded {
            from,
            to,
            piece,
            ..new.encoded
        };
        new.encoded.block.motion = Motion::Line(opposite);
        Ok(vec![new])
    }

    fn straight(at: At<'_, ThreeB>, ends: [Node; 2]) -> News<ThreeB> {
        let [start, end] = ends.map(point_of);
        encoded(at, &Segment::line(start, end), ends, None)
    }

    fn transformed(at: At<'_, ThreeB>, transform: Transform) -> New {
        let kept = at.kept();
        let Encoded {
            block,
            from,
            to,
            piece,
        } = kept.encoded;
        New {
            encoded: Encoded {
                block: turned::turned(&block, transform),
                from: transform.of_node(from),
                to: transform.of_node(to),
                piece: transform.of_segment(&piece),
            },
            ..kept
        }
    }

    fn scaled_node(_: &Row<ThreeB>, node: Node, factor: f64) -> Option<Node> {
        snap(point_of(node) * factor)
    }

    fn scaled(at: At<'_, ThreeB>, ends: [Node; 2], factor: f64) -> News<ThreeB> {
        encoded(at, &scaled(&at.piece, factor), ends, None)
    }

    fn runs_on(at: At<'_, ThreeB>, first: usize) -> bool {
        matches!(at.own.block.motion, Motion::Line(_))
            && at.own.part.is_none()
            && (at.index == first || at.own.comment.is_none())
    }

    fn longest(settings: &Effective) -> i64 {
        settings.largest_number()
    }

    fn write(
        sheet: &Sheet<'_, ThreeB>,
        content: &Content<ThreeB>,
        rewrite: &Rewrite<ThreeB>,
    ) -> Edits {
        slot::edits(sheet, content, rewrite)
    }

    fn agree(_: &Document, row: &Row<ThreeB>, meant: &New) -> Result<(), String> {
        let Encoded {
            block,
            from,
            to,
            piece,
        } = &meant.encoded;
        if row.own.block != *block || row.own.part != meant.part {
            return Err(say!(the_new_block_reads_otherwise).into());
        }
        let beside = || say!(the_block_does_not_run_along_its_piece).to_owned();
        let decoded = decode(block, point_of(*from)).map_err(|_| beside())?;
        let apart =
            |share: f64| -> f64 { (decoded.point_at(share) - piece.point_at(share)).norm() };
        let is_right = if meant.exact {
            [0.0, 0.5, 1.0]
                .into_iter()
                .all(|share| apart(share) <= EXACT)
        } else {
            runs_along(&decoded, piece, *to)
        };
        if is_right { Ok(()) } else { Err(beside()) }
    }

    /// A program whose numbers counted its blocks keeps counting them.
    fn finishing(before: &Trace, after: &Document) -> Vec<TextEdit> {
        let counts = |trace: &Trace| {
            let mut blocks = trace.steps.iter().filter(|step| step.moves()).zip(1_u32..);
            blocks.all(|(step, ordinal)| step.number == Some(ordinal))
        };
        if counts(before) && !counts(&after.trace()) {
            numbered(after).unwrap_or_default()
        } else {
            Vec::new()
        }
    }

    fn own() -> Vec<Refactoring<ThreeB>> {
        vec![
            split::SPLIT,
            correction::OPENING,
            correction::PUNCH,
            layout::COMPACT,
            layout::ALIGNED,
            layout::CHECKING,
        ]
    }
}

/// An error where a block has 4B's radius: the program then holds the part's contour.
fn refuse_four_b(content: &Content<ThreeB>) -> Result<(), String> {
    match content.rows.iter().find(|row| row.own.part.is_some()) {
        Some(row) => Err(say!(a_4b_block_cannot_be_calculated_anew, row.line + 1)),
        None => Ok(()),
    }
}

/// The blocks of a piece between two nodes, for a row; no number is above the largest.
fn encoded(
    at: At<'_, ThreeB>,
    piece: &Segment,
    [from, to]: [Node; 2],
    part: Option<PartArc>,
) -> News<ThreeB> {
    let (mut blocks, largest) = (Vec::new(), at.sheet.document.largest());
    encode(&fitted(piece, from, to), from, to, largest, &mut blocks)
        .ok_or_else(|| say!(no_blocks_within_tolerance_lead_from_to, from, to))?;
    let new = |encoded| New {
        encoded,
        part,
        source: at.index,
        exact: false,
    };
    Ok(blocks.into_iter().map(new).collect())
}

/// The piece between its nodes. An arc keeps its direction; its centre moves to the nearest place equally far from both
/// nodes, because snapping, scaling or removing drift has moved the nodes by as much. Where that would lead elsewhere,
/// as about two nodes of nearly a full circle, the arc stays as it is.
fn fitted(piece: &Segment, from: Node, to: Node) -> Segment {
    let (start, end) = (point_of(from), point_of(to));
    let Segment::Arc(arc) = piece else {
        return Segment::line(start, end);
    };
    let Some(center) = equally_far(arc.center, start, end) else {
        return *piece;
    };
    let fitted = Segment::Arc(Arc::about(center, start, end, arc.sweep > 0.0));
    let moved = (start - arc.start).norm().max((end - arc.end).norm());
    if aside(&fitted, piece) <= ASIDE_TOLERANCE + moved {
        fitted
    } else {
        *piece
    }
}
