//! Rereads the items around an edit, up to the first that begins where an old one began, and replaces the old ones.

use super::Document;
use super::doubled::NamesAfter;
use super::edit::{FEW, ItemZone, shift, shift_place};
use super::entity::{Outcome, Read};
use super::frame;
use super::lexer::Lexer;
use super::lines::Lines;
use super::reader::{ReadItem, Said, range_key, read_item};
use super::reading::{is_fitted, set_appearance};
use super::shape::{MOST_CURVE_ARCS, Shape, curve_arcs};
use super::table::{Became, Context, Item, NO_ITEM, Named};
use super::unit::StatedUnit;
use crate::drawing::{
    Delta, Drawing, Entity, EntityId, Geometry, Handle, Touched, Vertex, differing,
};
use crate::finding::{Finding, Place};
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;
use std::sync::Arc;

impl Document {
    /// Reads items from the start of the zone until one begins where one began before.
    pub(super) fn reread_items(
        &mut self,
        zone: &ItemZone,
        lines: i64,
        bytes: i64,
    ) -> Option<Delta> {
        let first = zone.first;
        let (read, next, mut findings) = self.read_until_known(zone, lines)?;
        let names = self.names_after(&(first..next), &read)?;
        let plan = self.plan(first, next, &read, &names)?;
        self.tell_doubled(&names, &read, &mut findings);
        let old_end = self.table.lines.get(next).map(|&line| {
            // The end of the zone as it was before the edit.
            let new_start = self.text.line_start((i64::from(line) + lines) as usize);
            new_start as i64 - bytes
        });
        self.replace_findings(first, old_end.map(|end| end as usize), bytes, findings);
        let delta = self.replace_items(first..next, read, (plan, &names), lines);
        self.tell_renamed(&names);
        self.name_unsupported();
        Some(delta)
    }

    fn read_until_known(
        &mut self,
        zone: &ItemZone,
        lines: i64,
    ) -> Option<(Vec<ReadItem>, usize, Vec<Finding>)> {
        let start = *self.table.lines.get(zone.first)? as usize;
        let mut context = self.table.items.get(zone.first)?.context;
        let mut lexer = Lexer::new(Lines::new(&self.text), start);
        let mut read = Vec::new();
        let mut next = zone.first + 1;
        loop {
            let at = lexer.at() as i64;
            while self
                .table
                .lines
                .get(next)
                .is_some_and(|&line| i64::from(line) + lines < at || line as usize <= zone.end_line)
            {
                next += 1;
            }
            let known = self
                .table
                .lines
                .get(next)
                .is_some_and(|&line| i64::from(line) + lines == at);
            if known
                && self
                    .table
                    .items
                    .get(next)
                    .is_some_and(|item| item.context == context)
            {
                return Some((read, next, lexer.findings));
            }
            let Some(mut item) = read_item(
                &mut lexer,
                context,
                self.table.fit_tolerance,
                &mut self.layers,
            ) else {
                return Some((read, self.table.items.len(), lexer.findings));
            };
            context = item.after;
            if let Said::Entity(outcome) = item.said {
                item.said = Said::Entity(frame::without_frames(outcome, &self.table.frames));
            }
            read.push(item);
        }
    }

    /// Which earlier entity each entity that was read continues. `None` where the edit reaches
    /// beyond the zone.
    fn plan(
        &self,
        first: usize,
        next: usize,
        read: &[ReadItem],
        names: &NamesAfter,
    ) -> Option<Plan> {
        let old = self.table.items.get(first..next)?;
        let unnamed =
            |item: &ReadItem| item.said.entity().is_some_and(|read| read.handle.is_none());
        let is_unnamed = read.iter().any(unnamed);
        if self.reaches_beyond(old, read, is_unnamed) {
            return None;
        }
        let curve_arcs = self.curve_arcs_after(old, read)?;
        let mut ordinal = match is_unnamed {
            true => self
                .table
                .items
                .iter()
                .take(first)
                .filter(|item| item.is_entity() && is_counted(item.context))
                .count(),
            false => 0,
        };
        let ids: Vec<EntityId> = old.iter().filter_map(Item::entity).collect();
        let position: FxHashMap<&str, usize> = ids
            .iter()
            .enumerate()
            .filter_map(|(at, &id)| Some((&*self.drawing.get(id)?.handle, at)))
            .collect();
        let (mut entities, mut handles, mut matched) = (Vec::new(), FxHashSet::default(), 0);
        let mut last = None;
        for item in read {
            ordinal +=
                usize::from(matches!(item.said, Said::Entity(_)) && is_counted(item.context));
            let Some(entity) = item.said.entity() else {
                continue;
            };
            let anew = names.read.get(&entities.len());
            let (handle, named): (Handle, Named) = match (&entity.handle, anew) {
                (_, Some(name)) => (name.clone(), Named::Anew),
                (Some((handle, _)), None) => (handle.clone(), Named::ByText),
                (None, None) => (format!("#{ordinal}").into(), Named::ByOrdinal),
            };
            let at = position.get(&*handle).copied();
            // An ordinal is taken by an entity elsewhere, or a handle moved past another one.
            let taken =
                named == Named::ByOrdinal && at.is_none() && self.drawing.find(&handle).is_some();
            if taken || !handles.insert(handle.clone()) || (at.is_some() && at < last) {
                return None;
            }
            last = at.or(last);
            matched += usize::from(at.is_some());
            entities.push((handle, named, at.and_then(|at| ids.get(at).copied())));
        }
        let (gone, come) = (ids.len() - matched, entities.len() - matched);
        if gone + come > FEW {
            return None;
        }
        Some(Plan {
            entities,
            gone: gone > 0,
            come: come > 0,
            curve_arcs,
        })
    }

    /// True where what was read changes more than its own entities: the sections, a layer, a block, the names by ordinal.
    fn reaches_beyond(&self, old: &[Item], read: &[ReadItem], is_unnamed: bool) -> bool {
        let structure =
            |became: &Became| matches!(became, Became::Structure { .. }).then_some(*became);
        let before: Vec<Became> = old
            .iter()
            .filter_map(|item| structure(&item.became))
            .collect();
        let after: Vec<Became> = read
            .iter()
            .filter_map(|item| item.said.structure())
            .collect();
        let second_section = before.contains(&Became::Structure {
            entities: true,
            unit: StatedUnit::default(),
        }) && self.table.sections > 1;
        // A layer entry affects everything on the layer.
        let layers_before = old.iter().filter_map(|item| match item.became {
            Became::Layer(index) => self.table.layers.get(index as usize),
            _ => None,
        });
        let layers_after = read.iter().filter_map(|item| match &item.said {
            Said::Layer(entry) => Some(entry),
            _ => None,
        });
        let is_short = self.table.items.len() - old.len() + read.len() < 3;
        if !layers_before.eq(layers_after) || before != after || second_section || is_short {
            return true;
        }
        let was_entity = |item: &&Item| item.is_entity() && is_counted(item.context);
        let is_entity =
            |item: &&ReadItem| matches!(item.said, Said::Entity(_)) && is_counted(item.context);
        let entities_before = old.iter().filter(was_entity).count();
        let entities_after = read.iter().filter(is_entity).count();
        if entities_before != entities_after && (is_unnamed || self.table.by_ordinal > 0) {
            return true;
        }
        // The content of a block, and what a reference draws, reach beyond the zone.
        let of_block = |item: &ReadItem| {
            item.context == Context::Blocks || matches!(item.said, Said::Entity(Outcome::Insert(_)))
        };
        let was_of_block = |item: &Item| {
            item.context == Context::Blocks || matches!(item.became, Became::Parts { .. })
        };
        let names_frame = |item: &ReadItem| {
            item.said
                .entity()
                .is_some_and(|read| !read.frames.is_empty())
        };
        read.iter().any(of_block) || old.iter().any(was_of_block) || read.iter().any(names_frame)
    }

    /// How many arcs the curves of the table have then; `None` where there are too many: all of them together decide which are
    /// drawn.
    fn curve_arcs_after(&self, old: &[Item], read: &[ReadItem]) -> Option<u64> {
        let arcs_before: u64 = old
            .iter()
            .filter_map(|item| self.drawing.get(item.entity()?))
            .map(|entity| curve_arcs(entity.kind, &entity.geometry))
            .sum();
        let arcs_after: u64 = read
            .iter()
            .filter_map(|item| match item.said.entity()? {
                Read {
                    kind,
                    shape: Shape::Plain(geometry),
                    ..
                } => Some(curve_arcs(*kind, geometry)),
                _ => None,
            })
            .sum();
        let all_arcs = self.table.curve_arcs - arcs_before + arcs_after;
        let has_curves = arcs_before + arcs_after > 0;
        let is_too_many = self.table.lacks_curves || all_arcs > MOST_CURVE_ARCS;
        (!has_curves || !is_too_many).then_some(all_arcs)
    }

    /// Replaces the findings of the old items by those of the new ones.
    fn replace_findings(
        &mut self,
        first: usize,
        old_end: Option<usize>,
        bytes: i64,
        fresh: Vec<Finding>,
    ) {
        let start = self
            .text
            .line_start(self.table.lines.get(first).map_or(0, |&line| line as usize));
        self.splice_findings(start..old_end.unwrap_or(usize::MAX), bytes, fresh);
    }

    /// Replaces the findings of some bytes, as they were before an edit, by those of the text as it is now, and moves
    /// those after.
    pub(super) fn splice_findings(
        &mut self,
        bytes: Range<usize>,
        moved: i64,
        mut fresh: Vec<Finding>,
    ) {
        let of_document = |finding: &&Finding| finding.place == Place::Document;
        let of_document = self.findings.iter().take_while(of_document).count();
        let begun_before = |end: usize| self.findings.partition_point(|it| range_key(it).0 < end);
        let from = begun_before(bytes.start).max(of_document);
        let to = begun_before(bytes.end).max(from);
        for finding in self.findings.iter_mut().skip(to) {
            shift_place(finding, moved);
        }
        fresh.sort_by_key(range_key);
        self.findings.splice(from..to, fresh);
    }

    fn replace_items(
        &mut self,
        old: Range<usize>,
        read: Vec<ReadItem>,
        (plan, names): (Plan, &NamesAfter),
        lines: i64,
    ) -> Delta {
        let mut delta = Delta::default();
        if plan.gone {
            self.remove_others(&old, &plan, &mut delta);
        }
        let table = &mut self.table;
        table.curve_arcs = plan.curve_arcs;
        let were_named = |named: Named| {
            items_in(&table.items, &old)
                .filter(|item| item.entity().is_some() && item.named == named)
                .count()
        };
        let (by_ordinal, anew) = (were_named(Named::ByOrdinal), were_named(Named::Anew));
        table.by_ordinal -= by_ordinal;
        table.named_anew -= anew;
        self.rename(names, &mut delta);
        let drawing = Arc::make_mut(&mut self.drawing);
        let table = &mut self.table;
        let mut position = if plan.come {
            items_in(&table.items, &(0..old.start))
                .map(|item| item.entities().count())
                .sum()
        } else {
            0
        };
        let mut planned = plan.entities.into_iter();
        let layers: Vec<Became> = items_in(&table.items, &old)
            .map(|item| item.became)
            .filter(|became| matches!(became, Became::Layer(_)))
            .collect();
        let mut layers = layers.into_iter();
        let (mut starts, mut items) = (
            Vec::with_capacity(read.len()),
            Vec::with_capacity(read.len()),
        );
        for ReadItem {
            line,
            context,
            said,
            ..
        } in read
        {
            let mut item = Item {
                context,
                became: Became::Nothing,
                named: Named::ByText,
            };
            match said {
                Said::Entity(Outcome::Entity(read)) => {
                    let Some((handle, named, id)) = planned.next() else {
                        continue;
                    };
                    item.named = named;
                    table.by_ordinal += usize::from(named == Named::ByOrdinal);
                    table.named_anew += usize::from(named == Named::Anew);
                    let Read {
                        layer,
                        appearance,
                        kind,
                        shape: Shape::Plain(geometry),
                        vertices,
                        ..
                    } = read
                    else {
                        continue;
                    };
                    let on_layer = layer.clone();
                    let entity = Entity {
                        kind,
                        ..Entity::new(handle, layer, geometry)
                    };
                    let id = put(drawing, id, position, entity, &mut delta);
                    drawing.set_fitted(id, is_fitted(kind));
                    let looks_new =
                        set_appearance(drawing, id, appearance, &on_layer, &mut table.states);
                    if looks_new && delta.touched.last() != Some(&Touched::Entity { entity: id }) {
                        delta.touched.push(Touched::Entity { entity: id });
                    }
                    let width = vertices.as_ref().map_or(0.0, |vertices| vertices.width);
                    drawing.set_width(id, width);
                    drawing.set_straight(
                        id,
                        vertices.as_ref().is_some_and(|vertices| vertices.in_space),
                    );
                    position += 1;
                    item.became = Became::Entity(id);
                    table.set_item_of(id, (old.start + items.len()) as u32);
                    match vertices {
                        Some(vertices) => table.vertices.insert(id, vertices),
                        None => table.vertices.remove(&id),
                    };
                }
                Said::Entity(Outcome::Damaged) => item.became = Became::Damaged,
                Said::Entity(Outcome::Unsupported(kind, why)) => {
                    item.became = Became::Unsupported(table.kinds.index(kind, why))
                }
                Said::Layer(_) => item.became = layers.next().unwrap_or(Became::Nothing),
                other => item.became = other.structure().unwrap_or(Became::Nothing),
            }
            starts.push(line as u32);
            items.push(item);
        }
        self.put_items(old, (starts, items), lines);
        delta
    }

    /// Removes the old entities that none of those read continues.
    fn remove_others(&mut self, old: &Range<usize>, plan: &Plan, delta: &mut Delta) {
        let kept: FxHashSet<EntityId> =
            plan.entities.iter().filter_map(|entity| entity.2).collect();
        let gone: Vec<EntityId> = items_in(&self.table.items, old)
            .filter_map(Item::entity)
            .filter(|id| !kept.contains(id))
            .collect();
        let drawing = Arc::make_mut(&mut self.drawing);
        for entity in gone {
            drawing.remove(entity);
            self.table.vertices.remove(&entity);
            self.table.set_item_of(entity, NO_ITEM);
            delta.touched.push(Touched::Removed { entity });
        }
    }

    /// Puts items, with the lines in which they begin, in place of old ones, and moves those after.
    fn put_items(&mut self, old: Range<usize>, (starts, items): (Vec<u32>, Vec<Item>), lines: i64) {
        let table = &mut self.table;
        let grown = items.len() != old.len();
        let end = old.start + items.len();
        table.lines.splice(old.clone(), starts);
        table.items.splice(old, items);
        shift(&mut table.lines, end, lines);
        if grown {
            for index in end..table.items.len() {
                let own = table.items.get(index);
                let entities: Vec<_> = own.into_iter().flat_map(Item::entities).collect();
                for entity in entities {
                    table.set_item_of(entity, index as u32);
                }
            }
        }
    }
}

/// Entities of the section of entities alone count for the names by ordinal.
fn is_counted(context: Context) -> bool {
    context == Context::Entities
}

/// The entities read, by name, with the id of the same entity before.
struct Plan {
    entities: Vec<(Handle, Named, Option<EntityId>)>,
    gone: bool,
    come: bool,
    /// Of the whole table.
    curve_arcs: u64,
}

/// Puts an entity into the drawing: in place of the old one, or at `position` of the machining order.
fn put(
    drawing: &mut Drawing,
    id: Option<EntityId>,
    position: usize,
    entity: Entity,
    delta: &mut Delta,
) -> EntityId {
    let Some(id) = id else {
        let entity = drawing.insert_at(position, entity);
        delta.touched.push(Touched::Entity { entity });
        return entity;
    };
    if drawing.get(id) != Some(&entity) {
        let touched = splice(drawing, id, &entity).unwrap_or_else(|| {
            drawing.replace(id, entity);
            Touched::Entity { entity: id }
        });
        delta.touched.push(touched);
    }
    id
}

/// Takes up the vertices in which a polyline differs, where nothing else does and they are few of many.
fn splice(drawing: &mut Drawing, id: EntityId, new: &Entity) -> Option<Touched> {
    let old = drawing.get(id)?;
    let is_alike = (&old.layer, old.role, old.kind) == (&new.layer, new.role, new.kind);
    let ((closed, old), (now_closed, new)) = (polyline(old)?, polyline(new)?);
    if !is_alike || closed != now_closed {
        return None;
    }
    let (start, removed, inserted) = differing(old, new);
    let come = new.get(start..start + inserted)?;
    let is_few = removed.max(inserted) <= FEW.min(old.len() / 4);
    is_few.then(|| drawing.splice(id, start, removed, come).ok())?
}

fn polyline(entity: &Entity) -> Option<(bool, &[Vertex])> {
    match &entity.geometry {
        Geometry::Polyline { closed, vertices } => Some((*closed, vertices)),
        _ => None,
    }
}

fn items_in<'a>(items: &'a [Item], range: &Range<usize>) -> std::slice::Iter<'a, Item> {
    items.get(range.clone()).unwrap_or_default().iter()
}
