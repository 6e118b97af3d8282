//! A disc beside the walls of a contour: where it touches them, and where its centre may lie so that it does.

use super::Limits;
use super::wall::Wall;
use crate::finding::Side;
use crate::geometry::Locus;
use crate::geometry::{Point, Segment, Vector, left_normal};

/// A place where a disc touches a wall: along it, or at its start vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    pub(crate) index: usize,
    pub(crate) at_vertex: bool,
    /// From the place towards the disc's centre.
    pub(crate) normal: Vector,
}

/// How far a wall may reach into a disc by rounding.
pub(super) fn slack(limits: &Limits, radius: f64) -> f64 {
    (1e-6 * radius).max(limits.tolerances.clearance)
}

/// Where the centre of a disc may lie that touches a wall, or its start vertex.
pub(super) fn loci(wall: &Wall, side: Side, radius: f64) -> [Option<Locus>; 2] {
    let along = Locus::beside(
        wall.geometry(),
        side.sign(),
        radius,
        wall.outlook.limits.tolerances.zero_length,
    );
    [
        along,
        wall.starts_in_tip(side)
            .then(|| Locus::about(wall.geometry().start(), radius)),
    ]
}

/// How a disc on one side of a wall touches it, if it does.
pub(super) fn touch(wall: &Wall, side: Side, center: Point, radius: f64) -> Option<Touch> {
    let slack = slack(wall.outlook.limits, radius);
    let geometry = wall.geometry();
    let share = geometry.share_of(center);
    let rounding = 1e-9 / geometry.length();
    let place = foot(geometry, center, share);
    let away = center - place;
    let touches = |distance: f64| (distance - radius).abs() <= slack;
    if (-rounding..=1.0 + rounding).contains(&share)
        && touches(away.norm())
        && left_normal(geometry.tangent_at(share)).dot(&away) * side.sign() > 0.0
    {
        return Some(Touch {
            index: wall.index,
            at_vertex: false,
            normal: away / away.norm(),
        });
    }
    let corner = wall.corners().next().filter(|_| wall.starts_in_tip(side))?;
    let away = center - corner.at;
    let normal = away.try_normalize(0.0)?;
    (touches(away.norm()) && corner.is_nearest(normal)).then_some(Touch {
        index: wall.index,
        at_vertex: true,
        normal,
    })
}

/// The place on a segment's line or circle nearest to `point`, which lies at `share` of the segment.
fn foot(segment: &Segment, point: Point, share: f64) -> Point {
    match segment {
        Segment::Line(line) => line.start + (line.end - line.start) * share,
        Segment::Arc(arc) => (point - arc.center)
            .try_normalize(0.0)
            .map_or(arc.start, |away| arc.center + away * arc.radius),
    }
}
