//! After any edits a document equals a fresh reading of its text; a drawing's edit does in the text what it does in the drawing.

use super::blocks::with_blocks;
use super::layers::with_layers;
use super::reading::dxf;
use crate::drawing::{EntityId, Touched};
use crate::dxf::Document;
use crate::finding::Place;
use proptest::prelude::*;

/// Everything that can be asked of a document, entity ids replaced by the place in the machining order.
fn all_of(document: &Document) -> String {
    let drawing = document.drawing();
    let mut all = format!("{:?}\n", drawing.unit);
    for (order, (id, entity)) in drawing.entities().enumerate() {
        all += &format!(
            "{order} {entity:?} {:?} {:?} {:?} {:?} at {:?}\n",
            drawing.visibility(id),
            drawing.color(id),
            drawing.linetype(id),
            drawing.marks(id).collect::<Vec<_>>(),
            document.range_of(&Place::Entity { entity: id })
        );
        for segment in 0..entity.geometry.segment_count() {
            let range = document.range_of(&Place::Segment {
                entity: id,
                segment,
            });
            let order_of = |id: EntityId| drawing.order().iter().position(|&other| other == id);
            let at: Vec<_> = document
                .segments_at(range.clone())
                .into_iter()
                .map(|(id, segment)| (order_of(id), segment))
                .collect();
            all += &format!("  {segment} at {range:?}: {at:?}\n");
        }
    }
    for finding in document.findings() {
        all += &format!("{finding:?}\n");
    }
    all
}

/// Makes one edit and compares the document with a fresh one; returns what the edit touched.
fn edit(document: &mut Document, range: std::ops::Range<usize>, replacement: &str) -> Vec<Touched> {
    let before = document.drawing().clone();
    let text_before = document.text().as_str_lossy().into_owned();
    let delta = document.edit(range.clone(), replacement);
    let fresh = Document::read(document.text().bytes().to_vec());
    let (edited, fresh) = (all_of(document), all_of(&fresh));
    let only_in = |one: &str, other: &str| {
        one.lines()
            .filter(|line| !other.contains(*line))
            .map(|line| format!("{line}\n"))
            .collect::<String>()
    };
    assert!(
        edited == fresh,
        "after {range:?} of {text_before:?} became {replacement:?}, {delta:?}\nedited:\n{}fresh:\n{}",
        only_in(&edited, &fresh),
        only_in(&fresh, &edited)
    );
    if !delta.touched.contains(&Touched::All) {
        let touched = |id: EntityId| {
            let mut entities = delta.touched.iter().map(Touched::entity);
            entities.any(|entity| entity.is_none_or(|entity| entity == id))
        };
        for (id, entity) in before.entities() {
            assert!(
                touched(id) || document.drawing().get(id) == Some(entity),
                "{id:?} changed in silence"
            );
        }
        for (id, _) in document.drawing().entities() {
            assert!(
                touched(id) || before.get(id).is_some(),
                "{id:?} came in silence"
            );
        }
    }
    delta.touched
}

const DRAWINGS: [&str; 5] = [
    "0 LINE 5 A1 8 DIE 10 1 20 2 11 3 21 4 0 ARC 5 A2 8 DIE 10 1 20 2 40 3 50 30 51 90 0 HATCH 5 A3 8 X 10 1 20 1 \
     0 LWPOLYLINE 5 A4 8 P 90 4 70 1 10 0 20 0 10 10 20 0 42 0.5 10 10 20 10 40 0.5 41 0 10 0 20 10 42 -0.25 210 0 220 0 230 -1 \
     0 CIRCLE 5 A5 10 0 20 0 40 5 0 INSERT 5 A6 2 B 66 1 0 ATTRIB 5 A7 1 X 0 SEQEND 0 TEXT 5 A8 10 1 20 1 1 O",
    "0 LINE 10 1 20 2 11 3 21 4 0 POLYLINE 66 1 70 1 0 VERTEX 10 0 20 0 0 VERTEX 10 1 20 0 42 1 0 VERTEX 10 1 20 5 0 SEQEND \
     0 LINE 10 1 20 2 11 3 21 4 0 SPLINE 10 1 20 1 0 LINE 10 5 20 5 11 6 21 6",
    "0 LINE 5 A 10 1 20 2 11 3 21 4 0 LINE 5 A 10 1 20 2 11 3 21 4 0 LWPOLYLINE 5 A 90 2 10 1 20 2 10 3 20 4 0 CIRCLE 5 B 10 0 20 0 40 1 \
     0 LINE 5 C 10 1,5 20 2 11 3 21 4 0 LINE 5 D 10 1 20 11 3 21 4 8 X 6 Y 0 ARC 5 E 10 1 20 1 40 -1 50 0 51 90",
    "0 LWPOLYLINE 5 A 8 Q 90 9 10 0.5 20 1 10 1.5 20 2 42 1 10 2.5 20 3 10 3.5 20 4 10 4.5 20 5 42 -1 10 5.5 20 6 10 6.5 20 7 10 7.5 20 8 10 8.5 20 9 \
     0 LINE 5 B 10 1 20 2 11 3 21 4",
    "0 POLYLINE 5 A 66 1 70 1 230 -1 0 VERTEX 8 X 10 0.5 20 1 70 0 0 VERTEX 10 1.5 20 2 42 1 0 VERTEX 10 1.5 20 3 30 0 0 VERTEX 10 4.5 20 3 70 16 \
     0 VERTEX 10 5.5 20 3 0 VERTEX 10 5.5 20 2 0 SEQEND \
     0 POLYLINE 5 B 66 1 70 8 0 VERTEX 10 1.5 20 2 30 1 70 32 0 VERTEX 10 1.5 20 3 30 1 42 0 0 VERTEX 10 4.5 20 3 30 1 0 SEQEND",
];

const BLOCKS: &str = "0 BLOCK 2 B 10 1 20 1 0 LINE 8 0 10 1 20 2 11 3 21 4 0 HATCH 8 0 0 ARC 8 C 10 1 20 2 40 3 50 30 51 90 0 ENDBLK \
     0 BLOCK 2 C 10 0 20 0 0 INSERT 2 B 10 1 20 1 41 -1 70 2 44 5 0 SPLINE 8 S 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 0 10 1 20 1 10 2 20 0 0 ENDBLK";
const REFERENCES: &str = "0 LINE 5 A1 10 1 20 2 11 3 21 4 0 INSERT 5 A2 8 P 2 B 10 1 20 2 50 30 1001 WEDM 1000 suppress_gap_so \
     0 LINE 5 A3 8 X 62 1 370 5 6 CONTINUOUS 48 1.5 39 0 60 0 10 1 20 2 30 0 11 3 21 4 31 0 0 LINE 5 A4 10 1 20 2 11 3 21 4 \
     0 LINE 5 A5 8 X 62 1 370 5 6 CONTINUOUS 48 1.5 39 0 60 0 10 1 20 2 30 0 11 3 21 4 31 0 0 LINE 5 A6 10 1 20 2 11 3 21 4 \
     0 ELLIPSE 5 A7 8 X 10 1 20 2 11 3 21 0 40 0.5 41 0 42 3 0 CIRCLE 5 A8 10 1 20 2 40 5 0 INSERT 5 A9 2 C 10 0 20 0 \
     0 INSERT 2 NONE 10 0 20 0 0 SPLINE 5 AA 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 0 10 1 20 1 10 2 20 0 0 POINT 5 AB 10 1 20 2";

const LAYERED: &str = "0 LINE 5 A1 8 COLD 10 1 20 2 11 3 21 4 0 LINE 5 A2 8 DARK 62 1 10 1 20 2 11 3 21 4 0 LINE 5 A3 8 AIDS 10 1 20 2 11 3 21 4 \
     0 LINE 5 A4 8 Q 10 1 20 2 11 3 21 4 0 LINE 5 A5 60 1 62 256 10 1 20 2 11 3 21 4 0 CIRCLE 5 A6 8 cold 420 255 10 1 20 2 40 3 \
     0 LINE 5 A7 8 WEDM_SUPPRESS_gap_so 10 1 20 2 11 3 21 4 1001 ACAD 1000 suppress 1001 WEDM 1070 1 1000 suppress_gap_so 1000 more";

/// An edit as shares of the text, so that it fits every text.
fn any_edit() -> impl Strategy<Value = (f64, usize, String)> {
    let replacement = prop_oneof![
        4 => "[0-9.\\-]{0,2}",
        2 => "[\r\n 0-9A,]{0,3}",
        2 => prop::sample::select(vec![
            "\n0\nLINE\n5\nF1\n10\n7\n20\n7\n11\n8\n21\n8\n", "\n0\nENDSEC\n", "\n0\nSECTION\n2\nENTITIES\n", "\n0\nEOF\n", "\n10\n5\n20\n5\n",
            "\n42\n0.1\n", "\n999\nx\n", "\nx\ny\n", "\n99999\nz\n", "\n0\nPOLYLINE\n", "\n0\nVERTEX\n10\n1\n20\n1\n", "\n5\nA2\n", "\n102\n{X\n",
            "\n1001\nX\n", "\n1001\nWEDM\n1000\nsuppress_gap_x\n", "\r", "\r\n", "\n", "\u{feff}", "\n70\n5\n", "0\nHATCH\n", "nan", "1D2",
        ]).prop_map(str::to_owned),
    ];
    (
        0.0..1.0f64,
        prop_oneof![3 => Just(0usize), 3 => 1usize..3, 1 => 3usize..40],
        replacement,
    )
}

proptest! {
    #[test]
    fn after_any_edits_a_document_is_as_if_read_afresh(
        drawing in 0..DRAWINGS.len() + 4,
        line_end in prop::sample::select(vec!["\n", "\r\n", "\r"]),
        edits in prop::collection::vec(any_edit(), 1..12),
    ) {
        // The last one is longer than any decision looks ahead.
        let long = || (0..60).map(|n| format!("0 LINE 5 A{n:02} 8 X 10 {n} 20 2 11 3 21 4 ")).collect::<String>();
        let text = match DRAWINGS.get(drawing) {
            Some(tags) => dxf(tags),
            None if drawing == DRAWINGS.len() => with_blocks(BLOCKS, REFERENCES),
            None if drawing == DRAWINGS.len() + 1 => with_layers("", LAYERED),
            None if drawing == DRAWINGS.len() + 2 => dxf(&long_polyline()),
            None => dxf(&long()),
        };
        let text = text.replace('\n', line_end);
        let mut document = Document::read(text.into_bytes());
        for (share, length, replacement) in edits {
            let start = (share * document.text().len() as f64) as usize;
            edit(&mut document, start..start + length, &replacement);
        }
    }
}

proptest! {
    /// Few handles for many entities: an edit of one names others anew, far before and behind it.
    #[test]
    fn handles_that_several_entities_state_are_read_as_if_afresh(
        stated in prop::collection::vec(prop::sample::select(vec!["A", "B", "C", "D1"]), 30),
        edits in prop::collection::vec((0..30usize, prop::sample::select(vec!["A", "B", "C", "D1", "E", "0", "Z", ""])), 1..16),
    ) {
        let line = |(at, handle): (usize, &&str)| format!("0 LINE 5 {handle} 8 X 10 {at}00 20 2 11 3 21 4 ");
        let text = dxf(&stated.iter().enumerate().map(line).collect::<String>());
        let mut document = Document::read(text.into_bytes());
        for (at, handle) in edits {
            let text = document.text().as_str_lossy().into_owned();
            let place = text.find(&format!("\n{at}00\n")).unwrap();
            let start = text[..place].rfind("\n5\n").unwrap() + 3;
            let length = text[start..].find('\n').unwrap();
            let is_stated = |handle: &str| handle.bytes().any(|digit| digit != b'0');
            let was_stated = is_stated(&text[start..start + length]);
            let touched = edit(&mut document, start..start + length, handle);
            // Without a handle it is named by its place in the text, and so may others be.
            let is_stated = was_stated && is_stated(handle) && !text.contains("\n5\n0\n") && !text.contains("\n5\n\n");
            prop_assert!(!is_stated || !touched.contains(&Touched::All), "{} of {}", handle, text);
        }
    }
}

/// Replaces the first `what` after the first `after`.
fn replace(document: &mut Document, after: &str, what: &str, by: &str) -> Vec<Touched> {
    let text = document.text().as_str_lossy().into_owned();
    let start = text.find(after).unwrap() + after.len();
    let start = start + text[start..].find(what).unwrap();
    edit(document, start..start + what.len(), by)
}

/// A LWPOLYLINE with more vertices than any decision looks ahead, which states their number.
fn long_polyline() -> String {
    let vertices = (0..60).map(|n| format!("10 {n}.5 20 {}.25 42 0.{n} ", n % 7));
    format!(
        "0 LWPOLYLINE 5 A 8 Q 90 60 70 1 {} 0 LINE 5 B 10 1 20 2 11 3 21 4",
        vertices.collect::<String>()
    )
}

/// An edit of few bytes about a line of the polyline, in the middle of a number or at an end of a line.
fn any_edit_of_a_line() -> impl Strategy<Value = (usize, usize, usize, &'static str)> {
    let texts = [
        "",
        "",
        "1",
        "x",
        "-",
        ".",
        ",",
        "\n",
        "0\n",
        "\n5",
        "10\n1\n20\n2\n",
        "\n42\n0.5",
        "\n90\n7",
        "\n0\nLINE",
    ];
    (
        10usize..400,
        0usize..3,
        0usize..9,
        prop::sample::select(texts.to_vec()),
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn after_edits_of_vertices_a_polyline_is_as_if_read_afresh(edits in prop::collection::vec(any_edit_of_a_line(), 1..16)) {
        let mut document = Document::read(dxf(&long_polyline()).into_bytes());
        for (line, column, length, replacement) in edits {
            let line = document.text().line_range(line.min(document.text().line_count() - 1));
            let start = (line.start + column).min(line.end);
            let end = (start + length).min(document.text().len());
            let before = document.text().slice(start..end).unwrap().to_vec();
            edit(&mut document, start..end, replacement);
            // As often as not it is taken back.
            if length % 2 == 0 {
                let before = String::from_utf8(before).unwrap();
                edit(&mut document, start..start + replacement.len(), &before);
            }
        }
    }
}

#[test]
fn an_edit_of_a_polyline_touches_the_vertices_about_it() {
    let mut document = Document::read(dxf(&long_polyline()).into_bytes());
    let entity = document.drawing().find("A").unwrap();
    let vertices = |start, removed, inserted| {
        [Touched::Vertices {
            entity,
            start,
            removed,
            inserted,
        }]
    };
    let mut replace = |after: &str, what: &str, by: &str| replace(&mut document, after, what, by);
    // Without its x a vertex is a part of the one before.
    assert_eq!(
        replace("0.29\n", "10\n30.5", "110\n30.5"),
        vertices(29, 2, 1)
    );
    assert_eq!(
        replace("0.29\n", "110\n30.5", "10\n30.5"),
        vertices(29, 1, 2)
    );
    // What is damaged and comes back is the same entity.
    let gone = [Touched::Removed { entity }];
    for (what, by) in [
        ("10\n", "x10\n"),
        ("30.5", "30.x5"),
        ("20\n", "20"),
        ("42\n", "42\n\n"),
    ] {
        assert_eq!(replace("0.29\n", what, by), gone, "{what:?}");
        let back = replace("0.29\n", by, what);
        assert!(
            matches!(
                back[..],
                [Touched::Vertices {
                    removed: 0,
                    inserted: 0,
                    ..
                }]
            ),
            "{what:?} {back:?}"
        );
    }
    assert_eq!(replace("0.29\n", "10\n", "x10\n"), gone);
    assert_eq!(replace("0.31\n", "10\n", "y10\n"), []);
    assert_eq!(replace("0.29\n", "x10\n", "10\n"), []);
    assert_eq!(replace("0.31\n", "y10\n32.5", "10\n31"), vertices(32, 1, 1));
    assert_eq!(
        replace("0.31\n", "10\n", "10\n7\n20\n7\n10\n"),
        vertices(32, 0, 1)
    );
}

#[test]
fn an_edit_touches_no_more_than_it_must() {
    let mut document = Document::read(dxf(DRAWINGS[0]).into_bytes());
    let [line, arc, polyline] =
        ["A1", "A2", "A4"].map(|handle| document.drawing().find(handle).unwrap());
    let vertex = |start| Touched::Vertices {
        entity: polyline,
        start,
        removed: 1,
        inserted: 1,
    };
    assert_eq!(
        replace(&mut document, "A1\n", "10\n1", "10\n1.5"),
        [Touched::Entity { entity: line }]
    );
    assert_eq!(
        replace(&mut document, "A2\n", "40\n3", "40\n4"),
        [Touched::Entity { entity: arc }]
    );
    assert_eq!(replace(&mut document, "A4\n", "0.5", "0.75"), [vertex(1)]);
    assert_eq!(
        replace(&mut document, "A4\n", "20\n10\n40", "20\n11\n42\n1\n40"),
        [vertex(2)]
    );
    assert_eq!(replace(&mut document, "A4\n", "42\n1\n", ""), [vertex(2)]);
    assert_eq!(replace(&mut document, "A3\n", "10\n1", "10\n2"), []);
    assert_eq!(
        replace(&mut document, "A2\n", "40\n4", "40\n"),
        [Touched::Removed { entity: arc }]
    );
    let arc = EntityId(document.drawing().id_bound() as u32);
    assert_eq!(
        replace(&mut document, "A2\n", "40\n", "40\n4"),
        [Touched::Entity { entity: arc }]
    );
    let mut document = Document::read(dxf(DRAWINGS[4]).into_bytes());
    let polyline = document.drawing().find("A").unwrap();
    let vertex = Touched::Vertices {
        entity: polyline,
        start: 1,
        removed: 1,
        inserted: 1,
    };
    assert_eq!(
        replace(&mut document, "VERTEX\n10\n1.5\n20\n", "42\n1", "42\n1.5"),
        [vertex]
    );
}

#[test]
fn an_edit_beside_blocks_touches_no_more_than_it_must() {
    let mut document = Document::read(with_blocks(BLOCKS, REFERENCES).into_bytes());
    let [line, ellipse] = ["A5", "A7"].map(|handle| document.drawing().find(handle).unwrap());
    assert_eq!(replace(&mut document, "A5\n", "31\n0", "31\n0.0"), []);
    assert_eq!(
        replace(&mut document, "A5\n", "21\n4", "21\n5"),
        [Touched::Entity { entity: line }]
    );
    assert_eq!(
        replace(&mut document, "A7\n", "40\n0.5", "40\n0.25"),
        [Touched::Entity { entity: ellipse }]
    );
    assert!(!document.drawing().is_editable(ellipse));
    let is_part = |(_, entity): &(EntityId, &crate::drawing::Entity)| &*entity.handle == "A2";
    let parts = document.drawing().entities().filter(is_part);
    let parts: Vec<Touched> = parts
        .map(|(entity, _)| Touched::Entity { entity })
        .collect();
    assert_eq!(parts.len(), 2);
    assert_eq!(replace(&mut document, "A2\n", "30", "30.0"), []);
    assert_eq!(replace(&mut document, "A2\n", "30.0", "45"), parts);
    for (what, by) in [("50\n45", "41\n2"), ("2\nB", "2\nC"), ("10\n1", "10\nx")] {
        assert_eq!(replace(&mut document, "A2\n", what, by), [Touched::All]);
    }
    assert_eq!(
        replace(&mut document, "BLOCKS\n", "11\n3", "11\n5"),
        [Touched::All]
    );
}

#[test]
fn edits_that_once_went_wrong() {
    for (drawing, after, what, by) in [
        (0, "A6\n", "B\n66\n1\n0\nATTRIB\n5\nA7\n1", "-"),
        (0, "41\n0\n10\n", "", "-"),
        (1, "20\n0\n0", "\nVERTEX\n", ""),
        (1, "VERTEX\n10\n0\n20\n0", "\n0\nVERTEX", ""),
        (4, "70\n32", "", "."),
        (4, "70\n16", "", "."),
    ] {
        replace(
            &mut Document::read(dxf(DRAWINGS[drawing]).into_bytes()),
            after,
            what,
            by,
        );
    }
}
