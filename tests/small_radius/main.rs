//! The small-radius rule and its fix: against known outlines and against an independent opening.

mod opening;
mod oracle;
mod refusals;
mod support;
