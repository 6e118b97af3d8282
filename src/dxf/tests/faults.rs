//! Bytes that are not DXF text, or not sound: one finding, no panic, no long wait.

use super::reading::dxf;
use crate::dxf::Document;
use crate::finding::{Detail, Finding, Rule, Severity};
use proptest::prelude::*;

#[test]
fn what_is_no_dxf_gets_one_finding() {
    let utf16: Vec<u8> = dxf("0 LINE 10 1 20 1 11 1 21 2")
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let marked = [&b"\xff\xfe"[..], &utf16].concat();
    let cases: [(&[u8], &str); 14] = [
        (b"", "the text is empty, expected DXF"),
        (b"\n\r\n \n", "the text is empty, expected DXF"),
        (
            b"G21\nG90\nG1 X1 Y1\n",
            "the text has no DXF records: expected lines of group codes and values, such as 0 and SECTION",
        ),
        (
            b"1\n2\n3\n4\n",
            "the text has no DXF records: expected lines of group codes and values, such as 0 and SECTION",
        ),
        (
            b"hello",
            "the text has no DXF records: expected lines of group codes and values, such as 0 and SECTION",
        ),
        (
            b"AC1015\0\0\0\0\x06\x01",
            "the file is a DWG drawing, not DXF text: save it as DXF",
        ),
        (b"%PDF-1.7\n", "the file is a PDF, not DXF text"),
        (
            b"PK\x03\x04\x14\0",
            "the file is a ZIP archive, not DXF text",
        ),
        (
            b"AutoCAD Binary DXF\r\n\x1a\0",
            "the text is binary DXF, which an editor cannot keep: save it as ASCII DXF",
        ),
        (&utf16, "the text is UTF-16: save it as UTF-8"),
        (&marked, "the text is UTF-16: save it as UTF-8"),
        (&[0; 5000], "the file is binary, not DXF text"),
        (&[0; 1], "the file is binary, not DXF text"),
        (
            b"\x80\xff\n\xfe\n",
            "the text has no DXF records: expected lines of group codes and values, such as 0 and SECTION",
        ),
    ];
    for (bytes, expected) in cases {
        let document = Document::read(bytes.to_vec());
        let found: Vec<_> = document
            .findings()
            .iter()
            .map(|finding| (finding.severity, &finding.detail))
            .collect();
        assert_eq!(
            found,
            [(Severity::Error, &Detail::Said(expected.into()))],
            "{:?}",
            String::from_utf8_lossy(bytes)
        );
        assert!(document.drawing().is_empty());
    }
}

#[test]
fn a_text_that_becomes_dxf_is_read() {
    let mut document = Document::read(Vec::new());
    document.edit(0..0, &dxf("0 CIRCLE 10 1 20 1 40 2"));
    assert_eq!(
        (document.drawing().len(), document.findings().len()),
        (1, 0)
    );
    document.edit(0..usize::MAX, "");
    assert_eq!(
        (document.drawing().len(), document.findings().len()),
        (0, 1)
    );
}

/// Sentences of the findings about the text.
fn syntax(document: &Document) -> Vec<String> {
    let sentence = |finding: &Finding| match &finding.detail {
        Detail::Said(sentence) if finding.rule == Rule::Syntax => Some(sentence.clone()),
        _ => None,
    };
    document.findings().iter().filter_map(sentence).collect()
}

#[test]
fn a_text_that_is_cut_anywhere_has_one_finding() {
    let whole = dxf(
        "0 LINE 5 A1 8 DIE 10 1.5 20 2.5 11 3.5 21 4.5 0 ARC 5 A2 8 0 10 1.0 20 2.0 40 3.5 50 0.0 51 90.0 \
         0 LWPOLYLINE 5 A3 8 0 90 3 70 1 10 0.5 20 0.5 42 0.5 10 9.5 20 0.5 10 9.5 20 9.5 \
         0 POLYLINE 5 A4 8 0 66 1 70 0 0 VERTEX 8 0 10 1.0 20 2.0 0 VERTEX 8 0 10 3.0 20 4.0 0 SEQEND \
         0 SPLINE 8 0 100 AcDbSpline 70 8 71 1 40 0 40 0 40 1 40 1 10 0.5 20 0.5 10 1.5 20 1.5 \
         0 ELLIPSE 8 0 10 0.5 20 0.5 11 3.5 21 0.0 40 0.5 41 0.0 42 3.0 0 TEXT 8 0 10 1.0 20 1.0 40 2.5 1 O",
    );
    let mut report = String::new();
    for (bytes, what) in [(whole.clone(), "LF"), (whole.replace('\n', "\r\n"), "CRLF")] {
        let end = bytes.trim_end().len();
        for length in 1..end {
            let found = syntax(&Document::read_file(bytes.as_bytes()[..length].to_vec()));
            if found.len() != 1 {
                report += &format!(
                    "{what} {length} behind {:?}: {found:?}\n",
                    &bytes[length.saturating_sub(24)..length]
                );
            }
        }
        assert_eq!(syntax(&Document::read_file(bytes.into_bytes())), [""; 0]);
    }
    assert!(report.is_empty(), "{report}");
}

proptest! {
    #[test]
    fn damaged_bytes_do_no_harm(flips in prop::collection::vec((0.0..1.0f64, any::<u8>()), 0..6), length in 0.0..1.0f64) {
        let text = dxf("0 LWPOLYLINE 5 A 90 3 70 1 10 0 20 0 42 1 10 1 20 1 10 2 20 0 0 ARC 10 1 20 2 40 3 50 1 51 2 0 POLYLINE 66 1 \
             0 VERTEX 10 0 20 0 0 VERTEX 10 1 20 0 0 SEQEND 0 INSERT 2 X 0 LINE 10 1 20 1 11 1 21 2");
        let mut bytes = text.into_bytes();
        for (share, byte) in flips {
            let at = (share * bytes.len() as f64) as usize;
            bytes[at] = byte;
        }
        bytes.truncate((length * 1.2 * bytes.len() as f64) as usize);
        let document = Document::read(bytes);
        for finding in document.findings() {
            prop_assert!(document.range_of(&finding.place).end <= document.text().len());
        }
        document.segments_at(0..document.text().len());
        for (_, entity) in document.drawing().entities() {
            prop_assert!(entity.geometry.is_sound());
        }
    }
}

#[test]
fn a_line_too_few_or_too_many_is_one_finding_and_costs_its_own_entity() {
    let tags = "0 LINE 5 A1 8 DIE 10 1.5 20 2.0 30 0.0 11 3 21 4 31 0.0 0 ARC 5 A2 8 DIE 10 1.0 20 2.25 40 3 50 30 51 90 \
         0 LWPOLYLINE 5 A3 8 P 90 3 70 1 43 0.0 10 0.5 20 0.5 42 0.25 10 10.5 20 0.0 10 10 20 10.25 0 CIRCLE 5 A4 8 P 10 1.5 20 1.5 40 2 \
         0 LINE 5 A5 8 DIE 10 1.5 20 2.0 30 0.0 11 3 21 4 31 0.0";
    let text = dxf(tags);
    let lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|line| *line == "ENTITIES").unwrap() + 1;
    let mut report = String::new();
    let mut look = |what: String, lines: &[&str]| {
        let document = Document::read((lines.join("\n") + "\n").into_bytes());
        let syntax = document
            .findings()
            .iter()
            .filter(|finding| finding.rule == Rule::Syntax)
            .count();
        let kept = ["A1", "A2", "A3", "A4", "A5"]
            .iter()
            .filter(|handle| document.drawing().find(handle).is_some())
            .count();
        if syntax != 1 || kept < 3 {
            let sentences: Vec<_> = document
                .findings()
                .iter()
                .map(|finding| format!("{:?}", finding.detail))
                .collect();
            report += &format!("{what}: {syntax} findings, {kept} entities kept {sentences:?}\n");
        }
    };
    for at in first..lines.len() - 4 {
        let without: Vec<&str> = lines
            .iter()
            .enumerate()
            .filter(|(line, _)| *line != at)
            .map(|(_, line)| *line)
            .collect();
        look(
            format!("without {at} {:?} before {:?}", lines[at], lines[at + 1]),
            &without,
        );
        for extra in ["", "xyz", "7.5"] {
            let with: Vec<&str> = lines[..at]
                .iter()
                .copied()
                .chain([extra])
                .chain(lines[at..].iter().copied())
                .collect();
            look(format!("{extra:?} before {at} {:?}", lines[at]), &with);
        }
    }
    assert!(report.is_empty(), "{report}");
}

/// A bulge whose radius no number can express is not a line either.
#[test]
fn a_bulge_that_no_arc_has_damages_its_entity() {
    for entity in [
        "0 LWPOLYLINE 90 3 70 1 10 0 20 0 42 BULGE 10 9 20 0 10 9 20 9",
        "0 POLYLINE 66 1 70 1 0 VERTEX 10 0 20 0 42 BULGE 0 VERTEX 10 9 20 0 0 VERTEX 10 9 20 9 0 SEQEND",
    ] {
        for (bulge, is_read) in [
            ("0.4", true),
            ("-1e12", true),
            ("1.1e12", false),
            ("-1e155", false),
            ("1e308", false),
        ] {
            let text = |bulge: &str| dxf(&entity.replace("BULGE", bulge));
            let check = |document: &Document| {
                let found = document.findings();
                assert_eq!(
                    document.drawing().len(),
                    usize::from(is_read),
                    "{entity} {bulge}"
                );
                match found {
                    [] => assert!(is_read, "{entity} {bulge}"),
                    [finding] => {
                        let Detail::Said(sentence) = &finding.detail else {
                            panic!("{finding:?}");
                        };
                        assert!(!is_read && sentence.contains(bulge), "{sentence}");
                    }
                    _ => panic!("{found:?}"),
                }
            };
            check(&Document::read(text(bulge).into()));
            let before = text("0.5");
            let mut document = Document::read(before.clone().into());
            let at = before.find("\n0.5\n").unwrap() + 1;
            document.edit(at..at + 3, bulge);
            check(&document);
        }
    }
}
