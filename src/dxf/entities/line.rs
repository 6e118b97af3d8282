//! LINE.

use crate::drawing::{Geometry, Kind};
use crate::dxf::entity::{Read, Refused};
use crate::dxf::layers::Layers;
use crate::dxf::lexer::{Lexer, Tag};
use crate::dxf::numbers::Numbers;
use crate::dxf::shape::Shape;
use crate::dxf::space::{Lies, Vector3};
use crate::geometry::Point;

pub(super) fn line(start: Tag, lexer: &mut Lexer, layers: &mut Layers) -> Result<Read, Refused> {
    let mut numbers = Numbers::new([10, 20, 11, 21, 30, 31]);
    let common = numbers.gather(lexer, |_, _| {});
    let [x, y, end_x, end_y] = numbers.required(start, lexer, &common)?;
    // The ends of a LINE are world coordinates: its extrusion only gives the direction of its thickness.
    common.is_in_the_model()?;
    let (low, high) = (
        numbers.values[4].unwrap_or(0.0),
        numbers.values[5].unwrap_or(0.0),
    );
    if low != high {
        let sentence = say!(the_ends_of_this_line_differ_in_z).to_owned();
        lexer.remark(start.value_line(), sentence);
    }
    let geometry = Geometry::Line {
        start: Point::new(x, y),
        end: Point::new(end_x, end_y),
    };
    let lies = match low == high {
        true => Lies::Level(low),
        false => Lies::Rising(Box::new([
            Vector3::new(x, y, low),
            Vector3::new(end_x, end_y, high),
        ])),
    };
    Ok(common.finish(lexer, layers, Kind::Line, (Shape::Plain(geometry), lies)))
}
