//! The blocks of a program with their places.

use super::ThreeB;
use crate::geometry::{Point, Segment, Vector};
use crate::program::path::{Cut, Kind, Trace};
use crate::program::refactor::Row;
use crate::program::three_b::Document;
use crate::program::three_b::block::{Block, Node, PartArc};
use crate::program::three_b::encode::{point_of, snap};
use crate::program::three_b::layout::layout_in;
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::pieces::{Field, pieces};
use crate::settings::Layout;
use std::ops::Range;

/// A block in its line.
#[derive(Clone, Debug)]
pub(in crate::program) struct Own {
    /// Bytes of the text.
    pub(crate) range: Range<usize>,
    pub(crate) block: Block,
    pub(crate) part: Option<PartArc>,
    /// Its end point, if the text states one.
    pub(crate) coordinates: Option<Range<usize>>,
    pub(crate) comment: Option<Range<usize>>,
    /// Compact or aligned, as in the text.
    pub(crate) layout: Layout,
}

/// The blocks of a program; the error says which line cannot be read.
pub(super) fn rows(
    document: &Document,
    trace: &Trace,
    contours: &[Cut],
) -> Result<Vec<Row<ThreeB>>, String> {
    let text = document.text();
    let words = document.words();
    let mut steps = trace.steps.iter().filter(|step| step.moves());
    // Words that end programs elsewhere may stand before the one that ends this one.
    let end = trace
        .steps
        .iter()
        .find(|step| step.kind == Kind::End)
        .map(|step| step.range.start);
    let (mut rows, mut pieces_of_path) = (Vec::new(), Vec::new());
    let (mut fault, mut is_over) = (None, false);
    for line in 0..text.line_count() {
        if is_over {
            break;
        }
        let range = text.line_range(line);
        let bytes = &text.bytes()[range.clone()];
        let place = |found: Option<&Range<usize>>| {
            found.map(|found| range.start + found.start..range.start + found.end)
        };
        let (mut blocks, cut) = (0, std::cell::OnceCell::new());
        let piece_of = |field: Field| {
            let pieces = cut.get_or_init(|| pieces(bytes, &words));
            pieces
                .iter()
                .rev()
                .find(|piece| piece.field == field)
                .map(|piece| &piece.range)
        };
        read_line(bytes, range.start, &words, |item| match item {
            _ if is_over => {}
            Item::Block {
                block,
                part,
                range: own,
                stated_end,
                ..
            } => {
                blocks += 1;
                let step = steps.next().filter(|step| step.range.start == own.start);
                let Some((step, piece)) = step.and_then(|step| Some((step, step.ideal?))) else {
                    fault.get_or_insert_with(|| say!(the_block_of_a_line_leads_nowhere, line + 1));
                    return;
                };
                let written = text.bytes().get(own.clone()).unwrap_or_default();
                let layout = layout_in(written);
                pieces_of_path.push((step.start, step.end, piece));
                let own = Own {
                    range: own,
                    block,
                    part,
                    coordinates: stated_end.and_then(|_| place(piece_of(Field::Coordinates))),
                    comment: if memchr::memchr(b';', bytes).is_some() {
                        place(piece_of(Field::Comment))
                    } else {
                        None
                    },
                    layout,
                };
                rows.push((line, own));
            }
            Item::Fault(found) => {
                fault.get_or_insert_with(|| say!(line_by_number, line + 1, found.sentence()));
            }
            Item::Text { .. } if !rows.is_empty() => {
                fault.get_or_insert_with(|| say!(that_line_cannot_be_read, line + 1));
            }
            Item::Text { .. } | Item::CommentedBlock { .. } | Item::StartPoint { .. } => {}
            Item::Word { range, .. } => is_over |= end.is_some_and(|end| range.start >= end),
        });
        if blocks > 1 {
            fault.get_or_insert_with(|| say!(a_line_holds_several_blocks, line + 1, blocks));
        }
    }
    match fault {
        Some(sentence) => Err(sentence),
        None if rows.is_empty() => Err(say!(the_program_has_no_block).into()),
        None => {
            let ends = nodes(&pieces_of_path, contours)?;
            let placed = rows.into_iter().zip(ends).zip(pieces_of_path);
            let row = |(((line, own), (from, to)), (start, _, piece)): (_, (_, _, Segment))| Row {
                line,
                from,
                to,
                piece: piece.moved(point_of(from) - start),
                own,
            };
            Ok(placed.map(row).collect())
        }
    }
}

/// Where blocks begin and end, and their pieces, µm.
type PlacedPiece = (Point, Point, Segment);

/// The nodes of each row on the µm grid, from and to. Contours close exactly: the drift of their arcs is taken back arc
/// by arc. A full circle ends where it begins, and has none.
fn nodes(pieces: &[PlacedPiece], contours: &[Cut]) -> Result<Vec<(Node, Node)>, String> {
    let node = |point: Point| {
        snap(point).ok_or_else(|| say!(the_path_runs_too_far_out_for_a_program).to_owned())
    };
    let is_arc =
        |(_, _, piece): &PlacedPiece| piece.as_arc().is_some_and(|arc| !arc.is_full_turn());
    let mut nodes = Vec::with_capacity(pieces.len());
    // What has been taken back so far.
    let mut shift = Vector::zeros();
    for contour in contours {
        let own = contour.contour_steps();
        let rows = pieces.get(own.clone()).unwrap_or_default();
        let drift = match (rows.first(), rows.last()) {
            (Some(first), Some(last)) if contour.closed => last.1 - first.0,
            _ => Vector::zeros(),
        };
        let arcs = rows.iter().filter(|row| is_arc(row)).count().max(1) as f64;
        let (before, mut passed) = (shift, 0.0);
        for index in contour.steps.clone() {
            let Some(row) = pieces.get(index) else { break };
            let from = node(row.0 - rounded(shift))?;
            if own.contains(&index) && is_arc(row) {
                passed += 1.0;
                shift = before + drift * (passed / arcs);
            }
            nodes.push((from, node(row.1 - rounded(shift))?));
        }
    }
    Ok(nodes)
}

fn rounded(vector: Vector) -> Vector {
    Vector::new(vector.x.round(), vector.y.round())
}
