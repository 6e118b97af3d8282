//! The wire: bytes in, messages to the service in order, replies out.
//!
//! One blocking thread reads. It polls each message's handler once, immediately, so that everything before a handler's
//! first wait happens in the order of the messages. A handler that waits is spawned: any number of them holds up
//! neither the next message nor a cancellation. Knows JSON-RPC, and of LSP only `initialize` and `exit`.

// Public for fuzz targets, of which a build without `testing` knows nothing.
#[cfg_attr(not(feature = "testing"), allow(unreachable_pub))]
mod frame;
mod lost;
mod memory;
mod message;
mod stdio;
mod weight;
mod whole;
mod writer;
mod written;

pub(crate) use lost::LostChange;
pub(crate) use memory::give_back;
pub(crate) use whole::{FromClient, ToClient};
pub(crate) use writer::{Publish, Writer};
pub(crate) use written::Written;

#[cfg_attr(not(feature = "testing"), allow(unreachable_pub))]
pub use frame::{Frame, Frames};
use lost::lost_change;
use memory::Memory;
use message::Incoming;
use serde_json::Value;
use std::any::Any;
use std::future::Future;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::task::{Context, Poll, Waker};
use std::time::{Duration, Instant};
use tower::Service;
use tower_lsp::jsonrpc::{Error, ErrorCode, Id, Request, Response};
use tower_lsp::{ExitedError, LanguageServer, LspService};
use written::{REPLY, Reply};

pub(crate) use stdio::pipes;

/// The server's part for the transport, beside the messages themselves.
pub(crate) trait Inbox {
    /// The client answered a request of ours.
    fn reply(&self, id: String, result: Result<Value, Value>);
    /// A line about the connection for the log.
    fn note(&self, text: String);
    /// A change of a document could not be read.
    fn lost(&self, change: LostChange);
    /// Number of notifications that a handler has taken so far.
    fn taken(&self) -> usize;
}

/// What a client sends, one message after another.
pub(crate) trait Messages {
    /// Waits for the next one.
    fn step(&mut self) -> Frame;

    /// The change of a document in what was passed over since this was asked last.
    fn take_lost(&mut self) -> Option<LostChange>;

    /// Marks the last message as invalid.
    fn was_broken(&mut self, body: &[u8]);

    /// Bytes that are used up.
    fn position(&self) -> i64;

    /// True where the client has gone, although messages of it may still wait.
    fn is_hung_up(&self) -> bool;
}

type Answer = Pin<Box<dyn Future<Output = Result<Option<Response>, ExitedError>> + Send>>;

pub(crate) struct Transport<S, I> {
    service: LspService<S>,
    inbox: I,
    writer: Writer,
    runtime: tokio::runtime::Runtime,
    memory: Memory,
    /// Handlers that still wait.
    waiting: Arc<AtomicUsize>,
}

impl<S: LanguageServer, I: Inbox> Transport<S, I> {
    pub(crate) fn new(service: LspService<S>, inbox: I, writer: Writer) -> std::io::Result<Self> {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .enable_time()
            .thread_name("wedm-replies")
            .build()?;
        Ok(Transport {
            service,
            inbox,
            writer,
            runtime,
            memory: Memory::default(),
            waiting: Arc::default(),
        })
    }

    /// Serves until `exit` or the end of the input; true when the client said `exit`.
    pub(crate) fn serve(&mut self, messages: &mut impl Messages) -> bool {
        loop {
            if !self.wait_for_reader(messages) {
                return false;
            }
            let frame = messages.step();
            self.lose(messages.take_lost());
            match frame {
                Frame::End => return false,
                Frame::Broken(reason) => {
                    let error = Error {
                        code: ErrorCode::ParseError,
                        message: reason.into(),
                        data: None,
                    };
                    self.answer_broken(error, messages.position());
                }
                Frame::Body(body) => match message::parse(&body) {
                    Err(error) => {
                        messages.was_broken(&body);
                        self.answer_broken(error, messages.position());
                        self.lose(lost_change(&body));
                    }
                    Ok(Incoming::Invalid { id, error }) => {
                        self.send(Response::from_error(id, error));
                        self.lose(lost_change(&body));
                    }
                    Ok(Incoming::Reply { id, result }) => self.inbox.reply(id, result),
                    Ok(Incoming::Request(request)) => {
                        let length = body.len();
                        drop(body);
                        let exit = request.method() == "exit" && request.id().is_none();
                        self.dispatch(request);
                        self.memory.after_message(length, &self.runtime);
                        if exit {
                            return true;
                        }
                    }
                },
            }
        }
    }

    /// Waits at most `limit` for the waiting handlers.
    pub(crate) fn drain(&self, limit: Duration) {
        let deadline = Instant::now() + limit;
        while self.waiting.load(Ordering::Acquire) > 0 && Instant::now() < deadline {
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Takes no more messages while the client does not read; false when it has gone.
    fn wait_for_reader(&self, messages: &impl Messages) -> bool {
        while self.writer.is_congested() {
            if self.writer.wait_for_room(Duration::from_millis(200)) {
                break;
            }
            if messages.is_hung_up() {
                return false;
            }
        }
        true
    }

    fn dispatch(&mut self, request: Request) {
        let (id, method) = (request.id().cloned(), request.method().to_owned());
        // None of the framework's own `$/` methods is a request, and it leaves such requests unanswered.
        if let Some(id) = id.clone().filter(|_| method.starts_with("$/")) {
            let message = say!(there_is_no_request, method).into();
            return self.send(Response::from_error(
                id,
                Error {
                    code: ErrorCode::MethodNotFound,
                    message,
                    data: None,
                },
            ));
        }
        let inline = method == "initialize";
        let changed = (method == DID_CHANGE).then(|| {
            let uri = request
                .params()
                .and_then(|params| params.pointer("/textDocument/uri"));
            uri.and_then(Value::as_str).map(str::to_owned)
        });
        let taken = self.inbox.taken();
        let guard = self.runtime.enter();
        let reply = Reply::default();
        let answer = match catch_unwind(AssertUnwindSafe(|| self.service.call(request))) {
            Ok(answer) => Guarded {
                answer: Box::pin(REPLY.scope(reply.clone(), answer)),
            },
            Err(panic) => {
                drop(guard);
                return self.finish(&reply, id, Err(panic));
            }
        };
        drop(guard);
        // `initialize` ends before the next message: a client that sends `didOpen` right after it loses nothing.
        if inline {
            let outcome = self.runtime.block_on(answer);
            return self.finish(&reply, id, outcome);
        }
        let mut answer = answer;
        let first = {
            let _guard = self.runtime.enter();
            Pin::new(&mut answer).poll(&mut Context::from_waker(Waker::noop()))
        };
        match first {
            Poll::Ready(outcome) => {
                let unread = id.is_none()
                    && self.inbox.taken() == taken
                    && is_ours(&method)
                    && matches!(outcome, Ok(Ok(None)));
                if unread {
                    self.inbox.note(say!(was_ignored_for_its_params, method));
                    self.lose(changed.map(|uri| LostChange {
                        uris: uri.into_iter().collect(),
                    }));
                }
                self.finish(&reply, id, outcome);
            }
            Poll::Pending => {
                self.waiting.fetch_add(1, Ordering::AcqRel);
                let (writer, waiting) = (self.writer.clone(), self.waiting.clone());
                self.runtime.spawn(async move {
                    let outcome = answer.await;
                    finish(&writer, &reply, id, outcome);
                    waiting.fetch_sub(1, Ordering::AcqRel);
                });
            }
        }
    }

    fn finish(&mut self, reply: &Reply, id: Option<Id>, outcome: Outcome) {
        if outcome.is_err()
            && let Some(id) = &id
        {
            // The framework remembers the id of a request whose handler never ended; forget it.
            let id = serde_json::to_value(id).unwrap_or_default();
            let cancel = Request::build("$/cancelRequest")
                .params(serde_json::json!({ "id": id }))
                .finish();
            let mut answer = self.service.call(cancel);
            let _ = answer
                .as_mut()
                .poll(&mut Context::from_waker(Waker::noop()));
        }
        finish(&self.writer, reply, id, outcome);
    }

    fn answer_broken(&self, error: Error, position: i64) {
        self.inbox
            .note(say!(a_broken_message_before_byte, position, error.message));
        self.send(Response::from_error(Id::Null, error));
    }

    fn lose(&self, change: Option<LostChange>) {
        if let Some(change) = change {
            self.inbox.lost(change);
        }
    }

    fn send(&self, response: Response) {
        self.writer.send_json(&response);
    }
}

/// The end of a handler: its answer, or its panic.
type Outcome = Result<Result<Option<Response>, ExitedError>, Box<dyn Any + Send>>;

fn finish(writer: &Writer, reply: &Reply, id: Option<Id>, outcome: Outcome) {
    let response = match outcome {
        Ok(Ok(response)) => response,
        Ok(Err(_exited)) => None,
        Err(panic) => {
            let text = panic_text(&*panic);
            tracing::error!("a handler panicked: {text}");
            let message = say!(internal_error, text).into();
            id.map(|id| {
                Response::from_error(
                    id,
                    Error {
                        code: ErrorCode::InternalError,
                        message,
                        data: None,
                    },
                )
            })
        }
    };
    let Some(response) = response else { return };
    match reply.body(&response) {
        Ok(body) => writer.send(body),
        Err(error) => tracing::error!("a reply cannot be written: {error}"),
    }
}

/// The text of a panic.
pub(crate) fn panic_text(panic: &(dyn Any + Send)) -> &str {
    match (panic.downcast_ref::<&str>(), panic.downcast_ref::<String>()) {
        (Some(text), _) => text,
        (_, Some(text)) => text,
        _ => say!(no_reason_given),
    }
}

const DID_CHANGE: &str = "textDocument/didChange";

/// Notifications whose loss must be reported.
fn is_ours(method: &str) -> bool {
    method.starts_with("wedm/")
        || matches!(
            method,
            "textDocument/didOpen" | DID_CHANGE | "textDocument/didClose"
        )
}

/// A handler's future that turns a panic into a value.
struct Guarded {
    answer: Answer,
}

impl Future for Guarded {
    type Output = Outcome;

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Outcome> {
        match catch_unwind(AssertUnwindSafe(|| self.answer.as_mut().poll(context))) {
            Ok(Poll::Pending) => Poll::Pending,
            Ok(Poll::Ready(answer)) => Poll::Ready(Ok(answer)),
            Err(panic) => Poll::Ready(Err(panic)),
        }
    }
}
