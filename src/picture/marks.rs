//! Numbered marks beside the faults, thread holes, starting points and texts.

use super::numbers::number;
use super::pieces::Piece;
use super::room::{Area, Room};
use super::sheet::{Frame, MARGIN, SHEET_WIDTH, Sheet, escaped, named};
use super::style::class_of;
use super::subject::{Fault, Subject};
use crate::finding::Severity;
use crate::geometry::{Point, Vector, direction};
use crate::toolpath::Source;
use std::f64::consts::FRAC_PI_4;

/// Beyond this many, faults have a small number: large ones would cover the drawing.
const MOST: usize = 24;
/// Up to this many faults the number has the radius beside it.
const WITH_RADIUS: usize = 16;

/// More contours than this are not numbered, and more marks of other findings.
const MOST_NUMBERED: usize = 300;
const MOST_SMALL: usize = 300;
/// The longest arrow head, in units of the sheet.
const ARROW: f64 = 11.0;

/// Where a mark of the drawing is, and its number.
pub(super) struct Spot {
    pub(super) number: usize,
    /// On the sheet.
    pub(super) at: (f64, f64),
    pub(super) handle: String,
    pub(super) segment: usize,
    pub(super) severity: Severity,
}

/// A number beside each fault, in sheet coordinates, joined to it by a thin line; a small one beyond [`MOST`].
pub(super) fn faults(
    sheet: &mut Sheet,
    frame: &Frame,
    faults: &[Fault],
    unit_mm: f64,
    top: f64,
    room: &mut Room,
) {
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
        mark(sheet, &named, (at, outward), index, beside, room, top);
    }
    let left = faults
        .iter()
        .enumerate()
        .skip(MOST)
        .map(|(index, fault)| Spot {
            number: index + 1,
            at: frame.on_sheet(fault.arc().point_at(0.5)),
            handle: fault.handle.clone(),
            segment: fault.segment,
            severity: fault.severity,
        });
    numbers(sheet, &left.collect::<Vec<_>>(), room);
}

/// A small number beside each mark.
pub(super) fn numbers(sheet: &mut Sheet, spots: &[Spot], room: &mut Room) {
    for spot in spots.iter().take(MOST_SMALL) {
        let number_of = spot.number;
        let width = 6.4 * number_of.to_string().len() as f64 + 2.0;
        let area = |middle: &(f64, f64)| Area::about(*middle, width, 9.0);
        let places = around(spot.at, FRAC_PI_4, &[10.0, 15.0, 22.0]);
        let Some((text_x, text_y)) = room.free(places, area) else {
            continue;
        };
        let named = named(
            &format!("mark {}", class_of(spot.severity)),
            &spot.handle,
            spot.segment,
        );
        let [x, y, text_x, text_y] = [spot.at.0, spot.at.1, text_x, text_y + 3.5].map(number);
        sheet.line(format_args!(
            r#"<g {named} data-at="{x} {y}"><text class="small radius" x="{text_x}" y="{text_y}">{number_of}</text></g>"#
        ));
    }
}

/// Places about a point of the sheet, the nearest first, and of those in the direction of `angle` first.
fn around(
    at: (f64, f64),
    angle: f64,
    distances: &[f64],
) -> impl Iterator<Item = (f64, f64)> + use<'_> {
    let turns = [0.0, 2.0, -2.0, 4.0, 1.0, -1.0, 3.0, -3.0];
    distances.iter().flat_map(move |distance| {
        turns.into_iter().map(move |turn| {
            let along = direction(angle + turn * FRAC_PI_4);
            (at.0 + along.x * distance, at.1 - along.y * distance)
        })
    })
}

/// A number beside a place of the sheet, joined to it by a thin line, on the `outward` side if possible; with a text
/// beside the number.
pub(super) fn mark(
    sheet: &mut Sheet,
    named: &str,
    (at, outward): ((f64, f64), Vector),
    index: usize,
    beside: Option<String>,
    room: &mut Room,
    top: f64,
) {
    // On the sheet y points down.
    let angle = (-outward.y).atan2(outward.x);
    let label = free_place(at, angle, beside.is_some(), room, top);
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
}

/// The place of a number: its disc, the box of disc and text, and the side to which the text runs.
struct Label {
    badge: (f64, f64),
    area: Area,
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
        let area = Area {
            from: (badge.0 - 11.0 - left, badge.1 - 11.0),
            to: (badge.0 + 11.0 + right, badge.1 + 11.0),
        };
        Label {
            badge,
            area,
            text_to_the_left,
        }
    }
}

/// The nearest place in which nothing is in the way, outward from the part first.
fn free_place(at: (f64, f64), outward: f64, with_text: bool, room: &mut Room, top: f64) -> Label {
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
        let Area { from, to } = label.area;
        from.0 > MARGIN / 4.0 && to.0 < SHEET_WIDTH - MARGIN / 4.0 && from.1 > top
    };
    room.free(candidates.filter(fits), |label| label.area)
        .unwrap_or_else(|| Label::new(at, with_text, false))
}

/// A thread hole, as large as its drill where that is set, with its number in the order of the cuts if there are
/// several, the start of the cut on the path, and its direction. An electrode is shown to scale where it starts.
pub(super) fn thread_holes(sheet: &mut Sheet, frame: &Frame, subject: &Subject, room: &mut Room) {
    // The passes of a contour share it.
    let first = || subject.paths.iter().filter(|path| path.is_first());
    let are_numbered = (2..=MOST_NUMBERED).contains(&first().count());
    if let Some(pieces) = &mut sheet.pieces {
        pieces.extend(first().enumerate().map(|(index, path)| {
            let order = are_numbered.then_some(index + 1);
            Piece::thread(frame.place(path.thread_hole), order)
        }));
        return;
    }
    for path in first() {
        let hole = path.thread_hole;
        let at = frame.local(hole);
        room.take(Area::about(frame.on_sheet(hole), 16.0, 16.0));
        match subject.electrode {
            Some(radius) => {
                let title = say!(start_of_a_contour);
                let class = r#"class="electrode""#;
                sheet.circle(class, at, radius * frame.scale, title);
            }
            None => {
                let [x, y, left, below] = [at.0, at.1, at.0 - 8.0, at.1 - 8.0].map(number);
                let title = say!(thread_hole_at_mm, subject.mm(hole.x), subject.mm(hole.y));
                sheet.line(format_args!(
                    r#"<g class="thread"><title>{title}</title><circle cx="{x}" cy="{y}" r="5"/><path d="M{left} {y}h16M{x} {below}v16"/></g>"#
                ));
            }
        }
        if let Some(radius) = subject.drill.radius_at(hole) {
            sheet.circle(r#"class="hole""#, at, radius * frame.scale, "");
        }
        let is_cut = |source: &Source| !matches!(source, Source::LeadIn | Source::LeadOut);
        let mut segments = path.segments.iter();
        if let Some(first) = segments.find(|segment| is_cut(&segment.source)) {
            let first = &first.geometry;
            let contour = subject
                .outlines
                .get(path.outline)
                .map(|outline| &outline.contour);
            let size = contour.map_or(0.0, |contour| {
                let bounds = contour.bounds(subject.drawing);
                bounds.width().max(bounds.height()) * frame.scale
            });
            let length = (size * 0.25).clamp(4.0, ARROW);
            let along = first.start_tangent() * (length / frame.scale / 2.0);
            let middle = frame.on_sheet(first.start() + along);
            room.take(Area::about(middle, length, length));
            arrow(sheet, frame, first.start(), first.start_tangent(), length);
        }
    }
    for (index, path) in first().enumerate().filter(|_| are_numbered) {
        let (x, y) = frame.on_sheet(path.thread_hole);
        let width = 7.2 * (index + 1).to_string().len() as f64 + 1.0;
        let area = |middle: &(f64, f64)| Area::about(*middle, width, 10.0);
        let places = around((x, y), FRAC_PI_4, &[13.0, 17.0, 22.0, 30.0]);
        let (across, down) = room.free(places, area).unwrap_or((x, y));
        order(
            sheet,
            frame.local(path.thread_hole),
            (across - x, down - y),
            index + 1,
        );
    }
}

/// The number of a contour among all, beside its thread hole: its middle `by` this much on the sheet.
pub(super) fn order(sheet: &mut Sheet, (x, y): (f64, f64), by: (f64, f64), number_of: usize) {
    let [x, y, across, down] = [x, y, by.0, by.1 + 4.0].map(number);
    sheet.line(format_args!(
        r#"<g class="turned" transform="matrix(1 0 0 -1 {x} {y})"><text class="order" text-anchor="middle" x="{across}" y="{down}">{number_of}</text></g>"#
    ));
}

/// An arrow head of a length that points along `along` and begins in `point`.
fn arrow(sheet: &mut Sheet, frame: &Frame, point: Point, along: Vector, length: f64) {
    let from = Vector::from(<[f64; 2]>::from(frame.local(point)));
    let side = Vector::new(-along.y, along.x) * (length / 3.0);
    let [tip, left, right] = [from + along * length, from + side, from - side]
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
