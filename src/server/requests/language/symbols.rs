//! `textDocument/documentSymbol`: sections, tables, layers, blocks, entities, contours; contours and blocks of programs.

use super::{program_in, whole, whole_program};
use crate::drawing::{Drawing, Outline};
use crate::dxf::language::{ContourNote, Node, NodeKind, outline, symbols};
use crate::program;
use crate::server::convert::{lsp_range, range_of};
use crate::server::requests::{Errand, written};
use crate::server::state::State;
use crate::text::{Encoding, SourceText};
use ls_types::{
    DocumentSymbol, DocumentSymbolResponse, Location, Range, SymbolInformation, SymbolKind, Uri,
};
use std::ops::Range as Bytes;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn document_symbol(state: &mut State, uri: Uri, errand: Errand) {
    let (encoding, hierarchical) = (state.encoding, state.client.abilities.hierarchical_symbols);
    if state
        .documents
        .get(uri.as_str())
        .and_then(program_in)
        .is_some()
    {
        let name = uri.as_str().to_owned();
        whole_program(
            state,
            "Listing symbols",
            &name,
            errand,
            move |program, _| {
                let tree = program::language::symbols(program)
                    .into_iter()
                    .map(Listed::of_program)
                    .collect();
                answer(program.text(), tree, hierarchical, &uri, encoding)
            },
        );
        return;
    }
    let snapshot = state
        .documents
        .get(uri.as_str())
        .and_then(|open| match &open.content {
            crate::server::content::Content::Read(document) => document.snapshot(),
            _ => None,
        });
    let name = uri.as_str().to_owned();
    whole(
        state,
        "Listing symbols",
        &name,
        errand,
        move |text, stop| {
            let tree = outline(text, stop)?;
            let contours = snapshot.map_or_else(Vec::new, |snapshot| {
                notes(&snapshot.drawing, &snapshot.outlines)
            });
            let tree = symbols(tree, &contours);
            if stop() {
                return None;
            }
            Some(answer(
                text,
                tree.into_iter().map(Listed::of_dxf).collect(),
                hierarchical,
                &uri,
                encoding,
            ))
        },
    );
}

/// A symbol as the protocol names it, with its places still in bytes.
struct Listed {
    name: String,
    detail: String,
    kind: SymbolKind,
    range: Bytes<usize>,
    selection: Bytes<usize>,
    children: Vec<Listed>,
}

impl Listed {
    fn of_dxf(node: Node) -> Listed {
        let (name, kind) = (name_of(&node), kind_of(&node));
        let children = node.children.into_iter().map(Listed::of_dxf).collect();
        Listed {
            name,
            detail: node.detail,
            kind,
            range: node.range,
            selection: node.selection,
            children,
        }
    }

    fn of_program(symbol: program::language::Symbol) -> Listed {
        use program::language::SymbolKind as Of;
        let kind = match symbol.kind {
            Of::Contour => SymbolKind::CLASS,
            Of::Lead => SymbolKind::CONSTRUCTOR,
            Of::Way => SymbolKind::INTERFACE,
            Of::Block => SymbolKind::METHOD,
            Of::Run => SymbolKind::ARRAY,
            Of::Word => SymbolKind::EVENT,
        };
        let children = symbol
            .children
            .into_iter()
            .map(Listed::of_program)
            .collect();
        Listed {
            name: symbol.name,
            detail: symbol.detail,
            kind,
            range: symbol.range,
            selection: symbol.selection,
            children,
        }
    }
}

fn answer(
    text: &SourceText,
    tree: Vec<Listed>,
    hierarchical: bool,
    uri: &Uri,
    encoding: Encoding,
) -> Result<Vec<u8>> {
    if hierarchical {
        return written(
            &tree
                .into_iter()
                .map(|node| nested(text, node, encoding))
                .collect::<Vec<_>>(),
        );
    }
    let mut flat = Vec::new();
    flatten(text, tree, None, uri, encoding, &mut flat);
    written(&flat)
}

fn notes(drawing: &Drawing, outlines: &[Outline]) -> Vec<ContourNote> {
    let handle = |piece: &crate::drawing::Piece| {
        drawing
            .get(piece.entity)
            .map(|entity| entity.handle.clone())
    };
    let note = |outline: &Outline| ContourNote {
        closed: outline.contour.closed,
        segments: outline.contour.len(),
        handles: outline.contour.pieces.iter().filter_map(handle).collect(),
    };
    outlines.iter().map(note).collect()
}

fn name_of(node: &Node) -> String {
    let name = match node.kind {
        NodeKind::Section | NodeKind::Contours | NodeKind::Contour | NodeKind::Group => {
            node.name.to_string()
        }
        _ => format!("{} {}", node.record, node.name).trim().to_owned(),
    };
    // A symbol without a name is refused by editors.
    if name.is_empty() {
        "unnamed".into()
    } else {
        name
    }
}

fn kind_of(node: &Node) -> SymbolKind {
    match node.kind {
        NodeKind::Section => SymbolKind::MODULE,
        NodeKind::Table => SymbolKind::NAMESPACE,
        NodeKind::Entry => SymbolKind::CONSTANT,
        NodeKind::Block => SymbolKind::CLASS,
        NodeKind::Entity => SymbolKind::OBJECT,
        NodeKind::Other => SymbolKind::STRUCT,
        NodeKind::Contours | NodeKind::Group => SymbolKind::ARRAY,
        NodeKind::Contour => SymbolKind::EVENT,
    }
}

#[expect(deprecated, reason = "the type has a field of that kind")]
fn nested(text: &SourceText, node: Listed, encoding: Encoding) -> DocumentSymbol {
    let children: Vec<DocumentSymbol> = node
        .children
        .into_iter()
        .map(|child| nested(text, child, encoding))
        .collect();
    DocumentSymbol {
        name: node.name,
        detail: (!node.detail.is_empty()).then_some(node.detail),
        kind: node.kind,
        tags: None,
        deprecated: None,
        range: lsp_range(range_of(text, node.range, encoding)),
        selection_range: lsp_range(range_of(text, node.selection, encoding)),
        children: (!children.is_empty()).then_some(children),
    }
}

#[expect(deprecated, reason = "the type has a field of that kind")]
fn flatten(
    text: &SourceText,
    nodes: Vec<Listed>,
    holder: Option<&str>,
    uri: &Uri,
    encoding: Encoding,
    flat: &mut Vec<SymbolInformation>,
) {
    for node in nodes {
        flat.push(SymbolInformation {
            name: node.name.clone(),
            kind: node.kind,
            tags: None,
            deprecated: None,
            location: Location {
                uri: uri.clone(),
                range: lsp_range(range_of(text, node.range, encoding)),
            },
            container_name: holder.map(str::to_owned),
        });
        flatten(text, node.children, Some(&node.name), uri, encoding, flat);
    }
}

/// A typed result that holds the token of the true one.
#[expect(deprecated, reason = "the type has a field of that kind")]
pub(in crate::server) fn standing_for(token: serde_json::Value) -> DocumentSymbolResponse {
    DocumentSymbolResponse::Nested(vec![DocumentSymbol {
        name: token.as_str().unwrap_or_default().to_owned(),
        detail: None,
        kind: SymbolKind::FILE,
        tags: None,
        deprecated: None,
        range: Range::default(),
        selection_range: Range::default(),
        children: None,
    }])
}
