//! The form of a block, and which of its parts the cursor is in.

use crate::ide::program::Signature;
use crate::program::iso::block::{Motion, read_line};
use crate::program::iso::document::Document;
use crate::program::iso::machine::CenterRule;
use crate::program::iso::word::{Token, WordFault, words};

type Part = (&'static str, &'static str);

const X: [Part; 2] = [
    ("X", "where to, from the program's zero (G90)"),
    ("X", "how far along X, from where the wire stands (G91)"),
];
const Y: [Part; 2] = [
    ("Y", "where to, from the program's zero (G90)"),
    ("Y", "how far along Y, from where the wire stands (G91)"),
];
const I: [Part; 3] = [
    ("I", "from the arc's start to its centre, along X"),
    ("I", "from the arc's centre to its start, along X"),
    ("I", "the centre's own X"),
];
const J: [Part; 3] = [
    ("J", "from the arc's start to its centre, along Y"),
    ("J", "from the arc's centre to its start, along Y"),
    ("J", "the centre's own Y"),
];

const LINE: [[Part; 2]; 2] = [[X[0], Y[0]], [X[1], Y[1]]];
/// By how coordinates are meant, and how centres.
const ARC: [[[Part; 4]; 3]; 2] = [
    [
        [X[0], Y[0], I[0], J[0]],
        [X[0], Y[0], I[1], J[1]],
        [X[0], Y[0], I[2], J[2]],
    ],
    [
        [X[1], Y[1], I[0], J[0]],
        [X[1], Y[1], I[1], J[1]],
        [X[1], Y[1], I[2], J[2]],
    ],
];
const RADIUS: [[Part; 3]; 2] = [
    [
        X[0],
        Y[0],
        (
            "R",
            "radius; negative where the arc turns by more than 180°",
        ),
    ],
    [
        X[1],
        Y[1],
        (
            "R",
            "radius; negative where the arc turns by more than 180°",
        ),
    ],
];
const POSITION: [Part; 2] = [
    ("X", "where the wire stands"),
    ("Y", "where the wire stands"),
];
const CORRECTION: [Part; 1] = [(
    "D",
    "place in the control's table that holds the correction; some controls say H",
)];
const CALL: [Part; 2] = [
    ("P", "number at which the subprogram begins: its N or O"),
    ("L", "how often it is run"),
];
const WAIT: [Part; 1] = [("P", "how long; some controls say X")];

/// The form of the block that is written at a byte; `None` where none is.
pub fn signature(document: &Document, offset: usize) -> Option<Signature> {
    let text = document.text();
    let line = text.line_of(offset);
    let range = text.line_range(line);
    let bytes = text.bytes().get(range.clone())?;
    let cursor = offset.clamp(range.start, range.end) - range.start;
    let block = read_line(bytes, 1, |_| {});
    let before = document.machine_before(line).unwrap_or_default();
    let mut last = None;
    let mut is_comment = false;
    // Counted from 1 so that no byte order mark is looked for.
    words(bytes, 1, |token| match token {
        Token::Word { letter, range, .. }
        | Token::Fault {
            fault: WordFault::NoNumber { letter },
            range,
        } if range.start <= cursor => {
            last = Some((letter, range.end > cursor));
        }
        Token::Comment { range }
        | Token::Fault {
            fault: WordFault::OpenComment,
            range,
        } if range.start <= cursor => {
            is_comment = range.end > cursor;
        }
        _ => {}
    });
    // Where nothing has been written yet, nobody asks for a form.
    let (letter, inside) = last.filter(|_| !is_comment)?;
    let incremental = usize::from(block.incremental.unwrap_or(before.incremental));
    let motion = block.motion.unwrap_or(before.motion);
    let is_arc = matches!(motion, Motion::Clockwise | Motion::CounterClockwise);
    let coordinates = matches!(letter, b'X' | b'Y' | b'I' | b'J' | b'R');
    let (label, parameters): (&str, &'static [Part]) = if block.sets_position {
        ("G92 X Y", &POSITION)
    } else if block.call.is_some() || is_m98(bytes) {
        ("M98 P L", &CALL)
    } else if block.takes_coordinates && is_wait(bytes) {
        ("G04 P", &WAIT)
    } else if block.takes_coordinates {
        return None;
    } else if block.compensation.is_some() && matches!(letter, b'G' | b'D' | b'H') {
        match block.compensation {
            Some(crate::program::iso::block::Compensation::Left) => ("G41 D", &CORRECTION),
            Some(crate::program::iso::block::Compensation::Right) => ("G42 D", &CORRECTION),
            _ => return None,
        }
    } else if !(coordinates || letter == b'G' && block.motion.is_some()) {
        return None;
    } else if is_arc && block.r.is_some() {
        (
            if motion == Motion::Clockwise {
                "G02 X Y R"
            } else {
                "G03 X Y R"
            },
            &RADIUS[incremental],
        )
    } else if is_arc {
        let rule = match document.reading().rule(incremental == 1) {
            CenterRule::StartToCenter => 0,
            CenterRule::CenterToStart => 1,
            CenterRule::Absolute => 2,
        };
        (
            if motion == Motion::Clockwise {
                "G02 X Y I J"
            } else {
                "G03 X Y I J"
            },
            &ARC[incremental][rule],
        )
    } else {
        (
            if motion == Motion::Rapid {
                "G00 X Y"
            } else {
                "G01 X Y"
            },
            &LINE[incremental],
        )
    };
    // Behind a word and a space the next one is meant; before the first of them, that.
    let letter = if letter == b'H' { b'D' } else { letter };
    let at = parameters
        .iter()
        .position(|(name, _)| name.as_bytes() == [letter]);
    let active = at.map_or(0, |at| {
        at + usize::from(
            !inside
                && bytes
                    .get(cursor.wrapping_sub(1))
                    .is_some_and(|byte| *byte == b' '),
        )
    });
    Some(Signature {
        label,
        parameters,
        active: active.min(parameters.len() - 1),
    })
}

fn is_m98(line: &[u8]) -> bool {
    crate::program::iso::block::word_range(line, 1, |letter, number| {
        letter == b'M' && number.whole() == Some(98)
    })
    .is_some()
}

fn is_wait(line: &[u8]) -> bool {
    crate::program::iso::block::word_range(line, 1, |letter, number| {
        letter == b'G' && number.whole() == Some(4)
    })
    .is_some()
}
