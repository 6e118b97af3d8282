//! The program as a tree: contours between pauses, each with its way in, its blocks and its way out.

use super::step;
use crate::geometry::Bounds;
use crate::ide::amounts::{closing, mm, point, turn};
use crate::ide::{Symbol, SymbolKind};
use crate::program::Document;
use crate::program::path::{Cut, Kind, Step, Trace, cuts, lie_beside};
use crate::text::SourceText;

/// With more blocks than this in one contour, runs of them are listed instead.
const LISTED: usize = 2_000;
/// Runs that stand for many.
const RUNS: usize = 500;
/// The most contours, pauses and ways that are listed individually.
const LISTED_CUTS: usize = 5_000;

/// The tree of a program, in the order of the text.
pub(crate) fn symbols(document: &Document) -> Vec<Symbol> {
    let trace = document.trace();
    let tree = Tree {
        text: document.text(),
        trace: &trace,
    };
    let mut found = Vec::new();
    let cuts = cuts(&trace);
    let numbers = numbers(&trace, &cuts);
    let (mut next, mut index) = (0, 0);
    while index < trace.steps.len() && found.len() < LISTED_CUTS {
        match cuts.get(next).filter(|cut| cut.steps.start == index) {
            Some(cut) => {
                let name = match numbers.get(next..) {
                    Some([(contour, 1), (_, 2), ..]) => say!(pass_of_contour, contour, 1),
                    Some([(contour, 1), ..]) => say!(contour_by_number, contour),
                    Some([(contour, pass), ..]) => say!(pass_of_contour, contour, pass),
                    _ => String::new(),
                };
                found.push(tree.of_cut(cut, name));
                index = cut.steps.end;
                next += 1;
            }
            None => {
                found.push(tree.of_step(&trace.steps[index], SymbolKind::Stop));
                index += 1;
            }
        }
    }
    // A subprogram is not run where it stands in the text.
    found.sort_by_key(|symbol| (symbol.range.start, std::cmp::Reverse(symbol.range.end)));
    found
}

/// For each cut the number of its contour, and which pass of it the cut is. A move between contours
/// belongs to what comes before it.
fn numbers(trace: &Trace, cuts: &[Cut]) -> Vec<(usize, usize)> {
    let mut numbers = Vec::new();
    let (mut now, mut before) = ((0, 1), None);
    for cut in cuts {
        let steps = trace.steps.get(cut.contour_steps()).unwrap_or_default();
        let mut bounds = Bounds::EMPTY;
        let ideals = steps.iter().filter_map(|step| step.ideal.as_ref());
        ideals.for_each(|piece| bounds.merge(&piece.bounds()));
        let own = (cut.closed && !cut.is_way).then_some(bounds);
        let is_next_pass = before
            .zip(own)
            .is_some_and(|(one, other)| lie_beside(&one, &other));
        now = match (cut.is_way, is_next_pass) {
            (true, _) => now,
            (false, true) => (now.0, now.1 + 1),
            (false, false) => (now.0 + 1, 1),
        };
        before = own;
        numbers.push(now);
    }
    numbers
}

struct Tree<'a> {
    text: &'a SourceText,
    trace: &'a Trace,
}

impl Tree<'_> {
    /// The whole lines of some steps, with the first step's bytes as the name.
    fn symbol(&self, kind: SymbolKind, name: String, detail: String, steps: &[Step]) -> Symbol {
        let lines = || steps.iter().map(|step| step.line);
        let first = lines().min().unwrap_or(0);
        let start = match steps {
            [] => 0,
            _ => self.text.line_start(first),
        };
        let end = |step: &Step| self.text.line_range(step.line).end.max(step.range.end);
        let end = steps.iter().map(end).max().unwrap_or(0).max(start);
        Symbol {
            kind,
            record: "".into(),
            name,
            detail,
            range: start..end,
            selection: steps.first().map_or(start..end, |step| step.range.clone()),
            lines: first..lines().max().unwrap_or(0) + 1,
            children: Vec::new(),
        }
    }

    fn of_cut(&self, cut: &Cut, name: String) -> Symbol {
        let steps_of = |range| self.trace.steps.get(range).unwrap_or_default();
        let (steps, contour) = (steps_of(cut.steps.clone()), steps_of(cut.contour_steps()));
        let (kind, name, detail) = if cut.is_way {
            let to = steps.last().map_or(self.trace.start, |step| step.end);
            (SymbolKind::Way, say!(way_to, point(to)), String::new())
        } else {
            (SymbolKind::Cut, name, detail(cut, steps, contour))
        };
        let lead_in = &steps[..cut.lead_in.min(steps.len())];
        let lead_out = &steps[steps.len() - cut.lead_out.min(steps.len())..];
        let lead = |name: &str, part: &[Step]| {
            let detail = step::in_words(part.last()?);
            Some(self.symbol(SymbolKind::Lead, name.into(), detail, part))
        };
        let mut children: Vec<Symbol> = lead(say!(lead_in), lead_in).into_iter().collect();
        children.extend(self.blocks(contour));
        children.extend(lead(say!(lead_out), lead_out));
        Symbol {
            children,
            ..self.symbol(kind, name, detail, steps)
        }
    }

    fn blocks(&self, steps: &[Step]) -> Vec<Symbol> {
        if steps.len() <= LISTED {
            let block = |step| self.of_step(step, SymbolKind::Move);
            return steps.iter().map(block).collect();
        }
        let size = steps.len().div_ceil(RUNS);
        let run = |(index, run): (usize, &[Step])| {
            let from = index * size + 1;
            let name = say!(blocks_from_one_to_another, from, from + run.len() - 1);
            let detail = say!(from_place, point(run.first()?.start));
            Some(self.symbol(SymbolKind::Run, name, detail, run))
        };
        steps.chunks(size).enumerate().filter_map(run).collect()
    }

    fn of_step(&self, step: &Step, kind: SymbolKind) -> Symbol {
        let words = step::in_words(step);
        let (name, detail) = match (step.number, step.kind) {
            (Some(number), _) => (format!("N{number}"), words),
            (None, Kind::Pause | Kind::End) => (words, String::new()),
            (None, _) => {
                let (name, detail) = words.split_once(' ').unwrap_or((&words, ""));
                (name.to_owned(), detail.to_owned())
            }
        };
        self.symbol(kind, name, detail, std::slice::from_ref(step))
    }
}

/// Closed or open, the number of blocks, the length of cut with its leads, and the direction of a closed contour.
fn detail(cut: &Cut, steps: &[Step], contour: &[Step]) -> String {
    let ideals = || contour.iter().filter_map(|step| step.ideal.as_ref());
    let length = |steps: &[Step]| -> f64 {
        let cuts = steps.iter().filter(|step| step.kind != Kind::Rapid);
        cuts.filter_map(|step| Some(step.ideal.as_ref()?.length()))
            .sum()
    };
    let leads = length(steps) - length(contour);
    let detail = say!(
        closing_blocks_and_cut,
        closing(cut.closed),
        say!(blocks, contour.len()),
        mm(length(steps)),
        match leads > 0.0 {
            true => say!(of_it_leads, mm(leads)),
            false => String::new(),
        }
    );
    let area: f64 = match contour.first() {
        Some(first) if cut.closed => ideals().map(|ideal| ideal.twice_area(first.start)).sum(),
        _ => 0.0,
    };
    if area == 0.0 {
        detail
    } else {
        format!("{detail}, {}", turn(area))
    }
}
