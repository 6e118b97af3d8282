//! Programs turned into drawings and into other languages, and back: the geometry stays.

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

fn way_to_write(via: &str) -> (Language, Format, Effective) {
    let words: Vec<&str> = via.split(' ').collect();
    match words[..] {
        [layout @ ("checking" | "compact" | "aligned")] => (
            Language::ThreeB,
            Format::ThreeB,
            settings(&format!("[program]\nlayout = \"{layout}\"\n")),
        ),
        ["iso", coordinates, center, unit] => {
            let word = if coordinates == "absolute" {
                "G90"
            } else {
                "G91"
            };
            let profile = format!(
                "[program]\nprofile = \"own\"\n[profiles.own]\ncoordinates = \"{coordinates}\"\ncenter = \"{center}\"\nunit = \"{unit}\"\n\
                 begin = [\"G92 X{{x}} Y{{y}}\", \"{word}\"]\n"
            );
            (Language::Iso, Format::Iso, settings(&profile))
        }
        [profile] => (
            Language::Iso,
            Format::Iso,
            settings(&format!("[program]\nprofile = \"{profile}\"\n")),
        ),
        _ => panic!("{via}"),
    }
}

fn path_of(segments: &[Segment]) -> WirePath {
    let source = Source::Segment {
        entity: EntityId(0),
        segment: 0,
    };
    let thread_hole = segments.first().map_or_else(Point::origin, Segment::start);
    let segments = segments
        .iter()
        .map(|&geometry| PathSegment { geometry, source })
        .collect();
    WirePath {
        outline: 0,
        pass: 1,
        counter_clockwise: None,
        cut_off: false,
        correction: 0.0,
        thread_hole,
        side: None,
        segments,
    }
}

fn written(format: Format, paths: &[WirePath], unit_mm: f64, settings: &Effective) -> String {
    format
        .write(paths, unit_mm, settings, &mut |_, _| true)
        .expect("a program")
        .text
}

fn read(language: Language, text: &str, settings: &Effective) -> Document {
    Document::read(language, text.as_bytes().to_vec(), settings)
}

/// Points in mm that a drawing's segments join.
fn nodes(drawing: &Drawing) -> Vec<Point> {
    drawing
        .entities()
        .flat_map(|(_, entity)| {
            entity
                .geometry
                .segments()
                .flat_map(|s| [s.start(), s.end()])
                .collect::<Vec<_>>()
        })
        .collect()
}

/// By how much the points of `segments` are off from the nearest of `nodes` at most, mm.
fn farthest(segments: &[Segment], nodes: &[Point]) -> f64 {
    let ends = segments
        .iter()
        .flat_map(|segment| [segment.start(), segment.end()]);
    let off = |end: Point| {
        nodes
            .iter()
            .map(|node| (node - end).norm())
            .fold(f64::INFINITY, f64::min)
    };
    ends.map(off).fold(0.0, f64::max)
}

/// By how much the middles of what is made are off from what it was made of at most, mm.
fn strays(made: &[Segment], of: &[Segment]) -> f64 {
    let off = |segment: &Segment| {
        of.iter()
            .map(|other| other.distance_to(segment.point_at(0.5)))
            .fold(f64::INFINITY, f64::min)
    };
    made.iter().map(off).fold(0.0, f64::max)
}

fn all(drawing: &Drawing) -> Vec<Segment> {
    drawing
        .entities()
        .flat_map(|(_, entity)| entity.geometry.segments().collect::<Vec<_>>())
        .collect()
}

proptest! {
    #[test]
    fn a_drawing_that_went_through_a_program_has_its_nodes(
        segments in contour(),
        via in prop::sample::select(VIAS.to_vec()),
    ) {
        let paths = [path_of(&segments)];
        let (language, format, settings) = way_to_write(via);
        let text = written(format, &paths, 1.0, &settings);
        let cuts = convert::cuts(&read(language, &text, &settings));
        prop_assert_eq!(cuts.lost.len(), 0);
        // The text of the drawing is read again, as a CAD program would.
        let bytes = dxf::write(&cuts.drawing()).unwrap();
        let back = dxf::Document::read(bytes);
        prop_assert!(back.findings().is_empty(), "{:?}", back.findings());
        // Programs that hold no place begin at the origin: the first node, on the grid.
        let begin = segments[0].start();
        let shift = match via {
            "compact" | "robofil" => Point::new((begin.x * 1e3).round() / 1e3, (begin.y * 1e3).round() / 1e3).coords,
            _ => Point::origin().coords,
        };
        let moved: Vec<Point> = nodes(back.drawing()).iter().map(|node| node + shift).collect();
        // Nothing drifts where coordinates are written, else as far as 3B allows.
        let arcs = segments.iter().filter(|segment| segment.as_arc().is_some()).count() as f64;
        let allowed = if via == "compact" { 0.002 + 0.0015 * arcs } else { 0.0015 };
        let off = farthest(&segments, &moved);
        prop_assert!(off <= allowed, "{via}: {off} of {allowed} mm\n{text}");
        // One polyline, closed, and the ways in and out as lines.
        let kinds: Vec<&str> = back.drawing().entities().map(|(_, entity)| entity.kind.name()).collect();
        prop_assert_eq!(kinds.iter().filter(|kind| **kind == "LWPOLYLINE").count(), 1);
        let closed = back.drawing().entities().any(|(_, entity)| matches!(entity.geometry, Geometry::Polyline { closed: true, .. }));
        prop_assert!(closed, "{kinds:?}\n{text}");
    }

    #[test]
    fn programs_of_all_languages_are_turned_into_each_other(
        segments in contour(),
        route in prop::sample::subsequence(vec!["checking", "fast-wire", "robofil", "aligned", "generic", "compact"], 2..6).prop_shuffle(),
    ) {
        let mut paths = vec![path_of(&segments)];
        let mut unit_mm = 1.0;
        let mut origin = Point::origin().coords;
        let begin = segments[0].start();
        for via in &route {
            let (language, format, settings) = way_to_write(via);
            let text = written(format, &paths, unit_mm, &settings);
            let program = read(language, &text, &settings);
            // A lone arc may fit two readings of I and J; that is said, and which one is meant nobody can tell.
            if program.findings(&settings, 500).0.iter().any(|finding| finding.rule == Rule::AmbiguousCenter) {
                return Ok(());
            }
            let cuts = convert::cuts(&program);
            prop_assert_eq!(cuts.cuts.len(), 1, "{}\n{}", via, text);
            prop_assert!(cuts.cuts[0].closed, "{via}\n{text}");
            paths = cuts.paths();
            unit_mm = 1e-3;
            if matches!(*via, "compact" | "robofil") {
                origin = Point::new((begin.x * 1e3).round() / 1e3, (begin.y * 1e3).round() / 1e3).coords;
            }
        }
        let made: Vec<Segment> = paths[0].segments.iter().map(|piece| moved(&piece.geometry, 1e-3, origin)).collect();
        let arcs = segments.iter().filter(|segment| segment.as_arc().is_some()).count() as f64;
        let allowed = (0.003 + 0.0015 * arcs) * route.len() as f64;
        let ends: Vec<Point> = made.iter().flat_map(|segment| [segment.start(), segment.end()]).collect();
        prop_assert!(farthest(&segments, &ends) <= allowed, "{route:?}: {} of {allowed}", farthest(&segments, &ends));
        prop_assert!(strays(&made, &segments) <= allowed + 0.003, "{route:?}: {}", strays(&made, &segments));
        let length = |segments: &[Segment]| segments.iter().map(Segment::length).sum::<f64>();
        prop_assert!((length(&made) - length(&segments)).abs() <= 0.01 * made.len() as f64 * route.len() as f64);
    }
}

fn moved(segment: &Segment, scale: f64, by: wedm::geometry::Vector) -> Segment {
    match segment {
        Segment::Line(line) => Segment::line(line.start * scale + by, line.end * scale + by),
        Segment::Arc(arc) => Segment::Arc(Arc {
            center: arc.center * scale + by,
            radius: arc.radius * scale,
            start: arc.start * scale + by,
            end: arc.end * scale + by,
            ..*arc
        }),
    }
}

#[test]
fn several_contours_keep_their_ways() {
    let square = |x: f64| {
        let at = |dx: f64, dy: f64| Point::new(x + dx, dy);
        let corners = [
            at(0.0, 0.0),
            at(1.0, 0.0),
            at(3.0, 0.0),
            at(3.0, 2.0),
            at(1.0, 2.0),
            at(1.0, 0.0),
            at(0.0, 0.0),
        ];
        path_of(
            &corners
                .windows(2)
                .map(|pair| Segment::line(pair[0], pair[1]))
                .collect::<Vec<_>>(),
        )
    };
    let paths = [square(0.0), square(10.0), square(25.0)];
    for (language, format) in [
        (Language::Iso, Format::Iso),
        (Language::ThreeB, Format::ThreeB),
    ] {
        for layout in [Layout::Compact, Layout::Aligned, Layout::Checking] {
            let settings = Effective {
                layout,
                ..Effective::default()
            };
            let text = written(format, &paths, 1.0, &settings);
            let cuts = convert::cuts(&read(language, &text, &settings));
            assert_eq!(cuts.cuts.len(), 3, "{text}");
            let ways =
                [[0.0, 10_000.0], [10_000.0, 25_000.0]].map(|way| way.map(|x| Point::new(x, 0.0)));
            assert_eq!(cuts.ways, ways, "{text}");
            assert!(
                cuts.cuts.iter().all(|cut| cut.closed
                    && cut.lead_in == 1
                    && cut.lead_out == 1
                    && cut.contour().len() == 4),
                "{cuts:?}"
            );
            // As text that a CAD program reads: contours closed on CUT, leads on LEAD, ways on WAY.
            let back = dxf::Document::read(dxf::write(&cuts.drawing()).unwrap());
            assert!(back.findings().is_empty(), "{:?}", back.findings());
            let mut on: Vec<String> = back
                .drawing()
                .entities()
                .map(|(_, entity)| format!("{} {}", entity.layer, entity.kind))
                .collect();
            on.sort();
            on.dedup_by(|a, b| a == b);
            assert_eq!(on, ["CUT LWPOLYLINE", "LEAD LINE", "WAY LINE"]);
            assert_eq!(all(back.drawing()).len(), 3 * 6 + 2);
            assert!(paths.iter().all(|path| {
                let segments: Vec<Segment> =
                    path.segments.iter().map(|piece| piece.geometry).collect();
                farthest(&segments, &nodes(back.drawing())) <= 1e-9
            }));
        }
    }
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

#[test]
fn the_correction_is_never_lost_without_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    put(
        "part.4b",
        "B10000B0B10000GXL1\nB10000B0B40000B10000GYDDNR1\nB10000B0B10000GXL3\nDD\n",
    );
    let square = "G01 X5. Y0.\nY5.\nX-5.\nY-5.\nX5.\nY0.\n";
    put(
        "side.iso",
        &format!("G92 X0 Y0\nG90\nG41 D1\n{square}G40\nG01 X0.\nM02\n"),
    );
    put(
        "late.iso",
        &format!("G92 X0 Y0\nG90\nG01 X1. Y0.\nG41 D1\n{square}G40\nG01 X1. Y0.\nX0.\nM02\n"),
    );
    put(
        "own.iso",
        &format!("H1=0.155\nG92 X0 Y0\nG90\nG41 H1\n{square}G40\nG01 X0.\nM02\n"),
    );
    put(
        "mixed.iso",
        "G92 X0 Y0\nG90\nG01 X5. Y0.\nY5.\nG41 D1\nG01 X-5.\nY-5.\nX5.\nG40\nG01 Y0.\nX0.\nM02\n",
    );
    for (from, to, said) in [
        (
            "part.4b",
            "iso",
            "line 2: a 4B program holds the part's contour",
        ),
        (
            "part.4b",
            "3b",
            "line 2: a 4B program holds the part's contour",
        ),
        (
            "side.iso",
            "3b",
            "the control adds the correction of this program (G41, G42)",
        ),
        (
            "late.iso",
            "3b",
            "the control adds the correction of this program (G41, G42)",
        ),
        (
            "mixed.iso",
            "3b",
            "the correction is switched within the contour",
        ),
        (
            "mixed.iso",
            "iso",
            "the correction is switched within the contour",
        ),
        (
            "own.iso",
            "4b",
            "the program's own correction H1 is 0.155 mm",
        ),
    ] {
        let (code, out, errors) = wedm(
            folder.path(),
            &format!("convert {from} --force --format {to} -o out.{to}"),
        );
        assert_eq!(code, 1, "{from} to {to}: {out}{errors}");
        assert!(errors.contains(said), "{from} to {to}: {errors}");
        assert!(!folder.path().join(format!("out.{to}")).exists());
    }
    for (from, to, said) in [
        ("part.4b", "dxf", "the correction is not in them"),
        ("late.iso", "dxf", "the correction is not in them"),
        ("own.iso", "iso --profile generic", "H1 = 0.155 mm"),
    ] {
        let (code, out, errors) = wedm(
            folder.path(),
            &format!("convert {from} --force --format {to} -o out.x"),
        );
        let all = format!("{out}{errors}");
        assert_eq!(code, 0, "{from} to {to}: {all}");
        assert!(all.contains(said), "{from} to {to}: {all}");
    }
}

/// What tilts the wire is not in a conversion: nothing is made of it unless somebody forces it, and then it is said. Planes by which
/// nothing leans lose nothing but their words.
#[test]
fn a_taper_is_dropped_only_where_it_is_forced() {
    let folder = tempfile::tempdir().unwrap();
    for (name, words, end, leans) in [
        ("angle", "G51 A2.\n", "G50\n", true),
        ("right", "G52 A0.5\n", "G50\n", true),
        ("guides", "", "G01 X5. Y5. U0.3 V0.\n", true),
        ("no-angle", "G51\n", "", true),
        ("planes", "TP0.\nTN40.\n", "", false),
    ] {
        let text = format!(
            "G92 X0 Y0\nG90\n{words}G01 X5. Y0.\nY5.\n{end}X-5.\nY-5.\nX5.\nY0.\nX0.\nM02\n"
        );
        std::fs::write(folder.path().join("in.iso"), text).unwrap();
        std::fs::write(folder.path().join("wedm.toml"), "[job]\nthickness = 40\n").unwrap();
        for to in ["iso", "3b", "dxf"] {
            let (code, _, said) = wedm(folder.path(), &format!("convert in.iso -o {name}.{to}"));
            assert_eq!(code, i32::from(leans), "{name} as {to}: {said}");
            assert_eq!(folder.path().join(format!("{name}.{to}")).exists(), !leans);
            assert_eq!(said.contains("--force"), leans, "{name} as {to}: {said}");
            let (code, _, said) = wedm(
                folder.path(),
                &format!("convert in.iso --force -o {name}.{to}"),
            );
            assert_eq!(code, 0, "{name} as {to}: {said}");
            assert!(said.contains("not written: the taper"), "{said}");
        }
    }
}

#[test]
fn the_command_converts_and_refuses() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    put(
        "hole.3b",
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n",
    );
    put(
        "off.iso",
        "G92 X0 Y0\nG91\nG01 X1000\nG02 X1000 I400 J0\nG01 X-2000\nM02\n",
    );
    put("empty.3b", "DD\n");
    put("part.dxf", "0\nEOF\n");
    let check = |arguments: &str, code: i32, expected: &str| {
        let (ended, stdout, stderr) = wedm(folder.path(), arguments);
        assert!(
            ended == code && (stdout.contains(expected) || stderr.contains(expected)),
            "{arguments}: {ended}\n{stdout}\n{stderr}"
        );
    };
    check(
        "convert hole.3b -o hole.dxf",
        0,
        "written hole.dxf: 1 contour",
    );
    check(
        "convert hole.3b -o hole.iso --profile fast-wire",
        0,
        "written hole.iso: 4 blocks, 1 contour",
    );
    check(
        "convert hole.iso -o again.3b --layout checking",
        0,
        "written again.3b: 4 blocks",
    );
    check(
        "convert hole.3b --format iso --profile robofil",
        0,
        "G03 X-9.900 Y0.000 I0.000 J0.000",
    );
    // A part's contour under G42, its corners rounded, becomes 4B; a path of the wire does not say where the part is.
    put(
        "part.iso",
        "G92 X0. Y-5.\nG90\nG42 D1\nG01 X0. Y0.\nX9. Y0.\nG03 X10. Y1. I0. J1.\nG01 Y10.\nX-10. Y10.\nY0.\nX0.\nG40\nG01 Y-5.\nM02\n",
    );
    check(
        "convert part.iso -o part.4b --correction 0.15",
        0,
        "written part.4b: 11 blocks, 1 contour",
    );
    let four_b = std::fs::read_to_string(folder.path().join("part.4b")).unwrap();
    assert!(
        four_b.contains("B0B1000B1000B1000GYDNR4\n") && four_b.contains("B151GYDNR"),
        "{four_b}"
    );
    check("check part.4b", 0, "1 file checked");
    check(
        "convert part.4b -o again.dxf",
        0,
        "written again.dxf: 1 contour",
    );
    check(
        "convert hole.3b -o hole.4b",
        1,
        "4B holds the part's contour",
    );
    check("convert hole.3b --format 4b", 1, "say opening or punch");
    check("convert off.iso -o off.dxf", 1, "the program has 1 error");
    check(
        "convert off.iso -o off.dxf --force",
        0,
        "left out, since they lead nowhere: lines 4",
    );
    check("convert empty.3b -o empty.dxf", 1, "it cuts nothing");
    check("convert part.dxf -o part.3b", 2, "it is a drawing");
    check(
        "convert hole.3b -o hole.step",
        2,
        "\"step\" is not written, expected dxf, ",
    );
    check("convert hole.3b -o hole", 2, "no ending");
    check("convert hole.3b", 2, "expected -o OUT or --format");
    let iso = std::fs::read_to_string(folder.path().join("hole.iso")).unwrap();
    assert_eq!(
        iso,
        "G92 X0 Y0\nG91\nG01 X9900 Y0\nG03 X-19800 Y0 I-9900 J0\nG03 X19800 Y0 I9900 J0\nG01 X-9900 Y0\nM02\n"
    );
    check("check hole.iso again.3b", 0, "2 files checked");
}

/// A drawing that is made is opened and printed by LibreCAD. Skipped where that is not installed.
#[test]
fn what_is_drawn_is_opened_by_librecad() {
    let folder = tempfile::tempdir().unwrap();
    // Asked for its version it opens a window and waits.
    let is_installed = std::env::var_os("PATH").is_some_and(|path| {
        std::env::split_paths(&path).any(|folder| folder.join("librecad").is_file())
    });
    if !is_installed {
        eprintln!("skipped: LibreCAD is not installed");
        return;
    }
    std::fs::write(
        folder.path().join("hole.3b"),
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n",
    )
    .unwrap();
    let (code, _, stderr) = wedm(folder.path(), "convert hole.3b -o hole.dxf");
    assert_eq!(code, 0, "{stderr}");
    let printed = Command::new("timeout")
        .args(["60", "librecad", "dxf2pdf", "hole.dxf"])
        .current_dir(folder.path())
        .env("QT_QPA_PLATFORM", "offscreen")
        .env("HOME", folder.path())
        .stdin(std::process::Stdio::null())
        .output()
        .unwrap();
    let pdf = std::fs::read(folder.path().join("hole.pdf")).unwrap_or_default();
    assert!(
        pdf.starts_with(b"%PDF") && pdf.len() > 800,
        "{}",
        String::from_utf8_lossy(&printed.stderr)
    );
    // The sheet is A4 on its long side, 297 by 210 mm in points of 1/72 inch, not a few millimetres.
    let text = String::from_utf8_lossy(&pdf);
    let sheet = text
        .split("/MediaBox [")
        .nth(1)
        .and_then(|rest| rest.split(']').next())
        .unwrap_or_default();
    let lengths: Vec<f64> = sheet
        .split_whitespace()
        .filter_map(|length| length.parse().ok())
        .collect();
    assert!(
        matches!(lengths[..], [_, _, width, height] if (width - 842.0).abs() < 3.0 && (height - 595.0).abs() < 3.0),
        "{sheet}"
    );
}

/// An interpreter that has ezdxf: that of the environment which `tests/run` and the benchmark of reading use, else the machine's own.
fn python_with_ezdxf() -> Option<PathBuf> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/ezdxf/bin/python");
    let has_it = |python: &PathBuf| {
        Command::new(python)
            .args(["-c", "import ezdxf"])
            .output()
            .is_ok_and(|output| output.status.success())
    };
    [own, PathBuf::from("python3")].into_iter().find(has_it)
}

/// A drawing that is made is read by another program without a fault. Skipped where no Python has ezdxf.
#[test]
fn what_is_drawn_passes_the_audit_of_ezdxf() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("hole.3b"),
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n",
    )
    .unwrap();
    let Some(python) = python_with_ezdxf() else {
        assert!(
            std::env::var_os("CI").is_none(),
            "no Python has ezdxf: `tests/run tests` installs it into target/ezdxf"
        );
        eprintln!("skipped: no Python has ezdxf; `tests/run tests` installs it into target/ezdxf");
        return;
    };
    let (code, _, stderr) = wedm(folder.path(), "convert hole.3b -o hole.dxf");
    assert_eq!(code, 0, "{stderr}");
    let script = "
import ezdxf, math, sys
document = ezdxf.readfile(sys.argv[1])
auditor = document.audit()
print(document.dxfversion, len(auditor.errors), len(auditor.fixes))
for entity in document.modelspace():
    if entity.dxftype() == 'LWPOLYLINE':
        points = entity.get_points('xyb')
        print('LWPOLYLINE', entity.closed, ' '.join('%.6f,%.6f,%.9f' % tuple(point) for point in points))
    else:
        print(entity.dxftype(), entity.dxf.layer)
";
    let output = Command::new(python)
        .args(["-c", script])
        .arg(folder.path().join("hole.dxf"))
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(
        text,
        "AC1015 0 0\nLINE LEAD\nLWPOLYLINE True 9.900000,0.000000,1.000000000 -9.900000,0.000000,1.000000000\nLINE LEAD\n",
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
