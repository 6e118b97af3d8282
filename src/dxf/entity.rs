//! The common part of all kinds of records: what is drawn, on which layer, under which handle.
//!
//! Knows nothing of the records around it. A coordinate that is missing or not a number is never replaced: the entity
//! then has no geometry.

use super::fault::{meaning, quoted};
use super::layers::Layers;
use super::lexer::{Lexer, Tag};
use super::number::{self, Code, Number};
use super::shape::Shape;
use super::space::{FLAT, Lies, Space, Vector3};
use crate::drawing::{Color, Handle, Kind, Marks, Vertex};
use std::sync::Arc;

/// What was read of one entity of the modelspace.
#[derive(Debug)]
pub(super) struct Read {
    /// The handle and its line.
    pub(super) handle: Option<(Handle, usize)>,
    pub(super) layer: Arc<str>,
    pub(super) appearance: Appearance,
    pub(super) kind: Kind,
    pub(super) shape: Shape,
    pub(super) lies: Lies,
    pub(super) vertices: Option<Box<VertexLines>>,
    /// Handles of the entities that form the frame of this text.
    pub(super) frames: Vec<u64>,
}

/// The appearance that the entity states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Appearance {
    pub(super) paint: Paint,
    pub(super) stroke: Stroke,
    pub(super) invisible: bool,
    /// Its extended data under the name of this program.
    pub(super) marks: Option<Marks>,
}

/// The source of an entity's colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Paint {
    ByLayer,
    /// From the reference that draws it.
    ByBlock,
    Own(Color),
}

/// The source of an entity's linetype.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Stroke {
    ByLayer,
    /// From the reference that draws it.
    ByBlock,
    Own(Arc<str>),
}

impl Stroke {
    /// By the name in the text.
    pub(super) fn of(name: &[u8], layers: &mut Layers) -> Stroke {
        match name {
            name if name.eq_ignore_ascii_case(b"BYLAYER") => Stroke::ByLayer,
            name if name.eq_ignore_ascii_case(b"BYBLOCK") => Stroke::ByBlock,
            name => Stroke::Own(layers.name(name)),
        }
    }
}

/// Where the vertices of a polyline stand.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct VertexLines {
    /// The line of each vertex's first tag (its x, or its VERTEX record), counted from the first line of the entity.
    pub(crate) lines: Vec<u32>,
    /// True where the entity's plane has the extrusion (0, 0, -1).
    pub(super) mirrored: bool,
    /// True for a 3D polyline, whose bulges mean nothing.
    pub(super) in_space: bool,
    /// Of a LWPOLYLINE, the number of vertices before the first that is followed by a tag of the whole polyline.
    /// 0 for a POLYLINE.
    pub(super) own: u32,
    /// The line of the stated number of vertices, counted likewise; 0 where there is none.
    pub(super) count: u32,
    /// The largest width; 0 for none.
    pub(super) width: f64,
}

impl VertexLines {
    /// The line of the stated number of vertices, in a LWPOLYLINE that begins in the line `start`.
    pub(super) fn count_line(&self, start: usize) -> Option<usize> {
        (self.count > 0).then_some(start + self.count as usize)
    }
}

#[derive(Debug)]
pub(super) enum Outcome {
    Entity(Read),
    /// A reference to a block.
    Insert(Box<Insert>),
    /// In the text, but not cut: its kind, and why.
    Unsupported(String, &'static str),
    /// A finding says what is wrong with it.
    Damaged,
}

/// Why a record is not an entity that is cut.
#[derive(Debug)]
pub(super) enum Refused {
    /// The reason, beside its kind.
    Unsupported(&'static str),
    /// A finding says what is wrong with it.
    Damaged,
}

/// A reference to a block, as it stands in the text.
#[derive(Clone, Debug)]
pub(super) struct Insert {
    /// The handle and its line.
    pub(super) handle: Option<(Handle, usize)>,
    pub(super) layer: Arc<str>,
    pub(super) appearance: Appearance,
    /// The block's name as `insert::block_key` has it.
    pub(super) block: String,
    /// The line of the block's name.
    pub(super) name_line: usize,
    /// From the block's coordinates, with its base point at the origin, to those around the reference.
    pub(super) map: Space,
    /// Columns and rows, at least 1, and the step from one to the next.
    pub(super) columns: (u64, Vector3),
    pub(super) rows: (u64, Vector3),
}

impl Insert {
    pub(super) fn copies(&self) -> u64 {
        self.columns.0.saturating_mul(self.rows.0)
    }
}

/// Extrusion: the normal of the plane in which an entity's own coordinates lie.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Plane {
    Normal,
    /// Seen from below: x is reversed.
    Mirrored,
    Tilted,
}

/// The fields that all kinds of entities share.
#[derive(Default)]
pub(super) struct Common {
    handle: Option<Tag>,
    layer: Option<Tag>,
    linetype: Option<Tag>,
    color: Option<Tag>,
    rgb: Option<Tag>,
    invisible: bool,
    pub(super) paper_space: bool,
    extrusion: [Option<f64>; 3],
    /// A value was not a number, a number was missing or the lines were out of step: there is a finding.
    pub(super) bad: bool,
    /// Only tags of other programs follow, up to the end of the record.
    pub(super) foreign: bool,
    /// Texts of the extended data of the application `WEDM`, and whether its data are being read.
    marks: Vec<Tag>,
    is_own: bool,
    /// The largest width that a polyline states.
    width: f64,
    /// Within a group `{` … `}` of another program.
    pub(super) group: bool,
    /// A subclass marker names the class of the tags after it.
    pub(super) is_marked: bool,
}

impl Common {
    /// Takes the tags that all entities share, and those that belong to no field. True if taken.
    #[inline]
    pub(super) fn take(&mut self, lexer: &mut Lexer, tag: Tag) -> bool {
        if self.foreign {
            if tag.code >= 1000 {
                self.take_extended(lexer, tag);
            }
            return true;
        }
        if self.group || tag.code >= 1000 || matches!(tag.code, 100..=102) {
            self.take_foreign(lexer, tag);
            return true;
        }
        match tag.code {
            5 => self.handle = Some(tag),
            6 => self.linetype = Some(tag),
            8 => self.layer = Some(tag),
            60 => self.invisible = lexer.lines.trimmed(tag.value_line()) == b"1",
            62 => self.color = Some(tag),
            420 => self.rgb = Some(tag),
            67 => self.paper_space = lexer.lines.trimmed(tag.value_line()) == b"1",
            210 | 220 | 230 => {
                let value = self.coordinate(lexer, tag);
                let [x, y, z] = &mut self.extrusion;
                *match tag.code {
                    210 => x,
                    220 => y,
                    _ => z,
                } = value;
            }
            _ => return false,
        }
        true
    }

    fn take_foreign(&mut self, lexer: &Lexer, tag: Tag) {
        match tag.code {
            100 => self.is_marked = true,
            // An embedded object uses the same codes with other meanings.
            101 => self.foreign = true,
            1000.. => {
                self.foreign = true;
                self.take_extended(lexer, tag);
            }
            102 => self.group = lexer.lines.trimmed(tag.value_line()).starts_with(b"{"),
            _ => {}
        }
    }

    /// Extended data: the name of an application, then its data.
    fn take_extended(&mut self, lexer: &Lexer, tag: Tag) {
        match tag.code {
            1001 => {
                let name = lexer.lines.trimmed(tag.value_line());
                self.is_own = name.eq_ignore_ascii_case(b"WEDM");
            }
            1000 if self.is_own => self.marks.push(tag),
            _ => {}
        }
    }

    /// The number after a tag; `None` with a finding where it is not a number.
    #[inline]
    pub(super) fn coordinate(&mut self, lexer: &mut Lexer, tag: Tag) -> Option<f64> {
        match number::number(lexer.lines.content(tag.value_line())) {
            Number::Exact(value) => Some(value),
            other => self.blemished(lexer, tag, other),
        }
    }

    /// The width of a polyline at a vertex, or of all of it. What is no number is no width: it changes no contour.
    pub(super) fn take_width(&mut self, lexer: &Lexer, tag: Tag) {
        self.width = self.width.max(width(lexer, tag));
    }

    pub(super) fn width(&self) -> f64 {
        self.width
    }

    /// The bulge of a vertex.
    pub(super) fn bulge(&mut self, lexer: &mut Lexer, tag: Tag) -> Option<f64> {
        let bulge = self.coordinate(lexer, tag)?;
        if bulge.abs() <= Vertex::MOST_BULGE {
            return Some(bulge);
        }
        self.bad = true;
        let found = quoted(lexer.lines.trimmed(tag.value_line()));
        let sentence = say!(no_arc_has_such_a_bulge, found, Vertex::MOST_BULGE);
        lexer.damage(tag.value_line(), sentence);
        None
    }

    #[cold]
    fn blemished(&mut self, lexer: &mut Lexer, tag: Tag, number: Number) -> Option<f64> {
        let (code, line) = (tag.code, tag.value_line());
        let found = quoted(lexer.lines.trimmed(line));
        if let Number::Blemished(value, blemish) = number {
            let sentence = say!(
                group_code_is_read_otherwise,
                code,
                meaning(code),
                found,
                blemish,
                value
            );
            lexer.oddity(line, sentence);
            return Some(value);
        }
        self.bad = true;
        if !lexer.back_in_step(tag) {
            let hint = if found.contains(',') {
                say!(with_a_decimal_point)
            } else {
                ""
            };
            let sentence = say!(
                group_code_is_expected_a_number,
                code,
                meaning(code),
                found,
                hint
            );
            lexer.damage(line, sentence);
        }
        None
    }

    /// A whole number; `None` where it is not.
    pub(super) fn whole(lexer: &Lexer, tag: Tag) -> Option<i64> {
        std::str::from_utf8(lexer.lines.trimmed(tag.value_line()))
            .ok()?
            .parse()
            .ok()
    }

    /// Flags; a value that is not a whole number is a fault.
    pub(super) fn flags(&mut self, lexer: &mut Lexer, tag: Tag) -> i64 {
        let Some(flags) = Self::whole(lexer, tag) else {
            self.bad = true;
            if !lexer.back_in_step(tag) {
                let found = quoted(lexer.lines.trimmed(tag.value_line()));
                let sentence = say!(group_code_is_expected_a_whole_number, tag.code, found);
                lexer.damage(tag.value_line(), sentence);
            }
            return 0;
        };
        flags
    }

    pub(super) fn normal(&self) -> Vector3 {
        Vector3::new(
            self.extrusion[0].unwrap_or(0.0),
            self.extrusion[1].unwrap_or(0.0),
            self.extrusion[2].unwrap_or(1.0),
        )
    }

    /// What lies in paper space is not cut.
    pub(super) fn is_in_the_model(&self) -> Result<(), Refused> {
        match self.paper_space {
            true => Err(Refused::Unsupported(say!(it_lies_in_paper_space))),
            false => Ok(()),
        }
    }

    /// The plane of an entity whose coordinates are those of its extrusion, at `height` over its plane. Refused where
    /// the extrusion has no direction.
    pub(super) fn lies(&self, height: f64) -> Result<Lies, Refused> {
        Ok(match self.plane() {
            Plane::Normal => Lies::Level(height),
            Plane::Mirrored => Lies::Level(0.0 - height),
            Plane::Tilted => {
                let tilted = say!(its_plane_is_tilted);
                let system = Space::of_extrusion(self.normal());
                let system = system.ok_or(Refused::Unsupported(tilted))?;
                Lies::Aslant(
                    Box::new(Space {
                        origin: system.z * height,
                        ..system
                    }),
                    tilted,
                )
            }
        })
    }

    pub(super) fn plane(&self) -> Plane {
        let [x, y, z] = self.normal().into();
        let tilt = FLAT * z.abs();
        match () {
            () if z == 0.0 || x.abs() > tilt || y.abs() > tilt => Plane::Tilted,
            () if z < 0.0 => Plane::Mirrored,
            () => Plane::Normal,
        }
    }

    pub(super) fn handle(&self, lexer: &mut Lexer) -> Option<(Handle, usize)> {
        let line = self.handle?.value_line();
        let value = lexer.lines.trimmed(line);
        let hexadecimal =
            !value.is_empty() && value.len() <= 16 && value.iter().all(u8::is_ascii_hexdigit);
        if !hexadecimal || value.iter().all(|&digit| digit == b'0') {
            let sentence = say!(the_handle_is_no_hexadecimal_number, quoted(value));
            lexer.oddity_in(lexer.lines.range(line), sentence);
        }
        if value.is_empty() || value.iter().all(|&digit| digit == b'0') {
            return None;
        }
        Some((Handle::new(&String::from_utf8_lossy(value)), line))
    }

    pub(super) fn layer(&self, lexer: &Lexer, layers: &mut Layers) -> Arc<str> {
        layers.name(
            self.layer
                .map_or(b"0", |tag| lexer.lines.trimmed(tag.value_line())),
        )
    }

    pub(super) fn appearance(&self, lexer: &Lexer, layers: &mut Layers) -> Appearance {
        let rgb = self
            .rgb
            .and_then(|tag| Self::whole(lexer, tag))
            .and_then(|rgb| u32::try_from(rgb).ok());
        let paint = match (rgb, self.color.and_then(|tag| Self::whole(lexer, tag))) {
            (Some(rgb), _) => Paint::Own(Color::of_rgb(rgb)),
            (None, Some(0)) => Paint::ByBlock,
            (None, Some(index)) => {
                u8::try_from(index).map_or(Paint::ByLayer, |index| Paint::Own(Color::Index(index)))
            }
            (None, None) => Paint::ByLayer,
        };
        let stroke = self.linetype.map_or(Stroke::ByLayer, |tag| {
            Stroke::of(lexer.lines.trimmed(tag.value_line()), layers)
        });
        let marks = self.marks.iter();
        let marks: Vec<Arc<str>> = marks
            .map(|tag| layers.name(lexer.lines.trimmed(tag.value_line())))
            .collect();
        Appearance {
            paint,
            stroke,
            invisible: self.invisible,
            marks: (!marks.is_empty()).then(|| marks.into()),
        }
    }

    /// Reads the handle and the layer, and puts the parts together.
    pub(super) fn finish(
        self,
        lexer: &mut Lexer,
        layers: &mut Layers,
        kind: Kind,
        (shape, lies): (Shape, Lies),
    ) -> Read {
        let appearance = self.appearance(lexer, layers);
        let (handle, layer) = (self.handle(lexer), self.layer(lexer, layers));
        Read {
            handle,
            layer,
            appearance,
            kind,
            shape,
            lies,
            vertices: None,
            frames: Vec::new(),
        }
    }
}

/// The number of a tag that states a width; 0 where it states none.
pub(super) fn width(lexer: &Lexer, tag: Tag) -> f64 {
    match number::number(lexer.lines.content(tag.value_line())) {
        Number::Exact(value) | Number::Blemished(value, _) if value.is_finite() => value,
        _ => 0.0,
    }
}

/// The next tag of the record; the tag that begins the next record is left to the lexer.
#[inline]
pub(super) fn tag_of_record(lexer: &mut Lexer) -> Option<Tag> {
    let tag = lexer.next()?;
    if tag.code == 0 {
        lexer.back_to(tag);
        return None;
    }
    Some(tag)
}

/// Passes over the rest of the record. True when it lies in paper space.
pub(super) fn pass_over(lexer: &mut Lexer) -> bool {
    let mut paper_space = false;
    while let Some(tag) = tag_of_record(lexer) {
        paper_space |= tag.code == 67 && lexer.lines.trimmed(tag.value_line()) == b"1";
    }
    paper_space
}

/// Passes over the further records of a record, up to and with its SEQEND.
pub(super) fn pass_over_followers(lexer: &mut Lexer, names: &[&[u8]]) {
    while let Some(tag) = lexer.peek_record() {
        let name = lexer.lines.trimmed(tag.value_line());
        if !names.contains(&name) {
            return;
        }
        lexer.next();
        pass_over(lexer);
        if name == b"SEQEND" {
            return;
        }
    }
}

/// The line of the last value of `code` among the entity's own tags; the name's line where there is none.
pub(super) fn value_line_of(start: Tag, lexer: &Lexer, code: i16) -> usize {
    let mut found = start.value_line();
    let mut line = start.line + 2;
    while line + 1 < lexer.lines.count() {
        match number::code(lexer.lines.content(line)) {
            Code::Known(0 | 101 | 1000..) => break,
            Code::Known(other) if other == code => found = line + 1,
            _ => {}
        }
        line += 2;
    }
    found
}
