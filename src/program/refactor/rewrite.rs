//! From what stands in the place of which move to the edits of the text.

use super::proof::{prove, same_way};
use super::{Content, Notation, Sheet};
use crate::geometry::Point;
use crate::program::grid::Node;
use crate::program::steps::Program;
use crate::text::{TextEdit, difference, edited};
use std::collections::BTreeMap;

/// What a refactoring does to a program.
pub(in crate::program) struct Rewrite<N: Notation> {
    /// By row, what stands in its place; rows that are not named stay.
    pub(crate) rows: BTreeMap<usize, Vec<N::New>>,
    /// Where the program begins afterwards, where that changes.
    pub(crate) start: Option<Node>,
    /// Where it ends afterwards, µm, where that changes.
    pub(crate) end: Option<Point>,
    pub(crate) extra: N::Extra,
}

impl<N: Notation> Rewrite<N> {
    pub(crate) fn new() -> Rewrite<N> {
        Rewrite {
            rows: BTreeMap::new(),
            start: None,
            end: None,
            extra: N::Extra::default(),
        }
    }

    /// The edits of the text, proved; none where nothing changes.
    pub(crate) fn edits(
        self,
        sheet: &Sheet<'_, N>,
        content: &Content<N>,
    ) -> Result<Vec<TextEdit>, String> {
        let edits = N::write(sheet, content, &self)?;
        if edits.is_empty() {
            return Ok(edits);
        }
        let old = sheet.document.text().bytes();
        let bytes = edited(old, &edits).ok_or(say!(the_edits_lie_on_each_other))?;
        let after = N::read(bytes, sheet.settings);
        prove(sheet, content, &self, &after)?;
        let more = N::finishing(&sheet.trace, &after);
        if more.is_empty() {
            return Ok(edits);
        }
        let again = Sheet::<N>::new(&after, sheet.settings, 0..0);
        let finished = same_way(&again, more).ok();
        let both = finished.and_then(|more| edited(after.text().bytes(), &more));
        let both = both.and_then(|bytes| difference(old, &bytes));
        Ok(both.map_or(edits, |both| vec![both]))
    }

    /// The moves of the program as it is meant to be.
    pub(crate) fn meant(&self, sheet: &Sheet<'_, N>, content: &Content<N>) -> Vec<N::New> {
        let of_row = |row: usize| match self.rows.get(&row) {
            Some(news) => news.clone(),
            None => vec![N::kept(sheet, content, row, row)],
        };
        (0..content.rows.len()).flat_map(of_row).collect()
    }
}
