//! What a setting may be.

declare! {
    a_number_above(least) => "a number above {least}";
    a_number_of_or_above(least) => "a number of {least} or above";
    a_number_from_to(least, most) => "a number from {least} to {most}";
    a_whole_number_from_to(least, most) => "a whole number from {least} to {most}";
    a_list_of_numbers_one_for_each_pass => "a list of numbers above 0, one for each pass";
    a_list_of_words => "a list of words of letters and digits such as [\"D1\", \"D2\"]";
    a_list_of_lines => "a list of lines such as [\"G90\"]";
    one_line_of_text => "one line of text";
    one_line_without_control_characters => "one line without control characters";
    the_path_of_a_drawing => "the path of a drawing, .dxf or .dxb";
    an_address_with_rule_in_it => "an address such as https://edm.example/rules/{rule}.html, in which {rule} stands for the rule's name";
    the_name_of_a_profile => "the name of a profile";
    true_or_false => "true or false";
    a_table => "a table";
    a_list => "a list";
    not_set => "not set";
    a_point => "a point [x, y]";
    a_word_of_letters_and_digits => "a word of letters and digits such as \"DD\"";
    colors_that_are_known => "red, yellow, green, cyan, blue, magenta, white, a number from 1 to 255 or #rrggbb";
    the_reason_in_words => "the reason in words";
    did_you_mean_of(expected, near) => "{expected}: did you mean {near}?";
    is_not_known_did_you_mean(key, near) => "{key} is not known, did you mean {near}?";
    suppresses_nothing(handle, rule) => "the suppression of {rule} at {handle} suppresses nothing here: take it out";
    no_contour_of_that_name(drawing, key) => "nothing in this drawing is {key}: what [drawings.\"{drawing}\".contours] says of it holds for nothing";
    one_or_other(ones, other) => "{ones} or {other}";
    is_not_what_is_expected(key, found, expected) => "{key} is {found}, expected {expected}";
    is_empty(key, expected) => "{key} is empty, expected {expected}";
    is_not_known(key, expected) => "{key} is not known, expected {expected}";
    holds_an_unknown_name(key, name) => "{key} holds {name}, expected {{x}}, {{y}}, {{side}} or {{register}}";
    there_is_no_profile(name, names) => "there is no profile {name:?}, expected {names}";
    is_more_than_the_pass_before(pass, correction, before) => "{pass} is {correction}, expected at most {before}, that of the pass before: corrections fall";
    is_of_passes_expected_one_for_each(key, count, passes) => "{key} is a list of {count}, expected one for each of the {passes} passes";
    is_less_than_the_wire_radius(pass, correction, radius) => "{pass} is {correction}, expected at least the wire's radius {radius}: the wire would cut into the part";
    a_list_of_layers => "a list of names of layers such as [\"PUNCH\"]";
    the_name_of_a_layer => "the name of a layer";
    a_fit_needs(key, missing) => "{key} asks whether the parts fit: expected {missing} beside it";
    a_pair_without_partner(key) => "{key} has no pair: expected pair.drawn-as where a contour is cut twice, or two workpieces where both parts are drawn";
    a_pair_without_clearance(key) => "{key} says nothing without pair.clearance: expected the clearance, mm a side";
    a_pair_drawn_and_cut_twice(key) => "{key} says that each contour is cut twice, workpieces that both parts are drawn: expected one of the two";
    a_pair_on_one_side(key, side) => "{key} says that each contour is cut from both sides, but side is {side}: expected both";
    an_extra_needs_a_drawn_part(key) => "{key} needs a contour that is cut for several parts: expected pair.drawn-as beside it";
    a_layer_in_two_workpieces(layer, one, other) => "the layer {layer} is of the workpieces {one} and {other}: expected one of them";
    the_file_has_too_many_bytes(bytes, most) => "the file has {bytes} bytes, expected at most {most}: none of it holds";
    not_toml(reason) => "not TOML: {reason}";
}
