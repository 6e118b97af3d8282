//! New tags and records in the style of their neighbours: the padding of group codes, the line ends, the common tags.

use super::lexer::Tag;
use super::lines::Lines;
use super::number::{self, Number, written};
use super::place::own_tags;
use crate::drawing::Geometry;
use crate::geometry::positive_angle;
use crate::text::{SourceText, WIDEST_COLUMN};
use std::ops::Range;

/// Decimals of lengths and of angles in degrees.
pub(super) const DECIMALS: usize = 12;

/// Tags that a new entity copies from the one before it: owner, layout, layer, line type, colour, line weight.
const HANDED_ON: [i16; 9] = [330, 410, 8, 6, 62, 420, 440, 370, 48];

/// How tags are written in one place of a text.
#[derive(Clone, Debug)]
pub(super) struct Style {
    /// Width to which group codes are padded with spaces on the left.
    width: usize,
    line_end: Vec<u8>,
}

impl Style {
    /// The style of the tag whose code stands on `line`.
    pub(super) fn of(text: &SourceText, lines: Lines, line: usize) -> Style {
        let (whole, code) = (lines.range(line), lines.trimmed_range(line));
        let next = text.line_start(line + 1);
        let width = (code.end - whole.start).min(WIDEST_COLUMN);
        Style {
            width,
            line_end: text.slice(whole.end..next).unwrap_or_default().to_vec(),
        }
    }

    pub(super) fn tag(&self, code: i16, value: &[u8], into: &mut Vec<u8>) {
        into.extend_from_slice(format!("{code:>width$}", width = self.width).as_bytes());
        into.extend_from_slice(&self.line_end);
        into.extend_from_slice(value);
        into.extend_from_slice(&self.line_end);
    }

    pub(super) fn number(&self, code: i16, value: f64, decimals: usize, into: &mut Vec<u8>) {
        self.tag(code, written(value, decimals).as_bytes(), into);
    }

    /// `record` as it must be inserted at `at`: after a last line without a line end, that end comes first.
    pub(super) fn inserted(&self, text: &SourceText, at: usize, record: Vec<u8>) -> String {
        let is_cut = at >= text.len()
            && !matches!(text.byte(text.len().wrapping_sub(1)), Some(b'\n' | b'\r'));
        let before = if is_cut { &self.line_end[..] } else { &[] };
        String::from_utf8_lossy(&[before, &record].concat()).into_owned()
    }
}

/// The record of a new LINE or ARC, modelled on the entity whose lines are `model`; `handle` where that one has a
/// handle. An error for other geometry and for numbers that are not finite.
pub(super) fn new_entity(
    text: &SourceText,
    lines: Lines,
    model: Range<usize>,
    mirrored: bool,
    handle: Option<&str>,
    geometry: &Geometry,
) -> Result<Vec<u8>, String> {
    let style = Style::of(text, lines, model.start);
    let tags: Vec<Tag> = own_tags(lines, model.clone()).collect();
    let name = lines.trimmed(model.start + 1);
    let marked = tags.iter().any(|tag| tag.code == 100);
    let height_code = if name == b"LWPOLYLINE" { 38 } else { 30 };
    let height = tags
        .iter()
        .rfind(|tag| tag.code == height_code && !mirrored)
        .and_then(
            |tag| match number::number(lines.content(tag.value_line())) {
                Number::Exact(z) => Some(z),
                _ => None,
            },
        );
    let height = height.or(marked.then_some(0.0));
    if !geometry.is_sound() {
        return Err(say!(a_number_of_the_new_entity_does_not_fit).into());
    }
    let mut record = Vec::new();
    let begin = |kind: &[u8], class: &[u8], record: &mut Vec<u8>| {
        style.tag(0, kind, record);
        if let Some(handle) = handle {
            style.tag(5, handle.as_bytes(), record);
        }
        let (owner, rest): (Vec<&Tag>, Vec<&Tag>) = tags
            .iter()
            .filter(|tag| HANDED_ON.contains(&tag.code))
            .partition(|tag| tag.code == 330);
        let copy = |tags: Vec<&Tag>, record: &mut Vec<u8>| {
            tags.iter()
                .for_each(|tag| style.tag(tag.code, lines.content(tag.value_line()), record));
        };
        copy(owner, record);
        if marked {
            style.tag(100, b"AcDbEntity", record);
        }
        copy(rest, record);
        if marked {
            style.tag(100, class, record);
        }
    };
    let point = |at: crate::geometry::Point, code: i16, record: &mut Vec<u8>| {
        style.number(code, at.x, DECIMALS, record);
        style.number(code + 10, at.y, DECIMALS, record);
        if let Some(height) = height {
            style.number(code + 20, height, DECIMALS, record);
        }
    };
    match geometry {
        Geometry::Line { start, end } => {
            begin(b"LINE", b"AcDbLine", &mut record);
            point(*start, 10, &mut record);
            point(*end, 11, &mut record);
        }
        Geometry::Arc {
            center,
            radius,
            start_angle,
            end_angle,
        } => {
            begin(b"ARC", b"AcDbCircle", &mut record);
            point(*center, 10, &mut record);
            style.number(40, *radius, DECIMALS, &mut record);
            if marked {
                style.tag(100, b"AcDbArc", &mut record);
            }
            style.number(50, degrees(*start_angle), DECIMALS, &mut record);
            style.number(51, degrees(*end_angle), DECIMALS, &mut record);
        }
        _ => return Err(say!(only_a_line_or_an_arc_can_be_added_to_dxf).into()),
    }
    Ok(record)
}

/// An angle in [0°, 360°) as it is written: 359.9999999999999 would be written as 360.
pub(super) fn degrees(angle: f64) -> f64 {
    let degrees = positive_angle(angle).to_degrees();
    if written(degrees, DECIMALS) == "360.0" {
        0.0
    } else {
        degrees
    }
}

/// One above the largest number that may be a handle in the text (group codes 5 and 105, `$HANDSEED` included); `None`
/// where there is none left.
pub(super) fn free_handle(lines: Lines) -> Option<u64> {
    let handle = |line: usize| {
        let is_code = matches!(lines.trimmed(line), b"5" | b"105");
        let value = is_code
            .then(|| lines.trimmed(line + 1))
            .filter(|value| value.len() <= 16)?;
        u64::from_str_radix(std::str::from_utf8(value).ok()?, 16).ok()
    };
    (0..lines.count().saturating_sub(1))
        .filter_map(handle)
        .max()
        .unwrap_or(0)
        .checked_add(1)
}
