//! Where output goes: terminals with colours, pipes without, files beside their target and renamed.

use super::Failure;
use anstyle::{AnsiColor, Style};
use std::io::{self, ErrorKind, Write};
use std::path::Path;

pub const ERROR: Style = AnsiColor::Red.on_default().bold();
pub const WARNING: Style = AnsiColor::Yellow.on_default().bold();
pub const NOTE: Style = AnsiColor::Cyan.on_default();
pub const GOOD: Style = AnsiColor::Green.on_default();
pub const FAINT: Style = Style::new().dimmed();
pub const STRONG: Style = Style::new().bold();

/// `text` in a style; the streams of this module leave the style out where no terminal reads it.
pub fn styled(style: Style, text: impl std::fmt::Display) -> String {
    format!("{style}{text}{style:#}")
}

/// Text to stdout. A reader that has gone away has seen enough: no error.
pub fn print(text: impl AsRef<[u8]>) -> Result<(), Failure> {
    let mut stdout = anstream::stdout().lock();
    accepted(stdout.write_all(text.as_ref()).and_then(|()| stdout.flush()), "stdout")
}

/// Bytes to stdout, as they are.
fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    accepted(stdout.write_all(bytes).and_then(|()| stdout.flush()), "stdout")
}

/// A line to stderr. Nobody can be told when that fails.
pub fn say(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{text}");
}

/// What went wrong, to stderr.
pub fn complain(sentence: &str) {
    say(&format!("{}: {sentence}", styled(ERROR, "error")));
}

fn accepted(written: io::Result<()>, target: &str) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure(format!("{target} could not be written: {error}"))),
        _ => Ok(()),
    }
}

/// Bytes to a file, or to stdout for none and for `-`.
///
/// A file is written beside its target and renamed, so that nobody ever sees half of it; permissions of a file that
/// stands there are kept, and a link stays a link. What is no regular file (a device, a pipe) is written directly.
pub fn write(target: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    match target {
        None => print_bytes(bytes),
        Some(path) if path == Path::new("-") => print_bytes(bytes),
        Some(path) => replace(path, bytes).map_err(|error| Failure(format!("{} could not be written: {error}", path.display()))),
    }
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let present = match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => return Err(io::Error::new(ErrorKind::IsADirectory, "it is a folder")),
        Ok(metadata) if !metadata.is_file() => return std::fs::write(path, bytes),
        Ok(metadata) => Some(metadata.permissions()),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    let path = if present.is_some() { path.canonicalize()? } else { path.to_path_buf() };
    if present.as_ref().is_some_and(std::fs::Permissions::readonly) {
        return Err(io::Error::new(ErrorKind::PermissionDenied, "it is read-only"));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut beside = new_file(folder)?;
    beside.write_all(bytes)?;
    if let Some(permissions) = present {
        beside.as_file().set_permissions(permissions)?;
    }
    beside.as_file().sync_all()?;
    beside.persist(&path)?;
    Ok(())
}

/// A temporary file that gets the permissions of any new file, not those of a secret one.
fn new_file(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".wedm-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// An error where `target` is the file that was read: an input changes only when `--in-place` says so.
pub fn refuse_input(target: &Path, input: &Path) -> Result<(), Failure> {
    let same = match (target.canonicalize(), input.canonicalize()) {
        (Ok(target), Ok(input)) => target == input,
        _ => false,
    };
    if same {
        return Err(Failure(format!("{} is the input, expected another file", target.display())));
    }
    Ok(())
}

/// "1 error", "3 errors".
pub fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}
