//! Bytes as a 3B program: reading, rules, fixes and the trace end whatever they are, every place lies in the text, and a document that
//! was edited is the one read from scratch.

#![no_main]

use libfuzzer_sys::fuzz_target;
use wedm::program::three_b::Document;
use wedm_fuzz::{check_program, edit_of_program};

fuzz_target!(|data: &[u8]| {
    let mut document = Document::read(data.to_vec());
    check(&document);
    let (range, replacement) = edit_of_program(data);
    document.edit(range, &replacement);
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
    check_program(document.text(), &document.findings(), |finding| document.fixes(finding), &document.trace());
}
