//! Corners that the control makes: R on a straight cut, `,R` and `,C` after any. The move ends early, the corner's own
//! follows, and the next one begins where that ends.

use super::block::{Corner, Motion, read_under};
use super::machine::Machine;
use super::moves::{Bend, Move, Reading, added, apart, bend_about, nanometres};
use crate::geometry::{Locus, Point, Segment, cross, turn};

/// The next move is searched for in this many lines after a corner's.
pub(crate) const REACH: usize = 64;

/// Two cuts that turn by less than this have no corner, radians.
const STRAIGHT: f64 = 1e-4;

/// Makes the corner at the end of a move, towards the first one that `behind` makes: the move up to where the corner
/// begins, and the corner; the whole move where there is none to make. The machine, which has made the move, stands at
/// the sharp corner as its coordinates say, and begins the next move where the corner ends. `fixed` becomes true where what
/// `behind` does depends on where the wire stands before it.
pub(crate) fn turned<'a>(
    made: Move,
    machine: &mut Machine,
    behind: impl Iterator<Item = &'a [u8]>,
    reading: &Reading,
    fixed: &mut bool,
) -> (Move, Option<Move>) {
    let cut = made.corner.and_then(|corner| {
        let next = next_move(*machine, behind, reading, fixed)?;
        let size = reading.length(corner.size, machine.inch);
        cut_off(&made, &next, &corner, size, reading)
    });
    let Some((short, own)) = cut else {
        return (made, None);
    };
    machine.cut_short = Some(apart(own.to, made.to));
    (short, Some(own))
}

/// The next cut, if one follows directly.
fn next_move<'a>(
    mut machine: Machine,
    behind: impl Iterator<Item = &'a [u8]>,
    reading: &Reading,
    fixed: &mut bool,
) -> Option<Move> {
    for line in behind.take(REACH) {
        let block = read_under(&mut machine.variables, line, 1, |_| {});
        if block.sets_position || block.call.is_some() || block.returns || block.stop.is_some() {
            return None;
        }
        if block.empty {
            continue;
        }
        if let Some(made) = machine.run(&block, reading) {
            *fixed |= !made.incremental || machine.center.is_some();
            return Some(made).filter(Move::is_cut);
        }
        if machine.lost != [false, false] {
            return None;
        }
    }
    None
}

/// The move up to where the corner begins, and the corner.
fn cut_off(
    made: &Move,
    next: &Move,
    corner: &Corner,
    size: i64,
    reading: &Reading,
) -> Option<(Move, Move)> {
    if size <= 0 {
        return None;
    }
    // Relative to the corner, so that the result is the same anywhere.
    let (one, other) = (
        way(&made.seen_from(made.to), reading)?,
        way(&next.seen_from(made.to), reading)?,
    );
    let length = size as f64 / 1e3;
    let (begin, end, center) = if corner.round {
        rounded(&one, &other, length)?
    } else {
        chamfered(&one, &other, length)?
    };
    let place = |point: Point| added(made.to, nanometres(point.coords));
    let (begin, end) = (place(begin), place(end));
    let mut short = Move {
        to: begin,
        corner: None,
        ..*made
    };
    if let (Segment::Arc(arc), true) = (&one, made.is_arc()) {
        short.bend = bend_about(place(arc.center), made.from, made.incremental, reading);
    }
    let own = Move {
        from: begin,
        to: end,
        bend: Bend::Nothing,
        corner: None,
        switches: None,
        motion: Motion::Line,
        ..*made
    };
    let Some(center) = center else {
        return Some((short, own));
    };
    let turns_left = cross(one.end_tangent(), other.start_tangent()) > 0.0;
    let motion = Motion::turning(turns_left);
    let bend = bend_about(place(center), begin, made.incremental, reading);
    Some((
        short,
        Move {
            motion,
            bend,
            ..own
        },
    ))
}

fn way(made: &Move, reading: &Reading) -> Option<Segment> {
    let curve = made.curve(reading)?;
    (made.from != made.to || curve.as_arc().is_some()).then_some(curve)
}

/// Where a chamfer between two straight cuts begins and ends.
fn chamfered(one: &Segment, other: &Segment, length: f64) -> Option<(Point, Point, Option<Point>)> {
    let fits = one.as_arc().is_none()
        && other.as_arc().is_none()
        && length <= one.length()
        && length <= other.length();
    let (from, to) = (one.end_tangent(), other.start_tangent());
    let turns = turn(from, to).abs() > STRAIGHT;
    (fits && turns).then(|| (one.end() - from * length, other.start() + to * length, None))
}

/// The ends and the centre of the arc of a radius that is tangent to both ways.
fn rounded(one: &Segment, other: &Segment, radius: f64) -> Option<(Point, Point, Option<Point>)> {
    let (from, to) = (one.end_tangent(), other.start_tangent());
    let turn = turn(from, to);
    if turn.abs() < STRAIGHT || turn.abs() > std::f64::consts::PI - STRAIGHT {
        return None;
    }
    let corner = one.end();
    let side = turn.signum();
    let beside = |way: &Segment| Locus::beside(way, side, radius, 0.0);
    let found = beside(one)?.meet(&beside(other)?);
    let feet = found.into_iter().filter_map(|center| {
        let (begin, end) = (foot(one, center)?, foot(other, center)?);
        Some((begin, end, center))
    });
    let nearest =
        feet.min_by(|(_, _, a), (_, _, b)| (a - corner).norm().total_cmp(&(b - corner).norm()))?;
    Some((nearest.0, nearest.1, Some(nearest.2)))
}

/// The point of a way nearest to a centre, where it lies on it.
fn foot(way: &Segment, center: Point) -> Option<Point> {
    /// A point this close to an end is on the way, µm.
    const MET: f64 = 1e-3;
    match way {
        Segment::Arc(arc) => {
            let out = (center - arc.center).try_normalize(0.0)?;
            let point = arc.center + out * arc.radius;
            (way.distance_to(point) <= MET).then_some(point)
        }
        _ => {
            let along = way.start_tangent();
            let at = (center - way.start()).dot(&along);
            (-MET..=way.length() + MET)
                .contains(&at)
                .then(|| way.start() + along * at)
        }
    }
}
