//! The first faults enlarged, each with the circle of the correction beside the arc that is too tight for it.

use super::figure::{Frame, escaped, named, number, path_data};
use super::{Fault, MARGIN, Picture, SHEET_WIDTH};
use crate::drawing::{Outline, Role};
use crate::geometry::{Bounds, Point, Segment};
use std::fmt::Write;

const COLUMNS: usize = 4;
const GAP: f64 = 16.0;
const WIDTH: f64 = (SHEET_WIDTH - 2.0 * MARGIN - GAP * (COLUMNS as f64 - 1.0)) / COLUMNS as f64;
const WINDOW: f64 = 168.0;
const CAPTION: f64 = 52.0;
/// More than this many faults are marked in the figure, and not enlarged.
const MOST: usize = 8;
/// A contour of more segments than this is not shaded within a lens.
const SHADED_SEGMENTS: usize = 1000;

/// Height of the rows for `faults` faults, 0 for none.
pub(super) fn height_of(faults: usize) -> f64 {
    let rows = faults.min(MOST).div_ceil(COLUMNS);
    let note = if faults > MOST { 24.0 } else { 0.0 };
    rows as f64 * (WINDOW + CAPTION) + note
}

pub(super) fn row(sheet: &mut String, picture: &Picture, top: f64) {
    for (index, fault) in picture.faults.iter().take(MOST).enumerate() {
        let left = MARGIN + (index % COLUMNS) as f64 * (WIDTH + GAP);
        let top = top + (index / COLUMNS) as f64 * (WINDOW + CAPTION);
        lens(sheet, picture, fault, index, left, top);
    }
    let left_out = picture.faults.len().saturating_sub(MOST);
    if left_out > 0 {
        let y = top + height_of(picture.faults.len()) - 8.0;
        let _ = writeln!(
            sheet,
            r#"<text class="note lens" x="{MARGIN}" y="{}">and {left_out} more, marked in the drawing</text>"#,
            number(y)
        );
    }
}

fn lens(sheet: &mut String, picture: &Picture, fault: &Fault, index: usize, left: f64, top: f64) {
    let disc = correction_disc(fault);
    let required = fault.detail.required;
    let mut seen = Bounds::of_disc(disc, required);
    seen.merge(&fault.arc().bounds());
    let scale = (WIDTH / seen.width()).min(WINDOW / seen.height()) / 1.5;
    if !scale.is_finite() || scale <= 0.0 {
        return;
    }
    // The middle of what is shown lies in the middle of the window, and coordinates are counted from it.
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
    let outline = picture.outlines.iter().find(|outline| {
        fault.entity.is_some_and(|entity| {
            outline
                .contour
                .pieces
                .iter()
                .any(|piece| piece.entity == entity)
        })
    });

    let (x, y, width, height) = (number(left), number(top), number(WIDTH), number(WINDOW));
    let rectangle = format!(r#"x="{x}" y="{y}" width="{width}" height="{height}" rx="6""#);
    let _ = writeln!(
        sheet,
        r#"<g class="lens" {}>"#,
        named(&fault.handle, fault.segment)
    );
    let _ = writeln!(
        sheet,
        r#"<clipPath id="lens{index}"><rect {rectangle}/></clipPath>"#
    );
    let _ = writeln!(sheet, r#"<g clip-path="url(#lens{index})">"#);
    let ground = if outline.is_some_and(|outline| outline.role == Role::Opening) {
        "ground"
    } else {
        "sheet"
    };
    let _ = writeln!(sheet, r#"<rect class="{ground}" {rectangle}/>"#);
    let _ = writeln!(sheet, "{}", frame.opening());
    if let Some(outline) = outline {
        shade(sheet, picture, outline, &frame);
    }
    contents(sheet, picture, &frame, &window);
    marks(sheet, fault, disc, &frame);
    let _ = writeln!(sheet, r#"</g></g><rect class="window" {rectangle}/>"#);
    caption(sheet, picture, fault, index, left, top + WINDOW);
    sheet.push_str("</g>\n");
}

fn shade(sheet: &mut String, picture: &Picture, outline: &Outline, frame: &Frame) {
    if !outline.contour.closed || outline.contour.len() > SHADED_SEGMENTS {
        return;
    }
    let class = if outline.role == Role::Opening {
        "void"
    } else {
        "ground"
    };
    let segments = outline
        .contour
        .segments(picture.drawing)
        .map(|segment| segment.geometry);
    let _ = writeln!(
        sheet,
        r#"<path class="{class}" d="{}"/>"#,
        path_data(frame, segments, true)
    );
}

/// Contour and wire path as far as they reach into the window.
fn contents(sheet: &mut String, picture: &Picture, frame: &Frame, window: &Bounds) {
    let mut draw = |class: &str, segments: &mut dyn Iterator<Item = Segment>| {
        for segment in segments.filter(|segment| segment.bounds().touches(window)) {
            let _ = writeln!(
                sheet,
                r#"<path class="{class}" d="{}"/>"#,
                path_data(frame, [segment], false)
            );
        }
    };
    for outline in picture.outlines {
        draw(
            "contour",
            &mut outline
                .contour
                .segments(picture.drawing)
                .map(|segment| segment.geometry),
        );
    }
    for path in picture.paths {
        draw(
            "wire",
            &mut path.segments.iter().map(|segment| segment.geometry),
        );
    }
}

fn marks(sheet: &mut String, fault: &Fault, disc: Point, frame: &Frame) {
    let arc = fault.arc();
    let (x, y) = frame.local(disc);
    let radius = fault.detail.required * frame.scale;
    let _ = writeln!(
        sheet,
        r#"<circle class="correction" cx="{}" cy="{}" r="{}"/>"#,
        number(x),
        number(y),
        number(radius)
    );
    let _ = writeln!(
        sheet,
        r#"<circle class="dot" cx="{}" cy="{}" r="2.2"/>"#,
        number(x),
        number(y)
    );
    let spoke = Segment::line(arc.center, arc.point_at(0.5));
    let _ = writeln!(
        sheet,
        r#"<path class="spoke" d="{}"/>"#,
        path_data(frame, [spoke], false)
    );
    let _ = writeln!(
        sheet,
        r#"<path class="fault" d="{}"/>"#,
        path_data(frame, [Segment::Arc(arc)], false)
    );
}

fn caption(
    sheet: &mut String,
    picture: &Picture,
    fault: &Fault,
    index: usize,
    left: f64,
    top: f64,
) {
    let detail = fault.detail;
    let place = format!("{} segment {}", fault.handle, fault.segment);
    let figures = format!(
        "R {:.3} < {:.3} mm",
        picture.mm(detail.radius),
        picture.mm(detail.required)
    );
    let overcut = format!("overcut {:.3}", picture.mm(detail.overcut));
    let _ = writeln!(
        sheet,
        r#"<circle class="badge" cx="{}" cy="{}" r="9"/>"#,
        number(left + 10.0),
        number(top + 20.0)
    );
    let _ = writeln!(
        sheet,
        r#"<text class="count" x="{}" y="{}">{}</text><text class="figures" x="{}" y="{}">{}</text><text class="place" x="{}" y="{}">{}</text>"#,
        number(left + 10.0),
        number(top + 24.0),
        index + 1,
        number(left + 26.0),
        number(top + 18.0),
        escaped(&figures),
        number(left + 26.0),
        number(top + 34.0),
        escaped(&format!("{place}, {overcut}"))
    );
}

/// Centre of the circle of the correction as it would have to lie: touching both neighbours of a fillet.
///
/// From a half turn on no circle touches both; it is then shown about the arc's own centre.
pub(super) fn correction_disc(fault: &Fault) -> Point {
    let arc = fault.arc();
    let opening = (arc.sweep.abs() / 2.0).cos();
    let inward = (arc.center - arc.point_at(0.5)).try_normalize(0.0);
    match inward {
        Some(inward) if arc.sweep.abs() < 2.8 => {
            arc.center + inward * ((fault.detail.required - arc.radius) / opening)
        }
        _ => arc.center,
    }
}
