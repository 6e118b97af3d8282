//! `small-radius` in a program that holds the part's contour: the controller makes the arc smaller by its correction.
//!
//! A 4B block says on which side of the arc the wire runs (`DD` inside). A 3B program holds the part's contour only where the
//! settings say so (`compensation = "controller"` or `"none"`); the wire's own path rightly has arcs down to nothing.

use super::{Counts, Seen, Sight, Spot};
use crate::finding::{Detail, Rule, Side, SmallRadius};
use crate::geometry::{Point, Segment};
use crate::program::three_b::block::Motion;
use crate::program::three_b::decode::decode;
use crate::settings::SideSetting;
use std::f64::consts::PI;

/// Radii within half a µm of the correction are as large as it: a program counts in µm.
const ROUNDING: f64 = 0.5;

pub(super) fn look(seen: &Seen) -> Option<Sight> {
    let turns_left = match seen.block.motion {
        Motion::Line(_) => return None,
        Motion::Clockwise(_) => false,
        Motion::CounterClockwise(_) => true,
    };
    let counts = match seen.part {
        Some(part) if part.concave => Counts::Always,
        Some(_) => return None,
        None if !seen.limits.holds_part => return None,
        None if matches!(seen.limits.side, SideSetting::Opening | SideSetting::Punch) => {
            Counts::IfInside { turns_left }
        }
        None => Counts::Always,
    };
    let stated = seen.part.map_or(0.0, |part| part.radius as f64);
    let radius = if stated > 0.0 { stated } else { seen.radius() };
    let required = seen.limits.correction * 1000.0;
    // A 4B controller refuses an arc as large as its correction, too.
    let is_tight = if seen.part.is_some() {
        radius <= required + ROUNDING
    } else {
        radius < required - ROUNDING
    };
    let Ok(Segment::Arc(arc)) = decode(seen.block, Point::origin()) else {
        return None;
    };
    if !is_tight {
        return None;
    }
    let mm = |point: Point| point / 1000.0;
    let turn = arc.sweep.abs().min(PI);
    let short = (required - radius).max(0.0) / 1000.0;
    let side = if turns_left { Side::Left } else { Side::Right };
    let detail = SmallRadius {
        radius: radius / 1000.0,
        required: required / 1000.0,
        center: mm(arc.center),
        start: mm(arc.start),
        end: mm(arc.end),
        sweep: arc.sweep,
        side,
        overcut: short * (1.0 - turn.cos()),
        stock_left: if turn < PI {
            short * (1.0 / (turn / 2.0).cos() - 1.0)
        } else {
            f64::INFINITY
        },
        pass: seen.limits.pass,
        no_fix: None,
    };
    Some(Sight {
        rule: Rule::SmallRadius,
        spot: Spot::Block,
        detail: Detail::SmallRadius(Box::new(detail)),
        counts,
    })
}
