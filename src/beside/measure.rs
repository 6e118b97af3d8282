//! What can be measured in a program of ours: the contours that it cuts, its ways in, its tabs.

use super::drawn::Drawn;
use super::traced::{Block, Motion, Traced};
use crate::geometry::{Bounds, Segment, Vector, left_normal};
use crate::program::path::without_ways_back;
use std::ops::Range;

/// The largest distance between the boxes of passes of one contour, µm.
const BESIDE: f64 = 1_000.0;
/// The largest distance of places of one line from another that runs beside it, µm.
const PARALLEL: f64 = 3.0;
/// Arcs about one centre: where the machine counts, it drifts along a contour, µm.
const CONCENTRIC: f64 = 20.0;
/// The most blocks of a pass that are compared with those of the first.
const VOTERS: usize = 400;
/// The most pairs of boxes that are compared.
const MOST: usize = 2_000_000;
/// The most cuts of which the beginning and the overlap past their start are measured.
const ASKED: usize = 8;
/// The most lengths of ways in that are considered.
const LEADS: usize = 2;

/// The blocks that cut between two threadings: those of one contour, or of one pass.
fn cuts(traced: &Traced) -> impl Iterator<Item = Range<usize>> {
    let all = traced.cuts.iter().map(|[all, _]| all.clone());
    all.filter(|blocks| segments(traced, blocks.clone()).count() > 2)
}

fn segments(traced: &Traced, blocks: Range<usize>) -> impl Iterator<Item = &Segment> {
    segments_of(traced.blocks.get(blocks).unwrap_or_default())
}

fn segments_of(blocks: &[Block]) -> impl Iterator<Item = &Segment> {
    blocks.iter().filter_map(|block| block.segment())
}

/// The box of all between the first block and the last.
fn bounds(traced: &Traced, blocks: Range<usize>) -> Bounds {
    let count = segments(traced, blocks.clone()).count();
    let mut bounds = Bounds::EMPTY;
    let inner = segments(traced, blocks)
        .skip(1)
        .take(count.saturating_sub(2));
    inner.for_each(|segment| bounds.merge(&segment.bounds()));
    bounds
}

/// The distance between the middles of two boxes, and the difference of their sizes.
fn apart(one: &Bounds, other: &Bounds, shift: Vector) -> f64 {
    let middle = |bounds: &Bounds| (bounds.min.coords + bounds.max.coords) / 2.0;
    let away = (middle(one) - middle(other) - shift).norm();
    let wider = one.width() - other.width();
    let higher = one.height() - other.height();
    away + (wider - higher).abs() + wider.abs().max(higher.abs()) / 8.0
}

/// Whether two cuts are passes of one contour: one box holds them, or, where a sharp corner leads one of them farther
/// out, they run side by side.
fn are_passes(traced: &Traced, one: &Range<usize>, other: &Range<usize>) -> bool {
    let [own, next] = [one, other].map(|cut| bounds(traced, cut.clone()));
    if (own.min - next.min).amax() <= BESIDE && (own.max - next.max).amax() <= BESIDE {
        return true;
    }
    let is_like = |one: f64, other: f64| one.max(other) <= 2.0 * one.min(other);
    let are_alike = is_like(own.width(), next.width()) && is_like(own.height(), next.height());
    let (mut sum, mut beside) = (0.0, 0.0);
    for block in segments(traced, other.clone())
        .take(VOTERS)
        .filter(|_| are_alike)
    {
        let mut all = segments(traced, one.clone()).take(VOTERS);
        let is_near = |own: &Segment| aside(own, block).is_some_and(|by| by.abs() <= BESIDE);
        sum += block.length();
        beside += if all.any(is_near) {
            block.length()
        } else {
            0.0
        };
    }
    2.0 * beside > sum
}

/// The contours of the drawing that a program cuts, each by the name of one of its entities, in the order of the cuts;
/// `None` where that is not known or needs no setting.
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
    let mut first_passes: Vec<Range<usize>> = Vec::new();
    for cut in cuts(traced) {
        let is_same = |last: &Range<usize>| are_passes(traced, last, &cut);
        if !first_passes.last().is_some_and(is_same) {
            first_passes.push(cut);
        }
    }
    let groups = first_passes.into_iter().map(|cut| bounds(traced, cut));
    let groups: Vec<Bounds> = groups.collect();
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

/// A run from stop to stop, and the register at its start.
struct Run {
    segments: Vec<Segment>,
    register: Option<u32>,
}

impl AsRef<[Segment]> for Run {
    fn as_ref(&self) -> &[Segment] {
        &self.segments
    }
}

/// The passes of the longest contour, each from stop to stop; pieces that cut off its tab do not count, and neither do
/// ways back along a pass. Under the control these have its register; in 4B nothing tells them from passes that run back,
/// and they count as such.
pub(super) fn passes(traced: &Traced) -> Vec<Vec<Segment>> {
    let Some(longest) = cuts(traced).max_by_key(|cut| cut.len()) else {
        return Vec::new();
    };
    let beside = cuts(traced).filter(|cut| are_passes(traced, &longest, cut));
    let mut runs: Vec<Run> = Vec::new();
    for cut in beside {
        let blocks = traced.blocks.get(cut).unwrap_or_default();
        let pieces = blocks.split(|block| block.segment().is_none());
        runs.extend(pieces.map(|piece| Run {
            segments: segments_of(piece).copied().collect(),
            register: piece.iter().find_map(|block| block.register),
        }));
    }
    let length = |run: &Run| run.segments.iter().map(Segment::length).sum::<f64>();
    let longest = runs.iter().map(length).fold(0.0, f64::max);
    runs.retain(|run| 2.0 * length(run) > longest);
    let is_offset = traced.blocks.iter().any(Block::is_offset);
    let may_go_back = |one: &Run, other: &Run| match is_offset {
        true => one.register.is_some() && one.register == other.register,
        false => !traced.four_b,
    };
    let runs = without_ways_back(runs, PARALLEL, may_go_back).into_iter();
    runs.map(|run| run.segments).collect()
}

/// How many passes there are where those that go back along the one before are ways back.
pub(super) fn passes_one_way(passes: &[Vec<Segment>]) -> usize {
    without_ways_back(passes.iter().collect(), PARALLEL, |_, _| true).len()
}

/// How much nearer to the wall each pass runs than the first, µm: the distance that most of its length beside the first
/// has. `None` where the passes do not come nearer one after the other.
pub(super) fn steps(passes: &[Vec<Segment>]) -> Option<Vec<f64>> {
    let first = passes.first()?;
    let mut steps = vec![0.0];
    for pass in &passes[1..] {
        let blocks = pass.iter().take(VOTERS);
        let pairs = blocks.flat_map(|block| first.iter().take(VOTERS).map(move |own| (own, block)));
        let votes = pairs.filter_map(|(own, block)| Some((aside(own, block)?, block.length())));
        let mut votes: Vec<(f64, f64)> = votes
            .filter(|(away, _)| (PARALLEL / 2.0..=BESIDE).contains(&away.abs()))
            .collect();
        votes.sort_by(|one, other| one.0.total_cmp(&other.0));
        let about = |from: usize| {
            let near = votes[from..].iter();
            let near = near.take_while(|vote| vote.0 - votes[from].0 <= PARALLEL);
            near.fold((0.0, 0.0), |(sum, weight), (away, length)| {
                (sum + away * length, weight + length)
            })
        };
        let all = (0..votes.len()).map(about);
        let (sum, weight) = all.max_by(|one, other| one.1.total_cmp(&other.1))?;
        steps.push((sum / weight).abs());
    }
    steps.is_sorted().then_some(steps)
}

/// The distance to the left at which another line or arc runs beside one, µm.
fn aside(own: &Segment, other: &Segment) -> Option<f64> {
    match (own.as_arc(), other.as_arc()) {
        (Some(own), Some(other)) => {
            let is_about = (own.center - other.center).norm() <= CONCENTRIC;
            is_about.then_some((own.radius - other.radius) * own.sweep.signum())
        }
        (None, None) => {
            let middle = own.share_of(other.point_at(0.5));
            let normal = left_normal(own.start_tangent());
            let [from, to] =
                [other.start(), other.end()].map(|place| normal.dot(&(place - own.start())));
            let is_beside = (0.0..=1.0).contains(&middle) && (to - from).abs() <= PARALLEL;
            is_beside.then_some((from + to) / 2.0)
        }
        _ => None,
    }
}

/// The ways in and out of the first cuts, µm.
fn ways(traced: &Traced) -> impl Iterator<Item = f64> {
    let cuts = traced.cuts.iter().take(ASKED);
    cuts.flat_map(|[all, contour]| {
        let way = |blocks: Range<usize>| segments(traced, blocks).map(Segment::length).sum::<f64>();
        [way(all.start..contour.start), way(contour.end..all.end)]
    })
}

/// How much longer the ways of a program are than those of another one, µm: what most of them say comes first. From
/// a hole to the wire's path they are shorter by the correction.
pub(super) fn longer_ways(traced: &Traced, than: &Traced) -> Vec<f64> {
    let by = ways(traced).zip(ways(than)).map(|(own, other)| own - other);
    let mut by: Vec<f64> = by.filter(|by| (1.0..=BESIDE).contains(&by.abs())).collect();
    by.sort_by(f64::total_cmp);
    let mut groups: Vec<&[f64]> = by.chunk_by(|one, next| next - one <= 1.0).collect();
    groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
    let middles = groups.into_iter().take(LEADS);
    middles.map(|group| group[group.len() / 2]).collect()
}

/// The possible settings of the ways' length, mm, the longest first: a way is shorter where there is no room. And
/// whether the setting is stated: then it counts from the path, else from the contour. Those that are stated come first:
/// the others depend on the correction as well.
pub(super) fn leads(traced: &Traced, correction: f64) -> Vec<(f64, Option<f64>)> {
    // From the hole to the contour, whichever way the wire goes: an arc ends tangent to the contour, and looks like a part of it.
    let lead = |[all, contour]: &[Range<usize>; 2]| -> f64 {
        let mut blocks = segments(traced, all.clone()).skip(1);
        let by_arc = blocks.next().is_some_and(|next| next.as_arc().is_some());
        let is_circle = segments(traced, all.clone()).count() < 4;
        let least = if by_arc && !is_circle { 2 } else { 1 };
        let mut lead = segments(traced, all.start..contour.start.max(all.start + least));
        let Some(first) = lead.next() else {
            return 0.0;
        };
        (lead.last().unwrap_or(first).end() - first.start()).norm()
    };
    let mut lengths: Vec<f64> = traced.cuts.iter().take(ASKED).map(lead).collect();
    let first = lengths.first().copied();
    lengths.sort_by(|one, other| other.total_cmp(one));
    lengths.dedup_by(|one, other| (*one - *other).abs() <= 2.0);
    lengths.truncate(LEADS);
    // Passes after the first come nearer to the wall.
    lengths.extend(first);
    lengths.dedup();
    let is_offset = traced.blocks.iter().any(|block| block.is_offset());
    let of = |um: f64| {
        let unstated = hundredths(um + correction * 1e3);
        // The control adds the correction to the way that is written, or takes it away.
        let stated = [um, um - correction * 1e3].into_iter();
        let stated = stated
            .filter(|um| *um > 0.0)
            .take(if is_offset { 2 } else { 1 });
        let stated = stated.flat_map(|um| [hundredths(um), um.round() / 1e3]);
        let stated = stated.map(|length| (length, Some(length)));
        stated.chain([(unstated, None)])
    };
    lengths.into_iter().flat_map(of).collect()
}

fn hundredths(um: f64) -> f64 {
    (um / 10.0).round() / 100.0
}

/// The most lengths that are considered for one setting.
const LENGTHS: usize = 48;

/// Adds a length, in hundredths of a millimetre, unless it is there.
fn note(found: &mut Vec<f64>, um: f64) {
    let mm = hundredths(um);
    if mm > 0.0 && found.len() < LENGTHS && !found.contains(&mm) {
        found.push(mm);
    }
}

/// Round numbers come first: settings are more likely round.
fn round_first(found: &mut [f64]) {
    let hundredths = |mm: &f64| (mm * 100.0).round() as i64;
    found.sort_by_key(|mm| [50, 10, 5].map(|round| hundredths(mm) % round != 0));
}

/// How far a program may go on past its start, mm; first, not at all. It does so in the blocks before its way out.
pub(super) fn overlaps(traced: &Traced) -> Vec<f64> {
    let mut found = vec![0.0];
    for cut in cuts(traced).take(ASKED) {
        let own: Vec<&Segment> = segments(traced, cut).collect();
        for ways_out in 1..=2 {
            let mut sum = 0.0;
            for segment in own.iter().rev().skip(ways_out).take(3) {
                sum += segment.length();
                note(&mut found, sum);
            }
        }
    }
    round_first(&mut found);
    found
}

/// A way aside that deviates by no more from several others is a slip, mm.
const SLIP: f64 = 0.01;

/// What the control may add in each pass, mm, where the wire moves aside at a tab to switch the correction, in the order
/// of the program: the way aside is longer by a hundredth.
pub(super) fn switching(traced: &Traced) -> Vec<f64> {
    let correction = |um: f64| (um - 10.0).round() / 1e3;
    let aside = traced.blocks.windows(3).filter_map(|three| {
        let [before, own, behind] = three else {
            return None;
        };
        let is_aside = before.is_offset() && !own.is_offset() && behind.motion == Motion::Stop;
        let length = own.segment().filter(|_| is_aside)?.length();
        (20.0..BESIDE).contains(&length).then(|| correction(length))
    });
    let mut counted: Vec<(f64, usize)> = Vec::new();
    for mm in aside {
        match counted.iter_mut().find(|(own, _)| *own == mm) {
            Some((_, count)) => *count += 1,
            None => counted.push((mm, 1)),
        }
    }
    // One of many may have been changed.
    let is_slip = |(mm, count): (f64, usize)| {
        let mut others = counted.iter();
        others.any(|(other, more)| *more > count && (other - mm).abs() <= SLIP)
    };
    let kept = counted.iter().filter(|one| !is_slip(**one));
    let mut all: Vec<f64> = kept.map(|(mm, _)| *mm).collect();
    // Where the wire does not stop there, its shortest block is that way.
    if all.is_empty() {
        let lengths = traced.blocks.iter();
        let lengths = lengths.filter_map(|block| Some(block.segment()?.length()));
        let least = lengths
            .filter(|length| *length > 20.0)
            .fold(f64::INFINITY, f64::min);
        all.extend((least < BESIDE).then(|| correction(least)));
    }
    all
}
