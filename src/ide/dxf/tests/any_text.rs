//! Asks every question about damaged texts.

use super::{ALL, MM, all_tokens, lines};
use crate::dxf::Document;
use crate::ide::Symbol;
use crate::ide::dxf::*;
use proptest::prelude::*;

/// Asks every question at every line: no answer lies outside the text, and none panics.
fn ask_everything(text: Vec<u8>) {
    let document = Document::read(text);
    let length = document.text().len();
    let tree = outline(document.text(), &|| false).unwrap_or_default();
    let mut all = Vec::new();
    fn ranges(
        nodes: &[Symbol],
        holder: std::ops::Range<usize>,
        all: &mut Vec<std::ops::Range<usize>>,
    ) {
        for node in nodes {
            assert!(
                node.range.start <= node.selection.start && node.selection.end <= node.range.end,
                "{node:?}"
            );
            assert!(
                holder.start <= node.range.start && node.range.end <= holder.end,
                "{node:?} in {holder:?}"
            );
            all.push(node.range.clone());
            ranges(&node.children, node.range.clone(), all);
        }
    }
    ranges(&tree, 0..length, &mut all);
    let lines = document.text().line_count();
    assert!(
        folds(&tree, 100)
            .iter()
            .all(|fold| fold.first < fold.last && fold.last < lines)
    );
    assert!(
        all_tokens(document.text(), usize::MAX)
            .windows(2)
            .all(|pair| pair[0].line < pair[1].line)
    );
    for line in 0..lines {
        let offset = document.text().line_start(line);
        all.extend(hover(&document, offset, MM).map(|hover| hover.range));
        all.extend(
            completions(&document, offset)
                .into_iter()
                .map(|completion| completion.range),
        );
        let steps = selections(&document, offset);
        assert!(
            steps
                .windows(2)
                .all(|pair| pair[1].start <= pair[0].start && pair[0].end <= pair[1].end),
            "{steps:?}"
        );
        all.extend(steps);
        if let Some((name, range)) = name_at(&document, offset) {
            let found =
                occurrences(document.text(), &name, usize::MAX, &|| false).unwrap_or_default();
            all.extend(found.into_iter().map(|found| found.range));
            all.push(range);
        }
        tokens_in(&document, line..line + 3);
    }
    hints(&document, 0..length, MM);
    assert!(
        all.iter()
            .all(|range| range.start <= range.end && range.end <= length)
    );
}

#[test]
fn everything_can_be_asked_of_any_text() {
    let all = lines(ALL);
    ask_everything(Vec::new());
    ask_everything(b"\xef\xbb\xbf".to_vec());
    ask_everything(all.clone().into_bytes());
    ask_everything(all.replace('\n', "\r\n").into_bytes());
    ask_everything(format!("\u{feff}{all}").into_bytes());
    // One line is missing, and then the end.
    let missing: Vec<&str> = all
        .lines()
        .enumerate()
        .filter(|(line, _)| *line != 25)
        .map(|(_, line)| line)
        .collect();
    ask_everything(missing.join("\n").as_bytes()[..114].to_vec());
    ask_everything(all.replace("DIE", "D\u{fc}").into_bytes());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn everything_can_be_asked_of_damaged_text(gone in prop::collection::vec(0usize..190, 1..6), cut in 0usize..800) {
        let kept: Vec<&str> = ALL.split('|').enumerate().filter(|(line, _)| !gone.contains(line)).map(|(_, line)| line).collect();
        let mut text = kept.join("\n");
        text.truncate(cut.max(1).min(text.len()));
        ask_everything(text.into_bytes());
    }
}
