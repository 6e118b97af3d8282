//! Finds the pieces of rounds that a block may stand for, wherever its program lies.

use super::super::REACH;
use super::{Rounds, Spot};
use crate::geometry::{Segment, Vector};
use rustc_hash::FxHashMap;

/// Width of a cell for finding pieces by their vectors and radii, µm.
const CELL: f64 = 8.0;
/// The largest difference between the vectors of a block and of its piece when both are rounded, µm.
const ALIKE: f64 = 2.9;

impl Rounds {
    /// The beginnings of pieces with this vector in either direction, with the whole of them.
    pub(crate) fn leading(&self, by: Vector) -> Vec<(Spot, Segment)> {
        let cell = |by: Vector| ((by.x / CELL).floor() as i64, (by.y / CELL).floor() as i64);
        let leads = self.leads.get_or_init(|| {
            let mut leads: FxHashMap<_, Vec<_>> = FxHashMap::default();
            for (number, round) in self.rounds.iter().enumerate() {
                for (index, piece) in round.pieces.iter().enumerate() {
                    let by = piece.segment.end() - piece.segment.start();
                    let place = (number as u32, index as u32);
                    leads.entry(cell(by)).or_default().push(place);
                }
            }
            leads
        });
        let mut found = Vec::new();
        for back in [false, true] {
            let by = if back { -by } else { by };
            let (x, y) = cell(by);
            let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (x + dx, y + dy)));
            for &(round, piece) in around.filter_map(|cell| leads.get(&cell)).flatten() {
                let spot = self.at_begin(round as usize, piece as usize, back);
                let own = &self.piece(&spot).segment;
                if (own.end() - own.start() - by).norm() <= ALIKE {
                    found.push((spot, self.whole(&spot)));
                }
            }
        }
        found.sort_by_key(|(spot, _)| (spot.round, spot.piece, spot.back));
        found
    }

    /// The pieces that are arcs of this radius, with their rounds.
    pub(crate) fn with_radius(&self, radius: f64) -> Vec<(usize, usize)> {
        let cell = |radius: f64| (radius / CELL).floor() as i64;
        let radii = self.radii.get_or_init(|| {
            let mut radii: FxHashMap<_, Vec<_>> = FxHashMap::default();
            for (number, round) in self.rounds.iter().enumerate() {
                for (index, piece) in round.pieces.iter().enumerate() {
                    if let Some(arc) = piece.segment.as_arc() {
                        let place = (number as u32, index as u32);
                        radii.entry(cell(arc.radius)).or_default().push(place);
                    }
                }
            }
            radii
        });
        let around = (-1..=1).map(|by| cell(radius) + by);
        let mut found: Vec<(usize, usize)> = around
            .filter_map(|cell| radii.get(&cell))
            .flatten()
            .map(|&(round, piece)| (round as usize, piece as usize))
            .filter(|&(round, piece)| {
                let arc = self.rounds[round].pieces[piece].segment.as_arc();
                arc.is_some_and(|arc| (arc.radius - radius).abs() <= REACH)
            })
            .collect();
        found.sort_unstable();
        found
    }
}
