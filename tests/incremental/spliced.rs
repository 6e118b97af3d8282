//! Vertices come into a long polyline and leave it: what was seen of those behind them stays, under other indices.

use super::*;

/// Rows of teeth over each other; a vertex may stand aside, and an arc follow it.
fn of_rows(at: usize, (x, y, bulge): (f64, f64, f64)) -> Vertex {
    const ROW: usize = 90;
    let (row, step) = (at / ROW, at % ROW);
    let along = if row.is_multiple_of(2) {
        step
    } else {
        ROW - 1 - step
    };
    let tooth = (along % 2) as f64;
    Vertex::new(
        along as f64 * 0.15 + x,
        row as f64 * 2.5 + tooth * 1.5 + y,
        bulge,
    )
}

/// How far a vertex stands aside, and its bulge: mostly little, sometimes far across the others.
fn aside() -> impl Strategy<Value = (f64, f64, f64)> {
    let off = prop_oneof![4 => Just(0.0), 4 => -0.1..0.1f64, 1 => -6.0..6.0f64];
    let bulge = prop_oneof![3 => Just(0.0), 1 => -0.6..0.6f64];
    (off.clone(), off, bulge)
}

/// Where vertices come and go: often in one run, which becomes long, or loses all it has.
fn place() -> impl Strategy<Value = usize> {
    prop_oneof![2 => 0..700usize, 1 => 190..260usize, 1 => 0..6usize, 1 => 600..621usize]
}

fn few_or_many() -> impl Strategy<Value = usize> {
    prop_oneof![4 => 0..7usize, 1 => 0..80usize]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(12), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn vertices_that_come_and_go_leave_what_is_behind_them_as_if_afresh(
        closed in any::<bool>(),
        side in prop::sample::select(vec![SideSetting::Both, SideSetting::Opening, SideSetting::Auto]),
        others in prop::collection::vec(aside(), 1..80),
        beside in any::<bool>(),
        edits in prop::collection::vec((place(), few_or_many(), few_or_many(), aside()), 1..6),
    ) {
        let settings = Arc::new(Effective::of(&Settings { side: Some(side), ..Settings::default() }));
        let small = others.iter().cycle().map(|&(x, y, bulge)| (x.clamp(-0.1, 0.1), y.clamp(-0.1, 0.1), bulge / 3.0));
        let vertices = (0..620).zip(small).map(|(at, aside)| of_rows(at, aside)).collect();
        let mut drawing = Drawing::new(None);
        let polyline = drawing.push(entity(Geometry::Polyline { closed, vertices }, None));
        if beside {
            // A wall within reach of the teeth, and one across them.
            for [start, end] in [[(-1.0, -0.12), (16.0, -0.12)], [(3.02, 1.0), (3.05, 14.0)]] {
                let [start, end] = [start, end].map(|(x, y)| Point::new(x, y));
                drawing.push(entity(Geometry::Line { start, end }, None));
            }
        }
        let mut analysis = Analysis::new(&drawing, settings.clone());
        analysis.findings(&drawing, usize::MAX);
        for (from, removed, come, aside) in edits {
            // On the way from one tooth to the next, the last one aside.
            let [start, end] = [from.saturating_sub(1), from].map(|at| of_rows(at, (0.0, 0.0, 0.0)).point);
            let insert = (1..=come).map(|nth| {
                let point = start + (end - start) * (nth as f64 / (come + 1) as f64);
                let (x, y, bulge) = if nth == come { aside } else { (0.0, 0.0, 0.0) };
                Vertex::new(point.x + x, point.y + y, bulge)
            });
            let insert: Vec<Vertex> = insert.collect();
            let Ok(touched) = drawing.splice(polyline, from, removed, &insert) else {
                continue;
            };
            analysis.update(&drawing, &Delta { touched: vec![touched] });
            let mut fresh = Analysis::new(&drawing, settings.clone());
            prop_assert_eq!(analysis.findings(&drawing, usize::MAX), fresh.findings(&drawing, usize::MAX));
        }
    }
}
