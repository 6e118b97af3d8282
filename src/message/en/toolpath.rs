//! Paths of the wire, and why there is none.

declare! {
    the_lead_in_cuts_through_contour(x, y, x1, y1, crossed) => "the lead-in from the thread hole ({x:.3}, {y:.3}) to ({x1:.3}, {y1:.3}) cuts through contour {crossed}";
    the_way_cuts_into_contour(x, y, x1, y1, contour) => "the way from ({x:.3}, {y:.3}) to ({x1:.3}, {y1:.3}) cuts into contour {contour}: the wire stays threaded, since the profile's pause does not stop the machine";
    contour_has_no_length(handle) => "contour {handle} has no length";
    contour_is_open_and_cannot_be_entered_at(handle, x, y) => "contour {handle} is open and cannot be entered at ({x}, {y}), expected one of its ends";
    contour_is_open_the_side_of_the_wire_is_not_known(handle) => "contour {handle} is open: the side of the wire is not known; close it, or set compensation to none to cut it as drawn";
    side_of_contour_is_not_known(handle) => "side of contour {handle} is not known: set side (--side) to opening or punch";
    the_thread_hole_comes_nearer_to_the_contour(x, y, correction, x1, y1) => "the thread hole ({x:.3}, {y:.3}) comes nearer to the contour than the correction {correction:.3} mm: the wire can only stand at ({x1:.3}, {y1:.3})";
    there_is_no_entity_with_the_handle(handle) => "there is no entity with the handle {handle}";
    entity_belongs_to_no_contour_that_is_cut(handle) => "entity {handle} belongs to no contour that is cut";
    there_is_no_contour_to_cut => "there is no contour to cut";
    crosses_the_contour_or_comes_nearer(correction) => "crosses the contour or comes nearer to it than the correction {correction:.3} mm";
    the_path_comes_too_near_to_contour(handle, correction, other) => "the path along contour {handle} cuts into contour {other} here or comes nearer to it than the correction {correction:.3} mm";
    cuts_into_contour_or_comes_nearer(contour, correction) => "cuts into contour {contour} or comes nearer to it than the correction {correction:.3} mm";
    runs_into_the_cut_along_contour(contour) => "runs into the cut along contour {contour}";
    an_open_contour_keeps_no_tab(handle) => "contour {handle} is open: nothing of it drops, so it keeps no tab; give the tab by handle to the contours that keep one, or set it to 0";
    no_contour_keeps_a_tab(key) => "{key}: no contour of this program keeps a tab; punches do, and openings whose slug is heavier than job.slug-limit";
    a_punch_is_free_after_its_first_pass(handle) => "contour {handle} is a punch and keeps no tab: it drops in its first pass, and the later ones cut nothing; expected a program.tab, unless it is held otherwise";
    the_tab_is_longer_than_contour(tab, handle, length) => "the tab of {tab:.3} mm leaves nothing of contour {handle}, which is {length:.3} mm long: expected a shorter tab";
    the_overlap_is_longer_than_contour(overlap, handle, length) => "the overlap of {overlap:.3} mm goes all round contour {handle}, which is {length:.3} mm long: expected a shorter one";
    nothing_of_the_tab_is_left_standing(tab, handle, x, y, cut) => "nothing of the tab of {tab:.3} mm at contour {handle} is left standing: what is cut before the stop meets at ({x:.3}, {y:.3}), {cut:.3} mm wide; expected a longer tab, another lead or entry, or a start hole that is smaller or farther away";
    the_tab_stands_by_a_neck(tab, handle, width, x, y) => "of the tab of {tab:.3} mm at contour {handle} a neck of {width:.3} mm is left standing at ({x:.3}, {y:.3}) until the stop";
    the_cut_meets_itself(handle, x, y, area) => "the cut of contour {handle} meets itself at ({x:.3}, {y:.3}) before the stop: {area:.1} mm² of the slug are loose there, and the tab does not hold them; expected another entry, a shorter lead or no tab";
    no_tab_fits_at(x, y) => "no tab begins at ({x:.3}, {y:.3}): the wire does not pass there";
    the_start_hole_cuts_into(diameter, x, y, handle, by) => "the start hole of Ø {diameter:.3} mm at ({x:.3}, {y:.3}) cuts {by:.3} mm into contour {handle}";
    the_start_hole_comes_near(diameter, x, y, left, handle, correction, clear) => "the start hole of Ø {diameter:.3} mm at ({x:.3}, {y:.3}) leaves {left:.3} mm beside contour {handle}, expected the correction {correction:.3} mm plus {clear} mm";
    the_start_holes_meet(diameter, x, y, handle, x1, y1) => "the start hole of Ø {diameter:.3} mm at ({x:.3}, {y:.3}) meets that of contour {handle} at ({x1:.3}, {y1:.3})";
    no_start_hole_fits_in(diameter, handle, depth, most) => "no start hole of Ø {diameter:.3} mm has room in contour {handle}: its deepest point is {depth:.3} mm from the next contour, expected at most Ø {most:.3} mm";
    no_start_hole_at_all_fits_in(diameter, handle, depth) => "no start hole of Ø {diameter:.3} mm has room in contour {handle}: its deepest point is {depth:.3} mm from the next contour; expected a thread hole that is given elsewhere";
    no_start_hole_fits_beside(diameter, x, y, least, why) => "no start hole of Ø {diameter:.3} mm has room beside the entry ({x:.3}, {y:.3}){why}: expected a lead-in of {least:.3} mm or more, another entry or a thread hole";
    no_arc_fits_at(length, least, x, y, why) => "no lead from {length:.3} mm down with an arc of R {least:.3} mm or more fits at ({x:.3}, {y:.3}){why}: give a thread hole or another entry";
    no_arc_leads_from_to(least, x, y, x1, y1, why) => "no arc of R {least:.3} mm or more leads from the thread hole ({x:.3}, {y:.3}) to the path at ({x1:.3}, {y1:.3}){why}";
    the_lead_in_does(x, y, x1, y1, does) => "the lead-in from the thread hole ({x:.3}, {y:.3}) to ({x1:.3}, {y1:.3}) {does}";
    the_way_back_does(x, y, x1, y1, does) => "the straight way back from the end of the contour at ({x:.3}, {y:.3}) to the thread hole ({x1:.3}, {y1:.3}) {does}";
    no_lead_in_fits_at(length, correction, x, y, why) => "no lead-in from {length:.3} mm down to the correction {correction:.3} mm fits at ({x:.3}, {y:.3}){why}: give a thread hole or another entry";
    the_lead_is_longer_than_the_part(contour, length, size) => "the lead of contour {contour} is {length:.3} mm long, and the part only {size:.3} mm: the thread hole belongs to another part, or is given in another unit";
    the_lead_is_shortened(handle, wanted, length) => "the lead of contour {handle} is {length:.3} mm long: there is no room for the {wanted:.3} mm of lead-in";
    because_it(does) => " (it {does})";
    the_entry_lies_from_contour(x, y, distance, handle) => "the entry ({x}, {y}) lies {distance:.3} mm from contour {handle}, expected a point on it";
    one_is_given_for_several_contours(what, count) => "one {what} is given for {count} contours: choose one contour by its handle, or give a table by handle";
    entry => "entry";
    whether_it_fits_needs(missing) => "whether the parts fit is not known: expected {missing} to be set";
    no_contour_has_a_partner => "no contour of a workpiece has a partner in another one: there is no pair to cut (--force writes the programs all the same)";
    a_pair_needs(missing) => "the corrections of a pair are not known: expected {missing} to be set";
    no_contour_is_of_a_pair => "no contour belongs to a pair: expected closed contours that the wire runs on both sides of, or two workpieces, one in the other";
    passes_run_on_both_sides_of_the_contour(part, key, length, corrections) => "{key} {length} mm lies between the corrections {corrections}: some passes of the {part} run on one side of the drawn contour, some on the other, and a control that offsets the contour keeps to one; expected program.compensation = \"path\", in 3B or ISO";
}
