//! The one slip that would make a cut in trouble sound: tried word by word and block by block, ranked by what it leaves.
//!
//! A cut in trouble is taken as the lines between two stops. A change of one block is run from there on until the machine stands again as
//! it did, so that most cost a few lines; all is bounded by counted lines, so that what is found hangs on the text alone.

mod change;
pub mod found;
mod scan;

use super::document::Document;
use super::machine::Machine;
use crate::finding::{Detail, Fault, Finding, Place, Rule, Severity};
use change::{Change, Pool};
pub use found::{Repair, Repairs};
use scan::{Line, Scan, Way};
use std::ops::Range;
use std::sync::Arc;

/// Cuts of more lines are searched only near what is wrong.
const MOST_LINES: usize = 160;

/// Cuts of more lines are not searched.
const LONGEST: usize = 4_000;

/// Cuts with a longer line, in bytes, are not searched: no block is, and each change of one is as long as the line.
const LONGEST_LINE: usize = 512;

/// Lines on either side of what is wrong that are searched in a long cut.
const NEAR: usize = 2;

/// Cuts of a program that are searched.
const MOST_CUTS: usize = 3;

/// One slip has no more consequences.
const MOST_TROUBLES: usize = 6;

/// Lines that are run for all of them.
const MOST_RUNS: usize = 40_000;

/// The best changes that are held against each other.
const FINALISTS: usize = 16;

/// Repairs that are offered.
const OFFERED: usize = 4;

/// By how much a change must be better than any other that leads elsewhere to be the one that is meant.
const CLEAR: f64 = 1.5;

impl Document {
    /// The slips that may be behind what is wrong, by the lines of the cuts that they stand in.
    pub(super) fn repairs(&self) -> &Repairs {
        self.repairs
            .get_or_init(|| Arc::new(repairs(self, &self.plain_findings())))
    }
}

/// Searches the cuts in which something is wrong.
fn repairs(document: &Document, findings: &[Finding]) -> Repairs {
    let text = document.text();
    let mut found: Repairs = Vec::new();
    let mut too_long: Vec<Range<usize>> = Vec::new();
    let mut left = MOST_RUNS;
    let places: Vec<usize> = findings
        .iter()
        .filter(|finding| is_trouble(finding))
        .filter_map(|finding| line_of(document, finding))
        .collect();
    for &line in &places {
        let known = found.iter().map(|(lines, _)| lines).chain(&too_long);
        if known.clone().any(|lines| lines.contains(&line)) {
            continue;
        }
        if found.len() == MOST_CUTS || left == 0 {
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
        let own: Vec<usize> = places
            .iter()
            .copied()
            .filter(|line| lines.contains(line))
            .collect();
        // So much does not come of one slip.
        let is_long = |line: usize| document.line_bytes(line).len() > LONGEST_LINE;
        if own.len() > MOST_TROUBLES || lines.clone().any(is_long) {
            found.push((lines, Vec::new()));
            continue;
        }
        let mut search = Search::new(document, lines.clone(), before, left);
        let repairs = search.best(&own);
        left = search.left;
        found.push((lines, repairs));
    }
    debug_assert!(
        found
            .iter()
            .flat_map(|(_, repairs)| repairs)
            .all(|repair| repair.line < text.line_count())
    );
    found
}

/// What one slip may stand behind.
pub fn is_trouble(finding: &Finding) -> bool {
    match finding.rule {
        Rule::Syntax | Rule::NotClosed | Rule::MixedNumbers => {
            finding.severity <= Severity::Warning
        }
        Rule::ArcOffRadius
        | Rule::ArcWithoutRadius
        | Rule::PathCrossesItself
        | Rule::ReversedArc
        | Rule::CenterOnLine
        | Rule::WordTwice
        | Rule::Spur => true,
        Rule::DoubledBlock => !matches!(
            &finding.detail,
            Detail::Program(fault) if matches!(**fault, Fault::DoubledBlock { arc: false })
        ),
        _ => false,
    }
}

pub fn line_of(document: &Document, finding: &Finding) -> Option<usize> {
    match &finding.place {
        Place::Text { range } => Some(document.text().line_of(range.start)),
        _ => None,
    }
}

/// The lines between the stops around a line, or between the places where subprograms begin, end and are called; more than [`LONGEST`]
/// where there are too many.
fn cut_around(document: &Document, line: usize) -> Range<usize> {
    let is_order_kept = document.order().is_none();
    let ends_with = |line: usize| {
        let block = document.block(line);
        block.stop.is_some() || (!is_order_kept && (block.call.is_some() || block.returns))
    };
    let begins_with = |line: usize| {
        let block = document.block(line);
        let is_called = |number: u32| document.calls(number);
        !is_order_kept && (block.program.is_some() || block.number.is_some_and(is_called))
    };
    let count = document.text().line_count();
    let mut first = line;
    while first > 0 && line - first <= LONGEST && !begins_with(first) && !ends_with(first - 1) {
        first -= 1;
    }
    let mut end = line + 1;
    while end < count && end - line <= LONGEST && !ends_with(end - 1) && !begins_with(end) {
        end += 1;
    }
    first..end
}

/// True where the lines of a cut hold all of it. The search does not make the corners that the control makes, and an arc begins where one
/// of them ends; and what a subprogram goes on with is not known.
fn stands_alone(document: &Document, lines: &Range<usize>) -> bool {
    let (mut has_corner, mut has_arc) = (false, false);
    for block in lines.clone().map(|line| document.block(line)) {
        has_corner |= block.corner.is_some();
        has_arc |= block.i.is_some() || block.j.is_some();
    }
    let is_begun = || {
        document
            .begun_cut(lines.start)
            .is_some_and(|begun| begun.moves > 0)
    };
    !(has_corner && has_arc) && (document.order().is_none() || !is_begun())
}

struct Search<'a> {
    document: &'a Document,
    lines: Range<usize>,
    way: Way<'a>,
    pool: Pool,
    left: usize,
}

/// A change, what it leaves and what speaks against it.
struct Tried {
    change: Change,
    hard: u32,
    beside: u32,
    cost: f64,
}

impl<'a> Search<'a> {
    fn new(
        document: &'a Document,
        lines: Range<usize>,
        before: Machine,
        left: usize,
    ) -> Search<'a> {
        let own: Vec<Line> = lines
            .clone()
            .map(|line| Line::read(document.line_bytes(line), document))
            .collect();
        let pool = Pool::of(document, &own);
        let way = Way::new(document.reading(), own, before);
        Search {
            document,
            lines,
            way,
            pool,
            left,
        }
    }

    /// The best repairs; `places` are the lines at which something is said.
    fn best(&mut self, places: &[usize]) -> Vec<Repair> {
        let total = self.way.total();
        let (hard, soft) = (total.hard, total.soft);
        self.left = self.left.saturating_sub(self.lines.len());
        let mut finalists: Vec<Tried> = Vec::new();
        let is_long = self.lines.len() > MOST_LINES;
        // Those near what is wrong come first.
        let apart = |index: usize| {
            places
                .iter()
                .map(|place| place.abs_diff(self.lines.start + index))
                .min()
                .unwrap_or(0)
        };
        let mut order: Vec<usize> = (0..self.lines.len())
            .filter(|index| !is_long || apart(*index) <= NEAR)
            .collect();
        order.sort_by_key(|index| apart(*index));
        for index in order {
            let changes = change::of_line(self.document, &self.way, &self.pool, &self.lines, index);
            for change in changes {
                if self.left == 0 {
                    break;
                }
                let lines: Vec<Line> = change
                    .lines
                    .iter()
                    .map(|bytes| Line::read(bytes, self.document))
                    .collect();
                let (scan, runs) = self.way.with(index, change.replaced, &lines);
                self.left = self.left.saturating_sub(runs + 1);
                let cost = scan.soft + change.prior;
                let is_better =
                    scan.hard < hard || (scan.hard == hard && hard == 0 && cost + CLEAR < soft);
                if is_better {
                    keep(
                        &mut finalists,
                        Tried {
                            change,
                            hard: scan.hard,
                            beside: scan.beside,
                            cost,
                        },
                    );
                }
            }
        }
        self.ranked(finalists, total)
    }

    /// Those that lead somewhere of their own, best first.
    fn ranked(&self, finalists: Vec<Tried>, total: Scan) -> Vec<Repair> {
        let mut seen: Vec<u64> = Vec::new();
        let mut different: Vec<Tried> = Vec::new();
        for tried in finalists {
            let lines: Vec<Line> = tried
                .change
                .lines
                .iter()
                .map(|bytes| Line::read(bytes, self.document))
                .collect();
            let mark = self
                .way
                .mark_with(tried.change.index, tried.change.replaced, &lines);
            if !seen.contains(&mark) {
                seen.push(mark);
                different.push(tried);
            }
        }
        let is_clear = match &different[..] {
            [] => false,
            [_] => true,
            [first, second, ..] => first.hard < second.hard || first.cost + CLEAR <= second.cost,
        };
        let repair = |(rank, tried): (usize, Tried)| {
            let is_sure = rank == 0
                && tried.hard == 0
                && tried.beside == 0
                && tried.change.is_a_slip
                && is_clear
                && total.hard > 0;
            let repair = tried.change.into_repair(self.document, self.lines.start)?;
            Some(Repair {
                closes: total.open > 0,
                is_sure,
                explains: total.hard > 0,
                ..repair
            })
        };
        different
            .into_iter()
            .take(OFFERED)
            .enumerate()
            .filter_map(repair)
            .collect()
    }
}

fn keep(finalists: &mut Vec<Tried>, tried: Tried) {
    let is_before = |other: &Tried| (other.hard, other.cost) <= (tried.hard, tried.cost);
    let at = finalists.partition_point(is_before);
    if at < FINALISTS {
        finalists.insert(at, tried);
        finalists.truncate(FINALISTS);
    }
}
