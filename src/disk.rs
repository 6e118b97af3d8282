//! Reads and writes files: never more than fits in memory, and never over a file that has changed since it was read.

mod fence;
mod temporary;

pub(crate) use fence::{Barred, Fence};

use rustc_hash::FxHasher;
use std::fs::{File, Metadata};
use std::hash::Hasher;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;
use temporary::Temporary;

/// The identity of a file when it was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Seen {
    identity: Option<[u64; 2]>,
    length: usize,
    digest: u64,
}

/// The bytes of `file`, at most `cap` of them: a device or a pipe may have no end.
///
/// # Errors
/// A sentence: it cannot be read, or is larger.
pub(crate) fn read_at_most(file: &File, cap: u64) -> Result<Vec<u8>, String> {
    let metadata = file.metadata().map_err(|error| plain(&error))?;
    let mut bytes = Vec::new();
    if metadata.is_file() {
        if metadata.len() > cap {
            return Err(say!(it_has_too_many_bytes, metadata.len(), cap));
        }
        bytes.reserve_exact(
            usize::try_from(metadata.len())
                .unwrap_or_default()
                .saturating_add(1),
        );
    }
    read_stream_at_most(file, cap, bytes)
}

/// The same for a stream, appended to `bytes`.
pub(crate) fn read_stream_at_most(
    stream: impl Read,
    cap: u64,
    mut bytes: Vec<u8>,
) -> Result<Vec<u8>, String> {
    stream
        .take(cap.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(|error| plain(&error))?;
    if bytes.len() as u64 > cap {
        return Err(say!(it_holds_too_many_bytes, cap));
    }
    Ok(bytes)
}

/// The ending of a name, in lower case; empty where there is none.
pub(crate) fn ending_of(path: &Path) -> String {
    let ending = path.extension().unwrap_or_default();
    ending.to_string_lossy().to_ascii_lowercase()
}

/// Opens a file that nobody has named on the command line: a pipe or a device may have no end, or wait for ever for the other
/// side, and is an error.
pub(crate) fn open_regular(path: &Path) -> Result<File, String> {
    let mut options = File::options();
    options.read(true);
    #[cfg(unix)]
    {
        // Not even opening a pipe that has taken the file's place meanwhile waits.
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags(libc::O_NONBLOCK | libc::O_NOCTTY);
    }
    let is_regular = std::fs::metadata(path).map(|metadata| metadata.is_file());
    if !is_regular.map_err(|error| plain(&error))? {
        return Err(say!(it_is_no_regular_file).into());
    }
    let file = options.open(path).map_err(|error| plain(&error))?;
    match file.metadata().map(|metadata| metadata.is_file()) {
        Ok(true) => Ok(file),
        Ok(false) => Err(say!(it_is_no_regular_file).into()),
        Err(error) => Err(plain(&error)),
    }
}

/// [`read_at_most`] for a regular file.
pub(crate) fn read_path_at_most(path: &Path, cap: u64) -> Result<Vec<u8>, String> {
    read_at_most(&open_regular(path)?, cap)
}

/// True for a name that leads to another computer: a share of the network, or an address.
pub(crate) fn leads_to_the_network(name: &str) -> bool {
    let slashes = name.replace('\\', "/");
    slashes.starts_with("//") || slashes.contains("://")
}

/// A file of which parts are read again, as long as it has not been written to.
pub(crate) struct Unchanged {
    file: Mutex<File>,
    stamp: (u64, SystemTime),
}

impl Unchanged {
    /// The file as it is now; `None` where the system does not tell when it was written.
    pub(crate) fn of(file: &File) -> Option<Unchanged> {
        Some(Unchanged {
            stamp: stamp(file)?,
            file: Mutex::new(file.try_clone().ok()?),
        })
    }

    /// A range of its bytes; `None` where they cannot be read, or the file has been written to.
    pub(crate) fn read(&self, range: Range<usize>) -> Option<Vec<u8>> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(range.start as u64)).ok()?;
        let mut bytes = Vec::with_capacity(range.len());
        let most = range.len() as u64;
        (&mut *file).take(most).read_to_end(&mut bytes).ok()?;
        (stamp(&file)? == self.stamp).then_some(bytes)
    }
}

fn stamp(file: &File) -> Option<(u64, SystemTime)> {
    let metadata = file.metadata().ok()?;
    Some((metadata.len(), metadata.modified().ok()?))
}

impl Seen {
    /// The identity of `file`, which has these bytes.
    pub(crate) fn of(file: &File, bytes: &[u8]) -> Result<Seen, String> {
        let metadata = file.metadata().map_err(|error| plain(&error))?;
        Ok(Seen {
            identity: identity(&metadata),
            length: bytes.len(),
            digest: digest(bytes),
        })
    }
}

fn digest(bytes: &[u8]) -> u64 {
    let mut hasher = FxHasher::default();
    hasher.write(bytes);
    hasher.finish()
}

/// A word for what a file holds: other bytes have another.
pub(crate) fn revision(bytes: &[u8]) -> String {
    format!("{:x}-{:016x}", bytes.len(), digest(bytes))
}

/// Device and number of a file, where a system has them.
#[cfg(unix)]
fn identity(metadata: &Metadata) -> Option<[u64; 2]> {
    use std::os::unix::fs::MetadataExt;
    Some([metadata.dev(), metadata.ino()])
}

#[cfg(not(unix))]
fn identity(_: &Metadata) -> Option<[u64; 2]> {
    None
}

/// Writes to `path`: a regular file is [replaced](replace), a device or a pipe is written to.
/// Returns the number of other names of an old file.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<u64, String> {
    match std::fs::metadata(path) {
        Ok(metadata) if !metadata.is_file() && !metadata.is_dir() => std::fs::write(path, bytes)
            .map(|()| 0)
            .map_err(|error| plain(&error)),
        _ => replace(path, None, bytes),
    }
}

/// Puts a new file in place of the one at `path`, or where there is none.
///
/// The bytes are first written beside it, to a file that nobody else may read. That file then gets the owner, the
/// permissions and the name of the old one, so nobody ever sees half of it. A link stays a link to
/// a new file. Returns the number of other names (hard links) of the old file, which keep the old
/// content.
///
/// # Errors
/// A sentence, with nothing changed: the path is not a regular file or is read-only, the file is not the one that was
/// `read`, or the new one cannot have its owner.
pub(crate) fn replace(path: &Path, read: Option<&Seen>, bytes: &[u8]) -> Result<u64, String> {
    replaced(path, read, bytes).map_err(|error| plain(&error))
}

fn replaced(path: &Path, read: Option<&Seen>, bytes: &[u8]) -> io::Result<u64> {
    let refused = |kind: ErrorKind, reason: &str| Err(io::Error::new(kind, reason));
    let old = match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => {
            return refused(ErrorKind::IsADirectory, say!(it_is_a_folder));
        }
        Ok(metadata) if !metadata.is_file() => {
            return refused(ErrorKind::InvalidInput, say!(it_is_no_regular_file));
        }
        Ok(metadata) if metadata.permissions().readonly() => {
            return refused(ErrorKind::PermissionDenied, say!(it_is_read_only));
        }
        Ok(metadata) => Some(metadata),
        Err(error) if error.kind() == ErrorKind::NotFound && read.is_none() => None,
        Err(error) => return Err(error),
    };
    let path = if old.is_some() {
        path.canonicalize()?
    } else {
        path.to_path_buf()
    };
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    // What stands for an old file is private until it has the old permissions.
    let mut beside = Temporary::in_folder(folder, old.is_some())?;
    let file = beside.file();
    file.write_all(bytes)?;
    if let Some(old) = &old {
        give_owner(file, old)?;
        file.set_permissions(old.permissions())?;
    }
    file.sync_all()?;
    // As late as possible, so as not to lose what somebody else wrote meanwhile.
    if let Some(read) = read
        && !is_still(&path, read)?
    {
        return refused(
            ErrorKind::InvalidData,
            say!(it_is_not_the_file_any_more_that_was_read),
        );
    }
    beside.persist(&path)?;
    sync(folder);
    Ok(old.as_ref().map_or(0, other_names))
}

/// Writes a file where there is none, beside and renamed as [`replace`] does. The error is `AlreadyExists` where there is
/// one by now.
pub(crate) fn create(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if std::fs::symlink_metadata(path).is_ok() {
        return Err(ErrorKind::AlreadyExists.into());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut beside = Temporary::in_folder(folder, false)?;
    beside.file().write_all(bytes)?;
    beside.file().sync_all()?;
    beside.persist_new(path)?;
    sync(folder);
    Ok(())
}

/// True for a regular file with other bytes than these.
pub(crate) fn holds_else(path: &Path, bytes: &[u8]) -> bool {
    match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_file() => {
            metadata.len() != bytes.len() as u64
                || read_path_at_most(path, metadata.len()).as_deref() != Ok(bytes)
        }
        _ => false,
    }
}

fn is_still(path: &Path, read: &Seen) -> io::Result<bool> {
    let file = File::open(path)?;
    // One byte more tells a longer file from this one.
    let bytes = match read_at_most(&file, read.length as u64) {
        Ok(bytes) => bytes,
        Err(_) => return Ok(false),
    };
    Ok(Seen::of(&file, &bytes).map_err(io::Error::other)? == *read)
}

#[cfg(unix)]
fn give_owner(new: &File, old: &Metadata) -> io::Result<()> {
    use std::os::unix::fs::{MetadataExt, fchown};
    let own = new.metadata()?;
    if (own.uid(), own.gid()) == (old.uid(), old.gid()) {
        return Ok(());
    }
    fchown(new, Some(old.uid()), Some(old.gid())).map_err(|error| {
        let reason = say!(
            its_owner_user_group_cannot_be_kept,
            old.uid(),
            old.gid(),
            plain(&error)
        );
        io::Error::new(error.kind(), reason)
    })
}

/// The folder decides the owner of a new file.
#[cfg(not(unix))]
fn give_owner(_: &File, _: &Metadata) -> io::Result<()> {
    Ok(())
}

#[cfg(unix)]
fn other_names(old: &Metadata) -> u64 {
    use std::os::unix::fs::MetadataExt;
    old.nlink().saturating_sub(1)
}

#[cfg(not(unix))]
fn other_names(_: &Metadata) -> u64 {
    0
}

/// Makes the new name durable. The file is in place by now, so it is not an error where a system
/// cannot do this.
fn sync(folder: &Path) {
    if cfg!(unix) {
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
    }
}

/// The system's reason without its number.
pub(crate) fn plain(error: &io::Error) -> String {
    let of_kind = match error.kind() {
        ErrorKind::NotFound => Some(say!(no_such_file_or_directory)),
        ErrorKind::PermissionDenied => Some(say!(permission_denied)),
        ErrorKind::NotADirectory => Some(say!(not_a_directory)),
        ErrorKind::IsADirectory => Some(say!(is_a_directory)),
        ErrorKind::StorageFull => Some(say!(no_space_left_on_device)),
        ErrorKind::ReadOnlyFilesystem => Some(say!(read_only_file_system)),
        _ => None,
    };
    if let Some(sentence) = of_kind {
        return sentence.to_owned();
    }
    let text = error.to_string();
    let short = text.split(" (os error").next().unwrap_or(&text);
    let mut characters = short.chars();
    characters.next().map_or_else(String::new, |first| {
        first.to_lowercase().chain(characters).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_is_read_than_can_be_held() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "12345").unwrap();
        assert_eq!(read_path_at_most(&path, 5), Ok(b"12345".to_vec()));
        assert_eq!(
            read_path_at_most(&path, 4),
            Err("it has 5 bytes, expected at most 4".into())
        );
        assert_eq!(
            read_path_at_most(&folder.path().join("b"), 4),
            Err("no such file or directory".into())
        );
    }

    #[test]
    fn a_part_is_read_again_until_somebody_writes_to_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "12345").unwrap();
        let file = File::open(&path).unwrap();
        let unchanged = Unchanged::of(&file).unwrap();
        assert_eq!(read_at_most(&file, 5), Ok(b"12345".to_vec()));
        assert_eq!(unchanged.read(1..3), Some(b"23".to_vec()));
        assert_eq!(unchanged.read(0..5), Some(b"12345".to_vec()));
        std::fs::write(&path, "1234").unwrap();
        assert_eq!(unchanged.read(1..3), None);
    }

    #[cfg(unix)]
    #[test]
    fn what_has_no_end_is_read_up_to_the_cap() {
        let read = |path: &str| read_at_most(&File::open(path).unwrap(), 1000);
        let sentence = "it has more than 1000 bytes, expected at most that many";
        assert_eq!(read("/dev/zero"), Err(sentence.into()));
        assert_eq!(read("/dev/null"), Ok(Vec::new()));
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_regular_file_is_not_opened() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("a.dxf");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        let link = folder.path().join("b.dxf");
        std::os::unix::fs::symlink(&pipe, &link).unwrap();
        for path in [&*pipe, &*link, Path::new("/dev/zero"), folder.path()] {
            assert_eq!(
                read_path_at_most(path, 1000),
                Err(say!(it_is_no_regular_file).into()),
                "{}",
                path.display()
            );
        }
    }

    #[test]
    fn only_the_file_that_was_read_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let read =
            || Seen::of(&File::open(&path).unwrap(), &std::fs::read(&path).unwrap()).unwrap();
        std::fs::write(&path, "old").unwrap();
        let seen = read();
        assert_eq!(replace(&path, Some(&seen), b"new"), Ok(0));
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        let changes: [fn(&Path); 4] = [
            |path| std::fs::write(path, "net").unwrap(),
            |path| std::fs::write(path, "newer").unwrap(),
            |path| std::fs::write(path, "").unwrap(),
            |path| std::fs::remove_file(path).unwrap(),
        ];
        for (index, change) in changes.into_iter().enumerate() {
            std::fs::write(&path, "new").unwrap();
            let seen = read();
            change(&path);
            let now = std::fs::read(&path).ok();
            assert!(replace(&path, Some(&seen), b"repaired").is_err(), "{index}");
            assert_eq!(std::fs::read(&path).ok(), now, "{index}");
        }
        assert_eq!(
            std::fs::read_dir(folder.path()).unwrap().count(),
            0,
            "a temporary file is left"
        );
    }

    #[cfg(unix)]
    #[test]
    fn another_file_of_the_same_content_is_another_file() {
        let folder = tempfile::tempdir().unwrap();
        let (path, other) = (folder.path().join("a"), folder.path().join("b"));
        for path in [&path, &other] {
            std::fs::write(path, "same").unwrap();
        }
        let seen = Seen::of(&File::open(&path).unwrap(), b"same").unwrap();
        std::fs::rename(&other, &path).unwrap();
        assert_eq!(
            replace(&path, Some(&seen), b"new"),
            Err("it is no longer the file that was read, nothing is changed".into())
        );
    }

    #[cfg(unix)]
    #[test]
    fn owner_mode_and_links_are_kept() {
        use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (path, link, second) = (
            folder.path().join("a"),
            folder.path().join("link"),
            folder.path().join("second"),
        );
        std::fs::write(&path, "old").unwrap();
        std::fs::set_permissions(&path, PermissionsExt::from_mode(0o640)).unwrap();
        // Only root may give a file away.
        let is_given = chown(&path, Some(12_345), Some(54_321)).is_ok();
        symlink(&path, &link).unwrap();
        std::fs::hard_link(&path, &second).unwrap();
        assert_eq!(replace(&link, None, b"new"), Ok(1));
        assert!(link.is_symlink());
        assert_eq!(
            (
                std::fs::read(&path).unwrap(),
                std::fs::read(&second).unwrap()
            ),
            (b"new".to_vec(), b"old".to_vec())
        );
        let metadata = std::fs::metadata(&path).unwrap();
        assert_eq!(metadata.mode() & 0o7777, 0o640);
        if is_given {
            assert_eq!((metadata.uid(), metadata.gid()), (12_345, 54_321));
        }
    }

    #[cfg(unix)]
    #[test]
    fn what_stands_for_an_old_file_is_nobody_elses_to_read() {
        use std::os::unix::fs::MetadataExt;
        let folder = tempfile::tempdir().unwrap();
        let mode = |stands_for_old| {
            let mut beside = Temporary::in_folder(folder.path(), stands_for_old).unwrap();
            beside.file().metadata().unwrap().mode() & 0o777
        };
        assert_eq!(mode(true), 0o600);
        assert_ne!(mode(false), 0o600);
    }
}
