//! Requests to the client: sent without waiting, answered by an event, given up after ten seconds.

use super::transport::Writer;
use crate::message::readable;
use crate::protocol::method::Message;
use rustc_hash::FxHashMap;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::sync::Arc;
use std::time::{Duration, Instant};

const TIME_OUT: Duration = Duration::from_secs(10);

/// Acts on an answer; the error is a sentence.
type Then<S> = Box<dyn FnOnce(&mut S, Result<Value, String>) + Send>;

/// What to do once an answer has come, or none will.
pub(super) type Answered<S> = Box<dyn FnOnce(&mut S) + Send>;

struct Asked<S> {
    method: &'static str,
    deadline: Instant,
    then: Then<S>,
}

/// The client's capabilities that matter here.
#[derive(Clone, Debug, Default)]
pub(super) struct Abilities {
    pub(crate) apply_drawing_edit: bool,
    pub(crate) resend_drawing: bool,
    pub(crate) document_changes: bool,
    /// A workspace edit may make a new file.
    pub(crate) create_files: bool,
    pub(crate) configuration: bool,
    pub(crate) register_configuration: bool,
    pub(crate) register_watched_files: bool,
    pub(crate) related_information: bool,
    pub(crate) apply_edit: bool,
    /// Code actions may say why they cannot be done.
    pub(crate) disabled_actions: bool,
    /// Asks for the edit of the code action that is chosen.
    pub(crate) resolves_actions: bool,
    /// The client has the commands that lenses name.
    pub(crate) code_lens: bool,
    /// The client opens pages of rules, which it asks for.
    pub(crate) rule_pages: bool,
    /// Completions may be snippets.
    pub(crate) snippets: bool,
    /// Symbols may be a tree.
    pub(crate) hierarchical_symbols: bool,
    /// Asks for the difference of the semantic tokens.
    pub(crate) token_deltas: bool,
    /// The most folds that the client takes.
    pub(crate) folding_limit: Option<usize>,
}

/// The other end of the wire, as the state thread sees it. Answers act on the state `S`.
pub(super) struct Client<S> {
    pub(crate) abilities: Arc<Abilities>,
    writer: Writer,
    next_id: u64,
    asked: FxHashMap<String, Asked<S>>,
}

#[derive(Serialize)]
struct Request<'a, P> {
    jsonrpc: &'static str,
    id: &'a str,
    method: &'a str,
    params: P,
}

/// Level of a line in the client's log.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Weight {
    Error = 1,
    Warning = 2,
    Info = 3,
}

impl<S: 'static> Client<S> {
    pub(crate) fn new(writer: Writer) -> Client<S> {
        Client {
            abilities: Arc::default(),
            writer,
            next_id: 0,
            asked: FxHashMap::default(),
        }
    }

    pub(crate) fn writer(&self) -> &Writer {
        &self.writer
    }

    /// Sends a request; `then` runs on the state thread when the answer, an error or the time-out comes.
    pub(crate) fn ask(
        &mut self,
        method: &'static str,
        params: impl Serialize,
        then: impl FnOnce(&mut S, Result<Value, String>) + Send + 'static,
    ) {
        self.next_id += 1;
        let id = format!("wedm-{}", self.next_id);
        self.writer.send_json(&Request {
            jsonrpc: "2.0",
            id: &id,
            method,
            params,
        });
        self.asked.insert(
            id,
            Asked {
                method,
                deadline: Instant::now() + TIME_OUT,
                then: Box::new(then),
            },
        );
    }

    /// Sends a request of the name space `wedm/`, and reads its answer.
    pub(crate) fn ask_own<M: Message<Params: Serialize, Answer: DeserializeOwned>>(
        &mut self,
        params: M::Params,
        then: impl FnOnce(&mut S, Result<M::Answer, String>) + Send + 'static,
    ) {
        self.ask(M::NAME, params, move |state, answer| {
            let read = |answer| serde_json::from_value(answer).map_err(|error| error.to_string());
            then(state, answer.and_then(read));
        });
    }

    /// A line for the client's log.
    pub(crate) fn log(&self, weight: Weight, message: impl Into<String>) {
        self.say("window/logMessage", weight, message.into());
    }

    /// A message that the client puts before its user.
    pub(crate) fn show(&self, weight: Weight, message: impl Into<String>) {
        self.say("window/showMessage", weight, message.into());
    }

    fn say(&self, method: &str, weight: Weight, message: String) {
        self.writer.notify(
            method,
            serde_json::json!({ "type": weight as u8, "message": readable(&message) }),
        );
    }

    /// When the next request is given up.
    pub(crate) fn next_deadline(&self) -> Option<Instant> {
        self.asked.values().map(|asked| asked.deadline).min()
    }

    /// The client answered: returns what to do.
    pub(crate) fn answered(
        &mut self,
        id: &str,
        result: Result<Value, Value>,
    ) -> Option<Answered<S>> {
        let Some(Asked { then, method, .. }) = self.asked.remove(id) else {
            self.log(Weight::Info, say!(an_answer_came_late, id));
            return None;
        };
        let result = result.map_err(|error| {
            let reason = error
                .get("message")
                .and_then(Value::as_str)
                .unwrap_or(say!(no_reason_given));
            say!(failed_for, method, reason)
        });
        Some(Box::new(move |state| then(state, result)))
    }

    /// Gives up one request that has waited too long: returns what to do.
    pub(crate) fn expired(&mut self) -> Option<Answered<S>> {
        let now = Instant::now();
        let (id, _) = self.asked.iter().find(|(_, asked)| asked.deadline <= now)?;
        let id = id.clone();
        let Asked { then, method, .. } = self.asked.remove(&id)?;
        let seconds = TIME_OUT.as_secs();
        self.log(
            Weight::Warning,
            say!(was_not_answered_within_s, method, seconds),
        );
        let error = Err(say!(the_client_did_not_answer, method, seconds));
        Some(Box::new(move |state| then(state, error)))
    }
}
