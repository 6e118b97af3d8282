//! The parts of a drawing that are not cut: one finding for each kind and each layer.

use super::lines::Lines;
use super::reader::range_key;
use super::table::{Became, Context, NO_ITEM};
use super::{Document, place};
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use std::ops::Range;

impl Document {
    /// One finding for each kind of entity that is not cut, at the first of it; all findings in the order of the text.
    pub(super) fn name_unsupported(&mut self) {
        self.findings
            .retain(|finding| finding.rule != Rule::UnsupportedEntity);
        // The number of each kind, and the first of it.
        let mut seen = vec![(0usize, NO_ITEM); self.table.kinds.len()];
        // The content of a block counts where the block is drawn.
        let mut used = self.table.used.iter();
        let mut is_drawn = false;
        // In most drawings everything is cut; then no item is looked at.
        let items = if seen.is_empty() {
            &[][..]
        } else {
            &self.table.items[..]
        };
        for (index, item) in items.iter().enumerate() {
            if item.became == Became::Block {
                is_drawn = used.next().copied().unwrap_or(false);
            }
            let mut name = |kind: u32, how_many: usize| {
                if let Some((count, first)) = seen.get_mut(kind as usize) {
                    if *count == 0 {
                        *first = index as u32;
                    }
                    *count += how_many;
                }
            };
            match item.became {
                Became::Unsupported(kind) if item.context != Context::Blocks || is_drawn => {
                    name(kind, 1)
                }
                Became::Parts { first, .. } if !self.table.left_out.is_empty() => {
                    let left_out = self.table.left_out.get(&first).into_iter().flatten();
                    left_out.for_each(|&(kind, how_many)| name(kind, how_many));
                }
                _ => {}
            }
        }
        let lines = Lines::new(&self.text);
        for (index, (count, first)) in seen.into_iter().enumerate() {
            let Some((kind, why)) = self.table.kinds.get(index as u32).filter(|_| count > 0) else {
                continue;
            };
            let line = self
                .table
                .lines
                .get(first as usize)
                .map_or(0, |&line| line as usize + 1);
            self.findings.push(Finding {
                rule: Rule::UnsupportedEntity,
                severity: Severity::Information,
                place: Place::Text {
                    range: lines.trimmed_range(line),
                },
                detail: Detail::UnsupportedEntity {
                    kind: kind.clone(),
                    count,
                    why,
                },
                related: Vec::new(),
            });
        }
        self.name_unseen();
        self.findings.sort_by_key(range_key);
    }

    /// One finding for each layer that is not simply shown and has something drawn on it, at its entry; one for all
    /// entities that are invisible themselves, at the first of them; one for polylines with a width.
    fn name_unseen(&mut self) {
        for unseen in self.drawing.unseen() {
            let entry = self.entry_of(&unseen.layer);
            let mut finding = Finding::from(unseen);
            finding.place = Place::Text {
                range: entry.unwrap_or_else(|| self.range_of(&finding.place)),
            };
            self.findings.push(finding);
        }
        if let Some(wide) = self.drawing.wide() {
            let mut finding = Finding::from(wide);
            finding.place = Place::Text {
                range: self.range_of(&finding.place),
            };
            self.findings.push(finding);
        }
    }

    /// Where the name of a layer stands in the table LAYER.
    fn entry_of(&self, layer: &str) -> Option<Range<usize>> {
        let is_it = |became: Became| match became {
            Became::Layer(index) => self
                .table
                .layers
                .get(index as usize)
                .is_some_and(|entry| entry.name.to_lowercase() == layer.to_lowercase()),
            _ => false,
        };
        let item = self
            .table
            .items
            .iter()
            .position(|item| is_it(item.became))?;
        let lines = Lines::new(&self.text);
        let name = place::own_tags(lines, self.table.lines_of(item, lines.count()))
            .filter(|tag| tag.code == 2)
            .last()?;
        Some(lines.trimmed_range(name.value_line()))
    }
}
