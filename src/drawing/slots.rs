//! The entities of a drawing by id: small ones together in pages, large ones on their own.
//!
//! A copy of a drawing shares all pages with it; a page is copied when one of its entities changes while a copy exists.

use super::{Entity, EntityId, Geometry};
use std::sync::Arc;

/// Entities in one page. Few enough that copying one costs a microsecond.
const PAGE: usize = 64;

#[derive(Clone, Debug)]
enum Slot {
    Empty,
    /// Of a fixed size, so that copying a page needs no second allocation.
    Here(Entity),
    /// With a list of its own, which may be long.
    Apart(Arc<Entity>),
}

impl Slot {
    fn of(entity: Entity) -> Slot {
        match entity.geometry {
            Geometry::Polyline { .. } | Geometry::Text { .. } => Slot::Apart(Arc::new(entity)),
            Geometry::Line { .. } | Geometry::Arc { .. } | Geometry::Circle { .. } => {
                Slot::Here(entity)
            }
        }
    }

    fn entity(&self) -> Option<&Entity> {
        match self {
            Slot::Empty => None,
            Slot::Here(entity) => Some(entity),
            Slot::Apart(entity) => Some(entity),
        }
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct Slots {
    pages: Vec<Arc<Vec<Slot>>>,
    count: usize,
}

impl Slots {
    /// The number of ids that were given out.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    pub(super) fn get(&self, id: EntityId) -> Option<&Entity> {
        let index = id.0 as usize;
        self.pages.get(index / PAGE)?.get(index % PAGE)?.entity()
    }

    /// Puts an entity under the next id.
    pub(super) fn push(&mut self, entity: Entity) {
        if self.count.is_multiple_of(PAGE) {
            self.pages.push(Arc::new(Vec::with_capacity(PAGE)));
        }
        if let Some(page) = self.pages.last_mut() {
            Arc::make_mut(page).push(Slot::of(entity));
            self.count += 1;
        }
    }

    fn slot_mut(&mut self, id: EntityId) -> Option<&mut Slot> {
        let index = id.0 as usize;
        Arc::make_mut(self.pages.get_mut(index / PAGE)?).get_mut(index % PAGE)
    }

    /// Replaces the entity of an id, present or removed. Does nothing for an id that was never given out.
    pub(super) fn set(&mut self, id: EntityId, entity: Entity) {
        if let Some(slot) = self.slot_mut(id) {
            *slot = Slot::of(entity);
        }
    }

    pub(super) fn put_back(&mut self, id: EntityId, entity: Arc<Entity>) {
        if let Some(slot) = self.slot_mut(id) {
            *slot = match Arc::try_unwrap(entity) {
                Ok(entity) => Slot::of(entity),
                Err(shared) => Slot::Apart(shared),
            };
        }
    }

    pub(super) fn take(&mut self, id: EntityId) -> Option<Arc<Entity>> {
        self.get(id)?;
        match std::mem::replace(self.slot_mut(id)?, Slot::Empty) {
            Slot::Empty => None,
            Slot::Here(entity) => Some(Arc::new(entity)),
            Slot::Apart(entity) => Some(entity),
        }
    }

    /// The entity, for changes; copies it first when a copy of the drawing still holds it.
    pub(super) fn get_mut(&mut self, id: EntityId) -> Option<&mut Entity> {
        match self.slot_mut(id)? {
            Slot::Empty => None,
            Slot::Here(entity) => Some(entity),
            Slot::Apart(entity) => Some(Arc::make_mut(entity)),
        }
    }

    /// Frees the memory that was reserved ahead.
    pub(super) fn shrink_to_fit(&mut self) {
        self.pages.shrink_to_fit();
        if let Some(page) = self.pages.last_mut().and_then(Arc::get_mut) {
            page.shrink_to_fit();
        }
    }
}
