//! `textDocument/formatting`, `rangeFormatting` and `onTypeFormatting`: programs in their layout.

use super::whole_program;
use crate::program::language;
use crate::server::convert::{bytes_of, lsp_edits};
use crate::server::requests::{Errand, written};
use crate::server::state::State;
use ls_types::{DocumentOnTypeFormattingOptions, Position, Range, TextEdit, Uri};

/// Lines that are to be formatted.
#[derive(Clone, Copy, Debug)]
pub(in crate::server) enum Scope {
    Whole,
    Range(Range),
    /// The line that was left with Enter; the cursor is on the one behind it.
    Left(Position),
}

pub(in crate::server) fn on_type() -> DocumentOnTypeFormattingOptions {
    DocumentOnTypeFormattingOptions {
        first_trigger_character: "\n".into(),
        more_trigger_character: None,
    }
}

pub(in crate::server) fn formatting(state: &mut State, uri: &Uri, scope: Scope, errand: Errand) {
    let encoding = state.encoding;
    whole_program(
        state,
        "Formatting",
        uri.as_str(),
        errand,
        move |program, settings| {
            let text = program.text();
            let lines = match scope {
                Scope::Whole => 0..text.line_count(),
                Scope::Range(range) => {
                    let bytes = bytes_of(text, range, encoding);
                    // A range that ends at the beginning of a line does not touch it.
                    let last = if bytes.is_empty() {
                        bytes.end
                    } else {
                        bytes.end - 1
                    };
                    text.line_of(bytes.start)..text.line_of(last) + 1
                }
                Scope::Left(position) => {
                    let line = position.line as usize;
                    line.saturating_sub(1)..line
                }
            };
            written(&lsp_edits(
                text,
                language::format(program, settings, lines),
                encoding,
            ))
        },
    );
}

/// A typed result that holds the token of the true one.
pub(in crate::server) fn standing_for(token: serde_json::Value) -> Vec<TextEdit> {
    vec![TextEdit {
        range: Range::default(),
        new_text: token.as_str().unwrap_or_default().to_owned(),
    }]
}
