//! Which drawn contours are partners: one lies in the other, and both run beside each other everywhere.

use super::workpiece_of;
use crate::drawing::{Drawing, Outline};
use crate::geometry::{Bounds, Point};
use crate::settings::Effective;
use crate::toolpath::Walls;
use rayon::iter::ParallelIterator;
use rayon::slice::ParallelSlice;

/// One core takes so many segments at a time.
const AT_A_TIME: usize = 1024;

/// Partners may be so many clearances apart.
const FARTHEST: f64 = 5.0;

/// Who is whose partner. Indices of outlines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawn {
    /// The punch, then its plate; in the order of the punches.
    pub pairs: Vec<[usize; 2]>,
    /// Contours of workpieces that have none.
    pub alone: Vec<usize>,
    /// The names of workpieces of which nothing is drawn.
    pub missing: Vec<String>,
}

/// One contour that may have a partner.
struct Candidate {
    outline: usize,
    workpiece: u16,
    bounds: Bounds,
    area: f64,
}

/// The partners among the contours of workpieces. A contour has one: of several the one whose box fits best.
pub(crate) fn partners(drawing: &Drawing, outlines: &[Outline], settings: &Effective) -> Drawn {
    let unit_mm = settings.unit_of(drawing).mm;
    let reach = FARTHEST * settings.pair.clearance.unwrap_or(0.0) / unit_mm;
    let candidates: Vec<Candidate> = outlines
        .iter()
        .enumerate()
        .filter(|(_, outline)| {
            outline.contour.closed
                && outline.twice_area != 0.0
                && outline.contour.double_of.is_none()
        })
        .filter_map(|(index, outline)| {
            let workpiece = workpiece_of(drawing, &outline.contour, settings);
            let mut bounds = Bounds::EMPTY;
            outline
                .contour
                .segments(drawing)
                .for_each(|segment| bounds.merge(&segment.geometry.bounds()));
            (workpiece != 0).then_some(Candidate {
                outline: index,
                workpiece,
                bounds,
                area: outline.twice_area.abs(),
            })
        })
        .collect();
    // By their left edges: those that may lie in each other stand together.
    let mut by_left: Vec<usize> = (0..candidates.len()).collect();
    by_left.sort_by(|&a, &b| {
        let left = |index: usize| candidates[index].bounds.min.x;
        left(a).total_cmp(&left(b))
    });
    let mut found: Vec<(f64, usize, usize)> = Vec::new();
    for (place, &one) in by_left.iter().enumerate() {
        for &other in &by_left[place + 1..] {
            let (a, b) = (&candidates[one], &candidates[other]);
            if b.bounds.min.x - a.bounds.min.x > reach {
                break;
            }
            let off = apart(&a.bounds, &b.bounds);
            if a.workpiece == b.workpiece || off > reach {
                continue;
            }
            let (punch, plate) = if a.area <= b.area {
                (one, other)
            } else {
                (other, one)
            };
            if run_together(
                drawing,
                [punch, plate].map(|index| &outlines[candidates[index].outline]),
                reach,
            ) {
                found.push((off, punch, plate));
            }
        }
    }
    let place = |index: usize| candidates[index].outline;
    found.sort_by(|a, b| {
        let by_off = a.0.total_cmp(&b.0);
        by_off.then_with(|| (place(a.1), place(a.2)).cmp(&(place(b.1), place(b.2))))
    });
    let mut taken = vec![false; candidates.len()];
    let mut drawn = Drawn::default();
    for (_, punch, plate) in found {
        if !taken[punch] && !taken[plate] {
            taken[punch] = true;
            taken[plate] = true;
            drawn.pairs.push([place(punch), place(plate)]);
        }
    }
    let is_drawn = |number: u16| {
        let mut contours = outlines.iter();
        contours.any(|outline| workpiece_of(drawing, &outline.contour, settings) == number)
    };
    let names = settings.workpieces.names().iter().zip(1..);
    let missing = names.filter(|(_, number)| !is_drawn(*number));
    drawn.missing = missing.map(|(name, _)| name.clone()).collect();
    drawn.pairs.sort_unstable();
    drawn.alone = candidates
        .iter()
        .zip(taken)
        .filter(|(_, taken)| !taken)
        .map(|(candidate, _)| candidate.outline)
        .collect();
    drawn
}

/// The farthest that an edge of one box lies from that of another.
fn apart(a: &Bounds, b: &Bounds) -> f64 {
    let (min, max) = (a.min - b.min, a.max - b.max);
    [min.x, min.y, max.x, max.y]
        .into_iter()
        .map(f64::abs)
        .fold(0.0, f64::max)
}

/// True where no place of the one contour is farther from the other than `reach`, as far as ends and places between them tell.
fn run_together(drawing: &Drawing, both: [&Outline; 2], reach: f64) -> bool {
    let walls = |outline: &Outline| {
        let segments = outline.contour.segments(drawing);
        Walls::new(segments.map(|segment| segment.geometry).collect())
    };
    let (punch, plate) = rayon::join(|| walls(both[0]), || walls(both[1]));
    let keeps = |own: &Walls, other: &Walls| {
        let some = own.segments().par_chunks(AT_A_TIME);
        some.all(|segments| {
            let mut beside = None;
            let mut is_near = |at: Point| {
                beside = other.nearer_from(beside, at, reach);
                beside.is_some()
            };
            segments.iter().all(|segment| {
                [0.0, 0.25, 0.5, 0.75]
                    .into_iter()
                    .all(|share| is_near(segment.point_at(share)))
            })
        })
    };
    keeps(&punch, &plate) && keeps(&plate, &punch)
}
