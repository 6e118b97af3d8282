//! I and J in another convention of controls.
//!
//! ```text
//! G03 X0. Y10. I-5. J0.      →     G03 X0. Y10. I5. J0.     (from the centre to the start)
//! ```

use super::Iso;
use crate::program::iso::moves::{Bend, CenterRule};
use crate::program::refactor::{Edits, Refactoring, Rewrite, Sheet};

pub(super) const START_TO_CENTER: Refactoring<Iso> = Refactoring {
    id: "refactor.rewrite.centers.startToCenter",
    title: |_| say!(let_i_and_j_lead_from_the_start_to_the_centre).into(),
    rewrite: |sheet| converted(sheet, CenterRule::StartToCenter),
};
pub(super) const CENTER_TO_START: Refactoring<Iso> = Refactoring {
    id: "refactor.rewrite.centers.centerToStart",
    title: |_| say!(let_i_and_j_lead_from_the_centre_to_the_start).into(),
    rewrite: |sheet| converted(sheet, CenterRule::CenterToStart),
};
pub(super) const ABSOLUTE: Refactoring<Iso> = Refactoring {
    id: "refactor.rewrite.centers.absolute",
    title: |_| say!(let_i_and_j_be_coordinates_of_the_centre).into(),
    rewrite: |sheet| converted(sheet, CenterRule::Absolute),
};

fn converted(sheet: &Sheet<'_, Iso>, rule: CenterRule) -> Edits {
    let content = sheet.content()?;
    let old = sheet.document.reading();
    let with_center = |incremental: bool| {
        let arcs = content
            .rows
            .iter()
            .filter(move |row| row.own.made.is_arc() && row.own.made.incremental == incremental);
        arcs.filter(|row| matches!(row.own.made.bend, Bend::Center { .. }))
            .count()
    };
    let (absolute, incremental) = (with_center(false), with_center(true));
    let changes =
        (absolute > 0 && old.absolute != rule) || (incremental > 0 && old.incremental != rule);
    if !changes {
        return Ok(Vec::new());
    }
    if rule == CenterRule::Absolute && incremental > 0 {
        return Err(say!(under_g91_a_centre_has_no_coordinates_of_its_own).into());
    }
    let mut rewrite = Rewrite::<Iso>::new();
    rewrite.extra.reading = Some(old.with_rule(rule));
    rewrite.edits(sheet, content)
}
