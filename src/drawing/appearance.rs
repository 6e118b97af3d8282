//! How a CAD program shows an entity: its colour, linetype, and whether it is visible at all.

use super::{Drawing, Entity, EntityId};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Whether the CAD program shows an entity, and if not, why. A hidden entity is not cut, unless it
/// is given a role.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Visibility {
    #[default]
    Shown,
    /// Its layer is not plotted; it is visible on the screen, and cut.
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

/// The linetype of an entity, where it is not a continuous one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Linetype {
    pub(crate) name: Arc<str>,
    /// It is the linetype of the entity's layer, not the entity's own.
    pub(crate) of_layer: bool,
}

impl Linetype {
    /// The linetype of a name; `None` for a continuous one.
    pub(crate) fn named(name: Arc<str>, of_layer: bool) -> Option<Linetype> {
        let is_broken = !name.is_empty() && !name.eq_ignore_ascii_case("CONTINUOUS");
        is_broken.then_some(Linetype { name, of_layer })
    }
}

/// Words that the drawing itself holds for one entity.
pub(crate) type Marks = Arc<[Arc<str>]>;

/// The mark in the name of a layer, for everything on it: `WEDM_SUPPRESS_gap_as the customer drew it`.
pub(crate) fn mark_of_layer(layer: &str) -> Option<&str> {
    let (ours, mark) = (layer.get(..5)?, layer.get(5..)?);
    let is_mark = |mark: &&str| {
        let word = mark.get(..SUPPRESS.len());
        word.is_some_and(|word| word.eq_ignore_ascii_case(SUPPRESS))
    };
    let is_ours = ours.eq_ignore_ascii_case("WEDM_");
    is_ours.then_some(mark).filter(is_mark)
}

/// The word that begins a mark which suppresses a finding.
pub(crate) const SUPPRESS: &str = "suppress";

/// Everything that a drawing knows of the appearance of one entity, and the words that it holds for it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Appearance {
    /// Set where it is not simply shown, with the layer that decides it.
    pub(crate) unseen: Option<(Visibility, Arc<str>)>,
    pub(crate) linetype: Option<Linetype>,
    pub(crate) color: Option<Color>,
    pub(crate) marks: Option<Marks>,
}

/// The entities that are not simply shown for one reason.
pub(crate) struct Unseen {
    pub(crate) visibility: Visibility,
    /// The layer that decides it; empty for entities that are invisible themselves.
    pub(crate) layer: Arc<str>,
    pub(crate) count: usize,
    /// The first of them in machining order.
    pub(crate) first: EntityId,
}

/// The polylines that are drawn with a width.
pub(crate) struct Wide {
    pub(crate) count: usize,
    /// The largest width, drawing units.
    pub(crate) width: f64,
    /// The first of them in machining order.
    pub(crate) first: EntityId,
}

/// The colour of an entity or a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Color {
    /// AutoCAD colour index, 1 to 255.
    Index(u8),
    /// Red, green, blue in 24 bits.
    True(u32),
}

/// The named colours, which are the first of the index, as 24-bit RGB.
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
    /// A 24-bit colour; a named colour if it equals one.
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

impl Drawing {
    /// Sets whether an entity is visible, and which layer decides it. True when that changes.
    pub(crate) fn set_visibility(
        &mut self,
        id: EntityId,
        visibility: Visibility,
        layer: &Arc<str>,
    ) -> bool {
        let now = (visibility != Visibility::Shown).then(|| (visibility, layer.clone()));
        let before = match now.clone() {
            None => self.unseen.remove(&id),
            Some(now) => self.unseen.insert(id, now),
        };
        before != now
    }

    pub fn visibility(&self, id: EntityId) -> Visibility {
        self.unseen
            .get(&id)
            .map_or(Visibility::Shown, |(visibility, _)| *visibility)
    }

    /// The layer that hides an entity: its own, or that of the block reference that draws it. `None` for one that hides itself, and for
    /// one that is seen.
    pub(crate) fn hiding_layer(&self, id: EntityId) -> Option<&Arc<str>> {
        let (visibility, layer) = self.unseen.get(&id)?;
        matches!(visibility, Visibility::Off | Visibility::Frozen).then_some(layer)
    }

    /// The entities with segments that are not simply shown, by visibility and layer.
    pub(crate) fn unseen(&self) -> Vec<Unseen> {
        let mut by_reason: BTreeMap<(Visibility, &str), Unseen> = BTreeMap::new();
        for (&id, (visibility, layer)) in &self.unseen {
            let has_segments = |entity: &Entity| entity.geometry.segment_count() > 0;
            if !self.get(id).is_some_and(has_segments) {
                continue;
            }
            let decides = match visibility {
                Visibility::Invisible => "",
                _ => layer,
            };
            let unseen = by_reason
                .entry((*visibility, decides))
                .or_insert_with(|| Unseen {
                    visibility: *visibility,
                    layer: decides.into(),
                    count: 0,
                    first: id,
                });
            unseen.count += 1;
            if self.rank(id) < self.rank(unseen.first) {
                unseen.first = id;
            }
        }
        by_reason.into_values().collect()
    }

    /// Sets the largest width of a polyline; 0 is none.
    pub(crate) fn set_width(&mut self, id: EntityId, width: f64) {
        match width > 0.0 {
            true => drop(self.widths.insert(id, width)),
            false => drop(self.widths.remove(&id)),
        }
    }

    /// The polylines with a width that are seen.
    pub(crate) fn wide(&self) -> Option<Wide> {
        let is_seen = |(id, _): &(&EntityId, &f64)| self.visibility(**id).is_seen();
        let seen = || self.widths.iter().filter(is_seen);
        Some(Wide {
            count: seen().count(),
            width: seen().map(|(_, width)| *width).fold(0.0, f64::max),
            first: *seen().min_by_key(|(id, _)| self.rank(**id))?.0,
        })
    }

    /// Sets the linetype of an entity; `None` is a continuous one. True when that changes.
    pub(crate) fn set_linetype(&mut self, id: EntityId, linetype: Option<Linetype>) -> bool {
        let before = self.linetypes.get(&id);
        let is_new = before != linetype.as_ref();
        if is_new {
            match linetype {
                Some(linetype) => drop(self.linetypes.insert(id, linetype)),
                None => drop(self.linetypes.remove(&id)),
            }
        }
        is_new
    }

    /// The linetype of an entity, where it is not a continuous one.
    pub(crate) fn linetype(&self, id: EntityId) -> Option<&Linetype> {
        self.linetypes.get(&id)
    }

    /// Sets the words that the source holds for an entity. True when that changes.
    pub(crate) fn set_marks(&mut self, id: EntityId, marks: Option<Marks>) -> bool {
        let before = match marks.clone() {
            Some(marks) => self.marks.insert(id, marks),
            None => self.marks.remove(&id),
        };
        before != marks
    }

    /// Whether any entity has words.
    pub(crate) fn has_marks(&self) -> bool {
        !self.marks.is_empty() || !self.on_marked_layers.is_empty()
    }

    /// The entities with words, their own or their layer's; in no order.
    pub(crate) fn marked(&self) -> impl Iterator<Item = EntityId> + '_ {
        let by_layer = self.on_marked_layers.iter();
        let by_layer = by_layer.filter(|id| !self.marks.contains_key(id));
        self.marks.keys().chain(by_layer).copied()
    }

    /// The words for an entity: its own, then those of its layer.
    pub(crate) fn marks(&self, id: EntityId) -> impl Iterator<Item = &str> + '_ {
        let layer = self.get(id).and_then(|entity| mark_of_layer(&entity.layer));
        let own = self.marks.get(&id).into_iter();
        own.flat_map(|marks| marks.iter().map(|mark| &**mark))
            .chain(layer)
    }

    pub(super) fn look_at_layer(&mut self, id: EntityId) {
        let layer = self.get(id).and_then(|entity| mark_of_layer(&entity.layer));
        if layer.is_some() {
            self.on_marked_layers.insert(id);
        } else if !self.on_marked_layers.is_empty() {
            self.on_marked_layers.remove(&id);
        }
    }

    /// The appearance of an entity, for one that is removed and may come back.
    pub(crate) fn appearance(&self, id: EntityId) -> Appearance {
        Appearance {
            unseen: self.unseen.get(&id).cloned(),
            linetype: self.linetypes.get(&id).cloned(),
            marks: self.marks.get(&id).cloned(),
            color: self.colors.get(id.0 as usize).copied().flatten(),
        }
    }

    pub(crate) fn set_appearance(&mut self, id: EntityId, appearance: Appearance) {
        match appearance.unseen {
            Some(unseen) => self.unseen.insert(id, unseen),
            None => self.unseen.remove(&id),
        };
        self.set_linetype(id, appearance.linetype);
        self.set_marks(id, appearance.marks);
        self.set_color(id, appearance.color);
    }

    /// Gives an entity a colour of its own, or that of its layer. True when that changes.
    pub(crate) fn set_color(&mut self, id: EntityId, color: Option<Color>) -> bool {
        let index = id.0 as usize;
        if color.is_some() && index >= self.colors.len() {
            self.colors.resize(index + 1, None);
        }
        self.colors
            .get_mut(index)
            .is_some_and(|slot| std::mem::replace(slot, color) != color)
    }

    pub(crate) fn set_layer_color(&mut self, layer: &str, color: Color) {
        self.layer_colors.insert(layer.to_lowercase(), color);
    }

    /// The colour of an entity: its own, else that of its layer; `None` where the source gives none.
    pub fn color(&self, id: EntityId) -> Option<Color> {
        let own = self.colors.get(id.0 as usize).copied().flatten();
        own.or_else(|| {
            self.layer_colors
                .get(&self.get(id)?.layer.to_lowercase())
                .copied()
        })
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
