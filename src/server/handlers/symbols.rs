//! `textDocument/documentSymbol`: sections, tables, layers, blocks, entities, contours; contours and blocks of programs.

use crate::drawing::{Drawing, Outline};
use crate::ide::dxf::{ContourNote, Node, NodeKind, outline, symbols};
use crate::server::context::RequestContext;
use crate::server::errors::moved_on;
use crate::text::SourceText;
use ls_types::{
    DocumentSymbol, DocumentSymbolParams, DocumentSymbolResponse, Location, SymbolInformation,
    SymbolKind, Uri,
};
use std::ops::Range as Bytes;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn document_symbol(
    context: &RequestContext,
    _: DocumentSymbolParams,
) -> Result<Option<DocumentSymbolResponse>> {
    if let Some(program) = context.program() {
        let tree = crate::ide::program::symbols(program).into_iter();
        let tree = tree.map(Listed::of_program).collect();
        return answer(context, program.text(), tree).map(Some);
    }
    let Some(text) = context.text() else {
        return Ok(None);
    };
    let tree = outline(text, &|| context.is_cancelled()).ok_or_else(moved_on)?;
    let contours = context.snapshot().map_or_else(Vec::new, |snapshot| {
        notes(&snapshot.drawing, &snapshot.outlines)
    });
    let tree = symbols(tree, &contours);
    context.check()?;
    let tree = tree.into_iter().map(Listed::of_dxf).collect();
    answer(context, text, tree).map(Some)
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

    fn of_program(symbol: crate::ide::program::Symbol) -> Listed {
        use crate::ide::program::SymbolKind as Of;
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
    context: &RequestContext,
    text: &SourceText,
    tree: Vec<Listed>,
) -> Result<DocumentSymbolResponse> {
    if context.abilities.hierarchical_symbols {
        let nested = tree.into_iter().map(|node| nested(context, text, node));
        return Ok(DocumentSymbolResponse::Nested(nested.collect()));
    }
    let mut flat = Vec::new();
    flatten(context, text, tree, None, &context.lsp_uri()?, &mut flat);
    Ok(DocumentSymbolResponse::Flat(flat))
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
fn nested(context: &RequestContext, text: &SourceText, node: Listed) -> DocumentSymbol {
    let children: Vec<DocumentSymbol> = node
        .children
        .into_iter()
        .map(|child| nested(context, text, child))
        .collect();
    DocumentSymbol {
        name: node.name,
        detail: (!node.detail.is_empty()).then_some(node.detail),
        kind: node.kind,
        tags: None,
        deprecated: None,
        range: context.range(text, node.range),
        selection_range: context.range(text, node.selection),
        children: (!children.is_empty()).then_some(children),
    }
}

#[expect(deprecated, reason = "the type has a field of that kind")]
fn flatten(
    context: &RequestContext,
    text: &SourceText,
    nodes: Vec<Listed>,
    holder: Option<&str>,
    uri: &Uri,
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
                range: context.range(text, node.range),
            },
            container_name: holder.map(str::to_owned),
        });
        flatten(context, text, node.children, Some(&node.name), uri, flat);
    }
}
