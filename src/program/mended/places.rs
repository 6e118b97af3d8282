//! Where findings stand, and where they stand after edits.

use crate::finding::{Finding, Place, Rule};
use crate::text::TextEdit;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Findings of one rule that are looked at around a place. Those of one rule hardly overlap.
const NEARBY: usize = 4;

/// The ranges of findings, by rule, in the order of the text.
#[derive(Default)]
pub(super) struct Ranges(FxHashMap<Rule, Vec<Range<usize>>>);

impl Ranges {
    /// Those of findings, each range as it is `placed`.
    pub(super) fn of<'a>(
        findings: impl IntoIterator<Item = &'a Finding>,
        placed: impl Fn(&Range<usize>) -> Range<usize>,
    ) -> Ranges {
        let mut ranges = Ranges::default();
        for finding in findings {
            if let Place::Text { range } = &finding.place {
                let of_rule = ranges.0.entry(finding.rule).or_default();
                of_rule.push(placed(range));
            }
        }
        let sort = |all: &mut Vec<Range<usize>>| all.sort_unstable_by_key(|it| (it.start, it.end));
        ranges.0.values_mut().for_each(sort);
        ranges
    }

    pub(super) fn has(&self, rule: Rule, range: &Range<usize>) -> bool {
        let key = (range.start, range.end);
        self.0.get(&rule).is_some_and(|all| {
            all.binary_search_by_key(&key, |it| (it.start, it.end))
                .is_ok()
        })
    }

    /// True where a finding of this rule stands in or at `range`, other than those of `known`.
    pub(super) fn has_at(&self, rule: Rule, range: &Range<usize>, known: &Ranges) -> bool {
        let Some(all) = self.0.get(&rule) else {
            return false;
        };
        let end = all.partition_point(|own| own.start <= range.end);
        let nearby = all.get(..end).unwrap_or_default().iter().rev().take(NEARBY);
        let mut own = nearby.filter(|own| own.end >= range.start);
        own.any(|own| !known.has(rule, own))
    }
}

/// Where edits leave a place of the text before them. The edits are sorted and disjoint.
pub(super) struct Moved<'a> {
    edits: &'a [TextEdit],
    /// By how many bytes what stands behind each edit is moved.
    by: Vec<isize>,
}

impl Moved<'_> {
    pub(super) fn by(edits: &[TextEdit]) -> Moved<'_> {
        let mut sum = 0;
        let by = edits.iter().map(|edit| {
            sum += edit.text.len() as isize - edit.range.len() as isize;
            sum
        });
        let by = by.collect();
        Moved { edits, by }
    }

    /// The range with all that is put in at its ends.
    pub(super) fn range(&self, range: &Range<usize>) -> Range<usize> {
        // What is put in at its very beginning or end counts to it, what is replaced beside it does not.
        let before = self.edits.partition_point(|edit| {
            let own = &edit.range;
            own.end < range.start || (own.end == range.start && !own.is_empty())
        });
        let through = self.edits.partition_point(|edit| {
            let own = &edit.range;
            own.start < range.end || (own.start == range.end && own.is_empty())
        });
        let sum = |count: usize| match count {
            0 => 0,
            count => self.by.get(count - 1).copied().unwrap_or_default(),
        };
        // An edit that reaches into the range begins it.
        let start = match self.edits.get(before) {
            Some(edit) if edit.range.start < range.start => edit.range.start,
            _ => range.start,
        };
        let reached = through.checked_sub(1).and_then(|at| self.edits.get(at));
        let end = reached.map_or(range.end, |edit| edit.range.end.max(range.end));
        start.saturating_add_signed(sum(before))..end.saturating_add_signed(sum(through))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_moves_with_what_is_put_in_before_it() {
        let edit = |range: Range<usize>, text: &str| TextEdit::new(range, text);
        let edits = [edit(2..4, "abcd"), edit(10..10, "xy"), edit(20..22, "")];
        let moved = Moved::by(&edits);
        for (range, expected) in [
            (0..1, 0..1),
            (0..2, 0..2),
            (3..5, 2..7),
            (4..6, 6..8),
            (10..12, 12..16),
            (8..10, 10..14),
            (11..12, 15..16),
            (20..22, 24..24),
            (30..31, 32..33),
        ] {
            assert_eq!(moved.range(&range), expected, "{range:?}");
        }
    }
}
