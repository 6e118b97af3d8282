//! The findings for a person, and their totals.

use super::Survey;
use crate::cli::output::{self, push_line, styled};
use crate::cli::report::{Row, SHARE};
use crate::finding::{Rule, Severity};
use crate::message::readable;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// With the lines at fault of every file.
pub(super) fn excerpts(survey: &Survey) -> String {
    let mut text = String::new();
    let suppressed: &[Row] = match survey.shows_suppressed {
        true => &survey.suppressed,
        false => &[],
    };
    for rows in survey.rows.chunks(16 * SHARE).chain([suppressed]) {
        let rows = rows.par_iter().with_min_len(SHARE);
        let rendered: Vec<String> = rows.map(Row::rendered).collect();
        for row in rendered {
            push_line(&mut text, row + "\n");
        }
    }
    text + &summary(survey)
}

/// Drawings with a line for each finding, and one for all hints of a rule; texts with the lines at fault.
pub(super) fn render(survey: &Survey) -> String {
    let mut text = String::new();
    let suppressed = survey.suppressed.iter().filter(|_| survey.shows_suppressed);
    let mut hints: BTreeMap<(&str, Rule), usize> = BTreeMap::new();
    let is_hint = |row: &Row| row.is_drawn() && row.severity == Severity::Hint;
    for row in survey.rows.iter().filter(|row| is_hint(row)) {
        *hints.entry((&row.path, row.rule)).or_default() += 1;
    }
    // That a drawing does not say its unit stands in the last line.
    let is_said = |row: &&Row| row.rule == Rule::Units && row.severity == Severity::Information;
    for row in survey.rows.iter().filter(|row| !is_said(row)) {
        let count = match is_hint(row) {
            // Said with the first.
            true => hints.remove(&(&row.path, row.rule)),
            false => Some(1),
        };
        match count {
            None => {}
            Some(1) => push_line(&mut text, row.shown()),
            Some(count) => {
                let more = say!(and_more_with_concise, count - 1);
                push_line(&mut text, say!(with_its_places, row.shown(), more));
            }
        }
    }
    suppressed.for_each(|row| push_line(&mut text, row.shown()));
    text + &summary(survey)
}

/// The totals, and what can be done.
pub(super) fn summary(survey: &Survey) -> String {
    let mut text = String::new();
    let count = |severity| {
        survey
            .rows
            .iter()
            .filter(|row| row.severity == severity)
            .count()
    };
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    let notes = survey.rows.len() - errors - warnings;
    let mut parts = Vec::new();
    if errors > 0 {
        parts.push(styled(output::ERROR, say!(errors, errors)));
    }
    if warnings > 0 {
        parts.push(styled(output::WARNING, say!(warnings, warnings)));
    }
    if notes > 0 {
        parts.push(say!(notes, notes));
    }
    let result = match (parts.is_empty(), survey.empty.len()) {
        (true, 0) => styled(output::GOOD, say!(nothing_found)),
        // What is not cut was not judged.
        (true, count) if count == survey.files => styled(output::WARNING, say!(nothing_is_cut)),
        (true, _) => say!(nothing_found).to_owned(),
        (false, _) => parts.join(say!(comma)),
    };
    let suppressed = match survey.suppressed.len() {
        0 => String::new(),
        count => say!(and_so_many_suppressed, count),
    };
    let result = result + &suppressed;
    let files = say!(files, survey.files);
    let checked = match survey.files {
        // Without any document "nothing found" would be misleading.
        0 if survey.rows.is_empty() => say!(nothing_to_check, files),
        _ => say!(checked, files, result),
    };
    push_line(&mut text, checked);
    if let Some(first) = survey.fixable.first() {
        let heading = match survey.fixable.len() {
            1 => say!(repair_what_can_be_repaired).to_owned(),
            count => say!(files_that_can_be_repaired, say!(files, count)),
        };
        let heading = styled(output::NOTE, heading);
        let command = say!(the_command_that_fixes, output::word(first));
        push_line(&mut text, say!(says, heading, command));
    }
    for (path, holds) in survey.empty.iter().take(SOME) {
        let heading = styled(output::WARNING, say!(nothing_is_cut));
        let path = readable(&path.to_string_lossy()).into_owned();
        push_line(&mut text, say!(says, path, say!(says, heading, holds)));
    }
    text + &against(survey)
}

/// The most lines about single files, or about what several were judged against.
const SOME: usize = 4;

/// What the drawings were judged against: a line where it is the same for all.
fn against(survey: &Survey) -> String {
    let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
    for (_, against) in &survey.against {
        *kinds.entry(against.on_a_terminal()).or_default() += 1;
    }
    let mut kinds: Vec<(String, usize)> = kinds.into_iter().collect();
    kinds.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let mut text = String::new();
    let is_one = kinds.len() == 1;
    for (said, count) in kinds.into_iter().take(SOME) {
        let line = match is_one {
            true => say!(judged_against, said),
            false => say!(files_judged_against, say!(files, count), said),
        };
        push_line(&mut text, styled(output::FAINT, line));
    }
    text
}
