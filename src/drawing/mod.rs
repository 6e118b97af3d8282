//! A drawing: entities by handle, in machining order, and the edits that a rule or a CAD program makes to it.
//!
//! Every kind of document (DXF text, a drawing sent by a CAD program) is one of these to the rules.
//! Coordinates are world coordinates in the drawing's own unit. Nothing here knows of text or protocols.

mod chain;
mod contour;
mod edit;
mod entity;
mod index;
mod nesting;
mod orientation;
mod outline;

pub use chain::{Chains, Key as ContourKey, Rechained, stated_role};
pub use contour::{Contour, ContourSegment, Piece};
pub use edit::{Change, ChangeError, Delta, DrawingEdit, Touched};
pub use entity::{Entity, Geometry, Role, Vertex};
pub use index::{ContourIndex, RUN};
pub use nesting::{nesting_depths, winding};
pub use orientation::{Orientation, orientation, orientation_by_extreme_point, orientation_by_turns};
pub use outline::{Outline, wire_side};

use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

/// The place of an entity in its drawing: stays the same until the entity is removed, and is not used again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EntityId(pub u32);

/// The unit of a drawing's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Millimetres in one drawing unit.
    pub mm: f64,
}

impl Unit {
    pub const MILLIMETRE: Unit = Unit { mm: 1.0 };
    pub const INCH: Unit = Unit { mm: 25.4 };
}

/// Entities by stable id, in machining order.
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    /// The unit that the drawing states; `None` where it states none and the settings decide.
    pub unit: Option<Unit>,
    slots: Vec<Option<Arc<Entity>>>,
    order: Vec<EntityId>,
    by_handle: FxHashMap<Arc<str>, EntityId>,
    /// Entities that stand for something else in the source: parts of a block, arcs fitted to a curve.
    fixed: FxHashSet<EntityId>,
}

impl Drawing {
    pub fn new(unit: Option<Unit>) -> Drawing {
        Drawing { unit, ..Drawing::default() }
    }

    /// The entity, `None` once it has been removed.
    pub fn get(&self, id: EntityId) -> Option<&Entity> {
        self.slots.get(id.0 as usize)?.as_deref()
    }

    pub fn find(&self, handle: &str) -> Option<EntityId> {
        self.by_handle.get(handle).copied()
    }

    /// Ids in machining order.
    pub fn order(&self) -> &[EntityId] {
        &self.order
    }

    /// The place of an entity in the machining order. Cheap while the order is that in which entities came.
    pub fn rank(&self, id: EntityId) -> Option<usize> {
        // Found is found, sorted or not.
        self.order.binary_search(&id).ok().or_else(|| self.order.iter().position(|&other| other == id))
    }

    /// Entities in machining order.
    pub fn entities(&self) -> impl Iterator<Item = (EntityId, &Entity)> + '_ {
        self.order.iter().filter_map(|&id| Some((id, self.get(id)?)))
    }

    pub fn len(&self) -> usize {
        self.order.len()
    }

    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// One past the largest id ever given out, for tables indexed by id.
    pub fn id_bound(&self) -> usize {
        self.slots.len()
    }

    /// Adds an entity at the end of the machining order.
    ///
    /// A handle that is taken already becomes `<handle>#2`, `#3`, …; the caller reports it where that is a fault.
    pub fn push(&mut self, entity: Entity) -> EntityId {
        self.insert_at(self.order.len(), entity)
    }

    /// Adds an entity at `position` of the machining order (clamped to its length); handles as in [`Drawing::push`].
    pub fn insert_at(&mut self, position: usize, mut entity: Entity) -> EntityId {
        let id = EntityId(self.slots.len() as u32);
        if self.by_handle.contains_key(&entity.handle) {
            let base = entity.handle.clone();
            let free = (2..).map(|n: u64| format!("{base}#{n}")).find(|name| !self.by_handle.contains_key(name.as_str()));
            entity.handle = free.expect("a free number exists").into();
        }
        self.by_handle.insert(entity.handle.clone(), id);
        self.slots.push(Some(Arc::new(entity)));
        self.order.insert(position.min(self.order.len()), id);
        id
    }

    /// Adds an entity at the end of the machining order that shares its handle with the entity that [`Drawing::find`]
    /// gives for it, as the parts of a block do. It is not editable.
    pub fn push_part(&mut self, entity: Entity) -> EntityId {
        let id = EntityId(self.slots.len() as u32);
        self.by_handle.entry(entity.handle.clone()).or_insert(id);
        self.slots.push(Some(Arc::new(entity)));
        self.order.push(id);
        self.fixed.insert(id);
        id
    }

    /// Says whether an entity is geometry of the source itself, which an edit can change.
    pub fn set_editable(&mut self, id: EntityId, editable: bool) {
        if editable {
            self.fixed.remove(&id);
        } else {
            self.fixed.insert(id);
        }
    }

    /// False for a part of a block and for arcs fitted to a curve: the source has no numbers of their own for them.
    pub fn is_editable(&self, id: EntityId) -> bool {
        !self.fixed.contains(&id)
    }

    /// Puts another entity in the place of `id`, keeping id, handle and machining order.
    pub fn replace(&mut self, id: EntityId, entity: Entity) {
        if let Some(slot) = self.slots.get_mut(id.0 as usize)
            && let Some(old) = slot.as_ref()
        {
            let handle = old.handle.clone();
            *slot = Some(Arc::new(Entity { handle, ..entity }));
        }
    }

    /// Removes the entity and gives it back. Costs the length of the machining order.
    pub fn remove(&mut self, id: EntityId) -> Option<Arc<Entity>> {
        let entity = self.take(id)?;
        self.order.retain(|&other| other != id);
        Some(entity)
    }

    /// Removes entities. Costs the length of the machining order once, however many they are.
    pub fn remove_all(&mut self, ids: &FxHashSet<EntityId>) {
        if ids.iter().filter_map(|&id| self.take(id)).count() > 0 {
            self.order.retain(|id| !ids.contains(id));
        }
    }

    fn take(&mut self, id: EntityId) -> Option<Arc<Entity>> {
        let entity = self.slots.get_mut(id.0 as usize)?.take()?;
        if self.by_handle.get(&entity.handle) == Some(&id) {
            self.by_handle.remove(&entity.handle);
        }
        self.fixed.remove(&id);
        Some(entity)
    }

    /// The vertices of a polyline, to be changed in place; copies them first when a snapshot still holds them.
    pub(crate) fn vertices_mut(&mut self, id: EntityId) -> Option<&mut Vec<Vertex>> {
        let entity = Arc::make_mut(self.slots.get_mut(id.0 as usize)?.as_mut()?);
        match &mut entity.geometry {
            Geometry::Polyline { vertices, .. } => Some(vertices),
            _ => None,
        }
    }
}
