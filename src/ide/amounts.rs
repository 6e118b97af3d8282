//! Lengths, angles and places as people read them.

use crate::geometry::Point;

/// At most this many decimals, without trailing zeros.
pub(super) fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    if text == "-0" { "0" } else { text }.into()
}

/// µm as mm with three decimals: the places that a machine on a µm grid can reach.
pub(super) fn mm(micrometres: f64) -> String {
    let text = format!("{:.3}", micrometres / 1000.0);
    if text == "-0.000" {
        "0.000".into()
    } else {
        text
    }
}

/// `(9.900, 0.000)` of a place in µm.
pub(super) fn point(at: Point) -> String {
    format!("({}, {})", mm(at.x), mm(at.y))
}

/// At most three decimals, without trailing zeros.
pub(super) fn degrees(radians: f64) -> String {
    format!("{}°", rounded(radians.to_degrees(), 3))
}

/// The direction of an arc of this sweep, or of a contour around this area.
pub(super) fn turn(amount: f64) -> &'static str {
    if amount > 0.0 {
        say!(counter_clockwise)
    } else {
        say!(clockwise)
    }
}

pub(super) fn closing(closed: bool) -> &'static str {
    if closed { say!(closed) } else { say!(open) }
}
