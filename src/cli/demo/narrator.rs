//! What the demonstration says: numbered steps, in 80 columns, coloured on a terminal.

use super::super::output::{self, styled};
use anstyle::Style;
use serde_json::Value;
use std::time::Duration;

const COLUMNS: usize = 80;
const INDENT: usize = 4;

/// What stands behind a drawing: a diagnostic in text has a line.
pub enum Behind {
    Text,
    Nothing,
}

#[derive(Default)]
pub struct Narrator {
    steps: usize,
}

impl Narrator {
    pub fn heading(&mut self, text: &str) {
        self.print(output::STRONG, 0, "", text);
    }

    pub fn step(&mut self, text: &str) {
        self.steps += 1;
        let number = format!("{:>2}  ", self.steps);
        let _ = output::print("\n");
        self.print(output::STRONG, INDENT, &number, text);
    }

    pub fn say(&mut self, text: &str) {
        self.print(Style::new(), INDENT, "    ", text);
    }

    pub fn item(&mut self, text: &str) {
        self.print(Style::new(), INDENT + 2, "    - ", text);
    }

    pub fn good(&mut self, text: &str) {
        self.print(output::GOOD, INDENT, "    ", text);
    }

    /// A diagnostic as it arrived: its place, then its sentence.
    pub fn diagnostic(&mut self, diagnostic: &Value, behind: Behind) {
        let (handle, segment) = super::segment_of(diagnostic);
        let line = match behind {
            Behind::Text => format!(
                "line {}, ",
                diagnostic["range"]["start"]["line"]
                    .as_u64()
                    .unwrap_or_default()
                    + 1
            ),
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

    /// Text in lines of at most 80 columns, the first behind `lead`, the others indented. A word is never broken.
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
        let word_length = word.chars().count();
        if length > 0 && length + 1 + word_length > width {
            lines.push(String::new());
            length = 0;
        }
        let Some(line) = lines.last_mut() else {
            return lines;
        };
        if length > 0 {
            line.push(' ');
            length += 1;
        }
        line.push_str(word);
        length += word_length;
    }
    lines
}

/// Milliseconds as a person reads them.
pub fn duration(duration: Duration) -> String {
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
        assert_eq!(wrapped("unbreakable", 3), ["unbreakable"]);
        assert_eq!(wrapped("", 3), [""]);
    }
}
