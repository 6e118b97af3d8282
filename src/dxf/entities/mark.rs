//! TEXT, MTEXT and POINT: they may mark where a cut starts.

use crate::drawing::{Geometry, Kind};
use crate::dxf::entity::{Plane, Read, Refused};
use crate::dxf::frame;
use crate::dxf::layers::Layers;
use crate::dxf::lexer::{Lexer, Tag};
use crate::dxf::numbers::Numbers;
use crate::dxf::shape::Shape;
use crate::dxf::space::{Lies, Space, Vector3};
use crate::dxf::strings::{words_of_mtext, words_of_text};
use crate::geometry::Point;

pub(super) fn text(
    kind: Kind,
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
) -> Result<Read, Refused> {
    let mut content = Vec::new();
    let mut numbers = Numbers::new([10, 20, 11, 21, 30]);
    let mut is_aligned = false;
    let common = numbers.gather(lexer, |lexer, tag| match tag.code {
        1 | 3 => content.extend_from_slice(lexer.lines.content(tag.value_line())),
        // Aligned right, middle or above a line: the user has set the second point.
        72 if kind == Kind::Text => {
            is_aligned |= matches!(lexer.lines.trimmed(tag.value_line()), b"1" | b"2" | b"4")
        }
        73 if kind == Kind::Text => {
            is_aligned |= matches!(lexer.lines.trimmed(tag.value_line()), b"1" | b"2" | b"3")
        }
        _ => {}
    });
    let [x, y] = numbers.required(start, lexer, &common)?;
    let [_, _, set_x, set_y, height] = numbers.values;
    let (x, y) = match (set_x, set_y) {
        (Some(x), Some(y)) if is_aligned => (x, y),
        _ => (x, y),
    };
    common.is_in_the_model()?;
    let height = height.unwrap_or(0.0);
    let lies = common.lies(height)?;
    let (x, y, lies) = match (kind, lies) {
        // The place of an MTEXT is in world coordinates.
        (Kind::LongText, Lies::Aslant(system, why)) => (
            0.0,
            0.0,
            Lies::Aslant(
                Box::new(Space {
                    origin: Vector3::new(x, y, height),
                    ..*system
                }),
                why,
            ),
        ),
        (Kind::LongText, _) => (x, y, Lies::Level(height)),
        (_, lies) => (
            if common.plane() == Plane::Mirrored {
                0.0 - x
            } else {
                x
            },
            y,
            lies,
        ),
    };
    let content = layers.text(&content);
    let words = if kind == Kind::LongText {
        words_of_mtext(&content)
    } else {
        words_of_text(&content)
    };
    let geometry = Geometry::Text {
        at: Point::new(x, y),
        text: words.trim().to_owned(),
    };
    let frames = if kind == Kind::LongText {
        frame::handles(lexer.lines, start.line..lexer.at())
    } else {
        Vec::new()
    };
    let read = common.finish(lexer, layers, kind, (Shape::Plain(geometry), lies));
    Ok(Read { frames, ..read })
}

/// A POINT marks a start just as the text "O" does. Its place is in world coordinates.
pub(super) fn point(start: Tag, lexer: &mut Lexer, layers: &mut Layers) -> Result<Read, Refused> {
    let mut numbers = Numbers::new([10, 20, 30]);
    let common = numbers.gather(lexer, |_, _| {});
    let [x, y] = numbers.required(start, lexer, &common)?;
    common.is_in_the_model()?;
    let geometry = Geometry::mark(Point::new(x, y));
    let lies = Lies::Level(numbers.values[2].unwrap_or(0.0));
    Ok(common.finish(lexer, layers, Kind::Point, (Shape::Plain(geometry), lies)))
}
