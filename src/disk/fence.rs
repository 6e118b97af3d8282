//! Folders beyond which nothing is read or written: their names decide first, and then where links lead.
//!
//! A name is looked at before the disk is, so that no share of another computer is asked for. What was opened is looked up
//! again, since another file may have taken its place between the look and the opening.

use super::{identity, open_regular, plain};
use std::fmt::{self, Display, Formatter};
use std::fs::File;
use std::io::{self, ErrorKind};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

/// The folders; without any everything is within.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fence {
    folders: Option<Arc<[Enclosed]>>,
}

#[derive(Debug)]
struct Enclosed {
    /// As its files are named.
    named: PathBuf,
    /// Where links lead.
    real: PathBuf,
}

/// Why there is no way to a file.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Barred {
    Outside,
    Missing,
    /// A sentence.
    Faulty(String),
}

impl Display for Barred {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Barred::Outside => say!(it_lies_outside),
            Barred::Missing => say!(no_such_file_or_directory),
            Barred::Faulty(reason) => reason,
        })
    }
}

impl From<Barred> for String {
    fn from(barred: Barred) -> String {
        barred.to_string()
    }
}

impl From<io::Error> for Barred {
    fn from(error: io::Error) -> Barred {
        match error.kind() {
            ErrorKind::NotFound | ErrorKind::NotADirectory => Barred::Missing,
            _ => Barred::Faulty(plain(&error)),
        }
    }
}

impl Fence {
    /// A fence around folders that are there, each an absolute path.
    pub(crate) fn around(folders: impl IntoIterator<Item = PathBuf>) -> io::Result<Fence> {
        let enclosed = folders.into_iter().map(|named| {
            let real = named.canonicalize()?;
            Ok(Enclosed { named, real })
        });
        Ok(Fence {
            folders: Some(enclosed.collect::<io::Result<_>>()?),
        })
    }

    /// True for a path whose name is of something within; the disk is not asked.
    pub(crate) fn encloses(&self, path: &Path) -> bool {
        self.within(path, |folder| &folder.named).is_some()
    }

    /// The rest of a path behind its folder.
    fn within<'path>(
        &self,
        path: &'path Path,
        of: impl Fn(&Enclosed) -> &PathBuf,
    ) -> Option<&'path Path> {
        let Some(folders) = &self.folders else {
            return Some(path);
        };
        let leads_up = path.components().any(|part| part == Component::ParentDir);
        let rests = folders
            .iter()
            .filter_map(|folder| path.strip_prefix(of(folder)).ok());
        // Of folders in each other the innermost.
        let rest = rests.min_by_key(|rest| rest.as_os_str().len());
        rest.filter(|_| !leads_up)
    }

    /// The real place of a file that may not be there yet, if `is_wanted` takes what stands behind the folder both in its
    /// name and in its real place.
    pub(crate) fn place(
        &self,
        path: &Path,
        is_wanted: impl Fn(&Path) -> bool,
    ) -> Result<PathBuf, Barred> {
        let named = self.within(path, |folder| &folder.named);
        named
            .filter(|rest| is_wanted(rest))
            .ok_or(Barred::Outside)?;
        let real = match path.canonicalize() {
            // A link to nothing would be written through.
            Err(error)
                if error.kind() == ErrorKind::NotFound
                    && std::fs::symlink_metadata(path).is_err() =>
            {
                let (folder, name) = path.parent().zip(path.file_name()).ok_or(Barred::Missing)?;
                folder.canonicalize()?.join(name)
            }
            real => real?,
        };
        let rest = self.within(&real, |folder| &folder.real);
        rest.filter(|rest| is_wanted(rest)).ok_or(Barred::Outside)?;
        Ok(real)
    }

    /// Opens a regular file within.
    pub(crate) fn open(&self, path: &Path) -> Result<File, Barred> {
        if self.folders.is_none() {
            return open_regular(path).map_err(Barred::Faulty);
        }
        if !self.encloses(path) {
            return Err(Barred::Outside);
        }
        let place = self.real_place(path)?;
        let file = open_regular(&place).map_err(Barred::Faulty)?;
        // A link that stood there meanwhile led to another file than the one that is there now.
        let now = std::fs::symlink_metadata(self.real_place(&place)?)?;
        match identity(&now) == identity(&file.metadata()?) {
            true => Ok(file),
            false => Err(Barred::Outside),
        }
    }

    /// Where links lead, if that is within.
    fn real_place(&self, path: &Path) -> Result<PathBuf, Barred> {
        let real = path.canonicalize()?;
        match self.within(&real, |folder| &folder.real) {
            Some(_) => Ok(real),
            None => Err(Barred::Outside),
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn only_what_lies_within_by_its_name_and_in_truth_is_opened() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["inside", "inside/sub", "beside", "inside/.hidden"] {
            std::fs::create_dir(at(name)).unwrap();
        }
        for name in ["inside/a", "inside/sub/b", "beside/c", "inside/.hidden/d"] {
            std::fs::write(at(name), name).unwrap();
        }
        symlink(at("beside/c"), at("inside/out")).unwrap();
        symlink(at("beside"), at("inside/folder")).unwrap();
        symlink(at("inside/a"), at("inside/in")).unwrap();
        symlink(at("beside/none"), at("inside/nothing")).unwrap();
        symlink(at("inside"), at("link")).unwrap();
        let fence = Fence::around([at("inside"), at("link")]).unwrap();
        let check = |name: &str, expected: Option<Barred>| {
            assert_eq!(fence.open(&at(name)).err(), expected, "{name}");
        };
        for name in [
            "inside/a",
            "inside/sub/b",
            "inside/in",
            "link/a",
            "inside/./a",
        ] {
            check(name, None);
        }
        for name in [
            "beside/c",
            "inside/out",
            "inside/folder/c",
            "inside/../beside/c",
            "inside/sub/../a",
            "inside2/a",
            "",
        ] {
            check(name, Some(Barred::Outside));
        }
        check("inside/none", Some(Barred::Missing));
        check("inside/nothing", Some(Barred::Missing));
        let is_shown = |path: &Path| !path.to_string_lossy().contains(".hidden");
        let place = |name: &str| fence.place(&at(name), is_shown);
        let real = folder.path().canonicalize().unwrap();
        assert_eq!(place("link/new"), Ok(real.join("inside/new")));
        assert_eq!(place("inside/in"), Ok(real.join("inside/a")));
        assert_eq!(place("inside/.hidden/d"), Err(Barred::Outside));
        assert_eq!(place("inside/folder/new"), Err(Barred::Outside));
        assert_eq!(place("inside/nothing"), Err(Barred::Missing));
        assert_eq!(place("inside/none/new"), Err(Barred::Missing));
    }
}
