//! Handles that several entities state. The first of them in the text keeps it; those after it get new names, `<handle>#2`, `#3` and so on.
//!
//! After an edit of a handle the entities that state it elsewhere in the text may have other names: these are reported here,
//! so that nothing else is read again.

use super::Document;
use super::edit::FEW;
use super::fault;
use super::lines::Lines;
use super::place::own_tags;
use super::reader::{ReadItem, range_key};
use super::table::Named;
use crate::drawing::{Delta, EntityId, Handle, Touched};
use crate::finding::{Finding, Severity};
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::Arc;

/// Names after an edit, other than those that stand in the text.
#[derive(Default)]
pub(super) struct NamesAfter {
    /// Of entities that were read, by their number among these.
    pub(super) read: FxHashMap<usize, Handle>,
    elsewhere: Vec<Renamed>,
}

/// An entity that an edit elsewhere gives another name.
struct Renamed {
    id: EntityId,
    /// As the text states it.
    handle: Handle,
    before: Handle,
    after: Handle,
}

/// The entities outside of a zone that state one handle, in the order of the text.
#[derive(Default)]
struct Bearers {
    before: usize,
    behind: Vec<EntityId>,
}

impl Document {
    /// The names of entities after the items of `zone` have been read again as `read`. `None` where more has to be read.
    pub(super) fn names_after(&self, zone: &Range<usize>, read: &[ReadItem]) -> Option<NamesAfter> {
        let mut stated: FxHashMap<&str, Vec<usize>> = FxHashMap::default();
        for item in self.table.items.get(zone.clone())? {
            let Some(entity) = item.entity().and_then(|id| self.drawing.get(id)) else {
                continue;
            };
            match item.named {
                Named::ByText => stated.entry(&entity.handle).or_default(),
                Named::Anew => stated.entry(entity.handle.rsplit_once('#')?.0).or_default(),
                Named::ByOrdinal => continue,
            };
        }
        let entities = read.iter().filter_map(|item| item.said.entity());
        for (nth, entity) in entities.enumerate() {
            if let Some((handle, _)) = &entity.handle {
                stated.entry(handle).or_default().push(nth);
            }
        }
        let mut names = NamesAfter::default();
        for (handle, own) in stated {
            let Bearers { before, behind } = self.bearers(handle, zone)?;
            for (&nth, number) in own.iter().zip(before..).skip(usize::from(before == 0)) {
                names.read.insert(nth, numbered(handle, number));
            }
            for (&id, number) in behind.iter().zip(before + own.len()..) {
                let before = self.drawing.get(id)?.handle.clone();
                let after = numbered(handle, number);
                if before != after {
                    let handle = handle.into();
                    names.elsewhere.push(Renamed {
                        id,
                        handle,
                        before,
                        after,
                    });
                }
            }
        }
        (names.elsewhere.len() <= FEW).then_some(names)
    }

    fn bearers(&self, handle: &str, zone: &Range<usize>) -> Option<Bearers> {
        let mut bearers = Bearers::default();
        for number in 0..=FEW {
            let Some(id) = self.drawing.find(&numbered(handle, number)) else {
                return Some(bearers);
            };
            let index = self.table.item_of(id)?;
            let item = self.table.items.get(index)?;
            let named = match number {
                0 => Named::ByText,
                _ => Named::Anew,
            };
            // What a reference draws has its handle; a handle may look like a name.
            if item.entity() != Some(id) || item.named != named {
                return None;
            }
            if index < zone.start {
                bearers.before += 1;
            } else if index >= zone.end {
                bearers.behind.push(id);
            }
        }
        None
    }

    /// Adds the findings about entities that were read and got a new name.
    pub(super) fn tell_doubled(
        &self,
        names: &NamesAfter,
        read: &[ReadItem],
        findings: &mut Vec<Finding>,
    ) {
        let lines = Lines::new(&self.text);
        let entities = read.iter().filter_map(|item| item.said.entity());
        for (nth, entity) in entities.enumerate() {
            if let Some((handle, line)) = &entity.handle
                && let Some(name) = names.read.get(&nth)
            {
                findings.push(finding(lines.trimmed_range(*line), handle, name));
            }
        }
    }

    /// Renames entities elsewhere, when those that are gone have left the drawing and before new ones enter it.
    pub(super) fn rename(&mut self, names: &NamesAfter, delta: &mut Delta) {
        let of = names.elsewhere.iter();
        let of: Vec<(EntityId, Handle)> = of.map(|it| (it.id, it.after.clone())).collect();
        if of.is_empty() {
            return;
        }
        Arc::make_mut(&mut self.drawing).rename(&of);
        for renamed in &names.elsewhere {
            let item = self.table.item_of(renamed.id);
            let Some(item) = item.and_then(|item| self.table.items.get_mut(item)) else {
                continue;
            };
            let is_anew = renamed.handle != renamed.after;
            self.table.named_anew -= usize::from(item.named == Named::Anew);
            self.table.named_anew += usize::from(is_anew);
            item.named = if is_anew { Named::Anew } else { Named::ByText };
            let entity = renamed.id;
            delta.touched.push(Touched::Entity { entity });
        }
    }

    /// Brings the findings about them up to date, when the table of the text is.
    pub(super) fn tell_renamed(&mut self, names: &NamesAfter) {
        for renamed in &names.elsewhere {
            let lines = Lines::new(&self.text);
            let Some(item) = self.table.item_of(renamed.id) else {
                continue;
            };
            let own = self.table.lines_of(item, lines.count());
            let Some(tag) = own_tags(lines, own).filter(|tag| tag.code == 5).last() else {
                continue;
            };
            let range = lines.trimmed_range(tag.value_line());
            let key = (range.start, range.end);
            let first = self.findings.partition_point(|it| range_key(it) < key);
            let mut behind = self.findings.partition_point(|it| range_key(it) <= key);
            let of = |name: &Handle| finding(range.clone(), &renamed.handle, name);
            let before = of(&renamed.before);
            let is_old = |&at: &usize| self.findings.get(at) == Some(&before);
            if let Some(old) = (first..behind).find(is_old) {
                self.findings.remove(old);
                behind -= 1;
            }
            if renamed.handle != renamed.after {
                self.findings.insert(behind, of(&renamed.after));
            }
        }
    }
}

/// The name of an entity before which this many others state the same handle.
fn numbered(handle: &str, before: usize) -> Handle {
    match before {
        0 => handle.into(),
        _ => format!("{handle}#{}", before + 1).into(),
    }
}

/// What is said where a handle stands that an entity before it has.
pub(super) fn finding(range: Range<usize>, handle: &Handle, name: &Handle) -> Finding {
    let sentence = say!(
        the_handle_is_taken_by_an_entity_before_this_one,
        handle,
        name
    );
    fault::said(range, Severity::Warning, sentence)
}
