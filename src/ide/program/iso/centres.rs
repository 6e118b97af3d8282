//! The centre of an arc from its end.

use super::completion::Offer;
use crate::geometry::{Arc, Point, left_normal};
use crate::program::grid::{best_center, snap};
use crate::program::iso::block::Motion;
use crate::program::iso::moves::{CenterRule, Course, Move, Place, Reading, added, micrometres};
use crate::program::iso::steps::BegunCut;
use std::f64::consts::{FRAC_PI_2, PI};

/// A chord this nearly parallel to the way before it gives no tangent arc: the sine of the angle between them.
const ALONG: f64 = 1e-4;

impl Offer<'_> {
    /// I and J of the arcs that lead from here to the end given in the line.
    pub(super) fn centers(&mut self) {
        if !matches!(self.motion(), Motion::Clockwise | Motion::CounterClockwise) {
            return;
        }
        let mut block = self.typed.block;
        if self.typed.letter == Some(b'R') {
            block.r = self.typed.number;
        }
        let mut machine = self.machine;
        let Some(made) = machine.run(&block, self.document.reading()) else {
            return;
        };
        if made.from == made.to {
            return;
        }
        let reading = *self.document.reading();
        let zero = self.machine.zero;
        let rule = reading.rule(made.incremental);
        let coordinate = |center: Place, axis: usize| match rule {
            CenterRule::StartToCenter => center[axis].wrapping_sub(made.from[axis]),
            CenterRule::CenterToStart => made.from[axis].wrapping_sub(center[axis]),
            CenterRule::Absolute => center[axis].wrapping_sub(zero[axis]),
        };
        let mut candidates =
            candidates(&made, self.document.begun_cut(self.line).as_ref(), &reading);
        let given = [block.i, block.j]
            .map(|number| number.map(|number| reading.length(number, self.machine.inch)));
        if let Some(axis) = given.iter().position(Option::is_some) {
            // If one of them is given, the other follows from it.
            let place = given[axis].map(|length| match rule {
                CenterRule::StartToCenter => made.from[axis].wrapping_add(length),
                CenterRule::CenterToStart => made.from[axis].wrapping_sub(length),
                CenterRule::Absolute => zero[axis].wrapping_add(length),
            });
            candidates = place
                .and_then(|place| equidistant(&made, axis, place))
                .into_iter()
                .collect();
        }
        for (center, about) in candidates {
            let Some(center) = self.on_grid(&made, center) else {
                continue;
            };
            let [i, j] = [coordinate(center, 0), coordinate(center, 1)]
                .map(|length| self.style.number(length));
            let text = match given {
                [Some(_), _] => format!("J{j}"),
                [_, Some(_)] => format!("I{i}"),
                _ => format!("I{i} J{j}"),
            };
            // I and J replace R, at which the cursor is.
            if let Some(Course::Arc(arc)) = self.run(&text).map(|made| made.course(&reading)) {
                let turn = arc.sweep.abs().to_degrees();
                let about = say!(radius_and_turn_of_the_arc, arc.radius / 1e3, turn, about);
                self.push(text, about);
            }
        }
    }

    /// The centre that can be written, as equally far from both ends as possible.
    fn on_grid(&self, made: &Move, center: Point) -> Option<Place> {
        let step = self.style.step();
        let scale = 1e3 / step as f64;
        let [from, to] = [made.from, made.to].map(|place| snap(micrometres(place) * scale));
        let arc = Arc::about(
            center * scale,
            micrometres(made.from) * scale,
            micrometres(made.to) * scale,
            true,
        );
        let node = best_center(&arc, from?, to?);
        Some([node.x.checked_mul(step)?, node.y.checked_mul(step)?])
    }
}

/// Centres in µm, each with its description: the arc tangent to the cut before, that of R, a quarter and a half turn.
fn candidates(
    made: &Move,
    begun: Option<&BegunCut>,
    reading: &Reading,
) -> Vec<(Point, &'static str)> {
    let (from, to) = (micrometres(made.from), micrometres(made.to));
    let chord = to - from;
    let turn = if made.motion == Motion::CounterClockwise {
        1.0
    } else {
        -1.0
    };
    let mut found = Vec::new();
    if let Course::Arc(arc) = made.course(reading) {
        found.push((arc.center, say!(the_arc_that_r_means)));
    }
    if let Some(last) = begun
        .map(|begun| begun.last)
        .filter(|last| last.to == made.from)
    {
        let normal = left_normal(last.segment(reading).end_tangent()) * turn;
        let across = normal.dot(&chord);
        if across > chord.norm() * ALONG {
            found.push((
                from + normal * (chord.norm_squared() / (2.0 * across)),
                say!(leaves_the_block_before_without_a_corner),
            ));
        }
    }
    let middle = from + chord / 2.0;
    for sweep in [FRAC_PI_2, PI, 1.5 * PI] {
        let height = chord.norm() / 2.0 / (sweep / 2.0).tan();
        found.push((
            middle + left_normal(chord.normalize()) * (turn * height),
            "",
        ));
    }
    found
}

/// The centre that is equally far from both ends of an arc, with one coordinate given in nm.
fn equidistant(made: &Move, axis: usize, place: i64) -> Option<(Point, &'static str)> {
    let other = 1 - axis;
    let origin = made.from;
    let chord = added(made.to, origin.map(i64::wrapping_neg)).map(|length| length as f64);
    let along = place.wrapping_sub(origin[axis]) as f64;
    if chord[other] == 0.0 {
        return None;
    }
    let across =
        ((chord[0] * chord[0] + chord[1] * chord[1]) / 2.0 - chord[axis] * along) / chord[other];
    let mut center = [0.0; 2];
    center[axis] = along;
    center[other] = across;
    let start = micrometres(origin);
    Some((
        Point::new(start.x + center[0] / 1e3, start.y + center[1] / 1e3),
        "",
    ))
}
