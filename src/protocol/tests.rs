//! The same drawing by both routes, out of its file and as a CAD program sends it: the same is cut, and the same is found.
//!
//! `WEDM_DRAWINGS` names further folders of drawings, as `PATH` does.

use super::drawing::{Drawing, Entity};
use super::{DrawingChange, apply};
use crate::document::{Document, Source};
use crate::drawing::{self as core, Kind};
use crate::dxf;
use crate::finding::{Detail, Place};
use crate::settings::{Effective, from_toml};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

fn effective(toml: &str) -> Arc<Effective> {
    let (settings, errors) = from_toml(toml);
    assert!(errors.is_empty(), "{toml}: {errors:?}");
    Arc::new(Effective::of(&settings))
}

fn drawings() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let further = std::env::var_os("WEDM_DRAWINGS").unwrap_or_default();
    let folders = [root.join("tests/data"), root.join("docs/pictures")];
    let folders = folders.into_iter().chain(std::env::split_paths(&further));
    let files = folders.flat_map(|folder| walkdir::WalkDir::new(folder).sort_by_file_name());
    let is_dxf = |path: &PathBuf| {
        let ending = path.extension().and_then(|it| it.to_str());
        ending.is_some_and(|it| it.eq_ignore_ascii_case("dxf"))
    };
    files
        .filter_map(|entry| Some(entry.ok()?.into_path()))
        .filter(is_dxf)
        .collect()
}

/// The drawing of a file as a CAD program sends it, read again from its JSON. Parts of a block have one handle in the file.
fn sent(drawing: &core::Drawing) -> core::Drawing {
    let entities = drawing.entities().enumerate().map(|(number, (id, it))| {
        let entity = Entity::reshaped(drawing, id, it.geometry.clone()).unwrap();
        Entity {
            handle: format!("{number:X}"),
            ..entity
        }
    });
    let entities: Vec<Entity> = entities.collect();
    let text = json!({ "uri": "cad:1", "version": 1, "entities": entities }).to_string();
    let read: Drawing = serde_json::from_str(&text).unwrap();
    let mut read = read.into_core().unwrap();
    // A file may be in units that the protocol has no word for.
    read.unit = drawing.unit;
    read
}

/// What is cut, and where the wire is threaded.
fn cut(document: &Document) -> String {
    let snapshot = document.snapshot().unwrap();
    let mut told = String::new();
    for outline in snapshot.outlines.iter() {
        let segments = outline.contour.segments(&snapshot.drawing);
        let segments: Vec<_> = segments.map(|segment| segment.geometry).collect();
        let _ = writeln!(
            told,
            "{:?} {} {segments:?}",
            outline.role, outline.contour.closed
        );
    }
    if let Ok(planned) = crate::job::planned(&snapshot, document.settings(), None, false, &()) {
        let holes = planned
            .paths
            .iter()
            .map(|path| (path.outline, path.thread_hole));
        let _ = writeln!(told, "{:?}", holes.collect::<Vec<_>>());
    }
    told
}

/// Rules and severities of what is found at entities, and how many are not shown.
fn found(document: &Document) -> (Vec<String>, usize) {
    let (mut rules, mut unseen) = (Vec::new(), 0);
    for finding in document.all_findings().iter() {
        match (&finding.detail, &finding.place) {
            (Detail::Unseen { count, .. }, _) => unseen += count,
            (_, Place::Entity { .. } | Place::Segment { .. }) => {
                rules.push(format!("{:?} {:?}", finding.rule, finding.severity))
            }
            _ => {}
        }
    }
    rules.sort();
    (rules, unseen)
}

/// Settings under which other entities are cut.
fn settings_for(drawing: &core::Drawing) -> [String; 4] {
    let quoted = |names: BTreeSet<String>, role: &str| {
        let rows = names.iter().map(|name| format!("{name:?} = \"{role}\"\n"));
        rows.collect::<String>()
    };
    let layers = drawing
        .entities()
        .map(|(_, entity)| entity.layer.to_string());
    let linetypes = drawing.order().iter();
    let linetypes = linetypes.filter_map(|&id| Some(drawing.linetype(id)?.name.to_string()));
    let plain = |name: &String| !name.is_empty() && name.is_ascii() && !name.contains(['"', '\\']);
    let layers = quoted(layers.filter(plain).collect(), "punch");
    let linetypes = quoted(linetypes.filter(plain).collect(), "opening");
    [
        "side = \"auto\"".into(),
        format!("side = \"auto\"\n[layers]\n{layers}"),
        format!("side = \"auto\"\n[linetypes]\n{linetypes}"),
        "side = \"auto\"\n[colors]\nred = \"ignore\"\n30 = \"opening\"\n\"#123456\" = \"ignore\""
            .into(),
    ]
}

#[test]
fn the_same_is_cut_and_found() {
    let mut files = 0;
    for path in drawings() {
        let text = std::fs::read(&path).unwrap();
        let file = dxf::Document::read(text);
        let fitted = [Kind::Ellipse, Kind::Spline];
        let drawing = file.drawing().clone();
        let is_exact = !drawing.entities().any(|(_, it)| fitted.contains(&it.kind));
        for toml in settings_for(&drawing) {
            let settings = effective(&toml);
            let file = Document::new(Source::Dxf(file.clone()), settings.clone());
            // Curves are fitted under these settings.
            let drawing = sent(file.drawing().unwrap());
            let from_cad = Document::new(Source::Cad(Arc::new(drawing)), settings);
            assert_eq!(
                cut(&from_cad),
                cut(&file),
                "{} under {toml}",
                path.display()
            );
            if is_exact {
                assert_eq!(
                    found(&from_cad),
                    found(&file),
                    "{} under {toml}",
                    path.display()
                );
            }
        }
        files += 1;
    }
    assert!(files > 60, "{files}");
}

/// Any order of changes of how entities are shown leads where a fresh look at the drawing leads.
#[test]
fn a_look_that_changes_is_judged_as_a_fresh_one() {
    let looks = [
        json!({}),
        json!({ "linetype": "HIDDEN" }),
        json!({ "linetype": "CENTER", "linetypeByLayer": true }),
        json!({ "visible": false }),
        json!({ "visible": "off" }),
        json!({ "visible": "frozen", "linetype": "HIDDEN" }),
        json!({ "color": 1 }),
        json!({ "xdata": ["suppress gap: as drawn"] }),
    ];
    let entity = |handle: usize, look: usize| {
        let at = (handle % 4) as f64;
        let mut entity = match handle {
            0..4 => json!({ "type": "line", "start": [at, 0], "end": [at + 1.0, 0] }),
            4..8 => json!({ "type": "circle", "center": [at * 9.0, 9], "radius": 4.0 - at }),
            _ => {
                json!({ "type": "arc", "center": [2, 0], "radius": 2, "startAngle": 0, "endAngle": 180 })
            }
        };
        let own = entity.as_object_mut().unwrap();
        own.extend(looks[look].as_object().unwrap().clone());
        own.insert("handle".into(), handle.to_string().into());
        own.insert(
            "layer".into(),
            if handle.is_multiple_of(3) { "DIE" } else { "0" }.into(),
        );
        entity
    };
    let mut state = 7_u64;
    let mut next = |below: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    let settings = effective("[layers]\nDIE = \"opening\"\n[colors]\nred = \"ignore\"");
    let all: Vec<Value> = (0..9).map(|handle| entity(handle, 0)).collect();
    let text = json!({ "uri": "cad:1", "version": 1, "entities": all });
    let drawing: Drawing = serde_json::from_value(text).unwrap();
    let source = Source::Cad(Arc::new(drawing.into_core().unwrap()));
    let mut document = Document::new(source, settings.clone());
    for step in 0..60 {
        let changes = (0..1 + next(3)).map(|_| {
            let handle = next(9);
            let before = (next(4) == 0).then(|| ((handle + 1) % 9).to_string());
            json!({ "handle": handle.to_string(), "entity": entity(handle, next(looks.len())), "before": before })
        });
        let changes: Vec<DrawingChange> =
            serde_json::from_value(changes.collect::<Vec<_>>().into()).unwrap();
        let edit = document.edit_drawing(|drawing| apply(drawing, changes));
        edit.unwrap().unwrap();
        let drawing = Source::Cad(document.drawing().unwrap().clone());
        let fresh = Document::new(drawing, settings.clone());
        assert_eq!(cut(&document), cut(&fresh), "step {step}");
        assert_eq!(document.all_findings(), fresh.all_findings(), "step {step}");
    }
}
