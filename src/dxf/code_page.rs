//! The code page of a file on disk, which its header names (`$DWGCODEPAGE`), to Unicode.
//!
//! Text from an editor is Unicode already: there no code page holds.

use encoding_rs::Encoding;
use memchr::memmem;

/// The header stands at the beginning; its variables are looked for in this many bytes.
const HEADER: usize = 1 << 16;

/// How texts of a file are to be read where they are no UTF-8, or, where `first` is set, before it is asked whether they are.
#[derive(Clone, Copy, Debug)]
pub(super) struct CodePage {
    encoding: &'static Encoding,
    /// Codes of several bytes may look like UTF-8 by chance.
    first: bool,
}

impl CodePage {
    /// The code page that the header names; `None` where it names none that is known, and since release 2007, which is UTF-8.
    pub(super) fn of_file(bytes: &[u8]) -> Option<CodePage> {
        let head = &bytes[..bytes.len().min(HEADER)];
        let version = variable(head, b"$ACADVER").unwrap_or_default();
        if version.starts_with(b"AC10") && version >= b"AC1021".as_slice() {
            return None;
        }
        let name = String::from_utf8_lossy(variable(head, b"$DWGCODEPAGE")?).to_ascii_uppercase();
        let number = name.trim_start_matches("ANSI_").trim_start_matches("DOS").trim_start_matches('_');
        let (encoding, first) = match number {
            "874" => (encoding_rs::WINDOWS_874, false),
            "932" => (encoding_rs::SHIFT_JIS, true),
            "936" | "GB2312" => (encoding_rs::GBK, true),
            "949" | "KSC5601" => (encoding_rs::EUC_KR, true),
            "950" | "BIG5" => (encoding_rs::BIG5, true),
            "1250" => (encoding_rs::WINDOWS_1250, false),
            "1251" => (encoding_rs::WINDOWS_1251, false),
            "1252" => (encoding_rs::WINDOWS_1252, false),
            "1253" => (encoding_rs::WINDOWS_1253, false),
            "1254" => (encoding_rs::WINDOWS_1254, false),
            "1255" => (encoding_rs::WINDOWS_1255, false),
            "1256" => (encoding_rs::WINDOWS_1256, false),
            "1257" => (encoding_rs::WINDOWS_1257, false),
            "1258" => (encoding_rs::WINDOWS_1258, false),
            "866" => (encoding_rs::IBM866, false),
            _ => return None,
        };
        Some(CodePage { encoding, first })
    }

    /// The bytes as UTF-8.
    pub(super) fn unicode(self, bytes: &[u8]) -> Vec<u8> {
        if bytes.is_ascii() || (!self.first && std::str::from_utf8(bytes).is_ok()) {
            return bytes.to_vec();
        }
        self.encoding.decode_without_bom_handling(bytes).0.into_owned().into_bytes()
    }
}

/// The value of a header variable: what stands two lines below its name.
fn variable<'a>(head: &'a [u8], name: &[u8]) -> Option<&'a [u8]> {
    let at = memmem::find(head, name)?;
    let mut lines = head[at..].split(|&byte| byte == b'\n' || byte == b'\r').map(<[u8]>::trim_ascii).filter(|line| !line.is_empty());
    lines.nth(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_the_file_s_own_code_page() {
        let file = |version: &str, page: &str| format!("  9\r\n$ACADVER\r\n  1\r\n{version}\r\n  9\r\n$DWGCODEPAGE\r\n  3\r\n{page}\r\n");
        for (version, page, bytes, expected) in [
            ("AC1015", "ANSI_1252", &b"m\xe4rks"[..], Some("märks")),
            ("AC1015", "ANSI_1252", "märks".as_bytes(), Some("märks")),
            ("AC1009", "ansi_936", b"\xc4\xa3", Some("模")),
            ("AC1015", "ANSI_932", b"\x8b\xe0\x8c^", Some("金型")),
            ("AC1015", "dos866", b"\x84", Some("Д")),
            ("AC1021", "ANSI_1252", b"m\xe4rks", None),
            ("AC1015", "ANSI_9999", b"m\xe4rks", None),
        ] {
            let page = CodePage::of_file(file(version, page).as_bytes());
            assert_eq!(page.map(|page| page.unicode(bytes)), expected.map(|text| text.as_bytes().to_vec()), "{version} {expected:?}");
        }
    }
}
