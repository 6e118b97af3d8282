//! The frame of an MTEXT: before release 2018 a polyline of its own, which the text names in its extended data.

use super::entity::Outcome;
use super::lines::Lines;
use super::number::{self, Code};
use rustc_hash::FxHashSet;
use std::ops::Range;

/// The strings (group code 1000) that enclose the handles of the frame in extended data, as AutoCAD and BricsCAD write
/// them.
const BEGIN: &[u8] = b"ACAD_MTEXT_TEXT_BORDERS_BEGIN";
const END: &[u8] = b"ACAD_MTEXT_TEXT_BORDERS_END";

/// The handles of the entities that form the frame of the text whose record is `lines_of`.
pub(super) fn handles(lines: Lines, lines_of: Range<usize>) -> Vec<u64> {
    let (mut handles, mut is_frame) = (Vec::new(), false);
    for line in lines_of.step_by(2).filter(|line| line + 1 < lines.count()) {
        let value = lines.trimmed(line + 1);
        match number::code(lines.content(line)) {
            Code::Known(1000) => is_frame = value == BEGIN || (is_frame && value != END),
            Code::Known(1001) => is_frame = false,
            Code::Known(1005) if is_frame => handles.extend(number_of(value)),
            _ => {}
        }
    }
    handles
}

/// True where the lines hold extended data of a frame.
pub(super) fn is_named_in(lines: Lines, mut range: Range<usize>) -> bool {
    range.any(|line| line < lines.count() && lines.trimmed(line) == BEGIN)
}

fn number_of(handle: &[u8]) -> Option<u64> {
    u64::from_str_radix(std::str::from_utf8(handle).ok()?, 16).ok()
}

/// The entity, without geometry to cut where it is the frame of a text.
pub(super) fn without_frames(outcome: Outcome, frames: &FxHashSet<u64>) -> Outcome {
    match outcome {
        Outcome::Entity(read)
            if !frames.is_empty()
                && read
                    .handle
                    .as_ref()
                    .and_then(|(handle, _)| number_of(handle.as_bytes()))
                    .is_some_and(|handle| frames.contains(&handle)) =>
        {
            Outcome::Unsupported(read.kind.name().into(), say!(it_is_the_frame_of_a_text))
        }
        other => other,
    }
}
