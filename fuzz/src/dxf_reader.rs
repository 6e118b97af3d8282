//! A file's bytes to findings: whatever they are, reading, chaining, all rules and all repairs end, and everything that is said has
//! its place. A repair does in the text what it does in the drawing.

use super::segment_count;
use std::sync::Arc;
use wedm::document::{Document, Source};
use wedm::drawing::{Drawing, DrawingEdit, Geometry, Kind};
use wedm::dxf;
use wedm::finding;
use wedm::finding::Edit;
use wedm::picture::{self, View};
use wedm::protocol::{Contours, Inspection};
use wedm::settings::{Effective, Settings, SideSetting};

/// Rules and repairs are tried on drawings of at most this many segments; larger ones only from a bomb.
const SEGMENTS: usize = 2_000;
/// Repairs are asked for of at most this many findings.
const REPAIRS: usize = 30;

pub fn run(data: &[u8]) {
    let text = dxf::Document::read_file(data.to_vec());
    let length = text.text().len();
    for finding in text.findings() {
        let range = text.range_of(&finding.place);
        assert!(
            range.start <= range.end && range.end <= length,
            "{finding:?}"
        );
    }
    for (_, entity) in text.drawing().entities() {
        assert!(entity.geometry.is_sound(), "{entity:?}");
    }
    text.segments_at(0..length);
    let side = if data.len().is_multiple_of(2) {
        SideSetting::Both
    } else {
        SideSetting::Auto
    };
    let settings = Arc::new(Effective::of(&Settings {
        side: Some(side),
        ..Settings::default()
    }));
    let drawing = text.drawing().clone();
    if segment_count(&drawing) > SEGMENTS {
        return;
    }
    let document = Document::new(Source::Dxf(text), settings);
    let unit = document.settings().unit_of(&drawing);
    let findings = document.all_findings();
    for finding in findings.iter() {
        assert!(!finding::sentence(finding, unit.mm).is_empty());
        let range = document.range_of(&finding.place).expect("a text");
        assert!(range.end <= length, "{finding:?}");
    }
    Inspection::of(&document, None).expect("a drawing");
    if let Some(snapshot) = document.snapshot() {
        Contours::new(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        let view = View {
            name: None,
            drawing: &drawing,
            outlines: &snapshot.outlines,
            findings: &findings,
            paths: &[],
            parts: &[],
            holes: &[],
            why: None,
            settings: &snapshot.settings,
        };
        picture::svg(&view);
    }
    let fixes = findings
        .iter()
        .take(REPAIRS)
        .flat_map(|finding| document.fixes(finding))
        .map(|fix| fix.edit);
    for edit in fixes.chain(document.fix_all()) {
        match edit {
            Edit::Drawing(edit) => apply(&document, &drawing, &edit),
            // What is not to be cut is said in wedm.toml.
            Edit::Settings(_) => {}
            edit => panic!("a drawing is not repaired as text: {edit:?}"),
        }
    }
}

/// The edit in the drawing and in the text comes to the same.
fn apply(document: &Document, drawing: &Drawing, edit: &DrawingEdit) {
    let Source::Dxf(text) = document.source() else {
        unreachable!()
    };
    // A copied name full of zeros may make another file look binary.
    if text.text().bytes().contains(&0) {
        return;
    }
    let Ok(edits) = text.text_edits(edit) else {
        return;
    };
    let mut wanted = drawing.clone();
    wanted
        .apply(edit)
        .expect("an edit that is offered can be made");
    let mut bytes = Vec::new();
    let mut at = 0;
    for edit in &edits {
        assert!(
            at <= edit.range.start && edit.range.end <= text.text().len(),
            "edits overlap: {edits:?}"
        );
        bytes.extend_from_slice(&text.text().bytes()[at..edit.range.start]);
        bytes.extend_from_slice(edit.text.as_bytes());
        at = edit.range.end;
    }
    bytes.extend_from_slice(&text.text().bytes()[at..]);
    let after = dxf::Document::read_file(bytes);
    let (wanted, found): (Vec<_>, Vec<_>) = (shapes(&wanted), shapes(after.drawing()));
    assert!(
        alike(&wanted, &found),
        "{edit:?}\nin the drawing {wanted:?}\nin the text {found:?}\n{edits:?}"
    );
}

/// What an entity is called, and its numbers: those of its segments.
fn shapes(drawing: &Drawing) -> Vec<(Kind, Vec<f64>)> {
    let numbers = |geometry: &Geometry| {
        let of_segments = geometry.segments().flat_map(|segment| {
            let (from, to, middle) = (segment.start(), segment.end(), segment.point_at(0.5));
            [from.x, from.y, to.x, to.y, middle.x, middle.y]
        });
        of_segments.collect()
    };
    drawing
        .entities()
        .map(|(_, entity)| (entity.kind, numbers(&entity.geometry)))
        .collect()
}

/// Alike within what twelve decimals and a bulge can say of numbers of this size.
fn alike(one: &[(Kind, Vec<f64>)], other: &[(Kind, Vec<f64>)]) -> bool {
    let all = one.iter().chain(other).flat_map(|(_, numbers)| numbers);
    let size = all.fold(1.0, |size: f64, number| size.max(number.abs()));
    one.len() == other.len()
        && one
            .iter()
            .zip(other)
            .all(|((kind, one), (other_kind, other))| {
                kind == other_kind
                    && one.len() == other.len()
                    && one
                        .iter()
                        .zip(other)
                        .all(|(a, b)| (a - b).abs() <= 1e-7 * size)
            })
}
