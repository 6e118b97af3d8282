//! The hover at a place: the block in words, and the meaning of the word under the cursor.

use super::words_of;
use super::{iso, three_b};
use crate::geometry::Segment;
use crate::ide::Hover;
use crate::ide::amounts::{degrees, mm, point, turn};
use crate::program::Document;
use crate::program::path::{Kind, Step};

/// A deviation below this is rounding, µm.
const SHOWN_DEVIATION: f64 = 0.05;

/// The hover at a byte; `None` where there is nothing.
pub(crate) fn hover(document: &Document, offset: usize) -> Option<Hover> {
    let text = document.text();
    let line = text.line_of(offset);
    let parts = words_of(document, line);
    let part = parts
        .iter()
        .find(|part| part.range.start <= offset && offset < part.range.end);
    // A cursor right after the last letter still means the word.
    let part = part.or_else(|| parts.iter().rev().find(|part| part.range.end == offset))?;
    let steps = document.steps_in(text.line_range(line));
    let step = steps
        .iter()
        .find(|step| step.range.start <= part.range.start && part.range.end <= step.range.end);
    // A block number and the end point are outside their block.
    let step = step
        .or_else(|| {
            steps
                .iter()
                .rfind(|step| step.range.end <= part.range.start)
        })
        .or(steps.first());
    let own = part.range.clone();
    let word = match document {
        Document::ThreeB(program) => three_b::meaning(program, own),
        Document::Iso(program) => iso::meaning(program, own),
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
    let (start, end) = (point(step.start), point(step.end));
    let mut lines = match (step.kind, &step.ideal) {
        (Kind::Pause, _) => vec![say!(step_at, name, say!(pause), start)],
        (Kind::End, _) => vec![say!(step_at, name, say!(end), start)],
        (_, None) => vec![say!(step_leads_nowhere, name, start)],
        (kind, Some(Segment::Line(line))) => {
            let what = if kind == Kind::Rapid {
                say!(way_without_the_wire)
            } else {
                say!(line)
            };
            let along = line.end - line.start;
            let (length, direction) = (mm(along.norm()), degrees(along.y.atan2(along.x)));
            vec![
                say!(step_to, name, what, end),
                say!(from_length_and_direction, start, length, direction),
            ]
        }
        (_, Some(Segment::Arc(arc))) => {
            let what = if arc.is_full_turn() {
                say!(circle)
            } else {
                say!(arc)
            };
            let (centre, radius) = (point(arc.center), mm(arc.radius));
            let (turn, sweep) = (turn(arc.sweep), degrees(arc.sweep.abs()));
            vec![
                say!(step_about, name, what, turn, centre, radius, sweep),
                say!(from_to_and_length, start, end, mm(arc.length())),
            ]
        }
    };
    if step.moves() && step.deviation() > SHOWN_DEVIATION {
        let ideal = step.ideal.map_or(step.end, |ideal| ideal.end()) / 1000.0;
        lines.push(say!(
            the_machine_stops_beside_the_ideal_end,
            step.deviation(),
            ideal.x,
            ideal.y
        ));
    }
    if one_of_many {
        lines.push(say!(one_of_several_in_this_line).into());
    }
    lines.join("\n\n")
}
