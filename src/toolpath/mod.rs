//! The path of the wire's centre: offset, corners, leads, order.
//!
//! Each piece of a path remembers the segment of the drawing that it comes from. A path never comes nearer to its contour than the
//! correction, lies at it everywhere but on the tips of corners, and leaves out nothing that the wire can reach: `proof`. Where that
//! cannot be, there is an error finding at the place and no path. Everything is in drawing units; settings are in mm.

mod clearance;
mod corners;
mod drawn;
#[cfg(test)]
mod families;
mod leads;
mod loops;
mod offset;
mod order;
mod proof;
#[cfg(test)]
mod tests;

use crate::drawing::{Contour, Drawing, EntityId, Outline, Role};
use crate::finding::{Detail, Finding, Place, Rule, Severity, Side};
use crate::geometry::{Point, Segment};
use crate::settings::{Compensation, Corner, Effective, Jumps, Order};
use clearance::Walls;
use corners::{Element, Joining, Raw, with_tips};
use leads::{
    Contours, Entry, Kerfs, Surroundings, Wanted, circle_center, default_entry, fault, nearest,
    off_contour, path_point, thread_hole,
};
use loops::Found;
use offset::{Wall, walls};
use order::{Chosen, Pick, begin_at, directed, name};
use proof::{Proof, Unproved};
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::OnceLock;

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

impl Source {
    /// The segment of the drawing, where it is of one.
    pub fn place(self) -> Option<Place> {
        match self {
            Source::Segment { entity, segment } | Source::Corner { entity, segment } => {
                Some(Place::Segment { entity, segment })
            }
            Source::LeadIn | Source::LeadOut => None,
        }
    }
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
    /// Refused for the geometry: errors in the drawing, at their places. Some it gets only when a path is asked for, such as `lead-in`.
    Findings(Vec<Finding>),
    /// Nobody wants the path any more.
    Cancelled,
}

/// Walls up to this long, mm, are left out where there is no path otherwise.
const CRUMB: f64 = 4e-6;

/// How much nearer than the correction a path may come by rounding, mm.
const ROUNDING: f64 = 1e-6;

/// The paths of all `outlines`, or of those that hold one of `handles`, in machining order.
pub fn plan(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    handles: Option<&[String]>,
) -> Result<Vec<WirePath>, Refusal> {
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

/// All contours in the order in which they are cut. `None` for a drawing of so many contours or marks that finding out takes longer than
/// a question may, and where the order is that of the nearest thread holes and there is no path.
pub fn cuts(drawing: &Drawing, outlines: &[Outline], settings: &Effective) -> Option<Vec<Cut>> {
    const MOST_CONTOURS: usize = 20_000;
    const MOST_COMPARED: usize = 20_000_000;
    /// A path is laid for the order of the nearest.
    const MOST_LAID: usize = 10_000;
    if outlines.len() > MOST_CONTOURS {
        return None;
    }
    let tolerances = settings.tolerances.in_units(settings.unit_of(drawing).mm);
    let segments: usize = outlines.iter().map(|outline| outline.contour.len()).sum();
    let chosen = match settings.order {
        Order::Nearest if segments > MOST_LAID => return None,
        Order::Nearest => plan(drawing, outlines, settings, None)
            .ok()?
            .into_iter()
            .map(|path| path.outline)
            .collect(),
        order => {
            order::chosen(drawing, outlines, None, order, tolerances.zero_length)
                .unwrap_or_default()
                .outlines
        }
    };
    let marks = leads::marks(drawing, outlines, MOST_COMPARED / segments.max(1))?;
    Some(
        chosen
            .into_iter()
            .map(|outline| Cut {
                outline,
                mark: leads::mark_of(&marks, outline),
            })
            .collect(),
    )
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
    let Chosen {
        outlines: chosen,
        picks,
    } = order::chosen(
        drawing,
        outlines,
        handles,
        settings.order,
        tolerances.zero_length,
    )?;
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
    let job = Job {
        drawing,
        outlines,
        settings,
        picks,
        unit_mm: settings.unit_of(drawing).mm,
        goes_on,
    };
    job.go_on()?;
    let contours = Contours::new(drawing, outlines);
    let (paths, mut findings) = match settings.compensation {
        Compensation::None => job.as_drawn_all(&chosen, &wanted, &contours)?,
        Compensation::Path | Compensation::Controller => {
            job.offset_all(&chosen, &wanted, &contours)?
        }
    };
    let paths = if settings.order == Order::Nearest {
        order::by_nearest(drawing, outlines, paths)
    } else {
        paths
    };
    findings.extend(job.jumps_that_cut(&paths, &contours));
    if findings.is_empty() {
        Ok(paths)
    } else {
        Err(Refusal::Findings(findings))
    }
}

/// The entities of the contours that hold one of `handles`; `None` where none is named, which means all.
pub fn entities_of(
    drawing: &Drawing,
    outlines: &[Outline],
    handles: Option<&[String]>,
) -> Option<FxHashSet<EntityId>> {
    let holders = handles?
        .iter()
        .filter_map(|handle| order::outline_of(drawing, outlines, handle).ok());
    Some(
        holders
            .flat_map(|outline| {
                outlines[outline]
                    .contour
                    .pieces
                    .iter()
                    .map(|piece| piece.entity)
            })
            .collect(),
    )
}

/// What stands against a path along one contour under the settings' correction, as a finding: an error where there is none, a
/// warning where the wire can only stand. `None` where there is a path, and where the side of the wire is not known.
pub fn misfit(drawing: &Drawing, outline: &Outline, settings: &Effective) -> Option<Finding> {
    let side = outline.wire_side()?.sign();
    let job = Job {
        drawing,
        outlines: &[],
        settings,
        picks: FxHashMap::default(),
        unit_mm: settings.unit_of(drawing).mm,
        goes_on: &|| true,
    };
    let (walls, _, laid) = job.along(&outline.contour, side).ok()?;
    match laid {
        Ok(Laid::Path(_)) => None,
        Ok(Laid::Point(_)) => {
            let finding = job.no_path(&Fault::Nothing, &walls);
            let detail = Detail::OffsetCollapse {
                required: job.units(settings.correction),
                point: true,
            };
            Some(Finding {
                severity: settings.severity_over(Rule::OffsetCollapse, Severity::Warning)?,
                detail,
                ..finding
            })
        }
        Err(fault) => Some(job.no_path(&fault, &walls)),
    }
}

/// What all contours of one request have in common.
struct Job<'a> {
    drawing: &'a Drawing,
    outlines: &'a [Outline],
    settings: &'a Effective,
    /// What the selection says of contours, by outline.
    picks: FxHashMap<usize, Pick>,
    unit_mm: f64,
    goes_on: &'a dyn Fn() -> bool,
}

/// The offset of a contour, before it has leads.
enum Offset {
    Path(Box<Unled>),
    /// The wire stands in one point.
    Point(WirePath),
}

struct Unled {
    outline: usize,
    walls: Vec<Wall>,
    own: Walls,
    /// Begins anywhere.
    path: Vec<Element>,
    entry: Entry,
    /// The element of the path that is entered, and where.
    element: usize,
    begin: Point,
}

/// Elements of a path that are looked at between two questions whether it is still wanted.
const STEP: usize = 1024;

impl Job<'_> {
    fn go_on(&self) -> Result<(), Refusal> {
        if (self.goes_on)() {
            Ok(())
        } else {
            Err(Refusal::Cancelled)
        }
    }

    /// The contours themselves as paths, and the leads that cut through others.
    fn as_drawn_all(
        &self,
        chosen: &[usize],
        wanted: &[Wanted],
        contours: &Contours,
    ) -> Result<(Vec<WirePath>, Vec<Finding>), Refusal> {
        let (mut paths, mut findings) = (Vec::new(), Vec::new());
        for (&index, wanted) in chosen.iter().zip(wanted) {
            self.go_on()?;
            let path = self.as_drawn(index, wanted)?;
            let lead = path
                .segments
                .first()
                .filter(|piece| piece.source == Source::LeadIn)
                .map(|piece| piece.geometry);
            if let Some(lead) = lead
                && let Some(wall) = self.crossed(&lead, contours, Some(index))
            {
                let crossed = name(self.drawing, &self.outlines[contours.outline_of(wall)]);
                let (from, to) = (lead.start(), lead.end());
                let sentence = format!(
                    "the lead-in from the thread hole ({:.3}, {:.3}) to ({:.3}, {:.3}) cuts through contour {crossed}",
                    from.x, from.y, to.x, to.y
                );
                let source = path.segments.get(1).map(|piece| piece.source);
                findings.push(fault(
                    self.severity(),
                    source,
                    sentence,
                    Some(contours.place_of(wall)),
                ));
            }
            paths.push(path);
        }
        Ok((paths, findings))
    }

    /// The offsets of contours, with leads that are held against all of them, and the leads that do not fit.
    fn offset_all(
        &self,
        chosen: &[usize],
        wanted: &[Wanted],
        contours: &Contours,
    ) -> Result<(Vec<WirePath>, Vec<Finding>), Refusal> {
        let (mut paths, mut findings) = (Vec::new(), Vec::new());
        let mut offsets = Vec::with_capacity(chosen.len());
        for (&index, wanted) in chosen.iter().zip(wanted) {
            self.go_on()?;
            match self.compensated(index, wanted) {
                Ok(offset) => offsets.push((wanted, offset)),
                Err(Refusal::Findings(found)) => findings.extend(found),
                Err(refusal) => return Err(refusal),
            }
        }
        let kerfs = Kerfs::new(offsets.iter().filter_map(|(_, offset)| match offset {
            Offset::Path(unled) => Some((unled.outline, &unled.path[..])),
            Offset::Point(_) => None,
        }));
        for (wanted, offset) in offsets {
            self.go_on()?;
            let by_control = self.settings.compensation == Compensation::Controller;
            let unled = match offset {
                Offset::Path(unled) => unled,
                Offset::Point(point) if by_control => {
                    paths.push(self.controlled(point.outline, wanted, point.thread_hole)?);
                    continue;
                }
                Offset::Point(point) => {
                    paths.push(point);
                    continue;
                }
            };
            let thread = match self.thread_hole(&unled, wanted, contours, &kerfs) {
                Ok(thread) => thread,
                Err(finding) => {
                    findings.push(finding);
                    continue;
                }
            };
            paths.push(if by_control {
                self.controlled(unled.outline, wanted, thread)?
            } else {
                let path = begin_at(unled.path, unled.element, unled.begin);
                self.with_leads(
                    unled.outline,
                    self.units(self.settings.correction),
                    thread,
                    path,
                    true,
                )
            });
        }
        Ok((paths, findings))
    }

    fn severity(&self) -> Severity {
        self.settings
            .severity(Rule::LeadIn)
            .unwrap_or(Severity::Error)
    }

    /// How near the path may come to the walls.
    fn clearance(&self) -> f64 {
        match self.settings.compensation {
            Compensation::None => self.units(ROUNDING),
            _ => self.units(self.settings.correction - ROUNDING),
        }
    }

    /// The wall of a closed contour, `but` for one of them, that a straight way cuts.
    fn crossed(&self, way: &Segment, contours: &Contours, but: Option<usize>) -> Option<usize> {
        let counts = |wall: usize, _| {
            let outline = contours.outline_of(wall);
            Some(outline) != but && self.outlines[outline].contour.closed
        };
        contours.walls.find_near(way, self.clearance(), counts)
    }

    /// The ways from one contour to the next that cut through a part, where the wire stays threaded.
    fn jumps_that_cut(&self, paths: &[WirePath], contours: &Contours) -> Vec<Finding> {
        if !self.settings.stays_threaded || self.settings.jumps == Jumps::None {
            return Vec::new();
        }
        let cut = |pair: &[WirePath]| {
            let (from, next) = (pair[0].segments.last()?.geometry.end(), &pair[1]);
            let to = next.segments.first()?.geometry.start();
            let wall = self.crossed(&Segment::line(from, to), contours, None)?;
            let sentence = format!(
                "the way from ({:.3}, {:.3}) to ({:.3}, {:.3}) cuts into contour {}: the wire stays threaded, since the profile's pause does not stop the machine",
                from.x,
                from.y,
                to.x,
                to.y,
                name(self.drawing, &self.outlines[contours.outline_of(wall)])
            );
            let source = next
                .segments
                .iter()
                .map(|piece| piece.source)
                .find(|source| source.place().is_some());
            Some(fault(
                self.severity(),
                source,
                sentence,
                Some(contours.place_of(wall)),
            ))
        };
        paths.windows(2).filter_map(cut).collect()
    }

    /// The contour in the direction of the cut, and whether that is against its own.
    fn directed(&self, index: usize) -> (Contour, bool) {
        let picked = self.picks.get(&index).and_then(|pick| pick.turned);
        let outline = &self.outlines[index];
        // An explicit direction wins; an open contour has none but that of the selection.
        let picked =
            picked.filter(|_| self.settings.stated_direction.is_none() || !outline.contour.closed);
        directed(outline, self.settings.direction, picked)
    }

    /// mm in drawing units.
    fn units(&self, mm: f64) -> f64 {
        mm / self.unit_mm
    }

    /// The contour itself as the wire's path.
    fn as_drawn(&self, index: usize, wanted: &Wanted) -> Result<WirePath, Refusal> {
        let outline = &self.outlines[index];
        let zero_length = self.units(self.settings.tolerances.zero_length);
        let (contour, _) = self.directed(index);
        let mut walls = walls(contour.segments(self.drawing), contour.closed, zero_length);
        let handle = name(self.drawing, outline);
        let empty = || Refusal::Sentence(format!("contour {handle} has no length"));
        let path = if contour.closed {
            let path: Vec<Element> = walls
                .iter()
                .enumerate()
                .map(|(wall, w)| Element {
                    geometry: w.geometry,
                    source: w.source,
                    wall,
                })
                .collect();
            match self.entry(index, &walls, wanted)? {
                Some(entry) => begin_at(path, entry.wall, entry.point),
                None => path,
            }
        } else {
            let (first, last) = (
                walls.first().ok_or_else(empty)?.geometry.start(),
                walls.last().ok_or_else(empty)?.geometry.end(),
            );
            if let Some(begin) = wanted.entry.or(wanted.thread) {
                let (to_first, to_last) = ((begin - first).norm(), (begin - last).norm());
                if wanted.entry.is_some()
                    && to_first.min(to_last) > self.units(self.settings.tolerances.join)
                {
                    return Err(Refusal::Sentence(format!(
                        "contour {handle} is open and cannot be entered at ({}, {}), expected one of its ends",
                        begin.x, begin.y
                    )));
                }
                if to_last < to_first {
                    walls.reverse();
                    walls
                        .iter_mut()
                        .for_each(|wall| wall.geometry = wall.geometry.reversed());
                }
            }
            walls
                .iter()
                .enumerate()
                .map(|(wall, w)| Element {
                    geometry: w.geometry,
                    source: w.source,
                    wall,
                })
                .collect()
        };
        let begin = path.first().ok_or_else(empty)?.geometry.start();
        let thread = wanted
            .thread
            .filter(|thread| (thread - begin).norm() > self.units(ROUNDING))
            .unwrap_or(begin);
        Ok(self.with_leads(index, 0.0, thread, path, contour.closed))
    }

    /// The offset of a closed contour.
    fn compensated(&self, index: usize, wanted: &Wanted) -> Result<Offset, Refusal> {
        let (outline, settings) = (&self.outlines[index], self.settings);
        let handle = name(self.drawing, outline);
        if !outline.contour.closed {
            return Err(Refusal::Sentence(format!(
                "contour {handle} is open: the side of the wire is not known; close it, or set compensation to none to cut it as drawn"
            )));
        }
        let Some(own_side) = outline.wire_side() else {
            return Err(Refusal::Sentence(format!(
                "side of contour {handle} is not known: say opening or punch"
            )));
        };
        let correction = self.units(settings.correction);
        let (contour, turned) = self.directed(index);
        let side = if turned {
            own_side.reversed()
        } else {
            own_side
        }
        .sign();
        let (walls, own, laid) = self.along(&contour, side)?;
        let path = match laid {
            Ok(Laid::Path(path)) => path,
            Ok(Laid::Point(point)) => {
                return self
                    .threaded(index, wanted, &walls, correction, point)
                    .map(Offset::Point);
            }
            Err(fault) => return Err(Refusal::Findings(vec![self.no_path(&fault, &walls)])),
        };
        let entry = match self
            .entry(index, &walls, wanted)?
            .or_else(|| default_entry(&walls))
        {
            Some(entry) => entry,
            None => return Err(Refusal::Sentence(format!("contour {handle} has no length"))),
        };
        let (element, begin) =
            path_point(&path, &walls, &entry, correction, side).ok_or_else(|| {
                Refusal::Findings(vec![
                    self.no_path(&Fault::Unproved { wall: entry.wall }, &walls),
                ])
            })?;
        Ok(Offset::Path(Box::new(Unled {
            outline: index,
            walls,
            own,
            path,
            entry,
            element,
            begin,
        })))
    }

    /// The thread hole for the offset of a contour, or what is in the way.
    fn thread_hole(
        &self,
        unled: &Unled,
        wanted: &Wanted,
        contours: &Contours,
        kerfs: &Kerfs,
    ) -> Result<Point, Finding> {
        if wanted.thread.is_none() && goes_out_and_back(&unled.path) {
            // There is no room beside the path.
            return Ok(unled.begin);
        }
        let surroundings = Surroundings {
            drawing: self.drawing,
            outlines: self.outlines,
            outline: unled.outline,
            own: &unled.own,
            contours,
            kerfs,
            clearance: self.clearance(),
            unit_mm: self.unit_mm,
            severity: self.severity(),
        };
        let is_opening = self.outlines[unled.outline].role == Role::Opening;
        let says_nothing = wanted.entry.is_none()
            && wanted.beside.is_none()
            && self.settings.stated_lead_in.is_none();
        let center = if is_opening && says_nothing {
            circle_center(&unled.walls, self.units(self.settings.tolerances.report))
        } else {
            None
        };
        thread_hole(
            wanted,
            center,
            &unled.entry,
            unled.begin,
            &unled.walls,
            self.settings,
            &surroundings,
        )
    }

    /// The walls of a closed contour with the wire on the side of that sign, and the path along them, proved. Where there is none because
    /// of crumbs, they are left out: their neighbours move by less than what any control can follow.
    fn along(&self, contour: &Contour, side: f64) -> Result<(Vec<Wall>, Walls, Outcome), Refusal> {
        let of = |shortest: f64| {
            let walls = walls(contour.segments(self.drawing), true, self.units(shortest));
            let own = Walls::new(walls.iter().map(|wall| wall.geometry).collect());
            (walls, own)
        };
        let (walls, own) = of(self.settings.tolerances.zero_length);
        let laid = self.laid(&walls, &own, side)?;
        if laid.is_err()
            && walls
                .iter()
                .any(|wall| wall.geometry.length() <= self.units(CRUMB))
        {
            let (walls, own) = of(CRUMB);
            if let Ok(path) = self.laid(&walls, &own, side)? {
                return Ok((walls, own, Ok(path)));
            }
        }
        Ok((walls, own, laid))
    }

    /// The path along a closed contour, proved; `walls` have the wire on the side of that sign.
    fn laid(&self, walls: &[Wall], own: &Walls, side: f64) -> Result<Outcome, Refusal> {
        let correction = self.units(self.settings.correction);
        let joining = Joining {
            correction,
            side,
            touch: self.units(1e-7),
            tolerance: self.units(self.settings.tolerances.report),
        };
        self.go_on()?;
        let raw = Raw::new(walls, &joining);
        let rounding = self.units(ROUNDING);
        let proof = Proof {
            walls,
            raw: &raw,
            own,
            correction,
            side,
            rounding,
            near_raw: OnceLock::new(),
        };
        let tipped = |path: Vec<(usize, Element)>| {
            let path: Vec<Element> = path.into_iter().map(|(_, element)| element).collect();
            Laid::Path(match self.settings.corner {
                Corner::Intersection => {
                    with_tips(path, walls, &joining, own, correction - rounding)
                }
                Corner::Arc => path,
            })
        };
        self.go_on()?;
        let found = match &raw.elements[..] {
            [circle] if circle.geometry.length() > 0.0 => Some(vec![(0, *circle)]),
            _ => raw.trimmed(),
        };
        if let Some(path) = found.filter(|path| keeps_its_side(path, walls, side))
            && self.holds(&proof, &path)?.is_ok()
        {
            return Ok(Ok(tipped(path)));
        }
        let mut loops = match loops::find(&proof, self.goes_on) {
            Found::Loops(loops) => loops,
            Found::Point(point) => return Ok(Ok(Laid::Point(point))),
            // Outside of a contour there is always room: one that is turned inside out somewhere is so where it is finest.
            Found::Nothing if !proof.is_inside() => {
                return Ok(Err(Fault::Unproved {
                    wall: shortest(walls),
                }));
            }
            Found::Nothing => return Ok(Err(Fault::Nothing)),
            Found::Torn(raw_element) => {
                return Ok(Err(Fault::Unproved {
                    wall: raw.elements[raw_element].wall,
                }));
            }
            Found::Cancelled => return Err(Refusal::Cancelled),
        };
        if loops.len() > 1 {
            loops.retain(|path| {
                path.first()
                    .is_none_or(|(_, piece)| proof.is_on_wire_side(piece.geometry.point_at(0.5)))
            });
        }
        // The wire is threaded into the largest; outside a punch that is the one round it.
        let size = |path: &Vec<(usize, Element)>| {
            path.iter()
                .map(|(_, element)| element.geometry.length())
                .sum::<f64>()
        };
        loops.sort_by(|a, b| size(b).total_cmp(&size(a)));
        if let Some((_, lost)) = loops.get(1).and_then(|lost| lost.first()) {
            return Ok(Err(Fault::Several {
                near: lost.geometry.point_at(0.5),
                wall: lost.wall,
            }));
        }
        let Some(path) = loops.pop() else {
            return Ok(Err(Fault::Nothing));
        };
        if !keeps_its_side(&path, walls, side) {
            return Ok(Err(Fault::Unproved { wall: 0 }));
        }
        Ok(self
            .holds(&proof, &path)?
            .map(|()| tipped(path))
            .map_err(|Unproved { wall }| Fault::Unproved { wall }))
    }

    /// Holds a path against its proof.
    fn holds(
        &self,
        proof: &Proof,
        path: &[(usize, Element)],
    ) -> Result<Result<(), Unproved>, Refusal> {
        for pieces in path.chunks(STEP) {
            self.go_on()?;
            if let Err(fault) = proof.pieces_hold(pieces) {
                return Ok(Err(fault));
            }
        }
        let mut by_raw = path.to_vec();
        let share = |(raw, piece): &(usize, Element)| {
            proof.raw.elements[*raw]
                .geometry
                .share_of(piece.geometry.start())
        };
        by_raw.sort_by(|a, b| a.0.cmp(&b.0).then_with(|| share(a).total_cmp(&share(b))));
        let count = proof.raw.elements.len();
        for first in (0..count).step_by(STEP) {
            self.go_on()?;
            if let Err(fault) = proof.nothing_is_missing(&by_raw, first..(first + STEP).min(count))
            {
                return Ok(Err(fault));
            }
        }
        Ok(Ok(()))
    }

    /// The finding that stands for a path which cannot be made.
    fn no_path(&self, fault: &Fault, walls: &[Wall]) -> Finding {
        let required = self.units(self.settings.correction);
        let near = |wall: usize| {
            walls
                .get(wall)
                .map_or_else(Point::origin, |wall| wall.geometry.point_at(0.5))
        };
        let (rule, detail, wall) = match *fault {
            Fault::Nothing => (
                Rule::OffsetCollapse,
                Detail::OffsetCollapse {
                    required,
                    point: false,
                },
                0,
            ),
            Fault::Several { near, wall } => (Rule::LostPocket, Detail::LostPocket { near }, wall),
            Fault::Unproved { wall } => (
                Rule::UnprovedPath,
                Detail::UnprovedPath { near: near(wall) },
                wall,
            ),
        };
        let place = walls
            .get(wall)
            .and_then(|wall| wall.source.place())
            .unwrap_or(Place::Document);
        let severity = self.settings.severity(rule).unwrap_or(Severity::Error);
        Finding {
            rule,
            severity,
            place,
            detail,
            related: Vec::new(),
        }
    }

    /// The path where the wire's centre can only stand: it is threaded there, and cuts nothing more.
    fn threaded(
        &self,
        index: usize,
        wanted: &Wanted,
        walls: &[Wall],
        correction: f64,
        point: Point,
    ) -> Result<WirePath, Refusal> {
        let join = self.units(self.settings.tolerances.join);
        if let Some(thread) = wanted
            .thread
            .filter(|thread| (thread - point).norm() > join)
        {
            let wall = nearest(walls, thread, join).map_or(0, |(entry, _)| entry.wall);
            let sentence = format!(
                "the thread hole ({:.3}, {:.3}) comes nearer to the contour than the correction {:.3} mm: the wire can stand at ({:.3}, {:.3}) alone",
                thread.x, thread.y, self.settings.correction, point.x, point.y
            );
            let source = walls.get(wall).map(|wall| wall.source);
            return Err(Refusal::Findings(vec![fault(
                self.severity(),
                source,
                sentence,
                None,
            )]));
        }
        Ok(WirePath {
            outline: index,
            correction,
            thread_hole: point,
            side: None,
            segments: Vec::new(),
        })
    }

    /// The part's contour, which the control offsets, with the thread hole of the path that comes of it.
    ///
    /// That path has been made all the same: where it cannot be, the control would cut into the part or stop.
    fn controlled(
        &self,
        index: usize,
        wanted: &Wanted,
        thread_hole: Point,
    ) -> Result<WirePath, Refusal> {
        let outline = &self.outlines[index];
        let (contour, turned) = self.directed(index);
        let side = outline
            .wire_side()
            .map(|side| if turned { side.reversed() } else { side });
        let walls = walls(
            contour.segments(self.drawing),
            true,
            self.units(self.settings.tolerances.zero_length),
        );
        let Some(entry) = self
            .entry(index, &walls, wanted)?
            .or_else(|| default_entry(&walls))
        else {
            return Err(Refusal::Sentence(format!(
                "contour {} has no length",
                name(self.drawing, outline)
            )));
        };
        let path = walls
            .iter()
            .enumerate()
            .map(|(wall, w)| Element {
                geometry: w.geometry,
                source: w.source,
                wall,
            })
            .collect();
        let path = begin_at(path, entry.wall, entry.point);
        Ok(WirePath {
            side,
            ..self.with_leads(index, 0.0, thread_hole, path, true)
        })
    }

    /// The entry that is asked for, that beside the mark, the begin of the entity that was picked first, or the point nearest to the
    /// thread hole; `None` where nothing of it is given.
    fn entry(
        &self,
        index: usize,
        walls: &[Wall],
        wanted: &Wanted,
    ) -> Result<Option<Entry>, Refusal> {
        let outline = &self.outlines[index];
        let tie = self.units(ROUNDING);
        if let Some(point) = wanted.entry {
            return match nearest(walls, point, tie) {
                Some((entry, distance))
                    if distance <= self.units(self.settings.tolerances.join) =>
                {
                    Ok(Some(entry))
                }
                found => {
                    let distance_mm =
                        found.map_or(f64::INFINITY, |(_, distance)| distance * self.unit_mm);
                    Err(off_contour(self.drawing, outline, point, distance_mm))
                }
            };
        }
        let near = |point: Option<Point>| {
            point
                .and_then(|point| nearest(walls, point, tie))
                .map(|(entry, _)| entry)
        };
        let picked = || {
            let first = self.picks.get(&index)?.first;
            let is_of = |wall: &Wall| matches!(wall.source, Source::Segment { entity, .. } if entity == first);
            let begins = |&at: &usize| {
                is_of(&walls[at]) && !is_of(&walls[(at + walls.len() - 1) % walls.len()])
            };
            let wall = (0..walls.len()).find(begins)?;
            Some(Entry {
                wall,
                share: 0.0,
                point: walls[wall].geometry.start(),
            })
        };
        Ok(near(wanted.beside)
            .or_else(picked)
            .or_else(|| near(wanted.thread)))
    }

    /// The path with the way from and back to the thread hole, where that is another point than its begin. An open path ends where it ends.
    fn with_leads(
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
        if thread_hole != begin {
            segments.push(PathSegment {
                geometry: Segment::line(thread_hole, begin),
                source: Source::LeadIn,
            });
        }
        segments.extend(path.iter().map(|element| PathSegment {
            geometry: element.geometry,
            source: element.source,
        }));
        if thread_hole != begin && closed {
            segments.push(PathSegment {
                geometry: Segment::line(end, thread_hole),
                source: Source::LeadOut,
            });
        }
        WirePath {
            outline,
            correction,
            thread_hole,
            side: None,
            segments,
        }
    }
}

/// What a contour gives the wire.
enum Laid {
    Path(Vec<Element>),
    /// The one place where the wire's centre may be.
    Point(Point),
}

/// What comes of a contour.
type Outcome = Result<Laid, Fault>;

/// Why a contour has no path, with the wall where that shows.
#[derive(Clone, Copy, Debug)]
enum Fault {
    /// Nowhere along it does the wire fit.
    Nothing,
    /// There are several places for the wire with no way from one to the other.
    Several { near: Point, wall: usize },
    /// There is a path, but it does not hold its proof.
    Unproved { wall: usize },
}

/// The shortest of the walls.
fn shortest(walls: &[Wall]) -> usize {
    let length = |wall: &usize| walls[*wall].geometry.length();
    (0..walls.len())
        .min_by(|a, b| length(a).total_cmp(&length(b)))
        .unwrap_or(0)
}

/// True for the path in a slot that is just as wide as the wire: it goes round nothing.
fn goes_out_and_back(path: &[Element]) -> bool {
    let Some(origin) = path.first().map(|element| element.geometry.start()) else {
        return false;
    };
    let area: f64 = path
        .iter()
        .map(|element| element.geometry.twice_area(origin))
        .sum();
    let length: f64 = path.iter().map(|element| element.geometry.length()).sum();
    area.abs() <= 1e-9 * length * length
}

/// True when a path runs round as its contour does, inside an opening and outside a punch. Out and back along a line is no way round.
fn keeps_its_side(path: &[(usize, Element)], walls: &[Wall], side: f64) -> bool {
    let Some(origin) = walls.first().map(|wall| wall.geometry.start()) else {
        return false;
    };
    let contour: f64 = walls
        .iter()
        .map(|wall| wall.geometry.twice_area(origin))
        .sum();
    let area: f64 = path
        .iter()
        .map(|(_, element)| element.geometry.twice_area(origin))
        .sum();
    let elements: Vec<Element> = path.iter().map(|(_, element)| *element).collect();
    let grows = (area - contour) * contour.signum();
    let inside = grows * side * contour.signum() <= 0.0;
    // To the left of a counter-clockwise contour lies its inside.
    inside && (area * contour > 0.0 || goes_out_and_back(&elements))
}
