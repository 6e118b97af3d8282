//! Many lone lines side by side, which are asked together what they face, and one by one after an edit.

use super::*;
use crate::size::by_day;

fn turned(x: f64, y: f64, angle: f64) -> Point {
    Point::new(
        x * angle.cos() - y * angle.sin(),
        x * angle.sin() + y * angle.cos(),
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(25, 60)), failure_persistence: None, ..ProptestConfig::default() })]

    /// Lines of a hatch within a plate, whose edges may be long ones of many teeth, some of which end beside another line or an open outline.
    #[test]
    fn lines_of_a_hatch_are_set_aside_as_if_afresh(
        angle in prop::sample::select(vec![0.0, 0.6, 2.0]),
        teeth in prop::sample::select(vec![1_usize, 1, 200]),
        apart in prop::sample::select(vec![0.3, 1.0, 2.5]),
        ends in proptest::collection::vec((0.0..3.0f64, 17.0..23.0f64, -0.5..0.5f64), 20..60),
        across in proptest::collection::vec((0.0..20.0f64, 0.0..20.0f64, 1.0..9.0f64), 0..4),
        outlines in proptest::collection::vec((0.0..20.0f64, 15.0..26.0f64), 0..3),
        edits in proptest::collection::vec((0..64usize, 0.0..20.0f64, 0.0..20.0f64), 1..6),
    ) {
        let line = |(x, y): (f64, f64), (u, v): (f64, f64)| {
            Geometry::Line { start: turned(x, y, angle), end: turned(u, v, angle) }
        };
        let polyline = |closed: bool, points: &[(f64, f64)]| {
            let vertex = |&(x, y): &(f64, f64)| Vertex { point: turned(x, y, angle), bulge: 0.0 };
            Geometry::Polyline { closed, vertices: points.iter().map(vertex).collect() }
        };
        let wide = ends.len() as f64 * apart;
        let mut drawing = Drawing::new(None);
        let corners = [(-3.0, -3.0), (wide, -3.0), (wide, 25.0), (-3.0, 25.0)];
        let edge = |side: usize| {
            let ((x, y), (u, v)) = (corners[side], corners[(side + 1) % 4]);
            (0..teeth).map(move |tooth| {
                let (share, deep) = (tooth as f64 / teeth as f64, 0.1 * (tooth % 2) as f64);
                (x + (u - x) * share + deep, y + (v - y) * share + deep)
            })
        };
        drawing.push(entity(polyline(true, &(0..4).flat_map(edge).collect::<Vec<_>>()), None));
        for (at, (low, high, slant)) in ends.iter().enumerate() {
            let x = at as f64 * apart;
            drawing.push(entity(line((x, *low), (x + slant, *high)), None));
        }
        for (x, y, long) in across {
            drawing.push(entity(line((x, y), (x + long, y + 0.2)), None));
        }
        for (x, y) in outlines {
            drawing.push(entity(polyline(false, &[(x, y), (x + 1.0, y + 2.0), (x + 3.0, y + 2.0)]), None));
        }
        let settings = Arc::new(Effective::default());
        let mut analysis = Analysis::new(&drawing, settings.clone());
        for (at, x, y) in edits {
            let (low, high, _) = ends[at % ends.len()];
            let edit = Edit::Replace(1 + at, line((x, low), (y, high)), None);
            let touched = apply(&mut drawing, &edit).into_iter().collect();
            analysis.update(&drawing, &Delta { touched });
            let afresh = Analysis::new(&drawing, settings.clone()).findings(&drawing, usize::MAX);
            prop_assert_eq!(analysis.clone().findings(&drawing, usize::MAX), afresh);
        }
    }
}
