//! Number the blocks, or remove their numbers.
//!
//! ```text
//! B9900B0B9900GXL1      →     N1 B9900B0B9900GXL1          M98 P7            M98 P40
//! N7 B9900B0B9900GXL3         N2 B9900B0B9900GXL3          N7 G01 X1.   →    N40 G01 X1.
//! ```

use super::proof::same_way;
use super::{Notation, Refactoring};

pub(super) fn all<N: Notation>() -> [Refactoring<N>; 2] {
    [
        Refactoring {
            id: "refactor.rewrite.number",
            title: |_| N::title_of_numbering().into(),
            rewrite: |sheet| same_way(sheet, N::numbered(sheet.document)?),
        },
        Refactoring {
            id: "refactor.rewrite.withoutNumbers",
            title: |_| say!(leave_the_block_numbers_out).into(),
            rewrite: |sheet| same_way(sheet, N::without_numbers(sheet.document)?),
        },
    ]
}
