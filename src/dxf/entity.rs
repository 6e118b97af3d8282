//! The tags of one record to one entity: what is drawn, on which layer, under which handle.
//!
//! Knows nothing of the records around it. A coordinate that is missing or is no number is never replaced:
//! the entity has no geometry then.

use super::fault::{damage, meaning, oddity, quoted};
use super::layers::Layers;
use super::lexer::{Lexer, Tag};
use super::number::{self, Code, Number};
use super::shape::Shape;
use super::space::{FLAT, Lies, Space, Vector3, in_space as at_height};
use super::strings::{words_of_mtext, words_of_text};
use super::{curve, frame, insert, plain};
use crate::drawing::{Color, Geometry, Handle, Kind, Vertex};
use crate::finding::Finding;
use crate::geometry::{Point, radians};
use std::sync::Arc;

/// What was read of one entity of the modelspace.
#[derive(Debug)]
pub(super) struct Read {
    /// The handle, and the line it stands on.
    pub(super) handle: Option<(Handle, usize)>,
    pub(super) layer: Arc<str>,
    pub(super) look: Look,
    pub(super) kind: Kind,
    pub(super) shape: Shape,
    pub(super) lies: Lies,
    pub(super) vertices: Option<VertexLines>,
    /// Handles of the entities that are the frame of this text.
    pub(super) frames: Vec<u64>,
}

/// What an entity says of how it looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Look {
    pub(super) paint: Paint,
    pub(super) invisible: bool,
}

/// Whence an entity has its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Paint {
    ByLayer,
    /// From the reference that draws it.
    ByBlock,
    Own(Color),
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
}

#[derive(Debug)]
pub(super) enum Outcome {
    Entity(Read),
    /// A reference to a block.
    Insert(Box<insert::Insert>),
    /// In the text, but not cut: what it is called, and why.
    Unsupported(String, &'static str),
    /// A finding says what is wrong with it.
    Damaged,
}

/// Extrusion: the normal of the plane in which an entity's own coordinates lie.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Plane {
    Normal,
    /// Seen from below: x runs the other way.
    Mirrored,
    Tilted,
}

/// What all kinds of entities state alike.
#[derive(Default)]
pub(super) struct Common {
    handle: Option<Tag>,
    layer: Option<Tag>,
    color: Option<Tag>,
    rgb: Option<Tag>,
    invisible: bool,
    pub(super) paper_space: bool,
    extrusion: [Option<f64>; 3],
    /// A value was no number, a number was missing or the lines were out of step: there is a finding.
    pub(super) bad: bool,
    /// Tags of other programs follow, up to the end of the record.
    foreign: bool,
    /// Within a group `{` … `}` of another program.
    group: bool,
}

impl Common {
    /// Takes the tags that all entities share, and those that belong to none of its fields. True when taken.
    #[inline]
    pub(super) fn take(
        &mut self,
        lexer: &mut Lexer,
        tag: Tag,
        findings: &mut Vec<Finding>,
    ) -> bool {
        if self.foreign {
            return true;
        }
        if self.group || tag.code >= 1000 || matches!(tag.code, 100..=102) {
            self.take_foreign(lexer, tag);
            return true;
        }
        match tag.code {
            5 => self.handle = Some(tag),
            8 => self.layer = Some(tag),
            60 => self.invisible = lexer.lines.trimmed(tag.value_line()) == b"1",
            62 => self.color = Some(tag),
            420 => self.rgb = Some(tag),
            67 => self.paper_space = lexer.lines.trimmed(tag.value_line()) == b"1",
            210 | 220 | 230 => {
                let value = self.coordinate(lexer, tag, findings);
                self.extrusion[usize::from(tag.code.unsigned_abs() / 10 - 21)] = value;
            }
            _ => return false,
        }
        true
    }

    fn take_foreign(&mut self, lexer: &Lexer, tag: Tag) {
        match tag.code {
            // An embedded object uses the same codes with other meanings.
            101 | 1000.. => self.foreign = true,
            102 => self.group = lexer.lines.trimmed(tag.value_line()).starts_with(b"{"),
            _ => {}
        }
    }

    /// The number behind a tag; `None` with a finding where it is none.
    #[inline]
    pub(super) fn coordinate(
        &mut self,
        lexer: &mut Lexer,
        tag: Tag,
        findings: &mut Vec<Finding>,
    ) -> Option<f64> {
        match number::number(lexer.lines.content(tag.value_line())) {
            Number::Exact(value) => Some(value),
            other => self.blemished(lexer, tag, other, findings),
        }
    }

    #[cold]
    fn blemished(
        &mut self,
        lexer: &mut Lexer,
        tag: Tag,
        number: Number,
        findings: &mut Vec<Finding>,
    ) -> Option<f64> {
        let (code, line) = (tag.code, tag.value_line());
        let found = quoted(lexer.lines.trimmed(line));
        if let Number::Blemished(value, blemish) = number {
            let sentence = say!(
                group_code_is_which_is_read,
                code,
                meaning(code),
                found,
                blemish,
                value
            );
            oddity(findings, lexer.lines.trimmed_range(line), sentence);
            return Some(value);
        }
        self.bad = true;
        if !lexer.back_in_step(tag, findings) {
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
            damage(findings, lexer.lines.trimmed_range(line), sentence);
        }
        None
    }

    /// A whole number; `None` where it is none.
    pub(super) fn whole(lexer: &Lexer, tag: Tag) -> Option<i64> {
        std::str::from_utf8(lexer.lines.trimmed(tag.value_line()))
            .ok()?
            .parse()
            .ok()
    }

    /// Flags; a value that is no whole number is a fault.
    pub(super) fn flags(
        &mut self,
        lexer: &mut Lexer,
        tag: Tag,
        findings: &mut Vec<Finding>,
    ) -> i64 {
        let Some(flags) = Self::whole(lexer, tag) else {
            self.bad = true;
            if !lexer.back_in_step(tag, findings) {
                let found = quoted(lexer.lines.trimmed(tag.value_line()));
                let sentence = say!(group_code_is_expected_a_whole_number, tag.code, found);
                damage(
                    findings,
                    lexer.lines.trimmed_range(tag.value_line()),
                    sentence,
                );
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

    /// Where an entity lies whose coordinates are those of its extrusion, at `height` over its plane. `None` where the extrusion is
    /// no direction.
    pub(super) fn lies(&self, height: f64) -> Option<Lies> {
        Some(match self.plane() {
            Plane::Normal => Lies::Level(height),
            Plane::Mirrored => Lies::Level(0.0 - height),
            Plane::Tilted => {
                let system = Space::of_extrusion(self.normal())?;
                Lies::Aslant(
                    Box::new(Space {
                        origin: system.z * height,
                        ..system
                    }),
                    say!(its_plane_is_tilted),
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

    pub(super) fn handle(
        &self,
        lexer: &Lexer,
        findings: &mut Vec<Finding>,
    ) -> Option<(Handle, usize)> {
        let line = self.handle?.value_line();
        let value = lexer.lines.trimmed(line);
        let hexadecimal =
            !value.is_empty() && value.len() <= 16 && value.iter().all(u8::is_ascii_hexdigit);
        if !hexadecimal || value.iter().all(|&digit| digit == b'0') {
            let sentence = say!(group_code_5_handle, quoted(value));
            oddity(findings, lexer.lines.range(line), sentence);
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

    pub(super) fn look(&self, lexer: &Lexer) -> Look {
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
        Look {
            paint,
            invisible: self.invisible,
        }
    }

    /// Reads the handle and the layer, and puts the parts together.
    pub(super) fn finish(
        self,
        lexer: &Lexer,
        layers: &mut Layers,
        kind: Kind,
        (shape, lies): (Shape, Lies),
        vertices: Option<VertexLines>,
        findings: &mut Vec<Finding>,
    ) -> Outcome {
        let look = self.look(lexer);
        let (handle, layer) = (self.handle(lexer, findings), self.layer(lexer, layers));
        Outcome::Entity(Read {
            handle,
            layer,
            look,
            kind,
            shape,
            lies,
            vertices,
            frames: Vec::new(),
        })
    }
}

/// The next tag of the record; the tag that begins the next record is left to the lexer.
#[inline]
pub(super) fn tag_of_record(lexer: &mut Lexer, findings: &mut Vec<Finding>) -> Option<Tag> {
    let tag = lexer.next(findings)?;
    if tag.code == 0 {
        lexer.back_to(tag);
        return None;
    }
    Some(tag)
}

/// Passes over the rest of the record. True when it says that it lies in paper space.
pub(super) fn pass_over(lexer: &mut Lexer, findings: &mut Vec<Finding>) -> bool {
    let mut paper_space = false;
    while let Some(tag) = tag_of_record(lexer, findings) {
        paper_space |= tag.code == 67 && lexer.lines.trimmed(tag.value_line()) == b"1";
    }
    paper_space
}

/// Reads the entity whose record begins at `start`; the lexer stands behind its name.
pub(super) fn read(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
    findings: &mut Vec<Finding>,
) -> Outcome {
    match plain::read(lexer.lines, start.line, layers) {
        Some((read, next)) => {
            lexer.begin_item(next);
            Outcome::Entity(read)
        }
        None => read_closely(start, lexer, layers, findings),
    }
}

/// Reads any entity, sound or not.
pub(super) fn read_closely(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
    findings: &mut Vec<Finding>,
) -> Outcome {
    match lexer.lines.trimmed(start.value_line()) {
        b"LWPOLYLINE" => light_polyline(start, lexer, layers, findings),
        b"LINE" => line(start, lexer, layers, findings),
        b"ARC" => arc(start, lexer, layers, findings),
        b"CIRCLE" => circle(start, lexer, layers, findings),
        b"TEXT" => text(Kind::Text, start, lexer, layers, findings),
        b"MTEXT" => text(Kind::LongText, start, lexer, layers, findings),
        b"POLYLINE" => polyline(start, lexer, layers, findings),
        b"ELLIPSE" => curve::read_ellipse(start, lexer, layers, findings),
        b"SPLINE" => curve::read_spline(start, lexer, layers, findings),
        b"INSERT" => insert::read(start, lexer, layers, findings),
        b"POINT" => point(start, lexer, layers, findings),
        name => {
            let kind = String::from_utf8_lossy(&name[..name.len().min(64)]).into_owned();
            let why = if pass_over(lexer, findings) {
                say!(it_lies_in_paper_space)
            } else {
                say!(this_kind_is_not_cut)
            };
            Outcome::Unsupported(kind, why)
        }
    }
}

/// Passes over the records behind a record that are a part of it, up to and with its SEQEND.
pub(super) fn pass_over_followers(lexer: &mut Lexer, findings: &mut Vec<Finding>, names: &[&[u8]]) {
    while let Some(tag) = lexer.peek_record() {
        let name = lexer.lines.trimmed(tag.value_line());
        if !names.contains(&name) {
            return;
        }
        lexer.next(findings);
        pass_over(lexer, findings);
        if name == b"SEQEND" {
            return;
        }
    }
}

pub(super) fn missing(
    start: Tag,
    lexer: &Lexer,
    codes: &[(i16, bool)],
    findings: &mut Vec<Finding>,
) {
    let mut lacking: Vec<String> = codes
        .iter()
        .filter(|(_, there)| !there)
        .map(|(code, _)| format!("{code}{}", meaning(*code)))
        .collect();
    let kind = String::from_utf8_lossy(lexer.lines.trimmed(start.value_line())).into_owned();
    let last = lacking.pop().unwrap_or_default();
    let sentence = match lacking.is_empty() {
        true => say!(lacks_group_code, kind, last),
        false => say!(lacks_the_group_codes_and, kind, lacking.join(", "), last),
    };
    damage(
        findings,
        lexer.lines.trimmed_range(start.value_line()),
        sentence,
    );
}

/// The numbers of an entity that has each of them once.
pub(super) struct Numbers<const N: usize> {
    codes: [i16; N],
    pub(super) values: [Option<f64>; N],
}

impl<const N: usize> Numbers<N> {
    pub(super) fn new(codes: [i16; N]) -> Self {
        Numbers {
            codes,
            values: [None; N],
        }
    }

    /// Takes all tags of the record that it holds a place for.
    pub(super) fn gather(
        &mut self,
        lexer: &mut Lexer,
        findings: &mut Vec<Finding>,
        mut other: impl FnMut(&Lexer, Tag),
    ) -> Common {
        let mut common = Common::default();
        while let Some(tag) = tag_of_record(lexer, findings) {
            if common.take(lexer, tag, findings) {
                continue;
            }
            match self.codes.iter().position(|&code| code == tag.code) {
                Some(index) => self.values[index] = common.coordinate(lexer, tag, findings),
                None => other(lexer, tag),
            }
        }
        common.bad |= lexer.out_of_step;
        common
    }

    /// The first `M` numbers, which the entity must have; one finding names those that are missing.
    pub(super) fn required<const M: usize>(
        &self,
        start: Tag,
        lexer: &Lexer,
        common: &Common,
        findings: &mut Vec<Finding>,
    ) -> Option<[f64; M]> {
        if common.bad {
            return None;
        }
        let first = self.values.first_chunk::<M>()?;
        if first.iter().all(Option::is_some) {
            return Some(first.map(Option::unwrap_or_default));
        }
        let there: Vec<(i16, bool)> = self
            .codes
            .iter()
            .zip(first)
            .map(|(&code, value)| (code, value.is_some()))
            .collect();
        missing(start, lexer, &there, findings);
        None
    }
}

fn line(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
    findings: &mut Vec<Finding>,
) -> Outcome {
    let mut numbers = Numbers::new([10, 20, 11, 21, 30, 31]);
    let common = numbers.gather(lexer, findings, |_, _| {});
    let Some([x, y, end_x, end_y]) = numbers.required(start, lexer, &common, findings) else {
        return Outcome::Damaged;
    };
    // The ends of a LINE are world coordinates: its extrusion only gives the direction of its thickness.
    if common.paper_space {
        return Outcome::Unsupported("LINE".into(), say!(it_lies_in_paper_space));
    }
    let (low, high) = (
        numbers.values[4].unwrap_or(0.0),
        numbers.values[5].unwrap_or(0.0),
    );
    if low != high {
        let sentence = say!(the_ends_of_this_line_differ_in_z).to_owned();
        oddity(
            findings,
            lexer.lines.trimmed_range(start.value_line()),
            sentence,
        );
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
    common.finish(
        lexer,
        layers,
        Kind::Line,
        (Shape::Plain(geometry), lies),
        None,
        findings,
    )
}

/// The radius, when it is positive; else a finding.
fn radius_of(
    value: f64,
    kind: &str,
    start: Tag,
    lexer: &Lexer,
    findings: &mut Vec<Finding>,
) -> Option<f64> {
    if value > 0.0 {
        return Some(value);
    }
    let radius_line = value_line_of(start, lexer, 40);
    let found = quoted(lexer.lines.trimmed(radius_line));
    let sentence = say!(group_code_40_radius, kind, found);
    damage(findings, lexer.lines.trimmed_range(radius_line), sentence);
    None
}

fn arc(start: Tag, lexer: &mut Lexer, layers: &mut Layers, findings: &mut Vec<Finding>) -> Outcome {
    let mut numbers = Numbers::new([10, 20, 40, 50, 51, 30]);
    let common = numbers.gather(lexer, findings, |_, _| {});
    let Some([x, y, radius, from, to]) = numbers.required(start, lexer, &common, findings) else {
        return Outcome::Damaged;
    };
    // A point begins and ends in the same direction: what a fillet of no radius leaves behind. Else the radius is damaged.
    let is_point = radius == 0.0 && (to - from) % 360.0 == 0.0;
    if is_point {
        let place = lexer.lines.trimmed_range(value_line_of(start, lexer, 40));
        oddity(findings, place, say!(arc_has_the_radius_0).into());
    } else if radius_of(radius, "ARC", start, lexer, findings).is_none() {
        return Outcome::Damaged;
    }
    let (from, to) = (radians(from), radians(to));
    let Some(lies) = common.lies(numbers.values[5].unwrap_or(0.0)) else {
        return Outcome::Unsupported("ARC".into(), say!(its_plane_is_tilted));
    };
    let (center, (start_angle, end_angle)) = match common.plane() {
        _ if common.paper_space => {
            return Outcome::Unsupported("ARC".into(), say!(it_lies_in_paper_space));
        }
        Plane::Normal | Plane::Tilted => (Point::new(x, y), (from, to)),
        Plane::Mirrored => (Point::new(0.0 - x, y), mirrored_angles(from, to)),
    };
    let geometry = if is_point {
        Geometry::point(center)
    } else {
        Geometry::Arc {
            center,
            radius,
            start_angle,
            end_angle,
        }
    };
    common.finish(
        lexer,
        layers,
        Kind::Arc,
        (Shape::Plain(geometry), lies),
        None,
        findings,
    )
}

/// Start and end of an arc, counter-clockwise again, once x runs the other way. Its own inverse.
pub(super) fn mirrored_angles(start: f64, end: f64) -> (f64, f64) {
    (std::f64::consts::PI - end, std::f64::consts::PI - start)
}

fn circle(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
    findings: &mut Vec<Finding>,
) -> Outcome {
    let mut numbers = Numbers::new([10, 20, 40, 30]);
    let common = numbers.gather(lexer, findings, |_, _| {});
    let Some([x, y, radius]) = numbers.required(start, lexer, &common, findings) else {
        return Outcome::Damaged;
    };
    let Some(radius) = radius_of(radius, "CIRCLE", start, lexer, findings) else {
        return Outcome::Damaged;
    };
    let Some(lies) = common.lies(numbers.values[3].unwrap_or(0.0)) else {
        return Outcome::Unsupported("CIRCLE".into(), say!(its_plane_is_tilted));
    };
    let x = match common.plane() {
        _ if common.paper_space => {
            return Outcome::Unsupported("CIRCLE".into(), say!(it_lies_in_paper_space));
        }
        Plane::Normal | Plane::Tilted => x,
        Plane::Mirrored => 0.0 - x,
    };
    let shape = Shape::Plain(Geometry::Circle {
        center: Point::new(x, y),
        radius,
    });
    common.finish(lexer, layers, Kind::Circle, (shape, lies), None, findings)
}

fn text(
    kind: Kind,
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
    findings: &mut Vec<Finding>,
) -> Outcome {
    let mut content = Vec::new();
    let mut numbers = Numbers::new([10, 20, 11, 21, 30]);
    let mut is_aligned = false;
    let common = numbers.gather(lexer, findings, |lexer, tag| match tag.code {
        1 | 3 => content.extend_from_slice(lexer.lines.content(tag.value_line())),
        // To the right, to the middle, above a line: then the point that somebody has set is the second one.
        72 if kind == Kind::Text => {
            is_aligned |= matches!(lexer.lines.trimmed(tag.value_line()), b"1" | b"2" | b"4")
        }
        73 if kind == Kind::Text => {
            is_aligned |= matches!(lexer.lines.trimmed(tag.value_line()), b"1" | b"2" | b"3")
        }
        _ => {}
    });
    let Some([x, y]) = numbers.required(start, lexer, &common, findings) else {
        return Outcome::Damaged;
    };
    let [_, _, set_x, set_y, height] = numbers.values;
    let (x, y) = match (set_x, set_y) {
        (Some(x), Some(y)) if is_aligned => (x, y),
        _ => (x, y),
    };
    if common.paper_space {
        return Outcome::Unsupported(kind.name().into(), say!(it_lies_in_paper_space));
    }
    let height = height.unwrap_or(0.0);
    let Some(lies) = common.lies(height) else {
        return Outcome::Unsupported(kind.name().into(), say!(its_plane_is_tilted));
    };
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
    match common.finish(
        lexer,
        layers,
        kind,
        (Shape::Plain(geometry), lies),
        None,
        findings,
    ) {
        Outcome::Entity(read) => Outcome::Entity(Read { frames, ..read }),
        other => other,
    }
}

/// A POINT marks a start as a text "O" does. Its place is in world coordinates.
fn point(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
    findings: &mut Vec<Finding>,
) -> Outcome {
    let mut numbers = Numbers::new([10, 20, 30]);
    let common = numbers.gather(lexer, findings, |_, _| {});
    let Some([x, y]) = numbers.required(start, lexer, &common, findings) else {
        return Outcome::Damaged;
    };
    if common.paper_space {
        return Outcome::Unsupported("POINT".into(), say!(it_lies_in_paper_space));
    }
    let geometry = Geometry::Text {
        at: Point::new(x, y),
        text: "O".into(),
    };
    let lies = Lies::Level(numbers.values[2].unwrap_or(0.0));
    common.finish(
        lexer,
        layers,
        Kind::Point,
        (Shape::Plain(geometry), lies),
        None,
        findings,
    )
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

/// Vertices as they come: x opens one, y closes it.
#[derive(Default)]
struct Vertices {
    vertices: Vec<Vertex>,
    lines: Vec<u32>,
    /// The last vertex has no y yet.
    lacks_y: bool,
    /// The first vertex that got none. Said at the end: lines that are out of step may be the cause.
    without_y: Option<usize>,
}

impl Vertices {
    fn close(&mut self) {
        if self.lacks_y {
            self.without_y = self.without_y.or(self.vertices.len().checked_sub(1));
        }
        self.lacks_y = false;
    }
}

fn light_polyline(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
    findings: &mut Vec<Finding>,
) -> Outcome {
    let mut common = Common::default();
    let mut read = Vertices::default();
    let (mut closed, mut count, mut height) = (false, None, 0.0);
    while let Some(tag) = tag_of_record(lexer, findings) {
        match tag.code {
            10 | 20 | 42 if !common.foreign && !common.group => {
                // A number that is none has its finding; a stand-in keeps the vertices after it in step.
                let value = common.coordinate(lexer, tag, findings).unwrap_or_default();
                match (tag.code, read.vertices.last_mut()) {
                    (10, _) => {
                        read.close();
                        read.vertices.push(Vertex::new(value, 0.0, 0.0));
                        read.lines.push((tag.line - start.line) as u32);
                        read.lacks_y = true;
                    }
                    (20, Some(vertex)) => {
                        vertex.point.y = value;
                        read.lacks_y = false;
                    }
                    (_, Some(vertex)) => vertex.bulge = value,
                    (code, None) => {
                        if !common.bad && !lexer.out_of_step {
                            let sentence = say!(
                                group_code_stands_before_the_first_group_code,
                                code,
                                meaning(code)
                            );
                            damage(findings, lexer.lines.trimmed_range(tag.line), sentence);
                        }
                        common.bad = true;
                    }
                }
            }
            _ if common.take(lexer, tag, findings) => {}
            70 => closed = common.flags(lexer, tag, findings) & 1 != 0,
            38 => height = common.coordinate(lexer, tag, findings).unwrap_or_default(),
            90 => count = Some(tag),
            _ => {}
        }
    }
    read.close();
    if common.bad || lexer.out_of_step {
        return Outcome::Damaged;
    }
    if let Some(index) = read.without_y {
        let line = start.line + read.lines.get(index).map_or(0, |&line| line as usize);
        let sentence = say!(vertex_lacks_group_code_20, index + 1);
        damage(findings, lexer.lines.trimmed_range(line + 1), sentence);
        return Outcome::Damaged;
    }
    if common.paper_space {
        return Outcome::Unsupported("LWPOLYLINE".into(), say!(it_lies_in_paper_space));
    }
    let Some(lies) = common.lies(height) else {
        return Outcome::Unsupported("LWPOLYLINE".into(), say!(its_plane_is_tilted));
    };
    let mirrored = common.plane() == Plane::Mirrored;
    let found = read.vertices.len();
    if let Some(tag) = count
        && found > 1
        && Common::whole(lexer, tag) != i64::try_from(found).ok()
    {
        let stated = quoted(lexer.lines.trimmed(tag.value_line()));
        let sentence = say!(group_code_90_number, stated, found);
        oddity(findings, lexer.lines.range(tag.value_line()), sentence);
    }
    polyline_of(
        Kind::LightPolyline,
        start,
        common,
        closed,
        read,
        (mirrored, false, lies),
        lexer,
        layers,
        findings,
    )
}

#[expect(
    clippy::too_many_arguments,
    reason = "what a polyline is made of, in one call from each of its two kinds"
)]
fn polyline_of(
    kind: Kind,
    start: Tag,
    common: Common,
    closed: bool,
    mut read: Vertices,
    (mirrored, in_space, lies): (bool, bool, Lies),
    lexer: &Lexer,
    layers: &mut Layers,
    findings: &mut Vec<Finding>,
) -> Outcome {
    if read.vertices.len() < 2 {
        let sentence = say!(has_vertices_expected_at_least_2, kind, read.vertices.len());
        oddity(
            findings,
            lexer.lines.trimmed_range(start.value_line()),
            sentence,
        );
        return Outcome::Damaged;
    }
    if mirrored {
        read.vertices.iter_mut().for_each(mirror);
    }
    read.vertices.shrink_to_fit();
    read.lines.shrink_to_fit();
    let geometry = Geometry::Polyline {
        closed,
        vertices: read.vertices,
    };
    let vertices = VertexLines {
        lines: read.lines,
        mirrored,
        in_space,
    };
    common.finish(
        lexer,
        layers,
        kind,
        (Shape::Plain(geometry), lies),
        Some(vertices),
        findings,
    )
}

/// A vertex once x runs the other way. Its own inverse.
pub(super) fn mirror(vertex: &mut Vertex) {
    vertex.point.x = 0.0 - vertex.point.x;
    vertex.bulge = 0.0 - vertex.bulge;
}

/// POLYLINE with its VERTEX records, up to and with SEQEND.
fn polyline(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
    findings: &mut Vec<Finding>,
) -> Outcome {
    const CLOSED: i64 = 1;
    const IN_SPACE: i64 = 8;
    const MESHES: i64 = 16 | 64;
    const CONTROL_POINT: i64 = 16;
    let (mut flags, mut height) = (0, 0.0);
    let mut common = Common::default();
    while let Some(tag) = tag_of_record(lexer, findings) {
        if common.take(lexer, tag, findings) {
            continue;
        }
        match tag.code {
            70 => flags = common.flags(lexer, tag, findings),
            30 => height = common.coordinate(lexer, tag, findings).unwrap_or_default(),
            _ => {}
        }
    }
    if flags & MESHES != 0 {
        pass_over_followers(lexer, findings, &[b"VERTEX", b"SEQEND"]);
        return Outcome::Unsupported(
            "POLYLINE".into(),
            if common.paper_space {
                say!(it_lies_in_paper_space)
            } else {
                say!(it_is_a_mesh)
            },
        );
    }
    let mut read = Vertices::default();
    let (mut heights, mut ended) = (Vec::new(), false);
    while let Some(next) = lexer.peek_record() {
        let name = lexer.lines.trimmed(next.value_line());
        if !matches!(name, b"VERTEX" | b"SEQEND") {
            break;
        }
        lexer.next(findings);
        if name == b"SEQEND" {
            pass_over(lexer, findings);
            ended = true;
            break;
        }
        let mut of_vertex = Common::default();
        let (mut numbers, mut vertex_flags) = ([None; 4], 0);
        while let Some(tag) = tag_of_record(lexer, findings) {
            if of_vertex.take(lexer, tag, findings) {
                continue;
            }
            match tag.code {
                10 => numbers[0] = of_vertex.coordinate(lexer, tag, findings),
                20 => numbers[1] = of_vertex.coordinate(lexer, tag, findings),
                30 => numbers[2] = of_vertex.coordinate(lexer, tag, findings),
                42 => numbers[3] = of_vertex.coordinate(lexer, tag, findings),
                70 => vertex_flags = of_vertex.flags(lexer, tag, findings),
                _ => {}
            }
        }
        let bad = of_vertex.bad || lexer.out_of_step;
        common.bad |= bad;
        if vertex_flags & CONTROL_POINT != 0 || bad {
            continue;
        }
        let [Some(x), Some(y), z, bulge] = numbers else {
            missing(
                next,
                lexer,
                &[(10, numbers[0].is_some()), (20, numbers[1].is_some())],
                findings,
            );
            common.bad = true;
            continue;
        };
        heights.push(z.unwrap_or(0.0));
        let bulge = if flags & IN_SPACE != 0 {
            0.0
        } else {
            bulge.unwrap_or(0.0)
        };
        read.vertices.push(Vertex::new(x, y, bulge));
        read.lines.push((next.line - start.line) as u32);
    }
    // The text ends within the name of the next record, which tells of it: that may have been a VERTEX.
    let is_cut = !ended
        && lexer.lines.last_is_open()
        && lexer
            .peek_record()
            .is_some_and(|next| next.line + 2 >= lexer.lines.count());
    if common.bad || lexer.out_of_step || is_cut {
        return Outcome::Damaged;
    }
    if !ended && !lexer.at_end() && read.vertices.len() > 1 {
        oddity(
            findings,
            lexer.lines.trimmed_range(start.value_line()),
            say!(polyline_does_not_end_with_seqend).into(),
        );
    }
    let in_space = flags & IN_SPACE != 0;
    if common.paper_space {
        return Outcome::Unsupported("POLYLINE".into(), say!(it_lies_in_paper_space));
    }
    // The points of a 3D polyline are world coordinates.
    let lies = match in_space {
        true if heights.windows(2).all(|pair| pair[0] == pair[1]) => {
            Some(Lies::Level(heights.first().copied().unwrap_or(0.0)))
        }
        true => {
            let points: Vec<Vector3> = read
                .vertices
                .iter()
                .zip(&heights)
                .map(|(vertex, z)| at_height(vertex.point.coords, *z))
                .collect();
            let plane = Space::through(&points);
            if let Some(plane) = &plane {
                read.vertices
                    .iter_mut()
                    .zip(points)
                    .for_each(|(vertex, point)| vertex.point = plane.seen_from(point));
            }
            plane.map(|plane| Lies::Aslant(Box::new(plane), say!(its_points_differ_in_z)))
        }
        false => common.lies(height),
    };
    let Some(lies) = lies else {
        return Outcome::Unsupported(
            "POLYLINE".into(),
            if in_space {
                say!(its_points_differ_in_z)
            } else {
                say!(its_plane_is_tilted)
            },
        );
    };
    let mirrored = !in_space && common.plane() == Plane::Mirrored;
    polyline_of(
        Kind::Polyline,
        start,
        common,
        flags & CLOSED != 0,
        read,
        (mirrored, in_space, lies),
        lexer,
        layers,
        findings,
    )
}
