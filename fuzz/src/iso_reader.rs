//! Bytes as an ISO program: reading, findings, fixes and the trace end whatever they are, every place lies in the text, and a document
//! that was edited is the one read from scratch.

use super::check_program;
use wedm::program::{Document, Language};

pub fn run(data: &[u8]) {
    let [edited, fresh] = check_program(Language::Iso, data);
    let (Document::Iso(edited), Document::Iso(fresh)) = (edited, fresh) else {
        panic!("another language")
    };
    assert_eq!(
        edited.reading(),
        fresh.reading(),
        "how the numbers of an edited document are meant"
    );
}
