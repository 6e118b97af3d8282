//! What lies beside open documents: the drawing of a program, the programs of a drawing. A worker looks it up on disk, so that no
//! document waits for a slow or faulty disk.
//!
//! Nothing of the disk is kept but the data of files, each with the time stamp that it had: a later look asks for everything
//! again.

use super::config::{self, Config, Search};
use super::links::{Files, Kept, Link, Paths, Stamp};
use crate::compare::{Folders, Form};
use crate::disk::{self, Fence};
use crate::document::{Document, FileKind};
use crate::settings::Effective;
use crate::text::SourceText;
use rustc_hash::FxHashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError, Weak};
use std::time::Duration;

/// A larger file is not read beside another one, bytes.
const LARGEST: u64 = 256 * 1024 * 1024;

/// A change this soon after another may leave the time stamp as it was.
const SOON: Duration = Duration::from_secs(2);

/// What is asked about one document.
pub(super) struct Question {
    pub(super) uri: Arc<str>,
    pub(super) path: PathBuf,
    /// The first bytes of a program; `None` for a drawing.
    pub(super) head: Option<Vec<u8>>,
    /// `program.drawing`.
    pub(super) setting: Option<String>,
}

/// The questions about several documents, which the disk answers as it is at one moment.
pub(super) struct Look {
    pub(super) questions: Vec<Question>,
    pub(super) paths: Paths,
    pub(super) files: Files,
    pub(super) config: Arc<Config>,
    /// The texts of open project files.
    pub(super) settings_texts: FxHashMap<PathBuf, SourceText>,
}

impl Look {
    /// The documents, each with its partners.
    pub(super) fn answered(self) -> Vec<(Arc<str>, Link)> {
        let paths = self.paths.clone();
        let is_open = move |path: &Path| {
            let paths = paths.read().unwrap_or_else(PoisonError::into_inner);
            paths.contains_key(path)
        };
        let folders = Folders::new(self.config.fence().clone(), is_open);
        let mut search = Search::default();
        let mut answers = Vec::with_capacity(self.questions.len());
        for question in &self.questions {
            let setting = question.setting.as_deref();
            let link = match &question.head {
                Some(head) => match folders.drawing_of(&question.path, head, setting) {
                    Some(named) if folders.is_open(&named.path) => Link::Drawing(named, None),
                    Some(named) => {
                        let file = self.file(&named.path, &mut search);
                        Link::Drawing(named, Some(file))
                    }
                    None => Link::Nothing,
                },
                None => {
                    let programs = folders.programs_of(&question.path, setting).into_iter();
                    let read = |path: PathBuf| {
                        let file = self.file(&path, &mut search);
                        (path, file)
                    };
                    let programs: Vec<_> = programs.map(read).collect();
                    match programs.is_empty() {
                        true => Link::Nothing,
                        false => Link::Programs(programs),
                    }
                }
            };
            answers.push((question.uri.clone(), link));
        }
        let mut files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        files.retain(|_, kept| kept.strong_count() > 0);
        answers
    }

    /// What a file holds that is not open.
    fn file(&self, path: &Path, search: &mut Search) -> Arc<Kept> {
        let lock = || self.files.lock().unwrap_or_else(PoisonError::into_inner);
        let stamp = stamp_of(path);
        let known = lock().get(path).and_then(Weak::upgrade);
        let is_same = |known: &&Arc<Kept>| stamp.is_some() && known.stamp == stamp;
        if let Some(known) = known.as_ref().filter(is_same) {
            return known.clone();
        }
        let uri = config::uri_of(path).unwrap_or_default();
        let opened = |file: &Path| self.settings_texts.get(file).cloned();
        let project = self.config.file_for(&uri, search, &opened);
        let settings = self.config.effective_for(&uri, project.as_deref());
        let form = form_of_file(path, self.config.fence(), &settings);
        if let Some(known) = known.filter(|known| stamp.is_none() && known.form == form) {
            return known;
        }
        let kept = Arc::new(Kept { stamp, form });
        lock().insert(path.to_path_buf(), Arc::downgrade(&kept));
        kept
    }
}

/// Reads a file that is not open.
fn form_of_file(path: &Path, fence: &Fence, settings: &Arc<Effective>) -> Result<Form, String> {
    let file = fence.open(path)?;
    let bytes = disk::read_at_most(&file, LARGEST)?;
    let kind = FileKind::of_ending(&disk::ending_of(path)).unwrap_or(FileKind::Drawing);
    let form = catch_unwind(AssertUnwindSafe(|| {
        let (source, _) = kind.read(bytes, settings);
        Document::new(source, settings.clone()).form()
    }));
    let form = form.ok().flatten();
    form.ok_or_else(|| say!(internal_error_the_document_could_not_be_judged).into())
}

fn stamp_of(path: &Path) -> Stamp {
    let metadata = std::fs::metadata(path).ok()?;
    let changed = metadata.modified().ok()?;
    let is_old = changed.elapsed().is_ok_and(|since| since > SOON);
    is_old.then_some((changed, metadata.len()))
}
