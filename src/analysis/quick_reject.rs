//! A cheap first test of a tentative edit: rejects repairs that open a contour before anything is
//! compared. That costs a small fraction of looking at the whole drawing: without it, repairing a map takes half as long again.

use super::Analysis;
use super::contours::{chained_with, role_of};
use super::report::Tally;
use crate::drawing::{
    Contour, ContourKey, Delta, Drawing, EntityId, Piece, Role, Touched, stated_role, wire_side,
};
use crate::finding::Rule;
use crate::geometry::Bounds;
use rustc_hash::FxHashSet;

impl Analysis {
    /// The number of entities that were chained again where more contours than `before` are reported as open after an edit.
    /// `None` where only a look at the drawing can tell.
    ///
    /// The two are the drawing before and after the edit, which touched `delta`. A contour that the edit does not touch
    /// stays as it is; an untouched entity can only become a double of a touched one.
    pub(super) fn plainly_opens(
        &self,
        (drawing, edited): (&Drawing, &Drawing),
        delta: &Delta,
        before: &Tally,
    ) -> Option<usize> {
        let touched: Option<Vec<EntityId>> = delta.touched.iter().map(Touched::entity).collect();
        let touched = touched.filter(|touched| !touched.is_empty())?;
        let is_told = self.settings.severity(Rule::OpenContour).is_some();
        if !is_told || before.unseen > 0 || !self.settings.points.is_empty() {
            return None;
        }
        let mut chains = self.chains.clone();
        let rechained = chains.update_parts(edited, &touched, &|id| {
            chained_with(edited, &self.settings, id)
        });
        let new = rechained.new.iter().filter_map(|&key| chains.get(key));
        let mut open = new
            .filter(|contour| self.is_open(edited, contour))
            .peekable();
        open.peek()?;
        let touched: FxHashSet<EntityId> = touched.into_iter().collect();
        let outlook = |key| self.outlook(drawing, key);
        let doubles: Vec<[EntityId; 2]> = self.pairs.doubles(&outlook).collect();
        let all: FxHashSet<EntityId> = doubles.iter().flatten().copied().collect();
        let was_told = |key: &&ContourKey| {
            let open = self.chains.get(**key).filter(|contour| !contour.closed);
            open.is_some_and(|it| it.pieces.iter().any(|piece| !all.contains(&piece.entity)))
        };
        let told_before = rechained.gone.iter().filter(was_told).count();
        let stays = |pair: &&[EntityId; 2]| pair.iter().all(|id| !touched.contains(id));
        let doubled: FxHashSet<EntityId> =
            doubles.iter().filter(stays).flatten().copied().collect();
        let box_of = |id: EntityId| Some(edited.get(id)?.geometry.bounds(edited.flat()));
        let places: Vec<Bounds> = touched.iter().filter_map(|&id| box_of(id)).collect();
        let lies_alone = |piece: &Piece| {
            let is_apart = |own: Bounds| places.iter().all(|place| !place.touches(&own));
            !doubled.contains(&piece.entity)
                && !touched.contains(&piece.entity)
                && box_of(piece.entity).is_some_and(is_apart)
        };
        // One piece that is not a double is enough.
        let mut plainly = open.filter(|contour| contour.pieces.iter().any(lies_alone));
        plainly.nth(told_before).map(|_| rechained.chained)
    }

    /// True for a contour of several entities that is open and has no side on which the wire runs.
    fn is_open(&self, drawing: &Drawing, contour: &Contour) -> bool {
        let role = || {
            let stated = stated_role(contour, &|id| role_of(drawing, &self.settings, id));
            stated.or(self.settings.side.role()).unwrap_or(Role::Both)
        };
        // A line by itself may be one that is not cut.
        contour.pieces.len() > 1
            && !contour.closed
            && contour.double_of.is_none()
            && role() != Role::Line
            && wire_side(role(), false, 0.0).is_none()
    }
}
