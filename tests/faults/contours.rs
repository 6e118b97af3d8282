//! Programs without a fault: contours as machinists draw them, written by the project's own writers, and published ones.

use super::chance::Chance;
use std::f64::consts::TAU;
use std::path::Path;
use wedm::drawing::EntityId;
use wedm::geometry::{Point, Segment, Vector, left_normal, turn};
use wedm::program::{Format, Language};
use wedm::settings::{Effective, from_toml};
use wedm::toolpath::{PathSegment, Source, WirePath};

/// How programs of one group are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    Compact,
    Checking,
    Iso,
}

impl Group {
    pub const ALL: [Group; 3] = [Group::Compact, Group::Checking, Group::Iso];

    pub fn name(self) -> &'static str {
        match self {
            Group::Compact => "3B compact",
            Group::Checking => "3B checking layout",
            Group::Iso => "ISO",
        }
    }

    pub fn language(self) -> Language {
        match self {
            Group::Compact | Group::Checking => Language::ThreeB,
            Group::Iso => Language::Iso,
        }
    }
}

/// One program of a group; `None` where the contour cannot be written.
pub fn program(group: Group, chance: &mut Chance) -> Option<String> {
    if group == Group::Compact && chance.one_in(6) {
        return Some(published(chance));
    }
    let count = if chance.one_in(4) { 2 } else { 1 };
    let is_offset_by_control = group == Group::Iso && chance.one_in(3);
    let paths: Vec<WirePath> = (0..count)
        .map(|nth| path(nth, is_offset_by_control, chance))
        .collect();
    let (format, settings) = match group {
        Group::Compact => (
            Format::ThreeB,
            "[program]\nlayout = \"compact\"\n".to_owned(),
        ),
        Group::Checking => (
            Format::ThreeB,
            "[program]\nlayout = \"checking\"\n".to_owned(),
        ),
        Group::Iso => (
            Format::Iso,
            format!(
                "[program]\nprofile = \"{}\"\n",
                chance.of(&["generic", "robofil", "fast-wire"])
            ),
        ),
    };
    let (settings, errors) = from_toml(&settings);
    assert_eq!(errors, []);
    let written = format.write(&paths, 1.0, &Effective::of(&settings), &mut |_, _| true);
    written.ok().map(|program| program.text)
}

/// Contours with their ways in and out, written in 3B; `None` where that cannot be.
pub fn written(contours: &[Vec<Segment>], program: &str) -> Option<String> {
    let source = Source::Segment {
        entity: EntityId(0),
        segment: 0,
    };
    let path = |pieces: &Vec<Segment>| WirePath {
        outline: 0,
        pass: 1,
        counter_clockwise: None,
        cut_off: false,
        is_way_back: false,
        correction: 0.0,
        on_line: false,
        thread_hole: pieces[0].start(),
        side: None,
        segments: (0..)
            .zip(pieces)
            .map(|(nth, &geometry)| PathSegment {
                geometry,
                source: match nth {
                    0 => Source::LeadIn,
                    nth if nth + 1 == pieces.len() => Source::LeadOut,
                    _ => source,
                },
            })
            .collect(),
    };
    let paths: Vec<WirePath> = contours.iter().map(path).collect();
    let (settings, errors) = from_toml(&format!("[program]\n{program}\n"));
    assert_eq!(errors, []);
    let written = Format::ThreeB.write(&paths, 1.0, &Effective::of(&settings), &mut |_, _| true);
    written.ok().map(|program| program.text)
}

/// One of the programs that people published.
fn published(chance: &mut Chance) -> String {
    let name = chance.of(&[
        "comb",
        "hole",
        "plate_with_three_arcs",
        "table_of_a_book",
        "named_segments",
    ]);
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/programs/right/{name}.3b"));
    std::fs::read_to_string(path).expect("a published program")
}

/// A contour with its ways in and out, mm.
fn path(nth: usize, is_offset_by_control: bool, chance: &mut Chance) -> WirePath {
    let mut contour = contour(chance);
    let shift = Vector::new(120.0 * nth as f64, 0.0);
    contour
        .iter_mut()
        .for_each(|segment| *segment = segment.moved(shift));
    // It begins in the middle of its longest line, else at the end of its longest piece.
    let longest = |lines_alone: bool| {
        let found = contour
            .iter()
            .enumerate()
            .filter(|(_, segment)| !lines_alone || segment.as_arc().is_none());
        found
            .max_by(|(_, a), (_, b)| a.length().total_cmp(&b.length()))
            .map(|(index, _)| index)
    };
    let (line, piece) = (longest(true), longest(false));
    match line {
        Some(index) => {
            let whole = contour[index];
            let middle = rounded(whole.point_at(0.5), 0.001);
            contour[index] = Segment::line(whole.start(), middle);
            contour.rotate_left(index + 1);
            contour.insert(0, Segment::line(middle, whole.end()));
        }
        None => contour.rotate_left(piece.unwrap_or(0)),
    }
    let entry = contour[0].start();
    let source = Source::Segment {
        entity: EntityId(0),
        segment: 0,
    };
    let piece = |geometry: Segment, source: Source| PathSegment { geometry, source };
    let mut segments: Vec<PathSegment> = contour
        .iter()
        .map(|&geometry| piece(geometry, source))
        .collect();
    let mut thread_hole = entry;
    if is_offset_by_control || !chance.one_in(8) {
        let length = chance.of(&[1.0, 2.0, 3.0, 5.0]);
        thread_hole = rounded(
            entry + left_normal(contour[0].start_tangent()) * length,
            0.001,
        );
        segments.insert(0, piece(Segment::line(thread_hole, entry), Source::LeadIn));
        segments.push(piece(Segment::line(entry, thread_hole), Source::LeadOut));
    }
    let side = is_offset_by_control.then_some(wedm::finding::Side::Left);
    WirePath {
        side,
        ..WirePath::along(thread_hole, segments)
    }
}

pub fn contour(chance: &mut Chance) -> Vec<Segment> {
    let at = Point::new;
    let (w, h) = (chance.length(8.0, 90.0), chance.length(6.0, 60.0));
    let corners: Vec<Point> = match chance.below(9) {
        0 => vec![at(0.0, 0.0), at(w, 0.0), at(w, h), at(0.0, h)],
        // A slot.
        1 => {
            let r = chance.length(1.0, 8.0);
            return vec![
                Segment::line(at(0.0, -r), at(w, -r)),
                Segment::from_bulge(at(w, -r), at(w, r), 1.0),
                Segment::line(at(w, r), at(0.0, r)),
                Segment::from_bulge(at(0.0, r), at(0.0, -r), 1.0),
            ];
        }
        // A circle, whole or of two halves.
        2 => {
            let r = chance.length(2.0, 25.0);
            let halves = vec![
                Segment::from_bulge(at(r, 0.0), at(-r, 0.0), 1.0),
                Segment::from_bulge(at(-r, 0.0), at(r, 0.0), 1.0),
            ];
            let whole = wedm::geometry::Arc::about(at(0.0, 0.0), at(r, 0.0), at(r, 0.0), true);
            return if chance.one_in(2) {
                vec![Segment::Arc(whole)]
            } else {
                halves
            };
        }
        3 => {
            let (u, v) = (chance.length(2.0, w - 3.0), chance.length(2.0, h - 3.0));
            vec![
                at(0.0, 0.0),
                at(w, 0.0),
                at(w, v),
                at(u, v),
                at(u, h),
                at(0.0, h),
            ]
        }
        // Steps along a side.
        4 => {
            let teeth = 2 + chance.below(3);
            let pitch = chance.length(4.0, 9.0);
            let mut corners = vec![at(0.0, 0.0), at(pitch * (2 * teeth) as f64, 0.0)];
            for tooth in (0..teeth).rev() {
                let x = pitch * (2 * tooth) as f64;
                let depth = chance.length(2.0, 7.0);
                corners.extend([
                    at(x + 2.0 * pitch, 10.0),
                    at(x + pitch, 10.0),
                    at(x + pitch, 10.0 + depth),
                    at(x, 10.0 + depth),
                ]);
            }
            corners
        }
        // A gear of straight flanks, its tips about the middle.
        5 => return gear(chance),
        _ => {
            let count = 3 + chance.below(7);
            let turned = chance.share();
            let corner = |index: usize, radius: f64| {
                let angle = (index as f64 + turned) / count as f64 * TAU;
                Point::new(radius * angle.cos(), radius * angle.sin())
            };
            let grid = chance.of(&[0.001, 0.01, 0.5]);
            (0..count)
                .map(|index| rounded(corner(index, chance.length(8.0, 40.0)), grid))
                .collect()
        }
    };
    filleted(&corners, chance)
}

fn gear(chance: &mut Chance) -> Vec<Segment> {
    let teeth = 5 + chance.below(6);
    let (inner, outer) = (chance.length(8.0, 15.0), chance.length(17.0, 22.0));
    let at = |share: f64, radius: f64| {
        let angle = share / teeth as f64 * TAU;
        Point::new(radius * angle.cos(), radius * angle.sin())
    };
    let about = |from: Point, to: Point| {
        Segment::Arc(wedm::geometry::Arc::about(Point::origin(), from, to, true))
    };
    let tooth = |tooth: usize| {
        let t = tooth as f64;
        let nodes = [
            at(t, inner),
            at(t + 0.35, inner),
            at(t + 0.45, outer),
            at(t + 0.85, outer),
            at(t + 1.0, inner),
        ];
        [
            about(nodes[0], nodes[1]),
            Segment::line(nodes[1], nodes[2]),
            about(nodes[2], nodes[3]),
            Segment::line(nodes[3], nodes[4]),
        ]
    };
    (0..teeth).flat_map(tooth).collect()
}

/// A polygon, most of whose corners are rounded where there is room.
fn filleted(corners: &[Point], chance: &mut Chance) -> Vec<Segment> {
    let count = corners.len();
    let radius = chance.of(&[0.3, 0.5, 1.0, 2.0, 3.0]);
    let share = chance.of(&[0.0, 0.6, 1.0]);
    // Where each corner begins and ends, and its bulge.
    let rounds: Vec<(Point, Point, f64)> = (0..count)
        .map(|index| {
            let (before, own, behind) = (
                corners[(index + count - 1) % count],
                corners[index],
                corners[(index + 1) % count],
            );
            let (from, to) = (own - before, behind - own);
            let turned = turn(from, to);
            let cut = radius * (turned / 2.0).tan().abs();
            let is_round = chance.share() < share
                && turned.abs() > 0.2
                && cut < 0.4 * from.norm().min(to.norm());
            if !is_round {
                return (own, own, 0.0);
            }
            (
                own - from.normalize() * cut,
                own + to.normalize() * cut,
                (turned / 4.0).tan(),
            )
        })
        .collect();
    let mut segments = Vec::new();
    for index in 0..count {
        let (from, to, bulge) = rounds[index];
        if bulge != 0.0 {
            segments.push(Segment::from_bulge(from, to, bulge));
        }
        segments.push(Segment::line(to, rounds[(index + 1) % count].0));
    }
    segments
}

fn rounded(point: Point, grid: f64) -> Point {
    Point::new(
        (point.x / grid).round() * grid,
        (point.y / grid).round() * grid,
    )
}
