//! Adds lines to the text of a `wedm.toml`; everything else in it stays.

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
    let heading = format!("[{table}]");
    let mut at = 0;
    let head = text.split_inclusive('\n').find_map(|row| {
        at += row.len();
        let own = row.split('#').next().unwrap_or(row).trim();
        (own == heading).then_some((at, row.ends_with('\n')))
    });
    let edit = match head {
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
    };
    let mut changed = text.to_owned();
    changed.replace_range(edit.range.clone(), &edit.text);
    // A value that the user still has to write is not a fault of the text.
    let is_toml = |text: &str| toml::from_str::<toml::Table>(text).is_ok();
    let is_one_table = keeps.iter().all(|keep| keep.table == *table);
    (is_one_table && is_toml(&changed)).then_some(edit)
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
}
