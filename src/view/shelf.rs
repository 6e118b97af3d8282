//! The files that are shown, each with its errors and warnings.
//!
//! A thread counts what has not been counted yet, one file at a time: the page is served meanwhile, and so are its
//! sessions. Which files there are, and how many faults each has, is asked of whoever opens the bench.

use super::files::LARGEST;
use crate::disk::{Fence, ending_of};
use crate::document::FileKind;
use crate::server::uri_of;
use crate::settings;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};
use tokio::sync::broadcast;

/// The most files that are listed.
const MOST: usize = 2000;
/// The most changes that wait for a page; behind that it asks for all files again.
const MOST_WAITING: usize = 256;
/// While files are counted, pages are told this often.
const PULSE: Duration = Duration::from_millis(250);

/// Errors and warnings of a file.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counts {
    pub(crate) errors: usize,
    pub(crate) warnings: usize,
}

/// A folder that is shown.
pub(crate) struct Root {
    /// Absolute, as its files are named.
    pub(crate) folder: PathBuf,
    pub(crate) has_subfolders: bool,
}

/// What is shown, and who knows it.
pub(crate) struct Shown {
    pub(crate) roots: Vec<Root>,
    /// The files that were named by themselves.
    pub(crate) opened: Vec<PathBuf>,
    /// Lists all files of the folders.
    pub(crate) find: fn(&Root) -> Vec<PathBuf>,
    /// Counts the faults of one; the error is a sentence.
    pub(crate) count: fn(&Path, &Fence) -> Result<Counts, String>,
    /// Makes the report of a drawing, as HTML; the error is a sentence.
    pub(crate) report: fn(&Path) -> Result<String, String>,
}

/// What a page is told.
#[derive(Clone, Debug)]
pub(super) enum Change {
    /// A file was added, is gone, or was counted.
    Files,
    /// The text of a file changed, and has settled.
    Saved { uri: String, modified: u64 },
    /// It begins to change.
    Writing { uri: String },
}

impl Change {
    /// A server-sent event.
    pub(super) fn as_event(&self) -> String {
        let (name, data) = match self {
            Change::Files => ("files", json!({})),
            Change::Saved { uri, modified } => {
                ("saved", json!({ "uri": uri, "modified": modified }))
            }
            Change::Writing { uri } => ("writing", json!({ "uri": uri })),
        };
        format!("event: {name}\ndata: {data}\n\n")
    }
}

/// What a file on disk is known by until it changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stamp {
    pub(super) bytes: u64,
    pub(super) modified: SystemTime,
}

impl Stamp {
    fn milliseconds(self) -> u64 {
        let since = self.modified.duration_since(UNIX_EPOCH).unwrap_or_default();
        u64::try_from(since.as_millis()).unwrap_or(u64::MAX)
    }
}

struct Entry {
    stamp: Stamp,
    counted: Option<Result<Counts, String>>,
}

#[derive(Default)]
struct Listing {
    entries: BTreeMap<PathBuf, Entry>,
    /// How many more there are than are listed.
    left: usize,
    is_found: bool,
    uncounted: BTreeSet<PathBuf>,
    /// The one that is being counted.
    is_counting: bool,
}

pub(super) struct Shelf {
    shown: Shown,
    fence: Fence,
    listing: Mutex<Listing>,
    /// There is something to count.
    asked: Condvar,
    changes: broadcast::Sender<Change>,
}

impl Shelf {
    /// An empty one.
    pub(super) fn new(shown: Shown, fence: Fence) -> Shelf {
        Shelf {
            shown,
            fence,
            listing: Mutex::default(),
            asked: Condvar::new(),
            changes: broadcast::Sender::new(MOST_WAITING),
        }
    }

    fn lock(&self) -> MutexGuard<'_, Listing> {
        self.listing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn tell(&self, change: Change) {
        // Nobody may listen.
        let _ = self.changes.send(change);
    }

    pub(super) fn subscribe(&self) -> broadcast::Receiver<Change> {
        self.changes.subscribe()
    }

    pub(super) fn report(&self, path: &Path) -> Result<String, String> {
        (self.shown.report)(path)
    }

    pub(super) fn folders(&self) -> &[Root] {
        &self.shown.roots
    }

    /// For `/api/start`.
    pub(super) fn roots(&self) -> Vec<Value> {
        let roots = self.shown.roots.iter();
        roots
            .map(|root| {
                let name = root.folder.file_name().unwrap_or(root.folder.as_os_str());
                json!({ "name": name.to_string_lossy(), "uri": uri_of(&root.folder) })
            })
            .collect()
    }

    /// The URIs of the files that were named by themselves.
    pub(super) fn opened(&self) -> Vec<String> {
        let opened = self.shown.opened.iter();
        opened.filter_map(|path| uri_of(path)).collect()
    }

    /// True where a `wedm.toml` holds for each folder.
    pub(super) fn has_settings(&self) -> bool {
        let has = |root: &Root| {
            let mut folders = root.folder.ancestors();
            folders.any(|folder| settings::is_there(&folder.join(settings::FILE_NAME)))
        };
        self.shown.roots.iter().all(has)
    }

    /// For `/api/files`.
    pub(super) fn listed(&self) -> Value {
        let listing = self.lock();
        let files = listing.entries.iter();
        let is_counted = listing.is_found && !listing.is_counting && listing.uncounted.is_empty();
        json!({
            "files": files.map(|(path, entry)| self.listed_file(path, entry)).collect::<Vec<_>>(),
            "pending": !is_counted,
            "left": listing.left,
        })
    }

    fn listed_file(&self, path: &Path, entry: &Entry) -> Value {
        let roots = self.shown.roots.iter();
        let rest = roots
            .filter_map(|root| path.strip_prefix(&root.folder).ok())
            .next();
        let language = match FileKind::of_ending(&ending_of(path)) {
            Some(FileKind::Drawing) => "dxf",
            Some(FileKind::Program(language)) => language.id(),
            None => "toml",
        };
        let (counts, trouble) = match &entry.counted {
            None => (None, None),
            Some(Ok(counts)) => (Some(counts), None),
            Some(Err(sentence)) => (None, Some(sentence)),
        };
        json!({
            "uri": uri_of(path),
            "path": rest.unwrap_or(path).to_string_lossy().replace('\\', "/"),
            "language": language,
            "bytes": entry.stamp.bytes,
            "modified": entry.stamp.milliseconds(),
            "errors": counts.map(|counts| counts.errors),
            "warnings": counts.map(|counts| counts.warnings),
            "trouble": trouble,
        })
    }

    /// The files that there are now, those first that were named by themselves.
    pub(super) fn find(&self) -> BTreeMap<PathBuf, Stamp> {
        let mut paths: BTreeSet<PathBuf> = BTreeSet::new();
        for root in &self.shown.roots {
            let found = (self.shown.find)(root);
            let folders = found.iter().filter_map(|path| path.parent());
            let folders: BTreeSet<&Path> = folders.chain([&*root.folder]).collect();
            let of_settings = folders
                .iter()
                .map(|folder| folder.join(settings::FILE_NAME));
            paths.extend(of_settings.filter(|path| path.is_file()));
            paths.extend(found);
        }
        let (named, others): (Vec<PathBuf>, Vec<PathBuf>) = (paths.into_iter())
            .filter(|path| self.fence.encloses(path) && uri_of(path).is_some())
            .partition(|path| self.shown.opened.contains(path));
        let count = named.len() + others.len();
        self.lock().left = count.saturating_sub(MOST);
        let all = named.into_iter().chain(others).take(MOST);
        all.filter_map(|path| Some((path.clone(), self.look_at(&path)?)))
            .collect()
    }

    /// A file as it is on disk; of a link that leads out, the link.
    pub(super) fn look_at(&self, path: &Path) -> Option<Stamp> {
        let own = std::fs::symlink_metadata(path).ok()?;
        let leads_out = own.is_symlink() && self.fence.place(path, |_| true).is_err();
        let metadata = match own.is_symlink() && !leads_out {
            true => std::fs::metadata(path).ok()?,
            false => own,
        };
        (leads_out || metadata.is_file()).then(|| Stamp {
            bytes: metadata.len(),
            modified: metadata.modified().unwrap_or(UNIX_EPOCH),
        })
    }

    /// True for a path, not known yet, at which or below which there may be files of ours, or were.
    pub(super) fn may_hold(&self, path: &Path) -> bool {
        let is_named = path.file_name() == Some(settings::FILE_NAME.as_ref());
        let is_ours = is_named || FileKind::of_ending(&ending_of(path)).is_some();
        is_ours || path.is_dir() || self.lock().entries.keys().any(|own| own.starts_with(path))
    }

    /// What is known of each file.
    pub(super) fn stamps(&self) -> BTreeMap<PathBuf, Stamp> {
        let listing = self.lock();
        let stamps = listing.entries.iter();
        stamps
            .map(|(path, entry)| (path.clone(), entry.stamp))
            .collect()
    }

    pub(super) fn stamp(&self, path: &Path) -> Option<Stamp> {
        Some(self.lock().entries.get(path)?.stamp)
    }

    /// Everything has been found once.
    pub(super) fn begin(&self, found: BTreeMap<PathBuf, Stamp>) {
        let mut listing = self.lock();
        listing.uncounted = found.keys().cloned().collect();
        let entry = |stamp| Entry {
            stamp,
            counted: None,
        };
        listing.entries = (found.into_iter())
            .map(|(path, stamp)| (path, entry(stamp)))
            .collect();
        listing.is_found = true;
        drop(listing);
        self.asked.notify_one();
        self.tell(Change::Files);
    }

    /// A file has settled: it was written, or is gone. What depends on it is counted again.
    pub(super) fn settle(&self, path: &Path, stamp: Option<Stamp>) {
        let mut listing = self.lock();
        let old = listing.entries.remove(path);
        if let Some(stamp) = stamp {
            // What was counted is shown until it is counted again.
            let counted = old.as_ref().and_then(|old| old.counted.clone());
            let entry = Entry { stamp, counted };
            listing.entries.insert(path.to_path_buf(), entry);
            listing.uncounted.insert(path.to_path_buf());
        }
        let dependent = listing.entries.keys().filter(|other| depends(other, path));
        let dependent: Vec<PathBuf> = dependent.cloned().collect();
        listing.uncounted.extend(dependent);
        drop(listing);
        if old.is_some() != stamp.is_some() {
            self.tell(Change::Files);
        }
        if let (Some(stamp), Some(uri)) = (stamp, uri_of(path)) {
            let modified = stamp.milliseconds();
            self.tell(Change::Saved { uri, modified });
        }
        self.asked.notify_one();
    }

    /// Counts for ever.
    pub(super) fn count(&self) {
        let mut told = Instant::now();
        loop {
            let mut listing = self.lock();
            listing.is_counting = false;
            let Some(path) = listing.uncounted.pop_first() else {
                drop(listing);
                self.tell(Change::Files);
                let listing = self.lock();
                drop(
                    self.asked
                        .wait_while(listing, |listing| listing.uncounted.is_empty()),
                );
                continue;
            };
            let stamp = listing.entries.get(&path).map(|entry| entry.stamp);
            listing.is_counting = true;
            drop(listing);
            let counted = stamp.map(|stamp| self.counted(&path, stamp));
            if let Some(entry) = self.lock().entries.get_mut(&path)
                && Some(entry.stamp) == stamp
            {
                entry.counted = counted;
            }
            if told.elapsed() > PULSE {
                told = Instant::now();
                self.tell(Change::Files);
            }
        }
    }

    fn counted(&self, path: &Path, stamp: Stamp) -> Result<Counts, String> {
        if stamp.bytes > LARGEST {
            return Err(say!(it_has_too_many_bytes, stamp.bytes, LARGEST));
        }
        self.fence.open(path)?;
        let count = || (self.shown.count)(path, &self.fence);
        catch_unwind(AssertUnwindSafe(count))
            .unwrap_or_else(|_| Err(say!(internal_error_the_document_could_not_be_judged).into()))
    }
}

/// True where another file's faults may be others once this one has changed: settings hold for all below them, and a
/// drawing and the programs in its folder are compared.
fn depends(other: &Path, changed: &Path) -> bool {
    let kind = |path: &Path| FileKind::of_ending(&ending_of(path));
    let (Some(folder), Some(of_other)) = (changed.parent(), kind(other)) else {
        return false;
    };
    match kind(changed) {
        None => other.starts_with(folder),
        Some(of_changed) => {
            let is_drawing = |kind| kind == FileKind::Drawing;
            other.parent() == Some(folder) && is_drawing(of_changed) != is_drawing(of_other)
        }
    }
}
