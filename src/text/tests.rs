use super::*;
use proptest::prelude::*;

#[test]
fn all_three_line_ends_end_a_line() {
    let text = SourceText::new(b"a\nbb\r\nc\rd\r\r\n".to_vec());
    let lines: Vec<_> = (0..text.line_count())
        .map(|line| &text.bytes()[text.line_range(line)])
        .collect();
    assert_eq!(lines, [&b"a"[..], b"bb", b"c", b"d", b"", b""]);
    assert_eq!(text.line_of(4), 1);
    assert_eq!(text.line_of(99), 5);
    assert_eq!(text.line_range(99), 12..12);
}

#[test]
fn positions_are_counted_in_the_clients_units_and_clamped() {
    let text = SourceText::new(
        "é𝄞x\r\nб"
            .as_bytes()
            .iter()
            .copied()
            .chain([0xff, b'y'])
            .collect(),
    );
    let cases = [
        (0, 0, 0, 0),
        (0, 1, 2, 0),
        (0, 2, 2, 2),
        (0, 3, 6, 2),
        (0, 4, 7, 2),
        (0, 5, 7, 2),
        (0, 6, 7, 6),
        (0, 99, 7, 7),
        (1, 1, 11, 9),
        (1, 2, 12, 11),
        (1, 3, 13, 12),
        (1, 99, 13, 13),
        (7, 0, 13, 13),
    ];
    for (line, character, utf16, utf8) in cases {
        assert_eq!(
            text.offset_of(line, character, Encoding::Utf16),
            utf16,
            "{line}:{character} in UTF-16"
        );
        assert_eq!(
            text.offset_of(line, character, Encoding::Utf8),
            utf8,
            "{line}:{character} in UTF-8"
        );
    }
    assert_eq!(text.position_of(4, Encoding::Utf16), (0, 1));
    assert_eq!(text.position_of(8, Encoding::Utf16), (0, 4));
    assert_eq!(text.position_of(12, Encoding::Utf16), (1, 2));
    assert_eq!(text.position_of(99, Encoding::Utf8), (1, 4));
}

proptest! {
    #[test]
    fn replaced_text_has_the_lines_of_a_fresh_one(
        start in "[ab\r\n]{0,20}",
        edits in prop::collection::vec((0usize..24, 0usize..6, "[x\r\n]{0,5}"), 1..8),
    ) {
        let mut text = SourceText::new(start.into_bytes());
        let (mut apart, mut shared) = (text.clone(), Vec::new());
        for (at, length, replacement) in edits {
            text.replace(at..at + length, &replacement);
            prop_assert_eq!(&text, &SourceText::new(text.bytes().to_vec()));
            apart.replace_here(at..at + length, &replacement);
            let (before, behind) = apart.pieces();
            prop_assert_eq!([before, behind].concat(), text.bytes());
            prop_assert!(behind.is_empty() || apart.begins_line(before.len()), "{:?}", apart.pieces());
            prop_assert_eq!(apart.line_starts(), text.line_starts());
            for place in 0..=text.len() {
                prop_assert_eq!(apart.line_end_before(place), text.line_end_before(place));
                for encoding in [Encoding::Utf8, Encoding::Utf16] {
                    prop_assert_eq!(apart.position_of(place, encoding), text.position_of(place, encoding));
                }
                for end in place..=text.len() {
                    prop_assert_eq!(apart.slice(place..end), Some(&text.bytes()[place..end]));
                }
            }
            prop_assert_eq!(&apart, &text);
            // A clone keeps the text as it was.
            shared.push((apart.clone(), text.clone()));
            if at % 5 == 0 {
                apart.join();
            }
        }
        for (apart, text) in shared {
            prop_assert_eq!(apart.into_bytes(), text.into_bytes());
        }
    }

    #[test]
    fn every_position_comes_back(bytes in prop::collection::vec(prop::sample::select(vec![b'a', b'\r', b'\n', 0xc3, 0xa9, 0xf0, 0x9d, 0x84, 0x9e]), 0..24)) {
        let text = SourceText::new(bytes);
        for encoding in [Encoding::Utf8, Encoding::Utf16] {
            for offset in 0..=text.len() {
                let (line, character) = text.position_of(offset, encoding);
                let back = text.offset_of(line, character, encoding);
                prop_assert!(back <= offset && offset - back < 4);
                prop_assert_eq!(text.position_of(back, encoding), (line, character));
                for part in text.line_start(line)..=back {
                    let (at, before) = text.counted(text.line_start(line), part, encoding);
                    prop_assert_eq!(before + text.counted(at, back, encoding).1, character);
                }
            }
        }
    }

    #[test]
    fn a_text_that_is_set_aside_is_the_same_as_if_it_were_kept(
        lines in prop::collection::vec((0..60usize, prop::sample::select(vec!["\n", "\r\n", "\r"])), 200..900),
        long in 0..9000usize,
        places in prop::collection::vec((any::<prop::sample::Index>(), 0..600usize), 1..40),
        replacement in "[x\r\n]{0,5}",
    ) {
        let letter = |at: usize| char::from(b'a' + (at % 26) as u8);
        let line = |(at, (length, end)): (usize, &(usize, &str))| {
            let length = if at == 100 { long } else { *length };
            (0..length).map(|more| letter(at + more)).chain(end.chars()).collect::<String>()
        };
        let bytes: Vec<u8> = lines.iter().enumerate().map(line).collect::<String>().into_bytes();
        let kept = SourceText::new(bytes.clone());
        let mut aside = kept.clone();
        aside.set_aside(Arc::new(move |range| bytes.get(range).map(<[u8]>::to_vec)));
        prop_assert_eq!(aside.len(), kept.len());
        for (at, length) in &places {
            let at = at.index(kept.len() + 2);
            prop_assert_eq!(aside.slice(at..at + length), kept.slice(at..at + length));
            prop_assert_eq!(aside.byte(at), kept.byte(at));
            let line = kept.line_of(at);
            prop_assert_eq!(aside.line(line), kept.line(line));
            prop_assert_eq!(aside.line_end(line), kept.line_end(line));
            prop_assert_eq!(aside.position_of(at, Encoding::Utf16), kept.position_of(at, Encoding::Utf16));
        }
        prop_assert_eq!(&aside, &kept);
        for (at, length) in places {
            let at = at.index(kept.len() + 2);
            let (mut edited, mut aside) = (kept.clone(), aside.clone());
            edited.replace_here(at..at + length, &replacement);
            aside.replace_here(at..at + length, &replacement);
            prop_assert_eq!(&aside, &edited);
        }
    }
}

#[test]
fn what_cannot_be_read_again_is_lost() {
    let mut text = SourceText::new(b"0\nSECTION\n".repeat(1000));
    text.set_aside(Arc::new(|range| {
        (range.start == 0).then(|| vec![b'0'; range.len()])
    }));
    assert_eq!(text.slice(3..5), Some(&b"00"[..]));
    assert!(!text.is_lost());
    assert_eq!(text.slice(9000..9002), None);
    assert!(text.is_lost());
    assert_eq!(text.slice(3..5), Some(&b"00"[..]));
    let mut text = SourceText::new(b"0\nSECTION\n".repeat(1000));
    text.set_aside(Arc::new(|_| Some(b"less".to_vec())));
    assert_eq!((text.byte(3), text.is_lost()), (None, true));
}
