//! Centres that fit the ends of an arc.

use super::super::document::Document;
use super::super::line::{Bent, Target, line_to};
use super::super::moves::{Bend, CenterRule, Move, Place, added, apart, distance, micrometres};
use super::super::style::Style;
use crate::finding::{CenterFix, FixKind, TextFix};
use crate::geometry::equally_far;
use std::ops::Range;

/// Centres that fit the ends of an arc: by another convention, a lost sign or a swap of I and J, else the nearest one.
pub(super) fn center_fixes(document: &Document, range: &Range<usize>) -> Option<Vec<TextFix>> {
    let line = document.text().line_of(range.start);
    let before = document.machine_before(line)?;
    let (mut machine, reading) = (before, document.reading());
    let made = machine.run(&document.block(line), reading)?;
    let Bend::Center { i, j, absolute } = made.bend else {
        return None;
    };
    let rule = reading.rule(made.incremental);
    let own = made.center(rule);
    let mut centers: Vec<(Place, CenterFix)> = Vec::new();
    for other in [
        CenterRule::StartToCenter,
        CenterRule::CenterToStart,
        CenterRule::Absolute,
    ] {
        if other != rule && !(made.incremental && other == CenterRule::Absolute) {
            centers.extend(
                made.center(other)
                    .map(|center| (center, CenterFix::OtherConvention)),
            );
        }
    }
    // As from the point that I and J count from.
    let about = match rule {
        CenterRule::StartToCenter | CenterRule::CenterToStart => made.from,
        CenterRule::Absolute => apart(absolute, [i, j]),
    };
    let sign = if rule == CenterRule::CenterToStart {
        -1
    } else {
        1
    };
    let at = |i: i64, j: i64| added(about, [i, j].map(|length| length.wrapping_mul(sign)));
    centers.extend([(-i, j), (i, -j), (-i, -j)].map(|(i, j)| (at(i, j), CenterFix::Sign)));
    centers.extend([(j, i), (-j, i), (j, -i), (-j, -i)].map(|(i, j)| (at(i, j), CenterFix::Swap)));
    let fits = |center: Place| {
        (distance(made.from, center) - distance(made.to, center)).abs() <= reading.tolerance as f64
    };
    centers.retain(|(center, _)| fits(*center));
    let nearest = own.and_then(|own| nearest_center(document, &made, own, machine.inch));
    centers.extend(nearest.map(|(center, moved)| (center, CenterFix::Nearest { moved })));
    let mut fixes: Vec<TextFix> = Vec::new();
    let mut seen: Vec<Place> = own.into_iter().collect();
    for (center, how) in centers {
        if seen.contains(&center) {
            continue;
        }
        seen.push(center);
        let target = Target {
            bend: Bent::Center(center),
            ..Target::of(&made, reading)
        };
        let Some(edit) = line_to(document, line, &before, &target) else {
            continue;
        };
        let radius = distance(made.from, center) / 1e6;
        let kind = FixKind::SetCenter { radius, how };
        fixes.push(TextFix::text(kind, false, edit).preferred_if(fixes.is_empty()));
    }
    Some(fixes)
}

/// The centre equally far from both ends and nearest to the programmed one, and its distance from that one, mm.
fn nearest_center(
    document: &Document,
    made: &Move,
    own: Place,
    inch: bool,
) -> Option<(Place, f64)> {
    let [from, to, center] = [made.from, made.to, own].map(micrometres);
    let center = equally_far(center, from, to)?;
    let place = Style::of(document, inch).center(center, made.from, made.to)?;
    let moved = distance(place, own);
    // Beyond that it is another arc, not a slip.
    (moved <= distance(place, made.from)).then_some((place, moved / 1e6))
}
