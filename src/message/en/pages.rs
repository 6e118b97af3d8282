//! The pages of `wedm report`.

declare! {
    no_drawing_for_a_report => "there is no drawing, expected .dxf";
    pages_are_written(written, pages, index) => "{written} {pages}: {index}";
    pages(count: usize) => { if *count == 1 { "1 page".into() } else { format!("{count} pages") } };
    report_of_drawings(count: usize) => { if *count == 1 { "Report of 1 drawing".into() } else { format!("Report of {count} drawings") } };
    head_contours => "Contours";
    head_findings => "Findings";
    head_radius_list => "Radius list";
    head_passes => "Passes";
    head_program => "Program";
    column_drawing => "drawing";
    column_number => "no.";
    column_kind => "kind";
    column_role => "role";
    column_length => "contour mm";
    column_area => "area mm²";
    column_order => "cut as no.";
    column_found => "what is found";
    column_place => "where";
    column_turn => "arc °";
    column_entity => "entity";
    column_segment => "segment";
    column_verdict => "verdict";
    column_pass => "pass";
    column_correction => "correction mm";
    column_contours => "contours";
    column_length_with_leads => "cut mm";
    column_smallest_radius => "smallest R mm";
    column_blocks => "blocks";
    head_time_and_material => "Time and material";
    head_start_holes => "Start holes";
    head_fit => "Fit";
    column_contour => "contour";
    column_hole => "hole";
    hole_given => "given";
    hole_found => "found";
    column_minutes => "min";
    column_slug => "slug g";
    column_left => "µm left";
    column_part => "part";
    the_cut_is_long(length) => "cut: {length:.3} mm";
    the_jumps_are_long(length) => "jumps: {length:.3} mm";
    cut_off_in_pass(pass) => "cut-off, pass {pass}";
    a_program_and_its_proof(language, blocks, contours, length, deviation) => "{language}: {blocks}, {contours}, {length}; decoded again, at most {deviation:.2} µm from the path";
    its_text => "text";
    and_more_of_them(count) => "and {count} more";
}
