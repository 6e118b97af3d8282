//! The demonstration as a user starts it, and whether what it wrote is what it says.

use std::path::Path;
use std::process::{Command, Stdio};
use wedm::document::{Document, Source};
use wedm::drawing::Role;
use wedm::program::three_b;
use wedm::settings::{Effective, Settings};

struct Played {
    said: String,
    folder: tempfile::TempDir,
}

fn play(arguments: &[&str]) -> Played {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_wedm"));
    let output = command
        .arg("demo")
        .args(arguments)
        .arg("plate")
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(
        output.status.success(),
        "{said}\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    Played { said, folder }
}

impl Played {
    fn file(&self, name: &str) -> String {
        std::fs::read_to_string(self.folder.path().join("plate").join(name)).unwrap()
    }
}

/// The repaired plate under `correction`, read from the file that was written.
fn document(text: &str, correction: f64) -> Document {
    let layers = [
        ("DIE", Role::Opening),
        ("HOLES", Role::Opening),
        ("PLATE", Role::Ignore),
    ];
    let layers = layers
        .into_iter()
        .map(|(layer, role)| (layer.to_string(), role))
        .collect();
    let settings = Settings {
        correction: Some(correction),
        layers: Some(layers),
        ..Settings::default()
    };
    let source = Source::Dxf(wedm::dxf::Document::read(text.as_bytes().to_vec()));
    Document::new(source, std::sync::Arc::new(Effective::of(&settings)))
}

/// Plays it under `correction` and looks for what it should say and write.
#[track_caller]
fn check(correction: f64, said: &[&str], not_said: &[&str]) -> Played {
    let played = play(&["--correction", &correction.to_string()]);
    for text in said {
        assert!(
            played.said.contains(text),
            "{text:?} is not said:\n{}",
            played.said
        );
    }
    for text in not_said {
        assert!(
            !played.said.contains(text),
            "{text:?} is said:\n{}",
            played.said
        );
    }
    assert!(
        played.said.lines().all(|line| line.chars().count() <= 80),
        "more than 80 columns:\n{}",
        played.said
    );
    assert!(!played.said.contains('\x1b'), "colours without a terminal");

    let (findings, _) = document(&played.file("demo.dxf"), correction).findings(usize::MAX);
    assert!(findings.is_empty(), "{findings:?}");
    let program = played.file("demo.3b");
    let (items, faults) = three_b::read(program.as_bytes(), &three_b::Words::default());
    assert!(faults.is_empty() && items.len() > 30, "{faults:?}");
    assert!(
        three_b::Document::read(program.into_bytes())
            .findings()
            .is_empty()
    );
    let picture = played.file("demo.svg");
    for part in [
        "class=\"contour\"",
        "class=\"fault error\"",
        "class=\"wire\"",
        "class=\"correction\"",
        "</svg>",
    ] {
        assert!(picture.contains(part), "{part} is missing in the picture");
    }
    played
}

#[test]
fn at_a_tenth_two_fillets_of_the_plate_are_too_tight() {
    let played = check(
        0.1,
        &[
            "a correction of 0.100 mm",
            "version 1: 2 diagnostics",
            "arc R 0.080 mm is below the correction 0.100 mm",
            "arc R 0.070 mm",
            "squeezes the fillet at 31, 13 to R 0.060",
            "gone: 2A segment 2",
            "becomes R 0.090",
            "plate and punch bind here by 0.0273 mm",
            "The parts overlap by 0.0273 mm where it is tightest",
            "Of 0.0100 mm of clearance, 0.0004 mm are left",
            "program of the plate: correction 0.0900 mm",
            "preferred: Replace the arc by one of R 0.101 mm",
            "version 6: 0 diagnostics",
            "The drawing is clean",
            "the correction is 0.100",
            "version 3: 0 diagnostics",
            "Everything above was checked",
        ],
        &["R 0.110"],
    );
    assert!(
        played.file("demo.3b").starts_with("B2900B0B2900GXL1\n"),
        "R3 less 0.1 begins with 2.9 mm"
    );
}

#[test]
fn another_correction_gives_other_figures() {
    let played = check(
        0.12,
        &[
            "version 1: 3 diagnostics",
            "arc R 0.110 mm is below the correction 0.120 mm",
            "becomes R 0.108",
            "one of R 0.121 mm",
        ],
        &["0.101", "0.100 mm"],
    );
    assert!(
        played.file("demo.3b").starts_with("B2880B0B2880GXL1\n"),
        "R3 less 0.12 begins with 2.88 mm"
    );
}

#[test]
fn the_folder_is_wedm_demo_when_none_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let status = Command::new(env!("CARGO_BIN_EXE_wedm"))
        .arg("demo")
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .status()
        .unwrap();
    assert!(status.success());
    for name in ["demo.dxf", "demo.3b", "demo.svg", "wedm.toml"] {
        assert!(
            folder.path().join("wedm-demo").join(name).is_file(),
            "{name}"
        );
    }
}

/// What it says can be done next works word for word, under each correction.
#[test]
fn the_commands_that_are_said_at_the_end_work() {
    for correction in ["0.1", "0.12"] {
        let played = play(&["--correction", correction]);
        let (_, next) = played.said.split_once("Go on with").expect("a heading");
        let commands: Vec<&str> = next
            .lines()
            .filter_map(|line| line.trim().strip_prefix("wedm "))
            .collect();
        assert!(commands.len() >= 5, "{next}");
        for command in commands {
            let output = Command::new(env!("CARGO_BIN_EXE_wedm"))
                .args(command.split(' '))
                .current_dir(played.folder.path())
                .output()
                .unwrap();
            assert!(
                output.status.success(),
                "wedm {command}: {}{}",
                String::from_utf8_lossy(&output.stdout),
                String::from_utf8_lossy(&output.stderr)
            );
        }
    }
}

/// A project's settings have nothing to say about the plate.
#[test]
fn a_settings_file_nearby_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("wedm.toml"),
        "correction = 3.0\nside = \"punch\"\n",
    )
    .unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_wedm"))
        .args(["demo", "here"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn what_the_plate_is_not_made_for_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [
        ["--correction", "5"],
        ["--correction", "0.001"],
        ["--side", "punch"],
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_wedm"))
            .arg("demo")
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    assert!(!Path::new(&folder.path().join("wedm-demo")).exists());
}
