//! Translates AutoCAD DXB, the small binary drawing format of plotters and digitisers, to the equivalent DXF text.
//!
//! Source: DXF reference, release 12, "Binary Drawing Interchange (DXB) Files". It holds lines, arcs, circles, points,
//! polylines and filled areas, layers and colours, but no unit and no handles.

use super::number::written;
use std::io::Write as _;

/// The first bytes of a DXB file.
pub(super) const SENTINEL: &[u8] = b"AutoCAD DXB 1.0\r\n\x1a\0";

/// Decimals of coordinates; those of the file are integers times a scale, or double precision.
const DECIMALS: usize = 12;
/// Integer angles are millionths of a degree, integer bulges have 16 binary places.
const ANGLE_STEPS: f64 = 1e6;
const BULGE_STEPS: f64 = 65536.0;

/// The file as text; and the fault, where it breaks off. The part before that is kept.
pub(super) fn to_text(bytes: &[u8]) -> (Vec<u8>, Option<String>) {
    let at = SENTINEL.len().min(bytes.len());
    let mut reader = Reader {
        bytes,
        at,
        floats: false,
        scale: 1.0,
        layer: b"0".to_vec(),
        color: 256,
        last: [0.0; 3],
        open: false,
    };
    let mut text = b"0\nSECTION\n2\nENTITIES\n".to_vec();
    let fault = loop {
        let begins_at = reader.at;
        let mark = text.len();
        match reader.item(&mut text) {
            Ok(true) => {}
            Ok(false) => break None,
            Err(sentence) => {
                text.truncate(mark);
                break Some(say!(in_byte, begins_at, sentence));
            }
        }
    };
    if reader.open {
        text.extend_from_slice(b"0\nSEQEND\n");
    }
    text.extend_from_slice(b"0\nENDSEC\n0\nEOF\n");
    (text, fault)
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Numbers are of double precision, not integers.
    floats: bool,
    /// The scale of integer coordinates.
    scale: f64,
    layer: Vec<u8>,
    color: i16,
    /// The end of the last line, where an extension goes on.
    last: [f64; 3],
    /// Within a polyline.
    open: bool,
}

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let taken = self
            .bytes
            .get(self.at..)
            .and_then(|rest| rest.first_chunk::<N>())
            .ok_or(say!(the_file_ends_inside_an_item))?;
        self.at += N;
        Ok(*taken)
    }

    fn word(&mut self) -> Result<i16, String> {
        self.take().map(i16::from_le_bytes)
    }

    fn float(&mut self) -> Result<f64, String> {
        let value = self.take().map(f64::from_le_bytes)?;
        if value.is_finite() {
            Ok(value)
        } else {
            Err(say!(a_number_is_not_finite, value))
        }
    }

    /// A coordinate or a length.
    fn length(&mut self) -> Result<f64, String> {
        if self.floats {
            self.float()
        } else {
            Ok(f64::from(self.word()?) * self.scale)
        }
    }

    /// A number; an integer counts `steps` to one and is not scaled.
    fn fraction(&mut self, steps: f64) -> Result<f64, String> {
        if self.floats {
            self.float()
        } else {
            Ok(f64::from(self.take().map(i32::from_le_bytes)?) / steps)
        }
    }

    fn lengths<const N: usize>(&mut self) -> Result<[f64; N], String> {
        let mut lengths = [0.0; N];
        for length in &mut lengths {
            *length = self.length()?;
        }
        Ok(lengths)
    }

    /// Writes the record of one item; false at the end of the file. An error says why reading cannot go on.
    fn item(&mut self, text: &mut Vec<u8>) -> Result<bool, String> {
        let Ok([kind]) = self.take::<1>() else {
            return Err(say!(the_file_ends_without_its_end_mark).into());
        };
        if self.open && !matches!(kind, 17 | 20 | 128..=136) {
            self.open = false;
            text.extend_from_slice(b"0\nSEQEND\n");
        }
        match kind {
            0 => return Ok(false),
            1 | 21 => {
                let [x, y, z, end_x, end_y, end_z] = self.lengths()?;
                self.line([x, y, z], [end_x, end_y, end_z], text);
            }
            2 => {
                let [x, y] = self.lengths()?;
                self.record("POINT", &[(10, x), (20, y)], text);
            }
            3 => {
                let [x, y, radius] = self.lengths()?;
                self.record("CIRCLE", &[(10, x), (20, y), (40, radius)], text);
            }
            8 => {
                let [x, y, radius] = self.lengths()?;
                let (from, to) = (self.fraction(ANGLE_STEPS)?, self.fraction(ANGLE_STEPS)?);
                self.record(
                    "ARC",
                    &[(10, x), (20, y), (40, radius), (50, from), (51, to)],
                    text,
                );
            }
            9 | 11 => {
                let [x, y, ..] = self.lengths::<8>()?;
                self.record(
                    if kind == 9 { "TRACE" } else { "SOLID" },
                    &[(10, x), (20, y)],
                    text,
                );
            }
            17 => {
                if std::mem::take(&mut self.open) {
                    text.extend_from_slice(b"0\nSEQEND\n");
                }
            }
            19 => {
                let closed = self.word()? != 0;
                self.record("POLYLINE", &[], text);
                tag(66, b"1", text);
                tag(70, if closed { b"1" } else { b"0" }, text);
                self.open = true;
            }
            20 => {
                let [x, y] = self.lengths()?;
                self.record("VERTEX", &[(10, x), (20, y)], text);
            }
            22 => {
                let [x, y, ..] = self.lengths::<12>()?;
                self.record("3DFACE", &[(10, x), (20, y)], text);
            }
            128 => self.scale = self.float()?,
            129 => {
                let rest = self.bytes.get(self.at..).unwrap_or_default();
                let end = memchr::memchr(0, rest)
                    .ok_or(say!(the_file_ends_inside_the_name_of_a_layer))?;
                self.layer = rest
                    .iter()
                    .take(end)
                    .map(|&byte| if byte < b' ' { b'?' } else { byte })
                    .collect();
                self.at += end + 1;
            }
            130 => {
                let [x, y] = self.lengths()?;
                self.line(self.last, [x, y, self.last[2]], text);
            }
            131 => {
                let [x, y, ..] = self.lengths::<4>()?;
                self.record("TRACE", &[(10, x), (20, y)], text);
            }
            // The base of the block that DXBIN would make: the drawing is read in place.
            132 => drop(self.lengths::<2>()?),
            133 => {
                let bulge = self.fraction(BULGE_STEPS)?;
                if self.open {
                    number(42, bulge, text);
                }
            }
            134 => drop(self.lengths::<2>()?),
            135 => self.floats = self.word()? != 0,
            136 => self.color = self.word()?,
            137 => {
                let to = self.lengths()?;
                self.line(self.last, to, text);
            }
            other => {
                return Err(say!(item_type_is_not_known, other));
            }
        }
        Ok(true)
    }

    fn line(&mut self, from: [f64; 3], to: [f64; 3], text: &mut Vec<u8>) {
        self.last = to;
        let ([x, y, z], [end_x, end_y, end_z]) = (from, to);
        self.record(
            "LINE",
            &[
                (10, x),
                (20, y),
                (30, z),
                (11, end_x),
                (21, end_y),
                (31, end_z),
            ],
            text,
        );
    }

    fn record(&self, name: &str, numbers: &[(i16, f64)], text: &mut Vec<u8>) {
        tag(0, name.as_bytes(), text);
        tag(8, &self.layer, text);
        if self.color != 256 {
            tag(62, self.color.to_string().as_bytes(), text);
        }
        for &(code, value) in numbers {
            number(code, value, text);
        }
    }
}

fn number(code: i16, value: f64, text: &mut Vec<u8>) {
    tag(code, written(value, DECIMALS).as_bytes(), text);
}

fn tag(code: i16, value: &[u8], text: &mut Vec<u8>) {
    let _ = writeln!(text, "{code}");
    text.extend_from_slice(value);
    text.push(b'\n');
}

#[cfg(test)]
mod tests {
    use super::super::tests::reading::entities;
    use super::*;
    use crate::dxf::Document;

    /// Items as bytes: `b` one, `w` two, `l` four, `d` a double, a text in quotes with its end.
    fn file(items: &str) -> Vec<u8> {
        let mut bytes = SENTINEL.to_vec();
        for item in items.split_whitespace() {
            let (kind, value) = item.split_at(1);
            match kind {
                "b" => bytes.push(value.parse().unwrap()),
                "w" => bytes.extend(value.parse::<i16>().unwrap().to_le_bytes()),
                "l" => bytes.extend(value.parse::<i32>().unwrap().to_le_bytes()),
                "d" => bytes.extend(value.parse::<f64>().unwrap().to_le_bytes()),
                _ => bytes.extend(value.bytes().chain([0])),
            }
        }
        bytes
    }

    fn check(items: &str, expected: &[&str], fault: Option<&str>) {
        let document = Document::read_file(file(items));
        assert!(document.is_binary());
        assert_eq!(entities(&document), expected, "{items}");
        assert_eq!(to_text(&file(items)).1.as_deref(), fault, "{items}");
    }

    #[test]
    fn integers_are_scaled_and_floats_are_not() {
        check(
            "b128 d0.001 b1 w0 w0 w0 w5000 w0 w0 b130 w5000 w2500 b135 w1 b3 d1.5 d2.5 d0.25 b0",
            &[
                "LINE #1 on 0: 0 0 to 5 0",
                "LINE #2 on 0: 5 0 to 5 2.5",
                "CIRCLE #3 on 0: 1.5 2.5 R0.25",
            ],
            None,
        );
    }

    #[test]
    fn angles_bulges_and_words_have_no_scale() {
        check(
            "b128 d0.5 b8 w2 w4 w6 l30000000 l90000000 b19 w1 b20 w0 w0 b133 l-32768 b20 w20 w0 b134 w0 w0 b20 w20 w10 b17 b2 w2 w2 b0",
            &[
                "ARC #1 on 0: 1 2 R3 30 90",
                "POLYLINE #2 on 0: 0 0 -0.5, 10 0 0, 10 5 0 closed",
                "POINT #3 on 0: 1 1 O",
            ],
            None,
        );
    }

    #[test]
    fn layers_colours_and_what_is_not_cut() {
        check(
            "b129 'DIE b136 w1 b3 w0 w0 w5 b9 w0 w0 w1 w0 w0 w1 w1 w1 b11 w0 w0 w1 w0 w0 w1 w1 w1 b0",
            &["CIRCLE #1 on DIE: 0 0 R5"],
            None,
        );
        let document = Document::read_file(file(
            "b129 'DIE b136 w1 b3 w0 w0 w5 b22 w0 w0 w0 w0 w0 w0 w0 w0 w0 w0 w0 w0 b0",
        ));
        assert_eq!(
            document.drawing().color(document.drawing().order()[0]),
            Some(crate::drawing::Color::Index(1))
        );
        assert_eq!(
            document.findings().len(),
            2,
            "no unit, and a 3DFACE: {:?}",
            document.findings()
        );
    }

    #[test]
    fn what_breaks_off_keeps_what_came_before() {
        let circle = "CIRCLE #1 on 0: 1 1 R5";
        check(
            "b3 w1 w1 w5 b3 w1",
            &[circle],
            Some("byte 26: the file ends inside an item"),
        );
        check(
            "b3 w1 w1 w5",
            &[circle],
            Some("byte 26: the file ends without its end mark"),
        );
        check(
            "b3 w1 w1 w5 b77 w1 w1",
            &[circle],
            Some("byte 26: item type 77 is not known, so its length is not"),
        );
        check(
            "b3 w1 w1 w5 b135 w1 b3 dinf d0 d1 b0",
            &[circle],
            Some("byte 29: a number is inf, expected a finite one"),
        );
        check(
            "b3 w1 w1 w5 b129",
            &[circle],
            Some("byte 26: the file ends inside the name of a layer"),
        );
    }
}
