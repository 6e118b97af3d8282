//! New circles and marks on a layer of their own, put into the text of a drawing, of which everything else stays.

use super::Document;
use super::lexer::{Lexer, Tag};
use super::lines::Lines;
use super::number::{Number, number};
use super::place::own_tags;
use super::record::{self, DECIMALS, Style};
use crate::geometry::Point;
use crate::text::{TextEdit, edited};

/// What is added.
pub(crate) struct Added<'a> {
    pub(crate) layer: &'a str,
    pub(crate) places: &'a [Point],
    /// Of a circle at each place; `None` for the marks alone.
    pub(crate) radius: Option<f64>,
    /// Of the mark at each place.
    pub(crate) mark: &'a str,
    pub(crate) height: f64,
}

/// Where a text takes new records, and how its records are written.
#[derive(Default)]
struct Frame {
    /// The lines of the ENDSEC of the entities, and of the ENDTAB of the layers.
    entities_end: Option<usize>,
    layers_end: Option<usize>,
    /// The line of the value of `$HANDSEED`.
    seed: Option<usize>,
    /// The lines of the records of a layer and of an entity on which new ones are modelled.
    layer: Option<usize>,
    entity: Option<usize>,
    is_layer_there: bool,
    /// What lies on the layer.
    there: Vec<There>,
}

/// A circle or a text on the layer, from when the same was added before.
#[derive(Clone, Copy, Default)]
struct There {
    x: f64,
    y: f64,
    /// The radius of a circle, the height of a text.
    size: f64,
    is_circle: bool,
    is_on_layer: bool,
}

impl There {
    fn take(&mut self, code: i16, value: &[u8], layer: &str) {
        let number = match number(value) {
            Number::Exact(number) | Number::Blemished(number, _) => number,
            Number::Bad => f64::NAN,
        };
        match code {
            8 => self.is_on_layer = value.eq_ignore_ascii_case(layer.as_bytes()),
            10 => self.x = number,
            20 => self.y = number,
            40 => self.size = number,
            _ => {}
        }
    }

    fn is_at(&self, place: Point) -> bool {
        is_same(self.x, place.x) && is_same(self.y, place.y)
    }
}

/// Numbers of a drawing that mean one place.
fn is_same(one: f64, other: f64) -> bool {
    (one - other).abs() <= 1e-6
}

/// Tags of a layer's record that a new one takes over: owner, line weight, plot style, material.
const OF_LAYER: [i16; 4] = [330, 370, 390, 347];

impl Frame {
    fn of(lines: Lines, layer: &str) -> Frame {
        let mut frame = Frame::default();
        let (mut section, mut table): (&[u8], &[u8]) = (b"", b"");
        let mut lexer = Lexer::new(lines, 0);
        let mut before = None;
        let (mut record, mut is_seed): (&[u8], bool) = (b"", false);
        let mut there: Option<There> = None;
        while let Some(Tag { code, line }) = lexer.next() {
            let value = lines.trimmed(line + 1);
            match (code, value, record) {
                (0, b"ENDSEC", _) => {
                    if section == b"ENTITIES" {
                        frame.entities_end = Some(line);
                    }
                    section = b"";
                }
                (0, b"ENDTAB", _) => {
                    if table == b"LAYER" {
                        frame.layers_end = Some(line);
                    }
                    table = b"";
                }
                (0, b"LAYER", _) if table == b"LAYER" => frame.layer = Some(line),
                (0, b"VERTEX" | b"SEQEND" | b"ATTRIB", _) => {}
                (0, ..) if section == b"ENTITIES" => {
                    before = frame.entity.replace(line);
                }
                // Of paper space.
                (67, b"1", _) if section == b"ENTITIES" => frame.entity = before,
                (2, _, b"SECTION") => section = value,
                (2, _, b"TABLE") => table = value,
                (2, _, b"LAYER") if table == b"LAYER" => {
                    frame.is_layer_there |= value.eq_ignore_ascii_case(layer.as_bytes());
                }
                (9, ..) if section == b"HEADER" => is_seed = value == b"$HANDSEED",
                (5, ..) if is_seed => {
                    frame.seed = Some(line + 1);
                    is_seed = false;
                }
                _ => {}
            }
            match code {
                0 => {
                    frame.there.extend(there.take().filter(|it| it.is_on_layer));
                    let is_circle = value == b"CIRCLE";
                    if section == b"ENTITIES" && (is_circle || value == b"TEXT") {
                        there = Some(There {
                            is_circle,
                            ..There::default()
                        });
                    }
                    (record, is_seed) = (value, false);
                }
                _ => {
                    if let Some(there) = &mut there {
                        there.take(code, value, layer);
                    }
                }
            }
        }
        frame
    }
}

impl Document {
    /// The text with what is added and not there yet: the layer, and the entities, with handles that are free. Every other byte stays, except
    /// of the next free handle. `None` for a binary file, and for a text in which the end of its entities is not found.
    pub(crate) fn with_added(&self, added: &Added) -> Option<Vec<u8>> {
        if self.is_binary {
            return None;
        }
        let lines = Lines::new(&self.text);
        let frame = Frame::of(lines, added.layer);
        let at = self.text.line_start(frame.entities_end?);
        let of_record = |line: Option<usize>| -> Vec<Tag> {
            let tags = line.map(|line| own_tags(lines, line..lines.count()));
            tags.into_iter().flatten().collect()
        };
        let (of_layer, of_entity) = (of_record(frame.layer), of_record(frame.entity));
        let has = |tags: &[Tag], code: i16| tags.iter().any(|tag| tag.code == code);
        let mut free = record::free_handle(lines)?;
        let mut handle = || {
            let own = format!("{free:X}");
            free = free.saturating_add(1);
            own
        };
        let style = Style::of(&self.text, lines, frame.entities_end?);
        let mut edits = Vec::new();
        if let Some(end) = frame.layers_end.filter(|_| !frame.is_layer_there) {
            let mut layer = Vec::new();
            style.tag(0, b"LAYER", &mut layer);
            if has(&of_layer, 5) {
                style.tag(5, handle().as_bytes(), &mut layer);
            }
            let copy = |codes: &[i16], into: &mut Vec<u8>| {
                for tag in of_layer.iter().filter(|tag| codes.contains(&tag.code)) {
                    style.tag(tag.code, lines.content(tag.value_line()), into);
                }
            };
            copy(&OF_LAYER[..1], &mut layer);
            if has(&of_layer, 100) {
                style.tag(100, b"AcDbSymbolTableRecord", &mut layer);
                style.tag(100, b"AcDbLayerTableRecord", &mut layer);
            }
            style.tag(2, added.layer.as_bytes(), &mut layer);
            style.tag(70, b"0", &mut layer);
            style.tag(62, b"7", &mut layer);
            style.tag(6, b"CONTINUOUS", &mut layer);
            copy(&OF_LAYER[1..], &mut layer);
            let at = self.text.line_start(end);
            edits.push(TextEdit::new(at..at, style.inserted(&self.text, at, layer)));
        }
        let (has_handles, marked) = (has(&of_entity, 5), has(&of_entity, 100));
        let mut records = Vec::new();
        let mut begin = |kind: &[u8], class: &[u8], into: &mut Vec<u8>| {
            style.tag(0, kind, into);
            if has_handles {
                style.tag(5, handle().as_bytes(), into);
            }
            for owner in of_entity.iter().filter(|tag| tag.code == 330) {
                style.tag(330, lines.content(owner.value_line()), into);
            }
            if marked {
                style.tag(100, b"AcDbEntity", into);
            }
            style.tag(8, added.layer.as_bytes(), into);
            if marked {
                style.tag(100, class, into);
            }
        };
        for place in added.places {
            let point = |into: &mut Vec<u8>| {
                for (code, value) in [(10, place.x), (20, place.y), (30, 0.0)] {
                    style.number(code, value, DECIMALS, into);
                }
            };
            let is_there = |size: Option<f64>| {
                let is_it = |there: &There| {
                    there.is_circle == size.is_some()
                        && size.is_none_or(|size| is_same(size, there.size))
                        && there.is_at(*place)
                };
                frame.there.iter().any(is_it)
            };
            if let Some(radius) = added.radius.filter(|radius| !is_there(Some(*radius))) {
                begin(b"CIRCLE", b"AcDbCircle", &mut records);
                point(&mut records);
                style.number(40, radius, DECIMALS, &mut records);
            }
            if is_there(None) {
                continue;
            }
            begin(b"TEXT", b"AcDbText", &mut records);
            point(&mut records);
            style.number(40, added.height, DECIMALS, &mut records);
            style.tag(1, added.mark.as_bytes(), &mut records);
            if marked {
                style.tag(100, b"AcDbText", &mut records);
            }
        }
        let is_any = !records.is_empty();
        edits.push(TextEdit::new(
            at..at,
            style.inserted(&self.text, at, records),
        ));
        if let Some(line) = frame.seed.filter(|_| has_handles && is_any) {
            let range = lines.trimmed_range(line);
            edits.push(TextEdit::new(range, format!("{free:X}")));
        }
        edits.sort_by_key(|edit| edit.range.start);
        edited(self.text.bytes(), &edits)
    }
}
