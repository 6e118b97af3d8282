//! Variables, what G90.1 and G91.1 say, and what whole numbers are.

use super::*;
use proptest::prelude::*;

/// A contour with an arc, `A` to `F` for its numbers in mm.
const SHAPE: &str = "G90 G92 X0. Y-5.\nG41 D1 G01 X0. Y0.\nXA YB\nG03 XC YD IE JF\nG01 X0. Y10.\nX0. Y0.\nG40 X0. Y-5.\nM02\n";
const NUMBERS: [(char, &str); 6] = [
    ('A', "10."),
    ('B', "0."),
    ('C', "10."),
    ('D', "5."),
    ('E', "0."),
    ('F', "2.5"),
];

fn shape(number: impl Fn(usize, &str) -> String, before: &str, beside: &str) -> String {
    let all = NUMBERS.iter().enumerate();
    let text = all.fold(SHAPE.to_owned(), |text, (index, (letter, own))| {
        ["X", "Y", "I", "J"].iter().fold(text, |text, axis| {
            text.replace(
                &format!("{axis}{letter}"),
                &format!("{axis}{}", number(index, own)),
            )
        })
    });
    let text = text.replace("G41", &format!("{beside}G41"));
    format!("{before}{text}")
}

/// The rules of all findings but those about words of the machine.
fn rules(text: &str) -> Vec<&'static str> {
    let all = faults(text, &Effective::default());
    let rules = all.into_iter().map(|(_, rule)| rule);
    // What stands before the program repeats a number on purpose.
    let is_aside = |rule: &&str| matches!(*rule, "machine-dependent" | "block-number");
    rules.filter(|rule| !is_aside(rule)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// However a number is said, the wire goes where the plain program leads it, and no word beside it is swallowed.
    #[test]
    fn a_number_that_is_worked_out_is_the_number(
        ways in prop::collection::vec(0..8_usize, NUMBERS.len()),
        beside in prop::sample::select(vec!["", "S#500", "F#9", "E[#5+1]", "T#3", "C[#501 - 2]", "#900=#901"]),
        aside in 1..5_i32,
    ) {
        let plain = shape(|_, own| own.to_owned(), "", "");
        let value = |own: &str| own.parse::<f64>().unwrap_or_default();
        let mut before = String::new();
        for (index, (_, own)) in NUMBERS.iter().enumerate() {
            let (number, value) = (100 + index, value(own));
            let line = match ways[index] {
                0 => String::new(),
                1 => format!("#{number}={own}\n"),
                2 => format!("#{number} = -{own} (of the other sign)\n"),
                3 => format!("N10#{number}={:.3}\n", value - f64::from(aside)),
                4 => format!("#1={}\n#{number}=#1+[{:.3}*2.]\n", aside, (value - f64::from(aside)) / 2.0),
                5 => format!("#{number}=7.\n#{number}={own}\n"),
                6 => format!("#{number}={:.4}\n", value * 4.0),
                _ => format!("#{number}={:.3}\n", value + f64::from(aside)),
            };
            before += &line;
        }
        let number = |index: usize, own: &str| {
            let number = 100 + index;
            match ways[index] {
                0 => own.to_owned(),
                1 | 4 | 5 => format!("#{number}"),
                2 => format!("-#{number}"),
                3 => format!("[#{number}+{aside}.]"),
                6 => format!("[#{number} / 4]"),
                _ => format!("0.-[{aside}.-#{number}]"),
            }
        };
        let text = shape(number, &before, beside);
        prop_assert_eq!(way(&text), way(&plain), "{}", text);
        prop_assert_eq!(rules(&text), rules(&plain), "{}", text);
    }
}

#[test]
fn what_the_text_does_not_tell_is_an_error_at_its_place() {
    let program = |before: &str, word: &str| {
        format!("G90 G92 X0. Y0.\n{before}\nG01 X5. Y0.\n{word}\nX0. Y0.\nM02\n")
    };
    for (before, word) in [
        ("", "Y#1"),
        ("", "G#1 Y5."),
        ("", "D#1 Y5."),
        ("#1=30.", "M#1"),
        ("#1=SQRT[2.]", "Y#1"),
        ("#1=#2+1.", "Y#1"),
        ("#1=5.\n#1=#2", "Y#1"),
        ("#1=1./0.", "Y#1"),
        ("#1=5.\nIF[#2EQ1]GOTO7\n#1=4.", "Y#1"),
        ("#1=5.\nWHILE[#2LT3]DO1", "Y[#1]"),
        ("#1=5.", "Y[#1"),
        ("#1=5.", "Y[#1MOD2]"),
        ("#1=5.", "Y#[#1]"),
    ] {
        let text = program(before, word);
        let line = text
            .lines()
            .position(|line| line == word)
            .unwrap_or_default()
            + 1;
        let found = faults(&text, &Effective::default());
        assert!(found.contains(&(line, "syntax")), "{text}{found:?}");
    }
    // More than a control's program has: the last one is not known.
    let many: String = (1..18).map(|number| format!("#{number}=5.\n")).collect();
    assert_eq!(rules(&program(&many, "Y#16 X#17")), ["syntax"]);
    assert_eq!(rules(&program(&many, "Y#16 X#1")), [""; 0]);
}

#[test]
fn a_rule_of_centres_is_followed_from_its_line_on() {
    let arcs = |text: &str| -> Vec<[f64; 3]> {
        let arcs = way(text).into_iter();
        let arcs = arcs.filter_map(|piece| piece.as_arc().copied());
        arcs.map(|arc| [arc.center.x, arc.center.y, arc.radius].map(f64::round))
            .collect()
    };
    let begin = "G90 G92 X5. Y2.5\nG01 X10. Y0.\n";
    let circle = "G03 I10. J2.5\n";
    let absolute = [10_000.0, 2_500.0, 2_500.0];
    assert_eq!(arcs(&format!("G90.1\n{begin}{circle}M02\n")), [absolute]);
    assert_eq!(arcs(&format!("G90.1 {begin}G91 {circle}M02\n")), [absolute]);
    assert_eq!(
        arcs(&format!("{begin}G90.1 {circle}G91.1 G03 I0. J2.5\nM02\n")),
        [absolute, absolute]
    );
    // Without a word the arcs tell it: a full circle fits any centre.
    assert_eq!(
        rules(&format!("{begin}{circle}G01 X5. Y2.5\nM02\n")),
        ["ambiguous-center"]
    );
    assert_eq!(
        rules(&format!("G90.1\n{begin}{circle}G01 X5. Y2.5\nM02\n")),
        [""; 0]
    );
}

#[test]
fn r_beside_i_and_j_says_the_same_arc_or_is_an_error() {
    // A half turn leaves open what I and J mean.
    let told = |text: &str| -> Vec<&str> {
        let all = rules(text).into_iter();
        all.filter(|rule| *rule != "ambiguous-center").collect()
    };
    let half = |r: &str| {
        format!(
            "G90 G92 X0. Y-3.\nG01 X0. Y0.\nX10.\nG03 X10. Y5. I0. J2.5 {r}\nG01 X0.\nY0.\nY-3.\nM02\n"
        )
    };
    let quarter = |r: &str| {
        format!(
            "G90 G92 X0. Y-3.\nG01 X0. Y0.\nX10.\nG03 X12. Y2. I0. J2. {r}\nG01 X0.\nY0.\nY-3.\nM02\n"
        )
    };
    for r in ["", "R2.5", "R2.501", "R-2.5"] {
        assert_eq!(told(&half(r)), [""; 0], "{r}");
    }
    assert_eq!(told(&half("R4.")), ["arc-off-radius"]);
    assert_eq!(told(&quarter("R2.")), [""; 0]);
    for r in ["R-2.", "R2.05", "R20."] {
        assert_eq!(told(&quarter(r)), ["arc-off-radius"], "{r}");
    }
}

#[test]
fn whole_numbers_are_what_the_program_shows_or_the_settings_say() {
    let settings = |whole: &str| {
        let text = format!("[program]\nwhole-numbers = \"{whole}\"");
        Effective::of(&crate::settings::from_toml(&text).0)
    };
    let plate = "G21\nG90\nG92 X-10 Y0\nG1 X0 Y0 F50\nX120\nY80\nX0\nY0\nX-10\nM2\n";
    let size = |text: &str, settings: &Effective| {
        let document = Document::read_with(text.as_bytes().to_vec(), settings);
        let steps = document.trace().steps;
        steps.iter().map(|step| step.end.x).fold(0.0, f64::max)
    };
    let by_itself = Effective::default();
    assert_eq!(size(plate, &by_itself), 120_000.0);
    check(plate, &[(3, "units")]);
    assert_eq!(size(plate, &settings("um")), 120.0);
    assert_eq!(faults(plate, &settings("mm")), []);
    // No machine travels 12 m.
    let fine = plate.replace("120", "12000").replace("80", "8000");
    assert_eq!(size(&fine, &by_itself), 12_000.0);
    check(&fine, &[]);
    // Steps add up.
    let steps = "G91\nG92 X0 Y0\nG01 X900\nX900\nY900\nX-900\nX-900\nY-900\nM02\n";
    assert_eq!(size(steps, &by_itself), 1_800.0);
    check(steps, &[(3, "units")]);
    // A number with a point among others says it of all.
    assert_eq!(
        size(&plate.replace("X120", "X120.5"), &by_itself),
        120_500.0
    );
}
