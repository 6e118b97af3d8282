//! The paths of all contours of one request, with their leads, each checked against all contours.

use super::Planned;
use super::clearance::Walls;
use super::contour_path::{Along, Fault, Laid};
use super::contours::Contours;
use super::cores::each;
use super::corners::{Element, elements};
use super::entry::{Entry, default_entry, path_point};
use super::finished::{Finished, Kerf, finished};
use super::hole::Holes;
use super::job::{Job, ROUNDING};
use super::lead_form::Landing;
use super::leads::Kerfs;
use super::offset::Wall;
use super::order::directed;
use super::path::{Refusal, WirePath};
use super::requested::Requested;
use super::rotated::Rotated;
use crate::drawing::Contour;
use crate::finding::{Finding, Rule, Severity};
use crate::geometry::{Point, Side};
use crate::message::has_options;
use rustc_hash::FxHashMap;

/// The offsets of a contour, before they have leads, all in the direction of the first pass.
pub(super) struct Unled {
    pub(crate) outline: usize,
    pub(crate) walls: Vec<Wall>,
    pub(crate) own: Walls,
    /// `None` where the wire only stands.
    pub(crate) entry: Option<Entry>,
    /// +1 where the wire runs to the left of the walls, −1 to the right.
    pub(crate) side: f64,
    pub(crate) passes: Vec<Pass>,
}

/// What the wire follows of one contour.
enum Offset {
    /// The contour itself, ready.
    Line(WirePath),
    /// With what is wanted of it, without leads.
    Beside(Requested, Box<Unled>),
}

/// Contours that one core takes at a time.
const CONTOURS_AT_A_TIME: usize = 8;

/// One pass along a contour.
pub(super) struct Pass {
    /// Drawing units; below 0 where the wire runs on the other side of the contour than in the first pass.
    pub(crate) correction: f64,
    /// Begins anywhere; empty where the wire stands in one point.
    pub(crate) path: Vec<Element>,
    /// The element of the path that is entered, and where.
    pub(crate) element: usize,
    pub(crate) begin: Point,
}

impl Pass {
    /// Where the wire comes to the path, from the `side` of the walls.
    pub(super) fn landing(&self, side: f64) -> Landing {
        let along = self.path.get(self.element).map(|element| {
            let geometry = element.geometry;
            geometry.tangent_at(geometry.share_of(self.begin).clamp(0.0, 1.0))
        });
        Landing::of_begin(self.begin, along.unwrap_or_default(), side, 0.0)
    }
}

impl Job<'_> {
    /// The paths of contours, beside them or on their lines, with leads that are checked against all of them, and what does not fit.
    pub(crate) fn all_paths(
        &self,
        chosen: &[usize],
        wanted: &[Requested],
        contours: &Contours,
    ) -> Result<(Planned, Vec<Finding>), Refusal> {
        let (mut planned, mut findings) = (Planned::default(), Vec::new());
        let mut offsets = Vec::with_capacity(chosen.len());
        let made = each(chosen.len(), CONTOURS_AT_A_TIME, |at| {
            self.go_on()?;
            self.offset(chosen[at], &wanted[at], contours)
        });
        for made in made {
            match made {
                Ok(Offset::Line(path)) => {
                    findings.extend(self.line_fault(&path, contours));
                    planned.paths.push(path);
                }
                Ok(Offset::Beside(wanted, unled)) => offsets.push((wanted, *unled)),
                Err(Refusal::Findings(found)) => findings.extend(found),
                Err(refusal) => return Err(refusal),
            }
        }
        // What is cut along a contour is in no way of its own leads.
        let others = if offsets.len() > 1 { &offsets[..] } else { &[] };
        let kerfs = Kerfs::new(others.iter().filter_map(|(_, unled)| {
            let rough = unled.passes.first()?;
            Some((unled.outline, &rough.path[..]))
        }));
        let mut holes = Holes::default();
        let given = wanted.iter().filter_map(|wanted| wanted.thread);
        given.for_each(|thread| holes.push(thread));
        for (mut wanted, mut unled) in offsets {
            self.go_on()?;
            let thread_hole = |unled: &Unled| {
                let wanted = &wanted;
                self.thread_hole(unled, wanted, contours, &kerfs, &holes)
            };
            let thread = match thread_hole(&unled) {
                Ok(thread) => thread,
                Err(finding) => match self.entered_elsewhere(&mut unled, &wanted, thread_hole) {
                    Some((entry, thread)) => {
                        wanted.entry = Some(entry);
                        thread
                    }
                    None => {
                        findings.push(finding);
                        continue;
                    }
                },
            };
            holes.push(thread);
            if let Some(found) = self.finished(&unled) {
                let before = planned.finished;
                planned.finished = Some(before.map_or(found, |before| before.merged(found)));
            }
            match self.led(unled, &wanted, thread, contours, &kerfs) {
                Ok(paths) => planned.paths.extend(paths),
                Err(Refusal::Findings(found)) => findings.extend(found),
                Err(refusal) => return Err(refusal),
            }
        }
        let places: FxHashMap<usize, usize> = chosen.iter().copied().zip(0..).collect();
        planned.paths.sort_by_key(|path| places.get(&path.outline));
        Ok((planned, findings))
    }

    /// The offsets of one contour, or the contour itself.
    fn offset(
        &self,
        index: usize,
        wanted: &Requested,
        contours: &Contours,
    ) -> Result<Offset, Refusal> {
        if self.settings.runs_on(&self.outlines[index]) {
            return Ok(Offset::Line(self.on_line(index, wanted, contours)?));
        }
        let wanted = self.with_proposed(index, *wanted, contours);
        let unled = self.compensated(index, &wanted, contours)?;
        Ok(Offset::Beside(wanted, Box::new(unled)))
    }

    /// The path along the drawn line. An electrode comes from above, to where it begins.
    fn on_line(
        &self,
        index: usize,
        wanted: &Requested,
        contours: &Contours,
    ) -> Result<WirePath, Refusal> {
        let thread = match self.settings.mills {
            true => wanted.thread.or(wanted.beside),
            false => wanted.thread,
        };
        let wanted = self.with_room(index, Requested { thread, ..*wanted }, contours);
        let mut path = self.as_drawn(index, &wanted)?;
        if self.settings.mills {
            path.segments.retain(|piece| piece.source.place().is_some());
            path.thread_hole = path.begin();
        }
        Ok(path)
    }

    /// Where a start hole is to be in an opening for which nothing is set: in the deepest point.
    fn with_proposed(&self, index: usize, wanted: Requested, contours: &Contours) -> Requested {
        let says_nothing = wanted.thread.is_none()
            && wanted.entry.is_none()
            && wanted.beside.is_none()
            && self.settings.stated_lead_in.is_none();
        let is_proposed = says_nothing
            && self.hole_reach().is_some()
            && self.has_waste_inside(index)
            && self.outlines[index].contour.closed;
        let alone = Holes::default();
        let deepest = || Some(self.deepest(index, contours, f64::INFINITY, &alone)?.0);
        Requested {
            proposed: if is_proposed { deepest() } else { None },
            ..wanted
        }
    }

    /// What all passes leave of a contour, where that is asked for; of a closed one where there are several.
    fn finished(&self, unled: &Unled) -> Option<Finished> {
        // At an end of an open contour a single pass may leave more than what its corners say.
        let (count, closed) = (
            unled.passes.len(),
            self.outlines[unled.outline].contour.closed,
        );
        if !self.finishes || count < 2 && closed {
            return None;
        }
        // Half the kerf of the last pass is its correction where nothing else is known: no later pass finds any stock.
        let kerf = |(number, pass): (usize, &Pass)| {
            let correction = pass.correction.abs();
            let last = (number + 1 == count).then_some(correction);
            let half = self.settings.half_kerf(number).map(|half| self.units(half));
            let half = half.or(last)?;
            Some(Kerf::new(&pass.path, pass.begin, correction, half))
        };
        let kerfs: Vec<Kerf> = unled.passes.iter().enumerate().filter_map(kerf).collect();
        let last = unled.passes.last()?;
        finished(&unled.walls, &last.path, &kerfs, self.units(1e-5))
    }

    pub(super) fn severity(&self) -> Severity {
        self.settings
            .severity(Rule::LeadIn)
            .unwrap_or(Severity::Error)
    }

    /// The contour in the direction of the cut, and whether that is against its own.
    pub(super) fn directed(&self, index: usize) -> (Contour, bool) {
        let picked = self.picks.get(&index).and_then(|pick| pick.turned);
        let outline = &self.outlines[index];
        // An explicit direction wins; an open contour has none but that of the selection.
        let picked =
            picked.filter(|_| self.settings.stated_direction.is_none() || !outline.contour.closed);
        directed(outline, self.settings.direction, picked)
    }

    /// The same, but that an open contour is begun at the end that is entered, or that the thread hole is nearer to.
    fn towards(&self, index: usize, wanted: &Requested) -> Result<(Contour, bool), Refusal> {
        let (contour, turned) = self.directed(index);
        let ends = || {
            let first = contour.segment(self.drawing, 0)?.geometry.start();
            let last = contour.len().checked_sub(1)?;
            Some((first, contour.segment(self.drawing, last)?.geometry.end()))
        };
        let begin = wanted.entry.or(wanted.thread).or(wanted.beside);
        let begin = begin.filter(|_| !contour.closed);
        let Some((begin, (first, last))) = begin.zip(ends()) else {
            return Ok((contour, turned));
        };
        let (to_first, to_last) = ((begin - first).norm(), (begin - last).norm());
        let join = self.units(self.settings.tolerances.join);
        if wanted.entry.is_some() && to_first.min(to_last) > join {
            let (handle, begin) = (self.name(index), self.in_mm(begin));
            return Err(Refusal::Sentence(say!(
                contour_is_open_and_cannot_be_entered_at,
                handle,
                begin.x,
                begin.y
            )));
        }
        Ok(match to_last < to_first {
            true => (contour.reversed(), !turned),
            false => (contour, turned),
        })
    }

    /// The contour itself as the wire's path.
    pub(super) fn as_drawn(&self, index: usize, wanted: &Requested) -> Result<WirePath, Refusal> {
        let (contour, _) = self.towards(index, wanted)?;
        let walls = self.walls(&contour);
        let empty = || Refusal::Sentence(say!(contour_has_no_length, self.name(index)));
        let path = if contour.closed {
            let path = elements(&walls);
            match self.entry(index, &walls, wanted)? {
                Some(entry) => Rotated::at(path, entry.wall, entry.point).into_path(),
                None => path,
            }
        } else {
            elements(&walls)
        };
        let begin = path.first().ok_or_else(empty)?.geometry.start();
        let thread = wanted
            .thread
            .filter(|thread| (thread - begin).norm() > self.units(ROUNDING))
            .unwrap_or(begin);
        let path = self.with_leads(index, 0.0, thread, path, contour.closed);
        Ok(WirePath {
            on_line: self.outlines[index].is_on_line(),
            ..path
        })
    }

    /// Names the contour by its number, its first entity and the place where it begins.
    fn without_side(&self, index: usize) -> Refusal {
        let (contour, handle) = (&self.outlines[index].contour, self.name(index));
        let number = (index + 1).to_string();
        let name = match handle == number {
            true => number,
            false => say!(number_and_handle, number, handle),
        };
        let begin = contour
            .segment(self.drawing, 0)
            .map(|it| it.geometry.start());
        let at = begin.unwrap_or_default() * self.unit_mm;
        let (x, y) = (at.x, at.y);
        Refusal::Sentence(match (contour.closed, has_options()) {
            (true, true) => say!(side_of_contour_is_not_known_give_an_option, name, x, y),
            (true, false) => say!(side_of_contour_is_not_known, name, x, y),
            (false, _) => say!(
                contour_is_open_the_side_of_the_wire_is_not_known,
                name,
                x,
                y
            ),
        })
    }

    /// The offsets of a contour, one for each pass.
    pub(super) fn compensated(
        &self,
        index: usize,
        wanted: &Requested,
        contours: &Contours,
    ) -> Result<Unled, Refusal> {
        let (outline, settings) = (&self.outlines[index], self.settings);
        let closed = outline.contour.closed;
        let Some(own_side) = outline.wire_side() else {
            return Err(self.without_side(index));
        };
        let (contour, turned) = self.towards(index, wanted)?;
        let side = match turned {
            true => own_side.reversed().sign(),
            false => own_side.sign(),
        };
        let corrections = settings.each_correction().into_iter();
        let corrections: Vec<f64> = corrections.map(|mm| self.units(mm)).collect();
        let rough = corrections.first().copied().unwrap_or_default();
        let segment = |at: usize| contour.segment(self.drawing, at);
        let (walls, own, first) = self.along(contour.len(), segment, side, rough, closed)?;
        let along = Along {
            side,
            correction: rough,
            closed,
        };
        let later = corrections.get(1..).unwrap_or_default();
        let mut all = self.each_pass(&walls, &own, first, later, along)?;
        for (laid, &correction) in all.iter_mut().zip(&corrections) {
            if let Ok(Laid::Path(path)) = laid {
                let rolled = std::mem::take(path);
                *path = self.beside_others(rolled, (&walls, &own), correction, index, contours)?;
            }
        }
        let path_of = |pass: usize| match &all[pass] {
            Ok(Laid::Path(path)) => Some(path),
            _ => None,
        };
        let is_any_path = (0..all.len()).any(|pass| path_of(pass).is_some());
        let is_fault = all.first().is_some_and(Result::is_err);
        let entry = match (is_any_path && !is_fault, closed) {
            (false, _) => None,
            (true, true) => {
                let entry = self.entry(index, &walls, wanted)?;
                entry.or_else(|| default_entry(&walls))
            }
            (true, false) => walls.first().map(|first| Entry {
                wall: 0,
                share: 0.0,
                point: first.geometry.start(),
            }),
        };
        // An open path begins where it begins.
        let begins = each(all.len(), 1, |pass| {
            let path = path_of(pass)?;
            let first = path.first().map(|first| (0, first.geometry.start()));
            first
                .filter(|_| !closed)
                .or_else(|| path_point(path, &walls, &entry?, corrections[pass], side))
        });
        let mut passes: Vec<Pass> = Vec::with_capacity(corrections.len());
        for ((correction, laid), begin) in corrections.into_iter().zip(all).zip(begins) {
            let path = match laid {
                Ok(Laid::Path(path)) => path,
                Ok(Laid::Point(begin)) => {
                    let (path, element) = (Vec::new(), 0);
                    passes.push(Pass {
                        correction,
                        path,
                        element,
                        begin,
                    });
                    continue;
                }
                Err(fault) => return Err(self.no_path(&fault, &walls, correction.abs()).into()),
            };
            let Some(at) = entry else {
                return Err(Refusal::Sentence(say!(
                    contour_has_no_length,
                    self.name(index)
                )));
            };
            let (element, begin) = begin.ok_or_else(|| {
                let fault = Fault::Unproved { wall: at.wall };
                self.no_path(&fault, &walls, correction.abs())
            })?;
            passes.push(Pass {
                correction,
                path,
                element,
                begin,
            });
        }
        if let Some(stand) = passes.iter().find(|pass| pass.path.is_empty()) {
            self.refuse_other_thread(wanted, &walls, stand)?;
        }
        Ok(Unled {
            outline: index,
            walls,
            own,
            entry,
            side,
            passes,
        })
    }

    /// The part's contour, which the control offsets, from its entry on; and the side of travel on which the wire runs.
    ///
    /// The wire's path has been made all the same: where it cannot be, the control would cut into the part or stop.
    pub(super) fn controlled(
        &self,
        index: usize,
        wanted: &Requested,
    ) -> Result<(Rotated, Option<Side>), Refusal> {
        let outline = &self.outlines[index];
        let (contour, turned) = self.towards(index, wanted)?;
        let side = outline
            .wire_side()
            .map(|side| if turned { side.reversed() } else { side });
        let walls = self.walls(&contour);
        if !contour.closed {
            return Ok((Rotated::whole(elements(&walls)), side));
        }
        let Some(entry) = self
            .entry(index, &walls, wanted)?
            .or_else(|| default_entry(&walls))
        else {
            return Err(Refusal::Sentence(say!(
                contour_has_no_length,
                self.name(index)
            )));
        };
        let path = Rotated::at(elements(&walls), entry.wall, entry.point);
        Ok((path, side))
    }
}
