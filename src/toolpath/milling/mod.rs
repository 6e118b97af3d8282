//! Milling by a cylindrical electrode that wears, layer by layer: the feeds.
//!
//! The uniform wear method feeds each layer its height and the wear of the whole layer, and lets the next layer go back
//! along it, so that the floor wears even (Yu, Masuzawa, Fujino 1998). Linear compensation feeds the wear on the way,
//! step by step. Lengths are in mm.

mod floor;
mod swept;
#[cfg(test)]
mod tests;

pub(crate) use floor::Floor;
pub(crate) use swept::swept_length;

use crate::settings::{Electrode, WearCompensation};
use std::f64::consts::PI;

impl Electrode {
    /// The distance of its axis from a contour: b = δ + D/2.
    pub fn correction(&self) -> f64 {
        self.diameter / 2.0 + self.gap
    }

    /// Width of the erosion: W = D + 2δ.
    pub fn width(&self) -> f64 {
        self.diameter + 2.0 * self.gap
    }

    /// Its cross-section: A = πD²/4.
    pub fn section(&self) -> f64 {
        PI * self.diameter.powi(2) / 4.0
    }

    /// Its loss of length on a way of 1 mm in a layer of 1 mm: ν W/A.
    pub(crate) fn wear_along(&self) -> f64 {
        self.wear * self.width() / self.section()
    }

    /// Its loss of length in a layer along a way of `length`, as a share of the layer's height: K = ν S/A, where S =
    /// W·l, and + πW²/4 where the round ends of an open slot count.
    pub fn wear_of_layer(&self, length: f64, is_closed: bool) -> f64 {
        let ends = match self.slot_ends && !is_closed {
            true => PI * self.width().powi(2) / 4.0,
            false => 0.0,
        };
        self.wear * (self.width() * length + ends) / self.section()
    }

    /// The number of layers; the last one may be thinner.
    pub fn layers(&self) -> usize {
        // Rounding of the depth must not add a layer.
        (self.depth / self.layer - 1e-6).ceil().max(1.0) as usize
    }

    /// Height of the last layer.
    pub(crate) fn last_layer(&self) -> f64 {
        self.depth - self.layer * (self.layers() - 1) as f64
    }
}

/// The next step of the electrode on its way along a contour. Ways count from the entry of the contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    /// It is fed to this many mm below the surface.
    Feed(f64),
    /// It goes along the contour; back where `to` lies before `from`.
    Along { from: f64, to: f64 },
}

/// The layers of one contour: to and fro along it, each from the end of the last one; a closed one in alternating
/// directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layers {
    pub(crate) electrode: Electrode,
    /// Of the way.
    pub(crate) length: f64,
    /// Of a straight way that takes as much: less where this one comes near itself.
    pub(crate) swept: f64,
    pub(crate) is_closed: bool,
    /// The feed so far for the wear along other contours.
    pub(crate) fed_before: f64,
}

impl Layers {
    /// K.
    pub(crate) fn wear(&self) -> f64 {
        self.electrode.wear_of_layer(self.swept, self.is_closed)
    }

    /// The electrode's loss of length on 1 mm of the way in a layer of 1 mm.
    pub(crate) fn wear_along(&self) -> f64 {
        self.electrode.wear_along() * self.swept / self.length
    }

    /// The feed of a layer of a height at its start.
    pub(crate) fn feed(&self, height: f64) -> f64 {
        match self.electrode.compensation {
            WearCompensation::Uniform => height * (1.0 + self.wear()),
            WearCompensation::None | WearCompensation::Linear => height,
        }
    }

    /// No more blocks than these are written for the layers along a way of this many pieces.
    pub(crate) fn blocks(&self, pieces: usize) -> usize {
        let feeds = match self.electrode.compensation {
            WearCompensation::Linear => self.length / self.electrode.step,
            WearCompensation::None | WearCompensation::Uniform => 0.0,
        };
        // A feed divides a piece; as a number of blocks what is beyond counting is the largest.
        let of_layer = (2.0 * feeds) as usize;
        let of_layer = of_layer.saturating_add(pieces + 2);
        self.electrode.layers().saturating_mul(of_layer)
    }

    /// Hands out the steps of all layers in order; returns the feed for the wear up to their end, with that of the
    /// contours before.
    pub(crate) fn each<E>(&self, step: &mut dyn FnMut(Step) -> Result<(), E>) -> Result<f64, E> {
        let Electrode {
            compensation,
            depth,
            ..
        } = self.electrode;
        let count = self.electrode.layers();
        let mut fed = self.fed_before;
        for number in 0..count {
            let height = match number + 1 == count {
                true => self.electrode.last_layer(),
                false => self.electrode.layer,
            };
            fed += self.feed(height);
            step(Step::Feed(fed))?;
            let is_back = number % 2 == 1;
            let along = |from: f64, to: f64| match is_back {
                true => Step::Along {
                    from: self.length - from,
                    to: self.length - to,
                },
                false => Step::Along { from, to },
            };
            let mut done = 0.0;
            if compensation == WearCompensation::Linear {
                let per_mm = self.wear_along() * height;
                // The wear after the last step is fed with the next layer.
                let steps = (self.length / self.electrode.step - 1e-9).floor() as usize;
                for at in (1..=steps).map(|number| number as f64 * self.electrode.step) {
                    step(along(done, at))?;
                    step(Step::Feed(fed + at * per_mm))?;
                    done = at;
                }
                fed += self.length * per_mm;
            }
            if done < self.length {
                step(along(done, self.length))?;
            }
        }
        Ok(fed - depth)
    }
}

/// The results of milling a contour; depths are below the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MilledContour {
    /// Index of the outline in the drawing's list.
    pub outline: usize,
    /// Of the way that each layer goes.
    pub length: f64,
    /// K.
    pub wear_of_layer: f64,
    /// The feed of each layer at its start, and of the last one.
    pub feed: f64,
    pub last_feed: f64,
    /// The feed on 1 mm of the way; 0 except for `linear`.
    pub feed_along: f64,
    /// The last programmed depth of the electrode.
    pub fed: f64,
    /// The floor after all layers: its mean along the way, its highest and its deepest place.
    pub floor: [f64; 3],
    /// The electrode's loss of length, with that of the contours before.
    pub worn: f64,
}

/// The results of milling a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Milled {
    pub electrode: Electrode,
    /// In the order of the cuts.
    pub contours: Vec<MilledContour>,
}
