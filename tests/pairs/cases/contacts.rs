//! Outlines that cross, touch, or run on one another.

use super::*;

fn line(start: [f64; 2], end: [f64; 2]) -> Geometry {
    Geometry::Line {
        start: start.into(),
        end: end.into(),
    }
}

fn check_contacts(name: &str, entities: &[Geometry], expected: &[([f64; 2], bool, Severity)]) {
    let (_, _, findings) = found(entities, Role::Both, Rule::SelfIntersection);
    let mut contacts: Vec<([f64; 2], bool, Severity)> = findings
        .iter()
        .map(|finding| match finding.detail {
            Detail::SelfIntersection { at, touches, .. } => {
                let rounded = |number: f64| (number * 1e3).round() / 1e3 + 0.0;
                ([rounded(at.x), rounded(at.y)], touches, finding.severity)
            }
            _ => panic!("{finding:?}"),
        })
        .collect();
    contacts.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    assert_eq!(contacts, expected, "{name}");
}

#[test]
fn outlines_cross_and_touch() {
    use Severity::{Error, Warning};
    let (cross, touch) = (false, true);
    check_contacts("a square", &[square(0., 0., 4.)], &[]);
    check_contacts(
        "a bow tie",
        &[ring(&[[0., 0.], [4., 4.], [4., 0.], [0., 4.]])],
        &[([2., 2.], cross, Error)],
    );
    check_contacts(
        "two squares apart",
        &[square(0., 0., 4.), square(4.1, 0., 4.)],
        &[],
    );
    check_contacts(
        "two squares that cross",
        &[square(0., 0., 4.), square(2., 1., 4.)],
        &[([2., 4.], cross, Error), ([4., 1.], cross, Error)],
    );
    check_contacts(
        "corner on a side",
        &[square(0., 0., 4.), ring(&[[4., 2.], [6., 0.], [6., 4.]])],
        &[([4., 2.], touch, Error)],
    );
    check_contacts(
        "corner through a side",
        &[square(0., 0., 4.), ring(&[[3., 2.], [6., 0.], [6., 4.]])],
        &[([4., 1.333], cross, Error), ([4., 2.667], cross, Error)],
    );
    check_contacts(
        "a vertex on a side, and on to the other side of it",
        &[
            square(0., 0., 4.),
            ring(&[[2., 1.], [4., 2.], [6., 3.], [6., 9.], [2., 9.]]),
        ],
        &[([2., 4.], cross, Error), ([4., 2.], cross, Error)],
    );
    check_contacts(
        "two loops that touch in a vertex",
        &[ring(&[
            [0., 0.],
            [2., 2.],
            [4., 4.],
            [4., 0.],
            [2., 2.],
            [0., 4.],
        ])],
        &[([2., 2.], cross, Error)],
    );
    check_contacts(
        "the same vertex without a crossing",
        &[ring(&[
            [0., 0.],
            [2., 2.],
            [4., 0.],
            [4., 4.],
            [2., 2.],
            [0., 4.],
        ])],
        &[([2., 2.], touch, Error)],
    );
    check_contacts(
        "circles that touch",
        &[circle([0., 0.], 2.), circle([5., 0.], 3.)],
        &[([2., 0.], touch, Error)],
    );
    check_contacts(
        "circles that touch from within",
        &[circle([0., 0.], 2.), circle([0., 1.], 1.)],
        &[([0., 2.], touch, Error)],
    );
    check_contacts(
        "circles that cross",
        &[circle([0., 0.], 5.), circle([6., 0.], 5.)],
        &[([3., 4.], cross, Error)],
    );
    check_contacts(
        "a line tangent to a circle",
        &[circle([0., 0.], 2.), line([-5., 2.], [5., 2.])],
        &[([0., 2.], touch, Warning)],
    );
    check_contacts(
        "lines that lead into a circle",
        &[
            circle([0., 0.], 2.),
            open(&[[-5., 0.], [-5., 1.], [0., 1.]]),
        ],
        &[([-1.732, 1.], cross, Error)],
    );
    check_contacts(
        "a corner on a circle, from within",
        &[
            circle([0., 0.], 2.),
            ring(&[[0., 2.], [-0.5, 1.], [0.5, 1.]]),
        ],
        &[([0., 2.], touch, Error)],
    );
    check_contacts(
        "a vertex on a circle, and on to the other side of it",
        &[
            circle([0., 0.], 2.),
            ring(&[[0., 1.], [0., 2.], [0.5, 3.], [3., 3.], [3., 1.]]),
        ],
        &[([0., 2.], cross, Error), ([1.732, 1.], cross, Error)],
    );
    check_contacts(
        "a lead-in that ends on a side",
        &[square(0., 0., 4.), open(&[[2., 1.], [2., 2.], [4., 2.]])],
        &[([4., 2.], touch, Warning)],
    );
    check_contacts(
        "a lead-in that ends in a corner",
        &[square(0., 0., 4.), open(&[[2., 1.], [2., 2.], [4., 4.]])],
        &[([4., 4.], touch, Warning)],
    );
    check_contacts(
        "a lead-in that reaches past",
        &[square(0., 0., 4.), open(&[[2., 1.], [2., 2.], [4.5, 2.]])],
        &[([4., 2.], cross, Error)],
    );
    check_contacts(
        "an open chain that ends on itself",
        &[open(&[
            [2., 2.],
            [4., 2.],
            [4., 4.],
            [0., 4.],
            [0., 0.],
            [4., 0.],
            [4., 2.],
        ])],
        &[([4., 2.], touch, Warning)],
    );
    check_contacts(
        "an arc that comes back through its neighbour",
        &[
            line([-5., 0.], [0., 0.]),
            // From the end of the line over the top and back through it.
            arc([-1., 1.], 2f64.sqrt(), -PI / 4., PI * 1.4),
        ],
        &[([-2., 0.], cross, Error)],
    );
    check_contacts(
        "an arc that comes back onto its neighbour",
        &[line([-5., 0.], [0., 0.]), arc([-1., 0.], 1., 0., PI)],
        &[([-2., 0.], touch, Warning)],
    );
    check_contacts(
        "a rounded slot",
        &[closed(&[
            [0., 0., 0.],
            [4., 0., 1.],
            [4., 2., 0.],
            [0., 2., 1.],
        ])],
        &[],
    );
    check_contacts(
        "a sharp spike",
        &[ring(&[[0., 0.], [10., 0.05], [0., 0.1], [-5., 5.]])],
        &[],
    );
    check_contacts(
        "a tiny chamfer",
        &[ring(&[
            [0., 0.],
            [3.9995, 0.],
            [4., 0.0005],
            [4., 4.],
            [0., 4.],
        ])],
        &[],
    );
    check_contacts(
        "two squares that share a side",
        &[square(0., 0., 4.), square(4., 0., 4.)],
        &[],
    );
    check_contacts("a double", &[square(0., 0., 4.), square(0., 0., 4.)], &[]);
}

fn check_overlaps(name: &str, entities: &[Geometry], expected: &[(f64, usize)]) {
    let (drawing, analysis, findings) = found(entities, Role::Both, Rule::Overlap);
    let told = |finding: &Finding| match finding.detail {
        Detail::Overlap { length } => (
            (length * 1e3).round() / 1e3,
            analysis.fixes(&drawing, finding).len(),
        ),
        _ => panic!("{finding:?}"),
    };
    assert_eq!(
        findings.iter().map(told).collect::<Vec<_>>(),
        expected,
        "{name}"
    );
}

#[test]
fn segments_run_on_one_another() {
    check_overlaps(
        "lines end to end",
        &[line([0., 0.], [4., 0.]), line([4., 0.], [8., 0.])],
        &[],
    );
    check_overlaps(
        "lines that reach past each other a little",
        &[line([0., 0.], [4.004, 0.]), line([3.996, 0.], [8., 0.])],
        &[],
    );
    check_overlaps(
        "half on one another",
        &[line([0., 0.], [4., 0.]), line([6., 0.], [3., 0.])],
        &[(1.0, 0)],
    );
    check_overlaps(
        "one within the other",
        &[line([0., 0.], [4., 0.]), line([3., 0.], [1., 0.001])],
        &[(2.0, 1)],
    );
    check_overlaps(
        "beside one another",
        &[line([0., 0.], [4., 0.]), line([3., 0.006], [1., 0.006])],
        &[],
    );
    check_overlaps(
        "a double",
        &[line([0., 0.], [4., 0.]), line([4., 0.], [0., 0.])],
        &[],
    );
    check_overlaps(
        "a double of many sides",
        &[square(0., 0., 4.), square(0., 0., 4.)],
        &[],
    );
    check_overlaps(
        "a common side",
        &[square(0., 0., 4.), square(4., 1., 4.)],
        &[(3.0, 0)],
    );
    check_overlaps(
        "there and back",
        &[open(&[[0., 0.], [4., 0.], [1., 0.]])],
        &[(3.0, 0)],
    );
    check_overlaps(
        "arcs of one circle",
        &[
            arc([0., 0.], 2., 0., PI),
            arc([0., 0.], 2., FRAC_PI_2, 1.5 * PI),
        ],
        &[((PI * 1e3).round() / 1e3, 0)],
    );
    check_overlaps(
        "an arc on a circle",
        &[circle([1., 0.], 2.), arc([1., 0.], 2., 1., 2.)],
        &[(2.0, 1)],
    );
    check_overlaps(
        "crossing at a small angle",
        &[line([0., 0.], [4., 0.]), line([0., -0.1], [4., 0.1])],
        &[],
    );
}
