//! The common data of all contours of one request.

use super::chords::with_arcs;
use super::offset::{Wall, walls};
use super::path::Refusal;
use crate::drawing::{Contour, ContourSegment, Drawing, EntityId, Outline};
use crate::geometry::{Point, Tolerances};
use crate::settings::Effective;
use rustc_hash::FxHashMap;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::atomic::{AtomicBool, AtomicU64};

/// How much nearer than the correction a path may come by rounding, mm.
pub(super) const ROUNDING: f64 = 1e-6;

/// What the selection says of one contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pick {
    /// The entity that the cut begins with.
    pub(crate) first: EntityId,
    /// Whether the cut goes against the contour's own direction; `None` where the selection does not say.
    pub(crate) turned: Option<bool>,
}

/// The common data of all contours of one request.
pub(super) struct Job<'a> {
    pub(crate) drawing: &'a Drawing,
    pub(crate) outlines: &'a [Outline],
    pub(crate) settings: &'a Effective,
    /// The selection's words for contours, by outline.
    pub(crate) picks: FxHashMap<usize, Pick>,
    pub(crate) unit_mm: f64,
    /// The area that is cut out of each outline before it, in square drawing units, where it counts.
    pub(crate) cut_out: FxHashMap<usize, f64>,
    /// The contour that all passes leave is worked out, too.
    pub(crate) finishes: bool,
    /// The wire follows the arcs for which chords stand, within `chord-fit`: in paths, not in what is found in the drawing.
    pub(crate) fits_chords: bool,
    /// The bits of the largest distance of such an arc from its chords.
    pub(crate) off_chords: AtomicU64,
    /// A loop that is everywhere at its distance is enough: whether the offset has others is not
    /// checked.
    pub(crate) a_loop_will_do: bool,
    /// Intersecting neighbours was not enough for a path: it was searched for among all crossings.
    pub(crate) searched: AtomicBool,
    pub(crate) goes_on: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Job<'a> {
    /// A request for contours of a drawing, none of which is picked, that is answered to its end.
    pub(super) fn of(
        drawing: &'a Drawing,
        outlines: &'a [Outline],
        settings: &'a Effective,
    ) -> Job<'a> {
        Job {
            drawing,
            outlines,
            settings,
            picks: FxHashMap::default(),
            unit_mm: settings.unit_of(drawing).mm,
            cut_out: FxHashMap::default(),
            finishes: false,
            fits_chords: false,
            off_chords: AtomicU64::default(),
            a_loop_will_do: false,
            searched: Default::default(),
            goes_on: &|| true,
        }
    }
}

impl Job<'_> {
    pub(crate) fn go_on(&self) -> Result<(), Refusal> {
        if (self.goes_on)() {
            Ok(())
        } else {
            Err(Refusal::Cancelled)
        }
    }

    /// The handle of a contour's first entity, which names the contour to the user.
    pub(super) fn name(&self, outline: usize) -> &str {
        let outline = self.outlines.get(outline);
        outline.map_or("?", |outline| outline.name(self.drawing))
    }

    /// The number of the workpiece that an outline lies in; 0 for none.
    pub(super) fn workpiece(&self, outline: usize) -> u16 {
        let (outline, workpieces) = (self.outlines.get(outline), &self.settings.workpieces);
        outline.map_or(0, |outline| {
            workpieces.of_contour(self.drawing, &outline.contour)
        })
    }

    /// Outlines, each with what is known of it, by the workpieces that they lie in, in the order of the first of each.
    pub(super) fn by_workpiece<T>(
        &self,
        outlines: &[usize],
        known: Vec<T>,
    ) -> Vec<(Vec<usize>, Vec<T>)> {
        if self.settings.workpieces.is_empty() {
            return vec![(outlines.to_vec(), known)];
        }
        let mut numbers: Vec<u16> = Vec::new();
        let mut parts: Vec<(Vec<usize>, Vec<T>)> = Vec::new();
        for (&outline, known) in outlines.iter().zip(known) {
            let number = self.workpiece(outline);
            let mut numbered = numbers.iter().zip(&mut parts);
            match numbered.find(|(part, _)| **part == number) {
                Some((_, (own, of_own))) => {
                    own.push(outline);
                    of_own.push(known);
                }
                None => {
                    numbers.push(number);
                    parts.push((vec![outline], vec![known]));
                }
            }
        }
        parts
    }

    /// The walls of a contour.
    pub(crate) fn walls(&self, contour: &Contour) -> Vec<Wall> {
        let segment = |at: usize| contour.segment(self.drawing, at);
        let shortest = self.settings.tolerances.zero_length;
        self.walls_of(contour.len(), segment, contour.closed, shortest)
    }

    /// The walls of a contour of `count` segments without those that are no longer than `shortest`, mm.
    pub(crate) fn walls_of(
        &self,
        count: usize,
        segment: impl Fn(usize) -> Option<ContourSegment> + Sync + Send,
        closed: bool,
        shortest: f64,
    ) -> Vec<Wall> {
        let tolerances = Tolerances {
            zero_length: self.units(shortest),
            ..self.tolerances()
        };
        let walls = walls(count, segment, closed, &tolerances);
        let (walls, off_chords) = with_arcs(walls, closed, tolerances.chord_fit);
        self.off_chords.fetch_max(off_chords.to_bits(), Relaxed);
        walls
    }

    /// In drawing units.
    pub(super) fn tolerances(&self) -> Tolerances {
        let tolerances = self.settings.tolerances.in_units(self.unit_mm);
        let chord_fit = if self.fits_chords {
            tolerances.chord_fit
        } else {
            0.0
        };
        Tolerances {
            chord_fit,
            ..tolerances
        }
    }

    /// A point of the settings, mm, in drawing units.
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> Point {
        Point::new(x, y) / self.unit_mm
    }

    /// A place of the drawing as people read it: in mm, to a nanometre.
    pub(super) fn in_mm(&self, at: Point) -> Point {
        (at * self.unit_mm).map(|it| (it * 1e6).round() / 1e6 + 0.0)
    }

    /// mm in drawing units.
    pub(crate) fn units(&self, mm: f64) -> f64 {
        mm / self.unit_mm
    }
}
