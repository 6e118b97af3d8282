//! Where a contour is threaded, and the leads between the thread hole and its path.

use super::contour_path::goes_out_and_back;
use super::contours::Contours;
use super::corners::Element;
use super::entry::{Entry, circle_center, nearest, other_entries, path_point};
use super::hole::Holes;
use super::job::{Job, ROUNDING};
use super::leads::{Kerfs, SAME, Surroundings, Threading, thread_hole};
use super::offset::Wall;
use super::path::{PathSegment, Refusal, Source, WirePath};
use super::paths::{Pass, Unled};
use super::requested::Requested;
use crate::finding::Finding;
use crate::geometry::{Point, Segment};
use crate::settings::{Compensation, Lead};

/// Entries that are tried where no lead fits at the first: of a comb none may have room, and each costs a look at all contours.
const OTHER_ENTRIES: usize = 8;

impl Job<'_> {
    /// How near a path at a correction, drawing units, may come to the walls.
    pub(super) fn clearance(&self, correction: f64) -> f64 {
        match self.settings.compensation {
            Compensation::None => self.units(ROUNDING),
            _ => (correction - self.units(ROUNDING)).max(self.units(ROUNDING)),
        }
    }

    /// True where the part inside the contour drops out: a slug.
    pub(super) fn has_waste_inside(&self, outline: usize) -> bool {
        self.settings.has_waste_inside(self.outlines[outline].role)
    }

    /// -1 where leads come from the other side of the contour than the one on which the wire runs, else 1.
    pub(super) fn across(&self) -> f64 {
        match self.settings.comes_across {
            true => -1.0,
            false => 1.0,
        }
    }

    /// The form of the leads of a contour. A hole that is found, or the nearest point to one, lies at right angles to it anyway.
    pub(super) fn lead(&self, wanted: &Requested) -> Lead {
        match self.settings.lead {
            Lead::Perpendicular if wanted.thread.and(wanted.entry).is_none() => Lead::Straight,
            lead => lead,
        }
    }

    /// What the leads of a pass are checked against; its correction is in drawing units, and below 0 where the wire runs on the other side
    /// of the contour than in the first pass; 0 on the contour itself.
    pub(super) fn surroundings<'a>(
        &'a self,
        unled: &'a Unled,
        contours: &'a Contours<'a>,
        kerfs: &'a Kerfs,
        lead: Lead,
        correction: f64,
    ) -> Surroundings<'a> {
        Surroundings {
            job: self,
            outline: unled.outline,
            own: &unled.own,
            contours,
            kerfs,
            clearance: self.clearance(correction.abs()),
            comes_across: self.settings.comes_across || correction <= 0.0,
            lead,
            goes_back: false,
        }
    }

    /// The thread hole for the offset of a contour, or what is in the way. `holes` are those of the others.
    pub(super) fn thread_hole(
        &self,
        unled: &Unled,
        wanted: &Requested,
        contours: &Contours,
        kerfs: &Kerfs,
        holes: &Holes,
    ) -> Result<Point, Finding> {
        let stand = unled.passes.iter().find(|pass| pass.path.is_empty());
        let (Some(rough), Some(entry)) = (unled.passes.first(), &unled.entry) else {
            return Ok(stand.map_or_else(Point::origin, |pass| pass.begin));
        };
        if self.settings.mills {
            return Ok(rough.begin);
        }
        let lead = self.lead(wanted);
        let surroundings =
            |correction: f64| self.surroundings(unled, contours, kerfs, lead, correction);
        let is_opening = self.has_waste_inside(unled.outline);
        let says_nothing = wanted.entry.is_none()
            && wanted.beside.is_none()
            && self.settings.stated_lead_in.is_none();
        let center = if is_opening && says_nothing {
            circle_center(&unled.walls, self.units(self.settings.tolerances.report))
        } else {
            None
        };
        let first: Vec<Point> = center.into_iter().chain(wanted.proposed).collect();
        let is_apart = |at: Point| self.is_apart(at, holes);
        let deepest = || {
            let alone = Holes::default();
            let (at, _) = self.deepest(unled.outline, contours, f64::INFINITY, &alone)?;
            let at = match is_apart(at) {
                true => at,
                false => {
                    let reach = self.hole_reach()?;
                    let beside = self.deepest(unled.outline, contours, reach, holes);
                    beside.filter(|(_, depth)| *depth >= reach)?.0
                }
            };
            is_opening.then_some(at)
        };
        let has_room = |at: Point| self.has_room(at, contours, holes);
        let threading = Threading {
            first: &first,
            last: &deepest,
            reach: self.hole_reach(),
            has_room: &has_room,
            is_apart: &is_apart,
        };
        let thread = if let Some(stand) = stand {
            stand.begin
        } else if wanted.thread.is_none()
            && self.outlines[unled.outline].contour.closed
            && goes_out_and_back(&rough.path)
        {
            // There is no room beside the path.
            rough.begin
        } else {
            thread_hole(
                wanted,
                &threading,
                entry,
                &rough.landing(unled.side * self.across()),
                &unled.walls,
                &surroundings(rough.correction),
            )?
        };
        // The first lead has been checked against everything.
        let first = usize::from(stand.is_none());
        for pass in unled.passes.iter().skip(first) {
            if pass.begin != thread && !pass.path.is_empty() {
                let surroundings = surroundings(pass.correction);
                let landing = pass.landing(unled.side * self.across());
                let least = pass.correction.abs();
                surroundings.hold(thread, &landing, entry, &unled.walls, least)?;
            }
        }
        Ok(thread)
    }

    /// Where the wire's centre can only stand still, the wire is threaded and cuts nothing more: no other thread hole will do.
    pub(super) fn refuse_other_thread(
        &self,
        wanted: &Requested,
        walls: &[Wall],
        stand: &Pass,
    ) -> Result<(), Refusal> {
        let (same, point) = (self.units(SAME), stand.begin);
        let Some(thread) = wanted
            .thread
            .filter(|thread| (thread - point).norm() > same)
        else {
            return Ok(());
        };
        let wall = nearest(walls, thread, same).map_or(0, |(entry, _)| entry.wall);
        let [thread, point] = [thread, point].map(|at| self.in_mm(at));
        let sentence = say!(
            the_thread_hole_comes_nearer_to_the_contour,
            thread.x,
            thread.y,
            stand.correction * self.unit_mm,
            point.x,
            point.y
        );
        Err(self.refused(walls.get(wall).map(|wall| wall.source), sentence))
    }

    /// The path with the way from and back to the thread hole, where that is another point than its
    /// beginning. An open path ends where it ends.
    pub(super) fn with_leads(
        &self,
        outline: usize,
        correction: f64,
        thread_hole: Point,
        path: Vec<Element>,
        closed: bool,
    ) -> WirePath {
        let (begin, end) = match (path.first(), path.last()) {
            (Some(first), Some(last)) => (first.geometry.start(), last.geometry.end()),
            _ => (thread_hole, thread_hole),
        };
        let mut segments: Vec<PathSegment> = Vec::with_capacity(path.len() + 2);
        segments.extend(lead(thread_hole, begin, Source::LeadIn));
        segments.extend(path.iter().map(Element::piece));
        if closed {
            segments.extend(lead(end, thread_hole, Source::LeadOut));
        }
        let turned = || self.directed(outline).1;
        WirePath {
            outline,
            counter_clockwise: closed
                .then(|| (self.outlines[outline].twice_area > 0.0) != turned()),
            correction,
            ..WirePath::along(thread_hole, segments)
        }
    }

    /// Where no lead fits at the entry, and nobody has said where to enter: the next entry at which one does, and its
    /// thread hole. The middle of the longest line may lie in a slit, where no arc has room.
    pub(super) fn entered_elsewhere(
        &self,
        unled: &mut Unled,
        wanted: &Requested,
        thread_hole: impl Fn(&Unled) -> Result<Point, Finding>,
    ) -> Option<(Point, Point)> {
        let index = unled.outline;
        let is_told = self.entry(index, &unled.walls, wanted).ok()?.is_some();
        if is_told || unled.entry.is_none() || !self.outlines[index].contour.closed {
            return None;
        }
        let others: Vec<Entry> = other_entries(&unled.walls).take(OTHER_ENTRIES).collect();
        others.into_iter().find_map(|entry| {
            for pass in unled.passes.iter_mut().filter(|pass| !pass.path.is_empty()) {
                let (correction, side) = (pass.correction, unled.side);
                (pass.element, pass.begin) =
                    path_point(&pass.path, &unled.walls, &entry, correction, side)?;
            }
            unled.entry = Some(entry);
            Some((entry.point, thread_hole(unled).ok()?))
        })
    }
}

/// The straight way between two points; nothing where they are one.
pub(super) fn lead(from: Point, to: Point, source: Source) -> Option<PathSegment> {
    (from != to).then(|| PathSegment {
        geometry: Segment::line(from, to),
        source,
    })
}
