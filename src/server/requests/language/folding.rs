//! `textDocument/foldingRange`: sections, tables, blocks, entities; contours and comments of programs.

use super::{program_in, whole, whole_program};
use crate::dxf::language::{Fold, folds, outline};
use crate::program;
use crate::server::requests::{Errand, written};
use crate::server::state::State;
use ls_types::{FoldingRange, FoldingRangeKind, Uri};

/// Folds of one answer, where the client does not say how many it takes.
const LIMIT: usize = 20_000;

pub(in crate::server) fn folding_range(state: &mut State, uri: &Uri, errand: Errand) {
    let limit = state
        .client
        .abilities
        .folding_limit
        .unwrap_or(LIMIT)
        .min(LIMIT);
    if state
        .documents
        .get(uri.as_str())
        .and_then(program_in)
        .is_some()
    {
        whole_program(
            state,
            "Listing folds",
            uri.as_str(),
            errand,
            move |program, _| {
                let line = |line: usize| u32::try_from(line).unwrap_or(u32::MAX);
                let range = |fold: program::language::Fold| FoldingRange {
                    start_line: line(fold.first),
                    end_line: line(fold.last),
                    kind: Some(if fold.is_comment {
                        FoldingRangeKind::Comment
                    } else {
                        FoldingRangeKind::Region
                    }),
                    ..FoldingRange::default()
                };
                written(
                    &program::language::folds(program, limit)
                        .into_iter()
                        .map(range)
                        .collect::<Vec<_>>(),
                )
            },
        );
        return;
    }
    whole(
        state,
        "Listing folds",
        uri.as_str(),
        errand,
        move |text, stop| {
            let tree = outline(text, stop)?;
            let line = |line: usize| u32::try_from(line).unwrap_or(u32::MAX);
            let range = |fold: Fold| FoldingRange {
                start_line: line(fold.first),
                end_line: line(fold.last),
                collapsed_text: Some(fold.text),
                ..FoldingRange::default()
            };
            let folds = folds(&tree, limit);
            if folds.len() >= limit {
                tracing::warn!("more than {limit} folds: only what holds others is folded");
            }
            Some(written(&folds.into_iter().map(range).collect::<Vec<_>>()))
        },
    );
}

/// A typed result that holds the token of the true one.
pub(in crate::server) fn standing_for(token: serde_json::Value) -> Vec<FoldingRange> {
    vec![FoldingRange {
        collapsed_text: token.as_str().map(str::to_owned),
        ..FoldingRange::default()
    }]
}
