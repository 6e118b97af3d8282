//! The records of the text in their order: where each begins, and what it became.

use super::blocks::Blocks;
use super::entity::VertexLines;
use super::layer_table::{LayerEntry, LayerStates};
use super::unit::StatedUnit;
use crate::drawing::EntityId;
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

/// The section in which a record stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Context {
    Outside,
    Entities,
    /// The blocks that references draw.
    Blocks,
    /// Any other section: kept, not drawn.
    Other,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Became {
    /// Text that is kept and does not concern the modelspace.
    Nothing,
    /// SECTION, ENDSEC or EOF: it decides what the records after it are. A HEADER states the unit.
    Structure {
        /// The section ENTITIES begins.
        entities: bool,
        unit: StatedUnit,
    },
    Entity(EntityId),
    /// A reference to a block: `count` entities with ids in a row, from `first` on.
    Parts {
        first: EntityId,
        count: u32,
    },
    /// A block begins.
    Block,
    /// An entry of the table LAYER, by its index in [`Table::layers`].
    Layer(u32),
    /// An entity that is not cut, by its index in [`Kinds`].
    Unsupported(u32),
    /// An entity with a fault.
    Damaged,
}

/// The source of an entity's handle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Named {
    ByText,
    ByOrdinal,
    /// The handle in the text was already taken.
    Anew,
}

/// One record, or a POLYLINE or INSERT with the records that belong to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Item {
    /// Its section, before any change of section that it makes.
    pub(crate) context: Context,
    pub(crate) became: Became,
    pub(crate) named: Named,
}

impl Item {
    pub(crate) fn entity(&self) -> Option<EntityId> {
        match self.became {
            Became::Entity(entity) => Some(entity),
            _ => None,
        }
    }

    /// All entities that it became.
    pub(crate) fn entities(&self) -> impl Iterator<Item = EntityId> + use<> {
        let (first, count) = match self.became {
            Became::Entity(entity) => (entity, 1),
            Became::Parts { first, count } => (first, count),
            _ => (EntityId(0), 0),
        };
        (first.0..first.0.saturating_add(count)).map(EntityId)
    }

    /// True for what counts as an entity of the file.
    pub(crate) fn is_entity(&self) -> bool {
        matches!(
            self.became,
            Became::Entity(_) | Became::Parts { .. } | Became::Unsupported(_) | Became::Damaged
        )
    }
}

pub(crate) const NO_ITEM: u32 = u32::MAX;

/// Kinds of entities that are not cut, with the reason; each once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Kinds {
    kinds: Vec<(String, &'static str)>,
    by_name: FxHashMap<(String, &'static str), u32>,
}

impl Kinds {
    pub(crate) fn index(&mut self, kind: String, why: &'static str) -> u32 {
        let key = (kind, why);
        if let Some(&index) = self.by_name.get(&key) {
            return index;
        }
        let index = self.kinds.len() as u32;
        self.kinds.push(key.clone());
        self.by_name.insert(key, index);
        index
    }

    pub(crate) fn get(&self, index: u32) -> Option<&(String, &'static str)> {
        self.kinds.get(index as usize)
    }

    pub(crate) fn len(&self) -> usize {
        self.kinds.len()
    }
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    /// The first line of each item, ascending, the first of them 0.
    pub(crate) lines: Vec<u32>,
    pub(crate) items: Vec<Item>,
    /// The item of each entity, by its id.
    pub(crate) item_of: Vec<u32>,
    pub(crate) vertices: FxHashMap<EntityId, Box<VertexLines>>,
    pub(crate) kinds: Kinds,
    /// What in a block is not cut, and why, by the first entity that its reference became: kind and count.
    pub(crate) left_out: FxHashMap<EntityId, Vec<(u32, usize)>>,
    pub(crate) layers: Vec<LayerEntry>,
    pub(super) states: LayerStates,
    /// Entities that are named by their ordinal, and those that were renamed.
    pub(crate) by_ordinal: usize,
    pub(crate) named_anew: usize,
    /// Blocks that are drawn somewhere, in the order of the text.
    pub(crate) used: Vec<bool>,
    /// The blocks themselves, for references that are drawn again.
    pub(super) blocks: Arc<Blocks>,
    /// Arcs that the curves take beyond their free allowance, and whether a curve was left out
    /// because all together would take too many.
    pub(crate) curve_arcs: u64,
    pub(crate) lacks_curves: bool,
    /// The largest distance of a fitted arc from its curve, in drawing units.
    pub(crate) fit_tolerance: f64,
    /// Sections ENTITIES.
    pub(crate) sections: usize,
    /// Handles of entities that are the frame of a text.
    pub(crate) frames: FxHashSet<u64>,
}

impl Table {
    /// The item that holds a line.
    pub(crate) fn item_at(&self, line: usize) -> Option<usize> {
        self.lines
            .partition_point(|&start| start as usize <= line)
            .checked_sub(1)
    }

    /// The item of an entity.
    pub(crate) fn item_of(&self, entity: EntityId) -> Option<usize> {
        self.item_of
            .get(entity.0 as usize)
            .filter(|&&item| item != NO_ITEM)
            .map(|&item| item as usize)
    }

    /// First and one past the last line of an item; `line_count` ends the last one.
    pub(crate) fn lines_of(&self, item: usize, line_count: usize) -> std::ops::Range<usize> {
        let start = self
            .lines
            .get(item)
            .map_or(line_count, |&line| line as usize);
        start
            ..self
                .lines
                .get(item + 1)
                .map_or(line_count, |&line| line as usize)
    }

    /// Frees the memory that was reserved ahead.
    pub(crate) fn shrink_to_fit(&mut self) {
        self.lines.shrink_to_fit();
        self.items.shrink_to_fit();
        self.item_of.shrink_to_fit();
        self.vertices.shrink_to_fit();
    }

    pub(crate) fn set_item_of(&mut self, entity: EntityId, item: u32) {
        let index = entity.0 as usize;
        if index >= self.item_of.len() {
            self.item_of.resize(index + 1, NO_ITEM);
        }
        if let Some(own) = self.item_of.get_mut(index) {
            *own = item;
        }
    }
}
