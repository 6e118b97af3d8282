//! Turns the targets of the moves into edits of the text: every line is run again as the control does.

use super::Iso;
use crate::program::iso::block::Block;
use crate::program::iso::line::{Line, Target, prove, push_changed, with_word};
use crate::program::iso::moves::Reading;
use crate::program::iso::style::Style;
use crate::program::refactor::{Content, Edits, Rewrite, Sheet};
use crate::text::{TextEdit, edited};

/// Changes besides the moves.
#[derive(Clone, Debug, Default)]
pub(in crate::program) struct Extra {
    /// Words of the text that are replaced.
    pub(crate) words: Vec<TextEdit>,
    /// The convention for arcs; `None` keeps the present one.
    pub(crate) reading: Option<Reading>,
    /// A word to be put before the first move.
    pub(crate) first_word: Option<&'static str>,
}

/// The edits of the text; none where nothing changes.
pub(super) fn edits(
    sheet: &Sheet<'_, Iso>,
    content: &Content<Iso>,
    rewrite: &Rewrite<Iso>,
) -> Edits {
    let Extra {
        words: all_words,
        reading,
        first_word,
    } = &rewrite.extra;
    let mut all_words = all_words.clone();
    all_words.sort_by_key(|edit| edit.range.start);
    let mut all_words = all_words.as_slice();
    let document = sheet.document;
    let text = document.text();
    let old = document.reading();
    let reading = reading.unwrap_or(*old);
    let parted = sheet.document.is_parted();
    let styles = [false, true].map(|inch| Style::of(document, inch));
    let mut machine = document.first_machine();
    let mut edits = Vec::new();
    let mut rows = content.rows.iter().enumerate().peekable();
    for line in 0..text.line_count() {
        let range = text.line_range(line);
        let own = document.line_bytes(line);
        let count = all_words.partition_point(|edit| edit.range.end <= range.end);
        let (here, rest) = all_words.split_at(count);
        all_words = rest;
        let here = here.iter().map(|edit| TextEdit {
            range: edit.range.start - range.start..edit.range.end - range.start,
            text: edit.text.clone(),
        });
        let here: Vec<TextEdit> = here.collect();
        let mut bytes = edited(own, &here).ok_or(say!(words_lie_on_each_other))?;
        let Some((index, row)) = rows.next_if(|(_, row)| row.line == line) else {
            machine.run(&Block::of(&bytes), &reading);
            push_changed(&mut edits, range, own, &bytes)?;
            continue;
        };
        let target = match rewrite.rows.get(&index).map(Vec::as_slice) {
            None => Target::of(&row.own.made, old),
            Some([target]) => *target,
            Some(_) => {
                // The whole line goes, its line end with it.
                edits.push(TextEdit::new(text.whole_line(line), ""));
                continue;
            }
        };
        if index == 0
            && let Some(word) = first_word
        {
            bytes = with_word(&bytes, word, parted);
        }
        // A line that already does what is meant stays as it is.
        let mut as_it_is = machine;
        let made = as_it_is.run(&Block::of(&bytes), &reading);
        if made.is_some_and(|made| made.from == machine.at && Target::of(&made, &reading) == target)
        {
            machine = as_it_is;
        } else {
            let written = Line {
                bytes: &bytes,
                parted,
                style: styles[usize::from(as_it_is.inch)],
                reading: &reading,
            };
            bytes = written.leading(&target, &machine)?;
            let made = machine.run(&Block::of(&bytes), &reading);
            prove(line, made.as_ref(), &target, &reading)?;
        }
        push_changed(&mut edits, range, own, &bytes)?;
    }
    Ok(edits)
}
