//! A picture of contours, faults and wire path as SVG, for people: one file that needs nothing beside it.
//!
//! It shows what others have found and planned and decides nothing. It knows drawings, findings and paths,
//! and nothing of files or protocols. The same input gives the same bytes.
//!
//! Whoever shows it to somebody who may point at it finds parts by their class: `figure` is the drawing, `lens` an enlarged
//! fault, `mark` the number beside one (with `data-at`, the point on the sheet that it belongs to), `chrome` what is
//! written about it, `fine` what is too small to be seen at this size. What stands for a segment says so in `data-handle` and `data-segment`.

mod figure;
mod fit;
mod lens;
mod marks;
mod program;
mod sheet;
mod style;
mod subject;

pub(crate) use fit::fit_svg;
pub(crate) use program::program_svg;
pub(crate) use sheet::escaped;

use crate::drawing::{Drawing, Outline};
use crate::finding::{Detail, Finding};
use crate::settings::Effective;
use crate::toolpath::WirePath;
use sheet::{FIGURE_TOP, Frame, MARGIN, SHEET_WIDTH};
use subject::{Subject, is_other};

/// The drawing with its faults and the paths of the wire as one SVG.
///
/// `outlines` are what is cut; entities in none of them are drawn faintly. Every arc that is too tight is marked, and
/// the first ones are shown enlarged with the circle of the correction. What the wire cuts, and what it leaves of an area that it should cut,
/// are shown to scale: half as wide as the wire's radius and the spark gap, else the last correction. All
/// figures that a reader sees are in mm. The y axis points up, as in the drawing. A drawing without geometry gives
/// a sheet that says so.
pub fn svg(
    drawing: &Drawing,
    outlines: &[Outline],
    findings: &[Finding],
    paths: &[WirePath],
    settings: &Effective,
) -> String {
    let Some(subject) = Subject::new(drawing, outlines, findings, paths, settings) else {
        return style::empty(say!(the_drawing_has_no_lines));
    };
    let unit_mm = subject.unit_mm;
    let faults = &subject.faults;
    let frame = Frame::fitting(&subject.bounds);
    let details_top = frame.bottom + 48.0;
    let legend_top = details_top + lens::height_of(faults.len());
    let title = match faults.len() {
        0 => say!(contour_and_wire_path).into(),
        1 => say!(n1_arc_is_too_tight).into(),
        count => say!(arcs_are_too_tight, count),
    };
    let shown = style::Shown {
        faults: !faults.is_empty(),
        others: findings.iter().any(is_other),
        paths: !paths.is_empty(),
        kerf: subject.half_kerfs.iter().any(Option::is_some),
        lost: findings.iter().any(leaves_some),
    };
    let entries = style::entries(&shown);
    let height = legend_top + 48.0 + style::height_of_legend(&entries);
    let mut sheet = style::opening(height, &title);
    sheet.heading(&title, &facts(&subject));
    sheet.line(format_args!("<g class=\"figure\">"));
    figure::figure(&mut sheet, &frame, &subject);
    marks::faults(&mut sheet, &frame, faults, unit_mm, FIGURE_TOP - 26.0);
    sheet.line(format_args!("</g>"));
    lens::row(&mut sheet, &subject, details_top);
    sheet.line(format_args!("<g class=\"chrome\">"));
    style::legend(&mut sheet, legend_top + 12.0, &entries);
    let right = SHEET_WIDTH - MARGIN;
    style::scale_bar(&mut sheet, right, legend_top + 12.0, frame.scale / unit_mm);
    sheet.line(format_args!("</g>\n</svg>"));
    sheet.0
}

/// Something that should be cut stays there.
fn leaves_some(finding: &Finding) -> bool {
    matches!(
        finding.detail,
        Detail::LostPocket { .. } | Detail::DeadEnd { .. } | Detail::SharpCorner { .. }
    )
}

/// Correction, contours and length of the path, as far as they are known.
fn facts(subject: &Subject) -> String {
    let of_path = || subject.paths.first().map(|path| path.correction);
    let first = subject.faults.first();
    let correction = first.map(|fault| fault.detail.required).or_else(of_path);
    let mut facts = Vec::new();
    if let Some(correction) = correction {
        facts.push(say!(correction_mm, subject.mm(correction)));
    }
    facts.push(say!(contours, subject.outlines.len()));
    if !subject.paths.is_empty() {
        let segments = subject.paths.iter().flat_map(|path| &path.segments);
        let length: f64 = segments.map(|segment| segment.geometry.length()).sum();
        facts.push(say!(wire_path_mm, subject.mm(length)));
    }
    facts.join(" · ")
}

#[cfg(test)]
mod tests;
