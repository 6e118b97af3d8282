//! What edits have changed since the findings were last shown: entities, and where lines went. Knows nothing of findings.

use crate::drawing::{EntityId, Touched};
use crate::dxf;
use crate::text::SourceText;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// More edits than this are not followed one by one.
const MOST_EDITS: usize = 64;

/// The changes of a document since somebody last took them.
#[derive(Clone, Debug)]
pub(crate) struct Since {
    is_all: bool,
    /// Entities that have changed, or whose text has been read again.
    entities: FxHashSet<EntityId>,
    /// For a polyline in which only some vertices have changed, the segments from the first to the
    /// last that touches one of these.
    segments: FxHashMap<EntityId, Range<usize>>,
    /// In their order.
    edits: Vec<EditedLines>,
    /// Of a program: lines before this one are as they were, and the machine stands there where it stood.
    as_before: usize,
}

/// The lines that an edit touched, by their numbers before it, and by how much it moved those after.
#[derive(Clone, Debug)]
pub(crate) struct EditedLines {
    touched: Range<usize>,
    by: isize,
}

impl Default for Since {
    /// Everything.
    fn default() -> Since {
        Since {
            is_all: true,
            entities: FxHashSet::default(),
            segments: FxHashMap::default(),
            edits: Vec::new(),
            as_before: 0,
        }
    }
}

impl EditedLines {
    /// The lines of an edit that is about to be made; how far later lines move is not known yet.
    pub(super) fn before(text: &SourceText, range: &Range<usize>) -> EditedLines {
        // The end of the line before may change.
        let first = text.line_of(range.start).saturating_sub(1);
        EditedLines {
            touched: first..text.line_of(range.end) + 1,
            by: -(text.line_count() as isize),
        }
    }
}

impl Since {
    /// Hands the changes on; none are left.
    pub(super) fn take(&mut self) -> Since {
        let none = Since {
            is_all: false,
            as_before: usize::MAX,
            ..Since::default()
        };
        std::mem::replace(self, none)
    }

    /// Adds an edit of a text, which has been made.
    pub(super) fn add_edit(
        &mut self,
        mut lines: EditedLines,
        document: &dxf::Document,
        touched: &[Touched],
    ) {
        lines.by += document.text().line_count() as isize;
        self.as_before = 0;
        self.edits.push(lines);
        self.entities.extend(document.read_last());
        self.add_touched(touched);
        if self.is_all || self.edits.len() > MOST_EDITS {
            *self = Since::default();
        }
    }

    /// Adds an edit of a program that left the lines before this one as they were, and the machine where it stood.
    pub(super) fn add_program_edit(&mut self, line: usize) {
        self.as_before = self.as_before.min(line);
    }

    /// Whether what stands up to a line of a program is as it was, and so is where the machine stands.
    pub(crate) fn is_as_before(&self, line: usize) -> bool {
        line < self.as_before
    }

    /// Adds what an edit touched in a drawing.
    pub(super) fn add_touched(&mut self, touched: &[Touched]) {
        for touched in touched {
            match *touched {
                // No segment has got another index, and the last one does not end in the first
                // vertex.
                Touched::Vertices {
                    entity,
                    start: start @ 1..,
                    removed,
                    inserted,
                } if removed == inserted => {
                    let (first, end) = (start - 1, start + inserted);
                    let known = self.segments.entry(entity).or_insert(first..end);
                    *known = known.start.min(first)..known.end.max(end);
                }
                _ => match touched.entity() {
                    Some(entity) => _ = self.entities.insert(entity),
                    None => *self = Since::default(),
                },
            }
        }
    }

    /// True where an entity, or the named segment of it, may have changed, or may stand elsewhere in the text than the moved lines tell.
    pub(crate) fn has_changed(&self, entity: EntityId, segment: Option<usize>) -> bool {
        let is_within =
            |segments: &Range<usize>| segment.is_some_and(|segment| segments.contains(&segment));
        self.is_all
            || self.entities.contains(&entity)
            || self.segments.get(&entity).is_some_and(is_within)
    }

    /// Where a line is now; `None` where an edit has touched it.
    pub(crate) fn line(&self, line: usize) -> Option<usize> {
        let moved = |line: usize, edit: &EditedLines| match line {
            line if line < edit.touched.start => Some(line),
            line if line >= edit.touched.end => line.checked_add_signed(edit.by),
            _ => None,
        };
        self.edits
            .iter()
            .try_fold(line, moved)
            .filter(|_| !self.is_all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_go_where_edits_move_them() {
        let mut since = Since::default();
        assert_eq!(since.line(3), None);
        since.take();
        let edit = |touched: Range<usize>, by| EditedLines { touched, by };
        since.edits = vec![edit(4..6, 2), edit(9..11, -1)];
        for (before, now) in [
            (3, Some(3)),
            (4, None),
            (5, None),
            (6, Some(8)),
            (7, None),
            (8, None),
            (9, Some(10)),
        ] {
            assert_eq!(since.line(before), now, "line {before}");
        }
        since.add_touched(&[Touched::All]);
        assert_eq!(since.line(3), None);
    }

    #[test]
    fn of_a_polyline_only_what_its_vertices_bound_has_changed() {
        let vertices = |start, removed, inserted| Touched::Vertices {
            entity: EntityId(7),
            start,
            removed,
            inserted,
        };
        let changed = |touched: &[Touched]| -> Vec<usize> {
            let mut since = Since::default();
            since.take();
            since.add_touched(touched);
            assert!(!since.has_changed(EntityId(8), Some(4)));
            let has_changed = |segment: &usize| since.has_changed(EntityId(7), Some(*segment));
            (0..9).filter(has_changed).collect()
        };
        assert_eq!(changed(&[vertices(4, 1, 1)]), [3, 4]);
        assert_eq!(
            changed(&[vertices(4, 1, 1), vertices(6, 2, 2)]),
            [3, 4, 5, 6, 7]
        );
        let all: Vec<usize> = (0..9).collect();
        assert_eq!(changed(&[vertices(4, 1, 2)]), all);
        assert_eq!(changed(&[vertices(0, 1, 1)]), all);
        let entity = Touched::Entity {
            entity: EntityId(7),
        };
        assert_eq!(changed(&[vertices(4, 1, 1), entity]), all);
    }
}
