//! Reading to contours, side by side with other readers in one run: `cargo bench --bench reading`.
//!
//! The fastest of a few runs counts for each, and for each without the time in which what it made is thrown away; `-- --alone` leaves the other readers out. ezdxf runs in an interpreter of its own (`benches/reading.py` says how it gets
//! there); where there is none the row says so.

mod generated;

use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use wedm::drawing::Chains;
use wedm::settings::Effective;

fn main() {
    let alone = std::env::args().any(|argument| argument == "--alone");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    println!(
        "{:<44} {:<24} {:>10} {:>10}   goal",
        "", "reader", "time", "MB/s"
    );
    for (name, file, text, goal) in [
        (
            "1,000,000 vertices in LWPOLYLINEs",
            "vertices.dxf",
            generated::polylines_of(125_000),
            "200 MB/s",
        ),
        (
            "300,000 LINE and ARC",
            "lines.dxf",
            generated::lines_and_arcs_of(37_500),
            "150 MB/s",
        ),
    ] {
        let size = text.len();
        let row = |reader: &str, time: Duration, goal: &str| {
            let rate = size as f64 / 1e6 / time.as_secs_f64();
            println!(
                "{name:<44} {reader:<24} {:>7.0} ms {rate:>10.0}   {goal}",
                time.as_secs_f64() * 1e3
            );
        };
        let bytes = text.as_bytes();
        row(
            "wedm, to geometry",
            fastest(7, || bytes.to_vec(), wedm::dxf::Document::read),
            "",
        );
        row(
            "wedm, to contours",
            fastest(7, || bytes.to_vec(), contours),
            goal,
        );
        if alone {
            continue;
        }
        row(
            "dxf crate, to geometry",
            fastest(
                1,
                || bytes,
                |mut bytes| dxf::Drawing::load(&mut bytes).expect("it reads"),
            ),
            "",
        );
        let path = folder.join(file);
        std::fs::write(&path, bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        match ezdxf(&path) {
            Some(time) => row("ezdxf, to geometry", time, ""),
            None => println!(
                "{name:<44} {:<24} {:>10}",
                "ezdxf, to geometry", "not installed"
            ),
        }
    }
    let document = wedm::dxf::Document::read(generated::lines_and_arcs_of(37_500).into_bytes());
    let time = fastest(7, || (), |()| chained(&document));
    println!(
        "{:<44} {:<24} {:>7.0} ms {:>10}   150 ms",
        "300,000 LINE and ARC",
        "wedm, chaining alone",
        time.as_secs_f64() * 1e3,
        ""
    );
}

/// The shortest time that the work took; what it takes in is made outside of the clock, and what it makes goes there.
fn fastest<T, U>(runs: usize, input: impl Fn() -> T, work: impl Fn(T) -> U) -> Duration {
    let timed = |_| {
        let input = input();
        let began = Instant::now();
        let made = black_box(work(input));
        let time = began.elapsed();
        drop(made);
        time
    };
    (0..runs).map(timed).min().unwrap_or_default()
}

fn contours(bytes: Vec<u8>) -> (wedm::dxf::Document, Chains) {
    let document = wedm::dxf::Document::read(bytes);
    let chains = chained(&document);
    (document, chains)
}

fn chained(document: &wedm::dxf::Document) -> Chains {
    let drawing = document.drawing();
    let join = Effective::default().tolerances.join;
    Chains::new(drawing, join, &|id| {
        drawing
            .get(id)
            .is_some_and(|entity| entity.geometry.segment_count() > 0)
    })
}

/// What ezdxf takes, as it says itself: without the start of its interpreter.
fn ezdxf(file: &Path) -> Option<Duration> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/reading.py");
    let own = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .with_file_name("ezdxf")
        .join("bin/python");
    let interpreter = if own.exists() { own } else { "python3".into() };
    let output = Command::new(interpreter)
        .arg(script)
        .arg(file)
        .output()
        .ok()?;
    let answer = String::from_utf8(output.stdout).ok()?;
    answer
        .split_whitespace()
        .next()?
        .parse()
        .ok()
        .map(Duration::from_secs_f64)
}
