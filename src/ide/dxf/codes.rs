//! The meanings of group codes, record by record, and the section of each record. Facts of the public DXF reference.

use crate::message::said;
use std::borrow::Cow;

/// The kind of a value, if that says more than its digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Value {
    Plain,
    /// Drawing units.
    Length,
    Degrees,
    /// The handle of the record itself.
    OwnHandle,
    /// The handle of another record.
    Handle,
    Bulge,
}

/// An entry of the tables: a value, or the first coordinate of several, whose codes are ten apart.
#[derive(Clone, Copy)]
enum Holds {
    One(Value),
    Coordinates(usize, Value),
}

const PLAIN: Holds = Holds::One(Value::Plain);
const LENGTH: Holds = Holds::One(Value::Length);
const DEGREES: Holds = Holds::One(Value::Degrees);
const OWN_HANDLE: Holds = Holds::One(Value::OwnHandle);
const HANDLE: Holds = Holds::One(Value::Handle);
const BULGE: Holds = Holds::One(Value::Bulge);
const POINT: Holds = Holds::Coordinates(3, Value::Length);
const POINT_IN_PLANE: Holds = Holds::Coordinates(2, Value::Length);
const DIRECTION: Holds = Holds::Coordinates(3, Value::Plain);

/// The meaning of a code, in the language in force.
pub(super) type About = fn() -> &'static str;
/// A group code, its meaning, and the kind of its value.
pub(super) type Code = (i16, Cow<'static, str>, Value);
type Row = (i16, About, Holds);
type Codes = &'static [Row];

/// Codes of every record.
const COMMON: Codes = &[
    (0, said::name_of_the_record_that_begins_here, PLAIN),
    (5, said::handle_of_the_record_hexadecimal, OWN_HANDLE),
    (100, said::class_of_the_following_codes, PLAIN),
    (102, said::group_of_another_program, PLAIN),
    (330, said::handle_of_the_owner, HANDLE),
    (360, said::handle_of_an_owned_record, HANDLE),
    (999, said::a_comment, PLAIN),
];

/// Codes of every entity.
const ENTITY: Codes = &[
    (6, said::name_of_the_linetype, PLAIN),
    (8, said::name_of_the_layer, PLAIN),
    (39, said::thickness, LENGTH),
    (48, said::scale_of_the_linetype, PLAIN),
    (60, said::visibility_0_visible_1_invisible, PLAIN),
    (62, said::colour_number_of_an_entity, PLAIN),
    (67, said::space_0_model_space_1_paper_space, PLAIN),
    (92, said::number_of_bytes_of_the_preview_picture, PLAIN),
    (347, said::handle_of_the_material, HANDLE),
    (370, said::line_weight_of_an_entity, PLAIN),
    (390, said::handle_of_the_plot_style, HANDLE),
    (410, said::name_of_the_layout, PLAIN),
    (420, said::true_colour_24_bits_red_green_blue, PLAIN),
    (430, said::name_of_the_colour, PLAIN),
    (440, said::transparency, PLAIN),
    (210, said::extrusion_direction, DIRECTION),
];

/// Codes of one kind of record; they take precedence over the common ones.
const OF_RECORD: &[(&[&str], Codes)] = &[
    (
        &["SECTION"],
        &[
            (2, said::name_of_the_section, PLAIN),
            (9, said::name_of_a_header_variable_its_value_follows, PLAIN),
        ],
    ),
    (
        &["TABLE"],
        &[
            (2, said::name_of_the_table, PLAIN),
            (5, said::handle_of_the_table, OWN_HANDLE),
            (70, said::largest_number_of_entries, PLAIN),
        ],
    ),
    (
        &["LAYER"],
        &[
            (2, said::name_of_the_layer, PLAIN),
            (70, said::flags_of_a_layer, PLAIN),
            (62, said::colour_number_of_a_layer, PLAIN),
            (6, said::name_of_the_linetype, PLAIN),
            (290, said::plotted_0_no_1_yes, PLAIN),
            (370, said::line_weight_in_hundredths_of_a_millimetre, PLAIN),
            (390, said::handle_of_the_plot_style, HANDLE),
            (347, said::handle_of_the_material, HANDLE),
            (420, said::true_colour_24_bits_red_green_blue, PLAIN),
        ],
    ),
    (
        &["LTYPE"],
        &[
            (2, said::name_of_the_linetype, PLAIN),
            (3, said::the_description, PLAIN),
            (70, said::flags, PLAIN),
            (72, said::alignment_always_65, PLAIN),
            (73, said::number_of_dashes, PLAIN),
            (40, said::length_of_the_pattern, LENGTH),
            (49, said::length_of_a_dash_negative_is_a_gap, LENGTH),
            (74, said::kind_of_the_element, PLAIN),
        ],
    ),
    (
        &["STYLE"],
        &[
            (2, said::name_of_the_text_style, PLAIN),
            (3, said::font_file, PLAIN),
            (4, said::big_font_file, PLAIN),
            (40, said::fixed_text_height_0_is_not_fixed, LENGTH),
            (41, said::width_factor, PLAIN),
            (42, said::height_used_last, LENGTH),
            (50, said::oblique_angle, DEGREES),
            (70, said::flags, PLAIN),
            (71, said::text_generation, PLAIN),
        ],
    ),
    (
        &["BLOCK_RECORD"],
        &[
            (2, said::name_of_the_block, PLAIN),
            (340, said::handle_of_the_layout, HANDLE),
            (70, said::units_of_the_block, PLAIN),
        ],
    ),
    (
        &["DIMSTYLE"],
        &[
            (105, said::handle_of_the_record_hexadecimal, OWN_HANDLE),
            (2, said::name_of_the_dimension_style, PLAIN),
        ],
    ),
    (
        &["VPORT", "APPID", "UCS", "VIEW"],
        &[
            (2, said::name_of_the_entry, PLAIN),
            (70, said::flags, PLAIN),
        ],
    ),
    (
        &["BLOCK"],
        &[
            (2, said::name_of_the_block, PLAIN),
            (3, said::name_of_the_block_again, PLAIN),
            (8, said::name_of_the_layer, PLAIN),
            (70, said::flags_of_a_block, PLAIN),
            (10, said::base_point, POINT),
            (1, said::path_of_the_external_reference, PLAIN),
        ],
    ),
    (
        &["LINE"],
        &[(10, said::start_point, POINT), (11, said::end_point, POINT)],
    ),
    (
        &["CIRCLE", "ARC"],
        &[
            (10, said::centre, POINT),
            (40, said::radius, LENGTH),
            (50, said::start_angle_of_the_arc, DEGREES),
            (51, said::end_angle_of_the_arc, DEGREES),
        ],
    ),
    (
        &["LWPOLYLINE"],
        &[
            (90, said::how_many_vertices, PLAIN),
            (70, said::flags_of_an_lwpolyline, PLAIN),
            (43, said::constant_width, LENGTH),
            (38, said::elevation, LENGTH),
            (10, said::vertex, POINT_IN_PLANE),
            (91, said::identifier_of_the_vertex, PLAIN),
            (40, said::width_at_the_start_of_the_segment, LENGTH),
            (41, said::width_at_the_end_of_the_segment, LENGTH),
            (42, said::bulge_of_the_segment, BULGE),
        ],
    ),
    (
        &["POLYLINE"],
        &[
            (66, said::vertices_follow_always_1, PLAIN),
            (70, said::flags_of_a_polyline, PLAIN),
            (10, said::always_0, PLAIN),
            (20, said::always_0, PLAIN),
            (30, said::elevation, LENGTH),
            (40, said::width_at_the_start, LENGTH),
            (41, said::width_at_the_end, LENGTH),
            (71, said::mesh_vertices_in_m, PLAIN),
            (72, said::mesh_vertices_in_n, PLAIN),
            (75, said::smoothing, PLAIN),
        ],
    ),
    (
        &["VERTEX"],
        &[
            (10, said::vertex, POINT),
            (40, said::width_at_the_start_of_the_segment, LENGTH),
            (41, said::width_at_the_end_of_the_segment, LENGTH),
            (42, said::bulge_of_the_segment, BULGE),
            (50, said::direction_of_the_tangent_of_a_curve_fit, DEGREES),
            (70, said::flags_of_a_vertex, PLAIN),
        ],
    ),
    (
        &["POINT"],
        &[
            (10, said::position, POINT),
            (50, said::angle_of_the_x_axis, DEGREES),
        ],
    ),
    (
        &["TEXT", "ATTRIB", "ATTDEF"],
        &[
            (1, said::the_text, PLAIN),
            (2, said::tag_of_the_attribute, PLAIN),
            (3, said::the_prompt, PLAIN),
            (7, said::name_of_the_text_style, PLAIN),
            (10, said::position, POINT),
            (11, said::alignment_point, POINT),
            (40, said::text_height, LENGTH),
            (41, said::width_factor, PLAIN),
            (50, said::rotation, DEGREES),
            (51, said::oblique_angle, DEGREES),
            (71, said::text_generation, PLAIN),
            (72, said::horizontal_alignment, PLAIN),
            (73, said::vertical_alignment, PLAIN),
        ],
    ),
    (
        &["MTEXT"],
        &[
            (1, said::the_text_or_its_last_part, PLAIN),
            (3, said::a_part_of_the_text_that_goes_on, PLAIN),
            (7, said::name_of_the_text_style, PLAIN),
            (10, said::position, POINT),
            (40, said::text_height, LENGTH),
            (41, said::width_of_the_column, LENGTH),
            (50, said::rotation_in_radians, PLAIN),
            (71, said::attachment_of_the_text, PLAIN),
            (72, said::direction_of_the_text, PLAIN),
        ],
    ),
    (
        &["INSERT"],
        &[
            (2, said::name_of_the_block, PLAIN),
            (10, said::insertion_point, POINT),
            (41, said::scale_in_x, PLAIN),
            (42, said::scale_in_y, PLAIN),
            (43, said::scale_in_z, PLAIN),
            (50, said::rotation, DEGREES),
            (66, said::attributes_follow_1_yes, PLAIN),
            (70, said::number_of_columns, PLAIN),
            (71, said::number_of_rows, PLAIN),
            (44, said::distance_of_the_columns, LENGTH),
            (45, said::distance_of_the_rows, LENGTH),
        ],
    ),
    (
        &["ELLIPSE"],
        &[
            (10, said::centre, POINT),
            (11, said::end_of_the_major_axis_x_from_the_centre, LENGTH),
            (21, said::end_of_the_major_axis_y_from_the_centre, LENGTH),
            (31, said::end_of_the_major_axis_z_from_the_centre, LENGTH),
            (40, said::ratio_of_the_minor_to_the_major_axis, PLAIN),
            (41, said::start_parameter_in_radians, PLAIN),
            (42, said::end_parameter_in_radians, PLAIN),
        ],
    ),
    (
        &["SPLINE"],
        &[
            (70, said::flags_of_a_spline, PLAIN),
            (71, said::the_degree, PLAIN),
            (72, said::number_of_knots, PLAIN),
            (73, said::number_of_control_points, PLAIN),
            (74, said::number_of_fit_points, PLAIN),
            (40, said::a_knot, PLAIN),
            (41, said::weight_of_a_control_point, PLAIN),
            (42, said::tolerance_of_the_knots, PLAIN),
            (43, said::tolerance_of_the_control_points, PLAIN),
            (44, said::tolerance_of_the_fit, PLAIN),
            (10, said::control_point, POINT),
            (11, said::fit_point, POINT),
            (12, said::tangent_at_the_start, DIRECTION),
            (13, said::tangent_at_the_end, DIRECTION),
        ],
    ),
    (
        &["DICTIONARY"],
        &[
            (3, said::name_of_an_entry, PLAIN),
            (350, said::handle_of_the_entry, HANDLE),
            (281, said::what_happens_to_doubles, PLAIN),
        ],
    ),
];

/// Records that are not entities: they lack the common codes of entities.
const NO_ENTITY: [&str; 22] = [
    "SECTION",
    "ENDSEC",
    "TABLE",
    "ENDTAB",
    "EOF",
    "LTYPE",
    "STYLE",
    "BLOCK_RECORD",
    "DIMSTYLE",
    "VPORT",
    "APPID",
    "UCS",
    "VIEW",
    "CLASS",
    "DICTIONARY",
    "XRECORD",
    "LAYOUT",
    "PLACEHOLDER",
    "MATERIAL",
    "MLINESTYLE",
    "LAYER",
    "",
];

/// A row for each coordinate of a point, else the row itself.
fn codes_in((code, about, holds): &Row) -> impl Iterator<Item = Code> + use<> {
    let (first, about) = (*code, about());
    let (count, value, is_point) = match *holds {
        Holds::One(value) => (1, value, false),
        Holds::Coordinates(count, value) => (count, value, true),
    };
    (first..)
        .step_by(10)
        .zip(["x", "y", "z"])
        .take(count)
        .map(move |(code, axis)| {
            let about = match is_point {
                true => say!(coordinate_of, about, axis).into(),
                false => about.into(),
            };
            (code, about, value)
        })
}

/// The meaning of `code` in a record of this name, and the kind of its value.
pub(super) fn meaning(record: &str, code: i16) -> (Cow<'static, str>, Value) {
    let own = codes_of(record)
        .into_iter()
        .find(|(known, _, _)| *known == code);
    own.map_or_else(
        || {
            let (about, value) = by_range(code);
            (about().into(), value)
        },
        |(_, about, value)| (about, value),
    )
}

/// The codes of a record of this name, those of its own kind first; each once.
pub(super) fn codes_of(record: &str) -> Vec<Code> {
    let own = OF_RECORD.iter().find(|(names, _)| names.contains(&record));
    let own: Codes = own.map_or(&[], |(_, codes)| codes);
    let entity: Codes = if NO_ENTITY.contains(&record) {
        &[]
    } else {
        ENTITY
    };
    let mut found: Vec<Code> = Vec::new();
    for code in own.iter().chain(entity).chain(COMMON).flat_map(codes_in) {
        let is_foreign = match record {
            // Its handle stands after 105: its 5 is the name of an arrow head.
            "DIMSTYLE" => code.0 == 5,
            "CIRCLE" => matches!(code.0, 50 | 51),
            _ => false,
        };
        if !is_foreign && found.iter().all(|(known, _, _)| *known != code.0) {
            found.push(code);
        }
    }
    found
}

/// The kind of a code's value where nothing more is known of it.
pub(super) fn value_of(code: i16) -> Value {
    by_range(code).1
}

/// The meaning of a code, and the kind of its value, where nothing more is known of it.
fn by_range(code: i16) -> (About, Value) {
    match code {
        5 | 105 => (said::a_handle, Value::OwnHandle),
        0..=9 => (said::some_text, Value::Plain),
        10..=18 => (said::x_of_a_point, Value::Plain),
        20..=28 => (said::y_of_a_point, Value::Plain),
        30..=37 => (said::z_of_a_point, Value::Plain),
        38..=49 | 59 | 140..=149 | 460..=469 => (said::a_number_of_any_kind, Value::Plain),
        50..=58 => (said::an_angle, Value::Degrees),
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 => {
            (said::whole_number, Value::Plain)
        }
        90..=99 | 160..=169 | 420..=429 | 440..=459 => {
            (said::whole_number_of_32_bits_or_more, Value::Plain)
        }
        101 => (said::begin_of_an_embedded_object, Value::Plain),
        110..=139 | 210..=239 => (said::number_of_a_point_or_vector, Value::Plain),
        290..=299 => (said::zero_or_one, Value::Plain),
        300..=309 | 410..=419 | 430..=439 | 470..=479 => (said::some_text, Value::Plain),
        310..=319 | 1004 => (said::bytes_hexadecimal, Value::Plain),
        320..=329 | 480..=481 | 1005 => (said::handle_of_a_record, Value::Handle),
        330..=339 => (said::handle_of_a_record_soft_pointer, Value::Handle),
        340..=349 | 390..=399 => (said::handle_of_a_record_hard_pointer, Value::Handle),
        350..=359 => (said::handle_of_a_record_soft_owner, Value::Handle),
        360..=369 => (said::handle_of_a_record_hard_owner, Value::Handle),
        1000 => (said::text_of_another_program, Value::Plain),
        1001 => (
            said::name_of_the_program_of_the_following_codes,
            Value::Plain,
        ),
        1002 => (said::brace_of_a_list_of_another_program, Value::Plain),
        1003 => (said::name_of_a_layer_of_another_program, Value::Plain),
        1010..=1059 => (said::number_of_another_program, Value::Plain),
        1060..=1071 => (said::whole_number_of_another_program, Value::Plain),
        _ => (said::no_meaning_that_is_known_here, Value::Plain),
    }
}
