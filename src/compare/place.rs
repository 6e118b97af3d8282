//! Where a program lies on its drawing: where it says so, else where most of it is as far beside a contour.

use super::budget::Budget;
use super::drawn::Drawn;
use super::passes::share;
use super::traced::{Block, Traced};
use super::walls::FARTHEST;
use crate::geometry::{Bounds, Point, Vector, left_normal};
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// Of the first cuts this many are laid on contours of their size, at most this many of these.
const CUTS: usize = 3;
const PLACES: usize = 24;
/// Blocks of a cut that are looked at.
const LOOKED_AT: usize = 64;
/// A place is right where so much of a cut lies at one distance, and surely where so much does.
const RIGHT: f64 = 0.2;
const SURE: f64 = 0.8;
/// Distances that do not fit count less from so far off on, µm: first as far as a contour of this size may be off.
const SCALES: [f64; 5] = [200.0, 50.0, 10.0, 4.0, 4.0];

/// From a program's places to those of the drawing; `None` where it lies nowhere on it.
pub(super) fn place(drawn: &Drawn, traced: &Traced, budget: &Budget) -> Option<Vector> {
    let cuts: Vec<Range<usize>> = traced.cuts.iter().map(|cut| cut.contour.clone()).collect();
    let cuts: Vec<Range<usize>> = cuts.into_iter().filter(|cut| !cut.is_empty()).collect();
    // A single line among others is a way.
    let is_contour = |cut: &&Range<usize>| {
        let first = traced.blocks.get(cut.start).and_then(Block::segment);
        cut.len() > 1 || first.is_some_and(|first| first.as_arc().is_some())
    };
    let contours: Vec<&Range<usize>> = match cuts.iter().any(|cut| is_contour(&cut)) {
        true => cuts.iter().filter(is_contour).collect(),
        false => cuts.iter().collect(),
    };
    // How much of the first cuts lies at one distance, each by itself: of contours that are alike, those count where all
    // of them lie.
    let right = |shift: Vector| {
        let of_contours = contours.iter().take(CUTS);
        let own = of_contours.map(|cut| {
            let cut = cut.start..cut.end.min(cut.start + LOOKED_AT);
            share(traced, drawn.walls(), cut, shift, budget)
        });
        let own: Vec<f64> = own.collect();
        own.iter().sum::<f64>() / own.len().max(1) as f64
    };
    if traced.is_placed && right(Vector::zeros()) >= RIGHT {
        return Some(Vector::zeros());
    }
    // Threaded where the settings say, or at zero.
    let rewritten = drawn.rewritten(traced, None);
    let begun = rewritten
        .and_then(|rewritten| Some(rewritten.traced.begin()? + rewritten.shift - traced.begin()?));
    let mut best: Option<(f64, Vector)> = None;
    let begun = begun.into_iter().chain([Vector::zeros()]);
    let sized = cuts
        .iter()
        .take(CUTS)
        .flat_map(|cut| of_size(drawn, traced, cut));
    for (number, shift) in begun.chain(sized).take(2 + CUTS * PLACES).enumerate() {
        let first = cuts.first()?;
        let middle = first.start + first.len() / 2;
        // Where a block in the middle is wrong, each half lies elsewhere.
        let parts = [first.clone(), first.start..middle, middle..first.end];
        let parts = parts.iter().take(if number < 2 { 0 } else { 3 });
        let places = parts.map(|part| refined(drawn, traced, part, shift, budget));
        for shift in std::iter::once(shift).chain(places.collect::<Vec<_>>()) {
            let own = right(shift);
            if best.is_none_or(|(best, _)| own > best) {
                best = Some((own, shift));
            }
        }
        if best.is_some_and(|(own, _)| own >= SURE) {
            break;
        }
    }
    best.filter(|(own, _)| *own >= RIGHT)
        .map(|(_, shift)| shift)
}

/// Where a contour lies that is about as far away as one of the same size: from `blocks` to each such contour.
pub(super) fn of_size(drawn: &Drawn, traced: &Traced, blocks: &Range<usize>) -> Vec<Vector> {
    let Some(own) = bounds(traced, blocks.clone()) else {
        return Vec::new();
    };
    let mut all: Vec<(f64, Vector)> = Vec::new();
    for contour in drawn
        .walls()
        .bounds
        .iter()
        .filter(|bounds| !bounds.is_empty())
    {
        let wider = own.width() - contour.width();
        let higher = own.height() - contour.height();
        if wider.abs().max(higher.abs()) <= 2.0 * FARTHEST {
            let middle = |bounds: &Bounds| bounds.min.coords + bounds.max.coords;
            let by = (middle(contour) - middle(&own)) / 2.0;
            all.push(((wider - higher).abs() + 0.1 * wider.abs(), by));
        }
    }
    all.sort_by(|one, other| one.0.total_cmp(&other.0));
    all.truncate(PLACES);
    all.into_iter().map(|(_, by)| by).collect()
}

fn bounds(traced: &Traced, blocks: Range<usize>) -> Option<Bounds> {
    let mut whole = Bounds::EMPTY;
    let segments = traced.blocks.get(blocks)?.iter().filter_map(Block::segment);
    segments.for_each(|segment| whole.merge(&segment.bounds()));
    (!whole.is_empty()).then_some(whole)
}

/// The place near another one from which the blocks of a cut lie at one distance.
pub(super) fn refined(
    drawn: &Drawn,
    traced: &Traced,
    blocks: &Range<usize>,
    mut shift: Vector,
    budget: &Budget,
) -> Vector {
    let walls = drawn.walls();
    let blocks = traced.blocks.get(blocks.clone()).unwrap_or_default();
    let segments: Vec<_> = blocks.iter().filter_map(Block::segment).collect();
    let step = segments.len().div_ceil(LOOKED_AT).max(1);
    for scale in SCALES {
        let measured = segments.iter().step_by(step).flat_map(|segment| {
            let places = [0.25, 0.75].map(|share| segment.point_at(share));
            places.into_iter().filter_map(|place: Point| {
                let near = walls.near(place + shift, None, budget)?;
                let wall = walls.segment(&near)?;
                let share = wall.share_of(place + shift).clamp(0.0, 1.0);
                Some((left_normal(wall.tangent_at(share)), near.left))
            })
        });
        let measured: Vec<(Vector, f64)> = measured.collect();
        let mut lefts: Vec<f64> = measured.iter().map(|(_, left)| *left).collect();
        lefts.sort_by(f64::total_cmp);
        let Some(middle) = lefts.get(lefts.len() / 2) else {
            return shift;
        };
        let (mut sums, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for (normal, left) in &measured {
            let off = left - middle;
            let weight = 1.0 / (1.0 + (off / scale).powi(2));
            let row = Vector3::new(normal.x, normal.y, -1.0);
            sums += weight * row * row.transpose();
            right += -weight * off * row;
        }
        let Some(solved) = sums.try_inverse().map(|inverse| inverse * right) else {
            return shift;
        };
        let by = Vector::new(solved.x, solved.y);
        if by.norm() > FARTHEST {
            return shift;
        }
        shift += by;
    }
    shift
}
