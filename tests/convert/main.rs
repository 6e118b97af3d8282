//! Programs turned into drawings and into other languages, and back: the geometry stays.

mod corrections;
mod drawn;
mod losses;
mod unfollowed;
mod ways;
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::process::Command;
use wedm::drawing::{Drawing, EntityId, Geometry};
use wedm::dxf;
use wedm::finding::Rule;
use wedm::geometry::{Arc, Point, Segment, direction};
use wedm::program::{Document, Format, Language, convert};
use wedm::settings::{Effective, Layout, from_toml};
use wedm::toolpath::{PathSegment, Source, WirePath};

fn settings(text: &str) -> Effective {
    let (settings, errors) = from_toml(text);
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

/// A closed contour of lines and arcs about a middle, entered from there; mm.
fn contour() -> impl Strategy<Value = Vec<Segment>> {
    let corner = (
        2.0_f64..40.0,
        prop_oneof![3 => Just(0.0), 2 => -1.5_f64..1.5, 1 => -0.02_f64..0.02],
    );
    let ways = prop::sample::select(vec![
        (true, true),
        (true, true),
        (false, false),
        (true, false),
    ]);
    (
        prop::collection::vec(corner, 3..14),
        -300.0_f64..300.0,
        -300.0_f64..300.0,
        0.0_f64..1.0,
        ways,
    )
        .prop_map(|(corners, x, y, turned, (way_in, way_out))| {
            let middle = Point::new(x, y);
            let count = corners.len();
            let at = |index: usize| {
                middle
                    + direction((index as f64 + turned) / count as f64 * TAU)
                        * corners[index % count].0
            };
            let mut segments = Vec::new();
            segments.extend(way_in.then(|| Segment::line(middle, at(0))));
            segments.extend((0..count).map(|index| {
                Segment::from_bulge(at(index), at((index + 1) % count), corners[index].1)
            }));
            segments.extend(way_out.then(|| Segment::line(at(0), middle)));
            segments
        })
}

/// The ways a program can be written in which its nodes come back, and the settings that do it: layouts of 3B; every convention of I and J
/// in every mode of coordinates of ISO, in µm and in mm.
const VIAS: [&str; 9] = [
    "checking",
    "compact",
    "robofil",
    "iso absolute start-to-center mm",
    "iso absolute center-to-start um",
    "iso absolute absolute mm",
    "iso absolute absolute um",
    "iso incremental start-to-center um",
    "iso incremental center-to-start mm",
];

fn written(format: Format, paths: &[WirePath], unit_mm: f64, settings: &Effective) -> String {
    format
        .write(paths, unit_mm, settings, &mut |_, _| true)
        .expect("a program")
        .text
}

fn read(language: Language, text: &str, settings: &Effective) -> Document {
    Document::read(language, text.as_bytes().to_vec(), settings)
}

fn all(drawing: &Drawing) -> Vec<Segment> {
    drawing
        .entities()
        .flat_map(|(_, entity)| entity.geometry.segments().collect::<Vec<_>>())
        .collect()
}

fn wedm(folder: &Path, arguments: &str) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_wedm"))
        .args(arguments.split(' '))
        .current_dir(folder)
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code().unwrap_or(-1),
        text(&output.stdout),
        text(&output.stderr),
    )
}
