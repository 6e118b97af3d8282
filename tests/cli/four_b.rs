//! What is said of a program in 4B.

use super::Desk;

fn outline(vertices: &[(f64, f64)]) -> String {
    let header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
    let vertex = |(x, y): &(f64, f64)| format!("10\n{x}\n20\n{y}\n");
    let all: String = vertices.iter().map(vertex).collect();
    let count = vertices.len();
    format!(
        "{header}0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n5\n2A\n8\n0\n90\n{count}\n70\n1\n{all}0\nENDSEC\n0\nEOF\n"
    )
}

/// 4B rounds a punch at its corners: how much each loses is said at its place. `R (1 / cos(θ/2) − 1)` for a corner that turns by θ.
#[test]
fn corners_that_4b_cuts_off_are_named() {
    let desk = Desk::new();
    desk.write("wedge.dxf", outline(&[(0.0, 0.0), (40.0, 0.0), (0.0, 8.0)]));
    let run = |format: &str, side: &str| {
        let made = desk.run(&format!(
            "generate wedge.dxf --side {side} --correction 0.15 --format {format}"
        ));
        assert_eq!(made.code, Some(0), "{made:?}");
        made.stderr
    };
    let said = run("4b", "punch");
    let turn = |degrees: f64| degrees.to_radians();
    let acute = turn(180.0) - (8.0_f64 / 40.0).atan();
    for (turn, place) in [
        (turn(90.0), "segment 0, at 0.000, 0.000"),
        (acute, "segment 1, at 40.000, 0.000"),
    ] {
        // R is the correction and 1 µm, and grows by up to 4 µm.
        let depth = |radius: f64| radius * (1.0 / (turn / 2.0).cos() - 1.0);
        let told: Vec<f64> = said
            .split("warning[sharp-corner]")
            .filter(|one| one.contains(place))
            .filter_map(|one| {
                one.split("cuts off ")
                    .nth(1)?
                    .split(' ')
                    .next()?
                    .parse()
                    .ok()
            })
            .collect();
        let [told] = told[..] else {
            panic!("{place}: {said}");
        };
        let allowed = depth(0.151) - 6e-4..=depth(0.155) + 6e-4;
        assert!(allowed.contains(&told), "{told} in {allowed:?}: {said}");
    }
    for (format, side) in [("4b", "opening"), ("3b", "punch"), ("iso", "punch")] {
        let said = run(format, side);
        assert!(!said.contains("sharp-corner"), "{format} {side}: {said}");
    }
}
