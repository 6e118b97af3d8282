//! The repair of a drawing for a CAD program that holds it itself: which entities change, go and come, as lists of group codes.
//!
//! A *group* is a code with its value, a *group list* what AutoLISP's `entmod` and `entmake` take for one entity: points are one
//! group, angles radians. What differs is read off two texts, before and after: whatever a repair did, the lists say the same.

use super::Document;
use super::lexer::Tag;
use super::lines::Lines;
use super::number::{self, Number};
use super::place::{own_tags, vertex_tags};
use super::strings;
use super::value_type::ValueType;
use crate::drawing::{EntityId, Handle};
use rustc_hash::FxHashMap;

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum GroupValue {
    Text(String),
    Whole(i64),
    Real(f64),
    /// Two coordinates in a LWPOLYLINE, else three.
    Point(Vec<f64>),
}

pub(crate) type Group = (i16, GroupValue);

/// What becomes of one entity.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum EntityChange {
    /// Its kind (code 0) and all groups of its geometry; each code 10 of a polyline begins a vertex.
    Set {
        handle: Handle,
        groups: Vec<Group>,
    },
    Remove {
        handle: Handle,
    },
    /// A new entity, complete but for its handle and its owner; it looks and lies `like` one that was there before.
    Make {
        like: Handle,
        groups: Vec<Group>,
    },
}

/// What two entities have in common that look alike: layer, line type, colours, transparency, line weight, scale of the line type.
const LOOKS: [i16; 7] = [8, 6, 62, 420, 440, 370, 48];

/// What a new entity does not keep: handle, owner, markers of subclasses.
const NOT_MADE: [i16; 3] = [5, 330, 100];

impl Document {
    /// What makes this drawing of the one `before`: what changes, what comes, and last what goes.
    pub(crate) fn changes_since(&self, before: &Document) -> Vec<EntityChange> {
        let fresh: FxHashMap<&Handle, EntityId> = self.whole_entities().collect();
        let (mut changes, mut gone) = (Vec::new(), Vec::new());
        for (handle, old) in before.whole_entities() {
            match fresh.get(handle) {
                None => gone.push(EntityChange::Remove {
                    handle: handle.clone(),
                }),
                Some(&new) if self.record_text(new) != before.record_text(old) => {
                    changes.push(EntityChange::Set {
                        handle: handle.clone(),
                        groups: self.geometry_groups(new),
                    });
                }
                Some(_) => {}
            }
        }
        let old: FxHashMap<&Handle, EntityId> = before.whole_entities().collect();
        for (handle, id) in self.whole_entities() {
            if !old.contains_key(handle) {
                let (groups, looks) = (self.groups_to_make(id), self.looks(id));
                let mut alike = before.whole_entities();
                let alike = alike.find(|(_, old)| before.looks(*old) == looks);
                let like = alike.map_or_else(|| Handle::new(""), |(like, _)| like.clone());
                changes.push(EntityChange::Make { like, groups });
            }
        }
        changes.extend(gone);
        changes
    }

    /// The entities that have a record of their own.
    fn whole_entities(&self) -> impl Iterator<Item = (&Handle, EntityId)> {
        let entities = self.drawing.entities();
        let whole = entities.filter(|(id, _)| self.drawing.is_whole(*id));
        whole.map(|(id, entity)| (&entity.handle, id))
    }

    fn record_text(&self, id: EntityId) -> Option<&[u8]> {
        let lines = self.record_lines(id)?;
        let [start, end] = [lines.start, lines.end].map(|line| self.text.line_start(line));
        self.text.slice(start..end)
    }

    /// Its tags, up to the first that belongs to a part of it.
    fn tags_of(&self, id: EntityId) -> impl Iterator<Item = Tag> {
        let range = self.record_lines(id).unwrap_or_default();
        own_tags(Lines::new(&self.text), range)
    }

    fn looks(&self, id: EntityId) -> Vec<(i16, &[u8])> {
        let lines = Lines::new(&self.text);
        let looks = self.tags_of(id).filter(|tag| LOOKS.contains(&tag.code));
        looks
            .map(|tag| (tag.code, lines.trimmed(tag.value_line())))
            .collect()
    }

    fn kind_of(&self, id: EntityId) -> String {
        let entity = self.drawing.get(id);
        entity.map_or_else(String::new, |entity| entity.kind.to_string())
    }

    fn geometry_groups(&self, id: EntityId) -> Vec<Group> {
        let lines = Lines::new(&self.text);
        let head: Vec<Tag> = self.tags_of(id).collect();
        let number = |tags: &[Tag], code| number_of(lines, tags, code);
        let kind = self.kind_of(id);
        let mut groups = vec![(0, GroupValue::Text(kind.clone()))];
        let is_light = kind == "LWPOLYLINE";
        if !is_light && kind != "POLYLINE" {
            let own = |tag: &&Tag| matches!(tag.code, 10 | 11 | 40 | 50 | 51);
            for tag in head.iter().filter(own) {
                groups.extend(self.group(&head, *tag, 3));
            }
            return groups;
        }
        let count = self.table.vertices.get(&id).map_or(0, |it| it.lines.len());
        if is_light {
            groups.push((90, GroupValue::Whole(count as i64)));
        }
        let flags = number(&head, 70).unwrap_or(0.0);
        groups.push((70, GroupValue::Whole(flags as i64)));
        // A width of the whole polyline stands for that of each vertex.
        let of_all = number(&head, 43).filter(|_| is_light);
        let width = |code| match is_light {
            true => of_all.unwrap_or(0.0),
            false => number(&head, code).unwrap_or(0.0),
        };
        for index in 0..count {
            let Some(range) = self.vertex_lines(id, index) else {
                continue;
            };
            let tags: Vec<Tag> = vertex_tags(lines, range).collect();
            let Some(&x) = tags.iter().find(|tag| tag.code == 10) else {
                continue;
            };
            let dimensions = if is_light { 2 } else { 3 };
            groups.extend(self.group(&tags, x, dimensions));
            for (code, default) in [(40, width(40)), (41, width(41)), (42, 0.0)] {
                let value = number(&tags, code).unwrap_or(default);
                groups.push((code, GroupValue::Real(value)));
            }
        }
        groups
    }

    fn groups_to_make(&self, id: EntityId) -> Vec<Group> {
        let tags: Vec<Tag> = self.tags_of(id).collect();
        let mut groups = vec![(0, GroupValue::Text(self.kind_of(id)))];
        for tag in tags.iter().filter(|tag| !NOT_MADE.contains(&tag.code)) {
            groups.extend(self.group(&tags, *tag, 3));
        }
        groups
    }

    /// The group that a tag begins; none for the y and z of a point, which are in that of its x.
    fn group(&self, tags: &[Tag], tag: Tag, dimensions: usize) -> Option<Group> {
        let lines = Lines::new(&self.text);
        let value = || number_of(lines, &[tag], tag.code).unwrap_or(0.0);
        let value = match tag.code {
            10..=18 | 210 => {
                let others = [tag.code + 10, tag.code + 20];
                let others = others.map(|code| number_of(lines, tags, code).unwrap_or(0.0));
                let mut point = vec![value(), others[0], others[1]];
                point.truncate(dimensions);
                GroupValue::Point(point)
            }
            20..=37 | 220 | 230 => return None,
            50..=58 => GroupValue::Real(value().to_radians()),
            code => match ValueType::of(code)? {
                ValueType::Text | ValueType::Bytes => {
                    let bytes = lines.trimmed(tag.value_line());
                    GroupValue::Text(strings::decoded(bytes))
                }
                ValueType::Real => GroupValue::Real(value()),
                _ => GroupValue::Whole(value() as i64),
            },
        };
        Some((tag.code, value))
    }
}

/// The value of the last tag with a code.
fn number_of(lines: Lines, tags: &[Tag], code: i16) -> Option<f64> {
    let tag = tags.iter().rfind(|tag| tag.code == code)?;
    match number::number(lines.content(tag.value_line())) {
        Number::Exact(value) | Number::Blemished(value, _) => Some(value),
        _ => None,
    }
}
