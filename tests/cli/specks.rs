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
            "generate fixed.dxf --side opening --format {format} -o {out} --overwrite"
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

/// A rectangle with a bump of a chord, mm, and a bulge in its lower side, or in its lower left corner.
fn with_bump(chord: f64, bulge: f64, is_in_corner: bool) -> String {
    let header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
    let bump = match is_in_corner {
        true => [(0.0, chord, bulge), (chord, 0.0, 0.0)],
        false => [(20.0, 0.0, bulge), (20.0 + chord, 0.0, 0.0)],
    };
    let rest = [(40.0, 0.0, 0.0), (40.0, 20.0, 0.0), (0.0, 20.0, 0.0)];
    let first = (!is_in_corner).then_some((0.0, 0.0, 0.0));
    let vertices: Vec<_> = first.into_iter().chain(bump).chain(rest).collect();
    let vertex = |(x, y, bulge): &(f64, f64, f64)| format!("10\n{x}\n20\n{y}\n42\n{bulge}\n");
    let all: String = vertices.iter().map(vertex).collect();
    let count = vertices.len();
    format!(
        "{header}0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n5\n2A\n8\n0\n90\n{count}\n70\n1\n{all}0\nENDSEC\n0\nEOF\n"
    )
}

/// A bump that nobody can measure blocks no program, nor does such a rounding of a corner; one that can be measured does.
#[test]
fn an_arc_below_the_resolution_is_no_small_radius() {
    let desk = Desk::new();
    for (chord, bulge, is_in_corner, is_found) in [
        (1e-6, 3.0, false, false),
        (1e-5, 0.5, false, false),
        (1e-5, 0.9, false, false),
        (1e-4, 0.5, false, false),
        (9e-4, 0.5, false, false),
        (9e-4, 3.0, false, true),
        (2e-3, 0.5, false, true),
        (1e-2, 0.5, false, true),
        (5e-4, 0.414_213_56, true, false),
        (5e-3, 0.414_213_56, true, true),
        (0.05, 0.414_213_56, true, true),
    ] {
        let what = format!("{chord} {bulge} {is_in_corner}");
        desk.write("bump.dxf", with_bump(chord, bulge, is_in_corner));
        // The wire runs where the centre of the arc lies.
        let checked = desk.run("check bump.dxf --side opening");
        let found = checked.stdout.contains("error[small-radius]");
        assert_eq!(found, is_found, "{what}: {checked:?}");
        let settings = "--side opening --format iso --lead-in 2";
        let made = desk.run(&format!(
            "generate bump.dxf {settings} -o bump.iso --overwrite"
        ));
        assert_eq!(made.code, Some(i32::from(is_found)), "{what}: {made:?}");
        if !is_found {
            let proof = made.stderr.split("at most ").nth(1);
            let off = proof.and_then(|off| off.split(' ').next()?.parse::<f64>().ok());
            assert!(off.is_some_and(|off| off < 1.0), "{what}: {made:?}");
        }
    }
}
