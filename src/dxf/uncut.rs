//! The parts of a drawing that are not cut: one finding for each kind and each layer.

use super::lines::Lines;
use super::reader::range_key;
use super::table::{Became, Context, NO_ITEM};
use super::{Document, place};
use crate::drawing::{EntityId, Visibility};
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

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
    /// entities that are invisible themselves, at the first of them.
    fn name_unseen(&mut self) {
        let mut by_reason: BTreeMap<(Visibility, Arc<str>), (usize, u64, EntityId)> =
            BTreeMap::new();
        for (id, visibility, layer) in self.drawing.unseen() {
            if self
                .drawing
                .get(id)
                .is_some_and(|entity| entity.geometry.segment_count() > 0)
            {
                let layer = if visibility == Visibility::Invisible {
                    "".into()
                } else {
                    layer.clone()
                };
                let rank = self.drawing.rank(id);
                let (count, first, at) = by_reason
                    .entry((visibility, layer))
                    .or_insert((0, rank, id));
                *count += 1;
                if rank < *first {
                    (*first, *at) = (rank, id);
                }
            }
        }
        for ((visibility, layer), (count, _, first)) in by_reason {
            let range = self
                .entry_of(&layer)
                .unwrap_or_else(|| self.range_of(&Place::Entity { entity: first }));
            self.findings.push(Finding {
                rule: Rule::UnsupportedEntity,
                severity: Severity::Information,
                place: Place::Text { range },
                detail: Detail::Unseen {
                    layer,
                    visibility,
                    count,
                },
                related: Vec::new(),
            });
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
