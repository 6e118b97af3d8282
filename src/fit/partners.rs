//! Which drawn contours are partners: one lies in the other, and both run beside each other everywhere.

use crate::drawing::{Contour, Drawing, Outline};
use crate::geometry::{Bounds, Segment};
use crate::settings::Effective;
use crate::toolpath::Walls;
use rayon::iter::ParallelIterator;
use rayon::slice::ParallelSlice;
use rustc_hash::FxHashSet;
use std::sync::Arc;

/// Segments that one core takes at a time.
const AT_A_TIME: usize = 1024;

/// Partners may be this many clearances apart.
const FARTHEST: f64 = 5.0;

/// Which contours are partners, by the indices of their outlines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawn {
    /// The punch, then its plate; in the order of the punches.
    pub pairs: Vec<[usize; 2]>,
    /// Contours of workpieces that have no partner.
    pub alone: Vec<usize>,
    /// The names of workpieces of which nothing is drawn.
    pub missing: Vec<String>,
}

/// One contour that may have a partner.
struct Candidate {
    outline: usize,
    workpiece: u16,
    walls: Arc<Walls>,
    bounds: Bounds,
    area: f64,
}

/// The segments of a contour, by place.
pub(crate) fn walls_of(drawing: &Drawing, contour: &Contour) -> Arc<Walls> {
    let segments = contour.segments(drawing);
    Arc::new(Walls::new(
        segments.map(|segment| segment.geometry).collect(),
    ))
}

/// The partners among the contours of workpieces, and all pairs of outlines that run beside each other. A punch has a partner in each of the other
/// workpieces; a plate or a stripper has one punch: of several, the one whose box fits best. `walls_of` hands out the walls of an outline; of
/// some pairs it is `known` that they run beside each other.
pub(crate) fn partners(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    walls_of: &mut dyn FnMut(usize, &Outline) -> Arc<Walls>,
    known: &dyn Fn([usize; 2]) -> bool,
) -> (Drawn, Vec<[usize; 2]>) {
    let reach = reach(drawing, settings);
    let candidates: Vec<Candidate> = outlines
        .iter()
        .enumerate()
        .filter(|(_, outline)| {
            outline.contour.closed
                && !outline.is_on_line()
                && outline.twice_area != 0.0
                && outline.contour.double_of.is_none()
        })
        .filter_map(|(index, outline)| {
            let workpiece = settings.workpieces.of_contour(drawing, &outline.contour);
            if workpiece == 0 {
                return None;
            }
            let walls = walls_of(index, outline);
            Some(Candidate {
                outline: index,
                workpiece,
                bounds: walls.bounds(),
                walls,
                area: outline.twice_area.abs(),
            })
        })
        .collect();
    // By their left edges, so that those that may lie in each other are close together.
    let mut by_left: Vec<usize> = (0..candidates.len()).collect();
    by_left.sort_by(|&a, &b| {
        let left = |index: usize| candidates[index].bounds.min.x;
        left(a).total_cmp(&left(b))
    });
    let mut found: Vec<(f64, usize, usize)> = Vec::new();
    let mut together = Vec::new();
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
            let both = [punch, plate].map(|index| &candidates[index]);
            let outlines = both.map(|candidate| candidate.outline);
            if known(outlines) || run_together(both.map(|it| &*it.walls), reach) {
                together.push(outlines);
                found.push((off, punch, plate));
            }
        }
    }
    let place = |index: usize| candidates[index].outline;
    found.sort_by(|a, b| {
        let by_off = a.0.total_cmp(&b.0);
        by_off.then_with(|| (place(a.1), place(a.2)).cmp(&(place(b.1), place(b.2))))
    });
    // A contour that goes round another one is no punch for a third.
    let mut holds = vec![false; candidates.len()];
    for &(_, _, plate) in &found {
        holds[plate] = true;
    }
    found.retain(|(_, punch, _)| !holds[*punch]);
    let mut taken = vec![false; candidates.len()];
    let mut served: FxHashSet<(usize, u16)> = FxHashSet::default();
    let mut drawn = Drawn::default();
    for (_, punch, plate) in found {
        if !taken[plate] && served.insert((punch, candidates[plate].workpiece)) {
            taken[punch] = true;
            taken[plate] = true;
            drawn.pairs.push([place(punch), place(plate)]);
        }
    }
    let is_drawn = |number: u16| {
        let mut contours = outlines.iter();
        contours.any(|outline| settings.workpieces.of_contour(drawing, &outline.contour) == number)
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
    (drawn, together)
}

/// The largest distance of partners.
fn reach(drawing: &Drawing, settings: &Effective) -> f64 {
    let unit_mm = settings.unit_of(drawing).mm;
    FARTHEST * settings.pair.clearance.unwrap_or(0.0) / unit_mm
}

/// The largest distance between the same edges of two boxes.
fn apart(a: &Bounds, b: &Bounds) -> f64 {
    let (min, max) = (a.min - b.min, a.max - b.max);
    [min.x, min.y, max.x, max.y]
        .into_iter()
        .map(f64::abs)
        .fold(0.0, f64::max)
}

/// True where no place of either contour is farther from the other one than `reach`, as far as ends and places between them show.
fn run_together([punch, plate]: [&Walls; 2], reach: f64) -> bool {
    let keeps = |own: &Walls, other: &Walls| {
        let some = own.segments().par_chunks(AT_A_TIME);
        some.all(|segments| are_near(segments, other, reach))
    };
    keeps(punch, plate) && keeps(plate, punch)
}

/// True where no end of some segments, and no place between, is farther from `other` than `reach`.
fn are_near(segments: &[Segment], other: &Walls, reach: f64) -> bool {
    let mut beside = None;
    segments.iter().all(|segment| {
        // No place of a line is farther from another line than one of its ends.
        let is_along = |wall: &usize| {
            let ends = [segment.start(), segment.end()];
            let wall = other.segment(*wall);
            wall.as_arc().is_none() && ends.iter().all(|end| wall.distance_to(*end) < reach)
        };
        if let (Segment::Line(_), Some(last)) = (segment, beside)
            && let Some(wall) = other.beside(last).into_iter().find(is_along)
        {
            beside = Some(wall);
            return true;
        }
        [0.0, 0.25, 0.5, 0.75].into_iter().all(|share| {
            beside = other.nearer_from(beside, segment.point_at(share), reach);
            beside.is_some()
        })
    })
}
