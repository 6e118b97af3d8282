//! The drawing beside a program, and the programs beside a drawing, as they are on disk.

use super::Failure;
use super::files;
use super::options::Common;
use crate::compare::{self, Beside, name_of};
use crate::disk::Fence;
use crate::document::Document;
use crate::finding::Rule;
use crate::settings::Settings;
use std::path::Path;

/// The folders searched so far: each is searched once.
#[derive(Default)]
pub(crate) struct Folders {
    searched: compare::Folders,
    fence: Fence,
}

impl Folders {
    /// The same, where nothing beyond a fence is read.
    pub(super) fn within(fence: &Fence) -> Folders {
        Folders {
            searched: compare::Folders::new(fence.clone(), |_| false),
            fence: fence.clone(),
        }
    }

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
            let form = self.fence.open(path).map_err(String::from).and_then(|_| {
                let opened = files::open(path, common, last);
                let opened = opened.map_err(|Failure(sentence)| sentence)?;
                let form = opened.document.form();
                form.ok_or_else(|| say!(a_program_is_no_drawing).into())
            });
            (name_of(path), form)
        };
        let setting = settings.drawing.as_deref();
        if let Some(program) = document.program() {
            let head = program.text().bytes();
            let Some(named) = self.searched.drawing_of(path, head, setting) else {
                return Beside::Nothing;
            };
            let others = named.others.iter().map(|path| name_of(path));
            return Beside::of_program(other(&named.path), others.collect());
        }
        let programs = self.searched.programs_of(path, setting);
        Beside::of_drawing(programs.iter().map(|program| other(program)))
    }
}
