use super::*;
use crate::program::three_b::{Item, read};
use proptest::prelude::*;

fn formatted(text: &[u8], layout: Option<Layout>) -> Vec<u8> {
    let source = SourceText::new(text.to_vec());
    let words = Words::default();
    let edits = format(&source, layout, &words, 0..source.line_count());
    let mut result = Vec::new();
    let mut at = 0;
    for edit in edits {
        assert!(
            edit.range.start >= at,
            "edits overlap in {}",
            source.as_str_lossy()
        );
        result.extend_from_slice(&text[at..edit.range.start]);
        result.extend_from_slice(edit.text.as_bytes());
        at = edit.range.end;
    }
    result.extend_from_slice(&text[at..]);
    result
}

#[track_caller]
fn check(layout: Option<Layout>, text: &str, expected: &str) {
    let once = formatted(text.as_bytes(), layout);
    assert_eq!(
        String::from_utf8_lossy(&once),
        expected,
        "{layout:?} of {text}"
    );
    assert_eq!(
        String::from_utf8_lossy(&formatted(&once, layout)),
        expected,
        "again, {layout:?} of {text}"
    );
}

const HOLE: &str =
    "; hole\nn1 b9900 b b09900 gx l1 ; in\nB9900B0B39600GYNR1\nB9900B0B9900GXL3 ; out  \ndd\n";

#[test]
fn every_layout_keeps_blocks_numbers_and_comments() {
    check(
        Some(Layout::Compact),
        HOLE,
        "; hole\nN1 B9900B0B9900GXL1 ; in\nB9900B0B39600GYNR1\nB9900B0B9900GXL3 ; out\nDD\n",
    );
    let aligned = "; hole\nN    1: B   9900 B      0 B   9900 GX L1  ; in\nB   9900 B      0 B  39600 GY NR1\nB   9900 B      0 B   9900 GX L3  ; out\nDD\n";
    check(Some(Layout::Aligned), HOLE, aligned);
    check(Some(Layout::Checking), HOLE, aligned);
    // Most of its blocks have no space in them.
    check(
        Some(Layout::Aligned),
        "b 0 b 5000 b 10000 b 5000 gx dd nr 1",
        "B      0 B   5000 B  10000 B   5000 GX DD NR1",
    );
    check(
        Some(Layout::Compact),
        "(3) b 0 b 5000 b 10000 b 5000 gx d nr 1 ; x",
        "N3 B0B5000B10000B5000GXDNR1 ; x",
    );
    check(
        None,
        HOLE,
        "; hole\nN1 B9900B0B9900GXL1 ; in\nB9900B0B39600GYNR1\nB9900B0B9900GXL3 ; out\nDD\n",
    );
}

#[test]
fn damaged_lines_headings_and_what_follows_the_end_stay() {
    let text = "***** x\nB1B2GXL1  \n9900B0B9900GXL1\n  b5b0b5gxl1\nN7\nn8 dd\n dd \n b1b0b1gxl1\n";
    check(
        Some(Layout::Compact),
        text,
        "***** x\nB1B2GXL1  \n9900B0B9900GXL1\nB5B0B5GXL1\nN7\nN8 DD\n dd \n b1b0b1gxl1\n",
    );
}

#[test]
fn an_end_point_stays_as_it_stands_whatever_it_says() {
    let text = "b5b0b5gxl1 ; 0.005 , 0\nB5B0B5GXL1 0.050 0 ; why\n";
    let compact = "B5B0B5GXL1  ; 0.005 , 0\nB5B0B5GXL1  ; 0.050 0 ; why\n";
    check(Some(Layout::Compact), text, compact);
    check(None, text, compact);
    check(
        Some(Layout::Checking),
        text,
        "B      5 B      0 B      5 GX L1  ; 0.005 , 0\nB      5 B      0 B      5 GX L1  ; 0.050 0 ; why\n",
    );
}

#[test]
fn each_block_gets_its_line_and_the_line_end_of_the_text() {
    check(
        Some(Layout::Compact),
        "b1b0b1gxl1 b2b0b2gxl1dd;x\r\n",
        "B1B0B1GXL1\r\nB2B0B2GXL1\r\nDD ;x\r\n",
    );
}

#[test]
fn a_comment_in_another_code_page_is_in_no_edit() {
    let text = b"\xef\xbb\xbfb1b0b1gxl1 ; \xd7\xaa\xb1\xb8 \nb1b0b1gxl1\n";
    assert_eq!(
        formatted(text, Some(Layout::Compact)),
        b"\xef\xbb\xbfB1B0B1GXL1 ; \xd7\xaa\xb1\xb8\nB1B0B1GXL1\n"
    );
}

fn any_line() -> impl Strategy<Value = String> {
    let block = (
        prop::option::of(1_u32..30),
        0_i64..3000,
        0_i64..3000,
        1_i64..3000,
        any::<bool>(),
        0_usize..12,
        0_usize..6,
    )
        .prop_map(|(number, x, y, j, on_x, motion, dress)| {
            let motion = [
                "L1", "L2", "L3", "L4", "SR1", "SR2", "SR3", "SR4", "NR1", "NR2", "NR3", "NR4",
            ][motion];
            let axis = if on_x { "GX" } else { "GY" };
            let number = number.map_or(String::new(), |number| format!("N{number} "));
            match dress {
                0 => format!("{number}b {x} b {y} b {j} {axis} {motion}"),
                1 => format!("{number}B{x}B{y}B0{j}{axis}{motion} ; note"),
                2 => format!(
                    "{number}B{x}B{y}B{j}{axis}{motion} ; {} , {} ; note",
                    x as f64 / 1000.0,
                    y as f64 / 500.0
                ),
                3 => format!("B{x}BB{j}{axis}{motion}B{x}B{y}B{j}{axis}{motion} D"),
                _ => format!("{number}B{x}B{y}B{j}{axis}{motion}"),
            }
        });
    prop_oneof![8 => block, 1 => "(; Start Point = 1.5 , -2|D|; c|B1B|  |\\*\\*|N3|DD x)", 1 => "[BNGXLDRS0-9 ;.,]{0,12}"]
}

proptest! {
    #[test]
    fn formatting_changes_nothing_that_is_read_and_is_the_same_when_repeated(
        lines in prop::collection::vec(any_line(), 0..14),
        layouts in prop::collection::vec(prop::sample::select(vec![Layout::Compact, Layout::Aligned, Layout::Checking]), 1..4),
    ) {
        let read_of = |text: &[u8]| {
            let (items, faults) = read(text, &Words::default());
            let content = items.into_iter().map(|item| match item {
                Item::Block { block, .. } => format!("{block:?}"),
                Item::Word { word, .. } => format!("{word:?}"),
                Item::StartPoint { at, .. } => format!("{at:?}"),
                Item::Text { .. } | Item::CommentedBlock { .. } | Item::Fault(_) => "damaged".into(),
            });
            (content.collect::<Vec<_>>(), faults.len())
        };
        let mut text = lines.join("\n").into_bytes();
        let before = read_of(&text);
        for layout in layouts {
            text = formatted(&text, Some(layout));
            prop_assert_eq!(&read_of(&text), &before);
            let again = formatted(&text, Some(layout));
            prop_assert_eq!(String::from_utf8_lossy(&again), String::from_utf8_lossy(&text));
        }
    }
}

/// Reading and writing in pieces equals doing it at once: a line depends on those before only by the end word.
#[test]
fn a_long_program_is_written_like_a_short_one() {
    for (before, behind) in [
        (3 * AT_ONCE, 0),
        (AT_ONCE, 2 * AT_ONCE),
        (2 * AT_ONCE - 2, 30),
    ] {
        let lines =
            |block: &str| format!("{}B99x\n; way\nDD\n", format!("{block}\n").repeat(before));
        let rest = "b9900b0b9900gxl1\n".repeat(behind);
        let text = lines("b9900b0b9900gxl1") + &rest;
        let expected = lines("B   9900 B      0 B   9900 GX L1") + &rest;
        check(Some(Layout::Checking), &text, &expected);
        let source = SourceText::new(text.into_bytes());
        let (words, all) = (Words::default(), 0..source.line_count());
        let edits = format(&source, Some(Layout::Checking), &words, all);
        assert_eq!(edits.len(), 1, "lines that follow each other are one edit");
    }
}
