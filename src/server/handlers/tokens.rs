//! `textDocument/semanticTokens`: of the whole text, of the changes in it, and of the visible lines.

use crate::ide::{Token, TokenKind, tokens_in};
use crate::server::context::RequestContext;
use crate::text::{Encoding, SourceText};
use ls_types::{
    Range, SemanticToken, SemanticTokenType, SemanticTokens, SemanticTokensDelta,
    SemanticTokensDeltaParams, SemanticTokensEdit, SemanticTokensFullDeltaResult,
    SemanticTokensParams, SemanticTokensRangeParams, SemanticTokensRangeResult,
    SemanticTokensResult,
};
use std::sync::Arc;
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
    let Some(tokens) = all(context)? else {
        return Ok(None);
    };
    keep(context, None, &tokens);
    Ok(Some(named(context, tokens).into()))
}

/// Answers with the difference to the answer that the client names, if that is known, else with all tokens.
pub(in crate::server) fn delta(
    context: &RequestContext,
    params: SemanticTokensDeltaParams,
) -> Result<Option<SemanticTokensFullDeltaResult>> {
    let previous = params.previous_result_id;
    let edits = |edits: Vec<SemanticTokensEdit>| SemanticTokensDelta {
        result_id: Some(context.stamp.to_string()),
        edits,
    };
    if context.abilities.token_deltas && context.tokens.is_current(&previous, context.stamp) {
        return Ok(Some(edits(Vec::new()).into()));
    }
    let Some(tokens) = all(context)? else {
        return Ok(None);
    };
    Ok(Some(match keep(context, Some(&previous), &tokens) {
        Some(edit) => edits(vec![edit]).into(),
        None => named(context, tokens).into(),
    }))
}

/// Remembers the tokens sent, where the client asks for differences; returns the difference to `previous`.
fn keep(
    context: &RequestContext,
    previous: Option<&str>,
    tokens: &Arc<Vec<SemanticToken>>,
) -> Option<SemanticTokensEdit> {
    let is_asked_for = context.abilities.token_deltas;
    is_asked_for.then(|| context.tokens.replace(previous, context.stamp, tokens))?
}

/// All tokens, with a name where the client asks for differences to them.
fn named(context: &RequestContext, tokens: Arc<Vec<SemanticToken>>) -> SemanticTokens {
    let is_named = context.abilities.token_deltas;
    SemanticTokens {
        result_id: is_named.then(|| context.stamp.to_string()),
        data: Arc::unwrap_or_clone(tokens),
    }
}

/// All tokens, up to [`LIMIT`]; `None` where the document has none.
fn all(context: &RequestContext) -> Result<Option<Arc<Vec<SemanticToken>>>> {
    let Some(whole) = context.whole() else {
        return Ok(None);
    };
    let text = whole.text();
    let mut encoder = Encoder::new(text, context.encoding);
    whole.tokens(LIMIT, &|| context.is_cancelled(), |token| {
        encoder.push(token)
    })?;
    if encoder.tokens.len() >= LIMIT {
        tracing::warn!(
            "only the first {LIMIT} tokens of a text of {} lines are coloured",
            text.line_count()
        );
    }
    context.check()?;
    Ok(Some(Arc::new(encoder.tokens)))
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
    let mut encoder = Encoder::new(text, context.encoding);
    for token in tokens_in(document, lines) {
        encoder.push(token);
    }
    let data = encoder.tokens;
    let result_id = None;
    Ok(Some(SemanticTokens { result_id, data }.into()))
}

/// Counts tokens as the client does, each from the one before.
struct Encoder<'a> {
    text: &'a SourceText,
    encoding: Encoding,
    /// Line of the last token and where it begins.
    line: usize,
    begin: usize,
    /// Character of the last token.
    character: usize,
    /// A byte of the line and its character, so that nothing is counted twice: a whole program may be one line.
    known: usize,
    counted: usize,
    tokens: Vec<SemanticToken>,
}

impl<'a> Encoder<'a> {
    fn new(text: &'a SourceText, encoding: Encoding) -> Encoder<'a> {
        Encoder {
            text,
            encoding,
            line: 0,
            begin: 0,
            character: 0,
            known: 0,
            counted: 0,
            tokens: Vec::new(),
        }
    }

    #[inline]
    fn push(&mut self, token: Token) {
        let delta_line = token.line - self.line;
        if delta_line > 0 {
            self.line = token.line;
            self.begin = self.text.line_start(token.line);
            (self.known, self.counted, self.character) = (self.begin, 0, 0);
        }
        let (start, end) = (
            self.begin + token.start,
            self.begin + token.start + token.length,
        );
        if start < self.known {
            (self.known, self.counted) = (self.begin, 0);
        }
        let (at, before) = self.text.counted(self.known, start, self.encoding);
        let from = self.counted + before;
        let length = self.text.counted(at, end, self.encoding).1;
        let number = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        self.tokens.push(SemanticToken {
            delta_line: number(delta_line),
            delta_start: number(from.saturating_sub(self.character)),
            length: number(length),
            token_type: token.kind as u32,
            token_modifiers_bitset: 0,
        });
        (self.known, self.counted, self.character) = (at, from, from);
    }
}
