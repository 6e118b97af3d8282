//! Arcs below the correction, and the larger arc that replaces a run of them.

use super::Analysis;
use super::notable::TightArc;
use super::repair::{self, Tried, Wanted};
use crate::drawing::{ContourKey, ContourSegment, Drawing, DrawingEdit, EntityId, Kind};
use crate::finding::{Fix, FixKind, NoFix, Place, Rule, Side, SmallRadius};
use crate::rules::small_radius::{self, Replacement, Travel};
use crate::settings::Compensation;
use rustc_hash::FxHashSet;
use std::sync::Arc;

/// An arc below the correction, with its index in the contour.
type Fault = (usize, ContourSegment, SmallRadius);

impl Analysis {
    /// The repair of an arc below the correction that replaces its run by one larger arc, if that improves the drawing.
    /// The looks that this takes are added to `looks`.
    pub(super) fn larger_arc(
        &self,
        drawing: &Drawing,
        key: ContourKey,
        index: usize,
        looks: &mut u64,
    ) -> Option<Fix> {
        let proposed = self.proposed_arc(drawing, key, index)?;
        let improves = self.enlarges(drawing, &proposed.edit, None, looks);
        improves.then_some(proposed)
    }

    /// The same without the proof that it improves the drawing.
    pub(super) fn proposed_arc(
        &self,
        drawing: &Drawing,
        key: ContourKey,
        index: usize,
    ) -> Option<Fix> {
        let (travel, replacement) = self.attempt(drawing, key, index)?;
        let replacement = replacement.ok()?;
        let kind = FixKind::Refillet {
            radius: replacement.arc.radius,
            arcs: replacement.arcs,
            moved: replacement.moved,
        };
        let radius = self.chains.get(key)?.segment(drawing, index)?.geometry;
        let is_for_skims = |radius| self.limits.is_for_skims(radius);
        let in_fix_all = replacement.moved <= self.limits.correction
            && !radius.as_arc().is_some_and(|arc| is_for_skims(arc.radius));
        let edit = small_radius::drawing_edit(drawing, &[(travel, replacement)])?;
        Some(Fix {
            kind,
            preferred: true,
            in_fix_all,
            edit,
        })
    }

    pub(super) fn fix_all_arcs(&self, drawing: &Drawing, wanted: Wanted) -> Option<DrawingEdit> {
        self.settings.severity(Rule::SmallRadius)?;
        let of_contour = |(key, wire_side): (ContourKey, Option<Side>)| {
            let mut accepted: Vec<(Stretch, Travel, Replacement)> = Vec::new();
            for index in self.tight_in_entity_order(key) {
                let is_answered = matches!(self.answers.get(&(key, index)), Some(Some(_)));
                let fault = if is_answered {
                    None
                } else {
                    self.fault(drawing, key, index, wire_side)
                };
                let is_let_stand = |(at, numbers): &(ContourSegment, SmallRadius)| {
                    numbers.taken_by_skims
                        || self.reason(drawing, Rule::SmallRadius, at.entity).is_some()
                };
                if fault.as_ref().is_none_or(is_let_stand) {
                    continue;
                }
                let Some((travel, Ok(replacement))) = self.attempt(drawing, key, index) else {
                    continue;
                };
                let stretch = Stretch::of(&travel, &replacement);
                let free = accepted
                    .first()
                    .is_none_or(|(first, ..)| !first.overlaps(&stretch))
                    && accepted
                        .last()
                        .is_none_or(|(last, ..)| !last.overlaps(&stretch));
                if !free || replacement.moved > self.limits.correction {
                    continue;
                }
                let alone = [(travel, replacement)];
                let can_be_made = wanted.can.is_none_or(|can| {
                    small_radius::drawing_edit(drawing, &alone).is_some_and(|edit| can(&edit))
                });
                let [(travel, replacement)] = alone;
                if can_be_made {
                    accepted.push((stretch, travel, replacement));
                }
            }
            let replaced = accepted.into_iter();
            replaced.map(|(_, travel, replacement)| (travel, replacement))
        };
        let replacements = self
            .with_tight_arcs(drawing)
            .into_iter()
            .flat_map(of_contour);
        repair::most_together(replacements, self.tries(), wanted, |together, _| {
            let Some(edit) = small_radius::drawing_edit(drawing, together) else {
                return Tried::Worse;
            };
            let enlarges = self.enlarges(drawing, &edit, None, &mut 0);
            Tried::of(enlarges.then_some(edit))
        })
    }

    /// Contours that have tight arcs, in machining order, with the wire side of each.
    fn with_tight_arcs(&self, drawing: &Drawing) -> Vec<(ContourKey, Option<Side>)> {
        let ordered = self.in_machining_order(drawing);
        let roles = self.roles(drawing, ordered);
        let tight = ordered.iter().zip(roles).filter(|(key, _)| {
            self.known
                .get(key)
                .is_some_and(|known| known.index.tight().next().is_some())
        });
        tight
            .map(|(&key, role)| (key, self.wire_side(key, role)))
            .collect()
    }

    fn tight_in_entity_order(&self, key: ContourKey) -> Vec<usize> {
        self.known
            .get(&key)
            .map_or_else(Vec::new, |known| known.index.tight().collect())
    }

    pub(super) fn fault(
        &self,
        drawing: &Drawing,
        key: ContourKey,
        index: usize,
        wire_side: Option<Side>,
    ) -> Option<(ContourSegment, SmallRadius)> {
        let contour = self.chains.get(key)?;
        let segment = contour.segment(drawing, index)?;
        let found = small_radius::check(&segment, wire_side, &self.limits)?;
        let length = |at: Option<usize>| Some(contour.segment(drawing, at?)?.geometry.length());
        let count = contour.len();
        let beside = match contour.closed {
            true => [Some((index + count - 1) % count), Some((index + 1) % count)],
            false => [index.checked_sub(1), Some(index + 1)],
        };
        let walls = beside.into_iter().filter_map(length);
        let shorter = walls.reduce(f64::min).unwrap_or(segment.geometry.length());
        Some((segment, found.beside_walls_of(shorter)))
    }

    /// The arcs of a contour that are below the correction with the wire on a side. Arcs that were fitted to a curve count by the
    /// stretch, at its tightest one, where the wire leaves anything of the curve that could be measured.
    pub(super) fn small_radii(
        &self,
        drawing: &Drawing,
        key: ContourKey,
        wire_side: Option<Side>,
    ) -> Arc<[TightArc]> {
        let known = self.known.get(&key);
        let tight = known.into_iter().flat_map(|known| known.index.tight());
        let fault = |index| {
            let (segment, numbers) = self.fault(drawing, key, index, wire_side)?;
            Some((index, segment, numbers))
        };
        let faults: Vec<(usize, ContourSegment, SmallRadius)> = tight.filter_map(fault).collect();
        let is_fitted = |at: &ContourSegment| {
            let kind = drawing.get(at.entity).map(|entity| entity.kind);
            matches!(kind, Some(Kind::Spline | Kind::Ellipse))
        };
        let turns_left = |at: &ContourSegment| at.geometry.bulge() > 0.0;
        let are_one = |one: &ContourSegment, next: &ContourSegment| {
            one.entity == next.entity && is_fitted(one) && turns_left(one) == turns_left(next)
        };
        let follows = |one: &Fault, next: &Fault| one.0 + 1 == next.0 && are_one(&one.1, &next.1);
        let stretches = faults.chunk_by(follows).map(<[Fault]>::to_vec);
        let mut stretches: Vec<Vec<Fault>> = stretches.collect();
        // A stretch may lead over the beginning of its contour.
        if let Some(contour) = self.chains.get(key).filter(|contour| contour.closed)
            && let [first, .., last] = stretches.as_slice()
            && let (Some(begin), Some(end)) = (first.first(), last.last())
            && (begin.0, end.0 + 1) == (0, contour.len())
            && are_one(&end.1, &begin.1)
            && let Some(mut whole) = stretches.pop()
            && let Some(first) = stretches.first_mut()
        {
            whole.append(first);
            *first = whole;
        }
        let told = stretches.into_iter().filter_map(|stretch| {
            let depth = match stretch.first() {
                Some(first) if is_fitted(&first.1) => self.depth(key, &stretch, drawing),
                _ => None,
            };
            let by_radius = |one: &Fault, other: &Fault| one.2.radius.total_cmp(&other.2.radius);
            let (index, segment, mut numbers) = stretch.into_iter().min_by(by_radius)?;
            if let Some(depth) = depth {
                // A control that offsets the curve loses the arc, whatever that costs.
                if depth < self.limits.tolerances.resolution
                    && self.settings.compensation == Compensation::Path
                {
                    return None;
                }
                numbers.stock_left = depth;
            }
            Some(TightArc {
                index,
                place: Place::from(&segment),
                numbers,
            })
        });
        told.collect()
    }

    /// What the wire leaves of a stretch of fitted arcs in a row.
    fn depth(&self, key: ContourKey, stretch: &[Fault], drawing: &Drawing) -> Option<f64> {
        let ((first, segment, _), (last, ..)) = (stretch.first()?, stretch.last()?);
        let travel = Travel {
            drawing,
            contour: self.chains.get(key)?,
            index: &self.known.get(&key)?.index,
            side: small_radius::center_side(segment.geometry.bulge()),
        };
        let [one, other] = [*first, *last].map(|index| travel.position_of(index));
        let begin = match travel.side {
            Side::Left => one,
            Side::Right => other,
        };
        small_radius::depth(
            &travel,
            begin..=begin + stretch.len() as isize - 1,
            &self.limits,
        )
    }

    /// The replacement of the run with a tight arc, searched for on the side of its centre.
    pub(super) fn attempt<'a>(
        &'a self,
        drawing: &'a Drawing,
        key: ContourKey,
        index: usize,
    ) -> Option<(Travel<'a>, Result<Replacement, NoFix>)> {
        let contour = self.chains.get(key)?;
        let segment = contour.segment(drawing, index)?;
        let arc = *segment.geometry.as_arc()?;
        let travel = Travel {
            drawing,
            contour,
            index: &self.known.get(&key)?.index,
            side: small_radius::center_side(arc.sweep),
        };
        if !drawing.is_editable(segment.entity) {
            // No search: its result could not be applied, and a fitted curve may have a million tight arcs.
            return Some((travel, Err(NoFix::NotEditable)));
        }
        let position = travel.position_of(index);
        let run = small_radius::run_of(&travel, position, &self.limits)?;
        let mut found = small_radius::refillet(&travel, &run, &self.limits);
        // An arc that was drawn in two pieces and rounded is one run all the same.
        if found.is_err()
            && let Some(longer) = small_radius::rounded_run_of(&travel, position, &self.limits)
                .filter(|longer| *longer != run)
        {
            found = small_radius::refillet(&travel, &longer, &self.limits).or(found);
        }
        if let Ok(replacement) = &found
            && !(replacement.before..=replacement.after).all(|position| {
                travel
                    .segment(position)
                    .is_none_or(|segment| drawing.is_editable(segment.entity))
            })
        {
            found = Err(NoFix::NotEditable);
        }
        Some((travel, found))
    }

    /// Why a fault has no fix, `None` where it has one; stored until the contour changes.
    pub(super) fn answer(
        &mut self,
        drawing: &Drawing,
        key: ContourKey,
        index: usize,
    ) -> Option<NoFix> {
        if let Some(answer) = self.answers.get(&(key, index)) {
            return *answer;
        }
        let (travel, replacement) = self.attempt(drawing, key, index)?;
        let answer = replacement.err();
        let is_editable = |index: usize| {
            let segment = travel.contour.segment_id(drawing, index);
            segment.is_some_and(|(entity, _)| drawing.is_editable(entity))
        };
        // The replacement of one arc of a run replaces them all.
        let run = small_radius::run_of(&travel, travel.position_of(index), &self.limits)
            .filter(|_| is_editable(index));
        let alike: Vec<usize> = run
            .into_iter()
            .flatten()
            .filter_map(|position| travel.index_at(position))
            .filter(|&index| is_editable(index))
            .collect();
        self.answers.insert((key, index), answer);
        let alike = alike.into_iter().map(|index| ((key, index), answer));
        self.answers.extend(alike);
        answer
    }

    /// The number of arcs below the correction in some entities.
    pub(super) fn tight(&self, drawing: &Drawing, entities: &FxHashSet<EntityId>) -> usize {
        let entities = entities.iter().filter_map(|&id| drawing.get(id));
        let arcs = entities.flat_map(|entity| entity.geometry.segments_of(drawing.flat()));
        arcs.filter(|segment| {
            segment
                .as_arc()
                .is_some_and(|arc| small_radius::is_too_small(arc.radius, &self.limits))
        })
        .count()
    }
}

/// The part of a contour that a replacement takes, in the contour's own direction: from one place to another, in
/// segments.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: f64,
    length: f64,
    round: f64,
}

impl Stretch {
    fn of(travel: &Travel, replacement: &Replacement) -> Stretch {
        let place = |position: isize, point| {
            let share = travel.segment(position).map_or(0.0, |segment| {
                segment.geometry.share_of(point).clamp(0.0, 1.0)
            });
            position as f64 + share
        };
        let (start, end) = (
            place(replacement.before, replacement.arc.start),
            place(replacement.after, replacement.arc.end),
        );
        let round = travel.len() as f64;
        let from = match travel.side {
            Side::Left => start,
            Side::Right => round - end,
        };
        Stretch {
            from: from.rem_euclid(round),
            length: end - start,
            round,
        }
    }

    fn overlaps(&self, other: &Stretch) -> bool {
        (other.from - self.from).rem_euclid(self.round) < self.length
            || (self.from - other.from).rem_euclid(self.round) < other.length
    }
}
