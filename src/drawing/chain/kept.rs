//! A contour as [`Chains`](super::Chains) keeps it, and how it is found again among those that are chained anew.

use super::super::linked::Way;
use super::super::{Contour, Drawing, EntityId};
use super::Key;
use rustc_hash::FxHashMap;
use std::sync::Arc;

#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) contour: Contour,
    /// The first of its entities in machining order.
    pub(super) first: EntityId,
    /// The contour holds as long as the ends of its entities stay, whatever lies between them.
    pub(super) by_ends: bool,
}

/// Contours without a touched entity that are chained again with their group, by their first piece: one that comes out as it was
/// keeps its key. In a map in which all borders meet, nearly all do.
pub(super) type Before = FxHashMap<EntityId, (Key, Arc<Chain>)>;

/// The contour along `way` as it was before.
pub(super) fn kept_of<'a>(
    before: &'a Before,
    entities: &[EntityId],
    (pieces, way): (&[(u32, bool)], &Way),
) -> Option<&'a (Key, Arc<Chain>)> {
    let entity = |at: u32| entities[at as usize];
    let kept = before.get(&entity(pieces.first()?.0))?;
    let Chain {
        contour,
        first,
        by_ends,
    } = &*kept.1;
    let runs = pieces.iter().map(|&(at, reversed)| (entity(at), reversed));
    let ran = (contour.pieces.iter()).map(|piece| (piece.entity, piece.reversed));
    let is_alike = (contour.closed, *first, *by_ends)
        == (way.closed, entity(way.first), way.by_ends)
        && contour.double_of == way.double_of.map(entity);
    (is_alike && runs.eq(ran)).then_some(kept)
}

impl Chain {
    /// The chain along `way`, which leads through some of these entities.
    pub(super) fn new(
        drawing: &Drawing,
        entities: &[EntityId],
        (pieces, way): (&[(u32, bool)], &Way),
        least: f64,
    ) -> Chain {
        let pieces = pieces
            .iter()
            .map(|&(at, reversed)| (entities[at as usize], reversed));
        let mut contour = Contour::of(drawing, pieces, way.closed, least);
        contour.double_of = way.double_of.map(|kept| entities[kept as usize]);
        Chain {
            contour,
            first: entities[way.first as usize],
            by_ends: way.by_ends,
        }
    }
}
