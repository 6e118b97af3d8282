//! Write the program in another layout.
//!
//! ```text
//! B9900B0B9900GXL1     →     N    1: B   9900 B      0 B   9900 GX L1  ;      9.900 ,      0.000
//! ```

use crate::program::refactor::moves::Edits;
use crate::program::three_b::Document;
use crate::program::three_b::format::guarded;
use crate::settings::{Effective, Layout};

pub(in crate::program) fn laid_out(
    program: &Document,
    settings: &Effective,
    layout: Layout,
) -> Edits {
    let lines = 0..program.text().line_count();
    let formatted = guarded(program, settings, Some(layout), lines);
    match formatted.kept {
        Some(kept) if layout == Layout::Checking => Err(say!(
            end_points_cannot_be_trusted,
            kept.rule.name(),
            kept.line + 1
        )),
        _ => Ok(formatted.edits),
    }
}
