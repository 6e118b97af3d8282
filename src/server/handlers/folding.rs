//! `textDocument/foldingRange`: sections, tables, blocks, entities; contours and comments of programs.

use crate::dxf::language::{folds, outline};
use crate::program;
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
    let line = |line: usize| u32::try_from(line).unwrap_or(u32::MAX);
    if let Some(program) = context.program() {
        let range = |fold: program::language::Fold| FoldingRange {
            start_line: line(fold.first),
            end_line: line(fold.last),
            kind: Some(match fold.is_comment {
                true => FoldingRangeKind::Comment,
                false => FoldingRangeKind::Region,
            }),
            ..FoldingRange::default()
        };
        let folds = program::language::folds(program, limit).into_iter();
        return Ok(Some(folds.map(range).collect()));
    }
    let Some(text) = context.text() else {
        return Ok(None);
    };
    let tree = outline(text, &|| context.is_cancelled()).ok_or_else(moved_on)?;
    let folds = folds(&tree, limit);
    if folds.len() >= limit {
        tracing::warn!("more than {limit} folds: only what holds others is folded");
    }
    let range = |fold: crate::dxf::language::Fold| FoldingRange {
        start_line: line(fold.first),
        end_line: line(fold.last),
        collapsed_text: Some(fold.text),
        ..FoldingRange::default()
    };
    Ok(Some(folds.into_iter().map(range).collect()))
}
