//! What happens while nobody stands at the machine: where it stops and waits, what is loose by then, and what falls by itself.
//!
//! The stops are those that a program is written with: before a tab is cut off, between passes and between contours as
//! settings and profile say. Lines of a profile that cut and thread the wire without M00 or M01 stop nothing.

use crate::document::Snapshot;
use crate::program::Format;
use crate::program::iso::block::{Block, Stop};
use crate::settings::{Effective, Jumps, Lead};
use crate::toolpath::{WirePath, Work};

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
