//! Questions of editors, at a cursor (`$0`) in small texts.

mod any_text;
mod hover;
mod outline;

use super::*;
use crate::drawing::Unit;
use crate::dxf::Document;
use crate::ide::{Completion, Hint, Occurrence, Role, Token, TokenKind};
use crate::text::SourceText;
use expect_test::{Expect, expect};

const MM: Unit = Unit { mm: 1.0 };

const INCH: Unit = Unit { mm: 25.4 };

/// Lines written side by side; `|` ends one.
fn lines(text: &str) -> String {
    text.split('|').map(|line| format!("{line}\n")).collect()
}

/// The document and the byte of its cursor.
fn with_cursor(text: &str) -> (Document, usize) {
    let text = lines(text);
    let cursor = text.find("$0").expect("there is a cursor");
    (
        Document::read(text.replacen("$0", "", 1).into_bytes()),
        cursor,
    )
}

fn in_entities(text: &str) -> String {
    format!("0|SECTION|2|ENTITIES|{text}|0|ENDSEC|0|EOF")
}

/// Sections, a table, a block, a polyline of each kind, and names that refer to each other.
const ALL: &str = "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|TABLES|0|TABLE|2|LAYER|0|LAYER|5|10|2|DIE|70|0|0|ENDTAB\
    |0|ENDSEC|0|SECTION|2|BLOCKS|0|BLOCK|5|20|8|0|2|HOLE|10|0|20|0|0|CIRCLE|5|21|8|die|10|0|20|0|40|2|0|ENDBLK|5|22|0|ENDSEC\
    |0|SECTION|2|ENTITIES|0|LWPOLYLINE|5|2A|330|1F|8|DIE|90|2|70|1|10|0|20|0|42|1|10|2|20|0\
    |0|POLYLINE|5|30|8|DIE|66|1|0|VERTEX|5|31|8|DIE|10|0|20|9|0|VERTEX|5|32|10|5|20|9|0|SEQEND|5|33\
    |0|INSERT|5|40|8|0|2|hole|10|7|20|7|0|TEXT|8|0|10|1|20|1|40|1|1|O|330|02A|0|ENDSEC|0|EOF";

fn all_tokens(text: &SourceText, limit: usize) -> Vec<Token> {
    let mut found = Vec::new();
    tokens(text, limit, &|| false, |token| found.push(token)).unwrap();
    found
}

#[test]
fn tokens_tell_lines_apart() {
    let text = SourceText::new(lines(ALL).into_bytes());
    let found = all_tokens(&text, usize::MAX);
    let mut kinds: Vec<String> = found
        .iter()
        .filter(|token| token.kind != TokenKind::Code)
        .map(|token| {
            let start = text.line_start(token.line) + token.start;
            format!(
                "{:?} {}",
                token.kind,
                String::from_utf8_lossy(&text.bytes()[start..start + token.length])
            )
        })
        .collect();
    kinds.sort();
    kinds.dedup();
    expect![[r#"
        Handle 02A
        Handle 10
        Handle 1F
        Handle 20
        Handle 21
        Handle 22
        Handle 2A
        Handle 30
        Handle 31
        Handle 32
        Handle 33
        Handle 40
        Layer 0
        Layer DIE
        Layer die
        Name BLOCKS
        Name DIE
        Name ENTITIES
        Name HEADER
        Name HOLE
        Name LAYER
        Name TABLES
        Name hole
        Number 0
        Number 1
        Number 2
        Number 4
        Number 5
        Number 7
        Number 9
        Record BLOCK
        Record CIRCLE
        Record ENDBLK
        Record ENDSEC
        Record ENDTAB
        Record EOF
        Record INSERT
        Record LAYER
        Record LWPOLYLINE
        Record POLYLINE
        Record SECTION
        Record SEQEND
        Record TABLE
        Record TEXT
        Record VERTEX
        Text O
        Variable $INSUNITS"#]]
    .assert_eq(&kinds.join("\n"));
    assert_eq!(all_tokens(&text, 5).len(), 5);
}

#[test]
fn tokens_of_some_lines_are_those_of_the_whole() {
    let document = Document::read(lines(ALL).into_bytes());
    let whole = all_tokens(document.text(), usize::MAX);
    let count = document.text().line_count();
    for (start, end) in
        (0..count).flat_map(|start| [(start, start + 1), (start, start + 7), (start, count)])
    {
        let expected: Vec<Token> = whole
            .iter()
            .filter(|token| (start..end).contains(&token.line))
            .copied()
            .collect();
        assert_eq!(tokens_in(&document, start..end), expected, "{start}..{end}");
    }
}

fn check_names(cursor_in: &str, expected: &Expect) {
    let (document, cursor) = with_cursor(cursor_in);
    let Some((name, _)) = name_at(&document, cursor) else {
        return expected.assert_eq("no name");
    };
    let found = occurrences(document.text(), &name, usize::MAX, &|| false).unwrap_or_default();
    let place = |found: &Occurrence| {
        let text =
            String::from_utf8_lossy(&document.text().bytes()[found.range.clone()]).into_owned();
        format!(
            "{}{} {text}",
            if found.role == Role::Defines {
                "defined "
            } else {
                ""
            },
            document.text().line_of(found.range.start)
        )
    };
    expected.assert_eq(&format!(
        "{:?}: {}",
        name.names,
        found.iter().map(place).collect::<Vec<_>>().join(", ")
    ));
}

#[test]
fn names_are_found_where_they_are_defined_and_used() {
    let check =
        |from: &str, to: &str, expected: Expect| check_names(&ALL.replacen(from, to, 1), &expected);
    check(
        "330|02A",
        "330|$002A",
        expect!["Record: defined 71 2A, 145 02A"],
    );
    check("5|2A", "5|2$0A", expect!["Record: defined 71 2A, 145 02A"]);
    check(
        "8|die",
        "8|d$0ie",
        expect!["Layer: defined 23 DIE, 51 die, 75 DIE, 95 DIE, 103 DIE"],
    );
    check(
        "2|hole",
        "2$0|hole",
        expect!["Block: defined 41 HOLE, 127 hole"],
    );
    check("330|1F", "330|$01F", expect!["Record: 73 1F"]);
    check("40|1|1|O", "40|1|1|$0O", expect!["no name"]);
    check("70|4", "7$00|4", expect!["no name"]);
}

fn check_selections(text: &str, expected: &Expect) {
    let (document, cursor) = with_cursor(text);
    let show = |range: &std::ops::Range<usize>| {
        String::from_utf8_lossy(&document.text().bytes()[range.clone()]).replace('\n', "|")
    };
    expected.assert_eq(
        &selections(&document, cursor)
            .iter()
            .map(show)
            .collect::<Vec<_>>()
            .join("\n"),
    );
}

#[test]
fn selections_grow_from_the_value_to_everything() {
    let check = |text: &str, expected: Expect| check_selections(&in_entities(text), &expected);
    check(
        "0|LWPOLYLINE|90|2|70|0|10|0|20|$07|42|1|10|2|20|0",
        expect![[r#"
        7
        20|7
        10|0|20|7|42|1
        0|LWPOLYLINE|90|2|70|0|10|0|20|7|42|1|10|2|20|0
        0|SECTION|2|ENTITIES|0|LWPOLYLINE|90|2|70|0|10|0|20|7|42|1|10|2|20|0|0|ENDSEC
        0|SECTION|2|ENTITIES|0|LWPOLYLINE|90|2|70|0|10|0|20|7|42|1|10|2|20|0|0|ENDSEC|0|EOF|"#]],
    );
    check(
        "0|POLYLINE|66|1|0|VERTEX|1$00|0|20|0|0|VERTEX|10|2|20|0|0|SEQEND",
        expect![[r#"
        10
        10|0
        0|VERTEX|10|0|20|0
        0|POLYLINE|66|1|0|VERTEX|10|0|20|0|0|VERTEX|10|2|20|0|0|SEQEND
        0|SECTION|2|ENTITIES|0|POLYLINE|66|1|0|VERTEX|10|0|20|0|0|VERTEX|10|2|20|0|0|SEQEND|0|ENDSEC
        0|SECTION|2|ENTITIES|0|POLYLINE|66|1|0|VERTEX|10|0|20|0|0|VERTEX|10|2|20|0|0|SEQEND|0|ENDSEC|0|EOF|"#]],
    );
    check(
        "0|LINE|10|0|20|0|11|1$0|21|0",
        expect![[r#"
        1
        11|1
        0|LINE|10|0|20|0|11|1|21|0
        0|SECTION|2|ENTITIES|0|LINE|10|0|20|0|11|1|21|0|0|ENDSEC
        0|SECTION|2|ENTITIES|0|LINE|10|0|20|0|11|1|21|0|0|ENDSEC|0|EOF|"#]],
    );
}

fn check_completions(text: &str, expected: &Expect) {
    let (document, cursor) = with_cursor(text);
    let found = completions(&document, cursor);
    let show = |found: &Completion| format!("{} {}", found.text, found.about);
    let more = if found.len() > 6 {
        format!("\n… {}", found.len())
    } else {
        String::new()
    };
    expected.assert_eq(&format!(
        "{}{more}",
        found
            .iter()
            .take(6)
            .map(show)
            .collect::<Vec<_>>()
            .join("\n")
    ));
}

#[test]
fn completions_are_what_makes_sense_at_the_place() {
    let check = |text: &str, expected: Expect| check_completions(&in_entities(text), &expected);
    check(
        "0|CIRCLE|5|1A|$0",
        expect![[r#"
        10 centre, x
        20 centre, y
        30 centre, z
        40 radius
        6 name of the linetype
        8 name of the layer
        … 29"#]],
    );
    check(
        "0|CIRCLE|10|1|$0|20|1|40|1",
        expect![[r#"
        20 centre, y
        10 centre, x
        30 centre, z
        40 radius
        6 name of the linetype
        8 name of the layer
        … 29"#]],
    );
    check(
        "0|LI$0|8|0",
        expect![[r#"
        LWPOLYLINE polyline of lines and arcs
        LINE line between two points
        ARC arc of a circle
        CIRCLE circle
        POLYLINE polyline with VERTEX records
        VERTEX vertex of a POLYLINE
        … 16"#]],
    );
    check(
        "0|LINE|8|DIE|10|0|20|0|11|1|21|0|0|CIRCLE|8|$0X|10|0|20|0|40|1",
        expect![[r#"
        DIE layer of the drawing
        X layer of the drawing"#]],
    );
    // A block that a program generated is never meant.
    check_completions(
        "0|SECTION|2|BLOCKS|0|BLOCK|2|*Model_Space|0|ENDBLK|0|BLOCK|8|0|2|Slot|10|0|20|0|0|ENDBLK|0|BLOCK|2|HOLE|0|ENDBLK|0|ENDSEC|0|SECTION|2|ENTITIES|0|INSERT|2|$0X|10|0|20|0|0|ENDSEC",
        &expect![[r#"
        HOLE block of the drawing
        Slot block of the drawing"#]],
    );
    check_completions(
        "0|SECTION|2|$0X|0|ENDSEC",
        &expect![[r#"
        HEADER section
        CLASSES section
        TABLES section
        BLOCKS section
        ENTITIES section
        OBJECTS section
        … 7"#]],
    );
    check_completions(
        "0|SECTION|2|HEADER|9|$0|70|4|0|ENDSEC",
        &expect![[r#"
        $ACADVER version of the file: AC1009 is R12, AC1015 is 2000, AC1032 is 2018
        $DWGCODEPAGE code page of texts in files before 2007
        $INSUNITS unit of the drawing: 1 inch, 4 millimetre, 5 centimetre, 6 metre, 0 none
        $MEASUREMENT 0 imperial, 1 metric: chooses patterns, says nothing about the unit
        $LUNITS how lengths are written
        $EXTMIN lower left corner of what is drawn
        … 11"#]],
    );
}

#[test]
fn hints_stand_behind_bulges_and_radii() {
    let check = |text: &str, unit: Unit, expected: Expect| {
        let document = Document::read(lines(&in_entities(text)).into_bytes());
        let all = hints(&document, 0..document.text().len(), unit);
        let show = |hint: &Hint| format!("{}: {}", document.text().line_of(hint.offset), hint.text);
        expected.assert_eq(&all.iter().map(show).collect::<Vec<_>>().join("\n"));
    };
    check(
        "0|LWPOLYLINE|90|3|70|1|10|0|20|0|42|1|10|2|20|0|10|0|20|2|42|-0.4142135623730951",
        MM,
        expect![[r#"
        15: R 1 mm, 180°
        25: R 1.4142 mm, -90°"#]],
    );
    check(
        "0|ARC|10|0|20|0|40|2|50|350|51|20|0|LINE|10|0|20|0|11|1|21|1|0|CIRCLE|10|0|20|0|40|1",
        INCH,
        expect!["11: 50.8 mm, 30°"],
    );
}

#[test]
fn the_tables_of_codes_name_each_code_once() {
    for record in [
        "LINE",
        "ARC",
        "CIRCLE",
        "LWPOLYLINE",
        "POLYLINE",
        "VERTEX",
        "SPLINE",
        "INSERT",
        "LAYER",
        "DIMSTYLE",
        "SECTION",
        "TEXT",
    ] {
        let mut all: Vec<i16> = super::codes::codes_of(record)
            .into_iter()
            .map(|(code, _, _)| code)
            .collect();
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count, "{record}");
    }
}
