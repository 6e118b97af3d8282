//! A line of a faulty cut: its words, and how many of them are faults.

use crate::program::iso::block::{Block, Note, read_line};
use crate::program::iso::document::Document;

/// A line of a cut.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) block: Block,
    /// Faults of its words.
    pub(crate) faults: u32,
}

impl Line {
    pub(crate) fn read(bytes: &[u8], document: &Document) -> Line {
        let mut faults = 0;
        let block = read_line(bytes, 1, |note| match note {
            Note::Fault { .. } | Note::Twice { .. } => faults += 1,
            // Among numbers that are written otherwise.
            Note::Length { pointed, .. }
                if document.pointed().is_some_and(|others| others != pointed) =>
            {
                faults += 1
            }
            _ => {}
        });
        if let Some(decimals) = document.usual_decimals() {
            let lengths = [block.x, block.y, block.i, block.j, block.r];
            faults += lengths
                .into_iter()
                .flatten()
                .filter(|number| decimals.is_odd(*number))
                .count() as u32;
        }
        Line { block, faults }
    }
}
