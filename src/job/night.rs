//! What happens while nobody stands at the machine: where it stops and waits, what is loose by then, and what falls by itself.
//!
//! The stops are those that a program is written with: before a tab is cut off, between passes and between contours as
//! settings and profile say. Lines of a profile that cut and thread the wire without M00 or M01 stop nothing.

use crate::document::Snapshot;
use crate::message::duration;
use crate::program::Format;
use crate::program::iso::block::{Block, Stop};
use crate::settings::{Effective, Jumps, Lead};
use crate::toolpath::{Nesting, WirePath, Work};

/// The most contours named in one sentence.
const MOST_NAMED: usize = 8;
/// Another order that wins no more than this is not worth a thought, minutes.
const WORTH_SAYING: f64 = 1.0;

/// One path of the cut, and what is the case when it is done.
pub(crate) struct Watch {
    /// Index of the outline.
    pub(crate) outline: usize,
    pub(crate) pass: usize,
    pub(crate) cut_off: bool,
    /// Minutes from the beginning of the first cut on, where the times are known.
    pub(crate) until: Option<f64>,
    /// What has come loose.
    pub(crate) loose: Option<Loose>,
    /// The machine waits for somebody behind it, or the program ends.
    pub(crate) waits: bool,
}

/// A piece that nothing holds any more.
pub(crate) struct Loose {
    pub(crate) is_slug: bool,
    /// g; of a slug, where the height is known.
    pub(crate) mass: Option<f64>,
    /// The machine has stopped just before: somebody stands by.
    pub(crate) is_watched: bool,
}

/// Each path of `paths`, whose totals are `work`, as `format` is written.
pub(crate) fn night(
    snapshot: &Snapshot,
    paths: &[WirePath],
    work: &Work,
    format: Format,
) -> Vec<Watch> {
    let settings = &*snapshot.settings;
    let cut: Vec<&WirePath> = paths.iter().filter(|path| !path.is_way_back).collect();
    let keeps_tab = |outline: usize| {
        cut.iter()
            .any(|path| path.outline == outline && path.cut_off)
    };
    let mut minutes = Some(0.0);
    let watched = cut.iter().zip(&work.cuts).enumerate();
    watched
        .map(|(index, (path, totals))| {
            minutes = minutes.zip(totals.minutes).map(|(sum, own)| sum + own);
            let next = cut.get(index + 1);
            // All passes go round what the first one has cut free, but for a tab.
            let frees = path.pass == 1 && path.cut_off == keeps_tab(path.outline);
            let outline = snapshot.outlines.get(path.outline);
            let outline = outline.filter(|outline| frees && outline.contour.closed);
            let slug = work.slugs.iter().find(|slug| slug.outline == path.outline);
            Watch {
                outline: path.outline,
                pass: path.pass,
                cut_off: path.cut_off,
                until: minutes,
                loose: outline.map(|outline| Loose {
                    is_slug: settings.has_waste_inside(outline.role),
                    mass: slug.map(|slug| slug.mass),
                    is_watched: path.cut_off,
                }),
                waits: next.is_none_or(|next| waits_before(path, next, settings, format)),
            }
        })
        .collect()
}

/// The minutes until somebody has to come for the first time, and whether the program has ended by then.
pub(crate) fn alone(night: &[Watch]) -> Option<(f64, bool)> {
    let first = night.iter().position(|watch| watch.waits)?;
    Some((night.get(first)?.until?, first + 1 == night.len()))
}

/// How long the machine runs alone, what falls meanwhile, and in which order it would run longest; nothing of a single cut.
pub(crate) fn unattended(snapshot: &Snapshot, night: &[Watch]) -> Vec<String> {
    if night.len() < 2 {
        return Vec::new();
    }
    let names = |outlines: &[usize]| {
        let names = outlines.iter().take(MOST_NAMED).map(|&outline| {
            let outline = snapshot.outlines.get(outline);
            outline.map_or("?", |outline| outline.name(&snapshot.drawing))
        });
        let more = (outlines.len() > MOST_NAMED).then_some("…");
        names.chain(more).collect::<Vec<_>>().join(say!(comma))
    };
    let mut sentences = Vec::new();
    let alone = alone(night);
    if let Some((minutes, is_end)) = alone {
        sentences.push(match is_end {
            true => say!(it_runs_alone_to_its_end, duration(minutes)),
            false => say!(it_runs_alone, duration(minutes)),
        });
    }
    let falls = |watch: &&Watch| {
        let loose = watch.loose.as_ref();
        loose.is_some_and(|loose| !loose.is_watched)
    };
    let falling: Vec<usize> = night.iter().filter(falls).map(|it| it.outline).collect();
    if !falling.is_empty() {
        sentences.push(say!(it_falls_unattended, names(&falling)));
    }
    if let Some((now, false)) = alone
        && let Some((minutes, first)) = longest_alone(snapshot, night)
        && minutes > now + WORTH_SAYING
    {
        sentences.push(say!(
            it_would_run_longest_alone,
            duration(minutes),
            names(&first)
        ));
    }
    sentences
}

/// All passes along one contour.
struct Stay {
    outline: usize,
    /// Minutes until the machine waits within it, else until it is done.
    alone: f64,
    waits_within: bool,
}

/// The contours to begin with so that nobody has to come for the longest time, and that time in minutes: all those during
/// which the machine never waits, then the one that it works on longest. What lies within a contour is cut before it.
fn longest_alone(snapshot: &Snapshot, night: &[Watch]) -> Option<(f64, Vec<usize>)> {
    let mut stays: Vec<Stay> = Vec::new();
    let (mut begin, mut waits_between) = (0.0, false);
    for passes in night.chunk_by(|one, next| one.outline == next.outline) {
        let (last, before) = passes.split_last()?;
        let wait = before.iter().find(|watch| watch.waits);
        stays.push(Stay {
            outline: last.outline,
            alone: wait.unwrap_or(last).until? - begin,
            waits_within: wait.is_some(),
        });
        begin = last.until?;
        let is_end = std::ptr::eq(last, night.last()?);
        waits_between |= last.waits && !is_end;
    }
    let chosen: Vec<usize> = stays.iter().map(|stay| stay.outline).collect();
    let around = Nesting::new(&snapshot.drawing, &snapshot.outlines, &chosen).around;
    let mut left: Vec<(usize, &Stay, Vec<usize>)> = (0..)
        .zip(&stays)
        .zip(around)
        .map(|((place, stay), around)| (place, stay, around))
        .collect();
    let holds_none = |left: &[(usize, &Stay, Vec<usize>)], place: usize| {
        left.iter().all(|(_, _, around)| !around.contains(&place))
    };
    let mut order = Vec::new();
    while let Some(next) = left.iter().position(|(place, stay, _)| {
        !waits_between && !stay.waits_within && holds_none(&left, *place)
    }) {
        order.push(left.remove(next).1);
    }
    let last = left
        .iter()
        .filter(|(place, ..)| holds_none(&left, *place))
        .map(|(_, stay, _)| *stay);
    order.extend(last.max_by(|one, other| one.alone.total_cmp(&other.alone)));
    let minutes = order.iter().map(|stay| stay.alone).sum();
    Some((minutes, order.iter().map(|stay| stay.outline).collect()))
}

fn waits_before(path: &WirePath, next: &WirePath, settings: &Effective, format: Format) -> bool {
    let profile = settings.profile.as_ref().ok();
    let profile = profile.filter(|_| format == Format::Iso);
    let is_stop = |line: &String| Block::of(line.as_bytes()).stop == Some(Stop::Pause);
    let stops = |lines: &[String]| lines.iter().any(is_stop);
    let is_same = path.outline == next.outline;
    if next.goes_back_along_tab() {
        return false;
    }
    if next.cut_off && next.pass == 1 {
        return true;
    }
    let word = settings.pause_between_passes.as_deref();
    // Where only a stop shows where a pass ends, one stands.
    let is_simple = settings.closing_overlap == 0.0 && settings.lead != Lead::Arc;
    let is_shown = next.returns() && is_simple;
    if is_same && (is_shown || word.is_some_and(|word| !word.is_empty())) {
        return match (word, profile) {
            (Some(""), _) if format != Format::FourB => false,
            (None, Some(profile)) => stops(&profile.pause_between_passes),
            _ => true,
        };
    }
    let is_by_hand = settings.jumps == Jumps::None && !is_same;
    is_by_hand || profile.is_none_or(|profile| stops(&profile.pause))
}
