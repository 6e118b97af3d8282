//! What small radii cost: the time of a drawing with each wire of the shop's table, and the places that keep the quicker ones
//! out.
//!
//! A wire cuts an arc that it runs inside of where half of its kerf is no more than the radius, and a slot where it is no more
//! than half the width. A sharp corner keeps no wire out: each leaves half of its kerf there.

use super::largest_wire::narrowest_below;
use crate::drawing::{ContourSegment, Drawing, EntityId, Outline};
use crate::geometry::turn;
use crate::message::duration;
use crate::rules::sharp_corner;
use crate::settings::Effective;
use crate::toolpath::{self, inner_arcs};

/// mm: what a radius may lack.
const ROUNDING: f64 = 1e-6;

/// A wire of the shop's table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShopWire {
    /// mm.
    pub diameter: f64,
    /// The least radius that it cuts, mm: half of its kerf.
    pub least: f64,
    /// Of all contours of the drawing.
    pub minutes: f64,
    /// In the money of `job.machine-rate`.
    pub cost: Option<f64>,
}

/// A place that not every wire of the table cuts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TightPlace {
    /// mm: what is left of the radius or half the width for the wire.
    pub radius: f64,
    pub entity: EntityId,
    pub segment: usize,
}

/// The wires of the table, the thickest first, and the tight places, the tightest first.
#[derive(Clone, Debug, PartialEq)]
pub struct RadiusPrices {
    pub wires: Vec<ShopWire>,
    pub places: Vec<TightPlace>,
}

/// `None` where the table or the height is not set, and where nothing is cut by a wire.
pub fn radius_prices(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
) -> Option<RadiusPrices> {
    let job = &settings.job;
    let (diameters, gaps, rates) = (
        job.wires.as_ref()?,
        job.wire_gaps.as_ref()?,
        job.wire_rates.as_ref()?,
    );
    let height = job.thickness.filter(|_| !settings.mills)?;
    let unit_mm = settings.unit_of(drawing).mm;
    let of_outline = |outline: &Outline| {
        let segments = outline.contour.segments(drawing);
        let length: f64 = segments.map(|segment| segment.geometry.length()).sum();
        length * unit_mm * toolpath::uses_of(outline, settings).len() as f64
    };
    let cut = outlines.iter().filter(|outline| outline.is_cut());
    let area = height * cut.map(of_outline).sum::<f64>();
    let mut wires: Vec<ShopWire> = diameters
        .iter()
        .zip(gaps)
        .zip(rates)
        .map(|((diameter, gap), rate)| ShopWire {
            diameter: *diameter,
            least: diameter / 2.0 + gap,
            minutes: area / rate,
            cost: job.machine_rate.map(|hour| area / rate / 60.0 * hour),
        })
        .collect();
    wires.sort_by(|a, b| b.least.total_cmp(&a.least));
    let thickest = wires.first().filter(|_| area > 0.0)?.least;
    let arcs = inner_arcs(drawing, outlines, settings, &|_| true);
    let mut places: Vec<TightPlace> = arcs
        .map(|arc| TightPlace {
            radius: arc.radius - arc.farther,
            entity: arc.entity,
            segment: arc.segment,
        })
        .collect();
    let slot = narrowest_below(drawing, outlines, settings, thickest);
    places.extend(slot.map(|slot| TightPlace {
        radius: slot.diameter / 2.0 + toolpath::last_gap(settings).unwrap_or(0.0),
        entity: slot.entity,
        segment: slot.segment,
    }));
    places.retain(|place| place.radius < thickest - ROUNDING);
    places.sort_by(|a, b| a.radius.total_cmp(&b.radius));
    Some(RadiusPrices { wires, places })
}

impl RadiusPrices {
    /// The quickest wire that cuts a radius.
    fn quickest(&self, radius: f64) -> Option<&ShopWire> {
        let cutting = self.wires.iter();
        let cutting = cutting.filter(|wire| wire.least <= radius + ROUNDING);
        cutting.min_by(|a, b| a.minutes.total_cmp(&b.minutes))
    }

    /// The wire that cuts the whole drawing in the least time; `None` where the table has none that cuts it.
    pub fn chosen(&self) -> Option<&ShopWire> {
        let tightest = self.places.first().map(|place| place.radius);
        self.quickest(tightest.unwrap_or(f64::INFINITY))
    }

    /// The places that a wire does not cut.
    pub fn barring(&self, wire: &ShopWire) -> &[TightPlace] {
        let behind = |place: &TightPlace| place.radius < wire.least - ROUNDING;
        &self.places[..self.places.partition_point(behind)]
    }

    /// In words what a place costs; `None` where it keeps no quicker wire out.
    fn of_place(&self, place: &TightPlace) -> Option<String> {
        let radius = place.radius;
        let Some(needed) = self.quickest(radius) else {
            let thinnest = self.wires.last()?;
            let ShopWire {
                diameter, least, ..
            } = thinnest;
            return Some(say!(no_wire_cuts_a_radius, radius, diameter, least));
        };
        let mut quicker: Vec<&ShopWire> = self.wires.iter().rev().collect();
        // Each of them has to gain something beside those that a smaller radius lets through.
        let mut best = needed.minutes;
        quicker.retain(|wire| {
            let gains = wire.minutes < best && wire.least > radius + ROUNDING;
            best = if gains { wire.minutes } else { best };
            gains
        });
        let first = *quicker.first()?;
        let more: Vec<String> = quicker.iter().map(|wire| more_than(needed, wire)).collect();
        let diameter = needed.diameter;
        let price = say!(
            a_radius_needs_a_wire,
            radius,
            diameter,
            more.join(say!(comma))
        );
        let others = self.barring(first).len().saturating_sub(1);
        Some(match others {
            0 => price,
            _ => say!(and_others_need_it, price, say!(places, others)),
        })
    }

    /// In words what every wire of the table that gains something leaves in a sharp corner.
    fn of_corner(&self) -> Option<String> {
        let chosen = self.chosen()?;
        let thinner = self
            .wires
            .iter()
            .filter(|wire| wire.least < chosen.least && wire.minutes > chosen.minutes);
        let thinner: Vec<String> = thinner
            .map(|wire| {
                let more = duration(wire.minutes - chosen.minutes);
                say!(a_thinner_wire_leaves, wire.least, more, wire.diameter)
            })
            .collect();
        let left = say!(a_wire_leaves_in_a_corner, chosen.least, chosen.diameter);
        Some([vec![left], thinner].concat().join(say!(comma)))
    }
}

/// What a wire takes more than a quicker one.
fn more_than(needed: &ShopWire, quicker: &ShopWire) -> String {
    let time = duration(needed.minutes - quicker.minutes);
    let cost = needed.cost.zip(quicker.cost);
    let cost = cost.map(|(own, other)| say!(and_so_much_money, own - other));
    let cost = cost.unwrap_or_default();
    say!(
        more_than_with_a_wire,
        time,
        cost,
        quicker.diameter,
        quicker.least
    )
}

/// In words what a segment costs: its radius, and sharp corners at its ends that the wire is known to run inside of.
pub fn price_of_segment(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    at: (EntityId, usize),
) -> Option<String> {
    let holds = |outline: &&Outline| {
        let mut pieces = outline.contour.pieces.iter();
        outline.is_cut() && pieces.any(|piece| piece.entity == at.0)
    };
    let outline = outlines.iter().find(holds)?;
    let prices = radius_prices(drawing, outlines, settings)?;
    let is_here = |entity: EntityId, segment: usize| (entity, segment) == at;
    let place = prices
        .places
        .iter()
        .find(|place| is_here(place.entity, place.segment));
    let segments: Vec<ContourSegment> = outline.contour.segments(drawing).collect();
    let index = segments
        .iter()
        .position(|segment| is_here(segment.entity, segment.segment))?;
    let count = segments.len();
    let is_sharp = |index: usize| {
        let before = index
            .checked_sub(1)
            .or(outline.contour.closed.then(|| count - 1));
        let (Some(before), Some(behind)) = (before, segments.get(index)) else {
            return false;
        };
        let before = &segments[before].geometry;
        let turn = turn(before.end_tangent(), behind.geometry.start_tangent());
        let inner = outline.wire_side().map_or(0.0, |side| side.sign() * turn);
        inner > sharp_corner::CLEAR
    };
    let next = match outline.contour.closed {
        true => (index + 1) % count,
        false => index + 1,
    };
    let corner = (is_sharp(index) || is_sharp(next)).then(|| prices.of_corner());
    let said = [
        place.and_then(|place| prices.of_place(place)),
        corner.flatten(),
    ];
    let said: Vec<String> = said.into_iter().flatten().collect();
    (!said.is_empty()).then(|| said.join("\n\n"))
}
