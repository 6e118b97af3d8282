//! Finds the drawing of a program: the one that a comment of it names, the one in the settings, else the one of its own
//! name.

use crate::disk::ending_of;
use crate::dxf;
use crate::program::Language;
use crate::text::Writing;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The drawing of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    pub path: PathBuf,
    /// Other drawings of the same name.
    pub others: Vec<PathBuf>,
}

/// Bytes of a program that are searched for the name of its drawing.
const HEAD: usize = 4096;

/// The most programs in a folder that are read to find their drawings.
const MOST: usize = 200;

/// The drawing of a program whose text begins like this; `setting` is `program.drawing`, relative to the program's
/// folder.
pub(crate) fn drawing_named(
    program: &Path,
    head: &[u8],
    setting: Option<&str>,
    exists: &dyn Fn(&Path) -> bool,
) -> Option<Named> {
    let folder = program.parent()?;
    let alone = |path: PathBuf| Named {
        path,
        others: Vec::new(),
    };
    // Where nothing else is the drawing of the program, that is told.
    let mut gone = None;
    if let Some(name) = in_comment(head) {
        // Only the file name of a path on another machine is used.
        let file = name.rsplit(['/', '\\']).next().unwrap_or(&name);
        let places = [folder.join(name.replace('\\', "/")), folder.join(file)];
        let there = places.iter().find(|path| exists(path)).cloned();
        if let Some(path) = there.or_else(|| whatever_case(&places, exists)) {
            return Some(alone(plain(&path)));
        }
        gone = Some(alone(plain(&folder.join(file))));
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
        if exists(&path) && !found.iter().any(is_same) {
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
fn whatever_case(places: &[PathBuf], exists: &dyn Fn(&Path) -> bool) -> Option<PathBuf> {
    let cased = |place: &PathBuf| {
        let name = place.file_name()?.to_str()?;
        let known =
            [name.to_lowercase(), name.to_uppercase()].map(|name| place.with_file_name(name));
        if let Some(path) = known.into_iter().find(|path| exists(path)) {
            return Some(path);
        }
        let folder = place.parent().filter(|folder| *folder != Path::new(""));
        let files = std::fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?;
        let names = files.filter_map(|file| file.ok()?.file_name().into_string().ok());
        let lower = name.to_lowercase();
        let mut alike: Vec<String> = names.filter(|own| own.to_lowercase() == lower).collect();
        alike.sort();
        let mut paths = alike.into_iter().map(|own| place.with_file_name(own));
        paths.find(|path| exists(path))
    };
    places.iter().find_map(cased)
}

/// The programs among the files of a folder that belong to a drawing, sorted by name. `named` decides for one.
pub(crate) fn programs_beside(
    files: impl IntoIterator<Item = PathBuf>,
    named: &dyn Fn(&Path) -> bool,
) -> Vec<PathBuf> {
    let mut programs: Vec<PathBuf> = files.into_iter().filter(|path| is_program(path)).collect();
    programs.sort();
    programs.truncate(MOST);
    programs.retain(|path| named(path));
    programs
}

/// The first lines of a program's file, in UTF-8 where it is in GB 18030; empty where it cannot be read.
pub(crate) fn head_of(path: &Path) -> Vec<u8> {
    let mut head = Vec::new();
    if let Ok(file) = std::fs::File::open(path) {
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
        let exists = |path: &Path| files.iter().any(|file| path == Path::new(file));
        let named = drawing_named(
            Path::new("/job/plate.3b"),
            head.as_bytes(),
            setting,
            &exists,
        );
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
        let named = drawing_named(&program, &head_of(&program), None, &Path::is_file);
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
            let named = drawing_named(&program, head.as_bytes(), None, &Path::is_file);
            assert_eq!(
                named.map(|named| named.path),
                Some(drawing.clone()),
                "{head}"
            );
        }
    }

    #[test]
    fn two_drawings_of_one_name_are_told() {
        let exists = |path: &Path| path.extension().is_some_and(|ending| ending != "DXF");
        let named = drawing_named(Path::new("/job/plate.3b"), b"", None, &exists).unwrap();
        assert_eq!(named.path, Path::new("/job/plate.dxf"));
        assert_eq!(named.others[0], Path::new("/job/plate.dxb"));
    }
}
