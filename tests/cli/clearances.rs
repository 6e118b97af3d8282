//! The clearance of a pair beside the corrections of its passes.

use super::Desk;

/// Which number is above which, and what to change.
#[test]
fn a_clearance_above_corrections_of_several_passes_is_named_with_them() {
    let desk = Desk::new();
    let wire = "--wire-diameter 0.1 --gap 0.01 --passes 0.2,0.15";
    for (pair, says) in [
        (
            "--drawn-as punch --clearance 0.3",
            "pair.clearance 0.3 mm is above all corrections 0.2, 0.15: the wire of the plate",
        ),
        (
            "--drawn-as plate --clearance 0.3",
            "pair.clearance 0.3 mm is above all corrections 0.2, 0.15: the wire of the punch",
        ),
        (
            "--drawn-as punch --clearance 0.17",
            "pair.clearance 0.17 mm lies between the corrections 0.2, 0.15: some passes of the plate",
        ),
        (
            "--drawn-as plate --clearance 0.01 --stripper 0.3",
            "pair.stripper - pair.clearance 0.29 mm is above all corrections 0.2, 0.15: the wire of the stripper",
        ),
    ] {
        let refused = desk.run(&format!("pair clean.dxf {wire} {pair} --force"));
        assert!(
            refused.code == Some(1) && refused.stderr.contains(says),
            "{pair}: {refused:?}"
        );
    }
}
