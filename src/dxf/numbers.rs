//! The numbers that an entity has once each, and the finding that names the missing ones.

use super::entity::{Common, Refused, tag_of_record};
use super::fault::meaning;
use super::lexer::{Lexer, Tag};

pub(super) fn missing(start: Tag, lexer: &mut Lexer, codes: &[(i16, bool)]) {
    let mut lacking: Vec<String> = codes
        .iter()
        .filter(|(_, there)| !there)
        .map(|(code, _)| format!("{code}{}", meaning(*code)))
        .collect();
    let kind = String::from_utf8_lossy(lexer.lines.trimmed(start.value_line())).into_owned();
    let last = lacking.pop().unwrap_or_default();
    let sentence = match lacking.is_empty() {
        true => say!(lacks_group_code, kind, last),
        false => say!(lacks_group_codes, kind, lacking.join(", "), last),
    };
    lexer.damage(start.value_line(), sentence);
}

/// The numbers of an entity that has each of them once.
pub(super) struct Numbers<const N: usize> {
    codes: [i16; N],
    pub(super) values: [Option<f64>; N],
}

impl<const N: usize> Numbers<N> {
    pub(super) fn new(codes: [i16; N]) -> Self {
        Numbers {
            codes,
            values: [None; N],
        }
    }

    /// Takes every tag of the record that has a place here.
    pub(super) fn gather(
        &mut self,
        lexer: &mut Lexer,
        mut other: impl FnMut(&Lexer, Tag),
    ) -> Common {
        let mut common = Common::default();
        while let Some(tag) = tag_of_record(lexer) {
            if common.take(lexer, tag) {
                continue;
            }
            let mut known = self.codes.iter().zip(&mut self.values);
            match known.find(|(code, _)| **code == tag.code) {
                Some((_, value)) => *value = common.coordinate(lexer, tag),
                None => other(lexer, tag),
            }
        }
        common.bad |= lexer.out_of_step;
        common
    }

    /// The first `M` numbers, which the entity must have; one finding names the missing ones.
    pub(super) fn required<const M: usize>(
        &self,
        start: Tag,
        lexer: &mut Lexer,
        common: &Common,
    ) -> Result<[f64; M], Refused> {
        if common.bad {
            return Err(Refused::Damaged);
        }
        let first = self.values.first_chunk::<M>().ok_or(Refused::Damaged)?;
        if first.iter().all(Option::is_some) {
            return Ok(first.map(Option::unwrap_or_default));
        }
        let there: Vec<(i16, bool)> = self
            .codes
            .iter()
            .zip(first)
            .map(|(&code, value)| (code, value.is_some()))
            .collect();
        missing(start, lexer, &there);
        Err(Refused::Damaged)
    }
}
