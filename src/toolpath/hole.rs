//! Start holes, which are drilled for threading the wire: proposals, and faults.

use super::clearance::Walls;
use super::containment::Places;
use super::contours::Contours;
use super::job::Job;
use super::leads::{HOLE_CLEAR, finding};
use super::requested::Requested;
use crate::drawing::{Drawing, Outline, are_twins, winding};
use crate::finding::{Finding, Place, Rule, Severity};
use crate::geometry::{Bounds, Grid, Point, Vector};
use crate::settings::{Compensation, Effective, Order};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::SQRT_2;

/// The deepest point is found within this share of half the size of an opening. Near it nothing is deeper by a
/// hundredth of that.
const DEPTH: f64 = 1e-3;

/// The most squares that are searched for it.
const MOST_SQUARES: usize = 100_000;

/// The thread hole of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartHole {
    /// Index of the outline in the drawing's list.
    pub outline: usize,
    pub at: Point,
    /// By the settings or by a mark; else it was found.
    pub is_given: bool,
    /// It was found, and cuts into a contour: there is no place for one of the set diameter.
    pub cuts: bool,
    /// It lies in what another contour has dropped before: nothing is drilled.
    pub is_open: bool,
}

/// Holes by place.
#[derive(Default)]
pub(super) struct Holes {
    places: Vec<Point>,
    grid: Grid<usize>,
}

impl Holes {
    pub(super) fn push(&mut self, at: Point) {
        self.grid
            .insert(self.places.len(), Bounds::of_points(&[at]));
        self.places.push(at);
    }

    /// Those within a distance of a point, and perhaps others, in no order.
    fn within(&self, at: Point, distance: f64) -> Vec<Point> {
        let mut near = Vec::new();
        self.grid.near(&Bounds::of_disc(at, distance), |hole, _| {
            near.extend(self.places.get(hole));
        });
        near
    }
}

/// The faults of the start holes of the set diameter: of given ones, and of openings without room for one.
pub(crate) fn hole_faults(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
) -> Vec<Finding> {
    let job = Job::of(drawing, outlines, settings);
    job.hole_faults().unwrap_or_default()
}

impl Job<'_> {
    fn hole_faults(&self) -> Option<Vec<Finding>> {
        let reach = self.hole_reach()?;
        let chosen = self.chosen(None, Order::AsDrawn, &Places::default()).ok()?;
        let mut faults = Vec::new();
        let wanted = self.wanted(&chosen.outlines).ok()?;
        for (outlines, wanted) in self.by_workpiece(&chosen.outlines, wanted) {
            faults.extend(self.hole_faults_of_part(&outlines, wanted, reach));
        }
        Some(faults)
    }

    fn hole_faults_of_part(
        &self,
        outlines: &[usize],
        wanted: Vec<Requested>,
        reach: f64,
    ) -> Vec<Finding> {
        let mut faults = Vec::new();
        let contours = Contours::about(self, outlines);
        let mut given: Vec<(Point, usize)> = Vec::new();
        let openings = self.openings_of_lines(outlines);
        for (&index, wanted) in outlines.iter().zip(wanted) {
            let outline = &self.outlines[index];
            if !outline.contour.closed && outline.lacks_side() {
                continue;
            }
            let thread = match outline.is_on_line() {
                // Where nothing is said of it, it is threaded where it begins.
                true => self
                    .as_drawn(index, &self.with_room(index, wanted, &contours))
                    .ok()
                    .filter(|path| !self.is_threaded_in_opening(path, &openings))
                    .map(|path| path.thread_hole),
                false => wanted.thread,
            };
            if let Some(at) = thread {
                faults.extend(self.hole_fault(at, reach, &contours));
                given.push((at, index));
            } else if self.has_waste_inside(index)
                && let Some((at, depth)) = self.deepest(index, &contours, reach, &Holes::default())
                && depth < reach - self.units(1e-6)
            {
                // One that is only too near is proposed all the same.
                let found = match self.cuts(depth) {
                    true => self.no_room(index, depth),
                    false => self.hole_fault(at, reach, &contours),
                };
                faults.extend(found);
            }
        }
        faults.extend(self.holes_that_meet(given));
        faults
    }

    /// The distance of a start hole's centre from every contour, drawing units. `None` where no diameter is set, and
    /// where the part's side of the wire is not known.
    pub(super) fn hole_reach(&self) -> Option<f64> {
        let diameter = self.settings.start_hole?;
        let is_known = self.settings.compensation != Compensation::None;
        is_known.then(|| self.units(diameter / 2.0 + self.settings.correction + HOLE_CLEAR))
    }

    /// By its effect: an error where the hole cuts into the part, else a warning.
    fn hole_finding(&self, wall: Option<Place>, cuts: bool, sentence: String) -> Option<Finding> {
        let own = if cuts {
            Severity::Error
        } else {
            Severity::Warning
        };
        let severity = self.settings.severity_over(Rule::StartHole, own)?;
        Some(finding(Rule::StartHole, severity, wall, sentence, None))
    }

    /// The contour that a hole cuts into, or comes too near to.
    fn hole_fault(&self, at: Point, reach: f64, contours: &Contours) -> Option<Finding> {
        let rounding = self.units(1e-6);
        contours.walls().nearer(at, reach - rounding)?;
        let distance = contours.walls().distance_to(at, reach);
        let wall = contours.walls().nearer(at, distance + rounding)?;
        let diameter = self.settings.start_hole?;
        let left = distance * self.unit_mm - diameter / 2.0;
        let handle = self.name(contours.outline_of(wall));
        let (cuts, at) = (left < -1e-6, self.in_mm(at));
        let sentence = match cuts {
            true => say!(
                the_start_hole_cuts_into,
                diameter,
                at.x,
                at.y,
                handle,
                -left
            ),
            false => say!(
                the_start_hole_comes_near,
                diameter,
                at.x,
                at.y,
                left.max(0.0),
                handle,
                self.settings.correction,
                HOLE_CLEAR
            ),
        };
        self.hole_finding(Some(contours.place_of(wall)), cuts, sentence)
    }

    /// An opening that is nowhere deeper than `depth`, drawing units.
    fn no_room(&self, index: usize, depth: f64) -> Option<Finding> {
        let outline = &self.outlines[index];
        let (diameter, depth) = (self.settings.start_hole?, depth * self.unit_mm);
        let most = 2.0 * (depth - self.settings.correction - HOLE_CLEAR);
        let handle = self.name(index);
        let sentence = match most > 0.0 {
            true => say!(no_start_hole_fits_in, diameter, handle, depth, most),
            false => say!(no_start_hole_at_all_fits_in, diameter, handle, depth),
        };
        let first = outline.contour.segment(self.drawing, 0);
        let place = first.as_ref().map(Place::from);
        self.hole_finding(place, true, sentence)
    }

    /// True for a hole that is so far from a contour, drawing units, that it cuts into it.
    fn cuts(&self, away: f64) -> bool {
        let diameter = self.settings.start_hole.unwrap_or_default();
        away * self.unit_mm < diameter / 2.0 - 1e-6
    }

    /// A hole that was found, and cuts into a contour, which [`hole_faults`] says.
    pub(super) fn finds_no_room(&self, at: Point, contours: &Contours) -> bool {
        let is_told = self.settings.severity(Rule::StartHole).is_some();
        let reach = self
            .hole_reach()
            .filter(|_| is_told && !self.settings.mills);
        reach.is_some_and(|reach| self.cuts(contours.walls().distance_to(at, reach)))
    }

    /// Holes that run into each other, unless they are the same.
    fn holes_that_meet(&self, mut holes: Vec<(Point, usize)>) -> Vec<Finding> {
        let (diameter, same) = (
            self.units(self.settings.start_hole.unwrap_or_default()),
            self.units(self.settings.tolerances.certain),
        );
        holes.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.0.y.total_cmp(&b.0.y)));
        let mut faults = Vec::new();
        for (number, (at, outline)) in holes.iter().enumerate() {
            let near = holes[number + 1..]
                .iter()
                .take_while(|(other, _)| other.x - at.x < diameter);
            for (other, of) in near {
                let apart = (other - at).norm();
                if (same..diameter).contains(&apart) {
                    let first =
                        |outline: usize| self.outlines[outline].contour.segment(self.drawing, 0);
                    let place = |outline| first(outline).as_ref().map(Place::from);
                    let [at, other] = [*at, *other].map(|at| self.in_mm(at));
                    let sentence = say!(
                        the_start_holes_meet,
                        self.settings.start_hole.unwrap_or_default(),
                        at.x,
                        at.y,
                        self.name(*of),
                        other.x,
                        other.y
                    );
                    let found = self.hole_finding(place(*outline), false, sentence);
                    faults.extend(found.map(|found| Finding {
                        related: place(*of).into_iter().collect(),
                        ..found
                    }));
                }
            }
        }
        faults
    }

    /// True where a start hole keeps its distance from every contour, and from the others; always where
    /// none is drilled.
    pub(super) fn has_room(&self, at: Point, contours: &Contours, others: &Holes) -> bool {
        let Some(reach) = self.hole_reach() else {
            return true;
        };
        let rounding = self.units(1e-6);
        contours.walls().nearer(at, reach - rounding).is_none() && self.is_apart(at, others)
    }

    /// True where a start hole leaves a web beside each of the others, or is the same hole; always where none is drilled.
    pub(super) fn is_apart(&self, at: Point, others: &Holes) -> bool {
        if self.hole_reach().is_none() {
            return true;
        }
        let diameter = self.settings.start_hole.unwrap_or_default();
        let (rounding, least) = (self.units(1e-6), self.units(diameter + HOLE_CLEAR));
        let mut near = others.within(at, least).into_iter();
        near.all(|other| {
            let apart = (other - at).norm();
            apart <= rounding || apart >= least - rounding
        })
    }

    /// The point of an opening that is furthest from every contour, and its distance; `enough` will do. A start hole is to
    /// keep apart from others: where one has no room beside these, the distance is below what a hole needs. `None` where
    /// the opening has no inside.
    pub(super) fn deepest(
        &self,
        index: usize,
        contours: &Contours,
        enough: f64,
        others: &Holes,
    ) -> Option<(Point, f64)> {
        let own = &self.outlines[index];
        let bounds = own.contour.bounds(self.drawing);
        // The same outline, drawn again.
        let is_twin = |other: &Outline, about: &Bounds| {
            let tolerance = self.units(self.settings.tolerances.same_place);
            let (own, other) = ((&own.contour, &bounds), (&other.contour, about));
            are_twins(self.drawing, own, other, tolerance)
        };
        let lies_within = |(other, about): (usize, Bounds)| {
            let other = &self.outlines[other];
            let first = other.contour.segment(self.drawing, 0)?;
            let is_island = about != bounds
                && winding(self.drawing, &own.contour, first.geometry.point_at(0.5)) != 0
                && !is_twin(other, &about);
            is_island.then_some(other)
        };
        let half = bounds.width().max(bounds.height()) / 2.0;
        if !half.is_finite() || half <= 0.0 {
            return None;
        }
        let middle = nalgebra::center(&bounds.min, &bounds.max);
        let nearer = self.units(self.settings.start_hole.unwrap_or_default() + HOLE_CLEAR)
            - self.hole_reach().unwrap_or_default();
        // From everywhere in the square about it, the contour itself is nearer than any other hole.
        let farthest = 3.0 * SQRT_2 * half + nearer.max(0.0);
        let region = Region {
            drawing: self.drawing,
            own,
            islands: contours
                .within(&bounds)
                .into_iter()
                .filter_map(lies_within)
                .collect(),
            walls: contours.walls(),
            others: &others.within(middle, farthest),
            nearer,
        };
        let within = half * DEPTH;
        let coarse = region.deepest(middle, half, enough, within)?;
        let fine = region.deepest(coarse.0, 2.0 * within, enough, within / 100.0)?;
        Some(if fine.1 > coarse.1 { fine } else { coarse })
    }
}

/// The inside of a contour without that of what lies in it.
struct Region<'a> {
    drawing: &'a Drawing,
    own: &'a Outline,
    islands: Vec<&'a Outline>,
    walls: &'a Walls,
    /// Holes to keep apart from, and by how much more than from a wall, drawing units.
    others: &'a [Point],
    nearer: f64,
}

impl Region<'_> {
    fn holds(&self, point: Point) -> bool {
        let lies_in = |outline: &Outline| winding(self.drawing, &outline.contour, point) != 0;
        lies_in(self.own) && !self.islands.iter().any(|island| lies_in(island))
    }

    /// Searches the square about `middle`: it is divided, the parts with the possibly deepest point first, until none
    /// may hold one that is deeper by more than `within`.
    fn deepest(&self, middle: Point, half: f64, enough: f64, within: f64) -> Option<(Point, f64)> {
        let square = |center: Point, half: f64, inside: Option<bool>| {
            let away = self.walls.distance_to(center, half);
            let inside = inside.unwrap_or_else(|| self.holds(center));
            let walls = if inside { away } else { -away };
            let of_others = self.others.iter();
            let apart = of_others.map(|other| (other - center).norm() - self.nearer);
            Square {
                center,
                half,
                walls,
                depth: apart.fold(walls, f64::min),
            }
        };
        let first = square(middle, half, None);
        let mut best = (first.center, first.depth);
        let mut waiting = BinaryHeap::from([first]);
        let mut looked_at = 0;
        while let Some(parent) = waiting.pop() {
            looked_at += 1;
            if best.1 >= enough || parent.most() <= best.1 + within || looked_at > MOST_SQUARES {
                break;
            }
            let half = parent.half / 2.0;
            // No wall comes between the middle of a square and those of its quarters that is further away than these.
            let inside = (parent.walls.abs() > half * SQRT_2).then_some(parent.walls > 0.0);
            for (x, y) in [(-half, -half), (half, -half), (-half, half), (half, half)] {
                let quarter = square(parent.center + Vector::new(x, y), half, inside);
                if quarter.depth > best.1 + within * 1e-3 {
                    best = (quarter.center, quarter.depth);
                }
                if quarter.most() > best.1 + within {
                    waiting.push(quarter);
                }
            }
        }
        (best.1 > 0.0).then_some(best)
    }
}

/// A square of a region, by its middle. `walls` is how far that is from the walls, below 0 outside; `depth` is less where another hole is
/// nearer.
struct Square {
    center: Point,
    half: f64,
    walls: f64,
    depth: f64,
}

impl Square {
    /// Nothing in it is deeper.
    fn most(&self) -> f64 {
        self.depth + self.half * SQRT_2
    }
}

impl PartialEq for Square {
    fn eq(&self, other: &Square) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Square {}

impl PartialOrd for Square {
    fn partial_cmp(&self, other: &Square) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Square {
    fn cmp(&self, other: &Square) -> Ordering {
        let places = |square: &Square| [square.center.x, square.center.y];
        let by_place = || {
            let ([x, y], [other_x, other_y]) = (places(self), places(other));
            other_x.total_cmp(&x).then(other_y.total_cmp(&y))
        };
        self.most().total_cmp(&other.most()).then_with(by_place)
    }
}
