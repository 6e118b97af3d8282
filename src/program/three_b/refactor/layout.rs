//! Write the program in another layout.
//!
//! ```text
//! B9900B0B9900GXL1     →     N    1: B   9900 B      0 B   9900 GX L1  ;      9.900 ,      0.000
//! ```

use super::ThreeB;
use crate::program::refactor::{Edits, Refactoring, Sheet};
use crate::program::three_b::format::guarded;
use crate::settings::Layout;

pub(super) const COMPACT: Refactoring<ThreeB> = Refactoring {
    id: "refactor.rewrite.layout.compact",
    title: |_| say!(convert_to_the_compact_layout).into(),
    rewrite: |sheet| laid_out(sheet, Layout::Compact),
};
pub(super) const ALIGNED: Refactoring<ThreeB> = Refactoring {
    id: "refactor.rewrite.layout.aligned",
    title: |_| say!(convert_to_the_aligned_layout).into(),
    rewrite: |sheet| laid_out(sheet, Layout::Aligned),
};
pub(super) const CHECKING: Refactoring<ThreeB> = Refactoring {
    id: "refactor.rewrite.layout.checking",
    title: |_| say!(convert_to_the_checking_layout).into(),
    rewrite: |sheet| laid_out(sheet, Layout::Checking),
};

fn laid_out(sheet: &Sheet<'_, ThreeB>, layout: Layout) -> Edits {
    let lines = 0..sheet.document.text().line_count();
    let formatted = guarded(sheet.document, sheet.settings, Some(layout), lines);
    match formatted.kept {
        Some(kept) if layout == Layout::Checking => Err(say!(
            end_points_cannot_be_trusted,
            kept.rule.name(),
            kept.line + 1
        )),
        _ => Ok(formatted.edits),
    }
}
