//! A drawing: entities by handle, in machining order, and the edits that rules and CAD programs make to it.
//!
//! To the rules every kind of document (DXF text, a drawing sent by a CAD program) is a drawing. Coordinates are world
//! coordinates in the drawing's own unit. Nothing here knows of text or protocols.

mod appearance;
mod chain;
mod contour;
mod crumbs;
mod doubles;
mod drafting;
mod edit;
mod ends;
mod entity;
mod handle;
mod index;
mod joints;
mod kind;
mod knots;
mod linked;
mod names;
mod nesting;
mod outline;
mod slots;
mod twins;

pub(crate) use appearance::{
    Appearance, Color, Linetype, Marks, SUPPRESS, Unseen, Visibility, Wide, mark_of_layer,
};
pub use chain::Chains;
pub(crate) use chain::Key as ContourKey;
pub(crate) use chain::stated_role;
pub use contour::Contour;
pub(crate) use contour::{ContourSegment, Piece};
pub(crate) use doubles::run_together;
pub(crate) use drafting::{
    START_HOLES, is_drafting_layer, is_drafting_linetype, is_layer_of_start_holes, is_layer_of_ways,
};
pub(crate) use edit::differing;
pub use edit::{Change, Delta, DrawingEdit, Touched};
pub use entity::{Entity, EntityId, Geometry, Role, Vertex};
pub(crate) use handle::Handle;
pub(crate) use index::ContourIndex;
pub(crate) use index::RUN;
pub use kind::Kind;
pub(crate) use nesting::{lies_within, nesting_depths, turns_about, winding, winding_of};
pub use outline::Outline;
pub(crate) use outline::wire_side;
pub(crate) use twins::{are_twins, twins};

use crate::geometry::{Segment, Tolerances};
use names::Names;
use rustc_hash::{FxHashMap, FxHashSet};
use slots::Slots;
use std::sync::Arc;

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

/// The step between the ranks of neighbours: room for entities between two without renumbering.
const RANK_STEP: u64 = 1 << 24;

/// Entities by stable id, in machining order.
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    /// The unit that the drawing states; `None` where it states none and the settings decide.
    pub unit: Option<Unit>,
    /// The unit from the settings for a drawing that states none; `None` is millimetres.
    assumed_unit: Option<Unit>,
    slots: Slots,
    order: Vec<EntityId>,
    /// By id: a rank that rises in machining order, so that two entities are compared without a search. Empty while the
    /// order is that of the ids.
    ranks: Vec<u64>,
    by_handle: Names,
    /// The last number given to a taken handle, while none has become free.
    last_number: FxHashMap<Handle, u64>,
    /// Entities that represent something else in the source: parts of a block, arcs fitted to a curve.
    fixed: FxHashSet<EntityId>,
    /// Those of them that are a whole entity of the source: such an entity can be removed, or get a neighbour.
    whole: FxHashSet<EntityId>,
    /// Polylines whose vertices can have no bulge, as those of a 3D polyline.
    straight: FxHashSet<EntityId>,
    /// Entities that are not simply shown, each with the layer that decides it, or its own layer
    /// where the entity itself decides.
    unseen: FxHashMap<EntityId, (Visibility, Arc<str>)>,
    /// The largest width of each polyline that is drawn with one.
    widths: FxHashMap<EntityId, f64>,
    /// Linetypes that are not continuous.
    linetypes: FxHashMap<EntityId, Linetype>,
    /// Words that the source holds for an entity, as extended data of DXF.
    marks: FxHashMap<EntityId, Marks>,
    /// Entities on layers whose names hold such words.
    on_marked_layers: FxHashSet<EntityId>,
    /// By id: an entity's own colour. Shorter than the drawing where the last ones have none.
    colors: Vec<Option<Color>>,
    /// By the name of the layer in lower case.
    layer_colors: FxHashMap<String, Color>,
}

impl Drawing {
    pub fn new(unit: Option<Unit>) -> Drawing {
        Drawing {
            unit,
            ..Drawing::default()
        }
    }

    /// Sets the unit to assume where the drawing states none; without a call it is millimetres.
    pub(crate) fn assume_unit(&mut self, unit: Unit) {
        self.assumed_unit = Some(unit);
    }

    /// True where `Drawing::assume_unit` would change the unit.
    pub(crate) fn assumes_another(&self, unit: Unit) -> bool {
        self.assumed_unit.unwrap_or(Unit::MILLIMETRE) != unit
    }

    /// [`Tolerances::flat`] in drawing units: a segment that rises less than this above its chord is a line.
    ///
    /// [`Tolerances::flat`]: crate::geometry::Tolerances::flat
    pub(crate) fn flat(&self) -> f64 {
        self.in_units(Tolerances::default().flat)
    }

    /// [`Tolerances::certain`] in drawing units: ends this near to each other belong together whatever else is near.
    ///
    /// [`Tolerances::certain`]: crate::geometry::Tolerances::certain
    fn certain(&self) -> f64 {
        self.in_units(Tolerances::default().certain)
    }

    fn in_units(&self, mm: f64) -> f64 {
        mm / self
            .unit
            .or(self.assumed_unit)
            .unwrap_or(Unit::MILLIMETRE)
            .mm
    }

    /// Segment `index` of an entity in its own direction.
    pub(crate) fn segment(&self, id: EntityId, index: usize) -> Option<Segment> {
        self.get(id)?.geometry.segment_of(index, self.flat())
    }

    /// The entity, `None` once it has been removed.
    pub fn get(&self, id: EntityId) -> Option<&Entity> {
        self.slots.get(id)
    }

    pub(crate) fn find(&self, handle: &str) -> Option<EntityId> {
        self.by_handle
            .find(handle, |id| Some(&self.slots.get(id)?.handle))
    }

    /// Ids in machining order.
    pub fn order(&self) -> &[EntityId] {
        &self.order
    }

    /// Entities in machining order.
    pub fn entities(&self) -> impl Iterator<Item = (EntityId, &Entity)> + '_ {
        self.order
            .iter()
            .filter_map(|&id| Some((id, self.get(id)?)))
    }

    pub fn len(&self) -> usize {
        self.order.len()
    }

    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// One past the largest id ever given out, for tables indexed by id.
    pub(crate) fn id_bound(&self) -> usize {
        self.slots.len()
    }

    /// Adds an entity at the end of the machining order.
    ///
    /// A taken handle becomes `<handle>#2`, `#3`, …; the caller reports it where that is a fault.
    pub fn push(&mut self, entity: Entity) -> EntityId {
        self.insert_at(self.order.len(), entity)
    }

    /// Adds an entity at `position` of the machining order (clamped to its length); handles as in [`Drawing::push`].
    pub fn insert_at(&mut self, position: usize, mut entity: Entity) -> EntityId {
        let id = EntityId(self.slots.len() as u32);
        if !self.enter(&entity.handle, id) {
            let base = entity.handle.clone();
            let mut number = self.last_number.get(&base).map_or(2, |last| last + 1);
            while self.find(&format!("{base}#{number}")).is_some() {
                number += 1;
            }
            entity.handle = format!("{base}#{number}").into();
            self.last_number.insert(base, number);
            self.enter(&entity.handle, id);
        }
        self.slots.push(entity);
        self.look_at_layer(id);
        let position = position.min(self.order.len());
        self.rank_at(position);
        self.order.insert(position, id);
        id
    }

    /// Gives a handle to an id. False, with nothing done, where another entity has it.
    fn enter(&mut self, handle: &Handle, id: EntityId) -> bool {
        let Drawing {
            slots, by_handle, ..
        } = self;
        by_handle.insert(handle, id, |id| Some(&slots.get(id)?.handle))
    }

    /// Gives entities other handles, which no other entity has.
    pub(crate) fn rename(&mut self, names: &[(EntityId, Handle)]) {
        for &(id, _) in names {
            if let Some(entity) = self.slots.get(id) {
                self.by_handle.remove(&entity.handle, id);
            }
        }
        for (id, handle) in names {
            if let Some(entity) = self.slots.get_mut(*id) {
                entity.handle = handle.clone();
            }
            self.enter(handle, *id);
        }
        self.last_number.clear();
    }

    /// Ranks the newest entity between its neighbours at `position`.
    fn rank_at(&mut self, position: usize) {
        if self.ranks.is_empty() {
            if position == self.order.len() {
                return;
            }
            self.ranks = (1..self.slots.len() as u64)
                .map(|number| number * RANK_STEP)
                .collect();
        }
        let rank_of = |position: Option<usize>| {
            position
                .and_then(|at| self.ranks.get(self.order.get(at)?.0 as usize))
                .copied()
        };
        let before = rank_of(position.checked_sub(1)).unwrap_or(0);
        let behind = rank_of(Some(position)).unwrap_or(before + 2 * RANK_STEP);
        self.ranks.push(before + (behind - before) / 2);
        if behind - before < 2 {
            // No rank is left between the two: all entities are ranked again.
            for (at, id) in self.order.iter().enumerate() {
                let rank = (at as u64 + 1 + u64::from(at >= position)) * RANK_STEP;
                self.ranks[id.0 as usize] = rank;
            }
            if let Some(new) = self.ranks.last_mut() {
                *new = (position as u64 + 1) * RANK_STEP;
            }
        }
    }

    /// Ranks all entities by the order as it stands.
    fn rank_anew(&mut self) {
        if self.ranks.is_empty() {
            self.ranks = (1..=self.slots.len() as u64)
                .map(|number| number * RANK_STEP)
                .collect();
        }
        for (at, id) in self.order.iter().enumerate() {
            self.ranks[id.0 as usize] = (at as u64 + 1) * RANK_STEP;
        }
    }

    /// The rank of an entity, larger for later ones in machining order. Ranks may change with every edit, but not the
    /// order of two entities.
    pub fn rank(&self, id: EntityId) -> u64 {
        match self.ranks.is_empty() {
            true if (id.0 as usize) < self.slots.len() => (u64::from(id.0) + 1) * RANK_STEP,
            _ => self.ranks.get(id.0 as usize).copied().unwrap_or(u64::MAX),
        }
    }

    /// Adds an entity at the end of the machining order that shares its handle with the one that [`Drawing::find`]
    /// returns for it, as the parts of a block do. It is not editable.
    pub(crate) fn push_part(&mut self, entity: Entity) -> EntityId {
        let id = EntityId(self.slots.len() as u32);
        self.enter(&entity.handle, id);
        self.slots.push(entity);
        self.look_at_layer(id);
        self.rank_at(self.order.len());
        self.order.push(id);
        self.fixed.insert(id);
        id
    }

    /// Sets whether an entity is geometry of the source itself, which an edit can change.
    pub(crate) fn set_editable(&mut self, id: EntityId, editable: bool) {
        if editable {
            self.fixed.remove(&id);
        } else {
            self.fixed.insert(id);
        }
    }

    /// Sets whether an entity is a curve with fitted arcs: the source has no numbers for the arcs, but the curve is one
    /// entity of it.
    pub(crate) fn set_fitted(&mut self, id: EntityId, fitted: bool) {
        self.set_editable(id, !fitted);
        if fitted {
            self.whole.insert(id);
        } else {
            self.whole.remove(&id);
        }
    }

    /// Whether an entity stands in the source itself and is not part of what a block reference
    /// draws.
    pub(crate) fn is_whole(&self, id: EntityId) -> bool {
        self.is_editable(id) || self.whole.contains(&id)
    }

    /// False for a part of a block and for arcs fitted to a curve: the source has no numbers of their own for them.
    pub fn is_editable(&self, id: EntityId) -> bool {
        !self.fixed.contains(&id)
    }

    /// Sets whether a polyline can only have lines.
    pub(crate) fn set_straight(&mut self, id: EntityId, straight: bool) {
        if straight {
            self.straight.insert(id);
        } else {
            self.straight.remove(&id);
        }
    }

    /// True for a polyline that cannot take an arc: the source has no place for a bulge.
    pub(crate) fn is_straight(&self, id: EntityId) -> bool {
        self.straight.contains(&id)
    }

    /// Replaces the entity of `id`, keeping id, handle and machining order.
    pub fn replace(&mut self, id: EntityId, entity: Entity) {
        if let Some(old) = self.slots.get(id) {
            let handle = old.handle.clone();
            self.slots.set(id, Entity { handle, ..entity });
            self.look_at_layer(id);
        }
    }

    /// Removes the entity and returns it. Costs the length of the machining order.
    pub fn remove(&mut self, id: EntityId) -> Option<Arc<Entity>> {
        let entity = self.take(id)?;
        self.order.retain(|&other| other != id);
        Some(entity)
    }

    /// Restores a removed entity under its id and at its place in the machining order. False, with nothing done, where
    /// its handle is taken or the id is in use.
    pub(crate) fn put_back(&mut self, id: EntityId, entity: Arc<Entity>) -> bool {
        if id.0 as usize >= self.slots.len()
            || self.get(id).is_some()
            || !self.enter(&entity.handle, id)
        {
            return false;
        }
        self.slots.put_back(id, entity);
        self.look_at_layer(id);
        let rank = self.rank(id);
        let position = self.order.partition_point(|&other| self.rank(other) < rank);
        self.order.insert(position, id);
        true
    }

    /// Frees the memory that was reserved ahead.
    pub(crate) fn shrink_to_fit(&mut self) {
        self.slots.shrink_to_fit();
        self.order.shrink_to_fit();
        self.ranks.shrink_to_fit();
        self.by_handle.shrink_to_fit();
    }

    /// Removes entities. Costs the length of the machining order once, however many they are.
    pub(crate) fn remove_all(&mut self, ids: &FxHashSet<EntityId>) {
        if ids.iter().filter_map(|&id| self.take(id)).count() > 0 {
            self.order.retain(|id| !ids.contains(id));
        }
    }

    fn take(&mut self, id: EntityId) -> Option<Arc<Entity>> {
        let entity = self.slots.take(id)?;
        self.by_handle.remove(&entity.handle, id);
        self.last_number.clear();
        self.fixed.remove(&id);
        self.whole.remove(&id);
        self.straight.remove(&id);
        self.unseen.remove(&id);
        self.widths.remove(&id);
        self.linetypes.remove(&id);
        self.marks.remove(&id);
        self.on_marked_layers.remove(&id);
        self.set_color(id, None);
        Some(entity)
    }

    /// The vertices of a polyline, for changes in place; copies them first when a snapshot still holds them.
    pub(crate) fn vertices_mut(&mut self, id: EntityId) -> Option<&mut Vec<Vertex>> {
        match &mut self.slots.get_mut(id)?.geometry {
            Geometry::Polyline { vertices, .. } => Some(vertices),
            _ => None,
        }
    }
}
