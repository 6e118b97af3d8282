//! A part of the drawing about an edit, in which the edit has the same effect as in the whole: to
//! know whether a repair helps, only what is near it is looked at.

use super::known::Known;
use super::repair::{Tried, Wanted};
use super::{Analysis, electrode};
use crate::drawing::{Change, ContourKey, Drawing, DrawingEdit, EntityId, RUN};
use crate::geometry::Bounds;
use crate::rules::units;
use crate::settings::SideSetting;
use crate::toolpath;
use rustc_hash::FxHashSet;
use std::sync::Arc;

/// In a smaller drawing, in segments, a look at all of it costs no more. Tests go this way with small ones.
const SMALL: usize = if cfg!(test) { 16 } else { 4096 };

/// What may matter to an observation lies within this many reaches of the rules: the other segment,
/// and what lies in the disc between two.
const REACHES: f64 = 3.0;

/// The contours that an edit touches and all that come near them, as a drawing of its own.
struct Nearby {
    drawing: Drawing,
    analysis: Analysis,
    /// The edit of this drawing.
    edit: DrawingEdit,
}

impl Analysis {
    /// What an edit makes of the drawing; if only the existence of a repair is asked for, of the
    /// part near it, where that gives the same answer.
    pub(super) fn made_of<M>(
        &self,
        drawing: &Drawing,
        edit: &DrawingEdit,
        wanted: Wanted,
        made: impl Fn(&Analysis, &Drawing, &DrawingEdit) -> Tried<M>,
    ) -> Tried<M> {
        let Some(near) = self.nearby(drawing, edit, wanted) else {
            return made(self, drawing, edit);
        };
        let tried = made(&near.analysis, &near.drawing, &near.edit);
        debug_assert_eq!(
            tried.is_better(),
            made(self, drawing, edit).is_better(),
            "{edit:?}"
        );
        tried
    }

    /// The part near an edit, if only the existence of a repair is asked for. The edit adds and
    /// removes the same findings in that part as in the whole. `None` where only the whole can
    /// tell.
    fn nearby(&self, drawing: &Drawing, edit: &DrawingEdit, wanted: Wanted) -> Option<Nearby> {
        if !wanted.first_will_do || self.segments < SMALL || self.hangs_on_all() {
            return None;
        }
        let touched: FxHashSet<EntityId> = edit.changes.iter().map(Change::entity).collect();
        let mut area = Bounds::EMPTY;
        for &id in &touched {
            let key = self.chains.contour_of(id)?;
            let grouped = self.chains.grouped_with(key).iter().copied();
            for key in grouped.chain([key]) {
                area.merge(&self.known.get(&key)?.index.bounds());
            }
        }
        let reach = self.pairs.reach.max(self.limits.tolerances.join);
        let about = area.grown(REACHES * reach);
        if !self.lone_near(&[about]).is_empty() {
            return None;
        }
        let mut near: FxHashSet<ContourKey> = FxHashSet::default();
        self.pairs.each_near(&about, |key| {
            if near.insert(key) {
                near.extend(self.chains.grouped_with(key));
            }
        });
        // Where no contour is large enough to be cut, the unit is in doubt: one that stays shows that it is not.
        let stays = self.sizable_beside(drawing, &near)?;
        near.extend(self.chains.grouped_with(stays).iter().chain([&stays]));
        let mut of = FxHashSet::default();
        let mut segments = 0;
        for key in near {
            let contour = self.chains.get(key)?;
            segments += contour.len();
            of.extend(contour.pieces.iter().map(|piece| piece.entity));
        }
        if segments > self.segments / 4 {
            return None;
        }
        let (part, ids) = drawing.part(&of);
        let of_part = |change: &Change| Some(change.of(*ids.get(&change.entity())?));
        let changes: Option<Vec<Change>> = edit.changes.iter().map(of_part).collect();
        let edit = DrawingEdit { changes: changes? };
        let mut edited = part.clone();
        let delta = edited.apply(&edit).ok()?;
        let within = area.grown(reach);
        let stays = |id: EntityId| {
            let entity = edited.get(id);
            entity.is_none_or(|entity| within.holds(&entity.geometry.bounds(edited.flat())))
        };
        let mut touched = delta.touched.iter();
        if !touched.all(|touched| touched.entity().is_some_and(stays)) {
            return None;
        }
        let analysis = Analysis::new(&part, self.settings.clone());
        let is_alike = analysis.lone.is_empty() && analysis.pairs.uncompared() == 0;
        #[cfg(test)]
        tests::PARTS.set(tests::PARTS.get() + usize::from(is_alike));
        is_alike.then_some(Nearby {
            drawing: part,
            analysis,
            edit,
        })
    }

    /// A contour of few segments that is large enough to be cut and is none of these.
    fn sizable_beside(
        &self,
        drawing: &Drawing,
        near: &FxHashSet<ContourKey>,
    ) -> Option<ContourKey> {
        let is_sizable = |(key, known): &(&ContourKey, &Arc<Known>)| {
            known.index.len() <= RUN
                && !near.contains(key)
                && units::is_sizable(&known.index.bounds(), self.limits.unit_mm)
                && self.is_there(drawing, **key)
        };
        let found = self.known.iter().find(is_sizable);
        found.map(|(&key, _)| key)
    }

    /// True where a finding may depend on something far off.
    fn hangs_on_all(&self) -> bool {
        let settings = &self.settings;
        settings.side != SideSetting::Both
            || self.stated > 0
            || !settings.points.is_empty()
            || !settings.workpieces.is_empty()
            || settings.start_hole.is_some()
            || toolpath::is_stated(settings)
            || electrode::beside_wire(settings).is_some()
            || self.asked_partners().is_some()
            || self.pairs.uncompared() > 0
            || !self.vast.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Entity, Geometry, Vertex};
    use crate::geometry::Point;
    use crate::settings::Effective;
    use proptest::prelude::*;
    use std::cell::Cell;
    use std::f64::consts::TAU;

    /// A fault, or a sound neighbour, about the origin. Sizes are in hundredths of the correction's order, 0.01 mm.
    fn figure(kind: usize, size: f64) -> Vec<Geometry> {
        let small = 0.01 * size;
        let line = |from: (f64, f64), to: (f64, f64)| Geometry::Line {
            start: Point::new(from.0, from.1),
            end: Point::new(to.0, to.1),
        };
        let outline = |closed, corners: &[(f64, f64, f64)]| Geometry::Polyline {
            closed,
            vertices: corners
                .iter()
                .map(|&(x, y, b)| Vertex::new(x, y, b))
                .collect(),
        };
        let square = |x: f64| {
            outline(
                true,
                &[
                    (x, 0.0, 0.0),
                    (x + 1.0, 0.0, 0.0),
                    (x + 1.0, 1.0, 0.0),
                    (x, 1.0, 0.0),
                ],
            )
        };
        let circle = |radius| Geometry::Circle {
            center: Point::new(0.5, 0.5),
            radius,
        };
        let bulge = (TAU / 16.0).tan();
        match kind {
            // A corner with a tight arc.
            0 => vec![outline(
                true,
                &[
                    (small, 0.0, 0.0),
                    (1.0, 0.0, 0.0),
                    (1.0, 1.0, 0.0),
                    (0.0, 1.0, 0.0),
                    (0.0, small, bulge),
                ],
            )],
            // A short segment.
            1 => vec![outline(
                true,
                &[
                    (0.0, 0.0, 0.0),
                    (0.5, 0.0, 0.0),
                    (0.5 + 0.04 * small, 0.0, 0.0),
                    (1.0, 0.0, 0.0),
                    (1.0, 1.0, 0.0),
                ],
            )],
            // Lines that nearly meet, and cross others that come near.
            2 => vec![
                line((0.0, 0.0), (1.0, 0.0)),
                line((1.0, 0.1 * small), (1.0, 1.0)),
                line((1.0, 1.0), (0.0, 0.0)),
            ],
            // Doubles, whole and in part.
            3 => vec![square(0.0), square(0.0)],
            4 => {
                let corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0)];
                let others = [(1.0, 1.0, 0.0), (1.0, 0.2 + small, 0.0)];
                vec![outline(false, &corners), outline(false, &others)]
            }
            // A circle of chords.
            5 => {
                let chord = |at: usize| {
                    let angle = TAU * at as f64 / 24.0;
                    (0.5 + 0.5 * angle.cos(), 0.5 + 0.5 * angle.sin(), 0.0)
                };
                vec![outline(true, &(0..24).map(chord).collect::<Vec<_>>())]
            }
            // Crumbs, one of them twice.
            6 => vec![line((0.0, 0.0), (0.001 * small, 0.0))],
            7 => vec![square(0.0), square(1.0 + small)],
            8 => vec![circle(small.max(0.001))],
            9 => vec![circle(0.02), circle(0.02)],
            _ => vec![square(0.0)],
        }
    }

    fn moved(geometry: &Geometry, by: (f64, f64)) -> Geometry {
        let to = |point: Point| Point::new(point.x + by.0, point.y + by.1);
        match geometry.clone() {
            Geometry::Line { start, end } => Geometry::Line {
                start: to(start),
                end: to(end),
            },
            Geometry::Circle { center, radius } => Geometry::Circle {
                center: to(center),
                radius,
            },
            Geometry::Polyline { closed, vertices } => Geometry::Polyline {
                closed,
                vertices: vertices
                    .into_iter()
                    .map(|it| Vertex {
                        point: to(it.point),
                        ..it
                    })
                    .collect(),
            },
            other => other,
        }
    }

    /// A kind of figure, its size, its column and row, and its offset from that place.
    type Figure = (usize, f64, (i32, i32), (f64, f64));

    fn drawn(figures: &[Figure], pitch: f64) -> Drawing {
        let mut drawing = Drawing::new(None);
        for &(kind, size, (column, row), (x, y)) in figures {
            let at = (f64::from(column) * pitch + x, f64::from(row) * pitch + y);
            for geometry in figure(kind, size) {
                drawing.push(Entity::new("A", "0", moved(&geometry, at)));
            }
        }
        drawing
    }

    /// How many tries were made in a part, and whether each way to ask gives the same answer as
    /// making all repairs.
    fn asked(drawing: &Drawing) -> (usize, [bool; 3]) {
        let mut analysis = Analysis::new(drawing, Arc::new(Effective::default()));
        let (found, _) = analysis.findings(drawing, usize::MAX);
        let all = analysis.fix_all(drawing);
        PARTS.set(0);
        let by_found = analysis.has_fix_that(drawing, Some(&found), &|_| true);
        let by_itself = analysis.has_fix_that(drawing, None, &|_| true);
        (PARTS.take(), [all.is_some(), by_found, by_itself])
    }

    thread_local!(pub(super) static PARTS: Cell<usize> = const { Cell::new(0) });

    proptest! {
        #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

        /// At a small pitch the figures lie within each other's reach, and what decides may lie at
        /// the border of the part.
        #[test]
        fn a_part_tells_of_a_repair_where_the_whole_does(
            figures in prop::collection::vec(
                (0..11usize, prop_oneof![0.5..12.0f64, Just(10.0)], (0..6i32, 0..6i32), (-0.3..0.3f64, -0.3..0.3f64)),
                4..24,
            ),
            far in prop::collection::vec((0..11usize, 0.5..12.0f64, (20..60i32, 0..40i32)), 8..24),
            pitch in prop::sample::select(vec![1.0, 1.05, 1.2, 1.45, 2.0]),
        ) {
            let far = far.into_iter().map(|(kind, size, at)| (kind, size, at, (0.0, 0.0)));
            let figures: Vec<_> = figures.into_iter().chain(far).collect();
            let (_, [all, by_found, by_itself]) = asked(&drawn(&figures, pitch));
            prop_assert_eq!((by_found, by_itself), (all, all));
        }
    }

    #[test]
    fn a_part_is_asked_where_a_fault_lies_apart() {
        let apart = |kind: usize| {
            let fault = [(kind, 8.0, (0, 0), (0.0, 0.0))];
            let sound = (1..40).map(|at| (10, 1.0, (at, 0), (0.0, 0.0)));
            let (parts, told) = asked(&drawn(
                &fault.into_iter().chain(sound).collect::<Vec<_>>(),
                3.0,
            ));
            (parts > 0, told)
        };
        assert_eq!([0, 1, 2, 3, 4, 5, 9].map(apart), [(true, [true; 3]); 7]);
        assert_eq!(apart(10), (false, [false; 3]));
    }
}
