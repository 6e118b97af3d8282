//! The one thread that owns every document.
//!
//! Handlers and workers hand it closures in order. It drains them before it judges what has changed, so that a burst of
//! edits costs one publish. A closure that panics costs its own request, but no document.

use super::client::{Client, Weight};
use super::config::Config;
use super::content::Content;
use super::convert::{settings_diagnostics, written};
use super::jobs::Workers;
use super::judge::{Job, Judged, Task};
use super::links::Links;
use super::looks::Looks;
use super::open::Open;
use super::transport::{Publish, Writer, give_back, panic_text};
use crate::disk::Fence;
use crate::text::Encoding;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};
use tower_lsp::jsonrpc;

/// The most messages that may wait; beyond it the sender waits.
const QUEUE: usize = 1024;
/// A flood of messages is interrupted after this long to publish the present state.
const TURN: Duration = Duration::from_millis(50);
/// A turn longer than this is logged.
const LONG_TURN: Duration = Duration::from_millis(100);

/// The channel for the answer to a request. Dropped unanswered, it becomes an internal error.
pub(super) type Reply<T> = tokio::sync::oneshot::Sender<jsonrpc::Result<T>>;

struct Message {
    name: &'static str,
    /// The document that the message is about.
    about: Option<Arc<str>>,
    /// It changes that document without reading it.
    changes: bool,
    act: Box<dyn FnOnce(&mut State) + Send>,
}

/// The way to the state thread.
#[derive(Clone)]
pub(super) struct Mailbox {
    sender: SyncSender<Message>,
}

impl Mailbox {
    /// Hands `act` to the state thread. Does nothing once that has ended.
    pub(crate) fn tell(
        &self,
        name: &'static str,
        about: Option<Arc<str>>,
        act: impl FnOnce(&mut State) + Send + 'static,
    ) {
        let _ = self.sender.send(Message {
            name,
            about,
            changes: false,
            act: Box::new(act),
        });
    }

    /// The same for changes that do not read the document: several of these are judged together.
    pub(crate) fn tell_change(
        &self,
        name: &'static str,
        about: Arc<str>,
        act: impl FnOnce(&mut State) + Send + 'static,
    ) {
        let _ = self.sender.send(Message {
            name,
            about: Some(about),
            changes: true,
            act: Box::new(act),
        });
    }
}

pub(super) struct State {
    pub(crate) client: Client<State>,
    pub(crate) config: Arc<Config>,
    pub(crate) encoding: Encoding,
    pub(crate) workers: Workers,
    /// Returns judged documents from workers.
    pub(crate) mailbox: Mailbox,
    /// Acts when a change does not fit its drawing.
    refuse_change: RefuseChange,
    pub(crate) documents: FxHashMap<Arc<str>, Open>,
    /// Drawings that the client has been asked to send again.
    pub(crate) resending: FxHashSet<Arc<str>>,
    /// Documents to be judged and published, in the order of their changes.
    pub(crate) dirty: Vec<Arc<str>>,
    /// Documents with changed settings: they are judged when there is nothing else to do, a few at a time.
    pub(crate) unsettled: VecDeque<Arc<str>>,
    /// Open texts of project files, by their paths.
    pub(crate) settings_texts: FxHashMap<PathBuf, Arc<str>>,
    /// Which documents belong to each other.
    pub(crate) links: Links,
    /// Messages about documents that a worker has, in their order.
    waiting: FxHashMap<Arc<str>, VecDeque<Message>>,
    /// Documents that a worker has.
    away: usize,
    /// Workers that look for the projects' files.
    pub(crate) looks: Looks<State>,
    /// Files on disk whose errors the client is shown.
    pub(crate) shown_files: FxHashSet<PathBuf>,
    stamp: u64,
    stopped: Option<std::sync::mpsc::Sender<()>>,
}

/// Takes the drawing's URI and the reason.
type RefuseChange = fn(&mut State, &Arc<str>, &str);

/// Starts the state thread.
pub(super) fn start(
    writer: Writer,
    fence: Fence,
    refuse_change: RefuseChange,
) -> std::io::Result<Mailbox> {
    let (sender, receiver) = sync_channel(QUEUE);
    let mailbox = Mailbox { sender };
    let workers = Workers::new(writer.clone());
    let state = State {
        client: Client::new(writer),
        config: Arc::new(Config::within(fence)),
        encoding: Encoding::default(),
        workers,
        mailbox: mailbox.clone(),
        refuse_change,
        documents: FxHashMap::default(),
        resending: FxHashSet::default(),
        dirty: Vec::new(),
        unsettled: VecDeque::new(),
        settings_texts: FxHashMap::default(),
        links: Links::default(),
        waiting: FxHashMap::default(),
        away: 0,
        looks: Looks::default(),
        shown_files: FxHashSet::default(),
        stamp: 0,
        stopped: None,
    };
    std::thread::Builder::new()
        .name("wedm-state".into())
        .spawn(move || state.run(&receiver))?;
    Ok(mailbox)
}

impl State {
    fn run(mut self, inbox: &Receiver<Message>) {
        loop {
            let first = match self.client.next_deadline() {
                // New settings of a document may have changed what lies beside it.
                _ if !(self.dirty.is_empty() && self.unsettled.is_empty()) => {
                    inbox.recv_timeout(Duration::ZERO)
                }
                None => inbox.recv().map_err(|_| RecvTimeoutError::Disconnected),
                Some(deadline) => {
                    inbox.recv_timeout(deadline.saturating_duration_since(Instant::now()))
                }
            };
            let began = Instant::now();
            let mut name = "time-out";
            match first {
                Ok(message) => {
                    name = message.name;
                    self.handle(message);
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
            while began.elapsed() < TURN
                && let Ok(message) = inbox.try_recv()
            {
                self.handle(message);
            }
            while let Some(act) = self.client.expired() {
                act(&mut self);
            }
            self.judge_dirty();
            self.judge_unsettled();
            self.look_beside();
            if began.elapsed() > LONG_TURN {
                tracing::info!(
                    "a turn that began with {name} took {} ms",
                    began.elapsed().as_millis()
                );
            }
            if self.away == 0
                && self.unsettled.is_empty()
                && self.links.is_at_rest()
                && self.looks.is_at_rest()
                && let Some(done) = self.stopped.take()
            {
                self.workers.end();
                let _ = done.send(());
                return;
            }
        }
    }

    /// Acts on a message, or lets it wait where a worker has its document: messages about one document keep their
    /// order.
    fn handle(&mut self, message: Message) {
        match message
            .about
            .clone()
            .filter(|uri| self.waiting.contains_key(uri) || self.is_busy(uri, message.changes))
        {
            Some(uri) => self.waiting.entry(uri).or_default().push_back(message),
            None => self.act_on(message),
        }
    }

    fn act_on(&mut self, message: Message) {
        let Message {
            name, about, act, ..
        } = message;
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| act(self))) {
            tracing::error!("{name} panicked: {}", panic_text(&*panic));
            self.client.log(
                Weight::Warning,
                say!(internal_error_in_a_method, name, panic_text(&*panic)),
            );
            if let Some(uri) = about {
                self.rebuild(&uri);
            }
        }
    }

    /// Does `act` after all earlier messages about a document.
    pub(crate) fn in_turn(
        &mut self,
        name: &'static str,
        about: Arc<str>,
        act: impl FnOnce(&mut State) + Send + 'static,
    ) {
        self.handle(Message {
            name,
            about: Some(about),
            changes: false,
            act: Box::new(act),
        });
    }

    /// Does `act` before all messages that wait about a document, once no worker has it.
    pub(crate) fn first_in_turn(
        &mut self,
        name: &'static str,
        about: Arc<str>,
        act: impl FnOnce(&mut State) + Send + 'static,
    ) {
        let waiting = self.waiting.entry(about.clone()).or_default();
        waiting.push_front(Message {
            name,
            about: Some(about.clone()),
            changes: false,
            act: Box::new(act),
        });
        self.go_on(&about);
    }

    /// True where a worker has a document or looks for its settings. A changed document is judged before it is read.
    fn is_busy(&mut self, uri: &Arc<str>, changes: bool) -> bool {
        if self.looks.hold(uri) {
            return true;
        }
        if !changes
            && self
                .documents
                .get(uri)
                .is_some_and(|open| !open.is_away() && !open.tasks.is_empty())
        {
            self.judge(uri);
        }
        self.documents.get(uri).is_some_and(Open::is_away)
    }

    /// Answers when everything before has been handled and published; then the threads end.
    pub(crate) fn stop(&mut self, done: std::sync::mpsc::Sender<()>) {
        self.stopped = Some(done);
    }

    pub(crate) fn next_stamp(&mut self) -> u64 {
        self.stamp += 1;
        self.stamp
    }

    /// Drops everything derived from a document, never its text, and derives it again.
    fn rebuild(&mut self, uri: &Arc<str>) {
        if self.documents.get(uri).is_some_and(|open| {
            matches!(open.content, Content::Settings(_) | Content::Foreign) && open.tasks.is_empty()
        }) {
            self.mark_dirty(uri);
        } else {
            self.add_task(uri, Task::Rebuild);
        }
    }

    /// Adds a change to a document, and has it judged.
    pub(crate) fn add_task(&mut self, uri: &Arc<str>, task: Task) {
        if let Some(open) = self.documents.get_mut(uri) {
            open.tasks.push(task);
            self.mark_dirty(uri);
        }
    }

    /// Marks a document as changed: results for the earlier state are out of date.
    pub(crate) fn give_stamp(&mut self, uri: &Arc<str>) {
        let stamp = self.next_stamp();
        if let Some(open) = self.documents.get_mut(uri) {
            open.set_stamp(stamp);
        }
    }

    /// Marks a document as changed, and publishes it again.
    pub(crate) fn mark_dirty(&mut self, uri: &Arc<str>) {
        self.give_stamp(uri);
        if let Some(open) = self.documents.get_mut(uri)
            && !std::mem::replace(&mut open.is_dirty, true)
        {
            // Uses the document's own copy of the name: one allocation for each document.
            self.dirty.push(open.uri.clone());
        }
    }

    fn judge_dirty(&mut self) {
        // The partners of a judged document may be judged again for it.
        while !self.dirty.is_empty() {
            for uri in std::mem::take(&mut self.dirty) {
                if self
                    .documents
                    .get(&uri)
                    .is_some_and(|open| open.is_dirty && !open.is_away())
                {
                    self.judge(&uri);
                }
            }
        }
    }

    /// Makes a document's pending changes: small work here, the rest on a worker.
    pub(crate) fn judge(&mut self, uri: &Arc<str>) {
        let beside = self.beside_of(uri);
        let wants_form = self.is_compared(uri);
        let Some(open) = self.documents.get_mut(uri) else {
            return;
        };
        open.is_dirty = false;
        let job = Job {
            uri: open.uri.clone(),
            version: open.version,
            content: std::mem::replace(&mut open.content, Content::Away),
            tasks: std::mem::take(&mut open.tasks),
            settings: open.settings.clone(),
            encoding: self.encoding,
            shows_related: self.client.abilities.related_information,
            is_slow: open.is_slow,
            beside,
            wants_form,
            has_form: open.form.is_some(),
        };
        if job.is_small() {
            let judged = job.run();
            self.take_back(judged);
        } else {
            self.away += 1;
            let reads = job.reads();
            let work = move || {
                let judged = job.run();
                // Before the findings are told: whoever has been answered sees what the document takes from now on.
                if reads {
                    give_back();
                }
                judged
            };
            self.on_a_worker("judging", work, |state, judged| {
                state.away -= 1;
                let uri = judged.uri.clone();
                state.take_back(judged);
                state.go_on(&uri);
            });
        }
    }

    /// Takes back a document and publishes its findings.
    fn take_back(&mut self, judged: Judged) {
        let Judged {
            uri,
            version,
            content,
            told,
            is_slow,
            remarks,
            refused,
            is_other,
            form,
        } = judged;
        let Some(open) = self.documents.get_mut(&uri) else {
            return;
        };
        (open.version, open.content, open.is_slow) = (version, content, is_slow);
        let is_form_new = (is_other || form.is_some()) && open.form != form;
        if is_form_new {
            open.form = form;
        }
        if let Some((diagnostics, findings)) = told {
            open.findings = findings;
            // The faults in a project's file depend on the client's settings as well.
            let diagnostics = match &open.content {
                Content::Settings(text) => written(&settings_diagnostics(
                    text,
                    &self.config.errors_in(&text.as_str_lossy()),
                    self.encoding,
                )),
                _ => diagnostics,
            };
            let owed = !std::mem::replace(&mut open.published, true);
            let has_drawing =
                |open: &Open| open.document().is_some_and(|it| it.drawing().is_some());
            if owed && has_drawing(open) && !open.content.is_small() {
                open.tasks.push(Task::Ready);
            }
            self.client.writer().publish(Publish {
                uri: uri.clone(),
                version: Some(version),
                diagnostics,
                owed,
            });
        }
        // The messages that came while it was away.
        if open.is_dirty || !open.tasks.is_empty() {
            open.is_dirty = true;
            self.dirty.push(uri.clone());
        }
        if is_other {
            self.ask_beside(&uri);
        }
        if is_form_new {
            self.poke_partners(&uri);
        }
        for remark in remarks {
            self.client.log(Weight::Warning, remark);
        }
        for reason in refused {
            (self.refuse_change)(self, &uri, &reason);
        }
    }

    /// Acts on the messages that waited for a document, until a worker has it again.
    pub(crate) fn go_on(&mut self, uri: &Arc<str>) {
        let Some(mut waiting) = self.waiting.remove(uri) else {
            return;
        };
        while let Some(message) = waiting.pop_front() {
            if self.is_busy(uri, message.changes) {
                waiting.push_front(message);
                let first = self.waiting.entry(uri.clone()).or_default();
                first.append(&mut waiting);
                return;
            }
            self.act_on(message);
        }
    }

    /// The open document, or the error that says there is none.
    pub(crate) fn document(&mut self, uri: &str) -> jsonrpc::Result<&mut Open> {
        self.documents
            .get_mut(uri)
            .ok_or_else(|| jsonrpc::Error::invalid_params(say!(is_not_open, uri)))
    }
}
