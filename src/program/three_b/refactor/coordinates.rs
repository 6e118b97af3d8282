//! Write number and end of each block beside it, or leave the ends out.
//!
//! ```text
//! B9900B0B9900GXL1     ↔     N1 B9900B0B9900GXL1  ;      9.900 ,      0.000
//! ```

use super::Blocks;
use super::blocks::node;
use crate::finding::{Finding, Rule};
use crate::program::refactor::moves::Edits;
use crate::program::refactor::proof::same_way;
use crate::program::refactor::sheet::Sheet;
use crate::program::three_b::Document;
use crate::program::three_b::layout::{push_end_point, push_to_comment_column};
use crate::program::three_b::pieces::Field;
use crate::text::TextEdit;

/// The blocks that state no end get theirs, and those without a number theirs where all other numbers count the blocks.
pub(in crate::program) fn with_ends(program: &Document, sheet: &Sheet<'_>) -> Edits {
    let text = program.text();
    let steps = || sheet.trace.steps.iter().filter(|step| step.moves());
    let mut numbers = steps().map(|step| step.number).zip(1..);
    let is_counted = numbers.all(|(own, number)| own.is_none_or(|own| own == number));
    let mut edits = Vec::new();
    let blocks = Blocks::of(program, &sheet.trace)?.all.into_iter();
    for (((own, step), made), number) in blocks.zip(steps()).zip(&sheet.moves).zip(1..) {
        if own.states_end {
            continue;
        }
        if is_counted && step.number.is_none() {
            edits.push(program.with_number(None, own.range.start, number));
        }
        let mut end = Vec::new();
        push_to_comment_column(&mut end, &own.block);
        push_end_point(&mut end, node(made.to));
        let (line, start) = (text.line(step.line), text.line_start(step.line));
        let behind = line.get(own.range.end - start..).unwrap_or_default();
        // A remark without its mark would belong to the coordinates.
        if !matches!(behind.trim_ascii(), [] | [b';', ..]) {
            end.extend_from_slice(b" ;");
        }
        let end = String::from_utf8_lossy(&end);
        edits.push(TextEdit::new(own.range.end..own.range.end, end));
    }
    trusted(program, sheet, edits)
}

pub(in crate::program) fn without_ends(program: &Document, sheet: &Sheet<'_>) -> Edits {
    let blocks = Blocks::of(program, &sheet.trace)?;
    let end = |own| Some((own, blocks.beside(own, Field::Coordinates)?));
    let ends = blocks.all.iter().filter_map(end);
    let edits = ends.map(|(own, end)| TextEdit::new(own.range.end..end.end, ""));
    trusted(program, sheet, edits.collect())
}

/// The edits, where no block is known to be wrong: an end point would be wrong with it, or tells of it.
fn trusted(program: &Document, sheet: &Sheet<'_>, edits: Vec<TextEdit>) -> Edits {
    if edits.is_empty() {
        return Ok(edits);
    }
    let findings = program.findings();
    if let Some(finding) = findings.iter().find(|finding| tells_of_wrong_ends(finding)) {
        let place = finding.place.in_text();
        let line = place.map_or(0, |range| program.text().line_of(range.start));
        let rule = finding.rule.name();
        return Err(say!(end_points_cannot_be_trusted, rule, line + 1));
    }
    same_way(sheet.document, sheet.settings, edits)
}

/// True for rules by which the numbers of a block are wrong, and with them its end.
fn tells_of_wrong_ends(finding: &Finding) -> bool {
    matches!(
        finding.rule,
        Rule::WrongQuadrant
            | Rule::WrongJ
            | Rule::WrongCountingAxis
            | Rule::LengthInJ
            | Rule::JOverTurn
            | Rule::ArcOffRadius
            | Rule::ArcWithoutRadius
            | Rule::ReversedArc
            | Rule::SuspectBlock
            | Rule::DoubledBlock
            | Rule::PositionMismatch
    )
}

#[cfg(test)]
mod tests {
    use crate::program::Language::ThreeB;
    use crate::program::refactor::tests::{check, refused};

    #[test]
    fn the_ends_of_blocks_are_written_after_them_and_left_out() {
        let text = "b9900b0b9900gxl1 way in\nN2 B9900B0B39600GYNR1\nB9900B0B9900GXL3 ; out\nDD\n";
        let ends = [
            "b9900b0b9900gxl1  ;      9.900 ,      0.000 ; way in\n",
            "B9900B0B39600GYNR1 ;      9.900 ,      0.000\n",
            "B9900B0B9900GXL3  ;      0.000 ,      0.000 ; out\n",
        ];
        let [first, second, third] = ends;
        let stated = format!("N1 {first}N2 {second}N3 {third}DD\n");
        check(ThreeB, "coordinates.insert", text, &stated);
        check(ThreeB, "coordinates.insert", &stated, &stated);
        let plain =
            "N1 b9900b0b9900gxl1 ; way in\nN2 B9900B0B39600GYNR1\nN3 B9900B0B9900GXL3 ; out\nDD\n";
        check(ThreeB, "coordinates.remove", &stated, plain);
        // Numbers that count something else stay alone.
        let text = text.replace("N2", "N7");
        check(
            ThreeB,
            "coordinates.insert",
            &text,
            &format!("{first}N7 {second}{third}DD\n"),
        );
        let wrong = "; Start Point = 0 , 0\nB10000B0B10000GXL1 ; 10.000 , 0.000\nB0B10300B10300GYL2 ; 10.000 , 10.000\nB10000B0B10000GXL3 ; 0.000 , 10.000\nB0B10000B10000GYL4\nDD\n";
        let reason = "in line 3 is repaired";
        refused(ThreeB, "coordinates.insert", wrong, reason);
        refused(ThreeB, "coordinates.remove", wrong, reason);
    }
}
