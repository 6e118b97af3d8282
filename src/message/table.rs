//! How a language is written down: rows of name, what is spoken of, and wording.

/// A sentence in the language that is spoken: `say!(name)` is a `&'static str`, `say!(name, one, other)` a `String`.
macro_rules! say {
    ($name:ident) => {
        $crate::message::said::$name()
    };
    ($name:ident, $($argument:expr),+ $(,)?) => {
        $crate::message::said::$name($(&$argument),+)
    };
}

/// The rows of a language: a function for each.
macro_rules! translate {
    ($($name:ident $(($($arguments:tt)*))? => $wording:tt;)*) => {
        $(row!($name, $(($($arguments)*))?, $wording);)*
    };
}

/// The rows of the language that says which sentences there are, and for each its function in the language that is spoken.
macro_rules! declare {
    ($($name:ident $(($($arguments:tt)*))? => $wording:tt;)*) => {
        translate! { $($name $(($($arguments)*))? => $wording;)* }

        /// Every sentence, in the language that is spoken.
        pub(crate) mod said {
            use crate::message::{Language, spoken};
            $(call!($name, $(($($arguments)*))?);)*
        }
    };
}

macro_rules! row {
    ($name:ident, , $wording:literal) => {
        pub(super) fn $name() -> &'static str {
            $wording
        }
    };
    ($name:ident, ($($argument:ident),+), $wording:literal) => {
        pub(super) fn $name($($argument: &dyn crate::message::Shown),+) -> String {
            format!($wording)
        }
    };
    ($name:ident, ($($argument:ident: $type:ty),+), $wording:block) => {
        pub(super) fn $name($($argument: &$type),+) -> String {
            $wording
        }
    };
}

macro_rules! call {
    ($name:ident, ) => {
        pub(crate) fn $name() -> &'static str {
            match spoken() {
                Language::English => super::$name(),
            }
        }
    };
    ($name:ident, ($($argument:ident),+)) => {
        pub(crate) fn $name($($argument: &dyn crate::message::Shown),+) -> String {
            match spoken() {
                Language::English => super::$name($($argument),+),
            }
        }
    };
    ($name:ident, ($($argument:ident: $type:ty),+)) => {
        pub(crate) fn $name($($argument: &$type),+) -> String {
            match spoken() {
                Language::English => super::$name($($argument),+),
            }
        }
    };
}
