//! Results that are JSON text already.
//!
//! A radius list of a million segments as a tree of JSON values takes gigabytes. Workers write results as text; a
//! handler leaves its text with the reply and returns an empty result to the framework, and the transport sends the
//! text instead.

use serde::Serialize;
use std::sync::{Arc, Mutex, PoisonError};
use tower_lsp::jsonrpc::{Id, Response};

tokio::task_local! {
    /// The reply of the handler that is being polled.
    pub(super) static REPLY: Reply;
}

/// A result as JSON text.
#[derive(Clone, Debug)]
pub(crate) struct Written(Vec<u8>);

impl Default for Written {
    /// An empty array.
    fn default() -> Written {
        Written(b"[]".to_vec())
    }
}

impl Written {
    pub(crate) fn of(result: &impl Serialize) -> serde_json::Result<Written> {
        serde_json::to_vec(result).map(Written)
    }

    pub(crate) fn json(&self) -> &[u8] {
        &self.0
    }

    /// Leaves the text with the reply to the request whose handler calls this.
    pub(crate) fn leave(self) {
        let _ = REPLY.try_with(|reply| *reply.lock() = Some(self));
    }
}

/// The text that a handler has left for its reply.
#[derive(Clone, Default)]
pub(super) struct Reply(Arc<Mutex<Option<Written>>>);

impl Reply {
    fn lock(&self) -> std::sync::MutexGuard<'_, Option<Written>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The body of a reply. An error replaces the text that was left.
    pub(crate) fn body(&self, response: &Response) -> serde_json::Result<Vec<u8>> {
        match self.lock().take().filter(|_| response.is_ok()) {
            None => serde_json::to_vec(response),
            Some(Written(json)) => {
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
