//! Whether a punch goes into its plate: both outlines as the wire leaves them, one laid in the other.
//!
//! A contour that is cut twice is compared with itself, by the corrections of its two uses. Where
//! both parts are drawn, each contour of one workpiece is compared with the contour of another that
//! lies so near that it can only be its partner. Everything is in drawing units.

mod about;
mod held;
mod laid;
mod observations;
mod partners;
mod penetration;
mod places;
mod walls;

pub(crate) use held::Held;
pub(crate) use laid::{Fitted, Laid};
pub use partners::Drawn;
pub(crate) use partners::{partners, walls_of};

use crate::drawing::{Contour, Drawing, EntityId, Outline, Role, wire_side};
use crate::geometry::{Point, Segment, Side};
use crate::settings::{Effective, Use};
use crate::toolpath::{Cutting, Part, Refusal, Walls, part};
use about::FitLimits;
use std::sync::Arc;

/// A segment of a drawing.
pub(crate) type SegmentOf = (EntityId, usize);

/// A place where clearance is missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// On the outline that stands too far out.
    pub at: Point,
    /// By how much the way of the wire turns there, radians; 0 at walls.
    pub turn: f64,
    /// What is left of the clearance; below 0 where the two bind.
    pub clearance: f64,
    /// It is the plate that stands too far out, not the punch.
    pub(crate) is_of_plate: bool,
    /// The drawn segment of the part that stands too far out.
    pub segment: SegmentOf,
    /// That part: `punch` or `plate`, or the name of its workpiece.
    pub of: Arc<str>,
    /// The drawn segment of its partner there.
    pub other: SegmentOf,
    /// The partner.
    pub partner: Arc<str>,
    /// In a corner that a wire has not spoiled, the one that is drawn too sharp.
    pub(crate) sharper: Option<Sharper>,
}

/// The corner of a part that stands in the partner, which is drawn rounder there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sharper {
    pub is_of_plate: bool,
    /// By how much the outline turns there, radians.
    pub turn: f64,
}

/// One part laid in the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The least clearance all round.
    pub least: f64,
    /// Where less is left than there should be, in the order of the outline of the punch, then of that of the plate.
    pub spots: Vec<Spot>,
    /// Outlines as the wire leaves them.
    pub punch: Vec<Segment>,
    pub plate: Vec<Segment>,
}

/// The fit of all pairs of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The clearance that there should be.
    pub clearance: f64,
    pub pairs: Vec<Pair>,
    /// Contours of workpieces without a partner, by their first segment, with the name of the workpiece.
    pub alone: Vec<(SegmentOf, Arc<str>)>,
    /// How far two outlines may overlap by rounding.
    pub rounding: f64,
}

impl Fit {
    pub fn least(&self) -> f64 {
        let all = self.pairs.iter().map(|pair| pair.least);
        all.reduce(f64::min).unwrap_or(self.clearance)
    }

    pub fn fits(&self) -> bool {
        self.least() >= -self.rounding && !self.pairs.is_empty()
    }

    pub fn spots(&self) -> impl Iterator<Item = &Spot> {
        self.pairs.iter().flat_map(|pair| &pair.spots)
    }
}

/// The fit of all pairs of a drawing. A sentence says which keys are missing.
pub fn fit(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    goes_on: &(dyn Fn() -> bool + Sync),
) -> Result<Fit, Refusal> {
    let laid = Laid::of(drawing, outlines, settings, goes_on)?;
    laid.compared(drawing, outlines, settings)
}

/// True for a contour that is cut once from inside and once from outside.
fn is_cut_twice(outline: &Outline) -> bool {
    outline.contour.closed
        && outline.role == Role::Both
        && outline.twice_area != 0.0
        && outline.contour.double_of.is_none()
}

/// The contours that are cut twice, by their indices among all.
pub(crate) fn all_cut_twice(outlines: &[Outline]) -> impl Iterator<Item = usize> {
    let all = outlines.iter().enumerate();
    all.filter(|(_, outline)| is_cut_twice(outline))
        .map(|(index, _)| index)
}

/// The punch and the plate that are cut along one contour, made at once; `walls` are its own, where they are known.
pub(crate) fn cut_twice_parts(
    drawing: &Drawing,
    outline: &Outline,
    settings: &Effective,
    walls: Option<&Walls>,
) -> Result<[Part; 2], Refusal> {
    let part_of = |of: Use| {
        let (own, is_other) = settings
            .of_use(of)
            .ok_or_else(|| Refusal::Sentence(say!(no_path_can_be_made).into()))?;
        let cutting = Cutting {
            side: side_of(outline, of.role())?,
            is_other,
            settings: &own,
            walls,
        };
        part(drawing, &outline.contour, cutting, &|| true)
    };
    let parts = rayon::join(|| part_of(Use::Punch), || part_of(Use::Plate));
    Ok([parts.0?, parts.1?])
}

/// The two parts, one laid in the other.
pub(crate) fn cut_twice(drawing: &Drawing, parts: [&Part; 2], settings: &Effective) -> Held {
    let names = [Use::Punch.name().into(), Use::Plate.name().into()];
    held::held(parts, &names, &limits(drawing, settings, true))
}

/// What the clearance of two parts is checked against, which are cut along one contour or both
/// drawn.
fn limits(drawing: &Drawing, settings: &Effective, is_cut_twice: bool) -> FitLimits {
    let unit_mm = settings.unit_of(drawing).mm;
    let clearance = settings.pair.clearance.unwrap_or(0.0) / unit_mm;
    // Beside straight walls the two lie as far apart as their kerfs leave it.
    let apart = || punch_and_plate_apart(settings).map_or(clearance, |mm| mm / unit_mm);
    FitLimits {
        clearance,
        rounding: settings.tolerances.report / unit_mm,
        along_walls: is_cut_twice.then(apart),
    }
}

/// How far apart the walls of the two parts lie that are cut along one contour, mm.
fn punch_and_plate_apart(settings: &Effective) -> Option<f64> {
    let half = settings.half_kerf(settings.each_correction().len() - 1)?;
    let within = |of: Use| {
        let (own, is_other) = settings.of_use(of)?;
        let last = own.corrections.last().copied()?;
        Some(if is_other { -last } else { last })
    };
    Some(2.0 * half - within(Use::Punch)? - within(Use::Plate)?)
}

/// The part that all passes leave of a contour where both are drawn; `walls` are its own, where they are known.
pub(crate) fn drawn_part(
    drawing: &Drawing,
    outline: &Outline,
    role: Role,
    settings: &Effective,
    walls: Option<&Walls>,
) -> Result<Part, Refusal> {
    let cutting = Cutting {
        side: side_of(outline, role)?,
        is_other: false,
        settings,
        walls,
    };
    part(drawing, &outline.contour, cutting, &|| true)
}

/// Two drawn parts, the punch and the plate, one laid in the other.
pub(crate) fn drawn_pair(
    drawing: &Drawing,
    outlines: [&Outline; 2],
    parts: [&Part; 2],
    settings: &Effective,
) -> Held {
    let names = outlines.map(|it| name_of(drawing, &it.contour, settings));
    held::held(parts, &names, &limits(drawing, settings, false))
}

fn side_of(outline: &Outline, role: Role) -> Result<Side, Refusal> {
    wire_side(role, outline.contour.closed, outline.twice_area)
        .ok_or_else(|| Refusal::Sentence(say!(no_path_can_be_made).into()))
}

pub(crate) fn name_of(drawing: &Drawing, contour: &Contour, settings: &Effective) -> Arc<str> {
    let number = settings.workpieces.of_contour(drawing, contour);
    settings.workpieces.name(number).unwrap_or_default().into()
}
