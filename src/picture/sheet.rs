//! The sheet as SVG: the layout, geometry as path data, and how elements, numbers and texts are written.

use super::numbers::{number, push_thousandths, thousandths};
use super::pieces::{Local, Piece, What, data_of_runs, runs};
use super::reach::FARTHEST;
use crate::geometry::{Bounds, Point, Segment};
use crate::message::columns;
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

/// The picture so far.
#[derive(Default)]
pub(super) struct Sheet {
    /// The SVG.
    pub(super) text: String,
    /// The parts of the drawing, where they are no elements of the SVG.
    pub(super) pieces: Option<Vec<Piece>>,
}

impl Sheet {
    /// A line of SVG.
    pub(crate) fn line(&mut self, svg: Arguments) {
        let _ = writeln!(self.text, "{svg}");
    }

    /// A part of the drawing along segments, with a tooltip where `title` is not empty; `close` joins its end to its start.
    pub(crate) fn draw(
        &mut self,
        frame: &Frame,
        what: &What,
        segments: impl IntoIterator<Item = Segment>,
        close: bool,
        title: impl FnOnce() -> String,
    ) {
        let runs = frame.runs(segments, close);
        match &mut self.pieces {
            Some(pieces) => pieces.extend(runs.into_iter().map(|run| what.piece(run))),
            None if runs.is_empty() => {}
            None => self.path(&attributes(what), &data_of_runs(&runs, close), &title()),
        }
    }

    /// A dot at a place of the drawing, in local coordinates.
    pub(crate) fn dot(&mut self, what: &What, at: (f64, f64), radius: f64, title: &str) {
        match &mut self.pieces {
            Some(pieces) => pieces.push(what.piece(vec![thousandths(at.0), thousandths(at.1)])),
            None => self.circle(&attributes(what), at, radius, title),
        }
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

    fn as_local(&self) -> Local {
        Local {
            origin: self.origin,
            scale: self.scale,
        }
    }

    /// A place in the group, in thousandths.
    pub(crate) fn place(&self, point: Point) -> [i64; 2] {
        self.as_local().place(point)
    }

    /// Segments in the group.
    pub(crate) fn runs(
        &self,
        segments: impl IntoIterator<Item = Segment>,
        area: bool,
    ) -> Vec<Vec<i64>> {
        runs(self.as_local(), segments, area)
    }

    /// Coordinates on the sheet, y down, where text is written.
    pub(crate) fn on_sheet(&self, point: Point) -> (f64, f64) {
        let (x, y) = self.local(point);
        (self.left + x, self.bottom - y)
    }
}

/// What an element is, as its attributes.
fn attributes(what: &What) -> String {
    let mut text = format!(r#"class="{}""#, what.class);
    if let Some(handle) = what.handle {
        let _ = write!(text, r#" data-handle="{}""#, escaped(handle));
    }
    let numbers = [
        ("data-segment", what.segment),
        ("data-pass", what.pass),
        ("data-line", what.line),
    ];
    for (name, number) in numbers {
        if let Some(number) = number {
            let _ = write!(text, r#" {name}="{number}""#);
        }
    }
    if let Some(width) = what.width {
        text.push_str(r#" stroke-width=""#);
        push_thousandths(&mut text, thousandths(width));
        text.push('"');
    }
    text
}

/// The segments as one path, in the frame's local coordinates; `close` joins its end to its start.
pub(super) fn path_data(
    frame: &Frame,
    segments: impl IntoIterator<Item = Segment>,
    close: bool,
) -> String {
    data_of_runs(&frame.runs(segments, close), close)
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
