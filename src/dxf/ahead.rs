//! Reads stretches of a long text ahead of their turn, on all cores, as if each began in the section ENTITIES at a record.
//!
//! A stretch is taken from where one of its records begins just where the reading in order has come to; before that, and where this
//! never happens, the text is read in order. So the result is that of the reading in order.

use super::entity::{Outcome, Stroke};
use super::layers::Layers;
use super::lexer::Lexer;
use super::lines::Lines;
use super::reader::{ReadItem, Said, read_item};
use super::reading::Pass;
use super::table::Context;
use crate::finding::Finding;
use rayon::prelude::*;
use std::ops::Range;

/// Lines of one stretch: hundreds of entities, some hundred kilobytes with what is read of them.
const STRETCH: usize = 1 << 13;

/// A text with fewer lines than this is read in order.
const MANY: usize = 1 << 16;

/// The lines of each stretch of a text that is worth reading ahead.
pub(super) fn stretch_of(lines: Lines) -> Option<usize> {
    (lines.count() >= MANY && rayon::current_num_threads() > 1).then_some(STRETCH)
}

/// What was read ahead: each item with its faults, and the line behind the last.
#[derive(Default)]
struct Stretch {
    items: Vec<(ReadItem, Vec<Finding>)>,
    end: usize,
}

impl Stretch {
    fn read(lines: Lines, range: Range<usize>, tolerance: f64, mut layers: Layers) -> Stretch {
        let mut stretch = Stretch::default();
        // What follows a POLYLINE or an INSERT is a part of it.
        let is_whole = |lexer: &Lexer| {
            lexer.peek_record().is_some_and(|record| {
                let name = lines.trimmed(record.value_line());
                !matches!(name, b"VERTEX" | b"ATTRIB" | b"SEQEND")
            })
        };
        let mut each = range.clone().map(|line| Lexer::new(lines, line));
        let Some(mut lexer) = each.find(is_whole) else {
            return stretch;
        };
        let mut context = Context::Entities;
        while lexer.at() < range.end
            && let Some(item) = read_item(&mut lexer, context, tolerance, &mut layers)
        {
            context = item.after;
            stretch
                .items
                .push((item, std::mem::take(&mut lexer.findings)));
        }
        stretch.end = lexer.at();
        stretch
    }
}

impl Pass<'_> {
    /// Takes the text from a record in the section ENTITIES on, up to the end of a stretch in which that section ends. Returns the
    /// section there.
    pub(super) fn take_stretches(&mut self, stretch: usize, layers: &mut Layers) -> Context {
        let (lines, tolerance) = (self.lexer.lines, self.table.fit_tolerance);
        let at_once = 4 * rayon::current_num_threads();
        let empty = layers.empty();
        let read = |from: usize| {
            let each = (0..at_once)
                .into_par_iter()
                .map(|nth| from + nth * stretch)
                .filter(|first| *first < lines.count());
            let of = |first| Stretch::read(lines, first..first + stretch, tolerance, empty.clone());
            each.map(of).collect::<Vec<Stretch>>()
        };
        let mut from = self.lexer.at();
        let mut context = Context::Entities;
        let mut next = read(from);
        while context == Context::Entities && !next.is_empty() {
            from += at_once * stretch;
            let here = std::mem::take(&mut next);
            let take = || {
                let mut stretches = here.into_iter();
                stretches.try_fold(context, |context, stretch| {
                    self.take_stretch(stretch, context, layers)
                })
            };
            let (taken, following) = rayon::join(take, || read(from));
            (context, next) = (taken.unwrap_or(Context::Outside), following);
        }
        context
    }

    /// Takes the text up to the end of a stretch; `None` where the text ends.
    fn take_stretch(
        &mut self,
        stretch: Stretch,
        mut context: Context,
        layers: &mut Layers,
    ) -> Option<Context> {
        while self.lexer.at() < stretch.end {
            let at = self.lexer.at();
            let found = stretch
                .items
                .binary_search_by_key(&at, |(item, _)| item.line);
            if let Ok(first) = found
                && stretch
                    .items
                    .get(first)
                    .is_some_and(|(item, _)| item.context == context)
            {
                let mut items = stretch.items.into_iter().skip(first).peekable();
                while let Some((mut item, mut findings)) = items.next() {
                    context = item.after;
                    share_names(&mut item, layers);
                    let end = items.peek().map_or(stretch.end, |(next, _)| next.line);
                    self.lexer.begin_item(end);
                    self.lexer.findings.append(&mut findings);
                    self.take(item);
                }
                break;
            }
            let tolerance = self.table.fit_tolerance;
            let item = read_item(&mut self.lexer, context, tolerance, layers)?;
            context = item.after;
            self.take(item);
        }
        Some(context)
    }
}

/// Puts the one copy of each name in the place of those that were decoded ahead.
fn share_names(item: &mut ReadItem, layers: &mut Layers) {
    let (layer, appearance) = match &mut item.said {
        Said::Entity(Outcome::Entity(read)) => (&mut read.layer, &mut read.appearance),
        Said::Entity(Outcome::Insert(insert)) => (&mut insert.layer, &mut insert.appearance),
        _ => return,
    };
    layers.share(layer);
    if let Stroke::Own(name) = &mut appearance.stroke {
        layers.share(name);
    }
}
