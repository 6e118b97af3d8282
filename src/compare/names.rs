//! Finds the drawing of a program: the one that a comment of it names, the one in the settings, else the one of its own
//! name. A comment never leads out of the program's folder: programs come from strangers.

use crate::disk::{Fence, ending_of};
use crate::dxf;
use crate::program::Language;
use crate::text::Writing;
use rustc_hash::FxHashMap;
use std::io::Read as _;
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The drawing of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    pub path: PathBuf,
    /// Other drawings of the same name.
    pub others: Vec<PathBuf>,
}

/// Bytes of a program that are searched for the name of its drawing.
pub(crate) const HEAD: usize = 4096;

/// The most programs in a folder that are read to find their drawings; those of a drawing's own name come on top.
const MOST: usize = 200;

/// The folders of drawings and programs at one moment: each is listed once, and the head of each program read once, however many
/// documents are asked about.
pub(crate) struct Folders {
    /// Whether an editor holds a file open: that one is there, on disk or not.
    is_open: Box<dyn Fn(&Path) -> bool + Send + Sync>,
    fence: Fence,
    listed: Mutex<FxHashMap<PathBuf, Arc<Listing>>>,
    /// Programs and the drawing of each, where it has one.
    drawings: Mutex<FxHashMap<PathBuf, Option<PathBuf>>>,
}

/// The files of a folder.
#[derive(Default)]
struct Listing {
    programs: Vec<PathBuf>,
    /// All of them, by their names in lower case.
    by_name: FxHashMap<String, Vec<PathBuf>>,
}

impl Default for Folders {
    fn default() -> Folders {
        Folders::new(Fence::default(), |_| false)
    }
}

impl Folders {
    /// Nothing is read beyond the fence.
    pub(crate) fn new(
        fence: Fence,
        is_open: impl Fn(&Path) -> bool + Send + Sync + 'static,
    ) -> Folders {
        Folders {
            is_open: Box::new(is_open),
            fence,
            listed: Mutex::default(),
            drawings: Mutex::default(),
        }
    }

    pub(crate) fn is_open(&self, path: &Path) -> bool {
        (self.is_open)(path)
    }

    fn exists(&self, path: &Path) -> bool {
        self.is_open(path) || path.is_file()
    }

    fn listing(&self, folder: &Path) -> Arc<Listing> {
        let lock = || self.listed.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().get(folder) {
            return known.clone();
        }
        let here = match folder == Path::new("") {
            true => Path::new("."),
            false => folder,
        };
        let mut listing = Listing::default();
        for entry in std::fs::read_dir(here).into_iter().flatten().flatten() {
            let path = plain(&entry.path());
            let lower = name_of(&path).to_lowercase();
            if is_program(&path) {
                listing.programs.push(path.clone());
            }
            listing.by_name.entry(lower).or_default().push(path);
        }
        listing.programs.sort();
        listing.by_name.values_mut().for_each(|alike| alike.sort());
        let listing = Arc::new(listing);
        lock().insert(folder.to_path_buf(), listing.clone());
        listing
    }

    /// The drawing of a program whose text begins like this; `setting` is `program.drawing`, relative to the program's
    /// folder.
    pub(crate) fn drawing_of(
        &self,
        program: &Path,
        head: &[u8],
        setting: Option<&str>,
    ) -> Option<Named> {
        let folder = program.parent()?;
        let alone = |path: PathBuf| Named {
            path,
            others: Vec::new(),
        };
        // Where nothing else is the drawing of the program, that is told.
        let mut gone = None;
        if let Some(name) = in_comment(head) {
            let places = places(folder, &name);
            let there = places.iter().find(|path| self.exists(path)).cloned();
            if let Some(path) = there.or_else(|| self.whatever_case(&places)) {
                return Some(alone(path));
            }
            gone = places.last().cloned().map(alone);
        }
        if let Some(setting) = setting {
            return Some(alone(plain(&folder.join(setting))));
        }
        let mut found: Vec<PathBuf> = Vec::new();
        let endings = dxf::ENDINGS.map(|ending| [ending.to_owned(), ending.to_ascii_uppercase()]);
        for ending in endings.into_iter().flatten() {
            let path = program.with_extension(ending);
            // Where letter case does not matter, both names are of one file.
            let is_same = |other: &PathBuf| {
                let real = |path: &Path| path.canonicalize().ok();
                real(other).is_some() && real(other) == real(&path)
            };
            if self.exists(&path) && !found.iter().any(is_same) {
                found.push(path);
            }
        }
        let others = found.split_off(found.len().min(1));
        match found.pop() {
            Some(path) => Some(Named { path, others }),
            None => gone,
        }
    }

    /// The file whose name is that of one of these, whatever the case of its letters.
    fn whatever_case(&self, places: &[PathBuf]) -> Option<PathBuf> {
        let cased = |place: &PathBuf| {
            let name = place.file_name()?.to_str()?;
            let known =
                [name.to_lowercase(), name.to_uppercase()].map(|name| place.with_file_name(name));
            if let Some(path) = known.into_iter().find(|path| self.exists(path)) {
                return Some(path);
            }
            let listing = self.listing(place.parent()?);
            let mut alike = listing.by_name.get(&name.to_lowercase())?.iter();
            alike.find(|path| self.exists(path)).cloned()
        };
        places.iter().find_map(cased)
    }

    /// The programs on disk in the folder of a drawing that belong to it, sorted by name; not those that are open.
    pub(crate) fn programs_of(&self, drawing: &Path, setting: Option<&str>) -> Vec<PathBuf> {
        let listing = self.listing(drawing.parent().unwrap_or(Path::new("")));
        let (own, stem) = (real(drawing), drawing.file_stem());
        let may_be =
            |(number, path): &(usize, &PathBuf)| *number < MOST || path.file_stem() == stem;
        let programs = listing.programs.iter().enumerate().filter(may_be);
        let is_own = |(_, path): &(usize, &PathBuf)| {
            !self.is_open(path) && self.drawing_of_file(path, setting).as_ref() == Some(&own)
        };
        programs
            .filter(is_own)
            .map(|(_, path)| path.clone())
            .collect()
    }

    /// The drawing of a program on disk.
    fn drawing_of_file(&self, program: &Path, setting: Option<&str>) -> Option<PathBuf> {
        let lock = || self.drawings.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().get(program) {
            return known.clone();
        }
        let named = self.drawing_of(program, &head_of(program, &self.fence), setting);
        let drawing = named.map(|named| real(&named.path));
        lock().insert(program.to_path_buf(), drawing.clone());
        drawing
    }
}

/// Where a file is, whatever links lead there.
fn real(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| plain(path))
}

/// The places of a drawing that a comment names, none of them outside of the program's folder: of a path that leads elsewhere, to
/// another folder, computer or network, only the name of the file counts.
fn places(folder: &Path, name: &str) -> Vec<PathBuf> {
    let name = name.replace('\\', "/");
    let path = plain(Path::new(&name));
    let path = path.strip_prefix(folder).unwrap_or(&path);
    let file = Path::new(name.rsplit('/').next().unwrap_or(&name));
    let is_inside = |path: &&Path| {
        let mut parts = path.components();
        path.file_name().is_some() && parts.all(|part| matches!(part, Component::Normal(_)))
    };
    let inside = [path, file].into_iter().filter(is_inside);
    inside.map(|path| folder.join(path)).collect()
}

/// The first lines of a program's file, in UTF-8 where it is in GB 18030; empty where it cannot be read.
fn head_of(path: &Path, fence: &Fence) -> Vec<u8> {
    let mut head = Vec::new();
    if let Ok(file) = fence.open(path) {
        let _ = file.take(HEAD as u64).read_to_end(&mut head);
    }
    // A letter that is cut in two would hide the encoding.
    if head.len() == HEAD
        && let Some(end) = head.iter().rposition(|byte| *byte == b'\n')
    {
        head.truncate(end + 1);
    }
    Writing::read(head).0
}

/// The name of a file.
pub(crate) fn name_of(path: &Path) -> Arc<str> {
    path.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into()
}

/// True for a file that is a program by its ending.
pub(crate) fn is_program(path: &Path) -> bool {
    Language::of_ending(&ending_of(path)).is_some()
}

/// Without the steps to a folder and back.
pub fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            std::path::Component::CurDir => {}
            std::path::Component::ParentDir if plain.file_name().is_some() => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

/// The name of a drawing in a comment.
fn in_comment(head: &[u8]) -> Option<String> {
    let head = String::from_utf8_lossy(&head[..head.len().min(HEAD)]);
    let comments = head.lines().filter_map(|line| {
        let semicolon = line.split_once(';').map(|(_, comment)| comment);
        let bracket = || {
            let (_, comment) = line.split_once('(')?;
            Some(
                comment
                    .split_once(')')
                    .map_or(comment, |(comment, _)| comment),
            )
        };
        semicolon.or_else(bracket)
    });
    comments.filter_map(name_in).next()
}

fn name_in(comment: &str) -> Option<String> {
    let lower = comment.to_ascii_lowercase();
    let ends = dxf::ENDINGS.iter().filter_map(|ending| {
        let end = lower.find(&format!(".{ending}"))? + 1 + ending.len();
        let behind = lower.get(end..)?.chars().next();
        (!behind.is_some_and(char::is_alphanumeric)).then_some(end)
    });
    let named = comment.get(..ends.min()?)?;
    // A name with spaces stands after a word and a colon.
    let label = named.find([':', '=']).filter(|at| !is_drive(named, *at));
    let name = match label {
        Some(at) => named.get(at + 1..)?,
        None => named.rsplit(char::is_whitespace).next()?,
    };
    let name = name.trim().trim_matches('"');
    (!name.is_empty()).then(|| name.to_owned())
}

/// The colon of `C:\`.
fn is_drive(text: &str, at: usize) -> bool {
    let behind = text.get(at..).unwrap_or_default();
    behind.starts_with(":\\") || behind.starts_with(":/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(head: &str, setting: Option<&str>, files: &[&str], expected: Option<&str>) {
        let files: Vec<PathBuf> = files.iter().map(PathBuf::from).collect();
        let folders = Folders::new(Fence::default(), move |path| {
            files.iter().any(|file| path == file)
        });
        let named = folders.drawing_of(Path::new("/job/plate.3b"), head.as_bytes(), setting);
        let path = named.map(|named| named.path);
        assert_eq!(path.as_deref(), expected.map(Path::new), "{head}");
    }

    #[test]
    fn a_comment_comes_first_then_the_settings_then_the_name() {
        let all = [
            "/job/plate.dxf",
            "/job/Part 7.DXF",
            "/job/other.dxf",
            "/up.dxf",
        ];
        check("B1B1B1GXL1\n", None, &all, Some("/job/plate.dxf"));
        check("B1B1B1GXL1\n", None, &[], None);
        check("", Some("other.dxf"), &all, Some("/job/other.dxf"));
        check("", Some("../up.dxf"), &all, Some("/up.dxf"));
        check("", Some("gone.dxf"), &all, Some("/job/gone.dxf"));
        check(
            "; drawing: Part 7.DXF\n",
            Some("other.dxf"),
            &all,
            Some("/job/Part 7.DXF"),
        );
        check(
            "%\nO100 (FROM C:\\JOBS\\OTHER\\other.dxf 2020)\n",
            None,
            &all,
            Some("/job/other.dxf"),
        );
        check("(OTHER.DXF)\n", None, &all, Some("/job/other.dxf"));
        check("(part 7.dxf)\n", None, &["/job/a.dxf"], Some("/job/7.dxf"));
        check("(see other.dxfs)\n", None, &all, Some("/job/plate.dxf"));
        check("; of b.dxfb\n", None, &["/job/b.dxfb"], Some("/job/b.dxfb"));
        check(
            "(a drawing that is gone.dxf)\n",
            None,
            &all,
            Some("/job/plate.dxf"),
        );
        check(
            "G01 X1 ; DXF=other.dxf\n",
            None,
            &all,
            Some("/job/other.dxf"),
        );
    }

    #[test]
    fn a_comment_in_gb_18030_names_its_drawing() {
        let folder = tempfile::tempdir().unwrap();
        let (program, drawing) = (folder.path().join("a.3b"), folder.path().join("凸模.dxf"));
        let blocks = "B1000B0B1000GXL1\n".repeat(400);
        let head = b"; \xcd\xb9\xc4\xa3.dxf\n; \xcd\xb9\xc4\xa3\n";
        std::fs::write(&program, [head, blocks.as_bytes()].concat()).unwrap();
        std::fs::write(&drawing, "").unwrap();
        let named =
            Folders::default().drawing_of(&program, &head_of(&program, &Fence::default()), None);
        assert_eq!(named.map(|named| named.path), Some(drawing));
    }

    #[test]
    fn a_drawing_is_known_whatever_the_case_of_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let (program, drawing) = (
            folder.path().join("a.iso"),
            folder.path().join("Part 7.dxf"),
        );
        std::fs::write(&drawing, "").unwrap();
        for head in ["(DXF: PART 7.DXF)", "; drawing=Part 7.Dxf"] {
            let named = Folders::default().drawing_of(&program, head.as_bytes(), None);
            assert_eq!(
                named.map(|named| named.path),
                Some(drawing.clone()),
                "{head}"
            );
        }
    }

    #[test]
    fn two_drawings_of_one_name_are_told() {
        let folders = Folders::new(Fence::default(), |path| {
            path.extension().is_some_and(|ending| ending != "DXF")
        });
        let named = folders
            .drawing_of(Path::new("/job/plate.3b"), b"", None)
            .unwrap();
        assert_eq!(named.path, Path::new("/job/plate.dxf"));
        assert_eq!(named.others[0], Path::new("/job/plate.dxb"));
    }

    #[test]
    fn a_comment_leads_nowhere_out_of_the_folder_of_its_program() {
        let check = |name: &str, expected: &[&str]| {
            let expected: Vec<PathBuf> = expected.iter().map(PathBuf::from).collect();
            assert_eq!(places(Path::new("/job"), name), expected, "{name}");
        };
        check("a.dxf", &["/job/a.dxf", "/job/a.dxf"]);
        check(r"sub\a.dxf", &["/job/sub/a.dxf", "/job/a.dxf"]);
        check("/job/sub/a.dxf", &["/job/sub/a.dxf", "/job/a.dxf"]);
        for outside in [
            r"\\10.0.0.9\share\a.dxf",
            "//10.0.0.9/share/a.dxf",
            "//host/a.dxf",
            "../a.dxf",
            "sub/../../a.dxf",
            "/etc/a.dxf",
            "/job/../etc/a.dxf",
            "/a.dxf",
        ] {
            check(outside, &["/job/a.dxf"]);
        }
        check("..", &[]);
        check("", &[]);
    }
}
