//! Split blocks whose numbers have more digits than the controller takes.
//!
//! ```text
//! B1500000B0B1500000GXL1     →    B750000B0B750000GXL1
//!                                 B750000B0B750000GXL1
//! ```

use super::Blocks;
use crate::program::refactor::moves::Edits;
use crate::program::refactor::proof::rewritten;
use crate::program::refactor::sheet::Sheet;
use crate::program::three_b::Document;

pub(in crate::program) fn split(program: &Document, sheet: &Sheet<'_>) -> Edits {
    let blocks = Blocks::of(program, &sheet.trace)?;
    let mut rewrite = sheet.rewrite();
    for index in sheet.selected_moves() {
        let (own, block) = (sheet.moves[index], blocks.all[index].block);
        if block.x.max(block.y).max(block.j) <= program.largest() {
            continue;
        }
        if own.part.is_some() {
            return Err(say!(a_4b_block_cannot_be_calculated_anew, own.line + 1));
        }
        rewrite.moves[index] = Some(own.fitted(&own.piece, [own.from, own.to]));
    }
    rewritten(sheet, &rewrite)
}
