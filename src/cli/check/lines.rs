//! The findings, a line each: for people who want an overview, and for tools that read such lines.

use super::Survey;
use crate::cli::output::{self, push_line, styled};
use crate::cli::report::{Row, Span};
use crate::finding::{Rule, Severity};
use crate::message::readable;
use crate::picture;
use std::fmt::Write;

/// `path:line:column: severity[rule]: sentence (where)`.
pub(super) fn concise(survey: &Survey) -> String {
    let line = |row: &Row| format!("{}:{}", readable(&row.path), told(row));
    let suppressed = survey.suppressed.iter().filter(|_| survey.shows_suppressed);
    survey.rows.iter().chain(suppressed).map(line).collect()
}

/// The same under a heading for each file.
pub(super) fn grouped(survey: &Survey) -> String {
    let mut text = String::new();
    for rows in survey.rows.chunk_by(|one, other| one.path == other.path) {
        let path = readable(&rows[0].path);
        push_line(&mut text, styled(output::STRONG, path));
        rows.iter()
            .for_each(|row| text.push_str(&format!("  {}", told(row))));
        text.push('\n');
    }
    text
}

fn told(row: &Row) -> String {
    let style = match row.severity {
        Severity::Error => output::ERROR,
        Severity::Warning => output::WARNING,
        _ => output::NOTE,
    };
    let head = styled(
        style,
        format!("{}[{}]", name(row.severity), row.rule.name()),
    );
    let Span { line, column, .. } = row.span;
    format!("{line}:{column}: {head}: {}\n", said(row))
}

/// The sentence, its place, the other places, and the reason of a suppression.
fn said(row: &Row) -> String {
    let others = row.others(|related| related.message.clone());
    let reason = row
        .suppressed
        .iter()
        .map(|reason| say!(suppressed_since, readable(reason)));
    let places = row.whereabouts().into_iter().chain(others).chain(reason);
    match places.collect::<Vec<_>>().join("; ") {
        none if none.is_empty() => row.message.clone(),
        places => say!(with_its_places, row.message, places),
    }
}

/// How often each rule occurs, most often first.
pub(super) fn statistics(survey: &Survey) -> String {
    let mut counts: Vec<(usize, Rule, Severity)> = Vec::new();
    for row in &survey.rows {
        match counts.iter_mut().find(|count| count.1 == row.rule) {
            Some(count) => (count.0, count.2) = (count.0 + 1, count.2.min(row.severity)),
            None => counts.push((1, row.rule, row.severity)),
        }
    }
    counts.sort_by_key(|&(count, rule, _)| (std::cmp::Reverse(count), rule));
    let mut text = String::new();
    for (count, rule, severity) in counts {
        let (rule, summary) = (rule.name(), rule.summary());
        let _ = writeln!(
            text,
            "{count:>7}  {rule:<20} {:<11}  {summary}",
            name(severity)
        );
    }
    text
}

fn name(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Information => "information",
        Severity::Hint => "hint",
    }
}

/// Commands of a GitHub workflow, which shows them beside the lines of a change.
pub(super) fn github(survey: &Survey) -> String {
    let of_row = |row: &Row| {
        let level = match row.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Information | Severity::Hint => "notice",
        };
        let Span {
            line,
            column,
            end_line,
            end_column,
        } = row.span;
        format!(
            "::{level} file={},line={line},endLine={end_line},col={column},endColumn={end_column},title={}::{}\n",
            escaped(&row.path, true),
            row.rule.name(),
            escaped(&said(row), false)
        )
    };
    survey.rows.iter().map(of_row).collect()
}

/// Characters that would end a property or the command are written as numbers.
fn escaped(text: &str, is_property: bool) -> String {
    let mut out = text.replace('%', "%25");
    out = out.replace('\r', "%0D").replace('\n', "%0A");
    if is_property {
        out = out.replace(':', "%3A").replace(',', "%2C");
    }
    out
}

/// JUnit's XML: a suite for each file, a case for each finding. Failed are those that decide how the command ends, of
/// severities up to `limit`; the others are printed by cases that passed.
pub(super) fn junit(survey: &Survey, limit: Severity) -> String {
    let failed = |rows: &[Row]| rows.iter().filter(|row| row.severity <= limit).count();
    let (files, findings, failures) = (survey.files, survey.rows.len(), failed(&survey.rows));
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"wedm\" tests=\"{}\" failures=\"{failures}\" errors=\"{}\">\n",
        files.max(findings),
        survey.failures.len()
    );
    for rows in survey.rows.chunk_by(|one, other| one.path == other.path) {
        let (path, count, failed) = (xml(&rows[0].path), rows.len(), failed(rows));
        let _ = writeln!(
            text,
            "  <testsuite name=\"{path}\" tests=\"{count}\" failures=\"{failed}\">"
        );
        for row in rows {
            let (rule, severity) = (row.rule.name(), name(row.severity));
            let (said, Span { line, column, .. }) = (xml(&said(row)), row.span);
            let result = match row.severity <= limit {
                true => format!("<failure type=\"{severity}\" message=\"{said}\"/>"),
                false => format!("<system-out>{severity}: {said}</system-out>"),
            };
            let _ = writeln!(
                text,
                "    <testcase classname=\"{path}\" name=\"{rule}\" line=\"{line}\" column=\"{column}\">{result}</testcase>"
            );
        }
        text.push_str("  </testsuite>\n");
    }
    for failure in &survey.failures {
        let _ = writeln!(
            text,
            "  <testsuite name=\"wedm\" tests=\"1\" errors=\"1\"><testcase name=\"read\"><error message=\"{}\"/></testcase></testsuite>",
            xml(&failure.0)
        );
    }
    text.push_str("</testsuites>\n");
    text
}

/// Text for an attribute; characters that XML forbids are replaced by a mark.
fn xml(text: &str) -> String {
    let is_forbidden = |letter: char| match letter {
        '\n' | '\t' => false,
        letter => letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}'),
    };
    picture::escaped(&text.replace(is_forbidden, "\u{fffd}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_tools_read_is_escaped() {
        assert_eq!(escaped("a:b,c%\n", true), "a%3Ab%2Cc%25%0A");
        assert_eq!(escaped("a: b", false), "a: b");
        assert_eq!(
            xml("<a & \"b\">\u{1b}"),
            "&lt;a &amp; &quot;b&quot;&gt;\u{fffd}"
        );
    }
}
