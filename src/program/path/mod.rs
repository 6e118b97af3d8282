//! The path of a program in any language: its steps, its cuts and contours, passes, crossings and arcs too tight to
//! cut.
//!
//! Lengths are µm. Nothing here knows how a language is written.

mod contour;
mod crossing;
mod cut;
mod joint;
mod offset_losses;
mod passes;
mod polyline;
mod size;
mod tight;
mod trace;
mod verdict;
mod way;
mod way_back;

pub(crate) use contour::closing;
pub(in crate::program) use contour::{Ends, is_tab};
pub(in crate::program) use crossing::crossings as crossings_of;
pub(crate) use cut::Cut;
pub(crate) use cut::{cut_in, cuts};
pub(in crate::program) use joint::{Jointed, odd_joints};
pub(in crate::program) use offset_losses::{ControlOffset, MOST_BLOCKS};
pub(crate) use passes::lie_beside;
pub(in crate::program) use polyline::{MOST_BY_BULGE, polyline};
pub(in crate::program) use size::{absurd_size, size_of};
pub(in crate::program) use tight::{UM_IN_MM, is_tight, is_tight_in_four_b};
pub(crate) use trace::Follower;
pub use trace::{Kind, Register, Step, Trace};
pub(in crate::program) use verdict::{FEWEST_CROSSING, Found, Verdict};
pub(in crate::program) use way::Node;
pub(crate) use way::Way;
pub(crate) use way::Writing;
pub(crate) use way::tolerance;
pub(crate) use way_back::without_ways_back;
