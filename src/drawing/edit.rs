//! Edits to a drawing from rules and CAD programs, and what they touched.

use super::{Drawing, Entity, EntityId, Geometry, Vertex};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// A new vertex before the one at an index, or with `None` the removal of the one at that index.
type Moving = (usize, Option<Vertex>);

/// One change to one entity, by id. Indices are those of the drawing before the *whole* edit.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Vertex `index` of a polyline moves to `vertex.point` and its segment gets `vertex.bulge`.
    SetVertex {
        entity: EntityId,
        index: usize,
        vertex: Vertex,
    },
    RemoveVertex {
        entity: EntityId,
        index: usize,
    },
    /// A line becomes another line, an arc another arc.
    Reshape {
        entity: EntityId,
        geometry: Geometry,
    },
    RemoveEntity {
        entity: EntityId,
    },
    /// A new vertex before vertex `index` of a polyline (after the last one where `index` is their number).
    InsertVertex {
        entity: EntityId,
        index: usize,
        vertex: Vertex,
    },
    SetClosed {
        entity: EntityId,
        closed: bool,
    },
    /// A new entity on the layer of `after`, next to it in machining order.
    AddEntity {
        after: EntityId,
        geometry: Geometry,
    },
}

impl Change {
    pub(crate) fn entity(&self) -> EntityId {
        match *self {
            Change::SetVertex { entity, .. }
            | Change::RemoveVertex { entity, .. }
            | Change::Reshape { entity, .. }
            | Change::RemoveEntity { entity }
            | Change::InsertVertex { entity, .. }
            | Change::SetClosed { entity, .. }
            | Change::AddEntity { after: entity, .. } => entity,
        }
    }
}

/// The change that a rule asks for: the fix of one finding, or of all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingEdit {
    pub changes: Vec<Change>,
}

/// What an edit touched, so that only that is checked again. Several of them apply one after another.
#[derive(Clone, Debug, PartialEq)]
pub enum Touched {
    /// Vertices of one polyline: `inserted` new ones replaced the `removed` ones from `start` on.
    Vertices {
        entity: EntityId,
        start: usize,
        removed: usize,
        inserted: usize,
    },
    /// The entity is new, or its geometry has changed.
    Entity {
        entity: EntityId,
    },
    Removed {
        entity: EntityId,
    },
    /// Everything may have changed.
    All,
}

impl Touched {
    /// The entity that was touched; `None` where it may be any.
    pub(crate) fn entity(&self) -> Option<EntityId> {
        match *self {
            Touched::Vertices { entity, .. }
            | Touched::Entity { entity }
            | Touched::Removed { entity } => Some(entity),
            Touched::All => None,
        }
    }
}

/// The change since the last check.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Delta {
    pub touched: Vec<Touched>,
}

impl Delta {
    pub(crate) fn all() -> Delta {
        Delta {
            touched: vec![Touched::All],
        }
    }
}

/// Why a change cannot apply. In that case nothing has been changed.
#[derive(Clone, Debug, PartialEq)]
pub enum ChangeError {
    UnknownEntity,
    NotAPolyline,
    OutOfRange {
        index: usize,
        count: usize,
    },
    NotFinite,
    /// A part of a block, or fitted to a curve.
    NotEditable,
    /// A bulge for a polyline that can only have lines.
    OnlyLines,
}

impl std::fmt::Display for ChangeError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let sentence = match self {
            ChangeError::UnknownEntity => say!(there_is_no_such_entity),
            ChangeError::NotEditable => {
                say!(the_entity_cannot_be_edited)
            }
            ChangeError::OnlyLines => say!(the_entity_is_a_3d_polyline),
            ChangeError::NotAPolyline => say!(the_entity_is_not_a_polyline_and_has_no_vertices),
            ChangeError::NotFinite => say!(a_coordinate_radius_or_bulge_is_not_a_finite_number),
            ChangeError::OutOfRange { index, count } => {
                &say!(a_vertex_is_out_of_range, index, count)
            }
        };
        f.write_str(sentence)
    }
}

/// Where two lists of vertices differ, as a splice of the old one: its start, and how many go and come.
pub(crate) fn differing(old: &[Vertex], new: &[Vertex]) -> (usize, usize, usize) {
    let equal = |(one, other): &(&Vertex, &Vertex)| one == other;
    let start = old.iter().zip(new).take_while(equal).count();
    let behind = old[start..].iter().rev().zip(new[start..].iter().rev());
    let behind = behind.take_while(equal).count();
    let many = |vertices: &[Vertex]| vertices.len() - start - behind;
    (start, many(old), many(new))
}

impl Drawing {
    /// Replaces `delete_count` vertices of a polyline from `start` on by `insert`. Costs the length
    /// of the edit when the count stays, else that of the tail of the polyline.
    ///
    /// Errors: no such entity, not a polyline, a range past its end, a number that is not finite; nothing is changed
    /// then.
    pub fn splice(
        &mut self,
        entity: EntityId,
        start: usize,
        delete_count: usize,
        insert: &[Vertex],
    ) -> Result<Touched, ChangeError> {
        let count = self.vertex_count(entity)?;
        let end = start
            .checked_add(delete_count)
            .filter(|&end| end <= count)
            .ok_or(ChangeError::OutOfRange {
                index: start.saturating_add(delete_count),
                count,
            })?;
        if !insert.iter().all(Vertex::is_finite) {
            return Err(ChangeError::NotFinite);
        }
        let vertices = self.vertices_mut(entity).ok_or(ChangeError::NotAPolyline)?;
        if delete_count == insert.len() {
            vertices[start..end].copy_from_slice(insert);
        } else {
            vertices.splice(start..end, insert.iter().copied());
        }
        Ok(Touched::Vertices {
            entity,
            start,
            removed: delete_count,
            inserted: insert.len(),
        })
    }

    fn vertex_count(&self, entity: EntityId) -> Result<usize, ChangeError> {
        match self.get(entity).map(|entity| &entity.geometry) {
            None => Err(ChangeError::UnknownEntity),
            Some(Geometry::Polyline { vertices, .. }) => Ok(vertices.len()),
            Some(_) => Err(ChangeError::NotAPolyline),
        }
    }

    /// Applies a whole edit: all of it, or nothing and the first error. An entity that is not editable refuses every
    /// change.
    pub fn apply(&mut self, edit: &DrawingEdit) -> Result<Delta, ChangeError> {
        let mut result = self.clone();
        let mut delta = Delta::default();
        // Vertices that come and go, with the index before the edit; those that stay are changed first.
        let mut moving: BTreeMap<EntityId, Vec<Moving>> = BTreeMap::new();
        let (mut gone, mut added) = (Vec::new(), Vec::new());
        for change in &edit.changes {
            let id = change.entity();
            let old = result.get(id).ok_or(ChangeError::UnknownEntity)?;
            result.accepts(change)?;
            match change {
                Change::SetVertex { index, vertex, .. } => {
                    let touched = result.splice(id, *index, 1, &[*vertex])?;
                    delta.touched.push(touched);
                }
                Change::RemoveVertex { index, .. } => {
                    moving.entry(id).or_default().push((*index, None))
                }
                Change::InsertVertex { index, vertex, .. } => {
                    moving.entry(id).or_default().push((*index, Some(*vertex)))
                }
                Change::Reshape { geometry, .. } => {
                    delta.touched.push(result.reshape(id, geometry.clone())?)
                }
                Change::SetClosed { closed, .. } => {
                    let Geometry::Polyline { vertices, .. } = &old.geometry else {
                        return Err(ChangeError::NotAPolyline);
                    };
                    let geometry = Geometry::Polyline {
                        closed: *closed,
                        vertices: vertices.clone(),
                    };
                    delta.touched.push(result.reshape(id, geometry)?);
                }
                Change::RemoveEntity { .. } => gone.push(id),
                Change::AddEntity { geometry, .. } => added.push((id, geometry)),
            }
        }
        for (entity, moving) in moving {
            delta.touched.push(result.move_vertices(entity, moving)?);
        }
        result.add_all_next_to(added, &mut delta)?;
        result.remove_all(&gone.iter().copied().collect());
        let removed = gone.into_iter().map(|entity| Touched::Removed { entity });
        delta.touched.extend(removed);
        *self = result;
        Ok(delta)
    }

    /// Whether an entity can take a change at all, whatever its numbers are.
    pub(crate) fn accepts(&self, change: &Change) -> Result<(), ChangeError> {
        let bulge = match change {
            Change::SetVertex { vertex, .. } | Change::InsertVertex { vertex, .. } => vertex.bulge,
            _ => 0.0,
        };
        let entity = change.entity();
        let of_whole = matches!(
            change,
            Change::RemoveEntity { .. } | Change::AddEntity { .. }
        );
        match of_whole {
            true if self.is_whole(entity) => Ok(()),
            false if self.is_editable(entity) => match bulge != 0.0 && self.is_straight(entity) {
                true => Err(ChangeError::OnlyLines),
                false => Ok(()),
            },
            _ => Err(ChangeError::NotEditable),
        }
    }

    /// Inserts and removes vertices of one polyline in one pass over it. A vertex is inserted before the one at its
    /// index; of several in one place the last comes first.
    fn move_vertices(
        &mut self,
        entity: EntityId,
        mut moving: Vec<Moving>,
    ) -> Result<Touched, ChangeError> {
        let count = self.vertex_count(entity)?;
        for &(index, vertex) in &moving {
            let behind = index.saturating_add(usize::from(vertex.is_none()));
            if behind > count {
                return Err(ChangeError::OutOfRange {
                    index: behind,
                    count,
                });
            }
            if vertex.is_some_and(|vertex| !vertex.is_finite()) {
                return Err(ChangeError::NotFinite);
            }
        }
        moving.reverse();
        moving.sort_by_key(|(index, _)| *index);
        let first = moving.first().map_or(0, |(index, _)| *index);
        let end = moving
            .iter()
            .map(|(index, vertex)| index + usize::from(vertex.is_none()))
            .max()
            .unwrap_or(0);
        let vertices = self.vertices_mut(entity).ok_or(ChangeError::NotAPolyline)?;
        let mut fresh = Vec::with_capacity(end - first + moving.len());
        let mut at = 0;
        for (index, &old) in (first..).zip(&vertices[first..end]) {
            let mut stays = true;
            while let Some(&(_, vertex)) = moving.get(at).filter(|(other, _)| *other == index) {
                fresh.extend(vertex);
                stays &= vertex.is_some();
                at += 1;
            }
            fresh.extend(stays.then_some(old));
        }
        // The vertices inserted after the last removed one, or after all.
        fresh.extend(moving.drain(at..).filter_map(|(_, vertex)| vertex));
        let inserted = fresh.len();
        vertices.splice(first..end, fresh);
        Ok(Touched::Vertices {
            entity,
            start: first,
            removed: end - first,
            inserted,
        })
    }

    /// Adds entities, each after a given one in machining order (of several after the same one the
    /// last comes first), on its layer, with its role and its appearance, under a handle made from its own.
    fn add_all_next_to(
        &mut self,
        added: Vec<(EntityId, &Geometry)>,
        delta: &mut Delta,
    ) -> Result<(), ChangeError> {
        let mut behind: FxHashMap<EntityId, Vec<EntityId>> = FxHashMap::default();
        for (after, geometry) in added {
            if !geometry.is_sound() {
                return Err(ChangeError::NotFinite);
            }
            let model = self.get(after).ok_or(ChangeError::UnknownEntity)?.clone();
            // At the end for now: a place in the middle costs the length of the order, for each.
            let entity = self.push(Entity {
                geometry: geometry.clone(),
                kind: geometry.kind(),
                ..model
            });
            self.set_appearance(entity, self.appearance(after));
            behind.entry(after).or_default().push(entity);
            delta.touched.push(Touched::Entity { entity });
        }
        let count: usize = behind.values().map(Vec::len).sum();
        if count > 0 {
            let old = std::mem::take(&mut self.order);
            let kept = &old[..old.len() - count];
            self.order.reserve(old.len());
            for &id in kept {
                self.order.push(id);
                self.order
                    .extend(behind.get(&id).into_iter().flatten().rev());
            }
            self.rank_anew();
        }
        Ok(())
    }

    fn reshape(&mut self, id: EntityId, geometry: Geometry) -> Result<Touched, ChangeError> {
        if !geometry.is_sound() {
            return Err(ChangeError::NotFinite);
        }
        let old = self.get(id).ok_or(ChangeError::UnknownEntity)?.clone();
        self.replace(id, Entity { geometry, ..old });
        Ok(Touched::Entity { entity: id })
    }
}
