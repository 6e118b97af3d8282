//! The thickest wire that a drawing lets through: what its smallest arc and its narrowest place leave.
//!
//! Narrow places are those of `narrow-slot` under a larger correction. This is raised step by step, so that a neck is found before much is
//! compared; walls as far apart as the smallest arc is wide do not matter any more.

use super::Analysis;
use crate::drawing::{ContourKey, Drawing, Outline, Role, wire_side};
use crate::rule::Rule;
use crate::settings::{Effective, Partners, Use};
use crate::toolpath::{self, LargestWire, WirePath, Work};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// In a drawing of more segments nothing is said: it would take longer than the answer is worth.
const MOST_SEGMENTS: usize = 100_000;

/// By how much the correction grows from one comparison to the next.
const GROWTH: f64 = 6.0;
/// The least part of the last correction with which the comparison begins.
const LEAST_SHARE: f64 = 1e-3;

/// The totals of `paths` of a drawing.
pub fn work(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    paths: &[WirePath],
) -> Work {
    let is_cut = |index: usize| paths.iter().any(|path| path.outline == index);
    Work {
        largest_wire: (!settings.mills)
            .then(|| largest_wire(drawing, outlines, settings, &is_cut))
            .flatten(),
        ..toolpath::work(drawing, outlines, settings, paths)
    }
}

/// The thickest wire that cuts every arc of the contours that are `cut`, and passes between their own walls and those of others. `None`
/// where there is no arc, where the gap is not set or fills the narrowest place, and where there is too much to compare.
pub fn largest_wire(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    is_cut: &dyn Fn(usize) -> bool,
) -> Option<LargestWire> {
    let of_arcs = toolpath::largest_of_arcs(drawing, outlines, settings, is_cut)?;
    let segments: usize = outlines.iter().map(|outline| outline.contour.len()).sum();
    if of_arcs.diameter <= 0.0 || segments > MOST_SEGMENTS {
        return None;
    }
    let uses = uses(settings);
    let farthest = uses.iter().map(|of| of.farther);
    let farthest = farthest.fold(f64::NEG_INFINITY, f64::max);
    let gap = toolpath::last_gap(settings).unwrap_or(0.0);
    // The correction of the thickest wire with its gap.
    let half = of_arcs.diameter / 2.0 + gap + farthest.max(0.0);
    // Where the wire runs on the contour's other side, its correction is no beginning.
    let mut correction = settings.correction.max(half * LEAST_SHARE);
    loop {
        correction = (GROWTH * correction).min(half);
        let settings = slots_alone(settings, correction);
        let found = narrowest(drawing, outlines, settings, &uses, is_cut).ok()?;
        // What is farther apart may still let less through in another part.
        let beyond = 2.0 * (correction - gap - farthest);
        let found = found.filter(|found| correction >= half || found.diameter <= beyond);
        if let Some(narrowest) = found {
            let smaller = narrowest.diameter < of_arcs.diameter;
            let largest = if smaller { narrowest } else { of_arcs };
            return Some(largest).filter(|largest| largest.diameter > 0.0);
        }
        if correction >= half {
            return Some(of_arcs);
        }
    }
}

/// The narrowest place that a wire with half a kerf of `half` does not pass; `None` where there is none, and where it would take
/// too long to compare.
pub(super) fn narrowest_below(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    half: f64,
) -> Option<LargestWire> {
    let uses = uses(settings);
    let segments: usize = outlines.iter().map(|outline| outline.contour.len()).sum();
    if segments > MOST_SEGMENTS {
        return None;
    }
    let farthest = uses.iter().map(|of| of.farther).fold(0.0, f64::max);
    let settings = slots_alone(settings, half + farthest);
    narrowest(drawing, outlines, settings, &uses, &|_| true)
        .ok()
        .flatten()
}

/// Settings under which narrow slots alone are looked for.
fn slots_alone(settings: &Effective, correction: f64) -> Effective {
    let severity = |rule: Rule| (rule == Rule::NarrowSlot).then(|| rule.default_severity());
    Effective {
        correction,
        severities: Rule::ALL.map(|rule| (rule, severity(rule))).into(),
        ..settings.clone()
    }
}

/// One of the parts that are cut along the contours of a drawing.
struct PartCut {
    /// The role that a contour has in it where several parts are cut along the contour.
    role: Option<Role>,
    /// How much farther from the contour than half its kerf the wire runs, mm.
    farther: f64,
    /// Contours with a role of their own belong to it, too.
    with_stated: bool,
}

fn uses(settings: &Effective) -> Vec<PartCut> {
    let Some(Partners::CutTwice(drawn_as)) = settings.partners() else {
        return vec![PartCut {
            role: None,
            farther: 0.0,
            with_stated: true,
        }];
    };
    let part = |of: Use| PartCut {
        role: Some(of.role()),
        farther: settings.shift_of(of).unwrap_or(0.0),
        with_stated: of == Use::from(drawn_as),
    };
    settings.uses().into_iter().map(part).collect()
}

/// True where the comparison was left out because it would take too long.
struct NotCompared;

/// What the narrowest place below twice the correction lets through, if there is one.
fn narrowest(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: Effective,
    uses: &[PartCut],
    is_cut: &dyn Fn(usize) -> bool,
) -> Result<Option<LargestWire>, NotCompared> {
    let unit_mm = settings.unit_of(drawing).mm;
    let gap = toolpath::last_gap(&settings).unwrap_or(0.0);
    let analysis = Analysis::new(drawing, Arc::new(settings));
    if analysis.pairs.uncompared() > 0 {
        return Err(NotCompared);
    }
    let places = outlines.iter().enumerate().filter_map(|(index, outline)| {
        let first = outline.contour.pieces.first()?;
        Some((analysis.chains.contour_of(first.entity)?, index))
    });
    let places: FxHashMap<ContourKey, usize> = places.collect();
    let outline = |key: ContourKey| Some((*places.get(&key)?, outlines.get(*places.get(&key)?)?));
    let outlook = |key: ContourKey| analysis.outlook(drawing, key);
    let of_part = |of: &PartCut| {
        let counts = |keys: [ContourKey; 2]| {
            let both = keys.map(outline);
            let is_drawn_once = |it: &Option<(usize, &Outline)>| {
                it.is_some_and(|(_, outline)| {
                    outline.contour.double_of.is_none()
                        && (of.with_stated || outline.role == Role::Both)
                })
            };
            both.iter().all(is_drawn_once) && both.iter().flatten().any(|(index, _)| is_cut(*index))
        };
        let side_of = |key: ContourKey| {
            let outline = outline(key)?.1;
            match (of.role, outline.role) {
                (Some(role), Role::Both) => {
                    wire_side(role, outline.contour.closed, outline.twice_area)
                }
                _ => outline.wire_side(),
            }
        };
        let (width, facing) = analysis.pairs.narrowest(&outlook, &side_of, &counts)?;
        let [one, other] = facing.map(|(key, index)| outlook(key)?.segment_id(index));
        one.map(|(entity, segment)| LargestWire {
            diameter: width * unit_mm - 2.0 * (gap + of.farther),
            radius: width * unit_mm / 2.0,
            entity,
            segment,
            facing: other,
        })
    };
    let found = uses.iter().filter_map(of_part);
    Ok(found.min_by(|a, b| a.diameter.total_cmp(&b.diameter)))
}
