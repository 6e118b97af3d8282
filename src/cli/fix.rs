//! `wedm fix`: every safe repair of a drawing, in its own bytes.

use super::options::Common;
use super::output::{self, counted, styled};
use super::report::{self, Row};
use super::{Failure, Verdict, files};
use crate::document::{Document, Source};
use crate::finding::{Rule, Severity};
use crate::text::TextEdit;
use clap::Args;
use similar::{ChangeTag, TextDiff};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Repair what can be repaired safely
///
/// Only the numbers that change are written, every other byte stays: code page, line ends, what wedm does not know. What came out
/// is read again and checked before it is written. Ends with 1 when errors are left.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm fix plate.dxf --diff                what would change
  wedm fix plate.dxf -o fixed.dxf
  wedm fix plate.dxf --in-place --correction 0.12")]
pub struct Arguments {
    /// The drawing
    #[arg(value_name = "PATH")]
    path: PathBuf,
    #[command(flatten)]
    target: Target,
    #[command(flatten)]
    common: Common,
}

#[derive(Args, Debug)]
#[group(required = true, multiple = false)]
struct Target {
    /// Write the repaired drawing there (`-` is stdout)
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Write the repaired drawing over the input
    #[arg(long)]
    in_place: bool,
    /// Print what would change, and write nothing
    #[arg(long)]
    diff: bool,
}

/// A fix may make room for another one; past this many rounds nothing new comes of it.
const ROUNDS: usize = 12;

pub fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let path = &arguments.path;
    if let Some(target) = &arguments.target.output {
        output::refuse_input(target, path)?;
    }
    let opened = files::open_drawing(path, &arguments.common, &arguments.common.settings())?;
    files::refuse_faulty_settings(&opened)?;
    let repair = repair(path, opened.document)?;
    deliver(arguments, &repair)?;
    summarise(path, &repair);
    let errors_left = repair.after.iter().any(|row| row.severity == Severity::Error);
    Ok(if errors_left { Verdict::Errors } else { Verdict::Clean })
}

/// A drawing before and after.
struct Repair {
    bytes_before: Vec<u8>,
    before: Vec<Row>,
    document: Document,
    after: Vec<Row>,
    rounds: usize,
}

impl Repair {
    fn bytes(&self) -> &[u8] {
        self.document.text().map_or(&[], |text| text.bytes())
    }

    fn is_changed(&self) -> bool {
        self.bytes() != self.bytes_before
    }
}

/// Fixes all, again and again until nothing is left to fix, and proves that the result is no worse.
fn repair(path: &Path, mut document: Document) -> Result<Repair, Failure> {
    let before = report::rows(path, &mut document);
    let bytes_before = document.text().map_or_else(Vec::new, |text| text.bytes().to_vec());
    let mut rounds = 0;
    while rounds < ROUNDS
        && let Some(edits) = next_edits(path, &document)?
    {
        let settings = document.settings().clone();
        let present = document.text().map_or(&[][..], |text| text.bytes());
        let edited = edited(present, &edits).ok_or_else(|| Failure(format!("{}: the edits of a fix overlap", path.display())))?;
        document = files::drawing_of(edited, settings);
        rounds += 1;
    }
    let after = report::rows(path, &mut document);
    let repair = Repair { bytes_before, before, document, after, rounds };
    let errors = |rows: &[Row]| rows.iter().filter(|row| row.severity == Severity::Error).count();
    if errors(&repair.after) > errors(&repair.before) {
        let sentence = "the repaired drawing has more errors than the drawing had; nothing is written";
        return Err(Failure(format!("{}: internal error: {sentence}", path.display())));
    }
    Ok(repair)
}

fn next_edits(path: &Path, document: &Document) -> Result<Option<Vec<TextEdit>>, Failure> {
    let (Some(edit), Source::Dxf(text)) = (document.fix_all(), document.source()) else { return Ok(None) };
    let edits = text.text_edits(&edit).map_err(|reason| Failure(format!("{}: {reason}", path.display())))?;
    Ok(Some(edits).filter(|edits| !edits.is_empty()))
}

/// The bytes with `edits` made, which are sorted and disjoint; `None` when they are not, or reach past the end.
fn edited(bytes: &[u8], edits: &[TextEdit]) -> Option<Vec<u8>> {
    let mut result = Vec::with_capacity(bytes.len());
    let mut at = 0;
    for edit in edits {
        result.extend_from_slice(bytes.get(at..edit.range.start)?);
        result.extend_from_slice(edit.text.as_bytes());
        at = edit.range.end;
    }
    result.extend_from_slice(bytes.get(at..)?);
    Some(result)
}

fn deliver(arguments: &Arguments, repair: &Repair) -> Result<(), Failure> {
    let target = &arguments.target;
    if target.diff {
        return output::print(&diff(&arguments.path, &repair.bytes_before, repair.bytes()));
    }
    match &target.output {
        Some(path) => output::write(Some(path), repair.bytes()),
        None if repair.is_changed() => output::write(Some(&arguments.path), repair.bytes()),
        None => Ok(()),
    }
}

/// A unified diff with three lines of context.
fn diff(path: &Path, before: &[u8], after: &[u8]) -> String {
    if before == after {
        return String::new();
    }
    let diff = TextDiff::from_lines(before, after);
    let mut text = String::new();
    let _ = writeln!(text, "{}\n{}", styled(output::STRONG, format!("--- {}", path.display())), styled(output::STRONG, format!("+++ {}", path.display())));
    for hunk in diff.unified_diff().context_radius(3).iter_hunks() {
        let _ = writeln!(text, "{}", styled(output::NOTE, hunk.header()));
        for change in hunk.iter_changes() {
            let (sign, style) = match change.tag() {
                ChangeTag::Delete => ("-", output::ERROR),
                ChangeTag::Insert => ("+", output::GOOD),
                ChangeTag::Equal => (" ", anstyle::Style::new()),
            };
            let line = change.to_string_lossy();
            // A line end inside the colours would colour the next line's margin; it is written as it is.
            let shown = line.trim_end_matches(['\n', '\r']);
            let end = &line[shown.len()..];
            let _ = write!(text, "{}{}", styled(style, format!("{sign}{shown}")), if end.is_empty() { "\n" } else { end });
            if change.missing_newline() {
                text.push_str("\\ No newline at end of file\n");
            }
        }
    }
    text
}

/// What was repaired, and what is left and why, to stderr: stdout may be the drawing.
fn summarise(path: &Path, repair: &Repair) {
    let tight = |rows: &[Row]| rows.iter().filter(|row| row.rule == Rule::SmallRadius).count();
    let (before, after) = (tight(&repair.before), tight(&repair.after));
    let repaired = before.saturating_sub(after);
    let name = path.display();
    match (repaired, before) {
        (0, 0) => output::say(&format!("{name}: no arc is tighter than the correction, nothing to repair")),
        (0, _) => output::say(&format!("{name}: nothing could be repaired safely")),
        _ => {
            let arcs = counted(repaired, "arc");
            let rounds = if repair.rounds > 1 { format!(" in {} rounds", repair.rounds) } else { String::new() };
            output::say(&format!("{name}: {}{rounds}", styled(output::GOOD, format!("{arcs} repaired"))));
        }
    }
    for row in repair.after.iter().filter(|row| row.severity <= Severity::Warning) {
        let reason = match &row.data.no_fix {
            None if row.rule == Rule::SmallRadius => " (its fix moves the contour far: choose it in the editor)",
            _ => "",
        };
        let place = format!("{name}:{}:{}", row.line, row.column);
        output::say(&format!("{} {place}: {}{reason}", styled(output::WARNING, "left:"), row.message));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn replacement(range: std::ops::Range<usize>, text: &str) -> TextEdit {
        TextEdit { range, text: text.into() }
    }

    #[test]
    fn edits_change_their_bytes_and_no_others() {
        let edits = [replacement(1..2, "xyz"), replacement(3..3, "-"), replacement(4..5, "")];
        assert_eq!(edited(b"ab\xffde", &edits).as_deref(), Some(&b"axyz\xff-d"[..]));
    }

    #[test]
    fn edits_that_cannot_be_made_are_refused() {
        for edits in [vec![replacement(0..9, "")], vec![replacement(2..3, ""), replacement(1..2, "")]] {
            assert_eq!(edited(b"abc", &edits), None);
        }
    }
}
