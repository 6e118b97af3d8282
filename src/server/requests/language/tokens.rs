//! `textDocument/semanticTokens`: of the whole text, of what has changed in it, and of the lines in sight.

use super::token_memory::TokenMemory;
use super::{dxf_in, program_in, whole, whole_program};
use crate::dxf::language::{Token, TokenKind, tokens, tokens_in};
use crate::program;
use crate::program::language::{WordKind, words_of};
use crate::server::requests::{Errand, written};
use crate::server::state::State;
use crate::text::{Encoding, SourceText};
use ls_types::{
    Range, SemanticToken, SemanticTokenType, SemanticTokens, SemanticTokensDelta,
    SemanticTokensFullOptions, SemanticTokensLegend, SemanticTokensOptions,
    SemanticTokensRangeResult, SemanticTokensServerCapabilities, Uri,
};
use rayon::prelude::*;
use std::sync::Arc;
use tower_lsp::jsonrpc::Result;

/// Tokens of one answer about a whole text.
const LIMIT: usize = 1_000_000;
/// Lines of one answer about a range.
const LINES: usize = 10_000;

pub(in crate::server) fn capabilities() -> SemanticTokensServerCapabilities {
    SemanticTokensServerCapabilities::SemanticTokensOptions(SemanticTokensOptions {
        legend: SemanticTokensLegend {
            token_types: TokenKind::ALL.map(type_of).to_vec(),
            token_modifiers: Vec::new(),
        },
        range: Some(true),
        full: Some(SemanticTokensFullOptions::Delta { delta: Some(true) }),
        ..SemanticTokensOptions::default()
    })
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

/// The same colours for the words of programs.
fn kind_of(kind: WordKind) -> Option<TokenKind> {
    Some(match kind {
        WordKind::Number => TokenKind::Handle,
        WordKind::Lead => TokenKind::Name,
        WordKind::Length => TokenKind::Number,
        WordKind::Setting => TokenKind::Code,
        WordKind::Motion => TokenKind::Record,
        WordKind::Stop => TokenKind::Variable,
        WordKind::Stated => TokenKind::Text,
        WordKind::Comment => TokenKind::Comment,
        WordKind::Strange => return None,
    })
}

/// The tokens of some lines of a program, at most `limit`.
fn tokens_of(
    program: &program::Document,
    lines: std::ops::Range<usize>,
    limit: usize,
) -> Vec<Token> {
    let text = program.text();
    let mut found = Vec::new();
    for line in lines.start..lines.end.min(text.line_count()) {
        let begin = text.line_start(line);
        let token = |part: program::language::Part| {
            Some(Token {
                line,
                start: part.range.start - begin,
                length: part.range.len(),
                kind: kind_of(part.kind)?,
            })
        };
        found.extend(words_of(program, line).into_iter().filter_map(token));
        if found.len() >= limit {
            found.truncate(limit);
            break;
        }
    }
    found
}

/// The tokens of a program, at most [`LIMIT`]; what a line says hangs on no other line.
fn all_tokens_of(program: &program::Document) -> Vec<Token> {
    const CHUNK: usize = 4_096;
    let count = program.text().line_count();
    if count <= CHUNK {
        return tokens_of(program, 0..count, LIMIT);
    }
    let firsts: Vec<usize> = (0..count).step_by(CHUNK).collect();
    let mut found = Vec::new();
    // As many at once as there may be need for.
    for some in firsts.chunks(16) {
        let chunks: Vec<Vec<Token>> = some
            .par_iter()
            .map(|&first| tokens_of(program, first..first + CHUNK, LIMIT))
            .collect();
        found.extend(chunks.into_iter().flatten());
        if found.len() >= LIMIT {
            found.truncate(LIMIT);
            break;
        }
    }
    found
}

/// Answers with all tokens; with what has changed since the answer `previous`, where that is known.
pub(in crate::server) fn full(
    state: &mut State,
    uri: &Uri,
    previous: Option<String>,
    errand: Errand,
) {
    let (encoding, deltas) = (state.encoding, state.client.abilities.token_deltas);
    let memory = match state.document(uri.as_str()) {
        Ok(open) => Memory {
            kept: deltas.then(|| open.tokens.clone()),
            stamp: open.stamp,
            previous,
        },
        Err(error) => {
            let _ = errand.reply.send(Err(error));
            return;
        }
    };
    if let Some(unchanged) = memory.unchanged() {
        let _ = errand.reply.send(unchanged);
        return;
    }
    if state
        .documents
        .get(uri.as_str())
        .and_then(program_in)
        .is_some()
    {
        whole_program(
            state,
            "Colouring",
            uri.as_str(),
            errand,
            move |program, _| {
                let tokens = all_tokens_of(program);
                memory.answer(encoded(program.text(), &tokens, encoding))
            },
        );
        return;
    }
    whole(
        state,
        "Colouring",
        uri.as_str(),
        errand,
        move |text, stop| {
            let tokens = tokens(text, LIMIT, stop)?;
            if tokens.len() >= LIMIT {
                tracing::warn!(
                    "only the first {LIMIT} tokens of a text of {} lines are coloured",
                    text.line_count()
                );
            }
            let data = encoded(text, &tokens, encoding);
            (!stop()).then(|| memory.answer(data))
        },
    );
}

/// What is known of earlier answers when a request comes.
struct Memory {
    /// `None` for a client that asks for no differences.
    kept: Option<Arc<TokenMemory>>,
    stamp: u64,
    previous: Option<String>,
}

impl Memory {
    /// The answer where nothing has changed since the one that the client names.
    fn unchanged(&self) -> Option<Result<Vec<u8>>> {
        let previous = self.previous.as_deref()?;
        let is_current = self.kept.as_ref()?.is_current(previous, self.stamp);
        is_current.then(|| {
            written(&SemanticTokensDelta {
                result_id: Some(previous.to_owned()),
                edits: Vec::new(),
            })
        })
    }

    fn answer(&self, data: Vec<SemanticToken>) -> Result<Vec<u8>> {
        let kept = self
            .kept
            .as_ref()
            .map(|kept| kept.replace(self.previous.as_deref(), self.stamp, &data));
        let (result_id, edit) = kept.unwrap_or_default();
        match edit {
            Some(edit) => written(&SemanticTokensDelta {
                result_id,
                edits: vec![edit],
            }),
            None => written(&SemanticTokens { result_id, data }),
        }
    }
}

/// A typed result that holds the token of the true one.
pub(in crate::server) fn standing_for(token: serde_json::Value) -> SemanticTokens {
    SemanticTokens {
        result_id: token.as_str().map(str::to_owned),
        data: Vec::new(),
    }
}

pub(in crate::server) fn range(
    state: &mut State,
    uri: &Uri,
    range: Range,
) -> Result<Option<SemanticTokensRangeResult>> {
    let encoding = state.encoding;
    let open = state.document(uri.as_str())?;
    let first = range.start.line as usize;
    // A range that ends at the beginning of a line does not touch it.
    let end = range.end.line as usize + usize::from(range.end.character > 0);
    let lines = first..end.min(first.saturating_add(LINES));
    let data = if let Some(program) = program_in(open).and_then(|document| document.program()) {
        encoded(
            program.text(),
            &tokens_of(program, lines, usize::MAX),
            encoding,
        )
    } else if let Some(dxf) = dxf_in(open) {
        encoded(dxf.text(), &tokens_in(dxf, lines), encoding)
    } else {
        return Ok(None);
    };
    Ok(Some(SemanticTokensRangeResult::Tokens(SemanticTokens {
        result_id: None,
        data,
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
