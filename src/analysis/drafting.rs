//! Entities drawn only to be read, not to be cut: centre lines, hidden edges, hatches, dimensions,
//! construction.
//!
//! An entity is set aside by its linetype or its layer, whatever lies about it. A line without a role is set aside as a
//! contour of its own if it is alone, with a stretch of it within a closed contour and no end near that of another
//! contour: a chain, or an end that faces another one, belongs to an outline with something
//! missing. One that ends on a closed contour, or leads from outside into it, is a slit or a wall between two parts, and
//! never set aside; a centre line comes out again, or stays within. A closed contour with a lone line in it is still sound, so rules do not see lines that
//! are set aside; the decision is made again where something near has changed.

use super::Analysis;
use super::contours::{role_of, set_aside};
use super::end_index::{EndIndex, SHARE};
use super::report::Report;
use super::runs::{MANY_RUNS, Runs, boxes_of, is_flat};
use crate::drawing::{ContourKey, Drawing, EntityId, Role};
use crate::finding::{Aside, Detail, MOST_HANDLES, Place, Rule, SetAside};
use crate::geometry::{
    Bounds, Boxes, Grid, Line, Point, Segment, Vector, cross, line_line, meetings,
};
use crate::settings::Compensation;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, OnceLock};

/// Two ends within this many join tolerances (1 mm) always belong together, unless the other one is that of a lone line.
const JOINS: f64 = 100.0;
/// Lines up to this sine of their angle count as parallel: hatches, and the pieces of a broken line.
const PARALLEL: f64 = 0.01;

/// From this many questions on, several threads are worth while; from this share of all lines on, an index of what they
/// face.
const MANY: usize = 16;
const FEW_OF_ALL: usize = 32;

/// A contour that is one line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lone {
    pub(super) line: Line,
    /// Nothing beyond this area matters to it.
    reach: Bounds,
    pub(super) is_aside: bool,
}

impl Analysis {
    /// The contour as a line that may be set aside: one straight segment without a given role.
    pub(super) fn as_lone(&self, drawing: &Drawing, key: ContourKey) -> Option<Lone> {
        let contour = self.chains.get(key)?;
        let &[piece] = contour.pieces.as_slice() else {
            return None;
        };
        let entity = drawing.get(piece.entity)?;
        // Asked of the drawing, not of the piece, which may not know yet what became of its
        // polyline.
        let (1, false) = (entity.geometry.segment_count(), contour.closed) else {
            return None;
        };
        let Segment::Line(line) = drawing.segment(piece.entity, 0)? else {
            return None;
        };
        let settings = &self.settings;
        let has_role = role_of(drawing, settings, piece.entity).is_some();
        let join = self.limits.tolerances.certain;
        let length = line.length();
        // Where the contour is the wire's own path, or the middle of a milled slot, a single line may be all of it.
        let is_path = settings.compensation == Compensation::None || settings.mills;
        if has_role || is_path || length <= join {
            return None;
        }
        let reach = (SHARE * length).max(JOINS * join);
        Some(Lone {
            line,
            reach: Bounds::of_points(&[line.start, line.end]).grown(reach),
            is_aside: false,
        })
    }

    /// True for a contour that is not cut.
    pub(super) fn is_lone(&self, key: ContourKey) -> bool {
        self.lone.get(&key).is_some_and(|lone| lone.is_aside)
    }

    /// True for an entity in a contour that is cut.
    pub(crate) fn cuts(&self, id: EntityId) -> bool {
        self.chains
            .contour_of(id)
            .is_some_and(|key| !self.is_lone(key))
    }

    /// One finding for all visible entities that are not cut.
    pub(super) fn report_set_aside(&self, drawing: &Drawing, report: &mut Report) {
        let by_itself = self.aside.iter().filter_map(|&id| {
            let why = set_aside(drawing, &self.settings, id)?;
            let is_drawn = drawing.get(id)?.geometry.segment_count() > 0;
            (is_drawn && role_of(drawing, &self.settings, id) != Some(Role::Ignore))
                .then_some((why, id))
        });
        let lone = self.lone.iter().filter_map(|(&key, lone)| {
            let id = self.chains.first_of(key).filter(|_| lone.is_aside)?;
            Some((Aside::Lone, id))
        });
        let mut all: Vec<(Aside, EntityId)> = by_itself.chain(lone).collect();
        if all.is_empty() || !report.counts(Rule::UnsupportedEntity, None) {
            return;
        }
        all.sort_unstable_by_key(|(_, id)| drawing.rank(*id));
        let Some(&(_, first)) = all.first() else {
            return;
        };
        let mut parts: BTreeMap<&Aside, SetAside> = BTreeMap::new();
        for (why, id) in &all {
            let part = parts.entry(why).or_insert_with(|| SetAside {
                why: why.clone(),
                count: 0,
                handles: Vec::new(),
                spare_layers: Vec::new(),
            });
            part.count += 1;
            if let (Aside::Lone, true, Some(entity)) =
                (why, part.handles.len() < MOST_HANDLES, drawing.get(*id))
            {
                part.handles.push((&*entity.handle).into());
            }
        }
        if let Some(part) = parts.get_mut(&Aside::Lone) {
            let of = |(why, id): &(Aside, EntityId)| {
                (*why == Aside::Lone).then(|| Some(drawing.get(*id)?.layer.clone()))?
            };
            let mut layers: BTreeSet<Arc<str>> = all.iter().filter_map(of).collect();
            for (id, entity) in drawing.entities() {
                if layers.contains(&entity.layer) && self.cuts(id) {
                    layers.remove(&entity.layer);
                }
            }
            part.spare_layers = layers.into_iter().collect();
        }
        report.add(
            Rule::UnsupportedEntity,
            None,
            Place::Entity { entity: first },
            Detail::SetAside(parts.into_values().collect()),
            Vec::new(),
        );
    }

    /// Records whether an entity is set aside by itself.
    pub(super) fn note_aside(&mut self, drawing: &Drawing, id: EntityId) {
        let is_aside =
            drawing.visibility(id).is_seen() && set_aside(drawing, &self.settings, id).is_some();
        if is_aside {
            self.aside.insert(id);
        } else {
            self.aside.remove(&id);
        }
    }

    /// Decides about lines again; returns those whose answer has changed.
    pub(super) fn judge_lone(&mut self, drawing: &Drawing, keys: &[ContourKey]) -> Vec<ContourKey> {
        if keys.is_empty() {
            return Vec::new();
        }
        let is_closed = |key: &ContourKey| self.chains.get(*key).is_some_and(|it| it.closed);
        let sorted = self.sorted_runs(keys.len());
        let holds = |lone: &Lone, other: ContourKey| {
            is_closed(&other) && self.holds_some_of(drawing, &lone.line, other, sorted.get(&other))
        };
        let is_met = |lone: &Lone, other: ContourKey| {
            is_closed(&other) && self.is_met_by(drawing, &lone.line, other, sorted.get(&other))
        };
        // Thousands of lines may be near each other: those in no closed contour are not examined.
        // Those in one that they meet are no annotation.
        let closed = (keys.len() > MANY).then(|| {
            let mut closed = Grid::default();
            let join = self.limits.tolerances.certain;
            for (&key, known) in &self.known {
                let contour = self.chains.get(key).filter(|contour| contour.closed);
                if contour.is_some_and(|it| !is_flat(drawing, it, &known.index, join)) {
                    closed.insert(key, known.index.bounds());
                }
            }
            closed
        });
        let is_cut = |lone: &Lone, closed: &Grid<ContourKey>| {
            let is_there = |key| self.is_there(drawing, key);
            !closed.any_near(&lone.reach, |key| is_there(key) && holds(lone, key))
                || closed.any_near(&lone.reach, |key| is_there(key) && is_met(lone, key))
        };
        let (faced, boxes) = (OnceLock::new(), OnceLock::new());
        let is_sorted = keys.len() > MANY && keys.len() * FEW_OF_ALL > self.lone.len();
        let judge = |&key: &ContourKey| {
            let lone = self.lone.get(&key)?;
            if closed.as_ref().is_some_and(|closed| is_cut(lone, closed)) {
                return Some((key, false));
            }
            if is_sorted {
                let faced = faced.get_or_init(|| EndIndex::of(self, drawing));
                let is_faced = |other| {
                    other != key
                        && (self.lone.contains_key(&other) || self.is_there(drawing, other))
                        && self.faces(drawing, lone, other)
                };
                return Some((
                    key,
                    !faced.any_near(&lone.line, self.reaches_of(lone), is_faced),
                ));
            }
            let boxes = boxes.get_or_init(|| self.boxes_by_place(drawing));
            let mut near = Vec::new();
            boxes.near(&lone.reach, |key, _| near.push(key));
            let is_aside = near.iter().any(|&other| holds(lone, other))
                && !near.iter().any(|&other| is_met(lone, other))
                && !near
                    .iter()
                    .any(|&other| other != key && self.faces(drawing, lone, other));
            Some((key, is_aside))
        };
        let judged: Vec<(ContourKey, bool)> = match keys.len() > MANY {
            true => keys.par_iter().filter_map(judge).collect(),
            false => keys.iter().filter_map(judge).collect(),
        };
        let is_new = |(key, is_aside): (ContourKey, bool)| {
            let lone = self.lone.get_mut(&key)?;
            (std::mem::replace(&mut lone.is_aside, is_aside) != is_aside).then_some(key)
        };
        judged.into_iter().filter_map(is_new).collect()
    }

    /// The runs of long closed contours by place, where that many lines are asked about.
    fn sorted_runs(&self, lines: usize) -> FxHashMap<ContourKey, Boxes> {
        let is_closed = |key: &ContourKey| self.chains.get(*key).is_some_and(|it| it.closed);
        let all = self.known.iter().filter(|_| lines > MANY);
        let long = all.filter(|(key, of)| of.index.run_count() >= MANY_RUNS && is_closed(key));
        long.map(|(&key, of)| (key, boxes_of(&of.index))).collect()
    }

    /// The boxes of the contours of a drawing, and the reaches of lone lines.
    fn boxes_by_place(&self, drawing: &Drawing) -> Grid<ContourKey> {
        let mut boxes = Grid::default();
        for (&key, lone) in &self.lone {
            boxes.insert(key, lone.reach);
        }
        for (&key, known) in &self.known {
            if !self.lone.contains_key(&key) && self.is_there(drawing, key) {
                boxes.insert(key, known.index.bounds());
            }
        }
        boxes
    }

    /// True where an end of the line faces one of another contour.
    fn faces(&self, drawing: &Drawing, lone: &Lone, other: ContourKey) -> bool {
        let line = &lone.line;
        let (reach, join) = self.reaches_of(lone);
        if let Some(theirs) = self.lone.get(&other) {
            return are_a_corner(line, &theirs.line, join);
        }
        self.ends_of(drawing, other)
            .any(|end| (end - line.start).norm() <= reach || (end - line.end).norm() <= reach)
    }

    /// The distance from the ends of a line within which it faces the ends of an open contour; and within which it
    /// always faces those of another line.
    fn reaches_of(&self, lone: &Lone) -> (f64, f64) {
        let join = JOINS * self.limits.tolerances.certain;
        ((SHARE * lone.line.length()).max(join), join)
    }

    /// The ends of an open contour.
    pub(super) fn ends_of(
        &self,
        drawing: &Drawing,
        key: ContourKey,
    ) -> impl Iterator<Item = Point> {
        let contour = self.chains.get(key).filter(|contour| !contour.closed);
        let ends = contour.map(|contour| {
            let last = contour.segment(drawing, contour.len().saturating_sub(1));
            [
                contour.segment(drawing, 0).map(|it| it.geometry.start()),
                last.map(|it| it.geometry.end()),
            ]
        });
        ends.into_iter().flatten().flatten()
    }

    /// True where a stretch of the line lies within a closed contour, and not on it.
    fn holds_some_of(
        &self,
        drawing: &Drawing,
        line: &Line,
        other: ContourKey,
        sorted: Option<&Boxes>,
    ) -> bool {
        let join = self.limits.tolerances.certain;
        let (Some(contour), Some(known)) = (self.chains.get(other), self.known.get(&other)) else {
            return false;
        };
        if !contour.closed {
            return false;
        }
        let runs = Runs {
            drawing,
            contour,
            index: &known.index,
            sorted,
        };
        let own = Segment::Line(*line);
        let area = Bounds::of_points(&[line.start, line.end]).grown(join);
        let mut cuts = vec![0.0, 1.0];
        for range in runs.near(&area) {
            for segment in contour.segments_in(drawing, range) {
                let met = meetings(&own, &segment.geometry);
                cuts.extend(met.into_iter().map(|point| line.share_of(point)));
                // Where they coincide, `meetings` finds no point.
                cuts.extend(
                    [segment.geometry.start(), segment.geometry.end()]
                        .into_iter()
                        .filter(|&end| line.distance_to(end) <= join)
                        .map(|end| line.share_of(end).clamp(0.0, 1.0)),
                );
            }
        }
        cuts.sort_by(f64::total_cmp);
        let length = line.length();
        let middles = cuts
            .windows(2)
            .filter(|cut| (cut[1] - cut[0]) * length > 2.0 * join)
            .map(|cut| own.point_at(cut[0].midpoint(cut[1])));
        middles
            .into_iter()
            .any(|middle| runs.enclose(middle) && !runs.pass_by(middle, join))
    }

    /// True where the line ends on a closed contour, or has one end within it.
    fn is_met_by(
        &self,
        drawing: &Drawing,
        line: &Line,
        other: ContourKey,
        sorted: Option<&Boxes>,
    ) -> bool {
        let join = self.limits.tolerances.certain;
        let (Some(contour), Some(known)) = (self.chains.get(other), self.known.get(&other)) else {
            return false;
        };
        let runs = Runs {
            drawing,
            contour,
            index: &known.index,
            sorted,
        };
        let [starts, ends] = [line.start, line.end].map(|end| runs.enclose(end));
        starts != ends || runs.pass_by(line.start, join) || runs.pass_by(line.end, join)
    }

    /// The lines whose answer may depend on something within these boxes.
    pub(super) fn lone_near(&self, changed: &[Bounds]) -> Vec<ContourKey> {
        let touched = |lone: &Lone| changed.iter().any(|bounds| bounds.touches(&lone.reach));
        let touched = self.lone.iter().filter(|(_, lone)| touched(lone));
        let mut keys: Vec<ContourKey> = touched.map(|(&key, _)| key).collect();
        keys.sort_unstable();
        keys
    }

    /// The box within which a contour may matter: its own, and the reach of a single line.
    pub(super) fn box_of(&self, key: ContourKey) -> Option<Bounds> {
        match self.lone.get(&key) {
            Some(lone) => Some(lone.reach),
            None => Some(self.known.get(&key)?.index.bounds()),
        }
    }

    /// Divides contours into those that rules see and the lines that may be set aside, which are entered.
    pub(super) fn without_lone(
        &mut self,
        drawing: &Drawing,
        keys: Vec<ContourKey>,
    ) -> (Vec<ContourKey>, Vec<ContourKey>) {
        let (mut whole, mut lone) = (Vec::with_capacity(keys.len()), Vec::new());
        for key in keys {
            match self.as_lone(drawing, key) {
                Some(line) => {
                    self.lone.insert(key, line);
                    lone.push(key);
                }
                None => whole.push(key),
            }
        }
        (whole, lone)
    }
}

/// True where the ends of two lines face each other like the sides of a corner that has lost its
/// tip, or lie within `least` of each other; not where the lines cross, as in a centre mark, or run
/// beside each other or in line, as in a hatch.
fn are_a_corner(one: &Line, other: &Line, least: f64) -> bool {
    let (u, v) = (one.end - one.start, other.end - other.start);
    let lengths = [u.norm(), v.norm()];
    if cross(u, v).abs() <= PARALLEL * lengths[0] * lengths[1] {
        return false;
    }
    let near = least.min(SHARE * lengths[0].min(lengths[1]));
    let ends = |line: &Line| [line.start, line.end];
    let meet = ends(one)
        .iter()
        .any(|end| ends(other).iter().any(|their| (their - end).norm() <= near));
    if meet {
        return true;
    }
    let Some(tip) = line_line(one.start, u, other.start, v) else {
        return false;
    };
    let beyond = |line: &Line, along: Vector, length: f64| {
        let share = along.dot(&(tip - line.start)) / (length * length);
        let missing = if share > 1.0 { share - 1.0 } else { -share };
        (0.0..=SHARE).contains(&missing)
    };
    beyond(one, u, lengths[0]) && beyond(other, v, lengths[1])
}

pub(super) type LoneLines = FxHashMap<ContourKey, Lone>;
pub(super) type AsideEntities = FxHashSet<EntityId>;
