//! The blocks of a drawing, and what a reference to one draws.
//!
//! Work is bounded before it begins: the size of a block is counted once, without drawing it.

use super::entity::{Appearance, Insert, Outcome};
use super::inherited::{Inherited, level};
use super::insert::block_key;
use super::layer_table::LayerStates;
use super::lexer::Lexer;
use super::number::{self, Number};
use super::place;
use super::shape::Shape;
use super::space::{Lies, Space, Vector3};
use crate::drawing::{Color, Geometry, Kind, Linetype, Visibility};
use crate::finding::NotJudged;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::sync::Arc;

/// All block references of a document together draw at most this many segments, and are copied at most this often.
const MOST_SEGMENTS: u64 = 200_000;
/// Blocks within blocks.
const DEEPEST: usize = 64;
const REFERS_TO_A_FILE: i64 = 4 | 8;

#[derive(Clone, Debug)]
enum Content {
    Shape {
        layer: Arc<str>,
        appearance: Appearance,
        /// The largest width of a polyline; 0 for none.
        width: f64,
        kind: Kind,
        shape: Shape,
        lies: Lies,
    },
    Reference(Box<Insert>),
}

#[derive(Clone, Debug)]
struct Block {
    /// As it stands in the text.
    name: String,
    base: Vector3,
    is_file: bool,
    /// Set for the block of a layout or of the modelspace, which nothing refers to: why its content is not cut.
    layout: Option<&'static str>,
    contents: Vec<Content>,
}

/// Why nothing of a layout's block is cut; `None` for any other block. Their names begin with $ before release 2000,
/// with * since, and those of further layouts end in a number.
fn layout(name: &[u8]) -> Option<&'static str> {
    let (sign, rest) = name.split_first()?;
    let begins_with = |space: &[u8]| {
        rest.get(..space.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(space))
    };
    match sign {
        b'*' | b'$' if begins_with(b"Paper_Space") => Some(say!(it_lies_in_paper_space)),
        b'*' | b'$' if begins_with(b"Model_Space") => Some(say!(
            it_stands_in_the_block_of_the_modelspace_instead_of_the_section_entities
        )),
        _ => None,
    }
}

/// The size of a block: copies and segments, and blocks below it.
#[derive(Clone, Copy, Debug)]
struct Size {
    segments: u64,
    depth: usize,
}

/// One piece of what a reference draws, in the coordinates around it.
pub(super) struct BlockPart {
    /// The largest width of a polyline; 0 for none.
    pub(super) width: f64,
    pub(super) layer: Arc<str>,
    /// Whether it is visible, and the layer that decides it.
    pub(super) visibility: (Visibility, Arc<str>),
    /// A colour other than that of its layer.
    pub(super) color: Option<Color>,
    pub(super) linetype: Option<Linetype>,
    pub(super) kind: Kind,
    pub(super) geometry: Geometry,
}

/// What one reference draws.
#[derive(Default)]
pub(super) struct Drawn {
    pub(super) parts: Vec<BlockPart>,
    /// What is not cut: why, which kind and how many.
    pub(super) left_out: BTreeMap<(Kind, &'static str), usize>,
}

/// Why a reference draws nothing.
#[derive(Clone, Debug)]
pub(super) enum Undrawn {
    /// What is damaged.
    Damaged(String),
    TooMuch(NotJudged),
}

/// Blocks in the order of the text.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    blocks: Vec<Block>,
    by_name: FxHashMap<String, usize>,
    sizes: Vec<Option<Size>>,
    /// Why a reference draws nothing, for each block that was asked for.
    refused: FxHashMap<usize, String>,
    /// Segments drawn by the references so far.
    drawn: u64,
    /// Blocks that a drawn reference uses.
    pub(super) used: Vec<bool>,
}

impl Blocks {
    /// The same blocks, with no results kept: results from before the blocks were complete may be
    /// wrong.
    pub(super) fn unasked(self) -> Blocks {
        let sizes = vec![None; self.blocks.len()];
        let used = self
            .blocks
            .iter()
            .map(|block| block.layout.is_some())
            .collect();
        Blocks {
            blocks: self.blocks,
            by_name: self.by_name,
            sizes,
            used,
            ..Blocks::default()
        }
    }

    /// Begins the block whose record starts at `line` and ends before the lexer's place. A taken name stays with the
    /// block that had it first; the line of the name is then returned.
    pub(super) fn begin(&mut self, lexer: &Lexer, line: usize) -> Option<usize> {
        let mut block = Block {
            name: String::new(),
            base: Vector3::zeros(),
            is_file: false,
            layout: None,
            contents: Vec::new(),
        };
        let mut name_line = line + 1;
        let number = |line: usize| match number::number(lexer.lines.content(line)) {
            Number::Exact(value) | Number::Blemished(value, _) => value,
            Number::Bad => 0.0,
        };
        let mut name: &[u8] = b"";
        for tag in place::own_tags(lexer.lines, line..lexer.at()) {
            match tag.code {
                2 => (name, name_line) = (lexer.lines.trimmed(tag.value_line()), tag.value_line()),
                10 => block.base.x = number(tag.value_line()),
                20 => block.base.y = number(tag.value_line()),
                30 => block.base.z = number(tag.value_line()),
                70 => block.is_file = number(tag.value_line()) as i64 & REFERS_TO_A_FILE != 0,
                _ => {}
            }
        }
        block.name = String::from_utf8_lossy(name).into_owned();
        block.layout = layout(name);
        let first = *self
            .by_name
            .entry(block_key(name))
            .or_insert(self.blocks.len());
        let is_doubled = first < self.blocks.len();
        self.used.push(block.layout.is_some());
        self.blocks.push(block);
        self.sizes.push(None);
        is_doubled.then_some(name_line)
    }

    /// Why the content is not cut, while the block of a layout or of the modelspace is read.
    pub(super) fn in_layout(&self) -> Option<&'static str> {
        self.blocks.last()?.layout
    }

    /// Adds what was read to the last block begun.
    pub(super) fn add(&mut self, outcome: Outcome) {
        let Some(block) = self.blocks.last_mut() else {
            return;
        };
        match outcome {
            Outcome::Entity(read) => {
                block.contents.push(Content::Shape {
                    layer: read.layer,
                    appearance: read.appearance,
                    width: read.vertices.map_or(0.0, |vertices| vertices.width),
                    kind: read.kind,
                    shape: read.shape,
                    lies: read.lies,
                });
            }
            Outcome::Insert(insert) => block.contents.push(Content::Reference(insert)),
            Outcome::Unsupported(..) | Outcome::Damaged => {}
        }
    }

    /// What a reference in the modelspace draws; curves are fitted within `tolerance`. An error says why it draws nothing.
    pub(super) fn resolve(
        &mut self,
        insert: &Insert,
        tolerance: f64,
        states: &mut LayerStates,
    ) -> Result<Drawn, Undrawn> {
        let Some(&block) = self.by_name.get(&insert.block) else {
            return Err(Undrawn::Damaged(say!(the_block_is_not_in_the_file).into()));
        };
        if let Some(why) = self.refused.get(&block) {
            return Err(Undrawn::Damaged(why.clone()));
        }
        let size = match self.size_of(block, &mut Vec::new()) {
            Ok(size) => size,
            Err(why) => {
                self.refused.insert(block, why.clone());
                return Err(Undrawn::Damaged(why));
            }
        };
        let all = insert
            .copies()
            .saturating_mul(size.segments.saturating_add(1));
        if self.drawn.saturating_add(all) > MOST_SEGMENTS {
            return Err(Undrawn::TooMuch(NotJudged::Reference {
                copies: insert.copies(),
                segments: all,
                most: MOST_SEGMENTS,
            }));
        }
        self.drawn += all;
        let drawn = self.drawn_by(insert, block, tolerance, states);
        self.mark_used(block);
        Ok(drawn)
    }

    /// What a reference draws now that was drawn before with other numbers, its block and its
    /// copies the same.
    pub(super) fn redraw(
        &self,
        insert: &Insert,
        tolerance: f64,
        states: &mut LayerStates,
    ) -> Option<Drawn> {
        let block = *self.by_name.get(&insert.block)?;
        Some(self.drawn_by(insert, block, tolerance, states))
    }

    fn drawn_by(
        &self,
        insert: &Insert,
        block: usize,
        tolerance: f64,
        states: &mut LayerStates,
    ) -> Drawn {
        let mut drawn = Drawn::default();
        let inherited = Inherited::from(insert, &insert.layer, None, states);
        self.draw(
            insert,
            block,
            &Space::IDENTITY,
            &inherited,
            &mut Pen {
                tolerance,
                states,
                drawn: &mut drawn,
            },
        );
        drawn
    }

    /// Counts a block. `path` holds the blocks around it.
    fn size_of(&mut self, index: usize, path: &mut Vec<usize>) -> Result<Size, String> {
        if let Some(size) = self.sizes.get(index).copied().flatten() {
            return if path.len() + size.depth > DEEPEST {
                Err(too_deep())
            } else {
                Ok(size)
            };
        }
        if path.contains(&index) {
            let names: Vec<&str> = path
                .iter()
                .chain([&index])
                .filter_map(|&at| Some(self.blocks.get(at)?.name.as_str()))
                .collect();
            let name = |at: usize| {
                super::fault::quoted(names.get(at).copied().unwrap_or_default().as_bytes())
            };
            return Err(say!(
                the_block_holds_itself,
                name(names.len().saturating_sub(1))
            ));
        }
        if path.len() >= DEEPEST {
            return Err(too_deep());
        }
        let Some(block) = self.blocks.get(index) else {
            return Ok(Size {
                segments: 0,
                depth: 0,
            });
        };
        if block.is_file {
            return Err(say!(the_block_stands_in_another_file).into());
        }
        let mut size = Size {
            segments: 0,
            depth: 1,
        };
        // The size of each block is found once, however often it is referred to.
        let mut below: FxHashMap<usize, u64> = FxHashMap::default();
        for content in &block.contents {
            match content {
                Content::Shape { shape, .. } => {
                    size.segments = size.segments.saturating_add(shape.cost())
                }
                Content::Reference(insert) => {
                    if let Some(&block) = self.by_name.get(&insert.block) {
                        let copies = below.entry(block).or_default();
                        *copies = copies.saturating_add(insert.copies());
                    }
                }
            }
        }
        path.push(index);
        let mut below: Vec<(usize, u64)> = below.into_iter().collect();
        below.sort_unstable();
        for (block, copies) in below {
            let inner = self.size_of(block, path)?;
            size.segments = size
                .segments
                .saturating_add(copies.saturating_mul(inner.segments.saturating_add(1)));
            size.depth = size.depth.max(inner.depth + 1);
        }
        path.pop();
        if let Some(slot) = self.sizes.get_mut(index) {
            *slot = Some(size);
        }
        Ok(size)
    }

    fn draw(
        &self,
        insert: &Insert,
        block: usize,
        around: &Space,
        inherited: &Inherited,
        pen: &mut Pen,
    ) {
        let Some(block) = self.blocks.get(block) else {
            return;
        };
        let base = Space {
            origin: -block.base,
            ..Space::IDENTITY
        };
        for row in 0..insert.rows.0 {
            for column in 0..insert.columns.0 {
                let offset = insert.columns.1 * column as f64 + insert.rows.1 * row as f64;
                let placed = Space {
                    origin: insert.map.origin + offset,
                    ..insert.map
                };
                let map = around.after(&placed).after(&base);
                for content in &block.contents {
                    let own = match content {
                        Content::Shape { layer, .. } => layer,
                        Content::Reference(inner) => &inner.layer,
                    };
                    // What lies on layer 0 takes the layer of the reference.
                    let layer = if **own == *"0" { &inherited.layer } else { own };
                    match content {
                        Content::Shape {
                            kind,
                            shape,
                            appearance,
                            width,
                            lies,
                            ..
                        } => {
                            let Some((shape, map)) = level(&map, shape, lies, *kind) else {
                                *pen.drawn
                                    .left_out
                                    .entry((*kind, say!(its_plane_is_tilted)))
                                    .or_default() += 1;
                                continue;
                            };
                            let scale = map.similarity().map_or(1.0, |(scale, _)| scale);
                            let (visibility, color, linetype) =
                                inherited.hand_on(appearance, layer, pen.states);
                            shape.placed(&map, *kind, &mut |kind, shape| match shape
                                .drawn(pen.tolerance)
                            {
                                Ok((geometry, _)) if geometry.is_sound() => {
                                    let (layer, visibility) = (layer.clone(), visibility.clone());
                                    pen.drawn.parts.push(BlockPart {
                                        width: width * scale,
                                        layer,
                                        visibility,
                                        color,
                                        linetype: linetype.clone(),
                                        kind,
                                        geometry,
                                    });
                                }
                                _ => {
                                    *pen.drawn
                                        .left_out
                                        .entry((
                                            kind,
                                            say!(as_a_part_of_a_block_it_comes_to_nothing),
                                        ))
                                        .or_default() += 1
                                }
                            });
                        }
                        Content::Reference(inner) => {
                            if let Some(&block) = self.by_name.get(&inner.block) {
                                let handed_on =
                                    Inherited::from(inner, layer, Some(inherited), pen.states);
                                self.draw(inner, block, &map, &handed_on, pen);
                            }
                        }
                    }
                }
            }
        }
    }

    fn mark_used(&mut self, block: usize) {
        let mut open = vec![block];
        while let Some(block) = open.pop() {
            let Some(used) = self.used.get_mut(block).filter(|used| !**used) else {
                continue;
            };
            *used = true;
            let Some(block) = self.blocks.get(block) else {
                continue;
            };
            let inner = block.contents.iter().filter_map(|content| match content {
                Content::Reference(insert) => self.by_name.get(&insert.block).copied(),
                Content::Shape { .. } => None,
            });
            open.extend(inner);
        }
    }
}

/// Draws the parts of a block.
struct Pen<'a> {
    tolerance: f64,
    states: &'a mut LayerStates,
    drawn: &'a mut Drawn,
}

fn too_deep() -> String {
    say!(blocks_within_blocks_are_too_deep, DEEPEST)
}
