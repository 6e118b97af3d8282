//! The lines of a program that move, read for refactoring, and the new ones: every line is run again as the control does.

use super::scaled::{planes, positions};
use super::turned::{swapped_sides, turned_words};
use crate::finding::{Detail, Place as Where, Severity};
use crate::geometry::Segment;
use crate::program::iso::block::{Block, Motion};
use crate::program::iso::document::Document;
use crate::program::iso::line::{Bent, Line, MIDDLE_TOLERANCE, Target, prove, push_changed};
use crate::program::iso::moves::{Bend, MICROMETRE, Move as Made, Reading, micrometres};
use crate::program::iso::plain::words_in;
use crate::program::iso::style::Style;
use crate::program::iso::taper::{Words as Taper, refuse, refuse_anywhere, refuse_where_it_leans};
use crate::program::iso::word::Token;
use crate::program::refactor::moves::{Change, Move, Numbers, Printed, Printer, Rewrite};
use crate::text::{TextEdit, edited};

/// A program by its lines that move.
pub(in crate::program) struct Words<'a> {
    pub(super) document: &'a Document,
    /// The line, what it does, and whether its lengths are in inches.
    pub(super) made: Vec<(usize, Made, bool)>,
    /// How lengths are written in millimetres and in inches.
    pub(super) styles: [Style; 2],
    /// How the centres of arcs are written.
    pub(super) reading: Reading,
}

impl<'a> Words<'a> {
    /// Those of a program. Lines that cannot be read, or are run from somewhere else, are left alone.
    pub(in crate::program) fn of(document: &'a Document) -> Result<Words<'a>, String> {
        if document.order().is_some() {
            return Err(say!(the_program_runs_subprograms).into());
        }
        if document.has_corners() {
            return Err(say!(the_control_makes_corners_of_its_own).into());
        }
        let text = document.text();
        for finding in document.plain_findings() {
            if let (Detail::Said(sentence), Severity::Error, Where::Text { range }) =
                (&finding.detail, finding.severity, &finding.place)
            {
                let line = text.line_of(range.start) + 1;
                return Err(say!(line_by_number, line, sentence));
            }
        }
        let reading = *document.reading();
        let mut made = Vec::new();
        document.moves(&mut |line, own, machine| made.push((line, own, machine.inch)));
        let is_lost = |(_, own, _): &&(usize, Made, bool)| own.curve(&reading).is_none();
        if let Some((line, ..)) = made.iter().find(is_lost) {
            return Err(say!(the_arc_of_a_line_leads_nowhere, line + 1));
        }
        if made.is_empty() {
            return Err(say!(the_program_moves_nothing).into());
        }
        Ok(Words {
            document,
            made,
            styles: [false, true].map(|inch| Style::of(document, inch)),
            reading,
        })
    }

    fn style(&self, block: usize) -> &Style {
        &self.styles[usize::from(self.made[block].2)]
    }

    /// What a line has to do.
    fn target(&self, meant: &Move, factor: f64) -> Result<Target, String> {
        let (_, made, _) = &self.made[meant.like];
        let motion = match &meant.piece {
            _ if meant.is_rapid => Motion::Rapid,
            Segment::Line(_) => Motion::Line,
            Segment::Arc(arc) if arc.sweep > 0.0 => Motion::CounterClockwise,
            Segment::Arc(_) => Motion::Clockwise,
        };
        let bend = match (
            Target::of(made, self.document.reading()).bend,
            meant.numbers,
        ) {
            _ if !meant.is_arc() => Bent::Line,
            (Bent::Center(center), Numbers::Turned(transform)) => {
                Bent::Center(transform.of_place(center))
            }
            (Bent::Center(center), Numbers::Fitted) => {
                let center = micrometres(center) * factor;
                let center = self.style(meant.like).center(center, meant.from, meant.to);
                Bent::Center(center.ok_or(say!(the_program_would_run_too_far_out))?)
            }
            (Bent::Radius(radius), Numbers::Fitted) => {
                Bent::Radius(self.radius(meant, (radius as f64 * factor).round() as i64)?)
            }
            (bend, _) => bend,
        };
        Ok(Target {
            motion,
            to: meant.to,
            bend,
            side: meant.side,
        })
    }

    /// The radius in the program's steps, if the arc then runs along its piece: near a half turn one step of R moves its
    /// middle by many.
    fn radius(&self, meant: &Move, radius: i64) -> Result<i64, String> {
        let radius = self.style(meant.like).rounded(radius);
        let made = Made {
            from: meant.from,
            to: meant.to,
            bend: Bend::Radius(radius),
            ..self.made[meant.like].1
        };
        let middle = |piece: &Segment| piece.point_at(0.5);
        let written = made.segment(self.document.reading());
        let aside = (middle(&written) - middle(&meant.piece)).norm();
        let step = self.step(meant.like) as f64 / MICROMETRE as f64;
        match aside <= MIDDLE_TOLERANCE * step.max(1.0) {
            true => Ok(radius),
            false => {
                let why = say!(its_arc_cannot_be_written_with_the_program_s_decimals);
                Err(say!(line_by_number, meant.line + 1, why))
            }
        }
    }
}

impl Printer for Words<'_> {
    fn count(&self) -> usize {
        self.made.len()
    }

    /// It is a straight cut, and its line has only its number and where it leads.
    fn goes_on(&self, block: usize) -> bool {
        let of =
            |(_, own, _): &(usize, Made, bool)| (own.motion, own.switches, own.side, own.offset);
        let (line, own, _) = &self.made[block];
        let before = block
            .checked_sub(1)
            .and_then(|before| self.made.get(before));
        let mut only = own.motion == Motion::Line
            && own.switches.is_none()
            && before.map(of) == Some(of(&self.made[block]));
        words_in(self.document.line_bytes(*line), |token, _| {
            only &= match token {
                Token::Word { letter, number } => {
                    matches!(letter, b'N' | b'X' | b'Y')
                        || letter == b'G' && number.whole() == Some(1)
                }
                _ => false,
            }
        });
        only
    }

    fn step(&self, block: usize) -> i64 {
        self.style(block).step()
    }

    fn is_in_inches(&self) -> bool {
        (0..self.made.len()).any(|block| self.style(block).is_inch())
    }

    fn words(&self, change: &Change<'_>) -> Result<Vec<TextEdit>, String> {
        let document = self.document;
        match change {
            Change::Reverse(contours) => {
                refuse_anywhere(document, Taper::All)?;
                let mut edits = Vec::new();
                for (lines, has_side) in contours.iter() {
                    // The correction's word is before the way in.
                    let words = swapped_sides(document, lines.clone());
                    if words.is_empty() && *has_side {
                        return Err(say!(the_correction_was_switched_on_for_another_contour).into());
                    }
                    edits.extend(words);
                }
                Ok(edits)
            }
            Change::StartHere {
                lines, is_corner, ..
            } => {
                refuse_anywhere(document, Taper::Guide)?;
                // At a corner the upper end begins beside its profile, and ends there.
                if *is_corner {
                    refuse_where_it_leans(document, lines.start)?;
                }
                refuse(document, lines.clone(), Taper::All)?;
                Ok(Vec::new())
            }
            Change::Scale(factor) => {
                refuse_anywhere(document, Taper::Guide)?;
                let mut edits = positions(document, *factor)?;
                edits.extend(planes(document, *factor)?);
                Ok(edits)
            }
            Change::Turn(transform) => {
                refuse_anywhere(document, Taper::Guide)?;
                turned_words(document, *transform)
            }
        }
    }

    fn print(&self, moves: &[Move], rewrite: &Rewrite) -> Result<Printed, String> {
        let (document, reading) = (self.document, &self.reading);
        let text = document.text();
        let mut words = rewrite.words.clone();
        words.sort_by_key(|edit| edit.range.start);
        let mut words = words.as_slice();
        let mut machine = document.first_machine();
        let (mut edits, mut blocks) = (Vec::new(), Vec::with_capacity(moves.len()));
        let mut rows = moves.iter().zip(&rewrite.moves).peekable();
        for line in 0..text.line_count() {
            let range = text.line_range(line);
            let own = document.line_bytes(line);
            let (here, rest) =
                words.split_at(words.partition_point(|edit| edit.range.end <= range.end));
            words = rest;
            let here = here.iter().map(|edit| TextEdit {
                range: edit.range.start - range.start..edit.range.end - range.start,
                text: edit.text.clone(),
            });
            let here: Vec<TextEdit> = here.collect();
            let mut bytes = edited(own, &here).ok_or(say!(words_lie_on_each_other))?;
            let Some((_, meant)) = rows.next_if(|(own, _)| own.line == line) else {
                machine.run(&Block::of(&bytes), reading);
                push_changed(&mut edits, range, own, &bytes)?;
                continue;
            };
            blocks.push(usize::from(meant.is_some()));
            let Some(meant) = meant else {
                // The whole line goes, its line end with it.
                edits.push(TextEdit::new(text.whole_line(line), ""));
                continue;
            };
            let target = self.target(meant, rewrite.factor.unwrap_or(1.0))?;
            // A line that already does what is meant stays as it is.
            let mut as_it_is = machine;
            let made = as_it_is.run(&Block::of(&bytes), reading);
            let is_meant =
                |made: Made| made.from == machine.at && Target::of(&made, reading) == target;
            if made.is_some_and(is_meant) {
                machine = as_it_is;
            } else {
                let written = Line {
                    bytes: &bytes,
                    parted: document.is_parted(),
                    style: self.styles[usize::from(as_it_is.inch)],
                    reading,
                };
                bytes = written.leading(&target, &machine)?;
                let made = machine.run(&Block::of(&bytes), reading);
                prove(line, made.as_ref(), &target, reading)?;
            }
            push_changed(&mut edits, range, own, &bytes)?;
        }
        Ok(Printed { edits, blocks })
    }
}
