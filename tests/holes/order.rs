//! The order of the contours.

use super::*;

/// The way from the first on, each time to the nearest that is left.
fn nearest_next(points: &[Point]) -> f64 {
    let (mut at, mut left, mut way) = (points[0], points[1..].to_vec(), 0.0);
    while !left.is_empty() {
        let away = |point: &Point| (point - at).norm();
        let next = (0..left.len()).min_by(|&a, &b| away(&left[a]).total_cmp(&away(&left[b])));
        let next = left.remove(next.unwrap());
        way += (next - at).norm();
        at = next;
    }
    way
}

#[test]
fn nearest_goes_from_hole_to_hole_and_to_the_contour_round_them_last() {
    // Two rows of seven, drawn to and fro between the rows.
    let centers: Vec<[f64; 2]> = (0..14)
        .map(|at| [f64::from(at / 2) * 15.0, f64::from(at % 2) * 60.0])
        .collect();
    let mut entities = vec![rectangle("1F", Role::Punch, [-20.0, -20.0], [110.0, 80.0])];
    entities.extend(
        centers
            .iter()
            .enumerate()
            .map(|(at, &center)| circle(&format!("{:X}", at + 48), Role::Opening, center, 4.0)),
    );
    let drawing = drawing(entities);
    let jumps = |order: &str| {
        let settings = settings(&format!("[program]\norder = \"{order}\"\n"));
        let planned = planned(&drawing, &settings);
        assert_eq!(planned.paths.last().unwrap().outline, 0, "{order}");
        let holes = &planned.paths[..14];
        holes
            .windows(2)
            .map(|pair| (pair[1].begin() - pair[0].end()).norm())
            .sum::<f64>()
    };
    let to_and_fro = 7.0 * 60.0 + 6.0 * 60.0_f64.hypot(15.0);
    assert!((jumps("as-drawn") - to_and_fro).abs() < 1e-9);
    // Along one row and back along the other: 12 × 15 + 60.
    assert!((jumps("nearest") - 240.0).abs() < 1e-9);
    // As the handles are given, whatever lies where.
    let picked: Vec<String> = ["31", "30", "3D"].map(str::to_owned).to_vec();
    let as_picked = settings("[program]\norder = \"as-picked\"\n");
    let snapshot = document(&drawing, &as_picked).snapshot().unwrap();
    let paths = job::planned(&snapshot, &as_picked, Some(&picked), false, &())
        .unwrap()
        .paths;
    let order: Vec<usize> = paths.iter().map(|path| path.outline).collect();
    assert_eq!(order, [2, 1, 14]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// The jumps of `nearest` are those of going each time to the nearest hole that is left.
    #[test]
    fn nearest_is_nearest_next(places in prop::collection::vec((0..9_i32, 0..9_i32, 0.0..2.0_f64, 0.0..2.0_f64), 2..14)) {
        let mut seen = std::collections::BTreeSet::new();
        let places: Vec<[f64; 2]> = places
            .iter()
            .filter(|(x, y, ..)| seen.insert((*x, *y)))
            .map(|&(x, y, dx, dy)| [f64::from(x) * 12.0 + dx, f64::from(y) * 12.0 + dy])
            .collect();
        let circles = places.iter().enumerate().map(|(at, &center)| circle(&format!("{:X}", at + 48), Role::Opening, center, 3.0));
        let drawing = drawing(circles.collect());
        let settings = settings("[program]\norder = \"nearest\"\n");
        let planned = planned(&drawing, &settings);
        let points: Vec<Point> = places.iter().map(|&at| at.into()).collect();
        let jumps: f64 = planned.paths.windows(2).map(|pair| (pair[1].begin() - pair[0].end()).norm()).sum();
        prop_assert!((jumps - nearest_next(&points)).abs() < 1e-6, "{jumps}");
    }

    /// A hole that is proposed and of which nothing is reported keeps its distance from everything, lies as deep as any point of a fine grid, and
    /// no lead comes nearer to another contour than the correction.
    #[test]
    fn proposed_holes_keep_clear_of_everything(
        entities in plate(),
        diameter in 0.5..4.0_f64,
        correction in 0.05..0.3_f64,
        lead in prop::sample::select(vec!["straight", "perpendicular", "arc"]),
    ) {
        let drawing = drawing(entities);
        let settings = settings(&format!(
            "correction = {correction}\n[program]\nstart-hole = {diameter}\nlead = \"{lead}\"\n"
        ));
        let snapshot = document(&drawing, &settings).snapshot().unwrap();
        let outlines = &snapshot.outlines;
        let any_said = !said(&drawing, &settings).is_empty();
        let Ok(planned) = job::planned(&snapshot, &settings, None, false, &()) else {
            // No arc of the correction has room beside the hole.
            prop_assert!(lead == "arc" || any_said || document(&drawing, &settings).all_findings().iter().any(|one| one.severity == Severity::Error));
            return Ok(());
        };
        for hole in &planned.holes {
            let away = distance(outlines, &drawing, hole.at, |_| true);
            prop_assert!(any_said || away >= diameter / 2.0 + correction + 0.1 - 1e-3, "{away} of {diameter}");
            for step in 0..64 {
                let (x, y) = (f64::from(step % 8) / 7.0, f64::from(step / 8) / 7.0);
                let point = Point::new(
                    hole.at.x - 5.0 + 10.0 * x,
                    hole.at.y - 5.0 + 10.0 * y,
                );
                let angle = {
                    let segments = outlines[hole.outline].contour.segments(&drawing);
                    let points: Vec<Point> = segments.flat_map(|segment| (0..16).map(move |at| segment.geometry.point_at(f64::from(at) / 16.0))).collect();
                    let around = points.iter().zip(points.iter().cycle().skip(1));
                    around.map(|(a, b)| wedm::geometry::turn(a - point, b - point)).sum::<f64>()
                };
                if angle.abs() > 3.0 {
                    prop_assert!(distance(outlines, &drawing, point, |_| true) <= away + 8e-3);
                }
            }
        }
        for path in &planned.paths {
            for piece in path.segments.iter().filter(|piece| is_lead(piece)) {
                for step in 0..=16 {
                    let point = piece.geometry.point_at(f64::from(step) / 16.0);
                    prop_assert!(distance(outlines, &drawing, point, |_| true) > correction - 1e-6);
                }
            }
        }
    }
}
