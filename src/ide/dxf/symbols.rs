//! The tree as an editor lists it: with contours, and with runs in the place of very many entities.

use super::outline::{ContourNote, Node, NodeKind};
use std::collections::HashMap;

/// With more entities than this in one text, or more contours, runs of them are listed and not each by itself.
pub const GROUPED_ABOVE: usize = 20_000;
/// Runs that stand for many.
const RUNS: usize = 1000;
/// Entities of a contour that are listed under it.
const LISTED_OF_CONTOUR: usize = 200;

/// Adds the contours to a tree and shortens it where it would be too long to list.
pub fn symbols(mut tree: Vec<Node>, contours: &[ContourNote]) -> Vec<Node> {
    let listed = contours_of(&tree, contours);
    shorten(&mut tree);
    if let Some(first) = listed.first()
        && let Some(section) = tree
            .iter_mut()
            .find(|node| node.kind == NodeKind::Section && &*node.name == "ENTITIES")
    {
        // Symbols lie within the one that holds them: the contours are a part of their section.
        let (range, selection, lines) = (
            section.range.clone(),
            first.selection.clone(),
            section.lines.clone(),
        );
        let detail = format!("{} of them", contours.len());
        let (record, name) = ("".into(), "Contours".into());
        let mut node = Node {
            kind: NodeKind::Contours,
            record,
            name,
            detail,
            range,
            selection,
            lines,
            children: listed,
        };
        shorten_children(&mut node.children);
        section.children.insert(0, node);
    }
    tree
}

fn shorten(tree: &mut [Node]) {
    let count: usize = tree.iter().map(count).sum();
    if count > GROUPED_ABOVE {
        for node in tree {
            shorten_children(&mut node.children);
        }
    }
}

fn count(node: &Node) -> usize {
    node.children.iter().map(|child| 1 + count(child)).sum()
}

/// Puts runs in the place of more children than can be listed.
fn shorten_children(children: &mut Vec<Node>) {
    if children.len() <= RUNS {
        return;
    }
    let all = children.len();
    let size = all.div_ceil(RUNS);
    let run = |(index, nodes): (usize, &[Node])| {
        let (first, last) = (nodes.first()?, nodes.last()?);
        let mut kinds: Vec<&str> = nodes
            .iter()
            .map(|node| {
                if node.record.is_empty() {
                    "contour"
                } else {
                    &*node.record
                }
            })
            .collect();
        kinds.sort_unstable();
        kinds.dedup();
        let from = index * size + 1;
        let range = first.range.start.min(last.range.start)..last.range.end.max(first.range.end);
        Some(Node {
            kind: NodeKind::Group,
            record: "".into(),
            name: format!("{from} to {}", from + nodes.len() - 1).into(),
            detail: format!("{} · {} of {all}", kinds.join(", "), nodes.len()),
            range,
            selection: first.selection.clone(),
            lines: first.lines.start..last.lines.end,
            children: Vec::new(),
        })
    };
    *children = children.chunks(size).enumerate().filter_map(run).collect();
}

/// One node for each contour whose entities are in the tree.
fn contours_of(tree: &[Node], contours: &[ContourNote]) -> Vec<Node> {
    let Some(section) = tree
        .iter()
        .find(|node| node.kind == NodeKind::Section && &*node.name == "ENTITIES")
    else {
        return Vec::new();
    };
    let mut by_handle: HashMap<String, &Node> = HashMap::with_capacity(section.children.len());
    for (ordinal, node) in section.children.iter().enumerate() {
        // Entities without a handle are known by their number.
        let handle = if node.name.is_empty() {
            format!("#{}", ordinal + 1)
        } else {
            node.name.to_string()
        };
        by_handle.entry(handle).or_insert(node);
    }
    let node_of = |(index, contour): (usize, &ContourNote)| {
        let members: Vec<&Node> = contour
            .handles
            .iter()
            .filter_map(|handle| by_handle.get(&**handle).copied())
            .collect();
        let first = *members.first()?;
        let start = members.iter().map(|node| node.range.start).min()?;
        let end = members.iter().map(|node| node.range.end).max()?;
        let closed = if contour.closed { "closed" } else { "open" };
        let segments = if contour.segments == 1 {
            "1 segment".into()
        } else {
            format!("{} segments", contour.segments)
        };
        let children = if members.len() > 1 {
            members
                .iter()
                .take(LISTED_OF_CONTOUR)
                .map(|&node| node.clone())
                .collect()
        } else {
            Vec::new()
        };
        Some(Node {
            kind: NodeKind::Contour,
            record: "".into(),
            name: format!("contour {}", index + 1).into(),
            detail: format!("{closed}, {segments}, {}", entities(&contour.handles)),
            range: start..end,
            selection: first.selection.clone(),
            lines: first.lines.clone(),
            children,
        })
    };
    contours.iter().enumerate().filter_map(node_of).collect()
}

fn entities(handles: &[crate::drawing::Handle]) -> String {
    match handles {
        [one] => format!("entity {one}"),
        [first, ..] => format!("{} entities from {first} on", handles.len()),
        [] => "no entity".into(),
    }
}
