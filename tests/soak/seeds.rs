//! The documents that a soak begins with: all kinds, sound ones and such that have something to mend.

use super::model::Model;
use crate::support::{TIGHT, dxf_of, tight_plate, wide_plate};
use serde_json::{Value, json};

const ISO: &str = "%
N10 G90 G92 X0 Y0
N20 G41 D1 G01 X5. Y0
N30 G01 X5. Y5.
N40 G03 X0. Y10. I-5. J0
N50 G01 X-5. Y10.
N60 G01 X-5. Y-5.
N70 G01 X5. Y-5.
N80 G01 X5. Y0.
N90 G40 G01 X0 Y0
N100 M02
%
";

const CALLS: &str = "G90 G92 X0 Y0
G91
M98 P100 L3
G00 X10.
M98 P100
M02
O100
G01 X2.
G02 X1. Y-1. I0 J-1.
G01 Y-2.
G01 X-3.
G01 Y3.
M99
";

const CHECKING: &str = "Start Point = 0.000 , 0.000 ; X , Y
N 1: B 9900 B 0 B 9900 GX L1 ; 9.900 , 0.000
N 2: B 9900 B 0 B 39600 GY NR1 ; 9.900 , 0.000
N 3: B 9900 B 0 B 9900 GX L3 ; 0.000 , 0.000
DD
";

const FOUR_B: &str = "N1 B5000B0B5000GXL1
N2 B0B5000B5000GYL2
N3 B5000B0B5000GXL3
N4 B0B5000B5000GYL4
D
N5 B1000B1000B2000B1000GXSR1D
DD
";

fn data(name: &str) -> String {
    let path = format!("{}/tests/data/{name}", env!("CARGO_MANIFEST_DIR"));
    String::from_utf8_lossy(&std::fs::read(&path).expect(&path)).into_owned()
}

/// Lines and an arc in DXF that come together, with doubles and a gap.
fn lines() -> String {
    let line = |handle: &str, from: [f64; 2], to: [f64; 2]| {
        format!(
            "0\nLINE\n5\n{handle}\n8\n0\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n",
            from[0], from[1], to[0], to[1]
        )
    };
    let entities = line("A1", [0.0, 0.0], [10.0, 0.0])
        + &line("A2", [10.0, 0.0], [10.0, 10.0])
        + &line("A3", [10.0, 10.0], [0.0, 10.004])
        + &line("A4", [0.0, 10.0], [0.0, 0.0])
        + &line("A5", [10.0, 0.0], [10.0, 10.0])
        + "0\nCIRCLE\n5\nA6\n8\n0\n10\n5\n20\n5\n40\n2\n0\nARC\n5\nA7\n8\n0\n10\n20\n20\n5\n40\n3\n50\n0\n51\n180\n";
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
    )
}

fn blocks() -> String {
    "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB\n10\n0\n20\n0\n0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n1\n0\nENDBLK\n0\nENDSEC\n\
     0\nSECTION\n2\nENTITIES\n0\nINSERT\n5\nB1\n2\nB\n10\n5\n20\n5\n70\n3\n71\n2\n44\n4\n45\n4\n\
     0\nELLIPSE\n5\nB2\n10\n0\n20\n20\n11\n5\n21\n0\n40\n0.4\n41\n0\n42\n6.283185307179586\n0\nENDSEC\n0\nEOF\n"
        .into()
}

/// A corner of chords, a crossing, lines and a circle.
fn mixed() -> Vec<Value> {
    vec![
        json!({ "handle": "E1", "type": "polyline", "closed": true,
            "vertices": [[0, 0], [20, 0], [20, 9.95], [19.985, 9.98], [19.95, 10], [10, 10], [10, 9.9], [0, 9.9]] }),
        json!({ "handle": "E2", "type": "line", "start": [30, 0], "end": [40, 0] }),
        json!({ "handle": "E3", "type": "line", "start": [40, 0.003], "end": [40, 10] }),
        json!({ "handle": "E4", "type": "circle", "center": [50, 5], "radius": 4 }),
        json!({ "handle": "E5", "type": "polyline", "closed": true, "vertices": [[60, 0], [70, 10], [70, 0], [60, 10]] }),
    ]
}

pub fn models() -> Vec<Model> {
    let program = |name: &str| data(&format!("programs/{name}"));
    let plates = dxf_of(&[("2A", &TIGHT)]);
    // No program has the name of a drawing: each document is compared with itself alone, opened from scratch.
    vec![
        Model::text("file:///plate.dxf", "dxf", &plates),
        Model::text("file:///lines.dxf", "dxf", &lines()),
        Model::text("file:///blocks.dxf", "dxf", &blocks()),
        Model::text("file:///narrow.dxf", "dxf", &data("narrow.dxf")),
        Model::text("file:///chain.dxf", "dxf", &data("chain.dxf")),
        Model::drawing("cad:///plates", vec![tight_plate("2A"), wide_plate("2B")]),
        Model::drawing("cad:///mixed", mixed()),
        Model::text("file:///hole.3b", "3b", &data("hole.3b")),
        Model::text("file:///checking.3b", "3b", CHECKING),
        Model::text(
            "file:///holes.3b",
            "3b",
            &program("right/two_holes_with_pauses.3b"),
        ),
        Model::text(
            "file:///three_arcs.3b",
            "3b",
            &program("right/plate_with_three_arcs.3b"),
        ),
        Model::text("file:///numbers.3b", "3b", &program("wrong/numbers.3b")),
        Model::text("file:///four.4b", "3b", FOUR_B),
        Model::text("file:///contour.nc", "wire-iso", ISO),
        Model::text("file:///calls.nc", "wire-iso", CALLS),
    ]
}
