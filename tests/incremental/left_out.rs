//! What is left out since it would take too much.

use super::drawings::shown;
use super::*;
use crate::size::by_day;

/// What is found, entities by their place in the machining order: that of another drawing with the same entities is the same.
fn found(drawing: &Drawing, mut analysis: Analysis) -> Vec<String> {
    let order: std::collections::HashMap<EntityId, usize> = drawing
        .order()
        .iter()
        .enumerate()
        .map(|(at, &id)| (id, at))
        .collect();
    let place = |place: &Place| match *place {
        Place::Segment { entity, segment } => format!("{:?}/{segment}", order.get(&entity)),
        _ => String::new(),
    };
    let (findings, _) = analysis.findings(drawing, usize::MAX);
    let said = |finding: &wedm::finding::Finding| {
        let related: Vec<String> = finding.related.iter().map(place).collect();
        format!(
            "{:?} {} {:?} {:?}",
            finding.rule,
            place(&finding.place),
            finding.detail,
            related
        )
    };
    findings.iter().map(said).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(100, 300)), failure_persistence: None, ..ProptestConfig::default() })]

    /// More lies on and across each other than is compared: what is left out depends on the drawing alone.
    #[test]
    fn what_is_left_out_is_what_is_left_out_afresh(
        start in proptest::collection::vec((geometry(), role()), 0..40),
        edits in proptest::collection::vec(proptest::collection::vec(edit(), 1..3), 1..10),
        budget in (0..4000u64, 0..200usize),
        side in 0..2usize,
    ) {
        let budget = Budget { looks: budget.0, looks_of_a_segment: 4, most_seen: budget.1 };
        let side = [SideSetting::Both, SideSetting::Opening][side];
        let settings = Effective::of(&Settings { correction: Some(0.3), side: Some(side), ..Settings::default() });
        let settings = Arc::new(Effective { budget, ..settings });
        let mut drawing = Drawing::new(None);
        for (geometry, role) in start {
            drawing.push(entity(geometry, role));
        }
        let mut analysis = Analysis::new(&drawing, settings.clone());
        for batch in edits {
            let touched = batch.iter().filter_map(|edit| apply(&mut drawing, edit)).collect();
            analysis.update(&drawing, &Delta { touched });
            let mut again = Drawing::new(None);
            for &id in drawing.order() {
                again.push(drawing.get(id).unwrap().clone());
            }
            let now = found(&drawing, analysis.clone());
            prop_assert_eq!(&now, &found(&drawing, Analysis::new(&drawing, settings.clone())));
            prop_assert_eq!(&now, &found(&again, Analysis::new(&again, settings.clone())));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(8, 20)), failure_persistence: None, ..ProptestConfig::default() })]

    /// A comb finer than the wire, in which enough is seen near its beginning: an edit after that looks at no more than itself.
    #[test]
    fn a_comb_of_which_the_end_is_not_compared_is_read_as_if_afresh(
        rows in 1..4usize,
        apart in prop::sample::select(vec![1.6, 2.0, 3.0]),
        most_seen in prop_oneof![Just(40usize), Just(200), Just(700), Just(1_000_000)],
        closed in any::<bool>(),
        edits in proptest::collection::vec((0..800usize, -1.0..1.0f64, -1.0..1.0f64, 0..8usize), 1..5),
        far in prop::sample::select(vec![1.0, 0.01]),
    ) {
        const ROW: usize = 200;
        let settings = Effective::of(&Settings { correction: Some(0.1), ..Settings::default() });
        let budget = Budget { most_seen, ..settings.budget };
        let settings = Arc::new(Effective { budget, ..settings });
        let vertex = |i: usize| {
            let (row, step) = (i / ROW, i % ROW);
            let along = if row % 2 == 0 { step } else { ROW - 1 - step };
            let point = Point::new(along as f64 * 0.08, row as f64 * apart + (i % 2) as f64 * 1.5);
            Vertex { point, bulge: 0.0 }
        };
        let mut drawing = Drawing::new(None);
        let comb = Geometry::Polyline { closed, vertices: (0..rows * ROW).map(vertex).collect() };
        drawing.push(entity(comb, None));
        let line = Geometry::Line { start: Point::new(-3.0, 0.0), end: Point::new(-3.0, 1.0) };
        drawing.push(entity(line, None));
        let mut analysis = Analysis::new(&drawing, settings.clone());
        for (at, x, y, kind) in edits {
            let at = at % (rows * ROW);
            let point = vertex(at).point + nalgebra::Vector2::new(x, y) * far;
            let moved = Vertex { point, bulge: if kind == 1 { x } else { 0.0 } };
            let edit = match kind {
                0 => Edit::Splice(0, at, 1, vec![moved, moved]),
                2 => Edit::Replace(1, Geometry::Line { start: point, end: Point::new(-3.0, 1.0) }, None),
                _ => Edit::Splice(0, at, 1, vec![moved]),
            };
            let touched = apply(&mut drawing, &edit).into_iter().collect();
            analysis.update(&drawing, &Delta { touched });
            prop_assert_eq!(found(&drawing, analysis.clone()), found(&drawing, Analysis::new(&drawing, settings.clone())));
        }
    }
}

/// A comb in which more is seen than is looked for, and a square, the one or the other first: a number, a code and a new vertex are typed,
/// and are none for a while.
#[test]
fn what_is_typed_in_a_contour_of_which_the_end_is_not_compared_is_read_as_if_afresh() {
    const COUNT: usize = 240;
    let comb = |i: usize| {
        let (x, y) = (i as f64 * 0.08, (i % 2) as f64 * 1.5);
        format!("10\n{x}\n20\n{y}\n")
    };
    let comb = (0..COUNT).map(comb).collect::<String>();
    let comb = format!("0\nLWPOLYLINE\n5\n1\n8\nDIE\n90\n{COUNT}\n70\n1\n{comb}");
    let square = |y: f64| {
        let corners = [(0.0, y), (9.0, y), (9.0, y + 9.0), (0.0, y + 9.0)];
        let corners = corners.map(|(x, y)| format!("10\n{x}\n20\n{y}\n")).concat();
        format!("0\nLWPOLYLINE\n5\n2\n8\nDIE\n90\n4\n70\n1\n{corners}")
    };
    for (most_seen, outlines) in [40, 300, 1_000_000].into_iter().flat_map(|most| {
        [
            (most, format!("{comb}{}", square(20.0))),
            (most, format!("{}{comb}", square(-20.0))),
            // The square lies over the comb.
            (most, format!("{}{comb}", square(1.45))),
        ]
    }) {
        let settings = Effective::of(&Settings::default());
        let budget = Budget {
            most_seen,
            ..settings.budget
        };
        let settings = Arc::new(Effective { budget, ..settings });
        let mut text = format!("0\nSECTION\n2\nENTITIES\n{outlines}0\nENDSEC\n0\nEOF\n");
        let read = |text: &str| {
            let text = text.to_owned().into_bytes();
            Document::new(Source::Dxf(dxf::Document::read(text)), settings.clone())
        };
        let mut document = read(&text);
        // A number, a code and a line, early and late in the comb.
        for at in [30, 225] {
            let number = text
                .match_indices("\n10\n")
                .nth(at)
                .map_or(0, |(at, _)| at + 4);
            for (home, new) in [
                (number, "x"),
                (number - 3, "x"),
                (number, "5\n"),
                (number, ""),
            ] {
                let typed = home..home;
                text.replace_range(typed.clone(), new);
                document.edit_text(typed, new);
                assert_eq!(shown(&mut document), shown(&mut read(&text)), "{at} {new}");
                text.replace_range(home..home + new.len(), "");
                document.edit_text(home..home + new.len(), "");
                assert_eq!(shown(&mut document), shown(&mut read(&text)), "{at} {new}");
            }
        }
    }
}
