//! From entities and segments to their bytes in the text, and back.

use super::Document;
use super::lexer::Tag;
use super::lines::Lines;
use super::number::{self, Code};
use crate::drawing::{EntityId, Geometry};
use crate::finding::Place;
use std::ops::Range;

/// The tags between two lines of a stretch that is in step, as in every entity with geometry.
pub(crate) fn tags<'a>(lines: Lines<'a>, range: Range<usize>) -> impl Iterator<Item = Tag> + 'a {
    let end = range.end.min(lines.count());
    (range.start..end.saturating_sub(1))
        .step_by(2)
        .filter_map(move |line| match number::code(lines.content(line)) {
            Code::Known(code) => Some(Tag { code, line }),
            _ => None,
        })
}

/// The own tags of one record: not those of the next record, of other programs, or of an embedded object.
pub(crate) fn own_tags<'a>(
    lines: Lines<'a>,
    range: Range<usize>,
) -> impl Iterator<Item = Tag> + 'a {
    let mut group = false;
    tags(lines, range.start + 2..range.end)
        .take_while(|tag| !matches!(tag.code, 0 | 101 | 1000..))
        .filter(move |tag| {
            if tag.code == 102 {
                group = lines.trimmed(tag.value_line()).starts_with(b"{");
                return false;
            }
            !group
        })
}

impl Document {
    /// The bytes of a place: the number at fault (code 42 of the vertex, 40 of an ARC or CIRCLE),
    /// or the entity's name.
    ///
    /// For a segment without a bulge its first x. For a place that is not (or no longer) in the text, the beginning of
    /// the text.
    pub fn range_of(&self, place: &Place) -> Range<usize> {
        match *place {
            Place::Text { ref range } => range.clone(),
            Place::Document => 0..0,
            Place::Entity { entity } => self.name_of(entity),
            Place::Segment { entity, segment } => self
                .number_of(entity, segment)
                .unwrap_or_else(|| self.name_of(entity)),
        }
    }

    fn name_of(&self, entity: EntityId) -> Range<usize> {
        let Some(item) = self.table.item_of(entity) else {
            return 0..0;
        };
        let lines = Lines::new(&self.text);
        lines.trimmed_range(self.table.lines_of(item, lines.count()).start + 1)
    }

    fn number_of(&self, entity: EntityId, segment: usize) -> Option<Range<usize>> {
        if !self.drawing.is_editable(entity) {
            return None;
        }
        let lines = Lines::new(&self.text);
        let wanted = match self.drawing.get(entity)?.geometry {
            Geometry::Arc { .. } | Geometry::Circle { .. } => 40,
            Geometry::Polyline { .. } => 42,
            _ => 10,
        };
        let of_entity = self
            .table
            .lines_of(self.table.item_of(entity)?, lines.count());
        let (mut number, mut x) = (None, None);
        let found: Box<dyn Iterator<Item = Tag>> = match self.vertex_lines(entity, segment) {
            Some(range) => Box::new(vertex_tags(lines, range)),
            None => Box::new(own_tags(lines, of_entity)),
        };
        for tag in found {
            if tag.code == wanted {
                number = Some(tag);
            } else if tag.code == 10 {
                x = Some(tag);
            }
        }
        number
            .or(x)
            .map(|tag| lines.trimmed_range(tag.value_line()))
    }

    /// The lines of an entity that has a record of its own.
    pub(crate) fn record_lines(&self, entity: EntityId) -> Option<Range<usize>> {
        let item = self.table.item_of(entity)?;
        Some(self.table.lines_of(item, Lines::new(&self.text).count()))
    }

    /// The lines of a vertex: from its first tag to that of the next vertex, or to the end of the entity.
    pub(crate) fn vertex_lines(&self, entity: EntityId, index: usize) -> Option<Range<usize>> {
        let vertices = self.table.vertices.get(&entity)?;
        let item = self.record_lines(entity)?;
        let start = item.start + *vertices.lines.get(index)? as usize;
        let end = vertices
            .lines
            .get(index + 1)
            .map_or(item.end, |&line| item.start + line as usize);
        Some(start..end)
    }

    /// The segments with a tag that overlaps a range of bytes; a cursor (an empty range) touches the line it stands in.
    ///
    /// The tags of a vertex belong to the segment that begins in it; the last vertex of an open polyline belongs to the
    /// segment that ends there. The head of a polyline belongs to no segment.
    pub fn segments_at(&self, range: Range<usize>) -> Vec<(EntityId, usize)> {
        let lines = Lines::new(&self.text);
        let first = self.text.line_of(range.start);
        // A range that ends at the beginning of a line does not touch it.
        let last = self.text.line_of(if range.end > range.start {
            range.end - 1
        } else {
            range.end
        });
        let mut found = Vec::new();
        let Some(mut item) = self.table.item_at(first) else {
            return found;
        };
        while let Some(of_this) = self.table.items.get(item) {
            let of_item = self.table.lines_of(item, lines.count());
            if of_item.start > last {
                break;
            }
            for entity in of_this.entities() {
                self.segments_of(entity, of_item.start, first, last, &mut found);
            }
            item += 1;
        }
        found
    }

    /// The entity with geometry whose record holds a byte; the first where a block's reference gives several.
    pub(crate) fn entity_at(&self, offset: usize) -> Option<EntityId> {
        let item = self
            .table
            .items
            .get(self.table.item_at(self.text.line_of(offset))?)?;
        item.entities()
            .find(|&entity| self.drawing.get(entity).is_some())
    }

    fn segments_of(
        &self,
        entity: EntityId,
        start: usize,
        first: usize,
        last: usize,
        found: &mut Vec<(EntityId, usize)>,
    ) {
        let count = self
            .drawing
            .get(entity)
            .map_or(0, |entity| entity.geometry.segment_count());
        let Some(vertices) = self.table.vertices.get(&entity) else {
            found.extend((0..count).map(|segment| (entity, segment)));
            return;
        };
        let begins_by = |line: usize| {
            vertices
                .lines
                .partition_point(|&vertex| start + vertex as usize <= line)
        };
        let (from, to) = (begins_by(first).saturating_sub(1), begins_by(last));
        let mut segments: Vec<usize> = (from..to)
            .map(|vertex| vertex.min(count.saturating_sub(1)))
            .collect();
        segments.dedup();
        found.extend(
            segments
                .into_iter()
                .filter(|&segment| segment < count)
                .map(|segment| (entity, segment)),
        );
    }
}

/// The own tags of a vertex, whether it is a record of its own or a part of a LWPOLYLINE.
pub(crate) fn vertex_tags<'a>(
    lines: Lines<'a>,
    range: Range<usize>,
) -> impl Iterator<Item = Tag> + 'a {
    let record = number::code(lines.content(range.start)) == Code::Known(0);
    // own_tags passes over the record's name.
    let start = if record {
        range.start
    } else {
        range.start.wrapping_sub(2)
    };
    own_tags(lines, start..range.end)
}
