//! DXF text: read without loss, edited in place.
//!
//! The text is cut into items, one for each record (a POLYLINE with its vertices is one). Only where the items begin is
//! kept of them, and where the vertices of a polyline stand; tags are read again when somebody asks for their place.
//!
//! Invariant: after any sequence of edits a document equals a fresh reading of its text, the numbers of its
//! entity ids aside.

mod binary;
mod blocks;
mod change;
mod code_page;
mod curve;
mod dxb;
mod edit;
mod entities;
mod entity;
mod fault;
mod foreign;
mod frame;
mod insert;
mod johab;
mod layer_table;
mod layers;
pub(crate) mod lexer;
pub(crate) mod lines;
pub(crate) mod number;
pub(crate) mod place;
mod plain;
mod reader;
mod record;
mod shape;
mod sleep;
mod space;
mod strings;
pub(crate) mod table;
#[cfg(test)]
mod tests;
mod write;

pub use write::write;

use crate::drawing::{Drawing, Entity, EntityId, Handle, Kind, Unit, Visibility};
use crate::finding::{Detail, Finding, NotJudged, Place, Rule, Severity};
use crate::geometry::Tolerances;
use crate::text::SourceText;
use blocks::{Blocks, Drawn, Part, Undrawn};
use code_page::CodePage;
use entity::{Insert, Look, Outcome, Paint};
use layer_table::LayerStates;
use layers::Layers;
use lexer::Lexer;
use lines::Lines;
use reader::{ReadItem, Said, range_key, read_item};
use rustc_hash::FxHashSet;
use shape::Shape;
use std::collections::BTreeMap;
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
    sleeper: Option<Box<sleep::Sleeper>>,
    is_binary: bool,
    /// How near arcs lie to the curves that they stand for, in mm; the default where none is set.
    arc_fit: Option<f64>,
    /// The unit of a drawing that states none.
    assumed_unit: Option<Unit>,
}

impl Document {
    /// Reads a file: DXF text in the code page that it names, or binary DXF or DXB, which become text that says the same
    /// (see [`Document::is_binary`]). Never fails: what is damaged is in [`Document::findings`].
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
            // What the last record lacks is beyond the end: one fault, one finding.
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

    /// Reads DXF text, which is UTF-8. Never fails: what is damaged is in [`Document::findings`].
    pub fn read(bytes: Vec<u8>) -> Document {
        let mut document = Document::default();
        document.take(bytes);
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

    /// What became of each record.
    pub(crate) fn table(&self) -> &Table {
        &self.table
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    /// Says how near the arcs must lie to the ellipses and splines that they stand for, in mm. Where there are some and it is
    /// something new, the text is read again: ids of entities may change.
    pub fn set_arc_fit(&mut self, mm: f64) {
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

    /// True where [`Document::text`] is not the file's own bytes, but what a binary DXF or DXB file says. It cannot be edited.
    pub fn is_binary(&self) -> bool {
        self.is_binary
    }

    /// Says which unit the drawing has where it states none.
    pub fn assume_unit(&mut self, unit: Unit) {
        self.assumed_unit = Some(unit);
        if self.drawing.assumes_another(unit) {
            Arc::make_mut(&mut self.drawing).assume_unit(unit);
        }
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
        self.sleeper = None;
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
        let mut reading = Reading::default();
        self.read_items(&mut reading);
        if !reading.frames.is_empty() {
            // A frame may stand before its text.
            self.findings.clear();
            *self.table = Table {
                frames: reading.frames,
                ..Table::default()
            };
            reading = Reading::default();
            self.read_items(&mut reading);
        }
        if reading.early {
            reading.states = std::mem::take(&mut self.table.states);
            // Blocks, or parts of them, that stand behind what refers to them.
            self.findings.clear();
            *self.table = Table {
                frames: std::mem::take(&mut self.table.frames),
                ..Table::default()
            };
            self.table.states = std::mem::take(&mut reading.states);
            reading = Reading {
                known: Some(reading.blocks.unasked()),
                ..Reading::default()
            };
            self.read_items(&mut reading);
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
        self.table.used = known.unwrap_or(blocks).used;
        drawing.unit = unit.and_then(unit_of);
        if let Some(unit) = self.assumed_unit {
            drawing.assume_unit(unit);
        }
        if let Some(sentence) = about_unit(unit) {
            let finding = Finding {
                rule: Rule::Units,
                severity: Severity::Warning,
                place: Place::Document,
                detail: Detail::Units(sentence),
                related: Vec::new(),
            };
            self.findings.insert(0, finding);
        }
        drawing.shrink_to_fit();
        self.table.shrink_to_fit();
        self.drawing = Arc::new(drawing);
        self.name_unsupported();
    }

    fn read_items(&mut self, reading: &mut Reading) {
        let Document {
            text,
            findings,
            table,
            layers,
            arc_fit,
            ..
        } = self;
        let lines = Lines::new(text);
        let mut lexer = Lexer::new(lines, 0);
        let mut context = Context::Outside;
        table.fit_tolerance = fit_tolerance(*arc_fit, None);
        while let Some(read) = read_item(&mut lexer, context, table.fit_tolerance, layers, findings)
        {
            context = read.after;
            let ReadItem {
                line,
                context,
                said,
                ..
            } = read;
            reading.any_record |=
                line > 0 || !matches!(said, Said::Nothing) || lines.trimmed(0) == b"0";
            let mut item = Item {
                context,
                became: Became::Nothing,
                named: Named::ByText,
            };
            match said {
                Said::Nothing => {}
                Said::Layer(entry) => {
                    // What stands before its layer is read again.
                    reading.early |= reading.known.is_none()
                        && !reading.drawing.is_empty()
                        && entry.visibility != Visibility::Shown;
                    table.states.enter(&entry);
                    if let Some(color) = entry.color {
                        reading.drawing.set_layer_color(&entry.name, color);
                    }
                    item.became = Became::Layer(table.layers.len() as u32);
                    table.layers.push(entry);
                }
                Said::Block => {
                    item.became = Became::Block;
                    reading.early |= reading.known.is_none() && reading.refers;
                    if let Some(name_line) = reading.blocks.begin(&lexer, line) {
                        let sentence = say!(a_block_of_this_name_stands_before_this_one).to_owned();
                        fault::oddity(findings, lines.trimmed_range(name_line), sentence);
                    }
                }
                Said::Structure {
                    entities,
                    unit: stated,
                } => {
                    item.became = Became::Structure {
                        entities,
                        unit: stated,
                    };
                    reading.unit = stated.or(reading.unit);
                    // One tolerance for all entities, also for those that are read again.
                    if table.sections == 0 {
                        table.fit_tolerance =
                            fit_tolerance(*arc_fit, reading.unit.and_then(unit_of));
                    }
                    table.sections += usize::from(entities);
                    if entities && table.sections > 1 {
                        let sentence = say!(a_second_section_entities_begins_here).to_owned();
                        fault::oddity(findings, lines.trimmed_range(line + 1), sentence);
                    }
                }
                Said::Entity(outcome) => {
                    let outcome = frame::without_frames(outcome, &table.frames);
                    if let Outcome::Entity(read) = &outcome
                        && table.frames.is_empty()
                    {
                        reading.frames.extend(&read.frames);
                    }
                    reading.ordinal += usize::from(context == Context::Entities);
                    match outcome {
                        Outcome::Damaged => item.became = Became::Damaged,
                        Outcome::Unsupported(kind, why) => {
                            item.became = Became::Unsupported(table.kinds.index(kind, why))
                        }
                        outcome
                            if context == Context::Blocks
                                && reading.blocks.in_layout().is_some() =>
                        {
                            let kind = match &outcome {
                                Outcome::Entity(read) => read.kind.name(),
                                _ => "INSERT",
                            };
                            let why = reading.blocks.in_layout().unwrap_or_default();
                            item.became = Became::Unsupported(table.kinds.index(kind.into(), why));
                        }
                        outcome if context == Context::Blocks => {
                            reading.early |= reading.known.is_none() && reading.refers;
                            reading.blocks.add(outcome);
                        }
                        Outcome::Insert(insert) => {
                            reading.push_reference(&insert, line, &mut item, table, findings, lines)
                        }
                        Outcome::Entity(read) => {
                            if let Shape::Plain(geometry) = read.shape {
                                let arcs = shape::curve_arcs(read.kind, &geometry);
                                if arcs > 0 && table.curve_arcs + arcs > shape::MOST_CURVE_ARCS {
                                    let what = NotJudged::Curve {
                                        arcs: geometry.segment_count(),
                                        most: shape::MOST_CURVE_ARCS,
                                    };
                                    fault::left_out(findings, lines.trimmed_range(line + 1), what);
                                    table.lacks_curves = true;
                                    item.became = Became::Damaged;
                                    table.lines.push(line as u32);
                                    table.items.push(item);
                                    continue;
                                }
                                table.curve_arcs += arcs;
                                let layer = read.layer.clone();
                                let entity = Entity {
                                    handle: "".into(),
                                    layer: read.layer,
                                    role: None,
                                    kind: read.kind,
                                    geometry,
                                };
                                let id = reading.push_entity(
                                    entity,
                                    read.handle,
                                    line,
                                    &mut item,
                                    table,
                                    findings,
                                    lines,
                                );
                                if is_fitted(read.kind) {
                                    reading.drawing.set_fitted(id, true);
                                }
                                set_look(
                                    &mut reading.drawing,
                                    id,
                                    read.look,
                                    &layer,
                                    &mut table.states,
                                );
                                item.became = Became::Entity(id);
                                if let Some(vertices) = read.vertices {
                                    reading.drawing.set_straight(id, vertices.in_space);
                                    table.vertices.insert(id, vertices);
                                }
                            }
                        }
                    }
                }
            }
            table.lines.push(line as u32);
            table.items.push(item);
        }
    }

    /// One finding for each kind of entity that is not cut, at the first of it; all findings in the order of the text.
    fn name_unsupported(&mut self) {
        self.findings
            .retain(|finding| finding.rule != Rule::UnsupportedEntity);
        let mut count = vec![0usize; self.table.kinds.len()];
        let mut first = vec![NO_ITEM; self.table.kinds.len()];
        // What a block holds counts where the block is drawn.
        let mut used = self.table.used.iter();
        let mut is_drawn = false;
        // Of most drawings everything is cut: then no item is looked at, however many there are.
        let items = if count.is_empty() {
            &[][..]
        } else {
            &self.table.items[..]
        };
        for (index, item) in items.iter().enumerate() {
            if item.became == Became::Block {
                is_drawn = used.next().copied().unwrap_or(false);
            }
            let mut name = |kind: u32, how_many: usize| {
                let kind = kind as usize;
                if count[kind] == 0 {
                    first[kind] = index as u32;
                }
                count[kind] += how_many;
            };
            match item.became {
                Became::Unsupported(kind) if item.context != Context::Blocks || is_drawn => {
                    name(kind, 1)
                }
                Became::Parts { first, .. } if !self.table.left_out.is_empty() => {
                    let left_out = self.table.left_out.get(&first).into_iter().flatten();
                    left_out.for_each(|&(kind, how_many)| name(kind, how_many));
                }
                _ => {}
            }
        }
        let lines = Lines::new(&self.text);
        for (index, (&count, &first)) in count.iter().zip(&first).enumerate() {
            let Some((kind, why)) = self.table.kinds.get(index as u32).filter(|_| count > 0) else {
                continue;
            };
            let line = self
                .table
                .lines
                .get(first as usize)
                .map_or(0, |&line| line as usize + 1);
            self.findings.push(Finding {
                rule: Rule::UnsupportedEntity,
                severity: Severity::Information,
                place: Place::Text {
                    range: lines.trimmed_range(line),
                },
                detail: Detail::UnsupportedEntity {
                    kind: kind.clone(),
                    count,
                    why,
                },
                related: Vec::new(),
            });
        }
        self.name_unseen();
        self.findings.sort_by_key(range_key);
    }

    /// One finding for each layer that is not simply shown and has something drawn on it, at its entry; one for all that is
    /// invisible by itself, at the first of it.
    fn name_unseen(&mut self) {
        let mut by_reason: BTreeMap<(Visibility, Arc<str>), (usize, u64, EntityId)> =
            BTreeMap::new();
        for (id, visibility, layer) in self.drawing.unseen() {
            if self
                .drawing
                .get(id)
                .is_some_and(|entity| entity.geometry.segment_count() > 0)
            {
                let layer = if visibility == Visibility::Invisible {
                    "".into()
                } else {
                    layer.clone()
                };
                let rank = self.drawing.rank(id);
                let (count, first, at) = by_reason
                    .entry((visibility, layer))
                    .or_insert((0, rank, id));
                *count += 1;
                if rank < *first {
                    (*first, *at) = (rank, id);
                }
            }
        }
        for ((visibility, layer), (count, _, first)) in by_reason {
            let range = self
                .entry_of(&layer)
                .unwrap_or_else(|| self.range_of(&Place::Entity { entity: first }));
            self.findings.push(Finding {
                rule: Rule::UnsupportedEntity,
                severity: Severity::Information,
                place: Place::Text { range },
                detail: Detail::Unseen {
                    layer,
                    visibility,
                    count,
                },
                related: Vec::new(),
            });
        }
    }

    /// Where the name of a layer stands in the table LAYER.
    fn entry_of(&self, layer: &str) -> Option<std::ops::Range<usize>> {
        let is_it = |became: Became| match became {
            Became::Layer(index) => self
                .table
                .layers
                .get(index as usize)
                .is_some_and(|entry| entry.name.to_lowercase() == layer.to_lowercase()),
            _ => false,
        };
        let item = self
            .table
            .items
            .iter()
            .position(|item| is_it(item.became))?;
        let lines = Lines::new(&self.text);
        let name = place::own_tags(lines, self.table.lines_of(item, lines.count()))
            .filter(|tag| tag.code == 2)
            .last()?;
        Some(lines.trimmed_range(name.value_line()))
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

/// What is gathered while the whole text is read.
#[derive(Default)]
struct Reading {
    drawing: Drawing,
    unit: Option<i32>,
    ordinal: usize,
    any_record: bool,
    blocks: Blocks,
    /// The blocks of the file, when they are known from an earlier reading.
    known: Option<Blocks>,
    /// What is known of the layers once all has been read.
    states: LayerStates,
    /// Handles of what is the frame of a text.
    frames: FxHashSet<u64>,
    /// Something in the modelspace refers to a block.
    refers: bool,
    /// A block was asked for before all blocks were read: what it draws is not known yet.
    early: bool,
}

impl Reading {
    /// Adds an entity under the handle that it has, or under its ordinal; a handle that is taken is reported.
    #[expect(
        clippy::too_many_arguments,
        reason = "the entity, and all that takes note of it"
    )]
    fn push_entity(
        &mut self,
        entity: Entity,
        handle: Option<(Handle, usize)>,
        line: usize,
        item: &mut Item,
        table: &mut Table,
        findings: &mut Vec<Finding>,
        lines: Lines,
    ) -> EntityId {
        item.named = if handle.is_some() {
            Named::ByText
        } else {
            Named::ByOrdinal
        };
        let asked: Handle = handle.as_ref().map_or_else(
            || format!("#{}", self.ordinal).into(),
            |(handle, _)| handle.clone(),
        );
        let handle_line = handle.as_ref().map_or(line + 1, |(_, line)| *line);
        let id = self.drawing.push(Entity {
            handle: asked.clone(),
            ..entity
        });
        if let Some(given) = self
            .drawing
            .get(id)
            .map(|entity| &entity.handle)
            .filter(|given| ***given != *asked)
        {
            let sentence = say!(
                the_handle_is_taken_by_an_entity_before_this_one,
                asked,
                given
            );
            fault::oddity(findings, lines.trimmed_range(handle_line), sentence);
            item.named = Named::Anew;
        }
        table.by_ordinal += usize::from(item.named == Named::ByOrdinal);
        table.named_anew += usize::from(item.named == Named::Anew);
        table.set_item_of(id, table.items.len() as u32);
        id
    }

    /// Adds what a reference to a block draws; all of it has the handle of the reference.
    fn push_reference(
        &mut self,
        insert: &Insert,
        line: usize,
        item: &mut Item,
        table: &mut Table,
        findings: &mut Vec<Finding>,
        lines: Lines,
    ) {
        self.refers = true;
        if self.early {
            // All is read again.
            return;
        }
        let blocks = self.known.as_mut().unwrap_or(&mut self.blocks);
        let Drawn { parts, left_out } =
            match blocks.resolve(insert, table.fit_tolerance, &mut table.states) {
                Ok(drawn) => drawn,
                Err(why) => {
                    item.became = Became::Damaged;
                    let range = lines.trimmed_range(insert.name_line);
                    return match why {
                        Undrawn::Damaged(sentence) => fault::damage(findings, range, sentence),
                        Undrawn::TooMuch(what) => fault::left_out(findings, range, what),
                    };
                }
            };
        if let (true, Some(((_, why), _))) = (parts.is_empty(), left_out.first_key_value()) {
            item.became = Became::Unsupported(table.kinds.index("INSERT".into(), why));
            return;
        }
        let mut ids = EntityId(0)..EntityId(0);
        let mut name: Option<Handle> = None;
        for Part {
            layer,
            visibility,
            color,
            kind,
            geometry,
        } in parts
        {
            let entity = Entity {
                handle: "".into(),
                layer,
                role: None,
                kind,
                geometry,
            };
            let id = match &name {
                Some(handle) => self.drawing.push_part(Entity {
                    handle: handle.clone(),
                    ..entity
                }),
                None => {
                    ids.start = self.push_entity(
                        entity,
                        insert.handle.clone(),
                        line,
                        item,
                        table,
                        findings,
                        lines,
                    );
                    self.drawing.set_editable(ids.start, false);
                    name = self
                        .drawing
                        .get(ids.start)
                        .map(|entity| entity.handle.clone());
                    ids.start
                }
            };
            table.set_item_of(id, table.items.len() as u32);
            self.drawing.set_visibility(id, visibility.0, &visibility.1);
            self.drawing.set_color(id, color);
            ids.end = EntityId(id.0 + 1);
        }
        item.became = Became::Parts {
            first: ids.start,
            count: ids.end.0 - ids.start.0,
        };
        if !left_out.is_empty() {
            let left_out = left_out
                .into_iter()
                .map(|((kind, why), count)| (table.kinds.index(kind.name().into(), why), count))
                .collect();
            table.left_out.insert(ids.start, left_out);
        }
    }
}

/// Takes note of how an entity looks. True when that is something new.
fn set_look(
    drawing: &mut Drawing,
    id: EntityId,
    look: Look,
    layer: &Arc<str>,
    states: &mut LayerStates,
) -> bool {
    let visibility = if look.invisible {
        Visibility::Invisible
    } else {
        states.of(layer)
    };
    let color = match look.paint {
        Paint::Own(color) => Some(color),
        Paint::ByLayer | Paint::ByBlock => None,
    };
    let seen_otherwise = drawing.set_visibility(id, visibility, layer);
    drawing.set_color(id, color) | seen_otherwise
}

/// Kinds that become arcs within a tolerance.
fn is_fitted(kind: Kind) -> bool {
    matches!(kind, Kind::Ellipse | Kind::Spline)
}

/// The setting for fitted arcs in drawing units. A drawing that does not say its unit may be taken for inches.
fn fit_tolerance(arc_fit: Option<f64>, unit: Option<Unit>) -> f64 {
    arc_fit.unwrap_or(Tolerances::default().arc_fit) / unit.unwrap_or(Unit::INCH).mm
}

/// The unit that a value of `$INSUNITS` stands for (DXF reference, HEADER section); `None` where it is no length.
pub(crate) fn unit_of(insunits: i32) -> Option<Unit> {
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

fn about_unit(insunits: Option<i32>) -> Option<String> {
    match insunits {
        None => Some(say!(the_drawing_does_not_say_its_unit).into()),
        Some(0) => Some(say!(the_drawing_says_that_it_has_no_unit).into()),
        Some(other) if unit_of(other).is_none() => {
            Some(say!(insunits_is_no_unit_that_is_known, other))
        }
        Some(_) => None,
    }
}
