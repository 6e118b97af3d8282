//! The lines of a cut with the faults of their words, the machine before each, and the pieces that they make; and what other
//! lines in their place make.

use super::around::is_way;
use crate::geometry::{Point, Vector};
use crate::program::iso::block::{Block, Motion, Note, read_line};
use crate::program::iso::document::Document;
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::{Place, Reading, apart};
use crate::program::repair::cut::{Piece, Pieces};
use std::ops::Range;

/// A line of a cut.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) block: Block,
    /// Faults of its words.
    pub(crate) faults: u32,
}

impl Line {
    pub(crate) fn read(bytes: &[u8], document: &Document) -> Line {
        let mut faults = 0;
        let block = read_line(bytes, 1, |note| match note {
            Note::Fault { .. } | Note::Twice { .. } => faults += 1,
            // Among numbers that are written otherwise.
            Note::Length { pointed, .. }
                if document.pointed().is_some_and(|others| others != pointed) =>
            {
                faults += 1
            }
            _ => {}
        });
        if let Some(decimals) = document.usual_decimals() {
            let lengths = [block.x, block.y, block.i, block.j, block.r];
            faults += lengths
                .into_iter()
                .flatten()
                .filter(|number| decimals.is_odd(*number))
                .count() as u32;
        }
        Line { block, faults }
    }
}

/// A line, and what it does.
pub(super) struct Row {
    pub(super) line: Line,
    pub(super) before: Machine,
    /// `None` where it does not lead anywhere.
    pub(super) piece: Option<Piece>,
    is_rapid: bool,
}

/// Lines that follow each other, of which the moving ones all cut, or all are rapids.
pub(super) struct Way<'a> {
    pub(super) document: &'a Document,
    /// Its first line.
    pub(super) first: usize,
    pub(super) rows: Vec<Row>,
    /// The row of each piece.
    pub(super) at: Vec<usize>,
    /// From this row on nothing depends on the wire's position, along each axis and at all.
    pub(super) free: [usize; 2],
    loose_from: usize,
}

/// The machine that runs the lines one after another, and the last block that led anywhere.
struct Runner<'a> {
    reading: &'a Reading,
    machine: Machine,
    last: Option<Block>,
}

impl Runner<'_> {
    /// Runs a line. One that cannot be read leads as far as it can, and the next one goes on there.
    fn run(&mut self, line: &Line) -> Option<Piece> {
        let block = &line.block;
        let (from, switches) = (self.machine.at, self.machine.switches.is_some());
        let made = self.machine.run(block, self.reading);
        let is_lost = self.machine.lost != [false; 2];
        (self.machine.lost, self.machine.torn) = ([false; 2], false);
        if made.is_none() && !(is_way(block) && (line.faults > 0 || is_lost)) {
            return None;
        }
        let said = words_of(block);
        let is_again = self.last.replace(said) == Some(said) && !self.machine.incremental;
        let by = vector(apart(self.machine.at, from));
        let is_stray = block.has_stray_center(self.machine.motion);
        let mut piece = Piece {
            by,
            machine: by,
            is_placed: !self.machine.incremental,
            is_unread: made.is_none(),
            is_unsound: line.faults > 0 || is_stray,
            ..Piece::default()
        };
        if let Some(made) = made {
            let curve = made.curve(self.reading);
            let is_arc = made.is_arc();
            piece.curve = curve.map(|curve| curve.moved(Point::origin() - curve.start()));
            // Controls switch the correction on straight cuts alone.
            let is_switched = switches || made.switches.is_some();
            piece.is_unsound |= is_arc && (is_again || is_switched || piece.curve.is_none());
            piece.miss = made.difference(self.reading.rule(made.incremental)).abs() / 1e3;
        }
        piece.is_off_circle = piece.is_unsound && line.faults == 0;
        piece.is_unsound &= !piece.is_unread;
        Some(piece)
    }
}

/// The words of a block that lead somewhere.
pub(super) fn words_of(block: &Block) -> Block {
    let Block {
        motion,
        x,
        y,
        i,
        j,
        r,
        ..
    } = *block;
    Block {
        motion,
        x,
        y,
        i,
        j,
        r,
        ..Block::default()
    }
}

fn vector(place: Place) -> Vector {
    Vector::new(place[0] as f64, place[1] as f64) / 1e3
}

impl<'a> Way<'a> {
    /// All of some lines.
    pub(super) fn of(document: &'a Document, lines: Range<usize>) -> Option<Way<'a>> {
        let mut machine = document.machine_before(lines.start)?;
        (machine.lost, machine.torn) = ([false; 2], false);
        let mut runner = Runner {
            reading: document.reading(),
            machine,
            last: None,
        };
        let row = |line: usize| {
            let line = Line::read(document.line_bytes(line), document);
            let before = runner.machine;
            let piece = runner.run(&line);
            Row {
                line,
                before,
                piece,
                is_rapid: runner.machine.motion == Motion::Rapid,
            }
        };
        let first = lines.start;
        let rows = lines.map(row).collect();
        Some(Way::with_rows(document, first, rows))
    }

    fn with_rows(document: &'a Document, first: usize, rows: Vec<Row>) -> Way<'a> {
        let at = (0..rows.len()).filter(|row| rows[*row].piece.is_some());
        let (mut free, mut loose_from) = ([0; 2], 0);
        for (nth, row) in rows.iter().enumerate() {
            let block = &row.line.block;
            let is_absolute = !block.incremental.unwrap_or(row.before.incremental);
            for (free, word) in free.iter_mut().zip([block.x, block.y]) {
                if word.is_some() && is_absolute || block.sets_position {
                    (*free, loose_from) = (nth + 1, nth + 1);
                }
            }
        }
        Way {
            document,
            first,
            at: at.collect(),
            rows,
            free,
            loose_from,
        }
    }

    /// Those of some lines around one of them that cut, or those that are rapids.
    pub(super) fn around(
        document: &'a Document,
        lines: Range<usize>,
        line: usize,
    ) -> Option<Way<'a>> {
        let start = lines.start;
        let mut rows = Way::of(document, lines)?.rows;
        let own = line.saturating_sub(start);
        let moves = |row: &&Row| row.piece.is_some();
        let (before, behind) = rows.split_at((own + 1).min(rows.len()));
        let nearest = before
            .iter()
            .rev()
            .find(moves)
            .or(behind.iter().find(moves))?;
        let is_rapid = nearest.is_rapid;
        let is_other = |row: &Row| row.piece.is_some() && row.is_rapid != is_rapid;
        let end = behind.iter().position(is_other).map(|at| own + 1 + at);
        let first = before.iter().rposition(is_other).map_or(0, |at| at + 1);
        rows.truncate(end.unwrap_or(rows.len()));
        rows.drain(..first);
        Some(Way::with_rows(document, start + first, rows))
    }

    pub(super) fn lines(&self) -> Range<usize> {
        self.first..self.first + self.rows.len()
    }

    pub(super) fn cuts(&self) -> bool {
        self.at.iter().any(|row| !self.rows[*row].is_rapid)
    }

    /// Its pieces, as the search sees them.
    pub(super) fn all(&self) -> Pieces {
        Pieces {
            closes: self.cuts(),
            writing: self.document.reading().writing(),
            all: self.pieces(),
            ..Pieces::default()
        }
    }

    pub(super) fn is_open(&self) -> bool {
        self.all().against().is_open
    }

    pub(super) fn pieces(&self) -> Vec<Piece> {
        self.rows.iter().filter_map(|row| row.piece).collect()
    }

    /// From its end to its start, nm.
    pub(super) fn gap(&self) -> Vector {
        -self.pieces().iter().map(|piece| piece.by).sum::<Vector>()
    }

    /// Whether the wire is taken elsewhere before it cuts.
    pub(super) fn is_taken(&self) -> bool {
        let first = self.at.first().copied().unwrap_or(0);
        let mut before = self.rows[..first].iter();
        before.any(|row| row.line.block.sets_position)
    }

    /// The pieces from a row on with other lines in the place of `count` ones, up to where the machine is as it was; and how
    /// many pieces they replace.
    pub(super) fn with(&self, row: usize, count: usize, lines: &[Line]) -> (usize, Vec<Piece>) {
        let before = self.rows[..row].iter().rev();
        let mut runner = Runner {
            reading: self.document.reading(),
            machine: self
                .rows
                .get(row)
                .map_or_else(Machine::default, |row| row.before),
            last: before
                .clone()
                .find(|row| row.piece.is_some())
                .map(|row| words_of(&row.line.block)),
        };
        let mut pieces: Vec<Piece> = lines.iter().filter_map(|line| runner.run(line)).collect();
        let own = &self.rows[row..(row + count).min(self.rows.len())];
        let mut replaced = own.iter().filter(|row| row.piece.is_some()).count();
        for (at, own) in self.rows.iter().enumerate().skip(row + count) {
            if self.goes_on(&runner.machine, at) {
                break;
            }
            pieces.extend(runner.run(&own.line));
            replaced += usize::from(own.piece.is_some());
        }
        (replaced, pieces)
    }

    /// Whether from a row on everything is as before, or only moved.
    fn goes_on(&self, machine: &Machine, row: usize) -> bool {
        let known = &self.rows[row].before;
        let is_alike = Machine {
            at: known.at,
            said: known.said,
            moved: known.moved,
            behind: known.behind,
            ..*machine
        } == *known;
        is_alike && (machine.at == known.at || row >= self.loose_from)
    }

    /// How many pieces from one on a change of it may change: until both coordinates are stated anew.
    pub(super) fn reach(&self, index: usize) -> usize {
        let Some(row) = self.at.get(index) else {
            return 0;
        };
        let mut is_known = [false; 2];
        let behind = self.rows[row + 1..]
            .iter()
            .filter(|row| row.piece.is_some());
        let mut reach = 1;
        for row in behind {
            let block = &row.line.block;
            if block.incremental.unwrap_or(row.before.incremental) || is_known == [true; 2] {
                break;
            }
            reach += 1;
            for (known, word) in is_known.iter_mut().zip([block.x, block.y]) {
                *known |= word.is_some();
            }
        }
        reach
    }
}
