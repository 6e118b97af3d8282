//! `not-closed`: a contour does not come back to where it began, nor to the end of its lead-in.
//!
//! Where a contour closes is said by [`crate::program::path`].

use super::super::run::Sum;
use crate::finding::Fault;

/// Up to this many blocks are a fragment: they may well be all that was meant.
pub(in super::super) const FRAGMENT: usize = 2;

/// `gap` leads from the end of the way to where it should be.
pub(in super::super) fn fault([x, y]: [f64; 2], sum: &Sum) -> Fault {
    Fault::NotClosed {
        x: -x,
        y: -y,
        blocks: sum.blocks,
    }
}
