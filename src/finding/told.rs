//! The form of messages as data: rows of a variant, its numbers, and the sentence that they make.

/// An enum with a function that words each of its variants. A row has the variant, its fields (or
/// the name of its one field in round brackets), and the sentence, in which the fields are
/// references.
macro_rules! told {
    (
        $(#[$about:meta])*
        enum $name:ident;
        $(#[$does:meta])*
        fn $tell:ident($($argument:ident: $type:ty),*);
        $(
            $(#[$doc:meta])*
            $variant:ident $(($one:ident: $inner:ty))?
            $({ $($(#[$of:meta])* $field:ident: $kind:ty),+ })? => $said:expr;
        )+
    ) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq)]
        pub enum $name {
            $($(#[$doc])* $variant $(($inner))? $({ $($(#[$of])* $field: $kind),+ })?,)+
        }

        impl $name {
            $(#[$does])*
            #[allow(unused_variables, reason = "not every number is in the sentence")]
            pub(crate) fn $tell(&self, $($argument: $type),*) -> String {
                match self {
                    $($name::$variant $(($one))? $({ $($field),+ })? => String::from($said),)+
                }
            }
        }
    };
}
