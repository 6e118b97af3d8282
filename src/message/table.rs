//! The form of a language: rows of name, parameters, and wording.

/// A sentence in the language in force: `say!(name)` is a `&'static str`, `say!(name, one, other)` a `String`.
macro_rules! say {
    ($name:ident) => {
        $crate::message::said::$name()
    };
    ($name:ident, $($argument:expr),+ $(,)?) => {
        $crate::message::said::$name($(&$argument),+)
    };
}

/// The same call in each language: an arm for each.
macro_rules! in_spoken {
    ($($call:tt)*) => {
        match $crate::message::spoken() {
            $crate::message::Language::English => $crate::message::en::$($call)*,
            $crate::message::Language::Chinese => $crate::message::zh::$($call)*,
        }
    };
}

/// The rows of a room: a function for each.
macro_rules! translate {
    ($($name:ident $(($($arguments:tt)*))? => $wording:tt;)*) => {
        $(row!($name, $(($($arguments)*))?, $wording);)*
    };
}

/// The rows of a room in the language that declares the sentences, each with the function that picks the language in
/// force.
macro_rules! declare {
    ($($name:ident $(($($arguments:tt)*))? => $wording:tt;)*) => {
        translate! { $($name $(($($arguments)*))? => $wording;)* }

        /// The same in the language in force.
        pub(crate) mod said {
            $(call!($name, $(($($arguments)*))?);)*
        }
    };
}

macro_rules! row {
    ($name:ident, , $wording:literal) => {
        pub(in crate::message) fn $name() -> &'static str {
            $wording
        }
    };
    ($name:ident, ($($argument:ident),+), $wording:literal) => {
        pub(in crate::message) fn $name($($argument: &dyn crate::message::Shown),+) -> String {
            format!($wording)
        }
    };
    ($name:ident, ($($argument:ident: $type:ty),+), $wording:block) => {
        pub(in crate::message) fn $name($($argument: &$type),+) -> String {
            $wording
        }
    };
}

macro_rules! call {
    ($name:ident, ) => {
        pub(crate) fn $name() -> &'static str {
            in_spoken!($name())
        }
    };
    ($name:ident, ($($argument:ident),+)) => {
        pub(crate) fn $name($($argument: &dyn crate::message::Shown),+) -> String {
            in_spoken!($name($($argument),+))
        }
    };
    ($name:ident, ($($argument:ident: $type:ty),+)) => {
        pub(crate) fn $name($($argument: &$type),+) -> String {
            in_spoken!($name($($argument),+))
        }
    };
}
