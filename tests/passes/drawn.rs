//! Programs of passes turned into drawings.

use super::{PLATE, drawing, held, settings};
use wedm::drawing::{Geometry, Role};
use wedm::program::{Format, convert};

/// A program of passes, its tabs cut off in whatever order, is one closed contour for each pass as a drawing: the last is the contour,
/// those before it are on layers of their own, each as large as its correction makes it.
#[test]
fn passes_and_their_tabs_are_drawn_as_closed_contours() {
    let mut made = 0;
    for number in 0..2 * 2 * 2 * 3 * 3 * 2 {
        let mut left = number;
        let mut pick = |count: usize| {
            let own = left % count;
            left /= count;
            own
        };
        let corrections = [&[0.215, 0.17, 0.14][..], &[0.2, 0.15]][pick(2)];
        let sequence = ["alternate", "one-way"][pick(2)];
        let (tab, overlap) = ([0, 3][pick(2)], [0.0, 0.5, 1.5][pick(3)]);
        let lead = ["perpendicular", "arc", "straight"][pick(3)];
        let (format, compensation) = [
            (Format::ThreeB, "path"),
            (Format::Iso, "path"),
            (Format::Iso, "controller"),
        ][(number / 72 + number) % 3];
        let role = [Role::Punch, Role::Opening][pick(2)];
        // A limit without a tab is a contradiction.
        let limit = if tab == 0 { "" } else { "slug-limit = 1\n" };
        let text = format!(
            "wire-diameter = 0.25\ngap = 0.015\n[job]\nthickness = 40\n{limit}[passes]\ncorrections = {corrections:?}\n\
             sequence = \"{sequence}\"\n[program]\ntab = {tab}\nclosing-overlap = {overlap:?}\nlead = \"{lead}\"\n\
             compensation = \"{compensation}\"\n"
        );
        let settings = settings(&text);
        let program = held(&drawing(role, &PLATE), &settings, format);
        let drawn = convert::cuts(&program).drawing();
        let mut contours = Vec::new();
        for (_, entity) in drawn.entities() {
            let Geometry::Polyline { closed, .. } = &entity.geometry else {
                assert_eq!(&*entity.layer, "LEAD", "{text}");
                continue;
            };
            if &*entity.layer != "LEAD" {
                assert!(closed, "{text}");
                let ends = || entity.geometry.segments().map(|it| it.start());
                let size = |axis: usize| {
                    let (least, most) = (
                        ends().map(|at| at[axis]).fold(f64::INFINITY, f64::min),
                        ends().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max),
                    );
                    most - least
                };
                contours.push((entity.layer.to_string(), size(0), size(1)));
            }
        }
        // One way up to a tab, each pass goes back as it came. Under the control no block says that it cuts nothing then:
        // a pass the other way has the same coordinates.
        let count = corrections.len();
        let goes_back = tab > 0 && sequence == "one-way" && compensation == "controller";
        let keeps_tab = goes_back && (role == Role::Punch || !limit.is_empty());
        let runs: Vec<f64> = (0..count)
            .flat_map(|pass| {
                let is_gone_back = keeps_tab && (pass + 1 < count || count % 2 == 0);
                vec![corrections[pass]; 1 + usize::from(is_gone_back)]
            })
            .collect();
        assert_eq!(contours.len(), runs.len(), "{text}{contours:?}");
        for (index, correction) in runs.iter().enumerate() {
            let (layer, width, height) = &contours[index];
            let wanted = match index + 1 == runs.len() {
                true => "CUT".to_owned(),
                false => format!("PASS{}", index + 1),
            };
            assert_eq!(*layer, wanted, "{text}");
            let beside = match (compensation, role) {
                ("controller", _) => 0.0,
                (_, Role::Punch) => 2.0 * correction,
                _ => -2.0 * correction,
            };
            let off = (width - 40.0 - beside)
                .abs()
                .max((height - 20.0 - beside).abs());
            assert!(off < 0.003, "{text}{contours:?}");
        }
        made += 1;
    }
    assert_eq!(made, 144);
}
