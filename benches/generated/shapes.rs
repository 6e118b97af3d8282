//! Drawings that make a careless algorithm take the square of their size: one fault a hundred thousand times over.

use std::f64::consts::TAU;
use std::fmt::Write;

/// One drawing by what is in it, and the text of this many segments of it.
pub struct Shape {
    pub name: &'static str,
    pub text: fn(usize) -> String,
}

/// All of them, with names that can be names of files.
pub const ALL: [Shape; 28] = [
    Shape {
        name: "comb",
        text: |count| polyline(&comb(count), true),
    },
    Shape {
        name: "comb-of-lines",
        text: |count| lines(chain(&comb(count), true)),
    },
    Shape {
        name: "circle-of-chords",
        text: |count| polyline(&circle(count), true),
    },
    Shape {
        name: "circle-of-chords-of-lines",
        text: |count| lines(chain(&circle(count), true)),
    },
    Shape {
        name: "circles-of-32-chords",
        text: |count| lines(small_circles(count)),
    },
    Shape {
        name: "loose-lines",
        text: |count| lines(loose(count)),
    },
    Shape {
        name: "crosses",
        text: |count| lines(crosses(count)),
    },
    Shape {
        name: "hatch",
        text: |count| lines(hatch(count)),
    },
    Shape {
        name: "hatch-slanted",
        text: |count| lines(hatch_slanted(count)),
    },
    Shape {
        name: "hatch-in-plate",
        text: |count| {
            let size = count as f64;
            let plate = [[-2.0, -2.0], [size, -2.0], [size, size], [-2.0, size]];
            let upright = |number| [[number as f64, 0.0], [number as f64, size - 2.0]];
            lines(
                chain(&plate, true)
                    .into_iter()
                    .chain((1..count.saturating_sub(4)).map(upright)),
            )
        },
    },
    Shape {
        name: "zigzag-slanted",
        text: |count| polyline(&zigzag_slanted(count), false),
    },
    Shape {
        name: "nested-squares",
        text: |count| lines(nested_squares(count)),
    },
    Shape {
        name: "concentric",
        text: |count| circles((1..=count).map(|number| ([0.0, 0.0], number as f64))),
    },
    Shape {
        name: "flower",
        text: |count| circles(flower(count)),
    },
    Shape {
        name: "chords",
        text: |count| lines(chords(count)),
    },
    Shape {
        name: "chords-across",
        text: |count| lines(chords_across(count)),
    },
    Shape {
        name: "star",
        text: |count| lines(star(count)),
    },
    Shape {
        name: "spiral",
        text: |count| polyline(&spiral(count), false),
    },
    Shape {
        name: "spiral-of-lines",
        text: |count| lines(chain(&spiral(count), false)),
    },
    Shape {
        name: "doubles",
        text: |count| lines(doubles(count)),
    },
    Shape {
        name: "gaps",
        text: |count| lines(gaps(count)),
    },
    Shape {
        name: "gaps-in-one-chain",
        text: |count| lines(gaps_in_one_chain(count)),
    },
    Shape {
        name: "ladder",
        text: |count| lines(ladder(count)),
    },
    Shape {
        name: "collinear",
        text: |count| lines((0..count).map(collinear)),
    },
    Shape {
        name: "near-doubles-in-one-place",
        text: |count| lines((0..count).map(near_double)),
    },
    Shape {
        name: "asterisks",
        text: |count| lines((0..count).map(spoke)),
    },
    Shape {
        name: "one-handle",
        text: |count| lines(loose(count)).replace("\n5\n", "\n5\n1\n999\n"),
    },
    Shape {
        name: "short-segments",
        text: |count| polyline(&short(count), true),
    },
];

type Point = [f64; 2];

/// DXF with one LWPOLYLINE.
fn polyline(points: &[Point], closed: bool) -> String {
    let mut text = String::new();
    super::header(&mut text);
    let _ = write!(
        text,
        "0\nLWPOLYLINE\n5\n2A\n8\nDIE\n90\n{}\n70\n{}\n",
        points.len(),
        i32::from(closed)
    );
    for [x, y] in points {
        let _ = write!(text, "10\n{x:.9}\n20\n{y:.9}\n");
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

/// DXF with a LINE for each pair of ends.
fn lines(ends: impl IntoIterator<Item = [Point; 2]>) -> String {
    let mut text = String::new();
    super::header(&mut text);
    for (number, [[x0, y0], [x1, y1]]) in ends.into_iter().enumerate() {
        let handle = 100 + number;
        let _ = write!(
            text,
            "0\nLINE\n5\n{handle:X}\n8\nDIE\n10\n{x0:.9}\n20\n{y0:.9}\n11\n{x1:.9}\n21\n{y1:.9}\n"
        );
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

/// DXF with a CIRCLE for each centre and radius.
fn circles(circles: impl IntoIterator<Item = (Point, f64)>) -> String {
    let mut text = String::new();
    super::header(&mut text);
    for (number, ([x, y], radius)) in circles.into_iter().enumerate() {
        let handle = 100 + number;
        let _ = write!(
            text,
            "0\nCIRCLE\n5\n{handle:X}\n8\nDIE\n10\n{x:.9}\n20\n{y:.9}\n40\n{radius:.9}\n"
        );
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

fn chain(points: &[Point], closed: bool) -> Vec<[Point; 2]> {
    let mut ends: Vec<[Point; 2]> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    if let (true, Some(&first), Some(&last)) = (closed, points.first(), points.last()) {
        ends.push([last, first]);
    }
    ends
}

/// A round wheel of pointed teeth: every corner is sharp, every second one on the wire's side.
fn comb(count: usize) -> Vec<Point> {
    let radius = count as f64 * 0.3;
    let at = |index: usize| {
        let (angle, r) = (
            index as f64 / count as f64 * TAU,
            radius + if index.is_multiple_of(2) { 0.0 } else { 2.0 },
        );
        [r * angle.cos(), r * angle.sin()]
    };
    (0..count).map(at).collect()
}

/// A circle broken into chords of 0.1.
fn circle(count: usize) -> Vec<Point> {
    let radius = count as f64 * 0.1 / TAU;
    (0..count)
        .map(|index| (index as f64 / count as f64 * TAU).sin_cos())
        .map(|(sine, cosine)| [radius * cosine, radius * sine])
        .collect()
}

/// Circles of 32 chords each.
fn small_circles(count: usize) -> Vec<[Point; 2]> {
    let circle = |number: usize| {
        let (x, y) = place(number, 4.0);
        let corner = move |k: usize| {
            [
                x + (k as f64 / 32.0 * TAU).cos(),
                y + (k as f64 / 32.0 * TAU).sin(),
            ]
        };
        (0..32).map(move |k| [corner(k), corner((k + 1) % 32)])
    };
    (0..count.div_ceil(32))
        .flat_map(circle)
        .take(count)
        .collect()
}

fn place(number: usize, step: f64) -> (f64, f64) {
    ((number % 300) as f64 * step, (number / 300) as f64 * step)
}

/// Lines that meet nothing.
fn loose(count: usize) -> Vec<[Point; 2]> {
    (0..count)
        .map(|number| place(number, 2.0))
        .map(|(x, y)| [[x, y], [x + 1.0, y + 0.7]])
        .collect()
}

/// Pairs of lines that cross each other and nothing else.
fn crosses(count: usize) -> Vec<[Point; 2]> {
    let line = |number: usize| {
        let (x, y) = place(number / 2, 2.0);
        if number.is_multiple_of(2) {
            [[x, y], [x + 1.0, y + 1.0]]
        } else {
            [[x, y + 1.0], [x + 1.0, y]]
        }
    };
    (0..count).map(line).collect()
}

/// Long lines of both directions, each of which crosses all of the other direction.
fn hatch(count: usize) -> Vec<[Point; 2]> {
    let size = count as f64;
    let line = |number: usize| {
        let at = number as f64;
        if number.is_multiple_of(2) {
            [[-1.0, at], [size, at]]
        } else {
            [[at, -1.0], [at, size]]
        }
    };
    (0..count).map(line).collect()
}

/// Long lines beside each other, askew: the box of each holds a part of all others.
fn hatch_slanted(count: usize) -> Vec<[Point; 2]> {
    let length = count as f64;
    let line = |number: usize| {
        let at = number as f64;
        [[at, 0.0], [at + 0.8 * length, 0.6 * length]]
    };
    (0..count).map(line).collect()
}

/// One long way to and fro, askew.
fn zigzag_slanted(count: usize) -> Vec<Point> {
    let length = count as f64 * 0.3;
    let at = |index: usize| {
        let (along, across) = (
            if index.div_ceil(2).is_multiple_of(2) {
                0.0
            } else {
                length
            },
            (index / 2) as f64 * 0.5,
        );
        [0.8 * along - 0.6 * across, 0.6 * along + 0.8 * across]
    };
    (0..count).map(at).collect()
}

/// Squares that lie in each other, one within the next.
fn nested_squares(count: usize) -> Vec<[Point; 2]> {
    let square = |number: usize| {
        let half = number as f64 + 1.0;
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        (0..4).map(move |side| [corners[side], corners[(side + 1) % 4]])
    };
    (0..count.div_ceil(4))
        .flat_map(square)
        .take(count)
        .collect()
}

/// Circles through one point, each of which crosses all others.
fn flower(count: usize) -> Vec<(Point, f64)> {
    let radius = count as f64;
    let petal = |number: usize| {
        let (sine, cosine) = (number as f64 / count as f64 * TAU).sin_cos();
        ([radius * cosine, radius * sine], radius)
    };
    (0..count).map(petal).collect()
}

/// Chords of one circle that run the same way, in no order.
fn chords(count: usize) -> Vec<[Point; 2]> {
    let radius = count as f64;
    let at = |number: usize| {
        // By the golden ratio, so that no two begin in one place.
        let (sine, cosine) = (number as f64 * 0.618_033_988_749_895 * TAU).sin_cos();
        [radius * cosine, radius * sine]
    };
    (0..count)
        .map(|number| [at(number), at(2 * count - number)])
        .collect()
}

/// Chords of one circle in many directions, most of which cross each other.
fn chords_across(count: usize) -> Vec<[Point; 2]> {
    let radius = count as f64;
    let at = |turns: f64| {
        let (sine, cosine) = (turns * TAU).sin_cos();
        [radius * cosine, radius * sine]
    };
    (0..count)
        .map(|number| number as f64)
        .map(|number| {
            [
                at(number * 0.618_033_988_749_895),
                at(number * 0.754_877_666_246_693),
            ]
        })
        .collect()
}

/// Lines through one point, in all directions.
fn star(count: usize) -> Vec<[Point; 2]> {
    let radius = count as f64;
    let line = |number: usize| {
        let (sine, cosine) = (number as f64 / count as f64 * TAU / 2.0).sin_cos();
        [
            [-radius * cosine, -radius * sine],
            [radius * cosine, radius * sine],
        ]
    };
    (0..count).map(line).collect()
}

/// A spiral whose turns lie 0.15 apart: a slot narrower than the wire all along.
fn spiral(count: usize) -> Vec<Point> {
    let mut angle = TAU;
    let step = |_| {
        let radius = 0.15 * angle / TAU;
        angle += 0.1 / radius;
        [radius * angle.cos(), radius * angle.sin()]
    };
    (0..count).map(step).collect()
}

/// Squares that are all there twice.
fn doubles(count: usize) -> Vec<[Point; 2]> {
    let line = |number: usize| {
        let (x, y) = place(number / 4, 3.0);
        let corners = [[x, y], [x + 2.0, y], [x + 2.0, y + 2.0], [x, y + 2.0]];
        [corners[number % 4], corners[(number + 1) % 4]]
    };
    (0..count / 2).chain(0..count / 2).map(line).collect()
}

/// Squares that do not quite meet in their corners.
fn gaps(count: usize) -> Vec<[Point; 2]> {
    let line = |number: usize| {
        let (x, y) = place(number / 4, 3.0);
        let corners = [[x, y], [x + 2.0, y], [x + 2.0, y + 2.0], [x, y + 2.0]];
        let ([ax, ay], [bx, by]) = (corners[number % 4], corners[(number + 1) % 4]);
        [[ax + (bx - ax) * 0.002, ay + (by - ay) * 0.002], [bx, by]]
    };
    (0..count).map(line).collect()
}

/// One round wheel of pointed teeth whose lines do not quite meet.
fn gaps_in_one_chain(count: usize) -> Vec<[Point; 2]> {
    let apart = |[[ax, ay], [bx, by]]: [Point; 2]| {
        [[ax + (bx - ax) * 0.002, ay + (by - ay) * 0.002], [bx, by]]
    };
    chain(&comb(count), true).into_iter().map(apart).collect()
}

/// Two rails and the rungs between them.
fn ladder(count: usize) -> Vec<[Point; 2]> {
    let cell = |number: usize| {
        let (x, next) = (number as f64, number as f64 + 1.0);
        [
            [[x, 0.0], [next, 0.0]],
            [[x, 5.0], [next, 5.0]],
            [[x, 0.0], [x, 5.0]],
        ]
    };
    (0..count / 3).flat_map(cell).collect()
}

/// One of many lines on one another, each a little longer than the last.
fn collinear(number: usize) -> [Point; 2] {
    let half = 1.0 + number as f64 * 0.01;
    [[-half, 0.0], [half, 0.0]]
}

/// One of many lines between two places, each nearly where the others are.
fn near_double(number: usize) -> [Point; 2] {
    let off = |by: usize| (number * by % 41) as f64 * 1e-4 - 0.002;
    [[off(7), off(11)], [10.0 + off(17), 5.0 + off(23)]]
}

/// One of a hundred lines that meet in each of many points.
fn spoke(number: usize) -> [Point; 2] {
    let (x, y) = place(number / 100, 50.0);
    let angle = (number % 100) as f64 / 100.0 * TAU;
    [[x, y], [x + 20.0 * angle.cos(), y + 20.0 * angle.sin()]]
}

/// A wheel of blunt teeth of which every second segment is shorter than 0.005.
fn short(count: usize) -> Vec<Point> {
    let radius = count as f64 * 0.2;
    let at = |index: usize| {
        let shift = if index.is_multiple_of(2) {
            0.0
        } else {
            0.003 / radius - TAU / count as f64
        };
        let angle = index as f64 / count as f64 * TAU + shift;
        [radius * angle.cos(), radius * angle.sin()]
    };
    (0..count).map(at).collect()
}
