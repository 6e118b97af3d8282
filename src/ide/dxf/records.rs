//! Records and header variables: their sections and meanings.

use super::codes::About;
use crate::message::said;

/// A name that DXF knows, and its meaning.
pub(super) type Named = (&'static str, About);

pub(super) const SECTIONS: [&str; 7] = [
    "HEADER",
    "CLASSES",
    "TABLES",
    "BLOCKS",
    "ENTITIES",
    "OBJECTS",
    "THUMBNAILIMAGE",
];
pub(super) const TABLES: [&str; 9] = [
    "VPORT",
    "LTYPE",
    "LAYER",
    "STYLE",
    "VIEW",
    "UCS",
    "APPID",
    "DIMSTYLE",
    "BLOCK_RECORD",
];

/// Names of records that can stand in a section, with their meanings.
pub(super) fn records_of(section: &str) -> &'static [Named] {
    match section {
        "TABLES" => &[
            ("TABLE", said::begins_a_table),
            ("ENDTAB", said::ends_a_table),
            ("LAYER", said::a_layer),
            ("LTYPE", said::a_linetype),
            ("STYLE", said::a_text_style),
            ("APPID", said::a_registered_program),
            ("BLOCK_RECORD", said::a_block_s_entry),
            ("DIMSTYLE", said::a_dimension_style),
            ("ENDSEC", said::ends_the_section),
        ],
        "BLOCKS" | "ENTITIES" => &[
            ("LWPOLYLINE", said::polyline_of_lines_and_arcs),
            ("LINE", said::line_between_two_points),
            ("ARC", said::arc_of_a_circle),
            ("CIRCLE", said::a_circle),
            ("POLYLINE", said::polyline_with_vertex_records),
            ("VERTEX", said::vertex_of_a_polyline),
            (
                "SEQEND",
                said::ends_a_polyline_or_the_attributes_of_an_insert,
            ),
            ("SPLINE", said::a_b_spline),
            ("ELLIPSE", said::ellipse_or_a_part_of_one),
            ("INSERT", said::a_block_put_in_place),
            ("POINT", said::a_point_entity),
            ("TEXT", said::one_line_of_text),
            ("MTEXT", said::text_of_several_lines),
            ("BLOCK", said::begins_a_block_section_blocks),
            ("ENDBLK", said::ends_a_block_section_blocks),
            ("ENDSEC", said::ends_the_section),
        ],
        "" => &[
            ("SECTION", said::begins_a_section),
            ("EOF", said::end_of_the_file),
        ],
        "OBJECTS" => &[
            ("DICTIONARY", said::names_and_handles),
            ("ENDSEC", said::ends_the_section),
        ],
        _ => &[("ENDSEC", said::ends_the_section)],
    }
}

/// Header variables that matter for a cut, with their meanings.
pub(super) const VARIABLES: &[Named] = &[
    ("$ACADVER", said::version_of_the_file),
    (
        "$DWGCODEPAGE",
        said::code_page_of_texts_in_files_before_2007,
    ),
    ("$INSUNITS", said::unit_of_the_drawing),
    ("$MEASUREMENT", said::imperial_or_metric_patterns),
    ("$LUNITS", said::how_lengths_are_written),
    ("$EXTMIN", said::lower_left_corner_of_what_is_drawn),
    ("$EXTMAX", said::upper_right_corner_of_what_is_drawn),
    ("$LIMMIN", said::lower_left_corner_of_the_limits),
    ("$LIMMAX", said::upper_right_corner_of_the_limits),
    ("$HANDSEED", said::the_next_handle_that_is_free),
    ("$CLAYER", said::name_of_the_current_layer),
];
