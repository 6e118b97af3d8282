//! A semicolon within a line: a comment follows, or, where a semicolon also ends the line, another block.

use super::super::variables::Variables;
use super::super::word::{Token, WordFault};
use super::scan;

/// What follows a semicolon.
pub(super) enum Behind {
    /// A comment, to the end of the line.
    Comment,
    /// A block that is no part of the one before: it is not read.
    Block,
    /// Words that belong to the one block of the line, `H001=110; G92 X0 Y0;`.
    Words,
    /// A dwell, which leads nowhere; it ends here.
    Dwell { end: usize },
}

/// What a block between two semicolons holds.
#[derive(Default)]
struct Held {
    /// Something else than words and values for the table.
    others: bool,
    lengths: bool,
    prepares: bool,
    dwells: bool,
    /// An M word: the machine stops, or calls, where it stands.
    acts: bool,
    /// The number of a block or of a program.
    number: bool,
}

impl Held {
    /// Adds what a block holds.
    fn add(&mut self, block: &[u8]) {
        let mut variables = Variables::default();
        scan(block, 0, false, &mut variables, |token, _| match token {
            Token::Word { letter, number } => match letter {
                b'X' | b'Y' | b'I' | b'J' | b'R' => self.lengths = true,
                b'G' if number.whole() == Some(4) => self.dwells = true,
                b'G' => self.prepares = true,
                b'M' => self.acts = true,
                b'N' | b'O' => self.number = true,
                _ => {}
            },
            Token::Fault(WordFault::Expression { .. }) => self.lengths = true,
            Token::Definition { .. } | Token::Sum { .. } | Token::Comment => {}
            _ => self.others = true,
        });
    }

    /// Where the wire goes depends on it.
    fn leads(&self) -> bool {
        self.lengths || self.prepares
    }
}

/// What follows the semicolon at a place of a line.
pub(super) fn behind(line: &[u8], at: usize) -> Behind {
    let line = line.trim_ascii_end();
    let rest = line.get(at + 1..).unwrap_or_default();
    let before = line.get(..at).unwrap_or_default();
    let is_first = before.iter().all(u8::is_ascii_whitespace);
    let length = rest.iter().position(|byte| *byte == b';');
    let end = at + 1 + length.unwrap_or(rest.len());
    let (mut own, mut earlier) = (Held::default(), Held::default());
    own.add(line.get(at + 1..end).unwrap_or_default());
    if rest.is_empty() || is_first || own.others {
        return Behind::Comment;
    }
    let blocks = before.split(|byte| *byte == b';');
    blocks.for_each(|block| earlier.add(block));
    let is_of_its_own = own.number || own.leads() && (earlier.lengths || earlier.acts);
    match line.ends_with(b";") {
        true if own.dwells => Behind::Dwell { end },
        true if !is_of_its_own => Behind::Words,
        _ if own.leads() => Behind::Block,
        _ => Behind::Comment,
    }
}
