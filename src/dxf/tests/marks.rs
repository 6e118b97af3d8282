//! Findings that the drawing itself suppresses: extended data of an entity, and names of layers.

use super::layers::with_layers;
use crate::document::{Document, Source};
use crate::finding::{Severity, sentence};
use crate::settings::{Effective, Settings};
use std::sync::Arc;

fn opened(text: &str) -> Document {
    let source = Source::Dxf(crate::dxf::Document::read(text.as_bytes().to_vec()));
    Document::new(source, Arc::new(Effective::of(&Settings::default())))
}

/// The findings above information, and the suppressed ones with the reasons.
fn told(document: &mut Document) -> (Vec<String>, Vec<String>) {
    let (findings, _) = document.findings(usize::MAX);
    let found = findings
        .iter()
        .filter(|finding| finding.severity <= Severity::Warning)
        .map(|finding| format!("{}: {}", finding.rule.name(), sentence(finding, 1.0)))
        .collect();
    let suppressed = document.suppressed();
    let reasons = suppressed
        .iter()
        .map(|(finding, reason)| format!("{}: {reason}", finding.rule.name()))
        .collect();
    (found, reasons)
}

/// An outline whose ends are 0.005 mm apart, reported at the first of its two entities.
fn outline(layer: &str, words: &str) -> String {
    let text = format!(
        "0 LINE 5 A 8 {layer} 10 0 20 0.005 11 10 21 0 {words} \
         0 LWPOLYLINE 5 B 8 DIE 90 3 10 10 20 0 10 10 20 10 10 0 20 0"
    );
    with_layers("", &text)
}

const GAP: &str = "gap: ends do not meet: they are 0.005 mm apart, within the join tolerance";

#[test]
fn a_drawing_lets_a_finding_stand_itself() {
    let useless = |sentence: &str| format!("settings: {sentence}");
    let mark = |mark: &str, near: &str| {
        useless(&format!(
            "the mark {mark:?} of A suppresses nothing, expected \"suppress RULE: the reason\"{near}"
        ))
    };
    for (layer, words, found, suppressed) in [
        ("DIE", "", vec![GAP.to_owned()], vec![]),
        (
            "DIE",
            "1001 WEDM 1000 suppress_gap:_relieved_by_hand",
            vec![],
            vec!["gap: relieved_by_hand"],
        ),
        (
            "DIE",
            "1001 ACAD 1000 x 1001 wedm 1070 5 1000 SUPPRESS_Gap_so",
            vec![],
            vec!["gap: so"],
        ),
        (
            "wedm_suppress_gap_drawn_so",
            "",
            vec![],
            vec!["gap: drawn_so"],
        ),
        // Words of others, and other words of our own.
        (
            "DIE",
            "1001 ACAD 1000 suppress_gap:_so",
            vec![GAP.to_owned()],
            vec![],
        ),
        (
            "WEDM_PATHS",
            "1001 WEDM 1000 something",
            vec![GAP.to_owned()],
            vec![],
        ),
        // No reason, no such rule, nothing to suppress.
        (
            "DIE",
            "1001 WEDM 1000 suppress_gap",
            vec![GAP.to_owned(), mark("suppress_gap", "")],
            vec![],
        ),
        (
            "DIE",
            "1001 WEDM 1000 suppress_gapp_so",
            vec![
                GAP.to_owned(),
                mark("suppress_gapp_so", ": did you mean gap?"),
            ],
            vec![],
        ),
        (
            "DIE",
            "1001 WEDM 1000 suppress_gap_so 1000 suppress_overlap_so",
            vec![useless(
                "the suppression of overlap at A suppresses nothing here: remove it",
            )],
            vec!["gap: so"],
        ),
        (
            "WEDM_SUPPRESS_overlap_so",
            "",
            vec![
                GAP.to_owned(),
                useless(
                    "the suppression of overlap at WEDM_SUPPRESS_overlap_so suppresses nothing here: remove it",
                ),
            ],
            vec![],
        ),
    ] {
        let (now_found, now_suppressed) = told(&mut opened(&outline(layer, words)));
        assert_eq!(now_found, found, "{layer} {words}");
        assert_eq!(now_suppressed, suppressed, "{layer} {words}");
    }
}

#[test]
fn an_edit_of_a_mark_tells_as_a_fresh_look_does() {
    let mut text = outline("DIE", "1001 WEDM 1000 suppress_gap_so");
    let mut document = opened(&text);
    for (from, to) in [
        ("suppress_gap", "suppress_overlap"),
        ("suppress_overlap", "suppress_gap"),
        ("WEDM\n", "ACAD\n"),
        ("8\nDIE\n", "8\nWEDM_SUPPRESS_gap_so\n"),
        ("21\n0\n", "21\n0.001\n"),
        ("1001\nACAD\n1000\nsuppress_gap_so\n", ""),
        ("WEDM_SUPPRESS_gap_so", "DIE"),
    ] {
        let at = text
            .find(from)
            .unwrap_or_else(|| panic!("{from:?} in {text}"));
        document.edit_text(at..at + from.len(), to);
        text.replace_range(at..at + from.len(), to);
        assert_eq!(told(&mut document), told(&mut opened(&text)), "{from:?}");
    }
}
