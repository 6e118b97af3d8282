//! I and J in another of the conventions that controls have.
//!
//! ```text
//! G03 X0. Y10. I-5. J0.      →     G03 X0. Y10. I5. J0.     (from the centre to the start)
//! ```

use super::Refactoring;
use super::rewrite::Rewrite;
use super::sheet::Sheet;
use crate::program::iso::machine::{Bend, CenterRule, Reading};
use crate::text::TextEdit;

pub const START_TO_CENTER: Refactoring = Refactoring {
    id: "refactor.rewrite.centers.startToCenter",
    title: "Let I and J lead from the arc's start to its centre",
    rewrite: |sheet| converted(sheet, CenterRule::StartToCenter),
};
pub const CENTER_TO_START: Refactoring = Refactoring {
    id: "refactor.rewrite.centers.centerToStart",
    title: "Let I and J lead from the arc's centre to its start",
    rewrite: |sheet| converted(sheet, CenterRule::CenterToStart),
};
pub const ABSOLUTE: Refactoring = Refactoring {
    id: "refactor.rewrite.centers.absolute",
    title: "Let I and J be the centre's own coordinates",
    rewrite: |sheet| converted(sheet, CenterRule::Absolute),
};

fn converted(sheet: &Sheet<'_>, rule: CenterRule) -> Result<Vec<TextEdit>, String> {
    let content = sheet.content()?;
    let old = sheet.document.reading();
    let with_center = |incremental: bool| {
        let arcs = content
            .rows
            .iter()
            .filter(move |row| row.made.is_arc() && row.made.incremental == incremental);
        arcs.filter(|row| matches!(row.made.bend, Bend::Center { .. }))
            .count()
    };
    let (absolute, incremental) = (with_center(false), with_center(true));
    let changes =
        (absolute > 0 && old.absolute != rule) || (incremental > 0 && old.incremental != rule);
    if !changes {
        return Ok(Vec::new());
    }
    if rule == CenterRule::Absolute && incremental > 0 {
        return Err(
            "under G91 a centre has no coordinates of its own: make the coordinates absolute first"
                .into(),
        );
    }
    let under_g91 = if rule == CenterRule::Absolute {
        old.incremental
    } else {
        rule
    };
    let rewrite = Rewrite {
        reading: Some(Reading {
            absolute: rule,
            incremental: under_g91,
            ..*old
        }),
        ..Rewrite::default()
    };
    rewrite.edits(sheet, content)
}
