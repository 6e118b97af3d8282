//! The parts of a text with names, as editors list and fold them.

use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SymbolKind {
    Section,
    Table,
    /// Entry of a table.
    Entry,
    Block,
    Entity,
    /// A record of a drawing that is none of these.
    Record,
    /// All contours of a drawing.
    Contours,
    Contour,
    /// Neighbours that are too many to be listed one by one.
    Run,
    /// Of a program, what is cut between two stops.
    Cut,
    /// The way into a cut or out of it.
    Lead,
    /// A way without a cut.
    Way,
    Move,
    /// A pause or an end.
    Stop,
}

/// A part of a text; ranges are bytes and lie within those of the part that holds it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    pub(crate) kind: SymbolKind,
    /// Name of the record in DXF, as `LWPOLYLINE`; empty where it is none.
    pub(crate) record: Box<str>,
    /// Of a section, table, entry or block; the handle of an entity; what a part of a program is.
    pub(crate) name: String,
    pub(crate) detail: String,
    /// Bytes of all of it.
    pub range: Range<usize>,
    /// Bytes of its name.
    pub selection: Range<usize>,
    /// First line and one past the last.
    pub(crate) lines: Range<usize>,
    pub children: Vec<Symbol>,
}

impl Symbol {
    /// As it is listed: never empty, which editors refuse.
    pub(crate) fn title(&self) -> String {
        let title = match self.kind {
            SymbolKind::Section => self.name.clone(),
            _ => format!("{} {}", self.record, self.name).trim().to_owned(),
        };
        if title.is_empty() {
            say!(unnamed).into()
        } else {
            title
        }
    }
}
