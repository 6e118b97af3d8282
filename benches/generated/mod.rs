//! Generated drawings for the benchmarks: the same bytes on every machine.

#![allow(dead_code)]

pub mod contours;
pub mod shapes;

use std::fmt::Write;

/// Vertices of one die opening near (x, y): a rounded rectangle, counter-clockwise, its first fillet of radius `tight`.
pub fn opening(x: f64, y: f64, tight: f64) -> Vec<[f64; 3]> {
    let bulge = (std::f64::consts::PI / 8.0).tan();
    let (width, height, wide) = (6.0, 4.0, 0.5);
    let corners = [
        (width, 0.0, tight, 1.0, 0.0),
        (width, height, wide, 0.0, 1.0),
        (0.0, height, wide, -1.0, 0.0),
        (0.0, 0.0, wide, 0.0, -1.0),
    ];
    let mut vertices = Vec::new();
    for (cx, cy, r, along_x, along_y) in corners {
        let (x, y): (f64, f64) = (x + cx, y + cy);
        vertices.push([x - along_x * r, y - along_y * r, bulge]);
        vertices.push([x - along_y * r, y + along_x * r, 0.0]);
    }
    vertices
}

fn header(text: &mut String) {
    text.push_str("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
}

fn place(i: usize) -> (f64, f64) {
    ((i % 100) as f64 * 8.0, (i / 100) as f64 * 6.0)
}

/// DXF of at least `bytes` bytes: openings as LWPOLYLINEs, every fiftieth with a fillet below the correction of 0.1.
pub fn polylines(bytes: usize) -> String {
    polylines_while(|_, length| length < bytes)
}

/// DXF of this many such openings, of eight vertices each.
pub fn polylines_of(openings: usize) -> String {
    polylines_while(|i, _| i < openings)
}

/// `goes_on` is asked with the number of openings and the length of the text.
fn polylines_while(goes_on: impl Fn(usize, usize) -> bool) -> String {
    let mut text = String::new();
    header(&mut text);
    let mut i = 0;
    while goes_on(i, text.len()) {
        let (x, y) = place(i);
        let vertices = opening(x, y, if i % 50 == 7 { 0.05 } else { 0.3 });
        let _ = write!(
            text,
            "0\nLWPOLYLINE\n5\n{:X}\n100\nAcDbEntity\n8\nDIE\n100\nAcDbPolyline\n90\n{}\n70\n1\n",
            100 + i,
            vertices.len()
        );
        for [x, y, bulge] in vertices {
            let _ = write!(text, "10\n{x:.9}\n20\n{y:.9}\n");
            if bulge != 0.0 {
                let _ = write!(text, "42\n{bulge:.12}\n");
            }
        }
        i += 1;
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

/// The same openings as chains of LINE and ARC.
pub fn lines_and_arcs(bytes: usize) -> String {
    lines_and_arcs_while(|_, length| length < bytes)
}

/// DXF of this many such openings, of eight entities each.
pub fn lines_and_arcs_of(openings: usize) -> String {
    lines_and_arcs_while(|i, _| i < openings)
}

fn lines_and_arcs_while(goes_on: impl Fn(usize, usize) -> bool) -> String {
    let mut text = String::new();
    header(&mut text);
    let (mut i, mut handle) = (0, 100);
    while goes_on(i, text.len()) {
        let (x, y) = place(i);
        let vertices = opening(x, y, if i % 50 == 7 { 0.05 } else { 0.3 });
        for (k, &[x0, y0, bulge]) in vertices.iter().enumerate() {
            let [x1, y1, _] = vertices[(k + 1) % vertices.len()];
            handle += 1;
            if bulge == 0.0 {
                let _ = write!(
                    text,
                    "0\nLINE\n5\n{handle:X}\n8\nDIE\n10\n{x0:.9}\n20\n{y0:.9}\n11\n{x1:.9}\n21\n{y1:.9}\n"
                );
            } else {
                let (dx, dy) = (x1 - x0, y1 - y0);
                let h = (1.0 - bulge * bulge) / (4.0 * bulge);
                let (cx, cy) = ((x0 + x1) / 2.0 - h * dy, (y0 + y1) / 2.0 + h * dx);
                let angle =
                    |px: f64, py: f64| (py - cy).atan2(px - cx).to_degrees().rem_euclid(360.0);
                let _ = write!(
                    text,
                    "0\nARC\n5\n{handle:X}\n8\nDIE\n10\n{cx:.9}\n20\n{cy:.9}\n40\n{:.9}\n50\n{:.9}\n51\n{:.9}\n",
                    (x0 - cx).hypot(y0 - cy),
                    angle(x0, y0),
                    angle(x1, y1)
                );
            }
        }
        i += 1;
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

/// DXF of at least `bytes` bytes: rounded plates in LINE and ARC, 40 beside each other in a row with little between them. An end that is
/// thrown far to the side crosses its whole row.
pub fn plates(bytes: usize) -> String {
    let mut text = String::new();
    header(&mut text);
    let (mut plate, mut handle) = (0, 100);
    while text.len() < bytes {
        let (left, low) = ((plate % 40) as f64 * 21.0, (plate / 40) as f64 * 13.0);
        let (right, high, r) = (left + 20.0, low + 12.0, 2.0);
        let mut add = |kind: &str, tags: std::fmt::Arguments| {
            handle += 1;
            let _ = write!(text, "0\n{kind}\n5\n{handle:X}\n8\nPLATE\n{tags}");
        };
        for [x0, y0, x1, y1] in [
            [left + r, low, right - r, low],
            [right, low + r, right, high - r],
            [right - r, high, left + r, high],
            [left, high - r, left, low + r],
        ] {
            add(
                "LINE",
                format_args!("10\n{x0:.6}\n20\n{y0:.6}\n11\n{x1:.6}\n21\n{y1:.6}\n"),
            );
        }
        for (x, y, from) in [
            (right - r, low + r, 270),
            (right - r, high - r, 0),
            (left + r, high - r, 90),
            (left + r, low + r, 180),
        ] {
            let to = (from + 90) % 360;
            add(
                "ARC",
                format_args!("10\n{x:.6}\n20\n{y:.6}\n40\n{r:.6}\n50\n{from}\n51\n{to}\n"),
            );
        }
        plate += 1;
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

/// DXF with one LWPOLYLINE of `count` vertices that goes up and down in steps finer than the wire, row over row.
pub fn zigzag(count: usize) -> String {
    const ROW: usize = 2_000;
    let mut text = String::new();
    header(&mut text);
    let _ = write!(text, "0\nLWPOLYLINE\n5\n2A\n8\nDIE\n90\n{count}\n70\n0\n");
    for i in 0..count {
        let (row, step) = (i / ROW, i % ROW);
        let along = if row % 2 == 0 { step } else { ROW - 1 - step };
        let (x, y) = (along as f64 * 0.08, row as f64 * 3.0 + (i % 2) as f64 * 1.5);
        let _ = write!(text, "10\n{x:.6}\n20\n{y:.6}\n");
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

/// A 3B program that runs the same two squares round, one within the other, as often as makes that many blocks.
pub fn three_b_round(blocks: usize) -> String {
    let mut text = String::with_capacity(blocks * 26);
    for round in 0..blocks / 4 {
        let side = if round % 2 == 0 { 100_000 } else { 90_000 };
        for direction in ["GXL1", "GYL2", "GXL3", "GYL4"] {
            let (x, y) = if direction.contains('X') {
                (side, 0)
            } else {
                (0, side)
            };
            let _ = writeln!(text, "B{x}B{y}B{side}{direction}");
        }
    }
    text + "DD\n"
}

/// The same squares as an ISO program, absolute in mm.
pub fn iso_round(blocks: usize) -> String {
    let mut text = String::with_capacity(blocks * 26);
    text.push_str("%\nG90\nG92 X0.000 Y0.000\n");
    for round in 0..blocks / 4 {
        let side = if round % 2 == 0 { 100 } else { 90 };
        for (x, y) in [(side, 0), (side, side), (0, side), (0, 0)] {
            let _ = writeln!(text, "G01 X{x}.000 Y{y}.000");
        }
    }
    text + "M02\n"
}

/// Round holes as an ISO program, each of another size, the wire beside them by the control's correction.
pub fn iso_holes(blocks: usize) -> String {
    let mut text = String::from("%\nG90\nG92 X0.000 Y0.000\n");
    for hole in 0..blocks / 6 {
        let (x, y, radius) = (hole % 200 * 20, hole / 200 * 20, 1000 + hole % 7919);
        let (begin, radius) = (x * 1000 + radius, radius as f64 / 1e3);
        let begin = begin as f64 / 1e3;
        let _ = writeln!(text, "G00 X{x}.000 Y{y}.000\nM00");
        let _ = writeln!(text, "G41 D01 G01 X{begin:.3} Y{y}.000");
        let _ = writeln!(text, "G03 X{begin:.3} Y{y}.000 I-{radius:.3} J0.000");
        let _ = writeln!(text, "G40 G01 X{x}.000 Y{y}.000\nM00");
    }
    text + "M02\n"
}

/// The places of a die opening cut to and fro in three passes from a stop before its tab on, and of the way back to the
/// thread hole after the stop, in mm.
fn before_tab() -> (Vec<[i64; 2]>, [[i64; 2]; 2]) {
    let pass = [[2, 0], [12, 0], [12, 10], [2, 10], [2, 3]];
    let back = pass.iter().rev().skip(1).copied();
    let passes = pass.iter().copied().chain(back);
    let passes = passes.chain(pass.iter().skip(1).copied());
    (passes.collect(), [[2, 0], [0, 0]])
}

/// An ISO program of die openings with tabs, each cut to and fro before the tab.
pub fn iso_tabs(blocks: usize) -> String {
    let (passes, tab) = before_tab();
    let mut text = String::from("%\nG90\nG92 X0.000 Y0.000\n");
    for opening in 0..blocks / 20 {
        let (x, y) = (opening as i64 % 200 * 20, opening as i64 / 200 * 20);
        let _ = writeln!(text, "G00 X{x}.000 Y{y}.000\nM00");
        for part in [&passes[..], &tab] {
            for [dx, dy] in part {
                let _ = writeln!(text, "G01 X{}.000 Y{}.000", x + dx, y + dy);
            }
            text.push_str("M00\n");
        }
    }
    text + "M02\n"
}

/// The same as a 3B program.
pub fn three_b_tabs(blocks: usize) -> String {
    let (passes, tab) = before_tab();
    let mut text = String::with_capacity(blocks * 22);
    for _ in 0..blocks / 17 {
        let mut at = [0, 0];
        for part in [&passes[..], &tab] {
            for to in part {
                let [dx, dy] = [(to[0] - at[0]) * 1000, (to[1] - at[1]) * 1000];
                let quadrant = match (dx > 0, dy > 0) {
                    (true, _) if dy >= 0 => 1,
                    (_, true) => 2,
                    (false, _) if dx < 0 => 3,
                    _ => 4,
                };
                let (dx, dy) = (dx.abs(), dy.abs());
                let axis = if dx > dy { 'X' } else { 'Y' };
                let _ = writeln!(text, "B{dx}B{dy}B{}G{axis}L{quadrant}", dx.max(dy));
                at = *to;
            }
            text.push_str("D\n");
        }
        text.push_str("B20000B0B20000GXL1\nD\n");
    }
    text + "DD\n"
}

/// The blocks of a contour of 3B with a number that is 500 too small, so that it does not close, and its radii as 4B
/// writes them.
fn open_contour(nth: usize) -> [(i64, i64, i64, &'static str, i64); 8] {
    let (side, r) = (6000 + nth as i64 % 4093, 1000);
    [
        (2000, 0, 2000, "GXL1", 0),
        (0, side, side, "GYL2", 0),
        (r, 0, r, "GXNR1", r),
        (side, 0, side, "GXL3", 0),
        (0, r, r, "GYNR2", r),
        (0, side - 500, side - 500, "GYL4", 0),
        (side + 2 * r, 0, side + 2 * r, "GXL1", 0),
        (0, r, r, "GYL4", 0),
    ]
}

/// A 3B program of contours that all stay open, each of another size.
pub fn three_b_open(blocks: usize) -> String {
    let mut text = String::with_capacity(blocks * 22);
    for contour in 0..blocks / 9 {
        for (x, y, j, z, _) in open_contour(contour) {
            let _ = writeln!(text, "B{x}B{y}B{j}{z}");
        }
        text.push_str("D\nB20000B0B20000GXL1\nD\n");
    }
    text + "DD\n"
}

/// The same as a 4B program.
pub fn four_b_open(blocks: usize) -> String {
    let mut text = String::with_capacity(blocks * 26);
    for contour in 0..blocks / 9 {
        for (x, y, j, z, radius) in open_contour(contour) {
            let (axis, motion) = z.split_at(2);
            let _ = match radius {
                0 => writeln!(text, "B{x}B{y}B{j}{z}"),
                _ => writeln!(text, "B{x}B{y}B{j}B{radius}{axis}D{motion}"),
            };
        }
        text.push_str("D\nB20000B0B20000GXL1\nD\n");
    }
    text + "DD\n"
}

/// An ISO program of contours that all stay open, each of another size.
pub fn iso_open(blocks: usize) -> String {
    let mut text = String::from("%\nG90\nG92 X0.000 Y0.000\n");
    for contour in 0..blocks / 9 {
        let (x, y) = (contour as i64 % 200 * 20, contour as i64 / 200 * 20);
        let side = 6000 + contour as i64 % 4093;
        let _ = writeln!(text, "G00 X{x}.000 Y{y}.000\nM00");
        let (x, y) = (x * 1000, y * 1000);
        for (dx, dy) in [
            (2000, 0),
            (2000, side),
            (2000 + side, side),
            (2000 + side, -500),
            (2500, -500),
        ] {
            let [x, y] = [x + dx, y + dy].map(|um| um as f64 / 1e3);
            let _ = writeln!(text, "G01 X{x:.3} Y{y:.3}");
        }
        text.push_str("M00\n");
    }
    text + "M02\n"
}

/// Vertices of one closed polyline of `count` vertices: a saw round a large circle, every tenth tooth rounded.
pub fn long_outline(count: usize) -> Vec<[f64; 3]> {
    let radius = count as f64 * 0.2;
    let vertex = |i: usize| {
        let angle = i as f64 / count as f64 * std::f64::consts::TAU;
        let r = radius + if i.is_multiple_of(2) { 0.0 } else { 0.4 };
        [
            r * angle.cos(),
            r * angle.sin(),
            if i.is_multiple_of(10) { 0.1 } else { 0.0 },
        ]
    };
    (0..count).map(vertex).collect()
}

/// DXF with one LWPOLYLINE of `count` vertices.
pub fn one_polyline(count: usize) -> String {
    let mut text = String::new();
    header(&mut text);
    let _ = write!(text, "0\nLWPOLYLINE\n5\n2A\n8\nDIE\n90\n{count}\n70\n1\n");
    for [x, y, bulge] in long_outline(count) {
        let _ = write!(text, "10\n{x:.9}\n20\n{y:.9}\n");
        if bulge != 0.0 {
            let _ = write!(text, "42\n{bulge:.12}\n");
        }
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

/// A 3B program of about 25 bytes for each of its blocks: squares that stand askew, each with a circle, beside each other with pauses between.
pub fn three_b(blocks: usize) -> String {
    let square = [
        (123_456, 23_456, "GXL1"),
        (23_456, 123_456, "GYL2"),
        (123_456, 23_456, "GXL3"),
        (23_456, 123_456, "GYL4"),
    ];
    let mut text = String::with_capacity(blocks * 26);
    let mut written = 0;
    loop {
        for (x, y, z) in square {
            text += &format!("B{x}B{y}B{}{z}\n", x.max(y));
        }
        text += "B100000B0B400000GYNR1\n";
        written += 5;
        if written >= blocks {
            break;
        }
        text += "D\nB500000B0B500000GXL1\nD\n";
        written += 1;
    }
    text + "DD\n"
}

/// The same squares and circles as an ISO program of about 25 bytes for each block, absolute in mm, cut without compensation.
pub fn iso(blocks: usize) -> String {
    let mm = |um: i64| {
        format!(
            "{}{}.{:03}",
            if um < 0 { "-" } else { "" },
            um.abs() / 1000,
            um.abs() % 1000
        )
    };
    let square = [
        (123_456, 23_456),
        (100_000, 146_912),
        (-23_456, 123_456),
        (0, 0),
    ];
    let mut text = String::with_capacity(blocks * 26);
    text.push_str("%\nG90\nG92 X0.000 Y0.000\n");
    let (mut written, mut x) = (0, 0);
    loop {
        for (dx, dy) in square {
            text += &format!("G01 X{} Y{}\n", mm(x + dx), mm(dy));
        }
        text += &format!("G03 X{} Y0.000 I-100.000 J0.000\n", mm(x));
        written += 5;
        if written >= blocks {
            break;
        }
        x = (x + 500_000) % 50_000_000;
        text += &format!("M00\nG00 X{} Y0.000\nM00\n", mm(x));
        written += 1;
    }
    text + "M02\n"
}
