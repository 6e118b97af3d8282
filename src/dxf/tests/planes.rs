//! Blocks that are tilted in space and end level with the drawing, against the result of ezdxf for the same files
//! (`tests/data/planes/make.py`).

use super::blocks::with_blocks;
use super::reading::{entities, findings};
use crate::dxf::Document;
use crate::geometry::{Point, Segment};

/// The largest distance of a point of a curve from the arcs that replace it, in drawing units.
const FITTED: f64 = 1e-3;

#[test]
fn what_ends_level_lies_where_ezdxf_says() {
    macro_rules! files {
        ($($name:literal),*) => {
            [$(($name, include_str!(concat!("../../../tests/data/planes/", $name, ".dxf")),
                include_str!(concat!("../../../tests/data/planes/", $name, ".points")))),*]
        };
    }
    for (name, text, expected) in files!(
        "standing",
        "lying_on_its_side",
        "askew",
        "mirrored",
        "seen_from_below_twice",
        "tilted_and_back",
        "three_deep"
    ) {
        let document = Document::read(text.as_bytes().to_vec());
        let segments: Vec<Segment> = document
            .drawing()
            .entities()
            .flat_map(|(_, entity)| entity.geometry.segments())
            .collect();
        let kinds: Vec<&str> = document
            .drawing()
            .entities()
            .map(|(_, entity)| entity.kind.name())
            .collect();
        assert_eq!(
            kinds,
            [
                "LINE",
                "ARC",
                "ARC",
                "CIRCLE",
                "LWPOLYLINE",
                "POLYLINE",
                "POLYLINE",
                "ELLIPSE",
                "ELLIPSE",
                "SPLINE"
            ],
            "{name}: {:?}",
            findings(&document)
        );
        let mut tilted = Vec::new();
        for line in expected.lines() {
            if let Some(kind) = line.strip_prefix("tilted ") {
                tilted.push(format!("information at \"INSERT\": 1 {kind}: its plane is tilted against the drawing's plane"));
                continue;
            }
            let numbers: Vec<f64> = line
                .split(' ')
                .map(|number| number.parse().unwrap())
                .collect();
            let point = Point::new(numbers[0], numbers[1]);
            let distance = segments
                .iter()
                .map(|segment| segment.distance_to(point))
                .fold(f64::INFINITY, f64::min);
            assert!(
                distance < FITTED,
                "{name}: {point} lies {distance} beside what is drawn"
            );
        }
        let said: Vec<String> = findings(&document)
            .into_iter()
            .filter(|finding| finding.contains("tilted"))
            .collect();
        assert_eq!(said, tilted, "{name}");
        // Only what ezdxf draws is drawn: the total is as long as the same shapes drawn level.
        let length: f64 = segments.iter().map(Segment::length).sum();
        assert!((length - LENGTH).abs() < 1e-2, "{name}: {length}");
    }
}

/// The length of what each of the files draws: the sum over its shapes, of curves by the points that ezdxf gives for them.
const LENGTH: f64 = 43.955_524_004;

#[test]
fn a_line_that_rises_is_cut_where_its_block_lays_it_down() {
    // A square that stands on the x axis: two of its sides rise in the block.
    let side = |from: &str, to: &str| {
        let [x, z] = [from, to].map(|end| end.split_once(' ').unwrap());
        format!(
            "0 LINE 8 0 10 {} 20 0 30 {} 11 {} 21 0 31 {} ",
            x.0, x.1, z.0, z.1
        )
    };
    let square = [
        ("0 0", "2 0"),
        ("2 0", "2 2"),
        ("2 2", "0 2"),
        ("0 2", "0 0"),
    ]
    .map(|(from, to)| side(from, to))
    .concat();
    let blocks = format!("0 BLOCK 2 B 10 0 20 0 30 0 {square} 0 ENDBLK ");
    // Turned about the x axis, so that z comes to lie on −y: extrusion (0, 1, 0) has x on −x and y on z.
    let document = Document::read(
        with_blocks(
            &blocks,
            "0 INSERT 5 A 8 P 2 B 10 0 20 0 30 0 210 0 220 1 230 0",
        )
        .into_bytes(),
    );
    assert_eq!(
        entities(&document),
        [
            "LINE A on P: 0 0 to -2 0",
            "LINE A on P: -2 0 to -2 2",
            "LINE A on P: -2 2 to 0 2",
            "LINE A on P: 0 2 to 0 0"
        ]
    );
}
