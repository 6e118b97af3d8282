//! Split blocks whose numbers have more digits than the controller takes.
//!
//! ```text
//! B1500000B0B1500000GXL1     →    B750000B0B750000GXL1
//!                                 B750000B0B750000GXL1
//! ```

use super::{ThreeB, encoded};
use crate::program::refactor::{Edits, Refactoring, Rewrite, Sheet};

pub(super) const SPLIT: Refactoring<ThreeB> = Refactoring {
    id: "refactor.rewrite.split",
    title: |settings| say!(split_blocks_over, settings.largest_number()),
    rewrite: split,
};

fn split(sheet: &Sheet<'_, ThreeB>) -> Edits {
    let content = sheet.content()?;
    let largest = sheet.settings.largest_number();
    let mut rewrite = Rewrite::new();
    for index in sheet.selected_rows(content) {
        let row = sheet.at(content, index);
        let block = &row.own.block;
        if block.x.max(block.y).max(block.j) <= largest {
            continue;
        }
        if row.own.part.is_some() {
            return Err(say!(a_4b_block_cannot_be_calculated_anew, row.line + 1));
        }
        let news = encoded(row, &row.piece, [row.from, row.to], None)?;
        rewrite.rows.insert(index, news);
    }
    rewrite.edits(sheet, content)
}
