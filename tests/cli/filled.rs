//! What encloses an area without being its contour is named.

use super::Desk;

const BLOCKS: &str = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nRING\n10\n0\n20\n0\n0\nLWPOLYLINE\n8\n0\n90\n2\n70\n1\n43\n1.5\n10\n0\n20\n0\n42\n1\n10\n10\n20\n0\n42\n1\n0\nENDBLK\n0\nENDSEC\n";

/// Entities, what is said of them, and how many contours they make.
#[test]
fn what_encloses_without_being_a_contour_is_named() {
    for (name, entities, said, contours) in [
        (
            "a ring of two wide half circles",
            "0\nLWPOLYLINE\n5\nA\n8\n0\n90\n2\n70\n1\n43\n1.5\n10\n0\n20\n0\n42\n1\n10\n10\n20\n0\n42\n1\n",
            "polylines with a width (1, up to 1.500 mm wide)",
            1,
        ),
        (
            "widths of single vertices, and an old polyline",
            "0\nLWPOLYLINE\n5\nA\n8\n0\n90\n3\n70\n1\n10\n0\n20\n0\n40\n0.2\n41\n0.4\n10\n10\n20\n0\n10\n5\n20\n8\n\
0\nPOLYLINE\n5\nB\n8\n0\n66\n1\n70\n1\n40\n2\n41\n2\n0\nVERTEX\n8\n0\n10\n20\n20\n0\n0\nVERTEX\n8\n0\n10\n30\n20\n0\n0\nVERTEX\n8\n0\n10\n25\n20\n8\n0\nSEQEND\n",
            "polylines with a width (2, up to 2.000 mm wide)",
            2,
        ),
        (
            "in a block, drawn twice as large",
            "0\nINSERT\n5\nA\n8\n0\n2\nRING\n10\n0\n20\n0\n41\n2\n42\n2\n43\n2\n",
            "polylines with a width (1, up to 3.000 mm wide)",
            1,
        ),
        (
            "a width of nothing",
            "0\nLWPOLYLINE\n5\nA\n8\n0\n90\n3\n70\n1\n43\n0\n10\n0\n20\n0\n10\n10\n20\n0\n10\n5\n20\n8\n",
            "",
            1,
        ),
        (
            "a hatch",
            "0\nHATCH\n5\nA\n8\n0\n10\n0\n20\n0\n30\n0\n2\nSOLID\n70\n1\n71\n0\n91\n1\n92\n2\n72\n0\n73\n1\n93\n3\n10\n0\n20\n0\n10\n10\n20\n0\n10\n5\n20\n8\n97\n0\n75\n0\n76\n1\n98\n0\n",
            "HATCH is not cut: what it fills is cut along lines and arcs",
            0,
        ),
        (
            "a region",
            "0\nREGION\n5\nA\n8\n0\n70\n1\n1\nnothing that can be read\n",
            "REGION is not cut: its edges are kept in a form",
            0,
        ),
        (
            "a solid",
            "0\nSOLID\n5\nA\n8\n0\n10\n0\n20\n0\n11\n1\n21\n0\n12\n0\n22\n1\n",
            "SOLID is not cut: it is a filled area",
            0,
        ),
    ] {
        let desk = Desk::new();
        desk.write(
            "a.dxf",
            format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n{BLOCKS}0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"),
        );
        let checked = desk.run("check a.dxf --side punch");
        let told = checked.stdout.matches("unsupported-entity").count();
        assert_eq!(told, usize::from(!said.is_empty()), "{name}: {checked:?}");
        assert!(checked.stdout.contains(said), "{name}: {checked:?}");
        let found = desk.run("contours a.dxf --output json --side punch");
        let count = match found.code {
            Some(0) => found.json()["contours"].as_array().unwrap().len(),
            _ => 0,
        };
        assert_eq!(count, contours, "{name}: {found:?}");
    }
}
