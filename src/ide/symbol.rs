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
    /// Neighbours that are too many to list.
    Run,
    /// In a program, a cut between two stops.
    Cut,
    /// The way into a cut or out of it.
    Lead,
    /// A way without a cut.
    Way,
    Move,
    /// A pause or an end.
    Stop,
}

/// A part of a text; ranges are bytes and lie within those of its parent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    pub(crate) kind: SymbolKind,
    /// Name of the record in DXF, as `LWPOLYLINE`; empty where there is none.
    pub(crate) record: Box<str>,
    /// Of a section, table, entry or block; the handle of an entity; the kind of a part of a program.
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
    /// As it is listed: never empty, since editors refuse that.
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
