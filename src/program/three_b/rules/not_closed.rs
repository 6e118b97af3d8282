//! `not-closed`: a contour does not come back to where it began, nor to the end of its lead-in.
//!
//! Where a contour closes is said by [`crate::program::path`].

/// Up to this many blocks are a fragment: they may well be all that was meant.
pub(in super::super) const FRAGMENT: usize = 2;
