//! Number the blocks, or remove their numbers.

use super::proof::same_way;
use super::{Notation, Refactoring};
use crate::program::numbering::{numbered, without_numbers};

pub(super) fn all<N: Notation>() -> [Refactoring<N>; 2] {
    [
        Refactoring {
            id: "refactor.rewrite.number",
            title: |_| N::title_of_numbering().into(),
            rewrite: |sheet| same_way(sheet, numbered(sheet.document)?),
        },
        Refactoring {
            id: "refactor.rewrite.withoutNumbers",
            title: |_| say!(leave_the_block_numbers_out).into(),
            rewrite: |sheet| same_way(sheet, without_numbers(sheet.document)?),
        },
    ]
}
