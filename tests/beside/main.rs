//! Programs that wedm writes follow the drawings that they are of, every block of them; of those with one wrong block just that one is named.

mod unknown;

use proptest::prelude::*;
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;
use wedm::beside::{Drawn, Traced, compare};
use wedm::document::{Document, Source};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Role, Unit, Vertex};
use wedm::finding::Severity;
use wedm::geometry::Point;
use wedm::job::{self, Wanted};
use wedm::program::{self, Format, Language};
use wedm::settings::{Effective, from_toml};

/// A contour: vertices `[x, y, bulge]`, or a circle.
#[derive(Clone, Debug)]
enum Shape {
    Polyline(Vec<[f64; 3]>),
    Open(Vec<[f64; 3]>),
    Circle([f64; 2], f64),
}

/// A drawing, the settings that hold for it, and the format of its program.
#[derive(Clone, Debug)]
struct Case {
    shapes: Vec<(Shape, Role)>,
    settings: String,
    format: Format,
}

fn settings_of(text: &str) -> Arc<Effective> {
    let (settings, errors) = from_toml(text);
    assert!(errors.is_empty(), "{errors:?}\n{text}");
    Arc::new(Effective::of(&settings))
}

fn document(shapes: &[(Shape, Role)], settings: &Arc<Effective>) -> Document {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for (index, (shape, role)) in shapes.iter().enumerate() {
        let (kind, geometry) = match shape {
            Shape::Polyline(vertices) | Shape::Open(vertices) => (
                Kind::LightPolyline,
                Geometry::Polyline {
                    closed: matches!(shape, Shape::Polyline(_)),
                    vertices: vertices
                        .iter()
                        .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
                        .collect(),
                },
            ),
            Shape::Circle([x, y], radius) => (
                Kind::Circle,
                Geometry::Circle {
                    center: Point::new(*x, *y),
                    radius: *radius,
                },
            ),
        };
        drawing.push(Entity {
            handle: format!("{:X}", 42 + index).as_str().into(),
            layer: "0".into(),
            role: Some(*role),
            kind,
            geometry,
        });
    }
    Document::new(Source::Cad(Arc::new(drawing)), settings.clone())
}

/// The program of a drawing; `None` where none is made.
fn program_of(document: &Document, format: Format) -> Option<String> {
    program_of_some(document, format, None)
}

/// The same of the contours that hold some handles.
fn program_of_some(
    document: &Document,
    format: Format,
    handles: Option<Vec<String>>,
) -> Option<String> {
    let wanted = Wanted {
        format,
        handles: handles.as_deref(),
        layers: None,
        force: true,
    };
    let made = job::generate(&document.snapshot()?, Vec::new(), &wanted, &());
    made.ok().map(|made| made.program.text)
}

fn traced(text: &str, format: Format, settings: &Effective) -> Traced {
    let language = match format {
        Format::Iso | Format::Milling => Language::Iso,
        Format::ThreeB | Format::FourB => Language::ThreeB,
    };
    Traced::of(&program::Document::read(language, text.into(), settings))
}

/// Where the numbers of a block stand that are lengths, those behind it in its line among them.
fn lengths(text: &str, block: &Range<usize>) -> Vec<Range<usize>> {
    let line_end = text[block.end..]
        .find('\n')
        .map_or(text.len(), |at| block.end + at);
    let bytes = text.as_bytes();
    let is_number =
        |at: usize| at < line_end && (bytes[at].is_ascii_digit() || b"+-.".contains(&bytes[at]));
    let (mut found, mut letter, mut at) = (Vec::new(), b' ', block.start);
    while at < line_end {
        let end = (at..=line_end).find(|at| !is_number(*at)).unwrap();
        if end == at {
            let is_space = bytes[at].is_ascii_whitespace();
            letter = if is_space { letter } else { bytes[at] };
            at += 1;
            continue;
        }
        let is_of_3b = text[block.start..].trim_start().starts_with(['B', 'N']);
        let letters: &[u8] = if is_of_3b { b"B;," } else { b"XYIJR" };
        if letters.contains(&letter) {
            found.push(at..end);
        }
        at = end;
    }
    found
}

/// The text with one of its numbers changed by so many µm; `None` where it has no such sign.
fn with_number(text: &str, number: &Range<usize>, by: i64) -> Option<String> {
    let own = &text[number.clone()];
    let new = match own.split_once('.') {
        Some((_, places)) => {
            let value = own.parse::<f64>().ok()? + by as f64 / 1e3;
            format!("{value:.*}", places.len())
        }
        None => {
            let value = own.parse::<i64>().ok()? + by;
            let is_absolute = text[..number.start].trim_end().ends_with('B');
            (!is_absolute || value >= 0).then_some(value.to_string())?
        }
    };
    let mut text = text.to_owned();
    text.replace_range(number.clone(), &new);
    Some(text)
}

/// The text with one block changed by so many µm in X or Y, with what follows from that; `None` where it has none that is large enough.
fn changed(text: &str, block: &Range<usize>, by: i64, axis: usize) -> Option<String> {
    let own = &text[block.clone()];
    let new = if own.trim_start().starts_with(['B', 'b']) {
        let parts: Vec<&str> = own.split(['B', 'b']).map(str::trim).collect();
        let digits = |text: &str| {
            text.chars()
                .take_while(char::is_ascii_digit)
                .collect::<String>()
        };
        let [x, y, j] = [1, 2, 3].map(|index| digits(parts[index]).parse::<i64>().unwrap());
        let rest: String = parts[3..].join("B")[digits(parts[3]).len()..].trim().into();
        match rest.split_once('L') {
            Some((_, quadrant)) => {
                let mut at = [x, y];
                // One that is along an axis has no sign across it, and short ones would be others altogether.
                if at[axis] < 20 {
                    return None;
                }
                at[axis] += by;
                let [x, y] = at;
                let counted = if x > y { 'X' } else { 'Y' };
                format!("B{x}B{y}B{}G{counted}L{quadrant}", x.max(y))
            }
            None => {
                let radius = (x as f64).hypot(y as f64);
                if j < 60 || (j as f64 - 4.0 * radius).abs() < 10.0 {
                    return None;
                }
                format!("B{x}B{y}B{}{rest}", j + by)
            }
        }
    } else {
        let letter = ['X', 'Y'][axis];
        let at = own.find(letter)? + 1;
        let number: String = own[at..]
            .chars()
            .take_while(|letter| letter.is_ascii_digit() || "+-.".contains(*letter))
            .collect();
        let new = match number.parse::<i64>() {
            Ok(whole) => (whole + by).to_string(),
            Err(_) => format!("{:.3}", number.parse::<f64>().ok()? + by as f64 / 1e3),
        };
        format!("{}{new}{}", &own[..at], &own[at + number.len()..])
    };
    let mut text = text.to_owned();
    text.replace_range(block.clone(), &new);
    Some(text)
}

fn shape() -> impl Strategy<Value = Vec<(Shape, Role)>> {
    let outer = (
        4usize..12,
        prop::collection::vec(
            (15.0..30.0f64, -0.35..0.35f64, 0.0..0.8f64, prop::bool::ANY),
            12,
        ),
    )
        .prop_map(|(count, values)| {
            let vertex = |index: usize| {
                let (radius, bulge, aside, is_arc) = values[index];
                let angle = (index as f64 + aside) / count as f64 * TAU;
                // Drawn on no grid.
                [
                    angle.cos() * radius,
                    angle.sin() * radius,
                    if is_arc { bulge } else { 0.0 },
                ]
            };
            Shape::Polyline((0..count).map(vertex).collect())
        });
    let circle =
        (2.0..4.0f64, -3.0..3.0f64).prop_map(|(radius, x)| Shape::Circle([x, 4.0], radius));
    let slot = (3.0..8.0f64, 1.0..2.0f64, -3.0..3.0f64).prop_map(|(length, radius, x)| {
        Shape::Polyline(vec![
            [x - length / 2.0, -6.0 - radius, 0.0],
            [x + length / 2.0, -6.0 - radius, 1.0],
            [x + length / 2.0, -6.0 + radius, 0.0],
            [x - length / 2.0, -6.0 + radius, 1.0],
        ])
    });
    (outer, prop::option::of(circle), prop::option::of(slot)).prop_map(|(outer, circle, slot)| {
        let mut shapes = vec![(outer, Role::Punch)];
        shapes.extend(circle.map(|shape| (shape, Role::Opening)));
        shapes.extend(slot.map(|shape| (shape, Role::Opening)));
        shapes
    })
}

fn case() -> impl Strategy<Value = Case> {
    let of = |words: &[&'static str]| prop::sample::select(words.to_vec());
    let corrections = prop::sample::select(vec![
        "correction = 0.1",
        "correction = 0.155",
        "[passes]\ncorrections = [0.2159, 0.1626, 0.1473]",
        "[passes]\ncorrections = [0.2, 0.15]\nsequence = \"one-way\"",
        "[passes]\ncorrections = [0.215, 0.17, 0.14]\nskim-corner = \"constant-stock\"",
    ]);
    let keys = (
        of(&["", "tab = 2.5"]),
        of(&[
            "direction = \"ccw\"",
            "direction = \"cw\"",
            "direction = \"as-drawn\"",
        ]),
        of(&["", "", "corner = \"intersection\""]),
        of(&["layout = \"compact\"", "layout = \"checking\""]),
        of(&["", "closing-overlap = 1.5"]),
        of(&["", "lead-in = 1.7"]),
        of(&["", "profile = \"fast-wire\"", "profile = \"robofil\""]),
        of(&["", "compensation = \"controller\""]),
    );
    let formats = prop::sample::select(vec![
        Format::ThreeB,
        Format::Iso,
        Format::FourB,
        Format::ThreeB,
    ]);
    (shape(), corrections, keys, formats).prop_map(|(shapes, corrections, keys, format)| {
        let (tab, direction, corner, layout, overlap, lead, profile, compensation) = keys;
        let compensation = if format == Format::Iso {
            compensation
        } else {
            ""
        };
        let lines = [
            tab,
            direction,
            corner,
            layout,
            overlap,
            lead,
            profile,
            compensation,
        ];
        Case {
            shapes,
            settings: format!("{corrections}\n[program]\n{}\n", lines.join("\n")),
            format,
        }
    })
}

/// The line of a byte, from 0.
fn line_of(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count()
}

/// What is wrong with what is said of a case, by one block changed.
fn judge(case: &Case, picks: &[(f64, usize, bool)]) -> Result<(), String> {
    let settings = settings_of(&case.settings);
    let document = document(&case.shapes, &settings);
    let Some(text) = program_of(&document, case.format) else {
        return Ok(());
    };
    let snapshot = document.snapshot().unwrap();
    let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
    let whole = compare(&drawn, &traced(&text, case.format, &settings));
    let Some(whole) = whole else {
        return Err(format!("nothing is alike\n{text}"));
    };
    if !whole.differences.is_empty() {
        return Err(format!("invented: {:?}\n{text}", whole.differences));
    }
    for &(share, axis, is_more) in picks {
        let block = &whole.follows[(share * whole.follows.len() as f64) as usize];
        let by = if is_more { 3 } else { -3 };
        let numbers = lengths(&text, block);
        let number = &numbers[(share * 7919.0) as usize % numbers.len()];
        let both = [
            changed(&text, block, by, axis),
            with_number(&text, number, by),
        ];
        for wrong in both.into_iter().flatten() {
            let found = compare(&drawn, &traced(&wrong, case.format, &settings));
            let lines = found.iter().flat_map(|found| &found.differences);
            let lines: Vec<usize> = lines.map(|found| found.line).collect();
            let line = line_of(&text, block.start);
            if lines != [line] {
                let found = found.map(|found| found.differences);
                return Err(format!(
                    "line {} changed, told: {found:?}\n{wrong}",
                    line + 1
                ));
            }
        }
    }
    Ok(())
}

/// Many programs and one changed block in each, the same ones at every run: nothing is said of those that are unchanged, and of a change
/// just its own line. `WEDM_CASES=500 cargo test --test beside -- --nocapture` tells of each that is not so, `WEDM_CASE=22` of one alone.
#[test]
fn one_changed_block_is_named_and_no_other() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let count = std::env::var("WEDM_CASES").map_or(40, |count| count.parse().unwrap());
    let mut runner = TestRunner::deterministic();
    let pick = (0.0..1.0f64, 0usize..2, prop::bool::ANY);
    let strategy = (case(), prop::collection::vec(pick, 4));
    let (mut invented, mut missed) = (0, 0);
    for number in 0..count {
        let (case, picks) = strategy.new_tree(&mut runner).unwrap().current();
        if std::env::var("WEDM_CASE").is_ok_and(|only| only != number.to_string()) {
            continue;
        }
        let Err(wrong) = judge(&case, &picks) else {
            continue;
        };
        let settings = case.settings.replace('\n', " ");
        println!(
            "==== case {number} {:?} {settings}\n{:?}\n{wrong}",
            case.format, case.shapes
        );
        match wrong.starts_with("line ") {
            true => missed += 1,
            false => invented += 1,
        }
    }
    println!("{invented} invented and {missed} missed of {count}");
    assert_eq!((invented, missed), (0, 0));
}

/// What is asked of a drawing's own program: passes, sequence, tab, overlap, lead, control. Nothing is wrong in it, and it follows its
/// drawing.
#[test]
fn programs_of_passes_tabs_and_overlaps_have_nothing_wrong() {
    const PASSES: [&str; 5] = [
        "correction = 0.15",
        "[passes]\ncorrections = [0.215, 0.18, 0.15]",
        "[passes]\ncorrections = [0.215, 0.18, 0.15]\nsequence = \"one-way\"",
        "[passes]\ncorrections = [0.2, 0.15]",
        "[passes]\ncorrections = [0.2, 0.15]\nsequence = \"one-way\"",
    ];
    const FORMATS: [(Format, &str); 4] = [
        (Format::ThreeB, "path"),
        (Format::Iso, "path"),
        (Format::Iso, "controller"),
        (Format::FourB, "path"),
    ];
    let polyline = |vertices: &[[f64; 3]]| Shape::Polyline(vertices.to_vec());
    let shapes = [
        Shape::Circle([0.0, 0.0], 7.2),
        polyline(&[
            [0.0, 0.0, 0.0],
            [40.0, 0.0, 0.0],
            [40.0, 20.0, 0.0],
            [0.0, 20.0, 0.0],
        ]),
        polyline(&[
            [0.0, 0.0, 0.0],
            [30.0, 0.0, 0.0],
            [30.0, 10.0, 0.0],
            [10.0, 10.0, 0.0],
            [10.0, 30.0, 0.0],
            [0.0, 30.0, 0.0],
        ]),
        polyline(&[
            [2.0, 0.0, 0.0],
            [38.0, 0.0, 0.41421356],
            [40.0, 2.0, 0.0],
            [40.0, 20.0, -0.3],
            [0.0, 20.0, 0.0],
            [0.0, 2.0, 0.41421356],
        ]),
    ];
    // Every so manieth of all combinations.
    let each = std::env::var("WEDM_EACH").map_or(23, |each| each.parse().unwrap());
    let (mut made, mut wrong) = (0, Vec::new());
    for number in (0..2 * 4 * 5 * 4 * 2 * 2 * 3 * 2).step_by(each) {
        let mut left = number;
        let mut pick = |count: usize| {
            let own = left % count;
            left /= count;
            own
        };
        let role = [Role::Punch, Role::Opening][pick(2)];
        let shape = &shapes[pick(4)];
        let passes = PASSES[pick(5)];
        let (format, compensation) = FORMATS[pick(4)];
        let (tab, overlap) = ([0.0, 2.0][pick(2)], [0.0, 0.5][pick(2)]);
        let lead = ["perpendicular", "arc", "straight"][pick(3)];
        let corner = ["arc", "intersection"][pick(2)];
        let keys = format!(
            "{passes}\n[program]\ntab = {tab}\nclosing-overlap = {overlap}\nlead = \"{lead}\"\n\
             corner = \"{corner}\"\ncompensation = \"{compensation}\"\n"
        );
        let side = if role == Role::Punch {
            "punch"
        } else {
            "opening"
        };
        let settings = settings_of(&format!(
            "side = \"{side}\"\nwire-diameter = 0.2\ngap = 0.01\n{keys}"
        ));
        let document = document(&[(shape.clone(), role)], &settings);
        let Some(text) = program_of(&document, format) else {
            assert_eq!(format, Format::FourB, "{keys}");
            continue;
        };
        made += 1;
        let language = match format {
            Format::Iso | Format::Milling => Language::Iso,
            Format::ThreeB | Format::FourB => Language::ThreeB,
        };
        let read = program::Document::read(language, text.clone().into(), &settings);
        let (mut found, _) = read.findings(&settings, usize::MAX);
        found.retain(|finding| finding.severity <= Severity::Warning);
        let drawn = document.drawn().unwrap();
        let beside = compare(&drawn, &traced(&text, format, &settings));
        let beside = beside.map(|beside| beside.differences);
        if !found.is_empty() || beside != Some(Vec::new()) {
            let keys = keys.replace('\n', " ");
            wrong.push(format!(
                "{number} {format:?} {side} {keys}\n{found:?}\n{beside:?}\n{text}"
            ));
        }
    }
    println!("{made} programs");
    assert!(
        made > 0 && wrong.is_empty(),
        "{}\n{} of {made} programs",
        wrong.join("\n"),
        wrong.len()
    );
}

/// A drawing whose settings say a correction and no more, and what its program was written under beside that.
#[derive(Clone, Debug)]
struct Otherwise {
    case: Case,
    /// What holds for the drawing.
    now: String,
    /// The contours that are cut, in this order.
    handles: Option<Vec<String>>,
}

/// An open contour that the wire runs beside.
fn open() -> impl Strategy<Value = Vec<(Shape, Role)>> {
    let vertex = (0.0..4.0f64, 0.0..6.0f64, -0.3..0.3f64, prop::bool::ANY);
    let vertices = prop::collection::vec(vertex, 3..7);
    (vertices, prop::bool::ANY).prop_map(|(vertices, is_left)| {
        let at = |(index, (x, y, bulge, is_arc)): (usize, (f64, f64, f64, bool))| {
            let bulge = if is_arc { bulge } else { 0.0 };
            [index as f64 * 8.0 + x, y, bulge]
        };
        let vertices = vertices.into_iter().enumerate().map(at).collect();
        let role = if is_left { Role::Left } else { Role::Right };
        vec![(Shape::Open(vertices), role)]
    })
}

fn otherwise() -> impl Strategy<Value = Otherwise> {
    let of = |words: &[&'static str]| prop::sample::select(words.to_vec());
    let keys = (
        of(&["", "", "tab = 2.5", "tab = 1.2"]),
        of(&["", "", "direction = \"cw\"", "direction = \"as-drawn\""]),
        of(&["", "", "", "corner = \"intersection\""]),
        of(&["", "layout = \"checking\""]),
        of(&["", "", "", "closing-overlap = 1.5"]),
        of(&[
            "",
            "",
            "lead-in = 1.7",
            "lead = \"straight\"",
            "lead = \"arc\"",
        ]),
        of(&["", "", "order = \"nearest\"", "order = \"as-drawn\""]),
        of(&["", "", "compensation = \"controller\""]),
    );
    let corrections = prop::sample::select(vec![
        "correction = 0.1",
        "correction = 0.1",
        "correction = 0.137",
        "[passes]\ncorrections = [0.2, 0.15]",
        "[passes]\ncorrections = [0.2159, 0.1626, 0.1473, 0.1346]",
        "[passes]\ncorrections = [0.2, 0.16, 0.13]\nsequence = \"one-way\"",
    ]);
    let formats = prop::sample::select(vec![Format::ThreeB, Format::Iso, Format::FourB]);
    let profile = of(&["", "profile = \"fast-wire\"", "profile = \"robofil\""]);
    let handles = prop::option::of((0usize..3, prop::bool::ANY));
    let shapes = prop_oneof![5 => shape(), 1 => open()];
    (shapes, corrections, keys, formats, profile, handles).prop_map(
        |(shapes, corrections, keys, format, profile, handles)| {
            let (tab, direction, corner, layout, overlap, lead, order, compensation) = keys;
            let compensation = if format == Format::Iso {
                compensation
            } else {
                ""
            };
            let keys = [
                profile,
                tab,
                direction,
                corner,
                layout,
                overlap,
                lead,
                order,
                compensation,
            ];
            let handles = handles.map(|(first, two)| {
                let of = |index: usize| format!("{:X}", 42 + index % shapes.len());
                let mut all = vec![of(first)];
                all.extend((two && shapes.len() > 1).then(|| of(first + 1)));
                all
            });
            Otherwise {
                now: format!("correction = 0.1\n[program]\n{profile}\n"),
                case: Case {
                    shapes,
                    settings: format!("{corrections}\n[program]\n{}\n", keys.join("\n")),
                    format,
                },
                handles,
            }
        },
    )
}

/// What is wrong with what is said of one program, unchanged and with a change of each kind.
fn judge_otherwise(of: &Otherwise, picks: &[(f64, usize, bool)]) -> Vec<(&'static str, String)> {
    let Otherwise { case, now, handles } = of;
    let mut wrong: Vec<(&'static str, String)> = Vec::new();
    let [written, now] = [&case.settings, now].map(|text| settings_of(text));
    let made = document(&case.shapes, &written);
    let Some(text) = program_of_some(&made, case.format, handles.clone()) else {
        return wrong;
    };
    let drawn_of = |shapes: &[(Shape, Role)]| {
        let snapshot = document(shapes, &now).snapshot().unwrap();
        Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings)
    };
    let drawn = drawn_of(&case.shapes);
    let told = |drawn: &Drawn, text: &str| {
        compare(drawn, &traced(text, case.format, &now)).map(|found| found.differences)
    };
    let Some(whole) = compare(&drawn, &traced(&text, case.format, &now)) else {
        return vec![("nothing", format!("nothing is alike\n{text}"))];
    };
    if !whole.differences.is_empty() {
        return vec![("invented", format!("{:?}\n{text}", whole.differences))];
    }
    let lines: Vec<&str> = text.lines().collect();
    let end = if text.contains("\r\n") { "\r\n" } else { "\n" };
    for &(share, _, is_more) in picks {
        let block = &whole.follows[(share * whole.follows.len() as f64) as usize];
        let line = line_of(&text, block.start);
        let mut expect =
            |kind, wrong_text: String, drawn: &Drawn, lines: Range<usize>, most: usize| {
                let found = told(drawn, &wrong_text);
                let at: Vec<usize> = found.iter().flatten().map(|found| found.line).collect();
                if at.is_empty() || at.len() > most || at.iter().any(|at| !lines.contains(at)) {
                    let kind = if at.is_empty() { "silent" } else { kind };
                    wrong.push((kind, format!("line {}: {found:?}\n{wrong_text}", line + 1)));
                }
            };
        let numbers = lengths(&text, block);
        let number = &numbers[(share * 7919.0) as usize % numbers.len()];
        if let Some(text) = with_number(&text, number, if is_more { 3 } else { -3 }) {
            expect("number", text, &drawn, line..line + 1, 1);
        }
        let with = |change: &dyn Fn(&mut Vec<&str>)| {
            let mut lines = lines.clone();
            change(&mut lines);
            lines.join(end) + end
        };
        let next = lines.get(line + 1).copied().unwrap_or_default();
        let is_block = |line: &str| line.contains(['B', 'X']) && !line.starts_with([';', '%']);
        if is_block(next) && next != lines[line] {
            let text = with(&|lines| lines.swap(line, line + 1));
            expect("exchanged", text, &drawn, line..line + 2, 2);
        }
        let text = with(&|lines| {
            lines.remove(line);
        });
        expect("lost", text, &drawn, line.saturating_sub(1)..line + 1, 1);
        let text = with(&|lines| lines.insert(line, lines[line]));
        expect("doubled", text, &drawn, line..line + 2, 1);
    }
    // A vertex of the first contour, where that is cut.
    if handles
        .as_ref()
        .is_none_or(|handles| handles.iter().any(|handle| handle == "2A"))
    {
        let mut shapes = case.shapes.clone();
        let mut moved = 0;
        if let Shape::Polyline(vertices) | Shape::Open(vertices) = &mut shapes[0].0 {
            moved = (picks[0].0 * vertices.len() as f64) as usize;
            vertices[moved][0] += 0.003;
        }
        let found = told(&drawn_of(&shapes), &text).unwrap_or_default();
        // Once in each pass.
        if !(1..=written.corrections.len()).contains(&found.len()) {
            wrong.push(("drawing", format!("vertex {moved}: {found:?}\n{text}")));
        }
    }
    wrong
}

/// Programs of which the drawing's settings do not know how they were written: nothing is said of those that are unchanged, of a change
/// just its own line. `WEDM_CASES=500 cargo test --test beside otherwise -- --nocapture` tells of each that is not so.
#[test]
fn programs_that_were_written_otherwise_are_known() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let count = std::env::var("WEDM_CASES").map_or(12, |count| count.parse().unwrap());
    let mut runner = TestRunner::deterministic();
    let pick = (0.0..1.0f64, 0usize..2, prop::bool::ANY);
    let strategy = (otherwise(), prop::collection::vec(pick, 2));
    let mut counts: std::collections::BTreeMap<&str, usize> = Default::default();
    for number in 0..count {
        let (of, picks) = strategy.new_tree(&mut runner).unwrap().current();
        if std::env::var("WEDM_CASE").is_ok_and(|only| only != number.to_string()) {
            continue;
        }
        for (kind, wrong) in judge_otherwise(&of, &picks) {
            let settings = of.case.settings.replace('\n', " ");
            println!(
                "==== {kind} case {number} {:?} {settings} {:?}\n{:?}\n{wrong}",
                of.case.format, of.handles, of.case.shapes
            );
            *counts.entry(kind).or_default() += 1;
        }
    }
    println!("wrong of {count}: {counts:?}");
    // Several passes under the control's own correction say too little of how they were written: then nothing is told of a change, rather
    // than something of what nobody changed.
    let of = |kind: &str| counts.get(kind).copied().unwrap_or(0);
    let wrong: usize = counts.values().sum();
    let silent = of("silent") + of("nothing");
    assert_eq!((of("invented"), of("number")), (0, 0), "{counts:?}");
    assert!(silent <= count, "{counts:?}");
    assert!(2 * (wrong - silent) <= count, "{counts:?}");
}

/// Where a guess has another tab than the program, it parts from it before the stop and behind it: that says nothing of the program.
#[test]
fn an_unchanged_program_with_a_tab_that_the_settings_do_not_know_has_nothing_said() {
    let written = "correction = 0.137\n[program]\ntab = 2.5\nlead = \"straight\"\n";
    for teeth in [7, 9, 13] {
        let vertex = |index: usize| {
            let (share, high, bulge) = [
                (0.0, 0.0, 0.0),
                (0.15, 1.0, -0.4),
                (0.5, 1.0, 0.0),
                (0.65, 0.0, 0.4),
            ][index % 4];
            let angle = -((index / 4) as f64 + share + 0.3) / teeth as f64 * TAU;
            let radius = 2.0 * teeth as f64 + high;
            [radius * angle.cos(), radius * angle.sin(), bulge]
        };
        let gear = [(
            Shape::Polyline((0..4 * teeth).map(vertex).collect()),
            Role::Punch,
        )];
        let text = program_of(&document(&gear, &settings_of(written)), Format::ThreeB).unwrap();
        let settings = settings_of("correction = 0.1\n");
        let snapshot = document(&gear, &settings).snapshot().unwrap();
        let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        let found = compare(&drawn, &traced(&text, Format::ThreeB, &settings));
        let said = found.map_or(Vec::new(), |found| found.differences);
        assert_eq!(said, [], "{teeth} teeth\n{text}");
    }
}

/// A ring of short arcs and chords, drawn on no grid, the same one at every run.
fn ring(count: usize) -> Vec<[f64; 3]> {
    let mut seed = 20_261_u64;
    let mut random = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let radius = count as f64 * 0.04;
    let vertex = |index: usize| {
        let angle = (index as f64 + 0.6 * random()) / count as f64 * TAU;
        let away = radius + 0.05 * random();
        let bulge = match index % 3 {
            0 => 0.0,
            _ => 0.02 + 0.1 * random(),
        };
        [angle.cos() * away, angle.sin() * away, bulge]
    };
    (0..count).map(vertex).collect()
}

/// Where a machine that counts has drifted to behind thousands of arcs is no fault of any of them.
#[test]
fn long_programs_of_short_arcs_follow_their_drawing() {
    for (count, format, keys) in [
        (6_000, Format::ThreeB, "layout = \"compact\""),
        (
            1_500,
            Format::ThreeB,
            "layout = \"checking\"\ndirection = \"cw\"",
        ),
        (1_500, Format::Iso, "profile = \"fast-wire\""),
        (1_500, Format::Iso, "compensation = \"controller\""),
    ] {
        let settings = settings_of(&format!("correction = 0.1\n[program]\n{keys}\n"));
        let shapes = [(Shape::Polyline(ring(count)), Role::Punch)];
        let document = document(&shapes, &settings);
        let text = program_of(&document, format).unwrap();
        let snapshot = document.snapshot().unwrap();
        let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        let begin = std::time::Instant::now();
        let whole = compare(&drawn, &traced(&text, format, &settings)).unwrap();
        println!("{count} {format:?}: {:?}", begin.elapsed());
        assert_eq!(whole.differences, [], "{keys}");
        assert!(whole.follows.len() >= count);
        let block = &whole.follows[whole.follows.len() / 3];
        let wrong = [0, 1]
            .into_iter()
            .find_map(|axis| changed(&text, block, 3, axis));
        let Some(wrong) = wrong else { continue };
        let found = compare(&drawn, &traced(&wrong, format, &settings)).unwrap();
        let lines: Vec<usize> = found.differences.iter().map(|found| found.line).collect();
        assert_eq!(lines, [line_of(&text, block.start)], "{keys}");
    }
}

/// A plate, its lower right corner moved by so many mm.
fn plate(moved: f64) -> [(Shape, Role); 1] {
    let vertices = vec![
        [0.1234, 0.2345, 0.0],
        [20.3456 + moved, 0.4567, 0.0],
        [20.4567, 15.5678, 0.3],
        [10.1111, 18.2222, -0.2],
        [0.3333, 14.4444, 0.0],
    ];
    [(Shape::Polyline(vertices), Role::Punch)]
}

#[test]
fn exchanged_blocks_and_an_edited_drawing_are_named_once() {
    for (format, keys) in [
        (Format::ThreeB, "layout = \"compact\""),
        (Format::ThreeB, "layout = \"checking\""),
        (Format::Iso, "profile = \"fast-wire\""),
    ] {
        let settings = settings_of(&format!("correction = 0.1\n[program]\n{keys}\n"));
        let own = document(&plate(0.0), &settings);
        let text = program_of(&own, format).unwrap();
        let told = |of: &Document, text: &str| {
            let snapshot = of.snapshot().unwrap();
            let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
            let found = compare(&drawn, &traced(text, format, &settings));
            found.map(|found| found.differences)
        };
        assert_eq!(told(&own, &text), Some(vec![]), "{keys}");
        let edited = told(&document(&plate(0.003), &settings), &text).unwrap();
        let segments: Vec<usize> = edited
            .iter()
            .filter_map(|one| Some(one.segment?.1))
            .collect();
        assert!(matches!(segments[..], [0 | 1]), "{keys}: {edited:?}");
        // Two blocks of the contour, one for the other.
        let mut lines: Vec<&str> = text.lines().collect();
        let middle = lines.len() / 2;
        lines.swap(middle, middle + 1);
        let exchanged = told(&own, &(lines.join("\n") + "\n")).unwrap();
        assert!(
            exchanged
                .iter()
                .any(|one| (middle - 1..=middle + 1).contains(&one.line)),
            "{keys}: {exchanged:?}"
        );
    }
}

/// An ISO program in millimetres that counts from block to block, or whose arcs of less than a third of a turn say their radius.
fn in_other_words(text: &str, counts: bool, by_radius: bool) -> String {
    let number = |line: &str, letter: char| -> Option<f64> {
        let rest = &line[line.find(letter)? + 1..];
        let end = rest.find(' ').unwrap_or(rest.len());
        rest[..end].parse().ok()
    };
    let mut at = [0.0, 0.0];
    let mut lines: Vec<String> = Vec::new();
    for line in text.lines() {
        let (Some(x), Some(y)) = (number(line, 'X'), number(line, 'Y')) else {
            lines.push(line.into());
            continue;
        };
        let before = std::mem::replace(&mut at, [x, y]);
        if line.starts_with("G92") {
            lines.push(line.into());
            lines.extend(counts.then(|| "G91".into()));
            continue;
        }
        let to = if counts {
            [x - before[0], y - before[1]]
        } else {
            at
        };
        let mut own = format!("{} X{:.3} Y{:.3}", &line[..3], to[0], to[1]);
        if let (Some(i), Some(j)) = (number(line, 'I'), number(line, 'J')) {
            let (radius, chord) = (i.hypot(j), (x - before[0]).hypot(y - before[1]));
            let is_left = line.starts_with("G03");
            // The centre lies to the left of the chord where less than half of the turn is gone.
            let side = (x - before[0]) * j - (y - before[1]) * i;
            let is_short = (side > 0.0) == is_left && chord < 1.7 * radius && chord > 0.5 * radius;
            own += &match by_radius && is_short {
                true => format!(" R{radius:.3}"),
                false => format!(" I{i:.3} J{j:.3}"),
            };
        }
        lines.push(own);
    }
    lines.join("\n") + "\n"
}

/// Each number of each line of programs in every dialect, changed alone: told at that line and nowhere else. So it is in programs that
/// say the same in other words, and in those that were written with other settings than the drawing has now.
#[test]
fn every_number_is_held_against_the_drawing() {
    let shapes = [
        plate(0.0)[0].clone(),
        (Shape::Circle([8.0, 8.0], 2.7), Role::Opening),
    ];
    let own = "correction = 0.12\n";
    let rows = [
        (Format::ThreeB, own, own),
        (
            Format::ThreeB,
            "correction = 0.12\n[program]\nlayout = \"checking\"\n",
            own,
        ),
        (Format::FourB, own, own),
        (Format::Iso, own, own),
        (
            Format::Iso,
            "correction = 0.12\n[program]\nprofile = \"fast-wire\"\n",
            "correction = 0.12\n[program]\nprofile = \"fast-wire\"\n",
        ),
        (
            Format::Iso,
            "correction = 0.12\n[program]\nprofile = \"robofil\"\n",
            "correction = 0.12\n[program]\nprofile = \"robofil\"\n",
        ),
        (
            Format::Iso,
            "correction = 0.12\n[program]\ntab = 2.0\n",
            "correction = 0.12\n[program]\ntab = 2.0\n",
        ),
        (
            Format::ThreeB,
            "correction = 0.12\n[program]\ntab = 1.79\nclosing-overlap = 0.4\n",
            "correction = 0.12\n[program]\ntab = 1.79\nclosing-overlap = 0.4\n",
        ),
        (
            Format::Iso,
            "correction = 0.12\n[program]\ncompensation = \"controller\"\n",
            own,
        ),
        (Format::ThreeB, "correction = 0.15\n", own),
        (
            Format::FourB,
            "correction = 0.15\n[program]\ndirection = \"cw\"\n",
            own,
        ),
        (
            Format::ThreeB,
            "correction = 0.137\n[program]\ncorner = \"intersection\"\n",
            own,
        ),
        (
            Format::Iso,
            "correction = 0.137\n[program]\ndirection = \"cw\"\nlead-in = 2\n",
            own,
        ),
    ];
    for (format, written, now) in rows {
        let is_own = written == now;
        let [written, now] = [written, now].map(settings_of);
        let text = program_of(&document(&shapes, &written), format).unwrap();
        let own = document(&shapes, &now);
        let snapshot = own.snapshot().unwrap();
        let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        let mut texts = vec![text.clone()];
        // Our own words of other controls count otherwise.
        if format == Format::Iso && text.contains("G21") {
            texts.extend(
                [(true, false), (false, true), (true, true)]
                    .into_iter()
                    // Radii that are rounded, counted from block to block, say too little of settings that are not known.
                    .filter(|both| is_own || *both != (true, true))
                    .map(|(counts, by_radius)| in_other_words(&text, counts, by_radius)),
            );
        }
        for (nth, text) in texts.iter().enumerate() {
            let told = |text: &str| -> Vec<usize> {
                let found = compare(&drawn, &traced(text, format, &now));
                found
                    .unwrap_or_else(|| panic!("nothing is alike\n{text}"))
                    .differences
                    .iter()
                    .map(|found| found.line)
                    .collect()
            };
            assert_eq!(told(text), [0; 0], "{text}");
            let (mut at, mut count) = (0, 0);
            // Other settings are found out by trying, which takes its time.
            let step = if is_own && nth == 0 { 1 } else { 9 };
            for (line, own) in text.split_inclusive('\n').enumerate() {
                let range = at..at + own.trim_end().len();
                at += own.len();
                let is_block = own.contains('B') || own.contains("X");
                // A program that lies elsewhere says so where it begins.
                if !is_block || own.starts_with(';') || nth > 0 && own.starts_with("G92") {
                    continue;
                }
                for number in lengths(
                    text,
                    &(range.start
                        ..range
                            .end
                            .min(range.start + own.find(';').unwrap_or(own.len()))),
                ) {
                    for by in [3, -3] {
                        let Some(wrong) = with_number(text, &number, by) else {
                            continue;
                        };
                        count += 1;
                        if count % step != 0 {
                            continue;
                        }
                        assert_eq!(told(&wrong), [line], "line {} of\n{wrong}", line + 1);
                    }
                }
            }
            assert!(count > 50);
        }
    }
}

/// A circle alone says nothing of the correction, nor of the way in: under settings that do not know them its program is as it should be.
#[test]
fn an_unchanged_program_of_a_circle_has_nothing_said() {
    for role in [Role::Punch, Role::Opening] {
        for (correction, lead, at) in [
            (0.12, 3.0, 0.0),
            (0.09, 2.0, 5.0),
            (0.155, 4.0, -3.5),
            (0.2, 3.0, 12.345),
        ] {
            for format in [Format::ThreeB, Format::Iso] {
                let shapes = [(Shape::Circle([at, 0.0], 10.0), role)];
                let written = settings_of(&format!(
                    "correction = {correction}\n[program]\nlead-in = {lead}\n"
                ));
                let text = program_of(&document(&shapes, &written), format).unwrap();
                let settings = settings_of("");
                let drawn = document(&shapes, &settings).drawn().unwrap();
                let found = compare(&drawn, &traced(&text, format, &settings));
                let said = found.map_or(Vec::new(), |found| found.differences);
                assert_eq!(said, [], "{correction} {lead} {role:?}\n{text}");
            }
        }
    }
}

/// The wire of a program is threaded where it is, whatever the settings say since: the contour is entered, and closes, elsewhere.
#[test]
fn a_thread_hole_that_was_moved_since_is_no_fault_of_the_program() {
    let (p, q) = (plate(0.0)[0].0.clone(), Shape::Circle([8.0, 8.0], 4.0));
    for (shape, role, places) in [
        (
            p.clone(),
            Role::Opening,
            [[8.0, 4.0], [9.0, 5.0], [8.1, 4.0]],
        ),
        (p, Role::Punch, [[8.0, -4.0], [9.0, -5.0], [8.1, -4.0]]),
        (q, Role::Opening, [[8.0, 8.0], [8.0, 9.0], [8.0, 8.1]]),
    ] {
        let under = |[x, y]: [f64; 2], keys: &str| {
            settings_of(&format!(
                "correction = 0.1\n[program]\nthread = [{x:?}, {y:?}]\n{keys}"
            ))
        };
        let shapes = [(shape, role)];
        for format in [Format::ThreeB, Format::Iso, Format::FourB] {
            for keys in ["", "tab = 2.0\n"] {
                let keys = if format == Format::FourB { "" } else { keys };
                let written = under(places[0], keys);
                let text = program_of(&document(&shapes, &written), format).unwrap();
                for place in places {
                    let settings = under(place, keys);
                    let drawn = document(&shapes, &settings).drawn().unwrap();
                    let found = compare(&drawn, &traced(&text, format, &settings));
                    let said = found.map_or(Vec::new(), |found| found.differences);
                    assert_eq!(said, [], "{keys} {format:?} {place:?}\n{text}");
                }
            }
        }
    }
}

/// The segments of a published example, a circle as the circle.
fn geometry_of(list: &serde_json::Value) -> Vec<Geometry> {
    let point = |value: &serde_json::Value| {
        Point::new(value[0].as_f64().expect("x"), value[1].as_f64().expect("y"))
    };
    let of = |value: &serde_json::Value| {
        let (start, end) = (&value["start"], &value["end"]);
        let center = || point(&value["center"]);
        match value["type"].as_str() {
            Some("line") => Geometry::Line {
                start: point(start),
                end: point(end),
            },
            Some("circle") => Geometry::Circle {
                center: center(),
                radius: value["radius"].as_f64().expect("a radius"),
            },
            _ if start == end => Geometry::Circle {
                center: center(),
                radius: (point(start) - center()).norm(),
            },
            _ => {
                let (from, to) = match value["dir"] == "ccw" {
                    true => (point(start), point(end)),
                    false => (point(end), point(start)),
                };
                let angle = |at: Point| (at.y - center().y).atan2(at.x - center().x);
                Geometry::Arc {
                    center: center(),
                    radius: (from - center()).norm(),
                    start_angle: angle(from),
                    end_angle: angle(to),
                }
            }
        }
    };
    list.as_array().into_iter().flatten().map(of).collect()
}

/// Programs that others have published follow the contours that they are of: where those are known, under their correction; else the path
/// of the wire. Of those of more than two blocks each that is 3 µm too long is named, and no other.
#[test]
fn a_published_program_follows_its_contours() {
    let examples: Vec<serde_json::Value> =
        serde_json::from_str(include_str!("../data/published_3b.json")).expect("examples");
    let mut named = 0;
    for example in &examples {
        let id = example["id"].as_str().expect("id");
        let nominal = geometry_of(&example["geometry"]["nominal_contour"]);
        let (geometry, settings) = match nominal.is_empty() {
            true => (
                geometry_of(&example["geometry"]["wire_path"]),
                "[program]\ncompensation = \"none\"\n".to_owned(),
            ),
            false => (nominal, format!("correction = {}\n", example["offset_mm"])),
        };
        let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
        for (index, geometry) in geometry.into_iter().enumerate() {
            let closed = matches!(geometry, Geometry::Circle { .. });
            drawing.push(Entity {
                handle: format!("{:X}", 42 + index).as_str().into(),
                layer: "0".into(),
                role: closed.then_some(Role::Opening),
                kind: Kind::Line,
                geometry,
            });
        }
        let settings = settings_of(&settings);
        let document = Document::new(Source::Cad(Arc::new(drawing)), settings.clone());
        let drawn = document.drawn().unwrap();
        let blocks: Vec<&str> = example["program"]
            .as_array()
            .expect("blocks")
            .iter()
            .filter_map(serde_json::Value::as_str)
            .collect();
        let told = |blocks: &[&str]| {
            let text = blocks.join("\n") + "\nDD\n";
            let found = compare(&drawn, &traced(&text, Format::ThreeB, &settings));
            found.map(|found| found.differences)
        };
        assert_eq!(told(&blocks), Some(Vec::new()), "{id}: {blocks:?}");
        if blocks.len() < 3 {
            continue;
        }
        for index in 0..blocks.len() {
            let text = blocks[index];
            let numbers = lengths(text, &(0..text.len()));
            // J says how far it goes, whatever X and Y are reduced to.
            let longer = numbers
                .last()
                .and_then(|number| with_number(text, number, 3));
            let Some(longer) = longer else {
                continue;
            };
            let mut wrong = blocks.clone();
            wrong[index] = &longer;
            let lines: Option<Vec<usize>> =
                told(&wrong).map(|found| found.iter().map(|found| found.line).collect());
            assert_eq!(lines, Some(vec![index]), "{id}: {wrong:?}");
            named += 1;
        }
    }
    assert!(examples.len() >= 30 && named >= 20, "{named}");
}
