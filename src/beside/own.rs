//! A program as we write it for its drawing, block by block.
//!
//! The drawing's program is written anew under the same settings. Where that has the same blocks but for a few, somebody has changed those:
//! each is named, in whatever number it was changed, and nothing else is. Of everything else nothing is known here.

use super::anew::Anew;
use super::comparison::{Comparison, Difference, FEW, longest_cut, looked_at};
use super::drawn::Drawn;
use super::infer;
use super::traced::{Block, Motion, Traced};
use super::walk::Kind;
use crate::drawing::EntityId;
use crate::geometry::{Point, Vector};
use crate::settings::{Compensation, Corner, Direction, Effective};

/// How far a block may lie from the one that is written anew, or one of its numbers from that, µm.
const ALIKE: f64 = 2.0;
/// Where the blocks of a program lie as near as this in the mean, it was written with just these settings, µm.
const SAME: f64 = 1e-2;
/// Where they lie farther away than this in the mean, another writer wrote it, µm.
const OURS: f64 = 0.5;
/// What a way in or out, or between contours, is off by more is meant: its hole is elsewhere, µm.
const SLIP: f64 = 50.0;
/// Blocks that are written anew under other settings, at most.
const MOST_TRIED: usize = 30_000;

/// Holds a program against a drawing; `None` where it follows nothing of it.
///
/// A program that is ours is known block by block, and so is a change of 3 µm in it; one of another writer has room for its roundings.
pub fn compare(drawn: &Drawn, traced: &Traced) -> Option<Comparison> {
    let known = own(drawn, traced, &drawn.settings).map(|(known, _)| known);
    // One may be as another writer has it in a place or two.
    let is_certain = |known: &Comparison| known.differences.len() < 2;
    if known.as_ref().is_some_and(is_certain) {
        return known;
    }
    let Some(known) = known else {
        return otherwise(drawn, traced).or_else(|| looked_at(drawn, traced));
    };
    let seen = looked_at(drawn, traced);
    let is_clean = |seen: &Comparison| seen.differences.is_empty();
    seen.filter(is_clean).or(Some(known))
}

/// What somebody has changed in a program that is ours by other settings: its correction, direction, corners and way in are found out.
fn otherwise(drawn: &Drawn, traced: &Traced) -> Option<Comparison> {
    let settings = &*drawn.settings;
    if settings.corrections.len() > 1 {
        return None;
    }
    let is_offset = traced.blocks.iter().any(|block| block.is_offset);
    let base = Effective {
        compensation: match (settings.compensation, is_offset) {
            (Compensation::Path, true) => Compensation::Controller,
            (Compensation::Controller, false) => Compensation::Path,
            (set, _) => set,
        },
        ..settings.clone()
    };
    let ways = [Direction::Ccw, Direction::Cw, Direction::AsDrawn];
    let corners = [Corner::Arc, Corner::Intersection];
    let mut all = Vec::new();
    for lead_in in [None, Some(lead_in(traced)?)] {
        for correction in corrections(drawn, traced) {
            all.extend(ways.map(|way| corners.map(|corner| (lead_in, correction, way, corner))));
        }
    }
    let drawn_segments = drawn.cut().map(|outline| outline.contour.len());
    let tries = MOST_TRIED / traced.blocks.len().max(drawn_segments.sum()).max(1);
    let all = all.into_iter().flatten().take(tries);
    let mut best: Option<(Comparison, f64)> = None;
    for (lead_in, correction, direction, corner) in all {
        let settings = Effective {
            correction,
            corrections: vec![correction],
            direction,
            corner,
            lead_in: lead_in.unwrap_or(base.lead_in),
            stated_lead_in: lead_in.or(base.stated_lead_in),
            ..base.clone()
        };
        let told = own(drawn, traced, &settings);
        let told = told.filter(|(told, mean)| told.differences.len() < 2 && *mean < OURS);
        if let Some(told) = told
            && best.as_ref().is_none_or(|(_, least)| told.1 < *least)
        {
            let is_exact = told.1 < SAME;
            best = Some(told);
            if is_exact {
                break;
            }
        }
    }
    best.map(|(told, _)| told)
}

/// Corrections that a program may have been written with, mm: of three places.
fn corrections(drawn: &Drawn, traced: &Traced) -> Vec<f64> {
    let scale = drawn.unit_mm * 1e3;
    let speaks_for = infer::corrections(drawn.contours().iter(), scale, &longest_cut(traced));
    let arcs = traced
        .blocks
        .iter()
        .filter_map(|block| block.segment()?.as_arc());
    // Round a corner it is the radius; a transition of 4B is larger by a step.
    let least = arcs
        .map(|arc| arc.radius / 1e3)
        .fold(f64::INFINITY, f64::min);
    let least = least.is_finite().then_some([least, least - 1e-3]);
    let rounded = speaks_for
        .into_iter()
        .take(2)
        .chain(least.into_iter().flatten());
    let near = |mm: f64| [0.0, -1e-3, 1e-3].map(|by| ((mm + by) * 1e3).round() / 1e3);
    let mut all = vec![drawn.settings.correction];
    for mm in rounded.flat_map(near).filter(|mm| *mm > 0.0) {
        if !all.contains(&mm) {
            all.push(mm);
        }
    }
    // A shorter number first.
    let places = |mm: &f64| (*mm * 1e3).round() as i64;
    all[1..].sort_by_key(|mm| (places(mm) % 5 != 0, places(mm) % 10 != 0));
    all
}

/// The length of the first way in, mm.
fn lead_in(traced: &Traced) -> Option<f64> {
    let [all, contour] = traced.cuts.first()?;
    let blocks = traced.blocks.get(all.start..contour.start)?;
    let length: f64 = blocks
        .iter()
        .filter_map(|block| Some(block.segment()?.length()))
        .sum();
    Some((length / 10.0).round() / 100.0)
}

/// What somebody has changed in a program that is ours under these settings, and how far the other blocks are off in the mean, µm; `None`
/// where it is not.
fn own(drawn: &Drawn, traced: &Traced, settings: &Effective) -> Option<(Comparison, f64)> {
    let anew = &*drawn.anew(traced, settings)?;
    if anew.traced.blocks.len() != traced.blocks.len() {
        return None;
    }
    let words: Vec<Words> = pairs(traced, anew)
        .map(|(own, meant)| Words::of(traced, own, anew, meant))
        .collect();
    // Placed where the drawing is, or anywhere.
    let anywhere = traced.begin()? - anew.traced.begin()?;
    let as_drawn = (traced.is_placed && anew.traced.is_placed).then(Vector::zeros);
    let fewer = |(told, _): &(Comparison, f64)| told.differences.len();
    let all = as_drawn.into_iter().chain([anywhere]);
    all.filter_map(|from| told(anew, traced, &words, from))
        .min_by_key(fewer)
}

fn pairs<'a>(traced: &'a Traced, anew: &'a Anew) -> impl Iterator<Item = (&'a Block, &'a Block)> {
    traced.blocks.iter().zip(&anew.traced.blocks)
}

/// The words of a block beside those of the one that is written anew.
struct Words {
    /// They are the same.
    are_same: bool,
    /// By how much one of the numbers is another one, where all else is the same, µm.
    apart: Option<f64>,
    /// The same of the coordinates behind the block.
    stated: f64,
}

impl Words {
    fn of(traced: &Traced, own: &Block, anew: &Anew, meant: &Block) -> Words {
        let anew = &anew.traced;
        if traced.line_from(own) == anew.line_from(meant) {
            return Words {
                are_same: true,
                apart: Some(0.0),
                stated: 0.0,
            };
        }
        let (said, expected) = (traced.said(own), anew.said(meant));
        let stated = match (said.stated, expected.stated) {
            (Some([x, y]), Some([meant_x, meant_y])) => {
                (x - meant_x).abs().max((y - meant_y).abs())
            }
            _ => 0.0,
        };
        Words {
            are_same: said.is_like(&expected),
            apart: said.apart(&expected),
            stated,
        }
    }
}

/// The same for a program that lies so far from the one that is written anew.
fn told(anew: &Anew, traced: &Traced, words: &[Words], from: Vector) -> Option<(Comparison, f64)> {
    let rewritten = words.iter().filter(|words| !words.are_same).count();
    let is_in_our_words = 2 * rewritten <= traced.blocks.len();
    let (mut found, mut stated) = (Vec::new(), Vec::new());
    let (mut before, mut beside) = (false, 0.0);
    for ((own, meant), words) in pairs(traced, anew).zip(words) {
        let is_first = !std::mem::take(&mut before);
        if own.is_offset != meant.is_offset {
            return None;
        }
        let away = away(&own.motion, &meant.motion, from, !is_first)?;
        let off = match words.apart {
            Some(apart) if is_in_our_words => away.max(apart),
            _ => away,
        };
        if off <= ALIKE {
            beside += away;
            let off = words.stated;
            stated.extend((off > ALIKE).then(|| named(own, None, off, Kind::Stated)));
            continue;
        }
        if words.are_same {
            // The same words mean something else behind a block that ends elsewhere, or under another mode.
            if is_first {
                return None;
            }
            continue;
        }
        let (segment, kind) = match anew.source_of(&meant.motion) {
            Some(segment) => (Some(segment), Kind::Block),
            None if off <= SLIP => (None, Kind::Lead),
            None => return None,
        };
        found.push(named(own, segment, off, kind));
        before = true;
    }
    if found.len() > FEW.min(traced.blocks.len() / 3) {
        return None;
    }
    if stated.len() <= FEW {
        found.append(&mut stated);
    }
    found.extend(begun_elsewhere(traced, &anew.traced));
    found.sort_by_key(|difference| difference.range.start);
    let contours = anew
        .traced
        .cuts
        .iter()
        .flat_map(|[_, contour]| contour.clone());
    let cut = contours.filter_map(|index| traced.blocks.get(index));
    let follows = cut.filter(|block| matches!(block.motion, Motion::Cut(_)));
    let told = Comparison {
        follows: follows.map(|block| block.range.clone()).collect(),
        differences: found,
    };
    Some((told, beside / traced.blocks.len() as f64))
}

fn named(block: &Block, segment: Option<(EntityId, usize)>, off: f64, kind: Kind) -> Difference {
    Difference {
        range: block.range.clone(),
        line: block.line,
        segment,
        off: off / 1e3,
        kind,
    }
}

/// The line with which an ISO program says where it begins, where that is a little beside its place.
fn begun_elsewhere(traced: &Traced, anew: &Traced) -> Option<Difference> {
    if traced.counts {
        return None;
    }
    let said = |of: &Traced| {
        let first = of.blocks.first()?.line;
        let lines = (0..first).map(|line| (line, of.text.line_range(line)));
        let mut words = lines.map(|(line, range)| (line, range.clone(), of.said_in(range)));
        words.find(|(_, _, said)| said.sets_place())
    };
    let ((line, range, own), (.., meant)) = (said(traced)?, said(anew)?);
    let off = own
        .apart(&meant)
        .filter(|off| (ALIKE..=SLIP).contains(off))?;
    Some(Difference {
        range,
        line,
        segment: None,
        off: off / 1e3,
        kind: Kind::Lead,
    })
}

/// How far one motion is from another, counted from where it begins or from where the program does; `None` where they are of two kinds.
///
/// `behind` a block that ends elsewhere the radius of an arc is enough: with it, its centre is elsewhere too.
fn away(own: &Motion, meant: &Motion, from: Vector, behind: bool) -> Option<f64> {
    let ends = |[start, end]: [Point; 2], [meant_start, meant_end]: [Point; 2]| {
        let counted = (end - start) - (meant_end - meant_start);
        let placed = end - from - meant_end;
        counted.norm().min(placed.norm())
    };
    match (own, meant) {
        (Motion::Stop, Motion::Stop) => Some(0.0),
        (Motion::Stop, _) | (_, Motion::Stop) => None,
        (Motion::Cut(own), Motion::Cut(meant)) => {
            let off = ends([own.start(), own.end()], [meant.start(), meant.end()]);
            Some(match (own.as_arc(), meant.as_arc()) {
                (Some(own), Some(meant)) if own.sweep * meant.sweep > 0.0 => {
                    let counted = (own.center - own.start) - (meant.center - meant.start);
                    let placed = own.center - from - meant.center;
                    let radius = if behind {
                        (own.radius - meant.radius).abs()
                    } else {
                        f64::INFINITY
                    };
                    off.max(counted.norm().min(placed.norm()).min(radius))
                }
                (None, None) => off,
                _ => off.max((own.point_at(0.5) - from - meant.point_at(0.5)).norm()),
            })
        }
        _ => Some(ends(ends_of(own)?, ends_of(meant)?)),
    }
}

fn ends_of(motion: &Motion) -> Option<[Point; 2]> {
    match motion {
        Motion::Cut(segment) => Some([segment.start(), segment.end()]),
        Motion::Way(start, by) => Some([*start, start + by]),
        Motion::Stop => None,
    }
}
