//! The program as a tree: contours between pauses, each with its way in, its blocks and its way out.

use super::sentences::{mm, point, step as step_in_words};
use crate::geometry::Segment;
use crate::program::Document;
use crate::program::path::{Cut, cuts};
use crate::program::path::{Kind, Step, Trace};
use std::ops::Range;

/// With more blocks than this in one contour, runs of them are listed and not each by itself.
const LISTED: usize = 2_000;
/// Runs that stand for many.
const RUNS: usize = 500;
/// Contours, pauses and ways that are listed each by itself.
const LISTED_CUTS: usize = 5_000;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolKind {
    Contour,
    Lead,
    Way,
    Block,
    /// Blocks that are too many to be listed one by one.
    Run,
    Word,
}

/// A node of the tree; ranges are bytes and lie within those of the node that holds it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    pub kind: SymbolKind,
    pub name: String,
    pub detail: String,
    pub range: Range<usize>,
    pub selection: Range<usize>,
    pub children: Vec<Symbol>,
}

/// The tree of a program, in the order of the text.
pub fn symbols(document: &Document) -> Vec<Symbol> {
    let trace = document.trace();
    let text = document.text();
    let whole_lines = |steps: &[Step]| {
        let first = steps
            .iter()
            .map(|step| text.line_start(step.line))
            .min()
            .unwrap_or(0);
        let last = steps
            .iter()
            .map(|step| text.line_range(step.line).end.max(step.range.end))
            .max()
            .unwrap_or(0);
        first..last.max(first)
    };
    let mut found = Vec::new();
    let cuts = cuts(&trace);
    let mut ordinal = 0;
    let (mut next, mut index) = (0, 0);
    while index < trace.steps.len() && found.len() < LISTED_CUTS {
        match cuts.get(next).filter(|cut| cut.steps.start == index) {
            Some(cut) => {
                ordinal += usize::from(!cut.is_way);
                found.push(of_cut(&trace, cut, ordinal, &whole_lines));
                index = cut.steps.end;
                next += 1;
            }
            None => {
                let step = &trace.steps[index];
                found.push(of_step(
                    step,
                    SymbolKind::Word,
                    whole_lines(std::slice::from_ref(step)),
                ));
                index += 1;
            }
        }
    }
    // A subprogram stands elsewhere than it runs.
    found.sort_by_key(|symbol| (symbol.range.start, std::cmp::Reverse(symbol.range.end)));
    found
}

fn of_cut(
    trace: &Trace,
    cut: &Cut,
    ordinal: usize,
    whole_lines: &dyn Fn(&[Step]) -> Range<usize>,
) -> Symbol {
    let steps = trace.steps.get(cut.steps.clone()).unwrap_or_default();
    let contour = trace.steps.get(cut.contour_steps()).unwrap_or_default();
    let length: f64 = contour
        .iter()
        .filter_map(|step| step.ideal.as_ref())
        .map(Segment::length)
        .sum();
    let (kind, name, mut detail) = if cut.is_way {
        let name = format!(
            "way to {}",
            point(steps.last().map_or(trace.start, |step| step.end))
        );
        (SymbolKind::Way, name, String::new())
    } else {
        let state = if cut.closed { "closed" } else { "open" };
        let blocks = if contour.len() == 1 {
            "1 block".into()
        } else {
            format!("{} blocks", contour.len())
        };
        (
            SymbolKind::Contour,
            format!("contour {ordinal}"),
            format!("{state}, {blocks}, {} mm", mm(length)),
        )
    };
    if let (true, Some(turn)) = (cut.closed, direction(contour)) {
        detail = format!("{detail}, {turn}");
    }
    let range = whole_lines(steps);
    let (lead_in, lead_out) = (
        &steps[..cut.lead_in.min(steps.len())],
        &steps[steps.len() - cut.lead_out.min(steps.len())..],
    );
    let mut children = Vec::new();
    for (name, part) in [("lead-in", lead_in), ("", contour), ("lead-out", lead_out)] {
        if name.is_empty() {
            children.extend(blocks(part, whole_lines));
        } else if let Some(first) = part.first() {
            children.push(Symbol {
                kind: SymbolKind::Lead,
                name: name.into(),
                detail: step_in_words(part.last().unwrap_or(first)),
                range: whole_lines(part),
                selection: first.range.clone(),
                children: Vec::new(),
            });
        }
    }
    let selection = steps
        .first()
        .map_or(range.clone(), |step| step.range.clone());
    Symbol {
        kind,
        name,
        detail,
        range,
        selection,
        children,
    }
}

/// Which way round a closed contour is cut.
fn direction(contour: &[Step]) -> Option<&'static str> {
    let origin = contour.first()?.start;
    let area: f64 = contour
        .iter()
        .filter_map(|step| step.ideal.as_ref())
        .map(|ideal| ideal.twice_area(origin))
        .sum();
    (area != 0.0).then_some(if area > 0.0 {
        "counter-clockwise"
    } else {
        "clockwise"
    })
}

fn blocks(steps: &[Step], whole_lines: &dyn Fn(&[Step]) -> Range<usize>) -> Vec<Symbol> {
    if steps.len() <= LISTED {
        return steps
            .iter()
            .map(|step| {
                of_step(
                    step,
                    SymbolKind::Block,
                    whole_lines(std::slice::from_ref(step)),
                )
            })
            .collect();
    }
    let size = steps.len().div_ceil(RUNS);
    let run = |(index, run): (usize, &[Step])| {
        let first = run.first()?;
        let from = index * size + 1;
        Some(Symbol {
            kind: SymbolKind::Run,
            name: format!("blocks {from} to {}", from + run.len() - 1),
            detail: format!("from {}", point(first.start)),
            range: whole_lines(run),
            selection: first.range.clone(),
            children: Vec::new(),
        })
    };
    steps.chunks(size).enumerate().filter_map(run).collect()
}

fn of_step(step: &Step, kind: SymbolKind, range: Range<usize>) -> Symbol {
    let words = step_in_words(step);
    let (name, detail) = match (step.number, step.kind) {
        (Some(number), _) => (format!("N{number}"), words),
        (None, Kind::Pause | Kind::End) => (words, String::new()),
        (None, _) => {
            let (name, detail) = words.split_once(' ').unwrap_or((&words, ""));
            (name.to_owned(), detail.to_owned())
        }
    };
    Symbol {
        kind,
        name,
        detail,
        range,
        selection: step.range.clone(),
        children: Vec::new(),
    }
}
