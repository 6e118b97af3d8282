//! Repairs of a program as edits of its text. Where it is not clear what was meant, none is offered.

use super::block::{Motion, Stop, read_line, word_range};
use super::document::Document;
use super::layout::is_parted;
use super::machine::{Bend, CenterRule, Move, Place, distance, micrometres};
use super::order::labels;
use super::refactor::{Bent, Target, line_to, numbered, with_word};
use super::style::Style;
use crate::finding::{CenterFix, Detail, Finding, Fix, FixKind, IsoFault, Place as Where};
use crate::geometry::Arc;
use crate::program::grid::{best_center, snap};
use crate::text::TextEdit;
use std::ops::Range;

/// The fixes of one finding, the preferred one first.
pub(super) fn fixes(document: &Document, finding: &Finding) -> Vec<Fix<Vec<TextEdit>>> {
    let (Detail::Iso(fault), Where::Text { range }) = (&finding.detail, &finding.place) else { return Vec::new() };
    let fix = |kind: FixKind, in_fix_all: bool, edits: Vec<TextEdit>| Fix { kind, preferred: true, in_fix_all, edit: edits };
    match fault {
        IsoFault::NoEnd { word } => {
            let end = document.text().line_range(document.text().line_of(range.end)).end;
            let text = format!("{}{word}", line_end(document, range.end));
            vec![fix(FixKind::AddEnd { word: word.clone() }, true, vec![TextEdit { range: end..end, text }])]
        }
        IsoFault::Switch { on: true, arc: false } => {
            // The rapid that the correction would go on with is cut instead.
            let Some(word) = rapid_word(document, range) else { return Vec::new() };
            vec![fix(FixKind::CutRapid, false, vec![TextEdit { range: word, text: "G01".into() }])]
        }
        IsoFault::RoleSide { .. } | IsoFault::EntrySide { .. } => {
            let bytes = document.text().bytes().get(range.clone()).unwrap_or_default();
            let other = match read_line(bytes, 0, |_| {}).compensation {
                Some(super::block::Compensation::Left) => "G42",
                Some(super::block::Compensation::Right) => "G41",
                _ => return Vec::new(),
            };
            vec![fix(FixKind::SwapSide, false, vec![TextEdit { range: range.clone(), text: other.into() }])]
        }
        IsoFault::OffRadius { .. } => center_fixes(document, range),
        IsoFault::NotClosed { .. } => closing_fix(document, range).into_iter().collect(),
        IsoFault::NumberTwice { .. } | IsoFault::Unnumbered { .. } => number_fixes(document, fault, range),
        IsoFault::BehindEnd => {
            let end = document.text().len();
            vec![fix(FixKind::DeleteBehindEnd, false, vec![TextEdit { range: range.start..end, text: String::new() }])]
        }
        _ => Vec::new(),
    }
}

/// Centres that the ends of an arc fit: where another convention, a lost sign or a swap of I and J leads, else the nearest one.
fn center_fixes(document: &Document, range: &Range<usize>) -> Vec<Fix<Vec<TextEdit>>> {
    let text = document.text();
    let line = text.line_of(range.start);
    let Some(before) = document.machine_before(line) else { return Vec::new() };
    let bytes = text.bytes().get(text.line_range(line)).unwrap_or_default();
    let (mut machine, reading) = (before, document.reading());
    let Some(made) = machine.run(&read_line(bytes, 1, |_| {}), reading) else { return Vec::new() };
    let Bend::Center { i, j, absolute } = made.bend else { return Vec::new() };
    let rule = reading.rule(made.incremental);
    let own = made.center(rule);
    let mut centers: Vec<(Place, CenterFix)> = Vec::new();
    for other in [CenterRule::StartToCenter, CenterRule::CenterToStart, CenterRule::Absolute] {
        if other != rule && !(made.incremental && other == CenterRule::Absolute) {
            centers.extend(made.center(other).map(|center| (center, CenterFix::OtherConvention)));
        }
    }
    // As from the point that I and J count from.
    let about = match rule {
        CenterRule::StartToCenter | CenterRule::CenterToStart => made.from,
        CenterRule::Absolute => [absolute[0].wrapping_sub(i), absolute[1].wrapping_sub(j)],
    };
    let sign = if rule == CenterRule::CenterToStart { -1 } else { 1 };
    let at = |i: i64, j: i64| [about[0].wrapping_add(i.wrapping_mul(sign)), about[1].wrapping_add(j.wrapping_mul(sign))];
    centers.extend([(-i, j), (i, -j), (-i, -j)].map(|(i, j)| (at(i, j), CenterFix::Sign)));
    centers.extend([(j, i), (-j, i), (j, -i), (-j, -i)].map(|(i, j)| (at(i, j), CenterFix::Swap)));
    let fits = |center: Place| (distance(made.from, center) - distance(made.to, center)).abs() <= reading.tolerance as f64;
    centers.retain(|(center, _)| fits(*center));
    let nearest = own.and_then(|own| nearest_center(document, &made, own, machine.inch));
    centers.extend(nearest.map(|(center, moved)| (center, CenterFix::Nearest { moved })));
    let mut fixes: Vec<Fix<Vec<TextEdit>>> = Vec::new();
    let mut seen: Vec<Place> = own.into_iter().collect();
    for (center, how) in centers {
        if seen.contains(&center) {
            continue;
        }
        seen.push(center);
        let target = Target { bend: Bent::Center(center), ..Target::of(&made, reading) };
        let Some(edit) = line_to(document, line, &before, &target) else { continue };
        let radius = distance(made.from, center) / 1e6;
        let kind = FixKind::SetCenter { radius, how };
        fixes.push(Fix { kind, preferred: fixes.is_empty(), in_fix_all: false, edit: vec![edit] });
    }
    fixes
}

/// The centre that is as far from both ends and nearest to the one that stands, and how far from it, mm.
fn nearest_center(document: &Document, made: &Move, own: Place, inch: bool) -> Option<(Place, f64)> {
    let step = Style::of(document, inch).step();
    let scale = 1e3 / step as f64;
    let [from, to, center] = [made.from, made.to, own].map(|place| micrometres(place) * scale);
    let along = (to - from).try_normalize(0.0)?;
    let on_line = center - along * (center - (from + (to - from) / 2.0)).dot(&along);
    let node = best_center(&Arc::about(on_line, from, to, true), snap(from)?, snap(to)?);
    let place = [node.x.checked_mul(step)?, node.y.checked_mul(step)?];
    let moved = distance(place, own);
    // Beyond that it is another arc, not a slip.
    (moved <= distance(place, made.from)).then_some((place, moved / 1e6))
}

/// A straight cut behind the last one that leads back to where the cut began, or to where its way in ended.
fn closing_fix(document: &Document, range: &Range<usize>) -> Option<Fix<Vec<TextEdit>>> {
    let text = document.text();
    let line = text.line_of(range.start);
    let begun = document.begun_cut_with(line)?;
    let machine = document.machine_behind(line)?;
    let near = |place: Place| distance(machine.at, place);
    let target = if begun.moves > 2 && near(begun.to) < near(begun.from) { begun.to } else { begun.from };
    if machine.lost != [false, false] || machine.at == target || !goes_on_by_itself(document, line, machine.motion) {
        return None;
    }
    let style = Style::of(document, machine.inch);
    let base = if machine.incremental { machine.at } else { machine.zero };
    let [x, y] = [0, 1].map(|axis| style.number(target[axis].wrapping_sub(base[axis])));
    let separator = if is_parted(text) { " " } else { "" };
    let words = ["G01".to_owned(), format!("X{x}"), format!("Y{y}")].join(separator);
    // Proved: the line leads there.
    let mut again = machine;
    let made = again.run(&read_line(words.as_bytes(), 1, |_| {}), document.reading())?;
    if made.to != target || made.motion != Motion::Line {
        return None;
    }
    let behind = text.line_range(line).end;
    let edit = TextEdit { range: behind..behind, text: format!("{}{words}", line_end(document, range.end)) };
    let length = near(target) / 1e6;
    Some(Fix { kind: FixKind::Close { length }, preferred: true, in_fix_all: false, edit: vec![edit] })
}

/// True where the line behind `line` that moves next says itself how, or would cut straight anyway.
fn goes_on_by_itself(document: &Document, line: usize, motion: Motion) -> bool {
    let text = document.text();
    let block = |line: usize| read_line(text.bytes().get(text.line_range(line)).unwrap_or_default(), 1, |_| {});
    let next = (line + 1..text.line_count()).map(block).find(|block| {
        block.motion.is_some() || block.stop == Some(Stop::End) || block.has_coordinates() || block.i.is_some() || block.j.is_some()
    });
    motion == Motion::Line || next.is_none_or(|block| block.motion.is_some() || block.stop == Some(Stop::End))
}

/// The number of the block's turn where there is room for it; all blocks numbered anew.
fn number_fixes(document: &Document, fault: &IsoFault, range: &Range<usize>) -> Vec<Fix<Vec<TextEdit>>> {
    let text = document.text();
    let line = text.line_of(range.start);
    let mut fixes = Vec::new();
    let free = |number: u32| !labels(text).contains_key(&number);
    match *fault {
        IsoFault::Unnumbered { expected } if free(expected) => {
            let own = text.line_range(line);
            let new = with_word(text.bytes().get(own.clone()).unwrap_or_default(), &format!("N{expected}"), is_parted(text));
            if let Ok(new) = String::from_utf8(new) {
                let edit = vec![TextEdit { range: own, text: new }];
                fixes.push(Fix { kind: FixKind::SetNumber { number: expected }, preferred: true, in_fix_all: true, edit });
            }
        }
        IsoFault::NumberTwice { number } if !document.called().contains(&number) => {
            let turn = document.numbers_before(line).map(|(last, step)| last.saturating_add(step));
            let next = document.number_behind(line);
            if let Some(turn) = turn.filter(|turn| free(*turn) && next.is_none_or(|next| next > *turn)) {
                let edit = vec![TextEdit { range: range.clone(), text: format!("N{turn}") }];
                fixes.push(Fix { kind: FixKind::SetNumber { number: turn }, preferred: true, in_fix_all: true, edit });
            }
        }
        _ => {}
    }
    if let Ok(edit) = numbered(document, RENUMBERED) {
        let kind = FixKind::Renumber { first: RENUMBERED, step: RENUMBERED };
        fixes.push(Fix { kind, preferred: fixes.is_empty(), in_fix_all: false, edit });
    }
    fixes
}

/// The step in which all blocks are numbered.
const RENUMBERED: u32 = 10;

/// The G00 of a line.
fn rapid_word(document: &Document, range: &Range<usize>) -> Option<Range<usize>> {
    let line = document.text().line_range(document.text().line_of(range.start));
    let bytes = document.text().bytes().get(line.clone())?;
    word_range(bytes, line.start, |letter, number| letter == b'G' && number.whole() == Some(0))
}

/// The line end that the text uses before a place.
fn line_end(document: &Document, place: usize) -> &'static str {
    let before = document.text().bytes().get(..place).unwrap_or_default();
    match memchr::memrchr(b'\n', before) {
        Some(at) if at > 0 && before[at - 1] == b'\r' => "\r\n",
        _ => "\n",
    }
}
