//! What is asked about a program again and again, with each of its findings: worked out once for each version of it.

use super::super::repair::Scope;
use super::super::rules::TextFix;
use super::At;
use super::contours::OneContour;
use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock, PoisonError};

/// The repairs of contours, by their first cut and the one behind them.
type OfContours = BTreeMap<([usize; 2], Scope), Vec<TextFix>>;

#[cfg(test)]
thread_local! {
    /// How many contours this thread has searched for repairs.
    static SEARCHED: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

/// Answers that depend on the program alone.
#[derive(Debug, Default)]
pub(super) struct Asked {
    fixes: Mutex<OfContours>,
    faulty_numbers: OnceLock<BTreeMap<At, Option<u32>>>,
}

impl Asked {
    /// The repairs of a contour. While they are `found`, others may ask.
    pub(super) fn fixes_of(
        &self,
        cuts: &OneContour,
        scope: Scope,
        found: impl FnOnce() -> Vec<TextFix>,
    ) -> Vec<TextFix> {
        let key = ([cuts.start, cuts.end], scope);
        let held = || self.fixes.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = held().get(&key) {
            return known.clone();
        }
        #[cfg(test)]
        SEARCHED.set(SEARCHED.get() + 1);
        let found = found();
        held().insert(key, found.clone());
        found
    }

    /// The blocks with a finding about their numbers, and the number of each one's turn, where that is known.
    pub(super) fn faulty_numbers(
        &self,
        found: impl FnOnce() -> BTreeMap<At, Option<u32>>,
    ) -> &BTreeMap<At, Option<u32>> {
        self.faulty_numbers.get_or_init(found)
    }
}

/// A copy is made to be changed: it knows no answers.
impl Clone for Asked {
    fn clone(&self) -> Asked {
        Asked::default()
    }
}

#[cfg(test)]
mod tests {
    use crate::program::numbering::Renumbering;
    use crate::program::three_b::Document;

    #[test]
    fn a_cut_is_searched_once_for_all_its_findings() {
        let square = "B9000B0B9000GXL1\nB0B9000B9000GYL2\nB9000B0B9000GXL3\nB0B9000B9000GYL4\nD\n";
        let text = square.to_owned() + &"B0B0B0GXL1\n".repeat(300) + "DD\n";
        let mut document = Document::read(text.into_bytes());
        let asked = |document: &Document| {
            let findings = document.findings();
            assert!(findings.len() >= 300, "{}", findings.len());
            let fixes = findings
                .iter()
                .map(|finding| document.offered(finding, Renumbering::LeftOut));
            fixes.collect::<Vec<_>>()
        };
        let before = asked(&document);
        assert_eq!(super::SEARCHED.take(), 1);
        assert_eq!(asked(&document), before);
        assert_eq!(super::SEARCHED.take(), 0);
        // What was known of the text before an edit does not count after it.
        document.edit(0..0, "\n");
        asked(&document);
        assert_eq!(super::SEARCHED.take(), 1);
    }
}
