//! Random edits.

use super::*;
use crate::size::by_day;

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(400, 1000)), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn incremental_equals_fresh(
        start in proptest::collection::vec((geometry(), role()), 0..12),
        // Now and then so much at once that all is looked at again.
        edits in proptest::collection::vec(
            prop_oneof![8 => proptest::collection::vec(edit(), 1..3), 1 => proptest::collection::vec(edit(), 18..22)],
            1..12,
        ),
        side in 0..4usize,
        common_line in any::<bool>(),
    ) {
        let side = [SideSetting::Both, SideSetting::Auto, SideSetting::Opening, SideSetting::Punch][side];
        let settings = Effective::of(&Settings { correction: Some(0.8), side: Some(side), ..Settings::default() });
        let settings = Arc::new(Effective { common_line, ..settings });
        let mut drawing = Drawing::new(None);
        for (geometry, role) in start {
            drawing.push(entity(geometry, role));
        }
        let mut analysis = Analysis::new(&drawing, settings.clone());
        for batch in edits {
            let touched = batch.iter().filter_map(|edit| apply(&mut drawing, edit)).collect();
            analysis.update(&drawing, &Delta { touched });
            let mut fresh = Analysis::new(&drawing, settings.clone());
            let (now, then) = (analysis.outlines(&drawing).clone(), fresh.outlines(&drawing).clone());
            prop_assert_eq!(now.len(), then.len(), "{:?}\n{:?}", now, then);
            for (a, b) in now.iter().zip(then.iter()) {
                prop_assert_eq!(&a.contour, &b.contour);
                prop_assert_eq!(a.role, b.role);
                prop_assert!((a.twice_area - b.twice_area).abs() < 1e-9, "{} {}", a.twice_area, b.twice_area);
            }
            let (now, then) = (analysis.findings(&drawing, usize::MAX), fresh.findings(&drawing, usize::MAX));
            prop_assert_eq!(now.1, now.0.len(), "counted and not listed: {:?}", now.0);
            prop_assert_eq!(now, then);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(80, 200)), failure_persistence: None, ..ProptestConfig::default() })]

    /// Pairs: of contours that are cut twice, and of two workpieces that are drawn in one place, entities that go from the one to the other.
    #[test]
    fn pairs_are_held_against_each_other_as_if_afresh(
        start in proptest::collection::vec((geometry(), 0..3usize), 0..10),
        edits in proptest::collection::vec(proptest::collection::vec((edit(), 0..3usize), 1..3), 1..10),
        is_drawn in any::<bool>(),
    ) {
        let what = match is_drawn {
            true => "[workpieces]\nA = [\"A\"]\nB = [\"B\"]\n",
            false => "",
        };
        let drawn_as = if is_drawn { "" } else { "drawn-as = \"punch\"\n" };
        let text = format!("wire-diameter = 0.4\ngap = 0.1\n[pair]\nclearance = 0.05\n{drawn_as}{what}");
        let (settings, errors) = wedm::settings::from_toml(&text);
        prop_assert_eq!(errors, []);
        let settings = Arc::new(Effective::of(&settings));
        let on_layer = |geometry: Geometry, layer: usize| Entity {
            layer: ["0", "A", "B"][layer].into(),
            ..entity(geometry, None)
        };
        let mut drawing = Drawing::new(None);
        for (geometry, layer) in start {
            drawing.push(on_layer(geometry, layer));
        }
        // A pair that is there from the beginning.
        for (layer, by) in [(1, 0.0), (2, 0.05)] {
            let (low, high) = (-10.0 - by, -4.0 + by);
            let vertices = [(low, low), (high, low), (high, high), (low, high)];
            let vertices = vertices.map(|(x, y)| Vertex { point: Point::new(x, y), bulge: 0.0 }).to_vec();
            drawing.push(on_layer(Geometry::Polyline { closed: true, vertices }, layer));
        }
        let mut analysis = Analysis::new(&drawing, settings.clone());
        prop_assert!(analysis.findings(&drawing, usize::MAX).0.iter().any(|finding| finding.rule == wedm::finding::Rule::DoesNotFit));
        for batch in edits {
            let mut touched = Vec::new();
            for (edit, layer) in batch {
                if let Edit::Replace(at, ..) = edit
                    && !drawing.is_empty()
                    && layer > 0
                {
                    // The same entity on another layer.
                    let id = drawing.order()[at % drawing.len()];
                    if let Some(old) = drawing.get(id).cloned() {
                        drawing.replace(id, on_layer(old.geometry, layer));
                        touched.push(Touched::Entity { entity: id });
                    }
                    continue;
                }
                touched.extend(apply(&mut drawing, &edit));
            }
            analysis.update(&drawing, &Delta { touched });
            let mut fresh = Analysis::new(&drawing, settings.clone());
            let (now, then) = (analysis.outlines(&drawing).clone(), fresh.outlines(&drawing).clone());
            prop_assert_eq!(now.len(), then.len(), "{:?}\n{:?}", now, then);
            for (a, b) in now.iter().zip(then.iter()) {
                prop_assert_eq!(&a.contour, &b.contour);
            }
            let (now, then) = (analysis.findings(&drawing, usize::MAX), fresh.findings(&drawing, usize::MAX));
            prop_assert_eq!(now.1, now.0.len(), "counted and not listed: {:?}", now.0);
            prop_assert_eq!(now, then);
        }
    }
}
