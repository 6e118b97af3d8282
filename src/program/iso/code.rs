//! Which foreign word a word is: its letter and number, or its name, in 32 bits.

use super::word::Number;
use rustc_hash::FxHasher;
use std::hash::{Hash, Hasher};

/// The key of a foreign word: its letter, and for G and M its number times 10; or its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code(pub(super) u32);

impl Code {
    /// `#1=4`.
    pub(super) const VARIABLE: Code = Code(0);
    pub(super) const SKIP: Code = Code(1);
    /// The text after a colon.
    pub(super) const SECOND: Code = Code(2);
    /// TP and TN.
    pub(super) const PLANE: Code = Code(3);

    /// M98.
    pub(super) const SUBPROGRAM: Code = Code((b'M' as u32) << 16 | 980);
    /// P with no word beside it, by which some controls call.
    pub(super) const SUBPROGRAM_BY_P: Code = Code((b'P' as u32) << 16 | 1);

    pub(super) fn of(letter: u8, number: Number) -> Code {
        let tenths = match (letter, number.decimals) {
            (b'G' | b'M', 0) => number.mantissa.saturating_mul(10),
            (b'G' | b'M', 1) => number.mantissa,
            _ => 0,
        };
        Code(u32::from(letter) << 16 | (tenths.unsigned_abs().min(0xffff) as u32))
    }

    /// The code of `STOP`, which is that of `Stop` too, and of `GOTO10` that of `GOTO20`.
    pub(super) fn of_name(text: &[u8]) -> Code {
        let letters = text.iter().take_while(|byte| byte.is_ascii_alphabetic());
        let name: Vec<u8> = letters.map(u8::to_ascii_uppercase).collect();
        if name.is_empty() {
            return Code::VARIABLE;
        }
        let mut hasher = FxHasher::default();
        name.hash(&mut hasher);
        // No letter lies this high.
        Code(1 << 31 | hasher.finish() as u32)
    }

    /// The code of a text that begins with bytes of the machine's own, this many of them.
    pub(super) fn of_text(text: &[u8], length: usize) -> Code {
        match text {
            [b':', ..] => Code::SECOND,
            // `TP0.0` or `TN20.0`.
            [b'T' | b't', b'P' | b'p' | b'N' | b'n', next, ..]
                if length > 2 && !next.is_ascii_alphabetic() =>
            {
                Code::PLANE
            }
            _ => Code::of_name(text),
        }
    }

    /// 0 for a name.
    pub(super) fn letter(self) -> u8 {
        u8::try_from(self.0 >> 16).unwrap_or_default()
    }

    /// It calls other blocks in a way that is not followed: M96 to M98, G22, G25, G65 to G67, P by itself, a name.
    pub(super) fn calls(self) -> bool {
        match (self.letter(), self.0 & 0xffff) {
            (b'M', tenths) => matches!(tenths, 960 | 970 | 980),
            (b'G', tenths) => matches!(tenths, 220 | 250 | 650..=679),
            _ if self == Code::SUBPROGRAM_BY_P => true,
            _ => self == Code::of_name(b"CALL") || self == Code::of_name(b"GOSUB"),
        }
    }

    /// It says where the upper end of the wire goes, or between which planes it leans.
    pub(super) fn is_of_guide(self) -> bool {
        matches!(self.letter(), b'U' | b'V') || matches!(self, Code::SECOND | Code::PLANE)
    }

    /// It does not depend on the machine in a program that mills.
    pub(super) fn is_height(self) -> bool {
        self.0 == u32::from(b'Z') << 16
    }

    /// It is followed where the lean of the wire is known. T also has many other meanings.
    pub(super) fn is_of_taper(self) -> bool {
        let (letter, tenths) = (self.letter(), self.0 & 0xffff);
        self.tilts()
            || self == Code::PLANE
            || letter == b'A'
            || letter == b'G' && matches!(tenths, 500 | 1400)
    }

    /// The wire may lean because of it: G51, G52, G141, G142, U, V, and a second contour.
    pub(super) fn tilts(self) -> bool {
        match (self.letter(), self.0 & 0xffff) {
            (b'G', tenths) => matches!(tenths, 510 | 520 | 1410 | 1420),
            (b'U' | b'V', _) => true,
            _ => self == Code::SECOND,
        }
    }
}
