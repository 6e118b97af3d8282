//! What no machine follows is left out of a program, which is proved as ever.

use super::Desk;

/// A repaired fillet leaves an arc of 1.6 µm in the wire's path.
#[test]
fn no_speck_of_a_path_is_left_in_a_program() {
    let desk = Desk::new();
    let fixed = desk.run("fix tight_fillet.dxf -o fixed.dxf");
    assert_eq!(fixed.code, Some(0), "{fixed:?}");
    for (format, ending) in [("3b", "3b"), ("iso", "iso")] {
        let out = format!("out.{ending}");
        let made = desk.run(&format!(
            "generate fixed.dxf --side opening --format {format} -o {out}"
        ));
        assert_eq!(made.code, Some(0), "{made:?}");
        let simulated = desk.run(&format!("simulate {out} --output json")).json();
        let blocks = simulated["blocks"].as_array().unwrap();
        let lengths: Vec<f64> = blocks
            .iter()
            .filter(|block| ["line", "arc"].contains(&block["kind"].as_str().unwrap()))
            .map(|block| {
                let of = |at: &str| [0, 1].map(|axis| block[at][axis].as_f64().unwrap());
                let ([x, y], [x1, y1]) = (of("start"), of("end"));
                (x1 - x).hypot(y1 - y)
            })
            .collect();
        assert!(
            lengths.len() > 6 && lengths.iter().all(|length| *length > 10.0),
            "{format}: {lengths:?}"
        );
        let checked = desk.run(&format!("check {out} fixed.dxf"));
        assert!(!checked.stdout.contains("not-the-drawing"), "{checked:?}");
    }
}
