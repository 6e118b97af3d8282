//! What can be measured in a program that is ours: which contours it cuts, how it comes to them, what it leaves standing.

use super::drawn::Drawn;
use super::traced::Traced;
use crate::geometry::{Bounds, Segment, Vector, left_normal};
use std::ops::Range;

/// Boxes of passes of one contour lie so near to each other, µm.
const BESIDE: f64 = 1_000.0;
/// Places of one line lie so near to another that runs beside it, µm.
const PARALLEL: f64 = 3.0;
/// Pairs of boxes that are compared, at most.
const MOST: usize = 2_000_000;
/// Cuts that are asked how they begin, and how far they go on past their start, at most.
const ASKED: usize = 8;
/// Lengths of ways in that are thought of, at most.
const LEADS: usize = 2;

/// The blocks that cut from one threading to the next: those of one contour, or of one pass.
fn cuts(traced: &Traced) -> impl Iterator<Item = Range<usize>> {
    let all = traced.cuts.iter().map(|[all, _]| all.clone());
    all.filter(|blocks| segments(traced, blocks.clone()).count() > 2)
}

fn segments(traced: &Traced, blocks: Range<usize>) -> impl Iterator<Item = &Segment> {
    let blocks = traced.blocks.get(blocks).unwrap_or_default();
    blocks.iter().filter_map(|block| block.segment())
}

/// The box of what lies between the first block and the last.
fn bounds(traced: &Traced, blocks: Range<usize>) -> Bounds {
    let count = segments(traced, blocks.clone()).count();
    let mut bounds = Bounds::EMPTY;
    let inner = segments(traced, blocks)
        .skip(1)
        .take(count.saturating_sub(2));
    inner.for_each(|segment| bounds.merge(&segment.bounds()));
    bounds
}

/// How far apart the middles of two boxes lie, and by how much the one is larger.
fn apart(one: &Bounds, other: &Bounds, shift: Vector) -> f64 {
    let middle = |bounds: &Bounds| (bounds.min.coords + bounds.max.coords) / 2.0;
    let away = (middle(one) - middle(other) - shift).norm();
    let wider = one.width() - other.width();
    let higher = one.height() - other.height();
    away + (wider - higher).abs() + wider.abs().max(higher.abs()) / 8.0
}

/// The contours of the drawing that a program cuts, each by the name of one of its entities, in the order in which they are cut; `None` where
/// that is not known, and where nothing is to be said of it.
pub(super) fn contours(drawn: &Drawn, traced: &Traced) -> Option<Vec<String>> {
    let scale = drawn.unit_mm * 1e3;
    let outlines: Vec<(Bounds, &str)> = drawn
        .contours()
        .iter()
        .zip(drawn.cut())
        .filter_map(|(contour, outline)| {
            let mut bounds = Bounds::EMPTY;
            for segment in &contour.segments {
                bounds.merge(&segment.geometry.bounds());
            }
            let entity = outline.contour.pieces.first()?.entity;
            let of = Bounds {
                min: bounds.min * scale,
                max: bounds.max * scale,
            };
            Some((of, drawn.handle(entity)))
        })
        .collect();
    let mut groups: Vec<Bounds> = Vec::new();
    for cut in cuts(traced) {
        let own = bounds(traced, cut);
        let is_same = |last: &Bounds| {
            (last.min - own.min).amax() <= BESIDE && (last.max - own.max).amax() <= BESIDE
        };
        if !groups.last().is_some_and(is_same) {
            groups.push(own);
        }
    }
    let first = *groups.first()?;
    let pairs = outlines
        .len()
        .saturating_mul(outlines.len())
        .saturating_mul(groups.len());
    if groups.len() > outlines.len() || pairs > MOST {
        return None;
    }
    let middle = |bounds: &Bounds| (bounds.min.coords + bounds.max.coords) / 2.0;
    let shifts = outlines.iter().map(|(own, _)| middle(&first) - middle(own));
    let shifts = std::iter::once(Vector::zeros()).chain(shifts);
    let mut best: Option<(f64, Vec<usize>)> = None;
    for shift in shifts {
        let (mut sum, mut chosen) = (0.0, Vec::with_capacity(groups.len()));
        for group in &groups {
            let of = |index: &usize| apart(group, &outlines[*index].0, shift);
            let left = (0..outlines.len()).filter(|index| !chosen.contains(index));
            let nearest = left.min_by(|one, other| of(one).total_cmp(&of(other)))?;
            sum += of(&nearest);
            chosen.push(nearest);
        }
        if best.as_ref().is_none_or(|(least, _)| sum < *least) {
            best = Some((sum, chosen));
        }
    }
    let (_, chosen) = best?;
    let names = chosen.into_iter().map(|index| outlines[index].1.to_owned());
    Some(names.collect())
}

/// The blocks of the longest contour, those of each pass by themselves where the wire stops between them.
pub(super) fn rounds(traced: &Traced) -> Vec<Vec<Segment>> {
    let Some(longest) = cuts(traced).max_by_key(|cut| cut.len()) else {
        return Vec::new();
    };
    let own = bounds(traced, longest);
    let beside = cuts(traced).filter(|cut| {
        let other = bounds(traced, cut.clone());
        (other.min - own.min).amax() <= BESIDE && (other.max - own.max).amax() <= BESIDE
    });
    beside
        .map(|cut| segments(traced, cut).copied().collect())
        .collect()
}

/// The same of all passes together.
pub(super) fn first(traced: &Traced) -> Vec<Segment> {
    rounds(traced).concat()
}

/// How much nearer to the wall each pass of the longest contour runs than the first, mm: along its longest line, or about its largest arc.
pub(super) fn steps(traced: &Traced) -> Vec<f64> {
    let blocks = first(traced);
    let longest = |is_arc: bool| {
        let own = blocks.iter().filter(|it| it.as_arc().is_some() == is_arc);
        own.max_by(|one, other| one.length().total_cmp(&other.length()))
    };
    let beside = |along: &Segment| -> Vec<f64> {
        let of = |block: &Segment| match (along.as_arc(), block.as_arc()) {
            (Some(one), Some(other)) => {
                let is_about = (one.center - other.center).norm() <= PARALLEL;
                is_about.then_some(other.radius - one.radius)
            }
            (None, None) if 2.0 * block.length() > along.length() => {
                let middle = along.share_of(block.point_at(0.5));
                if !(0.0..=1.0).contains(&middle) {
                    return None;
                }
                let [from, to] = [block.start(), block.end()]
                    .map(|place| left_normal(along.start_tangent()).dot(&(place - along.start())));
                ((to - from).abs() <= PARALLEL).then_some((from + to) / 2.0)
            }
            _ => None,
        };
        let near = |away: &f64| away.abs() <= BESIDE;
        let mut all: Vec<f64> = Vec::new();
        for away in blocks.iter().filter_map(of).filter(near) {
            if all.iter().all(|known| (known - away).abs() > PARALLEL) {
                all.push(away);
            }
        }
        let first = all.first().copied().unwrap_or_default();
        all.into_iter()
            .map(|away| (away - first).abs() / 1e3)
            .collect()
    };
    let lines = longest(false).map(beside);
    let falls = |steps: &Vec<f64>| steps.len() > 1 && steps.is_sorted();
    let found = lines.filter(falls).or_else(|| longest(true).map(beside));
    found.filter(falls).unwrap_or_default()
}

/// How often a place on the way round is passed at most, nearly: how many passes there may be.
pub(super) fn passes(traced: &Traced) -> usize {
    let blocks = first(traced);
    let Some(middle) = blocks
        .iter()
        .max_by(|one, other| one.length().total_cmp(&other.length()))
    else {
        return 0;
    };
    let at = middle.point_at(0.5);
    let near = |segment: &&Segment| segment.distance_to(at) <= BESIDE / 2.0;
    blocks.iter().filter(near).count()
}

/// How long the ways in may be set to be, mm, the longest first: where there is no room, one is shorter. And whether that is stated: then it
/// counts from the path, else from the contour.
pub(super) fn leads(traced: &Traced, correction: f64) -> Vec<(f64, Option<f64>)> {
    let lead = |[all, contour]: &[Range<usize>; 2]| -> f64 {
        let lead = segments(traced, all.start..contour.start.max(all.start + 1));
        lead.map(Segment::length).sum()
    };
    let mut lengths: Vec<f64> = traced.cuts.iter().take(ASKED).map(lead).collect();
    lengths.sort_by(|one, other| other.total_cmp(one));
    lengths.dedup_by(|one, other| (*one - *other).abs() <= 2.0);
    lengths.truncate(LEADS);
    let is_offset = traced.blocks.iter().any(|block| block.is_offset);
    let of = |um: f64| {
        let unstated = hundredths(um + correction * 1e3);
        // The control adds the correction to the way that is written, or takes it away.
        let stated = [um, um - correction * 1e3].into_iter();
        let stated = stated
            .filter(|um| *um > 0.0)
            .take(if is_offset { 2 } else { 1 });
        let stated = stated.flat_map(|um| [hundredths(um), um.round() / 1e3]);
        let stated = stated.map(|length| (length, Some(length)));
        std::iter::once((unstated, None)).chain(stated)
    };
    lengths.into_iter().flat_map(of).collect()
}

fn hundredths(um: f64) -> f64 {
    (um / 10.0).round() / 100.0
}

/// Lengths that are thought of for one setting, at most.
const LENGTHS: usize = 48;

/// Adds a length, in hundredths of a millimetre, where it is another one.
fn note(found: &mut Vec<f64>, um: f64) {
    let mm = hundredths(um);
    if mm > 0.0 && found.len() < LENGTHS && !found.contains(&mm) {
        found.push(mm);
    }
}

/// Somebody sets a round number rather than another.
fn round_first(found: &mut [f64]) {
    let hundredths = |mm: &f64| (mm * 100.0).round() as i64;
    found.sort_by_key(|mm| [50, 10, 5].map(|round| hundredths(mm) % round != 0));
}

/// How far a program may go on past its start, mm; not at all first. It does so in the blocks before its way out.
pub(super) fn overlaps(traced: &Traced) -> Vec<f64> {
    let mut found = vec![0.0];
    for cut in cuts(traced).take(ASKED) {
        let own: Vec<&Segment> = segments(traced, cut).collect();
        for ways_out in 1..=2 {
            let mut sum = 0.0;
            for segment in own.iter().rev().skip(ways_out).take(2) {
                sum += segment.length();
                note(&mut found, sum);
            }
        }
    }
    round_first(&mut found);
    found
}

/// What the control may add, mm, where the wire goes aside at a tab to have it switched: the shortest block is longer by a hundredth.
pub(super) fn aside(traced: &Traced) -> Option<f64> {
    let lengths = traced
        .blocks
        .iter()
        .filter_map(|block| Some(block.segment()?.length()));
    let least = lengths
        .filter(|length| *length > 20.0)
        .fold(f64::INFINITY, f64::min);
    (least < BESIDE).then_some((least - 10.0).round() / 1e3)
}
