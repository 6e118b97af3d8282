//! Workers look for the projects' files: a disk that does not answer holds up the documents whose settings it has, and no others.

use super::config::{ProjectFile, Search};
use super::looks::Then;
use super::state::State;
use crate::text::SourceText;
use rustc_hash::FxHashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl State {
    /// Acts on a document with the project's file that holds for it, as it is now. Later messages about the document wait.
    pub(crate) fn with_file(
        &mut self,
        name: &'static str,
        uri: Arc<str>,
        act: impl FnOnce(&mut State, Option<Arc<ProjectFile>>) + Send + 'static,
    ) {
        let folder = self.config.folder_of(&uri);
        self.look_for_file(folder, vec![uri.clone()], move |state, file| {
            state.first_in_turn(name, uri, move |state| act(state, file));
        });
    }

    /// Has a worker look for the project's file from a folder upwards; messages about `uris` wait until `then` has been done.
    pub(super) fn look_for_file(
        &mut self,
        folder: Option<PathBuf>,
        uris: Vec<Arc<str>>,
        then: impl FnOnce(&mut State, Option<Arc<ProjectFile>>) + Send + 'static,
    ) {
        let Some(folder) = folder else {
            return then(self, None);
        };
        for uri in &uris {
            self.looks.have_wait(uri);
        }
        let then: Then<State> = Box::new(move |state, file| {
            for uri in &uris {
                state.looks.let_go(uri);
            }
            then(state, file);
            for uri in &uris {
                state.go_on(uri);
            }
        });
        match self.looks.under_way.get_mut(&folder) {
            Some(asked) => asked.push(then),
            None => self.look(folder, vec![then]),
        }
    }

    fn look(&mut self, folder: PathBuf, mut asked: Vec<Then<State>>) {
        self.looks.under_way.insert(folder.clone(), Vec::new());
        let (stamp, texts, start) = (self.looks.stamp, self.settings_texts(), folder.clone());
        let look = move || {
            let opened = |file: &Path| texts.get(file).cloned();
            let found = || Search::default().upwards(&start, &opened);
            catch_unwind(AssertUnwindSafe(found)).ok().flatten()
        };
        self.on_a_worker("project's file", look, move |state, file| {
            let since = state.looks.under_way.remove(&folder).unwrap_or_default();
            if state.looks.stamp != stamp {
                asked.extend(since);
                return state.look(folder, asked);
            }
            if !since.is_empty() {
                state.look(folder, since);
            }
            if let Some(file) = &file {
                state.show_file(&file.path, Some(file));
            }
            for then in asked {
                then(state, file.clone());
            }
        });
    }

    /// The texts of the project files that the client holds open.
    pub(super) fn settings_texts(&self) -> FxHashMap<PathBuf, SourceText> {
        let texts = self.settings_texts.iter().filter_map(|(path, uri)| {
            let text = self.documents.get(uri)?.content.source_text()?;
            Some((path.clone(), text.clone()))
        });
        texts.collect()
    }
}
