//! Number the blocks, or remove their numbers.

use super::moves::Edits;
use super::proof::same_way;
use crate::program::document::Document;
use crate::program::numbering;
use crate::settings::Effective;

pub(in crate::program) fn numbered(document: &Document, settings: &Effective) -> Edits {
    let edits = match document {
        Document::ThreeB(program) => numbering::numbered(program),
        Document::Iso(program) => numbering::numbered(&**program),
    };
    same_way(document, settings, edits?)
}

pub(in crate::program) fn without_numbers(document: &Document, settings: &Effective) -> Edits {
    let edits = match document {
        Document::ThreeB(program) => numbering::without_numbers(program),
        Document::Iso(program) => numbering::without_numbers(&**program),
    };
    same_way(document, settings, edits?)
}
