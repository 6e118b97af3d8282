//! `textDocument/semanticTokens`: of the whole text, of what has changed in it, and of the lines in sight.

use crate::ide::{Token, TokenKind, tokens_in};
use crate::server::context::RequestContext;
use crate::text::{Encoding, SourceText};
use ls_types::{
    Range, SemanticToken, SemanticTokenType, SemanticTokens, SemanticTokensDelta,
    SemanticTokensDeltaParams, SemanticTokensEdit, SemanticTokensFullDeltaResult,
    SemanticTokensParams, SemanticTokensRangeParams, SemanticTokensRangeResult,
    SemanticTokensResult,
};
use tower_lsp::jsonrpc::Result;

/// Tokens of one answer about a whole text.
const LIMIT: usize = 1_000_000;
/// Lines of one answer about a range.
const LINES: usize = 10_000;

/// The names of the types, in the order of their numbers.
pub(in crate::server) fn types() -> [SemanticTokenType; TokenKind::ALL.len()] {
    TokenKind::ALL.map(type_of)
}

/// The types that themes have a colour for.
fn type_of(kind: TokenKind) -> SemanticTokenType {
    match kind {
        TokenKind::Code => SemanticTokenType::PROPERTY,
        TokenKind::Record => SemanticTokenType::KEYWORD,
        TokenKind::Handle => SemanticTokenType::VARIABLE,
        TokenKind::Layer => SemanticTokenType::NAMESPACE,
        TokenKind::Number => SemanticTokenType::NUMBER,
        TokenKind::Text => SemanticTokenType::STRING,
        TokenKind::Comment => SemanticTokenType::COMMENT,
        TokenKind::Variable => SemanticTokenType::MACRO,
        TokenKind::Name => SemanticTokenType::TYPE,
    }
}

pub(in crate::server) fn full(
    context: &RequestContext,
    _: SemanticTokensParams,
) -> Result<Option<SemanticTokensResult>> {
    let Some(data) = all(context)? else {
        return Ok(None);
    };
    let (result_id, _) = kept(context, None, &data);
    Ok(Some(SemanticTokensResult::Tokens(SemanticTokens {
        result_id,
        data,
    })))
}

/// Answers with what has changed since the answer that the client names, where that is known, else with all tokens.
pub(in crate::server) fn delta(
    context: &RequestContext,
    params: SemanticTokensDeltaParams,
) -> Result<Option<SemanticTokensFullDeltaResult>> {
    let previous = params.previous_result_id;
    let delta = |result_id, edits| {
        let delta = SemanticTokensDelta { result_id, edits };
        Ok(Some(SemanticTokensFullDeltaResult::TokensDelta(delta)))
    };
    if context.abilities.token_deltas && context.tokens.is_current(&previous, context.stamp) {
        return delta(Some(previous), Vec::new());
    }
    let Some(data) = all(context)? else {
        return Ok(None);
    };
    match kept(context, Some(&previous), &data) {
        (result_id, Some(edit)) => delta(result_id, vec![edit]),
        (result_id, None) => {
            let tokens = SemanticTokens { result_id, data };
            Ok(Some(SemanticTokensFullDeltaResult::Tokens(tokens)))
        }
    }
}

/// Takes note of what the client is sent, where it asks for differences: the name of the answer, and the difference to `previous`.
fn kept(
    context: &RequestContext,
    previous: Option<&str>,
    data: &[SemanticToken],
) -> (Option<String>, Option<SemanticTokensEdit>) {
    if context.abilities.token_deltas {
        context.tokens.replace(previous, context.stamp, data)
    } else {
        (None, None)
    }
}

/// All tokens, up to [`LIMIT`]; `None` where the document has none.
fn all(context: &RequestContext) -> Result<Option<Vec<SemanticToken>>> {
    let Some(whole) = context.whole() else {
        return Ok(None);
    };
    let text = whole.text();
    let tokens = whole.tokens(LIMIT, &|| context.is_cancelled())?;
    if tokens.len() >= LIMIT {
        tracing::warn!(
            "only the first {LIMIT} tokens of a text of {} lines are coloured",
            text.line_count()
        );
    }
    let data = encoded(text, &tokens, context.encoding);
    context.check()?;
    Ok(Some(data))
}

pub(in crate::server) fn range(
    context: &RequestContext,
    params: SemanticTokensRangeParams,
) -> Result<Option<SemanticTokensRangeResult>> {
    let Range { start, end } = params.range;
    let first = start.line as usize;
    // A range that ends at the beginning of a line does not touch it.
    let end = end.line as usize + usize::from(end.character > 0);
    let lines = first..end.min(first.saturating_add(LINES));
    let Some((document, text)) = context.document_and_text() else {
        return Ok(None);
    };
    let tokens = tokens_in(document, lines);
    Ok(Some(SemanticTokensRangeResult::Tokens(SemanticTokens {
        result_id: None,
        data: encoded(text, &tokens, context.encoding),
    })))
}

fn encoded(text: &SourceText, tokens: &[Token], encoding: Encoding) -> Vec<SemanticToken> {
    let number = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    let (mut line, mut character) = (0, 0);
    // A byte of the line and its character: what has been counted is not counted again, a program may stand in one line.
    let (mut known, mut counted) = (0, 0);
    let mut data = Vec::with_capacity(tokens.len());
    for token in tokens {
        let begin = text.line_start(token.line);
        let (start, end) = (begin + token.start, begin + token.start + token.length);
        if token.line != line || start < known || data.is_empty() {
            (known, counted) = (begin, 0);
        }
        let (at, before) = text.counted(known, start, encoding);
        let from = counted + before;
        let length = text.counted(at, end, encoding).1;
        (known, counted) = (at, from);
        let delta_line = token.line - line;
        data.push(SemanticToken {
            delta_line: number(delta_line),
            delta_start: number(if delta_line == 0 {
                from.saturating_sub(character)
            } else {
                from
            }),
            length: number(length),
            token_type: token.kind as u32,
            token_modifiers_bitset: 0,
        });
        (line, character) = (token.line, from);
    }
    data
}
