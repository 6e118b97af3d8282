//! `textDocument/formatting`, `rangeFormatting` and `onTypeFormatting`: programs in their layout.

use crate::program;
use crate::server::context::RequestContext;
use crate::server::convert::{bytes_of, lsp_edits};
use crate::text::SourceText;
use ls_types::{
    DocumentFormattingParams, DocumentOnTypeFormattingParams, DocumentRangeFormattingParams,
    TextEdit,
};
use std::ops::Range;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn whole(
    context: &RequestContext,
    _: DocumentFormattingParams,
) -> Result<Option<Vec<TextEdit>>> {
    formatted(context, |text| 0..text.line_count())
}

pub(in crate::server) fn range(
    context: &RequestContext,
    params: DocumentRangeFormattingParams,
) -> Result<Option<Vec<TextEdit>>> {
    formatted(context, |text| {
        let bytes = bytes_of(text, params.range, context.encoding);
        // A range that ends at the beginning of a line does not touch it.
        let last = bytes.end - usize::from(!bytes.is_empty());
        text.line_of(bytes.start)..text.line_of(last) + 1
    })
}

/// The line that Enter has left; the cursor is on the next one.
pub(in crate::server) fn left_line(
    context: &RequestContext,
    params: DocumentOnTypeFormattingParams,
) -> Result<Option<Vec<TextEdit>>> {
    let line = params.text_document_position.position.line as usize;
    formatted(context, |_| line.saturating_sub(1)..line)
}

fn formatted(
    context: &RequestContext,
    lines: impl FnOnce(&SourceText) -> Range<usize>,
) -> Result<Option<Vec<TextEdit>>> {
    let (Some(program), Some(document)) = (context.program(), context.document()) else {
        return Ok(None);
    };
    let text = program.text();
    let edits = program::format(program, document.settings(), lines(text));
    Ok(Some(lsp_edits(text, edits, context.encoding)))
}
