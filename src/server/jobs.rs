//! Long work beside the state thread: a few threads that take jobs in order, over snapshots that nobody changes.

use super::state::Mailbox;
use super::transport::{Writer, panic_text};
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Set when nobody wants the result any more.
#[derive(Clone, Default)]
pub(super) struct Cancel(Arc<AtomicBool>);

impl Cancel {
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Cancels when it is dropped: with the handler's future, when the client cancels its request.
    pub fn on_drop(&self) -> CancelOnDrop {
        CancelOnDrop(self.clone())
    }
}

pub(super) struct CancelOnDrop(Cancel);

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.0.store(true, Ordering::Relaxed);
    }
}

/// Reports on one request, where the client gave a token for it. Ends when it is dropped.
pub(super) struct Progress {
    to: Option<(Writer, Value)>,
}

impl Progress {
    /// `params` are those of the request, which may hold a `workDoneToken`.
    pub fn begin(writer: &Writer, token: Option<Value>, title: &str) -> Progress {
        let progress = Progress { to: token.map(|token| (writer.clone(), token)) };
        progress.send(json!({ "kind": "begin", "title": title, "cancellable": true }));
        progress
    }

    pub fn report(&self, message: &str) {
        self.send(json!({ "kind": "report", "message": message }));
    }

    /// `done` of `all`.
    pub fn share(&self, message: &str, done: usize, all: usize) {
        let percentage = done.min(all) * 100 / all.max(1);
        self.send(json!({ "kind": "report", "message": message, "percentage": percentage }));
    }

    fn send(&self, value: Value) {
        if let Some((writer, token)) = &self.to {
            writer.notify("$/progress", json!({ "token": token, "value": value }));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.send(json!({ "kind": "end" }));
    }
}

type Job = Box<dyn FnOnce() + Send>;

#[derive(Default)]
struct Queue {
    jobs: Mutex<VecDeque<Job>>,
    filled: Condvar,
    /// Nobody hands in more: the threads end.
    ended: AtomicBool,
}

/// The worker threads.
#[derive(Clone)]
pub(super) struct Workers {
    queue: Arc<Queue>,
    mailbox: Mailbox,
    writer: Writer,
}

impl Workers {
    /// Starts the threads: two at least, so that one long job does not hold up a short one.
    pub fn start(mailbox: Mailbox, writer: Writer) -> std::io::Result<Workers> {
        let queue = Arc::new(Queue::default());
        let count = std::thread::available_parallelism().map_or(2, usize::from).clamp(2, 4);
        for number in 0..count {
            let queue = queue.clone();
            std::thread::Builder::new().name(format!("wedm-worker-{number}")).spawn(move || work(&queue))?;
        }
        Ok(Workers { queue, mailbox, writer })
    }

    /// Runs `job` on a worker, unless it is cancelled before its turn, and hands what came of it, or the text of its panic,
    /// to `then` on the state thread.
    pub fn run<T: Send + 'static>(
        &self,
        name: &'static str,
        cancel: Cancel,
        job: impl FnOnce(&Cancel) -> T + Send + 'static,
        then: impl FnOnce(&mut super::state::State, Result<T, String>) + Send + 'static,
    ) {
        let (mailbox, writer) = (self.mailbox.clone(), self.writer.clone());
        let job: Job = Box::new(move || {
            if cancel.is_cancelled() {
                return;
            }
            // Results wait here and not in memory while the client does not read.
            while writer.is_congested() && !cancel.is_cancelled() {
                writer.wait_for_room(Duration::from_millis(200));
            }
            let result = catch_unwind(AssertUnwindSafe(|| job(&cancel))).map_err(|panic| panic_text(&*panic).to_owned());
            if let Err(text) = &result {
                tracing::error!("{name} panicked: {text}");
            }
            if !cancel.is_cancelled() {
                mailbox.tell(name, None, move |state| then(state, result));
            }
        });
        self.queue.jobs.lock().unwrap_or_else(PoisonError::into_inner).push_back(job);
        self.queue.filled.notify_one();
    }
}

impl Workers {
    /// Ends each thread behind the job that it is at.
    pub fn end(&self) {
        let jobs = self.queue.jobs.lock().unwrap_or_else(PoisonError::into_inner);
        self.queue.ended.store(true, Ordering::Relaxed);
        drop(jobs);
        self.queue.filled.notify_all();
    }
}

fn work(queue: &Queue) {
    loop {
        let mut jobs = queue.jobs.lock().unwrap_or_else(PoisonError::into_inner);
        let job = loop {
            match jobs.pop_front() {
                _ if queue.ended.load(Ordering::Relaxed) => return,
                Some(job) => break job,
                None => jobs = queue.filled.wait(jobs).unwrap_or_else(PoisonError::into_inner),
            }
        };
        drop(jobs);
        if catch_unwind(AssertUnwindSafe(job)).is_err() {
            tracing::error!("a worker's job panicked outside its guard");
        }
    }
}
