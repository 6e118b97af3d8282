//! What a table of settings is: rows that are declared once, and all that follows from them.

use super::reader::Reader;
use super::value::Node;
use std::collections::BTreeMap;

/// The numbers that a key takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub least: f64,
    /// The least number itself is taken.
    pub is_least: bool,
    pub most: f64,
}

impl Range {
    pub(super) const ABOVE_ZERO: Range = Range {
        is_least: false,
        ..Range::FROM_ZERO
    };
    pub(super) const FROM_ZERO: Range = Range::of(0.0, f64::INFINITY);

    /// All numbers from `least` to `most`, both among them.
    pub(super) const fn of(least: f64, most: f64) -> Range {
        Range {
            least,
            is_least: true,
            most,
        }
    }

    pub(super) fn holds(&self, number: f64) -> bool {
        number.is_finite()
            && number <= self.most
            && (number > self.least || self.is_least && number == self.least)
    }

    pub(super) fn expected(&self) -> String {
        let Range { least, most, .. } = self;
        match (most.is_finite(), self.is_least) {
            (true, _) => say!(a_number_from_to, least, most),
            (false, true) => say!(a_number_of_or_above, least),
            (false, false) => say!(a_number_above, least),
        }
    }
}

/// A key as its row declares it.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// As `wedm.toml` has it: `program.lead-in`; `profiles.NAME.end` within a table by name.
    pub key: String,
    /// As TOML writes it; `None` where the key is not set by default.
    pub default: Option<String>,
    pub range: Option<Range>,
    /// What the key means. The first sentence stands for itself.
    pub meaning: String,
}

impl Row {
    /// The meaning without the targets of its links.
    pub fn plain_meaning(&self) -> String {
        let mut plain = String::new();
        let mut rest = self.meaning.as_str();
        while let Some((before, link)) = rest.split_once("](") {
            plain.extend(before.rsplitn(2, '[').collect::<Vec<_>>().into_iter().rev());
            rest = link.split_once(')').map_or("", |(_, behind)| behind);
        }
        plain + rest
    }
}

/// A table with declared keys.
pub(super) trait Table: Default {
    /// The keys in their order, kebab-case.
    fn keys() -> Vec<String>;
    fn rows(prefix: &str) -> Vec<Row>;
    /// Reads the value of a key in snake_case; false where there is no such key. `dotted` is the key as it is written.
    fn read(&mut self, reader: &mut Reader, key: &str, dotted: &str, node: &Node) -> bool;
}

/// What becomes of a value that two levels set.
pub(super) trait Overlay: Clone {
    fn overlaid(&self, later: &Self) -> Self;
}

/// Types of values of which the later one wins as a whole.
macro_rules! plain {
    ($($type:ty),* $(,)?) => {
        $(impl table::Overlay for $type {
            fn overlaid(&self, later: &Self) -> Self {
                later.clone()
            }
        })*
    };
}

impl<T: Overlay> Overlay for Option<T> {
    fn overlaid(&self, later: &Self) -> Self {
        match (self, later) {
            (Some(earlier), Some(later)) => Some(earlier.overlaid(later)),
            (earlier, later) => later.clone().or_else(|| earlier.clone()),
        }
    }
}

/// Tables by name are merged name by name.
impl<T: Overlay> Overlay for BTreeMap<String, T> {
    fn overlaid(&self, later: &Self) -> Self {
        let mut merged = self.clone();
        for (name, value) in later {
            let value = match self.get(name) {
                Some(earlier) => earlier.overlaid(value),
                None => value.clone(),
            };
            merged.insert(name.clone(), value);
        }
        merged
    }
}

/// `lead_in` as `wedm.toml` has it.
pub(super) fn kebab_case(key: &str) -> String {
    key.replace('_', "-")
}

/// `lead-in` as JSON has it: `leadIn`.
pub fn camel_case(key: &str) -> String {
    let mut camel = String::with_capacity(key.len());
    let mut begins_word = false;
    for letter in key.chars() {
        match (letter, begins_word) {
            ('-', _) => begins_word = true,
            (letter, true) => {
                camel.push(letter.to_ascii_uppercase());
                begins_word = false;
            }
            (letter, false) => camel.push(letter),
        }
    }
    camel
}

/// A default as `wedm.toml` has it.
pub(super) fn as_toml(value: &impl serde::Serialize) -> Option<String> {
    serde_json::to_string(value).ok()
}

/// Declares tables of settings. Each row is a key: what it means (to people: docs, JSON Schema, editors), its type, its default, how it
/// is read and in which range. From it come the field of a level, which holds only what somebody has set, the method of the same name with
/// the default filled in, and the parts that [`Table`] and [`Overlay`] play. `(as NAME, …)` makes a second type, in which every default is filled in.
macro_rules! tables {
    ($($(#[doc = $about:literal])* $name:ident $filled:tt $rows:tt)*) => {$(
        table! { $(#[doc = $about])* $name $rows }
        filled! { $name $filled $rows }
    )*};
}

macro_rules! table {
    ($(#[doc = $about:literal])* $name:ident {$(
        $(#[doc = $doc:literal])*
        $(#[serde($($serde:tt)*)])?
        $key:ident: $type:ty $(= $default:expr)? => $read:ident $(in $range:expr)?;
    )*}) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "camelCase", deny_unknown_fields, default)]
        pub struct $name {$(
            $(#[doc = $doc])*
            #[serde(skip_serializing_if = "Option::is_none")]
            $(#[serde($($serde)*)])?
            pub $key: Option<$type>,
        )*}

        impl $name {$($(
            /// What is set, else the default.
            pub fn $key(&self) -> $type {
                self.$key.clone().unwrap_or_else(|| $default.into())
            }
        )?)*}

        impl Overlay for $name {
            fn overlaid(&self, later: &Self) -> Self {
                $name { $($key: Overlay::overlaid(&self.$key, &later.$key),)* }
            }
        }

        impl Table for $name {
            fn keys() -> Vec<String> {
                vec![$(kebab_case(stringify!($key))),*]
            }

            fn rows(within: &str) -> Vec<Row> {
                vec![$(Row {
                    key: format!("{within}{}", kebab_case(stringify!($key))),
                    default: where_given!($(as_toml(&<$type>::from($default)))?),
                    range: where_given!($(Some($range))?),
                    meaning: [$($doc.trim()),*].join(" "),
                }),*]
            }

            fn read(&mut self, reader: &mut Reader, key: &str, dotted: &str, node: &Node) -> bool {
                match key {
                    $(stringify!($key) => self.$key = reader.$read(dotted, node $(, &$range)?),)*
                    _ => return false,
                }
                true
            }
        }
    };
}

/// The type in which every default of a table is filled in; what has none stays as it is set.
macro_rules! filled {
    ($name:ident () $rows:tt) => {};
    ($name:ident (as $filled:ident, $($more:ident: $more_type:ty),*) {$(
        $(#[doc = $doc:literal])*
        $(#[serde($($serde:tt)*)])?
        $key:ident: $type:ty $(= $default:expr)? => $read:ident $(in $range:expr)?;
    )*}) => {
        #[doc = concat!("[`", stringify!($name), "`] with every default filled in.")]
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub struct $filled {
            $(pub $more: $more_type,)*
            $($(#[doc = $doc])* pub $key: filled_type!($type $(, $default)?),)*
        }

        impl $name {
            pub(super) fn filled(self, $($more: $more_type),*) -> $filled {
                $filled {
                    $($more,)*
                    $($key: filled_value!(self.$key $(, $default)?),)*
                }
            }
        }
    };
}

macro_rules! filled_type {
    ($type:ty) => { Option<$type> };
    ($type:ty, $default:expr) => { $type };
}

macro_rules! filled_value {
    ($value:expr) => {
        $value
    };
    ($value:expr, $default:expr) => {
        $value.unwrap_or_else(|| $default.into())
    };
}

macro_rules! where_given {
    () => {
        None
    };
    ($value:expr) => {
        $value
    };
}
