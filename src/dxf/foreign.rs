//! Files that are called DXF but are not.

use crate::text::{head, is_utf_16};

/// Names what the bytes are when they are not DXF text, from their first kilobyte.
pub(super) fn recognise(bytes: &[u8]) -> Option<&'static str> {
    let head = head(bytes, 1024);
    let known: [(&[u8], &str); 7] = [
        (
            b"AutoCAD Binary DXF",
            say!(the_text_is_binary_dxf_which_an_editor_cannot_keep),
        ),
        (
            b"AutoCAD DXB",
            say!(the_text_is_dxb_which_an_editor_cannot_keep),
        ),
        (b"%PDF", say!(the_file_is_a_pdf_not_dxf_text)),
        (b"PK\x03\x04", say!(the_file_is_a_zip_archive_not_dxf_text)),
        (b"\x1f\x8b", say!(the_file_is_compressed)),
        (b"\x89PNG", say!(the_file_is_a_png_picture)),
        (b"II*\0", say!(the_file_is_a_tiff_picture)),
    ];
    if let Some((_, sentence)) = known.iter().find(|(magic, _)| head.starts_with(magic)) {
        return Some(sentence);
    }
    if head.starts_with(b"AC10") || head.starts_with(b"AC1.") || head.starts_with(b"AC2.") {
        return Some(say!(the_file_is_a_dwg_drawing));
    }
    if is_utf_16(bytes) {
        return Some(say!(the_text_is_utf_16));
    }
    let zeros = head.iter().filter(|&&byte| byte == 0).count();
    (zeros * 10 > head.len() * 3).then_some(say!(the_file_is_binary_not_dxf_text))
}
