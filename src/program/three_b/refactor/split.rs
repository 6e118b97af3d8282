//! Split blocks whose numbers have more digits than the controller takes.
//!
//! ```text
//! B1500000B0B1500000GXL1     →    B750000B0B750000GXL1
//!                                 B750000B0B750000GXL1
//! ```

use super::Refactoring;
use super::rewrite::{Rewrite, encoded};
use super::sheet::Sheet;
use crate::text::TextEdit;

pub const SPLIT: Refactoring = Refactoring {
    id: "refactor.rewrite.split",
    title: |settings| format!("Split blocks over {} µm", settings.largest_number()),
    rewrite: split,
};

fn split(sheet: &Sheet<'_>) -> Result<Vec<TextEdit>, String> {
    let content = sheet.content()?;
    let largest = sheet.settings.largest_number();
    let is_too_long = |index: &usize| {
        let block = &content.rows[*index].block;
        block.x.max(block.y).max(block.j) > largest
    };
    let long: Vec<usize> = sheet.selected_rows(content).filter(is_too_long).collect();
    if long.is_empty() {
        return Ok(Vec::new());
    }
    let nodes = content.nodes()?;
    let mut rewrite = Rewrite {
        end: sheet.trace.end(),
        ..Rewrite::default()
    };
    for index in long {
        let row = &content.rows[index];
        if row.part.is_some() {
            return Err(format!(
                "line {}: a 4B block cannot be calculated anew",
                row.line + 1
            ));
        }
        let (from, to) = nodes[index];
        rewrite.rows.insert(
            index,
            encoded(
                &content.piece_from(index, from),
                from,
                to,
                None,
                index,
                largest,
            )?,
        );
    }
    rewrite.edits(sheet, content)
}
