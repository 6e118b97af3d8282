//! The first faults enlarged, each with the circle of the correction beside the arc that is too tight for it.

use super::sheet::{Frame, MARGIN, SHEET_WIDTH, Sheet, escaped, named, number, path_data};
use super::style::class_of;
use super::subject::{Fault, Subject};
use crate::drawing::{Outline, Role};
use crate::geometry::{Bounds, Point, Segment};

const COLUMNS: usize = 4;
const GAP: f64 = 16.0;
const WIDTH: f64 = (SHEET_WIDTH - 2.0 * MARGIN - GAP * (COLUMNS as f64 - 1.0)) / COLUMNS as f64;
const WINDOW: f64 = 168.0;
const CAPTION: f64 = 52.0;
/// Beyond this many, faults are marked in the figure and not enlarged.
const MOST: usize = 8;
/// A contour of more segments than this is not shaded within a lens.
const SHADED_SEGMENTS: usize = 1000;

/// Height of the rows for `faults` faults, 0 for none.
pub(super) fn height_of(faults: usize) -> f64 {
    let rows = faults.min(MOST).div_ceil(COLUMNS);
    let note = if faults > MOST { 24.0 } else { 0.0 };
    rows as f64 * (WINDOW + CAPTION) + note
}

pub(super) fn row(sheet: &mut Sheet, subject: &Subject, top: f64) {
    for (index, fault) in subject.faults.iter().take(MOST).enumerate() {
        let left = MARGIN + (index % COLUMNS) as f64 * (WIDTH + GAP);
        let top = top + (index / COLUMNS) as f64 * (WINDOW + CAPTION);
        lens(sheet, subject, fault, index, left, top);
    }
    let left_out = subject.faults.len().saturating_sub(MOST);
    if left_out > 0 {
        let y = number(top + height_of(subject.faults.len()) - 8.0);
        sheet.line(format_args!(
            r#"<text class="note lens" x="{MARGIN}" y="{y}">{}</text>"#,
            say!(and_more_marked_in_the_drawing, left_out)
        ));
    }
}

fn lens(sheet: &mut Sheet, subject: &Subject, fault: &Fault, index: usize, left: f64, top: f64) {
    let disc = fault.correction_disc();
    let mut seen = Bounds::of_disc(disc, fault.detail.required);
    seen.merge(&fault.arc().bounds());
    let scale = (WIDTH / seen.width()).min(WINDOW / seen.height()) / 1.5;
    if !scale.is_finite() || scale <= 0.0 {
        return;
    }
    // The subject is centred in the window, and coordinates are relative to its centre.
    let middle = Point::from((seen.min.coords + seen.max.coords) * 0.5);
    let frame = Frame {
        origin: middle,
        scale,
        left: left + WIDTH / 2.0,
        bottom: top + WINDOW / 2.0,
    };
    let window = Bounds {
        min: middle,
        max: middle,
    }
    .grown(WIDTH / scale);
    let holds = |outline: &&Outline| {
        let mut pieces = outline.contour.pieces.iter();
        fault
            .entity
            .is_some_and(|entity| pieces.any(|piece| piece.entity == entity))
    };
    let outline = subject.outlines.iter().find(holds);
    let ground = match outline {
        Some(outline) if outline.role == Role::Opening => "ground",
        _ => "sheet",
    };
    let [x, y, width, height] = [left, top, WIDTH, WINDOW].map(number);
    let rectangle = format!(r#"x="{x}" y="{y}" width="{width}" height="{height}" rx="6""#);
    let severity = class_of(fault.severity);
    let named = named(&format!("lens {severity}"), &fault.handle, fault.segment);
    let opening = frame.opening();
    sheet.line(format_args!(
        r##"<g {named}>
<clipPath id="lens{index}"><rect {rectangle}/></clipPath>
<g clip-path="url(#lens{index})">
<rect class="{ground}" {rectangle}/>
{opening}"##
    ));
    if let Some(outline) = outline {
        shade(sheet, subject, outline, &frame);
    }
    contents(sheet, subject, &frame, &window);
    marks(sheet, fault, disc, &frame);
    sheet.line(format_args!(
        r#"</g></g><rect class="window" {rectangle}/>"#
    ));
    caption(sheet, subject, fault, index, left, top + WINDOW);
    sheet.line(format_args!("</g>"));
}

fn shade(sheet: &mut Sheet, subject: &Subject, outline: &Outline, frame: &Frame) {
    if !outline.contour.closed || outline.contour.len() > SHADED_SEGMENTS {
        return;
    }
    let attributes = match outline.role {
        Role::Opening => r#"class="void""#,
        _ => r#"class="ground""#,
    };
    let segments = outline.contour.segments(subject.drawing);
    let data = path_data(frame, segments.map(|segment| segment.geometry), true);
    sheet.path(attributes, &data, "");
}

/// Contour and wire path as far as they reach into the window.
fn contents(sheet: &mut Sheet, subject: &Subject, frame: &Frame, window: &Bounds) {
    let mut draw = |attributes: &str, segment: Segment| {
        if segment.bounds().touches(window) {
            sheet.path(attributes, &path_data(frame, [segment], false), "");
        }
    };
    for outline in subject.outlines {
        for segment in outline.contour.segments(subject.drawing) {
            draw(r#"class="contour""#, segment.geometry);
        }
    }
    for segment in subject.paths.iter().flat_map(|path| &path.segments) {
        draw(r#"class="wire""#, segment.geometry);
    }
}

fn marks(sheet: &mut Sheet, fault: &Fault, disc: Point, frame: &Frame) {
    let (arc, middle) = (fault.arc(), frame.local(disc));
    let radius = fault.detail.required * frame.scale;
    sheet.circle(r#"class="correction""#, middle, radius, "");
    sheet.circle(r#"class="middle""#, middle, 2.2, "");
    let spoke = Segment::line(arc.center, arc.point_at(0.5));
    sheet.path(r#"class="spoke""#, &path_data(frame, [spoke], false), "");
    let arc = path_data(frame, [Segment::Arc(arc)], false);
    let class = format!(r#"class="fault {}""#, class_of(fault.severity));
    sheet.path(&class, &arc, "");
}

fn caption(sheet: &mut Sheet, subject: &Subject, fault: &Fault, index: usize, left: f64, top: f64) {
    let [radius, required, overcut] = [
        fault.detail.radius,
        fault.detail.required,
        fault.detail.overcut,
    ]
    .map(|length| subject.mm(length));
    let (handle, segment) = (&fault.handle, fault.segment);
    let figures = escaped(&format!("R {radius:.3} < {required:.3} mm"));
    let place = escaped(&say!(segment_overcut, handle, segment, overcut));
    sheet.circle(r#"class="badge""#, (left + 10.0, top + 20.0), 9.0, "");
    let [badge, x, y, first, second] =
        [left + 10.0, left + 26.0, top + 24.0, top + 18.0, top + 34.0].map(number);
    let count = index + 1;
    sheet.line(format_args!(
        r#"<text class="count" x="{badge}" y="{y}">{count}</text><text class="figures" x="{x}" y="{first}">{figures}</text><text class="place" x="{x}" y="{second}">{place}</text>"#
    ));
}
