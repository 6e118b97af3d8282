//! Geometry as SVG path data, and how numbers and texts are written.

use crate::geometry::{Point, Segment};
use std::f64::consts::PI;
use std::fmt::Write;

/// Where on the sheet a part of the drawing is shown, and how large.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// The point of the drawing at (`left`, `bottom`) of the sheet.
    pub origin: Point,
    /// Sheet units in one drawing unit.
    pub scale: f64,
    pub left: f64,
    pub bottom: f64,
}

impl Frame {
    /// Opens the group in which y points up and [`Frame::local`] coordinates hold.
    pub fn opening(&self) -> String {
        format!(
            r#"<g transform="matrix(1 0 0 -1 {} {})">"#,
            number(self.left),
            number(self.bottom)
        )
    }

    /// The same for the drawing itself, with what turns coordinates within the group into the drawing's:
    /// `data-origin` + local / `data-scale`, of which one is `data-unit-mm` millimetres.
    pub fn opening_of_drawing(&self, unit_mm: f64) -> String {
        format!(
            r#"<g class="drawing" transform="matrix(1 0 0 -1 {} {})" data-origin="{:?} {:?}" data-scale="{:?}" data-unit-mm="{unit_mm:?}">"#,
            number(self.left),
            number(self.bottom),
            self.origin.x,
            self.origin.y,
            self.scale
        )
    }

    /// Coordinates within the group, y up.
    pub fn local(&self, point: Point) -> (f64, f64) {
        let shifted = (point - self.origin) * self.scale;
        (shifted.x, shifted.y)
    }

    /// Coordinates on the sheet, y down, where text is written.
    pub fn on_sheet(&self, point: Point) -> (f64, f64) {
        let (x, y) = self.local(point);
        (self.left + x, self.bottom - y)
    }
}

/// The segments as one path, in the frame's local coordinates; `close` joins its end to its start.
///
/// An arc is split into pieces of less than a half turn, so that a full circle is drawn, and so that no viewer has
/// to guess which of two arcs is meant.
pub(super) fn path_data(
    frame: &Frame,
    segments: impl IntoIterator<Item = Segment>,
    close: bool,
) -> String {
    let mut data = String::new();
    let mut pen = String::new();
    for segment in segments {
        let start = pair(frame, segment.start());
        if pen.is_empty() {
            let _ = write!(data, "M{start}");
        } else if pen != start {
            let _ = write!(data, "L{start}");
        }
        pen = match segment {
            Segment::Line(line) => {
                let end = pair(frame, line.end);
                let _ = write!(data, "L{end}");
                end
            }
            Segment::Arc(arc) => {
                let pieces = (arc.sweep.abs() / (0.9 * PI)).ceil().max(1.0);
                let radius = number(arc.radius * frame.scale);
                let direction = u8::from(arc.sweep > 0.0);
                for piece in 1..=pieces as u32 {
                    let end = pair(frame, arc.point_at(f64::from(piece) / pieces));
                    let _ = write!(data, "A{radius} {radius} 0 0 {direction} {end}");
                }
                pair(frame, arc.end)
            }
        };
    }
    if close && !data.is_empty() {
        data.push('Z');
    }
    data
}

fn pair(frame: &Frame, point: Point) -> String {
    let (x, y) = frame.local(point);
    format!("{} {}", number(x), number(y))
}

/// The attributes by which an element is found that stands for a segment.
pub(super) fn named(handle: &str, segment: usize) -> String {
    format!(
        r#"data-handle="{}" data-segment="{segment}""#,
        escaped(handle)
    )
}

/// At most three decimals, without trailing zeros and without a minus before zero.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" {
        "0".into()
    } else {
        short.into()
    }
}

/// Text for XML: markup characters replaced, characters that XML forbids left out.
pub(super) fn escaped(text: &str) -> String {
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
