//! Finds the one slip whose correction makes a faulty cut sound.
//!
//! A faulty cut is taken as the lines between two stops. A change of one block is run until the machine is in the
//! earlier state again, so that most cost a few lines; all is bounded by counted lines, so that the result depends on
//! the text alone.

mod against;
mod around;
pub(super) mod found;
mod line;
mod lost;
mod passes;
mod scan;
mod shape;
mod slip;
mod troubles;
mod words;

use super::block::Block;
use super::document::Document;
use super::labels::LOOKED_BACK;
use super::line::push_changed;
use super::machine::Machine;
use super::moves::{Move, distance};
use super::plain::plain;
use crate::finding::FixKind;
use crate::geometry::{Segment, Vector};
use crate::program::repair;
use crate::program::repair::crosses_itself;
use crate::program::repair::search::{Contour, Plainness, Verdict, search};
use crate::text::TextEdit;
pub(super) use around::cut_within;
use around::{LONGEST, begins_astray, cut_around, is_way, stands_alone, with_numbers_kept};
use found::{LookedAt, Meant, Repair, Repairs, Searched};
use scan::{Against, Line, Scanned};
use shape::Passes;
use std::borrow::Cow;
use std::cell::OnceCell;
use std::ops::Range;
use std::sync::Arc;
pub(super) use troubles::Troubles;
pub(crate) use troubles::{is_trouble, line_of};
use words::{Pool, Words, prior};

/// Longer cuts, in lines, are searched only near the fault.
const MOST_LINES: usize = 160;

/// Cuts with a line longer than this, in bytes, are not searched: no block is that long, and each change costs its
/// line's length.
const LONGEST_LINE: usize = 512;

/// Lines on either side of the fault that are searched in a long cut.
const NEAR: usize = 2;

/// Cuts of a program that are searched.
const MOST_CUTS: usize = 3;

/// One slip has at most this many consequences.
const MOST_TROUBLES: usize = 6;

/// By this much a cut without a fault must be less odd after a change.
const SOUNDER: f64 = 1.5;

/// Lines that are run for all of them.
const MOST_RUNS: usize = 40_000;

impl Document {
    /// The slips that may explain the faults, by the lines of the cuts that they stand in.
    pub(super) fn repairs(&self) -> &Repairs {
        self.repairs.get_or_init(|| {
            let others = self.report().finish();
            Arc::new(repairs(self, &mut Troubles::of(self, &others)))
        })
    }

    /// The searches that were made before the last edit.
    fn searched_before(&self) -> &[Searched] {
        let before = self.repairs_before.as_ref();
        before.map_or(&[], |before| &before.searched)
    }

    /// The same, with the faults that a slip may explain given.
    pub(super) fn repairs_of(&self, troubles: &mut Troubles<'_>) -> &Repairs {
        self.repairs
            .get_or_init(|| Arc::new(repairs(self, troubles)))
    }
}

/// Searches the faulty cuts.
fn repairs(document: &Document, troubles: &mut Troubles<'_>) -> Repairs {
    let (mut found, mut too_long) = (Repairs::default(), Vec::<Range<usize>>::new());
    let mut left = MOST_RUNS;
    let text = document.text();
    while let Some(trouble) = troubles.next() {
        let line = text.line_of(trouble);
        let known = found
            .of_cuts
            .iter()
            .map(|(lines, _)| lines)
            .chain(&too_long);
        if known.clone().any(|lines| lines.contains(&line)) {
            continue;
        }
        if found.of_cuts.len() == MOST_CUTS || left == 0 {
            break;
        }
        let lines = cut_around(document, line);
        if lines.len() > LONGEST || !stands_alone(document, &lines) {
            too_long.push(lines);
            continue;
        }
        let Some(before) = document.machine_before(lines.start) else {
            too_long.push(lines);
            continue;
        };
        let own = troubles.within(&lines).iter();
        let own: Vec<usize> = own.map(|trouble| text.line_of(*trouble)).collect();
        // A single slip does not cause so many faults.
        let is_long = |line: usize| document.line_bytes(line).len() > LONGEST_LINE;
        if own.len() > MOST_TROUBLES || lines.clone().any(is_long) {
            found.of_cuts.push((lines, Vec::new()));
            continue;
        }
        let suspect = Suspect::new(document, lines.clone(), before, &own);
        left = left.saturating_sub(lines.len());
        let mut repairs = Vec::new();
        if !suspect.way.tells_too_little() {
            let searched = suspect.searched(&own, left);
            left = searched.left;
            let some = searched.found.iter();
            repairs.extend(some.filter_map(|repair| suspect.repair(repair)));
            found.searched.push(searched);
        }
        found.of_cuts.push((lines, repairs));
    }
    found
}

/// A faulty cut.
struct Suspect<'a> {
    document: &'a Document,
    lines: Range<usize>,
    way: Scanned<'a>,
    pool: Pool,
    total: Against,
    order: Vec<usize>,
    /// Those beside it that tell which of its moves are right.
    passes: Option<Arc<Passes>>,
    /// The block numbers of its lines and of those before it, once they were needed.
    numbers: Vec<OnceCell<Option<u32>>>,
    /// The cut before it has missed the place where this one should begin.
    begins_astray: bool,
    /// A line may be lost: between two that are alike, or before an arc with which the cut begins.
    may_lack_a_line: bool,
}

impl Contour for Suspect<'_> {
    type Meant = Meant;
    /// All moves.
    type Lead = Vec<Move>;

    const CLEARLY: f64 = 2.1;

    fn finalists(&self) -> usize {
        if self.is_searched_whole() { 64 } else { 16 }
    }

    fn is_searched_whole(&self) -> bool {
        self.order.len() == self.lines.len()
    }

    fn order(&self) -> Vec<usize> {
        self.order.clone()
    }

    fn meant(&self, index: usize) -> Vec<(Meant, f64)> {
        if !self.may_be_wrong(index) {
            return Vec::new();
        }
        let words = Words {
            document: self.document,
            pool: &self.pool,
            bytes: &self.bytes(index),
            index,
            before: self.way.machine_before(index),
            meant: Vec::new(),
        };
        words.all(&self.way)
    }

    fn deleted(&self, index: usize) -> Option<f64> {
        let prior = if self.is_twice(index) {
            prior::TWICE
        } else {
            prior::BLOCK
        };
        self.moves(index).then_some(prior)
    }

    fn exchanged(&self, index: usize) -> Option<f64> {
        let next = &self.way.lines.get(index + 1)?.block;
        let is_other = next.leads() && self.bytes(index) != self.line(index + 1);
        (self.moves(index) && is_other).then_some(prior::BLOCKS)
    }

    fn gaps(&self, index: usize) -> Vec<Vector> {
        match is_way(self.block(index)) {
            true => self.gaps_before(index),
            false => Vec::new(),
        }
    }

    fn headings(&self, index: usize) -> Option<[Vector; 2]> {
        self.headings_at(index)
    }

    fn filling(&self, index: usize, way: &Segment) -> Option<(Meant, f64)> {
        self.filled(index, way)
    }

    fn judged(&self, change: &Change, cost: f64) -> (Option<Verdict>, usize) {
        let lines = self.lines_with(change);
        let (index, count) = (change.index(), change.replaced());
        let (after, runs) = self.way.with(index, count, &lines);
        let told = |passes: &Arc<Passes>| passes.against(&self.way, index, count, &lines);
        let (told, more) = self.passes.as_ref().map_or((0.0, 0), told);
        let cost = after.cost() + cost;
        let (was, is) = (self.total.faults(), after.faults());
        let is_sounder = was == [0, 0] && cost + SOUNDER < self.total.cost();
        let is_better = is < was || (after.hard == 0 && is_sounder);
        let (plainness, speaks) = match change {
            Change::Replace { meant, .. } => {
                let is_a_word = !meant.is_calculated && !meant.found.is_empty();
                let plainness = match is_a_word {
                    true => Plainness::Slip,
                    false => Plainness::Calculated,
                };
                (plainness, meant.evidence)
            }
            // A line that stands twice tells so itself.
            Change::Delete { index } if self.is_twice(*index) => (Plainness::Slip, -3.0),
            Change::Delete { .. } => (Plainness::Calculated, 0.0),
            Change::Exchange { .. } => (Plainness::Slip, 0.0),
            Change::Insert { .. } => (Plainness::Slip, Self::CLEARLY),
        };
        // What is calculated comes behind what may have been written.
        let later = match change {
            Change::Replace { .. } if plainness == Plainness::Calculated => Self::CLEARLY,
            Change::Insert { .. } => Self::CLEARLY,
            _ => 0.0,
        };
        let verdict = Verdict {
            left: after.hard as usize,
            cost: cost + later + told,
            plainness,
            evidence: after.soft + speaks + told,
            may_be_sure: after.hard == 0
                && told <= 0.0
                && after.back <= self.total.back
                && after.beside == 0
                && after.unlike <= self.total.unlike
                && self.is_a_slip(change, &lines)
                && was > [0, 0]
                && !self.begins_astray,
        };
        (is_better.then_some(verdict), runs + more + 1)
    }

    fn lead(&self, change: &Change) -> Vec<Move> {
        let lines = self.lines_with(change);
        self.way
            .moves_with(change.index(), change.replaced(), &lines)
    }

    fn is_alike(one: &Vec<Move>, other: &Vec<Move>) -> bool {
        one == other
    }

    fn crosses(&self, change: Option<&Change>, left: &mut usize) -> Option<bool> {
        if !self.is_searched_whole() {
            return Some(false);
        }
        let pieces = match change {
            Some(change) => {
                let lines = self.lines_with(change);
                self.way
                    .pieces_with(change.index(), change.replaced(), &lines)
            }
            None => self.way.pieces_with(0, 0, &[]),
        };
        let arcs = pieces
            .iter()
            .filter(|piece| piece.as_arc().is_some())
            .count();
        crosses_itself(&pieces, arcs, left)
    }
}

type Change = repair::slip::Change<Meant>;

impl<'a> Suspect<'a> {
    /// `places` are the lines of the findings.
    fn new(
        document: &'a Document,
        lines: Range<usize>,
        before: Machine,
        places: &[usize],
    ) -> Suspect<'a> {
        let own: Vec<Line> = lines
            .clone()
            .map(|line| Line::read(document.line_bytes(line), document))
            .collect();
        let pool = Pool::of(document, &own);
        let way = Scanned::new(document.reading(), own, before);
        let apart = |index: &usize| {
            let apart = |place: &usize| place.abs_diff(lines.start + index);
            places.iter().map(apart).min().unwrap_or(0)
        };
        let is_long = lines.len() > MOST_LINES;
        let mut order: Vec<usize> = (0..lines.len())
            .filter(|index| !is_long || apart(index) <= NEAR)
            .collect();
        order.sort_by_key(apart);
        let mut suspect = Suspect {
            may_lack_a_line: false,
            document,
            total: way.total(),
            begins_astray: begins_astray(document, &lines),
            passes: Passes::beside(document, &lines, &way).map(Arc::new),
            numbers: vec![OnceCell::new(); lines.end - lines.start.saturating_sub(LOOKED_BACK)],
            lines,
            way,
            pool,
            order,
        };
        let mut indices = 0..suspect.lines.len();
        let has_twins = indices.clone().any(|index| suspect.is_twice(index));
        let first = indices.find_map(|index| suspect.made(index));
        suspect.may_lack_a_line = has_twins || first.is_some_and(|made| made.is_arc());
        suspect
    }

    fn block(&self, index: usize) -> &Block {
        &self.way.lines[index].block
    }

    fn line(&self, index: usize) -> &[u8] {
        self.document.line_bytes(self.lines.start + index)
    }

    /// A line in plain letters.
    fn bytes(&self, index: usize) -> Cow<'_, [u8]> {
        let own = self.line(index);
        plain(own).map_or(Cow::Borrowed(own), Cow::Owned)
    }

    /// The move that a line makes.
    fn made(&self, index: usize) -> Option<Move> {
        let mut machine = *self.way.machine_before(index);
        machine.run(self.block(index), self.way.reading)
    }

    fn may_be_wrong(&self, index: usize) -> bool {
        is_way(self.block(index)) && self.block(index).stop.is_none()
    }

    /// True for a line that makes a move, or would if it could be read.
    fn moves(&self, index: usize) -> bool {
        let has_fault = self.way.lines[index].faults > 0;
        self.may_be_wrong(index) && (has_fault || self.made(index).is_some())
    }

    /// The lines after a change.
    fn texts_with(&self, change: &Change) -> Vec<Vec<u8>> {
        match change {
            Change::Exchange { index } => {
                with_numbers_kept(&self.bytes(*index), self.line(index + 1))
            }
            other => other
                .meant()
                .map(|meant| meant.line.clone())
                .into_iter()
                .collect(),
        }
    }

    fn lines_with(&self, change: &Change) -> Vec<Line> {
        let texts = self.texts_with(change);
        texts
            .iter()
            .map(|text| Line::read(text, self.document))
            .collect()
    }

    /// The search through it for faults in some `places`, perhaps as it was made before the last edit, which changed nothing
    /// that it looks at.
    fn searched(&self, places: &[usize], left: usize) -> Searched {
        let (document, lines) = (self.document, &self.lines);
        let text = document.text();
        let first = lines.start.saturating_sub(LOOKED_BACK);
        let last = text.line_count().min(lines.end + LOOKED_BACK + 1);
        let bytes = text.line_start(first)..text.line_range(last.saturating_sub(1)).end;
        let of = LookedAt {
            text: text.slice(bytes).unwrap_or_default().to_vec(),
            lines_before: lines.start - first,
            lines: lines.len(),
            faults: places.iter().map(|line| line - lines.start).collect(),
            before: *self.way.machine_before(0),
            begins_astray: self.begins_astray,
            reading: *document.reading(),
            decimals: document.usual_decimals(),
            pointed: document.pointed(),
            is_parted: self.pool.is_parted,
            styles: self.pool.styles,
            passes: self.passes.clone(),
            left,
        };
        let mut before = document.searched_before().iter();
        before.find(|one| one.of == of).cloned().unwrap_or_else(|| {
            let mut left = left;
            let found = search(self, &mut left);
            Searched { of, found, left }
        })
    }

    /// A change as edits of the text.
    fn repair(&self, repair: &repair::slip::Repair<Meant>) -> Option<Repair> {
        let (text, change) = (self.document.text(), &repair.change);
        let line = self.lines.start + change.index();
        let start = text.line_start(line);
        let edits = match change {
            Change::Insert { meant, .. } => {
                let end = text.line_end_before(text.line_range(line).end);
                let new = String::from_utf8(meant.line.clone()).ok()?;
                vec![TextEdit::new(start..start, format!("{new}{end}"))]
            }
            // The whole line goes, with its end.
            Change::Delete { .. } => vec![TextEdit::new(text.whole_line(line), "")],
            Change::Replace { .. } | Change::Exchange { .. } => {
                let mut edits = Vec::new();
                for (line, new) in (line..).zip(self.texts_with(change)) {
                    let old = self.document.line_bytes(line);
                    push_changed(&mut edits, text.line_range(line), old, &new).ok()?;
                }
                edits
            }
        };
        let shown = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
        let own = || shown(&self.bytes(change.index()));
        let (found, meant) = match change {
            Change::Replace { meant, .. } | Change::Insert { meant, .. } => {
                (meant.found.clone(), meant.meant.clone())
            }
            Change::Delete { .. } => (own(), String::new()),
            Change::Exchange { index } => (own(), shown(self.line(index + 1))),
        };
        let kind = match change {
            Change::Replace { .. } => FixKind::Rewrite {
                found: found.clone(),
                meant: meant.clone(),
            },
            Change::Delete { .. } => FixKind::DeleteBlock,
            Change::Exchange { .. } => FixKind::ExchangeBlocks,
            Change::Insert { index, meant } => {
                let block = Line::read(&meant.line, self.document).block;
                let made = { *self.way.machine_before(*index) }.run(&block, self.way.reading)?;
                FixKind::InsertBlock {
                    length: distance(made.from, made.to) / 1e6,
                    is_arc: made.is_arc(),
                }
            }
        };
        Some(Repair {
            kind,
            edits,
            line,
            found,
            meant,
            closes: self.total.open > 0,
            is_sure: repair.is_sure,
            explains: self.total.faults() > [0, 0],
        })
    }
}
