//! The centre of an arc from its end.

use super::completion::Offer;
use crate::geometry::{Point, left_normal};
use crate::program::iso::block::Motion;
use crate::program::iso::moves::{Course, Move, Reading, micrometres, nanometres, to_center};
use crate::program::path::Way;
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
        let rule = reading.rule(made.incremental);
        let given = [block.i.is_some(), block.j.is_some()];
        let candidates = match given.iter().position(|is_given| *is_given) {
            // If one of them is given, the other follows from it.
            Some(axis) => {
                let followed = made.center(rule).and_then(|mut center| {
                    center[1 - axis] = made.center_along(1 - axis, center)?;
                    Some((micrometres(center), ""))
                });
                followed.into_iter().collect()
            }
            None => candidates(&made, &self.document.begun_cut(self.line), &reading),
        };
        for (center, about) in candidates {
            let Some(center) = self.style.center(center, made.from, made.to) else {
                continue;
            };
            let [i, j] = to_center(rule, center, made.from, self.machine.zero)
                .map(|length| self.style.number(length));
            let text = match given {
                [true, _] => format!("J{j}"),
                [_, true] => format!("I{i}"),
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
}

/// Centres in µm, each with its description: the arc tangent to the cut before, that of R, a quarter and a half turn.
fn candidates(made: &Move, begun: &Way, reading: &Reading) -> Vec<(Point, &'static str)> {
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
    if let Some(last) = begun.pieces().last()
        && nanometres(begun.end().machine.coords) == made.from
    {
        let normal = left_normal(last.end_tangent()) * turn;
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
