//! Bytes that are no DXF text, or no sound one: one finding, no panic, no long wait.

use super::reading::dxf;
use crate::dxf::Document;
use crate::finding::{Detail, Severity};
use proptest::prelude::*;

#[test]
fn what_is_no_dxf_gets_one_finding() {
    let utf16: Vec<u8> = dxf("0 LINE 10 1 20 1 11 1 21 2").encode_utf16().flat_map(u16::to_le_bytes).collect();
    let marked = [&b"\xff\xfe"[..], &utf16].concat();
    let cases: [(&[u8], &str); 14] = [
        (b"", "the text is empty, expected DXF"),
        (b"\n\r\n \n", "the text is empty, expected DXF"),
        (b"G21\nG90\nG1 X1 Y1\n", "the text has no DXF records: expected lines of group codes and values, as 0 and SECTION"),
        (b"1\n2\n3\n4\n", "the text has no DXF records: expected lines of group codes and values, as 0 and SECTION"),
        (b"hello", "the text has no DXF records: expected lines of group codes and values, as 0 and SECTION"),
        (b"AC1015\0\0\0\0\x06\x01", "the file is a DWG drawing, not DXF text: save it as DXF"),
        (b"%PDF-1.7\n", "the file is a PDF, not DXF text"),
        (b"PK\x03\x04\x14\0", "the file is a ZIP archive, not DXF text"),
        (b"AutoCAD Binary DXF\r\n\x1a\0", "the file is binary DXF, which is not read yet: save it as ASCII DXF"),
        (&utf16, "the text is UTF-16: save it as UTF-8"),
        (&marked, "the text is UTF-16: save it as UTF-8"),
        (&[0; 5000], "the file is binary, not DXF text"),
        (&[0; 1], "the file is binary, not DXF text"),
        (b"\x80\xff\n\xfe\n", "the text has no DXF records: expected lines of group codes and values, as 0 and SECTION"),
    ];
    for (bytes, expected) in cases {
        let document = Document::read(bytes.to_vec());
        let found: Vec<_> = document.findings().iter().map(|finding| (finding.severity, &finding.detail)).collect();
        assert_eq!(found, [(Severity::Error, &Detail::Syntax(expected.into()))], "{:?}", String::from_utf8_lossy(bytes));
        assert!(document.drawing().is_empty());
    }
}

#[test]
fn a_text_that_becomes_dxf_is_read() {
    let mut document = Document::read(Vec::new());
    document.edit(0..0, &dxf("0 CIRCLE 10 1 20 1 40 2"));
    assert_eq!((document.drawing().len(), document.findings().len()), (1, 0));
    document.edit(0..usize::MAX, "");
    assert_eq!((document.drawing().len(), document.findings().len()), (0, 1));
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
