//! A punch in its plate, as the wire leaves them: the places where clearance is missing are marked and enlarged.

use super::marks;
use super::numbers::number;
use super::room::Room;
use super::sheet::{Frame, MARGIN, SHEET_WIDTH, Sheet, named, path_data};
use super::style;
use super::window::{Window, Windows};
use crate::drawing::Drawing;
use crate::finding::Severity;
use crate::fit::{Fit, Spot};
use crate::geometry::{Bounds, Point, Segment};
use crate::text::head;

/// The most places that are enlarged, the worst first.
const MOST: usize = 6;
const WINDOWS: Windows = Windows {
    columns: 3,
    height: 200.0,
    caption: 56.0,
};
/// Beyond this many, places are dots without a number.
const NUMBERED: usize = 24;

/// One outline in the other as one SVG, in mm; the segment of the drawing that protrudes names a place.
pub(crate) fn fit_svg(drawing: &Drawing, fit: &Fit, unit_mm: f64) -> String {
    let mut bounds = Bounds::EMPTY;
    for pair in &fit.pairs {
        let all = pair.punch.iter().chain(&pair.plate);
        all.for_each(|segment| bounds.merge(&segment.bounds()));
    }
    if bounds.is_empty() {
        return style::empty(say!(no_contour_is_of_a_pair)).text;
    }
    let frame = Frame::fitting(&bounds);
    let mut worst: Vec<&Spot> = fit.spots().collect();
    worst.sort_by(|a, b| a.clearance.total_cmp(&b.clearance));
    let enlarged = head(&worst, MOST);
    let lenses_top = frame.bottom + 40.0;
    let legend_top = lenses_top + WINDOWS.height_of(enlarged.len());
    let mm = |length: f64| length * unit_mm;
    let title = match fit.fits() {
        true => say!(the_parts_fit),
        false => say!(the_parts_do_not_fit),
    };
    let mut sheet = style::opening(legend_top + 48.0, title);
    let (least, wanted, places) = (mm(fit.least()), mm(fit.clearance), worst.len());
    let facts = match least < 0.0 {
        true => say!(facts_of_parts_that_bind, -least, wanted, places),
        false => say!(facts_of_the_fit, least, wanted, places),
    };
    sheet.heading(title, &facts, None);
    sheet.line(format_args!(
        "<g class=\"figure\">{}",
        frame.opening_of_drawing(unit_mm, None)
    ));
    outlines(&mut sheet, fit, &frame);
    sheet.line(format_args!("</g>"));
    let middle = bounds.min + (bounds.max - bounds.min) * 0.5;
    let mut room = Room::default();
    for (index, spot) in worst.iter().enumerate() {
        let (entity, segment) = spot.segment;
        let handle = drawing
            .get(entity)
            .map_or("", |entity| entity.handle.as_ref());
        let class = format!("mark {}", style::class_of(Severity::Error));
        let named = named(&class, handle, segment);
        let at = frame.on_sheet(spot.at);
        if index < NUMBERED {
            let outward = spot.at - middle;
            marks::mark(
                &mut sheet,
                &named,
                (at, outward),
                index,
                None,
                &mut room,
                0.0,
            );
        } else {
            let [x, y] = [at.0, at.1].map(number);
            sheet.line(format_args!(r#"<g {named} data-at="{x} {y}">"#));
            sheet.circle(r#"class="badge""#, at, 3.0, "");
            sheet.line(format_args!("</g>"));
        }
    }
    sheet.line(format_args!("</g>"));
    for (index, spot) in enlarged.iter().enumerate() {
        let window = WINDOWS.at(index, lenses_top);
        lens(&mut sheet, fit, spot, &window, unit_mm);
    }
    sheet.line(format_args!("<g class=\"chrome\">"));
    let mut entries = vec![
        (
            r#"<path class="wire" d="M0 0h24"/>"#,
            say!(the_plate_as_it_is_left),
        ),
        (
            r#"<path class="contour" d="M0 0h24"/>"#,
            say!(the_punch_as_it_is_left),
        ),
    ];
    if !worst.is_empty() {
        let dot = r#"<circle class="badge" cx="12" cy="0" r="6"/>"#;
        entries.push((dot, say!(clearance_is_missing)));
    }
    style::legend(&mut sheet, legend_top + 12.0, &entries);
    let right = SHEET_WIDTH - MARGIN;
    style::scale_bar(&mut sheet, right, legend_top + 12.0, frame.scale / unit_mm);
    sheet.line(format_args!("</g>\n</svg>"));
    sheet.text
}

/// The plate as background with its opening, the punch in it.
fn outlines(sheet: &mut Sheet, fit: &Fit, frame: &Frame) {
    for (index, pair) in fit.pairs.iter().enumerate() {
        let data = |outline: &[Segment]| path_data(frame, outline.iter().copied(), true);
        let (plate, punch) = rayon::join(|| data(&pair.plate), || data(&pair.punch));
        let [plate_id, punch_id] = ["plate", "punch"].map(|part| format!("fit-{part}-{index}"));
        sheet.text.reserve(plate.len() + punch.len());
        sheet.line(format_args!("<defs>"));
        for (id, data) in [(&plate_id, &plate), (&punch_id, &punch)] {
            sheet.path(&format!(r#"id="{id}""#), data, "");
        }
        sheet.line(format_args!("</defs>"));
        for (class, id) in [
            ("void", &plate_id),
            ("ground", &punch_id),
            ("wire", &plate_id),
            ("contour", &punch_id),
        ] {
            sheet.line(format_args!(r##"<use class="{class}" href="#{id}"/>"##));
        }
    }
}

/// One place enlarged to suit its clearance, with what is left of that.
fn lens(sheet: &mut Sheet, fit: &Fit, spot: &Spot, lens: &Window, unit_mm: f64) {
    let seen = 14.0 * fit.clearance.max((fit.clearance - spot.clearance).abs());
    let scale = WINDOWS.width() / seen;
    if !scale.is_finite() || scale <= 0.0 {
        return;
    }
    let frame = lens.frame(spot.at, scale);
    let window = Bounds {
        min: spot.at,
        max: spot.at,
    }
    .grown(seen);
    lens.open(sheet, r#"class="lens""#, "fit", "ground", &frame);
    let reaches = |segments: &[Segment]| {
        let near = |segment: &&Segment| segment.bounds().touches(&window);
        segments.iter().filter(near).copied().collect::<Vec<_>>()
    };
    for pair in &fit.pairs {
        for (class, outline) in [("wire", &pair.plate), ("contour", &pair.punch)] {
            for segment in reaches(outline) {
                let data = path_data(&frame, flat(segment, spot.at, seen), false);
                sheet.path(&format!(r#"class="{class}""#), &data, "");
            }
        }
    }
    sheet.circle(r#"class="dot""#, (0.0, 0.0), 2.6, "");
    let [left, wanted] = [spot.clearance, fit.clearance].map(|length| length * unit_mm);
    let figures = match left < 0.0 {
        true => say!(binds_by, -left, wanted),
        false => say!(left_of_the_clearance, left, wanted),
    };
    let place = say!(the_corner_of_a_part, spot.of, spot.partner);
    lens.close(sheet, &figures, &place);
    let (right, bottom) = lens.lower_right();
    style::scale_bar(sheet, right - 12.0, bottom - 24.0, scale / unit_mm);
}

/// The part of a segment near a point, for viewers that lose digits when enlarging thousands of times.
fn flat(segment: Segment, at: Point, seen: f64) -> Vec<Segment> {
    let length = segment.length();
    let near = segment.share_of(at);
    if length <= 0.0 || !near.is_finite() {
        return vec![segment];
    }
    let reach = 2.0 * seen / length;
    let (from, to) = (
        (near - reach).clamp(0.0, 1.0),
        (near + reach).clamp(0.0, 1.0),
    );
    match segment.as_arc() {
        Some(arc) if arc.is_full_turn() => vec![segment],
        _ if to > from => vec![segment.part(from, to)],
        _ => Vec::new(),
    }
}
