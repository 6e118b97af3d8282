//! An edit of the text: what it touched is read again, and nothing else.
//!
//! A number within a vertex of a polyline costs that vertex; other edits cost the items around them. Where an edit
//! reaches further (sections, doubled handles, ordinals as names), everything is read.

use super::Document;
use super::entities::mirror;
use super::entity::{Outcome, Read};
use super::foreign;
use super::frame;
use super::lexer::{LOOKAHEAD, Lexer};
use super::lines::Lines;
use super::number::{self, Code, Number};
use super::reader::{ReadItem, Said, range_key, read_item};
use super::reading::{is_fitted, set_appearance};
use super::shape::{MOST_CURVE_ARCS, Shape, curve_arcs};
use super::table::{Became, Context, Item, NO_ITEM, Named};
use crate::drawing::{Delta, Drawing, Entity, EntityId, Handle, Touched, Vertex};
use crate::finding::{Finding, Place, Rule};
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;
use std::sync::Arc;

/// Reading begins at least this many lines before an edit: what was decided there may have looked at it.
const LOOKBACK: usize = LOOKAHEAD + 4;
/// An edit in the first bytes may change what the text is taken for.
const HEAD: usize = 1024;
/// Each entity that comes or goes costs the length of the drawing; of more than these, all are read again.
const FEW: usize = 64;

/// From so many bytes on an edit leaves the text in two pieces. Tests know no small text.
const LARGE: usize = if cfg!(test) { 1 } else { 64 * 1024 };

/// A vertex that an edit lies in: its lines before the edit, and what must stay as it is.
pub(super) struct VertexZone {
    pub(super) entity: EntityId,
    pub(super) item: usize,
    pub(super) index: usize,
    pub(super) lines: Range<usize>,
    pub(super) others: Others,
}

/// What of a vertex's lines is no part of its vertex, but decides what it is: whether it is a record of its own, z, flags.
pub(super) type Others = (bool, [Option<f64>; 2]);

/// What was known before the edit, of all that it can have touched.
struct ItemZone {
    first: usize,
    /// The last line, before the edit, that the edit touches.
    end_line: usize,
}

impl Document {
    /// Replaces a range of bytes (clamped to the text) and reads again what it touched.
    ///
    /// Ids of entities that the edit did not touch stay, unless the delta says that everything may have changed.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) -> Delta {
        let end = range.end.min(self.text.len());
        let range = range.start.min(end)..end;
        let vertex = self.vertex_zone(&range);
        let suspended = self.suspended_about(&range);
        let zone = self
            .item_zone(&range)
            .filter(|zone| !self.holds_frame(zone));
        let (old_lines, old_length) = (self.text.line_count(), self.text.len());
        if old_length < LARGE {
            self.text.replace(range.clone(), replacement);
        } else {
            self.text.replace_here(range.clone(), replacement);
        }
        let lines = self.text.line_count() as i64 - old_lines as i64;
        let bytes = self.text.len() as i64 - old_length as i64;
        if range.start >= HEAD || foreign::recognise(self.head()).is_none() {
            if let Some(delta) =
                suspended.and_then(|suspended| self.resume(suspended, &range, lines, bytes))
            {
                return delta;
            }
            if let Some(zone) = vertex
                && let Some(delta) = self
                    .reread_vertex(&zone, &range, lines, bytes)
                    .or_else(|| self.suspend(&zone, &range, lines, bytes))
            {
                return delta;
            }
            if let Some(delta) = zone.and_then(|zone| self.reread_items(&zone, lines, bytes)) {
                return delta;
            }
        }
        self.read_all();
        Delta::all()
    }

    /// The beginning of the text, by which other kinds of file are known.
    fn head(&self) -> &[u8] {
        self.text
            .slice(0..HEAD.min(self.text.len()))
            .unwrap_or_default()
    }

    /// The vertex that the edit lies in, when it leaves the first and the last byte of the vertex alone.
    /// The last vertex of a POLYLINE is none: SEQEND follows in the same lines.
    fn vertex_zone(&self, range: &Range<usize>) -> Option<VertexZone> {
        let line = self.text.line_of(range.start);
        let item = self.table.item_at(line)?;
        let Became::Entity(entity) = self.table.items.get(item)?.became else {
            return None;
        };
        let vertices = self.table.vertices.get(&entity)?;
        let lines = Lines::new(&self.text);
        let start = self.table.lines_of(item, lines.count()).start;
        let relative = line.checked_sub(start)?;
        let index = vertices
            .lines
            .partition_point(|&vertex| vertex as usize <= relative)
            .checked_sub(1)?;
        let zone = self.vertex_lines(entity, index)?;
        let inside = range.start > self.text.line_start(zone.start)
            && range.end < self.text.line_start(zone.end)
            && zone.end < lines.count();
        // A fault near by was judged by what follows it.
        let near = self.text.line_start(zone.start.saturating_sub(LOOKBACK));
        let behind = self
            .findings
            .partition_point(|finding| range_key(finding).0 < self.text.line_start(zone.end));
        let faults = self.findings[behind.saturating_sub(3)..behind]
            .iter()
            .any(|finding| {
                matches!(&finding.place, Place::Text { range } if range.end >= near)
                    && finding.rule == Rule::Syntax
            });
        if !inside || faults {
            return None;
        }
        let (_, others) = plain_vertex(lines, zone.clone())?;
        Some(VertexZone {
            entity,
            item,
            index,
            lines: zone,
            others,
        })
    }

    fn reread_vertex(
        &mut self,
        zone: &VertexZone,
        range: &Range<usize>,
        lines: i64,
        bytes: i64,
    ) -> Option<Delta> {
        let VertexZone {
            entity,
            item,
            index,
            lines: ref old,
            others,
        } = *zone;
        let end = old.end.checked_add_signed(lines as isize)?;
        let (mut vertex, others_now) = plain_vertex(Lines::new(&self.text), old.start..end)?;
        if others_now != others {
            return None;
        }
        let table = self.table.vertices.get_mut(&entity)?;
        if table.in_space {
            vertex.bulge = 0.0;
        }
        if table.mirrored {
            mirror(&mut vertex);
        }
        shift(&mut table.lines[index + 1..], lines);
        shift(&mut self.table.lines[item + 1..], lines);
        self.shift_findings(range.end, bytes);
        let touched = Arc::make_mut(&mut self.drawing)
            .splice(entity, index, 1, &[vertex])
            .ok()?;
        Some(Delta {
            touched: vec![touched],
        })
    }

    pub(super) fn shift_findings(&mut self, from: usize, bytes: i64) {
        let first = self
            .findings
            .partition_point(|finding| range_key(finding).0 < from);
        for finding in &mut self.findings[first..] {
            shift_place(finding, bytes);
        }
    }

    fn item_zone(&self, range: &Range<usize>) -> Option<ItemZone> {
        // The byte-order mark, and a text that was none.
        if range.start < 4 || self.table.items.len() < 3 {
            return None;
        }
        let line = self.text.line_of(range.start).saturating_sub(LOOKBACK);
        Some(ItemZone {
            first: self.table.item_at(line)?,
            end_line: self.text.line_of(range.end),
        })
    }

    /// True where a text with a frame stands in a zone, or at its end: what it says holds for another entity.
    fn holds_frame(&self, zone: &ItemZone) -> bool {
        let lines = Lines::new(&self.text);
        let last = || self.table.item_at(zone.end_line).map_or(0, |item| item + 1);
        let range = || {
            self.table.lines_of(zone.first, lines.count()).start
                ..self.table.lines_of(last(), lines.count()).end
        };
        !self.table.frames.is_empty() && frame::is_named_in(lines, range())
    }

    /// Reads the items from the zone's first on until one begins where one began before.
    fn reread_items(&mut self, zone: &ItemZone, lines: i64, bytes: i64) -> Option<Delta> {
        let first = zone.first;
        let (read, next, findings) = self.read_until_known(zone, lines)?;
        let plan = self.plan(first, next, &read)?;
        let old_end = self.table.lines.get(next).map(|&line| {
            // The end of the zone as it was before the edit.
            let new_start = self.text.line_start((i64::from(line) + lines) as usize);
            new_start as i64 - bytes
        });
        self.replace_findings(first, old_end.map(|end| end as usize), bytes, findings);
        let delta = self.replace_items(first..next, read, plan, lines);
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

    /// Which entity of before each entity read is. `None` where the edit reaches beyond the zone.
    fn plan(&self, first: usize, next: usize, read: &[ReadItem]) -> Option<Plan> {
        let old = &self.table.items[first..next];
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
            unit: None,
        }) && self.table.sections > 1;
        // What a layer says holds for all that lies on it.
        let layers_before = old.iter().filter_map(|item| match item.became {
            Became::Layer(index) => self.table.layers.get(index as usize),
            _ => None,
        });
        let layers_after = read.iter().filter_map(|item| match &item.said {
            Said::Layer(entry) => Some(entry),
            _ => None,
        });
        if !layers_before.eq(layers_after) {
            return None;
        }
        if before != after || second_section || self.table.items.len() - old.len() + read.len() < 3
        {
            return None;
        }
        let counted = |context: Context| context == Context::Entities;
        let entities_before = old
            .iter()
            .filter(|item| item.is_entity() && counted(item.context))
            .count();
        let entities_after = read
            .iter()
            .filter(|item| matches!(item.said, Said::Entity(_)) && counted(item.context))
            .count();
        let unnamed = read
            .iter()
            .any(|item| item.said.entity().is_some_and(|read| read.handle.is_none()));
        if entities_before != entities_after && (unnamed || self.table.by_ordinal > 0) {
            return None;
        }
        if old.iter().any(|item| item.named == Named::Anew) {
            return None;
        }
        // What a block holds, and what a reference draws, reaches beyond the zone.
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
        if read.iter().any(of_block) || old.iter().any(was_of_block) || read.iter().any(names_frame)
        {
            return None;
        }
        // Which curves are drawn where all are too many hangs on all of them.
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
        if arcs_before + arcs_after > 0 && (self.table.lacks_curves || all_arcs > MOST_CURVE_ARCS) {
            return None;
        }
        let mut ordinal = match unnamed {
            true => self.table.items[..first]
                .iter()
                .filter(|item| item.is_entity() && counted(item.context))
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
            ordinal += usize::from(matches!(item.said, Said::Entity(_)) && counted(item.context));
            let Some(entity) = item.said.entity() else {
                continue;
            };
            let handle: Handle = entity.handle.as_ref().map_or_else(
                || format!("#{ordinal}").into(),
                |(handle, _)| handle.clone(),
            );
            let at = position.get(&*handle).copied();
            // Taken by an entity elsewhere, doubled here, or moved past another one.
            let taken = at.is_none() && self.drawing.find(&handle).is_some();
            if taken || !handles.insert(handle.clone()) || (at.is_some() && at < last) {
                return None;
            }
            last = at.or(last);
            matched += usize::from(at.is_some());
            entities.push((handle, at.and_then(|at| ids.get(at).copied())));
        }
        let (gone, come) = (ids.len() - matched, entities.len() - matched);
        // An entity that was named anew may get its own handle back, or another one lose it.
        if gone + come > FEW || (self.table.named_anew > 0 && gone + come > 0) {
            return None;
        }
        Some(Plan {
            entities,
            gone: gone > 0,
            come: come > 0,
            curve_arcs: all_arcs,
        })
    }

    /// Puts the findings of the items read in the place of those of the items before.
    fn replace_findings(
        &mut self,
        first: usize,
        old_end: Option<usize>,
        bytes: i64,
        mut fresh: Vec<Finding>,
    ) {
        let start = self
            .text
            .line_start(self.table.lines.get(first).map_or(0, |&line| line as usize));
        let of_document = self
            .findings
            .iter()
            .take_while(|finding| finding.place == Place::Document)
            .count();
        let from = self
            .findings
            .partition_point(|finding| range_key(finding).0 < start)
            .max(of_document);
        let to = old_end
            .map_or(self.findings.len(), |end| {
                self.findings
                    .partition_point(|finding| range_key(finding).0 < end)
            })
            .max(from);
        for finding in &mut self.findings[to..] {
            shift_place(finding, bytes);
        }
        fresh.sort_by_key(range_key);
        self.findings.splice(from..to, fresh);
    }

    fn replace_items(
        &mut self,
        old: Range<usize>,
        read: Vec<ReadItem>,
        plan: Plan,
        lines: i64,
    ) -> Delta {
        let drawing = Arc::make_mut(&mut self.drawing);
        let table = &mut self.table;
        let mut delta = Delta::default();
        table.curve_arcs = plan.curve_arcs;
        if plan.gone {
            let kept: FxHashSet<EntityId> =
                plan.entities.iter().filter_map(|&(_, id)| id).collect();
            let gone: Vec<EntityId> = table.items[old.clone()]
                .iter()
                .filter_map(Item::entity)
                .filter(|id| !kept.contains(id))
                .collect();
            for entity in gone {
                drawing.remove(entity);
                table.vertices.remove(&entity);
                table.set_item_of(entity, NO_ITEM);
                delta.touched.push(Touched::Removed { entity });
            }
        }
        table.by_ordinal -= table.items[old.clone()]
            .iter()
            .filter(|item| item.entity().is_some() && item.named == Named::ByOrdinal)
            .count();
        let mut position = if plan.come {
            table.items[..old.start]
                .iter()
                .map(|item| item.entities().count())
                .sum()
        } else {
            0
        };
        let mut planned = plan.entities.into_iter();
        let layers: Vec<Became> = table.items[old.clone()]
            .iter()
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
                    let Some((handle, id)) = planned.next() else {
                        continue;
                    };
                    item.named = if read.handle.is_some() {
                        Named::ByText
                    } else {
                        Named::ByOrdinal
                    };
                    table.by_ordinal += usize::from(item.named == Named::ByOrdinal);
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
        let grown = items.len() != old.len();
        let end = old.start + items.len();
        table.lines.splice(old.clone(), starts);
        table.items.splice(old, items);
        shift(&mut table.lines[end..], lines);
        if grown {
            for index in end..table.items.len() {
                for entity in table.items[index].entities() {
                    table.set_item_of(entity, index as u32);
                }
            }
        }
        delta
    }
}

/// The entities read, by handle, with the id of the same entity before.
struct Plan {
    entities: Vec<(Handle, Option<EntityId>)>,
    gone: bool,
    come: bool,
    /// Of the whole table.
    curve_arcs: u64,
}

/// Puts an entity into the drawing: in the place of what it was before, or at `position` of the machining order.
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
        drawing.replace(id, entity);
        delta.touched.push(Touched::Entity { entity: id });
    }
    id
}

/// A vertex whose lines hold nothing but its own, sound tags: as it stands in the text, and what else is there.
///
/// It is a VERTEX record or a part of a LWPOLYLINE that begins with its x.
pub(super) fn plain_vertex(lines: Lines, range: Range<usize>) -> Option<(Vertex, Others)> {
    if !range.len().is_multiple_of(2) || range.end > lines.count() {
        return None;
    }
    let first = match number::code(lines.content(range.start)) {
        Code::Known(0) if lines.trimmed(range.start + 1) == b"VERTEX" => 0,
        Code::Known(10) => 10,
        _ => return None,
    };
    let [mut x, mut y, mut bulge, mut z, mut flags] = [None; 5];
    for line in range.clone().step_by(2) {
        let Code::Known(code) = number::code(lines.content(line)) else {
            return None;
        };
        let value = match code {
            10 => &mut x,
            20 => &mut y,
            42 => &mut bulge,
            30 if first == 0 => &mut z,
            70 if first == 0 => &mut flags,
            0 if first == 0 && line == range.start => continue,
            40 | 41 | 91 => continue,
            5 | 6 | 8 | 50 | 62 | 100 | 330 if first == 0 => continue,
            _ => return None,
        };
        // A second x begins another vertex.
        let another = code == 10 && value.is_some();
        if another || (code == 70 && !lines.trimmed(line + 1).iter().all(u8::is_ascii_digit)) {
            return None;
        }
        let Number::Exact(number) = number::number(lines.content(line + 1)) else {
            return None;
        };
        *value = Some(number);
    }
    Some((
        Vertex::new(x?, y?, bulge.unwrap_or(0.0)),
        (first == 0, [z, flags]),
    ))
}

pub(super) fn shift(lines: &mut [u32], by: i64) {
    if by != 0 {
        for line in lines {
            *line = line.wrapping_add(by as u32);
        }
    }
}

fn shift_place(finding: &mut Finding, bytes: i64) {
    if let Place::Text { range } = &mut finding.place {
        range.start = (range.start as i64 + bytes) as usize;
        range.end = (range.end as i64 + bytes) as usize;
    }
}
