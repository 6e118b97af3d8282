//! Refactorings of ISO: how its moves are read and written, and the refactorings that it alone has.

mod centers;
mod mode;
mod planes;
mod rows;
#[cfg(test)]
mod tests;
mod turned;
mod write;

use super::block::Motion;
use super::document::Document;
use super::line::{Bent, MIDDLE_TOLERANCE, Target};
use super::moves::{Bend, MICROMETRE, Move, Place, micrometres};
use super::plain::{words_at, words_in};
use super::style::Style;
use super::taper::{Words, refuse, refuse_anywhere, refuse_where_it_leans};
use super::word::Token;
use crate::finding::{Finding, Side};
use crate::geometry::Arc;
use crate::program::grid::{Node, best_center, snap};
use crate::program::path::{Cut, Trace};
use crate::program::refactor::{
    At, Change, Content, Edits, News, Notation, Refactoring, Rewrite, Row, Sheet, Transform,
};
use crate::settings::Effective;
use crate::text::TextEdit;
use rows::Own;
use std::ops::Range;
use write::Extra;

/// ISO.
pub(in crate::program) struct Iso;

impl Notation for Iso {
    type Document = Document;
    type Own = Own;
    type New = Target;
    type Extra = Extra;

    const STEP: f64 = 1e-3;

    fn title_of_numbering() -> &'static str {
        say!(number_the_blocks_in_tens)
    }

    fn read(bytes: Vec<u8>, settings: &Effective) -> Document {
        Document::read_with(bytes, settings)
    }

    fn findings(document: &Document) -> Vec<Finding> {
        document.plain_findings()
    }

    fn rows(document: &Document, _: &Trace, _: &[Cut]) -> Result<Vec<Row<Iso>>, String> {
        rows::rows(document)
    }

    fn refuse(sheet: &Sheet<'_, Iso>, change: Change) -> Result<(), String> {
        match change {
            Change::Reverse => refuse_anywhere(sheet.document, Words::All),
            Change::StartHere { lines, is_corner } => {
                refuse_anywhere(sheet.document, Words::Guide)?;
                // At a corner the upper end begins beside its profile, and ends there.
                if is_corner {
                    refuse_where_it_leans(sheet.document, lines.start)?;
                }
                refuse(sheet.document, lines, Words::All)
            }
            Change::Scale => refuse_anywhere(sheet.document, Words::Guide),
        }
    }

    fn kept(at: At<'_, Iso>, place: usize) -> Target {
        // The side depends on the place in the program.
        Target {
            side: at.content.rows[place].own.made.side,
            ..Target::of(&at.own.made, at.sheet.document.reading())
        }
    }

    fn reversed(at: At<'_, Iso>) -> News<Iso> {
        let made = at.own.made;
        Ok(vec![Target {
            motion: made.motion.reversed(),
            to: made.from,
            ..Target::of(&made, at.sheet.document.reading())
        }])
    }

    fn straight(at: At<'_, Iso>, [_, to]: [Node; 2]) -> News<Iso> {
        Ok(vec![Target {
            to: place_of(to),
            ..at.kept()
        }])
    }

    fn transformed(at: At<'_, Iso>, transform: Transform) -> Target {
        let of_place = |place| place_of(transform.of_node(node_of(place)));
        let kept = at.kept();
        let mirrors = transform.mirrors();
        Target {
            motion: if mirrors {
                kept.motion.reversed()
            } else {
                kept.motion
            },
            to: of_place(kept.to),
            bend: match kept.bend {
                Bent::Center(center) => Bent::Center(of_place(center)),
                other => other,
            },
            side: kept
                .side
                .map(|side| if mirrors { side.reversed() } else { side }),
        }
    }

    fn scaled_node(row: &Row<Iso>, node: Node, factor: f64) -> Option<Node> {
        let style = row.own.style;
        let of_length = |length: i64| style.rounded((length as f64 * factor).round() as i64);
        Some(node_of(place_of(node).map(of_length)))
    }

    fn scaled(at: At<'_, Iso>, ends: [Node; 2], factor: f64) -> News<Iso> {
        let (style, old) = (at.own.style, at.kept());
        let [from, to] = ends.map(place_of);
        if from == to && at.from != at.to && old.bend != Bent::Line {
            // It would be a full circle.
            return Ok(Vec::new());
        }
        let bend = match old.bend {
            Bent::Line => Bent::Line,
            Bent::Radius(radius) => {
                let radius = style.rounded((radius as f64 * factor).round() as i64);
                if !keeps_its_bow(at, [from, to], radius, factor) {
                    let why = say!(its_arc_cannot_be_written_with_the_program_s_decimals);
                    return Err(say!(line_by_number, at.line + 1, why));
                }
                Bent::Radius(radius)
            }
            Bent::Center(center) => Bent::Center(
                fitting([from, to], center, factor, &style)
                    .ok_or(say!(the_program_would_run_too_far_out))?,
            ),
        };
        Ok(vec![Target { to, bend, ..old }])
    }

    fn runs_on(at: At<'_, Iso>, first: usize) -> bool {
        let (made, begun) = (at.own.made, at.content.rows[first].own.made);
        made.motion == Motion::Line
            && made.corner.is_none()
            && (at.index == first
                || made.switches.is_none()
                    && begun.switches.is_none()
                    && (made.side, made.offset) == (begun.side, begun.offset)
                    && says_only_where(at.sheet.document, at.line))
    }

    fn is_in_inches(content: &Content<Iso>) -> bool {
        content.rows.iter().any(|row| row.own.style.is_inch())
    }

    fn longest(_: &Effective) -> i64 {
        i64::MAX
    }

    fn turn_round(
        sheet: &Sheet<'_, Iso>,
        content: &Content<Iso>,
        contour: &Cut,
        own: Range<usize>,
        rewrite: &mut Rewrite<Iso>,
    ) -> Result<(), String> {
        // The correction's word is before the way in.
        let before = contour.steps.start.checked_sub(1);
        let before = before.map_or(0, |row| content.rows[row].line + 1);
        let last = content.rows[own.end - 1].line;
        let words = swapped_sides(sheet.document, before..last + 1);
        let mut of_contour = content.rows[contour.steps.clone()].iter();
        if words.is_empty() && of_contour.any(|row| row.own.made.side.is_some()) {
            return Err(say!(the_correction_was_switched_on_for_another_contour).into());
        }
        rewrite.extra.words.extend(words);
        for index in contour.steps.clone() {
            let kept = || vec![sheet.at(content, index).kept()];
            for target in rewrite.rows.entry(index).or_insert_with(kept) {
                target.side = content.rows[index].own.made.side.map(Side::reversed);
            }
        }
        Ok(())
    }

    fn transform_words(
        sheet: &Sheet<'_, Iso>,
        transform: Transform,
        rewrite: &mut Rewrite<Iso>,
    ) -> Result<(), String> {
        turned::turn_words(sheet, transform, rewrite)
    }

    fn scale_words(
        sheet: &Sheet<'_, Iso>,
        factor: f64,
        rewrite: &mut Rewrite<Iso>,
    ) -> Result<(), String> {
        rewrite.extra.words = positions(sheet.document, factor)?;
        planes::scale(sheet.document, factor, &mut rewrite.extra.words)
    }

    fn write(sheet: &Sheet<'_, Iso>, content: &Content<Iso>, rewrite: &Rewrite<Iso>) -> Edits {
        write::edits(sheet, content, rewrite)
    }

    fn agree(after: &Document, row: &Row<Iso>, meant: &Target) -> Result<(), String> {
        let made = &row.own.made;
        if (made.to, made.motion, made.side) != (meant.to, meant.motion, meant.side) {
            return Err(say!(the_new_line_leads_elsewhere).into());
        }
        match meant.bend {
            _ if meant.is_along(made, after.reading()) => Ok(()),
            Bent::Center(_) => Err(say!(the_arcs_would_not_tell_how_i_and_j_are_meant).into()),
            _ => Err(say!(the_new_line_leads_elsewhere).into()),
        }
    }

    fn own() -> Vec<Refactoring<Iso>> {
        vec![
            mode::ABSOLUTE,
            mode::INCREMENTAL,
            centers::START_TO_CENTER,
            centers::CENTER_TO_START,
            centers::ABSOLUTE,
        ]
    }
}

fn node_of([x, y]: Place) -> Node {
    Node { x, y }
}

fn place_of(node: Node) -> Place {
    [node.x, node.y]
}

/// True where a line only has its number and target, and can be removed.
fn says_only_where(document: &Document, line: usize) -> bool {
    let mut only = true;
    words_in(document.line_bytes(line), |token, _| {
        only &= match token {
            Token::Word { letter, number } => {
                matches!(letter, b'N' | b'X' | b'Y') || letter == b'G' && number.whole() == Some(1)
            }
            _ => false,
        }
    });
    only
}

/// The G41 and G42 of some lines, each exchanged for the other.
fn swapped_sides(document: &Document, lines: Range<usize>) -> Vec<TextEdit> {
    let text = document.text();
    let mut edits = Vec::new();
    for line in lines {
        words_at(text, line, |letter, number, range| {
            let other = match (letter, number.whole()) {
                (b'G', Some(41)) => Some("G42"),
                (b'G', Some(42)) => Some("G41"),
                _ => None,
            };
            edits.extend(other.map(|other| TextEdit::new(range, other)));
        });
    }
    edits
}

/// Whether a scaled arc of a given radius runs along the old one: near a half turn one step of R moves its middle by
/// many.
fn keeps_its_bow(at: At<'_, Iso>, [from, to]: [Place; 2], radius: i64, factor: f64) -> bool {
    let reading = at.sheet.document.reading();
    let made = Move {
        from,
        to,
        bend: Bend::Radius(radius),
        ..at.own.made
    };
    let middle = |made: &Move| made.segment(reading).point_at(0.5).coords;
    let aside = (middle(&made) - middle(&at.own.made) * factor).norm();
    let step = at.own.style.step() as f64 / MICROMETRE as f64;
    aside <= MIDDLE_TOLERANCE * step.max(1.0)
}

/// The centre in the program's steps that is most nearly as far from both ends.
fn fitting(ends: [Place; 2], center: Place, factor: f64, style: &Style) -> Option<Place> {
    let step = style.step();
    let scale = 1e3 / step as f64;
    let [from, to] = ends.map(|end| micrometres(end) * scale);
    let arc = Arc::about(micrometres(center) * factor * scale, from, to, true);
    let node = best_center(&arc, snap(from)?, snap(to)?);
    Some([node.x.checked_mul(step)?, node.y.checked_mul(step)?])
}

/// The position set by G92, scaled.
fn positions(document: &Document, factor: f64) -> Edits {
    let text = document.text();
    let mut edits = Vec::new();
    for line in 0..text.line_count() {
        let block = document.block(line);
        if block.takes_coordinates && block.has_coordinates() {
            return Err(say!(a_word_takes_the_coordinates, line + 1));
        }
        if !block.sets_position {
            continue;
        }
        let before = document.machine_before(line);
        let inch = before.is_some_and(|machine| machine.inch);
        let style = Style::of(document, inch);
        words_at(text, line, |letter, number, range| {
            if matches!(letter, b'X' | b'Y') {
                let length = document.reading().length(number, inch) as f64 * factor;
                let number = style.number(length.round() as i64);
                let word = format!("{}{number}", letter as char);
                edits.push(TextEdit::new(range, word));
            }
        });
    }
    Ok(edits)
}
