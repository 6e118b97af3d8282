//! A faulty cut, and what its lines may have been before one slip.

use super::around::with_numbers_kept;
use super::found::Meant;
use super::way::{Line, Way, words_of};
use super::words::{self, Words};
use crate::geometry::{Segment, Vector};
use crate::program::iso::block::Compensation;
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::{Place, nanometres};
use crate::program::iso::plain::plain;
use crate::program::iso::style::Style;
use crate::program::repair::cut::{Against, Piece, Pieces};
use crate::program::repair::slip::{self, Cut, Ends, Sort};
use std::borrow::Cow;

/// Of longer cuts that nothing contradicts it costs too long to find out which change they would be sounder by.
const LONGEST_TANGLED: usize = 160;

/// The fewest straight cuts of which it tells anything that they do not close: fewer part something off.
const FEWEST: usize = 4;

pub(super) type Change = slip::Change<Meant>;
pub(super) type Slip = slip::Slip<Meant>;

pub(super) struct Suspect<'a> {
    pub(super) way: Way<'a>,
    pub(super) pieces: Pieces,
    pub(super) against: Against,
    pub(super) styles: [Style; 2],
}

impl<'a> Suspect<'a> {
    /// `others` are the cuts beside it.
    pub(super) fn of(way: Way<'a>, others: &[Vec<Piece>]) -> Suspect<'a> {
        let is_on = |side: Option<Compensation>| {
            matches!(side, Some(Compensation::Left | Compensation::Right))
        };
        let blocks = way.rows.iter().map(|row| &row.line.block);
        let holds_passes = blocks.filter(|block| is_on(block.compensation)).count() > 1;
        let mut pieces = way.all();
        let against = pieces.against();
        pieces.is_tangled = against.count() == 0 && pieces.all.len() <= LONGEST_TANGLED;
        Suspect {
            against,
            styles: [false, true].map(|inch| Style::of(way.document, inch)),
            pieces: Pieces {
                others: others.to_vec(),
                holds_passes,
                ..pieces
            },
            way,
        }
    }

    /// Nothing but that so few straight cuts do not close: nearly any change would close them.
    pub(super) fn tells_too_little(&self) -> bool {
        let is_only_open = self.against.is_open && self.against.count() == 1;
        let has_arc = self.pieces.all.iter().any(Piece::is_arc);
        is_only_open && self.pieces.all.len() < FEWEST && !has_arc
    }

    pub(super) fn line_of(&self, index: usize) -> usize {
        let row = self.way.at.get(index).or(self.way.at.last());
        self.way.first + row.copied().unwrap_or(0)
    }

    /// A line in plain letters.
    pub(super) fn bytes(&self, line: usize) -> Cow<'a, [u8]> {
        let own = self.way.document.line_bytes(line);
        plain(own).map_or(Cow::Borrowed(own), Cow::Owned)
    }

    /// Two lines after their exchange.
    pub(super) fn exchanged_lines(&self, line: usize) -> Vec<Vec<u8>> {
        with_numbers_kept(&self.bytes(line), &self.bytes(line + 1))
    }

    pub(super) fn read(&self, bytes: &[u8]) -> Line {
        Line::read(bytes, self.way.document)
    }

    pub(super) fn style(&self, machine: &Machine) -> &Style {
        &self.styles[usize::from(machine.inch)]
    }

    /// How much farther a row and those behind it lead with another number in it.
    fn shift(&self, row: usize, letter: u8, by: i64) -> Vector {
        let by = by as f64 / 1e3;
        match letter {
            b'X' if row + 1 >= self.way.free[0] => Vector::new(by, 0.0),
            b'Y' if row + 1 >= self.way.free[1] => Vector::new(0.0, by),
            _ => Vector::zeros(),
        }
    }

    /// Whether a change by so much may close what is open, or keep what is closed; `true` where nothing can be said.
    fn may_close(&self, shift: Vector, ends: &Ends) -> bool {
        let is_closed = self.against.unread == 0 && !self.against.is_open && self.pieces.closes;
        let stays = !is_closed || shift.norm() <= 2.0 * ends.within();
        stays && ends.may_be(shift, shift)
    }

    fn slip(&self, index: usize, reading: words::Reading, bytes: &[u8]) -> Slip {
        let words::Reading { range, text, .. } = reading;
        let found = bytes.get(range.clone()).unwrap_or_default();
        let found = String::from_utf8_lossy(found).trim().to_owned();
        let mut line = bytes.to_vec();
        line.splice(range, text.bytes());
        let mut read = self.read(&line);
        if reading.sort == Sort::Calculated {
            // Of what is calculated the number of decimals says nothing.
            read.faults = 0;
        }
        let (count, pieces) = self.way.with(self.way.at[index], 1, &[read]);
        let is_turn = |piece: Option<&Piece>| {
            let curve = piece.and_then(|piece| piece.curve);
            let arc = curve.and_then(|curve| curve.as_arc().copied());
            arc.is_some_and(|arc| arc.is_full_turn())
        };
        // Nobody means a circle by a slip.
        let sort = match is_turn(pieces.first()) && !is_turn(self.pieces.all.get(index)) {
            true => Sort::Calculated,
            false => reading.sort,
        };
        let meant = Meant {
            line,
            found,
            meant: text.trim().to_owned(),
        };
        Slip {
            change: Change::Replace { index, meant },
            count,
            pieces,
            sort,
            keys: reading.keys,
        }
    }
}

impl Cut for Suspect<'_> {
    type Meant = Meant;

    fn pieces(&self) -> &Pieces {
        &self.pieces
    }

    fn reach(&self, index: usize) -> usize {
        self.way.reach(index)
    }

    fn slips(&self, index: usize, ends: &Ends) -> Vec<Slip> {
        let (row, document) = (self.way.at[index], self.way.document);
        let own = &self.way.rows[row];
        let bytes = self.bytes(self.way.first + row);
        let words = Words {
            document,
            style: *self.style(&own.before),
            bytes: &bytes,
            line: &own.line,
            before: &own.before,
        };
        let length = |number| document.reading().length(number, own.before.inch);
        let block = &own.line.block;
        let is_read =
            own.line.faults == 0 && self.pieces.all.get(index).is_some_and(|own| !own.is_unread);
        let mut found = Vec::new();
        let gaps: Vec<Place> = ends.all().iter().copied().map(nanometres).collect();
        words.readings(&gaps, &mut |reading| {
            if let Some((letter, number)) = reading.number {
                let found = if letter == b'X' { block.x } else { block.y };
                let by = length(number).wrapping_sub(found.map_or(0, length));
                if is_read && !self.may_close(self.shift(row, letter, by), ends) {
                    return;
                }
            }
            found.push(self.slip(index, reading, &bytes));
        });
        found.extend(self.tangent_lines(index));
        found
    }

    fn deleted(&self, index: usize) -> Option<Slip> {
        let row = self.way.at[index];
        let said = |row: usize| {
            let block = &self.way.rows[row].line.block;
            (words_of(block), block.number)
        };
        let before = index.checked_sub(1).map(|before| self.way.at[before]);
        let is_twin = before.is_some_and(|before| before + 1 == row && said(before) == said(row));
        Some(Slip::deletion(index, is_twin, self.way.with(row, 1, &[])))
    }

    fn exchanged(&self, index: usize) -> Option<Slip> {
        let (row, next) = (self.way.at[index], *self.way.at.get(index + 1)?);
        // What is wrong with a block goes along with it.
        if [row, next]
            .iter()
            .any(|row| self.way.rows[*row].line.block.broken)
        {
            return None;
        }
        let lines = self.exchanged_lines(self.way.first + row);
        let lines: Vec<Line> = lines.iter().map(|line| self.read(line)).collect();
        let is_other =
            words_of(&self.way.rows[row].line.block) != words_of(&self.way.rows[next].line.block);
        let made = self.way.with(row, 2, &lines);
        (next == row + 1 && is_other).then(|| Slip::exchange(index, made))
    }

    fn inserted(&self, index: usize, way: &Segment) -> Option<Slip> {
        let row = match self.way.at.get(index) {
            Some(row) => *row,
            None => self.way.at.last()? + 1,
        };
        // Where a place is stated behind it, nothing closes by it.
        let is_loose = row >= self.way.free[0] && row >= self.way.free[1];
        is_loose.then(|| self.filled(index, row, way)).flatten()
    }
}
