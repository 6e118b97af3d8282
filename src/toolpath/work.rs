//! The totals of a job at the machine: lengths, times, slugs, money, without the largest possible wire, which depends on all contours.
//!
//! Nothing is guessed: without a key that it needs a value is left out, and the key is named.

use super::containment::Nesting;
use super::lead_form::largest_lead_angle;
use super::path::{WirePath, lengths};
use crate::drawing::{Drawing, EntityId, Outline, Role, wire_side};
use crate::geometry::Side;
use crate::settings::{Effective, Use};

/// The totals of some paths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Work {
    /// In the order of the cuts.
    pub cuts: Vec<WorkCut>,
    /// mm of all cuts, with leads, without the ways between contours.
    pub length: f64,
    /// mm of the ways from one contour to the next, without a cut.
    pub jumps: f64,
    /// Of all cuts.
    pub minutes: Option<f64>,
    /// In the money of `job.machine-rate`.
    pub cost: Option<f64>,
    /// The slugs that drop out of openings.
    pub slugs: Vec<Slug>,
    /// The largest angle between a lead and its contour, radians.
    pub lead_angle: Option<f64>,
    pub largest_wire: Option<LargestWire>,
    /// Unset keys that some value needs.
    pub missing: Vec<&'static str>,
}

/// One pass along one contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorkCut {
    /// Index of the outline in the drawing's list.
    pub outline: usize,
    pub pass: usize,
    /// It cuts off the tab.
    pub cut_off: bool,
    /// mm, leads included.
    pub length: f64,
    pub minutes: Option<f64>,
}

/// A slug that drops out of an opening.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slug {
    pub outline: usize,
    /// g of steel.
    pub mass: f64,
}

/// The thickest wire that still cuts every arc and passes every narrow place, and what limits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestWire {
    /// mm: twice the radius less the spark gap of the last pass.
    pub diameter: f64,
    /// mm: of the arc, or half the width of the narrow place.
    pub radius: f64,
    pub entity: EntityId,
    pub segment: usize,
    /// The facing wall of a narrow place.
    pub facing: Option<(EntityId, usize)>,
}

/// The totals of `paths` of a drawing, without the largest wire.
pub(crate) fn work(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    paths: &[WirePath],
) -> Work {
    let unit_mm = settings.unit_of(drawing).mm;
    let (thickness, rates) = (settings.job.thickness, settings.passes.rates.as_ref());
    let cut = |path: &WirePath| {
        let pieces = path.segments.iter();
        let length: f64 = pieces.map(|piece| piece.geometry.length()).sum::<f64>() * unit_mm;
        let rate = rates.and_then(|rates| rates.get(path.pass - 1));
        WorkCut {
            outline: path.outline,
            pass: path.pass,
            cut_off: path.cut_off,
            length,
            minutes: thickness
                .zip(rate)
                .map(|(thickness, rate)| length * thickness / rate),
        }
    };
    // What goes back along what has been cut cuts nothing.
    let cuts = paths.iter().filter(|path| !path.is_way_back);
    let cuts: Vec<WorkCut> = cuts.map(cut).collect();
    let minutes: Option<f64> = cuts.iter().map(|cut| cut.minutes).sum();
    let minutes = minutes.filter(|_| !cuts.is_empty());
    let chosen: Vec<usize> = paths
        .iter()
        .filter(|path| path.is_first())
        .map(|path| path.outline)
        .collect();
    let cut_out = Nesting::new(drawing, outlines, &chosen).cut_out(outlines, &chosen);
    let slug = |path: &WirePath| {
        let outline = &outlines[path.outline];
        let cut_out = cut_out.get(&path.outline).copied().unwrap_or_default();
        let area = (outline.twice_area.abs() / 2.0 - cut_out).max(0.0) * unit_mm.powi(2);
        (settings.has_waste_inside(outline.role) && outline.contour.closed)
            .then(|| settings.mass_of(area))?
            .map(|mass| Slug {
                outline: path.outline,
                mass,
            })
    };
    let angles = paths
        .iter()
        .filter_map(|path| largest_lead_angle(&path.segments));
    let missing = [
        ("job.thickness", thickness.is_none()),
        ("passes.rates", rates.is_none()),
        ("job.machine-rate", settings.job.machine_rate.is_none()),
        ("gap", last_gap(settings).is_none()),
    ];
    Work {
        length: cuts.iter().map(|cut| cut.length).sum(),
        jumps: lengths(paths).1 * unit_mm,
        minutes,
        cost: minutes
            .zip(settings.job.machine_rate)
            .map(|(minutes, rate)| minutes / 60.0 * rate),
        slugs: paths
            .iter()
            .filter(|path| path.is_first())
            .filter_map(slug)
            .collect(),
        lead_angle: angles.max_by(f64::total_cmp),
        largest_wire: None,
        missing: missing
            .into_iter()
            .filter_map(|(key, is_missing)| is_missing.then_some(key))
            .collect(),
        cuts,
    }
}

/// Spark gap of the last pass, mm, where set.
pub(crate) fn last_gap(settings: &Effective) -> Option<f64> {
    let of_passes = settings.passes.gaps.as_ref();
    of_passes.map_or(settings.gap, |gaps| gaps.last().copied())
}

/// The thickest wire that cuts every arc of the contours that are `cut`: for an arc with the wire on its inside it is Ø
/// = 2 (r − δ), of the outline of the part of a pair that is cut there. Where the side is not known each arc counts. `None` where there is no such arc, or the gap is not set.
pub(crate) fn largest_of_arcs(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    is_cut: &dyn Fn(usize) -> bool,
) -> Option<LargestWire> {
    let gap = last_gap(settings)?;
    inner_arcs(drawing, outlines, settings, is_cut)
        .map(|arc| LargestWire {
            diameter: 2.0 * (arc.radius - arc.farther - gap),
            radius: arc.radius,
            facing: None,
            entity: arc.entity,
            segment: arc.segment,
        })
        .min_by(|a, b| a.diameter.total_cmp(&b.diameter))
}

/// An arc that the wire runs inside of.
pub(crate) struct InnerArc {
    /// mm.
    pub(crate) radius: f64,
    /// How much farther from it than half its kerf the wire runs, mm.
    pub(crate) farther: f64,
    pub(crate) entity: EntityId,
    pub(crate) segment: usize,
}

/// The arcs of the contours that are `cut` that the wire runs inside of; where its side is not known each one.
pub(crate) fn inner_arcs<'a>(
    drawing: &'a Drawing,
    outlines: &'a [Outline],
    settings: &'a Effective,
    is_cut: &'a dyn Fn(usize) -> bool,
) -> impl Iterator<Item = InnerArc> + 'a {
    let unit_mm = settings.unit_of(drawing).mm;
    let cut = outlines.iter().enumerate();
    let cut =
        cut.filter(|(index, outline)| outline.is_cut() && !outline.is_on_line() && is_cut(*index));
    cut.flat_map(move |(_, outline)| {
        let uses = uses_of(outline, settings);
        outline
            .contour
            .segments(drawing)
            .filter_map(move |segment| {
                let arc = segment.geometry.as_arc()?;
                let is_inside =
                    |side: &Option<Side>| side.is_none_or(|side| side.sign() * arc.sweep > 0.0);
                let inside = uses.iter().filter(|(side, _)| is_inside(side));
                Some(InnerArc {
                    radius: arc.radius * unit_mm,
                    farther: inside.map(|(_, farther)| *farther).reduce(f64::max)?,
                    entity: segment.entity,
                    segment: segment.segment,
                })
            })
    })
}

/// The sides on which a wire runs along a contour, and how much farther from it than half its kerf, mm: one, or one for each part of a pair
/// that is cut along it.
pub(crate) fn uses_of(outline: &Outline, settings: &Effective) -> Vec<(Option<Side>, f64)> {
    let of_pair = |of: Use| {
        let farther = settings.shift_of(of)?;
        let side = wire_side(of.role(), outline.contour.closed, outline.twice_area);
        Some((side, farther))
    };
    let is_cut_twice = outline.role == Role::Both && outline.contour.closed;
    let all: Vec<_> = settings.uses().into_iter().filter_map(of_pair).collect();
    match is_cut_twice && !all.is_empty() {
        true => all,
        false => vec![(outline.wire_side(), 0.0)],
    }
}
