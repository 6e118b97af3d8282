//! Folding: sections, tables, blocks, entities, polylines with their vertices.

use crate::ide::{Fold, FoldKind, Symbol, SymbolKind};

/// The folds of a tree, in the order of the text. Where there are more than `limit`, only the outermost.
pub fn folds(tree: &[Symbol], limit: usize) -> Vec<Fold> {
    let mut found = Vec::new();
    collect(tree, 0, &mut found);
    if found.len() > limit {
        found.sort_by_key(|(depth, _)| *depth);
        found.truncate(limit);
        found.sort_by_key(|(_, fold)| fold.first);
    }
    found.into_iter().map(|(_, fold)| fold).collect()
}

fn collect(nodes: &[Symbol], depth: usize, found: &mut Vec<(usize, Fold)>) {
    for node in nodes {
        // The name of the record stays visible, not its group code 0.
        let (first, last) = (node.lines.start + 1, node.lines.end.saturating_sub(1));
        if last > first {
            let of_entity = if node.kind == SymbolKind::Entity {
                node.detail.as_str()
            } else {
                ""
            };
            let parts = [&*node.record, &*node.name, of_entity];
            let text = parts
                .into_iter()
                .filter(|part| !part.is_empty())
                .collect::<Vec<_>>()
                .join(" ");
            found.push((
                depth,
                Fold {
                    first,
                    last,
                    kind: FoldKind::Record(format!("{text} …")),
                },
            ));
        }
        collect(&node.children, depth + 1, found);
    }
}
