//! DXF text: read without loss, edited in place.
//!
//! The text is cut into items, one for each record (a POLYLINE with its vertices is one). Only the starts of the items
//! and of the vertices are stored; tags are read again when their place is asked for.
//!
//! Invariant: after any sequence of edits a document equals a fresh reading of its text, except for its entity ids.

mod ahead;
mod append;
mod binary;
mod blocks;
mod change;
mod code_page;
mod curve;
mod doubled;
mod dxb;
mod edit;
mod entities;
mod entity;
mod fault;
mod foreign;
mod frame;
mod group_lists;
mod inherited;
mod insert;
mod items;
mod johab;
mod layer_table;
mod layers;
pub(crate) mod lexer;
pub(crate) mod lines;
pub(crate) mod number;
mod numbers;
pub(crate) mod place;
mod reader;
mod reading;
mod record;
mod reference;
mod shape;
mod space;
mod strings;
pub(crate) mod table;
#[cfg(test)]
mod tests;
mod uncut;
mod unit;
mod value_type;
mod vertex_run;
mod write;

pub use write::write;

use crate::drawing::{Drawing, Unit};
use crate::finding::{Detail, Finding, Place, Rule};
use crate::geometry::Tolerances;
use crate::text::{Again, SourceText};
pub(crate) use append::Added;
use blocks::Blocks;
use code_page::CodePage;
pub(crate) use group_lists::{EntityChange, Group, GroupValue};
use layer_table::LayerStates;
use layers::Layers;
use reading::{Reading, is_fitted};
use std::sync::Arc;
use table::Table;
use unit::fit_tolerance;
pub(crate) use unit::unit_of;

/// Endings of the names of drawings, in lower case and without their dots; the bytes tell text from binary.
pub(crate) const ENDINGS: [&str; 3] = ["dxf", "dxb", "dxfb"];

/// DXF text, the drawing that it holds, and where each of its numbers stands.
#[derive(Clone, Debug, Default)]
pub struct Document {
    text: SourceText,
    drawing: Arc<Drawing>,
    findings: Vec<Finding>,
    table: Box<Table>,
    layers: Box<Layers>,
    suspended: Option<Box<vertex_run::Suspended>>,
    is_binary: bool,
    /// The largest distance of arcs from the curves that they replace, in mm; the default where unset.
    arc_fit: Option<f64>,
    /// The unit of a drawing that states none.
    assumed_unit: Option<Unit>,
}

impl Document {
    /// Reads a file: DXF text in the code page that it names, or binary DXF or DXB, which are turned into equivalent
    /// text (see `Document::is_binary`). Never fails: damage is in [`Document::findings`].
    pub fn read_file(bytes: Vec<u8>) -> Document {
        let (is_dxf, is_dxb) = (
            binary::sentinel(&bytes).is_some(),
            bytes.starts_with(dxb::SENTINEL),
        );
        let is_mangled = binary::is_mangled(&bytes);
        let is_binary = is_dxf || is_dxb;
        let (bytes, fault) = match () {
            () if is_dxf => binary::to_text(&bytes),
            () if is_dxb => dxb::to_text(&bytes),
            () => (bytes, None),
        };
        let layers = Layers::in_code_page(Some(CodePage::of_file(&bytes)));
        let mut document = Document {
            layers: Box::new(layers),
            is_binary,
            ..Document::default()
        };
        document.take(bytes);
        if is_mangled && fault.is_none() {
            let sentence = say!(this_binary_file_was_handled_as_a_text).to_owned();
            fault::oddity(&mut document.findings, 0..0, sentence);
        }
        if let Some(sentence) = fault {
            let end = document.text.len();
            // The missing part of the last record is beyond the end: one fault, one finding.
            let last = document
                .table
                .lines
                .last()
                .map_or(0, |&line| document.text.line_start(line as usize));
            document.findings.retain(|finding| {
                finding.rule != Rule::Syntax || reader::range_key(finding).0 < last
            });
            fault::damage(&mut document.findings, end..end, sentence);
        }
        document
    }

    /// Reads DXF text in UTF-8. Never fails: damage is in [`Document::findings`].
    pub fn read(bytes: Vec<u8>) -> Document {
        let mut document = Document::default();
        document.take(bytes);
        document
    }

    /// The same for a text that is held elsewhere as well: nothing of it is copied.
    pub(crate) fn of_text(text: SourceText) -> Document {
        let mut document = Document {
            text,
            ..Document::default()
        };
        document.read_all();
        document
    }

    fn take(&mut self, bytes: Vec<u8>) {
        let too_long = bytes.len() >= u32::MAX as usize;
        self.text = SourceText::new(if too_long { Vec::new() } else { bytes });
        self.read_all();
        if too_long {
            self.is_no_dxf(say!(the_text_is_longer_than_4_gib));
        }
    }

    /// What each record became.
    pub(crate) fn table(&self) -> &Table {
        &self.table
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    /// Keeps only the lines of the text: a part that is asked for is read `again`. Not for a binary
    /// file, whose text is not the bytes of the file.
    pub(crate) fn set_text_aside(&mut self, again: Again) {
        if !self.is_binary {
            self.text.set_aside(again);
        }
    }

    /// Sets the largest distance, in mm, of arcs from the ellipses and splines that they replace.
    /// If the drawing has any and the distance changes, the text is read again and ids of entities
    /// may change.
    pub(crate) fn set_arc_fit(&mut self, mm: f64) {
        if self.arc_fit.unwrap_or(Tolerances::default().arc_fit) == mm {
            return;
        }
        self.arc_fit = Some(mm);
        if self
            .drawing
            .entities()
            .any(|(_, entity)| is_fitted(entity.kind))
        {
            self.read_all();
        }
        self.table.fit_tolerance = fit_tolerance(self.arc_fit, self.drawing.unit);
    }

    /// True where [`Document::text`] is the translation of a binary DXF or DXB file. It cannot be edited.
    pub(crate) fn is_binary(&self) -> bool {
        self.is_binary
    }

    /// Sets the unit of a drawing that states none.
    pub(crate) fn assume_unit(&mut self, unit: Unit) {
        self.assumed_unit = Some(unit);
        if self.drawing.assumes_another(unit) {
            Arc::make_mut(&mut self.drawing).assume_unit(unit);
        }
    }

    pub fn drawing(&self) -> &Arc<Drawing> {
        &self.drawing
    }

    /// Faults of the text, and what in it is not cut, in the order of the text.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Reads the whole text.
    fn read_all(&mut self) {
        self.suspended = None;
        self.findings.clear();
        self.text.join();
        *self.table = Table::default();
        if let Some(sentence) = foreign::recognise(self.text.bytes()) {
            return self.is_no_dxf(sentence);
        }
        if self
            .text
            .bytes()
            .iter()
            .all(|byte| byte.is_ascii_whitespace())
        {
            return self.is_no_dxf(say!(the_text_is_empty_expected_dxf));
        }
        let mut reading = self.read_items(None);
        if !reading.frames.is_empty() {
            // A frame may stand before its text.
            self.table.frames = std::mem::take(&mut reading.frames);
            reading = self.read_again(None);
        }
        if reading.early {
            // Blocks, or parts of them, may stand after their references.
            reading = self.read_again(Some(reading.blocks.unasked()));
        }
        let Reading {
            mut drawing,
            unit,
            any_record,
            blocks,
            known,
            ..
        } = reading;
        if !any_record {
            return self.is_no_dxf(say!(the_text_has_no_dxf_records));
        }
        let mut blocks = known.unwrap_or(blocks);
        self.table.used = std::mem::take(&mut blocks.used);
        self.table.blocks = Arc::new(blocks);
        drawing.unit = unit.unit();
        if let Some(unit) = self.assumed_unit {
            drawing.assume_unit(unit);
        }
        if let Some((severity, sentence)) = unit.doubt() {
            let finding = Finding {
                rule: Rule::Units,
                severity,
                place: Place::Document,
                detail: Detail::Said(sentence),
                related: Vec::new(),
            };
            self.findings.insert(0, finding);
        }
        drawing.shrink_to_fit();
        self.table.shrink_to_fit();
        self.drawing = Arc::new(drawing);
        self.name_unsupported();
    }

    /// Reads all items once more with the known frames; where blocks are `known`, also with these and the known layers.
    fn read_again(&mut self, known: Option<Blocks>) -> Reading {
        let frames = std::mem::take(&mut self.table.frames);
        let states = match known {
            Some(_) => std::mem::take(&mut self.table.states),
            None => LayerStates::default(),
        };
        *self.table = Table {
            frames,
            states,
            ..Table::default()
        };
        self.read_items(known)
    }

    /// Empties the drawing and leaves one finding.
    fn is_no_dxf(&mut self, sentence: &str) {
        *self.table = Table::default();
        self.drawing = Arc::default();
        self.findings.clear();
        let line = self.text.line_range(0);
        fault::damage(&mut self.findings, 0..line.end.min(64), sentence.to_owned());
    }
}
