//! Decodes a file on disk by the code page that its header names (`$DWGCODEPAGE`).
//!
//! Text from an editor is Unicode already; no code page applies.

use super::johab;
use crate::text::head;
use encoding_rs::Encoding;
use memchr::memmem;

/// The header is at the beginning: this many bytes are searched for its variables.
const HEADER: usize = 1 << 16;

/// DOS pages that the `encoding_rs` library lacks: the characters from 128 on. Source: Unicode,
/// Mappings/VENDORS/MICSFT/PC.
const DOS_437: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜ¢£¥₧ƒáíóúñÑªº¿⌐¬½¼¡«»░▒▓│┤╡╢╖╕╣║╗╝╜╛┐└┴┬├─┼╞╟╚╔╩╦╠═╬╧╨╤╥╙╘╒╓╫╪┘┌█▄▌▐▀αßΓπΣσµτΦΘΩδ∞φε∩≡±≥≤⌠⌡÷≈°∙·√ⁿ²■\u{a0}";
const DOS_850: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜø£Ø×ƒáíóúñÑªº¿®¬½¼¡«»░▒▓│┤ÁÂÀ©╣║╗╝¢¥┐└┴┬├─┼ãÃ╚╔╩╦╠═╬¤ðÐÊËÈıÍÎÏ┘┌█▄¦Ì▀ÓßÔÒõÕµþÞÚÛÙýÝ¯´\u{ad}±‗¾¶§÷¸°¨·¹³²■\u{a0}";
const DOS_852: &str = "ÇüéâäůćçłëŐőîŹÄĆÉĹĺôöĽľŚśÖÜŤťŁ×čáíóúĄąŽžĘę¬źČş«»░▒▓│┤ÁÂĚŞ╣║╗╝Żż┐└┴┬├─┼Ăă╚╔╩╦╠═╬¤đĐĎËďŇÍÎě┘┌█▄ŢŮ▀ÓßÔŃńňŠšŔÚŕŰýÝţ´\u{ad}˝˛ˇ˘§÷¸°¨˙űŘř■\u{a0}";

/// How to decode a file that is not UTF-8, or, with `first`, before UTF-8 is tried.
///
/// A file that names no known page is read as Western European, as other programs do.
#[derive(Clone, Copy, Debug)]
pub(super) struct CodePage {
    encoding: Page,
    /// Multi-byte codes may look like UTF-8 by chance.
    first: bool,
}

#[derive(Clone, Copy, Debug)]
enum Page {
    OfTheWeb(&'static Encoding),
    OfDos(&'static str),
    Johab,
}

impl CodePage {
    /// The code page that the header names. Since release 2007 files are UTF-8; a file that is not was written in its
    /// named page all the same.
    pub(super) fn of_file(bytes: &[u8]) -> CodePage {
        let head = head(bytes, HEADER);
        let version = variable(head, b"$ACADVER").unwrap_or_default();
        let is_utf_8 = version.starts_with(b"AC10") && version >= b"AC1021".as_slice();
        let name = String::from_utf8_lossy(variable(head, b"$DWGCODEPAGE").unwrap_or_default())
            .to_ascii_uppercase();
        let number = ["ANSI", "DOS", "ISO", "_"]
            .iter()
            .fold(&*name, |name, prefix| name.trim_start_matches(prefix));
        let first = matches!(
            number,
            "932" | "936" | "GB2312" | "949" | "KSC5601" | "950" | "BIG5" | "1361" | "JOHAB"
        );
        let encoding = match number {
            "437" => Page::OfDos(DOS_437),
            "850" => Page::OfDos(DOS_850),
            "852" => Page::OfDos(DOS_852),
            "1361" | "JOHAB" => Page::Johab,
            _ => Page::OfTheWeb(
                of_the_web(number)
                    .or_else(|| Encoding::for_label(name.as_bytes()))
                    .unwrap_or(encoding_rs::WINDOWS_1252),
            ),
        };
        CodePage {
            encoding,
            first: first && !is_utf_8,
        }
    }

    /// The bytes as UTF-8.
    pub(super) fn unicode(self, bytes: &[u8]) -> Vec<u8> {
        if bytes.is_ascii() || (!self.first && std::str::from_utf8(bytes).is_ok()) {
            return bytes.to_vec();
        }
        match self.encoding {
            Page::OfTheWeb(encoding) => encoding
                .decode_without_bom_handling(bytes)
                .0
                .into_owned()
                .into_bytes(),
            Page::Johab => johab::decoded(bytes).into_bytes(),
            Page::OfDos(upper) => {
                let character = |&byte: &u8| match byte.checked_sub(128) {
                    None => char::from(byte),
                    Some(place) => upper
                        .chars()
                        .nth(usize::from(place))
                        .unwrap_or(char::REPLACEMENT_CHARACTER),
                };
                bytes.iter().map(character).collect::<String>().into_bytes()
            }
        }
    }
}

fn of_the_web(number: &str) -> Option<&'static Encoding> {
    Some(match number {
        "874" => encoding_rs::WINDOWS_874,
        "932" => encoding_rs::SHIFT_JIS,
        "936" | "GB2312" => encoding_rs::GBK,
        "949" | "KSC5601" => encoding_rs::EUC_KR,
        "950" | "BIG5" => encoding_rs::BIG5,
        "1250" => encoding_rs::WINDOWS_1250,
        "1251" => encoding_rs::WINDOWS_1251,
        "1252" | "8859-1" | "8859_1" => encoding_rs::WINDOWS_1252,
        "1253" => encoding_rs::WINDOWS_1253,
        "1254" | "8859-9" | "8859_9" => encoding_rs::WINDOWS_1254,
        "1255" => encoding_rs::WINDOWS_1255,
        "1256" => encoding_rs::WINDOWS_1256,
        "1257" => encoding_rs::WINDOWS_1257,
        "1258" => encoding_rs::WINDOWS_1258,
        "866" => encoding_rs::IBM866,
        "8859-2" | "8859_2" => encoding_rs::ISO_8859_2,
        "8859-5" | "8859_5" => encoding_rs::ISO_8859_5,
        "8859-7" | "8859_7" => encoding_rs::ISO_8859_7,
        "MAC-ROMAN" => encoding_rs::MACINTOSH,
        _ => return None,
    })
}

/// The value of a header variable: two lines below its name, comments left out.
fn variable<'a>(head: &'a [u8], name: &[u8]) -> Option<&'a [u8]> {
    let at = memmem::find(head, name)?;
    let mut lines = head
        .get(at..)?
        .split(|&byte| byte == b'\n' || byte == b'\r')
        .map(<[u8]>::trim_ascii)
        .filter(|line| !line.is_empty());
    lines.next();
    loop {
        let (code, value) = (lines.next()?, lines.next()?);
        if code != b"999" {
            return Some(value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_the_file_s_own_code_page() {
        let file = |version: &str, page: &str| {
            format!(
                "  9\r\n$ACADVER\r\n  1\r\n{version}\r\n  9\r\n$DWGCODEPAGE\r\n  3\r\n{page}\r\n"
            )
        };
        for (version, page, bytes, expected) in [
            ("AC1015", "ANSI_1252", &b"m\xe4rks"[..], "märks"),
            ("AC1015", "ANSI_1252", "märks".as_bytes(), "märks"),
            ("AC1009", "ansi_936", b"\xc4\xa3", "模"),
            ("AC1015", "ANSI_932", b"\x8b\xe0\x8c^", "金型"),
            ("AC1015", "ANSI_1361", b"\x94\x61\xb7\xa1", "다이"),
            ("AC1015", "dos866", b"\x84", "Д"),
            ("AC1009", "dos850", b"Au\xe1en\xb5", "AußenÁ"),
            ("AC1009", "DOS437", b"\x84\xe3", "äπ"),
            ("AC1009", "dos852", b"\xfdez\xff", "řez\u{a0}"),
            ("AC1012", "ISO8859-2", b"\xf8", "ř"),
            ("AC1012", "macintosh", b"\x8a", "ä"),
            ("AC1012", "KOI8-R", b"\xed", "М"),
            // UTF-8, whatever the header says; anything else is in the page of the header.
            ("AC1021", "ANSI_936", "模".as_bytes(), "模"),
            ("AC1021", "ANSI_1252", b"m\xe4rks", "märks"),
            ("AC1015", "ANSI_9999", b"m\xe4rks", "märks"),
        ] {
            let page = CodePage::of_file(file(version, page).as_bytes());
            assert_eq!(
                String::from_utf8(page.unicode(bytes)).unwrap(),
                expected,
                "{version}"
            );
        }
    }

    #[test]
    fn a_header_may_name_none_or_have_comments_in_it() {
        for (header, bytes, expected) in [
            ("", &b"m\xe4rks"[..], "märks"),
            ("9\n$DWGCODEPAGE\n999\n3\n3\nANSI_1251\n", b"\xcc", "М"),
            ("9\n$DWGCODEPAGE\n999\n", b"\xcc", "Ì"),
        ] {
            assert_eq!(
                String::from_utf8(CodePage::of_file(header.as_bytes()).unicode(bytes)).unwrap(),
                expected,
                "{header}"
            );
        }
    }
}
