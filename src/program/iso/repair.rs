//! Finds the one slip whose correction makes a faulty cut sound.
//!
//! A cut is taken as the lines between two stops, or rapids; what may be meant is decided by
//! [`crate::program::repair::rule`]. All is bounded by counts, so that the result depends on the text alone.

mod around;
pub(super) mod found;
mod lost;
mod suspect;
mod troubles;
mod way;
mod words;

use super::document::Document;
use super::labels::LOOKED_BACK;
use super::line::push_changed;
use super::moves::distance;
use crate::finding::FixKind;
use crate::program::repair::cut::Piece;
use crate::program::repair::rule::search;
use crate::program::repair::slip;
use crate::text::TextEdit;
pub(super) use around::cut_within;
use around::{LONGEST, cut_around, stands_alone};
use found::{Meant, Repair, Repairs};
use rustc_hash::FxHasher;
use std::f64::consts::PI;
use std::hash::{Hash, Hasher};
use std::ops::Range;
use std::sync::Arc;
use suspect::{Change, Suspect};
pub(super) use troubles::{is_trouble, troubles, within};
use way::Way;

/// Cuts of more moves cost too long to search.
const MOST_MOVES: usize = 1000;

/// Cuts with a line longer than this, in bytes, are not searched: no block is that long, and each change costs its
/// line's length.
const LONGEST_LINE: usize = 512;

/// Cuts of a program that are searched.
const MOST_CUTS: usize = 3;

/// One slip has at most this many consequences.
const MOST_TROUBLES: usize = 6;

/// So many stops on in either direction cuts are looked at that may be passes of a cut, or have leads like it.
const STOPS_BESIDE: usize = 3;

/// A cut that ends farther from its start, µm, has not returned there.
const ASTRAY: f64 = 20.0;

impl Document {
    /// The slips that may explain the faults, by the lines of the cuts that they stand in.
    pub(super) fn repairs(&self) -> &Repairs {
        self.repairs.get_or_init(|| {
            let troubles = troubles(&self.report().finish());
            Arc::new(repairs(self, &troubles))
        })
    }

    /// The same, with the first bytes of the findings that a slip may explain given.
    pub(super) fn repairs_of(&self, troubles: &[usize]) -> &Repairs {
        self.repairs
            .get_or_init(|| Arc::new(repairs(self, troubles)))
    }
}

/// Searches the faulty cuts.
fn repairs(document: &Document, troubles: &[usize]) -> Repairs {
    let (mut found, mut passed) = (Repairs::new(), Vec::<Range<usize>>::new());
    for trouble in troubles {
        let line = document.text().line_of(*trouble);
        let known = found.iter().map(|(lines, _)| lines);
        if known.chain(&passed).any(|lines| lines.contains(&line)) {
            continue;
        }
        if found.len() == MOST_CUTS {
            break;
        }
        let stops = cut_around(document, line);
        let is_long = |line: usize| document.line_bytes(line).len() > LONGEST_LINE;
        let may_be =
            stops.len() <= LONGEST && stands_alone(document, &stops) && !stops.clone().any(is_long);
        let way = may_be.then(|| Way::around(document, stops.clone(), line));
        let Some(way) = way.flatten().filter(|way| way.at.len() <= MOST_MOVES) else {
            passed.push(stops);
            continue;
        };
        let lines = way.lines();
        // A single slip does not cause so many faults.
        if within(document, troubles, &lines).len() > MOST_TROUBLES {
            found.push((lines, Vec::new()));
            continue;
        }
        found.push(searched(document, way));
    }
    found
}

/// The repairs of a cut, together with the open ones beside it: of two slips nothing says in which of the two each is.
fn searched(document: &Document, way: Way<'_>) -> (Range<usize>, Vec<Repair>) {
    let own = way.lines();
    let [before, behind] = beside(document, &own);
    let others = || before.iter().chain(&behind);
    let pieces: Vec<_> = others().map(Way::pieces).collect();
    let goes_on = |one: &Way<'_>, other: &Way<'_>| {
        let is_next = one.lines().end == other.first && document.order().is_none();
        is_next && one.cuts() && other.cuts() && !other.is_taken()
    };
    let astray = |way: &Way<'_>| way.at.len() > 2 && way.gap().norm() > ASTRAY;
    let before = before.first().filter(|before| goes_on(before, &way));
    let behind = behind.first().filter(|behind| goes_on(&way, behind));
    let begins_astray = before.is_some_and(astray);
    let suspect = Suspect::of(way, &pieces);
    // Even if it closes, it may begin at the wrong place, or the slip may stand in an open cut beside it.
    let mut is_alone = !begins_astray;
    if suspect.against.is_open {
        let [before, behind] = [before, behind].map(|way| way.filter(|way| way.is_open()));
        let first = before.map_or(own.start, |before| before.first);
        let end = behind.map_or(own.end, |behind| behind.lines().end);
        if (first, end) != (own.start, own.end)
            && let Some(whole) = Way::of(document, first..end)
        {
            let whole = Suspect::of(whole, &pieces);
            let mut repairs = whole.repairs();
            repairs.retain(|repair| repair.is_whole);
            if !repairs.is_empty() {
                let repairs = repairs.iter().filter_map(|repair| whole.repair(repair));
                return (first..end, repairs.collect());
            }
            is_alone = false;
        }
    }
    let repairs = suspect.repairs().into_iter().map(|repair| slip::Repair {
        is_sure: repair.is_sure && is_alone,
        ..repair
    });
    let repairs = repairs.filter_map(|repair| suspect.repair(&repair));
    (own, repairs.collect())
}

/// The cuts before some lines and those behind them, the nearest ones first.
fn beside<'a>(document: &'a Document, lines: &Range<usize>) -> [Vec<Way<'a>>; 2] {
    let (mut before, mut behind) = (Vec::new(), Vec::new());
    let at = |line: usize| {
        let stops = cut_around(document, line);
        let is_short = stops.len() <= LONGEST;
        let way = is_short.then(|| Way::around(document, stops.clone(), line));
        let way = way.flatten().filter(|way| way.at.len() <= MOST_MOVES);
        way.ok_or(stops)
    };
    let mut first = lines.start;
    let mut end = lines.end;
    for _ in 0..STOPS_BESIDE {
        if first > 0 {
            let way = at(first - 1);
            first = way
                .as_ref()
                .map_or_else(|stops| stops.start, |way| way.first);
            before.extend(way.ok());
        }
        if end < document.text().line_count() {
            let way = at(end);
            end = way
                .as_ref()
                .map_or_else(|stops| stops.end, |way| way.lines().end);
            behind.extend(way.ok());
        }
    }
    [before, behind]
}

/// Whether a line that repeats the one before it is too many, and not one that was to lead elsewhere: among lines along the
/// axes the next one does not slant, and a half circle may be the other half.
pub(super) fn is_plainly_twice(document: &Document, line: usize) -> bool {
    let stops = cut_around(document, line);
    if stops.len() > LONGEST {
        return true;
    }
    let Some(way) = Way::around(document, stops, line) else {
        return true;
    };
    let own = way.at.iter().position(|row| way.first + row == line);
    let pieces = way.pieces();
    let is_along = |piece: &&Piece| piece.by.x == 0.0 || piece.by.y == 0.0;
    let lines = pieces
        .iter()
        .filter(|piece| !piece.is_arc() && piece.by.norm() > 0.0);
    let are_along = 2 * lines.clone().filter(is_along).count() >= lines.count();
    let at = |index: Option<usize>| index.and_then(|index| pieces.get(index));
    let slants = at(own.map(|own| own + 1)).is_some_and(|next| !next.is_arc() && !is_along(&next));
    let before = at(own.and_then(|own| own.checked_sub(1))).and_then(|piece| piece.curve);
    let sweep = before.and_then(|curve| curve.as_arc().map(|arc| arc.sweep.abs()));
    let is_half = sweep.is_some_and(|sweep| (sweep - PI).abs() < 0.01);
    !(is_half || slants && are_along)
}

impl Suspect<'_> {
    fn repairs(&self) -> Vec<slip::Repair<Meant>> {
        match self.tells_too_little() {
            true => Vec::new(),
            false => {
                let searches = &self.way.document.searches;
                searches.found(self.mark(), || search(self))
            }
        }
    }

    /// A mark of all that a search looks at.
    fn mark(&self) -> u64 {
        let (document, lines) = (self.way.document, self.way.lines());
        let first = lines.start.saturating_sub(LOOKED_BACK);
        let last = document
            .text()
            .line_count()
            .min(lines.end + LOOKED_BACK + 1);
        let mut hasher = FxHasher::default();
        (first..last).for_each(|line| document.line_bytes(line).hash(&mut hasher));
        (lines.start - first, lines.len()).hash(&mut hasher);
        let usual = (
            document.usual_decimals(),
            document.pointed(),
            document.is_parted(),
        );
        let before = self.way.rows.first().map(|row| row.before);
        let about = format!(
            "{before:?}{:?}{usual:?}{:?}{}",
            document.reading(),
            self.styles,
            self.pieces.others_are_mirrored()
        );
        about.hash(&mut hasher);
        for piece in self.pieces.others.iter().flatten() {
            let sweep = piece
                .curve
                .and_then(|curve| curve.as_arc().map(|arc| arc.sweep));
            (
                piece.by.x.to_bits(),
                piece.by.y.to_bits(),
                sweep.map(f64::to_bits),
            )
                .hash(&mut hasher);
        }
        hasher.finish()
    }

    /// A change as edits of the text.
    fn repair(&self, repair: &slip::Repair<Meant>) -> Option<Repair> {
        let (document, change) = (self.way.document, &repair.change);
        let text = document.text();
        let line = self.line_of(change.index());
        let range = text.line_range(line);
        let changed = |lines: &[Vec<u8>]| {
            let mut edits = Vec::new();
            for (line, new) in (line..).zip(lines) {
                let old = document.line_bytes(line);
                push_changed(&mut edits, text.line_range(line), old, new).ok()?;
            }
            Some(edits)
        };
        let edits = match change {
            Change::Insert { index, meant } => {
                let new = String::from_utf8(meant.line.clone()).ok()?;
                let end = text.line_end_before(range.end);
                vec![match *index < self.way.at.len() {
                    true => TextEdit::new(range.start..range.start, format!("{new}{end}")),
                    false => TextEdit::new(range.end..range.end, format!("{end}{new}")),
                }]
            }
            // The whole line goes, with its end.
            Change::Delete { .. } => vec![TextEdit::new(text.whole_line(line), "")],
            Change::Replace { meant, .. } => changed(std::slice::from_ref(&meant.line))?,
            Change::Exchange { .. } => changed(&self.exchanged_lines(line))?,
        };
        let shown = |line: usize| String::from_utf8_lossy(&self.bytes(line)).trim().to_owned();
        let (found, meant) = match change {
            Change::Replace { meant, .. } | Change::Insert { meant, .. } => {
                (meant.found.clone(), meant.meant.clone())
            }
            Change::Delete { .. } => (shown(line), String::new()),
            Change::Exchange { .. } => (shown(line), shown(line + 1)),
        };
        let kind = match change {
            Change::Replace { .. } => FixKind::Rewrite {
                found: found.clone(),
                meant: meant.clone(),
            },
            Change::Delete { .. } => FixKind::DeleteBlock,
            Change::Exchange { .. } => FixKind::ExchangeBlocks,
            Change::Insert { meant, .. } => {
                let block = self.read(&meant.line).block;
                let made = self
                    .machine_at(change.index())?
                    .run(&block, document.reading())?;
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
            closes: self.against.is_open,
            is_sure: repair.is_sure,
            explains: self.against.count() > 0,
        })
    }
}
