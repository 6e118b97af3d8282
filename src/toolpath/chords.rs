//! Chords of an outline that the wire follows as arcs, within `chord-fit`.
//!
//! An outline is read in one direction, whichever way it is cut: every pass, and every lead of another contour, meets the same arcs.

use super::offset::Wall;
use crate::geometry::chords::{Within, longest, longest_window};
use crate::geometry::{Arc, Point, Segment};

/// The walls with arcs in place of chords, and the largest distance of such an arc from its chords; 0 where there is none.
pub(super) fn with_arcs(walls: Vec<Wall>, closed: bool, chord_fit: f64) -> (Vec<Wall>, f64) {
    if chord_fit == 0.0 || walls.is_empty() {
        return (walls, 0.0);
    }
    let is_backward = match closed {
        true => twice_area(&walls) < 0.0,
        false => ends_before(&walls),
    };
    let turned = |walls: Vec<Wall>| match is_backward {
        true => walls.iter().rev().map(reversed).collect(),
        false => walls,
    };
    let walls = turned(walls);
    let chords = Chords {
        walls: &walls,
        closed,
        in_a_row: in_a_row(&walls, closed),
        within: Within {
            corners: chord_fit,
            chords: chord_fit,
        },
    };
    let (fitted, farthest) = chords.as_arcs();
    (turned(fitted), farthest)
}

/// The chords of an outline; its corners are numbered from the start of the first wall on, and go on round a closed one.
struct Chords<'a> {
    walls: &'a [Wall],
    closed: bool,
    /// By wall: the number of lines in a row that begin with it.
    in_a_row: Vec<usize>,
    within: Within,
}

impl Chords<'_> {
    fn corner(&self, number: usize) -> Point {
        let count = self.walls.len();
        match !self.closed && number == count {
            true => self.walls[count - 1].geometry.end(),
            false => self.walls[number % count].geometry.start(),
        }
    }

    /// The first wall that begins an arc, and does not lie within one that begins before it; of a whole circle any.
    fn begin(&self) -> usize {
        let count = self.walls.len();
        let window = |wall: usize| {
            let corner = |number: usize, _| self.corner(wall + number);
            longest_window(corner, self.in_a_row[wall], self.within).unwrap_or(0)
        };
        let windows: Vec<usize> = (0..count).map(window).collect();
        let mut reached = 0;
        // Those that begin before the first wall are known the second time round.
        let begins = |at: &usize| {
            let own = windows[at % count];
            let begins = *at >= count && own > 0 && reached <= *at;
            reached = reached.max(at + own);
            begins
        };
        (0..2 * count).find(begins).unwrap_or(0) % count
    }

    fn as_arcs(&self) -> (Vec<Wall>, f64) {
        let count = self.walls.len();
        let first = if self.closed { self.begin() } else { 0 };
        let (mut fitted, mut wrapped, mut farthest) = (Vec::new(), 0, 0.0_f64);
        let mut at = first;
        while at < first + count {
            let own = self.walls[at % count];
            let most = self.in_a_row[at % count].min(first + count - at);
            wrapped += usize::from(at >= count);
            let Some((chords, circle)) =
                longest(|number| self.corner(at + number), most, self.within)
            else {
                fitted.push(own);
                at += 1;
                continue;
            };
            let [start, end] = [at, at + chords].map(|number| self.corner(number));
            let arc = Arc::about(circle.center, start, end, circle.counter_clockwise);
            for number in at..at + chords {
                let [from, to] = [number, number + 1].map(|number| self.corner(number));
                let off = |point: Point| ((point - arc.center).norm() - arc.radius).abs();
                farthest = farthest.max(off(from)).max(off(from + (to - from) * 0.5));
            }
            fitted.push(Wall {
                geometry: Segment::Arc(arc),
                ..own
            });
            at += chords;
        }
        fitted.rotate_right(wrapped);
        (fitted, farthest)
    }
}

/// By wall: the number of lines in a row that begin with it, once round at most.
fn in_a_row(walls: &[Wall], closed: bool) -> Vec<usize> {
    let count = walls.len();
    let mut in_a_row = vec![0; count];
    let mut behind = 0;
    for at in (0..if closed { 2 * count } else { count }).rev() {
        behind = match walls[at % count].geometry {
            Segment::Line(_) => (behind + 1).min(count),
            Segment::Arc(_) => 0,
        };
        in_a_row[at % count] = behind;
    }
    in_a_row
}

fn twice_area(walls: &[Wall]) -> f64 {
    let origin = walls
        .first()
        .map_or_else(Point::origin, |first| first.geometry.start());
    walls
        .iter()
        .map(|wall| wall.geometry.twice_area(origin))
        .sum()
}

/// True where an outline ends left of where it begins, or below.
fn ends_before(walls: &[Wall]) -> bool {
    let ends = walls.first().zip(walls.last());
    ends.is_some_and(|(first, last)| {
        let (start, end) = (first.geometry.start(), last.geometry.end());
        (end.x, end.y) < (start.x, start.y)
    })
}

fn reversed(wall: &Wall) -> Wall {
    Wall {
        geometry: wall.geometry.reversed(),
        ..*wall
    }
}
