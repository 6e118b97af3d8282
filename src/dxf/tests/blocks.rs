//! Block references: where the parts of a block end up, and what is refused.

use super::reading::{entities, findings};
use crate::dxf::Document;
use crate::finding::Place;

/// A text with a section BLOCKS; tags with spaces between.
pub(super) fn with_blocks(blocks: &str, entities: &str) -> String {
    let section = |name: &str, tags: &str| format!("0 SECTION 2 {name} {tags} 0 ENDSEC ");
    let all = format!(
        "{}{}{}0 EOF",
        section("HEADER", "9 $INSUNITS 70 4"),
        section("BLOCKS", blocks),
        section("ENTITIES", entities)
    );
    all.split_whitespace()
        .map(|tag| format!("{tag}\n"))
        .collect()
}

/// A slot: a line and a half circle, from a base point of (1, 0).
const SLOT: &str = "0 BLOCK 2 Slot 10 1 20 0 0 LINE 8 0 10 1 20 0 11 3 21 0 0 ARC 8 CUT 10 3 20 1 40 1 50 270 51 90 0 ENDBLK ";

fn check(blocks: &str, tags: &str, expected_entities: &[&str], expected_findings: &[&str]) {
    let document = Document::read(with_blocks(blocks, tags).into_bytes());
    assert_eq!(entities(&document), expected_entities, "in {tags}");
    assert_eq!(findings(&document), expected_findings, "in {tags}");
    for (id, entity) in document
        .drawing()
        .entities()
        .filter(|(_, entity)| &*entity.handle == "A")
    {
        assert!(!document.drawing().is_editable(id));
        let place = document.range_of(&Place::Segment {
            entity: id,
            segment: 0,
        });
        assert_eq!(
            &document.text().bytes()[place],
            b"INSERT",
            "{}",
            entity.kind
        );
    }
}

#[test]
fn where_the_parts_come_to_lie() {
    for (tags, line, arc) in [
        ("10 10 20 20", "10 20 to 12 20", "12 21 R1 270 90"),
        ("10 0 20 0 41 2 42 2", "0 0 to 4 0", "4 2 R2 270 90"),
        ("10 0 20 0 50 90", "0 0 to 0 2", "-1 2 R1 360 180"),
        ("10 0 20 0 41 -1", "0 0 to -2 0", "-2 1 R1 90 -90"),
        ("10 0 20 0 42 -1", "0 0 to 2 0", "2 -1 R1 -90 -270"),
        ("10 5 20 0 230 -1", "-5 0 to -7 0", "-7 1 R1 90 -90"),
        ("10 5 20 0 50 90 230 -1", "-5 0 to -5 2", "-4 2 R1 0 -180"),
    ] {
        let [line, arc] = [
            format!("LINE A on P: {line}"),
            format!("ARC A on CUT: {arc}"),
        ];
        check(
            SLOT,
            &format!("0 INSERT 5 A 8 P 2 SLOT {tags}"),
            &[&line, &arc],
            &[],
        );
    }
}

#[test]
fn what_blocks_do_not_give_to_the_drawing_is_named() {
    let circle = |radius: u8| format!("0 CIRCLE 8 0 10 0 20 0 40 {radius}");
    let named = |why: &str| format!(r#"information at "CIRCLE": 1 CIRCLE: {why}"#);
    let in_modelspace =
        named("it is in the block of the modelspace instead of the section ENTITIES");
    for (name, expected) in [
        ("*Model_Space", vec![in_modelspace.as_str()]),
        ("$MODEL_SPACE", vec![&in_modelspace]),
        ("*Paper_Space3", vec![&named("it lies in paper space")]),
        ("Model_Space", vec![]),
    ] {
        check(
            &format!("0 BLOCK 2 {name} 10 0 20 0 {} 0 ENDBLK", circle(1)),
            "0 LINE 5 B 10 0 20 0 11 1 21 0",
            &["LINE B on 0: 0 0 to 1 0"],
            &expected,
        );
    }
    let twice = format!(
        "0 BLOCK 2 B 10 0 20 0 {} 0 ENDBLK 0 BLOCK 2 b 10 0 20 0 {} 0 ENDBLK",
        circle(1),
        circle(2)
    );
    let said = r#"warning at "b": a block of this name comes before this one: that one is drawn"#;
    check(
        &twice,
        "0 INSERT 5 A 2 B 10 0 20 0",
        &["CIRCLE A on 0: 0 0 R1"],
        &[said],
    );
}

#[test]
fn arrays_step_along_the_turned_axes_and_are_not_scaled() {
    check(
        "0 BLOCK 2 B 10 0 20 0 0 CIRCLE 8 0 10 1 20 0 40 1 0 ENDBLK",
        "0 INSERT 5 A 8 P 2 b 10 0 20 0 41 2 42 2 50 90 70 2 71 2 44 10 45 20",
        &[
            "CIRCLE A on P: 0 2 R2",
            "CIRCLE A on P: 0 12 R2",
            "CIRCLE A on P: -20 2 R2",
            "CIRCLE A on P: -20 12 R2",
        ],
        &[],
    );
}

#[test]
fn blocks_in_blocks_mirrored_against_a_transform_by_hand() {
    // Outer: turned by 90°, at (100, 0). Inner: mirrored in x, at (10, 0), base (1, 0).
    // (1, 0) -> (0, 0) -> (10, 0) -> (100, 10); (3, 0) -> (-2 + 10, 0) = (8, 0) -> (100, 8); centre (3, 1) -> (8, 1) -> (99, 8).
    let outer = "0 BLOCK 2 OUTER 10 0 20 0 0 INSERT 8 0 2 SLOT 10 10 20 0 41 -1 0 ENDBLK ";
    let expected = [
        "LINE A on P: 100 10 to 100 8",
        "ARC A on CUT: 99 8 R1 -180 -360",
    ];
    check(
        &format!("{SLOT}{outer}"),
        "0 INSERT 5 A 8 P 2 OUTER 10 100 20 0 50 90",
        &expected,
        &[],
    );
    check(
        &format!("{outer}{SLOT}"),
        "0 INSERT 5 A 8 P 2 OUTER 10 100 20 0 50 90",
        &expected,
        &[],
    );
}

#[test]
fn unlike_scales_make_ellipses() {
    let block = "0 BLOCK 2 B 10 0 20 0 0 CIRCLE 8 0 10 0 20 0 40 1 0 LWPOLYLINE 8 0 90 2 10 0 20 0 42 1 10 2 20 0 10 4 20 0 0 ENDBLK";
    let document =
        Document::read(with_blocks(block, "0 INSERT 5 A 8 P 2 B 10 0 20 0 41 3 42 1").into_bytes());
    let kinds: Vec<_> = document
        .drawing()
        .entities()
        .map(|(_, entity)| (entity.kind.name(), entity.geometry.is_closed()))
        .collect();
    assert_eq!(
        kinds,
        [("ELLIPSE", true), ("ELLIPSE", false), ("LINE", false)]
    );
    for (_, entity) in document.drawing().entities().take(1) {
        for segment in entity.geometry.segments() {
            for point in [segment.start(), segment.point_at(0.5)] {
                let along = ((point.x / 3.0).powi(2) + point.y.powi(2)).sqrt();
                assert!((along - 1.0).abs() < 1e-3, "{point} is not on the ellipse");
            }
        }
    }
}

#[test]
fn what_would_never_end_is_refused() {
    let block = |name: &str, tags: &str| format!("0 BLOCK 2 {name} 10 0 20 0 {tags} 0 ENDBLK ");
    let line = "0 LINE 5 B 10 0 20 0 11 1 21 1";
    let read = "LINE B on 0: 0 0 to 1 1";
    let cycle = block("X", "0 INSERT 2 Y 10 0 20 0") + &block("Y", "0 INSERT 2 X 10 0 20 0");
    let tower: String = (0..30)
        .map(|n| {
            block(
                &format!("N{n}"),
                &format!(
                    "0 INSERT 2 N{m} 10 0 20 0 0 INSERT 2 N{m} 10 1 20 0",
                    m = n + 1
                ),
            )
        })
        .collect::<String>()
        + &block("N30", "0 LINE 10 0 20 0 11 1 21 1");
    let deep: String = (0..200)
        .map(|n| {
            block(
                &format!("N{n}"),
                &format!("0 INSERT 2 N{} 10 0 20 0", n + 1),
            )
        })
        .collect();
    for (blocks, insert, finding) in [
        (
            "",
            "2 NONE",
            r#"error at "NONE": the block is not in the file: nothing is drawn for this INSERT"#,
        ),
        (
            &*cycle,
            "2 X",
            r#"error at "X": the block "X" contains itself: nothing is drawn for this INSERT"#,
        ),
        (
            SLOT,
            "2 SLOT 70 30000 71 30000",
            r#"error at "SLOT": this INSERT draws 900000000 copies, 2700000000 segments in all, more than the 200000 that the references of a file may come to: nothing is drawn for it"#,
        ),
        (
            &*tower,
            "2 N0",
            r#"error at "N0": this INSERT draws 1 copies, 3221225471 segments in all, more than the 200000 that the references of a file may come to: nothing is drawn for it"#,
        ),
        (
            &*deep,
            "2 N0",
            r#"error at "N0": blocks within blocks are more than 64 deep here: nothing is drawn for this INSERT"#,
        ),
    ] {
        check(
            blocks,
            &format!("0 INSERT 5 C {insert} 10 0 20 0 {line}"),
            &[read],
            &[finding],
        );
    }
}

#[test]
fn what_a_block_holds_and_is_not_cut_is_named_where_it_is_drawn() {
    let blocks = "0 BLOCK 2 B 10 0 20 0 0 HATCH 8 0 0 LINE 8 0 10 0 20 0 11 1 21 1 0 ENDBLK 0 BLOCK 2 UNUSED 10 0 20 0 0 3DFACE 8 0 0 ENDBLK";
    let finding = r#"information at "HATCH": 1 HATCH: what it fills is cut along lines and arcs that are drawn round it; its own boundary is not read (draw it in CAD: HATCHEDIT, recreate boundary)"#;
    check(
        blocks,
        "0 INSERT 5 A 8 P 2 B 10 0 20 0",
        &["LINE A on P: 0 0 to 1 1"],
        &[finding],
    );
    check(
        blocks,
        "0 LINE 5 B 10 0 20 0 11 1 21 1",
        &["LINE B on 0: 0 0 to 1 1"],
        &[],
    );
}

#[test]
fn blocks_that_follow_their_references_are_found() {
    let text = with_blocks(SLOT, "0 INSERT 5 A 8 P 2 SLOT 10 10 20 20");
    let blocks_at = text.find("0\nSECTION\n2\nBLOCKS").unwrap();
    let entities_at = text.find("0\nSECTION\n2\nENTITIES").unwrap();
    let end = text.rfind("0\nEOF").unwrap();
    let turned = [
        &text[..blocks_at],
        &text[entities_at..end],
        &text[blocks_at..entities_at],
        &text[end..],
    ]
    .concat();
    let (read, turned) = (
        Document::read(text.into_bytes()),
        Document::read(turned.into_bytes()),
    );
    assert_eq!(entities(&turned), entities(&read));
    assert!(turned.findings().is_empty());
}

#[test]
fn a_block_that_grows_behind_what_refers_to_it_is_drawn_whole() {
    let insert = "0 SECTION 2 ENTITIES 0 INSERT 5 A 8 P 2 B 10 0 20 0 0 ENDSEC ";
    let block = "0 SECTION 2 BLOCKS 0 BLOCK 2 B 10 0 20 0 0 LINE 8 0 10 0 20 0 11 1 21 1 0 ENDSEC ";
    let text = |more: &str| {
        let tags = format!(
            "{block}{insert}0 SECTION 2 BLOCKS {more} 0 ENDSEC {} 0 EOF",
            insert.replace("5 A", "5 C")
        );
        tags.split_whitespace()
            .map(|tag| format!("{tag}\n"))
            .collect::<String>()
    };
    let document = Document::read(text("0 CIRCLE 8 0 10 1 20 0 40 1").into_bytes());
    assert_eq!(entities(&document).len(), 4, "{:?}", entities(&document));
    // It came to contain itself after its size had been found.
    let document = Document::read(text("0 INSERT 8 0 2 B 10 0 20 0").into_bytes());
    assert!(entities(&document).is_empty());
    assert_eq!(
        findings(&document)
            .iter()
            .filter(|finding| finding.contains("contains itself"))
            .count(),
        2
    );
}
