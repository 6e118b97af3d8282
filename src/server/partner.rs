//! The partners of a document that is judged: the drawing of a program, the programs of a drawing.

use crate::beside::{Beside, Form, Named, is_program, plain};
use crate::disk;
use crate::document::{Document, FileKind};
use crate::settings::Effective;
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

/// The partner or partners of an open document.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Link {
    #[default]
    Nothing,
    /// The drawing of a program.
    Drawing(Named),
    /// The programs of a drawing that lie in its folder.
    Programs(Vec<PathBuf>),
}

/// The time of the last change of a file, and its length in bytes, when it was read.
pub(super) type Stamp = Option<(SystemTime, u64)>;

/// The partners of a document that is judged.
pub(super) struct Wanted {
    pub others: Vec<Arc<str>>,
    pub partners: Vec<(Arc<str>, From)>,
    pub(crate) is_program: bool,
}

pub(super) enum From {
    Known(Result<Form, String>),
    File {
        path: PathBuf,
        stamp: Stamp,
        settings: Arc<Effective>,
    },
}

/// A file that was read for another document.
pub(super) struct Kept {
    pub(crate) stamp: Stamp,
    pub form: Result<Form, String>,
}

/// A larger drawing is not read beside a program, bytes.
const LARGEST: u64 = 256 * 1024 * 1024;

#[derive(Default)]
pub(super) struct Links {
    /// Open documents by their files.
    pub paths: FxHashMap<PathBuf, Arc<str>>,
    /// Open programs by their drawings.
    pub programs: FxHashMap<PathBuf, BTreeSet<Arc<str>>>,
    /// Files that are not open.
    pub files: FxHashMap<PathBuf, Kept>,
    /// Folders without a program, and when each had changed last.
    without_programs: FxHashMap<PathBuf, SystemTime>,
}

/// A change to a folder this soon after another may leave its time stamp as it was.
const SOON: Duration = Duration::from_secs(2);

impl Links {
    /// The programs in a folder. This is needed after every edit of a drawing, so a folder without
    /// programs is not read again until it has changed.
    pub(super) fn programs_in(&mut self, folder: &Path) -> Vec<PathBuf> {
        let changed = stamp_of(folder).map(|(changed, _)| changed);
        if changed.is_some() && self.without_programs.get(folder) == changed.as_ref() {
            return Vec::new();
        }
        let files = std::fs::read_dir(folder).into_iter().flatten();
        let files = files.filter_map(|entry| Some(plain(&entry.ok()?.path())));
        let programs: Vec<PathBuf> = files.filter(|path| is_program(path)).collect();
        let is_old = |changed: &SystemTime| changed.elapsed().is_ok_and(|since| since > SOON);
        match changed.filter(is_old) {
            Some(changed) if programs.is_empty() => {
                self.without_programs.insert(folder.into(), changed);
            }
            _ => drop(self.without_programs.remove(folder)),
        }
        programs
    }
}

impl Wanted {
    /// True where no file has to be read for it.
    pub(crate) fn is_at_hand(&self) -> bool {
        let known = |(_, from): &(_, From)| matches!(from, From::Known(_));
        self.partners.iter().all(known)
    }

    /// The partners of the document, and the files that were read for it.
    pub(super) fn read(self) -> (Beside, Vec<(PathBuf, Kept)>) {
        let mut read = Vec::new();
        let mut forms = Vec::with_capacity(self.partners.len());
        for (name, from) in self.partners {
            let form = match from {
                From::Known(form) => form,
                From::File {
                    path,
                    stamp,
                    settings,
                } => {
                    let form = form_of_file(&path, &settings);
                    let kept = Kept {
                        stamp,
                        form: form.clone(),
                    };
                    read.push((path, kept));
                    form
                }
            };
            forms.push((name, form));
        }
        let beside = match self.is_program {
            true => match forms.into_iter().next() {
                Some(drawing) => Beside::of_program(drawing, self.others),
                None => Beside::Nothing,
            },
            false => Beside::of_drawing(forms),
        };
        (beside, read)
    }
}

/// Reads a file that is not open.
fn form_of_file(path: &Path, settings: &Arc<Effective>) -> Result<Form, String> {
    let file = std::fs::File::open(path).map_err(|error| disk::plain(&error))?;
    let bytes = disk::read_at_most(&file, LARGEST)?;
    let kind = FileKind::of_ending(&disk::ending_of(path)).unwrap_or(FileKind::Drawing);
    let form = catch_unwind(AssertUnwindSafe(|| {
        let (source, _) = kind.read(bytes, settings);
        Document::new(source, settings.clone()).form()
    }));
    let form = form.ok().flatten();
    form.ok_or_else(|| say!(internal_error_the_document_could_not_be_judged).into())
}

pub(super) fn stamp_of(path: &Path) -> Stamp {
    let metadata = std::fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}
