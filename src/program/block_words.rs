//! The content of a block, however it is spaced: its words, and their numbers separately.

use super::Language;
use super::iso::{self, Token};
use super::three_b::{self, Item};

/// The words of one block and their numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct BlockWords {
    /// Everything but lengths: letters, and the numbers of codes.
    words: Vec<u8>,
    /// Lengths, µm where they have a point or are in µm anyway.
    numbers: Vec<f64>,
    /// Coordinates that stand after the block, µm.
    pub(crate) stated: Option<[f64; 2]>,
    /// The wire runs inside of the arc (DD of 4B).
    pub(crate) concave: Option<bool>,
}

/// The letters of ISO before a length.
const LENGTHS: &[u8] = b"XYIJRUVZK";

impl BlockWords {
    /// For the first block of a line that begins with it.
    pub(crate) fn of(language: Language, line: &[u8]) -> BlockWords {
        match language {
            Language::ThreeB => BlockWords::of_three_b(line),
            Language::Iso => BlockWords::of_iso(line),
        }
    }

    fn of_three_b(line: &[u8]) -> BlockWords {
        let mut said: Option<BlockWords> = None;
        three_b::read_line(line, 1, &three_b::Words::default(), |item| {
            if let Item::Block {
                block,
                stated_end,
                part,
                ..
            } = item
                && said.is_none()
            {
                let radius = part.map(|part| part.radius as f64);
                let numbers = [block.x, block.y, block.j].map(|number| number as f64);
                said = Some(BlockWords {
                    concave: part.map(|part| part.concave),
                    words: format!(
                        "{:?}{:?}{:?}",
                        block.motion,
                        block.axis,
                        part.map(|part| part.concave)
                    )
                    .into(),
                    numbers: numbers.into_iter().chain(radius).collect(),
                    stated: stated_end.map(|end| end.at.map(|mm| mm * 1e3)),
                });
            }
        });
        said.unwrap_or_default()
    }

    fn of_iso(line: &[u8]) -> BlockWords {
        let mut said = BlockWords::default();
        iso::words_in(line, |token, _| {
            let Token::Word { letter, number } = token else {
                return;
            };
            let value = number.mantissa as f64 / 10_f64.powi(number.decimals.into());
            match letter {
                b'N' => {}
                letter if LENGTHS.contains(&letter) => {
                    said.words.push(letter);
                    let steps = if number.point { 1e3 } else { 1.0 };
                    said.numbers.push(value * steps);
                }
                _ => said
                    .words
                    .extend(format!("{}{value}", letter as char).bytes()),
            }
        });
        said
    }

    /// It sets the start of an ISO program.
    pub(crate) fn sets_place(&self) -> bool {
        self.words.starts_with(b"G92X")
    }

    /// The same words and numbers, whatever stands after them.
    pub(crate) fn is_like(&self, other: &BlockWords) -> bool {
        self.words == other.words && self.numbers == other.numbers
    }

    /// By how much a number differs, where everything else is the same.
    pub(crate) fn apart(&self, other: &BlockWords) -> Option<f64> {
        let is_same = self.words == other.words && self.numbers.len() == other.numbers.len();
        let pairs = self.numbers.iter().zip(&other.numbers);
        let apart = pairs.map(|(own, other)| (own - other).abs());
        is_same.then(|| apart.fold(0.0, f64::max))
    }
}
