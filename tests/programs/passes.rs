//! Passes of one contour: one of them with a slip is named at its own line, whether the machine stops between them or not, and sound ones
//! have nothing said.

use wedm::finding::{Finding, Place, Severity};
use wedm::program::{Document, Language};
use wedm::settings::{Effective, Settings, SideSetting};

/// A slip in one pass.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Slip {
    Side,
    Register,
    EarlyCancel,
    Shift,
}

/// An outline from the middle of its lower side, mm, counter-clockwise; its thread hole lies 3 mm below.
const OUTLINE: [[f64; 2]; 6] = [
    [0., 0.],
    [9., 0.],
    [9., 14.],
    [-9., 14.],
    [-9., 0.],
    [0., 0.],
];

/// Three passes, of which every other one may run back, and the lines (from 0) at which a slip in the second is named.
fn program(slip: Option<Slip>, to_and_fro: bool, stops: bool) -> (String, Vec<usize>) {
    let mut lines: Vec<String> = ["%", "H1 = 0.18", "H2 = 0.15", "H3 = 0.13"]
        .map(Into::into)
        .into();
    lines.push("G90 G92 X0. Y-3.".into());
    let mut named = Vec::new();
    for pass in 0..3 {
        let own = slip.filter(|_| pass == 1);
        let is_back = to_and_fro && pass == 1;
        let mut outline = OUTLINE.to_vec();
        if is_back {
            outline.reverse();
        }
        let side = if is_back == (own == Some(Slip::Side)) {
            42
        } else {
            41
        };
        let register = match own {
            Some(Slip::Register) => 3,
            _ => pass + 1,
        };
        let aside = if own == Some(Slip::Shift) { 0.05 } else { 0.0 };
        match own {
            Some(Slip::Side | Slip::Shift) => named.push(lines.len()),
            Some(Slip::EarlyCancel) => named.push(lines.len() + outline.len()),
            // The pass behind it has the larger correction; and one that lies aside is named at its own line, and the next beside it.
            Some(Slip::Register) | None => {}
        }
        if pass == 2 && matches!(slip, Some(Slip::Shift)) {
            named.push(lines.len());
        }
        lines.push(format!("G{side} H{register}"));
        for (nth, [x, y]) in outline.iter().enumerate() {
            let is_last = nth + 1 == outline.len();
            let off = if own == Some(Slip::EarlyCancel) && is_last {
                "G40 "
            } else {
                ""
            };
            lines.push(format!("{off}G01 X{:.3} Y{y:.3}", x + aside));
        }
        let off = if own == Some(Slip::EarlyCancel) {
            ""
        } else {
            "G40 "
        };
        lines.push(format!("{off}G01 X0. Y-3."));
        if stops && pass < 2 {
            lines.push("M00".into());
        }
    }
    lines.push("M02\n%\n".into());
    (lines.join("\n"), named)
}

fn start_of(finding: &Finding) -> usize {
    match &finding.place {
        Place::Text { range } => range.start,
        _ => panic!("{finding:?} has no place"),
    }
}

fn named(text: &str, side: Option<SideSetting>) -> Vec<(&'static str, usize)> {
    let settings = Effective::of(&Settings {
        side,
        ..Settings::default()
    });
    let document = Document::read(Language::Iso, text.into(), &settings);
    let (findings, _) = document.findings(&settings, usize::MAX);
    let bad = findings
        .iter()
        .filter(|finding| finding.severity <= Severity::Warning);
    let line = |finding: &Finding| {
        (
            finding.rule.name(),
            text[..start_of(finding)].matches('\n').count(),
        )
    };
    bad.map(line).collect()
}

#[test]
fn a_slip_in_one_pass_of_several_is_named_in_it() {
    for to_and_fro in [false, true] {
        for stops in [false, true] {
            for side in [None, Some(SideSetting::Punch)] {
                for (slip, rule) in [
                    (None, ""),
                    (Some(Slip::Side), "wrong-side"),
                    (Some(Slip::EarlyCancel), "compensation-switch"),
                    (Some(Slip::Shift), "pass-order"),
                ] {
                    let (text, lines) = program(slip, to_and_fro, stops);
                    let expected: Vec<_> = lines.into_iter().map(|line| (rule, line)).collect();
                    let label =
                        format!("{slip:?}, to and fro {to_and_fro}, stops {stops}, {side:?}");
                    assert_eq!(named(&text, side), expected, "{label}\n{text}");
                }
            }
        }
    }
}

#[test]
fn corrections_that_the_program_states_fall_from_pass_to_pass() {
    for stops in [false, true] {
        let (text, _) = program(Some(Slip::Register), true, stops);
        // H3 in passes 2 and 3 is no rise; H1 behind it is.
        assert_eq!(named(&text, None), [], "{text}");
        let risen = text.replacen("G42 H3", "G42 H1", 1);
        let line = risen.lines().position(|line| line == "G42 H1").unwrap();
        let last = risen.lines().enumerate().skip(line + 1);
        let last = last
            .filter(|(_, own)| *own == "G42 H1")
            .map(|(at, _)| at)
            .last()
            .unwrap();
        assert_eq!(named(&risen, None), [("pass-order", last)], "{risen}");
    }
}

#[test]
fn a_way_that_is_cut_for_want_of_a_stop_is_named() {
    let square = "B0B3000B3000GYL2\nB5000B0B5000GXL1\nB0B10000B10000GYL2\nB10000B0B10000GXL3\nB0B10000B10000GYL4\nB5000B0B5000GXL1\nB0B3000B3000GYL4\n";
    let way = "B30000B0B30000GXL1\n";
    let named = |text: &str| {
        let settings = Effective::default();
        let document = Document::read(Language::ThreeB, text.into(), &settings);
        let (findings, _) = document.findings(&settings, usize::MAX);
        let at = |finding: &Finding| (finding.rule.name(), start_of(finding));
        findings.iter().map(at).collect::<Vec<_>>()
    };
    assert_eq!(named(&format!("{square}D\n{way}D\n{square}DD\n")), []);
    let text = format!("{square}{way}D\n{square}DD\n");
    assert_eq!(named(&text), [("not-closed", square.len())]);
    // Behind the last contour the wire may be led away.
    assert_eq!(named(&format!("{square}D\n{way}D\n{square}{way}DD\n")), []);
}
