//! The program of a document, as both faces ask for it.

use wedm::document::Document;
use wedm::job::{self, Generated, Refusal, Wanted};
use wedm::program::Format;

/// Of all contours of a drawing; `force`: whatever is found in it.
pub fn generate(document: &Document, format: Format, force: bool) -> Result<Generated, Refusal> {
    let findings = document.all_findings().to_vec();
    let snapshot = document.snapshot().expect("a drawing");
    let wanted = Wanted {
        format,
        handles: None,
        layers: None,
        force,
    };
    job::generate(&snapshot, findings, &wanted, &())
}
