//! Mirror and rotate a program about the origin of its frame: its zero, or where it begins, where nothing says otherwise.
//!
//! ```text
//! B5000B0B5000GXL1           B5000B0B5000GYL2         G01 X5. Y0.                G01 X0. Y5.
//! B5000B0B10000GYNR1    →    B0B5000B10000GXNR2       G03 X0. Y5. I-5. J0.  →    G03 X-5. Y0. I0. J-5.     (a quarter turn)
//! ```
//!
//! Every number stays as it is written; only axes, quadrants, letters and signs change. So the
//! transformation is exact.

use super::moves::{Change, Edits};
use super::proof::rewritten;
use super::sheet::Sheet;
use super::transform::Transform;

pub(in crate::program) fn transformed(sheet: &Sheet<'_>, rows: [[i64; 2]; 2]) -> Edits {
    let transform = Transform(rows);
    let mut rewrite = sheet.rewrite();
    for own in rewrite.moves.iter_mut().flatten() {
        *own = own.transformed(transform);
    }
    rewrite.words = sheet.words(&Change::Turn(transform))?;
    let first = sheet.moves.first();
    rewrite.start = first.map(|first| transform.of_place(first.from));
    rewrite.end = Some(transform.of_point(sheet.trace.end()));
    rewritten(sheet, &rewrite)
}
