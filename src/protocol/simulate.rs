//! The reply of `wedm/simulate`: where the machine goes, block by block.

use super::generate::Closure;
use crate::geometry::Xy as Point;
use crate::geometry::{Point as CorePoint, Segment};
use crate::program::path::{Kind, Step, Trace};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Params of `wedm/simulate`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Simulate {
    pub(crate) uri: String,
    /// mm/min: with it the reply says how many minutes the way takes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) feed: Option<f64>,
}

/// What a step of the program does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum StepKind {
    Line,
    Arc,
    /// A way without a cut.
    Rapid,
    Pause,
    End,
}

/// A block or word and what it makes the machine do; points in µm, in the program's own frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct SimulatedBlock {
    /// Line of the text, from 0.
    pub(crate) line: usize,
    /// Number that the block carries.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) number: Option<u32>,
    pub(crate) kind: StepKind,
    pub(crate) start: Point,
    /// Where the machine stops.
    pub(crate) end: Point,
    /// Where the line or arc ends that the block means; not there where it means none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) ideal_end: Option<Point>,
    /// From the ideal end to the machine's, µm.
    pub(crate) deviation: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) center: Option<Point>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) radius: Option<f64>,
    /// Degrees, positive counter-clockwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) sweep: Option<f64>,
    /// Index of the contour; a pause is between two of them.
    pub(crate) contour: usize,
    /// Where the wire's upper end is after the block; not there where that is where the machine stops.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) upper_end: Option<Point>,
}

/// A box, µm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct SimulatedBounds {
    pub(crate) min: Point,
    pub(crate) max: Point,
}

/// Result of `wedm/simulate`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Simulation {
    pub(crate) blocks: Vec<SimulatedBlock>,
    /// From the program's start to where the machine ends, µm.
    pub(crate) closure: Closure,
    /// mm, along the lines and arcs; ways without a cut are counted in.
    pub(crate) length: f64,
    /// mm that are cut.
    #[serde(default)]
    pub(crate) cut: f64,
    /// mm of the ways without a cut.
    #[serde(default)]
    pub(crate) jumps: f64,
    /// The largest deviation of a block, µm.
    pub(crate) deviation: f64,
    /// The text says where the program begins; else that is the origin.
    pub(crate) start_is_known: bool,
    /// Not there where nothing moves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) bounds: Option<SimulatedBounds>,
    /// At the feed that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) minutes: Option<f64>,
}

impl Simulation {
    /// `feed` in mm/min, for the cuts alone; one that is not above 0 gives no time.
    pub(crate) fn of(trace: &Trace, feed: Option<f64>) -> Simulation {
        let closure = trace.closure();
        let (cut, jumps) = trace.lengths();
        let (cut, jumps) = (cut / 1000.0, jumps / 1000.0);
        let length = cut + jumps;
        let mut blocks: Vec<SimulatedBlock> = trace.steps.iter().map(SimulatedBlock::of).collect();
        let moving = blocks.iter_mut().zip(&trace.steps);
        let moving = moving.filter(|(_, step)| step.moves());
        for ((block, step), upper) in moving.zip(&trace.upper) {
            let end = upper.last().map(|last| tidy(last.end()));
            block.upper_end = end.filter(|end| *end != tidy(step.end)).map(Point::from);
        }
        Simulation {
            blocks,
            closure: Closure::of([closure.x, closure.y]),
            length,
            cut,
            jumps,
            deviation: trace.steps.iter().map(Step::deviation).fold(0.0, f64::max),
            start_is_known: trace.start_is_known,
            bounds: trace.bounds().map(|bounds| SimulatedBounds {
                min: bounds.min.into(),
                max: bounds.max.into(),
            }),
            minutes: feed
                .filter(|feed| *feed > 0.0 && feed.is_finite())
                .map(|feed| cut / feed),
        }
    }
}

impl SimulatedBlock {
    fn of(step: &Step) -> SimulatedBlock {
        let arc = step.ideal.as_ref().and_then(Segment::as_arc);
        SimulatedBlock {
            line: step.line,
            number: step.number,
            kind: match step.kind {
                Kind::Line => StepKind::Line,
                Kind::Arc => StepKind::Arc,
                Kind::Rapid => StepKind::Rapid,
                Kind::Pause => StepKind::Pause,
                Kind::End => StepKind::End,
            },
            start: step.start.into(),
            end: step.end.into(),
            ideal_end: step.ideal.as_ref().map(|ideal| tidy(ideal.end()).into()),
            deviation: rounded(step.deviation()),
            center: arc.map(|arc| tidy(arc.center).into()),
            radius: arc.map(|arc| rounded(arc.radius)),
            sweep: arc.map(|arc| arc.sweep.to_degrees()),
            contour: step.contour,
            upper_end: None,
        }
    }
}

/// Rounded to nanometres, finer than anybody measures.
fn rounded(um: f64) -> f64 {
    (um * 1000.0).round() / 1000.0
}

fn tidy(point: CorePoint) -> CorePoint {
    CorePoint::new(rounded(point.x), rounded(point.y))
}
