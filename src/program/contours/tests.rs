//! Edits of programs with many stops, in every language, leave what is known of them as read from scratch.

use crate::program::{Document, Language};
use crate::settings::Effective;
use proptest::prelude::*;
use std::fmt::Write as _;

/// A step of the wire, mm, or a stop.
type Step = Option<[i32; 2]>;

/// How a die opening is cut from its thread hole on: its kind, its passes and its size, mm.
type Opening = (u8, usize, i32);

fn opening() -> impl Strategy<Value = Opening> {
    (0_u8..12, 1_usize..4, 8_i32..14)
}

/// Its path from the origin on: passes to and fro up to the tab, a stop, and the cuts after it.
fn way(&(kind, passes, size): &Opening) -> Vec<Step> {
    let pass = [[2, 0], [size, 0], [size, size], [2, size], [2, 3]];
    let mut way: Vec<Step> = pass.iter().copied().map(Some).collect();
    for nth in 1..passes {
        let mut own = pass.to_vec();
        if nth % 2 == 1 {
            own.reverse();
        }
        if kind == 1 {
            way.push(None);
        }
        way.extend(own.into_iter().skip(1).map(Some));
    }
    let ends_at_tab = passes % 2 == 1;
    let tab: &[Step] = match kind {
        // The tab is left standing, or cut wrong; the machine stops twice; several stops hold the part.
        2 => &[],
        3 => &[None, Some([5, 5])],
        4 => &[None, None, Some([2, 0]), Some([0, 0])],
        5 => &[None, Some([2, 2]), None, Some([2, 0]), Some([0, 0])],
        // A way to elsewhere, and one contour without a stop.
        6 => &[None, Some([30, 0]), None],
        7 => &[Some([2, 0]), Some([0, 0])],
        8 => &[None, Some([2, 0]), Some([-9, size]), Some([0, 0])],
        _ => &[None, Some([2, 0]), Some([0, 0])],
    };
    way.extend(tab.iter().filter(|_| ends_at_tab || kind != 7));
    way
}

/// Openings beside each other, each with the way to the next, as a program.
fn program(language: Language, openings: &[Opening], is_relative: bool) -> String {
    let mut text = match (language, is_relative) {
        (Language::ThreeB, _) => String::new(),
        (Language::Iso, true) => "G92 X0. Y0.\nG91\n".to_owned(),
        (Language::Iso, false) => "G92 X0. Y0.\nG90\n".to_owned(),
    };
    let mut at = [0, 0];
    for (nth, own) in openings.iter().enumerate() {
        let begin = 40 * nth as i32;
        let to_here = [None, Some([0, 0]), None];
        for (index, step) in to_here.into_iter().chain(way(own)).enumerate() {
            let Some([x, y]) = step else {
                text += if language == Language::Iso {
                    "M00\n"
                } else {
                    "D\n"
                };
                continue;
            };
            let to = [begin + x, y];
            let [dx, dy] = [to[0] - at[0], to[1] - at[1]];
            at = to;
            match language {
                Language::ThreeB => {
                    let quadrant = match (dx, dy) {
                        (1.., 0..) => 1,
                        (..=0, 1..) => 2,
                        (..0, ..=0) => 3,
                        _ => 4,
                    };
                    let [dx, dy] = [dx.abs() * 1000, dy.abs() * 1000];
                    let axis = if dx > dy { 'X' } else { 'Y' };
                    let _ = writeln!(text, "B{dx}B{dy}B{}G{axis}L{quadrant}", dx.max(dy));
                }
                Language::Iso => {
                    let word = if index == 1 { "G00" } else { "G01" };
                    let [x, y] = if is_relative { [dx, dy] } else { to };
                    let _ = writeln!(text, "{word} X{x}. Y{y}.");
                }
            }
        }
    }
    text + if language == Language::Iso {
        "M02\n"
    } else {
        "DD\n"
    }
}

fn told(document: &Document) -> Vec<String> {
    let (findings, _) = document.findings(&Effective::default(), usize::MAX);
    let mut told: Vec<String> = findings.iter().map(|one| format!("{one:?}")).collect();
    told.sort();
    told
}

fn assert_as_afresh(document: &Document) -> Result<(), TestCaseError> {
    let text = document.text().bytes().to_vec();
    let fresh = Document::read(document.language(), text, &Effective::default());
    prop_assert_eq!(told(document), told(&fresh));
    let (all, count) = document.findings(&Effective::default(), usize::MAX);
    for limit in [0, 1, 2, 7] {
        let some = all[..limit.min(count)].to_vec();
        prop_assert_eq!(
            document.findings(&Effective::default(), limit),
            (some, count)
        );
    }
    prop_assert_eq!(document.trace(), fresh.trace());
    let all = 0..document.text().len();
    prop_assert_eq!(document.steps_in(all.clone()), fresh.steps_in(all));
    Ok(())
}

/// Puts one of the `words` in the place of a few characters again and again: where, how many, and which.
fn assert_edited_as_afresh(
    language: Language,
    text: String,
    words: &[&str],
    edits: &[(f64, usize, prop::sample::Index)],
) -> Result<(), TestCaseError> {
    let mut document = Document::read(language, text.into_bytes(), &Effective::default());
    for (place, length, word) in edits {
        let mut start = (document.text().len() as f64 * place) as usize;
        if *length == 0 {
            start = document.text().line_start(document.text().line_of(start));
        }
        document.edit(start..start + length, words[word.index(words.len())]);
        assert_as_afresh(&document)?;
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn an_edit_among_stops_leaves_contours_as_read_afresh(
        openings in prop::collection::vec(opening(), 1..16),
        language in prop::sample::select(Language::ALL.to_vec()),
        is_relative in any::<bool>(),
        edits in prop::collection::vec((0.0..1.0, 0_usize..3, any::<prop::sample::Index>()), 1..5),
    ) {
        let words = match language {
            Language::ThreeB => ["", "7", "1", "\n", "D\n", "DD\n", "B2000B0B2000GXL3\n", "x"],
            Language::Iso => ["", "7", "1", "\n", "M00\n", "M02\n", "G00 X3. Y0.\n", "G91\n"],
        };
        let text = program(language, &openings, is_relative);
        assert_edited_as_afresh(language, text, &words, &edits)?;
    }

    #[test]
    fn a_character_that_comes_and_goes_leaves_contours_as_they_were(
        openings in prop::collection::vec(opening(), 1..16),
        language in prop::sample::select(Language::ALL.to_vec()),
        is_relative in any::<bool>(),
        place in 0.0..1.0,
        word in prop::sample::select(vec!["1", "x", "\n"]),
    ) {
        let text = program(language, &openings, is_relative);
        let mut document = Document::read(language, text.into_bytes(), &Effective::default());
        let before = told(&document);
        let at = (document.text().len() as f64 * place) as usize;
        document.edit(at..at, word);
        assert_as_afresh(&document)?;
        document.edit(at..at + 1, "");
        assert_as_afresh(&document)?;
        prop_assert_eq!(told(&document), before);
    }
}

/// Small contours that stay open, a few of them crossing themselves, each with the way to the next; some are numbered, and
/// some share a line.
fn open_contours(language: Language, contours: &[(u8, i32)], is_numbered: bool) -> String {
    let openings = contours.iter().map(|(kind, size)| match kind {
        0 => vec![[2, 0], [*size, 0], [*size, 7], [3, 7], [3, 1]],
        1 => vec![[2, 0], [*size, 0], [*size, 7], [2, 7], [2, 1]],
        2 => vec![[2, 0], [*size, 0], [*size, 7], [4, -7], [1, -7], [1, -3]],
        3 => vec![[2, 0], [*size, 0]],
        _ => vec![[2, 0], [*size, 0], [*size, 7], [2, 7], [2, 0], [0, 0]],
    });
    let (mut text, mut at) = (String::new(), [0, 0]);
    let mut number = 0;
    for (nth, own) in openings.enumerate() {
        let begin = 40 * nth as i32;
        for (index, [x, y]) in [[0, 0]].into_iter().chain(own).enumerate() {
            let to = [begin + x, y];
            let [dx, dy] = [to[0] - at[0], to[1] - at[1]];
            at = to;
            number += 1;
            if is_numbered && nth % 3 != 1 {
                let _ = write!(text, "N{number} ");
            }
            let stop = match language {
                Language::ThreeB => {
                    let quadrant = match (dx, dy) {
                        (1.., 0..) => 1,
                        (..=0, 1..) => 2,
                        (..0, ..=0) => 3,
                        _ => 4,
                    };
                    let [dx, dy] = [dx.abs() * 1000, dy.abs() * 1000];
                    let axis = if dx > dy { 'X' } else { 'Y' };
                    let _ = write!(text, "B{dx}B{dy}B{}G{axis}L{quadrant}", dx.max(dy));
                    "D\n"
                }
                Language::Iso => {
                    let word = if index == 0 { "G00" } else { "G01" };
                    let [x, y] = to;
                    let _ = write!(text, "{word} X{x}. Y{y}.");
                    "M00\n"
                }
            };
            text.push('\n');
            if index == 0 {
                text += stop;
            }
        }
        text += if language == Language::Iso {
            "M00\n"
        } else {
            "D\n"
        };
    }
    text + if language == Language::Iso {
        "M02\n"
    } else {
        "DD\n"
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn an_edit_among_open_contours_leaves_what_is_said_of_them_as_read_afresh(
        contours in prop::collection::vec((0_u8..6, 5_i32..14), 1..60),
        language in prop::sample::select(Language::ALL.to_vec()),
        is_numbered in any::<bool>(),
        edits in prop::collection::vec((0.0..1.0, 0_usize..3, any::<prop::sample::Index>()), 1..5),
    ) {
        let words = match language {
            Language::ThreeB => ["", "7", "N3 ", "\n", "D\n", "DD\n", "B2000B0B2000GXL3\n", "x", "; 2.000 , 1.000"],
            Language::Iso => ["", "7", "N3 ", "\n", "M00\n", "M02\n", "G00 X3. Y0.\n", "G91\n", "G41 D1 "],
        };
        let text = open_contours(language, &contours, is_numbered);
        assert_edited_as_afresh(language, text, &words, &edits)?;
    }
}
