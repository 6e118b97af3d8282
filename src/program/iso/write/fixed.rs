//! Lines of a profile in a program: none of them moves the wire, ends the program before its end, or leads the moves after it
//! elsewhere than they say.

use super::Lines;
use crate::finding::Side;
use crate::program::grid::Node;
use crate::program::iso::block::{Note, Stop, read_line};
use crate::program::iso::moves::Reading;
use crate::program::iso::tilt::Reader;
use crate::program::iso::unfollowed::Frame;
use crate::program::write::Proved;

/// What the lines of a profile so far do to the moves after them.
#[derive(Default)]
pub(super) struct Leading {
    upper: Reader,
    /// The line after which the wire leans.
    leans: Option<String>,
    frame: Frame,
    /// The line after which moves lead elsewhere, and the word of it that does that.
    turns: Option<(String, String)>,
}

impl Leading {
    pub(super) fn of(reading: Reading) -> Leading {
        Leading {
            upper: Reader::new(reading, None),
            ..Leading::default()
        }
    }
}

impl Lines<'_> {
    /// Lines of the profile before and between contours.
    pub(super) fn fixed(&mut self, lines: &[String], at: Node) -> Proved {
        self.put_lines(lines, at, false)
    }

    /// Lines of the profile after all contours.
    pub(super) fn last_lines(&mut self, lines: &[String], at: Node) -> Proved {
        self.put_lines(lines, at, true)
    }

    /// A refusal where the moves after the lines of the profile lead elsewhere than they say.
    pub(super) fn lead_nowhere_else(&mut self) -> Proved {
        self.leading.frame.moves();
        if let Some(line) = &self.leading.leans {
            return Err(self.refused(&say!(its_line_tilts_the_wire, line)));
        }
        if let Some((line, word)) = &self.leading.turns {
            return Err(self.refused(&say!(its_line_leads_elsewhere, line, word)));
        }
        Ok(())
    }

    fn put_lines(&mut self, lines: &[String], at: Node, are_last: bool) -> Proved {
        for line in lines {
            let word = match self.side {
                Some(Side::Left) => "G41",
                Some(Side::Right) => "G42",
                None if line.contains("{side}") => continue,
                None => "",
            };
            let text = if line.contains('{') {
                let (mut x, mut y) = (Vec::new(), Vec::new());
                self.push_length(&mut x, at.x - self.zero.x);
                self.push_length(&mut y, at.y - self.zero.y);
                let (x, y) = (String::from_utf8_lossy(&x), String::from_utf8_lossy(&y));
                line.replace("{side}", word)
                    .replace("{register}", &self.register(self.pass))
                    .replace("{x}", &x)
                    .replace("{y}", &y)
            } else {
                line.clone()
            };
            let mut fault = None;
            let block = read_line(text.as_bytes(), 1, |note| {
                if let Note::Fault { .. } = note {
                    fault = Some(());
                }
            });
            let made = self.machine.run(&block, &self.reading);
            if fault.is_some() {
                return Err(self.refused(&say!(its_line_cannot_be_read_again, text)));
            }
            if made.is_some() {
                return Err(self.refused(&say!(its_line_moves_the_wire, text)));
            }
            if (block.stop == Some(Stop::End) || block.returns) && !are_last {
                return Err(self.refused(&say!(its_line_ends_the_program, text)));
            }
            if block.motion.is_some() {
                self.motion = None;
            }
            let leading = &mut self.leading;
            leading.upper.read(0, text.as_bytes(), &self.machine);
            match leading.upper.leans() {
                true => drop(leading.leans.get_or_insert_with(|| text.clone())),
                false => leading.leans = None,
            }
            if let Some(word) = leading.frame.changed_by(text.as_bytes(), &block) {
                leading.turns.get_or_insert((text.clone(), word));
            }
            self.pauses += usize::from(block.stop == Some(Stop::Pause));
            self.out.extend_from_slice(text.as_bytes());
            self.end_line();
        }
        Ok(())
    }
}
