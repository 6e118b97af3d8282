//! Numbered marks beside the faults, thread holes, starting points and texts.

use super::figure::{Frame, escaped, named, number};
use super::{Fault, MARGIN, Picture, SHEET_WIDTH};
use crate::geometry::{Point, Vector, direction};
use crate::toolpath::Source;
use std::f64::consts::FRAC_PI_4;
use std::fmt::Write;

/// More faults than this are only coloured: numbers would cover the drawing.
const MOST: usize = 24;
/// Up to this many faults the number carries the radius beside it.
const WITH_RADIUS: usize = 16;

/// A number beside each fault, in sheet coordinates, joined to it by a thin line.
pub(super) fn faults(sheet: &mut String, frame: &Frame, faults: &[Fault], unit_mm: f64, top: f64) {
    let mut taken: Vec<Label> = Vec::new();
    let with_radius = faults.len() <= WITH_RADIUS;
    for (index, fault) in faults.iter().take(MOST).enumerate() {
        let arc = fault.arc();
        let at = frame.on_sheet(arc.point_at(0.5));
        let outward = (arc.point_at(0.5) - arc.center)
            .try_normalize(0.0)
            .unwrap_or_else(Vector::x);
        // On the sheet y points down.
        let angle = (-outward.y).atan2(outward.x);
        let label = free_place(at, angle, with_radius, &taken, top);
        let (x, y) = label.badge;
        let _ = writeln!(
            sheet,
            r#"<g class="mark" {} data-at="{} {}">"#,
            named(&fault.handle, fault.segment),
            number(at.0),
            number(at.1)
        );
        let _ = writeln!(
            sheet,
            r#"<path class="leader" d="M{} {}L{} {}"/><circle class="badge" cx="{2}" cy="{3}" r="9"/><text class="count" x="{2}" y="{}">{}</text>"#,
            number(at.0),
            number(at.1),
            number(x),
            number(y),
            number(y + 4.0),
            index + 1
        );
        if with_radius {
            let (anchor, x) = if label.text_to_the_left {
                ("end", x - 13.0)
            } else {
                ("start", x + 13.0)
            };
            let radius = fault.detail.radius * unit_mm;
            let _ = writeln!(
                sheet,
                r#"<text class="radius" text-anchor="{anchor}" x="{}" y="{}">R {radius:.3}</text>"#,
                number(x),
                number(y + 4.0)
            );
        }
        sheet.push_str("</g>\n");
        taken.push(label);
    }
}

/// Where a number stands: its disc, the box of disc and text, and to which side the text runs.
struct Label {
    badge: (f64, f64),
    from: (f64, f64),
    to: (f64, f64),
    text_to_the_left: bool,
}

impl Label {
    fn new(badge: (f64, f64), with_text: bool, text_to_the_left: bool) -> Label {
        let text = if with_text { 58.0 } else { 0.0 };
        let (left, right) = if text_to_the_left {
            (text, 0.0)
        } else {
            (0.0, text)
        };
        let from = (badge.0 - 11.0 - left, badge.1 - 11.0);
        let to = (badge.0 + 11.0 + right, badge.1 + 11.0);
        Label {
            badge,
            from,
            to,
            text_to_the_left,
        }
    }

    fn overlaps(&self, other: &Label) -> bool {
        self.from.0 < other.to.0
            && other.from.0 < self.to.0
            && self.from.1 < other.to.1
            && other.from.1 < self.to.1
    }
}

/// The nearest place that covers no earlier label, tried outward from the part first.
fn free_place(at: (f64, f64), outward: f64, with_text: bool, taken: &[Label], top: f64) -> Label {
    let turns = [0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 4.0];
    let candidates = [26.0, 44.0, 66.0, 96.0].into_iter().flat_map(|distance| {
        turns.into_iter().flat_map(move |turn| {
            let along = direction(outward + turn * FRAC_PI_4);
            let badge = (at.0 + along.x * distance, at.1 + along.y * distance);
            let away = along.x < -1e-9;
            [away, !away].map(|to_the_left| Label::new(badge, with_text, to_the_left))
        })
    });
    let fits = |label: &Label| {
        label.from.0 > MARGIN / 4.0 && label.to.0 < SHEET_WIDTH - MARGIN / 4.0 && label.from.1 > top
    };
    let mut first = None;
    for label in candidates {
        if fits(&label) && !taken.iter().any(|other| label.overlaps(other)) {
            return label;
        }
        first.get_or_insert(label);
    }
    first.unwrap_or_else(|| Label::new(at, with_text, false))
}

/// Thread hole, where the cut begins on the path, and which way it goes.
pub(super) fn thread_holes(sheet: &mut String, frame: &Frame, picture: &Picture) {
    for path in picture.paths {
        let (x, y) = frame.local(path.thread_hole);
        let (x_mm, y_mm) = (
            picture.mm(path.thread_hole.x),
            picture.mm(path.thread_hole.y),
        );
        let _ = writeln!(
            sheet,
            r#"<g class="thread"><title>thread hole at {x_mm:.3}, {y_mm:.3} mm</title><circle cx="{}" cy="{}" r="5"/><path d="M{} {}h16M{} {}v16"/></g>"#,
            number(x),
            number(y),
            number(x - 8.0),
            number(y),
            number(x),
            number(y - 8.0)
        );
        let first = path
            .segments
            .iter()
            .find(|segment| !matches!(segment.source, Source::LeadIn | Source::LeadOut));
        if let Some(first) = first {
            arrow(
                sheet,
                frame,
                first.geometry.start(),
                first.geometry.start_tangent(),
            );
        }
    }
}

/// A head that points along `along` and begins in `point`.
fn arrow(sheet: &mut String, frame: &Frame, point: Point, along: Vector) {
    let (x, y) = frame.local(point);
    let across = Vector::new(-along.y, along.x) * 4.5;
    let tip = along * 13.0;
    let _ = writeln!(
        sheet,
        r#"<path class="arrow" d="M{} {}L{} {}L{} {}Z"><title>the cut begins here</title></path>"#,
        number(x + tip.x),
        number(y + tip.y),
        number(x + across.x),
        number(y + across.y),
        number(x - across.x),
        number(y - across.y)
    );
}

/// A text of the drawing; "O", the mark of a starting point, stands upon its point, other texts begin in it.
pub(super) fn text(sheet: &mut String, frame: &Frame, at: Point, text: &str) {
    let (x, y) = frame.local(at);
    let shown: String = text.chars().take(48).collect();
    let is_mark = shown.trim().eq_ignore_ascii_case("o");
    let (class, anchor) = if is_mark {
        ("start", "middle")
    } else {
        ("annotation", "start")
    };
    // Text is turned back, or it would be read in a mirror.
    let _ = writeln!(
        sheet,
        r#"<text class="{class}" text-anchor="{anchor}" transform="matrix(1 0 0 -1 {} {})" y="{}">{}</text>"#,
        number(x),
        number(y),
        if is_mark { 4 } else { 0 },
        escaped(&shown)
    );
}
