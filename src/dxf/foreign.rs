//! What is no DXF text although it is called so.

/// Says what the bytes are, when they are not DXF text; looks at their first kilobyte.
pub(super) fn recognise(bytes: &[u8]) -> Option<&'static str> {
    let head = &bytes[..bytes.len().min(1024)];
    let zeros = head.iter().filter(|&&byte| byte == 0).count();
    let known: [(&[u8], &str); 9] = [
        (
            b"AutoCAD Binary DXF",
            "the text is binary DXF, which an editor cannot keep: save it as ASCII DXF",
        ),
        (
            b"AutoCAD DXB",
            "the text is DXB, which an editor cannot keep: save it as ASCII DXF",
        ),
        (b"%PDF", "the file is a PDF, not DXF text"),
        (b"PK\x03\x04", "the file is a ZIP archive, not DXF text"),
        (b"\xff\xfe", "the text is UTF-16: save it as UTF-8"),
        (b"\xfe\xff", "the text is UTF-16: save it as UTF-8"),
        (b"\x1f\x8b", "the file is compressed (gzip), not DXF text"),
        (b"\x89PNG", "the file is a picture (PNG), not DXF text"),
        (b"II*\0", "the file is a picture (TIFF), not DXF text"),
    ];
    if let Some((_, sentence)) = known.iter().find(|(magic, _)| head.starts_with(magic)) {
        return Some(sentence);
    }
    if head.starts_with(b"AC10") || head.starts_with(b"AC1.") || head.starts_with(b"AC2.") {
        return Some("the file is a DWG drawing, not DXF text: save it as DXF");
    }
    let alternate = head
        .iter()
        .skip(1)
        .step_by(2)
        .filter(|&&byte| byte == 0)
        .count();
    if zeros * 5 > head.len() * 2 && alternate * 10 > head.len() * 4 && zeros < head.len() * 6 / 10
    {
        return Some("the text is UTF-16: save it as UTF-8");
    }
    (zeros * 10 > head.len() * 3).then_some("the file is binary, not DXF text")
}
