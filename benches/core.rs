//! What reading, analysing and writing cost without the server: `cargo bench --bench core`.

mod generated;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Delta, Drawing, Entity, Geometry, Vertex};
use wedm::settings::Effective;

const MEGABYTE: usize = 1_000_000;

fn reading(c: &mut Criterion) {
    let mut group = c.benchmark_group("read DXF to typed geometry");
    for (name, text) in [
        ("10 MB of LWPOLYLINE", generated::polylines(10 * MEGABYTE)),
        (
            "10 MB of LINE and ARC",
            generated::lines_and_arcs(10 * MEGABYTE),
        ),
        (
            "one LWPOLYLINE of 300,000 vertices",
            generated::one_polyline(300_000),
        ),
    ] {
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(name, |b| {
            b.iter_batched(
                || text.clone().into_bytes(),
                wedm::dxf::Document::read,
                BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

fn analysing(c: &mut Criterion) {
    let mut group = c.benchmark_group("drawing to contours and findings");
    group.sample_size(20);
    for (name, text) in [
        ("5 MB of LWPOLYLINE", generated::polylines(5 * MEGABYTE)),
        (
            "5 MB of LINE and ARC",
            generated::lines_and_arcs(5 * MEGABYTE),
        ),
        (
            "100,000 segments of LWPOLYLINE",
            generated::polylines_of(12_500),
        ),
        ("100,000 LINE and ARC", generated::lines_and_arcs_of(12_500)),
    ] {
        let document = wedm::dxf::Document::read(text.into_bytes());
        let settings = Arc::new(Effective::default());
        group.bench_function(name, |b| {
            b.iter(|| {
                black_box(
                    Analysis::new(document.drawing(), settings.clone())
                        .findings(document.drawing(), 500),
                )
            });
        });
    }
    group.finish();
}

fn editing(c: &mut Criterion) {
    let mut group = c.benchmark_group("edit to findings");
    let settings = Arc::new(Effective::default());
    for (name, text) in [
        (
            "one character of 5 MB of LWPOLYLINE",
            generated::polylines(5 * MEGABYTE),
        ),
        (
            "one character of 5 MB of LINE and ARC",
            generated::lines_and_arcs(5 * MEGABYTE),
        ),
        (
            "one character of one LWPOLYLINE of 5 MB",
            generated::one_polyline(140_000),
        ),
    ] {
        let middle = text[..text.len() / 2]
            .rfind("\n10\n")
            .expect("there are vertices")
            + 4;
        let mut document = wedm::dxf::Document::read(text.into_bytes());
        let mut analysis = Analysis::new(document.drawing(), settings.clone());
        let mut inserted = false;
        group.bench_function(name, |b| {
            b.iter(|| {
                let (range, replacement) = if inserted {
                    (middle..middle + 1, "")
                } else {
                    (middle..middle, "1")
                };
                inserted = !inserted;
                let delta = document.edit(range, replacement);
                analysis.update(document.drawing(), &delta);
                black_box(analysis.findings(document.drawing(), 500))
            });
        });
    }
    let vertices: Vec<Vertex> = generated::long_outline(1_000_000)
        .into_iter()
        .map(|[x, y, bulge]| Vertex::new(x, y, bulge))
        .collect();
    let mut drawing = Drawing::new(None);
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
    let mut analysis = Analysis::new(&drawing, settings);
    let mut moved = false;
    group.bench_function("one vertex of a polyline of 1,000,000", |b| {
        b.iter(|| {
            moved = !moved;
            let vertex = Vertex::new(if moved { 1.0 } else { 1.5 }, 2.0, 0.0);
            let touched = drawing
                .splice(id, 500_000, 1, &[vertex])
                .expect("the vertex is there");
            analysis.update(
                &drawing,
                &Delta {
                    touched: vec![touched],
                },
            );
            black_box(analysis.findings(&drawing, 500))
        });
    });
    group.finish();
}

fn writing(c: &mut Criterion) {
    let mut group = c.benchmark_group("path to proved 3B program");
    group.sample_size(10);
    let text = generated::polylines(5 * MEGABYTE);
    let document = wedm::dxf::Document::read(text.into_bytes());
    let settings = Arc::new(Effective {
        side: wedm::settings::SideSetting::Opening,
        correction: 0.03,
        corrections: vec![0.03],
        ..Effective::default()
    });
    let analysis = Analysis::new(document.drawing(), settings.clone());
    let outlines = analysis.outlines(document.drawing()).clone();
    group.bench_function("plan 5 MB of LWPOLYLINE", |b| {
        b.iter(|| {
            black_box(wedm::toolpath::plan(
                document.drawing(),
                &outlines,
                &settings,
                None,
            ))
            .is_ok()
        });
    });
    let paths = wedm::toolpath::plan(document.drawing(), &outlines, &settings, None)
        .unwrap_or_else(|refusal| panic!("{refusal:?}"));
    let blocks = wedm::program::three_b::write(&paths, 1.0, &settings)
        .expect("the program is proved")
        .blocks;
    group.throughput(Throughput::Elements(blocks as u64));
    group.bench_function("write, decode, compare", |b| {
        b.iter(|| black_box(wedm::program::three_b::write(&paths, 1.0, &settings)))
    });
    group.finish();
}

criterion_group!(benches, reading, analysing, editing, writing);
criterion_main!(benches);
