//! What editors ask, at a cursor (`$0`) in small texts.

use super::symbols::{ContourNote, GROUPED_ABOVE};
use super::*;
use crate::drawing::Unit;
use crate::dxf::Document;
use crate::ide::{Completion, FoldKind, Hint, Occurrence, Role, Symbol, Token, TokenKind};
use crate::text::SourceText;
use expect_test::{Expect, expect};
use proptest::prelude::*;
use std::fmt::Write;

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

fn check_hover(text: &str, unit: Unit, expected: &Expect) {
    let (document, cursor) = with_cursor(text);
    let text = hover(&document, cursor, unit).map_or_else(|| "nothing".into(), |hover| hover.text);
    expected.assert_eq(&text);
}

#[test]
fn hover_says_what_a_code_means_in_its_entity() {
    let check =
        |text: &str, unit: Unit, expected: Expect| check_hover(&in_entities(text), unit, &expected);
    check(
        "0|CIRCLE|10|0|20|0|4$00|2",
        MM,
        expect!["**40** of CIRCLE: radius"],
    );
    check(
        "0|CIRCLE|10|0|20|0|40|$02",
        INCH,
        expect![[r#"
        **40** of CIRCLE: radius

        50.8 mm"#]],
    );
    check(
        "0|TEXT|10|0|20|0|$040|2",
        MM,
        expect!["**40** of TEXT: text height"],
    );
    check(
        "0|LWPOLYLINE|90|2|70|$0129|10|0|20|0|10|1|20|0",
        MM,
        expect![[r#"
        **70** of LWPOLYLINE: flags: 1 closed, 128 linetype runs through

        closed, linetype runs through"#]],
    );
    check(
        "0|WIPEOUT|$0340|7F",
        MM,
        expect![[r#"
        **340** of WIPEOUT: handle of a record (hard pointer)

        names no entity that is cut; "go to definition" looks for it in the whole file"#]],
    );
    check(
        "0|$0LINE|5|1A|8|DIE|10|0|20|0|11|1|21|0",
        MM,
        expect![[r#"
        **LINE**: line between two points

        entity 1A on layer DIE, 1 segment"#]],
    );
    check(
        "999|$0remark|0|LINE|10|0|20|0|11|1|21|0",
        MM,
        expect!["comment: programs pass it over"],
    );
}

#[test]
fn hover_on_an_arc_gives_its_sweep_radius_and_centre() {
    let check =
        |text: &str, unit: Unit, expected: Expect| check_hover(&in_entities(text), unit, &expected);
    check(
        "0|LWPOLYLINE|90|2|70|0|10|0|20|0|42|$01|10|2|20|0",
        INCH,
        expect![[r#"
        **42** of LWPOLYLINE: bulge of the segment that starts in this vertex: tan(sweep / 4), positive counter-clockwise, 0 is a line

        arc of 180°, counter-clockwise

        radius 1 (25.4 mm), centre (1, 0)"#]],
    );
    check(
        "0|LWPOLYLINE|90|3|70|1|10|0|20|0|10|2|20|0|10|0|20|2|42|$0-1",
        MM,
        expect![[r#"
        **42** of LWPOLYLINE: bulge of the segment that starts in this vertex: tan(sweep / 4), positive counter-clockwise, 0 is a line

        arc of 180°, clockwise

        radius 1 mm, centre (0, 1)"#]],
    );
    check(
        "0|POLYLINE|66|1|0|VERTEX|10|0|20|0|$042|1|0|VERTEX|10|2|20|0|0|SEQEND",
        MM,
        expect![[r#"
        **42** of VERTEX: bulge of the segment that starts in this vertex: tan(sweep / 4), positive counter-clockwise, 0 is a line

        arc of 180°, counter-clockwise

        radius 1 mm, centre (1, 0)"#]],
    );
    check(
        "0|ARC|10|0|20|0|40|2|50|350|51|$020",
        MM,
        expect![[r#"
        **51** of ARC: end angle; the arc runs counter-clockwise

        the arc sweeps 30°, radius 2 mm"#]],
    );
}

#[test]
fn hover_knows_header_variables_and_the_entity_of_a_handle() {
    check_hover(
        &ALL.replace("$INSUNITS|70|4", "$INSUNITS|70|$04"),
        MM,
        &expect![[r#"
        **$INSUNITS** unit of the drawing: 1 inch, 4 millimetre, 5 centimetre, 6 metre, 0 none

        one unit is 1 mm"#]],
    );
    check_hover(
        &ALL.replace("O|330|02A", "O|330|$02A"),
        MM,
        &expect![[r#"
        **330** of TEXT: handle of the owner

        names LWPOLYLINE on layer DIE"#]],
    );
}

#[test]
fn hover_is_silent_where_no_tag_is() {
    for text in ["$0", "x$0", "0|SECTION|2|ENTITIES|0|LINE|junk$0"] {
        let (document, cursor) = with_cursor(text);
        let _ = hover(&document, cursor, MM);
    }
    check_hover("$0", MM, &expect!["nothing"]);
}

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
    // Blocks that a program made for itself are not meant by anybody.
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

/// Asks everything at every line: no answer lies outside the text, none panics.
fn ask_everything(text: Vec<u8>) {
    let document = Document::read(text);
    let length = document.text().len();
    let tree = outline(document.text(), &|| false).unwrap_or_default();
    let mut all = Vec::new();
    fn ranges(
        nodes: &[Symbol],
        holder: std::ops::Range<usize>,
        all: &mut Vec<std::ops::Range<usize>>,
    ) {
        for node in nodes {
            assert!(
                node.range.start <= node.selection.start && node.selection.end <= node.range.end,
                "{node:?}"
            );
            assert!(
                holder.start <= node.range.start && node.range.end <= holder.end,
                "{node:?} in {holder:?}"
            );
            all.push(node.range.clone());
            ranges(&node.children, node.range.clone(), all);
        }
    }
    ranges(&tree, 0..length, &mut all);
    let lines = document.text().line_count();
    assert!(
        folds(&tree, 100)
            .iter()
            .all(|fold| fold.first < fold.last && fold.last < lines)
    );
    assert!(
        all_tokens(document.text(), usize::MAX)
            .windows(2)
            .all(|pair| pair[0].line < pair[1].line)
    );
    for line in 0..lines {
        let offset = document.text().line_start(line);
        all.extend(hover(&document, offset, MM).map(|hover| hover.range));
        all.extend(
            completions(&document, offset)
                .into_iter()
                .map(|completion| completion.range),
        );
        let steps = selections(&document, offset);
        assert!(
            steps
                .windows(2)
                .all(|pair| pair[1].start <= pair[0].start && pair[0].end <= pair[1].end),
            "{steps:?}"
        );
        all.extend(steps);
        if let Some((name, range)) = name_at(&document, offset) {
            let found =
                occurrences(document.text(), &name, usize::MAX, &|| false).unwrap_or_default();
            all.extend(found.into_iter().map(|found| found.range));
            all.push(range);
        }
        tokens_in(&document, line..line + 3);
    }
    hints(&document, 0..length, MM);
    assert!(
        all.iter()
            .all(|range| range.start <= range.end && range.end <= length)
    );
}

#[test]
fn everything_can_be_asked_of_any_text() {
    let all = lines(ALL);
    ask_everything(Vec::new());
    ask_everything(b"\xef\xbb\xbf".to_vec());
    ask_everything(all.clone().into_bytes());
    ask_everything(all.replace('\n', "\r\n").into_bytes());
    ask_everything(format!("\u{feff}{all}").into_bytes());
    // One line is missing, and then the end.
    let missing: Vec<&str> = all
        .lines()
        .enumerate()
        .filter(|(line, _)| *line != 25)
        .map(|(_, line)| line)
        .collect();
    ask_everything(missing.join("\n").as_bytes()[..114].to_vec());
    ask_everything(all.replace("DIE", "D\u{fc}").into_bytes());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn everything_can_be_asked_of_damaged_text(gone in prop::collection::vec(0usize..190, 1..6), cut in 0usize..800) {
        let kept: Vec<&str> = ALL.split('|').enumerate().filter(|(line, _)| !gone.contains(line)).map(|(_, line)| line).collect();
        let mut text = kept.join("\n");
        text.truncate(cut.max(1).min(text.len()));
        ask_everything(text.into_bytes());
    }
}
