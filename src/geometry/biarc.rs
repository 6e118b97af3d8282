//! A smooth curve as a chain of arcs, two for each piece, that leave each other without a kink.
//!
//! Source of the construction: K. M. Bolton, "Biarc curves", Computer-Aided Design 7 (1975), with the two tangent
//! lengths equal.

use super::{Arc, Point, Segment, Vector, turn};

/// A curve in smooth pieces, each with a parameter of its own.
pub(crate) trait Curve {
    /// Parameter ranges of the pieces, in the order of travel; the curve is smooth within each.
    fn pieces(&self) -> Vec<(f64, f64)>;

    /// The point and the derivative at parameter `t` of piece `piece`; at the ends of the piece the limits from within.
    fn at(&self, piece: usize, t: f64) -> (Point, Vector);

    /// Roughly an upper bound of the distance between any two points of the curve.
    fn extent(&self) -> f64;
}

/// A fitted chain: the start of each segment and its bulge. The last point has the bulge 0.
pub(crate) type Chain = Vec<(Point, f64)>;

/// Why a curve has no chain of arcs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unfit {
    /// It has no length, or numbers that are not finite.
    NoCurve,
    /// It would take more than this many arcs.
    TooManyArcs(usize),
}

/// The arcs that a curve may become, and in addition those for each of its pieces so far. A curve of a die takes some
/// dozens; a line of text could ask for a million, by coordinates without digits left for the tolerance or random
/// points over metres.
const MOST_ARCS: usize = 500;
const MOST_ARCS_OF_A_PIECE: usize = 48;
/// The tolerance for these limits; a finer one takes more, by the cube root.
const USUAL: f64 = 1e-3;

/// A piece is halved at most this often.
const HALVINGS: u32 = 14;
/// Places of each piece at which its distance from the arcs is measured.
const SAMPLES: usize = 12;
/// Share of the tolerance for the measured places: the curve may lie a little further off between them.
const MEASURED: f64 = 0.9;
/// Two arcs are parts of one circle when their circles agree within this share of the tolerance.
const SAME_CIRCLE: f64 = 1e-3;
/// The fit is not finer than this share of the curve's extent: beyond it numbers have no digits left.
const FINEST: f64 = 1e-9;

/// A chain of arcs and lines within `tolerance` of the curve (or within a billionth of its extent, where that is more).
/// Parts that are exactly lines or circular arcs become one segment of at most a half turn.
///
/// Errors: a curve without length or with numbers that are not finite, and one that would take far too many arcs.
pub(crate) fn fit(curve: &impl Curve, tolerance: f64) -> Result<Chain, Unfit> {
    let extent = curve.extent();
    if !extent.is_finite() || extent <= 0.0 {
        return Err(Unfit::NoCurve);
    }
    let tolerance = tolerance.max(extent * FINEST);
    let finer = (USUAL / tolerance).cbrt().max(1.0);
    let mut chain: Chain = Vec::new();
    let (mut last, mut halves) = (None, 0);
    for (piece, (from, to)) in curve.pieces().into_iter().enumerate() {
        let most = (finer * (MOST_ARCS + MOST_ARCS_OF_A_PIECE * (piece + 1)) as f64) as usize;
        let mut open = vec![(from, to, 0)];
        while let Some((from, to, depth)) = open.pop() {
            halves += 1;
            // Where the curve stands still, its halves become empty.
            if chain.len() > most || halves > 2 * most {
                return Err(Unfit::TooManyArcs(most));
            }
            let (start, end) = (curve.at(piece, from).0, curve.at(piece, to).0);
            let sound = [start.x, start.y, end.x, end.y]
                .iter()
                .all(|number| number.is_finite());
            if !sound {
                return Err(Unfit::NoCurve);
            }
            match biarc(curve, piece, from, to, tolerance) {
                Some(arcs) => chain.extend(arcs),
                // Where the curve stands still, so do its halves.
                None if depth < HALVINGS
                    && !is_tiny(curve, piece, (from, to), tolerance * SAME_CIRCLE) =>
                {
                    let middle = from + (to - from) * 0.5;
                    open.push((middle, to, depth + 1));
                    open.push((from, middle, depth + 1));
                    continue;
                }
                None if start == end => {}
                None => chain.push((start, 0.0)),
            }
            last = Some(end);
        }
    }
    let Some(last) = last.filter(|_| !chain.is_empty()) else {
        return Err(Unfit::NoCurve);
    };
    chain.push((last, 0.0));
    Ok(merged(chain, tolerance * SAME_CIRCLE))
}

/// True where a part of a piece stays within `least` of its start.
fn is_tiny(curve: &impl Curve, piece: usize, (from, to): (f64, f64), least: f64) -> bool {
    let start = curve.at(piece, from).0;
    (1..=SAMPLES).all(|sample| {
        (curve
            .at(piece, from + (to - from) * (sample as f64 / SAMPLES as f64))
            .0
            - start)
            .norm()
            <= least
    })
}

/// Two arcs for a part of a piece, `None` where they are not near enough.
fn biarc(
    curve: &impl Curve,
    piece: usize,
    from: f64,
    to: f64,
    tolerance: f64,
) -> Option<Vec<(Point, f64)>> {
    let (start, end) = (curve.at(piece, from).0, curve.at(piece, to).0);
    let chord = end - start;
    let leaving = tangent(curve, piece, from, to)?;
    let arriving = tangent(curve, piece, to, from).map(|backwards| -backwards)?;
    if chord.norm() == 0.0
        || leaving.dot(&arriving) < 0.5
        || leaving.dot(&chord) <= 0.0
        || arriving.dot(&chord) <= 0.0
    {
        return None;
    }
    let along = chord.dot(&(leaving + arriving));
    let length = chord.norm_squared()
        / (along
            + (along * along + 2.0 * (1.0 - leaving.dot(&arriving)) * chord.norm_squared()).sqrt());
    let joint = Point::from((start.coords + end.coords + (leaving - arriving) * length) * 0.5);
    let first = (turn(leaving, joint - start) / 2.0).tan();
    let second = (turn(end - joint, arriving) / 2.0).tan();
    // A bend too slight to differ from a line is a line.
    let straight =
        |bulge: f64, from: Point, to: Point| (bulge * (to - from).norm()).abs() < tolerance * 1e-6;
    let first = if straight(first, start, joint) {
        0.0
    } else {
        first
    };
    let second = if straight(second, joint, end) {
        0.0
    } else {
        second
    };
    let segments = [
        Segment::from_bulge(start, joint, first),
        Segment::from_bulge(joint, end, second),
    ];
    let near = (1..SAMPLES).all(|sample| {
        let point = curve
            .at(piece, from + (to - from) * (sample as f64 / SAMPLES as f64))
            .0;
        let distance = segments
            .iter()
            .map(|segment| segment.distance_to(point))
            .fold(f64::INFINITY, f64::min);
        distance <= tolerance * MEASURED
    });
    near.then(|| vec![(start, first), (joint, second)])
}

/// The unit direction in which the curve leaves `at` towards `other`. Where it stands still there, that of the chord to
/// a place near by.
fn tangent(curve: &impl Curve, piece: usize, at: f64, other: f64) -> Option<Vector> {
    let (point, derivative) = curve.at(piece, at);
    let forward = derivative * (other - at).signum();
    let still = curve.extent() * 1e-12;
    if (forward * (other - at)).norm() > still {
        return forward.try_normalize(0.0);
    }
    let near = curve.at(piece, at + (other - at) * 1e-3).0;
    (near - point).try_normalize(0.0)
}

/// Neighbours on one line or one circle become one segment.
fn merged(chain: Chain, same: f64) -> Chain {
    let mut result: Chain = Vec::with_capacity(chain.len());
    for window in 0..chain.len() {
        let (point, bulge) = chain[window];
        let Some(&(next, _)) = chain.get(window + 1) else {
            result.push((point, bulge));
            break;
        };
        if point == next {
            continue;
        }
        if let Some(&(start, before)) = result.last()
            && let Some(joined) = joined((start, before), (point, bulge), next, same)
        {
            if let Some(last) = result.last_mut() {
                last.1 = joined;
            }
            continue;
        }
        result.push((point, bulge));
    }
    result
}

/// The bulge of one segment from `start` to `end` that replaces two, when they are one.
fn joined(
    (start, before): (Point, f64),
    (middle, after): (Point, f64),
    end: Point,
    same: f64,
) -> Option<f64> {
    match (
        Segment::from_bulge(start, middle, before),
        Segment::from_bulge(middle, end, after),
    ) {
        (Segment::Line(one), Segment::Line(other)) => {
            let whole = Segment::line(start, end);
            (one.direction().dot(&other.direction()) > 0.0 && whole.distance_to(middle) <= same)
                .then_some(0.0)
        }
        (Segment::Arc(one), Segment::Arc(other)) => {
            let sweep = one.sweep + other.sweep;
            let alike = before * after > 0.0 && sweep.abs() <= std::f64::consts::PI * (1.0 + 1e-9);
            if !alike
                || (one.radius - other.radius).abs() > same
                || (one.center - other.center).norm() > same
            {
                return None;
            }
            let bulge = (sweep / 4.0).tan();
            let whole = Arc::from_bulge(start, end, bulge)?;
            (whole.distance_to(middle) <= same).then_some(bulge)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests;
