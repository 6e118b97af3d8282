//! The machine's way, block by block, for programs of every language.
//!
//! Points are µm in the program's own frame, as `f64`: a counting machine is always on whole µm, an ISO program may
//! have fractions. Nothing here knows how a language is written.

use super::way::{Node, Way, Writing};
use crate::finding::Side;
use crate::geometry::{Bounds, Point, Segment, Vector};
use std::ops::Range;

/// The kind of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Cuts along a straight line.
    Line,
    /// Cuts along an arc.
    Arc,
    /// Moves without cutting: a rapid, or the way between two contours while the wire is out.
    Rapid,
    /// Waits, as for the wire to be threaded.
    Pause,
    End,
}

/// A place in the control's table of corrections.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Register {
    pub(crate) letter: u8,
    pub(crate) index: u32,
}

/// One block or word of a program and the machine's action.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Bytes of the block in the program's text, without number and comment.
    pub range: Range<usize>,
    /// Line of the text, from 0.
    pub line: usize,
    /// Number that the block carries (`N12`).
    pub(crate) number: Option<u32>,
    pub kind: Kind,
    /// Where the machine stands before and after the step, µm.
    pub(crate) start: Point,
    pub end: Point,
    /// The line or arc that the block means, from `start`, µm. `None` where nothing moves, and for a block without one
    /// (`arc-without-radius`, …): the machine stays there.
    pub ideal: Option<Segment>,
    /// Index of the contour: pauses separate contours, except those before a tab.
    pub contour: usize,
    /// The side of travel on which the control lets the wire run, where the program gives it.
    pub side: Option<Side>,
    /// Where the control takes the correction from, where the program names it.
    pub(crate) register: Option<Register>,
    /// The side of travel on which the wire runs beside an arc of the part, in 4B.
    pub(crate) part_side: Option<Side>,
    /// The block counts from its start, so its words do not give its end.
    pub(crate) is_relative: bool,
    /// The end that the text states after the block, where that is as fine as the machine counts, µm.
    pub(crate) stated: Option<Point>,
    /// The radius by which an arc is given instead of its centre, µm.
    pub(crate) radius: Option<f64>,
}

impl Step {
    /// The machine stands still at a place; the text of it is still to be said.
    pub(in crate::program) fn stop(kind: Kind, at: Point) -> Step {
        Step {
            range: 0..0,
            line: 0,
            number: None,
            kind,
            start: at,
            end: at,
            ideal: None,
            contour: 0,
            side: None,
            register: None,
            part_side: None,
            is_relative: false,
            stated: None,
            radius: None,
        }
    }

    /// From the ideal end to where the machine stops, µm.
    pub(crate) fn miss(&self) -> Vector {
        self.ideal
            .map_or_else(Vector::zeros, |ideal| self.end - ideal.end())
    }

    /// Distance of the machine's end from the ideal end, µm.
    pub(crate) fn deviation(&self) -> f64 {
        self.miss().norm()
    }

    /// From its start to its end as the block means it, µm.
    pub fn meant(&self) -> Vector {
        self.ideal
            .as_ref()
            .map_or(self.end - self.start, |ideal| ideal.end() - ideal.start())
    }

    pub fn moves(&self) -> bool {
        matches!(self.kind, Kind::Line | Kind::Arc | Kind::Rapid)
    }
}

/// A whole program as steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    pub steps: Vec<Step>,
    /// Start of the program, µm: the origin by default.
    pub(crate) start: Point,
    /// The program says where it begins.
    pub(crate) start_is_known: bool,
    /// How its blocks give their ends.
    pub(crate) writing: Writing,
    /// For each step that moves the way of the wire's upper end, µm; nothing where it follows the lower one. Empty
    /// where the wire is upright in the whole program.
    pub upper: Vec<Vec<Segment>>,
    /// Why the way of the upper end is unknown.
    pub(crate) upper_unknown: Option<String>,
}

impl Trace {
    /// Where the machine stands at the end, µm.
    pub(crate) fn end(&self) -> Point {
        self.steps.last().map_or(self.start, |step| step.end)
    }

    /// The same program as its blocks mean it: every step begins at the intended end of the one before, without the
    /// drift of a counting machine. Where the program states a new place, it begins there.
    pub(crate) fn into_meant(mut self) -> Trace {
        let mut follower = Follower::from(self.start);
        for step in &mut self.steps {
            let at = follower.begin(step);
            let by = at - step.start;
            step.ideal = step.ideal.as_ref().map(|ideal| ideal.moved(by));
            step.end = step.ideal.as_ref().map_or(step.end + by, Segment::end);
            step.start = at;
            follower.at = step.end;
        }
        self
    }

    /// From the program's start to its end, µm: zero for a program that closes.
    pub(crate) fn closure(&self) -> Vector {
        self.end() - self.start
    }

    /// Lengths in µm along the ideal lines and arcs: of the cuts, with leads and all passes, and of the ways without a
    /// cut.
    pub(crate) fn lengths(&self) -> (f64, f64) {
        let mut lengths = (0.0, 0.0);
        for step in &self.steps {
            let length = step.ideal.as_ref().map_or(0.0, Segment::length);
            match step.kind {
                Kind::Rapid => lengths.1 += length,
                _ => lengths.0 += length,
            }
        }
        lengths
    }

    /// The box of the way, µm; `None` where nothing moves.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        let mut bounds = Bounds::EMPTY;
        for step in self.steps.iter().filter(|step| step.moves()) {
            bounds.include(step.start);
            bounds.include(step.end);
            if let Some(ideal) = &step.ideal {
                bounds.merge(&ideal.bounds());
            }
        }
        for piece in self.upper.iter().flatten() {
            bounds.merge(&piece.bounds());
        }
        bounds.min.x.is_finite().then_some(bounds)
    }
}

/// Where a way stands that follows the steps of a trace, and ends beside them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Follower {
    pub(crate) at: Point,
    /// Where the machine stands after the last step.
    stands: Point,
}

impl Follower {
    pub(crate) fn from(start: Point) -> Follower {
        Follower {
            at: start,
            stands: start,
        }
    }

    /// Where it begins the next step. The program may state a new place: the wire was taken there.
    pub(crate) fn begin(&mut self, step: &Step) -> Point {
        self.at += step.start - self.stands;
        self.stands = step.end;
        self.at
    }
}

impl Way {
    /// The way of steps that move.
    pub(crate) fn of_steps<'a>(steps: impl IntoIterator<Item = &'a Step>, writing: Writing) -> Way {
        let mut steps = steps.into_iter().peekable();
        let start = steps.peek().map_or(Point::origin(), |first| first.start);
        let mut way = Way::from(Node::at(start), writing);
        for step in steps {
            let from = way.end().ideal;
            let by = from - step.start;
            let piece = match &step.ideal {
                Some(ideal) => ideal.moved(by),
                None => Segment::line(from, from + step.meant()),
            };
            let end = Node {
                machine: step.end,
                ideal: from + step.meant(),
            };
            way.push(piece, step.kind == Kind::Arc, end);
        }
        way
    }
}
