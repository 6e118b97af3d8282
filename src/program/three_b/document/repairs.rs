//! Repairs of a contour as edits of the text.

use super::super::around::{StatedPoint, before_comment, two_numbers};
use super::super::entry::{Entry, What, travel_of};
use super::super::fields::fields_of;
use super::super::layout::{
    layout_in, number_edit, push_end_point, push_fields, push_to_comment_column,
};
use super::super::repair::{
    BLOCKS, Change, Loose, Repair, Slip, Suspect, Written, loose, piece_of, stated,
};
use super::super::rules::{TextFix, kind_of};
use super::contours::OneContour;
use super::{At, Document};
use crate::finding::{Finding, FixKind, Rule, Severity};
use crate::program::grid::Node;
use crate::program::repair::cut::{Piece, Pieces};
use crate::program::repair::offered;
use crate::program::repair::rule::search;
use crate::program::three_b::block::Block;
use crate::text::TextEdit;
use std::ops::Range;

impl Document {
    /// The repairs of the contour with a finding, the most likely one first.
    pub(super) fn contour_fixes(&self, finding: &Finding) -> Option<Vec<TextFix>> {
        let range = finding.place.in_text()?;
        let contour = self.contour_at(self.entry_at(range)?)?;
        let is_of_way = matches!(
            finding.rule,
            Rule::NotClosed
                | Rule::PathCrossesItself
                | Rule::Spur
                | Rule::ReversedArc
                | Rule::DoubledBlock
                | Rule::SuspectBlock
                | Rule::BlockNumber
                | Rule::PositionMismatch
        );
        // Of a sound contour that closes a block may be unusual, and nothing is to be repaired.
        let is_of_block = matches!(
            finding.rule,
            Rule::WrongJ
                | Rule::LengthInJ
                | Rule::JOverTurn
                | Rule::WrongCountingAxis
                | Rule::WrongQuadrant
                | Rule::Syntax
                | Rule::MissingB
                | Rule::ZeroBlock
                | Rule::ArcWithoutRadius
                | Rule::ArcOffRadius
                | Rule::TooManyDigits
        ) && finding.severity < Severity::Information;
        if !is_of_way && !is_of_block {
            return None;
        }
        let found = self.found(&contour);
        let cuts = found.cuts(&contour);
        let (places, pieces) = self.pieces_of(&cuts)?;
        let fixes = found.repairs.iter().map(|repair| {
            let (kind, mut edit) =
                self.edit_of(&repair.change, &places, &pieces, self.is_jump(cuts.start))?;
            edit.sort_by_key(|edit| edit.range.start);
            Some((kind, edit, repair.is_sure))
        });
        Some(offered(fixes))
    }

    /// The repairs of a cut.
    pub(super) fn repairs(&self, cut: &OneContour) -> Vec<Repair> {
        let Some((places, blocks)) = self.pieces_of(cut) else {
            return Vec::new();
        };
        let first = places.first().copied();
        let around = Pieces {
            start: first.and_then(|first| self.stated_begin(first)).map(stated),
            number: first.and_then(|first| self.number_before(first)),
            step: self.view.numbers.step,
            closes: !self.is_jump(cut.start),
            others: self.beside(&places),
            ..Pieces::default()
        };
        let is_closed = self.closes(cut) && self.unread(cut) == 0;
        search(&Suspect::of(&blocks, around, is_closed, &self.settings))
    }

    /// The pieces of the cuts before and after some blocks, perhaps their other passes: those that they follow, and those
    /// beyond a way between two contours.
    fn beside(&self, places: &[At]) -> Vec<Vec<Piece>> {
        let (Some(first), Some(last)) = (places.first(), places.last()) else {
            return Vec::new();
        };
        let mut before = cuts_of(self.before(*first));
        before.iter_mut().for_each(|blocks| blocks.reverse());
        before.extend(cuts_of(self.from(*last).skip(1)));
        before
    }

    /// The blocks of a contour, including unreadable ones; `None` where there are too few or too many.
    fn pieces_of(&self, cut: &OneContour) -> Option<(Vec<At>, Vec<Written>)> {
        if !BLOCKS.contains(&(self.block_count(cut) + self.unread(cut))) {
            return None;
        }
        let (mut places, mut pieces) = (Vec::new(), Vec::new());
        for at in self.entries_of(cut) {
            let entry = self.entry(at)?;
            let own = self.range_of(at);
            let piece = match &entry.what {
                What::Block(block) => {
                    let fields = fields_of(self.text.bytes(), own.clone())?;
                    let digits = |range: &Range<usize>| {
                        let digits = self.text.bytes().get(range.clone()).unwrap_or_default();
                        String::from_utf8_lossy(digits).into_owned()
                    };
                    Written {
                        block: Some(block.block()),
                        part: block.part(),
                        loose: None,
                        digits: [&fields.x, &fields.y, &fields.j].map(digits),
                        number: entry.number(),
                        stated: block.stated_end(),
                    }
                }
                What::Unread => {
                    let line = self.text.line_range(self.text.line_of(own.start));
                    let text = self.text.bytes().get(line).unwrap_or_default();
                    let behind = text
                        .iter()
                        .position(|byte| *byte == b';')
                        .and_then(|at| two_numbers(before_comment(&text[at + 1..])));
                    Written {
                        stated: behind.map(|at| StatedPoint { at, decimals: 3 }),
                        number: entry.number(),
                        loose: loose(before_comment(text)),
                        ..Written::default()
                    }
                }
                _ => continue,
            };
            places.push(at);
            pieces.push(piece);
        }
        Some((places, pieces))
    }

    fn edit_of(
        &self,
        change: &Change,
        places: &[At],
        pieces: &[Written],
        is_jump: bool,
    ) -> Option<(FixKind, Vec<TextEdit>)> {
        let text = self.text.bytes();
        let own = |index: usize| Some(self.range_of(*places.get(index)?));
        let line = |index: usize| Some(self.text.line_of(own(index)?.start));
        let is_alone = |index: usize| {
            let own_line = line(index)?;
            let is_other =
                |other: Option<usize>| other.and_then(line).is_none_or(|line| line != own_line);
            Some(is_other(index.checked_sub(1)) && is_other(index.checked_add(1)))
        };
        match change {
            Change::Replace {
                index,
                meant: (block, slip),
            } => {
                let Some(old) = pieces.get(*index)?.block else {
                    return self.restoration(own(*index)?, pieces[*index].loose.as_ref()?, block);
                };
                let fields = fields_of(text, own(*index)?)?;
                let kind = match slip {
                    Slip::Coordinates => FixKind::FollowCoordinates,
                    _ => kind_of(&old, block),
                };
                Some((kind, fields.changed(text, &old, block)))
            }
            Change::Delete { index } => {
                let range = match is_alone(*index)? {
                    true => self.text.whole_line(line(*index)?),
                    false => own(*index)?,
                };
                Some((FixKind::DeleteTwin, vec![TextEdit::new(range, "")]))
            }
            Change::Exchange { index } => {
                let mut ranges = [own(*index)?, own(index + 1)?];
                // With the rest of their lines, where each has a line to itself.
                if is_alone(*index)? && is_alone(index + 1)? {
                    ranges =
                        [line(*index)?, line(index + 1)?].map(|line| self.text.line_range(line));
                }
                let [one, other] = ranges;
                let taken = |range: &Range<usize>| {
                    Some(
                        std::str::from_utf8(text.get(range.clone())?)
                            .ok()?
                            .to_owned(),
                    )
                };
                let edits = vec![
                    TextEdit::new(one.clone(), taken(&other)?),
                    TextEdit::new(other, taken(&one)?),
                ];
                Some((FixKind::ExchangeBlocks, edits))
            }
            Change::Insert {
                index,
                meant: (block, _),
            } => self.insertion(*index, block, places, pieces, is_jump),
        }
    }

    /// A block that replaces the remains of one.
    fn restoration(
        &self,
        own: Range<usize>,
        loose: &Loose,
        block: &Block,
    ) -> Option<(FixKind, Vec<TextEdit>)> {
        let start = self.text.line_start(self.text.line_of(own.start));
        let range = start + loose.range.start..start + loose.range.end;
        let found = self.text.bytes().get(range.clone())?;
        let mut made = Vec::new();
        push_fields(&mut made, layout_in(found), block, None);
        if found.iter().all(|byte| !byte.is_ascii_uppercase()) {
            made.make_ascii_lowercase();
        }
        let made = String::from_utf8(made).ok()?;
        let block = made.clone();
        Some((
            FixKind::RestoreBlock { block },
            vec![TextEdit::new(range, made)],
        ))
    }

    /// A new line in the style of its neighbour.
    fn insertion(
        &self,
        index: usize,
        block: &Block,
        places: &[At],
        pieces: &[Written],
        is_jump: bool,
    ) -> Option<(FixKind, Vec<TextEdit>)> {
        let text = self.text.bytes();
        let model = index.saturating_sub(1);
        let own = self.range_of(*places.get(model)?);
        let line = self.text.line_range(self.text.line_of(own.start));
        let item = |index: usize| pieces.get(index);
        let mut made = Vec::new();
        let first = || self.number_before(*places.first()?);
        let number = item(model)
            .and_then(|item| item.number)
            .zip(self.view.numbers.step)
            .map(|(own, step)| match index {
                0 => first().map_or(own.saturating_sub(step), |last| {
                    last.saturating_add(step).min(own)
                }),
                _ => own.saturating_add(step),
            });
        if let Some(number) = number
            && let Some(digits) = self.digits_before(*places.get(model)?)
        {
            let edit = number_edit(text, digits, number);
            made.extend_from_slice(text.get(line.start..edit.range.start)?);
            made.extend_from_slice(edit.text.as_bytes());
            made.extend_from_slice(text.get(edit.range.end..own.start)?);
        }
        let layout = layout_in(text.get(own.clone())?);
        push_fields(&mut made, layout, block, None);
        let before = match index.checked_sub(1) {
            Some(before) => item(before).and_then(|item| item.stated),
            None => places.first().and_then(|first| self.stated_begin(*first)),
        };
        let is_stated = item(model).is_some_and(|item| item.stated.is_some());
        let [x, y] = travel_of(block).meant_um();
        if let Some(before) = before.filter(|_| is_stated) {
            let um = |mm: f64, by: f64| (mm * 1000.0 + by).round() as i64;
            push_to_comment_column(&mut made, block);
            let (x, y) = (um(before.at[0], x), um(before.at[1], y));
            push_end_point(&mut made, Node { x, y });
        }
        let made = String::from_utf8(made).ok()?;
        let line_end = self.text.line_end(0);
        let edit = match index {
            0 => {
                // The way to the stop before a jump was cut.
                let stop = places
                    .first()
                    .and_then(|first| self.before(*first).next())
                    .filter(|(_, entry)| is_jump && matches!(entry.what, What::Word { .. }))
                    .map(|(at, _)| self.range_of(at).start);
                let place = self
                    .text
                    .line_start(self.text.line_of(stop.unwrap_or(line.start)));
                TextEdit::new(place..place, format!("{made}{line_end}"))
            }
            _ => TextEdit::new(line.end..line.end, format!("{line_end}{made}")),
        };
        let (length, is_arc) = (x.hypot(y) / 1000.0, !block.motion.is_line());
        Some((FixKind::InsertBlock { length, is_arc }, vec![edit]))
    }
}

/// How many words on from a cut others are looked at that may be its passes, or have leads like it.
const WORDS_BESIDE: usize = 3;

/// The blocks between the next word and the one after it, and so on; none of a cut where a block cannot be read.
fn cuts_of<'a>(entries: impl Iterator<Item = (At, &'a Entry)>) -> Vec<Vec<Piece>> {
    let mut cuts: Vec<Option<Vec<Piece>>> = Vec::new();
    for (_, entry) in entries {
        if let What::Word { .. } = entry.what {
            if cuts.len() == WORDS_BESIDE {
                break;
            }
            cuts.push(Some(Vec::new()));
            continue;
        }
        let Some(cut) = cuts.last_mut() else {
            continue;
        };
        match (&entry.what, &mut *cut) {
            (What::Block(block), Some(blocks)) if blocks.len() < *BLOCKS.end() => {
                blocks.push(piece_of(&block.block()));
            }
            (What::Block(_) | What::Unread, _) => *cut = None,
            _ => {}
        }
    }
    cuts.into_iter().flatten().collect()
}
