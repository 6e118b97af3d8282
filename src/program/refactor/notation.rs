//! What a language tells of its moves and how it writes others.

use super::{Content, Contour, Refactoring, Rewrite, Row, Sheet, Transform};
use crate::finding::Finding;
use crate::program::grid::Node;
use crate::program::path::Trace;
use crate::program::steps::Program;
use crate::settings::Effective;
use crate::text::TextEdit;
use std::ops::Range;

/// What is about to be done with moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::program) enum Change {
    Reverse,
    /// With the contour in these lines.
    StartHere(Range<usize>),
    Scale,
}

/// A language whose programs can be rewritten. Errors are lower-case and have no final dot.
pub(in crate::program) trait Notation: Sized {
    type Document: Program;
    /// What is known of a move besides where it leads.
    type Own;
    /// What stands in the place of a move.
    type New: Clone;
    /// What changes besides the moves.
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
        contours: &[Contour],
    ) -> Result<Vec<Row<Self>>, String>;

    /// An error where words of the program say what such a change would make wrong.
    fn refuse(sheet: &Sheet<'_, Self>, change: Change) -> Result<(), String>;

    /// The move of one row as it stands, in the place of another.
    fn kept(
        sheet: &Sheet<'_, Self>,
        content: &Content<Self>,
        row: usize,
        place: usize,
    ) -> Self::New;
    /// The move of a row the other way.
    fn reversed(
        sheet: &Sheet<'_, Self>,
        content: &Content<Self>,
        row: usize,
    ) -> Result<Vec<Self::New>, String>;
    /// A straight cut in the place of a row.
    fn straight(
        sheet: &Sheet<'_, Self>,
        content: &Content<Self>,
        row: usize,
        ends: [Node; 2],
    ) -> Result<Vec<Self::New>, String>;
    fn transformed(
        sheet: &Sheet<'_, Self>,
        content: &Content<Self>,
        row: usize,
        transform: Transform,
    ) -> Self::New;
    /// Where a place of a row lies once it is scaled.
    fn scaled_node(
        sheet: &Sheet<'_, Self>,
        row: &Row<Self>,
        node: Node,
        factor: f64,
    ) -> Option<Node>;
    /// The scaled move of a row between two scaled nodes; nothing where it vanishes.
    fn scaled(
        sheet: &Sheet<'_, Self>,
        content: &Content<Self>,
        row: usize,
        ends: [Node; 2],
        factor: f64,
    ) -> Result<Vec<Self::New>, String>;
    /// Whether a row is a straight cut that can be made one with those before it, which begin with `first`.
    fn runs_on(sheet: &Sheet<'_, Self>, content: &Content<Self>, first: usize, row: usize) -> bool;
    /// Lengths are written in inches, so that nothing has to be scaled for it.
    fn is_in_inches(_: &Content<Self>) -> bool {
        false
    }
    /// The longest straight cut, steps.
    fn longest(settings: &Effective) -> i64;

    /// What changes besides the moves where a contour, the rows `own`, is turned round.
    fn turn_round(
        _: &Sheet<'_, Self>,
        _: &Content<Self>,
        _: &Contour,
        _own: Range<usize>,
        _: &mut Rewrite<Self>,
    ) -> Result<(), String> {
        Ok(())
    }
    /// What changes besides the moves where a program is mirrored or turned.
    fn transform_words(
        _: &Sheet<'_, Self>,
        _: Transform,
        _: &mut Rewrite<Self>,
    ) -> Result<(), String> {
        Ok(())
    }
    /// What changes besides the moves where a program is scaled.
    fn scale_words(_: &Sheet<'_, Self>, _: f64, _: &mut Rewrite<Self>) -> Result<(), String> {
        Ok(())
    }

    /// The edits that make the rewritten program, sorted and disjoint; none where nothing changes.
    fn write(
        sheet: &Sheet<'_, Self>,
        content: &Content<Self>,
        rewrite: &Rewrite<Self>,
    ) -> Result<Vec<TextEdit>, String>;
    /// An error where a move of the new program is not the one that was meant.
    fn agree(after: &Self::Document, row: &Row<Self>, meant: &Self::New) -> Result<(), String>;
    /// Further edits of the new program, by the path of the old one, with which the machine goes the same way.
    fn finishing(_before: &Trace, _after: &Self::Document) -> Vec<TextEdit> {
        Vec::new()
    }

    fn numbered(document: &Self::Document) -> Result<Vec<TextEdit>, String>;
    fn without_numbers(document: &Self::Document) -> Result<Vec<TextEdit>, String>;
    /// Refactorings that it alone has.
    fn own() -> Vec<Refactoring<Self>>;
}
