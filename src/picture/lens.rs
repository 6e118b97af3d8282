//! The first faults enlarged, each with the circle of the correction beside the arc that is too tight for it.

use super::areas;
use super::numbers::number;
use super::sheet::{Frame, MARGIN, Sheet, named, path_data};
use super::style::class_of;
use super::subject::{Fault, Subject};
use super::window::{Window, Windows};
use crate::drawing::Outline;
use crate::geometry::{Bounds, Point, Segment};
use rustc_hash::FxHashSet;

const WINDOWS: Windows = Windows {
    columns: 4,
    height: 168.0,
    caption: 52.0,
};
/// Beyond this many, faults are marked in the figure and not enlarged.
const MOST: usize = 8;
/// A contour of more segments than this is not shaded within a lens.
const SHADED_SEGMENTS: usize = 1000;

/// Height of the rows for `faults` faults, 0 for none.
pub(super) fn height_of(faults: usize) -> f64 {
    let note = if faults > MOST { 24.0 } else { 0.0 };
    WINDOWS.height_of(faults.min(MOST)) + note
}

pub(super) fn row(sheet: &mut Sheet, subject: &Subject, top: f64) {
    let voids = match subject.faults.is_empty() {
        true => FxHashSet::default(),
        false => areas::voids(subject.drawing, subject.outlines),
    };
    for (index, fault) in subject.faults.iter().take(MOST).enumerate() {
        lens(sheet, subject, fault, &voids, &WINDOWS.at(index, top));
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

fn lens(
    sheet: &mut Sheet,
    subject: &Subject,
    fault: &Fault,
    voids: &FxHashSet<usize>,
    lens: &Window,
) {
    let disc = fault.correction_disc();
    let mut seen = Bounds::of_disc(disc, fault.detail.required);
    seen.merge(&fault.arc().bounds());
    let scale = (WINDOWS.width() / seen.width()).min(WINDOWS.height / seen.height()) / 1.5;
    if !scale.is_finite() || scale <= 0.0 {
        return;
    }
    let middle = Point::from((seen.min.coords + seen.max.coords) * 0.5);
    let frame = lens.frame(middle, scale);
    let window = Bounds {
        min: middle,
        max: middle,
    }
    .grown(WINDOWS.width() / scale);
    let holds = |(_, outline): &(usize, &Outline)| {
        let mut pieces = outline.contour.pieces.iter();
        fault
            .entity
            .is_some_and(|entity| pieces.any(|piece| piece.entity == entity))
    };
    let outline = subject.outlines.iter().enumerate().find(holds);
    let is_void = outline.is_some_and(|(index, _)| voids.contains(&index));
    let ground = if is_void { "ground" } else { "sheet" };
    let severity = class_of(fault.severity);
    let named = named(&format!("lens {severity}"), &fault.handle, fault.segment);
    lens.open(sheet, &named, "lens", ground, &frame);
    if let Some((_, outline)) = outline {
        shade(sheet, subject, outline, is_void, &frame);
    }
    contents(sheet, subject, &frame, &window);
    marks(sheet, fault, disc, &frame);
    let detail = fault.detail;
    let [radius, required, overcut, stock] = [
        detail.radius,
        detail.required,
        detail.overcut,
        detail.stock_left,
    ]
    .map(|length| subject.mm(length));
    let place = match (detail.overcuts(subject.unit_mm), stock.is_finite()) {
        (true, _) => say!(segment_overcut, fault.handle, fault.segment, overcut),
        (false, true) => say!(segment_stock, fault.handle, fault.segment, stock),
        (false, false) => say!(segment, fault.handle, fault.segment),
    };
    let figures = format!("R {radius:.3} < {required:.3} mm");
    lens.close(sheet, &figures, &place);
}

fn shade(sheet: &mut Sheet, subject: &Subject, outline: &Outline, is_void: bool, frame: &Frame) {
    if !outline.contour.closed || outline.contour.len() > SHADED_SEGMENTS {
        return;
    }
    let attributes = match is_void {
        true => r#"class="void""#,
        false => r#"class="ground""#,
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
