//! English.

use crate::finding::{Detail, Finding, FixKind, NoFix, SmallRadius};

/// What a finding says, for a person: lower-case, no final dot. `unit_mm` is the drawing's unit in mm.
pub fn sentence(finding: &Finding, unit_mm: f64) -> String {
    match &finding.detail {
        Detail::SmallRadius(numbers) => small_radius(numbers, unit_mm),
        Detail::UnsupportedEntity { kind, count: 1, why } => format!("{kind} is not cut: {why}"),
        Detail::UnsupportedEntity { kind, count, why } => format!("{kind} ({count} of them) is not cut: {why}"),
        Detail::More { count } => format!("{count} more findings are not shown"),
        Detail::LeadIn(sentence) | Detail::Units(sentence) | Detail::Syntax(sentence) | Detail::Settings(sentence) => sentence.clone(),
    }
}

/// What a fix does, as the title of its code action.
pub fn title(kind: &FixKind, unit_mm: f64) -> String {
    match kind {
        FixKind::Refillet { radius, arcs, moved } => {
            let what = if *arcs == 1 { "arc".to_string() } else { format!("{arcs} arcs") };
            format!("Replace the {what} by one of R {} mm (moves the contour by {} mm)", mm(radius * unit_mm), mm(moved * unit_mm))
        }
        FixKind::KeepEndPoints { radius, kink } => format!(
            "Keep the end points, change only the bulge to R {} mm (kinks the contour by {:.1}° at each end, does not reduce the overcut)",
            mm(radius * unit_mm),
            kink.to_degrees()
        ),
    }
}

/// Title of the action that makes every safe fix.
pub fn fix_all_title() -> &'static str {
    "Fix all arcs below the correction that can be fixed safely"
}

fn small_radius(numbers: &SmallRadius, unit_mm: f64) -> String {
    let (radius, required) = told_apart(numbers.radius * unit_mm, numbers.required * unit_mm);
    let pass = numbers.pass.map_or(String::new(), |pass| format!(" of pass {pass}"));
    let mut text = format!("arc R {radius} mm is below the correction {required} mm{pass}");
    if numbers.overcut * unit_mm >= 0.5e-6 {
        text += &format!(": the wire overcuts the contour by {} mm", mm(numbers.overcut * unit_mm));
        if numbers.stock_left.is_finite() {
            text += &format!(", or leaves {} mm where the control trims", mm(numbers.stock_left * unit_mm));
        }
    } else {
        text += ": the control loses the arc";
    }
    match numbers.no_fix {
        None => {}
        Some(NoFix::NarrowSlot) => {
            text += &format!(
                "; no arc of the required radius fits here (narrow-slot: the wire needs {} mm)",
                mm(2.0 * numbers.required * unit_mm)
            );
        }
        Some(NoFix::SealsContour) => text += "; the arc that fits would seal the slot (narrow-slot)",
        Some(NoFix::NoNeighbour) => text += "; there is no neighbour on both sides that a larger arc could be tangent to",
        Some(NoFix::NotEditable) => text += "; it is part of an entity that cannot be edited here",
    }
    text
}

/// A length in mm with three decimals, or with as many as its first digit needs.
fn mm(length: f64) -> String {
    let places = if length != 0.0 && length.abs() < 0.0005 { 6 } else { 3 };
    format!("{length:.places$}")
}

/// Two lengths in mm with as many decimals as it takes to tell them apart, at least three.
fn told_apart(one: f64, other: f64) -> (String, String) {
    let digits = |places: usize| (format!("{one:.places$}"), format!("{other:.places$}"));
    (3..=9).map(digits).find(|(a, b)| a != b).unwrap_or_else(|| digits(3))
}
