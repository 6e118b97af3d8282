//! Blocks that may have been lost before a line: one that closes the cut, and a line tangent to an arc.

use super::found::Meant;
use super::suspect::{Change, Slip, Suspect};
use super::way::Line;
use crate::geometry::{Point, Segment, Vector, left_normal};
use crate::program::iso::block::Motion;
use crate::program::iso::line::{with_word, words_of_move};
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::{
    Bend, CenterRule, Move, Place, Reading, added, distance, micrometres, nanometres,
};
use crate::program::repair::slip::Sort;

/// Characters of a block, and of an arc.
const BLOCK_KEYS: [i32; 2] = [20, 21];

impl Suspect<'_> {
    /// The block before a row that runs along `way`, which begins at the origin.
    pub(super) fn filled(&self, index: usize, row: usize, way: &Segment) -> Option<Slip> {
        let document = self.way.document;
        let before = self.machine_at(index)?;
        let style = self.style(&before);
        let (along, arc) = (way.end() - way.start(), way.as_arc());
        let (mut motion, mut center) = (Motion::Line, None);
        if let Some(arc) = arc {
            let sign = match document.reading().rule(before.incremental) {
                CenterRule::StartToCenter => 1.0,
                CenterRule::CenterToStart => -1.0,
                CenterRule::Absolute => return None,
            };
            motion = Motion::turning(arc.sweep > 0.0);
            let to_center = (along + left_normal(along) / (arc.sweep / 2.0).tan()) / 2.0;
            center = Some(nanometres(to_center * sign));
        }
        let is_parted = document.is_parted();
        let words = words_of_move(
            &before,
            style,
            motion,
            added(before.at, nanometres(along)),
            center,
        );
        let meant = words.join(if is_parted { " " } else { "" });
        let line = match self.free_number(self.way.first + row) {
            Some(number) => with_word(meant.as_bytes(), &format!("N{number}"), is_parted),
            None => meant.clone().into_bytes(),
        };
        // Of what is calculated the number of decimals says nothing.
        let read = Line {
            faults: 0,
            ..self.read(&line)
        };
        let (count, pieces) = self.way.with(row, 0, &[read]);
        let meant = Meant {
            line,
            found: String::new(),
            meant,
        };
        Some(Slip {
            change: Change::Insert { index, meant },
            count,
            pieces,
            sort: Sort::Insertion,
            keys: BLOCK_KEYS[usize::from(arc.is_some())],
        })
    }

    /// The machine before a piece, or behind the last one.
    pub(super) fn machine_at(&self, index: usize) -> Option<Machine> {
        match self.way.at.get(index) {
            Some(row) => Some(self.way.rows[*row].before),
            None => self.way.document.machine_behind(self.line_of(index)),
        }
    }

    /// The number of a block before a line, where there is room for one.
    fn free_number(&self, line: usize) -> Option<u32> {
        let document = self.way.document;
        let (last, step) = document.numbers_before(line)?;
        let number = last.checked_add(step)?;
        let own = document.block(line).number;
        let next = own.or_else(|| document.number_behind(line));
        next.is_none_or(|next| next > number).then_some(number)
    }

    /// Lines before an arc that leads nowhere from where it begins: under G90 nothing else tells that one was lost.
    pub(super) fn tangent_lines(&self, index: usize) -> Vec<Slip> {
        let row = self.way.at[index];
        let own = &self.way.rows[row];
        let is_unsound = self
            .pieces
            .all
            .get(index)
            .is_some_and(|piece| piece.is_unsound);
        let mut machine = own.before;
        let reading = self.way.document.reading();
        let made = machine.run(&own.line.block, reading).filter(|_| is_unsound);
        let Some(made) = made.filter(|made| !made.incremental) else {
            return Vec::new();
        };
        let style = self.style(&machine);
        let line = |gap: Place| {
            let to = added(made.from, gap).map(|length| style.rounded(length));
            let along = micrometres(to) - micrometres(made.from);
            let way = Segment::line(Point::origin(), Point::origin() + along);
            self.filled(index, row, &way)
        };
        tangent_gaps(&made, reading)
            .into_iter()
            .filter_map(line)
            .collect()
    }
}
/// From the start of an arc to its start after a lost tangent line: its end stays, and its centre moves along where I
/// and J count from the start.
fn tangent_gaps(arc: &Move, reading: &Reading) -> Vec<Place> {
    let (Bend::Center { .. }, false) = (arc.bend, arc.incremental) else {
        return Vec::new();
    };
    let rule = reading.rule(false);
    let Some(center) = arc.center(rule) else {
        return Vec::new();
    };
    let out = micrometres(arc.from) - micrometres(center);
    let tangent = match arc.motion == Motion::CounterClockwise {
        true => left_normal(out),
        false => -left_normal(out),
    };
    let (along, lengths) = if rule == CenterRule::Absolute {
        let radius = distance(center, arc.to) / 1e3;
        let across = micrometres(center) - micrometres(arc.from);
        let length = (across.norm_squared() - radius * radius).max(0.0).sqrt();
        let turned = (radius / across.norm().max(radius)).asin();
        let turned = if arc.motion == Motion::CounterClockwise {
            -turned
        } else {
            turned
        };
        (rotated(across, turned), vec![length])
    } else {
        let from_end = micrometres(center) - micrometres(arc.to);
        let radius = distance(center, arc.from) / 1e3;
        let half = from_end.dot(&tangent.normalize());
        let square = half * half - from_end.norm_squared() + radius * radius;
        let root = square.sqrt();
        (tangent, vec![-half - root, -half + root])
    };
    let along = along.normalize();
    let is_likely = |length: &f64| length.is_finite() && *length > 0.0;
    let ways = lengths.into_iter().filter(is_likely);
    ways.map(|length| nanometres(along * length)).collect()
}

fn rotated(vector: Vector, by: f64) -> Vector {
    let (sin, cos) = by.sin_cos();
    Vector::new(
        vector.x * cos - vector.y * sin,
        vector.x * sin + vector.y * cos,
    )
}
