//! Long work beside the state thread: a few threads that take jobs in order, over immutable snapshots.

use super::transport::Writer;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Progress of one request, where the client gave a token for it. Ends when it is dropped.
pub(super) struct Progress {
    to: Option<(Writer, Value)>,
}

impl Progress {
    /// `params` are those of the request, which may hold a `workDoneToken`.
    pub(crate) fn begin(writer: &Writer, token: Option<Value>, title: &str) -> Progress {
        let progress = Progress {
            to: token.map(|token| (writer.clone(), token)),
        };
        progress.send(json!({ "kind": "begin", "title": title, "cancellable": true }));
        progress
    }

    pub(crate) fn report(&self, message: &str) {
        self.send(json!({ "kind": "report", "message": message }));
    }

    /// `done` of `all`.
    pub(crate) fn share(&self, message: &str, done: usize, all: usize) {
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

/// Threads that take jobs in their order: as many as there are jobs, up to a limit.
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
    /// No more jobs come: the threads end.
    is_ended: bool,
}

/// A thread without work for this long ends.
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

/// The worker threads: those that answer requests, short ones apart from long ones, and those that judge documents.
#[derive(Clone)]
pub(super) struct Workers {
    requests: Pool,
    /// Questions about one place wait for no long work.
    places: Pool,
    judges: Pool,
    writer: Writer,
}

/// The number of documents that are judged in parallel: the system shares the processors among them.
const MOST_JUDGED: usize = 16;

impl Workers {
    pub(crate) fn new(writer: Writer) -> Workers {
        let count = std::thread::available_parallelism().map_or(2, usize::from);
        // Two at least, so that one long job does not hold up a short one.
        let count = count.clamp(2, 4);
        Workers {
            requests: Pool::new("wedm-worker", count),
            places: Pool::new("wedm-place", count),
            judges: Pool::new("wedm-judge", MOST_JUDGED),
            writer,
        }
    }

    /// Runs the judging of a document, however many answers are being made.
    pub(crate) fn judge(&self, job: impl FnOnce() + Send + 'static) {
        self.judges.push(Box::new(job));
    }

    /// Runs a request's job on a worker, unless its answer is no longer wanted when its turn comes.
    pub(crate) fn run(
        &self,
        is_about_a_place: bool,
        is_wanted: impl Fn() -> bool + Send + 'static,
        job: impl FnOnce() + Send + 'static,
    ) {
        let writer = self.writer.clone();
        let pool = if is_about_a_place {
            &self.places
        } else {
            &self.requests
        };
        pool.push(Box::new(move || {
            // Results wait here and not in memory while the client does not read.
            while writer.is_congested() && is_wanted() {
                writer.wait_for_room(Duration::from_millis(200));
            }
            if is_wanted() {
                job();
            }
        }));
    }

    /// Ends each thread after its current job.
    pub(crate) fn end(&self) {
        self.requests.end();
        self.places.end();
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
