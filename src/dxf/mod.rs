//! DXF text: read without loss, edited in place.
//!
//! The text is cut into items, one for each record (a POLYLINE with its vertices is one). Only where the items begin is
//! kept of them, and where the vertices of a polyline stand; tags are read again when somebody asks for their place.
//!
//! Invariant: after any sequence of edits a document equals a fresh reading of its text, the numbers of its
//! entity ids aside.

mod change;
mod edit;
mod entity;
mod fault;
mod foreign;
pub mod language;
mod layers;
mod lexer;
mod lines;
mod number;
mod place;
mod reader;
mod strings;
mod table;
#[cfg(test)]
mod tests;
mod write;

pub use write::write;

use crate::drawing::{Drawing, Entity, Unit};
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::text::SourceText;
use entity::Outcome;
use layers::Layers;
use lexer::Lexer;
use lines::Lines;
use reader::{ReadItem, Said, range_key, read_item};
use std::sync::Arc;
use table::{Became, Context, Item, NO_ITEM, Named, Table};

/// DXF text, the drawing that it holds, and where each number of it stands.
#[derive(Clone, Debug, Default)]
pub struct Document {
    text: SourceText,
    drawing: Arc<Drawing>,
    findings: Vec<Finding>,
    table: Box<Table>,
    layers: Box<Layers>,
}

impl Document {
    /// Reads DXF text. Never fails: what is damaged is in [`Document::findings`].
    pub fn read(bytes: Vec<u8>) -> Document {
        let too_long = bytes.len() >= u32::MAX as usize;
        let text = SourceText::new(if too_long { Vec::new() } else { bytes });
        let mut document = Document { text, ..Document::default() };
        document.read_all();
        if too_long {
            document.is_no_dxf("the text is longer than 4 GiB");
        }
        document
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    pub fn drawing(&self) -> &Arc<Drawing> {
        &self.drawing
    }

    /// Faults of the text and what of it is not cut, in the order of the text.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Reads the whole text.
    fn read_all(&mut self) {
        self.findings.clear();
        *self.table = Table::default();
        if let Some(sentence) = foreign::recognise(self.text.bytes()) {
            return self.is_no_dxf(sentence);
        }
        if self.text.bytes().iter().all(|byte| byte.is_ascii_whitespace()) {
            return self.is_no_dxf("the text is empty, expected DXF");
        }
        let mut drawing = Drawing::default();
        let (mut unit, mut ordinal) = (None, 0);
        let lines = Lines::new(&self.text);
        let mut lexer = Lexer::new(lines, 0);
        let mut context = Context::Outside;
        let mut any_record = false;
        while let Some(read) = read_item(&mut lexer, context, &mut self.layers, &mut self.findings) {
            context = read.after;
            let ReadItem { line, context, said, .. } = read;
            any_record |= line > 0 || !matches!(said, Said::Nothing) || lines.trimmed(0) == b"0";
            let item_at = self.table.items.len() as u32;
            let mut item = Item { context, became: Became::Nothing, named: Named::ByText };
            match said {
                Said::Nothing => {}
                Said::Structure { entities, unit: stated } => {
                    item.became = Became::Structure { entities, unit: stated };
                    unit = stated.or(unit);
                    self.table.sections += usize::from(entities);
                    if entities && self.table.sections > 1 {
                        let sentence = "a second section ENTITIES begins here; both are read".to_owned();
                        fault::oddity(&mut self.findings, lines.trimmed_range(line + 1), sentence);
                    }
                }
                Said::Entity(outcome) => {
                    ordinal += usize::from(context == Context::Entities);
                    match outcome {
                        Outcome::Damaged => item.became = Became::Damaged,
                        Outcome::Unsupported(kind, why) => item.became = Became::Unsupported(self.table.kinds.index(kind, why)),
                        Outcome::Entity(read) => {
                            item.named = if read.handle.is_some() { Named::ByText } else { Named::ByOrdinal };
                            let asked = read.handle.as_ref().map_or_else(|| format!("#{ordinal}").into(), |(handle, _)| handle.clone());
                            let handle_line = read.handle.as_ref().map_or(line + 1, |(_, line)| *line);
                            let entity =
                                Entity { handle: asked.clone(), layer: read.layer, role: None, kind: read.kind, geometry: read.geometry };
                            let id = drawing.push(entity);
                            if let Some(given) = drawing.get(id).map(|entity| &entity.handle).filter(|given| **given != asked) {
                                let sentence =
                                    format!("the handle {asked} is taken by an entity before this one, which is called {given} here");
                                fault::oddity(&mut self.findings, lines.trimmed_range(handle_line), sentence);
                                item.named = Named::Anew;
                            }
                            item.became = Became::Entity(id);
                            self.table.by_ordinal += usize::from(item.named == Named::ByOrdinal);
                            self.table.named_anew += usize::from(item.named == Named::Anew);
                            self.table.set_item_of(id, item_at);
                            if let Some(vertices) = read.vertices {
                                self.table.vertices.insert(id, vertices);
                            }
                        }
                    }
                }
            }
            self.table.lines.push(line as u32);
            self.table.items.push(item);
        }
        if !any_record {
            return self.is_no_dxf("the text has no DXF records: expected lines of group codes and values, as 0 and SECTION");
        }
        drawing.unit = unit.and_then(unit_of);
        if let Some(sentence) = about_unit(unit) {
            let finding =
                Finding { rule: Rule::Units, severity: Severity::Warning, place: Place::Document, detail: Detail::Units(sentence) };
            self.findings.insert(0, finding);
        }
        self.drawing = Arc::new(drawing);
        self.name_unsupported();
    }

    /// One finding for each kind of entity that is not cut, at the first of it; all findings in the order of the text.
    fn name_unsupported(&mut self) {
        self.findings.retain(|finding| finding.rule != Rule::UnsupportedEntity);
        let mut count = vec![0usize; self.table.kinds.len()];
        let mut first = vec![NO_ITEM; self.table.kinds.len()];
        for (index, item) in self.table.items.iter().enumerate() {
            if let Became::Unsupported(kind) = item.became {
                let kind = kind as usize;
                if count[kind] == 0 {
                    first[kind] = index as u32;
                }
                count[kind] += 1;
            }
        }
        let lines = Lines::new(&self.text);
        for (index, (&count, &first)) in count.iter().zip(&first).enumerate() {
            let Some((kind, why)) = self.table.kinds.get(index as u32).filter(|_| count > 0) else { continue };
            let line = self.table.lines.get(first as usize).map_or(0, |&line| line as usize + 1);
            self.findings.push(Finding {
                rule: Rule::UnsupportedEntity,
                severity: Severity::Information,
                place: Place::Text { range: lines.trimmed_range(line) },
                detail: Detail::UnsupportedEntity { kind: kind.clone(), count, why },
            });
        }
        self.findings.sort_by_key(range_key);
    }

    /// Makes the document one without a drawing and with one finding.
    fn is_no_dxf(&mut self, sentence: &str) {
        *self.table = Table::default();
        self.drawing = Arc::default();
        self.findings.clear();
        let line = self.text.line_range(0);
        fault::damage(&mut self.findings, 0..line.end.min(64), sentence.to_owned());
    }
}

/// The unit that a value of `$INSUNITS` stands for (DXF reference, HEADER section); `None` where it is no length.
fn unit_of(insunits: i64) -> Option<Unit> {
    let mm = match insunits {
        1 => 25.4,
        2 => 304.8,
        3 => 1_609_344.0,
        4 => 1.0,
        5 => 10.0,
        6 => 1000.0,
        7 => 1e6,
        8 => 25.4e-6,
        9 => 0.0254,
        10 => 914.4,
        11 => 1e-7,
        12 => 1e-6,
        13 => 1e-3,
        14 => 100.0,
        15 => 1e4,
        16 => 1e5,
        17 => 1e12,
        21 => 1200.0 / 3937.0 * 1000.0,
        _ => return None,
    };
    Some(Unit { mm })
}

fn about_unit(insunits: Option<i64>) -> Option<String> {
    match insunits {
        None => Some("the drawing does not say its unit ($INSUNITS is missing): the unit of the settings holds".into()),
        Some(0) => Some("the drawing says that it has no unit ($INSUNITS is 0): the unit of the settings holds".into()),
        Some(other) if unit_of(other).is_none() => {
            Some(format!("$INSUNITS is {other}, which is no unit of length that is known here: the unit of the settings holds"))
        }
        Some(_) => None,
    }
}
