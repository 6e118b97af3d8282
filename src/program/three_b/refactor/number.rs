//! Number the blocks from 1, or leave their numbers out.
//!
//! ```text
//! B9900B0B9900GXL1      →     N1 B9900B0B9900GXL1
//! N7 B9900B0B9900GXL3         N2 B9900B0B9900GXL3
//! ```

use super::Refactoring;
use super::sheet::Sheet;
use crate::program::language::{numbered, without_numbers};
use crate::program::{Document, three_b};
use crate::text::TextEdit;

pub const NUMBER: Refactoring = Refactoring {
    id: "refactor.rewrite.number",
    title: |_| "Number the blocks from 1".into(),
    rewrite: |sheet| unproved(sheet, |program, lines| numbered(program, 0..lines, 1, 1)),
};
pub const WITHOUT_NUMBERS: Refactoring = Refactoring {
    id: "refactor.rewrite.withoutNumbers",
    title: |_| "Leave the block numbers out".into(),
    rewrite: |sheet| unproved(sheet, |program, lines| without_numbers(program, 0..lines)),
};

/// The edits, once the blocks read the same behind them.
fn unproved(
    sheet: &Sheet<'_>,
    edits: fn(&Document, usize) -> Vec<TextEdit>,
) -> Result<Vec<TextEdit>, String> {
    let program = Document::ThreeB(sheet.document.clone());
    let edits = edits(&program, program.text().line_count());
    let after = three_b::Document::read_with(
        super::rewrite::applied(program.text().bytes(), &edits),
        sheet.settings,
    );
    let ideals = |trace: &crate::program::path::Trace| {
        trace
            .steps
            .iter()
            .map(|step| (step.kind, step.ideal))
            .collect::<Vec<_>>()
    };
    if ideals(&after.trace().as_meant()) != ideals(&sheet.trace) {
        return Err("the new program reads otherwise than it was meant".into());
    }
    Ok(edits)
}
