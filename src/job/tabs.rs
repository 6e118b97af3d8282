//! What is said of the tabs of a program as a whole.

use super::Snapshot;
use crate::drawing::Role;
use crate::finding::{Detail, Finding, Place, Severity};
use crate::rule::Rule;
use crate::settings::LengthSetting;
use crate::toolpath::WirePath;

/// The finding when a tab is requested and no contour keeps one.
pub(super) fn none_kept(snapshot: &Snapshot, paths: &[WirePath]) -> Option<Finding> {
    let settings = &snapshot.settings;
    let is_asked = match &settings.tab {
        LengthSetting::One(length) => *length > 0.0,
        LengthSetting::ByHandle(_) => false,
    };
    let is_left_out = is_asked && !settings.mills && !paths.iter().any(|path| path.cut_off);
    is_left_out.then(|| remark(say!(no_contour_keeps_a_tab, "program.tab")))
}

/// The finding when punches are cut in several passes without a tab.
pub(super) fn missed(snapshot: &Snapshot, paths: &[WirePath]) -> Option<Finding> {
    let is_punch = |path: &&WirePath| {
        let outline = snapshot.outlines.get(path.outline);
        path.is_first()
            && !snapshot.settings.mills
            && outline.is_some_and(|own| own.role == Role::Punch && own.contour.closed)
    };
    let is_free = |path: &&WirePath| {
        let mut own = paths.iter().filter(|own| own.outline == path.outline);
        own.clone().any(|own| own.pass > 1) && !own.any(|own| own.cut_off)
    };
    let punch = paths.iter().filter(is_punch).find(is_free)?;
    let handle = snapshot
        .outlines
        .get(punch.outline)?
        .name(&snapshot.drawing);
    Some(remark(say!(a_punch_is_free_after_its_first_pass, handle)))
}

/// A remark about a program as a whole.
fn remark(sentence: String) -> Finding {
    Finding {
        rule: Rule::Settings,
        severity: Severity::Information,
        place: Place::Document,
        detail: Detail::Said(sentence),
        related: Vec::new(),
    }
}
