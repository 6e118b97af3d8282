//! What a setting may be.

declare! {
    a_number_above(least) => "a number above {least}";
    a_number_of_or_above(least) => "a number of {least} or above";
    a_number_up_to(most) => "a number up to {most}";
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
    a_point_of_numbers_up_to(most) => "a point [x, y] of numbers up to {most}";
    a_word_of_letters_and_digits => "a word of letters and digits such as \"DD\", which is no part of a block";
    colors_that_are_known => "red, yellow, green, cyan, blue, magenta, white, a number from 1 to 255 or #rrggbb";
    the_reason_in_words => "the reason in words";
    did_you_mean_of(expected, near) => "{expected}: did you mean {near}?";
    is_not_known_did_you_mean(key, near) => "{key} is not known, did you mean {near}?";
    mark_did_you_mean(bearer, mark, near) => "the mark {mark:?} of {bearer} suppresses nothing, expected \"suppress RULE: the reason\": did you mean {near}?";
    mark_is_not_understood(bearer, mark) => "the mark {mark:?} of {bearer} suppresses nothing, expected \"suppress RULE: the reason\"";
    suppresses_nothing(handle, rule) => "the suppression of {rule} at {handle} suppresses nothing here: remove it";
    no_contour_of_that_name(drawing, key) => "nothing in this drawing is {key}: what [drawings.\"{drawing}\".contours] says of it holds for nothing";
    one_or_other(ones, other) => "{ones} or {other}";
    is_not_what_is_expected(key: dyn crate::message::Shown, found: dyn crate::message::Shown, expected: dyn crate::message::Shown) => { format!("{key} is {found}, expected {expected}") };
    is_empty(key: dyn crate::message::Shown, expected: dyn crate::message::Shown) => { format!("{key} is empty, expected {expected}") };
    is_not_known(key: dyn crate::message::Shown, expected: dyn crate::message::Shown) => { format!("{key} is not known, expected {expected}") };
    holds_an_unknown_name(key, name) => "{key} holds {name}, expected {{x}}, {{y}}, {{side}} or {{register}}";
    there_is_no_profile(name, names) => "there is no profile {name:?}, expected {names}";
    is_more_than_the_pass_before(pass, correction, before) => "{pass} is {correction}, expected at most {before}, that of the pass before: corrections decrease";
    is_of_passes_expected_one_for_each(key: dyn crate::message::Shown, count: usize, passes: usize) => {
        match passes {
            1 => format!("{key} is a list of {count}, expected one for the one pass"),
            passes => format!("{key} is a list of {count}, expected one for each of the {passes} passes"),
        }
    };
    is_less_than_the_wire_radius(pass, correction, radius) => "{pass} is {correction}, expected at least the wire's radius {radius}: the wire would cut into the part";
    a_list_of_layers => "a list of names of layers such as [\"PUNCH\"]";
    the_name_of_a_layer => "the name of a layer";
    a_fit_needs(key, missing) => "{key} asks whether the parts fit: expected {missing} as well";
    a_pair_without_partner(key) => "{key} has no pair: expected pair.drawn-as where a contour is cut twice, or two workpieces where both parts are drawn";
    a_pair_without_clearance(key) => "{key} has no effect without pair.clearance: expected the clearance, mm a side";
    a_pair_drawn_and_cut_twice(key) => "{key} says that each contour is cut twice, workpieces that both parts are drawn: expected one of the two";
    a_pair_on_one_side(key, side) => "{key} says that each contour is cut from both sides, but side is {side}: expected both";
    a_pair_on_the_drawn_line(key, other) => "{key} is the clearance of two parts, but {other} is none: both would be cut along the drawn lines themselves; expected path or controller as {other}";
    an_extra_needs_a_drawn_part(key) => "{key} needs a contour that is cut for several parts: expected pair.drawn-as as well";
    a_layer_in_two_workpieces(layer, one, other) => "the layer {layer} belongs to the workpieces {one} and {other}: expected one of them";
    milling_needs(missing) => "milling needs an electrode and its layers: expected {missing} to be set";
    one_word_for_pause_and_end(key, word, other) => "{key} is {word}, and so is {other}: a program cannot pause with the word that ends it";
    is_no_place_of_a_correction(key, word) => "{key} is {word}, which is no place of a correction: expected one such as D1 or H1";
    a_register_of_two_corrections(key, word, correction, other, before) => "{key} is {word}, in which {correction} would have to stand, and so is {other} for {before}: expected a register of its own for each correction";
    the_wire_and_its_gap_cut_beyond(key, correction, half, beyond) => "{key} is {correction}, and the wire with its gap takes {half:.4} mm to either side: it would cut {beyond:.4} mm beyond the contour; expected at least that, or pair.clearance where it is meant";
    a_stop_that_ends(key, word) => "{key} is {word}, which ends the program: what stands would never be cut off";
    a_stop_that_does_not_stop(key, word, pause) => "{key} is {word}, which stops no machine: expected M00 or M01 in ISO, {pause} in 3B";
    the_control_runs_beside_the_drawn_contour(key, other) => "{key} is constant-stock, but {other} is controller: each pass would run beside the drawn contour, as with sharp; expected path as {other}, or sharp";
    passes_on_the_drawn_line(key, other, count) => "{key} lists {count} passes, but {other} is none: the wire runs once along the drawn line itself, and the others have no effect";
    registers_need_the_control(key, other) => "{key} has no effect while {other} is path: the program holds the path of the wire itself, and names no place of a correction";
    a_stock_needs_skims(key, other) => "{key} is constant-stock, which has no effect on one pass: expected {other} of several";
    a_stop_needs_a_tab(key, other) => "{key} has no effect without {other}: nothing is left standing";
    a_step_needs_linear_feed(key, other) => "{key} has no effect unless {other} is linear";
    a_hole_narrower_than_the_wire(key, hole, other, wire) => "{key} is {hole}, expected more than {other}, {wire}: the wire does not go through the hole";
    a_mass_needs_a_height(key) => "{key} is the mass of a slug: expected job.thickness as well";
    a_limit_needs_a_tab(key) => "{key} has no effect without program.tab: expected the length, mm, that an opening with a heavier slug leaves standing";
    a_punch_within_a_punch(inner, outer, others) => "contour {inner} is a punch within the punch {outer}{others}: the wire would cut into that part; make it an opening, or draw it in a workpiece of its own";
    and_more_punches(more) => ", and so are {more} more";
    an_outline_that_may_be_a_copy(copy, outline, thin) => "outline {copy} runs within {thin:.3} mm of outline {outline} everywhere: as a copy of it, it is to be deleted; as a wall so thin, both are to be given their roles; the sides of all that lies within them depend on it";
    a_layer_above_the_depth(key, layer, depth) => "{key} is {layer}, expected at most milling.depth {depth}";
    too_many_layers(key, layer, layers, most) => "{key} is {layer}, which makes {layers:.0} layers of milling.depth, expected at most {most}";
    the_file_has_too_many_bytes(bytes, most) => "the file has {bytes} bytes, expected at most {most}: none of it applies";
    a_value_without_quotes => "the value is missing, or is text without quotes";
    a_key_without_a_sign => "the key has no =";
    a_sign_without_a_key => "there is no key before =";
    a_key_of_other_letters => "the key has other characters than letters, digits, - and _: put it in quotes";
    a_key_that_is_repeated => "the key is repeated";
    text_behind_a_value => "text after the value, expected the end of the line";
    a_bracket_that_is_open => "a bracket is not closed";
    a_quote_that_is_open => "a quote is not closed";
    a_backslash_that_stands_for_nothing => "the backslash stands for nothing: write it twice";
    a_number_that_is_none => "not a number of TOML: expected digits before and after the point, and no 0 in front of others";
    comma_between_words => ", ";
    or_between_words => " or ";
    part_punch => "punch";
    part_plate => "plate";
    part_stripper => "stripper";
    part_holder => "holder";
    one_of(words) => "one of {words}";
    not_toml(reason) => "not TOML: {reason}";
}
