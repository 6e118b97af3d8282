//! The client's own copy of the DXF text: the place of a vertex in it, and changes to it.

use super::super::Failure;
use crate::drawing::{Change, DrawingEdit, Geometry, Vertex};
use crate::dxf;
use crate::geometry::Point;
use serde_json::{Value, json};
use std::ops::Range;

pub(crate) struct Copy {
    pub(crate) uri: String,
    pub(crate) text: String,
    pub(crate) version: i64,
}

impl Copy {
    pub(crate) fn new(uri: &str, text: &str) -> Copy {
        Copy {
            uri: uri.into(),
            text: text.into(),
            version: 1,
        }
    }

    /// Moves vertices of the polyline `handle` as a designer does; returns the params of `textDocument/didChange`.
    pub(crate) fn move_vertices(
        &mut self,
        handle: &str,
        moves: &[(usize, f64, f64)],
    ) -> Result<Value, Failure> {
        let drawn = dxf::Document::read(self.text.clone().into_bytes());
        let lacks = |index: usize| Failure(say!(the_plate_has_no_vertex, index, handle));
        let entity = drawn.drawing().find(handle).ok_or_else(|| lacks(0))?;
        let mut changes = Vec::new();
        for &(index, x, y) in moves {
            let known = match drawn.drawing().get(entity).map(|entity| &entity.geometry) {
                Some(Geometry::Polyline { vertices, .. }) => vertices.get(index),
                _ => None,
            };
            let vertex = Vertex {
                point: Point::new(x, y),
                ..*known.ok_or_else(|| lacks(index))?
            };
            changes.push(Change::SetVertex {
                entity,
                index,
                vertex,
            });
        }
        let edits = drawn
            .text_edits(&DrawingEdit { changes })
            .map_err(Failure)?;
        // From the last to the first, so that the places of the others stay right.
        let edits = edits.into_iter().rev();
        let changes = edits.map(|edit| self.replace(edit.range, &edit.text));
        let changes = changes.collect::<Result<_, _>>()?;
        Ok(self.changed(changes))
    }

    /// Applies the edits of a `WorkspaceEdit` for this text, refusing those for another version; returns the params of
    /// `textDocument/didChange`.
    pub(crate) fn apply(&mut self, workspace_edit: &Value) -> Result<Value, Failure> {
        let documents = workspace_edit["documentChanges"]
            .as_array()
            .map_or(&[][..], Vec::as_slice);
        let [document] = documents else {
            return Err(Failure(say!(
                the_fix_edits_several_documents,
                documents.len()
            )));
        };
        let versioned = &document["textDocument"];
        if versioned["uri"] != self.uri.as_str() || versioned["version"] != self.version {
            return Err(Failure(say!(
                the_fix_is_for_expected_version,
                versioned,
                self.version,
                self.uri
            )));
        }
        let edits = document["edits"].as_array().map_or(&[][..], Vec::as_slice);
        let mut placed = Vec::new();
        for edit in edits {
            let (start, end) = (
                self.offset(&edit["range"]["start"]),
                self.offset(&edit["range"]["end"]),
            );
            let (Some(start), Some(end), Some(text)) = (start, end, edit["newText"].as_str())
            else {
                return Err(Failure(say!(the_edit_does_not_fit_the_text, edit)));
            };
            placed.push((start..end, text));
        }
        // From the last to the first, so that the places of the others stay right.
        placed.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
        let changes = placed
            .into_iter()
            .map(|(range, text)| self.replace(range, text))
            .collect::<Result<_, _>>()?;
        Ok(self.changed(changes))
    }

    fn changed(&mut self, changes: Vec<Value>) -> Value {
        self.version += 1;
        json!({ "textDocument": { "uri": self.uri, "version": self.version }, "contentChanges": changes })
    }

    fn replace(&mut self, range: Range<usize>, text: &str) -> Result<Value, Failure> {
        if self.text.get(range.clone()).is_none() {
            return Err(Failure(say!(
                the_range_does_not_fit_the_text,
                format_args!("{}..{}", range.start, range.end)
            )));
        }
        let change = json!({ "range": { "start": self.position(range.start), "end": self.position(range.end) }, "text": text });
        self.text.replace_range(range, text);
        Ok(change)
    }

    /// The plate is ASCII: a byte is a character in every encoding.
    fn position(&self, offset: usize) -> Value {
        let before = self.text.get(..offset).unwrap_or_default();
        let line_start = before.rfind('\n').map_or(0, |end| end + 1);
        json!({ "line": before.matches('\n').count(), "character": offset - line_start })
    }

    fn offset(&self, position: &Value) -> Option<usize> {
        let (line, character) = (
            position["line"].as_u64()? as usize,
            position["character"].as_u64()? as usize,
        );
        let start: usize = self
            .text
            .split_inclusive('\n')
            .take(line)
            .map(str::len)
            .sum();
        Some(start + character).filter(|&offset| offset <= self.text.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "  0\nSECTION\n  2\nENTITIES\n  0\nLWPOLYLINE\n  5\n2A\n 10\n1.5\n 20\n2.0\n 10\n3.0\n 20\n4.0\n  0\nENDSEC\n  0\nEOF\n";

    #[test]
    fn a_moved_vertex_changes_its_numbers_only() {
        let mut copy = Copy::new("untitled:x", TEXT);
        let params = copy.move_vertices("2A", &[(1, 3.25, 4.0)]).unwrap();
        assert_eq!(copy.text, TEXT.replace("3.0", "3.25"));
        let range = json!({ "start": { "line": 13, "character": 0 }, "end": { "line": 13, "character": 3 } });
        assert_eq!(
            params["contentChanges"],
            json!([{ "range": range, "text": "3.25" }])
        );
        assert!(copy.move_vertices("2A", &[(2, 0.0, 0.0)]).is_err());
    }

    #[test]
    fn an_edit_for_another_version_is_refused() {
        let mut copy = Copy::new("untitled:x", TEXT);
        let edit = json!({ "documentChanges": [{ "textDocument": { "uri": "untitled:x", "version": 7 }, "edits": [] }] });
        assert!(copy.apply(&edit).is_err());
    }
}
