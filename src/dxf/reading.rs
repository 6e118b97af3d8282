//! Reads the whole text from its beginning: entities into the drawing, blocks drawn at their references.

use super::ahead;
use super::blocks::{BlockPart, Blocks, Drawn, Undrawn};
use super::entity::{Appearance, Insert, Outcome, Paint, Read};
use super::inherited::stroke;
use super::layer_table::{LayerEntry, LayerStates};
use super::layers::Layers;
use super::lexer::Lexer;
use super::lines::Lines;
use super::reader::{ReadItem, Said, read_item};
use super::shape::{self, Shape};
use super::table::{Became, Context, Item, Named, Table};
use super::unit::{StatedUnit, fit_tolerance};
use super::{Document, doubled, fault, frame};
use crate::drawing::{Drawing, Entity, EntityId, Handle, Kind, Visibility};
use crate::finding::NotJudged;
use rayon::prelude::*;
use rustc_hash::FxHashSet;
use std::sync::Arc;

/// What is gathered while the whole text is read.
#[derive(Default)]
pub(super) struct Reading {
    pub(super) drawing: Drawing,
    pub(super) unit: StatedUnit,
    ordinal: usize,
    pub(super) any_record: bool,
    pub(super) blocks: Blocks,
    /// The blocks of the file, when they are known from an earlier reading.
    pub(super) known: Option<Blocks>,
    /// Handles of entities that are the frame of a text.
    pub(super) frames: FxHashSet<u64>,
    /// Something in the modelspace refers to a block.
    refers: bool,
    /// A block was used before all blocks were read, so its content was not known yet.
    pub(super) early: bool,
}

impl Document {
    /// Reads all items. Blocks are `known` from an earlier reading where references come before
    /// their blocks.
    pub(super) fn read_items(&mut self, known: Option<Blocks>) -> Reading {
        let stretch = ahead::stretch_of(Lines::new(&self.text));
        self.read_items_ahead(known, stretch)
    }

    /// The same, with this many lines in each stretch that is read ahead, if any.
    pub(super) fn read_items_ahead(
        &mut self,
        known: Option<Blocks>,
        mut stretch: Option<usize>,
    ) -> Reading {
        let lines = Lines::new(&self.text);
        self.table.fit_tolerance = fit_tolerance(self.arc_fit, None);
        let mut pass = Pass {
            lexer: Lexer::new(lines, 0),
            arc_fit: self.arc_fit,
            table: &mut self.table,
            reading: Reading {
                known,
                ..Reading::default()
            },
        };
        let mut context = Context::Outside;
        while let Some(read) = read_item(
            &mut pass.lexer,
            context,
            pass.table.fit_tolerance,
            &mut self.layers,
        ) {
            context = read.after;
            pass.take(read);
            // Once: later sections of that name are read sequentially.
            if context == Context::Entities
                && let Some(lines) = stretch.take()
            {
                context = pass.take_stretches(lines, &mut self.layers);
            }
        }
        self.findings = pass.lexer.findings;
        pass.reading
    }
}

/// One pass over the text that records everything read.
struct Pass<'a> {
    lexer: Lexer<'a>,
    arc_fit: Option<f64>,
    table: &'a mut Table,
    reading: Reading,
}

impl Pass<'_> {
    /// Takes the text from a record in the section ENTITIES on, up to the end of a stretch in which that section ends. Returns the
    /// section there.
    fn take_stretches(&mut self, stretch: usize, layers: &mut Layers) -> Context {
        let (lines, tolerance) = (self.lexer.lines, self.table.fit_tolerance);
        let at_once = 4 * rayon::current_num_threads();
        let empty = layers.empty();
        let read = |from: usize| {
            let each = (0..at_once)
                .into_par_iter()
                .map(|nth| from + nth * stretch)
                .filter(|first| *first < lines.count());
            let of = |first| {
                ahead::Stretch::read(lines, first..first + stretch, tolerance, empty.clone())
            };
            each.map(of).collect::<Vec<ahead::Stretch>>()
        };
        let mut from = self.lexer.at();
        let mut context = Context::Entities;
        let mut next = read(from);
        while context == Context::Entities && !next.is_empty() {
            from += at_once * stretch;
            let here = std::mem::take(&mut next);
            let take = || {
                let mut stretches = here.into_iter();
                stretches.try_fold(context, |context, stretch| {
                    self.take_stretch(stretch, context, layers)
                })
            };
            let (taken, following) = rayon::join(take, || read(from));
            (context, next) = (taken.unwrap_or(Context::Outside), following);
        }
        context
    }

    /// Takes the text up to the end of a stretch; `None` where the text ends.
    fn take_stretch(
        &mut self,
        stretch: ahead::Stretch,
        mut context: Context,
        layers: &mut Layers,
    ) -> Option<Context> {
        while self.lexer.at() < stretch.end {
            let at = self.lexer.at();
            let found = stretch
                .items
                .binary_search_by_key(&at, |(item, _)| item.line);
            if let Ok(first) = found
                && stretch
                    .items
                    .get(first)
                    .is_some_and(|(item, _)| item.context == context)
            {
                let mut items = stretch.items.into_iter().skip(first).peekable();
                while let Some((mut item, mut findings)) = items.next() {
                    context = item.after;
                    ahead::share_names(&mut item, layers);
                    let end = items.peek().map_or(stretch.end, |(next, _)| next.line);
                    self.lexer.begin_item(end);
                    self.lexer.findings.append(&mut findings);
                    self.take(item);
                }
                break;
            }
            let tolerance = self.table.fit_tolerance;
            let item = read_item(&mut self.lexer, context, tolerance, layers)?;
            context = item.after;
            self.take(item);
        }
        Some(context)
    }
}

impl Pass<'_> {
    fn take(&mut self, read: ReadItem) {
        let ReadItem {
            line,
            context,
            said,
            ..
        } = read;
        self.reading.any_record |=
            line > 0 || !matches!(said, Said::Nothing) || self.lexer.lines.trimmed(0) == b"0";
        let mut item = Item {
            context,
            became: Became::Nothing,
            named: Named::ByText,
        };
        match said {
            Said::Nothing => {}
            Said::Layer(entry) => item.became = self.layer(entry),
            Said::Block => {
                item.became = Became::Block;
                self.reading.early |= self.reading.known.is_none() && self.reading.refers;
                if let Some(name_line) = self.reading.blocks.begin(&self.lexer, line) {
                    let sentence = say!(a_block_of_this_name_stands_before_this_one).to_owned();
                    self.lexer.oddity(name_line, sentence);
                }
            }
            Said::Structure { entities, unit } => {
                item.became = Became::Structure { entities, unit };
                self.structure(entities, unit, line);
            }
            Said::Entity(outcome) => self.outcome(outcome, line, &mut item),
        }
        self.table.lines.push(line as u32);
        self.table.items.push(item);
    }

    fn layer(&mut self, entry: LayerEntry) -> Became {
        // An entity that comes before the entry of its layer is read again.
        self.reading.early |=
            self.reading.known.is_none() && !self.reading.drawing.is_empty() && !entry.is_plain();
        self.table.states.enter(&entry);
        if let Some(color) = entry.color {
            self.reading.drawing.set_layer_color(&entry.name, color);
        }
        self.table.layers.push(entry);
        Became::Layer(self.table.layers.len() as u32 - 1)
    }

    fn structure(&mut self, entities: bool, unit: StatedUnit, line: usize) {
        self.reading.unit = unit.or(self.reading.unit);
        // One tolerance for all entities, also for those that are read again.
        if self.table.sections == 0 {
            let unit = self.reading.unit.unit();
            self.table.fit_tolerance = fit_tolerance(self.arc_fit, unit);
        }
        self.table.sections += usize::from(entities);
        if entities && self.table.sections > 1 {
            let sentence = say!(a_second_section_entities_begins_here).to_owned();
            self.lexer.oddity(line + 1, sentence);
        }
    }

    fn outcome(&mut self, outcome: Outcome, line: usize, item: &mut Item) {
        let outcome = frame::without_frames(outcome, &self.table.frames);
        let reading = &mut self.reading;
        if let Outcome::Entity(read) = &outcome
            && self.table.frames.is_empty()
        {
            reading.frames.extend(&read.frames);
        }
        reading.ordinal += usize::from(item.context == Context::Entities);
        let in_layout = reading.blocks.in_layout();
        let mut unsupported =
            |kind: String, why| Became::Unsupported(self.table.kinds.index(kind, why));
        match (outcome, item.context, in_layout) {
            (Outcome::Damaged, ..) => item.became = Became::Damaged,
            (Outcome::Unsupported(kind, why), ..) => item.became = unsupported(kind, why),
            (Outcome::Entity(read), Context::Blocks, Some(why)) => {
                item.became = unsupported(read.kind.name().into(), why)
            }
            (Outcome::Insert(_), Context::Blocks, Some(why)) => {
                item.became = unsupported("INSERT".into(), why)
            }
            (outcome, Context::Blocks, None) => {
                reading.early |= reading.known.is_none() && reading.refers;
                reading.blocks.add(outcome);
            }
            (Outcome::Insert(insert), ..) => self.reference(&insert, line, item),
            (Outcome::Entity(read), ..) => self.entity(read, line, item),
        }
    }

    fn entity(&mut self, read: Read, line: usize, item: &mut Item) {
        let Shape::Plain(geometry) = read.shape else {
            return;
        };
        let arcs = shape::curve_arcs(read.kind, &geometry);
        if arcs > 0 && self.table.curve_arcs + arcs > shape::MOST_CURVE_ARCS {
            let what = NotJudged::Curve {
                arcs: geometry.segment_count(),
                most: shape::MOST_CURVE_ARCS,
            };
            let name = self.lexer.lines.trimmed_range(line + 1);
            fault::left_out(&mut self.lexer.findings, name, what);
            self.table.lacks_curves = true;
            item.became = Became::Damaged;
            return;
        }
        self.table.curve_arcs += arcs;
        let layer = read.layer.clone();
        let entity = Entity {
            kind: read.kind,
            ..Entity::new("", read.layer, geometry)
        };
        let id = self.push(entity, read.handle, line, item);
        let drawing = &mut self.reading.drawing;
        if is_fitted(read.kind) {
            drawing.set_fitted(id, true);
        }
        set_appearance(drawing, id, read.appearance, &layer, &mut self.table.states);
        item.became = Became::Entity(id);
        if let Some(vertices) = read.vertices {
            drawing.set_straight(id, vertices.in_space);
            drawing.set_width(id, vertices.width);
            self.table.vertices.insert(id, vertices);
        }
    }

    /// Adds an entity under its handle, or under its ordinal; a taken handle is reported.
    fn push(
        &mut self,
        entity: Entity,
        handle: Option<(Handle, usize)>,
        line: usize,
        item: &mut Item,
    ) -> EntityId {
        let (asked, handle_line, named) = match handle {
            Some((handle, line)) => (handle, line, Named::ByText),
            None => {
                let ordinal = format!("#{}", self.reading.ordinal);
                (ordinal.into(), line + 1, Named::ByOrdinal)
            }
        };
        item.named = named;
        let id = self.reading.drawing.push(Entity {
            handle: asked.clone(),
            ..entity
        });
        let given = self.reading.drawing.get(id).map(|entity| &entity.handle);
        if let Some(given) = given.filter(|given| ***given != *asked) {
            let range = self.lexer.lines.trimmed_range(handle_line);
            let finding = doubled::finding(range, &asked, given);
            self.lexer.findings.push(finding);
            item.named = Named::Anew;
        }
        self.table.by_ordinal += usize::from(item.named == Named::ByOrdinal);
        self.table.named_anew += usize::from(item.named == Named::Anew);
        self.table.set_item_of(id, self.table.items.len() as u32);
        id
    }

    /// Adds what a reference to a block draws; every part has the handle of the reference.
    fn reference(&mut self, insert: &Insert, line: usize, item: &mut Item) {
        self.reading.refers = true;
        if self.reading.early {
            // All is read again.
            return;
        }
        let reading = &mut self.reading;
        let blocks = reading.known.as_mut().unwrap_or(&mut reading.blocks);
        let tolerance = self.table.fit_tolerance;
        let Drawn { parts, left_out } =
            match blocks.resolve(insert, tolerance, &mut self.table.states) {
                Ok(drawn) => drawn,
                Err(why) => {
                    item.became = Became::Damaged;
                    let range = self.lexer.lines.trimmed_range(insert.name_line);
                    let findings = &mut self.lexer.findings;
                    return match why {
                        Undrawn::Damaged(sentence) => fault::damage(findings, range, sentence),
                        Undrawn::TooMuch(what) => fault::left_out(findings, range, what),
                    };
                }
            };
        if let (true, Some(((_, why), _))) = (parts.is_empty(), left_out.first_key_value()) {
            item.became = Became::Unsupported(self.table.kinds.index("INSERT".into(), why));
            return;
        }
        let mut ids = EntityId(0)..EntityId(0);
        let mut name: Option<Handle> = None;
        for BlockPart {
            width,
            layer,
            visibility,
            color,
            linetype,
            kind,
            geometry,
        } in parts
        {
            let entity = Entity {
                kind,
                ..Entity::new(name.clone().unwrap_or_default(), layer, geometry)
            };
            let id = if name.is_some() {
                self.reading.drawing.push_part(entity)
            } else {
                ids.start = self.push(entity, insert.handle.clone(), line, item);
                let drawing = &mut self.reading.drawing;
                drawing.set_editable(ids.start, false);
                name = drawing.get(ids.start).map(|entity| entity.handle.clone());
                ids.start
            };
            self.table.set_item_of(id, self.table.items.len() as u32);
            let drawing = &mut self.reading.drawing;
            drawing.set_visibility(id, visibility.0, &visibility.1);
            drawing.set_width(id, width);
            drawing.set_color(id, color);
            drawing.set_linetype(id, linetype);
            drawing.set_marks(id, insert.appearance.marks.clone());
            ids.end = EntityId(id.0 + 1);
        }
        item.became = Became::Parts {
            first: ids.start,
            count: ids.end.0 - ids.start.0,
        };
        if !left_out.is_empty() {
            let left_out = left_out
                .into_iter()
                .map(|((kind, why), count)| {
                    (self.table.kinds.index(kind.name().into(), why), count)
                })
                .collect();
            self.table.left_out.insert(ids.start, left_out);
        }
    }
}

/// Records the appearance of an entity. True where it changed.
pub(super) fn set_appearance(
    drawing: &mut Drawing,
    id: EntityId,
    appearance: Appearance,
    layer: &Arc<str>,
    states: &mut LayerStates,
) -> bool {
    let visibility = if appearance.invisible {
        Visibility::Invisible
    } else {
        states.of(layer)
    };
    let color = match appearance.paint {
        Paint::Own(color) => Some(color),
        Paint::ByLayer | Paint::ByBlock => None,
    };
    let linetype = stroke(&appearance.stroke, None, layer, states);
    let is_stroked_otherwise = drawing.set_linetype(id, linetype);
    let is_marked_otherwise = drawing.set_marks(id, appearance.marks);
    let seen_otherwise = drawing.set_visibility(id, visibility, layer);
    drawing.set_color(id, color) | seen_otherwise | is_stroked_otherwise | is_marked_otherwise
}

/// Kinds that become arcs within a tolerance.
pub(super) fn is_fitted(kind: Kind) -> bool {
    matches!(kind, Kind::Ellipse | Kind::Spline)
}
