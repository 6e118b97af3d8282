//! Which entity has a handle.

use super::{EntityId, Handle};
use rustc_hash::{FxHashMap, FxHasher};
use std::hash::{Hash, Hasher};

/// Entities by handle. Kept by a part of the handle's hash, which takes a third of the memory of the handles themselves;
/// whoever asks holds the entities, and says which handle one has.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    first: FxHashMap<u32, EntityId>,
    /// Handles whose hash is that of an entity in `first`.
    others: FxHashMap<Handle, EntityId>,
}

fn hash(handle: &str) -> u32 {
    let mut hasher = FxHasher::default();
    handle.hash(&mut hasher);
    let hash = hasher.finish();
    (hash ^ hash >> 32) as u32
}

impl Names {
    pub(super) fn find<'a>(&self, handle: &str, handle_of: impl Fn(EntityId) -> Option<&'a Handle>) -> Option<EntityId> {
        let first = self.first.get(&hash(handle)).copied();
        match first.filter(|&id| handle_of(id).is_some_and(|other| *other == *handle)) {
            Some(id) => Some(id),
            None if self.others.is_empty() => None,
            None => self.others.get(handle).copied(),
        }
    }

    /// Enters a handle. Where it is there, nothing is changed, and the answer is false.
    pub(super) fn insert<'a>(&mut self, handle: &Handle, id: EntityId, handle_of: impl Fn(EntityId) -> Option<&'a Handle>) -> bool {
        if !self.others.is_empty() && self.others.contains_key(handle) {
            return false;
        }
        let first = *self.first.entry(hash(handle)).or_insert(id);
        if first == id {
            return true;
        }
        let is_new = handle_of(first) != Some(handle);
        if is_new {
            self.others.insert(handle.clone(), id);
        }
        is_new
    }

    /// Takes out a handle of an entity.
    pub(super) fn remove(&mut self, handle: &Handle, id: EntityId) {
        let hash = hash(handle);
        if self.first.get(&hash) == Some(&id) {
            self.first.remove(&hash);
        } else if self.others.get(handle) == Some(&id) {
            self.others.remove(handle);
        }
    }

    pub(super) fn shrink_to_fit(&mut self) {
        self.first.shrink_to_fit();
    }
}
