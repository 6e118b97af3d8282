//! The path of the wire's centre: offset, corners, leads, order.
//!
//! Each piece of a path remembers the segment of the drawing that it comes from. A path never comes nearer to its contour than the
//! correction: where an offset would, there is a refusal and no path. Everything is in drawing units; settings are in mm.

mod clearance;
mod corners;
mod drawn;
mod leads;
mod offset;
mod order;
#[cfg(test)]
mod tests;

use crate::drawing::{Drawing, EntityId, Outline};
use crate::finding::{Finding, Rule, Severity, Side};
use crate::geometry::{Point, Segment};
use crate::settings::{Compensation, Effective};
use clearance::Walls;
use corners::{Element, Joining, closed_path};
use leads::{Entry, Surroundings, Wanted, default_entry, nearest, off_contour, path_point, thread_hole};
use offset::{Wall, walls};
use order::{begin_at, directed, name};

/// Where a piece of the path comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The offset of this segment of an entity.
    Segment {
        entity: EntityId,
        segment: usize,
    },
    /// The way round the convex corner at the end of this segment.
    Corner {
        entity: EntityId,
        segment: usize,
    },
    LeadIn,
    LeadOut,
}

/// One piece of the path of the wire's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSegment {
    pub geometry: Segment,
    pub source: Source,
}

/// The path of the wire's centre for one contour in one pass, in drawing units.
#[derive(Clone, Debug, PartialEq)]
pub struct WirePath {
    /// Index of the outline in the drawing's list.
    pub outline: usize,
    /// How far the path lies from the contour, drawing units; 0 where the contour is the path.
    pub correction: f64,
    /// Where the wire is threaded and comes back to.
    pub thread_hole: Point,
    /// The side of travel on which the control is to let the wire run; `None` where the path is that of the wire.
    pub side: Option<Side>,
    /// In order of travel, lead-in and lead-out included.
    pub segments: Vec<PathSegment>,
}

/// Why no path can be made; a plain sentence for the user, lower-case, no final dot.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    Sentence(String),
    /// Findings that the drawing gets only when a path is asked for, such as `lead-in`.
    Findings(Vec<Finding>),
    /// Nobody wants the path any more.
    Cancelled,
}

/// How much nearer than the correction a path may come by rounding, mm.
const ROUNDING: f64 = 1e-6;

/// The paths of all `outlines`, or of those that hold one of `handles`, in machining order.
pub fn plan(drawing: &Drawing, outlines: &[Outline], settings: &Effective, handles: Option<&[String]>) -> Result<Vec<WirePath>, Refusal> {
    plan_while(drawing, outlines, settings, handles, &|| true)
}

/// One contour among the cuts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// Index into the outlines.
    pub outline: usize,
    /// The start mark that is nearest to it, of those that are nearer to no other contour.
    pub mark: Option<Point>,
}

/// All contours in the order in which they are cut: as they are drawn, but what lies within one before it. `None` for a drawing of
/// so many contours or marks that finding out takes longer than a question may.
pub fn cuts(drawing: &Drawing, outlines: &[Outline], settings: &Effective) -> Option<Vec<Cut>> {
    const MOST_CONTOURS: usize = 20_000;
    const MOST_COMPARED: usize = 20_000_000;
    if outlines.len() > MOST_CONTOURS {
        return None;
    }
    let tolerances = settings.tolerances.in_units(settings.unit_of(drawing).mm);
    let chosen = order::chosen(drawing, outlines, None, tolerances.zero_length).unwrap_or_default();
    let segments: usize = outlines.iter().map(|outline| outline.contour.len()).sum();
    let marks = leads::marks(drawing, outlines, MOST_COMPARED / segments.max(1))?;
    Some(chosen.into_iter().map(|outline| Cut { outline, mark: leads::mark_of(&marks, outline) }).collect())
}

/// The same for as long as `goes_on` says so, which is asked every few milliseconds.
pub fn plan_while(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    handles: Option<&[String]>,
    goes_on: &dyn Fn() -> bool,
) -> Result<Vec<WirePath>, Refusal> {
    let tolerances = settings.tolerances.in_units(settings.unit_of(drawing).mm);
    let chosen = order::chosen(drawing, outlines, handles, tolerances.zero_length)?;
    if settings.compensation == Compensation::None
        && chosen.len() > 1
        && let Some(path) = drawn::one_path(
            drawing,
            outlines,
            &chosen,
            [settings.thread.as_ref(), settings.entry.as_ref()],
            settings.direction,
            tolerances.join,
        )
    {
        return Ok([path].into());
    }
    let wanted = leads::wanted(drawing, outlines, &chosen, settings)?;
    let job = Job { drawing, outlines, settings, unit_mm: settings.unit_of(drawing).mm, goes_on };
    job.go_on()?;
    let all = job.all_walls();
    let (mut paths, mut findings) = (Vec::new(), Vec::new());
    for (&index, wanted) in chosen.iter().zip(&wanted) {
        job.go_on()?;
        let path = match settings.compensation {
            Compensation::None => job.as_drawn(index, wanted),
            Compensation::Path => job.compensated(index, wanted, &all),
            Compensation::Controller => job.controlled(index, wanted, &all),
        };
        match path {
            Ok(path) => paths.push(path),
            Err(Refusal::Findings(found)) => findings.extend(found),
            Err(refusal) => return Err(refusal),
        }
    }
    if findings.is_empty() { Ok(paths) } else { Err(Refusal::Findings(findings)) }
}

/// What all contours of one request have in common.
struct Job<'a> {
    drawing: &'a Drawing,
    outlines: &'a [Outline],
    settings: &'a Effective,
    unit_mm: f64,
    goes_on: &'a dyn Fn() -> bool,
}

/// Elements of a path that are looked at between two questions whether it is still wanted.
const STEP: usize = 1024;

impl Job<'_> {
    fn go_on(&self) -> Result<(), Refusal> {
        if (self.goes_on)() { Ok(()) } else { Err(Refusal::Cancelled) }
    }

    fn all_walls(&self) -> Walls {
        let segments = self.outlines.iter().flat_map(|outline| outline.contour.segments(self.drawing));
        Walls::new(segments.map(|segment| segment.geometry).collect())
    }

    /// mm in drawing units.
    fn units(&self, mm: f64) -> f64 {
        mm / self.unit_mm
    }

    /// The contour itself as the wire's path.
    fn as_drawn(&self, index: usize, wanted: &Wanted) -> Result<WirePath, Refusal> {
        let outline = &self.outlines[index];
        let zero_length = self.units(self.settings.tolerances.zero_length);
        let (contour, _) = directed(outline, self.settings.direction);
        let mut walls = walls(contour.segments(self.drawing), contour.closed, zero_length);
        let handle = name(self.drawing, outline);
        let empty = || Refusal::Sentence(format!("contour {handle} has no length"));
        let path = if contour.closed {
            let path: Vec<Element> =
                walls.iter().enumerate().map(|(wall, w)| Element { geometry: w.geometry, source: w.source, wall }).collect();
            match self.entry(outline, &walls, wanted)? {
                Some(entry) => begin_at(path, entry.wall, entry.point),
                None => path,
            }
        } else {
            let (first, last) = (walls.first().ok_or_else(empty)?.geometry.start(), walls.last().ok_or_else(empty)?.geometry.end());
            if let Some(begin) = wanted.entry.or(wanted.thread) {
                let (to_first, to_last) = ((begin - first).norm(), (begin - last).norm());
                if wanted.entry.is_some() && to_first.min(to_last) > self.units(self.settings.tolerances.join) {
                    return Err(Refusal::Sentence(format!(
                        "contour {handle} is open and cannot be entered at ({}, {}), expected one of its ends",
                        begin.x, begin.y
                    )));
                }
                if to_last < to_first {
                    walls.reverse();
                    walls.iter_mut().for_each(|wall| wall.geometry = wall.geometry.reversed());
                }
            }
            walls.iter().enumerate().map(|(wall, w)| Element { geometry: w.geometry, source: w.source, wall }).collect()
        };
        let begin = path.first().ok_or_else(empty)?.geometry.start();
        let thread = wanted.thread.filter(|thread| (thread - begin).norm() > self.units(ROUNDING)).unwrap_or(begin);
        Ok(self.with_leads(index, 0.0, thread, path, contour.closed))
    }

    /// The offset of a closed contour.
    fn compensated(&self, index: usize, wanted: &Wanted, all: &Walls) -> Result<WirePath, Refusal> {
        let (outline, settings) = (&self.outlines[index], self.settings);
        let handle = name(self.drawing, outline);
        if !outline.contour.closed {
            return Err(Refusal::Sentence(format!(
                "contour {handle} is open: the side of the wire is not known; close it, or set compensation to none to cut it as drawn"
            )));
        }
        let Some(own_side) = outline.wire_side() else {
            return Err(Refusal::Sentence(format!("side of contour {handle} is not known: say opening or punch")));
        };
        let correction = self.units(settings.correction);
        let (contour, turned) = directed(outline, settings.direction);
        let side = if turned { own_side.reversed() } else { own_side }.sign();
        let walls = walls(contour.segments(self.drawing), true, self.units(settings.tolerances.zero_length));
        let joining = Joining {
            correction,
            side,
            corner: settings.corner,
            touch: self.units(1e-7),
            tolerance: self.units(settings.tolerances.report),
        };
        let collapsed = |at: Point| {
            Refusal::Sentence(format!(
                "the wire with a correction of {:.3} mm does not fit along contour {handle} near ({:.3}, {:.3}): its path would cut into the part",
                settings.correction, at.x, at.y
            ))
        };
        self.go_on()?;
        let path = closed_path(&walls, &joining).map_err(collapsed)?;
        self.go_on()?;
        let own = Walls::new(walls.iter().map(|wall| wall.geometry).collect());
        let clearance = correction - self.units(ROUNDING);
        for step in path.chunks(STEP) {
            self.go_on()?;
            if let Some(wall) = step.iter().find_map(|element| own.too_near(&element.geometry, clearance)) {
                return Err(collapsed(walls[wall].geometry.point_at(0.5)));
            }
        }
        if !keeps_its_side(&path, &walls, side) {
            return Err(collapsed(walls[0].geometry.start()));
        }
        let entry = match self.entry(outline, &walls, wanted)?.or_else(|| default_entry(&walls)) {
            Some(entry) => entry,
            None => return Err(Refusal::Sentence(format!("contour {handle} has no length"))),
        };
        let (element, begin) = path_point(&path, &walls, &entry, correction, side).ok_or_else(|| collapsed(entry.point))?;
        let severity = settings.severity(Rule::LeadIn).unwrap_or(Severity::Error);
        let surroundings = Surroundings { own: &own, all, clearance, unit_mm: self.unit_mm, severity };
        let thread = thread_hole(wanted, &entry, begin, &walls, settings, &surroundings).map_err(|fault| Refusal::Findings(vec![fault]))?;
        Ok(self.with_leads(index, correction, thread, begin_at(path, element, begin), true))
    }

    /// The part's contour, which the control offsets, with the thread hole of the path that comes of it.
    ///
    /// That path is made all the same: where it cannot be, the control would cut into the part or stop.
    fn controlled(&self, index: usize, wanted: &Wanted, all: &Walls) -> Result<WirePath, Refusal> {
        let offset = self.compensated(index, wanted, all)?;
        let outline = &self.outlines[index];
        let (contour, turned) = directed(outline, self.settings.direction);
        let side = outline.wire_side().map(|side| if turned { side.reversed() } else { side });
        let walls = walls(contour.segments(self.drawing), true, self.units(self.settings.tolerances.zero_length));
        let Some(entry) = self.entry(outline, &walls, wanted)?.or_else(|| default_entry(&walls)) else {
            return Err(Refusal::Sentence(format!("contour {} has no length", name(self.drawing, outline))));
        };
        let path = walls.iter().enumerate().map(|(wall, w)| Element { geometry: w.geometry, source: w.source, wall }).collect();
        let path = begin_at(path, entry.wall, entry.point);
        Ok(WirePath { side, ..self.with_leads(index, 0.0, offset.thread_hole, path, true) })
    }

    /// The entry that is asked for, or the one nearest to the thread hole; `None` where neither is given.
    fn entry(&self, outline: &Outline, walls: &[Wall], wanted: &Wanted) -> Result<Option<Entry>, Refusal> {
        let tie = self.units(ROUNDING);
        if let Some(point) = wanted.entry {
            return match nearest(walls, point, tie) {
                Some((entry, distance)) if distance <= self.units(self.settings.tolerances.join) => Ok(Some(entry)),
                found => {
                    let distance_mm = found.map_or(f64::INFINITY, |(_, distance)| distance * self.unit_mm);
                    Err(off_contour(self.drawing, outline, point, distance_mm))
                }
            };
        }
        Ok(wanted.thread.and_then(|thread| nearest(walls, thread, tie)).map(|(entry, _)| entry))
    }

    /// The path with the way from and back to the thread hole, where that is another point than its begin. An open path ends where it ends.
    fn with_leads(&self, outline: usize, correction: f64, thread_hole: Point, path: Vec<Element>, closed: bool) -> WirePath {
        let (begin, end) = match (path.first(), path.last()) {
            (Some(first), Some(last)) => (first.geometry.start(), last.geometry.end()),
            _ => (thread_hole, thread_hole),
        };
        let mut segments: Vec<PathSegment> = Vec::with_capacity(path.len() + 2);
        if thread_hole != begin {
            segments.push(PathSegment { geometry: Segment::line(thread_hole, begin), source: Source::LeadIn });
        }
        segments.extend(path.iter().map(|element| PathSegment { geometry: element.geometry, source: element.source }));
        if thread_hole != begin && closed {
            segments.push(PathSegment { geometry: Segment::line(end, thread_hole), source: Source::LeadOut });
        }
        WirePath { outline, correction, thread_hole, side: None, segments }
    }
}

/// True when a path runs round as its contour does, inside an opening and outside a punch.
fn keeps_its_side(path: &[Element], walls: &[Wall], side: f64) -> bool {
    let Some(origin) = walls.first().map(|wall| wall.geometry.start()) else { return false };
    let contour: f64 = walls.iter().map(|wall| wall.geometry.twice_area(origin)).sum();
    let path: f64 = path.iter().map(|element| element.geometry.twice_area(origin)).sum();
    let grows = (path - contour) * contour.signum();
    // To the left of a counter-clockwise contour lies its inside.
    path * contour > 0.0 && grows * side * contour.signum() <= 0.0
}
