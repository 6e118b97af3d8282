//! What a wire path and its proved 3B program cost: `cargo bench --bench program`.

mod generated;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;
use wedm::compare::{Drawn, Traced, compare};
use wedm::drawing::{Contour, Drawing, Entity, Geometry, Outline, Role, Unit, Vertex};
use wedm::program::three_b::{self, Words};
use wedm::program::{self, Document, Format, Language, iso};
use wedm::settings::{Compensation, Effective, Layout, from_toml};
use wedm::toolpath::{WirePath, plan};

/// A wheel of `segments` segments, every other one an arc, each a tooth's flank or its rounded head and foot.
fn wheel(segments: usize) -> (Drawing, Outline) {
    wheel_of(segments, 0.4)
}

/// The same with other heads and feet.
fn wheel_of(segments: usize, rounded: f64) -> (Drawing, Outline) {
    let teeth = segments / 4;
    let radius = teeth as f64 * 0.4;
    let step = std::f64::consts::TAU / teeth as f64;
    let mut vertices = Vec::with_capacity(segments);
    for tooth in 0..teeth {
        for (share, height, bulge) in [
            (0.0, 0.0, 0.0),
            (0.15, 1.0, -rounded),
            (0.5, 1.0, 0.0),
            (0.65, 0.0, rounded),
        ] {
            let angle = -(tooth as f64 + share) * step;
            let at = radius + height;
            vertices.push(Vertex::new(at * angle.cos(), at * angle.sin(), bulge));
        }
    }
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let geometry = Geometry::Polyline {
        closed: true,
        vertices,
    };
    let id = drawing.push(Entity {
        handle: "2A".into(),
        layer: "0".into(),
        role: None,
        kind: wedm::drawing::Kind::LightPolyline,
        geometry,
    });
    let contour = Contour::new(&drawing, [(id, false)], true);
    let twice_area = contour.twice_area(&drawing);
    (
        drawing,
        Outline {
            contour,
            role: Role::Punch,
            twice_area,
        },
    )
}

fn settings() -> Effective {
    Effective {
        correction: 0.1,
        ..Effective::default()
    }
}

fn paths(segments: usize) -> Vec<WirePath> {
    let (drawing, outline) = wheel(segments);
    plan(&drawing, &[outline], &settings(), None).expect("the wire fits")
}

fn program(c: &mut Criterion) {
    const SEGMENTS: usize = 100_000;
    let mut group = c.benchmark_group("a contour of 100,000 segments");
    group.sample_size(10);
    group.throughput(Throughput::Elements(SEGMENTS as u64));
    let (drawing, outline) = wheel(SEGMENTS);
    let outlines = [outline];
    group.bench_function("wire path", |b| {
        b.iter(|| black_box(plan(&drawing, &outlines, &settings(), None)))
    });

    let paths = paths(SEGMENTS);
    let written = three_b::write(&paths, 1.0, &settings()).expect("a proved program");
    group.throughput(Throughput::Elements(written.blocks as u64));
    for layout in [Layout::Compact, Layout::Checking] {
        let settings = Effective {
            layout,
            ..settings()
        };
        group.bench_function(format!("3B, {layout:?}"), |b| {
            b.iter(|| black_box(three_b::write(&paths, 1.0, &settings)))
        });
    }
    group.throughput(Throughput::Bytes(written.text.len() as u64));
    group.bench_function("3B text read again", |b| {
        b.iter(|| black_box(three_b::read(written.text.as_bytes(), &Words::default())))
    });
    group.finish();
}

/// A program of about 10,000 blocks beside its drawing, by arcs and lines or by lines alone: the first look, which writes the drawing's own
/// program, and a digit that comes and goes in the program, to all that is found. The goal of both is 20 ms.
fn beside(c: &mut Criterion) {
    let settings = std::sync::Arc::new(settings());
    let mut group = c.benchmark_group("a program of 10,000 blocks beside its drawing");
    group.sample_size(20);
    for (shape, bulge, segments) in [("arcs", 0.4, 7_000), ("lines", 0.0, 6_600)] {
        let (drawing, outline) = wheel_of(segments, bulge);
        let (drawing, outlines) = (Arc::new(drawing), Arc::new(vec![outline]));
        for (name, language, format) in [
            ("3B", Language::ThreeB, Format::ThreeB),
            ("ISO", Language::Iso, Format::Iso),
            ("4B", Language::ThreeB, Format::FourB),
        ] {
            let of_format = Effective {
                compensation: match format {
                    Format::FourB => Compensation::Controller,
                    _ => Compensation::Path,
                },
                ..(*settings).clone()
            };
            let paths = plan(&drawing, &outlines, &of_format, None).expect("the wire fits");
            let written = format.write(&paths, 1.0, &settings, &mut |_, _| true);
            let text = written.expect("a proved program").text;
            let mut program = Document::read(language, text.clone().into(), &settings);
            println!("{name}, {shape}: {} blocks", program.trace().steps.len());
            group.bench_function(format!("{name}, {shape}: first look"), |b| {
                b.iter(|| {
                    let drawn = Drawn::of(&drawing, &outlines, &settings);
                    black_box(compare(&drawn, &Traced::of(&program)))
                })
            });
            let drawn = Drawn::of(&drawing, &outlines, &settings);
            // The last digit of a number in the middle.
            let middle = text.len() / 2;
            let at = middle + text[middle..].find('\n').unwrap_or(0) + 1;
            let at = at + text[at..].find(|c: char| "BX".contains(c)).unwrap_or(0) + 1;
            let digits = text[at..].find(|c: char| !"0123456789.-".contains(c));
            let at = at + digits.unwrap_or(1) - 1;
            let own = &text[at..at + 1];
            let other = if own == "3" { "6" } else { "3" };
            let mut is_own = true;
            group.bench_function(format!("{name}, {shape}: edit to findings"), |b| {
                b.iter(|| {
                    is_own = !is_own;
                    program.edit(at..at + 1, if is_own { own } else { other });
                    let told = compare(&drawn, &Traced::of(&program));
                    black_box((told, program.findings(&settings, 500)))
                })
            });
        }
    }
    group.finish();
}

/// A program of 200,000 blocks, about 5 MB, and what an editor asks of it; and a million blocks followed by the controller.
fn reading(c: &mut Criterion) {
    let settings = settings();
    let text = three_b::write(
        &paths(134_000),
        1.0,
        &Effective {
            layout: Layout::Aligned,
            ..settings.clone()
        },
    )
    .expect("a proved program")
    .text;
    let bytes = text.as_bytes();
    let blocks = text.lines().filter(|line| line.starts_with('B')).count();
    println!("the program has {blocks} blocks and {} bytes", bytes.len());
    let mut group = c.benchmark_group("a 3B program of 200,000 blocks");
    group.sample_size(20);
    group.throughput(Throughput::Bytes(bytes.len() as u64));
    group.bench_function("parse", |b| {
        b.iter(|| {
            let mut items = 0_usize;
            for line in text.lines() {
                three_b::read_line(line.as_bytes(), 1, &Words::default(), |_| items += 1);
            }
            black_box(items)
        })
    });
    group.bench_function("open with findings", |b| {
        b.iter(|| {
            let document = Document::read(Language::ThreeB, bytes.to_vec(), &settings);
            black_box(document.findings(&settings, 500))
        })
    });
    group.bench_function("trace", |b| {
        let document = Document::read(Language::ThreeB, bytes.to_vec(), &settings);
        b.iter(|| black_box(document.trace()))
    });
    // A digit in front of J in the middle of the file comes and goes: the contour is torn, and whole again.
    let mut document = Document::read(Language::ThreeB, bytes.to_vec(), &settings);
    let line = text[..text.len() / 2].rfind('\n').map_or(0, |at| at + 1);
    let at = line
        + text[line..]
            .rmatch_indices('B')
            .map(|(at, _)| at)
            .find(|at| line + at < line + 40)
            .unwrap_or(0)
        + 2;
    let mut is_in = false;
    group.bench_function("one character, edit to findings", |b| {
        b.iter(|| {
            if is_in {
                document.edit(at..at + 1, "");
            } else {
                document.edit(at..at, "1");
            }
            is_in = !is_in;
            black_box(document.findings(&settings, 500))
        })
    });
    group.finish();

    let mut group = c.benchmark_group("the controller");
    group.sample_size(10);
    let million = bytes.repeat(1_000_000_usize.div_ceil(blocks));
    let million: Vec<u8> = million
        .split(|&byte| byte == b'\n')
        .filter(|line| *line != b"DD")
        .flat_map(|line| [line, b"\n"].concat())
        .collect();
    group.throughput(Throughput::Elements(1_000_000));
    group.bench_function("1,000,000 blocks, text to every end point", |b| {
        b.iter(|| black_box(three_b::Document::read_with(million.clone(), &settings).trace()))
    });
    group.finish();
}

/// An ISO program of 200,000 blocks, absolute in mm, and one that counts from where the wire stands in µm; and what an editor asks of
/// them.
fn iso_programs(c: &mut Criterion) {
    for profile in ["generic", "fast-wire"] {
        let (set, _) = from_toml(&format!("[program]\nprofile = \"{profile}\"\n"));
        let settings = Effective {
            correction: 0.1,
            ..Effective::of(&set)
        };
        let paths = paths(134_000);
        let written = iso::write(&paths, 1.0, &settings).expect("a proved program");
        let text = written.text;
        println!(
            "the {profile} program has {} blocks and {} bytes",
            written.blocks,
            text.len()
        );
        let mut group = c.benchmark_group(format!("an ISO program of 200,000 blocks, {profile}"));
        group.sample_size(20);
        group.throughput(Throughput::Elements(written.blocks as u64));
        group.bench_function("write", |b| {
            b.iter(|| black_box(iso::write(&paths, 1.0, &settings)))
        });
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function("parse", |b| {
            b.iter(|| {
                let mut blocks = 0_usize;
                for line in text.lines() {
                    blocks +=
                        usize::from(iso::read_line(line.as_bytes(), 1, |_| {}).has_coordinates());
                }
                black_box(blocks)
            })
        });
        group.bench_function("open with findings", |b| {
            b.iter(|| {
                let document = Document::read(Language::Iso, text.clone().into_bytes(), &settings);
                black_box(document.findings(&settings, 500))
            })
        });
        let mut document = Document::read(Language::Iso, text.clone().into_bytes(), &settings);
        group.bench_function("trace", |b| b.iter(|| black_box(document.trace())));
        group.bench_function("format, compact", |b| {
            let settings = Effective {
                stated_layout: Some(Layout::Compact),
                ..settings.clone()
            };
            b.iter(|| {
                black_box(program::format(
                    &document,
                    &settings,
                    0..document.text().line_count(),
                ))
            })
        });
        // The last digit of an X in the middle of the file comes and goes.
        let line = text[..text.len() / 2].rfind('\n').map_or(0, |at| at + 1);
        let at = line + text[line..].find(" Y").unwrap_or(0);
        let mut is_in = false;
        group.bench_function("one character, edit to findings", |b| {
            b.iter(|| {
                if is_in {
                    document.edit(at..at + 1, "");
                } else {
                    document.edit(at..at, "5");
                }
                is_in = !is_in;
                black_box(document.findings(&settings, 500))
            })
        });
        group.finish();
    }
}

fn formatting(c: &mut Criterion) {
    let settings = Effective::default();
    let document = Document::read(
        Language::ThreeB,
        generated::three_b(200_000).into_bytes(),
        &settings,
    );
    let mut group = c.benchmark_group("format a program of 200,000 blocks");
    group.sample_size(10);
    group.throughput(Throughput::Bytes(document.text().len() as u64));
    for layout in [Layout::Compact, Layout::Aligned, Layout::Checking] {
        let settings = Effective {
            stated_layout: Some(layout),
            ..settings.clone()
        };
        group.bench_function(format!("compact to {layout:?}"), |b| {
            b.iter(|| {
                black_box(program::format(
                    &document,
                    &settings,
                    0..document.text().line_count(),
                ))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, program, beside, reading, iso_programs, formatting);
criterion_main!(benches);
