//! `small-radius` in a program that holds the part's contour: the controller makes the arc smaller by its correction.
//!
//! A 4B block gives the wire's side of the arc (`DD` inside). A 3B program holds the part's contour only where the
//! settings say so (`compensation = "controller"` or `"none"`); the wire's own path may have arcs down to nothing.

use super::{Counts, Observation, Outlook, Spot, holds_part};
use crate::finding::{Detail, Rule, SmallRadius};
use crate::geometry::{Point, Segment};
use crate::program::path::{UM_IN_MM, is_tight, is_tight_in_four_b};
use crate::program::three_b::block::Motion;
use crate::program::three_b::decode::decode;
use crate::settings::SideSetting;

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    let turns_left = match outlook.block.motion {
        Motion::Line(_) => return None,
        Motion::Clockwise(_) => false,
        Motion::CounterClockwise(_) => true,
    };
    let counts = match outlook.part {
        Some(part) if part.concave => Counts::Always,
        Some(_) => return None,
        None if !holds_part(outlook.settings) => return None,
        None if matches!(
            outlook.settings.side,
            SideSetting::Opening | SideSetting::Punch
        ) =>
        {
            Counts::IfInside { turns_left }
        }
        None => Counts::Always,
    };
    let stated = outlook.part.map_or(0.0, |part| part.radius as f64);
    let radius = if stated > 0.0 {
        stated
    } else {
        outlook.radius()
    };
    let required = outlook.settings.correction * 1000.0;
    let is_tight = match outlook.part {
        Some(_) => is_tight_in_four_b(radius.round(), required),
        None => is_tight(radius, required),
    };
    let Ok(Segment::Arc(arc)) = decode(outlook.block, Point::origin()) else {
        return None;
    };
    if !is_tight {
        return None;
    }
    let detail = SmallRadius {
        pass: outlook.settings.pass,
        ..SmallRadius::of(&arc, radius, required, UM_IN_MM)
    };
    Some(Observation {
        rule: Rule::SmallRadius,
        spot: Spot::Block,
        detail: Detail::SmallRadius(Box::new(detail)),
        counts,
    })
}
