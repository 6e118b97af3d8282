//! The numbers of blocks in any language: all rewritten, left out, and set by a fix.
//!
//! ```text
//! B9900B0B9900GXL1      →     N1 B9900B0B9900GXL1          M98 P7            M98 P40
//! N7 B9900B0B9900GXL3         N2 B9900B0B9900GXL3          N7 G01 X1.   →    N40 G01 X1.
//! ```

mod sequence;

pub(super) use sequence::{FIRST, Numbered, check, usual_step};

use super::steps::Program;
use crate::finding::{FixKind, TextFix};
use crate::text::TextEdit;
use std::ops::Range;

/// A block as far as its number goes.
pub(super) struct NumberedBlock {
    /// Its first byte after the number, or that of its line.
    pub(super) start: usize,
    /// The word that numbers it.
    pub(super) word: Option<Range<usize>>,
    /// It gets a number where all are numbered; else it only may have one.
    pub(super) is_counted: bool,
    /// Its number is called, so it stays.
    pub(super) is_called: bool,
}

/// A program whose blocks can be numbered. Errors are lower-case and have no final dot.
pub(super) trait Numbers: Program {
    /// The first number and the step, where all blocks are renumbered.
    const STEP: u32;

    /// Its blocks in the order of the text; an error where a word of it may name blocks by their numbers.
    fn blocks(&self) -> Result<Vec<NumberedBlock>, String>;

    /// The edit that gives a block a number, in the place of its own.
    fn written(&self, block: &NumberedBlock, number: u32) -> Result<TextEdit, String>;

    /// Numbers that no block may get.
    fn taken(&self) -> Vec<u32> {
        Vec::new()
    }

    /// The line of a block with a number other than `own`; an error as of [`Numbers::blocks`].
    fn other_with(&self, number: u32, own: usize) -> Result<Option<usize>, String>;

    /// The edits of the words that call the block in line `own` by its number.
    fn calls_follow(&self, _own: usize, _old: u32, _new: u32) -> Vec<TextEdit> {
        Vec::new()
    }

    /// Lets what names blocks by their numbers follow these, in no order.
    fn followed(&self, edits: Vec<TextEdit>, _given: &[(NumberedBlock, u32)]) -> Vec<TextEdit> {
        edits
    }

    /// The edits that give a block another number, whose digits stand at `digits`; calls of it follow.
    ///
    /// Errors: one that another block has.
    fn renamed(
        &self,
        digits: Range<usize>,
        old: u32,
        name: &str,
        new: u32,
    ) -> Result<Vec<TextEdit>, String> {
        let own = self.text().line_of(digits.start);
        if let Some(line) = self.other_with(new, own)? {
            return Err(say!(the_number_is_that_of_another_block, new, line + 1));
        }
        let mut edits = self.calls_follow(own, old, new);
        edits.push(TextEdit::new(digits, name));
        edits.sort_by_key(|edit| edit.range.start);
        Ok(edits)
    }
}

/// The edits that number all blocks, in the order of the text, words left out that stand already.
pub(super) fn numbered<P: Numbers>(program: &P) -> Result<Vec<TextEdit>, String> {
    let blocks = program.blocks()?.into_iter();
    let taken = program.taken();
    let (mut edits, mut given) = (Vec::new(), Vec::new());
    let mut number = 0_u32;
    for block in blocks.filter(|block| block.is_counted) {
        number = number.saturating_add(P::STEP);
        while taken.contains(&number) && number < u32::MAX {
            number = number.saturating_add(P::STEP);
        }
        edits.push(program.written(&block, number)?);
        given.push((block, number));
    }
    Ok(program.text().changing(program.followed(edits, &given)))
}

/// The edits that remove all numbers that are not called, with the space after them.
pub(super) fn without_numbers(program: &impl Numbers) -> Result<Vec<TextEdit>, String> {
    let blocks = program.blocks()?.into_iter();
    let words = blocks.filter(|block| !block.is_called);
    let words = words.filter_map(|block| block.word);
    Ok(words
        .map(|word| program.text().without_word(&word))
        .collect())
}

/// Whether the numbering of all blocks is among the fixes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Renumbering {
    Offered,
    LeftOut,
}

/// The fixes of a number: the one of the block's turn, where that is known, and all blocks renumbered, from the
/// `first` number on by a step.
pub(super) fn fixes(
    own: Option<(u32, TextEdit)>,
    all: Option<([u32; 2], Vec<TextEdit>)>,
) -> Vec<TextFix> {
    let is_first = own.is_none();
    let own = own.map(|(number, edit)| TextFix::text(FixKind::SetNumber { number }, true, edit));
    let all = all.map(|([first, step], edits)| {
        TextFix::text(FixKind::Renumber { first, step }, false, edits).preferred_if(is_first)
    });
    own.into_iter().chain(all).collect()
}

/// The step from one number to the next, if that is larger.
pub(super) fn step(number: u32, next: u32) -> Option<u32> {
    next.checked_sub(number).filter(|step| *step > 0)
}
