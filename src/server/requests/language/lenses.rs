//! `textDocument/codeLens`: what a client can do with a program, above its first block. For clients that have the commands.

use super::whole_program;
use crate::program::language::{SymbolKind, symbols};
use crate::server::convert::{lsp_range, range_of};
use crate::server::requests::{Errand, written};
use crate::server::state::State;
use ls_types::{CodeLens, Command, Uri};
use serde_json::json;

/// Commands of the client, each with the document's URI as its argument.
const COMMANDS: [(&str, &str); 3] = [
    ("Simulate", "wedm.simulate"),
    ("Open picture", "wedm.openPicture"),
    ("Convert to DXF", "wedm.convertToDxf"),
];

/// Contours that get a lens of their own.
const LENSES: usize = 500;

pub(in crate::server) fn code_lens(state: &mut State, uri: &Uri, errand: Errand) {
    let encoding = state.encoding;
    if !state.client.abilities.code_lens {
        let _ = errand.reply.send(Ok(b"null".to_vec()));
        return;
    }
    let argument = json!(uri.as_str());
    whole_program(
        state,
        "Listing lenses",
        uri.as_str(),
        errand,
        move |program, _| {
            let place = |range| lsp_range(range_of(program.text(), range, encoding));
            let tree = symbols(program);
            let mut lenses = Vec::new();
            if let Some(first) = tree
                .iter()
                .find(|symbol| symbol.kind == SymbolKind::Contour)
            {
                lenses.extend(COMMANDS.map(|(title, command)| CodeLens {
                    range: place(first.selection.clone()),
                    command: Some(Command {
                        title: title.into(),
                        command: command.into(),
                        arguments: Some(vec![argument.clone()]),
                    }),
                    data: None,
                }));
            }
            let contours = tree
                .iter()
                .filter(|symbol| symbol.kind == SymbolKind::Contour)
                .take(LENSES);
            // A command without a name is shown and does nothing.
            lenses.extend(contours.map(|symbol| CodeLens {
                range: place(symbol.selection.clone()),
                command: Some(Command {
                    title: format!("{}: {}", symbol.name, symbol.detail),
                    command: String::new(),
                    arguments: None,
                }),
                data: None,
            }));
            written(&lenses)
        },
    );
}
