//! The window that enlarges one place, in a row of them below the figure, and the text below it.

use super::numbers::number;
use super::sheet::{Frame, MARGIN, SHEET_WIDTH, Sheet, escaped};
use crate::geometry::Point;

/// The gap between neighbours in a row.
const GAP: f64 = 16.0;

/// The windows of a picture: the number in a row, and the height of each and of the text below it.
pub(super) struct Windows {
    pub(super) columns: usize,
    pub(super) height: f64,
    pub(super) caption: f64,
}

/// One of them, by its upper left corner.
pub(super) struct Window {
    index: usize,
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Windows {
    pub(super) const fn width(&self) -> f64 {
        let columns = self.columns as f64;
        (SHEET_WIDTH - 2.0 * MARGIN - GAP * (columns - 1.0)) / columns
    }

    /// The height of the rows for this many windows.
    pub(super) fn height_of(&self, count: usize) -> f64 {
        count.div_ceil(self.columns) as f64 * (self.height + self.caption)
    }

    /// The window with this index, from 0, where the first row begins at `top`.
    pub(super) fn at(&self, index: usize, top: f64) -> Window {
        let [column, row] = [index % self.columns, index / self.columns].map(|place| place as f64);
        Window {
            index,
            left: MARGIN + column * (self.width() + GAP),
            top: top + row * (self.height + self.caption),
            width: self.width(),
            height: self.height,
        }
    }
}

impl Window {
    /// The right end of its lower edge.
    pub(super) fn lower_right(&self) -> (f64, f64) {
        (self.left + self.width, self.top + self.height)
    }

    /// The frame with `middle` at the centre of the window, at a scale; coordinates are relative to
    /// `middle`.
    pub(super) fn frame(&self, middle: Point, scale: f64) -> Frame {
        Frame {
            origin: middle,
            scale,
            left: self.left + self.width / 2.0,
            bottom: self.top + self.height / 2.0,
        }
    }

    /// Opens an element with these attributes, and in it the drawing, clipped at the edge by a path
    /// named `clip`. `ground` is the class of the background.
    pub(super) fn open(
        &self,
        sheet: &mut Sheet,
        attributes: &str,
        clip: &str,
        ground: &str,
        frame: &Frame,
    ) {
        let (index, rectangle, opening) = (self.index, self.rectangle(), frame.opening());
        sheet.line(format_args!(
            r##"<g {attributes}>
<clipPath id="{clip}{index}"><rect {rectangle}/></clipPath>
<g clip-path="url(#{clip}{index})">
<rect class="{ground}" {rectangle}/>
{opening}"##
        ));
    }

    /// Ends the drawing and the element; below it come its number, figures and their place.
    pub(super) fn close(&self, sheet: &mut Sheet, figures: &str, place: &str) {
        let rectangle = self.rectangle();
        sheet.line(format_args!(
            r#"</g></g><rect class="window" {rectangle}/>"#
        ));
        let (left, bottom) = (self.left, self.top + self.height);
        sheet.circle(r#"class="badge""#, (left + 10.0, bottom + 20.0), 9.0, "");
        let [badge, x, y, first, second] = [
            left + 10.0,
            left + 26.0,
            bottom + 24.0,
            bottom + 18.0,
            bottom + 34.0,
        ]
        .map(number);
        let (count, figures, place) = (self.index + 1, escaped(figures), escaped(place));
        sheet.line(format_args!(
            r#"<text class="count" x="{badge}" y="{y}">{count}</text><text class="figures" x="{x}" y="{first}">{figures}</text><text class="place" x="{x}" y="{second}">{place}</text>"#
        ));
        sheet.line(format_args!("</g>"));
    }

    fn rectangle(&self) -> String {
        let [x, y, width, height] = [self.left, self.top, self.width, self.height].map(number);
        format!(r#"x="{x}" y="{y}" width="{width}" height="{height}" rx="6""#)
    }
}
