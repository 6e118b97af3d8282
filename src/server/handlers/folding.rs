//! `textDocument/foldingRange`: sections, tables, blocks, entities; contours and comments of programs.

use crate::ide::{Fold, FoldKind};
use crate::server::context::RequestContext;
use ls_types::{FoldingRange, FoldingRangeKind, FoldingRangeParams};
use tower_lsp::jsonrpc::Result;

/// Folds in one answer, where the client states no limit.
const LIMIT: usize = 20_000;

pub(in crate::server) fn folding_range(
    context: &RequestContext,
    _: FoldingRangeParams,
) -> Result<Option<Vec<FoldingRange>>> {
    let Some(whole) = context.whole() else {
        return Ok(None);
    };
    let limit = context.abilities.folding_limit.unwrap_or(LIMIT).min(LIMIT);
    let folds = whole.folds(limit, &|| context.is_cancelled())?;
    if folds.len() >= limit {
        tracing::warn!("more than {limit} folds: only what holds others is folded");
    }
    let line = |line: usize| u32::try_from(line).unwrap_or(u32::MAX);
    let range = |fold: Fold| {
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
