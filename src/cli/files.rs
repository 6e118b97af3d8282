//! Input files: which there are, the kind of each, and its settings.

use super::options::{Common, FileLanguage, at_fault};
use super::report::Row;
use super::{Failure, output};
use crate::disk::{self, Seen, Unchanged, ending_of, plain};
use crate::document::{Document, FileKind, Snapshot};
use crate::drawing::{Role, Unit};
use crate::finding;
use crate::finding::{Detail, Finding, Place, Severity};
use crate::message::readable;
use crate::program::{self, Language};
use crate::protocol::FindingData;
use crate::settings;
use crate::settings::{Effective, Origin, Origins, Settings, SettingsError};
use crate::text::{Again, SourceText, Writing};
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file that has been read.
pub(crate) struct Opened {
    pub(crate) path: PathBuf,
    pub(crate) document: Document,
    /// The file as it was: only this one may be overwritten. `None` of stdin.
    pub(crate) seen: Option<Seen>,
    /// The encoding of a program, which is kept.
    pub(crate) writing: Writing,
    /// Faults in settings files; the other settings apply.
    pub(crate) settings_rows: Vec<Row>,
}

impl From<FileLanguage> for FileKind {
    fn from(language: FileLanguage) -> FileKind {
        match language {
            FileLanguage::Dxf => FileKind::Drawing,
            FileLanguage::ThreeB => FileKind::Program(Language::ThreeB),
            FileLanguage::Iso => FileKind::Program(Language::Iso),
        }
    }
}

/// Reads one file with its settings: `wedm.toml` upwards from it, `--config`, then the options.
pub(crate) fn open(path: &Path, common: &Common, last: &Settings) -> Result<Opened, Failure> {
    match path == Path::new(output::STDIN) {
        true => open_stdin(None, shown(path), common, last),
        false => open_file(path, common, last, false),
    }
}

/// The name of an input for people.
pub(crate) fn shown(path: &Path) -> &Path {
    match path == Path::new(output::STDIN) {
        true => Path::new("stdin"),
        false => path,
    }
}

/// The same for a file that is only checked. The text of a large drawing is not kept but read again where it is needed; by then it may be gone.
pub(crate) fn open_to_check(
    path: &Path,
    common: &Common,
    last: &Settings,
) -> Result<Opened, Failure> {
    open_file(path, common, last, true)
}

fn open_file(
    path: &Path,
    common: &Common,
    last: &Settings,
    is_only_checked: bool,
) -> Result<Opened, Failure> {
    let (kind, settings, settings_rows) = kind_and_settings(path, common, last)?;
    let read = || {
        let file = File::open(path).map_err(|error| plain(&error))?;
        let is_regular = file.metadata().map_err(|error| plain(&error))?.is_file();
        let may_change = is_only_checked && is_regular;
        let as_it_is = may_change.then(|| Unchanged::of(&file)).flatten();
        let most = if is_regular { LARGEST } else { LARGEST_STREAM };
        let bytes = disk::read_at_most(&file, most)?;
        let seen = (!is_only_checked).then(|| Seen::of(&file, &bytes));
        Ok((bytes, seen.transpose()?, as_it_is))
    };
    let (bytes, seen, as_it_is) = read().map_err(|reason: String| Failure::of(path, reason))?;
    let again = as_it_is.filter(|_| bytes.len() >= LARGE);
    let again = again.map(|file| -> Again { Arc::new(move |range| file.read(range)) });
    let (document, writing) = document(kind, bytes, settings, again);
    Ok(Opened {
        path: path.to_path_buf(),
        document,
        seen,
        writing,
        settings_rows,
    })
}

/// What decides how a file is read: its kind, the settings, and the faults in these.
fn kind_and_settings(
    path: &Path,
    common: &Common,
    last: &Settings,
) -> Result<(FileKind, Arc<Effective>, Vec<Row>), Failure> {
    if path.is_dir() {
        return Err(Failure::of(path, say!(a_folder_is_no_file)));
    }
    if let Err(error) = std::fs::metadata(path) {
        return Err(Failure::of(path, plain(&error)));
    }
    let kind = match kind_of(path, common) {
        Ok(kind) => kind,
        Err(failure) => head(path)
            .and_then(|head| kind_of_content(path, &head))
            .ok_or(failure)?,
    };
    let (settings, rows) = settings_for(path, common, last)?;
    Ok((kind, Arc::new(settings), rows))
}

/// The text from stdin, read as a file of the given name, and the faults in its settings. Without a name it is a
/// drawing unless it reads as a program.
pub(crate) fn open_stdin(
    given: Option<&Path>,
    name: &Path,
    common: &Common,
    last: &Settings,
) -> Result<Opened, Failure> {
    let kind = kind_of(name, common);
    let (settings, settings_rows) = settings_for(name, common, last)?;
    let bytes = disk::read_stream_at_most(std::io::stdin().lock(), LARGEST_STREAM, Vec::new())
        .map_err(|reason| Failure::of(name, reason))?;
    let of_content =
        || kind_of_content(name, &bytes).or(given.is_none().then_some(FileKind::Drawing));
    let kind = kind.or_else(|failure| of_content().ok_or(failure))?;
    let (document, writing) = document(kind, bytes, Arc::new(settings), None);
    Ok(Opened {
        path: name.to_path_buf(),
        document,
        seen: None,
        writing,
        settings_rows,
    })
}

/// Refuses a text that is too large to hold: anything written from it would lack its end.
const LARGEST: u64 = u32::MAX as u64 - 1;
/// The same for a device or a pipe, which may have no end.
const LARGEST_STREAM: u64 = 256 * 1024 * 1024;

/// From this many bytes on the text of a drawing is read again rather than kept; in debug builds, which tests run, that of a small one, too.
const LARGE: usize = if cfg!(debug_assertions) {
    256
} else {
    16 * 1024 * 1024
};

/// The same for a command that makes something else from the file. It refuses faulty settings.
pub(crate) fn open_to_use(
    path: &Path,
    target: Option<&Path>,
    common: &Common,
    last: &Settings,
) -> Result<Opened, Failure> {
    if let Some(target) = target {
        output::refuse_input(target, path)?;
    }
    let opened = open(path, common, last)?;
    let faults = &opened.settings_rows;
    // Several drawings may share one faulty settings file.
    faults
        .iter()
        .for_each(|row| output::say_once(&row.rendered()));
    if faults.iter().any(|row| row.severity == Severity::Error) {
        return Err(Failure(say!(nothing_is_made_with_such_settings).into()));
    }
    Ok(opened)
}

/// The same for a drawing, with the snapshot that the work is done on.
pub(crate) fn drawing_to_use(
    path: &Path,
    target: Option<&Path>,
    common: &Common,
    last: &Settings,
) -> Result<(Opened, Snapshot), Failure> {
    let opened = open_to_use(path, target, common, last)?;
    let snapshot = opened.snapshot()?;
    Ok((opened, snapshot))
}

impl Opened {
    /// The drawing; an error where the file is a program.
    pub(crate) fn snapshot(&self) -> Result<Snapshot, Failure> {
        let snapshot = self.document.snapshot();
        snapshot.ok_or_else(|| Failure::of(&self.path, say!(a_program_is_no_drawing)))
    }

    /// The program; an error where the file is a drawing.
    pub(crate) fn program(&self) -> Result<&program::Document, Failure> {
        let program = self.document.program();
        program.ok_or_else(|| Failure::of(&self.path, say!(a_drawing_is_no_program)))
    }
}

/// What a drawing without any contour that is cut holds, in words; `None` for all others. An open contour that waits for its side
/// is one, and has a finding.
pub(crate) fn holds_no_contour(document: &Document) -> Option<String> {
    let snapshot = document.snapshot()?;
    if snapshot
        .outlines
        .iter()
        .any(|outline| outline.role != Role::Ignore)
    {
        return None;
    }
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    for (_, entity) in snapshot.drawing.entities() {
        *kinds.entry(entity.kind.name()).or_default() += 1;
    }
    let listed: Vec<String> = (kinds.iter())
        .map(|(kind, count)| format!("{count} {kind}"))
        .collect();
    Some(match listed.is_empty() {
        true => say!(no_entity_that_could_be_cut).into(),
        false => say!(no_contour_among, listed.join(say!(comma))),
    })
}

/// How much of a file is read to find its kind.
const HEAD: u64 = 64 * 1024;

/// The beginning of a regular file; nothing is read from others, such as a pipe.
fn head(path: &Path) -> Option<Vec<u8>> {
    let file = File::open(path).ok()?;
    let mut head = Vec::new();
    file.metadata().ok()?.is_file().then_some(())?;
    std::io::Read::read_to_end(&mut std::io::Read::take(file, HEAD), &mut head).ok()?;
    Some(head)
}

/// The kind of a file whose name does not tell.
fn kind_of_content(path: &Path, bytes: &[u8]) -> Option<FileKind> {
    match ending_of(path) == "dwg" {
        true => None,
        false => FileKind::of_content(bytes),
    }
}

/// By the command line, else by the name of the file.
fn kind_of(path: &Path, common: &Common) -> Result<FileKind, Failure> {
    if let Some(language) = common.language {
        return Ok(language.into());
    }
    let ending = ending_of(path);
    if let Some(kind) = FileKind::of_ending(&ending) {
        return Ok(kind);
    }
    let refusal: String = match ending.as_str() {
        "dwg" => say!(dwg_is_not_read).into(),
        "" => say!(its_name_has_no_ending, ".dxf, .3b, .iso", ".nc"),
        ending => say!(its_name_ends_otherwise, ending),
    };
    Err(Failure::of(path, refusal))
}

fn document(
    kind: FileKind,
    bytes: Vec<u8>,
    settings: Arc<Effective>,
    again: Option<Again>,
) -> (Document, Writing) {
    let (source, writing) = kind.read(bytes, &settings);
    say_encoding(writing);
    (Document::without_text(source, settings, again), writing)
}

/// Reports an unusual encoding once, however many files there are.
fn say_encoding(writing: Writing) {
    if writing == Writing::Gb18030 {
        let note = output::styled(output::NOTE, say!(note));
        output::say_once(&say!(read_as_gb_18030, note));
    }
}

/// The settings for an input, and the faults found in settings files.
pub(crate) fn settings_for(
    path: &Path,
    common: &Common,
    last: &Settings,
) -> Result<(Effective, Vec<Row>), Failure> {
    let mut settings = Settings::default();
    let (mut rows, mut sources, mut levels) = (Vec::new(), Vec::new(), Vec::new());
    let project = project_file(path).map(|file| (file, Origin::File));
    let config = common.config.clone().map(|file| (file, Origin::Config));
    for (file, origin) in project.iter().chain(&config) {
        let bytes = settings::read_file(file).map_err(|reason| Failure::of(file, reason))?;
        let (bytes, writing) = Writing::read(bytes);
        say_encoding(writing);
        let text =
            String::from_utf8(bytes).map_err(|_| Failure::of(file, say!(it_is_not_utf_8_text)))?;
        let (level, errors) = settings::from_toml(&text);
        settings = settings.overlaid(&level);
        let source = SourceText::new(text.clone().into_bytes());
        let by_itself = errors.into_iter().filter(|error| !error.of_levels);
        rows.extend(by_itself.map(|error| settings_row(file, &source, error)));
        sources.push((file, text, source));
        levels.push((level, *origin));
    }
    let of_files = settings.contradictions(&|_| None);
    let settings = settings.overlaid(last);
    // Faults of the passes show once all levels are merged: in the last file that sets them, or in the options.
    for error in settings.contradictions(&|_| None) {
        let is_of_files = of_files.iter().any(|own| own.message == error.message);
        if !is_of_files && let Some(options) = at_fault(last, &error.key) {
            said_of_options(say!(says, options, error.message), error.severity)?;
            continue;
        }
        let place = |(file, text, source): &(&PathBuf, String, SourceText)| {
            let mut own = settings
                .contradictions(&|fault| settings::place_in(text, fault))
                .into_iter();
            let own = own.find(|own| own.message == error.message && own.range.is_some())?;
            Some(settings_row(file, source, own))
        };
        match sources.iter().rev().find_map(place) {
            Some(row) => rows.push(row),
            None => said_of_options(error.message, error.severity)?,
        }
    }
    let name = path
        .file_name()
        .map(|name| name.to_string_lossy().into_owned());
    let levels = levels.iter().map(|(level, origin)| (level, *origin));
    let origins = Origins::of(levels.chain([(last, Origin::Option)]));
    let effective = Effective::of_document(&settings, name);
    Ok((
        Effective {
            origins,
            ..effective
        },
        rows,
    ))
}

/// An error in what options have set; what may not be meant is only said, once for all files.
fn said_of_options(sentence: String, severity: Severity) -> Result<(), Failure> {
    if severity == Severity::Error {
        return Err(Failure(sentence));
    }
    let warning = output::styled(output::WARNING, say!(warning));
    output::say_once(&say!(says, warning, readable(&sentence)));
    Ok(())
}

fn settings_row(file: &Path, source: &SourceText, error: SettingsError) -> Row {
    let range = error.range.unwrap_or(0..0);
    let place = Place::Text {
        range: range.clone(),
    };
    let SettingsError { rule, severity, .. } = error;
    let finding = Finding {
        rule,
        severity,
        place,
        detail: Detail::Said(error.message),
        related: Vec::new(),
    };
    let message = finding::sentence(&finding, Unit::MILLIMETRE.mm);
    Row::new(
        file,
        Some(source),
        range,
        (rule, severity),
        message,
        FindingData::default(),
    )
}

/// The nearest `wedm.toml` in the input's folder or one that holds it.
pub(crate) fn project_file(path: &Path) -> Option<PathBuf> {
    // Text from stdin has a name that need not exist.
    let folder = match path.canonicalize() {
        Ok(file) => file.parent()?.to_path_buf(),
        Err(_) => Path::new(".").join(path.parent()?).canonicalize().ok()?,
    };
    let file = folder
        .ancestors()
        .map(|folder| folder.join(settings::FILE_NAME))
        .find(|file| settings::is_there(file))?;
    // A file beside the input is named with the input's own path.
    match path.parent() {
        Some(parent) if file.parent() == Some(&folder) => Some(parent.join(settings::FILE_NAME)),
        _ => Some(file),
    }
}

/// The result of a search for files.
#[derive(Default)]
pub(crate) struct Found {
    pub(crate) files: Vec<PathBuf>,
    /// Unreadable folders, and missing paths.
    pub(crate) failures: Vec<Failure>,
}

/// The exclusions of a search.
#[derive(Default)]
pub(crate) struct Search<'a> {
    /// Patterns as .gitignore has them.
    pub(crate) exclude: &'a [String],
    /// Hidden files, too, and what .gitignore and its like name.
    pub(crate) all: bool,
    /// How many folders deep; all where nothing is said.
    pub(crate) depth: Option<usize>,
}

/// The files that `paths` name: files as they are, folders searched, sorted by name, without duplicates. `-` is kept.
pub(crate) fn search(paths: &[PathBuf], search: &Search) -> Found {
    let mut found = Found::default();
    let mut seen = std::collections::HashSet::new();
    for path in paths {
        if path == Path::new("-") {
            found.files.push(path.clone());
            continue;
        }
        let walk = match walk(path, search) {
            Ok(walk) => walk,
            Err(error) => {
                found.failures.push(Failure(error.to_string()));
                continue;
            }
        };
        for entry in walk {
            match entry {
                Ok(entry) => {
                    let named = entry.depth() == 0 && !entry.path().is_dir();
                    // A link to a file counts; a link to a folder may be circular.
                    let found_inside = has_known_ending(entry.path()) && entry.path().is_file();
                    if (named || found_inside) && seen.insert(entry.path().to_path_buf()) {
                        // Files in the working folder are named as a user would name them.
                        let here = entry.path().strip_prefix(".").ok();
                        let here = here.filter(|_| path == Path::new("."));
                        found.files.push(here.unwrap_or(entry.path()).to_path_buf());
                    }
                }
                Err(error) => {
                    let place = place_of(&error).unwrap_or(path).display().to_string();
                    let reason = reason_of(&error).map_or_else(|| error.to_string(), plain);
                    found.failures.push(Failure(say!(says, place, reason)));
                }
            }
        }
    }
    found
}

fn walk(path: &Path, search: &Search) -> Result<ignore::Walk, ignore::Error> {
    let mut excluded = ignore::overrides::OverrideBuilder::new(path);
    for pattern in search.exclude {
        excluded.add(&format!("!{pattern}"))?;
    }
    let mut walk = ignore::WalkBuilder::new(path);
    if !search.all {
        walk.add_custom_ignore_filename(".wedmignore");
    }
    Ok(walk
        .standard_filters(!search.all)
        .require_git(false)
        .max_depth(search.depth)
        .overrides(excluded.build()?)
        .sort_by_file_name(std::ffi::OsStr::cmp)
        .build())
}

/// The system's reason, without the names that the search has added.
fn reason_of(error: &ignore::Error) -> Option<&std::io::Error> {
    let error = error.io_error()?;
    let inner = error.get_ref().and_then(|inner| inner.source());
    Some(
        inner
            .and_then(|inner| inner.downcast_ref())
            .unwrap_or(error),
    )
}

fn place_of(error: &ignore::Error) -> Option<&Path> {
    match error {
        ignore::Error::WithPath { path, .. } => Some(path),
        ignore::Error::WithDepth { err, .. } | ignore::Error::WithLineNumber { err, .. } => {
            place_of(err)
        }
        _ => None,
    }
}

fn has_known_ending(path: &Path) -> bool {
    FileKind::of_ending(&ending_of(path)).is_some()
}
