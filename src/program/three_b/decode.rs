//! From a block to the line or arc that the controller runs.

use super::block::{Block, CountingAxis, Motion, Quadrant};
use crate::geometry::{Arc, Point, Segment, Vector, direction, positive_angle};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Why a block leads nowhere; each has its own diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecodeFault {
    /// J is 0, or the block has no number at all.
    NoLength,
    /// An arc whose start lies in its centre.
    NoRadius,
    /// J is larger than one turn, 4R.
    OverTurn,
    /// J fits neither X and Y nor a reduced ratio of them.
    WrongLength,
    /// The line does not move on the counted axis.
    WrongAxis,
}

/// The largest deviation of J from the exact projection, µm: published programs stay within it.
pub(super) const J_TOLERANCE: f64 = 2.0;

/// The line or arc of `block` from `start`, in µm.
///
/// A line's X and Y may be reduced by a common factor where the larger is below J; J then carries the scale. The end of an arc
/// is where the sum of its projections on the counting axis reaches J, which `travelled` gives in closed form; J within
/// 2 µm of 4R is a full circle.
pub fn decode(block: &Block, start: Point) -> Result<Segment, DecodeFault> {
    match block.motion {
        Motion::Line(quadrant) => line(block, quadrant, start),
        Motion::Clockwise(quadrant) => arc(block, quadrant, start, false),
        Motion::CounterClockwise(quadrant) => arc(block, quadrant, start, true),
    }
}

/// The line or arc that a block means, even where its J contradicts its X and Y: the controller goes by J.
///
/// `None` where it leads nowhere: no J, no radius, more than one turn, or a line that does not move on the counted
/// axis.
pub(super) fn meant(block: &Block, start: Point) -> Option<Segment> {
    match decode(block, start) {
        Ok(segment) => Some(segment),
        Err(DecodeFault::WrongLength) => {
            let larger = block.x.max(block.y);
            let scaled = |value: i64| value as f64 * block.j as f64;
            let counted = block.axis.of([block.x, block.y]);
            let Motion::Line(quadrant) = block.motion else {
                return None;
            };
            let (sign_x, sign_y) = quadrant.signs();
            let (counted, x, y) = (counted as f64, scaled(block.x), scaled(block.y));
            (larger > 0 && counted > 0.0).then(|| {
                Segment::line(
                    start,
                    start + Vector::new(sign_x * x / counted, sign_y * y / counted),
                )
            })
        }
        Err(_) => None,
    }
}

fn line(block: &Block, quadrant: Quadrant, start: Point) -> Result<Segment, DecodeFault> {
    let (x, y, j) = (block.x as f64, block.y as f64, block.j as f64);
    let (sign_x, sign_y) = quadrant.signs();
    if block.j == 0 {
        return Err(DecodeFault::NoLength);
    }
    let counted = block.axis.of([x, y]);
    let (along_x, along_y) = if x == 0.0 && y == 0.0 {
        block.extent().map(|um| um as f64).into()
    } else if counted == 0.0 {
        return Err(DecodeFault::WrongAxis);
    } else if x.max(y) < j || (j - counted).abs() <= J_TOLERANCE {
        (x * (j / counted), y * (j / counted))
    } else {
        return Err(DecodeFault::WrongLength);
    };
    Ok(Segment::line(
        start,
        start + Vector::new(along_x * sign_x, along_y * sign_y),
    ))
}

fn arc(
    block: &Block,
    quadrant: Quadrant,
    start: Point,
    counter_clockwise: bool,
) -> Result<Segment, DecodeFault> {
    let (sign_x, sign_y) = quadrant.signs();
    let from_center = Vector::new(block.x as f64 * sign_x, block.y as f64 * sign_y);
    let radius = from_center.norm();
    if radius == 0.0 {
        return Err(DecodeFault::NoRadius);
    }
    let j = block.j as f64;
    if j == 0.0 {
        return Err(DecodeFault::NoLength);
    }
    let center = start - from_center;
    let start_angle = from_center.y.atan2(from_center.x);
    let turn = if counter_clockwise { 1.0 } else { -1.0 };
    if (j - 4.0 * radius).abs() <= J_TOLERANCE {
        return Ok(Segment::Arc(Arc {
            center,
            radius,
            start_angle,
            sweep: TAU * turn,
            start,
            end: start,
        }));
    }
    if j > 4.0 * radius {
        return Err(DecodeFault::OverTurn);
    }
    let phase = phase(block.axis, start_angle, counter_clockwise);
    let sweep = turn * (phase_after(travelled(phase) + j / radius) - phase);
    let end = center + direction(start_angle + sweep) * radius;
    Ok(Segment::Arc(Arc {
        center,
        radius,
        start_angle,
        sweep,
        start,
        end,
    }))
}

/// The start angle as a phase in 0 … 2π that grows with the travel and whose cosine is the counted coordinate over R.
pub(super) fn phase(axis: CountingAxis, start_angle: f64, counter_clockwise: bool) -> f64 {
    let from_axis = match axis {
        CountingAxis::X => start_angle,
        CountingAxis::Y => start_angle - FRAC_PI_2,
    };
    positive_angle(if counter_clockwise {
        from_axis
    } else {
        -from_axis
    })
}

/// What a unit circle's coordinate travels while the phase grows from 0: 2 for each half turn, `1 − cos` within one.
fn travelled(phase: f64) -> f64 {
    let half_turns = (phase / PI).floor();
    2.0 * half_turns + 1.0 - (phase - half_turns * PI).cos()
}

/// The inverse of [`travelled`].
fn phase_after(travelled: f64) -> f64 {
    let half_turns = (travelled / 2.0).floor();
    half_turns * PI
        + (1.0 - (travelled - 2.0 * half_turns))
            .clamp(-1.0, 1.0)
            .acos()
}
