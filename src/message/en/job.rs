//! What is made of a document, and why it is not.

declare! {
    no_contour_that_is_cut_is_on_the_layer(layer) => "no contour that is cut has an entity on the layer \"{layer}\"";
    an_error_stands_in_the_drawing => "the drawing has an error";
    the_path_was_given_up => "the path was given up";
    laying_the_path => "laying the wire's path";
    writing_and_proving => "writing and proving the program";
    the_program_does_not_hold_its_proof(reason) => "the program does not pass its proof: {reason}";
    no_program_of_this_drawing(reason) => "no program could be proved for this drawing: {reason}";
    four_b_ends_with_an_open_contour => "4B cannot say where the wire is after an open contour: such a contour can only be the last of a program, cut in one pass; cut it by itself, or choose another format";
    four_b_cuts_a_corner_off(depth, radius) => "4B holds an arc of R {radius:.3} mm in place of this corner: the wire cuts off {depth:.3} mm of it; ISO and 3B keep it";
    four_b_has_no_tab => "4B has one contour for all passes: it can have a tab only with a single pass, and no overlap; set tab or closing-overlap to 0, or choose another format";
    no_other_program(reason) => "no other program could be proved for this one, and none is written: {reason}";
    a_target_that_is_not_written(name, names) => "{name:?} is not written, expected dxf, {names}";
    it_cuts_nothing => "it cuts nothing";
    the_program_breaks_off_there => "the program breaks off there, and has no end";
    a_drawing_is_no_program => "it is a drawing, expected a program (.3b, .iso)";
    a_program_is_no_drawing => "it is a program, expected a drawing (.dxf)";
    nothing_is_said_of_a_wire(format) => "no wire is set, only an electrode in [milling]: choose the format milling, or set correction or wire-diameter for {format}";
    parts_have_a_program_each(parts) => "it is a pair, whose parts ({parts}) have a program each: `wedm pair` writes them";
    parts_of_have_a_program_each(parts, path) => "it is a pair, whose parts ({parts}) have a program each: `wedm pair {path}` writes them";
    holes_of_a_pair_are_csv => "the holes of a pair are written as .csv: in one drawing the hole of a part would be taken for that of the other, too";
    a_pair_is_not_milled => "a pair is cut by a wire: expected 3b, 4b or iso";
    the_electrode_wears_more_than_a_layer(wear) => "the electrode gets shorter by {wear:.2} times the layer's height in each layer along this contour: the floor is uneven within one layer; a larger electrode or a shorter contour wears less";
    the_step_is_longer(step, length) => "milling.step is {step} mm, longer than a layer of this contour, {length:.3} mm: expected a shorter step";
    the_floor_is_uneven(wear, least, most) => "the electrode gets shorter by {wear:.2} times the layer's height in each layer along this contour: the floor is uneven within one layer, in the end {least:.4} to {most:.4} mm deep; a larger electrode or a shorter contour wears less";
    it_is_milled => "an electrode mills it layer by layer: its heights belong to its moves, and it is not the path of a wire";
    nothing_is_picked(key, other) => "{key} is as-picked, but no contour is picked: they are cut in the order of {other}";
    a_pass_that_is_not_set(pass, count) => "pass {pass} was measured, but the settings have {count}";
    the_wire_is_thicker_than_its_kerf(pass, half, radius) => "pass {pass}: half of the kerf is {half:.4} mm, less than the wire's radius, {radius:.4} mm: check wire-diameter, and the correction that was set at the machine";
    a_pass_cuts_wider_than_the_one_before(pass, half, before, of_before, allowed) => "half of the kerf of pass {pass} is {half:.4} mm, that of pass {before} {of_before:.4} mm: a finer pass has no larger gap, and the uncertainty allows {allowed:.4} mm; check which pass each size was measured after";
    no_kerf_explains_a_size(feature, measured, nominal, correction, half) => "{feature}: {measured} mm in place of {nominal} mm, cut with a correction of {correction:.4} mm, comes to {half:.4} mm for half of the kerf: check the sizes, and whether it is outer or inner";
    a_feature_stands_out(pass, feature, half, others, allowed) => "pass {pass}: {feature} comes to {half:.4} mm for half of the kerf, the others to {others:.4} mm: it is off by more than the {allowed:.4} mm that their scatter allows; measure it again, or leave it out";
    outer_and_inner_features_differ(pass, outer, inner, allowed) => "pass {pass}: half of the kerf is {outer:.4} mm by the outer features and {inner:.4} mm by the inner ones: they differ by more than the {allowed:.4} mm that their scatter and the measuring allow. No correction explains that: look for the scale of the machine, taper, or jaws that are off";
}
