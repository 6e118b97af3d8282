//! Lines to tags, as the editor features see them: every token in its line, every part of the tree within the one that holds it.

use wedm::dxf::Document;
use wedm::ide::Symbol;
use wedm::ide::dxf::{folds, outline, tokens, tokens_in};
use wedm::text::SourceText;

pub fn run(data: &[u8]) {
    let text = SourceText::new(data.to_vec());
    let mut found = Vec::new();
    tokens(&text, usize::MAX, &|| false, |token| found.push(token)).expect("nobody stops it");
    for token in &found {
        let line = text.line_range(token.line);
        assert!(
            token.start + token.length <= line.len(),
            "{token:?} in a line of {} bytes",
            line.len()
        );
    }
    assert!(
        found.windows(2).all(|pair| pair[0].line < pair[1].line),
        "tokens out of order: {found:?}"
    );
    let document = Document::read(data.to_vec());
    let lines = 0..text.line_count() / 2;
    let of_lines: Vec<_> = found
        .iter()
        .copied()
        .filter(|token| lines.contains(&token.line))
        .collect();
    assert_eq!(
        tokens_in(&document, lines),
        of_lines,
        "the tokens of some lines are not those of the whole text"
    );

    let tree = outline(&text, &|| false).expect("nobody stops it");
    check(&tree, 0..text.len());
    for fold in folds(&tree, usize::MAX) {
        assert!(
            fold.first < fold.last && fold.last < text.line_count(),
            "{fold:?}"
        );
    }
}

/// Siblings follow each other within what holds them.
fn check(nodes: &[Symbol], within: std::ops::Range<usize>) {
    let mut from = within.start;
    for node in nodes {
        assert!(
            from <= node.range.start && node.range.end <= within.end,
            "{:?} within {within:?}, from {from} on",
            node.range
        );
        assert!(
            node.range.start <= node.selection.start && node.selection.end <= node.range.end,
            "{node:?}"
        );
        check(&node.children, node.range.clone());
        from = node.range.end;
    }
}
