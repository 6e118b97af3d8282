//! The form of a block, and which of its parts the cursor is in.

use super::holds;
use crate::ide::Signature;
use crate::program::iso::block::{Block, Compensation, Motion, read_line};
use crate::program::iso::document::Document;
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::CenterRule;
use crate::program::iso::plain::words_in;
use crate::program::iso::word::{Token, WordFault};

/// The form of the block that is written at a byte; `None` where there is none.
pub(crate) fn signature(document: &Document, offset: usize) -> Option<Signature> {
    let text = document.text();
    let line = text.line_of(offset);
    let range = text.line_range(line);
    let bytes = text.bytes().get(range.clone())?;
    let cursor = offset.clamp(range.start, range.end) - range.start;
    let (letter, inside) = word_before(bytes, cursor)?;
    let block = read_line(bytes, 1, |_| {});
    let before = document.machine_before(line).unwrap_or_default();
    let label = label(bytes, &block, &before, letter)?;
    let incremental = block.incremental.unwrap_or(before.incremental);
    let rule = document.reading().rule(incremental);
    let about = |name: &'static str| (name, about(label, name, incremental, rule));
    let parameters: Vec<_> = label.split(' ').skip(1).map(about).collect();
    // After a word and a space the next word is meant; before the first word, the first.
    let letter = if letter == b'H' { b'D' } else { letter };
    let is_behind = !inside && bytes.get(cursor.wrapping_sub(1)) == Some(&b' ');
    let at = parameters
        .iter()
        .position(|(name, _)| name.as_bytes() == [letter]);
    let active = at.map_or(0, |at| at + usize::from(is_behind));
    Some(Signature {
        label,
        active: active.min(parameters.len() - 1),
        parameters,
    })
}

/// The letter of the last word that begins before the cursor, and whether the cursor is within it; `None` where nothing
/// has been written yet, and in a comment.
fn word_before(bytes: &[u8], cursor: usize) -> Option<(u8, bool)> {
    let (mut last, mut is_comment) = (None, false);
    words_in(bytes, |token, range| match token {
        _ if range.start >= cursor => {}
        Token::Word { letter, .. } | Token::Fault(WordFault::NoNumber { letter }) => {
            last = Some((letter, range.end >= cursor))
        }
        Token::Comment | Token::Fault(WordFault::OpenComment | WordFault::CommentedBlock) => {
            is_comment = range.end >= cursor
        }
        _ => {}
    });
    last.filter(|_| !is_comment)
}

/// The word that decides the kind of the block, and the letters that belong to it.
fn label(bytes: &[u8], block: &Block, before: &Machine, letter: u8) -> Option<&'static str> {
    let motion = block.motion.unwrap_or(before.motion);
    let is_of_motion = match letter {
        b'X' | b'Y' | b'I' | b'J' | b'R' => true,
        b'G' => block.motion.is_some(),
        _ => false,
    };
    Some(if block.sets_position {
        "G92 X Y"
    } else if block.call.is_some() || holds(bytes, b'M', 98) {
        "M98 P L"
    } else if block.takes_coordinates {
        holds(bytes, b'G', 4).then_some("G04 P")?
    } else if block.compensation.is_some() && matches!(letter, b'G' | b'D' | b'H') {
        match block.compensation {
            Some(Compensation::Left) => "G41 D",
            Some(Compensation::Right) => "G42 D",
            _ => return None,
        }
    } else if !is_of_motion {
        return None;
    } else {
        match (motion, block.r.is_some()) {
            (Motion::Clockwise, true) => "G02 X Y R",
            (Motion::Clockwise, false) => "G02 X Y I J",
            (Motion::CounterClockwise, true) => "G03 X Y R",
            (Motion::CounterClockwise, false) => "G03 X Y I J",
            (Motion::Rapid, _) => "G00 X Y",
            (Motion::Line, _) => "G01 X Y",
        }
    })
}

fn about(label: &str, name: &str, incremental: bool, rule: CenterRule) -> &'static str {
    match (name, rule) {
        ("X" | "Y", _) if label.starts_with("G92") => say!(where_the_wire_stands),
        ("X", _) if incremental => say!(how_far_along_x),
        ("Y", _) if incremental => say!(how_far_along_y),
        ("X" | "Y", _) => say!(where_to_from_the_zero),
        ("I", CenterRule::StartToCenter) => say!(from_the_start_to_the_centre_along_x),
        ("I", CenterRule::CenterToStart) => say!(from_the_centre_to_the_start_along_x),
        ("I", CenterRule::Absolute) => say!(x_of_the_centre),
        ("J", CenterRule::StartToCenter) => say!(from_the_start_to_the_centre_along_y),
        ("J", CenterRule::CenterToStart) => say!(from_the_centre_to_the_start_along_y),
        ("J", CenterRule::Absolute) => say!(y_of_the_centre),
        ("R", _) => say!(radius_with_its_sign),
        ("D", _) => say!(place_that_holds_the_correction),
        ("P", _) if label.starts_with("G04") => say!(how_long_some_controls_say_x),
        ("P", _) => say!(number_at_which_the_subprogram_begins),
        _ => say!(how_often_it_is_run),
    }
}
