//! Finds the entity of a handle.

use super::{EntityId, Handle};
use rustc_hash::{FxHashMap, FxHasher};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hash, Hasher};

/// Entities by handle. Keyed by a part of the handle's hash, which takes a third of the memory that
/// the handles would; the caller holds the entities and supplies their handles.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    first: HashMap<u32, EntityId, BuildHasherDefault<Neighbours>>,
    /// Handles whose hash is that of an entity in `first`.
    others: FxHashMap<Handle, EntityId>,
}

/// Handles are hexadecimal numbers that mostly count up: the number is the hash.
fn hash(handle: &str) -> u32 {
    u32::from_str_radix(handle, 16).unwrap_or_else(|_| {
        let mut hasher = FxHasher::default();
        handle.hash(&mut hasher);
        let hash = hasher.finish();
        (hash ^ hash >> 32) as u32
    })
}

/// Puts consecutive numbers side by side in memory, so that entering the handles of a file does not
/// jump about in it.
#[derive(Clone, Debug, Default)]
struct Neighbours(u64);

impl Hasher for Neighbours {
    fn write_u32(&mut self, number: u32) {
        // The table takes its place from the low bits and tells entries in one place apart by the highest. Folded, so
        // that numbers in steps of a power of two do not fall into one place.
        let place = number ^ number >> 11 ^ number >> 22;
        self.0 = u64::from(place)
            | u64::from(number).wrapping_mul(0x9e37_79b9_7f4a_7c15) & 0xfe00_0000_0000_0000;
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes
            .iter()
            .for_each(|&byte| self.write_u32((self.0 as u32).rotate_left(8) ^ u32::from(byte)));
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

impl Names {
    pub(super) fn find<'a>(
        &self,
        handle: &str,
        handle_of: impl Fn(EntityId) -> Option<&'a Handle>,
    ) -> Option<EntityId> {
        let first = self.first.get(&hash(handle)).copied();
        match first.filter(|&id| handle_of(id).is_some_and(|other| *other == *handle)) {
            Some(id) => Some(id),
            None if self.others.is_empty() => None,
            None => self.others.get(handle).copied(),
        }
    }

    /// Enters a handle. False, with nothing changed, where it is taken.
    pub(super) fn insert<'a>(
        &mut self,
        handle: &Handle,
        id: EntityId,
        handle_of: impl Fn(EntityId) -> Option<&'a Handle>,
    ) -> bool {
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

    /// Removes the handle of an entity.
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
