//! What a refactoring sees of a program: its blocks with their places, the path, the contours, the selection.

use crate::geometry::{Arc, Line, Point, Segment, Vector};
use crate::program::path::{Cut, cuts};
use crate::program::path::{Kind, Trace};
use crate::program::three_b::Document;
use crate::program::three_b::block::{Block, Node, PartArc};
use crate::program::three_b::encode::snap;
use crate::program::three_b::language::{Field, pieces};
use crate::program::three_b::parse::{Item, read_line};
use crate::settings::{Effective, Layout};
use std::ops::Range;

/// A block in its line.
#[derive(Clone, Debug)]
pub struct Row {
    pub line: usize,
    /// A pause stands between it and the row before.
    pub is_behind_pause: bool,
    /// Bytes of the text.
    pub range: Range<usize>,
    pub block: Block,
    pub part: Option<PartArc>,
    /// Where the machine stands before and after it, µm.
    pub from: Point,
    pub to: Point,
    /// What it means, from `from`.
    pub piece: Segment,
    /// Its end point as the text states it.
    pub coordinates: Option<Range<usize>>,
    pub comment: Option<Range<usize>>,
    /// Compact or aligned, as it stands.
    pub layout: Layout,
}

/// A contour in rows.
#[derive(Clone, Debug)]
pub struct Contour {
    /// As a person counts them; ways between contours count as none.
    pub ordinal: usize,
    pub rows: Range<usize>,
    pub lead_in: usize,
    pub lead_out: usize,
    pub closed: bool,
    pub is_way: bool,
}

impl Contour {
    /// The rows without the ways in and out.
    pub fn own_rows(&self) -> Range<usize> {
        self.rows.start + self.lead_in..self.rows.end - self.lead_out
    }
}

/// A program for refactoring.
pub struct Sheet<'a> {
    pub document: &'a Document,
    pub settings: &'a Effective,
    /// Bytes of the text.
    pub selection: Range<usize>,
    pub trace: Trace,
    /// Its blocks, or why they cannot be told.
    content: Result<Content, String>,
}

pub struct Content {
    pub rows: Vec<Row>,
    pub contours: Vec<Contour>,
    /// The header with the start.
    pub header: Option<Range<usize>>,
    /// The largest number that the controller takes, µm.
    pub largest: i64,
}

impl<'a> Sheet<'a> {
    pub fn new(
        document: &'a Document,
        settings: &'a Effective,
        selection: Range<usize>,
    ) -> Sheet<'a> {
        let trace = document.trace().as_meant();
        let content = content(document, &trace, settings.largest_number());
        Sheet {
            document,
            settings,
            selection,
            trace,
            content,
        }
    }

    /// The blocks; the error says which line cannot be read.
    pub fn content(&self) -> Result<&Content, String> {
        self.content.as_ref().map_err(Clone::clone)
    }

    /// Lines that the selection touches.
    pub fn selected_lines(&self) -> Range<usize> {
        let text = self.document.text();
        let first = text.line_of(self.selection.start);
        let last = text.line_of(self.selection.end.max(self.selection.start + 1) - 1);
        first..last.max(first) + 1
    }

    /// The rows that are selected; all, where not more than one line is.
    pub fn selected_rows(&self, content: &Content) -> Range<usize> {
        let lines = self.selected_lines();
        if lines.len() < 2 {
            return 0..content.rows.len();
        }
        let start = content.rows.partition_point(|row| row.line < lines.start);
        start..content.rows.partition_point(|row| row.line < lines.end)
    }

    /// The contours that the selection touches; all, where it touches none.
    pub fn selected_contours<'c>(&self, content: &'c Content) -> Vec<&'c Contour> {
        let lines = self.selected_lines();
        let cut = || content.contours.iter().filter(|contour| !contour.is_way);
        let touched = |contour: &&Contour| {
            content.rows[contour.rows.clone()]
                .iter()
                .any(|row| lines.contains(&row.line))
        };
        let chosen: Vec<&Contour> = cut().filter(touched).collect();
        if chosen.is_empty() {
            cut().collect()
        } else {
            chosen
        }
    }
}

impl Content {
    /// The nodes of each row on the µm grid, from and to. Contours close exactly: what their arcs drift is taken back arc by arc.
    pub fn nodes(&self) -> Result<Vec<(Node, Node)>, String> {
        let node = |point: Point| {
            snap(point).ok_or_else(|| "the path runs too far out for a program".to_owned())
        };
        let mut nodes = Vec::with_capacity(self.rows.len());
        // What has been taken back so far.
        let mut shift = Vector::zeros();
        for contour in &self.contours {
            let own = contour.own_rows();
            let rows = &self.rows[own.clone()];
            let drift = match (rows.first(), rows.last()) {
                (Some(first), Some(last)) if contour.closed => last.to - first.from,
                _ => Vector::zeros(),
            };
            let arcs = rows
                .iter()
                .filter(|row| row.piece.as_arc().is_some())
                .count()
                .max(1) as f64;
            let (before, mut passed) = (shift, 0.0);
            for index in contour.rows.clone() {
                let row = &self.rows[index];
                let from = node(row.from - rounded(shift))?;
                if own.contains(&index) && row.piece.as_arc().is_some() {
                    passed += 1.0;
                    shift = before + drift * (passed / arcs);
                }
                nodes.push((from, node(row.to - rounded(shift))?));
            }
        }
        Ok(nodes)
    }

    /// The piece of a row, moved so that it begins at `from`.
    pub fn piece_from(&self, row: usize, from: Node) -> Segment {
        let row = &self.rows[row];
        moved(
            &row.piece,
            Point::new(from.x as f64, from.y as f64) - row.from,
        )
    }

    /// An error where the contour pauses before its tab: the pause stands where it stands.
    pub fn refuse_pause(&self, contour: &Contour) -> Result<(), String> {
        let rows = self.rows.get(contour.rows.clone()).unwrap_or_default();
        match rows.iter().skip(1).find(|row| row.is_behind_pause) {
            Some(row) => Err(format!(
                "the contour pauses before line {}, to hold the part while its tab is cut",
                row.line + 1
            )),
            None => Ok(()),
        }
    }

    /// An error where a block carries 4B's radius: the program then holds the part's contour.
    pub fn refuse_four_b(&self) -> Result<(), String> {
        match self.rows.iter().find(|row| row.part.is_some()) {
            Some(row) => Err(format!(
                "line {}: a 4B block cannot be calculated anew",
                row.line + 1
            )),
            None => Ok(()),
        }
    }
}

fn rounded(vector: Vector) -> Vector {
    Vector::new(vector.x.round(), vector.y.round())
}

/// A segment shifted by a vector.
pub fn moved(segment: &Segment, by: Vector) -> Segment {
    match segment {
        Segment::Line(Line { start, end }) => Segment::line(start + by, end + by),
        Segment::Arc(arc) => Segment::Arc(Arc {
            center: arc.center + by,
            start: arc.start + by,
            end: arc.end + by,
            ..*arc
        }),
    }
}

fn content(document: &Document, trace: &Trace, largest: i64) -> Result<Content, String> {
    let text = document.text();
    let words = document.words();
    let mut steps = trace.steps.iter().filter(|step| step.moves());
    // Words that end programs elsewhere may stand before the one that ends this one.
    let end = trace
        .steps
        .iter()
        .find(|step| step.kind == Kind::End)
        .map(|step| step.range.start);
    let (mut rows, mut header, mut fault, mut is_over) = (Vec::new(), None, None, false);
    let mut is_behind_pause = false;
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
                    fault.get_or_insert_with(|| {
                        format!("line {}: the block leads nowhere", line + 1)
                    });
                    return;
                };
                let is_spaced = bytes
                    .get(own.start - range.start..own.end - range.start)
                    .is_some_and(|block| block.contains(&b' '));
                rows.push(Row {
                    line,
                    is_behind_pause: std::mem::take(&mut is_behind_pause),
                    range: own,
                    block,
                    part,
                    from: step.start,
                    to: step.end,
                    piece,
                    coordinates: stated_end.and_then(|_| place(piece_of(Field::Coordinates))),
                    comment: if memchr::memchr(b';', bytes).is_some() {
                        place(piece_of(Field::Comment))
                    } else {
                        None
                    },
                    layout: if is_spaced {
                        Layout::Aligned
                    } else {
                        Layout::Compact
                    },
                });
            }
            // One that stands behind blocks says nothing of the start.
            Item::StartPoint { range, .. } => {
                header = header.clone().or(Some(range).filter(|_| rows.is_empty()))
            }
            Item::Fault(found) => {
                fault.get_or_insert_with(|| format!("line {}: {}", line + 1, found.sentence()));
            }
            Item::Text { .. } if !rows.is_empty() => {
                fault.get_or_insert_with(|| format!("line {} cannot be read", line + 1));
            }
            Item::Text { .. } | Item::CommentedBlock { .. } => {}
            Item::Word { range, .. } => {
                is_over |= end.is_some_and(|end| range.start >= end);
                is_behind_pause = true;
            }
        });
        if blocks > 1 {
            fault.get_or_insert_with(|| {
                format!(
                    "line {} holds {blocks} blocks: format the program first",
                    line + 1
                )
            });
        }
    }
    match fault {
        Some(sentence) => Err(sentence),
        None if rows.is_empty() => Err("the program has no block".into()),
        None => Ok(Content {
            contours: contours(trace),
            rows,
            header,
            largest,
        }),
    }
}

fn contours(trace: &Trace) -> Vec<Contour> {
    let (mut row, mut ordinal) = (0, 0);
    let moves = |steps: Range<usize>| {
        trace
            .steps
            .get(steps)
            .unwrap_or_default()
            .iter()
            .filter(|step| step.moves())
            .count()
    };
    let contour = |cut: Cut| {
        let rows = row..row + moves(cut.steps.clone());
        row = rows.end;
        let is_way = cut.is_way
            || trace
                .steps
                .get(cut.steps.start)
                .is_some_and(|step| step.kind == Kind::Rapid);
        ordinal += usize::from(!is_way);
        let own = cut.contour_steps();
        let (lead_in, lead_out) = (
            moves(cut.steps.start..own.start),
            moves(own.end..cut.steps.end),
        );
        Contour {
            ordinal,
            rows,
            lead_in,
            lead_out,
            closed: cut.closed,
            is_way,
        }
    };
    cuts(trace).into_iter().map(contour).collect()
}
