//! What was left out because it would have taken too much: its numbers and sentences.

told! {
    /// Work on one document is bounded in counted steps, so that the same document always leaves out the same.
    enum NotJudged;
    fn sentence();

    /// Too much lies on or across each other: `count` stretches of contours were not compared with their neighbours.
    Pairs { count: usize } => say!(thousands_of_entities_lie_on_each_other, count);
    /// The offset of this many contours crosses itself too often to find out what it loses: the correction is much larger than their segments.
    Offsets { contours: usize } => say!(the_correction_is_so_large_beside_the_segments, contours);
    /// No path is laid along a contour of this many segments: so many of them lie within a square of twice the correction, in the mean `most`
    /// and more, that its offset would take too long to make.
    Path { segments: usize, most: usize } => say!(the_correction_is_too_large_for_a_path, segments, most);
    /// Too much of a contour of this many blocks lies in one place: not all crossings were looked for.
    Crossings { blocks: usize } => say!(so_much_of_the_way_lies_on_one_place, blocks);
    /// A contour of this many blocks is too long to look at all that the offset of the control loses of it.
    Losses { blocks: usize } => say!(so_long_a_contour_is_not_searched_for_narrow_places, blocks);
    /// A reference to a block would draw this many copies and segments: `most` is the limit for all references of a
    /// file.
    Reference { copies: u64, segments: u64, most: u64 }
        => say!(this_insert_draws_too_much, copies, segments, most);
    /// A curve takes this many arcs; all curves of a drawing together may take `most` beyond the
    /// free allowance of each.
    Curve { arcs: usize, most: u64 } => say!(this_curve_would_take_too_many_arcs, arcs, most);
    /// The calls of subprograms come to more than `lines` lines, or more than `calls` calls.
    Calls { lines: usize, calls: usize }
        => say!(the_calls_of_subprograms_come_to_too_much, lines, calls);
}
