//! The settings of a pair of parts: the correction of each, their partners, and contradictions.

use super::effective::Effective;
use super::{Compensation, DrawnAs, PassFault, Settings, SideSetting};
use crate::drawing::Role;
use std::collections::BTreeMap;

/// Two lengths in mm that differ by less are equal.
const ROUNDING: f64 = 1e-9;

/// A part that is cut along a drawn contour of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Use {
    Punch,
    Plate,
    /// The plate that strips the strip from the punch, with a clearance of its own.
    Stripper,
    /// The plate that holds the punch, tighter than the punch.
    Holder,
}

impl Use {
    pub(crate) const ALL: [Use; 4] = [Use::Punch, Use::Plate, Use::Stripper, Use::Holder];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Use::Punch => "punch",
            Use::Plate => "plate",
            Use::Stripper => "stripper",
            Use::Holder => "holder",
        }
    }

    pub(crate) fn role(self) -> Role {
        match self {
            Use::Punch => Role::Punch,
            Use::Plate | Use::Stripper | Use::Holder => Role::Opening,
        }
    }
}

/// The name of a part for people: one of [`Use`], or that of a workpiece, which stays as it is.
pub(crate) fn part_title(name: &str) -> String {
    let known = Use::ALL.into_iter().find(|of| of.name() == name);
    let title = match known {
        Some(Use::Punch) => say!(part_punch),
        Some(Use::Plate) => say!(part_plate),
        Some(Use::Stripper) => say!(part_stripper),
        Some(Use::Holder) => say!(part_holder),
        None => name,
    };
    title.to_owned()
}

impl From<DrawnAs> for Use {
    fn from(drawn_as: DrawnAs) -> Use {
        match drawn_as {
            DrawnAs::Punch => Use::Punch,
            DrawnAs::Plate => Use::Plate,
        }
    }
}

/// The partners of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Partners {
    /// Each contour with the wire on both sides, as punch and as plate.
    CutTwice(DrawnAs),
    /// Contours of different workpieces.
    Drawn,
}

/// The keys that a requested fit still needs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MissingForFit(pub Vec<&'static str>);

impl MissingForFit {
    /// The keys as a person reads them.
    pub(crate) fn listed(&self) -> String {
        match self.0.as_slice() {
            [first @ .., last] if !first.is_empty() => first.join(say!(comma)) + say!(and) + last,
            keys => keys.concat(),
        }
    }
}

impl Effective {
    /// The drawn part of a pair; `None` where the settings do not say.
    pub(crate) fn partners(&self) -> Option<Partners> {
        match self.pair.drawn_as {
            Some(drawn_as) => Some(Partners::CutTwice(drawn_as)),
            None if self.workpieces.names().len() > 1 => Some(Partners::Drawn),
            None => None,
        }
    }

    /// The partners and their clearance in mm, where a fit is requested and everything for it is set.
    pub(crate) fn fit(&self) -> Result<(Partners, f64), MissingForFit> {
        let mut missing = Vec::new();
        let partners = self.partners();
        if partners.is_none() {
            missing.push("pair.drawn-as");
        }
        if self.pair.clearance.is_none() {
            missing.push("pair.clearance");
        }
        if self.wire_diameter.is_none() {
            missing.push("wire-diameter");
        }
        if self.passes.gaps.is_none() && self.gap.is_none() {
            missing.push("gap");
        }
        match (partners, self.pair.clearance) {
            (Some(partners), Some(clearance)) if missing.is_empty() => Ok((partners, clearance)),
            _ => Err(MissingForFit(missing)),
        }
    }

    /// Why the parts of a pair cannot be cut or compared with each other under these settings, if they cannot.
    pub(crate) fn pair_error(&self) -> Option<String> {
        (self.compensation == Compensation::None).then(on_the_drawn_line)
    }

    /// The parts that are cut along each drawn contour.
    pub(crate) fn uses(&self) -> Vec<Use> {
        let is_cut = |of: &Use| match of {
            Use::Punch | Use::Plate => true,
            Use::Stripper => self.pair.stripper.is_some(),
            Use::Holder => self.pair.holder.is_some(),
        };
        Use::ALL.into_iter().filter(is_cut).collect()
    }

    /// The correction of a part minus that of the drawn one, mm; `None` where the pair does not say.
    pub(crate) fn shift_of(&self, of: Use) -> Option<f64> {
        let clearance = self.pair.clearance?;
        let drawn_as = self.pair.drawn_as?;
        // The outline of the punch lies this far within the drawn one.
        let within = match drawn_as {
            DrawnAs::Punch => 0.0,
            DrawnAs::Plate => clearance,
        };
        Some(match of {
            Use::Punch => -within,
            Use::Plate => within - clearance,
            Use::Stripper => within - self.pair.stripper?,
            Use::Holder => within + self.pair.holder?,
        })
    }

    /// The corrections of the passes of a part, mm, from the side of the drawn contour that the part does not lie on: below 0 on its own side.
    fn corrections_of(&self, of: Use) -> Option<Vec<f64>> {
        let shift = self.shift_of(of)?;
        let signed = |correction: f64| match correction + shift {
            on_contour if on_contour.abs() <= ROUNDING => 0.0,
            signed => signed,
        };
        Some(self.each_correction().into_iter().map(signed).collect())
    }

    /// The settings for one part of a pair, cut along the drawn contour. Where no correction of it is above 0, the wire runs on the other side
    /// of the contour, at distances that rise from pass to pass: the flag says so, and the settings that it comes across the contour, since
    /// what drops out lies where it did. Where some are above 0 and some below, those below are of passes on the other side. `None` where the
    /// pair does not say.
    pub(crate) fn of_use(&self, of: Use) -> Option<(Effective, bool)> {
        let signed = self.corrections_of(of)?;
        let is_other = signed.iter().all(|correction| *correction <= 0.0);
        let role = match (of.role(), is_other) {
            (Role::Punch, false) | (Role::Opening, true) => SideSetting::Punch,
            _ => SideSetting::Opening,
        };
        let corrections: Vec<f64> = match is_other {
            true => signed.iter().map(|correction| correction.abs()).collect(),
            false => signed,
        };
        let farthest = corrections.iter().map(|correction| correction.abs());
        let mut settings = Effective {
            correction: farthest.fold(0.0, f64::max),
            pass: self.pass,
            side: role,
            comes_across: is_other,
            ..self.clone()
        };
        settings.passes.corrections = self
            .passes
            .corrections
            .as_ref()
            .map(|_| corrections.clone());
        settings.corrections = corrections;
        settings.pair.drawn_as = None;
        settings.pair.clearance = None;
        Some((settings, is_other))
    }

    /// Why the control cannot offset the passes of a part, as a sentence: some would run on one side of the drawn contour, some on the other.
    pub(crate) fn sides_of_passes(&self, of: Use) -> Option<String> {
        let signed = self.corrections_of(of)?;
        let is_any = |sign: f64| signed.iter().any(|correction| *correction * sign > 0.0);
        if !is_any(1.0) || !is_any(-1.0) {
            return None;
        }
        let key = match (of, self.pair.drawn_as) {
            (Use::Stripper, Some(DrawnAs::Plate)) => "pair.stripper - pair.clearance",
            (Use::Stripper, _) => "pair.stripper",
            _ => "pair.clearance",
        };
        let listed = self.each_correction().into_iter().map(rounded);
        let listed: Vec<String> = listed.map(|mm| mm.to_string()).collect();
        Some(say!(
            passes_run_on_both_sides_of_the_contour,
            part_title(of.name()),
            key,
            rounded(-self.shift_of(of)?),
            listed.join(say!(comma))
        ))
    }

    /// The settings for one of the drawn workpieces alone.
    pub(crate) fn of_workpiece(&self, number: u16) -> Effective {
        let mut settings = Effective {
            only: Some(number),
            ..self.clone()
        };
        settings.pair.clearance = None;
        settings
    }
}

impl SideSetting {
    /// Its word in the settings.
    pub(crate) fn name(self) -> String {
        let name = serde_json::to_string(&self).unwrap_or_default();
        name.replace('"', "")
    }
}

/// A length in mm without the rounding of a difference.
fn rounded(mm: f64) -> f64 {
    (mm * 1e6).round() / 1e6
}

/// What is said where no wire of a pair keeps beside its contour.
fn on_the_drawn_line() -> String {
    say!(
        a_pair_on_the_drawn_line,
        "pair.clearance",
        "program.compensation"
    )
}

/// Contradictory or ineffective settings of a pair.
pub(super) fn faults(settings: &Settings) -> Vec<PassFault> {
    let pair = settings.pair.clone().unwrap_or_default();
    let workpieces = settings.workpieces.clone().unwrap_or_default();
    let mut faults = Vec::new();
    let mut complain = |key, message| faults.push(PassFault::of(key, message));
    let mut layers: BTreeMap<&str, &str> = BTreeMap::new();
    for (name, of) in &workpieces {
        for layer in of {
            if let Some(other) = layers.insert(layer, name)
                && other != name
            {
                let message = say!(a_layer_in_two_workpieces, layer, other, name);
                complain("workpieces.layers", message);
            }
        }
    }
    if pair.drawn_as.is_some() {
        let key = "pair.drawn-as";
        let side = settings.side();
        if workpieces.len() > 1 {
            complain(key, say!(a_pair_drawn_and_cut_twice, key));
        } else if side != SideSetting::Both {
            complain(key, say!(a_pair_on_one_side, key, side.name()));
        }
        if pair.clearance.is_none() {
            complain(key, say!(a_pair_without_clearance, key));
        }
    } else {
        for (key, is_set) in [
            ("pair.stripper", pair.stripper.is_some()),
            ("pair.holder", pair.holder.is_some()),
        ] {
            if is_set {
                complain(key, say!(an_extra_needs_a_drawn_part, key));
            }
        }
    }
    match settings.program().compensation() {
        Compensation::None if pair.clearance.is_some() => {
            complain("pair.clearance", on_the_drawn_line());
        }
        Compensation::Controller => {
            let effective = Effective::of(settings);
            let uses = effective.uses().into_iter();
            for sentence in uses.filter_map(|of| effective.sides_of_passes(of)) {
                complain("pair.clearance", sentence);
            }
        }
        _ => {}
    }
    if pair.clearance.is_some() {
        let key = "pair.clearance";
        let effective = Effective::of(settings);
        match effective.fit() {
            Ok(_) => {}
            Err(_) if effective.partners().is_none() => {
                complain(key, say!(a_pair_without_partner, key));
            }
            Err(missing) => complain(key, say!(a_fit_needs, key, missing.listed())),
        }
    }
    faults
}
