//! A picture of contours, faults and wire path as SVG, for people: one file that needs nothing beside it.
//!
//! It shows findings and paths that are made elsewhere and decides nothing. It knows drawings,
//! findings and paths, and nothing of files or protocols. The same input gives the same bytes.
//!
//! Interactive viewers find the parts by their class: `figure` is the drawing, `lens` an enlarged fault, `mark` the
//! number beside one (with `data-at`, the point on the sheet that it belongs to), `chrome` the text around it, `fine`
//! details that are too small to see at this size. An element for a segment has `data-handle` and `data-segment`.

mod areas;
mod export;
mod figure;
mod fit;
mod lens;
mod marks;
mod numbers;
mod pieces;
mod program;
mod reach;
mod room;
mod sheet;
mod style;
mod subject;
mod window;

pub(crate) use export::Image;
pub(crate) use fit::fit_svg;
pub(crate) use pieces::Piece;
pub(crate) use program::program;
pub(crate) use sheet::escaped;
pub(crate) use subject::mark_numbers;

use crate::drawing::{Drawing, Outline};
use crate::finding::{Detail, Finding, Severity};
use crate::settings::Effective;
use crate::toolpath::{StartHole, WirePath, lengths};
use room::Room;
use sheet::{FIGURE_TOP, Frame, MARGIN, SHEET_WIDTH, Sheet};
use subject::{PartPaths, Subject, is_other};

/// The contents of a picture.
pub struct View<'a> {
    /// The name of its file, where it has one.
    pub name: Option<&'a str>,
    pub drawing: &'a Drawing,
    /// The outlines that are cut; entities in none of them are drawn faintly.
    pub outlines: &'a [Outline],
    pub findings: &'a [Finding],
    /// In the order in which they are cut.
    pub paths: &'a [WirePath],
    /// Of a pair what of the paths is of which part, in their order; else nothing.
    pub parts: &'a [PartShare<'a>],
    /// Where the wire is threaded for them.
    pub holes: &'a [StartHole],
    /// Why there are none, and how severe that is.
    pub why: Option<(Severity, &'a str)>,
    pub settings: &'a Effective,
}

/// One part of a pair among the paths.
pub struct PartShare<'a> {
    /// Its name for people.
    pub title: String,
    /// How many of the paths are its own.
    pub paths: usize,
    /// Those that it is cut under.
    pub settings: &'a Effective,
}

/// The drawing with its faults and the paths of the wire as one SVG.
///
/// Every arc that is too tight is marked, and the first ones are enlarged with the circle of the correction. The kerf,
/// and what the wire leaves of an area that it should cut, are to scale: the half width is the wire's radius and the
/// spark gap, else the last correction; of a pair, whose parts are cut out of other plates, there are only the paths. All figures in texts are in mm. The y axis points up, as in the drawing. A
/// drawing without geometry gives a sheet that says so.
pub fn svg(view: &View) -> String {
    drawn(view, false).svg
}

/// A picture, and in numbers what of it is not in its SVG.
pub(crate) struct Drawn {
    pub(crate) svg: String,
    pub(crate) pieces: Option<Vec<Piece>>,
}

impl From<Sheet> for Drawn {
    fn from(Sheet { text, pieces }: Sheet) -> Drawn {
        Drawn { svg: text, pieces }
    }
}

/// As [`svg`]. With `in_pieces` a drawing of many elements comes as numbers: the SVG has its heading and its legend only.
pub(crate) fn drawn(view: &View, in_pieces: bool) -> Drawn {
    let View {
        findings,
        paths,
        settings,
        ..
    } = *view;
    let Some(subject) = Subject::new(view) else {
        return style::empty(say!(the_drawing_has_no_lines)).into();
    };
    let unit_mm = subject.unit_mm;
    let faults = &subject.faults;
    let frame = Frame::fitting(&subject.bounds);
    let details_top = frame.bottom + 48.0;
    let legend_top = details_top + lens::height_of(faults.len());
    let what = match (paths.is_empty(), settings.mills) {
        (true, false) => say!(contours_without_a_wire_path),
        (false, false) => say!(contour_and_wire_path),
        (true, true) => say!(contours_without_an_electrode_path),
        (false, true) => say!(contours_and_electrode_path),
    };
    let title = titled(view.name, what);
    let others = findings.iter().filter(|finding| is_other(finding));
    let severities = others.map(|finding| finding.severity);
    let ways = |paths: &[WirePath]| {
        let mut pairs = paths.iter().zip(paths.iter().skip(1));
        pairs.any(|(path, next)| path.end() != next.begin())
    };
    let jumps = subject.parts.iter().any(|part| ways(part.paths));
    let shown = style::Shown {
        part: view.outlines.iter().any(|outline| outline.contour.closed),
        faults: !faults.is_empty(),
        severities: severities
            .chain(faults.iter().map(|fault| fault.severity))
            .collect(),
        paths: !paths.is_empty(),
        mills: settings.mills,
        jumps,
        tabs: paths.iter().any(|path| path.cut_off),
        kerf: subject.half_kerfs.iter().any(Option::is_some),
        lost: findings.iter().any(leaves_some),
        zero: subject.shows_zero(),
    };
    let entries = style::entries(&shown);
    let mut sheet = style::opening(legend_top + style::height_of(&entries), &title);
    sheet.pieces = (in_pieces && subject.elements() > pieces::MANY).then(Vec::new);
    let (severity, alert) = alert(view, faults);
    let alert = (!alert.is_empty()).then_some((style::class_of(severity), alert.as_str()));
    sheet.heading(&title, &facts(&subject), alert);
    sheet.line(format_args!("<g class=\"figure\">"));
    let mut room = Room::default();
    let spots = figure::figure(&mut sheet, &frame, &subject, &mut room);
    // A viewer that paints pieces makes marks of its own.
    let is_whole = sheet.pieces.is_none();
    if is_whole {
        let top = FIGURE_TOP - 26.0;
        marks::faults(&mut sheet, &frame, faults, unit_mm, top, &mut room);
        marks::numbers(&mut sheet, &spots, &mut room);
    }
    sheet.line(format_args!("</g>"));
    if is_whole {
        lens::row(&mut sheet, &subject, details_top);
    }
    sheet.line(format_args!("<g class=\"chrome\">"));
    style::legend(&mut sheet, legend_top + 12.0, &entries);
    let right = SHEET_WIDTH - MARGIN;
    style::scale_bar(&mut sheet, right, legend_top + 12.0, frame.scale / unit_mm);
    sheet.line(format_args!("</g>\n</svg>"));
    sheet.into()
}

/// True where something that should be cut is left there.
fn leaves_some(finding: &Finding) -> bool {
    matches!(
        finding.detail,
        Detail::LostPocket { .. }
            | Detail::DeadEnd { .. }
            | Detail::SharpCorner { .. }
            | Detail::SharpCorners { .. }
    )
}

/// The name of a file and the content of its picture.
fn titled(name: Option<&str>, what: &str) -> String {
    match name {
        Some(name) => format!("{name} · {what}"),
        None => what.into(),
    }
}

/// The faults, and why there is no path.
fn alert(view: &View, faults: &[subject::Fault]) -> (Severity, String) {
    let mut parts = Vec::new();
    match faults.len() {
        0 => {}
        1 => parts.push(say!(n1_arc_is_too_tight).to_owned()),
        count => parts.push(say!(arcs_are_too_tight, count)),
    }
    parts.extend(view.why.map(|(_, why)| match view.settings.mills {
        false => say!(no_wire_path_because, why),
        true => say!(no_electrode_path_because, why),
    }));
    let severities = faults.iter().map(|fault| fault.severity);
    let worst = severities
        .chain(view.why.map(|(severity, _)| severity))
        .min();
    (worst.unwrap_or(Severity::Information), parts.join(" · "))
}

/// Corrections, contours, extents and lengths, as far as they are known.
fn facts(subject: &Subject) -> String {
    let first = subject.faults.first();
    let tight = first.map(|fault| vec![fault.detail.required]);
    let mut facts = Vec::new();
    for part in &subject.parts {
        let own = tight.clone().filter(|_| part.title.is_none());
        let corrections = own.unwrap_or_else(|| part.corrections.clone());
        let listed: Vec<String> = corrections
            .iter()
            .map(|correction| format!("{:.3}", subject.mm(*correction)))
            .collect();
        if !listed.is_empty() {
            let said = say!(correction_mm, listed.join(" / "));
            // The corrections of a pair are worked out.
            let said = match part.title {
                None => say!(with_its_origin, said, subject.origin),
                Some(_) => said,
            };
            facts.push(match part.title {
                Some(title) => say!(of_a_part, title, said),
                None => said,
            });
        }
    }
    facts.push(say!(contours, subject.outlines.len()));
    let extents = subject.extents();
    let [width, height] = [extents.width(), extents.height()].map(|length| subject.mm(length));
    facts.push(say!(extents_mm, width, height));
    let contours = subject.outlines.iter().map(|outline| &outline.contour);
    let segments = contours.flat_map(|contour| contour.segments(subject.drawing));
    let contour: f64 = segments.map(|segment| segment.geometry.length()).sum();
    facts.push(say!(contour_length, subject.mm(contour)));
    // There is no room for those of several parts.
    if let [
        PartPaths {
            title: None, paths, ..
        },
    ] = subject.parts[..]
        && !paths.is_empty()
    {
        let (cut, jumps) = lengths(paths);
        facts.push(crate::message::lengths(
            subject.mm(cut),
            subject.mm(jumps),
            " · ",
        ));
    }
    facts.join(" · ")
}

#[cfg(test)]
mod tests;
