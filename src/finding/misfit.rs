//! Two parts that do not go into each other: how they bind, and the sentence.

use super::lengths::Telling;
use crate::geometry::Point;
use std::sync::Arc;

/// Two parts of a pair bind. Lengths in drawing units.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    /// On the outline that protrudes.
    pub at: Point,
    /// The remaining clearance; below 0.
    pub clearance: f64,
    /// The required clearance.
    pub wanted: f64,
    /// The part at whose segment the finding stands, and its partner: `punch` and `plate`, or names of workpieces.
    pub of: Arc<str>,
    pub partner: Arc<str>,
    pub(crate) cause: Cause,
}

/// Why two parts bind.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cause {
    /// The wire leaves too much in a corner of this part.
    Corner(Arc<str>),
    /// Both are drawn as arcs there, whose radii do not differ by the clearance. First the radius
    /// of the part at whose segment the finding stands. Drawing units.
    Radii([f64; 2]),
    /// The corner of this part is drawn sharper than that of its partner there: the radii of both, 0 where it is sharp.
    /// Drawing units.
    Sharper(Arc<str>, [f64; 2]),
    /// They are drawn too near each other, which no corner radius mends.
    Wall,
}

impl Misfit {
    pub(super) fn sentence(&self, telling: Telling) -> String {
        let mm = |length: f64| length * telling.unit_mm;
        let (depth, wanted) = (mm(-self.clearance), mm(self.wanted));
        let (of, partner) = (&self.of, &self.partner);
        match &self.cause {
            Cause::Corner(corner_of) => {
                say!(the_parts_bind_here, of, partner, depth, corner_of, wanted)
            }
            Cause::Radii(radii) => {
                let [own, other] = radii.map(|radius| telling.mm(radius));
                say!(
                    the_parts_bind_along_an_arc,
                    of,
                    partner,
                    depth,
                    own,
                    other,
                    wanted
                )
            }
            Cause::Sharper(sharper, radii) => {
                let rounder = if sharper == of { partner } else { of };
                let [own, other] = radii.map(|radius| telling.mm(radius));
                let corner = match radii[0] == 0.0 {
                    true => say!(its_corner_is_sharp, sharper),
                    false => say!(its_corner_has_a_radius, sharper, own),
                };
                say!(
                    a_corner_is_sharper_than_its_partner,
                    of,
                    partner,
                    depth,
                    corner,
                    other,
                    rounder,
                    wanted
                )
            }
            Cause::Wall => say!(the_parts_bind_along_a_wall, of, partner, depth, wanted),
        }
    }
}
