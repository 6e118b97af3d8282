//! What group codes mean, record by record, and in which section a record stands. Facts of the public DXF reference.

/// What a value is, as far as more can be said of it than its digits.
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

use Value::{Bulge, Degrees, Handle, Length, OwnHandle, Plain};

type Codes = &'static [(i16, &'static str, Value)];

/// Codes of every record.
const COMMON: Codes = &[
    (0, "name of the record that begins here", Plain),
    (5, "handle of the record (hexadecimal)", OwnHandle),
    (
        100,
        "subclass: which class the following codes belong to",
        Plain,
    ),
    (
        102,
        "begin or end of a group of another program, in braces",
        Plain,
    ),
    (330, "handle of the owner", Handle),
    (360, "handle of an owned record", Handle),
    (999, "comment", Plain),
];

/// Codes of every entity.
const ENTITY: Codes = &[
    (6, "name of the linetype", Plain),
    (8, "name of the layer", Plain),
    (39, "thickness", Length),
    (48, "scale of the linetype", Plain),
    (60, "visibility: 0 visible, 1 invisible", Plain),
    (
        62,
        "colour number: 0 by block, 256 by layer, 257 by entity",
        Plain,
    ),
    (67, "space: 0 model space, 1 paper space", Plain),
    (92, "number of bytes of the preview picture", Plain),
    (347, "handle of the material", Handle),
    (
        370,
        "line weight in hundredths of a millimetre; -1 by layer, -2 by block, -3 default",
        Plain,
    ),
    (390, "handle of the plot style", Handle),
    (410, "name of the layout", Plain),
    (420, "true colour, 24 bits red, green, blue", Plain),
    (430, "name of the colour", Plain),
    (440, "transparency", Plain),
    (210, "extrusion direction, x", Plain),
    (220, "extrusion direction, y", Plain),
    (230, "extrusion direction, z", Plain),
];

/// Codes of one kind of record; they go before the common ones.
const OF_RECORD: &[(&[&str], Codes)] = &[
    (
        &["SECTION"],
        &[
            (2, "name of the section", Plain),
            (9, "name of a header variable; its value follows", Plain),
        ],
    ),
    (
        &["TABLE"],
        &[
            (2, "name of the table", Plain),
            (5, "handle of the table", OwnHandle),
            (70, "largest number of entries", Plain),
        ],
    ),
    (
        &["LAYER"],
        &[
            (2, "name of the layer", Plain),
            (
                70,
                "flags: 1 frozen, 2 frozen in new viewports, 4 locked",
                Plain,
            ),
            (62, "colour number; negative when the layer is off", Plain),
            (6, "name of the linetype", Plain),
            (290, "plotted: 0 no, 1 yes", Plain),
            (370, "line weight in hundredths of a millimetre", Plain),
            (390, "handle of the plot style", Handle),
            (347, "handle of the material", Handle),
            (420, "true colour, 24 bits red, green, blue", Plain),
        ],
    ),
    (
        &["LTYPE"],
        &[
            (2, "name of the linetype", Plain),
            (3, "description", Plain),
            (70, "flags", Plain),
            (72, "alignment, always 65", Plain),
            (73, "number of dashes", Plain),
            (40, "length of the pattern", Length),
            (49, "length of a dash; negative is a gap", Length),
            (74, "kind of the element", Plain),
        ],
    ),
    (
        &["STYLE"],
        &[
            (2, "name of the text style", Plain),
            (3, "font file", Plain),
            (4, "big font file", Plain),
            (40, "fixed text height; 0 is not fixed", Length),
            (41, "width factor", Plain),
            (42, "height used last", Length),
            (50, "oblique angle", Degrees),
            (70, "flags", Plain),
            (71, "text generation: 2 backwards, 4 upside down", Plain),
        ],
    ),
    (
        &["BLOCK_RECORD"],
        &[
            (2, "name of the block", Plain),
            (340, "handle of the layout", Handle),
            (70, "units of the block", Plain),
        ],
    ),
    (
        &["DIMSTYLE"],
        &[
            (105, "handle of the record (hexadecimal)", OwnHandle),
            (2, "name of the dimension style", Plain),
        ],
    ),
    (
        &["VPORT", "APPID", "UCS", "VIEW"],
        &[(2, "name of the entry", Plain), (70, "flags", Plain)],
    ),
    (
        &["BLOCK"],
        &[
            (2, "name of the block", Plain),
            (3, "name of the block, again", Plain),
            (8, "name of the layer", Plain),
            (
                70,
                "flags: 1 anonymous, 2 has attributes, 4 external reference",
                Plain,
            ),
            (10, "base point, x", Length),
            (20, "base point, y", Length),
            (30, "base point, z", Length),
            (1, "path of the external reference", Plain),
        ],
    ),
    (
        &["LINE"],
        &[
            (10, "start point, x", Length),
            (20, "start point, y", Length),
            (30, "start point, z", Length),
            (11, "end point, x", Length),
            (21, "end point, y", Length),
            (31, "end point, z", Length),
        ],
    ),
    (
        &["CIRCLE", "ARC"],
        &[
            (10, "centre, x", Length),
            (20, "centre, y", Length),
            (30, "centre, z", Length),
            (40, "radius", Length),
            (50, "start angle; the arc runs counter-clockwise", Degrees),
            (51, "end angle; the arc runs counter-clockwise", Degrees),
        ],
    ),
    (
        &["LWPOLYLINE"],
        &[
            (90, "number of vertices", Plain),
            (70, "flags: 1 closed, 128 linetype runs through", Plain),
            (43, "constant width", Length),
            (38, "elevation", Length),
            (10, "vertex, x", Length),
            (20, "vertex, y", Length),
            (91, "identifier of the vertex", Plain),
            (40, "width at the start of the segment", Length),
            (41, "width at the end of the segment", Length),
            (
                42,
                "bulge of the segment that starts in this vertex: tan(sweep / 4), positive counter-clockwise, 0 is a line",
                Bulge,
            ),
        ],
    ),
    (
        &["POLYLINE"],
        &[
            (66, "vertices follow: always 1", Plain),
            (
                70,
                "flags: 1 closed, 2 curve fit, 4 spline fit, 8 in space, 16 mesh, 64 polyface",
                Plain,
            ),
            (10, "always 0", Plain),
            (20, "always 0", Plain),
            (30, "elevation", Length),
            (40, "width at the start", Length),
            (41, "width at the end", Length),
            (71, "mesh: vertices in M", Plain),
            (72, "mesh: vertices in N", Plain),
            (75, "smoothing: 5 quadratic, 6 cubic, 8 Bézier", Plain),
        ],
    ),
    (
        &["VERTEX"],
        &[
            (10, "vertex, x", Length),
            (20, "vertex, y", Length),
            (30, "vertex, z", Length),
            (40, "width at the start of the segment", Length),
            (41, "width at the end of the segment", Length),
            (
                42,
                "bulge of the segment that starts in this vertex: tan(sweep / 4), positive counter-clockwise, 0 is a line",
                Bulge,
            ),
            (50, "direction of the tangent of a curve fit", Degrees),
            (
                70,
                "flags: 1 made by curve fit, 2 has a tangent, 8 made by spline fit, 16 control point",
                Plain,
            ),
        ],
    ),
    (
        &["POINT"],
        &[
            (10, "position, x", Length),
            (20, "position, y", Length),
            (30, "position, z", Length),
            (50, "angle of the x axis", Degrees),
        ],
    ),
    (
        &["TEXT", "ATTRIB", "ATTDEF"],
        &[
            (1, "the text", Plain),
            (2, "tag of the attribute", Plain),
            (3, "prompt", Plain),
            (7, "name of the text style", Plain),
            (10, "position, x", Length),
            (20, "position, y", Length),
            (30, "position, z", Length),
            (11, "alignment point, x", Length),
            (21, "alignment point, y", Length),
            (31, "alignment point, z", Length),
            (40, "text height", Length),
            (41, "width factor", Plain),
            (50, "rotation", Degrees),
            (51, "oblique angle", Degrees),
            (71, "text generation: 2 backwards, 4 upside down", Plain),
            (
                72,
                "horizontal alignment: 0 left, 1 centre, 2 right, 3 aligned, 4 middle, 5 fit",
                Plain,
            ),
            (
                73,
                "vertical alignment: 0 baseline, 1 bottom, 2 middle, 3 top",
                Plain,
            ),
        ],
    ),
    (
        &["MTEXT"],
        &[
            (1, "the text, or its last part", Plain),
            (3, "a part of the text that goes on", Plain),
            (7, "name of the text style", Plain),
            (10, "position, x", Length),
            (20, "position, y", Length),
            (30, "position, z", Length),
            (40, "text height", Length),
            (41, "width of the column", Length),
            (50, "rotation, in radians", Plain),
            (71, "attachment: 1 top left to 9 bottom right", Plain),
            (
                72,
                "direction: 1 left to right, 3 top to bottom, 5 by style",
                Plain,
            ),
        ],
    ),
    (
        &["INSERT"],
        &[
            (2, "name of the block", Plain),
            (10, "insertion point, x", Length),
            (20, "insertion point, y", Length),
            (30, "insertion point, z", Length),
            (41, "scale in x", Plain),
            (42, "scale in y", Plain),
            (43, "scale in z", Plain),
            (50, "rotation", Degrees),
            (66, "attributes follow: 1 yes", Plain),
            (70, "number of columns", Plain),
            (71, "number of rows", Plain),
            (44, "distance of the columns", Length),
            (45, "distance of the rows", Length),
        ],
    ),
    (
        &["ELLIPSE"],
        &[
            (10, "centre, x", Length),
            (20, "centre, y", Length),
            (30, "centre, z", Length),
            (11, "end of the major axis, x from the centre", Length),
            (21, "end of the major axis, y from the centre", Length),
            (31, "end of the major axis, z from the centre", Length),
            (40, "ratio of the minor to the major axis", Plain),
            (41, "start parameter, in radians", Plain),
            (42, "end parameter, in radians", Plain),
        ],
    ),
    (
        &["SPLINE"],
        &[
            (
                70,
                "flags: 1 closed, 2 periodic, 4 rational, 8 planar, 16 linear",
                Plain,
            ),
            (71, "degree", Plain),
            (72, "number of knots", Plain),
            (73, "number of control points", Plain),
            (74, "number of fit points", Plain),
            (40, "knot", Plain),
            (41, "weight of a control point", Plain),
            (42, "tolerance of the knots", Plain),
            (43, "tolerance of the control points", Plain),
            (44, "tolerance of the fit", Plain),
            (10, "control point, x", Length),
            (20, "control point, y", Length),
            (30, "control point, z", Length),
            (11, "fit point, x", Length),
            (21, "fit point, y", Length),
            (31, "fit point, z", Length),
            (12, "tangent at the start, x", Plain),
            (22, "tangent at the start, y", Plain),
            (32, "tangent at the start, z", Plain),
            (13, "tangent at the end, x", Plain),
            (23, "tangent at the end, y", Plain),
            (33, "tangent at the end, z", Plain),
        ],
    ),
    (
        &["DICTIONARY"],
        &[
            (3, "name of an entry", Plain),
            (350, "handle of the entry", Handle),
            (281, "what happens to doubles", Plain),
        ],
    ),
];

/// Records that are no entities: what entities have in common is not theirs.
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

/// What `code` means in a record of this name, and what its value is.
pub(super) fn meaning(record: &str, code: i16) -> (&'static str, Value) {
    let own = codes_of(record).find(|(known, _, _)| *known == code);
    own.map_or_else(|| by_range(code), |(_, text, value)| (text, value))
}

/// The codes that make sense in a record of this name, those of its own kind first; each once.
pub(super) fn codes_of(record: &str) -> impl Iterator<Item = (i16, &'static str, Value)> + use<> {
    let own: Codes = OF_RECORD
        .iter()
        .find(|(names, _)| names.contains(&record))
        .map_or(&[], |(_, codes)| codes);
    let entity: Codes = if NO_ENTITY.contains(&record) {
        &[]
    } else {
        ENTITY
    };
    let is_own = move |code: i16| own.iter().any(|(known, _, _)| *known == code);
    // DIMSTYLE has its handle behind 105: its 5 is the name of an arrow head.
    let no_handle = record == "DIMSTYLE";
    let is_circle = record == "CIRCLE";
    let rest = entity
        .iter()
        .chain(COMMON)
        .filter(move |(code, _, _)| !(is_own(*code) || no_handle && *code == 5));
    own.iter()
        .filter(move |(code, _, _)| !(is_circle && matches!(code, 50 | 51)))
        .chain(rest)
        .copied()
}

/// What a code holds wherever nothing more is known of it.
fn by_range(code: i16) -> (&'static str, Value) {
    match code {
        5 | 105 => ("handle", OwnHandle),
        0..=9 => ("text", Plain),
        10..=18 => ("x of a point", Plain),
        20..=28 => ("y of a point", Plain),
        30..=37 => ("z of a point", Plain),
        38..=49 | 59 | 140..=149 | 460..=469 => ("number", Plain),
        50..=58 => ("angle", Degrees),
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 => ("whole number", Plain),
        90..=99 | 160..=169 | 420..=429 | 440..=459 => ("whole number of 32 bits or more", Plain),
        101 => ("begin of an embedded object", Plain),
        110..=139 | 210..=239 => ("number of a point or vector", Plain),
        290..=299 => ("0 or 1", Plain),
        300..=309 | 410..=419 | 430..=439 | 470..=479 => ("text", Plain),
        310..=319 | 1004 => ("bytes, hexadecimal", Plain),
        320..=329 | 480..=481 | 1005 => ("handle of a record", Handle),
        330..=339 => ("handle of a record (soft pointer)", Handle),
        340..=349 | 390..=399 => ("handle of a record (hard pointer)", Handle),
        350..=359 => ("handle of a record (soft owner)", Handle),
        360..=369 => ("handle of a record (hard owner)", Handle),
        1000 => ("text of another program", Plain),
        1001 => (
            "name of the program that the following codes belong to",
            Plain,
        ),
        1002 => ("brace of a list of another program", Plain),
        1003 => ("name of a layer, of another program", Plain),
        1010..=1059 => ("number of another program", Plain),
        1060..=1071 => ("whole number of another program", Plain),
        _ => ("no meaning that is known here", Plain),
    }
}

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

/// Names of records that can stand in a section, with what they are.
pub(super) fn records_of(section: &str) -> &'static [(&'static str, &'static str)] {
    match section {
        "TABLES" => &[
            ("TABLE", "begins a table"),
            ("ENDTAB", "ends a table"),
            ("LAYER", "a layer"),
            ("LTYPE", "a linetype"),
            ("STYLE", "a text style"),
            ("APPID", "a registered program"),
            ("BLOCK_RECORD", "a block's entry"),
            ("DIMSTYLE", "a dimension style"),
            ("ENDSEC", "ends the section"),
        ],
        "BLOCKS" | "ENTITIES" => &[
            ("LWPOLYLINE", "polyline of lines and arcs"),
            ("LINE", "line between two points"),
            ("ARC", "arc of a circle"),
            ("CIRCLE", "circle"),
            ("POLYLINE", "polyline with VERTEX records"),
            ("VERTEX", "vertex of a POLYLINE"),
            ("SEQEND", "ends a POLYLINE or the attributes of an INSERT"),
            ("SPLINE", "B-spline"),
            ("ELLIPSE", "ellipse or a part of one"),
            ("INSERT", "a block put in place"),
            ("POINT", "point"),
            ("TEXT", "one line of text"),
            ("MTEXT", "text of several lines"),
            ("BLOCK", "begins a block (section BLOCKS)"),
            ("ENDBLK", "ends a block (section BLOCKS)"),
            ("ENDSEC", "ends the section"),
        ],
        "" => &[("SECTION", "begins a section"), ("EOF", "end of the file")],
        "OBJECTS" => &[
            ("DICTIONARY", "names and handles"),
            ("ENDSEC", "ends the section"),
        ],
        _ => &[("ENDSEC", "ends the section")],
    }
}

/// Header variables that bear on a cut, with what they say.
pub(super) const VARIABLES: &[(&str, &str)] = &[
    (
        "$ACADVER",
        "version of the file: AC1009 is R12, AC1015 is 2000, AC1032 is 2018",
    ),
    ("$DWGCODEPAGE", "code page of texts in files before 2007"),
    (
        "$INSUNITS",
        "unit of the drawing: 1 inch, 4 millimetre, 5 centimetre, 6 metre, 0 none",
    ),
    (
        "$MEASUREMENT",
        "0 imperial, 1 metric: chooses patterns, says nothing about the unit",
    ),
    ("$LUNITS", "how lengths are written"),
    ("$EXTMIN", "lower left corner of what is drawn"),
    ("$EXTMAX", "upper right corner of what is drawn"),
    ("$LIMMIN", "lower left corner of the limits"),
    ("$LIMMAX", "upper right corner of the limits"),
    ("$HANDSEED", "the next handle that is free"),
    ("$CLAYER", "name of the current layer"),
];
