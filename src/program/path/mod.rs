//! What the path of a program is, whatever its language: its steps, its cuts and contours, passes, crossings and arcs too tight to cut.
//!
//! Lengths are µm. Nothing here knows how a language is written.

mod contour;
mod crossing;
mod crossings;
mod cut;
mod passes;
mod tight;
mod trace;
mod way;

pub(crate) use contour::tolerance;
pub(in crate::program) use contour::{closing, gap, goes_round, is_tab};
pub(in crate::program) use crossing::{crossings as crossings_of, near_each_other};
pub(in crate::program) use crossings::{Found, Known};
pub use cut::Cut;
pub(crate) use cut::{cut_at, cut_of, cuts};
pub(in crate::program) use passes::{passes, pieces_of};
pub(in crate::program) use tight::{UM_IN_MM, is_tight};
pub use trace::{Chain, Kind, Step, Trace};
pub use way::Writing;
pub(in crate::program) use way::{Blocks, HeldWay, Node, Part, PartedWay, Way, mixed};
