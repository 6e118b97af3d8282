//! The links between open documents and what lies beside them, and what is to be looked up.

use crate::compare::{Form, Named};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError, RwLock, RwLockWriteGuard, Weak};
use std::time::SystemTime;

/// The partner or partners of an open document.
#[derive(Clone, Debug, Default)]
pub(super) enum Link {
    #[default]
    Nothing,
    /// The drawing of a program, and what its file holds, unless it is open.
    Drawing(Named, Option<Arc<Kept>>),
    /// The programs of a drawing that lie in its folder and are not open.
    Programs(Vec<(PathBuf, Arc<Kept>)>),
}

impl Link {
    /// The files that the document is compared with.
    pub(super) fn paths(&self) -> impl Iterator<Item = &Path> {
        let (drawing, programs) = match self {
            Link::Nothing => (None, &[][..]),
            Link::Drawing(named, _) => (Some(&*named.path), &[][..]),
            Link::Programs(programs) => (None, &programs[..]),
        };
        let programs = programs.iter().map(|(path, _)| &**path);
        drawing.into_iter().chain(programs)
    }
}

impl PartialEq for Link {
    /// True where both are the same files in the same state.
    fn eq(&self, other: &Link) -> bool {
        match (self, other) {
            (Link::Nothing, Link::Nothing) => true,
            (Link::Drawing(named, None), Link::Drawing(other, None)) => named == other,
            (Link::Drawing(named, Some(file)), Link::Drawing(other, Some(own))) => {
                named == other && Arc::ptr_eq(file, own)
            }
            (Link::Programs(programs), Link::Programs(others)) => {
                let is_same = |((path, file), (other, own)): (&(PathBuf, Arc<Kept>), &(_, _))| {
                    path == other && Arc::ptr_eq(file, own)
                };
                programs.len() == others.len() && programs.iter().zip(others).all(is_same)
            }
            _ => false,
        }
    }
}

/// The time of the last change of a file, and its length in bytes, when it was read; `None` where another change may leave them as
/// they are.
pub(super) type Stamp = Option<(SystemTime, u64)>;

/// A file that was read for other documents.
#[derive(Debug)]
pub(super) struct Kept {
    pub(super) stamp: Stamp,
    pub(super) form: Result<Form, String>,
}

/// The files that are still held by a document.
pub(super) type Files = Arc<Mutex<FxHashMap<PathBuf, Weak<Kept>>>>;

/// The open documents by their files.
pub(super) type Paths = Arc<RwLock<FxHashMap<PathBuf, Arc<str>>>>;

#[derive(Default)]
pub(super) struct Links {
    pub(super) paths: Paths,
    /// By file: the open documents that are compared with it.
    linked: FxHashMap<PathBuf, BTreeSet<Arc<str>>>,
    pub(super) files: Files,
    /// The documents whose partners are to be looked up.
    pub(super) asked: FxHashSet<Arc<str>>,
    /// A worker looks.
    pub(super) is_looking: bool,
}

impl Links {
    pub(super) fn paths_mut(&self) -> RwLockWriteGuard<'_, FxHashMap<PathBuf, Arc<str>>> {
        self.paths.write().unwrap_or_else(PoisonError::into_inner)
    }

    /// The open document of a file.
    pub(super) fn open_at(&self, path: &Path) -> Option<Arc<str>> {
        let paths = self.paths.read().unwrap_or_else(PoisonError::into_inner);
        paths.get(path).cloned()
    }

    /// The open documents that are compared with a file.
    pub(super) fn linked_to(&self, path: &Path) -> impl Iterator<Item = &Arc<str>> {
        self.linked.get(path).into_iter().flatten()
    }

    pub(super) fn unlink(&mut self, uri: &Arc<str>, link: &Link) {
        for path in link.paths() {
            if let Some(linked) = self.linked.get_mut(path) {
                linked.remove(uri);
                if linked.is_empty() {
                    self.linked.remove(path);
                }
            }
        }
    }

    pub(super) fn link(&mut self, uri: &Arc<str>, link: &Link) {
        for path in link.paths() {
            let linked = self.linked.entry(path.to_path_buf()).or_default();
            linked.insert(uri.clone());
        }
    }

    /// False where partners are being looked up, or are to be.
    pub(super) fn is_at_rest(&self) -> bool {
        self.asked.is_empty() && !self.is_looking
    }
}
