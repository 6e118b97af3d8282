//! The tree for an editor's list: with contours, and with runs instead of very many entities.

use crate::document::Snapshot;
use crate::drawing::{Handle, Outline, Piece};
use crate::ide::amounts::closing;
use crate::ide::{Symbol, SymbolKind};
use std::collections::HashMap;

/// With more entities than this in one text, or more contours, runs of them are listed instead.
pub(crate) const GROUPED_ABOVE: usize = 20_000;
/// Runs that stand for many.
const RUNS: usize = 1000;
/// The most entities of a contour that are listed under it.
const LISTED_OF_CONTOUR: usize = 200;

/// A contour of the drawing, as the tree names it: its entities' handles in order of travel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ContourNote {
    pub(crate) closed: bool,
    pub(crate) segments: usize,
    pub(crate) handles: Vec<Handle>,
}

/// The contours of a drawing.
pub(crate) fn notes(snapshot: &Snapshot) -> Vec<ContourNote> {
    let handle = |piece: &Piece| Some(snapshot.drawing.get(piece.entity)?.handle.clone());
    let note = |outline: &Outline| ContourNote {
        closed: outline.contour.closed,
        segments: outline.contour.len(),
        handles: outline.contour.pieces.iter().filter_map(handle).collect(),
    };
    snapshot.outlines.iter().map(note).collect()
}

/// Adds the contours to a tree and shortens it where the list would be too long.
pub(crate) fn symbols(mut tree: Vec<Symbol>, contours: &[ContourNote]) -> Vec<Symbol> {
    let listed = contours_of(&tree, contours);
    shorten(&mut tree);
    if let Some(first) = listed.first()
        && let Some(section) = tree
            .iter_mut()
            .find(|node| node.kind == SymbolKind::Section && &*node.name == "ENTITIES")
    {
        // A symbol must lie within its parent: the contours go into their section.
        let mut node = Symbol {
            kind: SymbolKind::Contours,
            record: "".into(),
            name: say!(contours_as_a_title).into(),
            detail: say!(so_many_of_them, contours.len()),
            range: section.range.clone(),
            selection: first.selection.clone(),
            lines: section.lines.clone(),
            children: listed,
        };
        shorten_children(&mut node.children);
        section.children.insert(0, node);
    }
    tree
}

fn shorten(tree: &mut [Symbol]) {
    let count: usize = tree.iter().map(count).sum();
    if count > GROUPED_ABOVE {
        for node in tree {
            shorten_children(&mut node.children);
        }
    }
}

fn count(node: &Symbol) -> usize {
    node.children.iter().map(|child| 1 + count(child)).sum()
}

/// Puts runs in place of more children than can be listed.
fn shorten_children(children: &mut Vec<Symbol>) {
    if children.len() <= RUNS {
        return;
    }
    let all = children.len();
    let size = all.div_ceil(RUNS);
    let run = |(index, nodes): (usize, &[Symbol])| {
        let (first, last) = (nodes.first()?, nodes.last()?);
        let mut kinds: Vec<&str> = nodes
            .iter()
            .map(|node| {
                if node.record.is_empty() {
                    say!(a_contour)
                } else {
                    &*node.record
                }
            })
            .collect();
        kinds.sort_unstable();
        kinds.dedup();
        let from = index * size + 1;
        let range = first.range.start.min(last.range.start)..last.range.end.max(first.range.end);
        Some(Symbol {
            kind: SymbolKind::Run,
            record: "".into(),
            name: say!(from_one_to_another, from, from + nodes.len() - 1),
            detail: say!(kinds_so_many_of_all, kinds.join(", "), nodes.len(), all),
            range,
            selection: first.selection.clone(),
            lines: first.lines.start..last.lines.end,
            children: Vec::new(),
        })
    };
    *children = children.chunks(size).enumerate().filter_map(run).collect();
}

/// One node for each contour whose entities are in the tree.
fn contours_of(tree: &[Symbol], contours: &[ContourNote]) -> Vec<Symbol> {
    let Some(section) = tree
        .iter()
        .find(|node| node.kind == SymbolKind::Section && &*node.name == "ENTITIES")
    else {
        return Vec::new();
    };
    let mut by_handle: HashMap<String, &Symbol> = HashMap::with_capacity(section.children.len());
    for (ordinal, node) in section.children.iter().enumerate() {
        // Entities without a handle are named by their number.
        let handle = if node.name.is_empty() {
            format!("#{}", ordinal + 1)
        } else {
            node.name.clone()
        };
        by_handle.entry(handle).or_insert(node);
    }
    let node_of = |(index, contour): (usize, &ContourNote)| {
        let members: Vec<&Symbol> = contour
            .handles
            .iter()
            .filter_map(|handle| by_handle.get(&**handle).copied())
            .collect();
        let first = *members.first()?;
        let start = members.iter().map(|node| node.range.start).min()?;
        let end = members.iter().map(|node| node.range.end).max()?;
        let children = if members.len() > 1 {
            members
                .iter()
                .take(LISTED_OF_CONTOUR)
                .map(|&node| node.clone())
                .collect()
        } else {
            Vec::new()
        };
        Some(Symbol {
            kind: SymbolKind::Contour,
            record: "".into(),
            name: say!(contour_by_number, index + 1),
            detail: [
                closing(contour.closed),
                &say!(segments, contour.segments),
                &entities(&contour.handles),
            ]
            .join(", "),
            range: start..end,
            selection: first.selection.clone(),
            lines: first.lines.clone(),
            children,
        })
    };
    contours.iter().enumerate().filter_map(node_of).collect()
}

fn entities(handles: &[Handle]) -> String {
    match handles {
        [one] => say!(entity_by_handle, one),
        [first, ..] => say!(entities_from_one_on, handles.len(), first),
        [] => say!(no_entity).into(),
    }
}
