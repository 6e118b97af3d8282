//! Pairs of long contours.

use super::*;
use crate::size::by_day;
use wedm::finding::Rule;

/// One corner: how far it stands out, and the bulge after it.
type Corner = (f64, f64);

/// All round a ring, over and over. Of the second kind a wire uses up what is left at every corner.
fn corners() -> impl Strategy<Value = Vec<Corner>> {
    prop_oneof![
        2 => proptest::collection::vec(corner(), 1..40),
        1 => (0.1..0.5).prop_map(|bulge| vec![(0.0, bulge), (0.0, 0.0)]),
        1 => (0.02..0.3, 0.0..0.4).prop_map(|(away, bulge)| vec![(away, bulge), (0.0, 0.0)]),
    ]
}

/// What an edit does at a corner: takes this many away, and puts others there.
type Change = (usize, usize, Vec<Corner>);

fn corner() -> impl Strategy<Value = Corner> {
    let bulge = prop_oneof![4 => Just(0.0), 1 => -0.4..0.4];
    (prop_oneof![1 => Just(0.0), 1 => 0.0..0.3], bulge)
}

fn change() -> impl Strategy<Value = Change> {
    // Half of them where begin and end of the contour meet.
    let at = prop_oneof![0..4usize, 0..400usize];
    (at, 0..3usize, proptest::collection::vec(corner(), 0..3))
}

/// A clearance and passes: below the correction, and above some or all of those of several passes.
fn passes() -> impl Strategy<Value = (f64, String)> {
    let several = |(clearance, skim_corner): (f64, &str)| {
        let passes =
            format!("[passes]\ncorrections = [0.15, 0.1]\nskim-corner = \"{skim_corner}\"\n");
        (clearance, passes)
    };
    let clearance = prop_oneof![Just(0.02), Just(0.1), Just(0.12), Just(0.2)];
    let skim_corner = prop_oneof![Just("sharp"), Just("constant-stock")];
    prop_oneof![
        2 => Just((0.01, String::new())),
        1 => (clearance, skim_corner).prop_map(several),
    ]
}

/// A corner of a ring of `count`, at a share of the way round, so far outside of where it is drawn.
fn vertex((away, bulge): Corner, share: f64, count: usize, outside: f64) -> Vertex {
    let (sin, cos) = (std::f64::consts::TAU * share).sin_cos();
    let radius = 0.08 * count as f64 + away + outside;
    Vertex::new(radius * cos, radius * sin, bulge)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(20, 60)), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn long_pairs_are_held_against_each_other_as_if_afresh(
        corners in corners(),
        count in 200..300usize,
        edits in proptest::collection::vec((any::<bool>(), change()), 1..8),
        outside in -0.02..0.06,
        is_drawn in any::<bool>(),
        (clearance, passes) in passes(),
    ) {
        let keys = match is_drawn {
            true => "[workpieces]\nA = [\"A\"]\nB = [\"B\"]\n".to_owned(),
            false => format!("drawn-as = \"punch\"\n{passes}"),
        };
        let clearance = if is_drawn { 0.01 } else { clearance };
        let text = format!("wire-diameter = 0.18\ngap = 0.01\n[pair]\nclearance = {clearance}\n{keys}");
        let (settings, errors) = wedm::settings::from_toml(&text);
        prop_assert_eq!(errors, []);
        let settings = Arc::new(Effective::of(&settings));
        let mut drawing = Drawing::new(None);
        let parts: &[(&str, f64)] = if is_drawn { &[("A", 0.0), ("B", outside)] } else { &[("0", 0.0)] };
        let mut ids = Vec::new();
        for (layer, outside) in parts {
            let at = |at: usize| vertex(corners[at % corners.len()], at as f64 / count as f64, count, *outside);
            let geometry = Geometry::Polyline { closed: true, vertices: (0..count).map(at).collect() };
            ids.push(drawing.push(Entity { layer: (*layer).into(), ..entity(geometry, None) }));
        }
        let mut analysis = Analysis::new(&drawing, settings.clone());
        analysis.findings(&drawing, usize::MAX);
        for (is_last, (at, gone, new)) in edits {
            let which = if is_last { ids.len() - 1 } else { 0 };
            let share = |nth: usize| (at as f64 + nth as f64 / (new.len() + 1) as f64) / count as f64;
            let new: Vec<Vertex> = new
                .iter()
                .enumerate()
                .map(|(nth, corner)| vertex(*corner, share(nth), count, parts[which].1))
                .collect();
            let Ok(touched) = drawing.splice(ids[which], at, gone, &new) else {
                continue;
            };
            analysis.update(&drawing, &Delta { touched: vec![touched] });
            let fresh = Analysis::new(&drawing, settings.clone()).findings(&drawing, usize::MAX);
            let now = analysis.findings(&drawing, usize::MAX);
            prop_assert_eq!(
                now.0.iter().filter(|finding| finding.rule == Rule::DoesNotFit).count(),
                fresh.0.iter().filter(|finding| finding.rule == Rule::DoesNotFit).count()
            );
            prop_assert_eq!(now.1, now.0.len(), "counted and not listed: {:?}", now.0);
            prop_assert_eq!(now, fresh);
        }
    }
}
