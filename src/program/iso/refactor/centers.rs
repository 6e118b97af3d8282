//! I and J in another convention of controls.
//!
//! ```text
//! G03 X0. Y10. I-5. J0.      →     G03 X0. Y10. I5. J0.     (from the centre to the start)
//! ```

use super::Words;
use crate::program::iso::document::Document;
use crate::program::iso::moves::{Bend, CenterRule};
use crate::program::refactor::moves::{Edits, Printer};
use crate::program::refactor::proof::proved;
use crate::program::refactor::sheet::Sheet;

pub(in crate::program) fn centered(
    program: &Document,
    sheet: &Sheet<'_>,
    rule: CenterRule,
) -> Edits {
    let words = Words::of(program)?;
    let old = words.reading;
    let is_written = |incremental: bool| {
        let mut made = words.made.iter().map(|(_, own, _)| own);
        made.any(|own| {
            own.is_arc()
                && own.incremental == incremental
                && matches!(own.bend, Bend::Center { .. })
        })
    };
    let (absolute, incremental) = (is_written(false), is_written(true));
    if !(absolute && old.absolute != rule || incremental && old.incremental != rule) {
        return Ok(Vec::new());
    }
    if rule == CenterRule::Absolute && incremental {
        return Err(say!(under_g91_a_centre_has_no_coordinates_of_its_own).into());
    }
    let reading = old.with_rule(rule);
    let rewrite = sheet.rewrite();
    let printed = Words { reading, ..words }.print(&sheet.moves, &rewrite)?;
    proved(sheet, &rewrite, printed)
}
