//! Words that give the upper guide another path than the lower one. Their meaning depends on the order, the direction
//! and the mode of the moves of X and Y: refactorings that would change it refuse such a program.

use super::tilt::{Upper, upper_words};
use crate::program::iso::document::Document;
use std::ops::Range;

/// The kinds of such words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) enum Words {
    /// Those that position the upper guide: U, V, a second contour after a colon.
    Guide,
    /// Those and the ones that tilt the wire: G51, G52, G140 to G142, TP, TN.
    All,
}

/// An error where one of the words stands in some lines.
pub(in crate::program) fn refuse(
    document: &Document,
    mut lines: Range<usize>,
    wanted: Words,
) -> Result<(), String> {
    match lines.find_map(|line| reason(document, line, wanted).map(|reason| (line, reason))) {
        Some((line, reason)) => Err(say!(line_by_number, line + 1, reason)),
        None => Ok(()),
    }
}

/// An error where one of the words stands anywhere.
pub(in crate::program) fn refuse_anywhere(
    document: &Document,
    wanted: Words,
) -> Result<(), String> {
    refuse(document, 0..document.text().line_count(), wanted)
}

/// An error where the wire leans by an angle from a line before this one on.
pub(in crate::program) fn refuse_where_it_leans(
    document: &Document,
    line: usize,
) -> Result<(), String> {
    let mut leans = None;
    for before in 0..line {
        upper_words(document.line_bytes(before), |upper, _| {
            if let Upper::Lean { to, .. } = upper {
                leans = to.map(|_| before);
            }
        });
    }
    match leans {
        Some(line) => {
            let reason = say!(the_upper_profile_would_begin_beside_a_corner);
            Err(say!(line_by_number, line + 1, reason))
        }
        None => Ok(()),
    }
}

/// Why the first such word of a line is refused.
fn reason(document: &Document, line: usize, wanted: Words) -> Option<&'static str> {
    let line = document.line_bytes(line);
    let mut found = None;
    upper_words(line, |upper, range| {
        let is_place = |byte: &u8| matches!(byte.to_ascii_uppercase(), b'X' | b'Y');
        let leads = || line.get(range).is_some_and(|own| own.iter().any(is_place));
        let reason = match upper {
            Upper::Guide(..) => say!(the_way_of_the_upper_guide_would_not_be_kept),
            Upper::Second if leads() => {
                say!(the_second_contour_behind_the_colon_would_not_be_kept)
            }
            // G50 ends a taper, and is none by itself.
            Upper::Lean { code, .. } if wanted == Words::All && code != 50 => {
                say!(a_taper_would_not_be_kept)
            }
            Upper::Plane(_, Some(_)) if wanted == Words::All => {
                say!(the_planes_of_a_taper_would_not_be_kept)
            }
            _ => return,
        };
        found = found.or(Some(reason));
    });
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_are_found_where_the_control_reads_them() {
        for (line, guide, all) in [
            ("G01 X5. U1.", true, true),
            ("g01x5.v-1.", true, true),
            // The semicolon that ends the line ends a word before it, too.
            ("G01 X5.; U1.;", true, true),
            ("D1; G51 A3.;", false, true),
            // A block of its own is not read, and a finding says so.
            ("G01 X5.; G51 A3.;", false, false),
            ("G01 X5. : G01 X6. Y1.", true, true),
            ("G52 T2.", false, true),
            ("G140", false, true),
            ("TP0.0 TN20.0", false, true),
            ("G50", false, false),
            ("T84", false, false),
            (":0100", false, false),
            ("G01 X5. ; U1.", false, false),
            ("(U1. G51) G01 X5.", false, false),
        ] {
            let document = Document::read(format!("G92 X0 Y0\n{line}\nM02\n").into_bytes());
            for (wanted, expected) in [(Words::Guide, guide), (Words::All, all)] {
                let refused = refuse_anywhere(&document, wanted).is_err();
                assert_eq!(refused, expected, "{line}: {wanted:?}");
            }
        }
    }
}
