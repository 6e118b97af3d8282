//! Repairs of a program in any language: filling a gap, finding the slip that explains the faults, offering repairs,
//! and choosing those to be made.

mod beside;
pub(super) mod cut;
pub(super) mod gap;
pub(super) mod keys;
pub(super) mod rule;
pub(super) mod searches;
pub(super) mod slip;
mod weigh;

use crate::finding::{FixKind, TextFix};
use crate::geometry::Segment;
use crate::program::path::{FEWEST_CROSSING, crossings_of};
use crate::text::{SourceText, TextEdit};

/// The most repairs that are returned.
const HANDED_OUT: usize = 4;

/// The most pieces that one search reads to find out whether its changes cross themselves: of a way that lies on itself again and again,
/// each change would take as many. Other ways take a few for each place where they come near themselves.
const MOST_FOLLOWED: usize = 200_000;

/// Whether a way crosses itself; `None` where more than the pieces `left` would be read to find out. What is read is
/// taken from them.
pub(super) fn crosses_itself(pieces: &[Segment], arcs: usize, left: &mut usize) -> Option<bool> {
    // Of so few nothing is reported.
    if pieces.len() < FEWEST_CROSSING {
        return Some(false);
    }
    if *left == 0 {
        return None;
    }
    let crosses = !crossings_of(pieces, arcs, left).is_empty();
    (crosses || *left > 0).then_some(crosses)
}

/// Turns repairs found by trying into offers: the best one first, which is preferred, and made by "fix all", where it is
/// sure. Those that cannot be written are left out.
pub(super) fn offered(
    found: impl Iterator<Item = Option<(FixKind, Vec<TextEdit>, bool)>>,
) -> Vec<TextFix> {
    let fix = |(nth, repair): (usize, Option<_>)| {
        let (kind, edits, is_sure) = repair?;
        Some(TextFix::text(kind, is_sure, edits).preferred_if(nth == 0 && is_sure))
    };
    found.enumerate().filter_map(fix).collect()
}

/// The fix of a spur, whose way out and way back stand in two lines, each with what is shown of it: both go.
pub(super) fn without_spur(text: &SourceText, lines: [(usize, String); 2]) -> TextFix {
    let edits = lines
        .each_ref()
        .map(|(line, _)| TextEdit::new(text.whole_line(*line), ""));
    let kind = FixKind::Rewrite {
        found: lines.map(|(_, shown)| shown).join(say!(and)),
        meant: String::new(),
    };
    TextFix::text(kind, false, edits.to_vec())
}

/// Merges those that take precedence with the others of one finding. Of two equal edits one stays, under the other's
/// name where that `names` it better.
pub(super) fn merged(mut fixes: Vec<TextFix>, more: Vec<TextFix>, names: bool) -> Vec<TextFix> {
    if fixes.is_empty() {
        return more;
    }
    let first = fixes.len();
    for fix in more {
        match fixes[..first]
            .iter_mut()
            .find(|known| known.edit == fix.edit)
        {
            Some(known) if names => known.kind = fix.kind,
            Some(_) => {}
            None => fixes.push(TextFix {
                preferred: false,
                in_fix_all: false,
                ..fix
            }),
        }
    }
    fixes
}
