//! Decodes a file on disk by the code page that its header names (`$DWGCODEPAGE`).
//!
//! Text from an editor is Unicode already; no code page applies.

use super::johab;
use crate::text::{consists_of_pairs, head, is_gb_18030_by_chance};
use encoding_rs::{Encoding, GB18030, WINDOWS_1252};
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
/// The page that the header names may be wrong: programs write UTF-8 under the page of their system, and the page of Western
/// Europe, or none, over Chinese in GBK. The bytes of the whole file decide.
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
    /// The code page in which a file is written. Since release 2007 files are UTF-8; a file that is not was written in its
    /// named page all the same. One that names no known page is read as Western European, as other programs do, unless it
    /// is GB 18030.
    pub(super) fn of_file(bytes: &[u8]) -> CodePage {
        let head = head(bytes, HEADER);
        let version = variable(head, b"$ACADVER").unwrap_or_default();
        let is_utf_8 = version.starts_with(b"AC10") && version >= b"AC1021".as_slice();
        let name = String::from_utf8_lossy(variable(head, b"$DWGCODEPAGE").unwrap_or_default())
            .to_ascii_uppercase();
        let number = ["ANSI", "DOS", "ISO", "_"]
            .iter()
            .fold(&*name, |name, prefix| name.trim_start_matches(prefix));
        let has_wide_letters = matches!(
            number,
            "932" | "936" | "GB2312" | "949" | "KSC5601" | "950" | "BIG5" | "1361" | "JOHAB"
        );
        let known = match number {
            "437" => Some(Page::OfDos(DOS_437)),
            "850" => Some(Page::OfDos(DOS_850)),
            "852" => Some(Page::OfDos(DOS_852)),
            "1361" | "JOHAB" => Some(Page::Johab),
            _ => of_the_web(number)
                .or_else(|| Encoding::for_label(name.as_bytes()))
                .filter(|&page| page != WINDOWS_1252)
                .map(Page::OfTheWeb),
        };
        let is_gb = || match std::str::from_utf8(bytes) {
            Ok(text) => !is_utf_8 && is_gb_18030_by_chance(text),
            Err(_) => is_gb_18030(bytes),
        };
        match known {
            None if is_gb() => CodePage {
                encoding: Page::OfTheWeb(GB18030),
                first: true,
            },
            known => CodePage {
                encoding: known.unwrap_or(Page::OfTheWeb(WINDOWS_1252)),
                first: has_wide_letters
                    && !is_utf_8
                    && std::str::from_utf8(bytes).map_or(true, consists_of_pairs),
            },
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
        "1252" | "8859-1" | "8859_1" => WINDOWS_1252,
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

/// True for bytes that are no UTF-8, and Chinese rather than Western European: all letters beyond ASCII come in pairs that
/// are common in GB 18030, and some of them are no word and no sign of Western Europe.
fn is_gb_18030(bytes: &[u8]) -> bool {
    let mut is_sure = false;
    let mut rest = bytes;
    let mut before = b' ';
    while let Some(at) = rest.iter().position(|byte| !byte.is_ascii()) {
        let (ascii, from) = rest.split_at(at);
        let length = from.iter().take_while(|byte| !byte.is_ascii()).count();
        let (run, behind) = from.split_at(length);
        let is_common = |pair: &[u8]| matches!(pair, [0xa1..=0xf7, 0xa1..=0xfe]);
        if !run.chunks(2).all(is_common) {
            return false;
        }
        before = ascii.last().copied().unwrap_or(before);
        let is_beside = |letter: Option<&u8>| letter.is_some_and(u8::is_ascii_alphabetic);
        let is_word = is_beside(Some(&before)) || is_beside(behind.first());
        // As in größe and 45°±, where the two letters are a character of GB 18030 by chance.
        let is_western = |byte: &u8| match byte {
            0xd7 | 0xf7 => true,
            0xc0..=0xff => is_word,
            _ => WESTERN_SIGNS.contains(byte),
        };
        is_sure |= length > 2 || !run.iter().all(is_western);
        rest = behind;
    }
    is_sure
}

/// § « ° ± ² ³ ´ µ · » ¼ ½ ¾ in the page 1252: signs that stand beside each other in Western drawings.
const WESTERN_SIGNS: [u8; 13] = [
    0xa7, 0xab, 0xb0, 0xb1, 0xb2, 0xb3, 0xb4, 0xb5, 0xb7, 0xbb, 0xbc, 0xbd, 0xbe,
];

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
            // UTF-8 under a page of East Asia, whatever the release says.
            ("AC1009", "ANSI_936", "凸模".as_bytes(), "凸模"),
            ("AC1015", "ANSI_932", "金型".as_bytes(), "金型"),
            ("AC1015", "ANSI_949", "다이".as_bytes(), "다이"),
            ("AC1015", "ANSI_950", "Außen".as_bytes(), "Außen"),
            // What may be both is in the page.
            ("AC1015", "ANSI_949", b"\xc2\xa1", "징"),
            // GBK under the page of Western Europe, or one that is not known.
            ("AC1015", "ANSI_1252", b"\xcd\xb9\xc4\xa3", "凸模"),
            ("AC1015", "", b"\xd0\xcd\xbf\xd7 1", "型孔 1"),
            ("AC1024", "ANSI_1252", b"\xbf\xd7", "孔"),
            ("AC1015", "ANSI_9999", b"\xb0\xbc\xc4\xa3A", "凹模A"),
            // Words and signs of Western Europe that come in pairs.
            ("AC1015", "ANSI_1252", b"gr\xf6\xdfe", "größe"),
            (
                "AC1015",
                "ANSI_1252",
                b"GR\xd6\xdfE 45\xb0\xb1",
                "GRÖßE 45°±",
            ),
            ("AC1015", "ANSI_1252", b"Au\xdfen \xcd\xb9", "Außen Í¹"),
        ] {
            let mut whole = file(version, page).into_bytes();
            whole.extend(bytes);
            let page = CodePage::of_file(&whole);
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
