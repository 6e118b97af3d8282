//! The form of what is told: rows of what is meant, its numbers, and the sentence that they make.

/// An enum with a function that tells each of its variants. In a row stand the variant, its fields (or the name of its
/// one field in round brackets), and the sentence, in which they are references.
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
