//! Adds lines to the text of a `wedm.toml`, or sets its values; everything else in it stays.

use super::spelling::snake_case;
use super::toml_tree::tree;
use super::value::{Node, Value};
use crate::finding::Keep;
use crate::text::TextEdit;

/// The lines for a table that is empty so far.
pub(crate) fn as_lines(keeps: &[Keep]) -> String {
    let mut lines = String::new();
    let mut table = None;
    for keep in keeps {
        if table != Some(&keep.table) {
            lines += &format!("[{}]\n", keep.table);
            table = Some(&keep.table);
        }
        lines += &line(keep);
    }
    lines
}

/// The edit of `text` that adds the settings: below the head of its table if there is one, else at the end. `None`
/// where the text cannot take it, for example because the table is written in another way.
pub(crate) fn keep(text: &str, keeps: &[Keep]) -> Option<TextEdit> {
    let table = &keeps.first()?.table;
    let lines: String = keeps.iter().map(line).collect();
    let edit = insertion(text, table, lines);
    let mut changed = text.to_owned();
    changed.replace_range(edit.range.clone(), &edit.text);
    // A value that the user still has to write is not a fault of the text.
    let is_one_table = keeps.iter().all(|keep| keep.table == *table);
    (is_one_table && is_toml(&changed)).then_some(edit)
}

/// The edit that adds lines below the head of a table if there is one, else at the end.
fn insertion(text: &str, table: &str, lines: String) -> TextEdit {
    let heading = format!("[{table}]");
    let mut at = 0;
    let head = text.split_inclusive('\n').find_map(|row| {
        at += row.len();
        let own = row.split('#').next().unwrap_or(row).trim();
        (own == heading).then_some((at, row.ends_with('\n')))
    });
    match head {
        Some((behind, true)) => TextEdit::new(behind..behind, lines),
        Some((behind, false)) => TextEdit::new(behind..behind, format!("\n{lines}")),
        None => {
            let apart = match text {
                "" => "",
                text if text.ends_with('\n') => "\n",
                _ => "\n\n",
            };
            TextEdit::new(text.len()..text.len(), format!("{apart}{heading}\n{lines}"))
        }
    }
}

fn is_toml(text: &str) -> bool {
    toml::from_str::<toml::Table>(text).is_ok()
}

/// `text` with values set, each by its dotted key, below a comment that begins with `mark`; an earlier one with that mark
/// goes. `None` where the text cannot take it.
pub(crate) fn set(
    text: &str,
    values: &[(&str, String)],
    mark: &str,
    comment: &str,
) -> Option<String> {
    let comment = format!("# {mark} {comment}\n");
    let mut text = text.to_owned();
    for (dotted, value) in values {
        let (table, name) = dotted.rsplit_once('.').unwrap_or(("", dotted));
        let root = tree(&text).0;
        let within = match table {
            "" => Some(&root),
            table => root.entry(&snake_case(table)).map(|entry| &entry.node),
        };
        let entry = within.and_then(|node| node.entry(&snake_case(name)));
        let Some(entry) = entry else {
            let lines = format!("{comment}{name} = {value}\n");
            let edit = match table {
                "" => behind_root(&text, &root, lines),
                table => insertion(&text, table, lines),
            };
            text.replace_range(edit.range, &edit.text);
            continue;
        };
        let (key, old) = (entry.key_range.clone()?, entry.node.range.clone()?);
        text.replace_range(old, value);
        let above = text.get(..key.start)?;
        let line = above.rfind('\n').map_or(0, |at| at + 1);
        let before = above.get(..line)?.trim_end_matches('\n');
        let last = before.rfind('\n').map_or(0, |at| at + 1);
        let is_marked = before.get(last..)?.starts_with(&format!("# {mark} "));
        text.replace_range(if is_marked { last..line } else { line..line }, &comment);
    }
    is_toml(&text).then_some(text)
}

/// The edit that adds lines behind the keys that stand in no table, before the first table.
fn behind_root(text: &str, root: &Node, lines: String) -> TextEdit {
    let ends = match &root.value {
        Value::Table(entries) => entries
            .iter()
            .filter(|entry| !matches!(entry.node.value, Value::Table(_)))
            .filter_map(|entry| Some(entry.node.range.as_ref()?.end))
            .max(),
        _ => None,
    };
    let behind = |end: usize| Some(end + text.get(end..)?.find('\n')? + 1);
    match ends {
        Some(end) => match behind(end) {
            Some(at) => TextEdit::new(at..at, lines),
            None => TextEdit::new(text.len()..text.len(), format!("\n{lines}")),
        },
        // All that stands there are comments and tables.
        None => {
            let mut at = 0;
            let tables = text.split_inclusive('\n').find_map(|row| {
                let here = at;
                at += row.len();
                row.trim_start().starts_with('[').then_some(here)
            });
            let at = tables.unwrap_or(text.len());
            let apart = if at < text.len() { "\n" } else { "" };
            TextEdit::new(at..at, format!("{lines}{apart}"))
        }
    }
}

fn line(keep: &Keep) -> String {
    let value = toml::Value::String(keep.value.clone());
    format!("{} = {value}\n", key(&keep.key))
}

/// A key in TOML: bare where possible.
fn key(name: &str) -> String {
    let is_bare = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_');
    match !name.is_empty() && name.bytes().all(is_bare) {
        true => name.into(),
        false => toml::Value::String(name.into()).to_string(),
    }
}

/// The head of the table that suppresses a finding at an entity of a drawing.
pub(crate) fn table_of_suppressions(drawing: &str, handle: &str) -> String {
    format!("drawings.{}.suppress.{}", key(drawing), key(handle))
}

#[cfg(test)]
mod tests {
    use super::super::from_toml;
    use super::*;

    #[test]
    fn a_line_comes_below_its_head_and_a_table_at_the_end() {
        let keeps = [Keep::new("linetypes", "CENTER", "both")];
        for (text, expected) in [
            ("", "[linetypes]\nCENTER = \"both\"\n"),
            (
                "margin = 0.1",
                "margin = 0.1\n\n[linetypes]\nCENTER = \"both\"\n",
            ),
            (
                "[linetypes] # ours\nHIDDEN = \"punch\"\n\n[layers]\n",
                "[linetypes] # ours\nCENTER = \"both\"\nHIDDEN = \"punch\"\n\n[layers]\n",
            ),
            ("[linetypes]", "[linetypes]\nCENTER = \"both\"\n"),
        ] {
            let edit = keep(text, &keeps).expect(text);
            let mut changed = text.to_owned();
            changed.replace_range(edit.range, &edit.text);
            assert_eq!(changed, expected);
            assert_eq!(from_toml(&changed).1, [], "{changed}");
        }
        assert_eq!(keep("linetypes = { HIDDEN = \"punch\" }\n", &keeps), None);
        let odd = [Keep::new("layers", "a \"b\" ü", "ignore")];
        assert_eq!(as_lines(&odd), "[layers]\n'a \"b\" ü' = \"ignore\"\n");
    }

    #[test]
    fn a_value_is_set_where_it_stands_and_an_old_mark_goes() {
        let values = [
            ("gap", "0.02".to_owned()),
            ("passes.gaps", "[0.03, 0.01]".to_owned()),
        ];
        for (before, after) in [
            (
                "",
                "# m now\ngap = 0.02\n\n[passes]\n# m now\ngaps = [0.03, 0.01]\n",
            ),
            (
                "side = \"auto\" # ours\n\n[passes]\ncorrections = [0.2, 0.1]\n",
                "side = \"auto\" # ours\n# m now\ngap = 0.02\n\n[passes]\n# m now\ngaps = [0.03, 0.01]\ncorrections = [0.2, 0.1]\n",
            ),
            (
                "# Gap.\n# m then\ngap = 0.01 # as bought\npasses.gaps = [\n  0.1,\n  0.1,\n]\n",
                "# Gap.\n# m now\ngap = 0.02 # as bought\n# m now\npasses.gaps = [0.03, 0.01]\n",
            ),
            (
                "# Ours.\n[passes]\ngaps = [1]",
                "# Ours.\n# m now\ngap = 0.02\n\n[passes]\n# m now\ngaps = [0.03, 0.01]",
            ),
        ] {
            assert_eq!(set(before, &values, "m", "now").as_deref(), Some(after));
        }
        let inline = "passes = { corrections = [0.2, 0.1] }\n";
        assert_eq!(
            set(inline, &values, "m", "now"),
            None,
            "its table is closed"
        );
    }
}
