//! `textDocument/documentSymbol`: sections, tables, layers, blocks, entities, contours; contours and blocks of programs.

use crate::ide::{Symbol, SymbolKind as Kind};
use crate::server::context::RequestContext;
use crate::text::SourceText;
use ls_types::{
    DocumentSymbol, DocumentSymbolParams, DocumentSymbolResponse, Location, SymbolInformation,
    SymbolKind, Uri,
};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn document_symbol(
    context: &RequestContext,
    _: DocumentSymbolParams,
) -> Result<Option<DocumentSymbolResponse>> {
    let Some(whole) = context.whole() else {
        return Ok(None);
    };
    let tree = whole.symbols(&|| context.is_cancelled())?;
    context.check()?;
    let text = whole.text();
    Ok(Some(if context.abilities.hierarchical_symbols {
        let nested = tree.into_iter().map(|symbol| nested(context, text, symbol));
        DocumentSymbolResponse::Nested(nested.collect())
    } else {
        let mut flat = Vec::new();
        flatten(context, text, tree, None, &context.lsp_uri()?, &mut flat);
        DocumentSymbolResponse::Flat(flat)
    }))
}

fn kind_of(kind: Kind) -> SymbolKind {
    match kind {
        Kind::Section => SymbolKind::MODULE,
        Kind::Table => SymbolKind::NAMESPACE,
        Kind::Entry => SymbolKind::CONSTANT,
        Kind::Block | Kind::Cut => SymbolKind::CLASS,
        Kind::Entity => SymbolKind::OBJECT,
        Kind::Record => SymbolKind::STRUCT,
        Kind::Contours | Kind::Run => SymbolKind::ARRAY,
        Kind::Contour | Kind::Stop => SymbolKind::EVENT,
        Kind::Lead => SymbolKind::CONSTRUCTOR,
        Kind::Way => SymbolKind::INTERFACE,
        Kind::Move => SymbolKind::METHOD,
    }
}

#[expect(deprecated, reason = "the type has a field of that kind")]
fn nested(context: &RequestContext, text: &SourceText, symbol: Symbol) -> DocumentSymbol {
    let name = symbol.title();
    let children = symbol.children.into_iter();
    let children: Vec<_> = children.map(|child| nested(context, text, child)).collect();
    DocumentSymbol {
        name,
        detail: (!symbol.detail.is_empty()).then_some(symbol.detail),
        kind: kind_of(symbol.kind),
        tags: None,
        deprecated: None,
        range: context.range(text, symbol.range),
        selection_range: context.range(text, symbol.selection),
        children: (!children.is_empty()).then_some(children),
    }
}

#[expect(deprecated, reason = "the type has a field of that kind")]
fn flatten(
    context: &RequestContext,
    text: &SourceText,
    tree: Vec<Symbol>,
    holder: Option<&str>,
    uri: &Uri,
    flat: &mut Vec<SymbolInformation>,
) {
    for symbol in tree {
        let name = symbol.title();
        flat.push(SymbolInformation {
            name: name.clone(),
            kind: kind_of(symbol.kind),
            tags: None,
            deprecated: None,
            location: Location {
                uri: uri.clone(),
                range: context.range(text, symbol.range),
            },
            container_name: holder.map(str::to_owned),
        });
        flatten(context, text, symbol.children, Some(&name), uri, flat);
    }
}
