//! `wedm view`: the page in the browser, and how it is opened.

use super::{Failure, Verdict, check, files, output, pages};
use crate::compare::plain as plain_path;
use crate::disk::{Fence, plain};
use crate::server;
use crate::view::{Bench, Root, Shown, is_of_ours};
use clap::Args;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};
use std::process::{Command, Stdio};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm view
  wedm view drawings/
  wedm view plate.dxf --no-open --port 8040")]
pub(crate) struct Arguments {
    #[arg(value_name = "PATH", default_value = ".")]
    paths: Vec<PathBuf>,
    #[arg(long, value_name = "N")]
    port: Option<u16>,
    #[arg(long)]
    no_open: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    server::log_to_stderr();
    let shown = shown(&arguments.paths)?;
    let folders = shown.roots.iter().map(|root| root.folder.clone());
    let fence = Fence::around(folders).map_err(|error| Failure(plain(&error)))?;
    let port = arguments.port.unwrap_or_default();
    let bench = Bench::open(port, fence, shown).map_err(|error| {
        Failure(match error.kind() {
            ErrorKind::AddrInUse => say!(the_port_is_taken, port),
            _ => say!(the_port_cannot_be_had, port, plain(&error)),
        })
    })?;
    let address = bench.address();
    output::print(format!("{address}\n"))?;
    output::say(say!(it_ends_with_the_last_page));
    if !arguments.no_open && !open_browser(&address) {
        output::say(say!(no_browser_could_be_opened));
    }
    bench.serve();
    Ok(Verdict::Clean)
}

/// Folders as they are, and the folder of each file, without those below it.
fn shown(paths: &[PathBuf]) -> Result<Shown, Failure> {
    let mut shown = Shown {
        roots: Vec::new(),
        opened: Vec::new(),
        find,
        count: check::count,
        report: pages::page_of,
    };
    for path in paths {
        let failed = |error| Failure::of(path, plain(&error));
        let absolute = std::path::absolute(path).map_err(failed)?;
        // Behind a link `..` leads elsewhere than its name says.
        let leads_up = absolute
            .components()
            .any(|part| part == Component::ParentDir);
        let absolute = match leads_up {
            true => absolute.canonicalize().map_err(failed)?,
            false => plain_path(&absolute),
        };
        let is_folder = absolute.metadata().map_err(failed)?.is_dir();
        if is_folder {
            std::fs::read_dir(&absolute).map_err(failed)?;
            shown.roots.push(Root {
                folder: absolute,
                has_subfolders: true,
            });
            continue;
        }
        let (Some(folder), Some(name)) = (absolute.parent(), absolute.file_name()) else {
            return Err(Failure::of(path, say!(it_is_no_regular_file)));
        };
        if !absolute.is_file() || !is_of_ours(Path::new(name)) {
            return Err(Failure::of(path, say!(it_is_nothing_to_show)));
        }
        if !shown.roots.iter().any(|root| root.folder == folder) {
            shown.roots.push(Root {
                folder: folder.to_path_buf(),
                has_subfolders: false,
            });
        }
        shown.opened.push(absolute);
    }
    Ok(shown)
}

fn find(root: &Root) -> Vec<PathBuf> {
    let search = files::Search {
        depth: (!root.has_subfolders).then_some(1),
        ..files::Search::default()
    };
    files::search(std::slice::from_ref(&root.folder), &search).files
}

/// Has the system open an address; false where it cannot.
fn open_browser(address: &str) -> bool {
    let mut command = if cfg!(windows) {
        // The name of the window comes first.
        let mut command = Command::new("cmd");
        command.args(["/C", "start", ""]);
        command
    } else if cfg!(target_os = "macos") {
        Command::new("open")
    } else {
        Command::new("xdg-open")
    };
    let command = command.arg(address).stdin(Stdio::null());
    let opened = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    let Ok(mut opened) = opened else { return false };
    // It may stay as long as the browser does; somebody has to ask how it ended.
    std::thread::spawn(move || opened.wait());
    true
}
