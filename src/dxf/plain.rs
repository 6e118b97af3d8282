//! LINE, ARC and CIRCLE in their common form: every tag sound and known, read in one pass over the bytes.
//!
//! The result equals that of [`super::entities::read`]; anything that needs a finding is left to it.

use super::entity::{Appearance, Paint, Read, Stroke};
use super::layers::Layers;
use super::lines::Lines;
use super::number;
use super::shape::Shape;
use super::space::Lies;
use crate::drawing::{Color, Geometry, Handle, Kind};
use crate::geometry::{Point, radians_of_arc};

/// Numbers by their place in the record: x, y, z; the second x, y, z; radius; first and last angle.
const CODES: [i16; 9] = [10, 20, 30, 11, 21, 31, 40, 50, 51];

/// The entity whose record begins at `line`, and the line of the next record. `None` where it needs the full reader.
pub(super) fn read(lines: Lines, line: usize, layers: &mut Layers) -> Option<(Read, usize)> {
    let at = lines.range(line + 1).start;
    let (bytes, begin) = lines.piece_at(at);
    let mut at = at - begin;
    let begins = |kind: &Kind| {
        bytes
            .get(at..)
            .is_some_and(|rest| rest.starts_with(kind.name().as_bytes()))
    };
    let kind = [Kind::Line, Kind::Arc, Kind::Circle]
        .into_iter()
        .find(begins)?;
    at = behind_line_end(bytes, at + kind.name().len())?;
    let mut next = line + 2;
    let mut values = [None; CODES.len()];
    let (mut handle, mut layer, mut paint) = (None, &b"0"[..], Paint::ByLayer);
    let mut linetype = &b"BYLAYER"[..];
    loop {
        let (code, value_at) = code(bytes, at)?;
        if code == 0 {
            bytes
                .get(value_at)
                .filter(|byte| byte.is_ascii_uppercase())?;
            break;
        }
        let mut known = CODES.iter().zip(&mut values);
        if let Some((_, own)) = known.find(|(known, _)| **known == code) {
            let (value, length) = number::leading(bytes.get(value_at..)?)?;
            *own = Some(value);
            at = behind_line_end(bytes, value_at + length)?;
        } else {
            let value = lines.content(next + 1);
            match code {
                5 => handle = Some((plain_handle(value)?, next + 1)),
                6 => linetype = unpadded(value)?,
                8 => layer = unpadded(value)?,
                62 => paint = plain_paint(value)?,
                // Thickness, line type scale, class, owner, line weight: they draw nothing.
                39 | 48 | 100 | 330 | 370 => {}
                _ => return None,
            }
            at = behind_line_end(bytes, value_at + value.len())?;
        }
        next += 2;
    }
    let [x, y, z, end_x, end_y, end_z, radius, from, to] = values;
    let center = Point::new(x?, y?);
    let height = z.unwrap_or(0.0);
    let geometry = match kind {
        // A differing z needs a finding.
        Kind::Line if height != end_z.unwrap_or(0.0) => return None,
        Kind::Line => Geometry::Line {
            start: center,
            end: Point::new(end_x?, end_y?),
        },
        _ if radius? <= 0.0 => return None,
        Kind::Circle => Geometry::Circle {
            center,
            radius: radius?,
        },
        _ => {
            let (start_angle, end_angle) = radians_of_arc(from?, to?);
            Geometry::Arc {
                center,
                radius: radius?,
                start_angle,
                end_angle,
            }
        }
    };
    let read = Read {
        handle,
        layer: layers.name(layer),
        appearance: Appearance {
            paint,
            stroke: Stroke::of(linetype, layers),
            invisible: false,
            marks: None,
        },
        kind,
        shape: Shape::Plain(geometry),
        lies: Lies::Level(height),
        vertices: None,
        frames: Vec::new(),
    };
    Some((read, next))
}

/// A group code without a sign, and where its value begins.
fn code(bytes: &[u8], mut at: usize) -> Option<(i16, usize)> {
    while let Some(b' ') = bytes.get(at) {
        at += 1;
    }
    let (mut code, first) = (0, at);
    while let Some(digit) = bytes
        .get(at)
        .map(|byte| byte.wrapping_sub(b'0'))
        .filter(|&digit| digit < 10)
    {
        code = code * 10 + i16::from(digit);
        at += 1;
        if at - first > 3 {
            return None;
        }
    }
    if at == first {
        None
    } else {
        Some((code, behind_line_end(bytes, at)?))
    }
}

/// Where the next line begins, when a line ends at `at`.
fn behind_line_end(bytes: &[u8], at: usize) -> Option<usize> {
    match (bytes.get(at)?, bytes.get(at + 1)) {
        (b'\r', Some(b'\n')) => Some(at + 2),
        (b'\n' | b'\r', _) => Some(at + 1),
        _ => None,
    }
}

/// A value that has no padding.
fn unpadded(value: &[u8]) -> Option<&[u8]> {
    let is_padding = |byte: Option<&u8>| matches!(byte, None | Some(b' ' | b'\t'));
    (!is_padding(value.first()) && !is_padding(value.last())).then_some(value)
}

fn plain_handle(value: &[u8]) -> Option<Handle> {
    let is_plain = value.len() <= 16
        && value.iter().all(u8::is_ascii_hexdigit)
        && value.iter().any(|&digit| digit != b'0');
    Some(Handle::new(
        std::str::from_utf8(value).ok().filter(|_| is_plain)?,
    ))
}

/// A colour by its number in the index.
fn plain_paint(value: &[u8]) -> Option<Paint> {
    let (number, length) = number::leading(value)?;
    match number as u16 {
        _ if length != value.len() || !value.iter().all(u8::is_ascii_digit) => None,
        index @ 1..=255 => Some(Paint::Own(Color::Index(index as u8))),
        256 => Some(Paint::ByLayer),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::dxf::entities;
    use crate::dxf::entity::Outcome;
    use crate::dxf::layers::Layers;
    use crate::dxf::lexer::Lexer;
    use crate::dxf::lines::Lines;
    use crate::text::SourceText;
    use proptest::prelude::*;

    /// Lines of a record that are mostly sound.
    fn record() -> impl Strategy<Value = String> {
        let code = prop::sample::select(vec![
            "  0", "5", "8", "62", "10", " 20", "30", "11", "21", "31", "40", "50", "51", "100",
            "330", "6", "370", "102", "210", "230", "67", "60", "420", "1001", "-5", "x",
        ]);
        let value = prop::sample::select(vec![
            "0",
            "1",
            "2.5",
            "-3.25",
            "+1",
            "7.125000000",
            "12345678.123456789",
            "1e2",
            "0.1234567890123456789",
            " 4",
            "5 ",
            "-0",
            ".",
            "LINE",
            "2A",
            "00",
            "{X",
            "DIE",
            "1",
            "256",
            "300",
            "",
        ]);
        let end = prop::sample::select(vec!["\n", "\n", "\n", "\r\n", "\r"]);
        let tag = (code, value, end.clone())
            .prop_map(|(code, value, end)| format!("{code}{end}{value}{end}"));
        let sound = |kind: &str| {
            let tags = match kind {
                "LINE" => "5\n2A\n8\nDIE\n10\n1\n20\n2\n11\n3\n21\n4\n",
                "ARC" => "5\n2B\n8\nDIE\n10\n1\n20\n2\n40\n3.5\n50\n10\n51\n200\n",
                _ => "8\nDIE\n10\n1\n20\n2\n40\n3.5\n",
            };
            format!("0\n{kind}\n{tags}")
        };
        let kind = prop::sample::select(vec!["LINE", "ARC", "CIRCLE", "LINES"]);
        (kind, prop::collection::vec(tag, 0..3))
            .prop_map(move |(kind, tags)| sound(kind) + &tags.concat() + "0\nENDSEC\n0\nEOF\n")
    }

    proptest! {
        #[test]
        fn what_is_read_in_one_pass_is_what_a_closer_look_finds(text in record()) {
            let text = SourceText::new(text.into_bytes());
            let lines = Lines::new(&text);
            let Some((read, next)) = super::read(lines, 0, &mut Layers::default()) else { return Ok(()) };
            let mut lexer = Lexer::new(lines, 0);
            let start = lexer.peek_record().expect("a record begins");
            lexer.pass(start);
            let looked = entities::read_closely(start, &mut lexer, &mut Layers::default());
            let Outcome::Entity(looked) = looked else { panic!("{looked:?} {:?}", lexer.findings) };
            prop_assert!(lexer.findings.is_empty(), "{:?}", lexer.findings);
            prop_assert_eq!((format!("{read:?}"), next), (format!("{looked:?}"), lexer.at()));
        }
    }
}
