use super::super::Settings;
use super::super::{Corner, Layout, SideSetting, UnitSetting, from_json, from_toml};
use super::*;
use serde_json::json;

#[test]
fn what_was_most_likely_meant_is_asked() {
    for (text, expected) in [
        ("layer = {}", "layer is not known, did you mean layers?"),
        (
            "corection = 0.1",
            "corection is not known, did you mean correction?",
        ),
        (
            "[program]\nleadin = 3",
            "program.leadin is not known, did you mean lead-in?",
        ),
        (
            "startHole = 1",
            "startHole is not known, did you mean program.start-hole?",
        ),
        (
            "[program]\ncorrection = 0.1",
            "program.correction is not known, did you mean correction?",
        ),
        (
            "[rules]\nshrap-corner = \"off\"",
            "rules.shrap-corner is not known, did you mean sharp-corner?",
        ),
        (
            "side = \"openning\"",
            "side is \"openning\", expected both, auto, opening, punch, left, right: did you mean opening?",
        ),
        (
            "[layers]\nDIE = \"Punch\"",
            "layers.DIE is \"Punch\", expected opening, punch, both, left, right, line, ignore",
        ),
    ] {
        let (_, errors) = from_toml(text);
        let said: Vec<&str> = errors.iter().map(|error| &*error.message).collect();
        assert!(
            said.len() == 1 && said[0].replace("one of ", "").starts_with(expected),
            "{said:?} {expected}"
        );
    }
}

#[test]
fn a_suppression_has_a_reason() {
    let table = "[drawings.\"plate.dxf\".suppress.2A]\n";
    let (settings, errors) = from_toml(&format!("{table}gap = \"glued\""));
    assert!(errors.is_empty(), "{errors:?}");
    assert_eq!(
        settings.drawings.unwrap()["plate.dxf"]
            .suppress
            .as_ref()
            .unwrap()["2A"]["gap"],
        "glued"
    );
    for (line, expected) in [
        (
            "gap = \" \"",
            "drawings.plate.dxf.suppress.2A.gap is empty, expected the reason in words",
        ),
        (
            "gap = true",
            "drawings.plate.dxf.suppress.2A.gap is true, expected the reason in words",
        ),
        (
            "gab = \"x\"",
            "drawings.plate.dxf.suppress.2A.gab is not known, did you mean gap?",
        ),
    ] {
        let (_, errors) = from_toml(&format!("{table}{line}"));
        assert_eq!(
            errors
                .iter()
                .map(|error| &*error.message)
                .collect::<Vec<_>>(),
            [expected]
        );
    }
}

#[test]
fn the_documented_file_is_read_whole() {
    let text = r#"
wire-diameter = 0.18
gap = 0.01
side = "opening"
units = "inch"
margin = 0
arc-fit = 0.002
[passes]
corrections = [0.175, 0.146, 0.140]
[layers]
"DIE" = "opening"
[colors]
red = "punch"
30 = "ignore"
[rules]
small-radius = "hint"
units = "off"
[program]
layout = "checking"
corner = "intersection"
thread = [115.0, -10]
entry = { 2A = [105.0, -10.0] }
lead-in = 3.0
end = "DD"
"#;
    let (settings, errors) = from_toml(text);
    assert_eq!(errors, []);
    let program = settings.program.unwrap();
    assert_eq!(
        (settings.wire_diameter, settings.gap, settings.margin),
        (Some(0.18), Some(0.01), Some(0.0))
    );
    assert_eq!(
        (settings.side, settings.units),
        (Some(SideSetting::Opening), Some(UnitSetting::Inch))
    );
    assert_eq!(
        settings.passes.unwrap().corrections,
        Some(vec![0.175, 0.146, 0.140])
    );
    assert_eq!(settings.layers.unwrap()["DIE"], Role::Opening);
    assert_eq!(settings.rules.unwrap()["units"], RuleSeverity::Off);
    assert_eq!(
        (settings.colors.unwrap()["red"], settings.arc_fit),
        (Role::Punch, Some(0.002))
    );
    assert_eq!(
        (program.layout, program.corner),
        (Some(Layout::Checking), Some(Corner::Intersection))
    );
    assert_eq!(program.thread, Some(PointSetting::One([115.0, -10.0])));
    assert_eq!(
        program.entry,
        Some(PointSetting::ByHandle(
            [("2A".to_string(), [105.0, -10.0])].into()
        ))
    );
    assert_eq!(
        (program.lead_in, program.end.as_deref()),
        (Some(3.0), Some("DD"))
    );
}

#[test]
fn a_misfit_is_named_with_its_place_and_the_other_keys_hold() {
    let check = |line: &str, place: &str, expected: &str| {
        let text = format!("margin = 0.5\n{line}\n[layers]\nDIE = \"punch\"\n");
        let (settings, errors) = from_toml(&text);
        let [error] = errors.as_slice() else {
            panic!("{line}: {errors:?}")
        };
        assert!(error.message.contains(expected), "{}", error.message);
        assert_eq!(&text[error.range.clone().unwrap()], place);
        assert_eq!(settings.margin, Some(0.5), "{line}");
        assert_eq!(settings.layers.unwrap()["DIE"], Role::Punch, "{line}");
    };
    check(
        "correction = -1",
        "-1",
        "correction is -1, expected a number above 0",
    );
    check(
        "correction = nan",
        "nan",
        "correction is NaN, expected a number above 0",
    );
    check(
        "correction = 99999999999999999999",
        "99999999999999999999",
        "correction is 1e20, expected a number up to 1000000000000",
    );
    check(
        "program = { start-hole = 1e308 }",
        "1e308",
        "program.start-hole is 1e308, expected a number up to 1000000000000",
    );
    check(
        "passes = { rates = [1e-300] }",
        "1e-300",
        "passes.rates[0] is 1e-300, expected a number of 0.000000000001 or above",
    );
    check(
        "program = { entry = [0.5, -2e12] }",
        "[0.5, -2e12]",
        "program.entry is a list, expected a point [x, y] of numbers up to 1000000000000",
    );
    check(
        "correction = \"0.1\"",
        "\"0.1\"",
        "correction is \"0.1\", expected a number above 0",
    );
    check(
        "gap = -0.1",
        "-0.1",
        "gap is -0.1, expected a number of 0 or above",
    );
    check(
        "side = \"inside\"",
        "\"inside\"",
        "side is \"inside\", expected one of both, auto, opening, punch, left, right",
    );
    check(
        "arc-fit = 0",
        "0",
        "arc-fit is 0, expected a number from 0.000001 to 0.1",
    );
    check(
        "colors = { pink = \"punch\" }",
        "pink",
        "colors.pink is not known, expected red,",
    );
    check(
        "corection = 1",
        "corection",
        "corection is not known, did you mean correction?",
    );
    check(
        "passes = { corrections = [0.1, 0] }",
        "0",
        "passes.corrections[1] is 0, expected a number above 0",
    );
    check(
        "passes = { corrections = [] }",
        "[]",
        "passes.corrections is empty",
    );
    check(
        "passes = { corrections = [0.2, 0.1, 0.15] }",
        "0.15",
        "passes.corrections[2] is 0.15, expected at most 0.1, that of the pass before",
    );
    check(
        "wire-diameter = 0.25\npasses = { corrections = [0.2, 0.12] }",
        "0.12",
        "passes.corrections[1] is 0.12, expected at least the wire's radius 0.125",
    );
    check(
        "correction = 0.1\nwire-diameter = 0.25",
        "0.1",
        "correction is 0.1, expected at least the wire's radius 0.125",
    );
    check(
        "rules = { small-radii = \"off\" }",
        "small-radii",
        "rules.small-radii is not known, did you mean small-radius?",
    );
    check(
        "rules = { small-radius = \"loud\" }",
        "\"loud\"",
        "rules.small-radius is \"loud\", expected one of error,",
    );
    check(
        "program = { order = \"random\" }",
        "\"random\"",
        "program.order is \"random\", expected one of as-drawn, inside-first, nearest, as-picked",
    );
    check(
        "program = { lead-in = 0 }",
        "0",
        "program.lead-in is 0, expected a number above 0",
    );
    check(
        "program = { thread = [1] }",
        "[1]",
        "program.thread is a list, expected a point [x, y]",
    );
    check(
        "program = { end = \"\" }",
        "\"\"",
        "program.end is \"\", expected a word",
    );
    check(
        "program = { digits = 3 }",
        "3",
        "program.digits is 3, expected a whole number from 4 to 9",
    );
    check("program = 3", "3", "program is 3, expected a table");
}

#[test]
fn a_file_that_is_not_toml_is_said_to_be_none_and_what_can_be_read_holds() {
    let (settings, errors) = from_toml("correction = 0.2\nside = = 3\n");
    assert_eq!(settings.correction, Some(0.2));
    assert!(errors[0].message.starts_with("not TOML: "), "{errors:?}");
    assert!(errors[0].range.is_some());
}

#[test]
fn a_file_beyond_all_measure_is_said_to_be_so_and_thousands_of_faults_are_read_in_one_pass() {
    let (settings, errors) = from_toml(&format!("correction = 0.2\n{}", "# \n".repeat(400_000)));
    assert!(
        settings == Settings::default()
            && errors.len() == 1
            && errors[0].message.contains("expected at most"),
        "{errors:?}"
    );
    let (settings, errors) = from_toml(&format!("correction = 0.2\n{}", "x\n".repeat(50_000)));
    assert_eq!((settings.correction, errors.len()), (Some(0.2), 50_000));
}

#[test]
fn json_is_taken_bare_or_as_the_section_and_null_is_not_set() {
    let check = |json: serde_json::Value, correction: Option<f64>, errors: usize| {
        let (settings, found) = from_json(&json);
        assert_eq!(
            (settings.correction, found.len()),
            (correction, errors),
            "{json}: {found:?}"
        );
    };
    check(json!(null), None, 0);
    check(json!({}), None, 0);
    check(
        json!({ "correction": 0.12, "wireDiameter": null, "program": null }),
        Some(0.12),
        0,
    );
    check(
        json!({ "wedm": { "correction": 0.12 }, "editor": { "tabSize": 2 } }),
        Some(0.12),
        0,
    );
    check(json!({ "wedm": null }), None, 0);
    check(json!({ "correction": true }), None, 1);
    check(
        json!({ "correction": 0.1, "wireDiameter": 0.2 }),
        Some(0.1),
        0,
    );
    check(
        json!({ "correction": 0.1, "wireDiameter": 0.25 }),
        Some(0.1),
        1,
    );
    check(json!({ "passes": { "corrections": [0.1, 0.2] } }), None, 1);
    check(json!([]), None, 0);
    check(json!({ "wedm": [], "layers": 1 }), None, 0);
    check(json!({ "program": [], "layers": [] }), None, 0);
    check(json!({ "layers": [1] }), None, 1);
    check(json!("x"), None, 1);
}
