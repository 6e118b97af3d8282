//! What is taken of a drawing: its contours, by segments.

use crate::drawing::{ContourSegment, Drawing, EntityId, Handle, Outline};
use crate::geometry::Side;
use crate::settings::Effective;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// The contours of a drawing, and what holds for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    pub(super) contours: Vec<Contour>,
    pub(super) settings: Arc<Effective>,
    /// mm of the drawing's unit.
    pub(super) unit_mm: f64,
    pub(super) handles: FxHashMap<EntityId, Handle>,
    /// What a program is written of, where that does not take long.
    pub(super) whole: Option<Whole>,
}

/// A drawing and its outlines.
#[derive(Clone, Debug)]
pub(super) struct Whole(Arc<(Drawing, Vec<Outline>)>);

impl PartialEq for Whole {
    fn eq(&self, other: &Whole) -> bool {
        let (Whole(own), Whole(other)) = (self, other);
        Arc::ptr_eq(own, other) || own.1 == other.1 && own.0.entities().eq(other.0.entities())
    }
}

/// Of more entities, or of contours of more segments, no program is written to hold another one against it.
const MOST: usize = 20_000;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contour {
    /// In the direction of travel, in the drawing's unit.
    pub segments: Vec<ContourSegment>,
    pub closed: bool,
    /// Side of the direction of travel on which the wire runs, where that is known.
    pub side: Option<Side>,
}

impl Drawn {
    /// The contours that are cut; what lies twice is taken once.
    pub fn of(drawing: &Drawing, outlines: &[Outline], settings: &Arc<Effective>) -> Drawn {
        let cut = outlines
            .iter()
            .filter(|outline| outline.contour.double_of.is_none());
        let contours: Vec<Contour> = cut
            .map(|outline| Contour {
                segments: outline.contour.segments(drawing).collect(),
                closed: outline.contour.closed,
                side: outline.wire_side(),
            })
            .collect();
        let entities = contours.iter().flat_map(|contour| &contour.segments);
        let handles = entities.filter_map(|segment| {
            let entity = drawing.get(segment.entity)?;
            Some((segment.entity, entity.handle.clone()))
        });
        let segments: usize = contours.iter().map(|contour| contour.segments.len()).sum();
        let is_small = segments.max(drawing.len()) <= MOST;
        Drawn {
            whole: is_small.then(|| Whole(Arc::new((drawing.clone(), outlines.to_vec())))),
            handles: handles.collect(),
            contours,
            settings: settings.clone(),
            unit_mm: settings.unit_of(drawing).mm,
        }
    }

    /// What a program is written of.
    pub(super) fn whole(&self) -> Option<&(Drawing, Vec<Outline>)> {
        self.whole.as_ref().map(|Whole(whole)| &**whole)
    }

    /// What an entity is called.
    pub fn handle(&self, entity: EntityId) -> &str {
        self.handles.get(&entity).map_or("", |handle| handle)
    }
}
