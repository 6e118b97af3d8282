//! A program as its cuts, each from one stop or rapid to the next: joined, to be drawn or written in another language.

mod drawn;
mod dropped;
mod fitted;
mod registers;
mod rings;
mod switches;

pub(crate) use dropped::Dropped;

use self::fitted::{ROUND, between, unevenness};
use self::switches::Parted;

use super::document::Document;
use super::format::Format;
use super::iso::{self, Register};
use super::path::{Follower, Kind, MOST_BY_BULGE, tolerance};
use crate::drawing::EntityId;
use crate::finding::Side;
use crate::geometry::{Arc, Point, Segment, left_normal};
use crate::settings::Effective;
use crate::toolpath::{PathSegment, Source, WirePath};
use std::f64::consts::PI;
use std::ops::Range;

/// Ends are joined within this many times the tolerance of closing.
const JOINED: f64 = 2.0;

/// The path of one cut, µm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutPath {
    /// Each begins where the one before ended.
    pub(crate) segments: Vec<Segment>,
    /// The number of segments at the beginning that lead to the contour.
    pub lead_in: usize,
    /// Segments at the end that lead away from it.
    pub lead_out: usize,
    /// The contour comes back to where it began.
    pub closed: bool,
    /// Segments before each stop within it.
    stops: Vec<usize>,
    /// The side of travel on which the control lets the wire run.
    pub(crate) side: Option<Side>,
    /// The line in which that changes within the contour, from 0.
    pub(crate) switched: Option<usize>,
    /// Where the control finds the correction by which it does.
    offset: Option<Register>,
    /// The line in which another place is named before the correction is switched off, from 0, and that place.
    renamed: Option<(usize, Register)>,
    /// It begins where the one before it ends, and nothing stops the machine there.
    goes_on: bool,
    /// The side of travel on which the wire runs beside a contour of 4B, where an arc of it says that.
    part_side: Option<Side>,
}

impl CutPath {
    /// The segments of the contour, without the ways in and out.
    pub fn contour(&self) -> &[Segment] {
        self.segments.get(self.span()).unwrap_or_default()
    }

    /// The place of these among all.
    fn span(&self) -> Range<usize> {
        self.lead_in..self.segments.len().saturating_sub(self.lead_out)
    }

    fn insert(&mut self, at: usize, segment: Segment) {
        self.segments.insert(at, segment);
        let behind = self.stops.iter_mut().filter(|stop| **stop >= at);
        behind.for_each(|stop| *stop += 1);
    }
}

/// The content of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cuts {
    pub cuts: Vec<CutPath>,
    /// Moves without the wire, from and to, µm.
    pub ways: Vec<[Point; 2]>,
    /// Lines of blocks without movement, from 0.
    pub lost: Vec<usize>,
    /// The line of the first 4B block, from 0: the contours are those of the part, and the controller adds its
    /// correction.
    pub(crate) four_b: Option<usize>,
    /// The corrections that the program itself states, by their names, mm.
    pub(crate) corrections: Vec<(String, f64)>,
    /// The word by which the upper guide takes another path.
    pub(crate) taper: Option<String>,
    /// It does so within the cuts: the wire leans, perhaps by an unknown amount.
    pub(crate) leans: bool,
    /// Lines of the stops within contours, before their tabs, from 0: no cut holds them.
    pub(crate) stops: Vec<usize>,
    /// The arc whose ends differ most in their distance from its centre: its line, from 0, and that difference, µm.
    uneven: Option<(usize, f64)>,
    /// The largest distance of a contour's ends before they were joined, µm.
    pub(crate) closure: f64,
    /// The correction by which contours of 4B have been placed beside the ends of their ways in, mm.
    pub(crate) placed_by: Option<f64>,
}

/// The cuts of a program, in the order of the machine, one for each of its contours.
///
/// Where a 3B program has coordinates after its blocks, the nodes are those; else they are where the machine stops.
///
/// Of passes without a stop between them each closed one is a cut.
pub fn cuts(document: &Document) -> Cuts {
    cuts_to_write(document, false)
}

/// The same for a program that is to be written; of one that keeps the `switches` of the correction, open passes are
/// cuts of their own, too.
pub(crate) fn cuts_to_write(document: &Document, switches: bool) -> Cuts {
    let trace = document.trace();
    let Parted {
        cuts: spans,
        going_on,
    } = switches::parted(&trace, switches);
    let leans = !trace.upper.iter().all(Vec::is_empty) || trace.upper_unknown.is_some();
    let trace = trace.into_meant();
    let mut cuts = Cuts {
        leans,
        ..Cuts::default()
    };
    match document {
        Document::ThreeB(program) => cuts.four_b = program.first_four_b_line(),
        Document::Iso(program) => {
            cuts.corrections = program.stated_corrections();
            cuts.taper = iso::refuse_taper(program, iso::TaperWords::All).err();
        }
    }
    let mut open = CutPath::default();
    let mut spans = spans.iter().peekable();
    let mut follower = Follower::from(trace.start);
    let mut arcs = 0_usize;
    for (index, step) in trace.steps.iter().enumerate() {
        while spans.next_if(|span| span.steps.end <= index).is_some() {
            cuts.close(std::mem::take(&mut open));
        }
        open.goes_on |= going_on.binary_search(&index).is_ok();
        let node = follower.begin(step);
        if !step.moves() {
            let is_within = spans.peek().is_some_and(|span| span.steps.contains(&index));
            cuts.stops.extend(is_within.then_some(step.line));
            open.stops.extend(is_within.then_some(open.segments.len()));
            continue;
        }
        let Some(ideal) = step.ideal else {
            cuts.lost.push(step.line);
            follower.at += step.end - step.start;
            continue;
        };
        let mut end = node + (step.end - step.start);
        arcs += usize::from(step.kind == Kind::Arc);
        if let Some(stated) = step.stated
            && (stated - end).norm() <= tolerance(arcs)
        {
            // The machine may stand beside the stated place, by as much as an arc is rounded: the next block begins there.
            (end, arcs) = (stated, 1);
        }
        if step.kind == Kind::Rapid {
            cuts.ways.push([node, end]);
        } else if end != node || is_full(&ideal) {
            open.name(step);
            let pieces = between(&ideal, step, node, end);
            let uneven = unevenness(&ideal, step, node, end);
            if cuts.uneven.is_none_or(|(_, most)| uneven > most) {
                cuts.uneven = Some((step.line, uneven));
            }
            if let Some(span) = spans.peek() {
                let contour = span.contour_steps();
                if contour.contains(&index) {
                    open.part_side = open.part_side.or(step.part_side);
                    let is_first = open.segments.len() == open.lead_in;
                    if !is_first && step.side != open.side {
                        open.switched.get_or_insert(step.line);
                    }
                    open.side = if is_first {
                        step.side
                    } else {
                        open.side.or(step.side)
                    };
                }
                open.closed = span.closed;
                if index < contour.start {
                    open.lead_in += pieces.len();
                }
                if index >= contour.end {
                    open.lead_out += pieces.len();
                }
            }
            open.segments.extend(pieces);
        }
        follower.at = end;
    }
    cuts.close(open);
    cuts
}

fn is_full(segment: &Segment) -> bool {
    segment.as_arc().is_some_and(Arc::is_full_turn)
}

impl Cuts {
    /// Why the cuts cannot become a program of a language without losing the correction: in lower
    /// case without a full stop.
    pub(crate) fn refusal(&self, format: Format, settings: &Effective) -> Option<String> {
        if let Some(line) = self.four_b {
            return Some(say!(a_4b_program_holds_the_contour_of_the_part, line + 1));
        }
        if let Some(line) = self.cuts.iter().find_map(|cut| cut.switched) {
            return Some(say!(
                the_correction_is_switched_within_the_contour,
                line + 1
            ));
        }
        if format == Format::ThreeB && self.cuts.iter().any(|cut| cut.side.is_some()) {
            return Some(say!(the_control_adds_the_correction_of_the_program).into());
        }
        let is_of_wire = |cut: &CutPath| cut.side.is_none() && !cut.contour().is_empty();
        if format == Format::FourB && self.cuts.iter().any(is_of_wire) {
            return Some(say!(the_program_holds_the_path_of_the_wire).into());
        }
        let differs = |correction: &f64| (correction.abs() - settings.correction).abs() > 5e-4;
        let own = self
            .corrections
            .iter()
            .find(|(_, correction)| differs(correction))
            .filter(|_| format == Format::FourB);
        let (name, correction) = own.filter(|_| self.cuts.iter().any(|cut| cut.side.is_some()))?;
        Some(say!(
            the_correction_of_the_program_is_not_that_of_the_settings,
            name,
            correction,
            settings.correction
        ))
    }

    /// Why a program that does not hold its proof cannot be written, where an arc of the source was fitted.
    pub(crate) fn reason_of_mismatch(&self) -> Option<String> {
        let (line, uneven) = self.uneven.filter(|(_, uneven)| *uneven > ROUND)?;
        let reason = say!(the_ends_of_its_arc_lie_on_two_circles, uneven);
        Some(say!(line_by_number, line + 1, reason))
    }

    /// What the new program loses, in sentences; a drawing has no stops at all.
    pub(crate) fn losses(&self, format: Option<Format>) -> Vec<String> {
        let mut losses = Vec::new();
        if self.cuts.iter().any(|cut| cut.side.is_some()) && !self.corrections.is_empty() {
            let own: Vec<String> = self
                .corrections
                .iter()
                .take(5)
                .map(|(name, mm)| format!("{name} = {mm:.3} mm"))
                .collect();
            losses.push(say!(
                not_written_the_corrections_of_the_program,
                own.join(", ")
            ));
        }
        if let Some(taper) = &self.taper {
            losses.push(say!(not_written_the_taper, taper));
        }
        let lost = match format {
            None => Some(0),
            Some(format) => self.lost_stop(format),
        };
        if let Some(line) = lost.and_then(|at| self.stops.get(at)) {
            losses.push(say!(not_written_the_stop_before_a_tab, line + 1));
        }
        losses
    }

    /// The first stop within a contour that a language does not have, among all.
    fn lost_stop(&self, format: Format) -> Option<usize> {
        let is_lost = |cut: &&CutPath| cut.stops_in(format).len() < cut.stops.len();
        let at = self.cuts.iter().position(|cut| is_lost(&cut))?;
        Some(self.cuts.iter().take(at).map(|cut| cut.stops.len()).sum())
    }

    /// Places each contour of a 4B program where the part has it: its way in ends beside it, on the wire's path, at the
    /// correction, mm, which the program does not state.
    pub(crate) fn place_parts(&mut self, correction: f64) {
        if self.four_b.is_none() {
            return;
        }
        for cut in &mut self.cuts {
            let contour = cut.span();
            let Some(segments) = cut.segments.get_mut(contour) else {
                continue;
            };
            if let (true, Some(side), Some(first)) = (cut.closed, cut.part_side, segments.first()) {
                let aside = left_normal(first.start_tangent()) * (side.sign() * correction * 1e3);
                segments.iter_mut().for_each(|it| *it = it.moved(-aside));
                self.placed_by = Some(correction);
            }
        }
    }

    /// Ends a cut: joins the ends of its contour, and those of its ways in and out, where they coincide.
    fn close(&mut self, mut cut: CutPath) {
        let count = cut.segments.len();
        let last = count.saturating_sub(cut.lead_out + 1);
        let (Some(begin), Some(end)) = (
            cut.segments.get(cut.lead_in).copied(),
            cut.segments.get(last).copied(),
        ) else {
            return;
        };
        let arcs = cut
            .segments
            .iter()
            .filter(|segment| segment.as_arc().is_some())
            .count();
        let within = JOINED * tolerance(arcs);
        let near = |a: Point, b: Point| (a - b).norm() <= within;
        if cut.closed {
            let mut target = begin.start();
            if !near(target, end.end()) {
                // It goes on past its closing point: a part that is cut twice does not belong to the contour.
                if end.distance_to(target) <= within {
                    let share = end.share_of(target);
                    cut.segments[last] = end.part(0.0, share);
                    cut.insert(last + 1, end.part(share, 1.0));
                    cut.lead_out += 1;
                } else {
                    let share = begin.share_of(end.end());
                    target = begin.point_at(share);
                    cut.segments[cut.lead_in] = begin.part(share, 1.0);
                    cut.insert(cut.lead_in, begin.part(0.0, share));
                    cut.lead_in += 1;
                }
            }
            let last = cut.segments.len().saturating_sub(cut.lead_out + 1);
            let by = target - cut.segments[last].end();
            self.join(&mut cut.segments, last, target);
            cut.segments[last + 1..]
                .iter_mut()
                .for_each(|segment| *segment = segment.moved(by));
            let first = cut.segments[0].start();
            if let Some(out) = cut.segments.len().checked_sub(1).filter(|out| *out > last)
                && near(cut.segments[out].end(), first)
            {
                self.join(&mut cut.segments, out, first);
            }
        }
        self.cuts.push(cut);
    }

    /// Lets a segment end in `end`.
    fn join(&mut self, segments: &mut [Segment], index: usize, end: Point) {
        self.closure = self.closure.max((segments[index].end() - end).norm());
        segments[index] = match segments[index] {
            Segment::Line(line) => Segment::line(line.start, end),
            Segment::Arc(arc) if arc.is_full_turn() => Segment::Arc(arc),
            // By its bulge, an arc runs through both its ends: about its old centre it would lie beside the new end, by
            // the gap of the contour.
            Segment::Arc(arc) if arc.sweep.abs() <= MOST_BY_BULGE => {
                Segment::from_bulge(arc.start, end, arc.bulge())
            }
            Segment::Arc(arc) => {
                let made = Arc::about(arc.center, arc.start, end, arc.sweep > 0.0);
                let sweep = if (made.sweep - arc.sweep).abs() > PI {
                    arc.sweep
                } else {
                    made.sweep
                };
                Segment::Arc(Arc { sweep, ..made })
            }
        };
    }

    /// The cuts as paths of the wire in µm, to be written in another language: a stop within one holds the part while
    /// what is left of it is cut off.
    pub fn paths(&self) -> Vec<WirePath> {
        self.paths_of(Format::Iso)
    }

    /// The same for one language.
    fn paths_of(&self, format: Format) -> Vec<WirePath> {
        let cuts = self.cuts.iter();
        cuts.flat_map(|cut| cut.paths(format)).collect()
    }
}

impl CutPath {
    /// The stops within it that a language has.
    fn stops_in(&self, format: Format) -> &[usize] {
        match format {
            Format::FourB if self.stops.len() > 1 => &[],
            _ => &self.stops,
        }
    }

    /// The segments from each of some stops to the next.
    fn runs(&self, stops: &[usize]) -> impl Iterator<Item = Range<usize>> {
        let ends = stops.iter().copied().chain([self.segments.len()]);
        let runs = ends.scan(0, |from, end| Some(std::mem::replace(from, end)..end));
        runs.filter(|run| !run.is_empty())
    }

    fn paths(&self, format: Format) -> impl Iterator<Item = WirePath> {
        let source = |index: usize| match index {
            _ if index < self.lead_in => Source::LeadIn,
            _ if index + self.lead_out >= self.segments.len() => Source::LeadOut,
            _ => Source::Segment {
                entity: EntityId(0),
                segment: index,
            },
        };
        let stops = self.stops_in(format);
        let is_one = self.runs(stops).count() == 1;
        self.runs(stops).enumerate().filter_map(move |(nth, run)| {
            let piece = |index: usize| {
                Some(PathSegment {
                    geometry: *self.segments.get(index)?,
                    source: source(index),
                })
            };
            Some(WirePath {
                side: self.side,
                cut_off: nth > 0,
                // What comes back to its start behind a stop is not open.
                counter_clockwise: (!is_one && self.closed).then_some(true),
                ..WirePath::along(
                    self.segments.first()?.start(),
                    run.filter_map(piece).collect(),
                )
            })
        })
    }
}
