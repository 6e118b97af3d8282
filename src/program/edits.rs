//! Edits of a program's text in the form that suits an editor. Their meaning is not known here.

use crate::text::{SourceText, TextEdit};
use rayon::prelude::*;
use std::ops::Range;

/// This many edits of one text are many.
const MANY: usize = 2_000;

/// Many edits are merged across gaps of up to this many bytes.
const LITTLE: usize = 64;

/// Sorted and disjoint edits. Where nearly all of a long text changes, edits with small gaps become one: tens of
/// thousands of edits cost an editor more than the text between them.
fn joined(edits: Vec<TextEdit>, text: &SourceText) -> Vec<TextEdit> {
    if edits.len() <= MANY {
        return edits;
    }
    let mut joined: Vec<TextEdit> = Vec::new();
    for edit in edits {
        let between = |last: &TextEdit| {
            std::str::from_utf8(text.bytes().get(last.range.end..edit.range.start)?).ok()
        };
        match joined.last_mut() {
            Some(last)
                if edit.range.start - last.range.end <= LITTLE && between(last).is_some() =>
            {
                let between = between(last).unwrap_or_default();
                last.text.reserve(between.len() + edit.text.len());
                last.text.push_str(between);
                last.text.push_str(&edit.text);
                last.range.end = edit.range.end;
            }
            _ => joined.push(edit),
        }
    }
    joined
}

/// Lines that are written together.
pub(in crate::program) const AT_ONCE: usize = 2048;

/// Edits of lines in the making, each with the lines that it replaces completely: those of consecutive lines become
/// one. An edit of a part of a line has none.
#[derive(Default)]
pub(in crate::program) struct LineEdits(Vec<(Range<usize>, TextEdit)>);

impl LineEdits {
    pub(crate) fn push(&mut self, text: &SourceText, lines: Range<usize>, edit: TextEdit) {
        let goes_on = |before: &Range<usize>| {
            !before.is_empty() && !lines.is_empty() && before.end == lines.start
        };
        match self.0.last_mut().filter(|(before, _)| goes_on(before)) {
            Some((before, last)) => {
                let between = text.bytes().get(last.range.end..edit.range.start);
                let between = between.and_then(|bytes| std::str::from_utf8(bytes).ok());
                last.text.push_str(between.unwrap_or("\n"));
                last.text.push_str(&edit.text);
                (last.range.end, before.end) = (edit.range.end, lines.end);
            }
            None if edit.range.is_empty() && edit.text.is_empty() => {}
            None => self.0.push((lines, edit)),
        }
    }
}

/// The edits of the pieces of a text, in their order.
pub(in crate::program) fn formed<P: Sync>(
    text: &SourceText,
    pieces: &[P],
    form: impl Fn(&P) -> LineEdits + Send + Sync,
) -> Vec<TextEdit> {
    let formed: Vec<LineEdits> = if pieces.len() > 2 {
        pieces.par_iter().map(form).collect()
    } else {
        pieces.iter().map(form).collect()
    };
    let mut edits = LineEdits::default();
    for (lines, edit) in formed.into_iter().flat_map(|piece| piece.0) {
        edits.push(text, lines, edit);
    }
    joined(edits.0.into_iter().map(|(_, edit)| edit).collect(), text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(count: usize, apart: usize, expected: usize) {
        let line = format!("x{}\n", ".".repeat(apart));
        let text = SourceText::new(line.repeat(count).into_bytes());
        let edit = |nth: usize| TextEdit {
            range: nth * line.len()..nth * line.len() + 1,
            text: "yy".into(),
        };
        let edits = joined((0..count).map(edit).collect(), &text);
        assert_eq!(edits.len(), expected, "{count} edits, {apart} bytes apart");
        let mut result = text.as_str_lossy().into_owned();
        edits
            .iter()
            .rev()
            .for_each(|edit| result.replace_range(edit.range.clone(), &edit.text));
        assert_eq!(result, line.replace('x', "yy").repeat(count));
    }

    #[test]
    fn many_edits_with_little_between_become_one() {
        check(MANY, 10, MANY);
        check(MANY + 1, 10, 1);
        check(MANY + 1, LITTLE, MANY + 1);
    }
}
