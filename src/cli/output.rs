//! Output: terminals with colours, pipes without, files. The only control sequences printed are our own colours.

use super::Failure;
use crate::disk;
use crate::document::Document;
use crate::finding::{Finding, Rule, Severity, Telling, sentence};
use crate::message::{columns, is_hidden, readable};
use crate::program::ProvedProgram;
use crate::protocol::Against;
use crate::toolpath::StartHole;
use anstyle::{AnsiColor, Style};
use serde::Serialize;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

pub(crate) const ERROR: Style = AnsiColor::Red.on_default().bold();
pub(crate) const WARNING: Style = AnsiColor::Yellow.on_default().bold();
pub(crate) const NOTE: Style = AnsiColor::Cyan.on_default();
pub(crate) const GOOD: Style = AnsiColor::Green.on_default();
pub(crate) const FAINT: Style = Style::new().dimmed();
pub(crate) const STRONG: Style = Style::new().bold();

/// What stands for stdin among the inputs.
pub(crate) const STDIN: &str = "-";

/// `text` in a style; the streams of this module drop the style where no terminal reads it.
pub(crate) fn styled(style: Style, text: impl std::fmt::Display) -> String {
    format!("{style}{text}{style:#}")
}

/// The name of a file for people.
pub(crate) fn name(path: &Path) -> String {
    readable(&path.to_string_lossy()).into_owned()
}

/// A path as a word of a command that can be copied.
pub(crate) fn word(path: &Path) -> String {
    let name = name(path);
    let is_plain = |letter: char| letter.is_alphanumeric() || "/\\.-_+:,@%=".contains(letter);
    match !name.is_empty() && name.chars().all(is_plain) {
        true => name,
        false if cfg!(windows) => format!("\"{name}\""),
        false => format!("'{}'", name.replace('\'', "'\\''")),
    }
}

/// Text to stdout. A reader that has gone away is no error.
pub(crate) fn print(text: impl AsRef<str>) -> Result<(), Failure> {
    let text = text.as_ref();
    if takes_colours(&io::stdout()) {
        return write_out(anstream::stdout().lock(), shown(text, true).as_bytes());
    }
    // The stream that strips colours writes each piece between two of them separately.
    write_out(io::stdout().lock(), shown(text, false).as_bytes())
}

fn write_out(mut stdout: impl Write, bytes: &[u8]) -> Result<(), Failure> {
    let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
    accepted(written, "stdout")
}

fn takes_colours(stdout: &io::Stdout) -> bool {
    anstream::AutoStream::choice(stdout) != anstream::ColorChoice::Never
}

/// JSON to stdout: control characters are escaped, which does not change the content.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let json = serde_json::to_string(value).map_err(|error| Failure(error.to_string()))?;
    print_json_text(&(json + "\n"))
}

/// The same of JSON that is text already.
pub(crate) fn print_json_text(json: &str) -> Result<(), Failure> {
    print(escaped(json))
}

/// What `-o` names, or stdout, for people.
pub(crate) fn target_name(target: Option<&Path>) -> String {
    target.map_or_else(|| "stdout".into(), name)
}

/// Bytes to stdout: to a pipe or a file as they are, to a terminal made readable.
pub(crate) fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    if io::stdout().is_terminal() {
        return print(String::from_utf8_lossy(bytes));
    }
    write_out(io::stdout().lock(), bytes)
}

/// True where a person reads stdout: it is a terminal, or shows colours.
pub(crate) fn is_for_people() -> bool {
    let stdout = io::stdout();
    stdout.is_terminal() || takes_colours(&stdout)
}

/// A line to stderr. A failure cannot be reported anywhere.
pub(crate) fn say(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{}", shown(text, true));
}

/// The same, once in a process: files of one command may share what it is about.
pub(crate) fn say_once(text: &str) {
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    if said.insert(text.to_owned()) {
        say(text);
    }
}

/// How far the outline lies from arcs that are cut in place of its chords, where there are any.
pub(crate) fn off_chords(program: &ProvedProgram) -> Option<String> {
    let off = program.off_chords;
    (off > 0.0).then(|| say!(chords_are_cut_as_arcs, off))
}

/// The corrections that have to be entered at the control, where it offsets the contour.
pub(crate) fn offsets(program: &ProvedProgram) -> Option<String> {
    let offsets = &program.offsets;
    let of_all: Vec<String> = offsets.iter().map(|(_, mm)| format!("{mm:.4}")).collect();
    let is_named = offsets.iter().any(|(register, _)| !register.is_empty());
    let one = |(register, mm): &(String, f64)| say!(offset_of_a_register, readable(register), mm);
    let told = match is_named {
        true => offsets
            .iter()
            .map(one)
            .collect::<Vec<_>>()
            .join(say!(comma)),
        false => say!(offset_of_all, of_all.join(" / ")),
    };
    (!offsets.is_empty()).then(|| say!(the_control_offsets, told))
}

/// The first thread hole, to stderr; `unit_mm` is the unit of the holes.
pub(crate) fn say_thread_hole(holes: &[StartHole], unit_mm: f64) {
    if let Some(hole) = holes.first() {
        let at = hole.at * unit_mm;
        say(&say!(the_wire_is_threaded_at, at.x, at.y));
    }
}

/// What of the findings of a program is only to be known, to stderr: how its tabs hold.
pub(crate) fn say_what_holds(warnings: &[Finding], telling: Telling) {
    let holds = warnings.iter().filter(|one| is_what_holds(one));
    holds.for_each(|one| say(&readable(&sentence(one, telling))));
}

/// True for the information how the tabs of a program hold.
pub(crate) fn is_what_holds(finding: &Finding) -> bool {
    finding.rule == Rule::LeadIn && finding.severity == Severity::Information
}

/// What a drawing was judged against, or cut with, to stderr.
pub(crate) fn say_against(document: &Document) {
    if let Some(against) = Against::of(document) {
        let line = say!(judged_against, against.on_a_terminal());
        say(&styled(FAINT, line));
    }
}

/// The failure, to stderr.
pub(crate) fn complain(sentence: &str) {
    say(&say!(says, styled(ERROR, say!(error)), readable(sentence)));
}

/// The same of one that several files of a command may share.
pub(crate) fn complain_once(sentence: &str) {
    say_once(&say!(says, styled(ERROR, say!(error)), readable(sentence)));
}

/// Text of several lines with our own colours, or without any, and no other control characters, even where a caller forgot
/// to remove them.
fn shown(text: &str, has_colours: bool) -> Cow<'_, str> {
    if !text.contains(|character| is_hidden(character) && character != '\n') {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    loop {
        // Most of it is plain.
        let is_plain = |byte: &u8| matches!(byte, b' '..=b'~' | b'\n');
        let plain = rest.bytes().position(|byte| !is_plain(&byte));
        let (plain, behind) = rest.split_at(plain.unwrap_or(rest.len()));
        out.push_str(plain);
        rest = behind;
        if let Some((style, behind)) = style_at_head(rest) {
            out.push_str(if has_colours { style } else { "" });
            rest = behind;
            continue;
        }
        let mut characters = rest.chars();
        let Some(character) = characters.next() else {
            return Cow::Owned(out);
        };
        rest = characters.as_str();
        match character {
            '\r' if rest.starts_with('\n') => {}
            hidden if is_hidden(hidden) => out.push(char::REPLACEMENT_CHARACTER),
            other => out.push(other),
        }
    }
}

/// The colour or weight that `text` begins with, `ESC [ digits m`, and the rest.
fn style_at_head(text: &str) -> Option<(&str, &str)> {
    let numbers = text.strip_prefix("\u{1b}[")?;
    let behind =
        numbers.trim_start_matches(|letter: char| letter.is_ascii_digit() || letter == ';');
    let behind = behind.strip_prefix('m')?;
    text.split_at_checked(text.len() - behind.len())
}

/// JSON with every [`is_hidden`] character escaped. Outside strings there are only line ends.
fn escaped(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    for character in json.chars() {
        if character != '\n' && is_hidden(character) {
            character
                .encode_utf16(&mut [0; 2])
                .iter()
                .for_each(|unit| out.push_str(&format!("\\u{unit:04x}")));
        } else {
            out.push(character);
        }
    }
    out
}

fn accepted(written: io::Result<()>, target: &str) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure(say!(
            could_not_be_written,
            target,
            disk::plain(&error)
        ))),
        _ => Ok(()),
    }
}

/// Bytes to a file, or to stdout for none and for `-`. A regular file that holds something else is only
/// [replaced](disk::replace) where `overwrites` says so; anything else (a device, a pipe) is written directly.
pub(crate) fn write(target: Option<&Path>, bytes: &[u8], overwrites: bool) -> Result<(), Failure> {
    match target.filter(|path| *path != Path::new("-")) {
        None => print_bytes(bytes),
        Some(path) if !overwrites && disk::holds_else(path, bytes) => {
            Err(Failure::of(path, say!(it_is_there_already)))
        }
        Some(path) => said_of(path, disk::write(path, bytes)),
    }
}

/// Overwrites the file that was read; an error, with nothing written, where the file has changed.
pub(crate) fn write_over(
    path: &Path,
    read: Option<&disk::Seen>,
    bytes: &[u8],
) -> Result<(), Failure> {
    said_of(path, disk::replace(path, read, bytes))
}

/// Warns if the file that was replaced has other names (hard links).
fn said_of(path: &Path, written: Result<u64, String>) -> Result<(), Failure> {
    match written {
        Ok(0) => {}
        Ok(others) => say(&say!(
            had_hard_links,
            styled(NOTE, say!(note)),
            name(path),
            say!(names, usize::try_from(others).unwrap_or(usize::MAX))
        )),
        Err(reason) => {
            return Err(Failure(say!(
                file_could_not_be_written,
                path.display(),
                reason
            )));
        }
    }
    Ok(())
}

/// An error where `path` is no regular file: nothing else can be changed in place.
pub(crate) fn refuse_irregular(path: &Path) -> Result<(), Failure> {
    let is_stdin = path == Path::new(STDIN);
    match std::fs::metadata(path).map(|metadata| metadata.is_file()) {
        is_file if is_stdin || matches!(is_file, Ok(false)) => Err(Failure(say!(
            it_is_no_regular_file_expected_one_to_be_changed_in_its_place,
            path.display()
        ))),
        _ => Ok(()),
    }
}

/// An error where `target` is the input: an input changes only with `--in-place`.
pub(crate) fn refuse_input(target: &Path, input: &Path) -> Result<(), Failure> {
    let same = match (target.canonicalize(), input.canonicalize()) {
        (Ok(target), Ok(input)) => target == input,
        _ => false,
    };
    if same {
        return Err(Failure(say!(
            is_the_input_expected_another_file,
            target.display()
        )));
    }
    Ok(())
}

/// How much of a file is read to find whether wedm wrote it.
const MARKED_WITHIN: u64 = 1024;

/// An error where `target` is a file that does not begin as wedm's own do: `mark` stands in what wedm writes there.
pub(crate) fn refuse_foreign(target: &Path, mark: &str) -> Result<(), Failure> {
    if std::fs::symlink_metadata(target).is_err() {
        return Ok(());
    }
    let mut head = Vec::new();
    let read = std::fs::File::open(target).and_then(|file| {
        io::Read::read_to_end(&mut io::Read::take(file, MARKED_WITHIN), &mut head)
    });
    match read.is_ok() && memchr::memmem::find(&head, mark.as_bytes()).is_some() {
        true => Ok(()),
        false => Err(Failure::of(target, say!(it_is_of_somebody_else))),
    }
}

/// Adds a line to a text of several.
pub(crate) fn push_line(text: &mut String, line: impl AsRef<str>) {
    text.push_str(line.as_ref());
    text.push('\n');
}

/// The text, left-aligned in this many columns of a terminal, where a Chinese character takes two.
pub(crate) fn flush_left(text: &str, width: usize) -> String {
    format!("{text}{}", " ".repeat(width.saturating_sub(columns(text))))
}

/// The same, right-aligned.
pub(crate) fn flush_right(text: &str, width: usize) -> String {
    format!("{}{text}", " ".repeat(width.saturating_sub(columns(text))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_but_lines_and_colours_reaches_a_terminal() {
        let check =
            |text: &str, expected: &str| assert_eq!(shown(text, true), expected, "{text:?}");
        check("plain\n\ttext\n", "plain\n\ttext\n");
        check(&styled(ERROR, "a"), &styled(ERROR, "a"));
        check(
            "a\u{1b}]0;title\u{7}\u{1b}[2Jb\u{1b}[31",
            "a\u{fffd}]0;title\u{fffd}\u{fffd}[2Jb\u{fffd}[31",
        );
        check("a\r\nb\rc\u{9b}", "a\nb\u{fffd}c\u{fffd}");
        check("\u{202e}\u{1b}", "\u{fffd}\u{fffd}");
    }

    #[test]
    fn without_colours_the_same_is_shown() {
        let text =
            styled(ERROR, "a\u{1b}[2Jb\t\u{e4}\u{202e}") + &styled(FAINT, "\n\u{6a21}c\r\nd\r");
        let stripped = anstream::adapter::strip_str(&shown(&text, true)).to_string();
        assert_eq!(shown(&text, false), stripped);
        assert_eq!(
            stripped,
            "a\u{fffd}[2Jb\t\u{e4}\u{fffd}\n\u{6a21}c\nd\u{fffd}"
        );
        assert_eq!(shown("plain\n", false), "plain\n");
    }

    #[test]
    fn escaped_json_says_the_same() {
        let value = serde_json::json!({ "a\u{1b}\u{9b}": ["\u{202e}\n", "\u{e0041}ä模"] });
        let escaped = escaped(&format!("{value:#}\n"));
        assert!(
            !escaped.contains(|character| is_hidden(character) && character != '\n'),
            "{escaped}"
        );
        assert_eq!(
            serde_json::from_str::<serde_json::Value>(&escaped).unwrap(),
            value
        );
    }
}
