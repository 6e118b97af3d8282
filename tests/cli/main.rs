//! The command line as a user meets it: the real binary, small files, what it prints and how it ends.

mod calibrate;
mod clearances;
mod common_line;
mod contradictions;
mod electrode;
mod ends;
mod filled;
mod fixes;
mod four_b;
mod holes;
mod on_line;
mod pages;
mod parts;
mod pictures;
mod programs;
mod reports;
mod search;
mod settings;
mod specks;
mod table;
mod targets;
mod told;
mod twice;
mod units;
mod untrusted;
mod words;

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A folder of its own with all files of `tests/data`.
struct Desk(tempfile::TempDir);

impl Desk {
    fn new() -> Desk {
        let folder = tempfile::tempdir().unwrap();
        for entry in
            std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data")).unwrap()
        {
            let entry = entry.unwrap();
            if entry.file_type().unwrap().is_file() {
                std::fs::copy(entry.path(), folder.path().join(entry.file_name())).unwrap();
            }
        }
        Desk(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::create_dir_all(self.path(name).parent().unwrap()).unwrap();
        std::fs::write(self.path(name), content).unwrap();
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap()
    }

    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_wedm"));
        command
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .env("LC_ALL", "C")
            .stdin(Stdio::null());
        command
    }

    fn run(&self, arguments: &str) -> Ended {
        Ended::of(self.command(arguments).output().unwrap())
    }
}

#[derive(Debug)]
struct Ended {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Ended {
    fn of(output: Output) -> Ended {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Ended {
            code: output.status.code(),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        }
    }

    fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }
}

/// Runs `arguments` and looks for texts, those that begin with `!` in stderr, the others in stdout.
#[track_caller]
fn check(desk: &Desk, arguments: &str, code: i32, texts: &[&str]) {
    let ended = desk.run(arguments);
    assert_eq!(ended.code, Some(code), "wedm {arguments}: {ended:?}");
    for text in texts {
        let (stream, text) = match text.strip_prefix('!') {
            Some(text) => (&ended.stderr, text),
            None => (&ended.stdout, *text),
        };
        assert!(
            stream.contains(text),
            "wedm {arguments}: no {text:?} in {ended:?}"
        );
    }
    assert!(
        !ended.stdout.contains('\x1b') && !ended.stderr.contains('\x1b'),
        "colours without a terminal: {ended:?}"
    );
}
