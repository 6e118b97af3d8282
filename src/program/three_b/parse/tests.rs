use super::super::block::{CountingAxis, Motion};
use super::*;

/// Blocks, words and faults of a line in one readable row.
fn check(line: &str, expected: &str) {
    let mut said = Vec::new();
    read_line(line.as_bytes(), 100, &Words::default(), |item| {
        said.push(match item {
            Item::Block {
                block,
                number,
                stated_end,
                part,
                ..
            } => {
                let motion = match block.motion {
                    Motion::Line(quadrant) => format!("L{}", quadrant.number()),
                    Motion::Clockwise(quadrant) => format!("SR{}", quadrant.number()),
                    Motion::CounterClockwise(quadrant) => format!("NR{}", quadrant.number()),
                };
                let number = number.map_or_else(String::new, |number| format!("N{number} "));
                let end = stated_end.map_or_else(String::new, |end| format!(" at {:?}", end.at));
                let axis = if block.axis == CountingAxis::X {
                    'X'
                } else {
                    'Y'
                };
                let part = part.map_or_else(String::new, |part| {
                    format!(
                        " R{} {}",
                        part.radius,
                        if part.concave { "DD" } else { "D" }
                    )
                });
                format!(
                    "{number}{},{},{} {axis} {motion}{part}{end}",
                    block.x, block.y, block.j
                )
            }
            Item::Word { word, number, .. } => format!(
                "{}{word:?}",
                number.map_or_else(String::new, |number| format!("N{number} "))
            ),
            Item::StartPoint { at, .. } => format!("start {at:?}"),
            Item::Text { range, .. } => {
                format!("text {}..{}", range.start - 100, range.end - 100)
            }
            Item::CommentedBlock { range, .. } => {
                format!("commented {}..{}", range.start - 100, range.end - 100)
            }
            Item::Fault(fault) => format!(
                "! {}..{} {}",
                fault.range.start - 100,
                fault.range.end - 100,
                fault.sentence()
            ),
        });
    });
    assert_eq!(said.join(" / "), expected, "{line}");
}

#[test]
fn every_layout_is_read() {
    for line in [
        "B9900B0B39600GYNR1",
        "b 9900 b 0 b 39600 gy nr 1",
        "  B  9900 B     0 B 039600 GY NR1 ; round the hole",
        "B9900BB39600GYNR1",
        "B\t9900\tB\tB\t39600\tG\tY\tN\tR\t1",
        "|B 9900|B 0|B 39600|GY|NR1|",
    ] {
        check(line, "9900,0,39600 Y NR1");
    }
    for line in [
        "N12B9900B0B9900GXL1",
        "N 12: B9900B0B9900GXL1",
        "n0012 b9900 b0 b9900 gx l1",
        "12 B9900B0B9900GXL1",
        "(12) B9900B0B9900GXL1",
        "12. B9900B0B9900GXL1",
    ] {
        check(line, "N12 9900,0,9900 X L1");
    }
    for line in [
        "B0B21500B21500GYL2 ; 1.5 , 21.5",
        "B0B21500B21500GYL2  1.500   21.500",
        "BBB021500GYL2 ; X=1.5, Y=21.5",
        "B B B21500 GY L2 (1.5,21.5)",
    ] {
        let ratio = if line.contains("B0B2") {
            "0,21500"
        } else {
            "0,0"
        };
        let point = if line.contains('(') {
            String::new()
        } else {
            " at [1.5, 21.5]".into()
        };
        check(line, &format!("{ratio},21500 Y L2{point}"));
    }
    check(
        "B40000BB040000GXL1 B1B9B090000GYL1 DD",
        "40000,0,40000 X L1 / 1,9,90000 Y L1 / End",
    );
    // Commas that do not belong to numbers.
    check(
        "B0B21500B21500GYL2 ; hole,left pin,right",
        "0,21500,21500 Y L2",
    );
    // Two axes are not an axis.
    check(
        "B9900B0B9900GXYL1",
        "! 14..17 column 15: found `YL1`, expected L, SR or NR and a quadrant",
    );
    // The only way to part the digits is that in which J has its zero.
    check(
        "B17000B9234017000GXL1",
        "! 0..17 the block lacks a B / 17000,9234,17000 X L1",
    );
    check("N13: DD ; the end", "N13 End");
    check("Start Point = -1.5 , 2", "start [-1.5, 2.0]");
    check("; Start Point = 1.50000 , 2.0 ; X , Y", "start [1.5, 2.0]");
    check("B0B5000B10000B5000GXDDNR1", "0,5000,10000 X NR1 R5000 DD");
    check(
        "B 3000 B 4000 B 6000 B 5000 GX D SR 1",
        "3000,4000,6000 X SR1 R5000 D",
    );
}

#[test]
fn wide_marks_and_spaces_are_those_of_a_program() {
    for line in [
        "（1）B9900B0B9900GXL1",
        "（ 1 ） B9900B0B9900GXL1",
        "1）B9900B0B9900GXL1",
        "1、B9900B0B9900GXL1",
        "N1：B9900B0B9900GXL1",
        "N1\u{3000}B9900\u{3000}B0\u{a0}B9900 GX\u{a0}L1",
        "\u{a0}N1 B9900B0B9900GXL1",
        "| 1 | B9900 | B0 | B9900 | GX | L1 |",
        "│",
    ] {
        let expected = if line == "│" {
            ""
        } else {
            "N1 9900,0,9900 X L1"
        };
        check(line, expected);
    }
    for line in [
        "N8：DD",
        "| 8 | DD |",
        "8 | DD | |",
        "N8\u{3000}DD",
        "（8）DD",
    ] {
        check(line, "N8 End");
    }
    check("B9900B0B9900GXL1；往", "9900,0,9900 X L1");
}

#[test]
fn headings_and_comments_are_no_faults() {
    for line in [
        "****************",
        "; anything B1 B2 GX",
        "% 0001",
        "(plate 12)",
        "/ skipped",
        "\u{7a0b}\u{5e8f}\u{5982}\u{4e0b}",
        "",
        "   \t ",
    ] {
        check(line, "");
    }
    check("CAXAWEDM -Version 2.0 , Name : 1.3B", "text 0..35");
    check(
        "Conner R= 0.00000    , Offset F= 0.10000 ,Length= 125.000 mm",
        "text 0..60",
    );
    check("START", "text 0..5");
    check(",", "");
    // A block that is commented out is not cut, and that is said.
    for line in [
        "* B9900B0B9900GXL1",
        "/ B9900B0B9900GXL1",
        "(B9900B0B9900GXL1)",
        "\u{ff1b}B9900B0B9900GXL1",
        "; was B9900B0B9900GXL1",
    ] {
        check(line, &format!("commented 0..{}", line.len()));
    }
    check("B9900B0B9900GXL1 ,", "9900,0,9900 X L1");
    check("B9900B0B9900GXL1 line AB, R3", "9900,0,9900 X L1");
    for line in [
        "OA: B9900B0B9900GXL1",
        "1-2 B9900B0B9900GXL1 ; in",
        "\u{76f4}\u{7ebf}OA B 9900 B 0 B 9900 GX L1",
        "\u{2460} B9900B0B9900GXL1",
    ] {
        check(line, "9900,0,9900 X L1");
    }
}

#[test]
fn what_was_meant_is_read_and_the_fault_said() {
    check(
        "9900B0B9900GXL1",
        "! 0..4 the block lacks a B / 9900,0,9900 X L1",
    );
    check(
        "N3 9900B0B9900GXL1",
        "! 3..7 the block lacks a B / N3 9900,0,9900 X L1",
    );
    check(
        "B9900 0B9900GXL1",
        "! 6..7 the block lacks a B / 9900,0,9900 X L1",
    );
    check(
        "B9900B0 9900GXL1",
        "! 8..12 the block lacks a B / 9900,0,9900 X L1",
    );
    check(
        "12 9900B0B9900GXL1",
        "! 3..7 the block lacks a B / N12 9900,0,9900 X L1",
    );
    check(
        "12 B9900 0B9900GXL1",
        "! 9..10 the block lacks a B / N12 9900,0,9900 X L1",
    );
    check(
        "12 B9900B0 9900GXL1",
        "! 11..15 the block lacks a B / N12 9900,0,9900 X L1",
    );
    check(
        "0B5000B10000B5000GXDDNR1",
        "! 0..1 the block lacks a B / 0,5000,10000 X NR1 R5000 DD",
    );
    check(
        "B99000B9900GXL1",
        "! 0..11 the block lacks a B / 9900,0,9900 X L1",
    );
    check(
        "B25B9900B0B9900GXL1",
        "! 0..3 B25 is written where N25 was meant / N25 9900,0,9900 X L1",
    );
    check(
        "B 25 B 9900 B 0 B 39600 GY NR1",
        "! 0..4 B25 is written where N25 was meant / N25 9900,0,39600 Y NR1",
    );
    check(
        "B9900BOB9900GXL1",
        "! 6..7 the letter O is written where a zero was meant / 9900,0,9900 X L1",
    );
}

#[test]
fn a_broken_block_is_said_with_its_column_and_hides_no_other() {
    check(
        "B1B2GXL1",
        "! 4..8 column 5: found `GXL1`, expected digits of Y, or B before J",
    );
    check(
        "B1000B0B1000GX",
        "! 13..14 column 15: the line ends, expected L, SR or NR and a quadrant",
    );
    check(
        "B1000B0B1000GXL5",
        "! 15..16 column 16: found `5`, expected a quadrant from 1 to 4",
    );
    check(
        "B1000B0B1000GZL1",
        "! 13..16 column 14: found `ZL1`, expected X or Y after G",
    );
    check(
        "B1000B0BGXL1",
        "! 8..12 column 9: found `GXL1`, expected the counting length J in \u{b5}m",
    );
    check(
        "B-5B0B5GXL1",
        "! 1..11 column 2: found `-5B0B5GXL1`, expected digits of X, or B before Y",
    );
    check(
        "B1000B0B1000 B5B0B5GXL1 B7B0B7GXL1",
        "! 13..23 column 14: found `B5B0B5GXL1`, expected G and the counting axis, GX or GY / 7,0,7 X L1",
    );
    check(
        "B1x2B0B12GXL1 DD",
        "! 2..13 column 3: found `x2B0B12GXL1`, expected digits of X, or B before Y / End",
    );
    check("B1B0B1GXL1 5", "1,0,1 X L1 / text 11..12");
    check("B1B0B1GXL1hello", "1,0,1 X L1 / text 10..15");
    check(
        "B1B0B1GXL1 ; 1,500 , 2,25",
        "1,0,1 X L1 / ! 13..25 the coordinates have decimal commas and are not read, expected decimal points",
    );
    check(
        "\u{412}9900B0B9900GXL1",
        "! 0..17 column 1: found `\u{412}9900B0B9900`, expected a block in plain letters and digits; these letters are Cyrillic or Greek",
    );
    check(
        "\u{411}9900\u{411}0\u{411}39600GYNR1",
        "! 0..21 column 1: found `\u{411}9900\u{411}0\u{411}3960`, expected a block in plain letters and digits",
    );
    check(
        "Ｄ",
        "! 0..3 column 1: found `Ｄ`, expected a block in plain letters and digits; these letters are full-width",
    );
    check(
        "\u{ff22}9900B0B9900GXL1",
        "! 0..18 column 1: found `\u{ff22}9900B0B9900`, expected a block in plain letters and digits; these letters are full-width",
    );
}
