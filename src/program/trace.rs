//! Where the machine goes, block by block: what programs of every language come to.
//!
//! Points are µm in the program's own frame, as `f64`: a machine that counts stands on whole µm, an ISO program may name parts of
//! them. Nothing here knows how a language is written.

use crate::geometry::{Bounds, Point, Segment, Vector};
use std::ops::Range;

/// What one step does.
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

/// One block or word of a program and what it makes the machine do.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Bytes of the block in the program's text, without number and comment.
    pub range: Range<usize>,
    /// Line of the text, from 0.
    pub line: usize,
    /// Number that the block carries (`N12`).
    pub number: Option<u32>,
    pub kind: Kind,
    /// Where the machine stands before and after the step, µm.
    pub start: Point,
    pub end: Point,
    /// The line or arc that the block means, from `start`, µm. `None` where nothing moves, and for a block that means none
    /// (`arc-without-radius`, …): the machine stays there.
    pub ideal: Option<Segment>,
    /// Index of the contour: pauses are between two of them.
    pub contour: usize,
}

impl Step {
    /// From the ideal end to where the machine stops, µm.
    pub fn miss(&self) -> Vector {
        self.ideal.map_or_else(Vector::zeros, |ideal| self.end - ideal.end())
    }

    /// Distance of the machine's end from the ideal end, µm.
    pub fn deviation(&self) -> f64 {
        self.miss().norm()
    }

    pub fn moves(&self) -> bool {
        matches!(self.kind, Kind::Line | Kind::Arc | Kind::Rapid)
    }
}

/// A whole program as steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    pub steps: Vec<Step>,
    /// Where the program begins, µm: the origin where it does not say.
    pub start: Point,
    /// The program says where it begins.
    pub start_is_known: bool,
}

impl Trace {
    /// Where the machine stands at the end, µm.
    pub fn end(&self) -> Point {
        self.steps.last().map_or(self.start, |step| step.end)
    }

    /// The same program as its blocks mean it: every step begins where the one before means to end, not where a counting machine has
    /// drifted to.
    pub fn as_meant(mut self) -> Trace {
        let mut at = self.start;
        for step in &mut self.steps {
            let by = at - step.start;
            step.ideal = step.ideal.as_ref().map(|ideal| ideal.moved(by));
            step.end = step.ideal.as_ref().map_or(step.end + by, Segment::end);
            step.start = at;
            at = step.end;
        }
        self
    }

    /// From the program's start to its end, µm: zero for a program that closes.
    pub fn closure(&self) -> Vector {
        self.end() - self.start
    }

    /// Length of the way in µm, along the ideal lines and arcs.
    pub fn length(&self) -> f64 {
        self.steps.iter().filter_map(|step| step.ideal.as_ref()).map(Segment::length).sum()
    }

    /// Length in µm of what is cut: ways without the wire left out.
    pub fn cut_length(&self) -> f64 {
        let cut = self.steps.iter().filter(|step| step.kind != Kind::Rapid);
        cut.filter_map(|step| step.ideal.as_ref()).map(Segment::length).sum()
    }

    /// The box of the way, µm; `None` where nothing moves.
    pub fn bounds(&self) -> Option<Bounds> {
        let mut bounds = Bounds::EMPTY;
        for step in self.steps.iter().filter(|step| step.moves()) {
            bounds.include(step.start);
            bounds.include(step.end);
            if let Some(ideal) = &step.ideal {
                bounds.merge(&ideal.bounds());
            }
        }
        bounds.min.x.is_finite().then_some(bounds)
    }
}
