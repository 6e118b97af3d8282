//! Long work beside the state thread: a few threads that take jobs in order, over snapshots that nobody changes.

use super::judge::{Job as JudgeJob, Judged};
use super::state::{Mailbox, State};
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
        let progress = Progress {
            to: token.map(|token| (writer.clone(), token)),
        };
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

/// Threads that take jobs in their order: as many as there are jobs, up to a number.
#[derive(Clone)]
struct Pool {
    shared: Arc<(Mutex<Bench>, Condvar)>,
    name: &'static str,
    most: usize,
}

#[derive(Default)]
struct Bench {
    jobs: VecDeque<Job>,
    threads: usize,
    /// Threads that wait for a job.
    idle: usize,
    /// Nobody hands in more: the threads end.
    is_ended: bool,
}

/// A thread that has had nothing to do for this long ends.
const REST: Duration = Duration::from_secs(10);

impl Pool {
    fn new(name: &'static str, most: usize) -> Pool {
        Pool {
            shared: Arc::default(),
            name,
            most,
        }
    }

    fn push(&self, job: Job) {
        let mut bench = self.shared.0.lock().unwrap_or_else(PoisonError::into_inner);
        bench.jobs.push_back(job);
        if bench.idle < bench.jobs.len() && bench.threads < self.most {
            let shared = self.shared.clone();
            match std::thread::Builder::new()
                .name(self.name.into())
                .spawn(move || work(&shared))
            {
                Ok(_) => bench.threads += 1,
                Err(error) => tracing::error!("a worker cannot be started: {error}"),
            }
        }
        drop(bench);
        self.shared.1.notify_one();
    }

    fn end(&self) {
        let mut bench = self.shared.0.lock().unwrap_or_else(PoisonError::into_inner);
        bench.is_ended = true;
        bench.jobs.clear();
        drop(bench);
        self.shared.1.notify_all();
    }
}

/// The worker threads: those that answer requests, and those that judge documents, which wait for no request.
#[derive(Clone)]
pub(super) struct Workers {
    requests: Pool,
    judges: Pool,
    mailbox: Mailbox,
    writer: Writer,
}

/// Documents that are judged side by side: the system shares the processors out among them.
const MOST_JUDGED: usize = 16;

impl Workers {
    pub fn new(mailbox: Mailbox, writer: Writer) -> Workers {
        let count = std::thread::available_parallelism().map_or(2, usize::from);
        // Two at least, so that one long job does not hold up a short one.
        Workers {
            requests: Pool::new("wedm-worker", count.clamp(2, 4)),
            judges: Pool::new("wedm-judge", MOST_JUDGED),
            mailbox,
            writer,
        }
    }

    /// Takes a document through what has come for it and hands it back to `then` on the state thread, whatever comes.
    pub fn judge(&self, job: JudgeJob, then: impl FnOnce(&mut State, Judged) + Send + 'static) {
        let mailbox = self.mailbox.clone();
        self.judges.push(Box::new(move || {
            let judged = job.run();
            mailbox.tell("judging", None, move |state| then(state, judged));
        }));
    }

    /// Runs `job` on a worker, unless it is cancelled before its turn, and hands what came of it, or the text of its panic,
    /// to `then` on the state thread.
    pub fn run<T: Send + 'static>(
        &self,
        name: &'static str,
        cancel: Cancel,
        job: impl FnOnce(&Cancel) -> T + Send + 'static,
        then: impl FnOnce(&mut State, Result<T, String>) + Send + 'static,
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
            let result = catch_unwind(AssertUnwindSafe(|| job(&cancel)))
                .map_err(|panic| panic_text(&*panic).to_owned());
            if let Err(text) = &result {
                tracing::error!("{name} panicked: {text}");
            }
            if !cancel.is_cancelled() {
                mailbox.tell(name, None, move |state| then(state, result));
            }
        });
        self.requests.push(job);
    }
}

impl Workers {
    /// Ends each thread behind the job that it is at.
    pub fn end(&self) {
        self.requests.end();
        self.judges.end();
    }
}

fn work((bench, filled): &(Mutex<Bench>, Condvar)) {
    loop {
        let mut guard = bench.lock().unwrap_or_else(PoisonError::into_inner);
        let job = loop {
            if let Some(job) = guard.jobs.pop_front() {
                break job;
            }
            guard.idle += 1;
            let (woken, timeout) = filled
                .wait_timeout(guard, REST)
                .unwrap_or_else(PoisonError::into_inner);
            guard = woken;
            guard.idle -= 1;
            if guard.is_ended || (timeout.timed_out() && guard.jobs.is_empty()) {
                guard.threads -= 1;
                return;
            }
        };
        drop(guard);
        if catch_unwind(AssertUnwindSafe(job)).is_err() {
            tracing::error!("a worker's job panicked outside its guard");
        }
    }
}
