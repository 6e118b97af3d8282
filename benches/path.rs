//! What the wire's path costs beside the offset of `cavalier_contours`, further passes, and whether punch and plate fit:
//! `cargo bench --bench path`.
//!
//! Every figure is the least of some runs, as `time/processor`: what one waits, over all cores, and the processor time of the whole
//! process, in which what else the machine does plays no part. Ratios are given of both.
//! `-- NAME …` takes only the contours whose names hold one of these, `-- --vertices N` another size, `-- --fit` only the fits.

mod generated;

use cavalier_contours::polyline::{PlineCreation, PlineSource, PlineSourceMut, Polyline};
use generated::contours::{ALL, rounded};
use std::f64::consts::TAU;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};
use wedm::analysis::Analysis;
use wedm::drawing::{Contour, Delta, Drawing, Entity, EntityId};
use wedm::drawing::{Geometry, Kind, Outline, Role, Unit, Vertex};
use wedm::settings::{Effective, from_toml};
use wedm::toolpath::plan;

const CORRECTION: f64 = 0.1;

/// Of this many runs the least counts, and of fewer where these would take longer than this long.
const RUNS: usize = 15;
const LONGEST: Duration = Duration::from_secs(4);

fn main() {
    let mut arguments = std::env::args().skip(1);
    let (mut names, mut sizes, mut paths) = (Vec::new(), vec![100_000, 1_000_000], true);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--vertices" => {
                let size = arguments.next().and_then(|number| number.parse().ok());
                sizes = vec![size.expect("a number of vertices")];
            }
            "--fit" => paths = false,
            "--bench" => {}
            name => names.push(name.to_owned()),
        }
    }
    if paths {
        println!(
            "{:<20} {:>9} {:>16} {:>16} {:>10} {:>16} {:>10}",
            "path, ms", "vertices", "wedm", "cavalier", "ratio", "5 passes", "ratio"
        );
        let is_chosen =
            |name: &str| names.is_empty() || names.iter().any(|part| name.contains(part));
        for contour in ALL.iter().filter(|contour| is_chosen(contour.name)) {
            for &size in &sizes {
                path(contour.name, &(contour.vertices)(size));
            }
        }
    }
    if names.is_empty() {
        println!(
            "\n{:<44} {:>13} {:>13} {:>13}",
            "fit of 10,000 segments, ms", "alone", "opened", "an edit"
        );
        let corners = |count: usize| -> Vec<[f64; 2]> {
            let corner = |at: usize| {
                let (sin, cos) = (TAU * at as f64 / count as f64).sin_cos();
                let away = 0.16 * count as f64 + if at.is_multiple_of(2) { 0.0 } else { 0.8 };
                [away * cos, away * sin]
            };
            (0..count).map(corner).collect()
        };
        let sharp: Vec<[f64; 3]> = corners(10_000)
            .into_iter()
            .map(|[x, y]| [x, y, 0.0])
            .collect();
        fit("sharp corners", &sharp);
        fit("filleted corners", &rounded(&corners(5_000), 0.2));
    }
}

/// What some work takes, in ms.
#[derive(Clone, Copy)]
struct Cost {
    time: f64,
    processor: f64,
}

impl Cost {
    fn ratio(self, other: Cost) -> String {
        let [time, processor] = [self.time / other.time, self.processor / other.processor];
        format!("{time:.2}/{processor:.2}")
    }
}

impl std::fmt::Display for Cost {
    fn fmt(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        formatter.pad(&format!("{:.1}/{:.1}", self.time, self.processor))
    }
}

/// Processor time of this process since it began; of another system than Unix the time of day.
fn processor() -> Duration {
    #[cfg(unix)]
    {
        let mut time = libc::timespec {
            tv_sec: 0,
            tv_nsec: 0,
        };
        // SAFETY: `time` is there to be written to.
        if unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut time) } == 0 {
            return Duration::new(time.tv_sec as u64, time.tv_nsec as u32);
        }
    }
    static BEGAN: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    BEGAN.get_or_init(Instant::now).elapsed()
}

/// The least that `work` takes.
fn least<T>(mut work: impl FnMut() -> T) -> Cost {
    let began = Instant::now();
    let mut least = Cost {
        time: f64::INFINITY,
        processor: f64::INFINITY,
    };
    for run in 0..RUNS {
        if run > 1 && began.elapsed() > LONGEST {
            break;
        }
        let before = (Instant::now(), processor());
        let made = black_box(work());
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        least.time = least.time.min(ms(before.0.elapsed()));
        least.processor = least.processor.min(ms(processor() - before.1));
        drop(made);
    }
    least
}

fn entity(handle: &str, layer: &str, vertices: &[[f64; 3]]) -> Entity {
    let vertices = vertices
        .iter()
        .map(|&[x, y, bulge]| Vertex::new(x, y, bulge));
    Entity {
        handle: handle.into(),
        layer: layer.into(),
        role: None,
        kind: Kind::LightPolyline,
        geometry: Geometry::Polyline {
            closed: true,
            vertices: vertices.collect(),
        },
    }
}

fn path(name: &str, vertices: &[[f64; 3]]) {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let id = drawing.push(entity("2A", "0", vertices));
    let contour = Contour::new(&drawing, [(id, false)], true);
    let twice_area = contour.twice_area(&drawing);
    let outlines = [Outline {
        contour,
        role: Role::Punch,
        twice_area,
    }];
    let settings = |corrections: &[f64]| Effective {
        correction: corrections[0],
        corrections: corrections.to_vec(),
        ..Effective::default()
    };
    let planned = |settings: &Effective| {
        plan(&drawing, &outlines, settings, None)
            .unwrap_or_else(|refusal| panic!("{name}: {refusal:?}"))
    };
    let one = settings(&[CORRECTION]);
    let ours = least(|| planned(&one));
    let mut pline = Polyline::with_capacity(vertices.len(), true);
    vertices
        .iter()
        .for_each(|&[x, y, bulge]| pline.add(x, y, bulge));
    // To the right of a contour that runs counter-clockwise.
    let outwards = -CORRECTION * twice_area.signum();
    let theirs = least(|| pline.parallel_offset(outwards));
    let five = settings(&[1.0, 0.95, 0.93, 0.92, 0.915].map(|share| share * CORRECTION));
    let all = least(|| planned(&five));
    println!(
        "{name:<20} {:>9} {ours:>16} {theirs:>16} {:>10} {all:>16} {:>10}",
        vertices.len(),
        ours.ratio(theirs),
        all.ratio(ours)
    );
}

/// Punch and plate along one contour, and along two.
fn fit(name: &str, punch: &[[f64; 3]]) {
    const CLEARANCE: f64 = 0.01;
    let mut pline = Polyline::with_capacity(punch.len(), true);
    punch
        .iter()
        .for_each(|&[x, y, bulge]| pline.add(x, y, bulge));
    let plate = pline.parallel_offset(-CLEARANCE);
    let plate: Vec<[f64; 3]> = plate[0]
        .iter_vertexes()
        .map(|vertex| [vertex.x, vertex.y, vertex.bulge])
        .collect();
    for (drawn, keys, parts) in [
        ("cut twice", "drawn-as = \"punch\"\n", &[("0", punch)][..]),
        (
            "both drawn",
            "[workpieces]\nA = [\"A\"]\nB = [\"B\"]\n",
            &[("A", punch), ("B", &plate)],
        ),
    ] {
        let text =
            format!("wire-diameter = 0.18\ngap = 0.01\n[pair]\nclearance = {CLEARANCE}\n{keys}");
        let (set, errors) = from_toml(&text);
        assert_eq!(errors, []);
        let settings = Arc::new(Effective::of(&set));
        let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
        let ids: Vec<EntityId> = parts
            .iter()
            .map(|(layer, vertices)| drawing.push(entity(layer, layer, vertices)))
            .collect();
        let opened = |drawing: &Drawing| {
            let mut analysis = Analysis::new(drawing, settings.clone());
            let found = analysis.findings(drawing, 500);
            (analysis, found)
        };
        let (mut analysis, found) = opened(&drawing);
        let outlines = analysis.outlines(&drawing).clone();
        let alone = least(|| {
            wedm::fit::fit(&drawing, &outlines, &settings, &|| true).expect("there is a pair")
        });
        let open = least(|| opened(&drawing));
        let mut moved = false;
        let edit = least(|| {
            moved = !moved;
            let [x, y, bulge] = punch[0];
            let vertex = Vertex::new(x + if moved { 0.001 } else { 0.0 }, y, bulge);
            let touched = drawing
                .splice(ids[0], 0, 1, &[vertex])
                .expect("the vertex is there");
            analysis.update(
                &drawing,
                &Delta {
                    touched: vec![touched],
                },
            );
            analysis.findings(&drawing, 500)
        });
        let name = format!("{name}, {drawn}, {} findings", found.1);
        println!("{name:<44} {alone:>13} {open:>13} {edit:>13}");
    }
}
