//! The outline and the folds of a text.

use super::{ALL, in_entities, lines};
use crate::ide::dxf::symbols::{ContourNote, GROUPED_ABOVE};
use crate::ide::dxf::*;
use crate::ide::{FoldKind, Symbol};
use crate::text::SourceText;
use expect_test::expect;
use std::fmt::Write;

fn tree(nodes: &[Symbol], depth: usize, text: &mut String) {
    for node in nodes {
        let (first, last) = (node.lines.start, node.lines.end);
        let _ = writeln!(
            text,
            "{}{} {} [{}] {first}..{last}",
            "  ".repeat(depth),
            node.record,
            node.name,
            node.detail
        );
        tree(&node.children, depth + 1, text);
    }
}

fn outline_of(text: &str) -> Vec<Symbol> {
    outline(&SourceText::new(text.as_bytes().to_vec()), &|| false).expect("nobody stopped it")
}

#[test]
fn the_outline_has_sections_tables_blocks_and_entities() {
    let mut text = String::new();
    tree(&outline_of(&lines(ALL)), 0, &mut text);
    expect![[r#"
        SECTION HEADER [] 0..10
        SECTION TABLES [] 10..30
          TABLE LAYER [] 14..28
            LAYER DIE [] 18..26
        SECTION BLOCKS [] 30..64
          BLOCK HOLE [] 34..62
            CIRCLE 21 [die] 46..58
        SECTION ENTITIES [] 64..148
          LWPOLYLINE 2A [DIE, 2 vertices] 68..90
          POLYLINE 30 [DIE, 2 vertices] 90..120
          INSERT 40 [0, block hole] 120..132
          TEXT  [0, "O"] 132..146
    "#]]
    .assert_eq(&text);
}

#[test]
fn the_outline_of_damaged_text_is_what_is_there() {
    let mut text = String::new();
    tree(
        &outline_of(&lines(
            "0|SECTION|2|ENTITIES|0|POLYLINE|8|A|0|VERTEX|10|1|0|LINE|8|B|junk|0|SECTION|2|BLOCKS|0|BLOCK|2|X",
        )),
        0,
        &mut text,
    );
    expect![[r#"
        SECTION ENTITIES [] 0..17
          POLYLINE  [A, 1 vertex] 4..12
          LINE  [B] 12..17
        SECTION BLOCKS [] 17..25
          BLOCK X [] 21..25
    "#]]
    .assert_eq(&text);
    assert_eq!(outline_of(""), []);
}

#[test]
fn a_stopped_outline_is_none() {
    let text = SourceText::new(lines(&in_entities(&"0|POINT|".repeat(5000))).into_bytes());
    assert_eq!(outline(&text, &|| true), None);
    assert_eq!(tokens(&text, usize::MAX, &|| true, |_| ()), None);
}

#[test]
fn contours_are_listed_with_their_entities() {
    let text = in_entities("0|LINE|5|A|8|0|10|0|0|LINE|5|B|8|0|10|1|0|CIRCLE|8|0|10|5");
    let note = |closed, segments, handles: &[&str]| ContourNote {
        closed,
        segments,
        handles: handles.iter().map(|&h| h.into()).collect(),
    };
    let listed = symbols(
        outline_of(&lines(&text)),
        &[
            note(false, 2, &["A", "B"]),
            note(true, 1, &["#3"]),
            note(true, 1, &["gone"]),
        ],
    );
    let mut text = String::new();
    tree(&listed, 0, &mut text);
    expect![[r#"
        SECTION ENTITIES [] 0..28
           Contours [3 of them] 0..28
             contour 1 [open, 2 segments, 2 entities from A on] 4..12
              LINE A [0] 4..12
              LINE B [0] 12..20
             contour 2 [closed, 1 segment, entity #3] 20..26
          LINE A [0] 4..12
          LINE B [0] 12..20
          CIRCLE  [0] 20..26
    "#]]
    .assert_eq(&text);
}

#[test]
fn very_many_entities_are_listed_in_runs() {
    let text = in_entities(&vec!["0|POINT|8|0"; GROUPED_ABOVE + 1].join("|"));
    let listed = symbols(outline_of(&lines(&text)), &[]);
    let runs = &listed[0].children;
    assert_eq!(
        (runs.len(), &*runs[0].name, runs[0].detail.as_str()),
        (953, "1 to 21", "POINT · 21 of 20001")
    );
    assert_eq!(&*runs[952].name, "19993 to 20001");
    let bytes: usize = runs
        .windows(2)
        .filter(|pair| pair[0].range.end > pair[1].range.start)
        .count();
    assert_eq!(bytes, 0, "runs do not overlap");
}

#[test]
fn folds_begin_behind_the_name_and_the_outer_ones_stay_when_there_are_too_many() {
    let tree = outline_of(&lines(ALL));
    let list = |limit| {
        folds(&tree, limit)
            .iter()
            .map(|fold| {
                let FoldKind::Record(text) = &fold.kind else {
                    panic!("{fold:?}")
                };
                format!("{}-{} {text}", fold.first, fold.last)
            })
            .collect::<Vec<_>>()
            .join("\n")
    };
    expect![[r#"
        1-9 SECTION HEADER …
        11-29 SECTION TABLES …
        15-27 TABLE LAYER …
        19-25 LAYER DIE …
        31-63 SECTION BLOCKS …
        35-61 BLOCK HOLE …
        47-57 CIRCLE 21 die …
        65-147 SECTION ENTITIES …
        69-89 LWPOLYLINE 2A DIE, 2 vertices …
        91-119 POLYLINE 30 DIE, 2 vertices …
        121-131 INSERT 40 0, block hole …
        133-145 TEXT 0, "O" …"#]]
    .assert_eq(&list(usize::MAX));
    expect![[r#"
        1-9 SECTION HEADER …
        11-29 SECTION TABLES …
        31-63 SECTION BLOCKS …
        65-147 SECTION ENTITIES …"#]]
    .assert_eq(&list(4));
}
