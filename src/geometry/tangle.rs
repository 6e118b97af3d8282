//! How much of an offset lies in one place, which says what it takes to find out its loops.

use super::{Bounds, Point, Segment, left_normal};

/// A look is a distance of a point from a segment; one for this many candidates that an index hands out.
const CANDIDATES_OF_A_LOOK: u64 = 4;
/// Two pieces that meet are cut there, and what is left of them is measured again.
const LOOKS_OF_A_MEETING: u64 = 16;

/// Pieces of an offset that follow each other this closely always meet.
const NEIGHBOURS: usize = 2;

/// A piece of a raw offset.
struct Piece {
    bounds: Bounds,
    /// Its ends, where it is straight.
    ends: Option<[Point; 2]>,
}

/// The looks that it takes to find the loops of the offset of a closed contour by `by`, to the left where positive: for each pair of pieces
/// of the raw offset (the segments moved aside, and the arcs about their joints) that come together, and for the segments near each piece.
/// More than `most` counts as `most + 1`. An estimate: the pieces are not trimmed, and arcs are their boxes.
pub(crate) fn looks_of_offset(segments: &[Segment], by: f64, most: u64) -> u64 {
    let aside = |point: Point, tangent| point + left_normal(tangent) * by;
    let mut pieces = Vec::with_capacity(2 * segments.len());
    let behind = segments.iter().cycle().skip(1);
    for (segment, next) in segments.iter().zip(behind) {
        let start = aside(segment.start(), segment.start_tangent());
        let end = aside(segment.end(), segment.end_tangent());
        // An arc within which the correction does not fit turns over.
        let is_bent = |arc: &super::Arc| arc.radius > by * arc.sweep.signum();
        let moved = match segment.as_arc().is_some_and(is_bent) {
            true => Segment::from_bulge(start, end, segment.bulge()),
            false => Segment::line(start, end),
        };
        let turn = super::turn(segment.end_tangent(), next.start_tangent());
        let behind = aside(next.start(), next.start_tangent());
        let joint = Segment::from_bulge(end, behind, (turn / 4.0).tan());
        pieces.extend([moved, joint].map(|piece| {
            Piece {
                bounds: piece.bounds(),
                ends: piece
                    .as_arc()
                    .is_none()
                    .then(|| [piece.start(), piece.end()]),
            }
        }));
    }
    let walls: Vec<Bounds> = segments.iter().map(Segment::bounds).collect();
    let near = candidates(&walls, &pieces, by.abs()) / CANDIDATES_OF_A_LOOK;
    let left = most.saturating_sub(near);
    let met = looks_of_meetings(&pieces, left);
    near.saturating_add(met).min(most.saturating_add(1))
}

/// For the middles of all pieces together, how many walls lie within `distance` in X or in Y, whichever are fewer.
fn candidates(walls: &[Bounds], pieces: &[Piece], distance: f64) -> u64 {
    let sorted = |of: &dyn Fn(&Bounds) -> f64| {
        let mut all: Vec<f64> = walls.iter().map(of).collect();
        all.sort_unstable_by(f64::total_cmp);
        all
    };
    let starts = [sorted(&|it| it.min.x), sorted(&|it| it.min.y)];
    let ends = [sorted(&|it| it.max.x), sorted(&|it| it.max.y)];
    let among = |axis: usize, at: f64| {
        let begun = starts[axis].partition_point(|&start| start <= at + distance);
        let ended = ends[axis].partition_point(|&end| end < at - distance);
        begun.saturating_sub(ended) as u64
    };
    let of_piece = |piece: &Piece| {
        let middle = nalgebra::center(&piece.bounds.min, &piece.bounds.max);
        among(0, middle.x).min(among(1, middle.y))
    };
    pieces.iter().map(of_piece).sum()
}

/// The looks at all pairs of pieces whose boxes overlap, of those that do not follow each other closely; the count ends beyond `most`.
fn looks_of_meetings(pieces: &[Piece], most: u64) -> u64 {
    let mut size = Bounds::EMPTY;
    pieces.iter().for_each(|piece| size.merge(&piece.bounds));
    // Along the axis on which the boxes overlap less.
    let across: f64 = pieces.iter().map(|piece| piece.bounds.width()).sum();
    let up: f64 = pieces.iter().map(|piece| piece.bounds.height()).sum();
    let along_x = across * size.height() <= up * size.width();
    let along = |piece: &Piece| match along_x {
        true => (piece.bounds.min.x, piece.bounds.max.x),
        false => (piece.bounds.min.y, piece.bounds.max.y),
    };
    let mut order: Vec<(usize, &Piece)> = pieces.iter().enumerate().collect();
    order.sort_unstable_by(|(_, a), (_, b)| along(a).0.total_cmp(&along(b).0));
    let follow = |a: usize, b: usize| {
        let apart = a.abs_diff(b);
        apart.min(pieces.len() - apart) <= NEIGHBOURS
    };
    let mut looks = 0;
    for (at, &(index, one)) in order.iter().enumerate() {
        let end = along(one).1;
        let behind = order[at + 1..].iter();
        for &(other_index, other) in behind.take_while(|(_, other)| along(other).0 <= end) {
            if one.bounds.touches(&other.bounds) && !follow(index, other_index) {
                looks += if may_cross(one, other) {
                    LOOKS_OF_A_MEETING
                } else {
                    1
                };
            }
        }
        if looks > most {
            break;
        }
    }
    looks
}

/// False for two straight pieces that do not cross.
fn may_cross(one: &Piece, other: &Piece) -> bool {
    let (Some(one), Some(other)) = (one.ends, other.ends) else {
        return true;
    };
    let parted = |[start, end]: [Point; 2], of: [Point; 2]| {
        let sides = of.map(|point| super::cross(end - start, point - start));
        sides[0] * sides[1] > 0.0
    };
    !parted(one, other) && !parted(other, one)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A closed star with this many points between two radii.
    fn star(points: usize, radii: [f64; 2]) -> Vec<Segment> {
        let at = |index: usize| {
            let angle = std::f64::consts::TAU * index as f64 / (2 * points) as f64;
            Point::origin() + super::super::direction(angle) * radii[index % 2]
        };
        (0..2 * points)
            .map(|index| Segment::line(at(index), at((index + 1) % (2 * points))))
            .collect()
    }

    #[test]
    fn a_smooth_contour_takes_few_looks_for_each_segment() {
        let round = star(1000, [10.0, 10.0]);
        for by in [0.1, -0.1, 1.0] {
            let looks = looks_of_offset(&round, by, u64::MAX - 1);
            assert!(looks < 2000 * 300, "{looks} looks by {by}");
        }
        let looks = looks_of_offset(&round, 0.1, u64::MAX - 1);
        assert!(looks < 2000 * 10, "{looks} looks");
    }

    #[test]
    fn a_correction_much_larger_than_the_teeth_takes_a_look_for_each_pair() {
        let teeth = star(500, [10.0, 9.0]);
        let small = looks_of_offset(&teeth, 0.01, u64::MAX - 1);
        let large = looks_of_offset(&teeth, 8.5, u64::MAX - 1);
        assert!(large > 1000 * 1000, "{large} looks");
        assert!(small < 1000 * 32, "{small} looks");
        assert_eq!(looks_of_offset(&teeth, 8.5, 1000), 1001);
    }
}
