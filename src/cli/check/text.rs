//! The findings for a person, and their totals.

use super::Survey;
use crate::cli::output::{self, push_line, styled};
use crate::cli::report::{Row, SHARE};
use crate::finding::Severity;
use rayon::prelude::*;

pub(super) fn render(survey: &Survey) -> String {
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
    let result = if parts.is_empty() {
        styled(output::GOOD, say!(nothing_found))
    } else {
        parts.join(say!(comma))
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
    text
}
