//! Contours that are cut on the line, beside others that are cut with a correction: slits, clamps, marks.
//!
//! Such a *line* is no wall of a part, so no other path keeps clear of it. Its own kerf reaches one correction to either side, though, and may
//! take of a part only where the line is drawn to do so: about a *contact*, where it meets the contour of that part. An *opening* is a contour
//! inside of which the wire runs: what it drops leaves room to thread the wire for the slits that begin there.

use super::contours::Contours;
use super::job::{Job, ROUNDING};
use super::leads::{fault, finding};
use super::path::{PathSegment, Source, WirePath};
use super::requested::Requested;
use crate::drawing::{Drawing, Outline, winding};
use crate::finding::{Finding, Rule, Severity};
use crate::geometry::{Arc, Point, Segment, Vector, direction, left_normal, meetings};
use crate::settings::{Compensation, Effective};
use rustc_hash::FxHashMap;

/// A line may run nearer to a contour than the correction for so many corrections about a contact. It leaves a wall at 15° within that; one
/// that runs on along a wall takes it away.
const ABOUT_A_CONTACT: f64 = 4.0;

/// Where lines meet contours, by the outline of these.
type Contacts = FxHashMap<usize, Vec<Point>>;

/// What the kerfs of lines take of the parts beside them.
pub(crate) fn line_faults(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
) -> Vec<Finding> {
    let lines: Vec<usize> = (0..outlines.len())
        .filter(|&index| outlines[index].is_on_line() && outlines[index].is_cut())
        .collect();
    if lines.is_empty() || settings.compensation == Compensation::None {
        return Vec::new();
    }
    let job = Job::of(drawing, outlines, settings);
    // A hole that is given wrongly has a finding of its own.
    let wanted = job.wanted(&lines);
    let wanted = wanted.unwrap_or_else(|_| vec![Requested::default(); lines.len()]);
    let mut faults = Vec::new();
    for (lines, wanted) in job.by_workpiece(&lines, wanted) {
        let contours = Contours::about(&job, &lines);
        for (&index, wanted) in lines.iter().zip(&wanted) {
            let wanted = job.with_room(index, *wanted, &contours);
            let path = job.as_drawn(index, &wanted).ok();
            faults.extend(path.and_then(|path| job.line_fault(&path, &contours)));
        }
    }
    faults
}

impl Job<'_> {
    /// What a path that is drawn, or the way to it, cuts of a part.
    pub(super) fn line_fault(&self, path: &WirePath, contours: &Contours) -> Option<Finding> {
        if self.settings.mills {
            return None;
        }
        let is_common = self.outlines[path.outline].contour.is_composed();
        let mut sources = path.segments.iter().map(|piece| piece.source);
        let first = sources.find(|source| source.place().is_some());
        // Else it would be threaded in the parts.
        if is_common
            && !path
                .segments
                .iter()
                .any(|piece| piece.source == Source::LeadIn)
        {
            let sentence = say!(no_room_to_thread_for_a_common_line, self.name(path.outline));
            return Some(fault(self.severity(), first, sentence, None));
        }
        let (piece, wall) = match self.settings.compensation {
            // Others may well be crossed by what is drawn, which is the wire's own path, but not by the way to it.
            Compensation::None => {
                let lead = path.segments.first();
                let lead = lead.filter(|piece| piece.source == Source::LeadIn)?;
                (
                    lead,
                    self.crossed(&lead.geometry, contours, Some(path.outline))?,
                )
            }
            Compensation::Path | Compensation::Controller => {
                let contacts = self.contacts(path, contours);
                let is_drawn = |piece: &&PathSegment| piece.source.place().is_some();
                let drawn = path.segments.iter().filter(is_drawn);
                let leads = path.segments.iter().filter(|piece| !is_drawn(piece));
                drawn.chain(leads).find_map(|piece| {
                    Some((
                        piece,
                        self.wall_taken(&piece.geometry, &contacts, contours)?,
                    ))
                })?
            }
        };
        Some(self.taking(path, piece, wall, contours))
    }

    /// The finding of a piece that comes too near to a wall.
    fn taking(
        &self,
        path: &WirePath,
        piece: &PathSegment,
        wall: usize,
        contours: &Contours,
    ) -> Finding {
        let (other, name) = (
            contours.place_of(wall),
            self.name(contours.outline_of(wall)),
        );
        if let Some(place) = piece.source.place() {
            let severity = self.settings.severity(Rule::UnprovedPath);
            let sentence = say!(
                the_path_comes_too_near_to_contour,
                self.name(path.outline),
                self.settings.correction,
                name
            );
            let severity = severity.unwrap_or(Severity::Error);
            return finding(
                Rule::UnprovedPath,
                severity,
                Some(place),
                sentence,
                Some(other),
            );
        }
        let [from, to] = [piece.geometry.start(), piece.geometry.end()].map(|at| self.in_mm(at));
        let sentence = say!(
            the_lead_in_cuts_through_contour,
            from.x,
            from.y,
            to.x,
            to.y,
            name
        );
        let mut sources = path.segments.iter().map(|piece| piece.source);
        let first = sources.find(|source| source.place().is_some());
        fault(self.severity(), first, sentence, Some(other))
    }

    /// Where a line meets contours.
    fn contacts(&self, path: &WirePath, contours: &Contours) -> Contacts {
        let (walls, touch) = (contours.walls(), self.units(self.settings.tolerances.touch));
        let mut contacts = Contacts::default();
        for piece in path
            .segments
            .iter()
            .filter(|it| it.source.place().is_some())
        {
            let own = &piece.geometry;
            walls.find(&own.bounds().grown(touch), |wall| {
                let other = walls.segment(wall);
                let ends = [own.start(), own.end(), other.start(), other.end()];
                let touching = ends.into_iter().filter(|&end| {
                    own.distance_to(end) <= touch && other.distance_to(end) <= touch
                });
                let met = contacts.entry(contours.outline_of(wall)).or_default();
                met.extend(meetings(own, other).into_iter().chain(touching));
                false
            });
        }
        contacts
    }

    /// A wall of which a piece of a line takes, away from where the two meet.
    fn wall_taken(
        &self,
        piece: &Segment,
        contacts: &Contacts,
        contours: &Contours,
    ) -> Option<usize> {
        let correction = self.units(self.settings.correction);
        let (least, about) = (self.clearance(correction), ABOUT_A_CONTACT * correction);
        let walls = contours.walls();
        walls.find_near(piece, least, |wall, _| {
            let outline = contours.outline_of(wall);
            let met = contacts.get(&outline).map_or(&[][..], Vec::as_slice);
            let near = met.iter().filter(|at| piece.distance_to(**at) <= about);
            let near: Vec<Point> = near.copied().collect();
            let own = &self.outlines[outline];
            (own.contour.closed || own.wire_side().is_some())
                && (parts_away_from(&near, about, piece).iter())
                    .any(|part| walls.distance_below(part, wall, least).is_some())
        })
    }

    /// What is wanted of an open line of which nothing is said: it is threaded where an opening leaves room for that, or beyond an end that lies
    /// on a contour, on the side of the wire there.
    pub(super) fn with_room(
        &self,
        index: usize,
        wanted: Requested,
        contours: &Contours,
    ) -> Requested {
        let outline = &self.outlines[index];
        let is_said = wanted.thread.or(wanted.entry).or(wanted.beside).is_some();
        let is_path = self.settings.compensation == Compensation::None || self.settings.mills;
        if !outline.is_on_line() || is_said || is_path || self.picks.contains_key(&index) {
            return wanted;
        }
        let ends = self.ends_of_line(index).into_iter();
        let mut threaded = ends.filter_map(|(end, outward)| {
            let (thread, _) = self.room_at(index, (end, outward), contours)?;
            Some((thread, end))
        });
        match threaded.next() {
            // The other end may be nearer to that place.
            Some((thread, end)) => Requested {
                thread: Some(thread),
                entry: Some(end),
                ..wanted
            },
            None => wanted,
        }
    }

    /// The ends of an open line, each with the direction in which it would go on.
    fn ends_of_line(&self, index: usize) -> Vec<(Point, Vector)> {
        let contour = &self.outlines[index].contour;
        let segment = |at: usize| contour.segment(self.drawing, at).map(|it| it.geometry);
        let ends = (segment(0), segment(contour.len().saturating_sub(1)));
        match ends {
            (Some(first), Some(last)) if !contour.closed => vec![
                (first.start(), -first.start_tangent()),
                (last.end(), last.end_tangent()),
            ],
            _ => Vec::new(),
        }
    }

    /// The direction in which a wire leaves a contour at a point on it.
    fn way_out(&self, outline: usize, at: Point) -> Option<Vector> {
        let own = &self.outlines[outline];
        let near = self.units(self.settings.tolerances.join);
        let side = own.wire_side()?.sign();
        let met = own.contour.segments(self.drawing).map(|it| it.geometry);
        let met = met.filter(|it| it.distance_to(at) <= near);
        let ways = met.map(|it| left_normal(it.tangent_at(it.share_of(at).clamp(0.0, 1.0))));
        (ways.sum::<Vector>() * side).try_normalize(0.0)
    }

    /// Where a line is threaded at an end that lies in an opening or on a contour, and the outline of that.
    fn room_at(
        &self,
        line: usize,
        (end, outward): (Point, Vector),
        contours: &Contours,
    ) -> Option<(Point, usize)> {
        let join = self.units(self.settings.tolerances.join);
        let least = self.clearance(self.units(self.settings.correction));
        for outline in contours.about_point(end, join) {
            let contour = &self.outlines[outline].contour;
            let lies_on = (contour.segments(self.drawing))
                .any(|segment| segment.geometry.distance_to(end) <= join);
            if lies_on {
                // A common line ends where two parts do: the way between both is the one that takes least of them.
                let way = match self.outlines[line].contour.is_composed() {
                    true => self.way_out(outline, end)?,
                    false => outward,
                };
                let mut lead = self.units(self.settings.lead_in);
                while lead > least {
                    let at = end + way * lead;
                    let way_there = Segment::line(at, end);
                    let is_clear = contours.walls().nearer(at, least).is_none()
                        && self.crossed(&way_there, contours, Some(outline)).is_none();
                    if is_clear && self.is_on_wire_side(outline, at) {
                        return Some((at, outline));
                    }
                    lead /= 2.0;
                }
            } else if winding(self.drawing, contour, end) != 0 {
                // The innermost that holds it.
                return self.has_waste_inside(outline).then_some((end, outline));
            }
        }
        None
    }

    fn is_on_wire_side(&self, outline: usize, at: Point) -> bool {
        let own = &self.outlines[outline];
        let is_inside = winding(self.drawing, &own.contour, at) != 0;
        own.wire_side().is_some() && is_inside == self.has_waste_inside(outline)
    }

    /// The common lines within some outlines, which part what lies in these.
    pub(super) fn common_lines_within(&self, chosen: &[usize]) -> Vec<usize> {
        let is_common = |index: &usize| {
            let outline = &self.outlines[*index];
            outline.is_on_line() && outline.contour.is_composed()
        };
        let lies_in = |line: &usize| {
            let mut around = chosen
                .iter()
                .filter(|at| self.outlines[**at].contour.closed);
            around.any(|outer| self.lies_within(*line, *outer))
        };
        let lines = (0..self.outlines.len()).filter(is_common);
        lines.filter(lies_in).collect()
    }

    /// Of some outlines the lines that begin in openings among them without lying in these as a whole, each with its opening: an opening is
    /// cut before them.
    pub(super) fn openings_of_lines(&self, chosen: &[usize]) -> Vec<(usize, usize)> {
        let lines = || chosen.iter().filter(|&&it| self.outlines[it].is_on_line());
        if lines().next().is_none() || self.settings.compensation == Compensation::None {
            return Vec::new();
        }
        let contours = Contours::about(self, chosen);
        let mut found = Vec::new();
        for &line in lines() {
            let begins = self.ends_of_line(line).into_iter().filter_map(|end| {
                let (_, outline) = self.room_at(line, end, &contours)?;
                let is_opening = self.has_waste_inside(outline) && chosen.contains(&outline);
                (is_opening && !self.lies_within(line, outline)).then_some((line, outline))
            });
            found.extend(begins);
        }
        found
    }

    /// As the order of the cuts takes it: see `Nesting`.
    fn lies_within(&self, line: usize, outline: usize) -> bool {
        let [inner, outer] = [line, outline].map(|index| &self.outlines[index].contour);
        let [of_inner, of_outer] = [inner, outer].map(|contour| contour.bounds(self.drawing));
        let of_outer = of_outer.grown(self.units(ROUNDING));
        let first = inner.segment(self.drawing, 0);
        let middle = first.map(|first| first.geometry.point_at(0.5));
        of_outer.merged(&of_inner) == of_outer
            && middle.is_some_and(|at| winding(self.drawing, outer, at) != 0)
    }

    /// Brings openings before the lines that begin in them.
    pub(super) fn behind_their_openings(&self, order: &mut [usize]) {
        for (line, opening) in self.openings_of_lines(order) {
            let place = |of: usize| order.iter().position(|&other| other == of);
            if let (Some(early), Some(late)) = (place(line), place(opening))
                && early < late
            {
                order[early..=late].rotate_left(1);
            }
        }
    }

    /// True where the wire is threaded in what another contour has dropped: nothing is drilled there.
    pub(super) fn is_threaded_in_opening(
        &self,
        path: &WirePath,
        openings: &[(usize, usize)],
    ) -> bool {
        let mut own = openings.iter().filter(|(line, _)| *line == path.outline);
        own.any(|&(_, opening)| self.is_on_wire_side(opening, path.thread_hole))
    }
}

/// The parts of a piece that are farther from some points than `about`.
fn parts_away_from(points: &[Point], about: f64, piece: &Segment) -> Vec<Segment> {
    let mut shares = vec![0.0, 1.0];
    for &at in points {
        let start = at + direction(0.0) * about;
        let circle = Segment::Arc(Arc::about(at, start, start, true));
        shares.extend((meetings(piece, &circle).into_iter()).map(|at| piece.share_of(at)));
    }
    shares.sort_by(f64::total_cmp);
    let parts = shares.windows(2).filter(|pair| pair[1] > pair[0]);
    let parts = parts.map(|pair| piece.part(pair[0], pair[1]));
    let is_away = |part: &Segment| {
        let middle = part.point_at(0.5);
        points.iter().all(|at| (middle - at).norm() > about)
    };
    parts.filter(is_away).collect()
}
