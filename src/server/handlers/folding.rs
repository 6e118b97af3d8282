//! `textDocument/foldingRange`: sections, tables, blocks, entities; contours and comments of programs.

use crate::ide::dxf::{folds, outline};
use crate::ide::{self, FoldKind};
use crate::server::context::RequestContext;
use crate::server::errors::moved_on;
use ls_types::{FoldingRange, FoldingRangeKind, FoldingRangeParams};
use tower_lsp::jsonrpc::Result;

/// Folds of one answer, where the client does not say how many it takes.
const LIMIT: usize = 20_000;

pub(in crate::server) fn folding_range(
    context: &RequestContext,
    _: FoldingRangeParams,
) -> Result<Option<Vec<FoldingRange>>> {
    let limit = context.abilities.folding_limit.unwrap_or(LIMIT).min(LIMIT);
    let folds = if let Some(program) = context.program() {
        ide::program::folds(program, limit)
    } else if let Some(text) = context.text() {
        let tree = outline(text, &|| context.is_cancelled()).ok_or_else(moved_on)?;
        folds(&tree, limit)
    } else {
        return Ok(None);
    };
    if folds.len() >= limit {
        tracing::warn!("more than {limit} folds: only what holds others is folded");
    }
    let line = |line: usize| u32::try_from(line).unwrap_or(u32::MAX);
    let range = |fold: ide::Fold| {
        let (kind, collapsed_text) = match fold.kind {
            FoldKind::Record(text) => (None, Some(text)),
            FoldKind::Contour => (Some(FoldingRangeKind::Region), None),
            FoldKind::Comment => (Some(FoldingRangeKind::Comment), None),
        };
        FoldingRange {
            start_line: line(fold.first),
            end_line: line(fold.last),
            kind,
            collapsed_text,
            ..FoldingRange::default()
        }
    };
    Ok(Some(folds.into_iter().map(range).collect()))
}
