//! The drawing beside a program, and the programs beside a drawing, as they are on disk.

use super::Failure;
use super::files;
use super::options::Common;
use crate::beside::{self, Beside, head_of, name_of};
use crate::document::Document;
use crate::finding::Rule;
use crate::settings::Settings;
use rustc_hash::FxHashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Programs, each with its drawing.
type Programs = Arc<Vec<(PathBuf, PathBuf)>>;

/// The folders searched so far: each is searched once.
#[derive(Default)]
pub(crate) struct Folders {
    /// The programs in a folder, each with its drawing.
    found: Mutex<FxHashMap<PathBuf, Programs>>,
}

impl Folders {
    /// The partners of a document that was read from `path`.
    pub(super) fn beside(
        &self,
        path: &Path,
        document: &Document,
        common: &Common,
        last: &Settings,
    ) -> Beside {
        let settings = document.settings();
        if settings.severity(Rule::NotTheDrawing).is_none() {
            return Beside::Nothing;
        }
        let other = |path: &Path| {
            let opened = files::open(path, common, last).map_err(|Failure(sentence)| sentence);
            let form = opened.and_then(|opened| {
                let form = opened.document.form();
                form.ok_or_else(|| say!(a_program_is_no_drawing).into())
            });
            (name_of(path), form)
        };
        if let Some(program) = document.program() {
            let setting = settings.drawing.as_deref();
            let head = program.text().bytes();
            let Some(named) = beside::drawing_named(path, head, setting, &Path::is_file) else {
                return Beside::Nothing;
            };
            let others = named.others.iter().map(|path| name_of(path));
            return Beside::of_program(other(&named.path), others.collect());
        }
        let real = path.canonicalize().ok();
        let programs = self.programs(path, settings.drawing.as_deref());
        let own = programs
            .iter()
            .filter(|(_, drawing)| real.as_ref() == Some(drawing));
        Beside::of_drawing(own.map(|(program, _)| other(program)))
    }

    /// The programs in the folder of a drawing with the drawings that they belong to.
    fn programs(&self, drawing: &Path, setting: Option<&str>) -> Programs {
        let folder = match drawing.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let lock = || self.found.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().get(folder) {
            return known.clone();
        }
        let files = std::fs::read_dir(folder).into_iter().flatten();
        let files = files.filter_map(|entry| Some(entry.ok()?.path()));
        let programs = beside::programs_beside(files, &Path::is_file);
        let with_drawing = |program: PathBuf| {
            let named =
                beside::drawing_named(&program, &head_of(&program), setting, &Path::is_file)?;
            Some((program, named.path.canonicalize().ok()?))
        };
        let found = Arc::new(programs.into_iter().filter_map(with_drawing).collect());
        lock().entry(folder.to_path_buf()).or_insert(found).clone()
    }
}
