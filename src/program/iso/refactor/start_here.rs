//! Begin a closed contour with the selected block; the ways in and out lead to its start.
//!
//! ```text
//! G01 X0 Y0                  G01 X10 Y0
//! X10                   →    Y10
//! Y10                        X0 Y0
//! X0 Y0                      X10
//! ```

use super::Refactoring;
use super::rewrite::{Rewrite, Target};
use super::sheet::{Content, Sheet};
use super::taper::{Words, refuse, refuse_anywhere};
use crate::geometry::{Segment, meetings};
use crate::program::iso::machine::{Place, micrometres};
use crate::text::TextEdit;
use std::ops::Range;

pub const START_HERE: Refactoring = Refactoring {
    id: "refactor.rewrite.startHere",
    title: "Begin the contour with this block",
    rewrite: start_here,
};

/// How near to its end the way in may meet the contour, µm.
const TOUCH: f64 = 3.0;

fn start_here(sheet: &Sheet<'_>) -> Result<Vec<TextEdit>, String> {
    let content = sheet.content()?;
    let reading = sheet.document.reading();
    let lines = sheet.selected_lines();
    let first = content
        .rows
        .iter()
        .position(|row| row.line == lines.start)
        .ok_or("no block is selected")?;
    let contour = content
        .contours
        .iter()
        .find(|contour| contour.steps.contains(&first))
        .ok_or("no contour is selected")?;
    let own = content.closed(contour)?;
    if !own.contains(&first) {
        return Err(
            "the block leads to the contour or away from it, expected one of the contour".into(),
        );
    }
    if first == own.start {
        return Ok(Vec::new());
    }
    refuse_anywhere(sheet.document, Words::Guide)?;
    let begins = content.rows[contour.steps.start].line;
    refuse(
        sheet.document,
        begins..content.rows[contour.steps.end - 1].line + 1,
        Words::All,
    )?;
    if contour.lead_in != 1 || contour.lead_out > 1 || own != contour.contour_steps() {
        return Err("the contour has no straight way in of one block".into());
    }
    let begin = content.rows[first].made.from;
    let mut rewrite = Rewrite::default();
    for (index, source) in own.clone().zip((first..own.end).chain(own.start..first)) {
        // The side is that of the place in the program.
        let side = content.rows[index].made.side;
        rewrite.rows.insert(
            index,
            Target {
                side,
                ..Target::of(&content.rows[source].made, reading)
            },
        );
    }
    let way_in = content.rows[contour.steps.start].made;
    if way_in.is_arc() {
        return Err("the way in is an arc".into());
    }
    refuse_crossing(sheet, content, own.clone(), way_in.from, begin)?;
    rewrite.rows.insert(
        contour.steps.start,
        Target {
            to: begin,
            ..Target::of(&way_in, reading)
        },
    );
    match content.rows.get(own.end).filter(|_| contour.lead_out == 1) {
        Some(way_out) if way_out.made.is_arc() => return Err("the way out is an arc".into()),
        Some(way_out) => refuse_crossing(sheet, content, own, way_out.made.to, begin)?,
        None if own.end < content.rows.len() => {
            return Err("what comes behind begins at the present end of the contour".into());
        }
        None => {}
    }
    rewrite.edits(sheet, content)
}

/// An error where the straight way from `hole` to `begin` cuts through the contour.
fn refuse_crossing(
    sheet: &Sheet<'_>,
    content: &Content,
    own: Range<usize>,
    hole: Place,
    begin: Place,
) -> Result<(), String> {
    let way = Segment::line(micrometres(hole), micrometres(begin));
    for row in &content.rows[own] {
        let piece = row.made.segment(sheet.document.reading());
        if meetings(&way, &piece)
            .into_iter()
            .any(|at| (at - way.end()).norm() > TOUCH)
        {
            return Err(format!(
                "the way from the thread hole would cut the contour in line {}",
                row.line + 1
            ));
        }
    }
    Ok(())
}
