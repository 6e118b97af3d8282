//! Which documents lie beside each other: a program and its drawing. An open document takes precedence over the file on
//! disk; a change to one has the other judged again.
//!
//! A worker looks on disk (`partner.rs`), at all documents that are asked about together. A document is asked about whenever it has
//! been judged, all of them when settings or files have changed and when a drawing comes or anything goes.

use super::config;
use super::content::Content;
use super::judge::Task;
use super::links::{Files, Link};
use super::open::Open;
use super::partner::{Look, Question};
use super::state::State;
use crate::compare::{Beside, Form, HEAD, name_of, plain};
use crate::finding::Rule;
use crate::text::head;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

fn file_of(uri: &str) -> Option<PathBuf> {
    config::path_of(uri).map(|path| plain(&path))
}

impl State {
    /// Called when a document is opened, in place of one with this link if it was open already. It may be the drawing of open
    /// programs.
    pub(crate) fn opened_beside(&mut self, uri: &Arc<str>, old: &Link, is_program: bool) {
        self.links.unlink(uri, old);
        let Some(path) = file_of(uri) else { return };
        self.links.paths_mut().insert(path.clone(), uri.clone());
        self.poke_linked(&path);
        if !is_program {
            self.ask_all_beside();
        }
    }

    /// Called when a document is closed: the file takes its place.
    pub(crate) fn closed_beside(&mut self, uri: &Arc<str>, link: &Link) {
        self.links.unlink(uri, link);
        let Some(path) = file_of(uri) else { return };
        if self.links.open_at(&path).as_ref() == Some(uri) {
            self.links.paths_mut().remove(&path);
        }
        self.poke_linked(&path);
        for partner in link.paths() {
            self.poke(partner);
        }
        self.ask_all_beside();
    }

    /// Has the partners of a document looked up.
    pub(crate) fn ask_beside(&mut self, uri: &Arc<str>) {
        self.links.asked.insert(uri.clone());
    }

    /// Has the partners of all documents looked up: files may have changed.
    pub(crate) fn ask_all_beside(&mut self) {
        self.links.asked.extend(self.documents.keys().cloned());
    }

    /// The same when settings have changed, by which files are read.
    pub(crate) fn forget_files(&mut self) {
        self.links.files = Files::default();
        self.ask_all_beside();
    }

    /// Has a worker look up what has been asked; what is asked meanwhile waits for the next look.
    pub(crate) fn look_beside(&mut self) {
        if self.links.is_looking || self.links.asked.is_empty() {
            return;
        }
        let mut questions = Vec::new();
        for uri in std::mem::take(&mut self.links.asked) {
            if self.documents.get(&uri).is_some_and(Open::is_away) {
                // The next look is for what a worker has.
                self.links.asked.insert(uri);
                continue;
            }
            match self.question(&uri) {
                Some(question) => questions.push(question),
                // Its rule may have been switched off.
                None => self.set_link(&uri, Link::Nothing),
            }
        }
        if questions.is_empty() {
            return;
        }
        let look = Look {
            questions,
            paths: self.links.paths.clone(),
            files: self.links.files.clone(),
            config: self.config.clone(),
            settings_texts: self.settings_texts(),
        };
        self.links.is_looking = true;
        self.on_a_worker(
            "partners",
            move || catch_unwind(AssertUnwindSafe(|| look.answered())),
            |state, answers| {
                state.links.is_looking = false;
                for (uri, link) in answers.unwrap_or_default() {
                    state.set_link(&uri, link);
                }
            },
        );
    }

    /// What is to be looked up for a document; `None` for one that is compared with no other.
    fn question(&self, uri: &Arc<str>) -> Option<Question> {
        let open = self.documents.get(uri)?;
        let path = file_of(uri)?;
        let is_off = open.settings.severity(Rule::NotTheDrawing).is_none();
        let (Content::Read(document), false) = (&open.content, is_off) else {
            return None;
        };
        let program = document.program();
        Some(Question {
            uri: uri.clone(),
            path,
            head: program.map(|program| head(program.text().bytes(), HEAD).to_vec()),
            setting: open.settings.drawing.clone(),
        })
    }

    /// Sets the partners of a document; those before and those from now on are judged again.
    fn set_link(&mut self, uri: &Arc<str>, link: Link) {
        let Some(open) = self.documents.get_mut(uri) else {
            return;
        };
        if open.link == link {
            return;
        }
        let old = std::mem::replace(&mut open.link, link.clone());
        self.links.unlink(uri, &old);
        self.links.link(uri, &link);
        for partner in old.paths().chain(link.paths()) {
            self.poke(partner);
        }
        self.judge_beside(uri);
    }

    /// What lies beside a document that is to be judged.
    pub(crate) fn beside_of(&self, uri: &Arc<str>) -> Beside {
        let Some(open) = self.documents.get(uri) else {
            return Beside::Nothing;
        };
        if let Link::Drawing(named, file) = &open.link {
            let others = named.others.iter().map(|path| name_of(path));
            let form = match self.links.open_at(&named.path) {
                Some(drawing) => self.form_of(&drawing).map(Ok),
                None => file.as_ref().map(|file| file.form.clone()),
            };
            // What is not known yet is told when it has been judged.
            return form.map_or(Beside::Nothing, |form| {
                Beside::of_program((name_of(&named.path), form), others.collect())
            });
        }
        let mut programs: Vec<(PathBuf, Result<Form, String>)> = Vec::new();
        if let Link::Programs(on_disk) = &open.link {
            // An open document says itself whether it belongs here.
            let closed = on_disk
                .iter()
                .filter(|(path, _)| self.links.open_at(path).is_none());
            programs.extend(closed.map(|(path, file)| (path.clone(), file.form.clone())));
        }
        if let Some(path) = file_of(uri) {
            let linked = self.links.linked_to(&path).filter(|linked| {
                let open = self.documents.get(*linked);
                open.is_some_and(|open| matches!(open.link, Link::Drawing(..)))
            });
            let known = |uri: &Arc<str>| Some((file_of(uri)?, Ok(self.form_of(uri)?)));
            programs.extend(linked.filter_map(known));
        }
        programs.sort_by(|(one, _), (other, _)| one.cmp(other));
        let named = programs.into_iter();
        Beside::of_drawing(named.map(|(path, form)| (name_of(&path), form)))
    }

    fn form_of(&self, uri: &str) -> Option<Form> {
        self.documents.get(uri)?.form.clone()
    }

    /// True where other documents are compared with one.
    pub(crate) fn is_compared(&self, uri: &Arc<str>) -> bool {
        let is_linked = |open: &Open| open.link != Link::Nothing;
        self.documents.get(uri).is_some_and(is_linked)
            || file_of(uri).is_some_and(|path| self.links.linked_to(&path).next().is_some())
    }

    /// Has the documents beside an open one judged again.
    pub(crate) fn poke_partners(&mut self, uri: &Arc<str>) {
        if let Some(path) = file_of(uri) {
            self.poke_linked(&path);
        }
        let link = self.documents.get(uri).map(|open| open.link.clone());
        for partner in link.iter().flat_map(Link::paths) {
            self.poke(partner);
        }
    }

    /// Has the open documents judged again that are compared with a file.
    fn poke_linked(&mut self, path: &Path) {
        let linked: Vec<Arc<str>> = self.links.linked_to(path).cloned().collect();
        for uri in linked {
            self.judge_beside(&uri);
        }
    }

    /// Has the document of a file judged again, where it is open.
    fn poke(&mut self, path: &Path) {
        if let Some(uri) = self.links.open_at(path) {
            self.judge_beside(&uri);
        }
    }

    /// Has a document compared again with what lies beside it. Its text is what it was, and answers about it hold.
    pub(crate) fn judge_beside(&mut self, uri: &Arc<str>) {
        let Some(open) = self.documents.get_mut(uri) else {
            return;
        };
        if !open.tasks.iter().any(|task| matches!(task, Task::Beside)) {
            open.tasks.push(Task::Beside);
        }
        if !std::mem::replace(&mut open.is_dirty, true) {
            self.dirty.push(open.uri.clone());
        }
    }

    /// Has a worker do `work`, and acts on its result.
    pub(crate) fn on_a_worker<T: Send + 'static>(
        &self,
        name: &'static str,
        work: impl FnOnce() -> T + Send + 'static,
        then: impl FnOnce(&mut State, T) + Send + 'static,
    ) {
        let mailbox = self.mailbox.clone();
        self.workers.judge(move || {
            let done = work();
            mailbox.tell(name, None, move |state| then(state, done));
        });
    }
}
