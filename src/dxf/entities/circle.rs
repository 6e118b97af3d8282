//! ARC and CIRCLE.

use crate::drawing::{Geometry, Kind};
use crate::dxf::entity::{Plane, Read, Refused, value_line_of};
use crate::dxf::fault::quoted;
use crate::dxf::layers::Layers;
use crate::dxf::lexer::{Lexer, Tag};
use crate::dxf::numbers::Numbers;
use crate::dxf::shape::Shape;
use crate::geometry::{Point, radians_of_arc};

/// The radius, if it is positive; else a finding.
fn radius_of(value: f64, kind: &str, start: Tag, lexer: &mut Lexer) -> Option<f64> {
    if value > 0.0 {
        return Some(value);
    }
    let radius_line = value_line_of(start, lexer, 40);
    let found = quoted(lexer.lines.trimmed(radius_line));
    let sentence = say!(the_radius_is_not_above_0, kind, found);
    lexer.damage(radius_line, sentence);
    None
}

pub(super) fn arc(start: Tag, lexer: &mut Lexer, layers: &mut Layers) -> Result<Read, Refused> {
    let mut numbers = Numbers::new([10, 20, 40, 50, 51, 30]);
    let common = numbers.gather(lexer, |_, _| {});
    let [x, y, radius, from, to] = numbers.required(start, lexer, &common)?;
    // A point begins and ends in the same direction: a fillet of no radius leaves it behind. Else the radius is
    // damaged.
    let is_point = radius == 0.0 && (to - from) % 360.0 == 0.0;
    if is_point {
        let place = lexer.lines.trimmed_range(value_line_of(start, lexer, 40));
        lexer.oddity_in(place, say!(arc_has_the_radius_0).into());
    } else if radius_of(radius, "ARC", start, lexer).is_none() {
        return Err(Refused::Damaged);
    }
    let (from, to) = radians_of_arc(from, to);
    let lies = common.lies(numbers.values[5].unwrap_or(0.0))?;
    let (center, (start_angle, end_angle)) = match common.plane() {
        _ if common.paper_space => {
            return Err(Refused::Unsupported(say!(it_lies_in_paper_space)));
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
    Ok(common.finish(lexer, layers, Kind::Arc, (Shape::Plain(geometry), lies)))
}

/// Start and end of an arc, counter-clockwise again after x is reversed. Its own inverse.
pub(in crate::dxf) fn mirrored_angles(start: f64, end: f64) -> (f64, f64) {
    (std::f64::consts::PI - end, std::f64::consts::PI - start)
}

pub(super) fn circle(start: Tag, lexer: &mut Lexer, layers: &mut Layers) -> Result<Read, Refused> {
    let mut numbers = Numbers::new([10, 20, 40, 30]);
    let common = numbers.gather(lexer, |_, _| {});
    let [x, y, radius] = numbers.required(start, lexer, &common)?;
    let Some(radius) = radius_of(radius, "CIRCLE", start, lexer) else {
        return Err(Refused::Damaged);
    };
    let lies = common.lies(numbers.values[3].unwrap_or(0.0))?;
    let x = match common.plane() {
        _ if common.paper_space => {
            return Err(Refused::Unsupported(say!(it_lies_in_paper_space)));
        }
        Plane::Normal | Plane::Tilted => x,
        Plane::Mirrored => 0.0 - x,
    };
    let shape = Shape::Plain(Geometry::Circle {
        center: Point::new(x, y),
        radius,
    });
    Ok(common.finish(lexer, layers, Kind::Circle, (shape, lies)))
}
