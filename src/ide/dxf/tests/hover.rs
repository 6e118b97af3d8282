//! The hover of the tag under the cursor.

use super::{ALL, INCH, MM, in_entities, with_cursor};
use crate::drawing::Unit;
use crate::ide::dxf::*;
use expect_test::{Expect, expect};

fn check_hover(text: &str, unit: Unit, expected: &Expect) {
    let (document, cursor) = with_cursor(text);
    let text = hover(&document, cursor, unit).map_or_else(|| "nothing".into(), |hover| hover.text);
    expected.assert_eq(&text);
}

#[test]
fn hover_says_what_a_code_means_in_its_entity() {
    let check =
        |text: &str, unit: Unit, expected: Expect| check_hover(&in_entities(text), unit, &expected);
    check(
        "0|CIRCLE|10|0|20|0|4$00|2",
        MM,
        expect!["**40** of CIRCLE: radius"],
    );
    check(
        "0|CIRCLE|10|0|20|0|40|$02",
        INCH,
        expect![[r#"
        **40** of CIRCLE: radius

        50.8 mm"#]],
    );
    check(
        "0|TEXT|10|0|20|0|$040|2",
        MM,
        expect!["**40** of TEXT: text height"],
    );
    check(
        "0|LWPOLYLINE|90|2|70|$0129|10|0|20|0|10|1|20|0",
        MM,
        expect![[r#"
        **70** of LWPOLYLINE: flags: 1 closed, 128 linetype runs through

        closed, linetype runs through"#]],
    );
    check(
        "0|WIPEOUT|$0340|7F",
        MM,
        expect![[r#"
        **340** of WIPEOUT: handle of a record (hard pointer)

        names no entity that is cut; "go to definition" looks for it in the whole file"#]],
    );
    check(
        "0|$0LINE|5|1A|8|DIE|10|0|20|0|11|1|21|0",
        MM,
        expect![[r#"
        **LINE**: line between two points

        entity 1A on layer DIE, 1 segment"#]],
    );
    check(
        "999|$0remark|0|LINE|10|0|20|0|11|1|21|0",
        MM,
        expect!["comment: programs pass it over"],
    );
}

#[test]
fn hover_on_an_arc_gives_its_sweep_radius_and_centre() {
    let check =
        |text: &str, unit: Unit, expected: Expect| check_hover(&in_entities(text), unit, &expected);
    check(
        "0|LWPOLYLINE|90|2|70|0|10|0|20|0|42|$01|10|2|20|0",
        INCH,
        expect![[r#"
        **42** of LWPOLYLINE: bulge of the segment that starts in this vertex: tan(sweep / 4), positive counter-clockwise, 0 is a line

        arc of 180°, counter-clockwise

        radius 1 (25.4 mm), centre (25.4, 0) mm"#]],
    );
    check(
        "0|LWPOLYLINE|90|3|70|1|10|0|20|0|10|2|20|0|10|0|20|2|42|$0-1",
        MM,
        expect![[r#"
        **42** of LWPOLYLINE: bulge of the segment that starts in this vertex: tan(sweep / 4), positive counter-clockwise, 0 is a line

        arc of 180°, clockwise

        radius 1 mm, centre (0, 1) mm"#]],
    );
    check(
        "0|POLYLINE|66|1|0|VERTEX|10|0|20|0|$042|1|0|VERTEX|10|2|20|0|0|SEQEND",
        MM,
        expect![[r#"
        **42** of VERTEX: bulge of the segment that starts in this vertex: tan(sweep / 4), positive counter-clockwise, 0 is a line

        arc of 180°, counter-clockwise

        radius 1 mm, centre (1, 0) mm"#]],
    );
    check(
        "0|ARC|10|0|20|0|40|2|50|350|51|$020",
        MM,
        expect![[r#"
        **51** of ARC: end angle; the arc runs counter-clockwise

        the arc sweeps 30°, radius 2 mm"#]],
    );
}

#[test]
fn hover_knows_header_variables_and_the_entity_of_a_handle() {
    check_hover(
        &ALL.replace("$INSUNITS|70|4", "$INSUNITS|70|$04"),
        MM,
        &expect![[r#"
        **$INSUNITS** unit of the drawing: 1 inch, 4 millimetre, 5 centimetre, 6 metre, 0 none

        one unit is 1 mm"#]],
    );
    check_hover(
        &ALL.replace("O|330|02A", "O|330|$02A"),
        MM,
        &expect![[r#"
        **330** of TEXT: handle of the owner

        names LWPOLYLINE on layer DIE"#]],
    );
}

#[test]
fn hover_is_silent_where_no_tag_is() {
    for text in ["$0", "x$0", "0|SECTION|2|ENTITIES|0|LINE|junk$0"] {
        let (document, cursor) = with_cursor(text);
        let _ = hover(&document, cursor, MM);
    }
    check_hover("$0", MM, &expect!["nothing"]);
}
