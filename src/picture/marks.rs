//! Numbered marks beside the faults, thread holes, starting points and texts.

use super::numbers::number;
use super::sheet::{Frame, MARGIN, SHEET_WIDTH, Sheet, escaped, named};
use super::style::class_of;
use super::subject::{Fault, Subject};
use crate::geometry::{Point, Vector, direction};
use crate::toolpath::Source;
use std::f64::consts::FRAC_PI_4;

/// Beyond this many, faults are only coloured: numbers would cover the drawing.
const MOST: usize = 24;
/// Up to this many faults the number has the radius beside it.
const WITH_RADIUS: usize = 16;

/// More contours than this are not numbered.
const MOST_NUMBERED: usize = 300;

/// A number beside each fault, in sheet coordinates, joined to it by a thin line.
pub(super) fn faults(sheet: &mut Sheet, frame: &Frame, faults: &[Fault], unit_mm: f64, top: f64) {
    let mut taken: Vec<Label> = Vec::new();
    let with_radius = faults.len() <= WITH_RADIUS;
    for (index, fault) in faults.iter().take(MOST).enumerate() {
        let arc = fault.arc();
        let outward = (arc.point_at(0.5) - arc.center)
            .try_normalize(0.0)
            .unwrap_or_else(Vector::x);
        let class = format!("mark {}", class_of(fault.severity));
        let named = named(&class, &fault.handle, fault.segment);
        let beside = with_radius.then(|| format!("R {:.3}", fault.detail.radius * unit_mm));
        let at = frame.on_sheet(arc.point_at(0.5));
        taken.push(mark(sheet, &named, at, outward, index, beside, &taken, top));
    }
}

/// A number beside a place of the sheet, joined to it by a thin line, on the `outward` side if possible; with a text
/// beside the number.
#[expect(clippy::too_many_arguments, reason = "all of it is one mark")]
pub(super) fn mark(
    sheet: &mut Sheet,
    named: &str,
    at: (f64, f64),
    outward: Vector,
    index: usize,
    beside: Option<String>,
    taken: &[Label],
    top: f64,
) -> Label {
    // On the sheet y points down.
    let angle = (-outward.y).atan2(outward.x);
    let label = free_place(at, angle, beside.is_some(), taken, top);
    let [from_x, from_y, x, y, text_y] = [
        at.0,
        at.1,
        label.badge.0,
        label.badge.1,
        label.badge.1 + 4.0,
    ]
    .map(number);
    let count = index + 1;
    sheet.line(format_args!(
        r#"<g {named} data-at="{from_x} {from_y}">
<path class="leader" d="M{from_x} {from_y}L{x} {y}"/><circle class="badge" cx="{x}" cy="{y}" r="9"/><text class="count" x="{x}" y="{text_y}">{count}</text>"#
    ));
    if let Some(text) = beside {
        let (anchor, beside) = match label.text_to_the_left {
            true => ("end", -13.0),
            false => ("start", 13.0),
        };
        let x = number(label.badge.0 + beside);
        sheet.line(format_args!(
            r#"<text class="radius" text-anchor="{anchor}" x="{x}" y="{text_y}">{text}</text>"#
        ));
    }
    sheet.line(format_args!("</g>"));
    label
}

/// The place of a number: its disc, the box of disc and text, and the side to which the text runs.
pub(super) struct Label {
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

/// The nearest place that covers no earlier label, outward from the part first.
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

/// A thread hole, as large as its drill where that is set, with its number in the order of the cuts if there are
/// several, the start of the cut on the path, and its direction.
pub(super) fn thread_holes(sheet: &mut Sheet, frame: &Frame, subject: &Subject) {
    // The passes of a contour share it.
    let first = || subject.paths.iter().filter(|path| path.is_first());
    let are_numbered = (2..=MOST_NUMBERED).contains(&first().count());
    for (index, path) in first().enumerate() {
        let hole = path.thread_hole;
        let (across, up) = frame.local(hole);
        let [x, y, left, below] = [across, up, across - 8.0, up - 8.0].map(number);
        let title = match subject.mills {
            false => say!(thread_hole_at_mm, subject.mm(hole.x), subject.mm(hole.y)),
            true => say!(start_of_a_contour).to_owned(),
        };
        sheet.line(format_args!(
            r#"<g class="thread"><title>{title}</title><circle cx="{x}" cy="{y}" r="5"/><path d="M{left} {y}h16M{x} {below}v16"/></g>"#
        ));
        if let Some(radius) = subject.drill.radius_at(hole) {
            let middle = frame.local(hole);
            sheet.circle(r#"class="hole""#, middle, radius * frame.scale, "");
        }
        if are_numbered {
            order(sheet, (across, up), index + 1);
        }
        let is_cut = |source: &Source| !matches!(source, Source::LeadIn | Source::LeadOut);
        let mut segments = path.segments.iter();
        if let Some(first) = segments.find(|segment| is_cut(&segment.source)) {
            let first = &first.geometry;
            arrow(sheet, frame, first.start(), first.start_tangent());
        }
    }
}

/// The number of a contour among all, beside its thread hole.
pub(super) fn order(sheet: &mut Sheet, (x, y): (f64, f64), number_of: usize) {
    let [x, y] = [x, y].map(number);
    sheet.line(format_args!(
        r#"<g class="turned" transform="matrix(1 0 0 -1 {x} {y})"><text class="order" x="9" y="-7">{number_of}</text></g>"#
    ));
}

/// An arrow head that points along `along` and begins in `point`.
fn arrow(sheet: &mut Sheet, frame: &Frame, point: Point, along: Vector) {
    let from = Vector::from(<[f64; 2]>::from(frame.local(point)));
    let side = Vector::new(-along.y, along.x) * 4.5;
    let [tip, left, right] = [from + along * 13.0, from + side, from - side]
        .map(|corner| format!("{} {}", number(corner.x), number(corner.y)));
    let data = format!("M{tip}L{left}L{right}Z");
    sheet.path(r#"class="arrow""#, &data, say!(the_cut_begins_here));
}

/// A text of the drawing. "O", the mark of a starting point, is centred on its point; other texts begin in it.
pub(super) fn text(sheet: &mut Sheet, frame: &Frame, at: Point, text: &str) {
    let (x, y) = frame.local(at);
    let [x, y] = [x, y].map(number);
    let shown: String = text.chars().take(48).collect();
    let (class, anchor, down) = match shown.trim().eq_ignore_ascii_case("o") {
        true => ("start", "middle", 4),
        false => ("annotation", "start", 0),
    };
    // Text is turned back, or it would be mirrored.
    sheet.line(format_args!(
        r#"<text class="{class}" text-anchor="{anchor}" transform="matrix(1 0 0 -1 {x} {y})" y="{down}">{}</text>"#,
        escaped(&shown)
    ));
}
