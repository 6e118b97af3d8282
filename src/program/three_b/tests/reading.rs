//! The reading of a text, damaged or not.

use super::blocks;
use crate::geometry::Point;
use crate::program::numbering::Renumbering;
use crate::program::three_b::around::StatedPoint;
use crate::program::three_b::block::{Block, CountingAxis, Motion, Quadrant};
use crate::program::three_b::decode::{DecodeFault, decode};
use crate::program::three_b::parse::{Item, read};
use crate::program::three_b::words::{Word, Words};

#[test]
fn text_of_every_writer_is_read() {
    let hole = [
        Block {
            x: 9900,
            y: 0,
            j: 9900,
            axis: CountingAxis::X,
            motion: Motion::Line(Quadrant::First),
        },
        Block {
            x: 9900,
            y: 0,
            j: 39600,
            axis: CountingAxis::Y,
            motion: Motion::CounterClockwise(Quadrant::First),
        },
    ];
    for text in [
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nDD",
        "B 9900 B 0 B 9900 GX L1\r\nB 9900 B 0 B 39600 GY NR1\r\nDD\r\n",
        "b9900b0b9900gxl1\rb9900b0b39600gynr1\rdd\r",
        "N1 B9900B0B009900GXL1 ; 9.900 , 0.000\nN 2: B9900 BB039600 G Y N R 1 ; once round\n\n  E",
        "\u{feff}; Start Point = 0.0 , 0.0\nN 1: B 9900 B 0 B 9900 GX L1  9.9 , 0\nN 2: B9900B0B39600GYNR1 9.9 0\nMJ\n\u{1a}",
        "*****\nStart Point = 0.00000 , 0.00000 ; X , Y\nB9900B0B9900GXL1 B9900B0B39600GYNR1 DD",
    ] {
        assert_eq!(blocks(text), hole, "{text}");
    }
    let (items, _) = read(
        b"; Start Point = 1.5 , -2\nN7: B5BB5GXL1 ; 1.505 , -2.0\nD\n",
        &Words::default(),
    );
    let block = Block {
        x: 5,
        y: 0,
        j: 5,
        axis: CountingAxis::X,
        motion: Motion::Line(Quadrant::First),
    };
    assert_eq!(
        items,
        [
            Item::StartPoint {
                at: [1.5, -2.0],
                range: 0..24
            },
            Item::Block {
                block,
                range: 29..38,
                number: Some(7),
                stated_end: Some(StatedPoint {
                    at: [1.505, -2.0],
                    decimals: 1
                }),
                part: None
            },
            Item::Word {
                word: Word::Pause,
                is_own: true,
                range: 54..55,
                number: None
            },
        ]
    );
}

#[test]
fn a_damaged_line_says_what_was_expected_where() {
    for (text, sentence) in [
        (
            "B9900B0B9900GXL5",
            "column 16: found `5`, expected a quadrant from 1 to 4",
        ),
        (
            "B9900B0B9900GZL1",
            "column 14: found `ZL1`, expected X or Y after G",
        ),
        (
            "B9900B0B9900",
            "column 13: the line ends, expected G and the counting axis, GX or GY",
        ),
        (
            "B9900B0BGXL1",
            "column 9: found `GXL1`, expected the counting length J in µm",
        ),
        (
            "B-9900B0B9900GXL1",
            "column 2: found `-9900B0B9900`, expected digits of X, or B before Y",
        ),
        (
            "B1B1B99999999999999999999GXL1",
            "column 6: found `999999999999`, expected at most 12 digits",
        ),
        (
            "B1B1B5GXMR1",
            "column 9: found `MR1`, expected L, SR or NR and a quadrant",
        ),
        (
            "B1B0B1GXL1\nXY",
            "column 1: found `XY`, expected a block (B X B Y B J G Z), a pause or end word, or a comment after `;`",
        ),
    ] {
        let (_, faults) = read(text.as_bytes(), &Words::default());
        assert_eq!(
            faults
                .iter()
                .map(|fault| fault.sentence())
                .collect::<Vec<_>>(),
            [sentence]
        );
    }
}

#[test]
fn a_block_that_leads_nowhere_says_why() {
    for (text, expected) in [
        ("B1000B0B0GXL1", Err(DecodeFault::NoLength)),
        ("B0B0B500GXNR1", Err(DecodeFault::NoRadius)),
        ("B1000B0B4003GYNR1", Err(DecodeFault::OverTurn)),
        ("B50000B0B5000GXL1", Err(DecodeFault::WrongLength)),
        ("B5000B0B5000GYL1", Err(DecodeFault::WrongAxis)),
        ("B1B9B90000GYL1", Ok([10000.0, 90000.0])),
        ("BBB21500GYL2", Ok([0.0, 21500.0])),
        ("B0B0B9900GXL3", Ok([-9900.0, 0.0])),
        ("B0B0B9900GYL4", Ok([0.0, -9900.0])),
        // A zero coordinate has no sign: both quadrants at that axis are right.
        ("B5000B0B5000GXNR4", Ok([-5000.0, 5000.0])),
    ] {
        let end = decode(&blocks(text)[0], Point::origin()).map(|segment| segment.end());
        match (end, expected) {
            (Ok(end), Ok(expected)) => assert!(
                (end - Point::from(expected)).norm() < 1e-6,
                "{text}: {end:?}"
            ),
            (end, expected) => assert_eq!(end, expected.map(Point::from), "{text}"),
        }
    }
}

#[test]
fn coordinates_beyond_any_machine_are_none() {
    let with = |stated: &str| {
        format!(
            "; Start Point = 0 , 0\nB10000B0B10000GXL1 ; 10 , 0\nB0B10000B10000GYL2 ; 10 , 10\nB10000B0B10000GXL3 ; {stated}\nB0B10000B10000GYL4 ; 0 , 0\nDD\n"
        )
    };
    let rules = |stated: &str| -> Vec<&str> {
        let document = crate::program::three_b::Document::read(with(stated).into_bytes());
        let findings = document.findings();
        // The fixes are asked for, too.
        let _: Vec<_> = findings
            .iter()
            .map(|it| document.offered(it, Renumbering::Offered))
            .collect();
        findings.iter().map(|finding| finding.rule.name()).collect()
    };
    for far in [
        "0 , -1e17",
        "1e300 , 10",
        "-9300000000000000 , 10",
        "0 , 1.1e9",
    ] {
        assert_eq!(rules(far), [""; 0], "{far}");
    }
    assert!(!rules("0 , 1e9").is_empty());
    assert_eq!(rules("0 , 10"), [""; 0]);
}

#[test]
fn a_header_at_no_place_of_a_machine_is_said() {
    for (header, said) in [
        ("; Start Point = 1e12 , 0", Some("beyond any machine")),
        ("Start Point = 0 , -2000000000", Some("beyond any machine")),
        ("; start point: nan , 1", Some("beyond any machine")),
        ("; Start Point = 1,5 , 2,5", Some("decimal commas")),
        ("; Start Point = 1 , 2", None),
        ("; Start point: the upper left corner", None),
    ] {
        let text = format!("{header}\nB1000B0B1000GXL1\nB1000B0B1000GXL3\nDD\n");
        let document = crate::program::three_b::Document::read(text.into_bytes());
        let findings = document.findings();
        let sentences: Vec<String> = findings
            .iter()
            .filter(|found| found.rule == crate::rule::Rule::Syntax)
            .map(|found| crate::finding::sentence(found, 1.0))
            .collect();
        match said {
            Some(said) => assert!(sentences[0].contains(said), "{header}: {sentences:?}"),
            None => assert_eq!(sentences, [""; 0], "{header}"),
        }
    }
}
