//! Doubles that were set aside.

use super::{drawing, settings};
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Geometry, Role};
use wedm::settings::{Compensation, Effective};
use wedm::toolpath::plan;

/// A double that was set aside is no contour to cut, wherever it stands in the drawing; its handle means the contour that is.
#[test]
fn a_double_is_no_contour_to_cut() {
    let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    let side = |at: usize| Geometry::Line {
        start: corners[at % 4].into(),
        end: corners[(at + 1) % 4].into(),
    };
    let reversed = |at: usize| Geometry::Line {
        start: corners[(at + 1) % 4].into(),
        end: corners[at % 4].into(),
    };
    for double in 0..4 {
        for place in 0..5 {
            for geometry in [side(double), reversed(double)] {
                let mut sides: Vec<(&str, Option<Role>, Geometry)> = ["20", "21", "22", "23"]
                    .into_iter()
                    .enumerate()
                    .map(|(at, handle)| (handle, None, side(at)))
                    .collect();
                sides.insert(place, ("24", None, geometry));
                let (drawing, _) = drawing(&sides);
                let opening = Effective {
                    side: wedm::settings::SideSetting::Opening,
                    ..settings()
                };
                let outlines = Analysis::new(&drawing, Arc::new(opening.clone()))
                    .outlines(&drawing)
                    .clone();
                for compensation in [
                    Compensation::Path,
                    Compensation::Controller,
                    Compensation::None,
                ] {
                    let settings = Effective {
                        compensation,
                        ..opening.clone()
                    };
                    let all = plan(&drawing, &outlines, &settings, None).unwrap();
                    assert_eq!(all.len(), 1, "{sides:?}");
                    assert!(outlines[all[0].outline].contour.closed);
                    for handle in ["20", "24", &format!("2{double}")] {
                        let chosen = [handle.to_string()];
                        assert_eq!(
                            plan(&drawing, &outlines, &settings, Some(&chosen)).unwrap(),
                            all
                        );
                    }
                }
            }
        }
    }
}
