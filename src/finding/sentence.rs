//! The sentence of a finding: its numbers in the units that people read, in the words of [`crate::message`].

use super::{Detail, Finding, Rule, Telling};
use crate::message::readable;

/// The sentence of a finding, for a person: in lower case without a full stop.
///
/// Names from the drawing in it are made `readable`.
pub fn sentence(finding: &Finding, telling: impl Into<Telling>) -> String {
    readable(&finding.detail.sentence(telling.into())).into_owned()
}

/// The other place of a finding, in words.
pub(crate) fn related(
    finding: &Finding,
    handle: &str,
    segment: Option<usize>,
    telling: Telling,
) -> String {
    let handle = readable(handle);
    let place = segment.map_or_else(
        || handle.to_string(),
        |segment| say!(segment, handle, segment),
    );
    match finding.detail {
        Detail::DoesNotFit(ref misfit) => say!(its_partner, misfit.partner, place),
        Detail::NarrowSlot { middles: 0, .. } => say!(the_facing_wall, place),
        Detail::DeadEnd { .. } => say!(the_wire_comes_no_further_than_here, place, telling.tool()),
        Detail::DuplicateEntity { .. } => say!(the_same_place, place),
        Detail::Overlap { .. } => say!(runs_on_this_one, place),
        Detail::Said(_) if matches!(finding.rule, Rule::LeadIn | Rule::StartHole) => {
            say!(what_is_in_the_way, place)
        }
        Detail::SelfIntersection { touches: true, .. } => say!(touches_this_one, place),
        Detail::SelfIntersection { .. } => say!(crosses_this_one, place),
        Detail::SharpCorner { .. } | Detail::NearTangent { .. } => {
            say!(meets_this_one, place)
        }
        Detail::SharpCorners { .. }
        | Detail::NearTangents { .. }
        | Detail::ArcsAsChords { .. }
        | Detail::OpenContours { .. } => say!(one_more_of_them, place),
        _ => say!(the_other_one, place),
    }
}
