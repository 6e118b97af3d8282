//! Which documents lie beside each other: a program and its drawing. An open document takes precedence over the file on
//! disk; a change to one has the other judged again.

use super::config;
use super::content::Content;
use super::judge::Task;
use super::partner::{From, Kept, Link, Wanted, stamp_of};
use super::state::State;
use crate::beside::{self, Form, Named, head_of, name_of, plain};
use crate::finding::Rule;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

fn file_of(uri: &str) -> Option<PathBuf> {
    config::path_of(uri).map(|path| plain(&path))
}

impl State {
    /// Called when a document is opened: it may be the drawing of open programs.
    pub(crate) fn note_path(&mut self, uri: &Arc<str>) {
        let Some(path) = file_of(uri) else { return };
        self.links.paths.insert(path, uri.clone());
        let is_program = |uri: &&Arc<str>| {
            let open = self.documents.get(*uri);
            let document = open.and_then(|open| open.document());
            document.is_some_and(|document| document.program().is_some())
        };
        let mut programs: Vec<Arc<str>> = self
            .links
            .paths
            .values()
            .filter(is_program)
            .cloned()
            .collect();
        programs.sort_unstable();
        for program in programs {
            self.relink(&program, false);
        }
    }

    /// The documents beside one that is to be judged.
    pub(crate) fn wanted_beside(&mut self, uri: &Arc<str>) -> Option<Wanted> {
        let open = self.documents.get(uri)?;
        let link = open.link.clone();
        let mut wanted = Wanted {
            others: Vec::new(),
            partners: Vec::new(),
            is_program: matches!(link, Link::Drawing(_)),
        };
        let paths = match link {
            Link::Drawing(Named { path, others }) => {
                wanted.others = others.iter().map(|path| name_of(path)).collect();
                vec![path]
            }
            Link::Programs(mut programs) => {
                let path = file_of(uri)?;
                let open = self.links.programs.get(&path).into_iter().flatten();
                // An open document says itself whether it belongs here.
                programs.retain(|path| !self.links.paths.contains_key(path));
                programs.extend(open.filter_map(|uri| file_of(uri)));
                programs.sort();
                programs
            }
            Link::Nothing => return Some(wanted),
        };
        for path in paths {
            let from = match self.links.paths.get(&path) {
                Some(uri) => match self.documents.get(uri).and_then(|open| open.form.clone()) {
                    Some(form) => From::Known(Ok(form)),
                    // It is yet to be judged, and notifies its partners then.
                    None => continue,
                },
                None => self.on_disk(&path),
            };
            wanted.partners.push((name_of(&path), from));
        }
        Some(wanted)
    }

    fn on_disk(&mut self, path: &Path) -> From {
        let stamp = stamp_of(path);
        if let Some(kept) = self.links.files.get(path)
            && kept.stamp == stamp
        {
            return From::Known(kept.form.clone());
        }
        let uri = config::uri_of(path).unwrap_or_default();
        From::File {
            path: path.to_path_buf(),
            stamp,
            settings: self.settings_for(&uri),
        }
    }

    /// Stores the files read for a document, and notifies its partners of its new state.
    pub(crate) fn judged_beside(
        &mut self,
        uri: &Arc<str>,
        read: Vec<(PathBuf, Kept)>,
        form: Option<Form>,
    ) {
        self.links.files.extend(read);
        let mut is_new = false;
        if let Some(open) = self.documents.get_mut(uri)
            && form.is_some()
        {
            is_new = open.form != form;
            open.form = form;
        }
        self.relink(uri, false);
        if is_new {
            self.poke_partners(uri);
        }
    }

    /// Has the documents beside an open one judged again.
    fn poke_partners(&mut self, uri: &Arc<str>) {
        let Some(path) = file_of(uri) else { return };
        let mut partners: BTreeSet<Arc<str>> =
            self.links.programs.get(&path).cloned().unwrap_or_default();
        let link = self.documents.get(uri).map(|open| &open.link);
        if let Some(Link::Drawing(named)) = link {
            partners.extend(self.links.paths.get(&named.path).cloned());
        }
        for partner in partners {
            self.add_task(&partner, Task::Beside);
        }
    }

    /// Finds the partners of a document; a drawing's partners are only searched for again when
    /// files have changed.
    fn relink(&mut self, uri: &Arc<str>, files_changed: bool) {
        let Some(open) = self.documents.get(uri) else {
            return;
        };
        let Content::Read(document) = &open.content else {
            return;
        };
        let Some(path) = file_of(uri) else { return };
        let settings = document.settings();
        let is_asked = document.program().is_none()
            && settings.severity(Rule::NotTheDrawing).is_some()
            && (files_changed || open.link == Link::Nothing);
        let folder = path.parent().filter(|_| is_asked);
        let programs = folder.map(|folder| self.links.programs_in(folder));
        let is_there = |path: &Path| self.links.paths.contains_key(path) || path.is_file();
        let setting = settings.drawing.as_deref();
        let link = match document.program() {
            _ if settings.severity(Rule::NotTheDrawing).is_none() => Link::Nothing,
            Some(program) => {
                let head = program.text().bytes();
                let named = beside::drawing_named(&path, head, setting, &is_there);
                named.map_or(Link::Nothing, Link::Drawing)
            }
            None if is_asked => {
                let is_own = |program: &Path| {
                    let head = head_of(program);
                    let named = beside::drawing_named(program, &head, setting, &is_there);
                    named.is_some_and(|named| named.path == path)
                };
                Link::Programs(beside::programs_beside(
                    programs.unwrap_or_default(),
                    &is_own,
                ))
            }
            None => return,
        };
        if open.link == link {
            return;
        }
        let is_alone = match &link {
            Link::Programs(programs) => {
                programs.is_empty()
                    && self
                        .links
                        .programs
                        .get(&path)
                        .is_none_or(BTreeSet::is_empty)
            }
            _ => false,
        };
        if is_alone && open.link == Link::Nothing {
            return;
        }
        let drawing_of = |link: &Link| match link {
            Link::Drawing(named) => Some(named.path.clone()),
            _ => None,
        };
        let (old, new) = (drawing_of(&open.link), drawing_of(&link));
        if let Some(open) = self.documents.get_mut(uri) {
            open.link = link;
            open.wants_form = true;
        }
        if old != new {
            for drawing in old.into_iter() {
                self.links
                    .programs
                    .entry(drawing.clone())
                    .or_default()
                    .remove(uri);
                self.poke(&drawing);
            }
            for drawing in new.into_iter() {
                self.links
                    .programs
                    .entry(drawing.clone())
                    .or_default()
                    .insert(uri.clone());
                self.poke(&drawing);
            }
        }
        self.add_task(uri, Task::Beside);
    }

    /// Has an open document compared again.
    fn poke(&mut self, path: &Path) {
        let Some(uri) = self.links.paths.get(path).cloned() else {
            return;
        };
        if let Some(open) = self.documents.get_mut(&uri) {
            open.wants_form = true;
            if open.link == Link::Nothing
                && open.document().is_some_and(|own| own.program().is_none())
            {
                open.link = Link::Programs(Vec::new());
            }
        }
        self.add_task(&uri, Task::Beside);
    }

    /// Called when a document is closed: its partners use the file.
    pub(crate) fn closed_beside(&mut self, uri: &Arc<str>, link: &Link) {
        let Some(path) = file_of(uri) else { return };
        self.links.paths.remove(&path);
        if let Link::Drawing(named) = link {
            if let Some(programs) = self.links.programs.get_mut(&named.path) {
                programs.remove(uri);
            }
            let drawing = self.links.paths.get(&named.path).cloned();
            if let Some(drawing) = drawing {
                self.relink(&drawing, true);
                self.add_task(&drawing, Task::Beside);
            }
        }
        for program in self.links.programs.get(&path).cloned().unwrap_or_default() {
            self.relink(&program, true);
            self.add_task(&program, Task::Beside);
        }
    }

    /// Called when files have changed on disk: all partners are found again.
    pub(crate) fn files_changed(&mut self) {
        let mut uris: Vec<Arc<str>> = self.links.paths.values().cloned().collect();
        uris.sort_unstable();
        for uri in uris {
            self.relink(&uri, true);
            let has_partner = |link: &Link| match link {
                Link::Nothing => false,
                Link::Drawing(_) => true,
                Link::Programs(programs) => !programs.is_empty(),
            };
            if self
                .documents
                .get(&uri)
                .is_some_and(|open| has_partner(&open.link))
            {
                self.add_task(&uri, Task::Beside);
            }
        }
    }

    /// Called when settings have changed, which files depend on.
    pub(crate) fn forget_files(&mut self) {
        self.links.files.clear();
    }
}
