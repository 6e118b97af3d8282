//! The type of the value after each group code, for readers of text and of binary files.
//!
//! Source: DXF reference, "Group code value types".

/// How a value is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ValueType {
    /// Names, handles and other text.
    Text,
    /// Bytes as hexadecimal digits.
    Bytes,
    Real,
    /// Whole numbers of one, two, four and eight bytes.
    Flag,
    Short,
    Long,
    Huge,
}

impl ValueType {
    /// `None` for a code that the reference does not know.
    pub(super) fn of(code: i16) -> Option<ValueType> {
        Some(match code {
            310..=319 | 1004 => ValueType::Bytes,
            -5..=9 | 100..=105 | 300..=369 | 390..=399 | 410..=419 | 430..=439 => ValueType::Text,
            470..=481 | 999..=1009 => ValueType::Text,
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => ValueType::Real,
            290..=299 => ValueType::Flag,
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 => ValueType::Short,
            1060..=1070 => ValueType::Short,
            90..=99 | 420..=429 | 440..=459 | 1071 => ValueType::Long,
            160..=169 => ValueType::Huge,
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::ValueType::{self, *};

    /// The table of the reference, range by range, with the codes that it leaves out: -5 to -1, which programs alone
    /// see, and 101, 103 and 104.
    const REFERENCE: [(i16, i16, ValueType); 41] = [
        (-5, -1, Text),
        (0, 9, Text),
        (10, 39, Real),
        (40, 59, Real),
        (60, 79, Short),
        (90, 99, Long),
        (100, 100, Text),
        (101, 101, Text),
        (102, 102, Text),
        (103, 104, Text),
        (105, 105, Text),
        (110, 119, Real),
        (120, 129, Real),
        (130, 139, Real),
        (140, 149, Real),
        (160, 169, Huge),
        (170, 179, Short),
        (210, 239, Real),
        (270, 279, Short),
        (280, 289, Short),
        (290, 299, Flag),
        (300, 309, Text),
        (310, 319, Bytes),
        (320, 329, Text),
        (330, 369, Text),
        (370, 379, Short),
        (380, 389, Short),
        (390, 399, Text),
        (400, 409, Short),
        (410, 419, Text),
        (420, 429, Long),
        (430, 439, Text),
        (440, 459, Long),
        (460, 469, Real),
        (470, 481, Text),
        (999, 1003, Text),
        (1004, 1004, Bytes),
        (1005, 1009, Text),
        (1010, 1059, Real),
        (1060, 1070, Short),
        (1071, 1071, Long),
    ];

    #[test]
    fn every_code_has_the_type_that_the_reference_gives_it() {
        for code in i16::MIN..=i16::MAX {
            let row = REFERENCE
                .iter()
                .find(|(first, last, _)| (*first..=*last).contains(&code));
            assert_eq!(ValueType::of(code), row.map(|row| row.2), "{code}");
        }
    }
}
