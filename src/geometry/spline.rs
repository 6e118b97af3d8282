//! Splines: B-splines of any degree, rational ones too, and the cubic one through given points.

use super::biarc::Curve;
use super::{Bounds, Point, Vector};

/// A higher degree is refused: no program draws it, and each point costs its square.
const MAX_DEGREE: usize = 24;

/// A (rational) B-spline. Made by `Spline::new`, so that its numbers are consistent.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spline {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<Point>,
    /// One for each point; empty where all are 1.
    weights: Vec<f64>,
}

impl Spline {
    /// Errors say what does not fit: the degree, the number of points, knots or weights, falling knots, weights of both
    /// signs or of 0, a knot at which the curve breaks in two.
    ///
    /// The curve runs over the knots from number `degree` to number `points.len()`, as DXF has it, so unclamped and
    /// periodic knots are valid too.
    pub(crate) fn new(
        degree: usize,
        knots: Vec<f64>,
        points: Vec<Point>,
        weights: Vec<f64>,
    ) -> Result<Spline, String> {
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(say!(has_the_degree_expected_1, degree, MAX_DEGREE));
        }
        if points.len() <= degree {
            return Err(say!(
                has_control_points_expected_at_least,
                points.len(),
                degree + 1
            ));
        }
        if knots.len() != points.len() + degree + 1 {
            return Err(say!(
                has_the_wrong_number_of_knots,
                knots.len(),
                points.len() + degree + 1,
                points.len(),
                degree
            ));
        }
        if knots.windows(2).any(|pair| pair[1] < pair[0]) || knots[degree] >= knots[points.len()] {
            return Err(say!(has_knots_that_do_not_rise).into());
        }
        if !weights.is_empty() && weights.len() != points.len() {
            return Err(say!(
                has_weights_for_control_points,
                weights.len(),
                points.len()
            ));
        }
        // A factor that all weights share cancels, whatever its sign.
        let are_one_sign = |sign: f64| weights.iter().all(|&weight| weight * sign > 0.0);
        if !are_one_sign(1.0) && !are_one_sign(-1.0) {
            return Err(say!(has_weights_of_both_signs_or_0).into());
        }
        let weights = if weights.windows(2).all(|pair| pair[0] == pair[1]) {
            Vec::new()
        } else {
            weights
        };
        let spline = Spline {
            degree,
            knots,
            points,
            weights,
        };
        match spline.break_in_two() {
            Some(times) => Err(say!(breaks_in_two_at_a_knot, times)),
            None => Ok(spline),
        }
    }

    /// How often a knot occurs at which the curve jumps: more often than the degree, with another control point behind
    /// it than before it.
    fn break_in_two(&self) -> Option<usize> {
        let bounds = Bounds::of_points(&self.points);
        let rounding = 1e-9 * (bounds.max - bounds.min).norm();
        let next = self.spans().skip(1);
        let jumps = |(span, next): (usize, usize)| {
            let times = next - span;
            let ends = || self.points[span] - self.points[next - self.degree];
            (times > self.degree && ends().norm() > rounding).then_some(times)
        };
        self.spans().zip(next).find_map(jumps)
    }

    /// The spline with even knots that begins at the first point and ends at the last one. Errors as in `Spline::new`.
    pub(crate) fn clamped(
        degree: usize,
        points: Vec<Point>,
        weights: Vec<f64>,
    ) -> Result<Spline, String> {
        let last = points.len().saturating_sub(degree);
        let knots = (0..points.len() + degree.min(MAX_DEGREE) + 1)
            .map(|knot| knot.saturating_sub(degree).min(last) as f64)
            .collect();
        Spline::new(degree, knots, points, weights)
    }

    /// The cubic spline through `points` with continuous curvature, its parameter the length of the chords. An end
    /// with a tangent leaves in that direction, one without is straight at its end. `None` for less than two different points.
    pub(crate) fn through(
        points: &[Point],
        start: Option<Vector>,
        end: Option<Vector>,
    ) -> Option<Spline> {
        let mut through: Vec<Point> = points.to_vec();
        through.dedup();
        let lengths: Vec<f64> = through
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).norm())
            .collect();
        let last = lengths.len().checked_sub(1)?;
        // The derivative at each point: a tridiagonal system, solved forward and back.
        let count = through.len();
        let chord = |index: usize| (through[index + 1] - through[index]) / lengths[index];
        let mut upper = vec![0.0; count];
        let mut slopes = vec![Vector::zeros(); count];
        for index in 0..count {
            let (below, middle, above, right) = match index {
                0 => match start.and_then(|tangent| tangent.try_normalize(0.0)) {
                    Some(tangent) => (0.0, 1.0, 0.0, tangent),
                    None => (0.0, 2.0, 1.0, chord(0) * 3.0),
                },
                _ if index == count - 1 => match end.and_then(|tangent| tangent.try_normalize(0.0))
                {
                    Some(tangent) => (0.0, 1.0, 0.0, tangent),
                    None => (1.0, 2.0, 0.0, chord(last) * 3.0),
                },
                _ => {
                    let (before, behind) = (lengths[index - 1], lengths[index]);
                    let right = (chord(index - 1) * behind + chord(index) * before) * 3.0;
                    (behind, 2.0 * (before + behind), before, right)
                }
            };
            let (upper_before, slope_before) = if index == 0 {
                (0.0, Vector::zeros())
            } else {
                (upper[index - 1], slopes[index - 1])
            };
            let pivot = middle - below * upper_before;
            upper[index] = above / pivot;
            slopes[index] = (right - slope_before * below) / pivot;
        }
        for index in (0..count - 1).rev() {
            slopes[index] = slopes[index] - slopes[index + 1] * upper[index];
        }
        let mut knots = vec![0.0; 4];
        let mut controls = vec![through[0]];
        let mut at = 0.0;
        for (index, &length) in lengths.iter().enumerate() {
            at += length;
            knots.extend([at; 3]);
            controls.push(through[index] + slopes[index] * (length / 3.0));
            controls.push(through[index + 1] - slopes[index + 1] * (length / 3.0));
            controls.push(through[index + 1]);
        }
        knots.push(at);
        Spline::new(3, knots, controls, Vec::new()).ok()
    }

    /// The closed cubic spline through `points`: as [`Spline::through`], but with continuous curvature at its start
    /// too. The first point need not be repeated. `None` for less than three different points.
    pub(crate) fn round(points: &[Point]) -> Option<Spline> {
        let mut round: Vec<Point> = points.to_vec();
        round.dedup();
        while round.len() > 1 && round.first() == round.last() {
            round.pop();
        }
        let count = round.len();
        if count < 3 {
            return None;
        }
        // The influence of a point falls to a quarter with each point in between: this many points
        // on both sides make the ends of the longer curve irrelevant.
        const BEHIND: usize = 30;
        let longer: Vec<Point> = (0..count + 1 + 2 * BEHIND)
            .map(|at| round[(at + count * BEHIND - BEHIND) % count])
            .collect();
        let longer = Spline::through(&longer, None, None)?;
        let (from, to) = (BEHIND, BEHIND + count);
        let knot = |point: usize| longer.knots.get(4 + 3 * point - 3).copied();
        let start = knot(from)?;
        let mut knots = vec![0.0; 4];
        for point in from + 1..=to {
            knots.extend([knot(point)? - start; 3]);
        }
        knots.push(knot(to)? - start);
        Spline::new(
            3,
            knots,
            longer.points.get(3 * from..=3 * to)?.to_vec(),
            Vec::new(),
        )
        .ok()
    }

    /// Number of its control points.
    pub(crate) fn point_count(&self) -> usize {
        self.points.len()
    }

    /// The same curve with its control points moved by an affine transformation.
    pub(crate) fn mapped(&self, map: impl Fn(Point) -> Point) -> Spline {
        Spline {
            points: self.points.iter().map(|&point| map(point)).collect(),
            ..self.clone()
        }
    }

    /// Spans that are not empty.
    fn spans(&self) -> impl Iterator<Item = usize> + '_ {
        (self.degree..self.points.len()).filter(|&span| self.knots[span] < self.knots[span + 1])
    }

    /// De Boor's algorithm in homogeneous coordinates, within one span of knots.
    fn in_span(&self, span: usize, t: f64) -> (Point, Vector) {
        let degree = self.degree;
        let mut points = [[0.0; 3]; MAX_DEGREE + 1];
        for (index, point) in points.iter_mut().enumerate().take(degree + 1) {
            let from = span - degree + index;
            let weight = self.weights.get(from).copied().unwrap_or(1.0);
            *point = [
                self.points[from].x * weight,
                self.points[from].y * weight,
                weight,
            ];
        }
        let mut derivative = [0.0; 3];
        for level in 1..=degree {
            if level == degree {
                let width = self.knots[span + 1] - self.knots[span];
                derivative = std::array::from_fn(|axis| {
                    degree as f64 * (points[degree][axis] - points[degree - 1][axis]) / width
                });
            }
            for index in (level..=degree).rev() {
                let low = self.knots[span - degree + index];
                let high = self.knots[span + index + 1 - level];
                let share = if high > low {
                    (t - low) / (high - low)
                } else {
                    0.0
                };
                points[index] = std::array::from_fn(|axis| {
                    points[index - 1][axis] * (1.0 - share) + points[index][axis] * share
                });
            }
        }
        let [x, y, weight] = points[degree];
        let point = Point::new(x / weight, y / weight);
        let slope = Vector::new(
            derivative[0] - point.x * derivative[2],
            derivative[1] - point.y * derivative[2],
        ) / weight;
        (point, slope)
    }
}

/// A spline with its spans looked up.
pub(crate) struct SplineCurve<'a> {
    spline: &'a Spline,
    spans: Vec<usize>,
    extent: f64,
}

impl<'a> From<&'a Spline> for SplineCurve<'a> {
    fn from(spline: &'a Spline) -> Self {
        let bounds = Bounds::of_points(&spline.points);
        SplineCurve {
            spline,
            spans: spline.spans().collect(),
            extent: (bounds.max - bounds.min).norm(),
        }
    }
}

impl Curve for SplineCurve<'_> {
    fn pieces(&self) -> Vec<(f64, f64)> {
        self.spans
            .iter()
            .map(|&span| (self.spline.knots[span], self.spline.knots[span + 1]))
            .collect()
    }

    fn at(&self, piece: usize, t: f64) -> (Point, Vector) {
        match self.spans.get(piece) {
            Some(&span) => self.spline.in_span(span, t),
            None => (Point::origin(), Vector::zeros()),
        }
    }

    fn extent(&self) -> f64 {
        self.extent
    }
}
