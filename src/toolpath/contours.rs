//! The contours that the wire may meet on its way to one of them: those in the same workpiece.

use super::chords::with_arcs;
use super::clearance::Walls;
use super::job::Job;
use super::offset::{Wall, walls};
use crate::drawing::{Contour, ContourSegment, Drawing, EntityId, Outline};
use crate::finding::Place;
use crate::geometry::{Bounds, Grid, Point, Tolerances};
use crate::settings::Workpieces;
use std::sync::OnceLock;

/// The walls of all contours that lie in one workpiece: no wire meets those of another.
pub(super) struct Contours<'a> {
    drawing: &'a Drawing,
    outlines: &'a [Outline],
    /// The part that they are of, where there are several.
    part: Option<(&'a Workpieces, u16)>,
    tolerances: Tolerances,
    /// Once somebody has asked what is near.
    known: OnceLock<WallsOf>,
    /// The closed ones that are cut, once somebody has asked what lies in an area.
    closed: OnceLock<Grid<usize>>,
}

struct WallsOf {
    walls: Walls,
    /// By wall: the outline, and the segment of the drawing.
    of: Vec<(usize, EntityId, usize)>,
}

impl Contours<'_> {
    /// Those that lie in the workpiece of the first of `chosen`.
    pub(crate) fn about<'a>(job: &Job<'a>, chosen: &[usize]) -> Contours<'a> {
        let workpieces = &job.settings.workpieces;
        let first = chosen.first().filter(|_| !workpieces.is_empty());
        Contours {
            drawing: job.drawing,
            outlines: job.outlines,
            part: first.map(|&first| (workpieces, job.workpiece(first))),
            tolerances: job.tolerances(),
            known: OnceLock::new(),
            closed: OnceLock::new(),
        }
    }

    /// It is cut as the wall of a part, and lies in the workpiece.
    fn is_met(&self, outline: &Outline) -> bool {
        let contour = &outline.contour;
        let is_of = |(workpieces, part): (&Workpieces, u16)| {
            workpieces.of_contour(self.drawing, contour) == part
        };
        contour.double_of.is_none() && !outline.is_on_line() && self.part.is_none_or(is_of)
    }

    /// The closed outlines that are cut whose boxes lie within an area, with their boxes, in their order.
    pub(crate) fn within(&self, area: &Bounds) -> Vec<(usize, Bounds)> {
        let mut within = Vec::new();
        self.closed().near(area, |index, about| {
            within.extend((about.merged(area) == *area).then_some((index, *about)));
        });
        within.sort_unstable_by_key(|(index, _)| *index);
        within
    }

    /// The closed outlines that are cut whose boxes come near a point, the smallest first.
    pub(crate) fn about_point(&self, at: Point, reach: f64) -> Vec<usize> {
        let mut about = Vec::new();
        self.closed()
            .near(&Bounds::of_disc(at, reach), |index, _| about.push(index));
        let area = |&index: &usize| self.outlines[index].twice_area.abs();
        about.sort_by(|a, b| area(a).total_cmp(&area(b)).then(a.cmp(b)));
        about
    }

    fn closed(&self) -> &Grid<usize> {
        self.closed.get_or_init(|| {
            let mut closed = Grid::default();
            for (index, outline) in self.outlines.iter().enumerate() {
                if outline.contour.closed && self.is_met(outline) {
                    closed.insert(index, outline.contour.bounds(self.drawing));
                }
            }
            closed
        })
    }

    /// A contour as its own path meets it: with arcs in place of chords where those are followed.
    fn walls_of(&self, contour: &Contour) -> Vec<ContourSegment> {
        if self.tolerances.chord_fit == 0.0 {
            return contour.segments(self.drawing).collect();
        }
        let segment = |at: usize| contour.segment(self.drawing, at);
        let walls = walls(contour.len(), segment, contour.closed, &self.tolerances);
        let (walls, _) = with_arcs(walls, contour.closed, self.tolerances.chord_fit);
        let segment = |wall: &Wall| {
            let (entity, segment) = wall.source.segment()?;
            Some(ContourSegment {
                entity,
                segment,
                reversed: false,
                geometry: wall.geometry,
            })
        };
        walls.iter().filter_map(segment).collect()
    }

    fn known(&self) -> &WallsOf {
        self.known.get_or_init(|| {
            let (mut segments, mut of) = (Vec::new(), Vec::new());
            let is_met = |(_, outline): &(usize, &Outline)| self.is_met(outline);
            for (index, outline) in self.outlines.iter().enumerate().filter(is_met) {
                for wall in self.walls_of(&outline.contour) {
                    segments.push(wall.geometry);
                    of.push((index, wall.entity, wall.segment));
                }
            }
            // Those that make the paths of other contours may wait for it.
            WallsOf {
                walls: Walls::by_one_core(segments),
                of,
            }
        })
    }

    pub(crate) fn walls(&self) -> &Walls {
        &self.known().walls
    }

    /// The outline that a wall is of.
    pub(crate) fn outline_of(&self, wall: usize) -> usize {
        self.known().of[wall].0
    }

    pub(crate) fn place_of(&self, wall: usize) -> Place {
        let (_, entity, segment) = self.known().of[wall];
        Place::Segment { entity, segment }
    }
}
