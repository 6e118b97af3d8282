//! What lies on something else.

use super::{SQUARE, all_fixed, analysed, closed, count, drawing_of, drawings, entity, settings};
use std::f64::consts::PI;
use wedm::document::{Document, Source};
use wedm::drawing::{Drawing, Entity, Geometry, Role};
use wedm::finding::{Detail, Finding, Rule};
use wedm::geometry::Point;

/// A spline that lies there twice goes as a whole, and a line may come in after one; of what a block reference draws no part goes.
#[test]
fn doubles_of_curves_are_deleted_and_those_in_blocks_are_not() {
    let text = |blocks: &str, entities: &str| {
        let all = format!(
            "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 BLOCKS {blocks} 0 ENDSEC 0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF"
        );
        all.split_whitespace()
            .map(|tag| format!("{tag}\n"))
            .collect::<String>()
    };
    let spline = |handle: &str| {
        format!(
            "0 SPLINE 5 {handle} 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 50 10 10 20 70 10 20 20 50 "
        )
    };
    let ellipse = |handle: &str| format!("0 ELLIPSE 5 {handle} 10 0 20 0 11 10 21 0 40 0.5 ");
    let line = "0 LINE 5 9 8 0 10 20 20 50 11 0 21 50 ";
    let block = "0 BLOCK 2 B 10 0 20 0 0 CIRCLE 8 0 10 0 20 0 40 3 0 ENDBLK ";
    let insert = |handle: &str| format!("0 INSERT 5 {handle} 2 B 10 0 20 0 ");
    for (blocks, entities, rule, expected) in [
        (
            "",
            format!("{}{line}{}", spline("1"), spline("2")),
            Rule::DuplicateEntity,
            Some(format!("{}{line}", spline("1"))),
        ),
        (
            "",
            ellipse("1") + &ellipse("2"),
            Rule::DuplicateEntity,
            Some(ellipse("1")),
        ),
        (
            "",
            spline("1"),
            Rule::OpenContour,
            Some(spline("1") + "0 LINE 5 2 10 20.0 20 50.0 11 0.0 21 50.0 "),
        ),
        (
            block,
            insert("1") + &insert("2"),
            Rule::DuplicateEntity,
            None,
        ),
    ] {
        let source = Source::Dxf(wedm::dxf::Document::read(
            text(blocks, &entities).into_bytes(),
        ));
        let mut document = Document::new(source, settings());
        let findings = document.findings(usize::MAX).0;
        let finding = findings
            .iter()
            .find(|finding| finding.rule == rule)
            .unwrap_or_else(|| panic!("{findings:#?}"));
        let fix = document.fixes(finding).into_iter().next();
        assert_eq!(fix.is_some(), expected.is_some(), "{entities}");
        if let (Some(fix), Some(expected), Source::Dxf(dxf)) = (fix, expected, document.source()) {
            let wedm::finding::Edit::Drawing(edit) = fix.edit else {
                panic!("an edit of the drawing")
            };
            let edited =
                wedm::text::edited(dxf.text().bytes(), &dxf.text_edits(&edit).unwrap()).unwrap();
            assert_eq!(String::from_utf8(edited).unwrap(), text(blocks, &expected));
        }
    }
}

/// A line that lies there twice: the fix of the arc beside it would move one of the two, and the contour would fall apart.
#[test]
fn an_arc_is_not_made_larger_beside_a_line_that_lies_there_twice() {
    let fillet = closed(&[
        (0.0, 0.0, 0.0),
        (9.95, 0.0, (PI / 8.0).tan()),
        (10.0, 0.05, 0.0),
        (10.0, 10.0, 0.0),
        (0.0, 10.0, 0.0),
    ]);
    let mut drawing = fillet.as_chain(Some(Role::Opening));
    let line = drawing
        .entities()
        .nth(2)
        .expect("the line behind the arc")
        .1
        .clone();
    drawing.push(line);
    let (analysis, findings) = analysed(&drawing);
    assert_eq!(
        (
            count(&findings, Rule::SmallRadius),
            count(&findings, Rule::DuplicateEntity)
        ),
        (1, 1),
        "{findings:#?}"
    );
    for fix in analysis.fixes(&drawing, &findings[0]) {
        let mut edited = drawing.clone();
        edited.apply(&fix.edit).unwrap();
        assert_eq!(
            count(&analysed(&edited).1, Rule::OpenContour),
            0,
            "{fix:#?}"
        );
    }
    let findings = analysed(&all_fixed(drawing)).1;
    assert_eq!(
        findings
            .iter()
            .filter(|finding| finding.rule != Rule::SharpCorner)
            .count(),
        0,
        "{findings:#?}"
    );
}

/// Two closed outlines in one place begin where they like, and have their vertices where they like.
#[test]
fn closed_outlines_that_lie_on_each_other_are_doubles() {
    let polyline = |vertices: &[(f64, f64, f64)]| closed(vertices).geometry();
    let l: Vec<(f64, f64, f64)> = vec![
        (0.0, 0.0, 0.0),
        (8.0, 0.0, 0.3),
        (8.0, 4.0, 0.0),
        (3.0, 4.0, 0.0),
        (3.0, 9.0, 0.0),
        (0.0, 9.0, 0.0),
    ];
    let with = |at: usize, vertex: (f64, f64, f64)| {
        let mut more = l.clone();
        more.insert(at, vertex);
        polyline(&more)
    };
    let circle = Geometry::Circle {
        center: Point::new(5.0, 5.0),
        radius: 3.0,
    };
    let moved = |by: f64| {
        polyline(
            &l.iter()
                .map(|&(x, y, bulge)| (x + by, y, bulge))
                .collect::<Vec<_>>(),
        )
    };
    for (name, one, other, expected) in [
        (
            "begun elsewhere",
            polyline(&l),
            closed(&l).begun_elsewhere().geometry(),
            true,
        ),
        (
            "the other way round",
            polyline(&l),
            closed(&l).reversed().geometry(),
            true,
        ),
        (
            "the other way round from elsewhere",
            polyline(&l),
            closed(&l).reversed().begun_elsewhere().geometry(),
            true,
        ),
        (
            "one vertex more",
            polyline(&l),
            with(3, (5.0, 4.0, 0.0)),
            true,
        ),
        (
            "a vertex more at the beginning",
            with(0, (0.0, 2.0, 0.0)),
            polyline(&l),
            true,
        ),
        (
            "a vertex twice",
            polyline(&l),
            with(4, (3.0, 4.0, 0.0)),
            true,
        ),
        (
            "one corner more",
            polyline(&l),
            with(3, (5.0, 4.01, 0.0)),
            false,
        ),
        (
            "a circle and its two halves",
            circle.clone(),
            polyline(&[(2.0, 5.0, 1.0), (8.0, 5.0, 1.0)]),
            true,
        ),
        (
            "a circle and its two halves backwards",
            polyline(&[(5.0, 8.0, -1.0), (5.0, 2.0, -1.0)]),
            circle.clone(),
            true,
        ),
        (
            "a circle and half of another",
            circle,
            polyline(&[(2.0, 5.0, 1.0), (8.0, 5.0, 0.9)]),
            false,
        ),
        (
            "beside each other by less than a place",
            polyline(&l),
            moved(0.004),
            true,
        ),
        (
            "beside each other by more than a place",
            polyline(&l),
            moved(0.006),
            false,
        ),
    ] {
        for swapped in [false, true] {
            let mut drawing = Drawing::new(None);
            for geometry in if swapped {
                [&other, &one]
            } else {
                [&one, &other]
            } {
                drawing.push(entity(geometry.clone(), Some(Role::Opening)));
            }
            let (analysis, findings) = analysed(&drawing);
            let double = findings
                .iter()
                .find(|finding| finding.rule == Rule::DuplicateEntity);
            assert_eq!(
                double.is_some(),
                expected,
                "{name}, swapped {swapped}: {findings:#?}"
            );
            if let Some(double) = double {
                assert_eq!(
                    (
                        count(&findings, Rule::DuplicateEntity),
                        count(&findings, Rule::Overlap)
                    ),
                    (1, 0),
                    "{name}: {findings:#?}"
                );
                drawing
                    .apply(
                        &analysis
                            .fixes(&drawing, double)
                            .first()
                            .expect("a fix")
                            .edit,
                    )
                    .unwrap();
                assert_eq!(drawing.len(), 1, "{name}");
            }
        }
    }
}

/// Three entities in one place are one finding, whose fix leaves the first.
#[test]
fn what_lies_in_one_place_is_one_finding() {
    let circle = Geometry::Circle {
        center: Point::new(5.0, 5.0),
        radius: 3.0,
    };
    let mut drawing = Drawing::new(None);
    for _ in 0..3 {
        drawing.push(entity(circle.clone(), None));
    }
    let (analysis, findings) = analysed(&drawing);
    let doubles: Vec<&Finding> = findings
        .iter()
        .filter(|finding| finding.rule == Rule::DuplicateEntity)
        .collect();
    assert_eq!(doubles.len(), 1, "{findings:#?}");
    assert_eq!(doubles[0].related.len(), 2);
    let fixes = analysis.fixes(&drawing, doubles[0]);
    drawing.apply(&fixes[0].edit).unwrap();
    assert_eq!(drawing.len(), 1);
}

#[test]
fn what_lies_wholly_on_another_entity_goes_with_fix_all() {
    let line = |x0: f64, x1: f64| Geometry::Line {
        start: Point::new(x0, 0.0),
        end: Point::new(x1, 0.0),
    };
    let arc = |from: f64, to: f64| Geometry::Arc {
        center: Point::new(0.0, 20.0),
        radius: 5.0,
        start_angle: from,
        end_angle: to,
    };
    for (geometries, overlaps, left) in [
        (vec![line(0.0, 10.0), line(2.0, 4.0), line(6.0, 8.0)], 2, 1),
        (vec![line(2.0, 4.0), line(10.0, 0.0)], 1, 1),
        (vec![arc(0.0, 3.0), arc(1.0, 2.0)], 1, 1),
        // Each reaches past the other: which of them ends where is not for a program to say.
        (vec![line(0.0, 6.0), line(4.0, 10.0)], 1, 2),
    ] {
        let drawing = drawing_of(geometries, None);
        assert_eq!(count(&analysed(&drawing).1, Rule::Overlap), overlaps);
        let fixed = all_fixed(drawing);
        assert_eq!(fixed.len(), left);
        assert_eq!(count(&analysed(&fixed).1, Rule::Overlap), left - 1);
    }
}

/// Two parts that lie at each other have their border twice, which is no double: to take one of the two away would open a part.
/// The one line that is too much is found among them.
#[test]
fn one_double_is_found_among_many_that_close_two_parts() {
    let pairs = 16;
    let ring = |points: &[(f64, f64)]| {
        let next = points.iter().cycle().skip(1);
        let lines = points.iter().zip(next).map(|(&from, &to)| Geometry::Line {
            start: Point::new(from.0, from.1),
            end: Point::new(to.0, to.1),
        });
        lines.collect::<Vec<_>>()
    };
    let mut lines = Vec::new();
    for pair in 0..pairs {
        let x = 30.0 * f64::from(pair);
        let border = [
            (x + 10.0, 10.0),
            (x + 9.0, 7.0),
            (x + 11.0, 3.0),
            (x + 10.0, 0.0),
        ];
        let left = [border.as_slice(), &[(x, 0.0), (x, 10.0)]].concat();
        let right = [border.as_slice(), &[(x + 20.0, 0.0), (x + 20.0, 10.0)]].concat();
        lines.extend(ring(&left));
        lines.extend(ring(&right));
    }
    let square = ring(&[(-30.0, 0.0), (-20.0, 0.0), (-20.0, 10.0), (-30.0, 10.0)]);
    lines.extend(square.iter().cloned());
    lines.push(square[0].clone());
    let drawing = drawing_of(lines, None);
    let doubles = |drawing: &Drawing| count(&analysed(drawing).1, Rule::DuplicateEntity);
    assert_eq!(doubles(&drawing), 1);
    let fixed = all_fixed(drawing.clone());
    assert_eq!(fixed.len(), drawing.len() - 1);
    assert_eq!(doubles(&fixed), 0);
}

/// An outline that lies there twice is one finding, whichever of its entities come first, and one fix; so is each of two outlines.
#[test]
fn an_outline_that_lies_there_twice_is_one_finding() {
    for (copies, count_of_more) in [(2, 4), (3, 8)] {
        for drawing in drawings(&closed(&SQUARE), None) {
            let entities: Vec<Entity> = drawing.entities().map(|(_, each)| each.clone()).collect();
            let mut doubled = Drawing::new(None);
            // One after the other, or each beside its double.
            let (by_outline, by_line) = (
                std::iter::repeat_n(&entities, copies)
                    .flatten()
                    .collect::<Vec<_>>(),
                entities
                    .iter()
                    .flat_map(|each| std::iter::repeat_n(each, copies))
                    .collect::<Vec<_>>(),
            );
            for order in [by_outline, by_line] {
                let mut drawing = Drawing::new(None);
                for each in order {
                    drawing.push(each.clone());
                }
                let (analysis, findings) = analysed(&drawing);
                let told: Vec<&Finding> = findings
                    .iter()
                    .filter(|finding| finding.rule == Rule::DuplicateEntity)
                    .collect();
                let [finding] = told[..] else {
                    panic!("{findings:#?}")
                };
                let lines = entities.len();
                assert_eq!(finding.related.len(), count_of_more * lines / 4);
                assert!(
                    matches!(finding.detail, Detail::DuplicateEntity { count } if count == lines),
                    "{finding:?}"
                );
                assert_eq!(count(&findings, Rule::OpenContour), 0, "{findings:#?}");
                let fix = &analysis.fixes(&drawing, finding)[0];
                drawing.apply(&fix.edit).unwrap();
                assert_eq!(drawing.order().len(), lines);
                assert_eq!(
                    count(&analysed(&drawing).1, Rule::DuplicateEntity),
                    0,
                    "{fix:?}"
                );
                doubled = drawing;
            }
            assert_eq!(doubled.order().len(), entities.len());
        }
    }
}

/// Plates side by side, each with its own edges: as many outlines as plates, and an error where the wire has no room between them.
#[test]
fn an_edge_that_two_outlines_share_belongs_to_both() {
    for (columns, rows) in [(2, 1), (3, 1), (2, 2), (3, 2)] {
        let mut lines = Vec::new();
        for (column, row) in (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row)))
        {
            let at =
                |x: i32, y: i32| Point::new(f64::from(column + x) * 10.0, f64::from(row + y) * 6.0);
            let corners = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
            let ends = (0..4).map(|nth| (corners[nth], corners[(nth + 1) % 4]));
            lines.extend(ends.map(|(start, end)| Geometry::Line { start, end }));
        }
        // Whatever their order.
        for step in [1, 3, 5, 7] {
            let order = (0..lines.len()).map(|at| lines[at * step % lines.len()].clone());
            let distinct = step == 1 || lines.len() % step != 0;
            if !distinct {
                continue;
            }
            let drawing = drawing_of(order, Some(Role::Punch));
            let (analysis, findings) = analysed(&drawing);
            let areas: Vec<f64> = analysis
                .outlines(&drawing)
                .iter()
                .map(|it| it.twice_area.abs())
                .collect();
            assert_eq!(
                areas,
                vec![120.0; (columns * rows) as usize],
                "{columns} by {rows}, {step}"
            );
            assert!(count(&findings, Rule::NarrowSlot) > 0, "{findings:#?}");
            assert_eq!(count(&findings, Rule::DuplicateEntity), 0, "{findings:#?}");
        }
    }
}

/// A circle, as arcs, as a polyline: one cut, one finding.
#[test]
fn a_closed_outline_that_is_drawn_again_is_cut_once_whatever_its_entities() {
    let half = |from: f64| Geometry::Arc {
        center: Point::origin(),
        radius: 3.0,
        start_angle: from,
        end_angle: from + PI,
    };
    let ways = [
        vec![Geometry::Circle {
            center: Point::origin(),
            radius: 3.0,
        }],
        vec![half(0.3), half(0.3 + PI)],
        vec![closed(&[(-3.0, 0.0, 1.0), (3.0, 0.0, 1.0)]).geometry()],
    ];
    for (one, other) in (0..3).flat_map(|one| (0..3).map(move |other| (one, other))) {
        let all = ways[one].iter().chain(&ways[other]).cloned();
        let drawing = drawing_of(all, Some(Role::Opening));
        let (analysis, findings) = analysed(&drawing);
        let told: Vec<Rule> = findings.iter().map(|it| it.rule).collect();
        assert_eq!(told, [Rule::DuplicateEntity], "{one} {other}");
        let repaired = all_fixed(drawing.clone());
        assert_eq!(
            repaired.len(),
            ways[one].len(),
            "{one} {other}: {:?}",
            analysis.fixes(&drawing, &findings[0])
        );
    }
}
