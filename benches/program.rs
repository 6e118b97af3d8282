//! What a wire path and its proved 3B program cost: `cargo bench --bench program`.

mod generated;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use wedm::drawing::{Contour, Drawing, Entity, Geometry, Outline, Role, Unit, Vertex};
use wedm::program::three_b::{self, Words};
use wedm::program::{Document, Language, language};
use wedm::settings::{Effective, Layout};
use wedm::toolpath::{WirePath, plan};

/// A wheel of `segments` segments, every other one an arc, each a tooth's flank or its rounded head and foot.
fn wheel(segments: usize) -> (Drawing, Outline) {
    let teeth = segments / 4;
    let radius = teeth as f64 * 0.4;
    let step = std::f64::consts::TAU / teeth as f64;
    let mut vertices = Vec::with_capacity(segments);
    for tooth in 0..teeth {
        for (share, height, bulge) in [(0.0, 0.0, 0.0), (0.15, 1.0, -0.4), (0.5, 1.0, 0.0), (0.65, 0.0, 0.4)] {
            let angle = -(tooth as f64 + share) * step;
            let at = radius + height;
            vertices.push(Vertex::new(at * angle.cos(), at * angle.sin(), bulge));
        }
    }
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let geometry = Geometry::Polyline { closed: true, vertices };
    let id = drawing.push(Entity { handle: "2A".into(), layer: "0".into(), role: None, kind: "LWPOLYLINE", geometry });
    let contour = Contour::new(&drawing, [(id, false)], true);
    let twice_area = contour.twice_area(&drawing);
    (drawing, Outline { contour, role: Role::Punch, twice_area })
}

fn settings() -> Effective {
    Effective { correction: 0.1, ..Effective::default() }
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
    group.bench_function("wire path", |b| b.iter(|| black_box(plan(&drawing, &outlines, &settings(), None))));

    let paths = paths(SEGMENTS);
    let written = three_b::write(&paths, 1.0, &settings()).expect("a proved program");
    group.throughput(Throughput::Elements(written.blocks as u64));
    for layout in [Layout::Compact, Layout::Checking] {
        let settings = Effective { layout, ..settings() };
        group.bench_function(format!("3B, {layout:?}"), |b| b.iter(|| black_box(three_b::write(&paths, 1.0, &settings))));
    }
    group.throughput(Throughput::Bytes(written.text.len() as u64));
    group.bench_function("3B text read again", |b| b.iter(|| black_box(three_b::read(written.text.as_bytes(), &Words::default()))));
    group.finish();
}

fn formatting(c: &mut Criterion) {
    let settings = Effective::default();
    let document = Document::read(Language::ThreeB, generated::three_b(200_000).into_bytes(), &settings);
    let mut group = c.benchmark_group("format a program of 200,000 blocks");
    group.sample_size(10);
    group.throughput(Throughput::Bytes(document.text().len() as u64));
    for layout in [Layout::Compact, Layout::Aligned, Layout::Checking] {
        let settings = Effective { stated_layout: Some(layout), ..settings.clone() };
        group.bench_function(format!("compact to {layout:?}"), |b| {
            b.iter(|| black_box(language::format(&document, &settings, 0..document.text().line_count())));
        });
    }
    group.finish();
}

criterion_group!(benches, program, formatting);
criterion_main!(benches);
