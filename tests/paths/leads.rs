//! Leads and ways between contours through what lies beside.

use super::{circle, drawing, handle, rectangle, settings, threads};
use wedm::drawing::{Drawing, Outline, Role};
use wedm::finding::{Detail, Finding, Rule};
use wedm::geometry::Point;
use wedm::settings::{Compensation, Effective};
use wedm::toolpath::{Refusal, plan};

/// The one finding `lead-in` that refuses a path: the contours that it stands at and that are in the way, and its sentence.
#[track_caller]
fn refused(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    handles: Option<&[String]>,
) -> (String, Vec<String>, String) {
    match plan(drawing, outlines, settings, handles) {
        Err(Refusal::Findings(found)) => {
            let [
                Finding {
                    rule: Rule::LeadIn,
                    place,
                    related,
                    detail: Detail::Said(sentence),
                    ..
                },
            ] = &found[..]
            else {
                panic!("{found:?}")
            };
            (
                handle(drawing, place),
                related.iter().map(|place| handle(drawing, place)).collect(),
                sentence.clone(),
            )
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_lead_through_another_part_is_an_error_at_both() {
    let punch = Some(Role::Punch);
    let two = [
        ("2A", punch, rectangle([0.0, 0.0], [10.0, 10.0])),
        ("2B", punch, rectangle([12.0, 0.0], [8.0, 10.0])),
    ];
    let (drawing, outlines) = drawing(&two);
    let with = |at: [f64; 2]| Effective {
        thread: threads(&[("2A", at)]),
        ..settings()
    };
    for (at, says) in [
        ([25.0, 5.0], "cuts into contour 2B"),
        (
            [11.95, 5.0],
            "cuts into contour 2B or comes nearer to it than the correction 0.100 mm",
        ),
        ([11.85, 5.0], "runs into the cut along contour 2B"),
        ([19.0, 5.0], "cuts into contour 2B"),
        ([16.0, 5.0], "cuts into contour 2B"),
        ([12.0, 5.0], "cuts into contour 2B"),
    ] {
        let (at_contour, others, sentence) = refused(&drawing, &outlines, &with(at), None);
        assert_eq!(
            (at_contour.as_str(), &others[..]),
            ("2A", &["2B".to_string()][..]),
            "{at:?}: {sentence}"
        );
        assert!(sentence.contains(says), "{at:?}: {sentence}");
        // Also where the other one is not cut in this program: it stands in the drawing.
        if !says.starts_with("runs") {
            assert_eq!(
                refused(&drawing, &outlines, &with(at), Some(&["2A".into()])).1,
                ["2B"],
                "{at:?}"
            );
        }
    }
    for at in [[11.0, 5.0], [11.69, 5.0], [5.0, -4.0], [11.0, 12.0]] {
        assert!(plan(&drawing, &outlines, &with(at), None).is_ok(), "{at:?}");
    }
    // One that is found goes round nothing: it is shortened until it is clear of the other part.
    let near = [
        ("2A", punch, rectangle([0.0, 0.0], [10.0, 11.0])),
        ("2B", punch, rectangle([11.0, -3.0], [8.0, 30.0])),
    ];
    let (drawing, outlines) = self::drawing(&near);
    let paths = plan(
        &drawing,
        &outlines,
        &Effective {
            entry: threads(&[("2A", [10.0, 5.0])]),
            ..settings()
        },
        None,
    )
    .unwrap();
    assert_eq!(paths[0].thread_hole, Point::new(10.375, 5.0));
}

#[test]
fn without_compensation_a_lead_does_not_cut_through_a_closed_contour() {
    let both = None;
    let two = [
        ("2A", both, rectangle([0.0, 0.0], [10.0, 10.0])),
        ("2B", both, rectangle([12.0, 0.0], [8.0, 10.0])),
    ];
    let (drawing, outlines) = drawing(&two);
    let with = |at| Effective {
        thread: threads(&[("2A", at)]),
        compensation: Compensation::None,
        ..settings()
    };
    let (at_contour, others, sentence) = refused(&drawing, &outlines, &with([25.0, 5.0]), None);
    assert_eq!(
        (at_contour.as_str(), &others[..]),
        ("2A", &["2B".to_string()][..]),
        "{sentence}"
    );
    assert!(plan(&drawing, &outlines, &with([11.5, 5.0]), None).is_ok());
}

#[test]
fn the_way_between_contours_is_checked_where_the_wire_stays_threaded() {
    let opening = Some(Role::Opening);
    let three = [
        ("2A", opening, circle(0.0, 0.0, 3.0)),
        ("2B", opening, circle(20.0, 0.0, 3.0)),
    ];
    let (drawing, outlines) = drawing(&three);
    assert!(plan(&drawing, &outlines, &settings(), None).is_ok());
    let (at_contour, _, sentence) = refused(
        &drawing,
        &outlines,
        &Effective {
            stays_threaded: true,
            ..settings()
        },
        None,
    );
    assert_eq!(at_contour, "2B");
    assert!(sentence.contains("the wire stays threaded"), "{sentence}");
}
