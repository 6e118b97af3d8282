//! Occurrences of something elsewhere in a text: the question and the answer.

use std::ops::Range;

/// Called now and then: true when the result is no longer wanted.
pub(crate) type Stop<'a> = &'a dyn Fn() -> bool;

/// The result was no longer wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stopped;

/// The question about a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Question {
    Definition,
    References { with_definition: bool },
    Highlights,
}

/// The relation of an occurrence to the place asked about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    Defines,
    Uses,
    /// It belongs together with the place.
    Partner,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Occurrence {
    pub(crate) range: Range<usize>,
    pub(crate) role: Role,
}

impl Question {
    /// True where an occurrence answers the question.
    pub(super) fn wants(self, role: Role) -> bool {
        match self {
            Question::Definition => role == Role::Defines,
            Question::References { with_definition } => with_definition || role != Role::Defines,
            Question::Highlights => true,
        }
    }
}
