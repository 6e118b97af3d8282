//! Drawings with one fault a hundred thousand times over, checked and repaired: `cargo bench --bench shapes`.
//!
//! Every shape is measured at half the size and at the whole, so that what grows faster than the drawing shows itself in the
//! last column: 2 is linear. `-- NAME …` takes only the shapes whose names hold one of these, `-- --segments N` another size,
//! `-- --check` leaves the repair out, `-- --write FOLDER` writes the drawings as files, for `wedm check` and `wedm fix`.

mod generated;

use generated::shapes::{ALL, Shape};
use std::sync::Arc;
use std::time::{Duration, Instant};
use wedm::document::{Document, Source};
use wedm::dxf;
use wedm::finding::Edit;
use wedm::settings::Effective;

/// As many rounds as `wedm fix` makes.
const ROUNDS: usize = 12;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let (mut names, mut segments, mut folder, mut rounds) = (Vec::new(), 100_000, None, ROUNDS);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--segments" => {
                segments = arguments
                    .next()
                    .and_then(|number| number.parse().ok())
                    .expect("a number of segments")
            }
            "--write" => folder = Some(arguments.next().expect("a folder")),
            "--check" => rounds = 0,
            "--bench" => {}
            name => names.push(name.to_owned()),
        }
    }
    let chosen = ALL
        .iter()
        .filter(|shape| names.is_empty() || names.iter().any(|name| shape.name.contains(name)));
    if let Some(folder) = folder {
        for shape in chosen {
            let path = format!("{folder}/{}.dxf", shape.name);
            std::fs::write(&path, (shape.text)(segments))
                .unwrap_or_else(|error| panic!("{path}: {error}"));
            println!("{path}");
        }
        return;
    }
    println!(
        "{:<28} {:>9} {:>8} {:>10} {:>10} {:>7} {:>7}",
        "", "segments", "findings", "check", "fix all", "rounds", "growth"
    );
    for shape in chosen {
        let half = measure(shape, segments / 2, rounds);
        let whole = measure(shape, segments, rounds);
        let growth =
            |of: fn(&Measured) -> Duration| of(&whole).as_secs_f64() / of(&half).as_secs_f64();
        let ms = |time: Duration| format!("{:.1} ms", time.as_secs_f64() * 1e3);
        println!(
            "{:<28} {:>9} {:>8} {:>10} {:>10} {:>7} {:>3.1} {:>3.1}",
            shape.name,
            segments,
            whole.findings,
            ms(whole.check),
            ms(whole.fix),
            whole.rounds,
            growth(|measured| measured.check),
            growth(|measured| measured.fix)
        );
    }
}

struct Measured {
    findings: usize,
    check: Duration,
    fix: Duration,
    rounds: usize,
}

fn measure(shape: &Shape, segments: usize, most_rounds: usize) -> Measured {
    let text = (shape.text)(segments);
    let settings = Arc::new(Effective::default());
    let began = Instant::now();
    let mut document = Document::new(
        Source::Dxf(dxf::Document::read(text.into_bytes())),
        settings.clone(),
    );
    let (_, findings) = document.findings(500);
    let check = began.elapsed();
    let began = Instant::now();
    let mut rounds = 0;
    while rounds < most_rounds
        && let Some(Edit::Drawing(edit)) = document.fix_all()
    {
        let Source::Dxf(dxf) = document.source() else {
            break;
        };
        let edits = dxf
            .text_edits(&edit)
            .unwrap_or_else(|reason| panic!("{}: {reason}", shape.name));
        let mut bytes = Vec::with_capacity(dxf.text().len());
        let mut at = 0;
        for edit in &edits {
            bytes.extend_from_slice(&dxf.text().bytes()[at..edit.range.start]);
            bytes.extend_from_slice(edit.text.as_bytes());
            at = edit.range.end;
        }
        bytes.extend_from_slice(&dxf.text().bytes()[at..]);
        document = Document::new(Source::Dxf(dxf::Document::read(bytes)), settings.clone());
        rounds += 1;
    }
    Measured {
        findings,
        check,
        fix: began.elapsed(),
        rounds,
    }
}
