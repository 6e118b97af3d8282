//! Contours of one program that are cut at different corrections: a wire has one for each pass.
//!
//! Asked of programs that are not, block for block, as we write them: there a contour may follow its drawing at a correction that none of the
//! others has.

use super::anchor::anchor;
use super::difference::Difference;
use super::drawn::{Contour, Drawn};
use super::foreign::segments;
use super::infer;
use super::placement::Placement;
use super::rounds::{Course, Rounds};
use super::traced::{Block, Traced};
use super::walk::Kind;
use crate::geometry::{Bounds, Segment};
use crate::program::write::scaled;
use crate::settings::Compensation;
use std::ops::Range;

/// Of more contours or cuts it is not asked.
const MOST: usize = 100;
/// The cuts of which the corrections are found out, and the most of these.
const ASKED: usize = 8;
const CORRECTIONS: usize = 8;
/// Blocks of a cut that are measured.
const MEASURED: usize = 48;
/// The largest correction, µm.
const FARTHEST: f64 = 3_000.0;
/// Blocks of one pass are as far from their contour within this, µm; and passes whose distances differ by more are at different corrections.
const ALIKE: f64 = 3.0;
const DIFFERENT: f64 = 4.0;

/// The cuts round one contour: the first block of each, and its distance, µm.
type Passes = Vec<(usize, f64)>;

/// The first block of each contour that is cut at another correction than most of the others, or than the settings say.
pub(super) fn uneven(drawn: &Drawn, traced: &Traced) -> Vec<Difference> {
    let contours = drawn.contours();
    let cuts = traced.cuts.iter().map(|[_, contour]| contour.clone());
    let cuts: Vec<Range<usize>> = cuts.filter(|contour| !contour.is_empty()).collect();
    let is_offset = traced.blocks.iter().any(Block::is_offset);
    let are_few = |count: usize| (2..=MOST).contains(&count);
    if traced.four_b
        || is_offset
        || drawn.settings.compensation == Compensation::None
        || !are_few(contours.len())
        || !are_few(cuts.len())
    {
        return Vec::new();
    }
    let Some(placement) = placed(drawn, traced, &cuts) else {
        return Vec::new();
    };
    let scale = drawn.unit_mm * 1e3;
    let walls: Vec<Vec<Segment>> = contours.iter().map(|one| walls(one, scale)).collect();
    let mut passes: Vec<Passes> = vec![Vec::new(); contours.len()];
    for cut in cuts {
        let blocks: Vec<Segment> = segments(&traced.blocks[cut.clone()]).collect();
        if let Some((contour, distance)) = along(&blocks, &walls, &placement) {
            passes[contour].push((cut.start, distance));
        }
    }
    let all: Vec<(usize, &Passes)> = passes
        .iter()
        .enumerate()
        .filter(|(_, passes)| !passes.is_empty())
        .collect();
    let meant = drawn.settings.each_correction();
    let is_meant = |passes: &Passes| {
        let own = passes.iter().map(|(_, distance)| *distance);
        passes.len() == meant.len()
            && own
                .zip(&meant)
                .all(|(own, mm)| (own - mm * 1e3).abs() <= DIFFERENT)
    };
    let votes = |one: &&(usize, &Passes)| {
        let alike = all.iter().filter(|other| differs(one.1, other.1).is_none());
        let first = one.1[0].0;
        (alike.count(), is_meant(one.1), std::cmp::Reverse(first))
    };
    let Some(&(_, shared)) = all.iter().max_by_key(votes) else {
        return Vec::new();
    };
    let mut found: Vec<Difference> = all
        .iter()
        .filter(|(_, passes)| passes.len() == shared.len())
        .filter_map(|&(contour, passes)| {
            let pass = differs(passes, shared)?;
            let [own, others] = [passes[pass].1, shared[pass].1];
            let kind = Kind::Correction {
                said: nanometres(own),
                meant: nanometres(others),
            };
            let source = contours[contour].segments.first();
            let segment = source.map(|segment| (segment.entity, segment.segment));
            let block = &traced.blocks[passes[pass].0];
            Some(Difference::of(block, segment, (own - others).abs(), kind))
        })
        .collect();
    found.sort_by_key(|one| one.range.start);
    found
}

fn nanometres(um: f64) -> u32 {
    (um * 1e3).round().max(0.0) as u32
}

/// The first pass in which two contours differ; `None` also where they have not as many.
fn differs(one: &Passes, other: &Passes) -> Option<usize> {
    let pairs = one.iter().zip(other.iter());
    let mut apart = pairs.map(|((_, own), (_, other))| (own - other).abs() > DIFFERENT);
    let found = apart.position(|is_apart| is_apart);
    found.filter(|_| one.len() == other.len())
}

/// Where the program lies, whatever the correction of each contour.
fn placed(drawn: &Drawn, traced: &Traced, cuts: &[Range<usize>]) -> Option<Placement> {
    let mut corrections = drawn.settings.each_correction();
    for cut in cuts.iter().take(ASKED) {
        let blocks: Vec<Segment> = segments(&traced.blocks[cut.clone()]).collect();
        let own = infer::corrections(drawn.contours().iter(), drawn.unit_mm * 1e3, &blocks);
        for mm in own.into_iter().take(2) {
            if !corrections.iter().any(|known| (known - mm).abs() < 1e-4) {
                corrections.push(mm);
            }
        }
    }
    corrections.truncate(CORRECTIONS);
    let courses: Vec<Course> = corrections.into_iter().map(Course::Beside).collect();
    let mut rounds = Rounds::default();
    rounds.add(drawn, &courses, None);
    anchor(traced, &rounds)
}

fn walls(contour: &Contour, scale: f64) -> Vec<Segment> {
    let segments = contour.segments.iter().filter(|_| contour.closed);
    segments.map(|one| scaled(&one.geometry, scale)).collect()
}

/// The contour beside which blocks run at one distance, the nearest of several, and that distance, µm.
fn along(
    blocks: &[Segment],
    walls: &[Vec<Segment>],
    placement: &Placement,
) -> Option<(usize, f64)> {
    let step = blocks.len().div_ceil(MEASURED).max(1);
    let points = blocks.iter().step_by(step);
    let points: Vec<_> = points.map(|it| placement.place(it.point_at(0.5))).collect();
    let own = Bounds::of_points(&points);
    let beside = |contour: &Vec<Segment>| {
        let mut bounds = Bounds::EMPTY;
        contour.iter().for_each(|it| bounds.merge(&it.bounds()));
        if contour.is_empty() || !bounds.grown(FARTHEST).touches(&own) {
            return None;
        }
        let away = points.iter().map(|&point| {
            let all = contour.iter().map(|it| it.distance_to(point));
            all.fold(f64::INFINITY, f64::min)
        });
        let mut away: Vec<f64> = away.collect();
        away.sort_by(f64::total_cmp);
        let middle = away[away.len() / 2];
        let alike = away
            .iter()
            .filter(|it| (*it - middle).abs() <= ALIKE)
            .count();
        (middle <= FARTHEST && 5 * alike >= 4 * away.len()).then_some(middle)
    };
    let each = walls.iter().enumerate();
    let each = each.filter_map(|(index, contour)| Some((index, beside(contour)?)));
    each.min_by(|a, b| a.1.total_cmp(&b.1))
}
