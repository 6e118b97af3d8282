//! Thread hole, entry and the leads between them.
//!
//! A lead cuts as the path does: it keeps clear of every contour, its own and all others, and of what is cut along the others.

use super::clearance::Walls;
use super::contours::Contours;
use super::corners::Element;
use super::entry::Entry;
use super::job::{Job, ROUNDING};
use super::lead_form::{Landing, Way};
use super::offset::Wall;
use super::path::{Refusal, Source};
use super::requested::Requested;
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::geometry::{Point, Segment};
use crate::settings::Lead;

/// mm that a start hole keeps from what the wire cuts.
pub(super) const HOLE_CLEAR: f64 = 0.1;

/// A thread hole within this distance of the path, mm, is given on it: there is no lead. Places are stated to 0.001 mm.
pub(super) const SAME: f64 = 1e-3;

/// How often a lead is halved at most.
const MOST_HALVED: usize = 64;

/// How often the part of a lead beyond the path is halved, where the last of the longer ones does not fit.
const HALVED_BEYOND: u32 = 4;

/// The wire's paths along all contours that are cut, without their leads.
pub(super) struct Kerfs {
    paths: Walls,
    /// By piece: the outline, and what it follows.
    of: Vec<(usize, Source)>,
}

impl Kerfs {
    pub(crate) fn new<'a>(paths: impl Iterator<Item = (usize, &'a [Element])>) -> Kerfs {
        let (mut pieces, mut of) = (Vec::new(), Vec::new());
        for (outline, path) in paths {
            pieces.extend(path.iter().map(|element| element.geometry));
            of.extend(path.iter().map(|element| (outline, element.source)));
        }
        Kerfs {
            paths: Walls::new(pieces),
            of,
        }
    }
}

/// What a lead is checked against.
pub(super) struct Surroundings<'a> {
    pub(crate) job: &'a Job<'a>,
    /// The outline that the lead leads to, and its walls.
    pub(crate) outline: usize,
    pub(crate) own: &'a Walls,
    pub(crate) contours: &'a Contours<'a>,
    pub(crate) kerfs: &'a Kerfs,
    /// The path keeps at least this from the walls, and so must the leads; drawing units.
    pub(crate) clearance: f64,
    /// The lead crosses the contour where it comes to the path, and nowhere else.
    pub(crate) comes_across: bool,
    pub(crate) lead: Lead,
    /// It is not a lead but the way back from the far end of an open contour.
    pub(crate) goes_back: bool,
}

/// What a lead would cut.
pub(super) enum Obstacle {
    /// A wall of its own contour, by its index.
    Own(usize),
    /// A wall of another contour.
    Contour(usize),
    /// What is cut along another contour.
    Kerf(usize),
}

impl<'a> Surroundings<'a> {
    /// The same for the straight way back from the far end of an open contour.
    pub(super) fn straight_back(&self) -> Surroundings<'a> {
        Surroundings {
            lead: Lead::Straight,
            goes_back: true,
            ..*self
        }
    }

    /// The form in which a lead comes to a landing without cutting anything; `correction` is that of the pass, drawing units.
    pub(super) fn hold(
        &self,
        thread: Point,
        landing: &Landing,
        entry: &Entry,
        walls: &[Wall],
        correction: f64,
    ) -> Result<Way, Finding> {
        let obstacle = match self.way(thread, landing, correction) {
            Ok(way) => return Ok(way),
            Err(obstacle) => obstacle,
        };
        let (begin, source) = (landing.at, walls.get(entry.wall).map(|wall| wall.source));
        let correction = correction * self.job.unit_mm;
        let (place, does) = obstacle
            .map(|obstacle| self.told(&obstacle, walls, correction))
            .unwrap_or_default();
        let [thread, begin] = [thread, begin].map(|at| self.job.in_mm(at));
        let sentence = match self.lead {
            Lead::Arc => say!(
                no_arc_leads_from_to,
                correction,
                thread.x,
                thread.y,
                begin.x,
                begin.y,
                because(does)
            ),
            _ if self.goes_back => {
                say!(
                    the_way_back_does,
                    begin.x,
                    begin.y,
                    thread.x,
                    thread.y,
                    does
                )
            }
            _ => say!(the_lead_in_does, thread.x, thread.y, begin.x, begin.y, does),
        };
        Err(fault(self.job.severity(), source, sentence, place))
    }

    /// The same; otherwise what is in the way of the shortest one, or nothing where the thread hole
    /// is too near for an arc.
    pub(super) fn way(
        &self,
        thread: Point,
        landing: &Landing,
        correction: f64,
    ) -> Result<Way, Option<Obstacle>> {
        let mut last = None;
        // How far beside the path a corner lies at most.
        let length = self.job.units(self.job.settings.lead_in);
        for way in Way::all(self.lead, thread, landing, length, correction) {
            let pieces = way.pieces(thread, landing, false);
            // A way round a corner that runs beside another wall of the contour would cut along it.
            let beside = match (way, pieces.first()) {
                (Way::Corner(_), Some(to_corner)) => {
                    let apart = 2.0 * correction - self.job.units(ROUNDING);
                    self.own.nearer(to_corner.end(), apart).map(Obstacle::Own)
                }
                _ => None,
            };
            let obstacle = pieces
                .iter()
                .find_map(|piece| self.obstacle(piece, landing.at))
                .or(beside)
                .or_else(|| self.comes_through_the_part(&pieces, landing));
            match obstacle {
                None => return Ok(way),
                obstacle => last = obstacle,
            }
        }
        Err(last)
    }

    /// What is in the way of a lead to `begin`.
    fn obstacle(&self, lead: &Segment, begin: Point) -> Option<Obstacle> {
        let own = match self.comes_across {
            true => self.crossed_elsewhere(lead, begin),
            false => self.own.too_near(lead, self.clearance),
        };
        if let Some(wall) = own {
            return Some(Obstacle::Own(wall));
        }
        let is_other = |wall: usize| self.contours.outline_of(wall) != self.outline;
        if self.job.outlines.len() > 1
            && let Some(wall) = self
                .contours
                .walls()
                .find_near(lead, self.clearance, |wall, _| is_other(wall))
        {
            return Some(Obstacle::Contour(wall));
        }
        // Each of the two cuts is two corrections wide. Where the paths themselves run nearer to each other, the lead may, too.
        let rounding = self.job.units(ROUNDING);
        let Kerfs { paths, of } = self.kerfs;
        let counts = |piece: usize, distance: f64| {
            of[piece].0 != self.outline
                && distance < paths.segment(piece).distance_to(begin) - rounding
        };
        paths
            .find_near(lead, 2.0 * self.clearance, counts)
            .map(Obstacle::Kerf)
    }

    /// A wall of its own contour that a lead crosses, other than those beside which it begins to cut.
    fn crossed_elsewhere(&self, lead: &Segment, begin: Point) -> Option<usize> {
        let rounding = self.job.units(ROUNDING);
        let beside = self.clearance + 4.0 * rounding;
        let is_elsewhere = |wall: usize| self.own.segment(wall).distance_to(begin) > beside;
        self.own
            .find_near(lead, rounding, |wall, _| is_elsewhere(wall))
    }

    /// The wall that a lead should come across, where it comes from the part.
    fn comes_through_the_part(&self, pieces: &[Segment], landing: &Landing) -> Option<Obstacle> {
        let last = pieces.last().filter(|_| self.comes_across)?;
        if !landing.is_reached_from_the_part(last.end_tangent()) {
            return None;
        }
        let (_, wall) = self.own.nearest_to(landing.at, self.clearance)?;
        Some(Obstacle::Own(wall))
    }

    /// Where an obstacle stands in the drawing, and what a lead does there.
    fn told(
        &self,
        obstacle: &Obstacle,
        walls: &[Wall],
        correction: f64,
    ) -> (Option<Place>, String) {
        let named = |outline: usize| self.job.name(outline);
        match *obstacle {
            Obstacle::Own(wall) => {
                let place = walls.get(wall).and_then(|wall| wall.source.place());
                (place, say!(crosses_the_contour_or_comes_nearer, correction))
            }
            Obstacle::Contour(wall) => (
                Some(self.contours.place_of(wall)),
                say!(
                    cuts_into_contour_or_comes_nearer,
                    named(self.contours.outline_of(wall)),
                    correction
                ),
            ),
            Obstacle::Kerf(piece) => {
                let (outline, source) = self.kerfs.of[piece];
                (
                    source.place(),
                    say!(runs_into_the_cut_along_contour, named(outline)),
                )
            }
        }
    }
}

impl Job<'_> {
    /// The refusal of a path, with what prevents it at a place of the contour.
    pub(super) fn refused(&self, source: Option<Source>, sentence: String) -> Refusal {
        fault(self.severity(), source, sentence, None).into()
    }
}

/// A finding `lead-in` at a place of the contour that is led to.
pub(super) fn fault(
    severity: Severity,
    source: Option<Source>,
    sentence: String,
    other: Option<Place>,
) -> Finding {
    let place = source.and_then(Source::place);
    finding(Rule::LeadIn, severity, place, sentence, other)
}

/// A finding of a rule about leads and holes, with its sentence.
pub(super) fn finding(
    rule: Rule,
    severity: Severity,
    place: Option<Place>,
    sentence: String,
    other: Option<Place>,
) -> Finding {
    let place = place.unwrap_or(Place::Document);
    let related = other.filter(|other| *other != place).into_iter().collect();
    Finding {
        rule,
        severity,
        place,
        detail: Detail::Said(sentence),
        related,
    }
}

fn because(does: String) -> String {
    match does.is_empty() {
        true => does,
        false => say!(because_it, does),
    }
}

/// Where the wire may be threaded for one contour.
pub(super) struct Threading<'a> {
    /// The centre of a round opening, and the start hole that was proposed: the first from which the way is clear is taken.
    pub first: &'a [Point],
    /// The deepest point of an opening, taken where no hole beside the entry has room.
    pub last: &'a dyn Fn() -> Option<Point>,
    /// How far a start hole has to be from the contours, drawing units, where one is proposed.
    pub reach: Option<f64>,
    /// True where a start hole has room.
    pub(crate) has_room: &'a dyn Fn(Point) -> bool,
    /// True where it keeps apart from those of the other contours.
    pub(crate) is_apart: &'a dyn Fn(Point) -> bool,
}

/// The thread hole for a lead to a landing, the point of the path that belongs to `entry`. The landing itself where there is no lead: where
/// the hole is given there, and where none is given and leads have no length.
///
/// A hole that is given must be reached without cutting anything. Where none is given it is one of the first, where there is one and the way
/// from it is clear; else the lead runs on from the entry through the landing, and its length, counted from the path where
/// somebody has set it, else from the entry, is halved until it fits, or is what a start hole needs.
pub(super) fn thread_hole(
    wanted: &Requested,
    threading: &Threading<'_>,
    entry: &Entry,
    landing: &Landing,
    walls: &[Wall],
    surroundings: &Surroundings<'_>,
) -> Result<Point, Finding> {
    let job = surroundings.job;
    let (settings, unit_mm) = (job.settings, job.unit_mm);
    let source = walls.get(entry.wall).map(|wall| wall.source);
    let (correction, begin) = (settings.correction, landing.at);
    if let Some(thread) = wanted.thread {
        if (thread - begin).norm() <= SAME / unit_mm {
            return Ok(begin);
        }
        return surroundings
            .hold(thread, landing, entry, walls, correction / unit_mm)
            .map(|_| thread);
    }
    if settings.lead_in == 0.0 {
        return Ok(begin);
    }
    // An arc comes from one side and leaves to the other: both have to be free. All other ways are the same both times.
    let clear = |thread: Point| {
        let way = |landing: &Landing| surroundings.way(thread, landing, correction / unit_mm);
        let way_in = way(landing)?;
        match surroundings.lead {
            Lead::Arc => way(&landing.once_round()),
            _ => Ok(way_in),
        }
    };
    for &center in threading.first {
        if (center - begin).norm() <= 1e-6 / unit_mm {
            return Ok(begin);
        }
        if (threading.is_apart)(center) && clear(center).is_ok() {
            return Ok(center);
        }
    }
    let to_path = begin - entry.point;
    // What lies across the contour has no way to go but that.
    let (nearest, way) = match surroundings.comes_across {
        true => (0.0, Some(landing.room())),
        false => (to_path.norm(), to_path.try_normalize(0.0)),
    };
    let Some(way) = way else {
        return Ok(begin);
    };
    // Halved down to the path; then what reaches beyond the path is halved.
    let least = nearest + 1e-6 / unit_mm;
    let full = Some(settings.lead_in / unit_mm).filter(|length| length.is_finite());
    // A length that the user has set counts from the path.
    let from = settings.stated_lead_in.map_or(0.0, |_| nearest);
    let halved = std::iter::successors(full, |length| Some(length / 2.0))
        .map(|length| from + length)
        .take(MOST_HALVED)
        .take_while(|&length| length > least);
    let shortest = halved.clone().last().unwrap_or(nearest);
    let beyond = (1..=HALVED_BEYOND)
        .map(|times| nearest + (shortest - nearest) / f64::from(1 << times))
        .filter(|&length| length > least);
    let of_hole = threading
        .reach
        .filter(|_| settings.stated_lead_in.is_none());
    let mut last = None;
    for length in halved.chain(beyond).chain(of_hole) {
        let thread = entry.point + way * length;
        match clear(thread) {
            Ok(_) if (threading.has_room)(thread) => return Ok(thread),
            Ok(_) => {}
            Err(obstacle) => last = obstacle,
        }
    }
    if threading.reach.is_some()
        && let Some(deepest) = (threading.last)()
        && (threading.is_apart)(deepest)
        && clear(deepest).is_ok()
    {
        return Ok(deepest);
    }
    // What is in the way of the shortest one.
    let (place, does) = last
        .map(|obstacle| surroundings.told(&obstacle, walls, correction))
        .unwrap_or_default();
    let at_entry = job.in_mm(entry.point);
    if let Some(diameter) = settings.start_hole.filter(|_| threading.reach.is_some()) {
        let sentence = say!(
            no_start_hole_fits_beside,
            diameter,
            at_entry.x,
            at_entry.y,
            diameter / 2.0 + HOLE_CLEAR,
            because(does)
        );
        let at = source.and_then(Source::place);
        let severity = job.severity();
        return Err(finding(Rule::StartHole, severity, at, sentence, place));
    }
    let sentence = match surroundings.lead {
        Lead::Arc => say!(
            no_arc_fits_at,
            settings.lead_in,
            correction,
            at_entry.x,
            at_entry.y,
            because(does)
        ),
        _ => say!(
            no_lead_in_fits_at,
            settings.lead_in,
            correction,
            at_entry.x,
            at_entry.y,
            because(does)
        ),
    };
    Err(fault(job.severity(), source, sentence, place))
}
