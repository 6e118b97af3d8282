//! The output of the demonstration: numbered steps, in 80 columns, coloured on a terminal.

use super::super::output::{self, styled};
use crate::message::columns;
use anstyle::Style;
use serde_json::Value;
use std::time::Duration;

const COLUMNS: usize = 80;
const INDENT: usize = 4;

/// What a drawing is made of: if it is a text, its diagnostics have lines.
pub(crate) enum Behind {
    Text,
    Nothing,
}

#[derive(Default)]
pub(crate) struct Narrator {
    steps: usize,
}

impl Narrator {
    pub(crate) fn heading(&mut self, text: &str) {
        self.print(output::STRONG, 0, "", text);
    }

    pub(crate) fn step(&mut self, text: &str) {
        self.steps += 1;
        let number = format!("{:>2}  ", self.steps);
        let _ = output::print("\n");
        self.print(output::STRONG, INDENT, &number, text);
    }

    pub(crate) fn say(&mut self, text: &str) {
        self.print(Style::new(), INDENT, "    ", text);
    }

    pub(crate) fn item(&mut self, text: &str) {
        self.print(Style::new(), INDENT + 2, "    - ", text);
    }

    pub(crate) fn good(&mut self, text: &str) {
        self.print(output::GOOD, INDENT, "    ", text);
    }

    /// A diagnostic as it arrived: its place, then its sentence.
    pub(crate) fn diagnostic(&mut self, diagnostic: &Value, behind: Behind) {
        let (handle, segment) = super::segment_of(diagnostic);
        let line = match behind {
            Behind::Text => {
                let line = diagnostic["range"]["start"]["line"].as_u64();
                say!(line_number, line.unwrap_or_default() + 1) + say!(comma)
            }
            Behind::Nothing => String::new(),
        };
        let at = &diagnostic["data"]["start"];
        let place = say!(
            rule_and_place_of_a_segment,
            diagnostic["code"].as_str().unwrap_or_default(),
            line,
            handle,
            segment,
            at[0].as_f64().unwrap_or(f64::NAN),
            at[1].as_f64().unwrap_or(f64::NAN)
        );
        self.print(output::ERROR, INDENT + 2, "    ! ", &place);
        self.print(
            Style::new(),
            INDENT + 2,
            "      ",
            diagnostic["message"].as_str().unwrap_or_default(),
        );
    }

    /// Text in lines of at most 80 columns, the first after `lead`, the others indented. Words are not broken; Chinese
    /// is, between any two of its letters.
    fn print(&mut self, style: Style, indent: usize, lead: &str, text: &str) {
        for (index, line) in wrapped(text, COLUMNS - indent).into_iter().enumerate() {
            let margin = if index == 0 {
                lead.to_string()
            } else {
                " ".repeat(indent)
            };
            // A reader that has gone away has seen enough; the files are still written.
            let _ = output::print(format!("{margin}{}\n", styled(style, line)));
        }
    }
}

fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut length = 0;
    for word in text.split(' ') {
        let mut space = " ";
        for piece in pieces(word) {
            if length == 0 {
                space = "";
            } else if length + space.len() + columns(piece) > width {
                lines.push(String::new());
                (length, space) = (0, "");
            }
            let Some(line) = lines.last_mut() else {
                return lines;
            };
            line.push_str(space);
            line.push_str(piece);
            length += space.len() + columns(piece);
            space = "";
        }
    }
    lines
}

/// A word, cut where a line may end: beside each wide letter, but not before a closing mark or after an opening one.
fn pieces(word: &str) -> Vec<&str> {
    let is_wide = |letter: char| columns(letter.encode_utf8(&mut [0; 4])) > 1;
    let (mut found, mut from) = (Vec::new(), 0);
    for ((_, before), (at, letter)) in word.char_indices().zip(word.char_indices().skip(1)) {
        let is_joined = "（“".contains(before) || "，。：；、）”…".contains(letter);
        if (is_wide(before) || is_wide(letter)) && !is_joined {
            found.extend(word.get(from..at));
            from = at;
        }
    }
    found.extend(word.get(from..));
    found
}

/// Milliseconds as a person reads them.
pub(crate) fn duration(duration: Duration) -> String {
    let milliseconds = duration.as_secs_f64() * 1e3;
    if milliseconds < 10.0 {
        format!("{milliseconds:.1} ms")
    } else {
        format!("{milliseconds:.0} ms")
    }
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn lines_break_between_words() {
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
        assert_eq!(
            wrapped("切割路线，长 5 mm（丝）", 8),
            ["切割路", "线，长 5", "mm（丝）"]
        );
        assert_eq!(wrapped("unbreakable", 3), ["unbreakable"]);
        assert_eq!(wrapped("", 3), [""]);
    }
}
