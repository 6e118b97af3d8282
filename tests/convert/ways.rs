//! From a path through each language and back.

use super::*;
use crate::size::by_day;

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
    WirePath::along(thread_hole, segments)
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
}

proptest! {
    #![proptest_config(ProptestConfig { cases: by_day(64, 256), ..ProptestConfig::default() })]

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

/// Where the wire was taken to by hand, the next contour begins.
#[test]
fn a_place_that_is_stated_anew_behind_a_stop_is_kept() {
    let square = |x: i64| {
        let at = [[2, 0], [2, 5], [-2, 5], [-2, 0], [2, 0], [0, 0]];
        let line = |[a, b]: [i64; 2]| format!("G01 X{}. Y{b}.\n", a + x);
        at.map(line).concat()
    };
    let text = format!(
        "G92 X0 Y0\nG90\n{}M00\nG92 X30. Y0.\n{}M02\n",
        square(0),
        square(30)
    );
    let own = Effective::default();
    let cuts = convert::cuts(&read(Language::Iso, &text, &own));
    let holes = |cuts: &convert::Cuts| {
        let paths = cuts.paths();
        let at = paths.iter().map(|path| path.thread_hole / 1e3);
        at.map(|at| [at.x, at.y]).collect::<Vec<_>>()
    };
    assert_eq!(holes(&cuts), [[0.0, 0.0], [30.0, 0.0]]);
    for (layout, jumps) in [
        (Layout::Compact, "blocks"),
        (Layout::Checking, "blocks"),
        (Layout::Checking, "none"),
    ] {
        let settings = Effective {
            layout,
            ..settings(&format!("[program]\njumps = \"{jumps}\"\n"))
        };
        for (format, language) in [
            (Format::ThreeB, Language::ThreeB),
            (Format::Iso, Language::Iso),
        ] {
            let new = written(format, &cuts.paths(), 1e-3, &settings);
            let again = convert::cuts(&read(language, &new, &settings));
            assert_eq!(holes(&again), [[0.0, 0.0], [30.0, 0.0]], "{new}");
        }
    }
}

/// A stop that holds the part while its tab is cut is one in each language, and is read back as one.
#[test]
fn a_stop_before_a_tab_is_kept() {
    let square = |side: &str, lead: &str| {
        format!(
            "G92 X0 Y0\nG90\n{side}G01 X5. Y0.\nY5.\nX-5.\nY-5.\nX2.\nM00\nG01 X5.\nY0.\n{lead}X0.\nM02\n"
        )
    };
    let by_path = square("", "");
    let by_control = square("G41 D1\n", "G40\nG01 ");
    let own = Effective::default();
    let stops = |language: Language, text: &str| {
        let trace = read(language, text, &own).trace();
        let moves = |step: &&wedm::program::path::Step| step.moves();
        let before = trace.steps.iter().take_while(moves).count();
        let pauses = trace.steps.iter().filter(|step| !step.moves()).count();
        // The end counts as one, too.
        (before, pauses)
    };
    for (text, format, language) in [
        (&by_path, Format::ThreeB, Language::ThreeB),
        (&by_path, Format::Iso, Language::Iso),
        (&by_control, Format::Iso, Language::Iso),
        (&by_control, Format::FourB, Language::ThreeB),
    ] {
        let source = read(Language::Iso, text, &own);
        let cuts = convert::cuts(&source);
        assert_eq!(cuts.cuts.len(), 1, "{text}");
        let new = written(format, &cuts.paths(), 1e-3, &own);
        let (before, pauses) = stops(language, &new);
        assert_eq!(pauses, 2, "{new}");
        assert!(before >= 5, "{new}");
        let again = convert::cuts(&read(language, &new, &own));
        assert_eq!(again.cuts.len(), 1, "{new}");
        assert!(again.cuts[0].closed, "{new}");
        assert_eq!(again.paths().len(), 2, "{new}");
    }
}
