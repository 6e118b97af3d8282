//! Programs by other writers, and by wedm under settings that nobody has said, beside their drawings: what follows the
//! drawing in any way has nothing said, and a changed block is named where it stands.
//!
//! Each folder of `tests/data/compare` holds a drawing, its settings, and programs: `unchanged`, or `line_N` where that
//! line is changed.

use super::{Drawn, Format, compare, settings_of, traced};
use std::path::{Path, PathBuf};
use wedm::document::{Document, Source};
use wedm::dxf;

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut all: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    all.sort();
    all
}

#[test]
fn what_follows_its_drawing_has_nothing_said_and_a_change_is_named_where_it_is() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/compare");
    let (mut programs, mut wrong) = (0, Vec::new());
    for folder in files(&data) {
        let settings = settings_of(&std::fs::read_to_string(folder.join("wedm.toml")).unwrap());
        let drawing = dxf::Document::read(std::fs::read(folder.join("drawing.dxf")).unwrap());
        let document = Document::new(Source::Dxf(drawing), settings.clone());
        let snapshot = document.snapshot().unwrap();
        let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        for file in files(&folder) {
            let format = match file.extension().and_then(|ending| ending.to_str()) {
                Some("3b") => Format::ThreeB,
                Some("4b") => Format::FourB,
                Some("iso") => Format::Iso,
                _ => continue,
            };
            let name = file.file_stem().unwrap().to_string_lossy().into_owned();
            let expected: Vec<usize> = name
                .strip_prefix("line_")
                .into_iter()
                .map(|number| number.parse().unwrap())
                .collect();
            let text = std::fs::read_to_string(&file).unwrap();
            let found = compare(&drawn, &traced(&text, format, &settings));
            let lines = found.map(|found| found.differences.into_iter().map(|one| one.line + 1));
            let lines: Vec<usize> = lines.map_or(vec![0], Iterator::collect);
            if lines != expected {
                wrong.push(format!("{}: {lines:?}", file.display()));
            }
            programs += 1;
        }
    }
    assert!(programs > 10);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
