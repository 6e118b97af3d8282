//! A program as its cuts: what the machine runs from one stop or rapid to the next, joined, to be drawn or written in another language.

use super::document::Document;
use super::three_b::{Item, Words, read_line};
use super::trace::{Kind, Step};
use crate::drawing::{Drawing, Entity, EntityId, Geometry, Unit, Vertex};
use crate::finding::Side;
use crate::geometry::{Arc, Point, Segment};
use crate::toolpath::{PathSegment, Source, WirePath};
use rustc_hash::FxHashMap;
use std::f64::consts::{PI, TAU};

/// Ends this near each other, and 1 µm more for each arc between, are one place, µm: what a controller that counts may drift.
const JOINED: f64 = 2.0;

/// How far a coordinate that stands behind a block may lie from where the block leads and still be its end, µm; 1 µm more for each arc.
const STATED: f64 = 2.0;

/// Layers of a drawing that is made of a program.
const CUT: &str = "CUT";
const LEAD: &str = "LEAD";
const WAY: &str = "WAY";

/// Consecutive cuts, µm.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// Each begins where the one before ended.
    pub segments: Vec<Segment>,
    /// The first segment leads to a contour that the others go round.
    pub lead_in: bool,
    /// The last segment leads away from it.
    pub lead_out: bool,
    /// The contour comes back to where it began.
    pub closed: bool,
    /// The side of travel on which the control lets the wire run.
    pub side: Option<Side>,
}

impl Cut {
    /// The segments of the contour, without the ways in and out.
    pub fn contour(&self) -> &[Segment] {
        let end = self.segments.len() - usize::from(self.lead_out);
        self.segments.get(usize::from(self.lead_in)..end).unwrap_or_default()
    }
}

/// What a program comes to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cuts {
    pub cuts: Vec<Cut>,
    /// Moves without the wire, from and to, µm.
    pub ways: Vec<[Point; 2]>,
    /// Lines of blocks that lead nowhere, from 0.
    pub lost: Vec<usize>,
    /// By how much contours did not close before their ends were made one, the most of it, µm.
    pub closure: f64,
}

/// The cuts of a program, in the order of the machine.
///
/// Where coordinates stand behind the blocks of a 3B program the nodes are those; else they are where the machine stops.
pub fn cuts(document: &Document) -> Cuts {
    let trace = document.trace().as_meant();
    let sides = document.sides();
    let stated = stated_ends(document);
    let mut cuts = Cuts::default();
    let mut open: Vec<Segment> = Vec::new();
    let mut side = None;
    let mut node = trace.start;
    let mut arcs = 0_u32;
    for (index, step) in trace.steps.iter().enumerate() {
        if !step.moves() {
            cuts.close(std::mem::take(&mut open), side);
            continue;
        }
        let Some(ideal) = step.ideal else {
            cuts.lost.push(step.line);
            node += step.end - step.start;
            continue;
        };
        let mut end = node + (step.end - step.start);
        arcs += u32::from(step.kind == Kind::Arc);
        if let Some(&stated) = stated.get(&step.range.start)
            && (stated - end).norm() <= STATED + f64::from(arcs)
        {
            (end, arcs) = (stated, 0);
        }
        if step.kind == Kind::Rapid {
            cuts.close(std::mem::take(&mut open), side);
            cuts.ways.push([node, end]);
        } else if end != node || is_full(&ideal) {
            if open.is_empty() {
                side = sides.get(index).copied().flatten();
            }
            open.push(between(&ideal, step, node, end));
        }
        node = end;
    }
    cuts.close(open, side);
    cuts
}

fn is_full(segment: &Segment) -> bool {
    segment.as_arc().is_some_and(Arc::is_full_turn)
}

/// The segment of a step moved to the nodes that it runs between.
fn between(ideal: &Segment, step: &Step, from: Point, to: Point) -> Segment {
    match ideal {
        Segment::Line(_) => Segment::line(from, to),
        Segment::Arc(arc) => {
            let center = arc.center + (from - step.start);
            if arc.is_full_turn() {
                return Segment::Arc(Arc { center, start: from, end: from, ..*arc });
            }
            let made = Arc::about(center, from, to, arc.sweep > 0.0);
            // Where both ends are nearly one place, rounding must not make a turn of nothing, or nothing of a turn.
            if (made.sweep - arc.sweep).abs() > PI {
                Segment::Arc(Arc { center, start: from, end: to, ..*arc })
            } else {
                Segment::Arc(made)
            }
        }
    }
}

impl Cuts {
    /// Ends a cut: joins its ends where they are one place, and tells the contour from the ways in and out.
    fn close(&mut self, mut segments: Vec<Segment>, side: Option<Side>) {
        let count = segments.len();
        let (Some(first), Some(last)) = (segments.first().copied(), segments.last().copied()) else { return };
        let arcs = segments.iter().filter(|segment| segment.as_arc().is_some()).count();
        let near = |a: Point, b: Point| (a - b).norm() <= JOINED + arcs as f64;
        let is_line = |segment: &Segment| matches!(segment, Segment::Line(_));
        // The way in ends where the way out begins.
        let last_node = |segments: &[Segment]| segments[count - 1].start();
        let led = count >= 3 && is_line(&first) && is_line(&last) && near(first.end(), last_node(&segments));
        let led_in = count >= 2 && is_line(&first) && !near(first.start(), last.end()) && near(first.end(), last.end());
        let closed = led || led_in || near(first.start(), last.end());
        if led {
            self.join(&mut segments, count - 2, first.end());
            let out_to = if near(last.end(), first.start()) { first.start() } else { last.end() };
            segments[count - 1] = Segment::line(first.end(), out_to);
        } else if led_in {
            self.join(&mut segments, count - 1, first.end());
        } else if closed {
            self.join(&mut segments, count - 1, first.start());
        }
        self.cuts.push(Cut { segments, lead_in: led || led_in, lead_out: led, closed, side });
    }

    /// Lets a segment end in `end`.
    fn join(&mut self, segments: &mut [Segment], index: usize, end: Point) {
        self.closure = self.closure.max((segments[index].end() - end).norm());
        segments[index] = match segments[index] {
            Segment::Line(line) => Segment::line(line.start, end),
            Segment::Arc(arc) if arc.is_full_turn() => Segment::Arc(arc),
            Segment::Arc(arc) => {
                let made = Arc::about(arc.center, arc.start, end, arc.sweep > 0.0);
                let sweep = if (made.sweep - arc.sweep).abs() > PI { arc.sweep } else { made.sweep };
                Segment::Arc(Arc { sweep, ..made })
            }
        };
    }

    /// The program as a drawing in mm: contours as polylines with bulges, the ways in and out and those without the wire as lines.
    pub fn drawing(&self) -> Drawing {
        let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
        for cut in &self.cuts {
            let lead = |index: usize| cut.segments.get(index).map(|segment| [segment.start(), segment.end()]);
            if cut.lead_in
                && let Some(ends) = lead(0)
            {
                push_line(&mut drawing, LEAD, ends);
            }
            if let Some(geometry) = polyline(cut.contour(), cut.closed) {
                drawing.push(Entity {
                    handle: CUT.into(),
                    layer: CUT.into(),
                    role: None,
                    kind: crate::drawing::Kind::LightPolyline,
                    geometry,
                });
            }
            if cut.lead_out
                && let Some(ends) = lead(cut.segments.len() - 1)
            {
                push_line(&mut drawing, LEAD, ends);
            }
        }
        for &ends in &self.ways {
            push_line(&mut drawing, WAY, ends);
        }
        drawing
    }

    /// The cuts as paths of the wire in µm, to be written in another language.
    pub fn paths(&self) -> Vec<WirePath> {
        let source = |cut: &Cut, index: usize| match index {
            0 if cut.lead_in => Source::LeadIn,
            _ if cut.lead_out && index + 1 == cut.segments.len() => Source::LeadOut,
            _ => Source::Segment { entity: EntityId(0), segment: index },
        };
        let paths = self.cuts.iter().filter_map(|cut| {
            let thread_hole = cut.segments.first()?.start();
            let segments =
                cut.segments.iter().enumerate().map(|(index, &geometry)| PathSegment { geometry, source: source(cut, index) }).collect();
            Some(WirePath { outline: 0, correction: 0.0, thread_hole, side: cut.side, segments })
        });
        paths.collect()
    }
}

fn push_line(drawing: &mut Drawing, layer: &str, [start, end]: [Point; 2]) {
    let geometry = Geometry::Line { start: start / 1e3, end: end / 1e3 };
    drawing.push(Entity { handle: layer.into(), layer: layer.into(), role: None, kind: crate::drawing::Kind::Line, geometry });
}

/// The segments as a polyline in mm; arcs near a full turn, which no bulge holds well, in two halves.
fn polyline(segments: &[Segment], closed: bool) -> Option<Geometry> {
    let last = segments.last()?;
    let mut vertices = Vec::with_capacity(segments.len() + 1);
    let mut push = |at: Point, bulge: f64| vertices.push(Vertex { point: at / 1e3, bulge });
    for segment in segments {
        match segment {
            Segment::Arc(arc) if arc.sweep.abs() > TAU * 0.75 => {
                let bulge = (arc.sweep / 8.0).tan();
                push(arc.start, bulge);
                push(arc.point_at(0.5), bulge);
            }
            segment => push(segment.start(), segment.bulge()),
        }
    }
    if !closed {
        push(last.end(), 0.0);
    }
    (vertices.len() >= 2).then_some(Geometry::Polyline { closed, vertices })
}

/// The coordinates that stand behind the blocks of a 3B program, µm, by the byte at which the block begins.
fn stated_ends(document: &Document) -> FxHashMap<usize, Point> {
    let mut ends = FxHashMap::default();
    let Document::ThreeB(program) = document else { return ends };
    let text = program.text();
    for line in 0..text.line_count() {
        let range = text.line_range(line);
        let start = range.start;
        read_line(&text.bytes()[range], start, &Words::default(), |item| {
            if let Item::Block { range, stated_end: Some(stated), .. } = item
                && stated.decimals >= 3
            {
                let [x, y] = stated.at.map(|mm| (mm * 1e6).round() / 1e3);
                ends.insert(range.start, Point::new(x, y));
            }
        });
    }
    ends
}
