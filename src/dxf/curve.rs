//! ELLIPSE and SPLINE: their records to curves. Their points are world coordinates.

use super::entity::{Common, NOT_PLANE, Numbers, Outcome, PAPER_SPACE, Plane, TILTED, missing, tag_of_record};
use super::fault::{damage, oddity};
use super::layers::Layers;
use super::lexer::{Lexer, Tag};
use super::shape::{Shape, ellipse};
use crate::finding::Finding;
use crate::geometry::{Point, Spline, Vector};
use std::f64::consts::TAU;

pub(super) fn read_ellipse(start: Tag, lexer: &mut Lexer, layers: &mut Layers, findings: &mut Vec<Finding>) -> Outcome {
    let mut numbers = Numbers::new([10, 20, 11, 21, 40, 31, 41, 42]);
    let common = numbers.gather(lexer, findings, |_, _| {});
    let Some([x, y, major_x, major_y, ratio]) = numbers.required(start, lexer, &common, findings) else { return Outcome::Damaged };
    let mirrored = match common.plane() {
        _ if common.paper_space => return Outcome::Unsupported("ELLIPSE".into(), PAPER_SPACE),
        Plane::Tilted => return Outcome::Unsupported("ELLIPSE".into(), TILTED),
        plane => plane == Plane::Mirrored,
    };
    let major = Vector::new(major_x, major_y);
    if numbers.values[5].unwrap_or(0.0).abs() > 1e-9 * major.norm() {
        return Outcome::Unsupported("ELLIPSE".into(), TILTED);
    }
    let (from, to) = (numbers.values[6].unwrap_or(0.0), numbers.values[7].unwrap_or(TAU));
    let arc = ellipse(Point::new(x, y), major, ratio, mirrored, from, to);
    if !arc.is_sound() {
        let sentence = "ELLIPSE has no width or no length: it is not drawn".to_owned();
        damage(findings, lexer.lines.trimmed_range(start.value_line()), sentence);
        return Outcome::Damaged;
    }
    common.finish(lexer, layers, "ELLIPSE", Shape::Ellipse(arc), None, findings)
}

/// Points in space as they come: x opens one.
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
        self.heights.windows(2).any(|pair| (pair[0] - pair[1]).abs() > 1e-9 * pair[0].abs().max(1.0))
    }
}

pub(super) fn read_spline(start: Tag, lexer: &mut Lexer, layers: &mut Layers, findings: &mut Vec<Finding>) -> Outcome {
    const CLOSED: i64 = 1;
    let mut common = Common::default();
    let (mut controls, mut through) = (Points::default(), Points::default());
    let (mut knots, mut weights) = (Vec::new(), Vec::new());
    let (mut degree, mut flags) = (None, 0);
    let mut tangents: [Option<f64>; 4] = [None; 4];
    while let Some(tag) = tag_of_record(lexer, findings) {
        if common.take(lexer, tag, findings) {
            continue;
        }
        match tag.code {
            10..=13 | 20..=23 | 30..=31 | 40 | 41 => {
                // A number that is none has its finding.
                let Some(value) = common.coordinate(lexer, tag, findings) else { continue };
                match tag.code {
                    10 => controls.x(value),
                    20 => controls.y(value),
                    30 => controls.z(value),
                    11 => through.x(value),
                    21 => through.y(value),
                    31 => through.z(value),
                    12 => tangents[0] = Some(value),
                    22 => tangents[1] = Some(value),
                    13 => tangents[2] = Some(value),
                    23 => tangents[3] = Some(value),
                    40 => knots.push(value),
                    _ => weights.push(value),
                }
            }
            70 => flags = common.flags(lexer, tag, findings),
            71 => degree = Some(common.flags(lexer, tag, findings)),
            _ => {}
        }
    }
    if common.bad || lexer.out_of_step {
        return Outcome::Damaged;
    }
    if common.paper_space {
        return Outcome::Unsupported("SPLINE".into(), PAPER_SPACE);
    }
    if controls.points.is_empty() && through.points.is_empty() {
        missing(start, lexer, &[(10, false), (20, false)], findings);
        return Outcome::Damaged;
    }
    let used = if controls.points.is_empty() { &through } else { &controls };
    if used.is_bad() {
        let sentence = "SPLINE has a point that lacks x or y".to_owned();
        damage(findings, lexer.lines.trimmed_range(start.value_line()), sentence);
        return Outcome::Damaged;
    }
    if used.differ_in_height() {
        return Outcome::Unsupported("SPLINE".into(), NOT_PLANE);
    }
    let spline = if controls.points.is_empty() {
        let points = through.points;
        let tangent = |x: Option<f64>, y: Option<f64>| Some(Vector::new(x?, y?));
        let closed = if flags & CLOSED != 0 { Spline::round(&points) } else { None };
        closed
            .or_else(|| Spline::through(&points, tangent(tangents[0], tangents[1]), tangent(tangents[2], tangents[3])))
            .ok_or_else(|| "has less than two different points".to_owned())
    } else {
        let degree = degree.unwrap_or(3);
        usize::try_from(degree)
            .map_err(|_| format!("has the degree {degree}"))
            .and_then(|degree| Spline::new(degree, knots, controls.points, weights))
    };
    match spline {
        Ok(spline) => common.finish(lexer, layers, "SPLINE", Shape::Spline(Box::new(spline)), None, findings),
        Err(why) => {
            oddity(findings, lexer.lines.trimmed_range(start.value_line()), format!("SPLINE {why}: it is not drawn"));
            Outcome::Damaged
        }
    }
}
