//! `textDocument/codeLens`: what a client can do with a program, above its first block. For clients that have the commands.

use crate::ide::SymbolKind;
use crate::ide::program::symbols;
use crate::server::context::RequestContext;
use ls_types::{CodeLens, CodeLensParams, Command};
use serde_json::json;
use tower_lsp::jsonrpc::Result;

/// Contours that get a lens of their own.
const LENSES: usize = 500;

pub(in crate::server) fn code_lens(
    context: &RequestContext,
    _: CodeLensParams,
) -> Result<Option<Vec<CodeLens>>> {
    let Some(program) = context.program().filter(|_| context.abilities.code_lens) else {
        return Ok(None);
    };
    let lens = |range, title: String, command: &str, arguments| CodeLens {
        range: context.range(program.text(), range),
        command: Some(Command {
            title,
            command: command.into(),
            arguments,
        }),
        data: None,
    };
    let tree = symbols(program);
    let contours = || tree.iter().filter(|symbol| symbol.kind == SymbolKind::Cut);
    let of_program = contours().take(1).flat_map(|first| {
        // Commands of the client, each with the document's URI as its argument.
        [
            (say!(simulate), "wedm.simulate"),
            (say!(open_picture), "wedm.openPicture"),
            (say!(convert_to_dxf), "wedm.convertToDxf"),
        ]
        .map(|(title, command)| {
            let arguments = Some(vec![json!(*context.uri)]);
            lens(first.selection.clone(), title.into(), command, arguments)
        })
    });
    // A command without a name is shown and does nothing.
    let of_contours = contours().take(LENSES).map(|symbol| {
        let title = format!("{}: {}", symbol.name, symbol.detail);
        lens(symbol.selection.clone(), title, "", None)
    });
    Ok(Some(of_program.chain(of_contours).collect()))
}
