//! What the ending of a file's name says of its content: it decides the format where nothing else does, and is never
//! allowed to contradict it.

use super::Failure;
use super::files::Opened;
use crate::disk::ending_of;
use crate::document::{FileKind, Source};
use crate::dxf;
use crate::job::Target;
use crate::picture::Image;
use crate::program::{Format, Language};
use crate::settings::Effective;
use std::path::Path;

/// The format of a program: the stated one, else that of the target's ending, else that of the settings, else 3B. An
/// error where the ending is that of another kind of file.
pub(super) fn format(
    stated: Option<Format>,
    target: Option<&Path>,
    settings: &Effective,
) -> Result<Format, Failure> {
    let ending = target.map(ending_of).unwrap_or_default();
    let stated = stated.or_else(|| Format::of_ending(&ending));
    if let (None, Some(target)) = (stated, target) {
        let endings: Vec<&str> = Format::ALL[..3]
            .iter()
            .flat_map(|format| format.endings())
            .copied()
            .collect();
        expect(target, say!(a_program), &endings)?;
    }
    let format = stated.unwrap_or_else(|| of_settings(settings));
    match target {
        Some(target) => expect(target, format.title(), format.endings()).map(|()| format),
        None => Ok(format),
    }
}

/// The format of programs where nothing else says it.
pub(super) fn of_settings(settings: &Effective) -> Format {
    settings.format.unwrap_or(Format::ThreeB)
}

/// An error where the ending of a conversion's target is that of something else.
pub(super) fn of_conversion(made: Target, target: &Path) -> Result<(), Failure> {
    match made {
        Target::Drawing => expect(target, DXF, &["dxf"]),
        Target::Program(format) => expect(target, format.title(), format.endings()),
    }
}

/// An error where a file would be written under the ending of another kind: a repair does not convert.
pub(super) fn as_read(opened: &Opened, target: &Path) -> Result<(), Failure> {
    match opened.document.source() {
        Source::Program(program) => {
            let language = program.language();
            let title = match language {
                Language::ThreeB => Format::ThreeB.title(),
                Language::Iso => Format::Iso.title(),
            };
            expect(target, title, language.endings())
        }
        _ => expect(target, DXF, &dxf::ENDINGS),
    }
}

/// An error where the name of a folder is that of a file of ours.
pub(super) fn folder(folder: &Path) -> Result<(), Failure> {
    let ending = ending_of(folder);
    match is_known(&ending) && !folder.is_dir() {
        true => Err(Failure::of(folder, say!(a_folder_named_as_a_file, ending))),
        false => Ok(()),
    }
}

const DXF: &str = "DXF";

fn expect(target: &Path, written: &str, endings: &[&str]) -> Result<(), Failure> {
    let ending = ending_of(target);
    if endings.contains(&&*ending) || !is_known(&ending) {
        return Ok(());
    }
    let expected = endings.iter().map(|ending| format!(".{ending}"));
    let expected = expected.collect::<Vec<_>>().join(say!(comma));
    Err(Failure::of(
        target,
        say!(its_ending_is_of_something_else, ending, written, expected),
    ))
}

/// True for the endings that say what a file is. A name with another ending is not taken for anything else.
fn is_known(ending: &str) -> bool {
    FileKind::of_ending(ending).is_some()
        || Image::of_ending(ending).is_some()
        || ["csv", "dwg", "html"].contains(&ending)
}
