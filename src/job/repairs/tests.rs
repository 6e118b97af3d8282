//! The lists of group codes that a CAD program gets make of its entities what the repairs make of the file.

use super::{Repairs, fix_all};
use crate::document::{Document, Source};
use crate::drawing::Geometry;
use crate::dxf::{self, EntityChange, Group, GroupValue};
use crate::settings::Effective;
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// One entity as a CAD program holds it: its record, and those of its vertices.
type Record = Vec<(i16, String)>;
type Held = Vec<(String, Vec<Record>)>;

/// A square of 10 mm whose last corner is rounded with `radius`, drawn in one of three ways, perhaps with a fault more.
#[derive(Clone, Debug)]
struct Square {
    kind: u8,
    radius: f64,
    gap: f64,
    double: bool,
    mirrored: bool,
}

fn squares() -> impl Strategy<Value = Vec<Square>> {
    let radius = prop_oneof![Just(0.03), Just(0.08), 0.02..0.3_f64];
    let gap = prop_oneof![Just(0.0), Just(0.002), 0.0..0.01_f64];
    let square = (0..3_u8, radius, gap, any::<bool>(), any::<bool>());
    let square = square.prop_map(|(kind, radius, gap, double, mirrored)| Square {
        kind,
        radius,
        gap,
        double,
        mirrored,
    });
    prop::collection::vec(square, 1..5)
}

impl Square {
    /// The records; handles begin with `from`.
    fn held(&self, from: usize, x: f64) -> Held {
        let handle = |index: usize| format!("{:X}", from + index);
        let extrusion = || match self.mirrored {
            true => vec![(210, "0".into()), (220, "0".into()), (230, "-1".into())],
            false => Vec::new(),
        };
        let point = |code: i16, x: f64, y: f64| {
            let mut tags = vec![(code, x.to_string()), (code + 10, y.to_string())];
            tags.push((code + 20, "0.5".into()));
            tags
        };
        let head = |kind: &str, index: usize| {
            let layer = format!("模{}", from % 7);
            let head = [(0, kind.to_owned()), (5, handle(index)), (8, layer)];
            head.to_vec()
        };
        let (radius, bulge) = (self.radius, (std::f64::consts::PI / 8.0).tan());
        let corners = [
            (x, self.gap, 0.0),
            (x + 10.0, 0.0, 0.0),
            (x + 10.0, 10.0 - radius, bulge),
            (x + 10.0 - radius, 10.0, 0.0),
            (x, 10.0, 0.0),
        ];
        let mut held: Held = Vec::new();
        match self.kind {
            0 => {
                let mut record = head("LWPOLYLINE", 0);
                record.extend([(90, "5".into()), (70, "129".into()), (38, "0.5".into())]);
                for (x, y, bulge) in corners {
                    record.extend([(10, x.to_string()), (20, y.to_string())]);
                    record.push((42, bulge.to_string()));
                }
                record.extend(extrusion());
                held.push((handle(0), vec![record]));
            }
            1 => {
                let mut record = head("POLYLINE", 0);
                record.extend([(66, "1".into()), (70, "1".into())]);
                record.extend(extrusion());
                let mut records = vec![record];
                for (index, (x, y, bulge)) in corners.into_iter().enumerate() {
                    let mut vertex = head("VERTEX", index + 1);
                    vertex.extend(point(10, x, y));
                    vertex.push((42, bulge.to_string()));
                    records.push(vertex);
                }
                records.push(head("SEQEND", 9));
                held.push((handle(0), records));
            }
            _ => {
                let places = corners.iter().zip(corners.iter().cycle().skip(1));
                for (index, (begin, end)) in places.enumerate() {
                    let mut record;
                    if begin.2 == 0.0 {
                        record = head("LINE", index);
                        record.extend(point(10, begin.0, if index == 0 { 0.0 } else { begin.1 }));
                        record.extend(point(11, end.0, end.1));
                    } else {
                        record = head("ARC", index);
                        record.extend(point(10, end.0, begin.1));
                        record.push((40, radius.to_string()));
                        record.extend([(50, "0".into()), (51, "90".into())]);
                    }
                    held.push((handle(index), vec![record]));
                }
                if self.double {
                    let mut again = held[1].1[0].clone();
                    again[1].1 = handle(9);
                    held.push((handle(9), vec![again]));
                }
            }
        }
        held
    }
}

fn text_of(held: &Held) -> String {
    let records = held
        .iter()
        .flat_map(|(_, records)| records.iter().flatten());
    let tags: String = records
        .map(|(code, value)| format!("{code}\n{value}\n"))
        .collect();
    format!("0\nSECTION\n2\nENTITIES\n{tags}0\nENDSEC\n0\nEOF\n")
}

/// A group as tags of DXF.
fn tags(group: &Group) -> Record {
    let (code, value) = group;
    match value {
        GroupValue::Text(text) => vec![(*code, text.clone())],
        GroupValue::Whole(whole) => vec![(*code, whole.to_string())],
        GroupValue::Real(value) if (50..=58).contains(code) => {
            vec![(*code, value.to_degrees().to_string())]
        }
        GroupValue::Real(value) => vec![(*code, value.to_string())],
        GroupValue::Point(at) => {
            let codes = (*code..).step_by(10);
            codes.zip(at.iter().map(f64::to_string)).collect()
        }
    }
}

/// A record without some codes, with others behind the rest.
fn with(record: &Record, codes: &[i16], groups: &[Group]) -> Record {
    let rest = record.iter().filter(|(code, _)| !codes.contains(code));
    rest.cloned().chain(groups.iter().flat_map(tags)).collect()
}

/// What a client makes of the entities that it holds.
fn applied(held: &mut Held, changes: &[EntityChange]) {
    for change in changes {
        match change {
            EntityChange::Remove { handle } => held.retain(|(own, _)| **own != **handle),
            EntityChange::Make { like, groups } => {
                assert!(held.iter().any(|(own, _)| **own == **like), "{like}");
                let record: Record = groups.iter().flat_map(tags).collect();
                held.push((String::new(), vec![record]));
            }
            EntityChange::Set { handle, groups } => {
                let found = held.iter_mut().find(|(own, _)| **own == **handle);
                set(&mut found.expect("a handle of the drawing").1, groups);
            }
        }
    }
}

fn set(records: &mut Vec<Record>, groups: &[Group]) {
    let (kind, groups) = groups.split_first().expect("a kind");
    match &kind.1 {
        GroupValue::Text(kind) if kind == "LWPOLYLINE" => {
            records[0] = with(&records[0], &[90, 70, 43, 10, 20, 40, 41, 42], groups);
        }
        GroupValue::Text(kind) if kind == "POLYLINE" => {
            let (flags, groups) = groups.split_first().expect("flags");
            let vertex = with(&records[1], &[5, 10, 20, 30, 40, 41, 42], &[]);
            let end = records.pop().expect("a SEQEND");
            records.truncate(1);
            records[0] = with(&records[0], &[70], std::slice::from_ref(flags));
            for groups in groups.chunks(4) {
                records.push(with(&vertex, &[], groups));
            }
            records.push(end);
        }
        _ => {
            let codes: Vec<i16> = groups.iter().flat_map(tags).map(|(code, _)| code).collect();
            records[0] = with(&records[0], &codes, groups);
        }
    }
}

/// Each entity by its handle, rounded to what is written; those that are new by what they are.
fn entities(document: &dxf::Document, known: &Held) -> BTreeMap<String, String> {
    let mut all = BTreeMap::new();
    for (_, entity) in document.drawing().entities() {
        let round = |value: f64| (value * 1e9).round() / 1e9 + 0.0;
        let geometry = match &entity.geometry {
            Geometry::Polyline { closed, vertices } => {
                let vertices = vertices.iter();
                let vertices = vertices.map(|it| [it.point.x, it.point.y, it.bulge].map(round));
                format!("{closed} {:?}", vertices.collect::<Vec<_>>())
            }
            Geometry::Line { start, end } => {
                format!("{:?}", [start.x, start.y, end.x, end.y].map(round))
            }
            Geometry::Arc {
                center,
                radius,
                start_angle,
                end_angle,
            } => {
                let turns = [start_angle, end_angle].map(|angle| round(angle.sin()));
                format!("{:?} {turns:?}", [center.x, center.y, *radius].map(round))
            }
            other => format!("{other:?}"),
        };
        let is_known = known.iter().any(|(handle, _)| **handle == *entity.handle);
        let is = format!("{} on {}: {geometry}", entity.kind, entity.layer);
        let key = if is_known {
            entity.handle.to_string()
        } else {
            is.clone()
        };
        all.insert(key, is);
    }
    all
}

/// Compares what the lists make of the entities with the repaired file; the kinds of changes that were made.
fn compared(squares: &[Square]) -> Vec<&'static str> {
    let mut held: Held = Vec::new();
    for (index, square) in squares.iter().enumerate() {
        held.extend(square.held(0x100 + 16 * index, 20.0 * index as f64));
    }
    let before = dxf::Document::read(text_of(&held).into_bytes());
    let document = Document::new(Source::Dxf(before.clone()), Arc::new(Effective::default()));
    let Some(Repairs::OfText { repaired, .. }) = fix_all(&document, &()) else {
        return Vec::new();
    };
    let Source::Dxf(after) = repaired.source() else {
        panic!("a drawing becomes a drawing");
    };
    let changes = after.changes_since(&before);
    let known = held.clone();
    applied(&mut held, &changes);
    let made = dxf::Document::read(text_of(&held).into_bytes());
    assert_eq!(entities(&made, &known), entities(after, &known));
    let kind = |change: &EntityChange| match change {
        EntityChange::Set { .. } => "set",
        EntityChange::Remove { .. } => "remove",
        EntityChange::Make { .. } => "make",
    };
    changes.iter().map(kind).collect()
}

proptest! {
    #[test]
    fn group_lists_repair_as_the_file_is_repaired(squares in squares()) {
        compared(&squares);
    }
}

#[test]
fn group_lists_set_and_remove_entities_of_each_kind() {
    for (kind, double, expected) in [
        (0, false, vec!["set"]),
        (1, false, vec!["set"]),
        (2, false, vec!["set"; 3]),
        (2, true, vec!["set", "set", "set", "remove"]),
    ] {
        let square = Square {
            kind,
            radius: 0.05,
            gap: 0.0,
            double,
            mirrored: false,
        };
        assert_eq!(compared(&[square]), expected, "{kind}");
    }
}
