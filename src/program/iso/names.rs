//! Names of the control's own language, which take what follows them in the line, and what each does with the way of the
//! wire. Reading and conversion know them from here alone.

/// What a word that nobody follows does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unfollowed {
    /// It moves the wire to a place that only the machine knows.
    Way,
    /// It mirrors, turns, scales or shifts what follows, or lets its coordinates mean something else.
    Frame,
    /// It counts from another zero than the blocks before it.
    Zero,
    /// It calls a subprogram that is not in the text.
    Missing,
    /// It calls something in a way that is not followed.
    Call,
    /// It says how often something runs.
    Repeat,
    /// The program goes on in another block.
    Jump,
    /// It says which correction holds, by a value that only the control knows.
    Correction,
    /// Nobody knows that it does nothing of the kind.
    Unknown,
}

/// Each with what it does; `None` for the end of what another one begins. `DO1` is `D01` with a letter for a zero: of a
/// loop it stands behind WHILE.
const NAMES: [(&str, Option<Unfollowed>); 19] = [
    ("CALL", Some(Unfollowed::Call)),
    ("ELSE", Some(Unfollowed::Jump)),
    ("END", None),
    ("ENDIF", None),
    ("GOSUB", Some(Unfollowed::Call)),
    ("GOTO", Some(Unfollowed::Jump)),
    ("IF", Some(Unfollowed::Jump)),
    ("JUMP", Some(Unfollowed::Jump)),
    ("LOOP", Some(Unfollowed::Repeat)),
    ("MIRROR", Some(Unfollowed::Frame)),
    ("REPEAT", Some(Unfollowed::Repeat)),
    ("RETURN", Some(Unfollowed::Jump)),
    ("ROT", Some(Unfollowed::Frame)),
    ("ROTATE", Some(Unfollowed::Frame)),
    ("SCALE", Some(Unfollowed::Frame)),
    ("SHIFT", Some(Unfollowed::Frame)),
    ("THEN", Some(Unfollowed::Jump)),
    ("TRANS", Some(Unfollowed::Frame)),
    ("WHILE", Some(Unfollowed::Jump)),
];

/// Names that move nothing: the machine stops, or says something; planes of a wire that leans are read elsewhere.
const HARMLESS: [&str; 5] = ["MSG", "PRINT", "STOP", "TN", "TP"];

/// Whether a name, in letters of either case, is known to leave the way of the wire as it is.
pub(super) fn is_harmless(name: &[u8]) -> bool {
    HARMLESS
        .iter()
        .any(|own| name.eq_ignore_ascii_case(own.as_bytes()))
}

/// What a name does, in letters of either case; `None` for one that is not of the list.
pub(super) fn meaning(name: &[u8]) -> Option<Option<Unfollowed>> {
    let own = NAMES
        .iter()
        .find(|(own, _)| name.eq_ignore_ascii_case(own.as_bytes()));
    own.map(|(_, what)| *what)
}
