//! A program as refactorings see it, and its new form; the interface by which a language reads and writes its moves.

use super::transform::Transform;
use super::{Edits, Refactoring};
use crate::finding::Finding;
use crate::geometry::{Point, Segment};
use crate::program::grid::{Node, point_of};
use crate::program::numbering::Numbers;
use crate::program::path::{Cut, Kind, Trace, cuts};
use crate::program::steps::{Program, trace};
use crate::settings::Effective;
use crate::text::TextEdit;
use std::collections::BTreeMap;
use std::ops::{Deref, Range};

/// The kind of change to moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::program) enum Change {
    Reverse,
    /// With the contour in these lines; the new start lies at a corner of it, or within a straight edge or where it is tangent.
    StartHere {
        lines: Range<usize>,
        is_corner: bool,
    },
    Scale,
}

/// A language whose programs can be rewritten. Errors are in lower case without a full stop.
pub(in crate::program) trait Notation: Sized {
    type Document: Numbers;
    /// Everything known of a move except where it leads.
    type Own;
    /// The replacement of a move.
    type New: Clone;
    /// Changes besides the moves.
    type Extra: Default;

    /// A step of its nodes, µm.
    const STEP: f64;

    /// Title of the refactoring that numbers its blocks.
    fn title_of_numbering() -> &'static str;

    fn read(bytes: Vec<u8>, settings: &Effective) -> Self::Document;
    fn findings(document: &Self::Document) -> Vec<Finding>;

    /// The moves of a program, one for each step of the trace that moves; the error says which line cannot be read.
    fn rows(
        document: &Self::Document,
        trace: &Trace,
        contours: &[Cut],
    ) -> Result<Vec<Row<Self>>, String>;

    /// An error where words of the program would become wrong by such a change.
    fn refuse(sheet: &Sheet<'_, Self>, change: Change) -> Result<(), String>;

    /// An error where a way in that ends before one row cannot be told for another one.
    fn refuse_begin(_content: &Content<Self>, _from: usize, _to: usize) -> Result<(), String> {
        Ok(())
    }

    /// The move of one row, replacing that of `place`.
    fn kept(at: At<'_, Self>, place: usize) -> Self::New;
    /// The move of a row in the other direction.
    fn reversed(at: At<'_, Self>) -> News<Self>;
    /// A straight cut that replaces a row.
    fn straight(at: At<'_, Self>, ends: [Node; 2]) -> News<Self>;
    fn transformed(at: At<'_, Self>, transform: Transform) -> Self::New;
    /// A place of a row after scaling.
    fn scaled_node(row: &Row<Self>, node: Node, factor: f64) -> Option<Node>;
    /// The scaled move of a row between two scaled nodes; nothing where it vanishes.
    fn scaled(at: At<'_, Self>, ends: [Node; 2], factor: f64) -> News<Self>;
    /// Whether a row is a straight cut that can be merged with those before it, which begin with `first`.
    fn runs_on(at: At<'_, Self>, first: usize) -> bool;
    /// Lengths are written in inches, so inches need no scaling.
    fn is_in_inches(_: &Content<Self>) -> bool {
        false
    }
    /// The longest straight cut, steps.
    fn longest(settings: &Effective) -> i64;

    /// Further changes where a contour, the rows `own`, is reversed.
    fn turn_round(
        _: &Sheet<'_, Self>,
        _: &Content<Self>,
        _: &Cut,
        _own: Range<usize>,
        _: &mut Rewrite<Self>,
    ) -> Result<(), String> {
        Ok(())
    }
    /// Further changes where a program is mirrored or turned.
    fn transform_words(
        _: &Sheet<'_, Self>,
        _: Transform,
        _: &mut Rewrite<Self>,
    ) -> Result<(), String> {
        Ok(())
    }
    /// Further changes where a program is scaled.
    fn scale_words(_: &Sheet<'_, Self>, _: f64, _: &mut Rewrite<Self>) -> Result<(), String> {
        Ok(())
    }

    /// The edits that make the rewritten program, sorted and disjoint; none where nothing changes.
    fn write(sheet: &Sheet<'_, Self>, content: &Content<Self>, rewrite: &Rewrite<Self>) -> Edits;
    /// An error where a move of the new program is not the intended one.
    fn agree(after: &Self::Document, row: &Row<Self>, meant: &Self::New) -> Result<(), String>;
    /// Further edits of the new program, by the path of the old one, that keep the machine's way.
    fn finishing(_before: &Trace, _after: &Self::Document) -> Vec<TextEdit> {
        Vec::new()
    }

    /// Refactorings that it alone has.
    fn own() -> Vec<Refactoring<Self>>;
}

/// The moves that replace one.
pub(in crate::program) type News<N> = Result<Vec<<N as Notation>::New>, String>;

/// A row in its program.
pub(in crate::program) struct At<'a, N: Notation> {
    pub(crate) sheet: &'a Sheet<'a, N>,
    pub(crate) content: &'a Content<N>,
    pub(crate) index: usize,
}

impl<N: Notation> Clone for At<'_, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N: Notation> Copy for At<'_, N> {}

impl<N: Notation> At<'_, N> {
    /// Its move as it is.
    pub(crate) fn kept(self) -> N::New {
        N::kept(self, self.index)
    }
}

impl<N: Notation> Deref for At<'_, N> {
    type Target = Row<N>;

    fn deref(&self) -> &Row<N> {
        &self.content.rows[self.index]
    }
}

/// A move in its line.
pub(in crate::program) struct Row<N: Notation> {
    pub(crate) line: usize,
    /// The machine's position before and after it, in the language's steps. Contours close exactly.
    pub(crate) from: Node,
    pub(crate) to: Node,
    /// Its curve, from `from`, µm.
    pub(crate) piece: Segment,
    pub(crate) own: N::Own,
}

/// A program for refactoring.
pub(in crate::program) struct Sheet<'a, N: Notation> {
    pub(crate) document: &'a N::Document,
    pub(crate) settings: &'a Effective,
    /// Bytes of the text.
    selection: Range<usize>,
    /// As the blocks mean it.
    pub(crate) trace: Trace,
    /// Its moves, or why they cannot be read.
    content: Result<Content<N>, String>,
}

pub(in crate::program) struct Content<N: Notation> {
    pub(crate) rows: Vec<Row<N>>,
    /// The contours of the program. Their steps are rows, and they are counted as a person does,
    /// without the moves between.
    pub(crate) contours: Vec<Cut>,
    /// The rows before which the program pauses.
    pauses: Vec<usize>,
    /// Moves name their ends, not displacements: nothing drifts.
    pub(crate) names_places: bool,
}

impl<'a, N: Notation> Sheet<'a, N> {
    pub(crate) fn new(
        document: &'a N::Document,
        settings: &'a Effective,
        selection: Range<usize>,
    ) -> Sheet<'a, N> {
        let trace = trace(document).into_meant();
        let (contours, pauses) = contours(&trace);
        let moves = trace.steps.iter().filter(|step| step.moves()).count();
        let content = N::rows(document, &trace, &contours).and_then(|rows| {
            if rows.len() != moves {
                return Err(say!(the_program_is_not_followed_as_a_whole).into());
            }
            Ok(Content {
                rows,
                contours,
                pauses,
                names_places: trace.writing.names_places,
            })
        });
        Sheet {
            document,
            settings,
            selection,
            trace,
            content,
        }
    }

    /// The moves; the error names the line that cannot be read.
    pub(crate) fn content(&self) -> Result<&Content<N>, String> {
        self.content.as_ref().map_err(Clone::clone)
    }

    pub(crate) fn at<'s>(&'s self, content: &'s Content<N>, index: usize) -> At<'s, N> {
        let sheet = self;
        At {
            sheet,
            content,
            index,
        }
    }

    /// Lines that the selection touches.
    pub(crate) fn selected_lines(&self) -> Range<usize> {
        let text = self.document.text();
        let first = text.line_of(self.selection.start);
        let last = text.line_of(self.selection.end.max(self.selection.start + 1) - 1);
        first..last.max(first) + 1
    }

    /// The selected rows; all, where at most one line is selected.
    pub(crate) fn selected_rows(&self, content: &Content<N>) -> Range<usize> {
        let lines = self.selected_lines();
        if lines.len() < 2 {
            return 0..content.rows.len();
        }
        let start = content.rows.partition_point(|row| row.line < lines.start);
        start..content.rows.partition_point(|row| row.line < lines.end)
    }

    /// The contours that the selection touches; all, where it touches none.
    pub(crate) fn selected_contours<'c>(&self, content: &'c Content<N>) -> Vec<&'c Cut> {
        let lines = self.selected_lines();
        let cut = || content.contours.iter().filter(|contour| !contour.is_way);
        let touched = |contour: &&Cut| {
            content.rows[contour.steps.clone()]
                .iter()
                .any(|row| lines.contains(&row.line))
        };
        let chosen: Vec<&Cut> = cut().filter(touched).collect();
        if chosen.is_empty() {
            cut().collect()
        } else {
            chosen
        }
    }
}

impl<N: Notation> Content<N> {
    /// Where a node lies, µm.
    pub(crate) fn point(node: Node) -> Point {
        point_of(node) * N::STEP
    }

    pub(crate) fn arcs(&self) -> usize {
        let is_arc = |row: &&Row<N>| row.piece.as_arc().is_some();
        self.rows.iter().filter(is_arc).count()
    }

    pub(crate) fn is_behind_pause(&self, row: usize) -> bool {
        self.pauses.binary_search(&row).is_ok()
    }

    /// An error where the contour pauses before its tab: that pause would be misplaced.
    pub(crate) fn refuse_pause(&self, contour: &Cut) -> Result<(), String> {
        let within = |row: &usize| contour.steps.start < *row && *row < contour.steps.end;
        match self.pauses.iter().copied().find(within) {
            Some(row) => Err(say!(
                the_contour_pauses_to_hold_the_part,
                self.rows[row].line + 1
            )),
            None => Ok(()),
        }
    }

    /// The rows of a closed contour whose ends coincide; the error says why there are none.
    pub(crate) fn closed(&self, contour: &Cut) -> Result<Range<usize>, String> {
        self.refuse_pause(contour)?;
        let (own, ordinal) = (contour.contour_steps(), contour.contour);
        if !contour.closed || own.is_empty() {
            return Err(say!(
                only_a_closed_contour_begins_elsewhere_or_goes_round,
                ordinal
            ));
        }
        if !self.names_places {
            return Ok(own);
        }
        // Leads that only nearly coincide belong to it.
        let mut wider =
            (0..=contour.lead_in.min(contour.lead_out)).map(|by| own.start - by..own.end + by);
        wider
            .find(|own| self.rows[own.start].from == self.rows[own.end - 1].to)
            .ok_or_else(|| say!(the_contour_misses_its_own_begin, ordinal))
    }
}

/// The changes of a refactoring to a program.
pub(in crate::program) struct Rewrite<N: Notation> {
    /// The replacement by row; rows without one stay.
    pub(crate) rows: BTreeMap<usize, Vec<N::New>>,
    /// The new start of the program, if it changes.
    pub(crate) start: Option<Node>,
    /// The new end of the program, µm, if it changes.
    pub(crate) end: Option<Point>,
    /// How much longer the contours become; `None` where that is not known.
    pub(crate) stretch: Option<f64>,
    pub(crate) extra: N::Extra,
}

impl<N: Notation> Rewrite<N> {
    pub(crate) fn new() -> Rewrite<N> {
        Rewrite {
            rows: BTreeMap::new(),
            start: None,
            end: None,
            stretch: Some(1.0),
            extra: N::Extra::default(),
        }
    }

    /// The intended moves of the program.
    pub(crate) fn meant(&self, sheet: &Sheet<'_, N>, content: &Content<N>) -> Vec<N::New> {
        let of_row = |row: usize| match self.rows.get(&row) {
            Some(news) => news.clone(),
            None => vec![sheet.at(content, row).kept()],
        };
        (0..content.rows.len()).flat_map(of_row).collect()
    }
}

/// The contours of a program, and the rows before which it pauses.
fn contours(trace: &Trace) -> (Vec<Cut>, Vec<usize>) {
    // Cuts count all steps, rows only those that move.
    let mut row_of = Vec::with_capacity(trace.steps.len() + 1);
    let (mut row, mut pauses) = (0, Vec::new());
    for step in &trace.steps {
        row_of.push(row);
        row += usize::from(step.moves());
        if step.kind == Kind::Pause {
            pauses.push(row);
        }
    }
    row_of.push(row);
    let rows = |steps: Range<usize>| {
        let at = |step: usize| row_of.get(step).copied().unwrap_or(row);
        at(steps.start)..at(steps.end)
    };
    let mut ordinal = 0;
    let contours = cuts(trace).into_iter().map(|cut| {
        let (own, all) = (rows(cut.contour_steps()), rows(cut.steps.clone()));
        ordinal += usize::from(!cut.is_way);
        Cut {
            contour: ordinal,
            lead_in: own.start - all.start,
            lead_out: all.end - own.end,
            steps: all,
            ..cut
        }
    });
    (contours.collect(), pauses)
}
