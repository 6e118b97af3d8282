//! `arc-off-radius` in 4B: R is not the distance of the arc's start from its centre, √(X² + Y²).
//!
//! One of the three numbers is wrong, so nothing is reported about J and G of that block: they may be right.

use super::{Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Fault, FixKind};
use crate::program::repair::keys::is_slip;

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    let part = outlook.part.filter(|_| !outlook.is_line())?;
    (!part.fits(outlook.block)).then(|| {
        Observation::at(
            Spot::Radius,
            Fault::RadiusOff {
                radius: part.radius,
                meant: outlook.radius().round() as i64,
            },
        )
    })
}

/// R is the wrong one where the way is right without it and one key makes it so.
pub(super) fn fixes(site: &Site, fault: &Fault) -> Vec<TextFix> {
    let (Fault::RadiusOff { meant, .. }, Some(place)) = (fault, &site.fields.radius) else {
        return Vec::new();
    };
    let found = site.text.get(place.clone()).unwrap_or_default();
    let new = meant.to_string();
    let is_plain = is_slip(found, new.as_bytes()) && (site.closes_with)(&[site.block]);
    let kind = FixKind::Rewrite {
        found: format!("B{}", String::from_utf8_lossy(found)),
        meant: format!("B{new}"),
    };
    let fix = TextFix::text(kind, is_plain, site.replace(place, new));
    vec![fix.preferred_if(is_plain)]
}
