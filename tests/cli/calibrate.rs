//! `wedm calibrate`: the kerf from a cut test piece, and what contradicts itself.

use super::{Desk, check};
use wedm::calibration::{Measurement, Setup, calibrate, student_t};

const PIECE: &str = "\
feature,kind,pass,nominal,measured
# after the rough pass
A,outer,1,20,20.1132
B,outer,1,12,12.112
C,inner,1,10,9.887
A,outer,3,20,19.9995
A,outer,3,20,20.0005
B,outer,3,12,12.0016
C,inner,3,10,9.999
D,inner,3,6,6.0002
";
const PASSES: &str = "wire-diameter = 0.25\n\n[passes]\ncorrections = [0.215, 0.17, 0.14]\ngaps = [0.03, 0.015, 0.015]\n";

#[test]
fn a_piece_gives_the_kerf_of_each_pass_and_what_the_file_gets() {
    let desk = Desk::new();
    desk.write("shop/piece.csv", PIECE);
    desk.write("shop/wedm.toml", PASSES);
    check(
        &desk,
        "calibrate shop/piece.csv",
        0,
        &[
            // 0.215 − 0.113 / 2, and so on: 0.1584, 0.1590, 0.1585; t of two degrees of freedom is 4.303.
            "pass 1, cut with 0.2150 mm: half of the kerf 0.1586 ± 0.0010 mm from 3 features (outer 0.1587, inner 0.1585), gap 0.0336 ± 0.0010 mm\n",
            // A is one feature: 0.1400, 0.1392, 0.1395, 0.1401.
            "pass 3, cut with 0.1400 mm: half of the kerf 0.1397 ± 0.0010 mm from 4 features (outer 0.1396, inner 0.1398), gap 0.0147 ± 0.0010 mm\n",
            // The rough pass leaves 0.215 − 0.125 − 0.03 as before.
            "  passes.corrections = [0.2186, 0.1700, 0.1397]\n  passes.gaps = [0.0336, 0.0150, 0.0147]\n",
            "!with --write shop/wedm.toml gets:",
        ],
    );
    assert_eq!(desk.read("shop/wedm.toml"), PASSES.as_bytes());
    check(
        &desk,
        "calibrate shop/piece.csv --write",
        0,
        &["!written shop/wedm.toml:"],
    );
    let written = String::from_utf8(desk.read("shop/wedm.toml")).unwrap();
    let lines: Vec<&str> = written.lines().collect();
    let [first, blank, head, mark, corrections, again, gaps] = lines[..] else {
        panic!("{written}");
    };
    assert_eq!(
        [first, blank, head, corrections, gaps],
        [
            "wire-diameter = 0.25",
            "",
            "[passes]",
            "corrections = [0.2186, 0.1700, 0.1397]",
            "gaps = [0.0336, 0.0150, 0.0147]",
        ]
    );
    assert!(mark.starts_with("# calibrated 20"), "{mark}");
    assert!(
        mark.ends_with(
            ": pass 1, cut with 0.2150 mm, from 3 features, ± 0.0010 mm; pass 3, cut with 0.1400 mm, from 4 features, ± 0.0010 mm"
        ),
        "{mark}"
    );
    assert_eq!(mark, again);
    // A second time the comment is replaced, not repeated.
    check(
        &desk,
        "calibrate shop/piece.csv --passes 0.215,0.17,0.14 --write",
        0,
        &[],
    );
    let again = String::from_utf8(desk.read("shop/wedm.toml")).unwrap();
    assert_eq!(again.matches("# calibrated").count(), 2, "{again}");
    check(&desk, "check clean.dxf --config shop/wedm.toml", 0, &[]);
}

#[test]
fn a_script_reads_the_passes_and_the_settings() {
    let desk = Desk::new();
    let ended = desk.run("calibrate --outer 20=20.006 --inner 10=9.994 --correction 0.155 --wire-diameter 0.25 --output json");
    let expected = serde_json::json!({
        "passes": [{ "pass": 1, "correction": 0.155, "halfKerf": 0.152, "uncertainty": 0.001, "gap": 0.027, "features": 2, "outer": 0.152, "inner": 0.152 }],
        "settings": { "wire-diameter": 0.25, "gap": 0.027 },
    });
    let mut found = ended.json();
    for number in found["passes"][0].as_object_mut().unwrap().values_mut() {
        if let Some(length) = number.as_f64().filter(|_| number.is_f64()) {
            *number = ((length * 1e6).round() / 1e6).into();
        }
    }
    assert_eq!(found, expected);
    assert!(ended.stderr.contains("with --write"), "{ended:?}");
}

/// The options, the `wedm.toml`, how the command ends, and what it says.
#[test]
fn sizes_may_be_options_and_the_wire_may_be_unknown() {
    let rows: [(&str, Option<&str>, &[&str]); 5] = [
        (
            "--outer 20=20.006 --inner 10=9.994 --correction 0.155",
            None,
            &[
                "pass 1, cut with 0.1550 mm: half of the kerf 0.1520 ± 0.0010 mm from 2 features (outer 0.1520, inner 0.1520)\n",
                "gap: not known, since wire-diameter is not set\n",
                "!with --write ./wedm.toml gets:",
                "  correction = 0.1520\n",
            ],
        ),
        (
            "--outer 20=20.006 --correction 0.155 --wire-diameter 0.25",
            None,
            &[
                "pass 1, cut with 0.1550 mm: half of the kerf 0.1520 ± 0.0010 mm from 1 feature, gap 0.0270 ± 0.0010 mm\n",
                "pass 1 was measured once: nothing shows how the sizes scatter",
                "  wire-diameter = 0.25\n  gap = 0.0270\n",
            ],
        ),
        (
            "--inner 10=9.994 --inner 6=5.996",
            Some("wire-diameter = 0.25\ngap = 0.03\n"),
            &["  gap = 0.0275\n", "0.1525 ± 0.0064 mm from 2 features"],
        ),
        (
            "--inner 10=9.994 --uncertainty 0.0005",
            Some("wire-diameter = 0.25\ngap = 0.03\ncorrection = 0.155\n"),
            &["± 0.0003 mm", "  correction = 0.1520\n  gap = 0.0270\n"],
        ),
        (
            "--outer 20=20.09 --pass 1",
            Some("[passes]\ncorrections = [0.2, 0.15]\n"),
            &["passes.corrections = [0.2000, 0.1500]\n", "gap: not known"],
        ),
    ];
    for (options, file, texts) in rows {
        let desk = Desk::new();
        if let Some(file) = file {
            desk.write("wedm.toml", file);
        }
        check(&desk, &format!("calibrate {options}"), 0, texts);
    }
    let desk = Desk::new();
    check(
        &desk,
        "calibrate --outer 20=20.006 --correction 0.155 --wire-diameter 0.25 --write --lang zh",
        0,
        &["放电间隙 0.0270 ± 0.0010 mm", "!已写出 ./wedm.toml："],
    );
    let written = String::from_utf8(desk.read("wedm.toml")).unwrap();
    assert!(written.contains("\ngap = 0.0270\n"), "{written}");
}

#[test]
fn what_contradicts_itself_is_refused() {
    let rows: [(&str, &str, &[&str]); 8] = [
        (
            "kind,nominal,measured\nouter,20,20.006\nouter,12,12.0064\ninner,10,10.006\ninner,8,8.004\n",
            PASSES,
            &[
                "!error: pass 3: half of the kerf is 0.1369 mm by the outer features and 0.1425 mm by the inner ones",
            ],
        ),
        (
            "feature,kind,nominal,measured\nA,outer,20,20.001\nB,outer,12,12\nC,outer,10,10\nD,outer,8,8.001\nE,outer,6,6.02\n",
            PASSES,
            &["!error: pass 3: E comes to 0.1300 mm for half of the kerf, the others to 0.1397 mm"],
        ),
        (
            "kind,nominal,measured\nouter,20,20.06\nouter,12,12.06\n",
            PASSES,
            &[
                "!error: pass 3: half of the kerf is 0.1100 mm, less than the wire's radius, 0.1250 mm",
            ],
        ),
        (
            "kind,pass,nominal,measured\nouter,1,20,20.17\nouter,2,12,12.02\n",
            PASSES,
            &["!error: half of the kerf of pass 2 is 0.1600 mm, that of pass 1 0.1300 mm"],
        ),
        (
            "feature,kind,nominal,measured\nA,outer,20,2.006\nB,inner,10,10.29\n",
            PASSES,
            &[
                "!error: A: 2.006 mm in place of 20 mm, cut with a correction of 0.1400 mm",
                "!error: B: 10.29 mm in place of 10 mm",
            ],
        ),
        (
            "kind,nominal,measured\nouter,20,20.1\n",
            "correction = 0.155\n[passes]\nregisters = [\"D1\", \"D2\"]\n",
            &["!error"],
        ),
        (
            "kind,nominal,measured\nouter,20,20.001\n",
            "passes = { corrections = [0.14] }\nwire-diameter = 0.25\n",
            &["!error: piece/wedm.toml: its keys stand where no lines can be added"],
        ),
        (
            "kind,nominal,measured\nouter,20,20.001\n",
            "side = \"auto\"\n",
            &["!error: nothing says what the piece was cut with"],
        ),
    ];
    for (index, (piece, file, texts)) in rows.into_iter().enumerate() {
        let desk = Desk::new();
        desk.write("piece/piece.csv", piece);
        desk.write("piece/wedm.toml", file);
        let code = if index < 5 { 1 } else { 2 };
        check(&desk, "calibrate piece/piece.csv --write", code, texts);
        assert_eq!(desk.read("piece/wedm.toml"), file.as_bytes(), "{piece}");
    }
}

#[test]
fn each_malformed_line_is_named() {
    let rows: [(&str, &[&str]); 9] = [
        (
            "",
            &[
                "piece.csv:1: the first line is \"\", expected names of columns out of feature, kind, pass, nominal, measured, among them kind, nominal, measured",
            ],
        ),
        (
            "kind,nominal\nouter,20\n",
            &["piece.csv:1: the first line is \"kind,nominal\", expected"],
        ),
        (
            "kind,size,nominal,measured\n",
            &["piece.csv:1: the first line is"],
        ),
        (
            "kind,nominal,measured\n",
            &["piece.csv: no measurement is in it"],
        ),
        (
            "kind,nominal,measured\nouter,20\n\n# note\nouter,2o,20.001\npunch,-1,nan\n",
            &[
                "piece.csv:2: 2 cells, expected 3 as in the first line",
                "piece.csv:5: nominal is \"2o\", expected a length in mm above 0",
                "piece.csv:6: kind is \"punch\", expected outer, inner",
                "piece.csv:6: nominal is \"-1\", expected a length in mm above 0",
                "piece.csv:6: measured is \"nan\", expected a length in mm above 0",
            ],
        ),
        (
            "kind,pass,nominal,measured\nouter,2,20,20\nouter,0,20,20\nouter,first,20,20\n",
            &[
                "piece.csv:2: pass is \"2\", expected a whole number from 1 to 1",
                "piece.csv:3: pass is \"0\"",
                "piece.csv:4: pass is \"first\"",
            ],
        ),
        (
            "feature,kind,nominal,measured\nA,outer,20,20\nA,inner,20,20\nA,outer,12,12\n",
            &[
                "piece.csv:3: A is of another kind or nominal size than in line 2: expected a name of its own",
                "piece.csv:4: A is of another kind",
            ],
        ),
        (
            "kind,nominal,measured\nouter,20,20,006\n",
            &["piece.csv:2: 4 cells, expected 3"],
        ),
        (
            "kind,nominal,measured\nouter,,20\n",
            &["piece.csv:2: nominal is \"\", expected"],
        ),
    ];
    for (piece, texts) in rows {
        let desk = Desk::new();
        desk.write("piece.csv", piece);
        let texts: Vec<String> = texts.iter().map(|text| format!("!error: {text}")).collect();
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        check(&desk, "calibrate piece.csv --correction 0.14", 2, &texts);
    }
    // As a spreadsheet of a German office writes it, and one of a Chinese.
    let desk = Desk::new();
    desk.write(
        "piece.csv",
        "\u{feff}Feature;Kind;Nominal;Measured\r\n\"A\";outer;20;20,002\r\n",
    );
    check(
        &desk,
        "calibrate piece.csv --correction 0.14",
        0,
        &["half of the kerf 0.1390"],
    );
    desk.write(
        "piece.csv",
        b"feature\tkind\tnominal\tmeasured\n\xcd\xb9\xc4\xa3\touter\t20\t20.002\n",
    );
    check(
        &desk,
        "calibrate piece.csv --correction 0.14",
        0,
        &["half of the kerf 0.1390"],
    );
    for (options, text) in [
        ("", "CSV"),
        ("--outer 20", "expected NOMINAL=MEASURED in mm"),
        ("--outer 20=", "expected a length in mm above 0"),
        ("no.csv --correction 0.1", "no.csv"),
        (". --correction 0.1", "error"),
        (
            "--inner 20=20 --pass 2 --correction 0.1",
            "pass 2 was measured, but the settings have 1",
        ),
    ] {
        let ended = desk.run(&format!("calibrate {options}"));
        assert!(
            ended.code > Some(0) && ended.stderr.contains(text),
            "{options}: {ended:?}"
        );
    }
}

#[test]
fn students_t_is_that_of_the_tables() {
    for (outside, freedom, expected) in [
        (0.05, 1, 12.7062),
        (0.05, 2, 4.3027),
        (0.05, 3, 3.1824),
        (0.05, 10, 2.2281),
        (0.05, 30, 2.0423),
        (0.01, 5, 4.0321),
        (0.01, 60, 2.6603),
        (0.001, 4, 8.6103),
    ] {
        let found = student_t(outside, freedom);
        assert!(
            (found - expected).abs() < 1e-4,
            "{outside} {freedom}: {found}"
        );
    }
}

/// Numbers that scatter, the same in each run.
struct Chance(u64);

impl Chance {
    /// From 0 to 1.
    fn even(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.even()
    }

    fn count(&mut self, least: usize, most: usize) -> usize {
        least + (self.even() * (most - least + 1) as f64) as usize
    }

    /// The sum of twelve has the deviation 1.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum::<f64>() - 6.0
    }
}

/// A piece is cut: where the wire runs, what it takes away, and where the faces are then.
fn cut(is_outer: bool, nominal: f64, correction: f64, half: f64) -> f64 {
    let contour = nominal / 2.0;
    let face = match is_outer {
        true => (contour + correction) - half,
        false => (contour - correction) + half,
    };
    2.0 * face
}

/// The kerf of each pass, the settings, and what is measured.
fn piece(
    chance: &mut Chance,
    counts: [usize; 2],
    scatter: f64,
) -> (Vec<f64>, Setup, Vec<Measurement>) {
    let radius = chance.between(0.05, 0.15);
    let mut gap = chance.between(0.02, 0.04);
    let (mut halves, mut corrections, mut measurements) = (Vec::new(), Vec::new(), Vec::new());
    for pass in 1..=chance.count(1, 3) {
        let half = radius + gap;
        let correction = half + chance.between(-0.01, 0.05);
        for (kind, count) in counts.into_iter().enumerate() {
            for number in 0..count {
                let nominal = chance.between(2.0, 50.0);
                let size = cut(kind == 0, nominal, correction, half);
                measurements.push(Measurement {
                    feature: format!("{kind} {number}"),
                    is_outer: kind == 0,
                    pass,
                    nominal,
                    measured: size + scatter * chance.normal(),
                });
            }
        }
        halves.push(half);
        corrections.push(correction);
        gap -= chance.between(0.005, 0.009);
    }
    let setup = Setup {
        corrections,
        wire_radius: Some(radius),
        uncertainty: 0.002,
    };
    (halves, setup, measurements)
}

/// Of random pieces whose sizes scatter as the uncertainty says, or more where it can be seen, nine of ten are within what
/// is stated, and few are refused.
#[test]
fn the_true_kerf_lies_within_its_uncertainty() {
    let mut chance = Chance(1);
    let (mut passes, mut within, mut pieces, mut refused) = (0, 0, 0, 0);
    for _ in 0..2000 {
        let counts = [chance.count(1, 4), chance.count(0, 4)];
        let least = 0.001;
        let most = if counts[0] + counts[1] > 1 {
            0.004
        } else {
            least
        };
        let scatter = chance.between(0.0, most);
        let (halves, setup, measurements) = piece(&mut chance, counts, scatter);
        pieces += 1;
        let Ok(kerfs) = calibrate(&measurements, &setup) else {
            refused += 1;
            continue;
        };
        for (kerf, half) in kerfs.iter().zip(halves) {
            passes += 1;
            within += usize::from((kerf.half - half).abs() <= kerf.uncertainty);
        }
    }
    assert!(within * 100 >= passes * 94, "{within} of {passes}");
    assert!(
        refused * 100 <= pieces * 15,
        "{refused} of {pieces} refused"
    );
    println!("{within} of {passes} within, {refused} of {pieces} refused");
}

/// Jaws that are off, a feature that is off, passes in the wrong order, another wire: none is averaged away.
#[test]
fn planted_contradictions_are_refused() {
    let mut chance = Chance(2);
    for _ in 0..300 {
        let (halves, setup, sound) = piece(&mut chance, [4, 4], 0.001);
        let last = halves.len();
        let mut jaws = sound.clone();
        jaws.iter_mut().for_each(|one| one.measured += 0.012);
        assert!(calibrate(&jaws, &setup).is_err(), "{jaws:?}");
        let mut slip = sound.clone();
        let chosen = chance.count(0, 7);
        slip[chosen].measured += 0.03;
        let name = slip[chosen].feature.clone();
        let refusals = calibrate(&slip, &setup).unwrap_err();
        assert!(
            refusals.iter().any(|one| one.contains(&name)),
            "{name}: {refusals:?}"
        );
        let thick = Setup {
            wire_radius: Some(halves[last - 1] + 0.01),
            ..setup.clone()
        };
        assert!(calibrate(&sound, &thick).is_err());
        if last > 1 {
            // What a swap measures, under the corrections of the other pass.
            let mut swapped = sound.clone();
            for one in &mut swapped {
                let other = last + 1 - one.pass;
                let (is_outer, correction) = (one.is_outer, setup.corrections[one.pass - 1]);
                one.measured = cut(is_outer, one.nominal, correction, halves[other - 1]);
            }
            assert!(calibrate(&swapped, &setup).is_err());
        }
    }
}
