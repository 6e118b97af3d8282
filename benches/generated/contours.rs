//! Contours of any number of vertices for the benchmark of the path: x, y and bulge of each.

use std::f64::consts::TAU;

/// One contour by what it looks like. The wire runs outside of it, 0.1 mm away.
pub struct Contour {
    pub name: &'static str,
    pub vertices: fn(usize) -> Vec<[f64; 3]>,
}

pub const ALL: [Contour; 5] = [
    Contour {
        name: "gear",
        vertices: gear,
    },
    Contour {
        name: "star with fillets",
        vertices: star,
    },
    Contour {
        name: "noise",
        vertices: noise,
    },
    Contour {
        name: "comb",
        vertices: comb,
    },
    Contour {
        name: "spiral",
        vertices: spiral,
    },
];

/// A wheel in which every other segment is an arc, each a tooth's flank or its rounded head and foot; clockwise.
pub fn gear(count: usize) -> Vec<[f64; 3]> {
    let teeth = count / 4;
    let radius = teeth as f64 * 0.4;
    let step = TAU / teeth as f64;
    let corners = [
        (0.0, 0.0, 0.0),
        (0.15, 1.0, -0.4),
        (0.5, 1.0, 0.0),
        (0.65, 0.0, 0.4),
    ];
    let tooth = |tooth: usize| {
        corners.map(|(share, height, bulge)| {
            let (sin, cos) = (-(tooth as f64 + share) * step).sin_cos();
            [(radius + height) * cos, (radius + height) * sin, bulge]
        })
    };
    (0..teeth).flat_map(tooth).collect()
}

/// Rays 2 mm high and 1.2 mm wide, tips and feet rounded.
fn star(count: usize) -> Vec<[f64; 3]> {
    let rays = count / 4;
    let radius = rays as f64 * 1.2 / TAU;
    let corner = |at: usize| {
        let (sin, cos) = (TAU * at as f64 / (2 * rays) as f64).sin_cos();
        let away = if at.is_multiple_of(2) {
            radius
        } else {
            radius - 2.0
        };
        [away * cos, away * sin]
    };
    let corners: Vec<[f64; 2]> = (0..2 * rays).map(corner).collect();
    rounded(&corners, 0.2)
}

/// A polygon with a fillet in every corner.
pub fn rounded(corners: &[[f64; 2]], radius: f64) -> Vec<[f64; 3]> {
    let count = corners.len();
    let way = |from: [f64; 2], to: [f64; 2]| {
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        [(to[0] - from[0]) / length, (to[1] - from[1]) / length]
    };
    let fillet = |at: usize| {
        let corner = corners[at];
        let before = way(corners[(at + count - 1) % count], corner);
        let behind = way(corner, corners[(at + 1) % count]);
        let cross = before[0] * behind[1] - before[1] * behind[0];
        let turn = cross.atan2(before[0] * behind[0] + before[1] * behind[1]);
        let length = radius * (turn.abs() / 2.0).tan();
        [
            [
                corner[0] - before[0] * length,
                corner[1] - before[1] * length,
                (turn / 4.0).tan(),
            ],
            [
                corner[0] + behind[0] * length,
                corner[1] + behind[1] * length,
                0.0,
            ],
        ]
    };
    (0..count).flat_map(fillet).collect()
}

/// A rough edge: each vertex a little further out or in, each segment an arc that bulges as it likes.
fn noise(count: usize) -> Vec<[f64; 3]> {
    let radius = count as f64 * 0.4 / TAU;
    let mut state = 1_u64;
    let mut number = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as f64 / (1_u64 << 31) as f64
    };
    let vertex = |at: usize| {
        let (sin, cos) = (TAU * at as f64 / count as f64).sin_cos();
        let away = radius + 0.3 * number();
        [away * cos, away * sin, 0.3 * number() - 0.1]
    };
    (0..count).map(vertex).collect()
}

/// Teeth 0.6 mm wide and 10 mm high, as far from each other, with round heads and feet, on a bar.
fn comb(count: usize) -> Vec<[f64; 3]> {
    let teeth = count / 4;
    let tooth = |tooth: usize| {
        let x = 1.2 * (teeth - tooth) as f64;
        [
            [x, 0.0, 0.0],
            [x, 10.0, 1.0],
            [x - 0.6, 10.0, 0.0],
            [x - 0.6, 0.0, if tooth + 1 < teeth { -1.0 } else { 0.0 }],
        ]
    };
    let bar = [[0.6, -5.0, 0.0], [1.2 * teeth as f64, -5.0, 0.0]];
    (0..teeth).flat_map(tooth).chain(bar).collect()
}

/// A band half a mm wide, wound up with half a mm between its turns, of arcs.
fn spiral(count: usize) -> Vec<[f64; 3]> {
    let half = count / 2;
    // So many segments of half a mm make turns that lie 1 mm apart.
    let turns = (half as f64 * 0.5 / std::f64::consts::PI).sqrt();
    let angle = |at: usize| TAU * turns * (0.0001 + at as f64 / (half - 1) as f64).sqrt();
    let vertex = |at: usize, outwards: f64, next: f64| {
        let along = angle(at);
        let radius = 2.0 + along / TAU + outwards;
        let bulge = ((next - along) / 4.0).tan();
        [radius * along.cos(), radius * along.sin(), bulge]
    };
    let there = (0..half).map(|at| match at + 1 < half {
        true => vertex(at, 0.25, angle(at + 1)),
        false => vertex(at, 0.25, angle(at)),
    });
    let back = (0..half).rev().map(|at| match at {
        0 => vertex(at, -0.25, angle(at)),
        _ => vertex(at, -0.25, angle(at - 1)),
    });
    there.chain(back).collect()
}
