//! Bytes as a 3B program: reading, rules, fixes and the trace end whatever they are, every place lies in the text, and a document that
//! was edited is the one read afresh.

#![no_main]

use libfuzzer_sys::fuzz_target;
use wedm::finding::Place;
use wedm::program::three_b::Document;

fuzz_target!(|data: &[u8]| {
    let mut document = Document::read(data.to_vec());
    check(&document);
    // The bytes say what is edited, too: from where, how much, and what comes in its place.
    let number = |at: usize| data.get(at).copied().map_or(0, usize::from);
    let start = (number(0) * 256 + number(1)) % (data.len() + 1);
    let replacement = String::from_utf8_lossy(data.get(..number(2) % 8).unwrap_or_default()).into_owned();
    document.edit(start..start + number(3) % 64, &replacement);
    check(&document);
    let fresh = Document::read(document.text().bytes().to_vec());
    assert_eq!(sorted(&document), sorted(&fresh), "findings of an edited document");
    assert_eq!(document.trace(), fresh.trace(), "trace of an edited document");
});

fn sorted(document: &Document) -> Vec<String> {
    let mut findings: Vec<String> = document.findings().iter().map(|finding| format!("{finding:?}")).collect();
    findings.sort();
    findings
}

fn check(document: &Document) {
    let length = document.text().len();
    for finding in document.findings().iter().take(64) {
        let Place::Text { range } = &finding.place else { panic!("{finding:?} has no place") };
        assert!(range.start <= range.end && range.end <= length, "{finding:?} in {length} bytes");
        for fix in document.fixes(finding) {
            let mut from = 0;
            for edit in &fix.edit {
                assert!(from <= edit.range.start && edit.range.start <= edit.range.end && edit.range.end <= length, "{fix:?}");
                from = edit.range.end;
            }
        }
    }
    for step in document.trace().steps {
        assert!(step.range.end <= length && step.line < document.text().line_count(), "{step:?}");
        assert!(step.end.x.is_finite() && step.end.y.is_finite(), "{step:?}");
    }
}
