//! What a CAD program shows of an entity: its colour, and whether it is to be seen at all.

use std::sync::Arc;

/// Whether an entity is to be seen in the CAD program. What is not seen is not cut, unless somebody gives it a role.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Visibility {
    #[default]
    Shown,
    /// Its layer is not plotted; it is seen on the screen, and cut.
    Unplotted,
    /// Its layer is switched off.
    Off,
    /// Its layer is frozen, or that of the block reference that draws it.
    Frozen,
    /// The entity itself says that it is invisible.
    Invisible,
}

impl Visibility {
    pub(crate) fn is_seen(self) -> bool {
        matches!(self, Visibility::Shown | Visibility::Unplotted)
    }
}

/// The linetype in which an entity is drawn, where it is not a continuous one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Linetype {
    pub(crate) name: Arc<str>,
    /// It is that of the entity's layer, not its own.
    pub(crate) of_layer: bool,
}

/// Words that the drawing itself has for one entity.
pub(crate) type Marks = Arc<[Arc<str>]>;

/// What the name of a layer says as a mark of all that is on it: `WEDM_SUPPRESS_gap_as the customer drew it`.
pub(crate) fn mark_of_layer(layer: &str) -> Option<&str> {
    let (ours, mark) = (layer.get(..5)?, layer.get(5..)?);
    let is_mark = |mark: &&str| {
        let word = mark.get(..SUPPRESS.len());
        word.is_some_and(|word| word.eq_ignore_ascii_case(SUPPRESS))
    };
    let is_ours = ours.eq_ignore_ascii_case("WEDM_");
    is_ours.then_some(mark).filter(is_mark)
}

/// The word that a mark begins with which lets a finding stand.
pub(crate) const SUPPRESS: &str = "suppress";

/// All that a drawing knows of how one entity looks, and what it has for it in words.
#[derive(Clone, Debug)]
pub(crate) struct Appearance {
    pub(super) unseen: Option<(Visibility, Arc<str>)>,
    pub(super) linetype: Option<Linetype>,
    pub(super) color: Option<Color>,
    pub(super) marks: Option<Marks>,
}

/// The colour of an entity or a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Color {
    /// AutoCAD colour index, 1 to 255.
    Index(u8),
    /// Red, green, blue in 24 bits.
    True(u32),
}

/// The colours that have a name, which are the first of the index, and what they are as red, green and blue.
const NAMED: [(&str, u32); 7] = [
    ("red", 0xFF_0000),
    ("yellow", 0xFF_FF00),
    ("green", 0x00_FF00),
    ("cyan", 0x00_FFFF),
    ("blue", 0x00_00FF),
    ("magenta", 0xFF_00FF),
    ("white", 0xFF_FFFF),
];

impl Color {
    /// A colour of 24 bits; one of those that have a name is that one.
    pub(crate) fn of_rgb(rgb: u32) -> Color {
        let named = NAMED.iter().zip(1..).find(|((_, named), _)| *named == rgb);
        named.map_or(Color::True(rgb & 0xFF_FFFF), |(_, index)| {
            Color::Index(index)
        })
    }

    /// A colour by the name that people write: `red` to `white`, `1` to `255`, or `#ff8000`. `None` for anything else.
    pub(crate) fn named(name: &str) -> Option<Color> {
        if let Some((_, index)) = NAMED
            .iter()
            .zip(1..)
            .find(|((named, _), _)| named.eq_ignore_ascii_case(name))
        {
            return Some(Color::Index(index));
        }
        if let Some(digits) = name.strip_prefix('#') {
            let is_rgb = digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
            let rgb = u32::from_str_radix(digits, 16).ok().filter(|_| is_rgb)?;
            return Some(Color::of_rgb(rgb));
        }
        name.parse()
            .ok()
            .filter(|index| *index > 0)
            .map(Color::Index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_by_name() {
        for (name, expected) in [
            ("red", Some(Color::Index(1))),
            ("White", Some(Color::Index(7))),
            ("30", Some(Color::Index(30))),
            ("#FF0000", Some(Color::Index(1))),
            ("#ff8000", Some(Color::True(0xFF8000))),
            ("0", None),
            ("256", None),
            ("#ff80", None),
            ("#+f8000", None),
            ("pink", None),
        ] {
            assert_eq!(Color::named(name), expected, "{name}");
        }
    }
}
