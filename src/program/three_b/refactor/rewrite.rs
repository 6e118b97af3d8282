//! From what stands in the place of which block to edits of the text, and the proof that they say what was meant.

use super::sheet::{Content, Sheet};
use crate::geometry::{Arc, Point, Segment};
use crate::program::language::numbered;
use crate::program::three_b::Document;
use crate::program::three_b::block::{Block, Node, PartArc};
use crate::program::three_b::decode::decode;
use crate::program::three_b::encode::{Encoded, encode};
use crate::program::three_b::layout::{
    push_end_point, push_fields, push_start_point, push_to_comment_column,
};
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::proof::Proof;
use crate::settings::Layout;
use crate::text::{SourceText, TextEdit};
use std::collections::BTreeMap;
use std::ops::Range;

/// A block that stands in the place of another.
#[derive(Clone, Debug)]
pub struct New {
    pub encoded: Encoded,
    pub part: Option<PartArc>,
    /// The row whose comment it carries.
    pub source: usize,
    /// It runs exactly along its piece, to which it was not fitted: a block that was moved, mirrored, turned round.
    pub exact: bool,
}

/// What a refactoring does to a program.
#[derive(Clone, Debug, Default)]
pub struct Rewrite {
    /// By row, what stands in its place; rows that are not named stay.
    pub rows: BTreeMap<usize, Vec<New>>,
    /// Where the program begins afterwards, where that changes.
    pub start: Option<Node>,
    /// Where it ends afterwards, µm.
    pub end: Point,
}

/// How far an exact block may lie from its piece, µm: rounding.
const EXACT: f64 = 1e-3;

/// How far the end of a program may lie from where it is meant to, µm, beside 1 µm for each arc.
const END_TOLERANCE: f64 = 2.0;

/// The blocks of a piece between two nodes, for the row `source`; none of their numbers is above `largest`.
pub fn encoded(
    piece: &Segment,
    from: Node,
    to: Node,
    part: Option<PartArc>,
    source: usize,
    largest: i64,
) -> Result<Vec<New>, String> {
    let mut blocks = Vec::new();
    encode(&fitted(piece, from, to), from, to, largest, &mut blocks)
        .ok_or_else(|| format!("no blocks within tolerance lead from {from:?} to {to:?}"))?;
    Ok(blocks
        .into_iter()
        .map(|encoded| New {
            encoded,
            part,
            source,
            exact: false,
        })
        .collect())
}

/// The piece between its nodes. An arc keeps its direction; its centre goes to the nearest place that is as far from both nodes,
/// because nodes that were snapped, scaled or freed of drift lie beside it by as much.
fn fitted(piece: &Segment, from: Node, to: Node) -> Segment {
    let (start, end) = (point(from), point(to));
    match piece {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(arc) => match (end - start).try_normalize(0.0) {
            None => *piece,
            Some(along) => {
                let middle = start + (end - start) * 0.5;
                let center = arc.center - along * (arc.center - middle).dot(&along);
                Segment::Arc(Arc::about(center, start, end, arc.sweep > 0.0))
            }
        },
    }
}

fn point(node: Node) -> Point {
    Point::new(node.x as f64, node.y as f64)
}

impl Rewrite {
    /// The edits of the text; none where nothing changes.
    ///
    /// Each new block is read again from its text and held against its piece; the new program is read as a whole and its blocks
    /// are compared with those that were meant, and its end with the end that was.
    pub fn edits(self, sheet: &Sheet<'_>, content: &Content) -> Result<Vec<TextEdit>, String> {
        let text = sheet.document.text();
        self.prove_blocks(sheet)?;
        let mut edits = Vec::new();
        if let (Some(start), Some(header)) = (self.start, &content.header) {
            edits.push(self.header(text, header, start)?);
        }
        for (&row, news) in &self.rows {
            edits.push(slot(text, content, row, news)?);
        }
        edits.sort_by_key(|edit| edit.range.start);
        edits.retain(|edit| text.bytes().get(edit.range.clone()) != Some(edit.text.as_bytes()));
        if edits.is_empty() {
            return Ok(edits);
        }
        let expected = self.expected(content);
        let after = applied(text.bytes(), &edits);
        let document = Document::read_with(after, sheet.settings);
        self.prove_program(sheet, &document, &expected)?;
        Ok(renumbered(sheet, content, document, edits))
    }

    fn header(
        &self,
        text: &SourceText,
        header: &Range<usize>,
        start: Node,
    ) -> Result<TextEdit, String> {
        let mut line = Vec::new();
        push_start_point(&mut line, start);
        let line = String::from_utf8(line).map_err(|error| error.to_string())?;
        // Only the header itself: what may stand before it in its line stays.
        let old = text.bytes().get(header.clone()).unwrap_or_default();
        let line = line.trim_end();
        let new = if old.starts_with(b";") {
            line
        } else {
            line.trim_start_matches("; ")
        };
        Ok(TextEdit {
            range: header.clone(),
            text: new.to_owned(),
        })
    }

    fn prove_blocks(&self, sheet: &Sheet<'_>) -> Result<(), String> {
        let mut proof = Proof::default();
        let words = sheet.document.words();
        for new in self.rows.values().flatten() {
            let mut line = Vec::new();
            push_fields(
                &mut line,
                Layout::Compact,
                &new.encoded.block,
                new.part.as_ref(),
            );
            if !new.exact {
                proof.check_line(&line, &words, &new.encoded, new.part)?;
                continue;
            }
            let mut read = None;
            read_line(&line, 1, &words, |item| {
                if let Item::Block { block, part, .. } = item {
                    read = Some((block, part));
                }
            });
            let Encoded {
                block, from, piece, ..
            } = new.encoded;
            let along = decode(&block, point(from)).is_ok_and(|decoded| {
                let apart = |share| (decoded.point_at(share) - piece.point_at(share)).norm();
                [0.0, 0.5, 1.0]
                    .into_iter()
                    .all(|share| apart(share) <= EXACT)
            });
            if read != Some((block, new.part)) || !along {
                return Err(format!(
                    "{block:?} does not run along its piece of the path"
                ));
            }
        }
        Ok(())
    }

    /// The blocks of the program as it is meant to be.
    fn expected(&self, content: &Content) -> Vec<(Block, Option<PartArc>)> {
        let mut blocks = Vec::with_capacity(content.rows.len());
        for (index, row) in content.rows.iter().enumerate() {
            match self.rows.get(&index) {
                Some(news) => blocks.extend(news.iter().map(|new| (new.encoded.block, new.part))),
                None => blocks.push((row.block, row.part)),
            }
        }
        blocks
    }

    fn prove_program(
        &self,
        sheet: &Sheet<'_>,
        after: &Document,
        expected: &[(Block, Option<PartArc>)],
    ) -> Result<(), String> {
        let again = Sheet::new(after, sheet.settings, 0..0);
        let content = again
            .content()
            .map_err(|reason| format!("the new program cannot be read: {reason}"))?;
        let blocks: Vec<_> = content
            .rows
            .iter()
            .map(|row| (row.block, row.part))
            .collect();
        if blocks != expected {
            return Err("the new program reads otherwise than it was meant".into());
        }
        let arcs = content
            .rows
            .iter()
            .filter(|row| row.piece.as_arc().is_some())
            .count() as f64;
        let start = self.start.map_or(sheet.trace.start, |node| {
            Point::new(node.x as f64, node.y as f64)
        });
        // Without a header the program counts from its own start.
        let end = again.trace.end() + (start - again.trace.start);
        let miss = (end - self.end).norm();
        let before = content_arcs(sheet);
        if miss > END_TOLERANCE + arcs.max(before) {
            return Err(format!(
                "the new program ends {miss:.1} µm from where it should"
            ));
        }
        Ok(())
    }
}

fn content_arcs(sheet: &Sheet<'_>) -> f64 {
    sheet.content().map_or(0, |content| {
        content
            .rows
            .iter()
            .filter(|row| row.piece.as_arc().is_some())
            .count()
    }) as f64
}

/// What stands in the place of one row: its number stays, its comment goes with its block.
fn slot(
    text: &SourceText,
    content: &Content,
    index: usize,
    news: &[New],
) -> Result<TextEdit, String> {
    let row = &content.rows[index];
    let Some(first) = news.first() else {
        // The whole line goes, its line end with it.
        return Ok(TextEdit {
            range: text.line_start(row.line)..text.line_start(row.line + 1),
            text: String::new(),
        });
    };
    let comment_moves = first.source != index;
    let mut end = row
        .coordinates
        .as_ref()
        .map_or(row.range.end, |coordinates| coordinates.end);
    if let (true, Some(comment)) = (comment_moves, &row.comment) {
        end = comment.end;
    }
    let mut out = Vec::new();
    for (position, new) in news.iter().enumerate() {
        if position > 0 {
            out.extend_from_slice(line_end(text, row.line));
        }
        let block = &new.encoded.block;
        push_fields(&mut out, row.layout, block, new.part.as_ref());
        if row.coordinates.is_some() {
            push_to_comment_column(&mut out, block);
            push_end_point(&mut out, new.encoded.to);
        }
        let carried = content
            .rows
            .get(new.source)
            .and_then(|source| source.comment.clone());
        if let (true, true, Some(comment)) = (position == 0, comment_moves, carried) {
            out.push(b' ');
            out.extend_from_slice(text.bytes().get(comment).unwrap_or_default());
        }
    }
    if !comment_moves && news.len() > 1 && row.comment.is_some() {
        return Err(format!(
            "line {}: a comment stands behind a block that becomes several",
            row.line + 1
        ));
    }
    let text = String::from_utf8(out)
        .map_err(|_| format!("line {}: the comment is in another code page", row.line + 1))?;
    Ok(TextEdit {
        range: row.range.start..end,
        text,
    })
}

fn line_end(text: &SourceText, line: usize) -> &[u8] {
    let end_of = |line: usize| {
        text.bytes()
            .get(text.line_range(line).end..text.line_start(line + 1))
            .filter(|end| !end.is_empty())
    };
    end_of(line)
        .or_else(|| end_of(line.checked_sub(1)?))
        .unwrap_or(b"\n")
}

/// A program whose numbers counted its blocks goes on doing so.
fn renumbered(
    sheet: &Sheet<'_>,
    content: &Content,
    after: Document,
    edits: Vec<TextEdit>,
) -> Vec<TextEdit> {
    let counts = |trace: &crate::program::path::Trace| {
        let mut blocks = trace.steps.iter().filter(|step| step.moves()).zip(1_u32..);
        blocks.all(|(step, ordinal)| step.number == Some(ordinal))
    };
    if content.rows.is_empty() || !counts(&sheet.trace) || counts(&after.trace()) {
        return edits;
    }
    let program = crate::program::Document::ThreeB(after);
    let text = program.text();
    let numbers = numbered(&program, 0..text.line_count(), 1, 1);
    let new = applied(text.bytes(), &numbers);
    let old = sheet.document.text().bytes();
    // One edit from the first byte that differs to the last.
    let start = old.iter().zip(&new).take_while(|(a, b)| a == b).count();
    let same_end = old
        .iter()
        .rev()
        .zip(new.iter().rev())
        .take_while(|(a, b)| a == b)
        .count();
    let kept_end = same_end.min(old.len() - start).min(new.len() - start);
    match String::from_utf8(new[start..new.len() - kept_end].to_vec()) {
        Ok(text) => vec![TextEdit {
            range: start..old.len() - kept_end,
            text,
        }],
        Err(_) => edits,
    }
}

/// Bytes with sorted, disjoint edits made.
pub fn applied(bytes: &[u8], edits: &[TextEdit]) -> Vec<u8> {
    let mut result = Vec::with_capacity(bytes.len());
    let mut at = 0;
    for edit in edits {
        result.extend_from_slice(bytes.get(at..edit.range.start).unwrap_or_default());
        result.extend_from_slice(edit.text.as_bytes());
        at = edit.range.end;
    }
    result.extend_from_slice(bytes.get(at..).unwrap_or_default());
    result
}
