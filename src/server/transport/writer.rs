//! The one thread that writes to the client, and the queue before it.
//!
//! Diagnostics wait in a slot for each document, where newer ones replace older ones; everything else waits in order.
//! The reading thread pauses while too much waits: a client that stops reading cannot make memory grow.

use super::Written;
use rustc_hash::FxHashMap;
use serde::Serialize;
use std::collections::VecDeque;
use std::io::Write;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// While more bytes than this wait, no more messages are taken from the client.
const BACKLOG: usize = 32 * 1024 * 1024;

/// Bodies up to this length are copied after their header; longer ones are not held twice.
const ONE_WRITE: usize = 1024 * 1024;

/// Params of `textDocument/publishDiagnostics`. The URI is the client's own spelling.
#[derive(Clone, Debug)]
pub(crate) struct Publish {
    pub(crate) uri: Arc<str>,
    pub(crate) version: Option<i64>,
    /// An array.
    pub(crate) diagnostics: Written,
    /// Must not be superseded: the one publish that has to follow an opening or a closing.
    pub(crate) owed: bool,
}

/// Where messages go.
pub(crate) trait Output: Send + 'static {
    /// Hands a whole JSON body over, and waits while the client takes no more.
    fn message(&mut self, body: Vec<u8>) -> std::io::Result<()>;
}

/// A stream, in which each body has its header.
impl<W: Write + Send + 'static> Output for W {
    fn message(&mut self, body: Vec<u8>) -> std::io::Result<()> {
        let header = format!("Content-Length: {}\r\n\r\n", body.len());
        // One write for header and body: readers then wake once.
        if body.len() <= ONE_WRITE {
            self.write_all(&[header.as_bytes(), &body].concat())?;
        } else {
            self.write_all(header.as_bytes())?;
            self.write_all(&body)?;
        }
        self.flush()
    }
}

/// Handle to the writing thread.
#[derive(Clone)]
pub(crate) struct Writer {
    shared: Arc<Shared>,
}

#[derive(Default)]
struct Shared {
    queue: Mutex<Queue>,
    /// There is something to write.
    filled: Condvar,
    /// Something has been written.
    emptied: Condvar,
}

#[derive(Default)]
struct Queue {
    waiting: VecDeque<Waiting>,
    /// The newest unwritten diagnostics of a document that may still be superseded, and the ticket of their place in
    /// line.
    slots: FxHashMap<Arc<str>, (u64, Publish)>,
    tickets: u64,
    bytes: usize,
    writing: bool,
    /// Nothing more comes: the thread ends when all is written.
    ended: bool,
}

enum Waiting {
    Message(Vec<u8>),
    Owed(Publish),
    Slot(Arc<str>, u64),
}

impl Shared {
    fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Publish {
    fn size(&self) -> usize {
        self.diagnostics.json().len()
    }

    /// The whole message.
    fn body(&self) -> serde_json::Result<Vec<u8>> {
        let method = "textDocument/publishDiagnostics";
        let uri = serde_json::to_string(&self.uri)?;
        let version = self
            .version
            .map(|version| format!(r#""version":{version},"#));
        let head = format!(
            r#"{{"jsonrpc":"2.0","method":"{method}","params":{{"uri":{uri},{}"diagnostics":"#,
            version.unwrap_or_default()
        );
        Ok([head.as_bytes(), self.diagnostics.json(), b"}}"].concat())
    }
}

impl Writer {
    /// Starts the thread. `failed` is called when the client cannot be written to any more.
    pub(crate) fn start(
        output: impl Output,
        failed: impl FnOnce() + Send + 'static,
    ) -> std::io::Result<Writer> {
        let shared = Arc::new(Shared::default());
        let writer = Writer {
            shared: shared.clone(),
        };
        std::thread::Builder::new()
            .name("wedm-writer".into())
            .spawn(move || {
                if write_all(&shared, output).is_err() {
                    failed();
                }
            })?;
        Ok(writer)
    }

    /// Queues a whole JSON body.
    pub(crate) fn send(&self, body: Vec<u8>) {
        let mut queue = self.shared.queue();
        queue.bytes += body.len();
        queue.waiting.push_back(Waiting::Message(body));
        self.shared.filled.notify_one();
    }

    /// Queues any message that serializes.
    pub(crate) fn send_json(&self, message: &impl Serialize) {
        match serde_json::to_vec(message) {
            Ok(body) => self.send(body),
            Err(error) => tracing::error!("a message cannot be written: {error}"),
        }
    }

    /// Queues a notification.
    pub(crate) fn notify(&self, method: &str, params: impl Serialize) {
        self.send_json(&Notification {
            jsonrpc: "2.0",
            method,
            params,
        });
    }

    /// Queues diagnostics in place of unwritten older ones of the same document, unless those must be written.
    pub(crate) fn publish(&self, publish: Publish) {
        let mut queue = self.shared.queue();
        let uri = publish.uri.clone();
        queue.bytes += publish.size();
        if publish.owed {
            // Unwritten ones are out of date now, and must not come after these.
            if let Some((_, old)) = queue.slots.remove(&uri) {
                queue.bytes -= old.size();
            }
            queue.waiting.push_back(Waiting::Owed(publish));
        } else if let Some((_, slot)) = queue.slots.get_mut(&uri) {
            let old = std::mem::replace(slot, publish);
            queue.bytes -= old.size();
        } else {
            queue.tickets += 1;
            let ticket = queue.tickets;
            queue.slots.insert(uri.clone(), (ticket, publish));
            queue.waiting.push_back(Waiting::Slot(uri, ticket));
        }
        self.shared.filled.notify_one();
    }

    /// True while too much waits for the client.
    pub(crate) fn is_congested(&self) -> bool {
        self.shared.queue().bytes > BACKLOG
    }

    /// Waits at most `limit` until little enough is queued; true if so.
    pub(crate) fn wait_for_room(&self, limit: Duration) -> bool {
        self.wait(limit, |queue| queue.bytes <= BACKLOG)
    }

    /// Waits until everything has been written, at most `limit`; then the thread ends.
    pub(crate) fn end(&self, limit: Duration) {
        self.wait(limit, |queue| queue.waiting.is_empty() && !queue.writing);
        self.shared.queue().ended = true;
        self.shared.filled.notify_one();
    }

    fn wait(&self, limit: Duration, done: impl Fn(&Queue) -> bool) -> bool {
        let deadline = Instant::now() + limit;
        let mut queue = self.shared.queue();
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            if done(&queue) || left.is_zero() {
                return done(&queue);
            }
            queue = self
                .shared
                .emptied
                .wait_timeout(queue, left)
                .unwrap_or_else(PoisonError::into_inner)
                .0;
        }
    }
}

#[derive(Serialize)]
struct Notification<'a, P> {
    jsonrpc: &'static str,
    method: &'a str,
    params: P,
}

/// Writes until the client's end is gone.
fn write_all(shared: &Shared, mut output: impl Output) -> std::io::Result<()> {
    loop {
        let mut queue = shared.queue();
        queue.writing = false;
        shared.emptied.notify_all();
        let next = loop {
            match queue.waiting.pop_front() {
                Some(Waiting::Message(body)) => {
                    queue.bytes -= body.len();
                    break Next::Body(body);
                }
                Some(Waiting::Owed(publish)) => {
                    queue.bytes -= publish.size();
                    break Next::Publish(publish);
                }
                // A place in the queue whose diagnostics were superseded by owed ones is empty.
                Some(Waiting::Slot(uri, ticket)) => {
                    if queue.slots.get(&uri).is_some_and(|(own, _)| *own == ticket)
                        && let Some((_, publish)) = queue.slots.remove(&uri)
                    {
                        queue.bytes -= publish.size();
                        break Next::Publish(publish);
                    }
                }
                None if queue.ended => return Ok(()),
                None => {
                    queue = shared
                        .filled
                        .wait(queue)
                        .unwrap_or_else(PoisonError::into_inner)
                }
            }
        };
        queue.writing = true;
        drop(queue);
        match next {
            Next::Body(body) => {
                let is_long = body.len() > ONE_WRITE;
                output.message(body)?;
                if is_long {
                    super::memory::give_back();
                }
            }
            Next::Publish(publish) => {
                output.message(publish.body().map_err(std::io::Error::other)?)?;
            }
        }
    }
}

enum Next {
    Body(Vec<u8>),
    Publish(Publish),
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;

    /// Takes one write, then waits until it may take more.
    struct Gate {
        open: mpsc::Receiver<()>,
        seen: mpsc::Sender<String>,
    }

    impl Write for Gate {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            let _ = self.open.recv();
            let text = String::from_utf8_lossy(bytes);
            let _ = self.seen.send(
                text.split_once("\r\n\r\n")
                    .map_or_else(String::new, |(_, body)| body.into()),
            );
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn newer_diagnostics_take_the_place_of_unwritten_older_ones_but_not_of_owed_ones() {
        let (open, gate) = mpsc::channel();
        let (seen, written) = mpsc::channel();
        let writer = Writer::start(Gate { open: gate, seen }, || {}).unwrap();
        let publish = |uri: &str, version: i64, owed: bool| Publish {
            uri: uri.into(),
            version: Some(version),
            diagnostics: Written::default(),
            owed,
        };
        writer.send(b"first".to_vec());
        while !writer.shared.queue().waiting.is_empty() {
            std::thread::yield_now();
        }
        writer.publish(publish("a", 1, true));
        for version in 2..100 {
            writer.publish(publish("a", version, false));
            writer.publish(publish("b", version, false));
        }
        writer.publish(publish("b", 100, true));
        writer.publish(publish("b", 101, false));
        writer.send(b"last".to_vec());
        drop(open);
        writer.end(Duration::from_secs(10));
        let versions: Vec<String> = written
            .try_iter()
            .map(
                |body| match serde_json::from_str::<serde_json::Value>(&body) {
                    Ok(message) => format!(
                        "{} {}",
                        message["params"]["uri"].as_str().unwrap(),
                        message["params"]["version"]
                    ),
                    Err(_) => body,
                },
            )
            .collect();
        assert_eq!(versions, ["first", "a 1", "a 99", "b 100", "b 101", "last"]);
    }
}
