//! `textDocument/semanticTokens`: of the whole text, of the changes in it, and of the visible lines. The answers leave
//! as JSON text: the tokens of a large text take only eight bytes each.

use crate::ide::{Token, TokenKind, tokens_in};
use crate::server::context::RequestContext;
use crate::server::token_memory::{Difference, Fields, Packed};
use crate::server::transport::Written;
use crate::text::{Encoding, SourceText};
use ls_types::{
    Range, SemanticTokenType, SemanticTokensDeltaParams, SemanticTokensParams,
    SemanticTokensRangeParams,
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
) -> Result<Written> {
    let Some(tokens) = all(context)? else {
        return Ok(Written::null());
    };
    let (result_id, _) = kept(context, None, &tokens);
    Ok(whole(result_id, &tokens))
}

/// Answers with the difference to the answer that the client names, if that is known, else with all tokens.
pub(in crate::server) fn delta(
    context: &RequestContext,
    params: SemanticTokensDeltaParams,
) -> Result<Written> {
    let previous = params.previous_result_id;
    if context.abilities.token_deltas && context.tokens.is_current(&previous, context.stamp) {
        return Ok(edits(Some(previous), None));
    }
    let Some(tokens) = all(context)? else {
        return Ok(Written::null());
    };
    Ok(match kept(context, Some(&previous), &tokens) {
        (result_id, Some(edit)) => edits(result_id, Some((edit, &tokens))),
        (result_id, None) => whole(result_id, &tokens),
    })
}

/// Remembers the tokens sent, where the client asks for differences; returns the name of the answer, and the difference
/// to `previous`.
fn kept(
    context: &RequestContext,
    previous: Option<&str>,
    tokens: &Arc<Packed>,
) -> (Option<String>, Option<Difference>) {
    if context.abilities.token_deltas {
        context.tokens.replace(previous, context.stamp, tokens)
    } else {
        (None, None)
    }
}

/// `SemanticTokens`. The name of an answer is a number.
fn whole(result_id: Option<String>, tokens: &Packed) -> Written {
    let mut json = named(result_id);
    json.extend_from_slice(b"\"data\":");
    tokens.write(0..tokens.len(), &mut json);
    json.push(b'}');
    json.into()
}

/// `SemanticTokensDelta` of at most one edit.
fn edits(result_id: Option<String>, edit: Option<(Difference, &Packed)>) -> Written {
    let mut json = named(result_id);
    json.extend_from_slice(b"\"edits\":[");
    if let Some((edit, tokens)) = edit {
        let (start, count) = (edit.start, edit.delete_count);
        let head = format!("{{\"start\":{start},\"deleteCount\":{count},\"data\":");
        json.extend_from_slice(head.as_bytes());
        tokens.write(edit.tokens, &mut json);
        json.push(b'}');
    }
    json.extend_from_slice(b"]}");
    json.into()
}

fn named(result_id: Option<String>) -> Vec<u8> {
    let id = result_id.map(|id| format!("\"resultId\":\"{id}\","));
    format!("{{{}", id.unwrap_or_default()).into_bytes()
}

/// All tokens, up to [`LIMIT`]; `None` where the document has none.
fn all(context: &RequestContext) -> Result<Option<Arc<Packed>>> {
    let Some(whole) = context.whole() else {
        return Ok(None);
    };
    let text = whole.text();
    let mut encoder = Encoder::new(text, context.encoding, text.line_count().min(LIMIT));
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
) -> Result<Written> {
    let Range { start, end } = params.range;
    let first = start.line as usize;
    // A range that ends at the beginning of a line does not touch it.
    let end = end.line as usize + usize::from(end.character > 0);
    let lines = first..end.min(first.saturating_add(LINES));
    let Some((document, text)) = context.document_and_text() else {
        return Ok(Written::null());
    };
    let mut encoder = Encoder::new(text, context.encoding, 0);
    for token in tokens_in(document, lines) {
        encoder.push(token);
    }
    Ok(whole(None, &encoder.tokens))
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
    tokens: Packed,
}

impl<'a> Encoder<'a> {
    fn new(text: &'a SourceText, encoding: Encoding, capacity: usize) -> Encoder<'a> {
        Encoder {
            text,
            encoding,
            line: 0,
            begin: 0,
            character: 0,
            known: 0,
            counted: 0,
            tokens: Packed::with_capacity(capacity),
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
        let fields: Fields = [
            number(delta_line),
            number(from.saturating_sub(self.character)),
            number(length),
            token.kind as u32,
        ];
        self.tokens.push(fields);
        (self.known, self.counted, self.character) = (at, from, from);
    }
}
