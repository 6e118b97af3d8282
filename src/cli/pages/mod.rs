//! `wedm report`: a page for each drawing and an index, for the workshop and for the file.

mod head;
mod html;
mod index;
mod job;
mod page;
mod share;

use super::options::{Common, Head, Program};
use super::output::{self, styled};
use super::{Failure, Verdict, ending, files};
use crate::disk::ending_of;
use crate::document::FileKind;
use crate::program::Format;
use crate::protocol::Against;
use crate::settings::Settings;
use clap::Args;
use page::Page;
use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm report plate.dxf -o report
  wedm report --side opening drawings/ -o report
  wedm report plate.dxf --side punch --part A-17 --material 1.2379 --thickness 40 -o report
  wedm report plate.dxf --side punch --format iso --profile robofil --compensation controller -o report")]
pub(crate) struct Arguments {
    #[arg(value_name = "PATH", default_value = ".")]
    paths: Vec<PathBuf>,
    #[arg(short, long, value_name = "FOLDER", default_value = "report")]
    output: PathBuf,
    #[arg(long)]
    overwrite: bool,
    #[arg(long, value_parser = Format::of)]
    format: Option<Format>,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    head: Head,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let found = files::search(&arguments.paths, &files::Search::default());
    let mut verdict = Verdict::Clean;
    for failure in &found.failures {
        output::complain(&failure.0);
        verdict = Verdict::Failed;
    }
    let drawings: Vec<&PathBuf> = found.files.iter().filter(|path| is_drawing(path)).collect();
    if drawings.is_empty() {
        return Err(Failure(say!(no_drawing_for_a_report).into()));
    }
    let folder = &arguments.output;
    ending::folder(folder)?;
    let index = folder.join(INDEX);
    let mut names = HashSet::new();
    let drawings: Vec<(&PathBuf, String)> = drawings
        .into_iter()
        .map(|path| (path, name_of(path, &mut names)))
        .collect();
    if !arguments.overwrite {
        for (_, name) in &drawings {
            output::refuse_foreign(&folder.join(name), html::MARK)?;
        }
        output::refuse_foreign(&index, html::MARK)?;
    }
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::of(folder, crate::disk::plain(&error)))?;
    let last = arguments.common.settings_with(&arguments.program);
    let last = last.overlaid(&arguments.head.0);
    let mut lines = Vec::new();
    let mut against: BTreeSet<String> = BTreeSet::new();
    for (path, name) in drawings {
        let page = files::open_to_use(path, None, &arguments.common, &last).and_then(|opened| {
            let settings = opened.document.settings();
            let format = (arguments.format).unwrap_or_else(|| ending::of_settings(settings));
            against.extend(Against::of(&opened.document).map(|own| own.on_a_terminal()));
            Page::of(opened, format)
        });
        match page {
            Ok(page) => {
                output::write(Some(&folder.join(&name)), page.html(true).as_bytes(), true)?;
                verdict = verdict.max(Verdict::of_errors(page.has_errors()));
                lines.push((name, page.line));
            }
            Err(Failure(sentence)) => {
                output::complain_once(&sentence);
                verdict = Verdict::Failed;
            }
        }
    }
    output::write(Some(&index), index::index(&lines).as_bytes(), true)?;
    output::say(&say!(
        pages_are_written,
        styled(output::GOOD, say!(written)),
        say!(pages, lines.len()),
        output::name(&index)
    ));
    for said in against.iter().take(SOME) {
        output::say(&styled(output::FAINT, say!(judged_against, said)));
    }
    Ok(verdict)
}

/// The page of one drawing by itself, made as the command makes it; the error is a sentence.
pub(crate) fn page_of(path: &Path) -> Result<String, String> {
    let opened = files::open_to_use(path, None, &Common::default(), &Settings::default());
    let page = opened.and_then(|opened| {
        let format = ending::of_settings(opened.document.settings());
        Page::of(opened, format)
    });
    page.map(|page| page.html(false))
        .map_err(|Failure(sentence)| sentence)
}

const INDEX: &str = "index.html";

/// The most lines about what drawings were judged against.
const SOME: usize = 4;

fn is_drawing(path: &Path) -> bool {
    FileKind::of_ending(&ending_of(path)) == Some(FileKind::Drawing)
}

/// A name for the page of a drawing that no other has yet.
fn name_of(path: &Path, names: &mut HashSet<String>) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let plain = |letter: char| match letter {
        letter if letter.is_alphanumeric() || "-_.+".contains(letter) => letter,
        _ => '_',
    };
    let stem: String = stem.chars().map(plain).collect();
    let numbered = (1..).map(|number| match number {
        1 => format!("{stem}.html"),
        _ => format!("{stem}-{number}.html"),
    });
    let is_free = |name: &String| {
        let name = name.to_lowercase();
        name != INDEX && !names.contains(&name)
    };
    let name = numbered.into_iter().find(is_free).unwrap_or_default();
    names.insert(name.to_lowercase());
    name
}
