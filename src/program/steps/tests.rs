//! Answers about a part of a program equal those of the whole trace, for programs of both languages under edits.

use super::way_before;
use crate::program::path::{Cut, Kind, Step, Trace, Way, cuts};
use crate::program::whereabouts::Stand;
use crate::program::{Document, Language};
use crate::settings::Effective;
use proptest::prelude::*;
use std::ops::Range;

/// The cut about a byte out of the whole trace: its steps without those of stops, the number of the touched one, and the stop within.
fn cut_by_trace(trace: &Trace, offset: usize) -> Option<(Vec<Step>, usize, Option<usize>)> {
    let touches =
        |step: &Step| step.moves() && step.range.start <= offset && offset <= step.range.end;
    let touched = trace.steps.iter().rposition(touches)?;
    let own = &trace.steps[touched];
    let is_same = |step: &Step| {
        step.moves()
            && step.contour == own.contour
            && (step.kind == Kind::Rapid) == (own.kind == Kind::Rapid)
    };
    let is_over = |step: &&Step| !is_same(step) && step.kind != Kind::Pause;
    let before = trace.steps[..touched]
        .iter()
        .rposition(|step| is_over(&step));
    let behind = trace.steps[touched..]
        .iter()
        .position(|step| is_over(&step));
    let all = before.map_or(0, |before| before + 1)
        ..behind.map_or(trace.steps.len(), |behind| touched + behind);
    let first = all.clone().find(|index| is_same(&trace.steps[*index]))?;
    let last = all.rev().find(|index| is_same(&trace.steps[*index]))?;
    let moves = |steps: Range<usize>| {
        let own = trace.steps[steps].iter();
        own.filter(|step| step.moves()).cloned().collect::<Vec<_>>()
    };
    let stop = (first..=last).find(|index| !trace.steps[*index].moves());
    Some((
        moves(first..last + 1),
        moves(first..touched).len(),
        stop.map(|stop| moves(first..stop).len()),
    ))
}

/// All answers about parts of a program, at some of its bytes.
fn assert_parts_are_of_the_whole(document: &Document) -> Result<(), TestCaseError> {
    let trace = document.trace();
    let (text, writing) = (document.text(), trace.writing);
    let all = cuts(&trace);
    prop_assert_eq!(document.program().begin().0, trace.start);
    let first = trace.steps.iter().find(|step| step.moves());
    prop_assert_eq!(document.first_move(), first.map(|step| step.range.clone()));
    let (unread, mut whereabouts) = (document.program().unread_line(), document.whereabouts());
    let mut seen = 0;
    for step in &trace.steps {
        // Two moves of one line begin where the first does.
        let is_known = step.range.start >= seen && unread.is_none_or(|unread| step.line <= unread);
        seen = seen.max(step.range.end);
        let stands = whereabouts.of(&step.range).map(|stand| stand.start);
        let begins = is_known.then(|| step.start / 1e3);
        if unread.is_some_and(|unread| step.line > unread) {
            prop_assert_eq!(stands, None);
        } else if is_known {
            prop_assert_eq!(stands, begins);
        }
    }
    // Where nothing moves, it stands as the step before has left it, wherever its cut begins.
    let in_order = trace.steps.is_sorted_by_key(|step| step.range.start);
    if !trace.steps.is_empty() && in_order {
        for line in 0..=unread.unwrap_or(text.line_count() - 1) {
            let range = text.line_range(line);
            let program = document.program();
            if program.cuts_at(line).is_empty() || trace.steps.iter().any(|step| step.line == line)
            {
                continue;
            }
            let before = trace.steps.partition_point(|step| step.line < line);
            let left = match before.checked_sub(1) {
                Some(before) => trace.steps[before].end,
                None => trace.start,
            };
            let stands = whereabouts.of(&range);
            prop_assert_eq!(
                stands,
                Some(Stand {
                    start: left / 1e3,
                    end: None
                }),
                "line {}",
                line
            );
        }
    }
    for offset in (0..=text.len()).step_by(1 + text.len() / 29) {
        let range = offset..(offset + 200).min(text.len());
        let touches = |step: &&Step| step.range.start <= range.end && range.start <= step.range.end;
        let within: Vec<Step> = trace.steps.iter().filter(touches).cloned().collect();
        prop_assert_eq!(document.steps_in(range.clone()), within);
        let stop = trace
            .steps
            .iter()
            .find(|step| !step.moves() && step.range.start > offset);
        prop_assert_eq!(
            document.stop_behind(offset),
            stop.map(|step| step.range.clone())
        );
        let whole = cut_by_trace(&trace, offset);
        let found = document.cut_at(offset);
        let whole = whole.map(|(steps, nth, _)| (steps, nth));
        let own = found.as_ref().map(|found| (found.steps.clone(), found.nth));
        prop_assert_eq!(own, whole.clone());
        if let (Some(found), Some((steps, index))) = (found, whole) {
            let touched = trace
                .steps
                .iter()
                .rposition(|step| Some(step) == steps.get(index));
            let whole = all
                .iter()
                .find(|cut| touched.is_some_and(|at| cut.steps.contains(&at)));
            let moves = |steps: Range<usize>| {
                let own = trace.steps[steps].iter();
                own.filter(|step| step.moves()).count()
            };
            let whole = whole.map(|whole| {
                let (steps, own) = (whole.steps.clone(), whole.contour_steps());
                Cut {
                    steps: 0..moves(steps.clone()),
                    lead_in: moves(steps.start..own.start),
                    lead_out: moves(own.end..steps.end),
                    ..whole.clone()
                }
            });
            prop_assert_eq!(Some(found.cut), whole);
        }
        let last = trace.steps.iter().rfind(|step| step.range.end <= offset);
        // Behind a rapid nothing is cut yet.
        let last = last.filter(|step| matches!(step.kind, Kind::Line | Kind::Arc));
        let before = last.and_then(|step| cut_by_trace(&trace, step.range.start));
        let own = before.map(|(steps, nth, stop)| match stop {
            Some(stop) if stop <= nth => steps[stop..=nth].to_vec(),
            _ => steps[..=nth].to_vec(),
        });
        // Where lines run again in another order, several cuts are before a place.
        if in_order {
            let way = Way::of_steps(&own.unwrap_or_default(), writing);
            let held = way_before(document.program(), offset);
            prop_assert_eq!(held.pieces(), way.pieces());
        }
    }
    Ok(())
}

/// A contour with ways in and out; `{n}` is how often its sides go to and fro.
const THREE_B: [&str; 7] = [
    "B9000B0B9000GXL1\nB0B9000B9000GYL2\nB9000B0B9000GXL3\nB0B9000B9000GYL4\n",
    "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\n",
    "B900B0B900GXL1\nB900B900B900GYL1\nB900B0B900GXL3\n",
    "B500B0B500GXL1\n",
    "D\n",
    "BxB\n",
    "DD\n",
];

const ISO: [&str; 10] = [
    "G01 X5\nG01 Y5\nG01 X-5\nG01 Y-5\n",
    "G01 X1\nG02 X2 Y2 I2\nG01 X-3 Y-2\n",
    "G01 X2\nG01 X1 Y1\n",
    "G01 X0\n",
    "G03 X1 Y1 R0.1\n",
    "G00 X3 Y1\n",
    "M00\n",
    "G01 Xx\n",
    "G01 X3 R1\nG01 Y3\n",
    "M02\n",
];

fn text(pieces: &[&'static str]) -> impl Strategy<Value = String> + use<> {
    let usual = pieces[..4].to_vec();
    let all = pieces.to_vec();
    let piece = prop_oneof![
        4 => (prop::sample::select(usual), 1_usize..60).prop_map(|(piece, times)| piece.repeat(times)),
        3 => prop::sample::select(all).prop_map(str::to_owned),
    ];
    prop::collection::vec(piece, 1..12).prop_map(|pieces| pieces.concat())
}

type Edits = Vec<(usize, usize, &'static str)>;

fn check(language: Language, text: String, edits: Edits) -> Result<(), TestCaseError> {
    let mut document = Document::read(language, text.into_bytes(), &Effective::default());
    assert_parts_are_of_the_whole(&document)?;
    for (start, length, replacement) in edits {
        let start = start % (document.text().len() + 1);
        document.edit(start..start + length, replacement);
    }
    assert_parts_are_of_the_whole(&document)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn parts_of_a_3b_program_are_those_of_the_whole(
        text in text(&THREE_B),
        edits in prop::collection::vec((any::<usize>(), 0_usize..80, prop::sample::select(vec!["", "7", "\n", "D\n", "B1B1B1GXL1\n"])), 0..4),
    ) {
        check(Language::ThreeB, text, edits)?;
    }

    #[test]
    fn parts_of_an_iso_program_are_those_of_the_whole(
        text in text(&ISO),
        is_incremental in prop::bool::weighted(0.8),
        with_calls in prop::bool::weighted(0.1),
        edits in prop::collection::vec((any::<usize>(), 0_usize..80, prop::sample::select(vec!["", "7", "\n", "M00\n", "G00 X1\n", "G01 X1\n", "G90\n"])), 0..4),
    ) {
        let begin = if is_incremental { "G91\n" } else { "" };
        let end = if with_calls { "M98 P5 L3\nM02\nN5 G01 X1\nG01 Y1\nM00\nM99\n" } else { "M02\n" };
        check(Language::Iso, format!("{begin}{text}{end}"), edits)?;
    }
}
