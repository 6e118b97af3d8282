//! The fixes of one finding.

use super::super::around::StatedPoint;
use super::super::block::{Block, Node};
use super::super::cut::way_of;
use super::super::encode::line_block;
use super::super::entry::{BlockEntry, What};
use super::super::fields::fields_of;
use super::super::layout::{layout_in, push_fields};
use super::super::pieces::{Field, Piece, pieces};
use super::super::rules::position_mismatch::Mismatched;
use super::super::rules::{self, Site, TextFix, missing_end, position_mismatch, text_after_end};
use super::super::words::Word;
use super::sequence::place_before;
use super::{At, Document};
use crate::finding::{Detail, Fault, Finding, FixKind, Rule};
use crate::program::lookalikes::alike;
use crate::program::numbering::{self, Renumbering};
use crate::program::path::{Ends, tolerance};
use crate::program::repair::{merged, without_spur};
use crate::text::TextEdit;
use std::ops::Range;

impl Document {
    /// The fixes of one finding, the preferred one first: explanations of the whole contour before those of the finding
    /// alone.
    pub(in crate::program) fn offered(
        &self,
        finding: &Finding,
        renumbering: Renumbering,
    ) -> Vec<TextFix> {
        let mut own = self.fixes_of(finding, renumbering).unwrap_or_default();
        let of_contour = self.contour_fixes(finding);
        let cuts = || self.contour_at(self.entry_at(finding.place.in_text()?)?);
        let is_searched = of_contour.is_some() && is_about_numbers(finding.rule);
        if is_searched && cuts().is_some_and(|cuts| self.block_count(&cuts) >= FEWEST_THAT_CLOSE) {
            // Which of them is wrong is for the search to say.
            let is_way = |fix: &&mut TextFix| !matches!(fix.kind, FixKind::SetCoordinates { .. });
            own.iter_mut()
                .filter(is_way)
                .for_each(|fix| (fix.preferred, fix.in_fix_all) = (false, false));
        }
        merged(of_contour.unwrap_or_default(), own, false)
    }

    fn fixes_of(&self, finding: &Finding, renumbering: Renumbering) -> Option<Vec<TextFix>> {
        let range = finding.place.in_text()?;
        let fault = match &finding.detail {
            Detail::Program(fault) => fault,
            Detail::Said(_) => return self.letter_fixes(range),
            _ => return None,
        };
        match &**fault {
            Fault::MissingEnd { word } => {
                // Of a contour that is not whole the rest is missing, not the end.
                let (at, _) = self.block_at(range)?;
                let is_whole = self.closes(&self.contour_at(at)?);
                is_whole.then(|| missing_end::fixes(&self.text, range.end, word))
            }
            Fault::TextAfterEnd { .. } => {
                let end = self.view.end?;
                let mut behind = self.from(end).skip(1);
                let ends_again = behind.any(|(_, entry)| entry.block().is_some())
                    && behind.any(|(_, entry)| {
                        matches!(
                            entry.what,
                            What::Word {
                                word: Word::End,
                                is_own: true
                            }
                        )
                    });
                Some(text_after_end::fixes(
                    &self.text,
                    self.range_of(end),
                    ends_again,
                ))
            }
            Fault::NotClosed { .. } => self.closing_fixes(range),
            Fault::DoubledNumber { .. }
            | Fault::NumberOutOfOrder { .. }
            | Fault::Unnumbered { .. } => self.number_fixes(range, renumbering),
            Fault::PositionMismatch { .. } => self.position_fixes(range),
            Fault::Spur { .. } => self.spur_fixes(range),
            fault => self.block_fixes(range, fault),
        }
    }

    fn position_fixes(&self, range: &Range<usize>) -> Option<Vec<TextFix>> {
        let (at, entry) = self.block_at(range)?;
        let own = self.range_of(at);
        let stated = entry.stated_end()?;
        let before = self.stated_before(at)?;
        let next = self
            .next_block(at)
            .and_then(|(_, next)| Some((next.stated_end()?, next.travel())));
        let goes_on =
            next.map(|(end, travel)| position_mismatch::mismatch(&stated, &travel, &end).is_none());
        let line = self.text.line_range(self.text.line_of(own.start));
        let is_behind = |piece: &&Piece| {
            piece.field == Field::Coordinates && line.start + piece.range.start >= own.end
        };
        let pieces = pieces(self.text.bytes().get(line.clone())?, &self.words());
        let coordinates = pieces
            .iter()
            .find(is_behind)
            .map(|piece| line.start + piece.range.start..line.start + piece.range.end)?;
        let cuts = self.contour_at(at)?;
        Some(position_mismatch::fixes(&Mismatched {
            text: self.text.bytes(),
            block: entry.block(),
            coordinates,
            before,
            goes_on,
            closes: self.closes(&cuts),
        }))
    }

    /// Where a block begins by the coordinates: those after the block before, or those of the start, or where the
    /// wire was taken.
    pub(super) fn stated_begin(&self, at: At) -> Option<StatedPoint> {
        if self.taken_before(at).is_some() {
            let block = self.entry(at)?.block()?;
            return Some(place_before(&block.stated_end()?, &block.travel()));
        }
        self.stated_before(at)
    }

    /// The coordinates that stand after the block before, or those of the start.
    pub(super) fn stated_before(&self, at: At) -> Option<StatedPoint> {
        self.before(at).find_map(|(_, entry)| match &entry.what {
            What::Block(block) => Some(block.stated_end()),
            What::StartPoint(at) => Some(Some(StatedPoint {
                at: *at,
                decimals: 3,
            })),
            What::Unread => Some(None),
            What::Word { .. } | What::Text { .. } | What::CommentedBlock { .. } => None,
        })?
    }

    pub(super) fn next_block(&self, at: At) -> Option<(At, &BlockEntry)> {
        let mut behind = self.from(at).skip(1);
        behind.find_map(|(at, entry)| Some((at, entry.block()?)))
    }

    fn block_fixes(&self, range: &Range<usize>, fault: &Fault) -> Option<Vec<TextFix>> {
        let (at, entry) = self.block_at(range)?;
        let own = self.range_of(at);
        // A number that stands before the block belongs to it.
        let block = if matches!(fault, Fault::BlockNumberAsB { .. }) {
            range.clone()
        } else {
            own.clone()
        };
        let fields = fields_of(self.text.bytes(), own)?;
        let line = self.text.line_of(block.start);
        let site = Site {
            text: self.text.bytes(),
            range: if matches!(fault, Fault::MissingB) {
                range.clone()
            } else {
                block
            },
            line: self.text.whole_line(line),
            fields,
            block: entry.block(),
            largest: self.largest(),
            closes_with: &|blocks| self.closes_with(at, blocks),
        };
        Some(rules::fixes(&site, fault))
    }

    /// Whether the contour of a block closes with other blocks in its place.
    fn closes_with(&self, at: At, blocks: &[Block]) -> bool {
        let Some(cuts) = self.contour_at(at) else {
            return false;
        };
        let all: Vec<At> = self.blocks_of(&cuts).collect();
        let own = |own: &At| Some(self.entry(*own)?.block()?.block());
        let made = all.iter().flat_map(|other| match *other == at {
            true => blocks.to_vec(),
            false => own(other).into_iter().collect(),
        });
        all.len() >= 3 && Ends::of(&way_of(made).0).close()
    }

    /// A way out and back goes, where it returns to its start.
    fn spur_fixes(&self, range: &Range<usize>) -> Option<Vec<TextFix>> {
        let (back, own) = self.block_at(range)?;
        let mut before = self.before(back);
        let (out, before) = before.find_map(|(at, entry)| Some((at, entry.block()?)))?;
        let both = before.travel().plus(own.travel());
        let line_of = |at: At| self.text.line_of(self.range_of(at).start);
        for at in [out, back] {
            let entries = self.entries_in(at.cut).iter();
            let line = self.entry(at)?.line;
            if entries.filter(|entry| entry.line == line).count() > 1 {
                return None;
            }
        }
        let shown = |at: At| {
            let own = self.text.bytes().get(self.range_of(at)).unwrap_or_default();
            (line_of(at), String::from_utf8_lossy(own).into_owned())
        };
        both.is_within(tolerance(0))
            .then(|| vec![without_spur(&self.text, [out, back].map(shown))])
    }

    /// A straight block that closes the contour.
    fn closing_fixes(&self, range: &Range<usize>) -> Option<Vec<TextFix>> {
        let (at, _) = self.block_at(range)?;
        let Fault::NotClosed { x, y } = self.ends_of(&self.contour_at(at)?).not_closed() else {
            return None;
        };
        let [x, y] = [-x, -y].map(|um| um.round() as i64);
        let largest = self.largest();
        if x.abs().max(y.abs()) > largest || (x, y) == (0, 0) {
            return None;
        }
        let block = line_block(Node { x: 0, y: 0 }, Node { x, y });
        let own = self.text.bytes().get(range.clone()).unwrap_or_default();
        let layout = layout_in(own);
        let mut text = self.text.line_end(0).as_bytes().to_vec();
        if let Some(number) = self.number_behind(at) {
            text.extend_from_slice(format!("N{number} ").as_bytes());
        }
        push_fields(&mut text, layout, &block, None);
        let behind = self.text.line_range(self.text.line_of(range.start)).end;
        let text = String::from_utf8(text).ok()?;
        let length = (x as f64).hypot(y as f64) / 1000.0;
        let edit = vec![TextEdit::new(behind..behind, text)];
        Some(vec![TextFix::text(FixKind::Close { length }, false, edit)])
    }

    /// The number of a block after another one, where the two before it are numbered.
    fn number_behind(&self, at: At) -> Option<u32> {
        let own = self.entry(at)?.number()?;
        let before = self
            .before(at)
            .map(|(_, entry)| entry)
            .find(|entry| entry.block().is_some());
        own.checked_add(numbering::step(before?.number()?, own)?)
    }

    fn number_fixes(&self, range: &Range<usize>, renumbering: Renumbering) -> Option<Vec<TextFix>> {
        let own = self.entry_at(range);
        let at = own.filter(|at| self.range_of(*at) == *range)?;
        let meant = *self.view.faulty_numbers.get(&at)?;
        // Where the number of an unreadable block stands is not known: digits before what is wrong with it may be those of X.
        let edit = |at: At, number: u32| {
            let is_read = self.entry(at)?.what != What::Unread;
            is_read
                .then(|| self.with_number(self.digits_before(at), self.range_of(at).start, number))
        };
        let own = meant.and_then(|meant| Some((meant, edit(at, meant)?)));
        if renumbering == Renumbering::LeftOut {
            return Some(numbering::fixes(own, None));
        }
        let (places, blocks) = self.numbered(self.view.end);
        let mut numbers = blocks.iter().filter_map(|block| block.number);
        let all = numbers.next().zip(numbers.next());
        let all = all.and_then(|(first, second)| {
            let step = second.saturating_sub(first).max(1);
            let mut edits = Vec::new();
            for (index, at) in places.iter().enumerate() {
                let turn = step.saturating_mul(u32::try_from(index).ok()?);
                let (own, number) = (self.entry(*at)?.number(), first.saturating_add(turn));
                if own == Some(number) {
                    continue;
                }
                match edit(*at, number) {
                    // One that stays as it is would be in the way.
                    None if own.is_some() => return None,
                    of_block => edits.extend(of_block),
                }
            }
            Some(([first, step], edits))
        });
        Some(numbering::fixes(own, all))
    }

    /// The digits of the number that a block or word has.
    pub(super) fn digits_before(&self, at: At) -> Option<Range<usize>> {
        self.entry(at)?.number()?;
        let own = self.range_of(at).start;
        let line = self.text.line_start(self.text.line_of(own));
        let before = self.text.bytes().get(line..own)?;
        let end = before.iter().rposition(u8::is_ascii_digit)? + 1;
        let digits = before.iter().take(end).rev();
        let count = digits.take_while(|byte| byte.is_ascii_digit()).count();
        Some(line + end - count..line + end)
    }

    fn letter_fixes(&self, range: &Range<usize>) -> Option<Vec<TextFix>> {
        let bytes = self.text.slice(range.clone())?;
        let fix = |kind, edit| Some(vec![TextFix::text(kind, true, edit)]);
        if let b"O" | b"o" = bytes {
            return fix(FixKind::ZeroForO, vec![TextEdit::new(range.clone(), "0")]);
        }
        let plain = |at: usize, length: usize, plain: char| {
            let start = range.start + at;
            TextEdit::new(start..start + length, plain)
        };
        let alike = alike(bytes);
        if alike.iter().any(|found| found.likeness.is_letter()) {
            let letters = alike.iter();
            let letters = letters.map(|it| plain(it.at, it.length, it.likeness.ascii().into()));
            return fix(FixKind::PlainLetters, letters.collect());
        }
        let commas: Vec<TextEdit> = decimal_commas(bytes).map(|at| plain(at, 1, '.')).collect();
        (commas.len() == 2).then(|| fix(FixKind::DecimalPoints, commas))?
    }
}

/// Fewer blocks are a way from one contour to the next.
const FEWEST_THAT_CLOSE: usize = 3;

/// Whether a rule finds numbers of a block that contradict each other.
fn is_about_numbers(rule: Rule) -> bool {
    matches!(
        rule,
        Rule::WrongJ | Rule::JOverTurn | Rule::WrongCountingAxis | Rule::PositionMismatch
    )
}

/// The commas of coordinates that stand between two digits.
fn decimal_commas(text: &[u8]) -> impl Iterator<Item = usize> + '_ {
    let is_digit = |at: Option<usize>| {
        at.and_then(|at| text.get(at))
            .is_some_and(u8::is_ascii_digit)
    };
    memchr::memchr_iter(b',', text)
        .filter(move |&at| is_digit(at.checked_sub(1)) && is_digit(Some(at + 1)))
}
