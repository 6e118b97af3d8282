//! Tables of settings: rows that are declared once, and everything that follows from them.

use std::collections::BTreeMap;

/// How a value that two levels set is merged.
pub(super) trait Overlay: Clone {
    fn overlaid(&self, later: &Self) -> Self;
}

/// Types whose later value replaces the earlier one as a whole.
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

/// Declares tables of settings. Each row is a key: its meaning (for people: docs, JSON Schema, editors), its type, its
/// default, its reader and range. It gives the field of a level, which holds only what somebody has set; the method of
/// the same name with the default filled in; and the parts that `Table` and [`Overlay`] need. `(as NAME, …)` makes a
/// second type, in which every default is filled in.
macro_rules! tables {
    ($($(#[doc = $about:literal])* $name:ident $filled:tt $rows:tt)*) => {$(
        table! { $(#[doc = $about])* $name $rows }
        filled! { $name $filled $rows }
    )*};
}

macro_rules! table {
    ($(#[doc = $about:literal])* $name:ident {$(
        $(#[doc = $doc:literal])*
        $key:ident: $type:ty $(= $default:expr)? => $read:ident $(in $range:expr)?;
    )*}) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "camelCase", deny_unknown_fields, default)]
        pub struct $name {$(
            $(#[doc = $doc])*
            #[serde(skip_serializing_if = "Option::is_none")]
            pub $key: Option<$type>,
        )*}

        impl $name {$($(
            /// The set value, else the default.
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
                    read: stringify!($read),
                    words: words!($read $type),
                    meaning: naming_profiles(&[$($doc.trim()),*].join(" "), ", "),
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

/// The type in which every default of a table is filled in; keys without a default stay optional.
macro_rules! filled {
    ($name:ident () $rows:tt) => {};
    ($name:ident (as $filled:ident, $($more:ident: $more_type:ty),*) {$(
        $(#[doc = $doc:literal])*
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

/// The words of a value whose type is a closed set.
macro_rules! words {
    (name $type:ty) => {
        words_of::<$type>()
    };
    ($read:ident $type:ty) => {
        Vec::new()
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
