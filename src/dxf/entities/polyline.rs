//! LWPOLYLINE and POLYLINE.

use crate::drawing::{Geometry, Kind, Vertex};
use crate::dxf::entity::{
    Common, Plane, Read, Refused, VertexLines, pass_over, pass_over_followers, tag_of_record, width,
};
use crate::dxf::fault::{meaning, quoted};
use crate::dxf::layers::Layers;
use crate::dxf::lexer::{Lexer, Tag};
use crate::dxf::lines::Lines;
use crate::dxf::numbers::missing;
use crate::dxf::shape::Shape;
use crate::dxf::space::{Lies, Space, Vector3, in_space as at_height};
use crate::finding::Finding;

/// Vertices in the order of the text: x opens one, y closes it.
#[derive(Default)]
struct Vertices {
    vertices: Vec<Vertex>,
    lines: Vec<u32>,
    /// The last vertex has no y yet.
    lacks_y: bool,
    /// The first vertex without y. Reported at the end: lines that are out of step may be the cause.
    without_y: Option<usize>,
    /// The number of vertices before the first that is followed by a tag of the whole polyline.
    own: Option<usize>,
}

impl Vertices {
    /// Takes x, y or bulge of a vertex; its line is counted from the entity's first. A value that is not a number has
    /// its finding; a stand-in keeps the later vertices in step.
    #[inline]
    fn take(&mut self, tag: Tag, start: usize, common: &mut Common, lexer: &mut Lexer) {
        let value = match tag.code {
            42 => common.bulge(lexer, tag),
            _ => common.coordinate(lexer, tag),
        };
        let value = value.unwrap_or_default();
        match (tag.code, self.vertices.last_mut()) {
            (10, _) => {
                self.close();
                self.vertices.push(Vertex::new(value, 0.0, 0.0));
                self.lines.push((tag.line - start) as u32);
                self.lacks_y = true;
            }
            (20, Some(vertex)) => {
                vertex.point.y = value;
                self.lacks_y = false;
            }
            (_, Some(vertex)) => vertex.bulge = value,
            (code, None) => {
                if !common.bad && !lexer.out_of_step {
                    let sentence = say!(
                        group_code_stands_before_the_first_group_code,
                        code,
                        meaning(code)
                    );
                    lexer.damage(tag.line, sentence);
                }
                common.bad = true;
            }
        }
    }

    /// A tag of the whole polyline has come.
    fn end_own(&mut self) {
        self.own = self.own.or(self.vertices.len().checked_sub(1));
    }

    /// A fault where a vertex has no y; `before` is the number of vertices before these.
    fn lacks_none(&self, before: usize, start: usize, lexer: &mut Lexer) -> Result<(), Refused> {
        let Some(index) = self.without_y else {
            return Ok(());
        };
        let line = start + self.lines.get(index).map_or(0, |&line| line as usize);
        let sentence = say!(vertex_lacks_group_code_20, before + index + 1);
        lexer.damage(line + 1, sentence);
        Err(Refused::Damaged)
    }

    fn close(&mut self) {
        if self.lacks_y {
            self.without_y = self.without_y.or(self.vertices.len().checked_sub(1));
        }
        self.lacks_y = false;
    }
}

pub(super) fn light_polyline(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
) -> Result<Read, Refused> {
    let mut common = Common::default();
    let mut read = Vertices::default();
    let (mut closed, mut count, mut height) = (false, None, 0.0);
    while let Some(tag) = tag_of_record(lexer) {
        match tag.code {
            10 | 20 | 42 if !common.foreign && !common.group => {
                read.take(tag, start.line, &mut common, lexer)
            }
            _ if common.take(lexer, tag) => read.end_own(),
            40 | 41 | 43 => common.take_width(lexer, tag),
            38 | 70 | 90 => {
                read.end_own();
                match tag.code {
                    70 => closed = common.flags(lexer, tag) & 1 != 0,
                    38 => height = common.coordinate(lexer, tag).unwrap_or_default(),
                    _ => count = Some(tag),
                }
            }
            _ => {}
        }
    }
    read.close();
    if common.bad || lexer.out_of_step {
        return Err(Refused::Damaged);
    }
    read.lacks_none(0, start.line, lexer)?;
    common.is_in_the_model()?;
    let lies = common.lies(height)?;
    let mirrored = common.plane() == Plane::Mirrored;
    if let Some(tag) = count {
        compare_count(lexer, tag, read.vertices.len());
    }
    // What is stated after a vertex does not stay in its place when another vertex is added.
    let first = read.lines.first().copied().unwrap_or_default();
    let line = count.map_or(0, |tag| (tag.line - start.line) as u32);
    let own = match line < first {
        // What one vertex says of the width, all of it may have.
        true if common.width() <= 0.0 => read.own.unwrap_or(read.vertices.len()),
        _ => 0,
    };
    let own = (own as u32, line);
    polyline_of(
        Kind::LightPolyline,
        start,
        common,
        closed,
        (read, own),
        (mirrored, false, lies),
        lexer,
        layers,
    )
}

/// A finding where `tag` states another number of vertices than was found.
fn compare_count(lexer: &mut Lexer, tag: Tag, found: usize) {
    if found > 1 && Common::whole(lexer, tag) != i64::try_from(found).ok() {
        let stated = quoted(lexer.lines.trimmed(tag.value_line()));
        let sentence = say!(another_number_of_vertices_is_stated, stated, found);
        lexer.oddity_in(lexer.lines.range(tag.value_line()), sentence);
    }
}

/// Some neighbouring vertices of a LWPOLYLINE, read again.
pub(in crate::dxf) struct ReadRun {
    pub(in crate::dxf) vertices: Vec<Vertex>,
    /// Their first lines, counted from the entity's.
    pub(in crate::dxf) lines: Vec<u32>,
    pub(in crate::dxf) findings: Vec<Finding>,
    /// The entity is damaged in them.
    pub(in crate::dxf) is_damaged: bool,
}

/// Reads vertices of the LWPOLYLINE that begins at the line `start`, from the vertex with index
/// `from` on, whose x stands at the line `at`, until `ends_at` is true of the line of the next tag.
/// `None` where one of their tags belongs to the whole polyline, or where they do not end there.
pub(in crate::dxf) fn read_run(
    lines: Lines,
    start: usize,
    (from, at): (usize, usize),
    mut ends_at: impl FnMut(usize) -> Option<bool>,
) -> Option<ReadRun> {
    let mut lexer = Lexer::within(lines, start, at);
    let (mut common, mut read) = (Common::default(), Vertices::default());
    while !ends_at(lexer.at())? {
        let tag = tag_of_record(&mut lexer)?;
        match tag.code {
            10 | 20 | 42 => read.take(tag, start, &mut common, &mut lexer),
            38 | 70 | 90 => return None,
            40 | 41 | 43 if width(&lexer, tag) > 0.0 => return None,
            _ if common.take(&mut lexer, tag) => return None,
            _ => {}
        }
    }
    read.close();
    let is_damaged =
        common.bad || lexer.out_of_step || read.lacks_none(from, start, &mut lexer).is_err();
    Some(ReadRun {
        vertices: read.vertices,
        lines: read.lines,
        findings: lexer.findings,
        is_damaged,
    })
}

/// The finding of a LWPOLYLINE that states, in the tag at this line, another number of vertices than it has.
pub(in crate::dxf) fn count_finding(lines: Lines, line: usize, found: usize) -> Vec<Finding> {
    let mut lexer = Lexer::new(lines, line);
    compare_count(&mut lexer, Tag { code: 90, line }, found);
    lexer.findings
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
    (mut read, (own, count)): (Vertices, (u32, u32)),
    (mirrored, in_space, lies): (bool, bool, Lies),
    lexer: &mut Lexer,
    layers: &mut Layers,
) -> Result<Read, Refused> {
    if read.vertices.len() < 2 {
        let sentence = say!(has_vertices_expected_at_least_2, kind, read.vertices.len());
        lexer.oddity(start.value_line(), sentence);
        return Err(Refused::Damaged);
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
        own,
        count,
        width: common.width(),
    };
    let read = common.finish(lexer, layers, kind, (Shape::Plain(geometry), lies));
    Ok(Read {
        vertices: Some(Box::new(vertices)),
        ..read
    })
}

/// A vertex after x is reversed. Its own inverse.
pub(in crate::dxf) fn mirror(vertex: &mut Vertex) {
    vertex.point.x = 0.0 - vertex.point.x;
    vertex.bulge = 0.0 - vertex.bulge;
}

/// POLYLINE with its VERTEX records, up to and with SEQEND.
pub(super) fn polyline(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
) -> Result<Read, Refused> {
    const CLOSED: i64 = 1;
    const IN_SPACE: i64 = 8;
    const MESHES: i64 = 16 | 64;
    const CONTROL_POINT: i64 = 16;
    let (mut flags, mut height) = (0, 0.0);
    let mut common = Common::default();
    while let Some(tag) = tag_of_record(lexer) {
        if common.take(lexer, tag) {
            continue;
        }
        match tag.code {
            70 => flags = common.flags(lexer, tag),
            30 => height = common.coordinate(lexer, tag).unwrap_or_default(),
            40 | 41 => common.take_width(lexer, tag),
            _ => {}
        }
    }
    if flags & MESHES != 0 {
        pass_over_followers(lexer, &[b"VERTEX", b"SEQEND"]);
        common.is_in_the_model()?;
        return Err(Refused::Unsupported(say!(it_is_a_mesh)));
    }
    let mut read = Vertices::default();
    let (mut heights, mut ended) = (Vec::new(), false);
    while let Some(next) = lexer.peek_record() {
        let name = lexer.lines.trimmed(next.value_line());
        if !matches!(name, b"VERTEX" | b"SEQEND") {
            break;
        }
        lexer.next();
        if name == b"SEQEND" {
            pass_over(lexer);
            ended = true;
            break;
        }
        let mut of_vertex = Common::default();
        let (mut numbers, mut vertex_flags) = ([None; 4], 0);
        while let Some(tag) = tag_of_record(lexer) {
            if of_vertex.take(lexer, tag) {
                continue;
            }
            match tag.code {
                10 => numbers[0] = of_vertex.coordinate(lexer, tag),
                20 => numbers[1] = of_vertex.coordinate(lexer, tag),
                30 => numbers[2] = of_vertex.coordinate(lexer, tag),
                42 => numbers[3] = of_vertex.bulge(lexer, tag),
                70 => vertex_flags = of_vertex.flags(lexer, tag),
                40 | 41 => common.take_width(lexer, tag),
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
    // The text ends within the name of the next record, which has the finding; it may have been a VERTEX.
    let is_cut = !ended
        && lexer.lines.last_is_open()
        && lexer
            .peek_record()
            .is_some_and(|next| next.line + 2 >= lexer.lines.count());
    if common.bad || lexer.out_of_step || is_cut {
        return Err(Refused::Damaged);
    }
    if !ended && !lexer.at_end() && read.vertices.len() > 1 {
        lexer.oddity(
            start.value_line(),
            say!(polyline_does_not_end_with_seqend).into(),
        );
    }
    let in_space = flags & IN_SPACE != 0;
    common.is_in_the_model()?;
    // The points of a 3D polyline are world coordinates.
    let lies = match in_space {
        true if heights
            .iter()
            .zip(heights.iter().skip(1))
            .all(|(one, other)| one == other) =>
        {
            Lies::Level(heights.first().copied().unwrap_or(0.0))
        }
        true => {
            let points: Vec<Vector3> = read
                .vertices
                .iter()
                .zip(&heights)
                .map(|(vertex, z)| at_height(vertex.point.coords, *z))
                .collect();
            let rises = say!(its_points_differ_in_z);
            let plane = Space::through(&points).ok_or(Refused::Unsupported(rises))?;
            read.vertices
                .iter_mut()
                .zip(points)
                .for_each(|(vertex, point)| vertex.point = plane.seen_from(point));
            Lies::Aslant(Box::new(plane), rises)
        }
        false => common.lies(height)?,
    };
    let mirrored = !in_space && common.plane() == Plane::Mirrored;
    polyline_of(
        Kind::Polyline,
        start,
        common,
        flags & CLOSED != 0,
        (read, (0, 0)),
        (mirrored, in_space, lies),
        lexer,
        layers,
    )
}
