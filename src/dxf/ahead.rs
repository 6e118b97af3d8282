//! Reads stretches of a long text ahead of their turn, on all cores, as if each began in the section ENTITIES at a record.
//!
//! The sequential reading (`reading`) takes over a stretch from the first of its records that
//! begins exactly where the sequential reading stands; before that, and where there is none, it
//! reads the text itself. So the result is that of a sequential reading.

use super::entity::{Outcome, Stroke};
use super::layers::Layers;
use super::lexer::Lexer;
use super::lines::Lines;
use super::reader::{ReadItem, Said, read_item};
use super::table::Context;
use crate::finding::Finding;
use std::ops::Range;

/// Lines of one stretch: hundreds of entities, some hundred kilobytes with what is read of them.
const STRETCH: usize = 1 << 13;

/// A text with fewer lines than this is read sequentially.
const MANY: usize = 1 << 16;

/// The lines of each stretch of a text that is worth reading ahead.
pub(super) fn stretch_of(lines: Lines) -> Option<usize> {
    (lines.count() >= MANY && rayon::current_num_threads() > 1).then_some(STRETCH)
}

/// What was read ahead: each item with its faults, and the line after the last.
#[derive(Default)]
pub(super) struct Stretch {
    pub(super) items: Vec<(ReadItem, Vec<Finding>)>,
    pub(super) end: usize,
}

impl Stretch {
    pub(super) fn read(
        lines: Lines,
        range: Range<usize>,
        tolerance: f64,
        mut layers: Layers,
    ) -> Stretch {
        let mut stretch = Stretch::default();
        // What follows a POLYLINE or an INSERT belongs to it.
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

/// Replaces the names that were decoded ahead by the shared copy of each.
pub(super) fn share_names(item: &mut ReadItem, layers: &mut Layers) {
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
