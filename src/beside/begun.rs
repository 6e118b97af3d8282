//! Where an ISO program states its start, beside our own for its drawing.

use super::difference::Difference;
use super::traced::Traced;
use super::walk::Kind;
use crate::geometry::Vector;
use std::ops::RangeInclusive;

/// The line in which an ISO program states its start, where that is a little off. All of the program is `from` the
/// rewritten one: where it counts from its own start, which is zero, that is no change. `slips`: how far off it counts, µm.
pub(super) fn begun_elsewhere(
    traced: &Traced,
    reference: &Traced,
    from: Vector,
    slips: RangeInclusive<f64>,
) -> Option<Difference> {
    if traced.counts {
        return None;
    }
    let said = |of: &Traced| {
        let first = of.blocks.first()?.line;
        let lines = (0..first).map(|line| (line, of.text.line_range(line)));
        let mut words = lines.map(|(line, range)| (line, range.clone(), of.said_in(range)));
        words.find(|(_, _, said)| said.sets_place())
    };
    let ((line, range, own), (.., meant)) = (said(traced)?, said(reference)?);
    if own.is_at_zero() && from != Vector::zeros() {
        return None;
    }
    let off = own.apart(&meant).filter(|off| slips.contains(off))?;
    Some(Difference {
        range,
        line,
        segment: None,
        off: off / 1e3,
        kind: Kind::Lead,
    })
}
