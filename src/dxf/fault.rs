//! Findings of the reader, and how their sentences quote a value.

use crate::finding::{Detail, Finding, NotJudged, Place, Rule, Severity};
use crate::text::head;
use std::ops::Range;

/// A fault that makes text unreadable.
pub(super) fn damage(findings: &mut Vec<Finding>, range: Range<usize>, sentence: String) {
    push(findings, range, Severity::Error, sentence);
}

/// Something odd that was read all the same.
pub(super) fn oddity(findings: &mut Vec<Finding>, range: Range<usize>, sentence: String) {
    push(findings, range, Severity::Warning, sentence);
}

/// A remark on how something was read that is not a fault.
pub(super) fn remark(findings: &mut Vec<Finding>, range: Range<usize>, sentence: String) {
    push(findings, range, Severity::Information, sentence);
}

/// A part of the drawing that would take too much: a program would lack it.
pub(super) fn left_out(findings: &mut Vec<Finding>, range: Range<usize>, what: NotJudged) {
    findings.push(Finding {
        rule: Rule::NotJudged,
        severity: Severity::Error,
        place: Place::Text { range },
        detail: Detail::NotJudged(what),
        related: Vec::new(),
    });
}

pub(super) fn push(
    findings: &mut Vec<Finding>,
    range: Range<usize>,
    severity: Severity,
    sentence: String,
) {
    findings.push(said(range, severity, sentence));
}

pub(super) fn said(range: Range<usize>, severity: Severity, sentence: String) -> Finding {
    Finding {
        rule: Rule::Syntax,
        severity,
        place: Place::Text { range },
        detail: Detail::Said(sentence),
        related: Vec::new(),
    }
}

/// A value as it is quoted: at most 32 characters, without control characters.
pub(super) fn quoted(value: &[u8]) -> String {
    let text = String::from_utf8_lossy(head(value, 128));
    let mut quoted: String = text.chars().take(32).flat_map(char::escape_debug).collect();
    if text.chars().nth(32).is_some() {
        quoted.push('…');
    }
    format!("\"{quoted}\"")
}

/// The meaning of a group code, for sentences: ` (bulge)`; empty where the code needs none.
pub(super) fn meaning(code: i16) -> &'static str {
    match code {
        10 => " (x)",
        20 => " (y)",
        30 => " (z)",
        11 => say!(end_x),
        21 => say!(end_y),
        31 => say!(end_z),
        42 => say!(the_bulge),
        50 => say!(start_angle),
        51 => say!(end_angle),
        90 => say!(number_of_vertices),
        210 | 220 | 230 => say!(the_extrusion),
        _ => "",
    }
}
