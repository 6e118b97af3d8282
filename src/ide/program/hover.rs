//! What stands at a place: the block in words, and what the word under the cursor means in it.

use super::sentences::{degrees, mm, point};
use super::words::words_of;
use super::{iso, three_b};
use crate::geometry::Segment;
use crate::ide::Hover;
use crate::program::Document;
use crate::program::path::{Kind, Step};

/// A deviation below this is rounding, µm.
const SHOWN_DEVIATION: f64 = 0.05;

/// What stands at a byte; `None` where nothing does.
pub fn hover(document: &Document, offset: usize) -> Option<Hover> {
    let text = document.text();
    let line = text.line_of(offset);
    let parts = words_of(document, line);
    let part = parts
        .iter()
        .find(|part| part.range.start <= offset && offset < part.range.end);
    // Behind the last letter the cursor still means it.
    let part = part.or_else(|| parts.iter().rev().find(|part| part.range.end == offset))?;
    let steps = document.steps_in(text.line_range(line));
    let step = steps
        .iter()
        .find(|step| step.range.start <= part.range.start && part.range.end <= step.range.end);
    // A block number and the end point stand outside of their block.
    let step = step
        .or_else(|| {
            steps
                .iter()
                .rfind(|step| step.range.end <= part.range.start)
        })
        .or(steps.first());
    let word = match document {
        Document::ThreeB(program) => three_b::meaning(program, part.range.clone()),
        Document::Iso(program) => iso::meaning(program, part.range.clone()),
    };
    let block = step.map(|step| about_step(step, steps.len() > 1));
    let text = [word, block]
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join("\n\n");
    (!text.is_empty()).then(|| Hover {
        range: part.range.clone(),
        text,
    })
}

fn about_step(step: &Step, one_of_many: bool) -> String {
    let name = step
        .number
        .map_or_else(String::new, |number| format!("N{number}: "));
    let mut lines = Vec::new();
    match (step.kind, &step.ideal) {
        (Kind::Pause, _) => lines.push(format!("**{name}pause** at {} mm", point(step.start))),
        (Kind::End, _) => lines.push(format!("**{name}end** at {} mm", point(step.start))),
        (_, None) => lines.push(format!(
            "**{name}block that leads nowhere**: the machine stays at {} mm",
            point(step.start)
        )),
        (kind, Some(Segment::Line(line))) => {
            let what = if kind == Kind::Rapid {
                "way without the wire"
            } else {
                "line"
            };
            let along = line.end - line.start;
            lines.push(format!("**{name}{what}** to {} mm", point(step.end)));
            lines.push(format!(
                "from {}, length {} mm, direction {}",
                point(step.start),
                mm(along.norm()),
                degrees(along.y.atan2(along.x))
            ));
        }
        (_, Some(Segment::Arc(arc))) => {
            let turn = if arc.sweep > 0.0 {
                "counter-clockwise"
            } else {
                "clockwise"
            };
            let what = if arc.is_full_turn() { "circle" } else { "arc" };
            lines.push(format!(
                "**{name}{what}** {turn} about {} mm, R {} mm, {}",
                point(arc.center),
                mm(arc.radius),
                degrees(arc.sweep.abs())
            ));
            lines.push(format!(
                "from {} to {}, length {} mm",
                point(step.start),
                point(step.end),
                mm(arc.length())
            ));
        }
    }
    if step.moves() && step.deviation() > SHOWN_DEVIATION {
        let ideal = step.ideal.map_or(step.end, |ideal| ideal.end());
        lines.push(format!(
            "the machine stops {:.1} µm beside the ideal end ({:.4}, {:.4})",
            step.deviation(),
            ideal.x / 1000.0,
            ideal.y / 1000.0
        ));
    }
    if one_of_many {
        lines.push("one of several in this line".into());
    }
    lines.join("\n\n")
}
