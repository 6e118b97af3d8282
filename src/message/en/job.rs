//! What is made of a document, and why it is not.

declare! {
    no_contour_that_is_cut_is_on_the_layer(layer) => "no contour that is cut has an entity on the layer \"{layer}\"";
    an_error_stands_in_the_drawing => "an error stands in the drawing";
    the_path_was_given_up => "the path was given up";
    laying_the_path => "laying the wire's path";
    writing_and_proving => "writing and proving the program";
    the_program_does_not_hold_its_proof(reason) => "the program does not hold its proof: {reason}";
    no_program_of_this_drawing(reason) => "no program could be proved for this drawing: {reason}";
    four_b_has_no_tab => "4B holds one contour for all passes: it has a tab with one pass alone, and no overlap; set tab or closing-overlap to 0, or choose another format";
    no_other_program(reason) => "no other program could be proved for this one, and none is written: {reason}";
    a_target_that_is_not_written(name, names) => "{name:?} is not written, expected dxf, {names}";
    it_cuts_nothing => "it cuts nothing";
    a_drawing_is_no_program => "it is a drawing, expected a program (.3b, .iso)";
    a_program_is_no_drawing => "it is a program, expected a drawing (.dxf)";
}
