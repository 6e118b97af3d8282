//! Correction, side and unit as they are said, each with where it comes from.

use super::{Effective, Origin, SideSetting};
use crate::drawing::{Drawing, Role};

impl Effective {
    /// The correction of each pass, and where it comes from.
    pub(crate) fn said_corrections(&self) -> String {
        let all = self.each_correction();
        let listed: Vec<String> = all.iter().map(|mm| length(*mm)).collect();
        let said = say!(correction_mm, listed.join(" / "));
        say!(with_its_origin, said, self.origins.correction.title())
    }

    /// The side, and where it comes from; layers, colours and contours may have sides of their own.
    pub(crate) fn said_side(&self) -> String {
        let side = match self.side {
            SideSetting::Both => say!(both_sides),
            SideSetting::Auto => say!(sides_by_nesting),
            SideSetting::Opening => say!(opening),
            SideSetting::Punch => say!(punch),
            SideSetting::Left => say!(wire_on_the_left),
            SideSetting::Right => say!(wire_on_the_right),
        };
        let is_cut = |role: &Role| *role != Role::Ignore;
        let has_own = self.layers.values().any(|role| is_cut(&role))
            || self.contours.values().any(is_cut)
            || self.linetypes.values().any(is_cut)
            || self.colors.values().any(is_cut)
            || self.points.iter().any(|(_, role)| is_cut(role));
        let side = say!(with_its_origin, side, self.origins.side.title());
        match has_own {
            true => say!(sides_as_set_else, side),
            false => side,
        }
    }

    /// The unit of a drawing, and what says it.
    pub(crate) fn said_unit(&self, drawing: &Drawing) -> String {
        let unit = match self.unit_of(drawing).mm {
            1.0 => "mm".to_owned(),
            25.4 => say!(inches).to_owned(),
            mm => say!(units_of_mm, mm),
        };
        say!(with_its_origin, unit, self.unit_from(drawing).title())
    }

    pub(crate) fn unit_from(&self, drawing: &Drawing) -> Origin {
        match drawing.unit {
            Some(_) => Origin::Drawing,
            None => self.origins.unit,
        }
    }
}

/// mm with three decimals, or with four where the fourth says something.
fn length(mm: f64) -> String {
    let text = format!("{mm:.4}");
    text.strip_suffix('0').map_or(text.clone(), str::to_owned)
}
