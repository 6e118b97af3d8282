//! The table LAYER: which layers are visible, and in which colour they are drawn.

use super::lines::Lines;
use super::number::{self, Number};
use super::place::own_tags;
use crate::drawing::{Color, Linetype, Visibility};
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::Arc;

/// One entry of the table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LayerEntry {
    pub(crate) name: Arc<str>,
    pub(super) visibility: Visibility,
    pub(super) color: Option<Color>,
    pub(super) linetype: Option<Linetype>,
}

/// The layer on which AutoCAD keeps the points of dimensions: it is never plotted.
const NEVER_PLOTTED: &str = "defpoints";

/// The entry of the record in some lines; `name` decodes its name. `None` for an entry without a name.
pub(super) fn read(
    lines: Lines,
    range: Range<usize>,
    mut name: impl FnMut(&[u8]) -> Arc<str>,
) -> Option<LayerEntry> {
    const FROZEN: i64 = 1;
    let whole = |line: usize| match number::number(lines.content(line)) {
        Number::Exact(value) if value.fract() == 0.0 && value.abs() < 1e9 => Some(value as i64),
        _ => None,
    };
    let mut entry = LayerEntry {
        name: "".into(),
        visibility: Visibility::Shown,
        color: None,
        linetype: None,
    };
    let (mut named, mut frozen, mut off, mut plotted, mut rgb) = (false, false, false, true, None);
    for tag in own_tags(lines, range) {
        let line = tag.value_line();
        match tag.code {
            2 => {
                entry.name = name(lines.trimmed(line));
                named = true;
            }
            6 => {
                entry.linetype = Linetype::named(name(lines.trimmed(line)), true);
            }
            70 => frozen = whole(line).is_some_and(|flags| flags & FROZEN != 0),
            62 => {
                // A negative colour means that the layer is off.
                let index = whole(line).unwrap_or(7);
                off = index < 0;
                entry.color = u8::try_from(index.unsigned_abs())
                    .ok()
                    .filter(|index| *index > 0)
                    .map(Color::Index);
            }
            420 => rgb = whole(line).and_then(|rgb| u32::try_from(rgb).ok()),
            290 => plotted = lines.trimmed(line) != b"0",
            _ => {}
        }
    }
    entry.color = rgb.map(Color::of_rgb).or(entry.color);
    entry.visibility = match () {
        () if frozen => Visibility::Frozen,
        () if off => Visibility::Off,
        () if !plotted || entry.name.eq_ignore_ascii_case(NEVER_PLOTTED) => Visibility::Unplotted,
        () => Visibility::Shown,
    };
    named.then_some(entry)
}

impl LayerEntry {
    /// True where it is shown with continuous lines: it need not be remembered.
    pub(super) fn is_plain(&self) -> bool {
        self.visibility == Visibility::Shown && self.linetype.is_none()
    }
}

/// Whether a layer is shown, and its linetype.
type LayerState = (Visibility, Option<Linetype>);

/// The table's entry of each layer that is not simply shown, or has a linetype. Names ignore case.
#[derive(Clone, Debug, Default)]
pub(super) struct LayerStates {
    unlike: FxHashMap<String, LayerState>,
    /// The last layer looked up: neighbours often share it.
    last: Option<(Arc<str>, LayerState)>,
}

impl LayerStates {
    pub(super) fn enter(&mut self, entry: &LayerEntry) {
        if !entry.is_plain() {
            let state = (entry.visibility, entry.linetype.clone());
            self.unlike.insert(entry.name.to_lowercase(), state);
        }
        self.last = None;
    }

    pub(super) fn of(&mut self, layer: &Arc<str>) -> Visibility {
        self.state(layer)
            .map_or(Visibility::Shown, |(visibility, _)| *visibility)
    }

    /// The linetype of entities that take their layer's.
    pub(super) fn linetype_of(&mut self, layer: &Arc<str>) -> Option<Linetype> {
        self.state(layer)?.1.clone()
    }

    fn state(&mut self, layer: &Arc<str>) -> Option<&LayerState> {
        if self.unlike.is_empty() {
            return None;
        }
        if !matches!(&self.last, Some((last, _)) if Arc::ptr_eq(last, layer)) {
            let state = self.unlike.get(&layer.to_lowercase());
            self.last = Some((layer.clone(), state.cloned().unwrap_or_default()));
        }
        self.last.as_ref().map(|(_, state)| state)
    }
}
