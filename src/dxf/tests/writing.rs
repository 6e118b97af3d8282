//! Written text reads back the same: edits of a drawing in its text, and new drawings.

use super::reading::dxf;
use crate::drawing::{Change, Drawing, DrawingEdit, Entity, Geometry, Kind, Unit, Vertex};
use crate::dxf::{Document, write};
use crate::geometry::{Point, positive_angle};
use proptest::prelude::*;
use std::f64::consts::TAU;

#[test]
fn the_same_drawing_is_the_same_file() {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let circle = Geometry::Circle {
        center: Point::new(1.0, 2.0),
        radius: 3.0,
    };
    drawing.push(Entity::new("1", "0", circle));
    let written = write(&drawing).unwrap();
    std::thread::sleep(std::time::Duration::from_millis(20));
    assert_eq!(write(&drawing).unwrap(), written);
    let text = String::from_utf8(written).unwrap();
    assert!(!text.contains("GUID") && !text.contains("$TD"), "{text}");
}

/// Asserts that two drawings hold the same within 1e-11, angles modulo a turn; handles and kinds only where asked.
fn assert_same(left: &Drawing, right: &Drawing, with_handles: bool) {
    assert_eq!(left.len(), right.len());
    let near = |a: f64, b: f64| (a - b).abs() < 1e-11 * a.abs().max(1.0);
    let near_point = |a: &Point, b: &Point| near(a.x, b.x) && near(a.y, b.y);
    let near_angle = |a: f64, b: f64| {
        let apart = positive_angle(a - b);
        apart.min(TAU - apart) < 1e-11
    };
    for ((_, a), (_, b)) in left.entities().zip(right.entities()) {
        let same = match (&a.geometry, &b.geometry) {
            (
                Geometry::Polyline { closed, vertices },
                Geometry::Polyline {
                    closed: other_closed,
                    vertices: others,
                },
            ) => {
                let pairs = || vertices.iter().zip(others);
                closed == other_closed
                    && vertices.len() == others.len()
                    && pairs()
                        .all(|(v, w)| near_point(&v.point, &w.point) && near(v.bulge, w.bulge))
            }
            (Geometry::Line { start, end }, Geometry::Line { start: s, end: e }) => {
                near_point(start, s) && near_point(end, e)
            }
            (
                Geometry::Arc {
                    center,
                    radius,
                    start_angle,
                    end_angle,
                },
                Geometry::Arc {
                    center: c,
                    radius: r,
                    start_angle: s,
                    end_angle: e,
                },
            ) => {
                near_point(center, c)
                    && near(*radius, *r)
                    && near_angle(*start_angle, *s)
                    && near_angle(*end_angle, *e)
            }
            (
                Geometry::Circle { center, radius },
                Geometry::Circle {
                    center: c,
                    radius: r,
                },
            ) => near_point(center, c) && near(*radius, *r),
            (Geometry::Text { at, text }, Geometry::Text { at: a, text: t }) => {
                near_point(at, a) && text == t
            }
            _ => false,
        };
        assert!(
            same && a.layer == b.layer
                && (!with_handles || (a.handle == b.handle && a.kind == b.kind)),
            "{a:?}\n{b:?}"
        );
    }
}

/// The text after the edit.
fn edited(document: &Document, edit: &DrawingEdit) -> Vec<u8> {
    let edits = document.text_edits(edit).unwrap();
    let mut bytes = document.text().bytes().to_vec();
    assert!(
        edits
            .windows(2)
            .all(|pair| pair[0].range.end <= pair[1].range.start),
        "{edits:?}"
    );
    for edit in edits.iter().rev() {
        bytes.splice(edit.range.clone(), edit.text.bytes());
    }
    bytes
}

const DRAWING: &str = "0 LINE 5 A1 8 DIE 10 1 20 2 11 3 21 4 0 ARC 5 A2 8 DIE 10 1 20 2 40 3 50 30 51 90 \
     0 LWPOLYLINE 5 A4 8 P 90 5 70 1 10 0 20 0 10 10 20 0 42 0.5 10 10 20 10 40 0 41 0 10 0 20 10 42 -0.25 10 -3 20 5 210 0 220 0 230 -1 \
     0 ARC 5 A5 10 1 20 2 40 3 50 30 51 90 230 -1 \
     0 POLYLINE 5 B 66 1 70 1 0 VERTEX 10 0 20 0 30 0 0 VERTEX 10 1 20 0 42 1 0 VERTEX 10 1 20 5 0 VERTEX 10 0 20 5 0 SEQEND \
     0 LWPOLYLINE 5 C 8 P 90 3 70 0 10 0 20 0 10 10 20 0 10 10 20 10";

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![-1000.0..1000.0f64, Just(0.0), Just(1.0), -1e-6..1e-6f64]
}

fn change() -> impl Strategy<Value = (usize, usize, [f64; 5], u8)> {
    (
        0..6usize,
        0..5usize,
        [number(), number(), number(), number(), number()],
        0..12u8,
    )
}

proptest! {
    #[test]
    fn an_edit_does_in_the_text_what_it_does_in_the_drawing(
        line_end in prop::sample::select(vec!["\n", "\r\n"]),
        changes in prop::collection::vec(change(), 1..5),
    ) {
        let document = Document::read(dxf(DRAWING).replace('\n', line_end).into_bytes());
        let drawing = document.drawing();
        let mut edit = DrawingEdit::default();
        let mut seen = std::collections::HashSet::new();
        for (which, index, [x, y, z, u, v], kind) in changes {
            let entity = drawing.order()[which];
            let first = seen.insert((which, 99));
            match &drawing.get(entity).unwrap().geometry {
                _ if kind == 0 && first => edit.changes.push(Change::RemoveEntity { entity }),
                _ if kind == 2 => {
                    let geometry = Geometry::Line { start: Point::new(x, y), end: Point::new(z, u) };
                    edit.changes.push(Change::AddEntity { after: entity, geometry });
                }
                _ if kind == 3 => {
                    let geometry = Geometry::Arc { center: Point::new(x, y), radius: z.abs() + 0.1, start_angle: u, end_angle: v };
                    edit.changes.push(Change::AddEntity { after: entity, geometry });
                }
                Geometry::Polyline { vertices, .. } if kind == 4 || kind == 5 => {
                    let index = index % (vertices.len() + 1);
                    if !edit.changes.contains(&Change::RemoveVertex { entity, index }) && seen.insert((which, index)) {
                        edit.changes.push(Change::InsertVertex { entity, index, vertex: Vertex::new(x, y, z / 100.0) });
                    }
                }
                Geometry::Polyline { .. } if kind == 6 => edit.changes.push(Change::SetClosed { entity, closed: index > 1 }),
                Geometry::Polyline { vertices, .. } => {
                    let index = index % vertices.len();
                    let removed = edit.changes.iter().any(|change| change.entity() == entity && matches!(change, Change::RemoveVertex { .. }));
                    if kind == 1 && !removed && seen.insert((which, index)) {
                        edit.changes.push(Change::RemoveVertex { entity, index });
                    } else if seen.insert((which, index)) {
                        edit.changes.push(Change::SetVertex { entity, index, vertex: Vertex::new(x, y, z / 100.0) });
                    }
                }
                Geometry::Line { .. } => edit.changes.push(Change::Reshape { entity, geometry: Geometry::Line { start: Point::new(x, y), end: Point::new(z, u) } }),
                _ => edit.changes.push(Change::Reshape { entity, geometry: Geometry::Arc { center: Point::new(x, y), radius: z.abs() + 0.1, start_angle: u, end_angle: v } }),
            }
        }
        let mut expected = Drawing::clone(drawing);
        let gone = |edit: &DrawingEdit, change: &Change| edit.changes.contains(&Change::RemoveEntity { entity: change.entity() });
        let sensible = DrawingEdit {
            changes: edit.changes.iter().filter(|change| !gone(&edit, change) || matches!(change, Change::RemoveEntity { .. } | Change::AddEntity { .. })).cloned().collect(),
        };
        expected.apply(&sensible).unwrap();
        let again = Document::read(edited(&document, &edit));
        assert_same(&expected, again.drawing(), false);
        let old = |entity: &&Entity| drawing.find(&entity.handle).is_some();
        let named = |of: &Drawing| of.entities().map(|(_, entity)| (entity.handle.clone(), entity.kind)).collect::<Vec<_>>();
        let kept = |of: &Drawing| of.entities().map(|(_, entity)| entity).filter(old).map(|entity| (entity.handle.clone(), entity.kind)).collect::<Vec<_>>();
        prop_assert_eq!(kept(&expected), kept(again.drawing()));
        prop_assert!(named(again.drawing()).iter().all(|(handle, _)| !handle.contains('#')));
        prop_assert_eq!(again.findings(), document.findings());
    }

    #[test]
    fn a_new_drawing_reads_back(
        vertices in prop::collection::vec((number(), number(), -3.0..3.0f64), 2..20),
        numbers in [number(), number(), number(), number(), number()],
        closed: bool,
        inch: bool,
    ) {
        let mut drawing = Drawing::new(Some(if inch { Unit::INCH } else { Unit::MILLIMETRE }));
        let [x, y, z, u, v] = numbers;
        let vertices = vertices.into_iter().map(|(x, y, bulge)| Vertex::new(x, y, bulge)).collect();
        for (kind, layer, geometry) in [
            (Kind::LightPolyline, "DIE", Geometry::Polyline { closed, vertices }),
            (Kind::Line, "PUNCH", Geometry::Line { start: Point::new(x, y), end: Point::new(z, u) }),
            (Kind::Arc, "0", Geometry::Arc { center: Point::new(x, y), radius: z.abs() + 0.01, start_angle: u, end_angle: v }),
            (Kind::Circle, "0", Geometry::Circle { center: Point::new(x, y), radius: z.abs() + 0.01 }),
            (Kind::Text, "märks", Geometry::Text { at: Point::new(x, y), text: "O".into() }),
        ] {
            drawing.push(Entity { handle: kind.name().into(), layer: layer.into(), role: None, kind, geometry });
        }
        let document = Document::read(write(&drawing).unwrap());
        prop_assert_eq!(document.findings(), &[][..]);
        prop_assert_eq!(document.drawing().unit, drawing.unit);
        assert_same(&drawing, document.drawing(), false);
    }
}

#[test]
fn what_is_new_looks_like_what_stands_beside_it() {
    let line = "  0\r\nLINE\r\n  5\r\n2F\r\n330\r\n1F\r\n100\r\nAcDbEntity\r\n  8\r\nDIE\r\n 62\r\n     3\r\n100\r\nAcDbLine\r\n 10\r\n0.0\r\n 20\r\n0.0\r\n 30\r\n0.0\r\n 11\r\n1.0\r\n 21\r\n0.0\r\n 31\r\n0.0\r\n";
    let text =
        format!("  0\r\nSECTION\r\n  2\r\nENTITIES\r\n{line}  0\r\nENDSEC\r\n  0\r\nEOF\r\n");
    let document = Document::read(text.clone().into());
    let after = document.drawing().order()[0];
    let geometry = Geometry::Arc {
        center: Point::new(1.0, 0.5),
        radius: 0.5,
        start_angle: -TAU / 4.0,
        end_angle: 0.0,
    };
    let edit = DrawingEdit {
        changes: vec![Change::AddEntity { after, geometry }],
    };
    let arc = "  0\r\nARC\r\n  5\r\n30\r\n330\r\n1F\r\n100\r\nAcDbEntity\r\n  8\r\nDIE\r\n 62\r\n     3\r\n100\r\nAcDbCircle\r\n 10\r\n1.0\r\n 20\r\n0.5\r\n 30\r\n0.0\r\n 40\r\n0.5\r\n100\r\nAcDbArc\r\n 50\r\n270.0\r\n 51\r\n0.0\r\n";
    assert_eq!(
        String::from_utf8(edited(&document, &edit)).unwrap(),
        text.replace(line, &format!("{line}{arc}"))
    );
}

#[test]
fn what_is_new_stands_before_empty_lines_at_the_end_of_a_text_that_breaks_off() {
    let arc = "0\nSECTION\n2\nENTITIES\n0\nARC\n8\nDIE\n10\n1\n20\n2\n40\n3\n50\n30\n51\n90";
    for (end, kept) in [("\n", "\n"), ("\n\n", "\n")] {
        let document = Document::read(format!("{arc}{end}").into());
        let after = document.drawing().order()[0];
        let geometry = Geometry::Line {
            start: Point::new(1.0, 5.0),
            end: Point::new(3.5, 3.5),
        };
        let text = edited(
            &document,
            &DrawingEdit {
                changes: vec![Change::AddEntity { after, geometry }],
            },
        );
        assert!(
            String::from_utf8_lossy(&text).starts_with(&format!("{arc}{kept}0\nLINE\n")),
            "{end:?}"
        );
        assert_eq!(Document::read(text).drawing().len(), 2, "{end:?}");
    }
}

#[test]
fn a_vertex_behind_the_last_one_comes_behind_the_bulge_that_the_last_one_gets() {
    for z in ["", "30\n7\n"] {
        let text = format!(
            "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n10\n0\n20\n0\n10\n1\n20\n2\n{z}0\nENDSEC\n0\nEOF\n"
        );
        let document = Document::read(text.into());
        let entity = document.drawing().order()[0];
        let last = Vertex {
            point: Point::new(1.0, 2.0),
            bulge: 0.5,
        };
        let new = Vertex {
            point: Point::new(3.0, 4.0),
            bulge: 0.0,
        };
        let edit = DrawingEdit {
            changes: vec![
                Change::SetVertex {
                    entity,
                    index: 1,
                    vertex: last,
                },
                Change::InsertVertex {
                    entity,
                    index: 2,
                    vertex: new,
                },
            ],
        };
        let after = Document::read(edited(&document, &edit));
        let mut wanted = Drawing::clone(document.drawing());
        wanted.apply(&edit).unwrap();
        let geometry =
            |drawing: &Drawing| drawing.get(drawing.order()[0]).unwrap().geometry.clone();
        assert_eq!(geometry(after.drawing()), geometry(&wanted), "{z:?}");
    }
}

#[test]
fn only_the_numbers_that_change_are_touched() {
    let text = "  0\r\nSECTION\r\n  2\r\nENTITIES\r\n  0\r\nLWPOLYLINE\r\n  5\r\nA\r\n 90\r\n        2\r\n 10\r\n 1.50\r\n 20\r\n2.0 \r\n 10\r\n3.0\r\n 20\r\n4.0\r\n  0\r\nENDSEC\r\n  0\r\nEOF\r\n";
    let document = Document::read(text.into());
    let entity = document.drawing().order()[0];
    let edit = |vertex| DrawingEdit {
        changes: vec![Change::SetVertex {
            entity,
            index: 0,
            vertex,
        }],
    };
    for (vertex, from, to) in [
        (Vertex::new(1.5, 2.0, 0.0), "", ""),
        (Vertex::new(1.25, 2.0, 0.0), " 1.50\r\n", " 1.25\r\n"),
        (
            Vertex::new(1.5, 1.0 / 3.0, 0.0),
            "2.0 \r\n",
            "0.333333333333 \r\n",
        ),
        (
            Vertex::new(1.5, 2.0, -0.25),
            "2.0 \r\n",
            "2.0 \r\n 42\r\n-0.25\r\n",
        ),
    ] {
        let expected = text.replacen(from, to, usize::from(!from.is_empty()));
        assert_eq!(
            String::from_utf8(edited(&document, &edit(vertex))).unwrap(),
            expected
        );
    }
    let refused = |edit: &DrawingEdit| document.text_edits(edit).unwrap_err();
    assert_eq!(
        refused(&edit(Vertex::new(f64::NAN, 0.0, 0.0))),
        "group code 10 of LWPOLYLINE A cannot be NaN"
    );
    let removal = DrawingEdit {
        changes: vec![Change::RemoveVertex { entity, index: 1 }],
    };
    assert_eq!(
        refused(&removal),
        "LWPOLYLINE A would be left with fewer than two vertices"
    );
    let beyond = DrawingEdit {
        changes: vec![Change::RemoveVertex { entity, index: 2 }],
    };
    assert_eq!(
        refused(&beyond),
        "vertex 2 of LWPOLYLINE A is out of range, the polyline has 2"
    );
}

#[test]
fn a_polyline_in_space_takes_no_bulge() {
    let document =
        Document::read(dxf("0 POLYLINE 5 A 70 8 0 VERTEX 10 0 20 0 42 0 0 VERTEX 10 1 20 0 0 VERTEX 10 1 20 1 0 SEQEND").into_bytes());
    let entity = document.drawing().order()[0];
    for change in [
        Change::SetVertex {
            entity,
            index: 0,
            vertex: Vertex::new(0.0, 0.0, 0.5),
        },
        Change::InsertVertex {
            entity,
            index: 1,
            vertex: Vertex::new(0.0, 0.0, 0.5),
        },
    ] {
        let edit = DrawingEdit {
            changes: vec![change],
        };
        assert_eq!(
            document.text_edits(&edit).unwrap_err(),
            "POLYLINE A is a 3D polyline and cannot take the bulge"
        );
        assert!(Drawing::clone(document.drawing()).apply(&edit).is_err());
    }
}

#[test]
fn lines_neither_come_nor_go_where_the_text_is_damaged() {
    // The reader resumes after the damage by the lines that the edit would remove.
    let damaged = dxf(
        "0 LINE 5 A 10 1 20 2 11 3 2INE 0 LINE 5 B 10 1 20 2 11 3 21 4 0 LINE 5 C 10 1 20 2 11 3 21 4",
    );
    let document = Document::read(damaged.into_bytes());
    let entity = document.drawing().find("B").unwrap();
    let removal = DrawingEdit {
        changes: vec![Change::RemoveEntity { entity }],
    };
    let refusal = document.text_edits(&removal).unwrap_err();
    assert_eq!(
        refusal,
        "lines would be added or removed near line 25, which is damaged: repair that first"
    );
    let shift = Change::Reshape {
        entity,
        geometry: Geometry::Line {
            start: Point::new(0.0, 0.0),
            end: Point::new(3.0, 4.0),
        },
    };
    assert_eq!(
        document
            .text_edits(&DrawingEdit {
                changes: vec![shift]
            })
            .unwrap()
            .len(),
        2
    );
}
