//! Lines that are put into the text of a `wedm.toml`, everything else in it staying as it is.

use super::from_toml;
use crate::finding::Keep;
use crate::text::TextEdit;

/// The lines of a table that nothing stands in yet.
pub fn as_lines(keeps: &[Keep]) -> String {
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

/// The edit of `text` after which the settings hold what is to be kept: below the head of its table where that stands, else at the end.
/// `None` where the text cannot take it, as where the table is written in another way.
pub fn keep(text: &str, keeps: &[Keep]) -> Option<TextEdit> {
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
    let errors = |text: &str| from_toml(text).1.len();
    (keeps.iter().all(|keep| keep.table == *table) && errors(&changed) <= errors(text))
        .then_some(edit)
}

fn line(keep: &Keep) -> String {
    let is_bare = !keep.key.is_empty()
        && keep
            .key
            .bytes()
            .all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_'));
    let quoted = |text: &str| toml::Value::String(text.into()).to_string();
    let key = if is_bare {
        keep.key.clone()
    } else {
        quoted(&keep.key)
    };
    format!("{key} = {}\n", quoted(&keep.value))
}

#[cfg(test)]
mod tests {
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
