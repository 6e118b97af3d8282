//! What a way of the electrode takes where it comes near itself: the strips to both sides of it overlap, and what is gone is not eroded again.

use super::super::clearance::Walls;
use crate::geometry::{Bounds, Point, Segment, direction, left_normal, turn};

/// Places along a way that are looked at, and distances from it at each of them on either side.
const PLACES: usize = 600;
const ASIDE: usize = 24;

/// Two pieces that turn by less than this (radians) go on straight.
const STRAIGHT: f64 = 1e-6;

/// How long a straight way would be that takes as much as these pieces do one after the other, each `width` wide; without the round ends
/// of an open way. It is their own length where they keep off each other.
pub(crate) fn swept_length(pieces: &[Segment], is_closed: bool, width: f64) -> f64 {
    let length: f64 = pieces.iter().map(Segment::length).sum();
    let swept = Swept {
        walls: Walls::new(pieces.to_vec()),
        is_closed,
        half: width / 2.0,
    };
    let gained: f64 = (0..pieces.len())
        .map(|index| swept.of_piece(index, length) + swept.of_corner(index))
        .sum();
    (length + gained / width).max(0.0)
}

/// The strip to both sides of a way, and the round parts outside of its corners.
struct Swept {
    walls: Walls,
    is_closed: bool,
    half: f64,
}

impl Swept {
    /// How much more a piece takes than its length by the width: less than nothing where others take it, too.
    fn of_piece(&self, index: usize, all: f64) -> f64 {
        let piece = self.walls.segment(index);
        let length = piece.length();
        let count = (PLACES as f64 * length / all).ceil().max(1.0) as usize;
        let step = length / count as f64;
        let thick = self.half / ASIDE as f64;
        let mut gained = 0.0;
        for place in 0..count {
            let share = (place as f64 + 0.5) / count as f64;
            let (at, normal) = (piece.point_at(share), left_normal(piece.tangent_at(share)));
            // Not at the same distances everywhere: what runs beside would be met all along, or nowhere.
            let shift = (place as f64 * 0.618_033_988_75).fract();
            for nth in 0..ASIDE {
                let aside = (nth as f64 + shift) * thick;
                for aside in [aside, -aside] {
                    let bent = piece
                        .as_arc()
                        .map_or(0.0, |arc| aside / arc.radius * -arc.sweep.signum());
                    let own = 1.0 + bent;
                    gained += step
                        * thick
                        * match own > 0.0 {
                            true => own * (1.0 / self.takers(at + normal * aside) as f64 - 1.0),
                            // Beyond the centre of an arc lies what its other places take.
                            false => -own,
                        };
                }
            }
        }
        gained
    }

    /// What the round part outside of the corner at the end of a piece takes.
    fn of_corner(&self, index: usize) -> f64 {
        let Some([from, angle]) = self.corner(index) else {
            return 0.0;
        };
        let at = self.walls.segment(index).end();
        let count = (angle.abs() * ASIDE as f64 / 2.0).ceil();
        let thick = self.half / ASIDE as f64;
        let mut taken = 0.0;
        for place in 0..count as usize {
            let way = direction(from + angle * (place as f64 + 0.5) / count);
            for nth in 0..ASIDE {
                let away = (nth as f64 + 0.5) * thick;
                let own = away * thick * angle.abs() / count;
                taken += own / self.takers(at + way * away) as f64;
            }
        }
        taken
    }

    /// Where the round part outside of the corner at the end of a piece begins, and how far it turns; `None` where there is no corner.
    fn corner(&self, index: usize) -> Option<[f64; 2]> {
        let count = self.walls.segments().len();
        let next = match index + 1 < count {
            true => index + 1,
            false if self.is_closed => 0,
            false => return None,
        };
        let [before, behind] = [index, next].map(|index| self.walls.segment(index));
        let (into, out) = (before.end_tangent(), behind.start_tangent());
        let angle = turn(into, out);
        let outside = left_normal(into) * -angle.signum();
        (angle.abs() > STRAIGHT).then(|| [outside.y.atan2(outside.x), angle])
    }

    /// How many pieces and corners take a point: at least one, that from which it is asked.
    fn takers(&self, point: Point) -> usize {
        let mut count = 0;
        self.walls
            .find(&Bounds::of_disc(point, self.half), |index| {
                count += usize::from(self.is_beside(index, point));
                count += usize::from(self.is_in_corner(index, point));
                false
            });
        count.max(1)
    }

    fn is_beside(&self, index: usize, point: Point) -> bool {
        match self.walls.segment(index) {
            Segment::Line(line) => {
                let share = line.share_of(point);
                let foot = line.start + (line.end - line.start) * share;
                (0.0..1.0).contains(&share) && (point - foot).norm() <= self.half
            }
            Segment::Arc(arc) => {
                let share = arc.share_of(point);
                let aside = (point - arc.center).norm() - arc.radius;
                (0.0..1.0).contains(&share) && aside.abs() <= self.half
            }
        }
    }

    fn is_in_corner(&self, index: usize, point: Point) -> bool {
        let away = point - self.walls.segment(index).end();
        let is_within = |[from, angle]: [f64; 2]| {
            let own = turn(direction(from), away);
            own * angle.signum() >= 0.0 && own.abs() <= angle.abs()
        };
        away.norm() <= self.half && self.corner(index).is_some_and(is_within)
    }
}
