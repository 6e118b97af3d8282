//! Edits to a drawing, as rules make them and as CAD programs send them, and what they touched.

use super::{Drawing, Entity, EntityId, Geometry, Vertex};
use crate::geometry::Point;

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
    SetLine {
        entity: EntityId,
        start: Point,
        end: Point,
    },
    /// Angles in radians, counter-clockwise from start to end.
    SetArc {
        entity: EntityId,
        center: Point,
        radius: f64,
        start_angle: f64,
        end_angle: f64,
    },
    RemoveEntity {
        entity: EntityId,
    },
}

impl Change {
    pub fn entity(&self) -> EntityId {
        match self {
            Change::SetVertex { entity, .. }
            | Change::RemoveVertex { entity, .. }
            | Change::SetLine { entity, .. }
            | Change::SetArc { entity, .. }
            | Change::RemoveEntity { entity } => *entity,
        }
    }
}

/// What a rule wants changed: the fix of one finding, or of all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingEdit {
    pub changes: Vec<Change>,
}

/// What an edit touched, so that only that is looked at again. Several of them hold one after another.
#[derive(Clone, Debug, PartialEq)]
pub enum Touched {
    /// Vertices of one polyline: `removed` ones from `start` on gave way to `inserted` new ones.
    Vertices {
        entity: EntityId,
        start: usize,
        removed: usize,
        inserted: usize,
    },
    /// The entity is new, or another geometry stands in its place.
    Entity {
        entity: EntityId,
    },
    Removed {
        entity: EntityId,
    },
    /// Everything may have changed.
    All,
}

/// What has changed since the last look.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Delta {
    pub touched: Vec<Touched>,
}

impl Delta {
    pub fn all() -> Delta {
        Delta { touched: vec![Touched::All] }
    }
}

/// Why a change cannot apply. Nothing has been changed then.
#[derive(Clone, Debug, PartialEq)]
pub enum ChangeError {
    UnknownEntity,
    NotAPolyline,
    OutOfRange { index: usize, count: usize },
    NotFinite,
}

impl std::fmt::Display for ChangeError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ChangeError::UnknownEntity => write!(f, "there is no such entity"),
            ChangeError::NotAPolyline => write!(f, "the entity is not a polyline and has no vertices"),
            ChangeError::OutOfRange { index, count } => write!(f, "vertex {index} is out of range, the polyline has {count}"),
            ChangeError::NotFinite => write!(f, "a coordinate, radius or bulge is not a finite number, or a radius is not positive"),
        }
    }
}

impl Drawing {
    /// Replaces `delete_count` vertices of a polyline from `start` on by `insert`. Costs the edit when the count
    /// stays, else the tail of the polyline.
    ///
    /// Errors: no such entity, not a polyline, a range past its end, a number that is not finite; nothing is changed then.
    pub fn splice(&mut self, entity: EntityId, start: usize, delete_count: usize, insert: &[Vertex]) -> Result<Touched, ChangeError> {
        let count = match self.get(entity).map(|entity| &entity.geometry) {
            None => return Err(ChangeError::UnknownEntity),
            Some(Geometry::Polyline { vertices, .. }) => vertices.len(),
            Some(_) => return Err(ChangeError::NotAPolyline),
        };
        let end = start
            .checked_add(delete_count)
            .filter(|&end| end <= count)
            .ok_or(ChangeError::OutOfRange { index: start.saturating_add(delete_count), count })?;
        if !insert.iter().all(Vertex::is_finite) {
            return Err(ChangeError::NotFinite);
        }
        let vertices = self.vertices_mut(entity).ok_or(ChangeError::NotAPolyline)?;
        if delete_count == insert.len() {
            vertices[start..end].copy_from_slice(insert);
        } else {
            vertices.splice(start..end, insert.iter().copied());
        }
        Ok(Touched::Vertices { entity, start, removed: delete_count, inserted: insert.len() })
    }

    /// Applies a whole edit: all of it, or nothing and the first error.
    pub fn apply(&mut self, edit: &DrawingEdit) -> Result<Delta, ChangeError> {
        let mut result = self.clone();
        let mut delta = Delta::default();
        let mut removed_vertices = Vec::new();
        for change in &edit.changes {
            let id = change.entity();
            let old = result.get(id).ok_or(ChangeError::UnknownEntity)?;
            match *change {
                Change::SetVertex { entity, index, vertex } => delta.touched.push(result.splice(entity, index, 1, &[vertex])?),
                Change::RemoveVertex { entity, index } => removed_vertices.push((entity, index)),
                Change::SetLine { start, end, .. } => {
                    let entity = Entity { geometry: Geometry::Line { start, end }, ..old.clone() };
                    result.replace_checked(id, entity, &mut delta)?;
                }
                Change::SetArc { center, radius, start_angle, end_angle, .. } => {
                    let entity = Entity { geometry: Geometry::Arc { center, radius, start_angle, end_angle }, ..old.clone() };
                    result.replace_checked(id, entity, &mut delta)?;
                }
                Change::RemoveEntity { entity } => {
                    result.remove(entity);
                    delta.touched.push(Touched::Removed { entity });
                }
            }
        }
        // From the last index to the first, so that the indices of the edit stay true.
        removed_vertices.sort_unstable_by(|a, b| b.cmp(a));
        for (entity, index) in removed_vertices {
            delta.touched.push(result.splice(entity, index, 1, &[])?);
        }
        *self = result;
        Ok(delta)
    }

    fn replace_checked(&mut self, id: EntityId, entity: Entity, delta: &mut Delta) -> Result<(), ChangeError> {
        if !entity.geometry.is_sound() {
            return Err(ChangeError::NotFinite);
        }
        self.replace(id, entity);
        delta.touched.push(Touched::Entity { entity: id });
        Ok(())
    }
}
