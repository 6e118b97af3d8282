//! Mirror and rotate a program about its zero.
//!
//! ```text
//! G01 X5. Y0.                G01 X0. Y5.
//! G03 X0. Y5. I-5. J0.  →    G03 X-5. Y0. I0. J-5.     (a quarter turn counter-clockwise)
//! ```
//!
//! Numbers stay as they are written; their letters and signs change. So the path changes exactly.

use super::Refactoring;
use super::rewrite::{Bent, Rewrite, Target, swapped_sides};
use super::sheet::Sheet;
use crate::finding::Side;
use crate::program::iso::block::{Motion, read_line};
use crate::program::iso::machine::Place;
use crate::program::iso::word::{Number, Token, words};
use crate::text::TextEdit;
use std::ops::Range;

pub const MIRROR_X: Refactoring = Refactoring {
    id: "refactor.rewrite.mirror.x",
    title: "Mirror left and right (X to −X)",
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: -1,
                xy: 0,
                yx: 0,
                yy: 1,
            },
        )
    },
};
pub const MIRROR_Y: Refactoring = Refactoring {
    id: "refactor.rewrite.mirror.y",
    title: "Mirror up and down (Y to −Y)",
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: 1,
                xy: 0,
                yx: 0,
                yy: -1,
            },
        )
    },
};
pub const ROTATE_LEFT: Refactoring = Refactoring {
    id: "refactor.rewrite.rotate.left",
    title: "Rotate by 90° counter-clockwise",
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: 0,
                xy: -1,
                yx: 1,
                yy: 0,
            },
        )
    },
};
pub const ROTATE_RIGHT: Refactoring = Refactoring {
    id: "refactor.rewrite.rotate.right",
    title: "Rotate by 90° clockwise",
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: 0,
                xy: 1,
                yx: -1,
                yy: 0,
            },
        )
    },
};
pub const ROTATE_HALF: Refactoring = Refactoring {
    id: "refactor.rewrite.rotate.half",
    title: "Rotate by 180°",
    rewrite: |sheet| {
        transformed(
            sheet,
            Transform {
                xx: -1,
                xy: 0,
                yx: 0,
                yy: -1,
            },
        )
    },
};

/// `x' = xx·x + xy·y`, `y' = yx·x + yy·y`, all of them 0, 1 or −1.
#[derive(Clone, Copy, Debug)]
struct Transform {
    xx: i64,
    xy: i64,
    yx: i64,
    yy: i64,
}

impl Transform {
    fn of_place(self, [x, y]: Place) -> Place {
        [self.xx * x + self.xy * y, self.yx * x + self.yy * y]
    }

    fn mirrors(self) -> bool {
        self.xx * self.yy - self.xy * self.yx < 0
    }

    fn swaps(self) -> bool {
        self.xx == 0
    }

    /// The sign that the coordinate of an axis gets, by the axis on which it stood.
    fn sign(self, axis: usize) -> i64 {
        match (self.swaps(), axis) {
            (false, 0) => self.xx,
            (false, _) => self.yy,
            (true, 0) => self.yx,
            (true, _) => self.xy,
        }
    }

    fn of_motion(self, motion: Motion) -> Motion {
        match (self.mirrors(), motion) {
            (true, Motion::Clockwise) => Motion::CounterClockwise,
            (true, Motion::CounterClockwise) => Motion::Clockwise,
            (_, motion) => motion,
        }
    }
}

fn transformed(sheet: &Sheet<'_>, transform: Transform) -> Result<Vec<TextEdit>, String> {
    let content = sheet.content()?;
    let (document, reading) = (sheet.document, sheet.document.reading());
    let mut rewrite = Rewrite::default();
    for (index, row) in content.rows.iter().enumerate() {
        let Target {
            motion,
            to,
            bend,
            side,
        } = Target::of(&row.made, reading);
        let bend = match bend {
            Bent::Center(center) => Bent::Center(transform.of_place(center)),
            other => other,
        };
        let side = if transform.mirrors() {
            side.map(Side::reversed)
        } else {
            side
        };
        rewrite.rows.insert(
            index,
            Target {
                motion: transform.of_motion(motion),
                to: transform.of_place(to),
                bend,
                side,
            },
        );
    }
    if transform.mirrors() {
        rewrite.words = swapped_sides(document, 0..document.text().line_count());
    }
    let text = document.text();
    for line in 0..text.line_count() {
        let range = text.line_range(line);
        line_words(
            text.bytes().get(range.clone()).unwrap_or_default(),
            range.start,
            transform,
            &mut rewrite.words,
        )
        .map_err(|reason| format!("line {}: {reason}", line + 1))?;
    }
    rewrite.edits(sheet, content)
}

/// Where a number stands with its letter, and what takes its place.
type Turned = (Range<usize>, String);

/// The words of a line that change.
fn line_words(
    line: &[u8],
    start: usize,
    transform: Transform,
    edits: &mut Vec<TextEdit>,
) -> Result<(), String> {
    let block = read_line(line, 1, |_| {});
    let mut fault = None;
    // X and Y, I and J: place and text of the number without its sign.
    let mut pairs: [[Option<Turned>; 2]; 2] = Default::default();
    words(line, 1, |token| {
        let Token::Word {
            letter,
            number,
            range,
        } = token
        else {
            return;
        };
        let range = range.start - 1..range.end - 1;
        let slot = match letter {
            b'X' => (0, 0),
            b'Y' => (0, 1),
            b'I' => (1, 0),
            b'J' => (1, 1),
            b'U' | b'V' => {
                fault = Some("the way of the upper guide (U, V) is not followed".to_owned());
                return;
            }
            b'G' => {
                let motion = match (number.mantissa, number.decimals) {
                    (2, 0) => "G03",
                    (3, 0) => "G02",
                    (51 | 52, 0) if transform.mirrors() => {
                        fault = Some("a taper (G51, G52) is not followed".to_owned());
                        return;
                    }
                    _ => return,
                };
                if transform.mirrors() {
                    edits.push(TextEdit {
                        range: start + range.start..start + range.end,
                        text: motion.into(),
                    });
                }
                return;
            }
            _ => return,
        };
        if pairs[slot.0][slot.1].is_some() {
            fault = Some(format!("{} stands twice", letter as char));
        }
        let digits = line.get(range.start + 1..range.end).unwrap_or_default();
        pairs[slot.0][slot.1] = Some((range, turned(digits, number, transform.sign(slot.1))));
    });
    if let Some(fault) = fault {
        return Err(fault);
    }
    if block.takes_coordinates && block.has_coordinates() {
        let is_wait = crate::program::iso::block::word_range(line, 1, |letter, number| {
            letter == b'G' && number.whole() == Some(4)
        })
        .is_some();
        return if is_wait {
            Ok(())
        } else {
            Err("a word takes the coordinates for a place of the machine".into())
        };
    }
    for (pair, names) in pairs.into_iter().zip([["X", "Y"], ["I", "J"]]) {
        let name = |axis: usize| names[if transform.swaps() { 1 - axis } else { axis }];
        let mut edit = |range: Range<usize>, name: &str, number: String| {
            edits.push(TextEdit {
                range: start + range.start..start + range.end,
                text: format!("{name}{number}"),
            });
        };
        match pair {
            // Both keep their order in the line.
            [Some((first, x)), Some((second, y))] if transform.swaps() => {
                edit(first, names[0], y);
                edit(second, names[1], x);
            }
            [first, second] => {
                for (axis, word) in [first, second].into_iter().enumerate() {
                    if let Some((range, number)) = word {
                        edit(range, name(axis), number);
                    }
                }
            }
        }
    }
    Ok(())
}

/// A number as it is written, with its sign turned where `sign` is −1.
fn turned(digits: &[u8], number: Number, sign: i64) -> String {
    let text = String::from_utf8_lossy(digits).trim().to_owned();
    if sign > 0 || number.mantissa == 0 {
        return text;
    }
    match text.strip_prefix('-') {
        Some(rest) => rest.to_owned(),
        None => format!("-{}", text.trim_start_matches('+')),
    }
}
