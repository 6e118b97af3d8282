//! Repairs of a program as edits of its text. Where the meaning is unclear, there is none.

mod centers;

use super::block::{Block, Compensation, Motion, Note, Stop, read_line};
use super::document::Document;
use super::line::words_of_move;
use super::machine::Machine;
use super::moves::{Place, distance, meet, nanometres};
use super::plain::{plain, word_at};
use super::repair::{is_plainly_twice, is_trouble};
use super::style::Style;
use crate::finding::{Detail, Fault, Finding, FixKind, Rule, TextFix};
use crate::geometry::Segment;
use crate::program::numbering::{self, Numbers, Renumbering};
use crate::program::path::{Way, tolerance};
use crate::program::repair::{merged, offered, without_spur};
use crate::text::TextEdit;
use centers::center_fixes;
use std::ops::Range;

impl Document {
    /// The fixes of one finding, the preferred one first: those of its own place, and the slip that may explain it.
    pub(in crate::program) fn offered(
        &self,
        finding: &Finding,
        renumbering: Renumbering,
    ) -> Vec<TextFix> {
        let own = of_place(self, finding, renumbering).unwrap_or_default();
        let searched = searched(self, finding).unwrap_or_default();
        let speaks_for_itself = matches!(finding.rule, Rule::Syntax | Rule::DoubledBlock);
        match speaks_for_itself && !own.is_empty() {
            true => merged(own, searched, false),
            // The place itself names the slip better.
            false => merged(searched, own, true),
        }
    }
}

/// The slips that make the finding's cut sound.
fn searched(document: &Document, finding: &Finding) -> Option<Vec<TextFix>> {
    if finding.rule != Rule::SuspectBlock && !is_trouble(finding) {
        return None;
    }
    let line = document.text().line_of(finding.place.in_text()?.start);
    let mut of_cuts = document.repairs().iter();
    let (_, repairs) = of_cuts.find(|(lines, _)| lines.contains(&line))?;
    let found = repairs
        .iter()
        .map(|repair| Some((repair.kind.clone(), repair.edits.clone(), repair.is_sure)));
    Some(offered(found))
}

/// The fixes of the finding's own place.
fn of_place(
    document: &Document,
    finding: &Finding,
    renumbering: Renumbering,
) -> Option<Vec<TextFix>> {
    let range = finding.place.in_text()?;
    let fault = match &finding.detail {
        Detail::Program(fault) => &**fault,
        Detail::Said(_) => return character_fixes(document, range),
        _ => return None,
    };
    match fault {
        Fault::Bare { .. } => bare_fixes(document, range),
        Fault::OffRadius { .. } => center_fixes(document, range),
        Fault::DoubledNumber { .. } | Fault::Unnumbered { .. } => {
            Some(number_fixes(document, fault, range, renumbering))
        }
        fault => Some(vec![plain_fix(document, fault, range)?]),
    }
}

/// The fix of a fault that has only one.
fn plain_fix(document: &Document, fault: &Fault, range: &Range<usize>) -> Option<TextFix> {
    let text = document.text();
    let line = text.line_of(range.start);
    let line_end = || text.line_end_before(range.end);
    let behind = |word: &str| {
        let end = text.line_range(text.line_of(range.end)).end;
        TextEdit::new(end..end, format!("{}{word}", line_end()))
    };
    let (kind, is_safe, edit) = match fault {
        Fault::ReversedArc { is_sure } => {
            let before = document.machine_before(line).map(|machine| machine.motion);
            let (found, meant, edit) = exchanged_word(document, line, before)?;
            (FixKind::Rewrite { found, meant }, *is_sure, edit)
        }
        Fault::DoubledBlock { .. } => {
            let is_sure = is_plainly_twice(document, line);
            (FixKind::DeleteBlock, is_sure, whole_line(document, line))
        }
        Fault::Spur { .. } => return spur_fix(document, line),
        Fault::NotClosed { .. } => return closing_fix(document, range),
        Fault::NoOffset { .. } => {
            let offset = document.only_offset()?;
            let (found, meant) = (
                String::new(),
                format!("{}{}", offset.letter as char, offset.index),
            );
            let space = if document.is_parted() { " " } else { "" };
            let edit = TextEdit::new(range.end..range.end, format!("{space}{meant}"));
            (FixKind::Rewrite { found, meant }, false, edit)
        }
        Fault::SideChange { .. } | Fault::RoleSide { .. } | Fault::EntrySide { .. } => {
            let word = text.bytes().get(range.clone())?;
            let is_word = word.get(1..)?.iter().all(u8::is_ascii_digit);
            let said = Block::of(word).compensation.filter(|_| is_word);
            let other = match said? {
                Compensation::Left => "G42",
                Compensation::Right => "G41",
                Compensation::Off => return None,
            };
            let edit = TextEdit::new(range.clone(), other);
            (FixKind::SwapSide, false, edit)
        }
        Fault::StillOn => {
            let start = text.line_start(way_out(document, line)?);
            let edit = TextEdit::new(start..start, format!("G40{}", line_end()));
            let block = "G40".into();
            (FixKind::InsertLine { block }, false, edit)
        }
        Fault::NoReturn { .. } => {
            let block = "M99".into();
            (FixKind::InsertLine { block }, true, behind("M99"))
        }
        Fault::MissingEnd { .. } if breaks_off(document, line) => return None,
        Fault::MissingEnd { word } => {
            let edit = match document.block(line).returns {
                true => end_before_subprograms(document, line, word)?,
                false => behind(word),
            };
            (FixKind::AddEnd { word: word.clone() }, true, edit)
        }
        // The rapid on which the correction would go on is cut instead.
        Fault::Switch {
            on: true,
            arc: false,
        } => {
            let edit = TextEdit::new(rapid_word(document, range)?, "G01");
            (FixKind::CutRapid, false, edit)
        }
        Fault::TextAfterEnd { .. } => {
            let edit = TextEdit::new(range.start..text.len(), "");
            (FixKind::DeleteBehindEnd, false, edit)
        }
        _ => return None,
    };
    Some(TextFix::text(kind, is_safe, edit))
}

/// Whether a program whose last words stand in a line was cut short there: that line cannot be read, or the wire stands
/// within a contour, or beside one. The rest is missing, not the end.
fn breaks_off(document: &Document, line: usize) -> bool {
    let mut is_unread = false;
    read_line(document.line_bytes(line), 1, |note| {
        is_unread |= matches!(note, Note::Fault { .. });
    });
    let begun = document.begun_cut_with(line);
    let is_within = || begun.count() > 1 && ![0, 1].iter().any(|node| is_back_at(&begun, *node));
    let machine = document.machine_behind(line);
    let is_amid = |machine: Machine| machine.lost != [false, false] || machine.side.is_some();
    is_unread || machine.is_none_or(is_amid) || is_within()
}

/// The end of a program that runs on into its subprograms, up to the return in `last`: before the first of them that is called.
fn end_before_subprograms(document: &Document, last: usize, word: &str) -> Option<TextEdit> {
    let order = document.order()?;
    let called = order.called.iter();
    let first = called.filter_map(|number| order.labels.get(number)).min()?;
    let start = document.text().line_start(*first);
    (0 < *first && *first <= last).then(|| {
        let line_end = document.text().line_end_before(start);
        TextEdit::new(start..start, format!("{word}{line_end}"))
    })
}

/// Characters that only look like those of a control.
fn character_fixes(document: &Document, range: &Range<usize>) -> Option<Vec<TextFix>> {
    let text = document.text();
    let (kind, edit) = match text.bytes().get(range.clone()) {
        Some([b'O' | b'o', rest @ ..]) => {
            let rest = String::from_utf8_lossy(rest).replace(['O', 'o'], "0");
            let edit = TextEdit::new(range.clone(), format!("0{rest}"));
            (FixKind::ZeroForO, edit)
        }
        Some(b",") => (FixKind::DecimalPoints, TextEdit::new(range.clone(), ".")),
        _ => {
            let line = text.line_of(range.start);
            let plain = String::from_utf8(plain(text.line(line))?).ok()?;
            let edit = TextEdit::new(text.line_range(line), plain);
            (FixKind::PlainLetters, edit)
        }
    };
    Some(vec![TextFix::text(kind, true, edit)])
}

/// G02 for G03 of a line, or the other way round: the present word, the intended one, and the edit.
fn exchanged_word(
    document: &Document,
    line: usize,
    before: Option<Motion>,
) -> Option<(String, String, TextEdit)> {
    let text = document.text();
    let own = document.block(line).motion;
    let stands = own.or(before).filter(|motion| motion.is_arc())?;
    let meant = stands.reversed().word().to_owned();
    if own.is_some() {
        let word = word_at(text, line, |letter, number| {
            letter == b'G' && matches!(number.whole(), Some(2 | 3))
        })?;
        let found = String::from_utf8_lossy(text.bytes().get(word.clone())?).into_owned();
        return Some((found, meant.clone(), TextEdit::new(word, meant)));
    }
    let edit = document.with_word(line, &meant)?;
    Some((String::new(), meant, edit))
}

/// A line with its end.
fn whole_line(document: &Document, line: usize) -> TextEdit {
    TextEdit::new(document.text().whole_line(line), "")
}

/// A spur is removed where it returns to its start.
fn spur_fix(document: &Document, back: usize) -> Option<TextFix> {
    let moves = |line: usize| document.block(line).leads();
    let out = (0..back).rev().take(SPUR_REACH).find(|line| moves(*line))?;
    let (before, behind) = (
        document.machine_before(out)?,
        document.machine_behind(back)?,
    );
    let is_plain = Machine {
        at: behind.at,
        said: behind.said,
        moved: behind.moved,
        ..before
    } == behind;
    if !have_met(before.at, behind.at) || !is_plain {
        return None;
    }
    let shown = |line: usize| {
        let bytes = document.line_bytes(line);
        (line, String::from_utf8_lossy(bytes).trim().to_owned())
    };
    Some(without_spur(document.text(), [out, back].map(shown)))
}

/// Ends of lines this near each other are one.
pub(super) fn have_met(one: Place, other: Place) -> bool {
    meet(one, other, tolerance(0))
}

/// A way ends where one of its nodes is.
fn is_back_at(way: &Way, node: usize) -> bool {
    way.end().is_near(&way.node(node), tolerance(0))
}

/// The way out of a spur is searched for in this many lines before its way back.
const SPUR_REACH: usize = 16;

/// The line before which G40 belongs: the last straight cut before the end, where it leads back to where the cut began.
fn way_out(document: &Document, end: usize) -> Option<usize> {
    let last = (0..end)
        .rev()
        .take(SPUR_REACH)
        .find(|line| document.block(*line).has_coordinates())?;
    let begun = document.begun_cut_with(last);
    let is_line = |piece: &Segment| piece.as_arc().is_none();
    let is_out = begun.pieces().last().is_some_and(is_line) && is_back_at(&begun, 0);
    Some(if is_out { last } else { end })
}

/// A number without its point, read in whole units and in the finest steps.
fn bare_fixes(document: &Document, range: &Range<usize>) -> Option<Vec<TextFix>> {
    let bytes = document.text().slice(range.clone())?;
    let found = String::from_utf8_lossy(bytes).into_owned();
    let at = found.find(|character: char| character.is_ascii_digit())?;
    let (letters, digits) = found.split_at(at);
    let padded = format!("{digits:0>4}");
    let (whole, thousandths) = padded.split_at_checked(padded.len() - 3)?;
    let fine = format!("{letters}{whole}.{thousandths}");
    let fix = |meant: String| {
        let edit = TextEdit::new(range.clone(), meant.clone());
        let found = found.clone();
        TextFix::text(FixKind::Rewrite { found, meant }, false, edit).preferred_if(false)
    };
    Some(vec![fix(fine), fix(format!("{found}."))])
}

/// A straight cut after the last one that leads back to where the cut began, or to where its way in ended.
fn closing_fix(document: &Document, range: &Range<usize>) -> Option<TextFix> {
    let text = document.text();
    let line = text.line_of(range.start);
    let begun = document.begun_cut_with(line);
    let machine = document.machine_behind(line)?;
    let near = |place: Place| distance(machine.at, place);
    let [from, to] = [0, 1].map(|node| nanometres(begun.node(node).machine.coords));
    let target = if begun.count() > 2 && near(to) < near(from) {
        to
    } else {
        from
    };
    if begun.count() == 0
        || machine.lost != [false, false]
        || machine.at == target
        || !goes_on_by_itself(document, line, machine.motion)
    {
        return None;
    }
    let style = Style::of(document, machine.inch);
    let separator = if document.is_parted() { " " } else { "" };
    let words = words_of_move(&machine, &style, Motion::Line, target, None).join(separator);
    // Proved: the line leads there.
    let mut again = machine;
    let made = again.run(&Block::of(words.as_bytes()), document.reading())?;
    if made.to != target || made.motion != Motion::Line {
        return None;
    }
    let behind = text.line_range(line).end;
    let edit = TextEdit::new(
        behind..behind,
        format!("{}{words}", document.text().line_end_before(range.end)),
    );
    let length = near(target) / 1e6;
    Some(TextFix::text(FixKind::Close { length }, false, edit))
}

/// True where the next moving line after `line` has its own G word, or would cut straight anyway.
fn goes_on_by_itself(document: &Document, line: usize, motion: Motion) -> bool {
    let mut behind = (line + 1..document.text().line_count()).map(|line| document.block(line));
    let next = behind
        .find(|block| block.motion.is_some() || block.stop == Some(Stop::End) || block.leads());
    motion == Motion::Line
        || next.is_none_or(|block| block.motion.is_some() || block.stop == Some(Stop::End))
}

/// The number of the block's turn where there is room for it; all blocks renumbered.
fn number_fixes(
    document: &Document,
    fault: &Fault,
    range: &Range<usize>,
    renumbering: Renumbering,
) -> Vec<TextFix> {
    let line = document.text().line_of(range.start);
    let free = |number: u32| !document.labels().contains_key(&number);
    let own = match *fault {
        Fault::Unnumbered { expected } if free(expected) => {
            let edit = document.with_word(line, &format!("N{expected}"));
            edit.map(|edit| (expected, edit))
        }
        Fault::DoubledNumber { number } if !document.calls(number) => {
            let turn = document
                .numbers_before(line)
                .map(|(last, step)| last.saturating_add(step));
            let next = document.number_behind(line);
            let has_room = |turn: &u32| free(*turn) && next.is_none_or(|next| next > *turn);
            let edit = |turn| (turn, TextEdit::new(range.clone(), format!("N{turn}")));
            turn.filter(has_room).map(edit)
        }
        _ => None,
    };
    let all = (renumbering == Renumbering::Offered)
        .then(|| numbering::numbered(document).ok())
        .flatten();
    numbering::fixes(own, all.map(|edits| ([Document::STEP; 2], edits)))
}

/// The G00 of a line.
fn rapid_word(document: &Document, range: &Range<usize>) -> Option<Range<usize>> {
    let text = document.text();
    word_at(text, text.line_of(range.start), |letter, number| {
        letter == b'G' && number.whole() == Some(0)
    })
}
