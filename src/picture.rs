//! A picture of contours, faults and wire path as SVG.
