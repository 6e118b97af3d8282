//! The language server: LSP and the `wedm/` name space over standard input and output.
//!
//! The transport reads and writes, the state thread owns every document, workers do long work. Nothing is decided here
//! that the core could decide.

mod beside;
mod changes;
mod client;
mod config;
mod content;
mod context;
mod convert;
mod drawings;
mod errors;
mod handlers;
mod jobs;
mod judge;
mod kind;
mod links;
mod looks;
mod methods;
mod open;
mod opening;
mod parent;
mod partner;
mod projects;
mod settings;
mod state;
mod texts;
mod token_memory;
mod transport;

#[cfg(feature = "testing")]
pub use transport::{Frame, Frames};

pub(crate) use config::{path_of, uri_of};

use crate::disk::Fence;
use serde_json::Value;
use state::Mailbox;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use tokio::sync::mpsc::{Receiver, Sender};
use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;
use transport::{FromClient, Inbox, LostChange, Messages, ToClient, Transport, Writer};

/// How the server is run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    /// End when the process that `initialize` names has died. Off where the process number means
    /// nothing, as in a container.
    pub(crate) watch_parent: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options { watch_parent: true }
    }
}

/// Exit code after `shutdown`, and without it.
const GOOD_END: u8 = 0;
const BAD_END: u8 = 1;

/// How long the end waits for answers, and for the client to read them; together below the second that the protocol
/// grants.
const LAST_ANSWERS: Duration = Duration::from_millis(400);
const LAST_WRITES: Duration = Duration::from_millis(400);

/// Serves the client on standard input and output until `exit` or the end of the input: 0 after `shutdown`, else 1.
pub(crate) fn run_stdio(options: Options) -> ExitCode {
    log_to_stderr();
    match serve(options) {
        Ok(code) => ExitCode::from(code),
        Err(error) => {
            tracing::error!("the server cannot start: {error}");
            ExitCode::from(BAD_END)
        }
    }
}

fn serve(options: Options) -> std::io::Result<u8> {
    let (input, output) = transport::pipes()?;
    let writer = Writer::start(output, || end_of_process(BAD_END))?;
    let flags = Arc::new(methods::Flags::default());
    let orphaned: Option<fn()> = options.watch_parent.then_some(|| end_of_process(BAD_END));
    // Held to the end: threads that still work are not waited for.
    let _transport = serve_between(
        &mut transport::Frames::new(input),
        &writer,
        &flags,
        orphaned,
        Fence::default(),
        [LAST_ANSWERS, LAST_WRITES],
    )?;
    end_of_process(if flags.shut_down.load(Ordering::Acquire) {
        GOOD_END
    } else {
        BAD_END
    })
}

/// Serves a client whose messages come whole, until it says `exit` or no more come; nothing beyond the fence is read but
/// settings above it. The process goes on. Both queues should be short: what waits for the client waits before them.
///
/// # Errors
/// Where a thread cannot be started.
pub(crate) fn serve_messages(
    from_client: Receiver<Vec<u8>>,
    to_client: Sender<Vec<u8>>,
    fence: Fence,
) -> std::io::Result<()> {
    let writer = Writer::start(ToClient(to_client), || {})?;
    let mut messages = FromClient::new(from_client);
    let patience = [LAST_ANSWERS, LAST_WRITES];
    serve_between(
        &mut messages,
        &writer,
        &Arc::default(),
        None,
        fence,
        patience,
    )
    .map(drop)
}

/// Serves a client to the end of its messages, then waits for the last answers and for the client to read them.
fn serve_between(
    messages: &mut impl Messages,
    writer: &Writer,
    flags: &Arc<methods::Flags>,
    orphaned: Option<fn()>,
    fence: Fence,
    [last_answers, last_writes]: [Duration; 2],
) -> std::io::Result<Transport<methods::Backend, ToState>> {
    let mailbox = state::start(writer.clone(), fence, drawings::does_not_apply)?;
    let service = methods::service(mailbox.clone(), flags.clone(), orphaned);
    let inbox = ToState {
        mailbox: mailbox.clone(),
        flags: flags.clone(),
    };
    let mut transport = Transport::new(service, inbox, writer.clone())?;
    transport.serve(messages);
    transport.drain(last_answers);
    let (done, all_told) = std::sync::mpsc::channel();
    // The queue may be full and its thread busy: the thread that ends the process must not wait for it.
    std::thread::spawn(move || mailbox.tell("exit", None, move |state| state.stop(done)));
    let _ = all_told.recv_timeout(last_answers / 4);
    writer.end(last_writes);
    Ok(transport)
}

/// A whole server between two streams, for tests and fuzz targets, which wait for all that it has to say.
///
/// # Errors
/// Where a thread cannot be started.
#[cfg(feature = "testing")]
pub fn serve_here(
    input: impl std::io::Read,
    output: impl std::io::Write + Send + 'static,
) -> std::io::Result<()> {
    let writer = Writer::start(output, || {})?;
    // Longer than anything in a test takes: an answer that has not come by then will never come.
    let patience = Duration::from_secs(20);
    let mut messages = transport::Frames::new(input);
    let fence = Fence::default();
    serve_between(
        &mut messages,
        &writer,
        &Arc::default(),
        None,
        fence,
        [patience; 2],
    )
    .map(drop)
}

fn end_of_process(code: u8) -> ! {
    std::process::exit(code.into())
}

/// The transport's way to the state thread.
struct ToState {
    mailbox: Mailbox,
    flags: Arc<methods::Flags>,
}

impl Inbox for ToState {
    fn reply(&self, id: String, result: Result<Value, Value>) {
        self.mailbox.tell("reply", None, move |state| {
            if let Some(act) = state.client.answered(&id, result) {
                act(state);
            }
        });
    }

    fn note(&self, text: String) {
        self.mailbox.tell("note", None, move |state| {
            state.client.log(client::Weight::Warning, text)
        });
    }

    fn lost(&self, change: LostChange) {
        self.mailbox.tell("lost", None, move |state| {
            texts::lost(state, &change);
        });
    }

    fn taken(&self) -> usize {
        self.flags.taken.load(Ordering::Relaxed)
    }
}

/// Logs to stderr by `WEDM_LOG`, warnings and worse by default. Standard output belongs to the protocol.
pub(crate) fn log_to_stderr() {
    let said = std::env::var("WEDM_LOG").ok();
    let filter: Targets = said
        .and_then(|said| said.parse().ok())
        .unwrap_or_else(|| Targets::new().with_default(LevelFilter::WARN));
    let lines = tracing_subscriber::fmt::layer()
        .with_writer(std::io::stderr)
        .with_ansi(false);
    let _ = tracing_subscriber::registry()
        .with(filter)
        .with(lines)
        .try_init();
}
