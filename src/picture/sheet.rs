//! The sheet as SVG: the layout, geometry as path data, and how elements, numbers and texts are written.

use super::numbers::{number, push_thousandths, thousandths};
use super::reach::{FARTHEST, Reach, each_part};
use crate::geometry::{Bounds, Point, Segment};
use crate::message::columns;
use std::f64::consts::PI;
use std::fmt::{Arguments, Write};

/// Width of the sheet and of the margin round it, in the picture's own units.
pub(super) const SHEET_WIDTH: f64 = 960.0;
pub(super) const MARGIN: f64 = 40.0;
/// Room at the sides of the drawing for the numbers beside its faults.
const FIGURE_WIDTH: f64 = SHEET_WIDTH - 5.5 * MARGIN;
const FIGURE_HEIGHT: f64 = 560.0;
pub(super) const FIGURE_TOP: f64 = 112.0;
/// Columns of text in the width of the sheet, and of its title, which is larger.
const COLUMNS: usize = 132;
const COLUMNS_OF_TITLE: usize = 86;

/// The SVG written so far.
#[derive(Default)]
pub(super) struct Sheet(pub String);

impl Sheet {
    /// A line of SVG.
    pub(crate) fn line(&mut self, svg: Arguments) {
        let _ = writeln!(self.0, "{svg}");
    }

    /// A path, with a tooltip where `title` is not empty.
    pub(crate) fn path(&mut self, attributes: &str, data: &str, title: &str) {
        match title {
            "" => self.line(format_args!(r#"<path {attributes} d="{data}"/>"#)),
            title => self.line(format_args!(
                r#"<path {attributes} d="{data}"><title>{}</title></path>"#,
                escaped(title)
            )),
        }
    }

    /// A circle, where it is near enough, and no larger than can be seen of it.
    pub(crate) fn circle(
        &mut self,
        attributes: &str,
        middle: (f64, f64),
        radius: f64,
        title: &str,
    ) {
        if radius.max(middle.0.abs()).max(middle.1.abs()) > FARTHEST {
            return;
        }
        let [x, y, r] = [middle.0, middle.1, radius].map(number);
        match title {
            "" => self.line(format_args!(
                r#"<circle {attributes} cx="{x}" cy="{y}" r="{r}"/>"#
            )),
            title => self.line(format_args!(
                r#"<circle {attributes} cx="{x}" cy="{y}" r="{r}"><title>{}</title></circle>"#,
                escaped(title)
            )),
        }
    }

    /// The head of the picture; `alert` is the fault, with the class of its severity.
    pub(crate) fn heading(&mut self, title: &str, facts: &str, alert: Option<(&str, &str)>) {
        self.line(format_args!(
            r#"<g class="chrome"><text class="heading" x="{MARGIN}" y="34">{}</text>"#,
            with_whole(title, COLUMNS_OF_TITLE)
        ));
        self.line(format_args!(
            r#"<text class="note" x="{MARGIN}" y="54">{}</text>"#,
            with_whole(facts, COLUMNS)
        ));
        if let Some((class, alert)) = alert {
            self.line(format_args!(
                r#"<text class="alert {class}" x="{MARGIN}" y="74"><title>{0}</title>{1}</text>"#,
                escaped(alert),
                escaped(&shortened(alert, COLUMNS))
            ));
        }
        self.line(format_args!("</g>"));
    }
}

/// Where on the sheet a part of the drawing is shown, and how large.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// The point of the drawing at (`left`, `bottom`) of the sheet.
    pub(crate) origin: Point,
    /// Sheet units in one drawing unit.
    pub(crate) scale: f64,
    pub(crate) left: f64,
    pub(crate) bottom: f64,
}

impl Frame {
    /// Centres `bounds` across the sheet, as large as there is room for.
    pub(crate) fn fitting(bounds: &Bounds) -> Frame {
        let scale = (FIGURE_WIDTH / bounds.width()).min(FIGURE_HEIGHT / bounds.height());
        // A single point has no extent to fit.
        let scale = if scale.is_finite() && scale > 0.0 {
            scale
        } else {
            1.0
        };
        Frame {
            origin: bounds.min,
            scale,
            left: (SHEET_WIDTH - bounds.width() * scale) / 2.0,
            bottom: FIGURE_TOP + (bounds.height() * scale).max(24.0),
        }
    }

    /// Opens the group with y up and [`Frame::local`] coordinates.
    pub(crate) fn opening(&self) -> String {
        let [left, bottom] = [self.left, self.bottom].map(number);
        format!(r#"<g transform="matrix(1 0 0 -1 {left} {bottom})">"#)
    }

    /// The same for the drawing itself, with the data that turn coordinates within the group into the drawing's:
    /// `data-origin` + local / `data-scale`, in units of `data-unit-mm` millimetres; and with the length of cut, mm, if
    /// the wire's path is in it.
    pub(crate) fn opening_of_drawing(&self, unit_mm: f64, cut: Option<f64>) -> String {
        let [left, bottom] = [self.left, self.bottom].map(number);
        let (origin, scale) = (self.origin, self.scale);
        let cut = cut.map_or_else(String::new, |cut| format!(r#" data-cut="{cut:?}""#));
        format!(
            r#"<g class="drawing" transform="matrix(1 0 0 -1 {left} {bottom})" data-origin="{:?} {:?}" data-scale="{scale:?}" data-unit-mm="{unit_mm:?}"{cut}>"#,
            origin.x, origin.y
        )
    }

    /// Coordinates within the group, y up.
    pub(crate) fn local(&self, point: Point) -> (f64, f64) {
        let shifted = (point - self.origin) * self.scale;
        (shifted.x, shifted.y)
    }

    /// Coordinates on the sheet, y down, where text is written.
    pub(crate) fn on_sheet(&self, point: Point) -> (f64, f64) {
        let (x, y) = self.local(point);
        (self.left + x, self.bottom - y)
    }
}

/// The segments as one path, in the frame's local coordinates; `close` joins its end to its start. What lies farther
/// away than [`FARTHEST`] is left out; of an area the edge there takes its place.
///
/// An arc is split into pieces of less than a half turn, so that a full circle is drawn, and so that no viewer has to
/// guess which of two arcs is meant.
pub(super) fn path_data(
    frame: &Frame,
    segments: impl IntoIterator<Item = Segment>,
    close: bool,
) -> String {
    let mut path = PathData::default();
    for segment in segments {
        each_part(frame.origin, frame.scale, segment, &mut |part| match part {
            Reach::Near(segment) => path.push(frame, &segment),
            Reach::Far(along) if close => path.push(frame, &along),
            // A line that leaves the sheet comes back to it in another place.
            Reach::Far(_) => path.pen = None,
        });
    }
    if close && !path.data.is_empty() {
        path.data.push('Z');
    }
    path.data
}

/// Path data, and where its pen stands.
#[derive(Default)]
struct PathData {
    data: String,
    pen: Option<[i64; 2]>,
}

impl PathData {
    fn push(&mut self, frame: &Frame, segment: &Segment) {
        let data = &mut self.data;
        let start = place(frame, segment.start());
        match self.pen {
            None => push_place(data, 'M', start),
            Some(stands) if stands != start => push_place(data, 'L', start),
            Some(_) => {}
        }
        let end = place(frame, segment.end());
        match segment {
            Segment::Line(_) => push_place(data, 'L', end),
            Segment::Arc(arc) => {
                let pieces = (arc.sweep.abs() / (0.9 * PI)).ceil().max(1.0);
                let radius = number(arc.radius * frame.scale);
                let direction = u8::from(arc.sweep > 0.0);
                for piece in 1..=pieces as u32 {
                    let to = place(frame, arc.point_at(f64::from(piece) / pieces));
                    let _ = write!(data, "A{radius} {radius} 0 0 {direction}");
                    push_place(data, ' ', to);
                }
            }
        }
        self.pen = Some(end);
    }
}

/// A place of the drawing in the frame's local coordinates, in thousandths.
fn place(frame: &Frame, point: Point) -> [i64; 2] {
    let (x, y) = frame.local(point);
    [x, y].map(thousandths)
}

fn push_place(data: &mut String, before: char, [x, y]: [i64; 2]) {
    data.push(before);
    push_thousandths(data, x);
    data.push(' ');
    push_thousandths(data, y);
}

/// As much of a text as fits in this many columns, with the whole of it as a tooltip where that is not all.
fn with_whole(text: &str, most: usize) -> String {
    match shortened(text, most) {
        short if short == text => escaped(text),
        short => format!("<title>{}</title>{}", escaped(text), escaped(&short)),
    }
}

/// As much of a text as fits in this many columns.
fn shortened(text: &str, most: usize) -> String {
    if columns(text) <= most {
        return text.into();
    }
    let mut short = String::new();
    for character in text.chars() {
        if columns(&short) + 2 >= most {
            break;
        }
        short.push(character);
    }
    short.trim_end().to_owned() + "…"
}

/// The class and the attributes of an element for a segment.
pub(super) fn named(class: &str, handle: &str, segment: usize) -> String {
    let handle = escaped(handle);
    format!(r#"class="{class}" data-handle="{handle}" data-segment="{segment}""#)
}

/// Text for XML: markup characters replaced, characters that XML forbids left out.
pub(crate) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\t' | '\n' => safe.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => safe.push(c),
        }
    }
    safe
}
