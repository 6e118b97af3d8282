//! Blocks that may have been lost before a line: one that closes the cut, and a line tangent to an arc.

use super::Suspect;
use super::found::Meant;
use super::words::prior;
use crate::geometry::{Segment, Vector, left_normal};
use crate::program::iso::block::Motion;
use crate::program::iso::document::Document;
use crate::program::iso::labels::LOOKED_BACK;
use crate::program::iso::line::{with_word, words_of_move};
use crate::program::iso::moves::{
    Bend, CenterRule, Move, Place, Reading, added, distance, micrometres,
};
use crate::program::iso::shape::directions;
use crate::program::repair::gap::is_one_line;

impl Suspect<'_> {
    /// From the wire's position to the intended one, as far as it can be written, µm.
    pub(super) fn gaps_before(&self, index: usize) -> Vec<Vector> {
        let before = self.way.machine_before(index);
        if before.lost != [false, false] {
            return Vec::new();
        }
        let gaps = match (before.incremental, self.made(index)) {
            (true, _) => self.way.gaps(index),
            (false, Some(next)) => tangent_gaps(&next, self.way.reading),
            (false, None) => Vec::new(),
        };
        let style = &self.pool.styles[usize::from(before.inch)];
        let across = |gap: Place| {
            let to = added(before.at, gap).map(|length| style.rounded(length));
            micrometres(to) - micrometres(before.at)
        };
        gaps.into_iter().map(across).collect()
    }

    pub(super) fn headings_at(&self, index: usize) -> Option<[Vector; 2]> {
        let ahead = directions(&self.made(index)?, self.way.reading)?.0;
        let is_incremental = self.way.machine_before(index).incremental;
        is_incremental.then_some([self.way.heading_before(index)?, ahead])
    }

    /// The line of the program that runs along `way`, which begins at the origin.
    pub(super) fn filled(&self, index: usize, way: &Segment) -> Option<(Meant, f64)> {
        let before = self.way.machine_before(index);
        let (along, arc) = (way.end() - way.start(), way.as_arc());
        let style = &self.pool.styles[usize::from(before.inch)];
        let nm = |by: Vector| [by.x, by.y].map(|um| (um * 1e3).round() as i64);
        let mut motion = Motion::Line;
        let mut center = None;
        if let Some(arc) = arc {
            let sign = match self.way.reading.rule(before.incremental) {
                CenterRule::StartToCenter => 1.0,
                CenterRule::CenterToStart => -1.0,
                CenterRule::Absolute => return None,
            };
            motion = Motion::turning(arc.sweep > 0.0);
            let to_center = (along + left_normal(along) / (arc.sweep / 2.0).tan()) / 2.0;
            center = Some(nm(to_center * sign));
        }
        let words = words_of_move(before, style, motion, added(before.at, nm(along)), center);
        let meant = words.join(if self.pool.is_parted { " " } else { "" });
        let line = match self.free_number(self.lines.start + index) {
            Some(number) => with_word(meant.as_bytes(), &format!("N{number}"), self.pool.is_parted),
            None => meant.clone().into_bytes(),
        };
        let heading = self.way.heading_before(index);
        let prior = match arc {
            _ if heading.is_some_and(|heading| is_one_line(heading, along)) => {
                prior::BLOCK + prior::MORE
            }
            None if !before.incremental => prior::TANGENT,
            _ => prior::LOST_BLOCK,
        };
        Some((Meant::new(line, "", &meant), prior))
    }

    /// The number of a block before a line, where there is room for one.
    fn free_number(&self, line: usize) -> Option<u32> {
        let document = self.document;
        let (last, step) = Document::last_numbers(line, |line| self.number_of(line))?;
        let number = last.checked_add(step)?;
        let next = self
            .number_of(line)
            .or_else(|| document.number_behind(line));
        next.is_none_or(|next| next > number).then_some(number)
    }

    /// The number of a line of the cut, or of one not far before it: many changes need it.
    fn number_of(&self, line: usize) -> Option<u32> {
        let first = self.lines.start.saturating_sub(LOOKED_BACK);
        let read = || self.document.block(line).number;
        let known = line.checked_sub(first).and_then(|at| self.numbers.get(at));
        known.map_or_else(read, |known| *known.get_or_init(read))
    }
}

/// From the start of an arc to its start after a lost tangent line: its end stays, and its centre moves along where I
/// and J count from the start.
fn tangent_gaps(arc: &Move, reading: &Reading) -> Vec<Place> {
    let (Bend::Center { .. }, false) = (arc.bend, arc.incremental) else {
        return Vec::new();
    };
    let rule = reading.rule(false);
    let (Some(center), Some((tangent, _))) = (arc.center(rule), directions(arc, reading)) else {
        return Vec::new();
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
    let place = |length: f64| [along.x, along.y].map(|part| (part * length * 1e3).round() as i64);
    lengths.into_iter().filter(is_likely).map(place).collect()
}

fn rotated(vector: Vector, by: f64) -> Vector {
    let (sin, cos) = by.sin_cos();
    Vector::new(
        vector.x * cos - vector.y * sin,
        vector.x * sin + vector.y * cos,
    )
}
