//! Points, lengths and steps in the words of the shop.

use crate::geometry::{Point, Segment};
use crate::program::path::{Kind, Step};

/// µm as mm with three decimals: what a machine on a µm grid can stand on.
pub(super) fn mm(micrometres: f64) -> String {
    let text = format!("{:.3}", micrometres / 1000.0);
    if text == "-0.000" {
        "0.000".into()
    } else {
        text
    }
}

/// `(9.900, 0.000)`.
pub(super) fn point(at: Point) -> String {
    format!("({}, {})", mm(at.x), mm(at.y))
}

/// At most three decimals, none that say nothing.
pub(super) fn degrees(radians: f64) -> String {
    let text = format!("{:.3}", radians.to_degrees());
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0°".into()
    } else {
        format!("{text}°")
    }
}

/// `line to (9.900, 0.000)`, `arc R 9.900 to …`.
pub(super) fn step(step: &Step) -> String {
    match (step.kind, &step.ideal) {
        (Kind::Pause, _) => "pause".into(),
        (Kind::End, _) => "end".into(),
        (Kind::Rapid, _) => format!("way to {}", point(step.end)),
        (_, None) => "block that leads nowhere".into(),
        (_, Some(Segment::Line(_))) => format!("line to {}", point(step.end)),
        (_, Some(Segment::Arc(arc))) if arc.is_full_turn() => {
            format!("circle R {}", mm(arc.radius))
        }
        (_, Some(Segment::Arc(arc))) => format!("arc R {} to {}", mm(arc.radius), point(step.end)),
    }
}
