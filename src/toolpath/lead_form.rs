//! The form of a lead: straight, round a corner, or along an arc.

use super::path::{PathSegment, Source};
use crate::geometry::{Arc, Point, Segment, Vector, cross, direction, left_normal, turn};
use crate::settings::Lead;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A lead needs no corner if it is at right angles to the contour within this angle, radians.
const OBLIQUE: f64 = 0.02;

/// How often the radius of an arc is halved.
const MOST_HALVED: usize = 24;

/// Where a lead reaches the path of the wire's centre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landing {
    /// On the way of the wire's centre.
    pub at: Point,
    /// On the programmed path: the same, unless the control offsets it.
    path: Point,
    /// The direction in which the path goes on.
    along: Vector,
    /// Away from the part.
    room: Vector,
    /// How much nearer to the part the programmed path lies.
    control: f64,
}

impl Landing {
    /// Where a path begins, at `path`, that runs to the `side` of its contour; the control lets the wire run `control`
    /// beside it.
    pub(crate) fn of_begin(path: Point, along: Vector, side: f64, control: f64) -> Landing {
        let room = left_normal(along) * side;
        let at = match control {
            0.0 => path,
            control => path + room * control,
        };
        Landing {
            at,
            path,
            along,
            room,
            control,
        }
    }

    /// The direction away from the part.
    pub(super) fn room(&self) -> Vector {
        self.room
    }

    /// True where a lead that ends in this direction comes from the part's side of the path.
    pub(super) fn is_reached_from_the_part(&self, direction: Vector) -> bool {
        direction.dot(&self.room) > 1e-9
    }

    /// True where a straight lead would not be at right angles to the path.
    fn is_oblique_from(&self, thread: Point) -> bool {
        let oblique = turn(self.along, self.at - thread).abs() - FRAC_PI_2;
        oblique.abs() > OBLIQUE
    }

    /// Where the same path ends, once round its contour: its way out is a lead gone backwards.
    pub(super) fn once_round(&self) -> Landing {
        Landing {
            along: -self.along,
            ..*self
        }
    }

    /// Where such a path ends, at `path`, for a lead that is gone backwards.
    pub(crate) fn of_end(path: Point, along: Vector, side: f64, control: f64) -> Landing {
        Landing::of_begin(path, along, side, control).once_round()
    }
}

/// The form of one lead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    Straight,
    /// At right angles to the contour from a corner this far beside the path.
    Corner(f64),
    /// Along an arc of this radius, which ends tangent to the path.
    Arc(f64),
}

impl Way {
    /// The possible forms of a lead, the best first. `length` is the largest distance of a corner from the path;
    /// `least` is the least radius of an arc. None where the thread hole lies too near for an arc.
    pub(super) fn all(
        lead: Lead,
        thread: Point,
        landing: &Landing,
        length: f64,
        least: f64,
    ) -> Vec<Way> {
        let way = thread - landing.at;
        match lead {
            _ if way.norm() <= least * 1e-6 => vec![Way::Straight],
            Lead::Straight => vec![Way::Straight],
            Lead::Perpendicular => {
                let aside = way.dot(&landing.room).min(length);
                let is_oblique = landing.is_oblique_from(thread);
                let corner = (is_oblique && aside > least && landing.control == 0.0)
                    .then_some(Way::Corner(aside));
                corner.into_iter().chain([Way::Straight]).collect()
            }
            Lead::Arc => {
                let halved =
                    std::iter::successors(Some(way.norm() / 3.0), |radius| Some(radius / 2.0));
                let halved = halved
                    .take(MOST_HALVED)
                    .take_while(|&radius| radius > least);
                let fits = |radius: &f64| arc(thread, landing, *radius, false).is_some();
                halved.chain([least]).filter(fits).map(Way::Arc).collect()
            }
        }
    }

    /// The lead from the thread hole to the landing: for the wire's centre, or as programmed where the control offsets
    /// it.
    pub(super) fn pieces(self, thread: Point, landing: &Landing, programmed: bool) -> Vec<Segment> {
        let at = if programmed { landing.path } else { landing.at };
        match self {
            _ if thread == at => Vec::new(),
            Way::Straight => vec![Segment::line(thread, at)],
            Way::Corner(aside) => {
                let corner = at + landing.room * aside;
                vec![Segment::line(thread, corner), Segment::line(corner, at)]
            }
            Way::Arc(radius) => arc(thread, landing, radius, programmed).unwrap_or_default(),
        }
    }
}

/// Straight to an arc and along it to the landing. The straight piece is tangent to the programmed arc. `None` where
/// the thread hole lies within the arc's circle, or the arc would go more than three quarters round.
fn arc(thread: Point, landing: &Landing, radius: f64, programmed: bool) -> Option<Vec<Segment>> {
    let center = landing.at + landing.room * radius;
    let outer = radius + landing.control;
    let (to_thread, sign) = (thread - center, cross(landing.along, landing.room).signum());
    let share = outer / to_thread.norm();
    if share.is_nan() || share >= 1.0 - 1e-6 {
        return None;
    }
    // Against the direction of travel, the tangent from the thread hole touches this far ahead of it.
    let touch = to_thread.y.atan2(to_thread.x) + sign * share.acos();
    let to_landing = -landing.room;
    let sweep = ((to_landing.y.atan2(to_landing.x) - touch) * sign).rem_euclid(TAU);
    if !(1e-6..1.5 * PI).contains(&sweep) {
        return None;
    }
    let (radius, end) = match programmed {
        true => (outer, landing.path),
        false => (radius, landing.at),
    };
    let begin = center + direction(touch) * radius;
    Some(vec![
        Segment::line(thread, begin),
        Segment::Arc(Arc {
            radius,
            ..Arc::about(center, begin, end, sign > 0.0)
        }),
    ])
}

/// A lead as pieces of a path.
pub(super) fn lead_in(pieces: Vec<Segment>) -> impl Iterator<Item = PathSegment> {
    pieces.into_iter().map(|geometry| PathSegment {
        geometry,
        source: Source::LeadIn,
    })
}

/// The same gone backwards, as the way out.
pub(super) fn lead_out(pieces: Vec<Segment>) -> impl Iterator<Item = PathSegment> {
    pieces.into_iter().rev().map(|geometry| PathSegment {
        geometry: geometry.reversed(),
        source: Source::LeadOut,
    })
}

/// The largest angle between a lead and its contour, radians: the turn of the wire there. `None` without leads.
pub(crate) fn largest_lead_angle(segments: &[PathSegment]) -> Option<f64> {
    let is_lead = |piece: &PathSegment| matches!(piece.source, Source::LeadIn | Source::LeadOut);
    let angle = |pair: &[PathSegment]| {
        let [before, behind] = pair else { return None };
        (is_lead(before) != is_lead(behind)).then(|| {
            turn(
                before.geometry.end_tangent(),
                behind.geometry.start_tangent(),
            )
            .abs()
        })
    };
    segments.windows(2).filter_map(angle).max_by(f64::total_cmp)
}
