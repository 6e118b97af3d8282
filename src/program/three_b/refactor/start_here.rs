//! Begin a closed contour with the selected block; the ways in and out lead to its start.
//!
//! ```text
//! B5000B0B5000GXL3           B5000B10000B10000GYL3
//! B10000B0B10000GXL1    →    B0B10000B10000GYL2       ← the cursor stood here
//! B0B10000B10000GYL2         B10000B0B10000GXL3
//! ```

use super::Refactoring;
use super::reverse::kept;
use super::rewrite::{Rewrite, encoded};
use super::sheet::{Content, Contour, Sheet};
use crate::geometry::{Point, Segment, cross};
use crate::program::three_b::block::Node;
use crate::text::TextEdit;

pub const START_HERE: Refactoring = Refactoring {
    id: "refactor.rewrite.startHere",
    title: |_| "Begin the contour with this block".into(),
    rewrite: start_here,
};

fn start_here(sheet: &Sheet<'_>) -> Result<Vec<TextEdit>, String> {
    let content = sheet.content()?;
    let line = sheet.selected_lines().start;
    let first = content
        .rows
        .iter()
        .position(|row| row.line == line)
        .ok_or("no block is selected")?;
    let contour = content
        .contours
        .iter()
        .find(|contour| contour.rows.contains(&first))
        .ok_or("no contour is selected")?;
    content.refuse_pause(contour)?;
    let own = contour.own_rows();
    if !own.contains(&first) {
        return Err(
            "the block leads to the contour or away from it, expected one of the contour".into(),
        );
    }
    if !contour.closed {
        return Err(format!(
            "contour {} is open and can begin at its end only",
            contour.ordinal
        ));
    }
    if first == own.start {
        return Ok(Vec::new());
    }
    let nodes = content.nodes()?;
    let begin = nodes[first].0;
    let mut rewrite = Rewrite {
        end: sheet.trace.end(),
        ..Rewrite::default()
    };
    let order = (first..own.end).chain(own.start..first);
    for (index, source) in own.clone().zip(order) {
        rewrite
            .rows
            .insert(index, kept(content, source..source + 1, &nodes));
    }
    match (contour.lead_in, contour.lead_out) {
        (0, 0) if content.contours.len() == 1 => {
            let point = Point::new(begin.x as f64, begin.y as f64);
            (rewrite.start, rewrite.end) = (Some(begin), point);
        }
        (0, 0) => return Err("what comes before and behind leads to the present start".into()),
        (1, 0 | 1) => {
            let hole = nodes[contour.rows.start].0;
            refuse_crossing(content, contour, &nodes, hole, begin)?;
            let row = contour.rows.start;
            rewrite.rows.insert(
                row,
                encoded(
                    &line_between(hole, begin),
                    hole,
                    begin,
                    None,
                    row,
                    content.largest,
                )?,
            );
            if contour.lead_out == 1 {
                let row = contour.rows.end - 1;
                let away = nodes[row].1;
                refuse_crossing(content, contour, &nodes, away, begin)?;
                rewrite.rows.insert(
                    row,
                    encoded(
                        &line_between(begin, away),
                        begin,
                        away,
                        None,
                        row,
                        content.largest,
                    )?,
                );
            } else {
                rewrite.end = Point::new(begin.x as f64, begin.y as f64);
                if content
                    .contours
                    .last()
                    .is_none_or(|last| last.rows != contour.rows)
                {
                    return Err("what comes behind begins at the present end of the contour".into());
                }
            }
        }
        _ => return Err("the way in or out is more than one block".into()),
    }
    rewrite.edits(sheet, content)
}

fn line_between(from: Node, to: Node) -> Segment {
    Segment::line(
        Point::new(from.x as f64, from.y as f64),
        Point::new(to.x as f64, to.y as f64),
    )
}

/// An error where the straight way from `hole` to `begin` cuts through the contour.
fn refuse_crossing(
    content: &Content,
    contour: &Contour,
    nodes: &[(Node, Node)],
    hole: Node,
    begin: Node,
) -> Result<(), String> {
    let way = line_between(hole, begin);
    let (start, along) = (way.start(), way.end() - way.start());
    let length = along.norm();
    if length == 0.0 {
        return Err("the thread hole lies on the start".into());
    }
    for index in contour.own_rows() {
        let piece = content.piece_from(index, nodes[index].0);
        // Chords are near enough to tell on which side of the way a piece runs.
        let pieces = piece
            .as_arc()
            .map_or(1, |arc| (arc.sweep.abs() / 0.05).ceil().max(1.0) as usize);
        let point = |share: usize| piece.point_at(share as f64 / pieces as f64);
        for share in 0..pieces {
            let (a, b) = (point(share), point(share + 1));
            let (side_a, side_b) = (
                cross(along, a - start) / length,
                cross(along, b - start) / length,
            );
            if side_a * side_b >= 0.0 {
                continue;
            }
            let at = a + (b - a) * (side_a / (side_a - side_b));
            let share_of_way = (at - start).dot(&along) / (length * length);
            // The end of the way lies on the contour.
            if share_of_way > 0.0 && (at - way.end()).norm() > TOUCH && share_of_way < 1.0 {
                return Err(format!(
                    "the way from the thread hole would cut the contour in line {}",
                    content.rows[index].line + 1
                ));
            }
        }
    }
    Ok(())
}

/// How near to its end the way may meet the contour, µm.
const TOUCH: f64 = 3.0;
