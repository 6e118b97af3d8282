//! Watches the files that are shown. The system reports changes where it can; everything is looked at again now and then
//! where it cannot, as on drives of a network.
//!
//! A file that is being written changes several times. It has *settled* once it has stayed as it is for a moment.

use super::shelf::{Change, Shelf, Stamp};
use crate::server::uri_of;
use notify::{EventKind, RecursiveMode, Watcher};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::{Duration, Instant};

/// A file has settled when its size and time have been the same for this long.
const SETTLED: Duration = Duration::from_millis(100);
/// How often everything is looked at where the system reports all changes, and where it does not.
const SELDOM: Duration = Duration::from_secs(3);
const OFTEN: Duration = Duration::from_millis(300);
/// Looking at everything takes at most one part in this many of the time.
const SHARE: u32 = 10;
/// More reports than this at a time are one: that everything is to be looked at.
const MOST: usize = 1024;

/// A file that changes: how it was seen last, and since when.
struct Unsettled {
    stamp: Option<Stamp>,
    since: Instant,
}

struct Watch<'a> {
    shelf: &'a Shelf,
    unsettled: BTreeMap<PathBuf, Unsettled>,
}

/// Watches for ever.
pub(super) fn watch(shelf: &Shelf) {
    let (reports, reported) = sync_channel(MOST);
    let missed = Arc::new(AtomicBool::new(false));
    let missed_by = missed.clone();
    let handler = move |event: notify::Result<notify::Event>| {
        let paths = match event {
            // Reading changes nothing, and we read ourselves.
            Ok(event) if matches!(event.kind, EventKind::Access(_)) => return,
            Ok(event) if !event.need_rescan() => event.paths,
            _ => Vec::new(),
        };
        if paths.is_empty()
            || paths
                .into_iter()
                .any(|path| reports.try_send(path).is_err())
        {
            missed_by.store(true, Ordering::Release);
        }
    };
    // Held, for it reports only as long as it lives.
    let mut watcher = notify::recommended_watcher(handler);
    let mut is_watched = |folder: &Path, mode| match &mut watcher {
        Ok(watcher) => watcher.watch(folder, mode).is_ok(),
        Err(_) => false,
    };
    let mut all_watched = true;
    for root in shelf.folders() {
        let mode = match root.has_subfolders {
            true => RecursiveMode::Recursive,
            false => RecursiveMode::NonRecursive,
        };
        all_watched &= is_watched(&root.folder, mode);
    }
    let pause = if all_watched { SELDOM } else { OFTEN };
    shelf.begin(shelf.find());
    let watch = Watch {
        shelf,
        unsettled: BTreeMap::new(),
    };
    watch.run(&reported, &missed, pause);
}

impl Watch<'_> {
    fn run(mut self, reported: &Receiver<PathBuf>, missed: &AtomicBool, pause: Duration) {
        let mut next_look = Instant::now() + pause;
        let (mut is_due, mut not_before) = (false, Instant::now());
        loop {
            let next = if is_due { not_before } else { next_look };
            let settling = self.unsettled.values();
            let settled = settling.map(|unsettled| unsettled.since + SETTLED).min();
            let until = settled.map_or(next, |settled| settled.min(next));
            let wait = until.saturating_duration_since(Instant::now());
            let mut touched = BTreeSet::new();
            match reported.recv_timeout(wait) {
                Ok(path) => touched.extend([path].into_iter().chain(reported.try_iter())),
                Err(RecvTimeoutError::Timeout) => {}
                // The system reports nothing.
                Err(RecvTimeoutError::Disconnected) => std::thread::sleep(wait),
            }
            is_due |= missed.swap(false, Ordering::AcqRel) || Instant::now() >= next_look;
            for path in touched {
                match self.shelf.stamp(&path).is_some() || self.unsettled.contains_key(&path) {
                    true => self.see(&path, self.shelf.look_at(&path)),
                    // Only a search knows whether it is one of ours, or holds such.
                    false => is_due |= self.shelf.may_hold(&path),
                }
            }
            if is_due && Instant::now() >= not_before {
                let began = Instant::now();
                self.look();
                not_before = Instant::now() + began.elapsed() * SHARE;
                next_look = not_before + pause;
                is_due = false;
            }
            self.settle();
        }
    }

    /// Looks at all files.
    fn look(&mut self) {
        let found = self.shelf.find();
        let known = self.shelf.stamps();
        for path in known.keys().chain(found.keys()) {
            let stamp = found.get(path).copied();
            if known.get(path) != stamp.as_ref() {
                self.see(path, stamp);
            }
        }
    }

    /// A file looks like this now.
    fn see(&mut self, path: &Path, stamp: Option<Stamp>) {
        let known = self.shelf.stamp(path);
        let before = self.unsettled.get(path);
        if before.map_or(known == stamp, |before| before.stamp == stamp) {
            return;
        }
        if before.is_none()
            && known.is_some()
            && let Some(uri) = uri_of(path)
        {
            self.shelf.tell(Change::Writing { uri });
        }
        let since = Instant::now();
        self.unsettled
            .insert(path.to_path_buf(), Unsettled { stamp, since });
    }

    fn settle(&mut self) {
        let due: Vec<PathBuf> = (self.unsettled.iter())
            .filter(|(_, unsettled)| unsettled.since.elapsed() >= SETTLED)
            .map(|(path, _)| path.clone())
            .collect();
        for path in due {
            let stamp = self.shelf.look_at(&path);
            self.see(&path, stamp);
            let is_settled = |unsettled: &Unsettled| unsettled.since.elapsed() >= SETTLED;
            if self.unsettled.get(&path).is_some_and(is_settled) {
                self.unsettled.remove(&path);
                self.shelf.settle(&path, stamp);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::shelf::{Counts, Root, Shown};
    use super::*;
    use crate::disk::Fence;

    fn find(root: &Root) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(&root.folder).unwrap();
        entries.map(|entry| entry.unwrap().path()).collect()
    }

    /// As on a drive of which the system reports nothing.
    #[test]
    fn what_changes_is_found_without_any_report() {
        let folder = tempfile::tempdir().unwrap();
        let (old, new) = (folder.path().join("a.dxf"), folder.path().join("b.dxf"));
        std::fs::write(&old, "old").unwrap();
        let root = Root {
            folder: folder.path().to_path_buf(),
            has_subfolders: true,
        };
        let shown = Shown {
            roots: vec![root],
            opened: Vec::new(),
            find,
            count: |_, _| Ok(Counts::default()),
            report: |_| Err(String::new()),
        };
        let fence = Fence::around([folder.path().to_path_buf()]).unwrap();
        let shelf = Shelf::new(shown, fence);
        shelf.begin(shelf.find());
        let mut changes = shelf.subscribe();
        let mut watch = Watch {
            shelf: &shelf,
            unsettled: BTreeMap::new(),
        };
        let mut seen = Vec::new();
        let mut wait_for = |what: &str, uri: &Path| {
            let uri = uri_of(uri).unwrap_or_default();
            let is_it = |event: &String| event.contains(what) && event.contains(&uri);
            while !seen.iter().any(is_it) {
                watch.look();
                watch.settle();
                while let Ok(change) = changes.try_recv() {
                    seen.push(change.as_event());
                }
            }
            std::mem::take(&mut seen)
        };
        std::fs::write(&old, "changed").unwrap();
        let events = wait_for("saved", &old);
        assert!(events[0].contains("writing"), "{events:?}");
        std::fs::write(&new, "new").unwrap();
        let events = wait_for("saved", &new);
        assert!(!events.concat().contains("writing"), "{events:?}");
        std::fs::remove_file(&new).unwrap();
        wait_for("files", Path::new(""));
        assert_eq!(shelf.stamps().into_keys().collect::<Vec<_>>(), [old]);
    }
}
