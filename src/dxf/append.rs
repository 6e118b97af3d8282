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

fn has(tags: &[Tag], code: i16) -> bool {
    tags.iter().any(|tag| tag.code == code)
}

/// How new records are written: as those that are there.
struct Records<'a> {
    lines: Lines<'a>,
    style: Style,
    /// The next free handle.
    free: u64,
    /// The tags of the records on which new ones are modelled.
    of_layer: Vec<Tag>,
    of_entity: Vec<Tag>,
}

impl Records<'_> {
    fn handle(&mut self) -> String {
        let own = format!("{:X}", self.free);
        self.free = self.free.saturating_add(1);
        own
    }

    fn copy(&self, tags: &[Tag], codes: &[i16], into: &mut Vec<u8>) {
        for tag in tags.iter().filter(|tag| codes.contains(&tag.code)) {
            let value = self.lines.content(tag.value_line());
            self.style.tag(tag.code, value, into);
        }
    }

    fn layer(&mut self, name: &str) -> Vec<u8> {
        let mut layer = Vec::new();
        let into = &mut layer;
        self.style.tag(0, b"LAYER", into);
        if has(&self.of_layer, 5) {
            let handle = self.handle();
            self.style.tag(5, handle.as_bytes(), into);
        }
        self.copy(&self.of_layer, &OF_LAYER[..1], into);
        if has(&self.of_layer, 100) {
            self.style.tag(100, b"AcDbSymbolTableRecord", into);
            self.style.tag(100, b"AcDbLayerTableRecord", into);
        }
        self.style.tag(2, name.as_bytes(), into);
        self.style.tag(70, b"0", into);
        self.style.tag(62, b"7", into);
        self.style.tag(6, b"CONTINUOUS", into);
        self.copy(&self.of_layer, &OF_LAYER[1..], into);
        layer
    }

    /// The circles and texts that are not there yet.
    fn entities(&mut self, added: &Added, there: &[There]) -> Vec<u8> {
        let mut entities = Vec::new();
        let into = &mut entities;
        for &place in added.places {
            let is_there = |size: Option<f64>| {
                let is_it = |there: &There| {
                    there.is_circle == size.is_some()
                        && size.is_none_or(|size| is_same(size, there.size))
                        && there.is_at(place)
                };
                there.iter().any(is_it)
            };
            if let Some(radius) = added.radius.filter(|radius| !is_there(Some(*radius))) {
                self.begin([b"CIRCLE", b"AcDbCircle"], added.layer, place, into);
                self.style.number(40, radius, DECIMALS, into);
            }
            if is_there(None) {
                continue;
            }
            self.begin([b"TEXT", b"AcDbText"], added.layer, place, into);
            self.style.number(40, added.height, DECIMALS, into);
            self.style.tag(1, added.mark.as_bytes(), into);
            if has(&self.of_entity, 100) {
                self.style.tag(100, b"AcDbText", into);
            }
        }
        entities
    }

    /// The beginning of an entity of this kind and class, to its first point.
    fn begin(&mut self, [kind, class]: [&[u8]; 2], layer: &str, at: Point, into: &mut Vec<u8>) {
        let is_marked = has(&self.of_entity, 100);
        self.style.tag(0, kind, into);
        if has(&self.of_entity, 5) {
            let handle = self.handle();
            self.style.tag(5, handle.as_bytes(), into);
        }
        self.copy(&self.of_entity, &[330], into);
        if is_marked {
            self.style.tag(100, b"AcDbEntity", into);
        }
        self.style.tag(8, layer.as_bytes(), into);
        if is_marked {
            self.style.tag(100, class, into);
        }
        for (code, value) in [(10, at.x), (20, at.y), (30, 0.0)] {
            self.style.number(code, value, DECIMALS, into);
        }
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
        let mut records = Records {
            lines,
            style: Style::of(&self.text, lines, frame.entities_end?),
            free: record::free_handle(lines)?,
            of_layer: of_record(frame.layer),
            of_entity: of_record(frame.entity),
        };
        let mut edits = Vec::new();
        let mut insert = |at: usize, new: Vec<u8>, style: &Style| {
            edits.push(TextEdit::new(at..at, style.inserted(&self.text, at, new)));
        };
        if let Some(end) = frame.layers_end.filter(|_| !frame.is_layer_there) {
            let layer = records.layer(added.layer);
            insert(self.text.line_start(end), layer, &records.style);
        }
        let entities = records.entities(added, &frame.there);
        let is_any = !entities.is_empty();
        insert(at, entities, &records.style);
        let has_handles = has(&records.of_entity, 5);
        if let Some(line) = frame.seed.filter(|_| has_handles && is_any) {
            let range = lines.trimmed_range(line);
            edits.push(TextEdit::new(range, format!("{:X}", records.free)));
        }
        edits.sort_by_key(|edit| edit.range.start);
        edited(self.text.bytes(), &edits)
    }
}
