//! Repairs of a program's one slip, whatever its language.

pub(super) mod gap;
