//! `wedm explain`: the page of a rule, or the list of all rules.

use super::{Failure, Verdict, output};
use crate::message::columns;
use crate::rule::{Line, Rule};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::fmt::Write;

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm explain
  wedm explain small-radius")]
pub(crate) struct Arguments {
    #[arg(value_name = "RULE", value_parser = rule_name(), hide_possible_values = true)]
    rule: Option<Rule>,
}

/// Columns of a line of text.
const WIDTH: usize = 80;

/// The lines of a page, of which those of a paragraph are one.
fn paragraphs(lines: impl IntoIterator<Item = (Line, String)>) -> Vec<(Line, String)> {
    let mut joined: Vec<(Line, String)> = Vec::new();
    for (kind, line) in lines {
        let begins = line.trim().is_empty() || line.trim_start().starts_with(['-', '|']);
        match joined.last_mut() {
            Some((Line::Text, before))
                if kind == Line::Text
                    && !begins
                    && !before.trim().is_empty()
                    && !before.starts_with('|') =>
            {
                // Chinese goes on without a blank.
                let is_ascii = before.ends_with(|last: char| last.is_ascii());
                before.push_str(if is_ascii { " " } else { "" });
                before.push_str(line.trim_start());
            }
            _ => joined.push((kind, line)),
        }
    }
    joined
}

/// A text in lines of at most so many columns where its words allow it; what belongs to an item of a list is indented.
/// Chinese has no blanks: it may go on after any of its characters.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let indent = text.len() - text.trim_start().len();
    let indent = indent
        + if text.trim_start().starts_with("- ") {
            2
        } else {
            0
        };
    let mut lines = vec![String::new()];
    for piece in pieces(text) {
        let line = lines.last_mut().map_or("", |line| line.as_str());
        let is_begun = !line.trim().is_empty();
        if is_begun && columns(line) + columns(piece.trim_end()) > width {
            lines.push(" ".repeat(indent) + piece);
        } else if let Some(line) = lines.last_mut() {
            line.push_str(piece);
        }
    }
    lines
        .iter()
        .map(|line| line.trim_end().to_owned())
        .collect()
}

/// Words with the blanks behind them, and single characters that take two columns.
fn pieces(text: &str) -> Vec<&str> {
    let (mut pieces, mut begin) = (Vec::new(), 0);
    let mut characters = text.char_indices().peekable();
    while let Some((at, character)) = characters.next() {
        let end = at + character.len_utf8();
        let next = characters.peek().map(|(_, next)| *next);
        let is_wide = |it: char| columns(it.encode_utf8(&mut [0; 4])) > 1;
        let is_closing = next.is_some_and(|next| "，。；：、）”".contains(next));
        let ends_word = character == ' ' && next.is_some_and(|next| next != ' ');
        if ends_word || (is_wide(character) && !is_closing) {
            pieces.extend(text.get(begin..end));
            begin = end;
        }
    }
    pieces.extend(text.get(begin..));
    pieces
}

/// The name of a rule, corrected if it is nearly one.
pub(crate) fn rule_name() -> impl TypedValueParser<Value = Rule> {
    PossibleValuesParser::new(Rule::ALL.map(Rule::name))
        .try_map(|name| Rule::named(&name).ok_or(""))
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let mut text = String::new();
    match arguments.rule {
        None => {
            for rule in Rule::ALL {
                let severity = format!("{:?}", rule.default_severity()).to_lowercase();
                let name = output::styled(output::STRONG, format!("{:<20}", rule.name()));
                let _ = writeln!(text, "{name} {severity:<11} {}", rule.summary());
            }
        }
        Some(rule) => {
            for (kind, line) in paragraphs(rule.lines()) {
                let _ = match kind {
                    Line::Heading => writeln!(text, "{}", output::styled(output::STRONG, line)),
                    Line::Text => {
                        let lines = wrapped(&line, WIDTH);
                        lines.iter().try_for_each(|line| writeln!(text, "{line}"))
                    }
                    Line::Code => writeln!(text, "    {}", output::styled(output::NOTE, line)),
                };
            }
        }
    }
    output::print(text)?;
    Ok(Verdict::Clean)
}
