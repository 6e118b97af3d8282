//! Results that are JSON text already.
//!
//! A radius list of a million segments as a tree of JSON values takes gigabytes; workers write such results as text,
//! the handler hands a token through the framework, and the transport puts the text where the token stands.

use rustc_hash::FxHashMap;
use serde_json::Value;
use std::sync::{Arc, Mutex, PoisonError};
use tower_lsp::jsonrpc::{Id, Response};

/// Text by token, from the moment a handler ends until its reply is written.
#[derive(Clone, Default)]
pub(crate) struct Prepared {
    waiting: Arc<Mutex<Waiting>>,
}

#[derive(Default)]
struct Waiting {
    tokens: u64,
    texts: FxHashMap<String, Vec<u8>>,
}

impl Prepared {
    /// The token that stands for `json` in a reply.
    pub fn token(&self, json: Vec<u8>) -> Value {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.tokens += 1;
        // No method of ours answers with a control character.
        let token = format!("\u{1}prepared {}", waiting.tokens);
        waiting.texts.insert(token.clone(), json);
        Value::String(token)
    }

    /// The body of a reply, its token replaced.
    pub fn body(&self, response: Response) -> serde_json::Result<Vec<u8>> {
        let prepared = response
            .result()
            .and_then(string_of)
            .filter(|token| token.starts_with('\u{1}'))
            .and_then(|token| {
                let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
                waiting.texts.remove(token)
            });
        match prepared {
            None => serde_json::to_vec(&response),
            Some(json) => {
                let id: &Id = response.id();
                let mut body = format!(
                    "{{\"jsonrpc\":\"2.0\",\"id\":{},\"result\":",
                    serde_json::to_string(id)?
                )
                .into_bytes();
                body.reserve_exact(json.len() + 1);
                body.extend_from_slice(&json);
                body.push(b'}');
                Ok(body)
            }
        }
    }
}

/// The string that may be a token: the result itself, or where a result of the framework's own types has room for one.
fn string_of(result: &Value) -> Option<&str> {
    match result {
        Value::String(text) => Some(text),
        Value::Array(list) => ["name", "collapsedText", "newText"]
            .iter()
            .find_map(|key| list.first()?.get(key)?.as_str()),
        Value::Object(_) => result.get("resultId")?.as_str(),
        _ => None,
    }
}
