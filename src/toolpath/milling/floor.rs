//! Simulates the wear of an electrode beside its program: what is eroded place by place, and what that takes from the
//! electrode.
//!
//! Nothing here knows how the feeds were found. The way consists of cells as wide as the erosion. In a cell the
//! electrode goes down to its tip; it gets shorter by ν times the volume that it erodes, over its cross-section.

use super::Layers;
use std::f64::consts::PI;

/// Cells of a way. There are fewer where the layers would visit more than [`MOST_VISITS`] cells in all.
const CELLS: usize = 2_000;
const FEWEST_CELLS: usize = 100;
const MOST_VISITS: usize = 40_000_000;

/// The floor of a milled contour, and the electrode above it. Lengths in mm; depths are below the surface.
pub(crate) struct Floor {
    /// Depth of each cell.
    cells: Vec<f64>,
    cell_length: f64,
    /// By how much the electrode is worn for each mm that a cell gets deeper, mm.
    of_cell: f64,
    /// Depth of the round ends, where they count.
    ends: Option<[f64; 2]>,
    of_end: f64,
    /// Where the tip would be without wear.
    fed: f64,
    pub(crate) worn: f64,
    /// The electrode's end of the way; 0 is the one from which ways count.
    end: Option<usize>,
}

impl Floor {
    /// An untouched surface under an electrode that is `worn`.
    pub(crate) fn new(layers: &Layers, worn: f64) -> Floor {
        let Layers {
            ref electrode,
            length,
            swept,
            is_closed,
            ..
        } = *layers;
        let visits = MOST_VISITS / electrode.layers().max(1);
        let count = visits.clamp(FEWEST_CELLS, CELLS);
        let cell_length = length / count as f64;
        let per_area = electrode.wear / electrode.section();
        let width = electrode.width();
        Floor {
            cells: vec![0.0; count],
            cell_length,
            // Where strips overlap, each takes its share of what they take together.
            of_cell: per_area * width * cell_length * swept / length,
            ends: (electrode.slot_ends && !is_closed).then_some([0.0; 2]),
            of_end: per_area * PI * width.powi(2) / 8.0,
            fed: 0.0,
            worn,
            end: Some(0),
        }
    }

    /// The electrode is fed to a depth.
    pub(crate) fn feed(&mut self, depth: f64) {
        self.fed = depth;
        self.erode_end();
    }

    /// The electrode goes along the contour.
    pub(crate) fn along(&mut self, from: f64, to: f64) {
        let index = |at: f64| ((at / self.cell_length).round() as usize).min(self.cells.len());
        let (from, to) = (index(from), index(to));
        for index in from..to {
            self.erode(index);
        }
        for index in (to..from).rev() {
            self.erode(index);
        }
        self.end = match to {
            0 => Some(0),
            to if to == self.cells.len() => Some(1),
            _ => None,
        };
        self.erode_end();
    }

    fn erode(&mut self, index: usize) {
        let depth = &mut self.cells[index];
        *depth = eroded(*depth, self.fed, &mut self.worn, self.of_cell);
    }

    fn erode_end(&mut self) {
        if let (Some(depths), Some(end)) = (&mut self.ends, self.end) {
            depths[end] = eroded(depths[end], self.fed, &mut self.worn, self.of_end);
        }
    }

    /// Mean of the floor along the way, its highest and its deepest place.
    pub(crate) fn depths(&self) -> [f64; 3] {
        let mean = self.cells.iter().sum::<f64>() / self.cells.len() as f64;
        let least = self.cells.iter().copied().fold(f64::INFINITY, f64::min);
        let most = self.cells.iter().copied().fold(0.0, f64::max);
        [mean, least, most]
    }
}

/// The depth of a place after an electrode has passed that is worn by this share of what it erodes there: at every
/// moment the tip comes nearer to the floor by that share of the remaining distance.
fn eroded(depth: f64, fed: f64, worn: &mut f64, share: f64) -> f64 {
    let left = fed - *worn - depth;
    if left <= 0.0 {
        return depth;
    }
    if share < 1e-12 {
        return depth + left;
    }
    let lost = left * (1.0 - (-share).exp());
    *worn += lost;
    depth + lost / share
}
