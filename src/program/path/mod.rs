//! The path of a program in any language: its steps, its cuts and contours, passes, crossings and arcs too tight to
//! cut.
//!
//! Lengths are µm. Nothing here knows how a language is written.

mod contour;
mod crossing;
mod crossings;
mod cut;
mod has_cuts;
mod joint;
mod known_tabs;
mod lay;
mod offset_losses;
mod parted;
mod passes;
mod polyline;
mod size;
mod tight;
mod trace;
mod way;
mod way_back;

pub(in crate::program) use contour::{Ends, closing, is_tab, not_closed};
pub(in crate::program) use crossing::crossings as crossings_of;
pub(in crate::program) use crossings::{Found, Known};
pub(crate) use cut::Cut;
pub(crate) use cut::{cut_in, cut_of, cuts};
pub(in crate::program) use has_cuts::{FEWEST_CROSSING, HasCuts};
pub(in crate::program) use joint::Heading;
pub(in crate::program) use joint::{joint, may_be_odd, odd_joint};
pub(in crate::program) use known_tabs::KnownTabs;
pub(in crate::program) use lay::{Lay, mixed};
pub(in crate::program) use offset_losses::{ControlOffset, MOST_BLOCKS};
pub(in crate::program) use parted::{Blocks, PartedWay, WayPart};
pub(crate) use passes::lie_beside;
pub(in crate::program) use polyline::{MOST_BY_BULGE, polyline};
pub(in crate::program) use size::{absurd_size, size_of};
pub(in crate::program) use tight::{UM_IN_MM, is_tight, is_tight_in_four_b};
pub(crate) use trace::{CutSteps, Follower};
pub use trace::{Kind, Step, Trace};
pub(crate) use way::Writing;
pub(crate) use way::tolerance;
pub(in crate::program) use way::{HeldWay, Node, Totals};
pub(crate) use way_back::without_ways_back;
