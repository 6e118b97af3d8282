//! Turns ELLIPSE and SPLINE records into curves. Their points are world coordinates.

use super::entity::{Common, Plane, Read, Refused, tag_of_record};
use super::fault;
use super::layers::Layers;
use super::lexer::{Lexer, Tag};
use super::numbers::{Numbers, missing};
use super::shape::{Shape, ellipse};
use super::space::{FLAT, Lies, Space, Vector3, in_space};
use crate::drawing::Kind;
use crate::finding::Severity;
use crate::geometry::{Point, Spline, Vector};
use std::f64::consts::TAU;

pub(super) fn read_ellipse(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
) -> Result<Read, Refused> {
    let mut numbers = Numbers::new([10, 20, 11, 21, 40, 31, 41, 42, 30]);
    let common = numbers.gather(lexer, |_, _| {});
    let [x, y, major_x, major_y, ratio] = numbers.required(start, lexer, &common)?;
    common.is_in_the_model()?;
    let [.., rise, from, to, height] = numbers.values;
    let (rise, height) = (rise.unwrap_or(0.0), height.unwrap_or(0.0));
    let (from, to) = (from.unwrap_or(0.0), to.unwrap_or(TAU));
    let (center, major) = (Point::new(x, y), Vector::new(major_x, major_y));
    let is_level = common.plane() != Plane::Tilted && rise.abs() <= FLAT * major.norm();
    let (arc, lies) = match is_level {
        true => (
            ellipse(
                center,
                major,
                ratio,
                common.plane() == Plane::Mirrored,
                from,
                to,
            ),
            Lies::Level(height),
        ),
        false => {
            // In its own plane: the half axes are its coordinates.
            let along = in_space(major, rise);
            let Some(normal) = common.normal().try_normalize(0.0) else {
                return Err(Refused::Unsupported(say!(its_plane_is_tilted)));
            };
            let plane = Space {
                x: along,
                y: normal.cross(&along),
                z: normal,
                origin: in_space(center.coords, height),
            };
            let arc = ellipse(Point::origin(), Vector::x(), ratio, false, from, to);
            (
                arc,
                Lies::Aslant(Box::new(plane), say!(its_plane_is_tilted)),
            )
        }
    };
    if !arc.is_sound() {
        let sentence = say!(ellipse_has_no_width_or_no_length).to_owned();
        lexer.damage(start.value_line(), sentence);
        return Err(Refused::Damaged);
    }
    Ok(common.finish(lexer, layers, Kind::Ellipse, (Shape::Ellipse(arc), lies)))
}

/// Points in space in the order of the text: x opens one.
#[derive(Default)]
struct Points {
    points: Vec<Point>,
    heights: Vec<f64>,
    lacks_y: bool,
    bad: bool,
}

impl Points {
    fn x(&mut self, value: f64) {
        self.bad |= self.lacks_y;
        self.points.push(Point::new(value, 0.0));
        self.heights.push(0.0);
        self.lacks_y = true;
    }

    fn y(&mut self, value: f64) {
        match self.points.last_mut() {
            Some(point) => point.y = value,
            None => self.bad = true,
        }
        self.lacks_y = false;
    }

    fn z(&mut self, value: f64) {
        if let Some(height) = self.heights.last_mut() {
            *height = value;
        }
    }

    fn is_bad(&self) -> bool {
        self.bad || self.lacks_y
    }

    fn differ_in_height(&self) -> bool {
        self.heights
            .iter()
            .zip(self.heights.iter().skip(1))
            .any(|(one, other)| (one - other).abs() > 1e-9 * one.abs().max(1.0))
    }

    fn in_space(&self) -> Vec<Vector3> {
        self.points
            .iter()
            .zip(&self.heights)
            .map(|(point, &height)| in_space(point.coords, height))
            .collect()
    }
}

/// What the tags of a SPLINE say.
#[derive(Default)]
struct SplineTags {
    controls: Points,
    through: Points,
    knots: Vec<f64>,
    weights: Vec<f64>,
    degree: Option<i64>,
    is_closed: bool,
    /// The tangents at the ends of a curve through points.
    first: [Option<f64>; 3],
    last: [Option<f64>; 3],
}

impl SplineTags {
    fn gather(lexer: &mut Lexer, common: &mut Common) -> SplineTags {
        const CLOSED: i64 = 1;
        let mut tags = SplineTags::default();
        while let Some(tag) = tag_of_record(lexer) {
            if common.take(lexer, tag) {
                continue;
            }
            match tag.code {
                10..=13 | 20..=23 | 30..=33 | 40 | 41 => {
                    // A value that is not a number has its finding.
                    if let Some(value) = common.coordinate(lexer, tag) {
                        tags.take(tag.code, value);
                    }
                }
                70 => tags.is_closed = common.flags(lexer, tag) & CLOSED != 0,
                71 => tags.degree = Some(common.flags(lexer, tag)),
                _ => {}
            }
        }
        tags
    }

    fn take(&mut self, code: i16, value: f64) {
        match code {
            10 => self.controls.x(value),
            20 => self.controls.y(value),
            30 => self.controls.z(value),
            11 => self.through.x(value),
            21 => self.through.y(value),
            31 => self.through.z(value),
            12 => self.first[0] = Some(value),
            22 => self.first[1] = Some(value),
            32 => self.first[2] = Some(value),
            13 => self.last[0] = Some(value),
            23 => self.last[1] = Some(value),
            33 => self.last[2] = Some(value),
            40 => self.knots.push(value),
            _ => self.weights.push(value),
        }
    }

    /// It has fit points alone.
    fn is_through(&self) -> bool {
        self.controls.points.is_empty()
    }

    fn lacks_knots(&self) -> bool {
        !self.is_through() && self.knots.is_empty()
    }

    fn used(&mut self) -> &mut Points {
        match self.is_through() {
            true => &mut self.through,
            false => &mut self.controls,
        }
    }

    /// Puts the points into the plane in which they lie; `None` where they lie in none.
    fn flatten(&mut self) -> Option<Lies> {
        let used = self.used();
        if !used.differ_in_height() {
            return Some(Lies::Level(used.heights.first().copied().unwrap_or(0.0)));
        }
        let points = used.in_space();
        let plane = Space::through(&points)?;
        used.points = points
            .into_iter()
            .map(|point| plane.seen_from(point))
            .collect();
        for tangent in [&mut self.first, &mut self.last] {
            if let [Some(x), Some(y), z] = *tangent {
                let seen = plane.seen_from(plane.origin + Vector3::new(x, y, z.unwrap_or(0.0)));
                *tangent = [Some(seen.x), Some(seen.y), None];
            }
        }
        Some(Lies::Aslant(Box::new(plane), say!(its_points_differ_in_z)))
    }

    /// The curve, or why there is none.
    fn spline(self) -> Result<Spline, String> {
        if self.is_through() {
            let points = self.through.points;
            let [first, last] = [self.first, self.last].map(|[x, y, _]| Some(Vector::new(x?, y?)));
            let closed = self.is_closed.then(|| Spline::round(&points)).flatten();
            return closed
                .or_else(|| Spline::through(&points, first, last))
                .ok_or_else(|| say!(has_less_than_two_different_points).to_owned());
        }
        let degree = self.degree.unwrap_or(3);
        let degree = usize::try_from(degree).map_err(|_| say!(has_the_degree, degree))?;
        match self.lacks_knots() {
            true => Spline::clamped(degree, self.controls.points, self.weights),
            false => Spline::new(degree, self.knots, self.controls.points, self.weights),
        }
    }
}

pub(super) fn read_spline(
    start: Tag,
    lexer: &mut Lexer,
    layers: &mut Layers,
) -> Result<Read, Refused> {
    let mut common = Common::default();
    let mut tags = SplineTags::gather(lexer, &mut common);
    if common.bad || lexer.out_of_step {
        return Err(Refused::Damaged);
    }
    common.is_in_the_model()?;
    if tags.used().points.is_empty() {
        missing(start, lexer, &[(10, false), (20, false)]);
        return Err(Refused::Damaged);
    }
    if tags.used().is_bad() {
        let sentence = say!(spline_has_a_point_that_lacks_x_or_y).to_owned();
        lexer.damage(start.value_line(), sentence);
        return Err(Refused::Damaged);
    }
    let Some(lies) = tags.flatten() else {
        return Err(Refused::Unsupported(say!(its_points_differ_in_z)));
    };
    let (is_through, lacks_knots) = (tags.is_through(), tags.lacks_knots());
    let spline = tags.spline();
    if lacks_knots && spline.is_ok() {
        lexer.oddity(start.value_line(), say!(spline_has_no_knots).to_owned());
    }
    // Every release with splines writes the marks, and most programs require them.
    if !common.is_marked && spline.is_ok() {
        let name = lexer.lines.trimmed_range(start.value_line());
        let sentence = say!(spline_has_no_subclass_mark).to_owned();
        fault::push(&mut lexer.findings, name, Severity::Hint, sentence);
    }
    match spline {
        Ok(spline) => Ok(common.finish(
            lexer,
            layers,
            Kind::Spline,
            (Shape::Spline(Box::new(spline)), lies),
        )),
        // An entity that is not cut anyway is reported once.
        Err(_) if matches!(lies, Lies::Aslant(..)) => {
            Err(Refused::Unsupported(say!(its_points_differ_in_z)))
        }
        Err(why) => {
            // A curve through less than two points has no length; otherwise a part of the outline is missing.
            let say = if is_through {
                Lexer::oddity
            } else {
                Lexer::damage
            };
            say(lexer, start.value_line(), say!(spline_it_is_not_drawn, why));
            Err(Refused::Damaged)
        }
    }
}
