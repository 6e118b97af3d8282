//! Makes foreign text safe to show: the name of a file, or one in a drawing, moves no cursor, hides
//! nothing and reverses no line.

use std::borrow::Cow;

/// True for characters that a terminal or a label would obey and not show: control characters (ESC, C0 except the tab,
/// C1, DEL), marks that turn the direction of text, and the separators of lines and paragraphs.
pub(crate) fn is_hidden(character: char) -> bool {
    (character.is_control() && character != '\t')
        || matches!(
            character,
            '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}'
        )
}

/// The text with `U+FFFD` for every [`is_hidden`] character. Line ends are among them: a name is a single line.
pub(crate) fn readable(text: &str) -> Cow<'_, str> {
    let is_plain = |byte: u8| (b' '..0x7f).contains(&byte);
    if text.bytes().all(is_plain) || !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    Cow::Owned(
        text.chars()
            .map(|character| {
                if is_hidden(character) {
                    char::REPLACEMENT_CHARACTER
                } else {
                    character
                }
            })
            .collect(),
    )
}

/// How many columns of a terminal a text takes: a Chinese character takes two.
pub(crate) fn columns(text: &str) -> usize {
    unicode_width::UnicodeWidthStr::width(text)
}

/// A time for people: minutes, from an hour on hours and minutes.
pub(crate) fn duration(minutes: f64) -> String {
    if minutes < 60.0 {
        return say!(minutes, minutes);
    }
    let whole = minutes.round();
    let hours = (whole / 60.0).floor();
    say!(hours_and_minutes, hours, (whole - 60.0 * hours) as u32)
}

/// The length of the cuts and, if any, of the ways between them, mm.
pub(crate) fn lengths(cut: f64, jumps: f64, apart: &str) -> String {
    let cut = say!(cut_length, cut);
    match jumps > 0.0 {
        true => format!("{cut}{apart}{}", say!(jumps_length, jumps)),
        false => cut,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_replaced_and_what_people_write_stays() {
        let check = |text: &str, expected: &str| assert_eq!(readable(text), expected, "{text:?}");
        check("DIE 1.dxf", "DIE 1.dxf");
        check("", "");
        check(
            "模具 Größe 凸模\u{1f600} נקבה",
            "模具 Größe 凸模\u{1f600} נקבה",
        );
        check("a\u{1b}[8mb\u{7}", "a\u{fffd}[8mb\u{fffd}");
        check(
            "\u{9b}31m\u{7f}\u{85}\n\r\t\0",
            "\u{fffd}31m\u{fffd}\u{fffd}\u{fffd}\u{fffd}\t\u{fffd}",
        );
        check(
            "fxd.\u{202e}exe\u{2066}\u{200f}\u{61c}",
            "fxd.\u{fffd}exe\u{fffd}\u{fffd}\u{fffd}",
        );
        check(
            "\u{2028}\u{2029}\u{feff}\u{e0041}",
            "\u{fffd}\u{fffd}\u{fffd}\u{fffd}",
        );
    }
}
