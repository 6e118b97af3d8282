//! One level of settings out of a tree of values: each key is held against what it may be, a misfit is left out and named.

use super::profile::DECIMALS;
use super::value::{Entry, Node, Value};
use super::{
    PassFault, Passes, PointSetting, ProfileSettings, ProgramSettings, RuleSeverity, Settings,
    SettingsError, shipped_profiles,
};
use crate::drawing::{Color, Role};
use crate::finding::Rule;
use serde::de::value::{Error, StrDeserializer};
use serde::de::{DeserializeOwned, IntoDeserializer};
use std::collections::BTreeMap;

/// Reads the root table. Null is an empty level.
pub(super) fn read(root: &Node) -> (Settings, Vec<SettingsError>) {
    let mut reader = Reader { errors: Vec::new() };
    let settings = reader.settings(root);
    (settings, reader.errors)
}

/// Digits of controllers: with fewer than four nothing larger than a millimetre could be cut.
const DIGITS: (f64, f64) = (4.0, 9.0);

struct Reader {
    errors: Vec<SettingsError>,
}

impl Reader {
    fn settings(&mut self, root: &Node) -> Settings {
        let mut settings = Settings::default();
        self.table("", root, |reader, key, entry| {
            let node = &entry.node;
            match camel_case(&entry.key).as_str() {
                "correction" => settings.correction = reader.number_above_zero(key, node),
                "wireDiameter" => settings.wire_diameter = reader.number_above_zero(key, node),
                "gap" => settings.gap = reader.number_from_zero(key, node),
                "side" => settings.side = reader.name(key, node),
                "units" => settings.units = reader.name(key, node),
                "margin" => settings.margin = reader.number_from_zero(key, node),
                "passes" => settings.passes = reader.passes(key, node),
                "layers" => settings.layers = reader.roles(key, node),
                "contours" => settings.contours = reader.roles(key, node),
                "colors" => settings.colors = reader.colors(key, node),
                "arcFit" => settings.arc_fit = reader.arc_fit(key, node),
                "rules" => settings.rules = reader.rules(key, node),
                "program" => settings.program = reader.program(key, node),
                "profiles" => settings.profiles = reader.profiles(key, node),
                _ => reader.unknown(
                    key,
                    entry,
                    "correction, wire-diameter, gap, side, units, margin, passes, layers, contours, colors, arc-fit, rules, program or profiles",
                ),
            }
        });
        self.errors
            .extend(settings.pass_errors(&|fault| place_of(root, fault)));
        if let Some(program) = &mut settings.program {
            let own = settings
                .profiles
                .iter()
                .flat_map(|profiles| profiles.keys().cloned());
            let mut names: Vec<String> = shipped_profiles().map(str::to_owned).chain(own).collect();
            names.sort_unstable();
            names.dedup();
            if let Some(entry) =
                entry_of(root, "program").and_then(|entry| entry_of(&entry.node, "profile"))
                && program
                    .profile
                    .as_deref()
                    .is_some_and(|profile| !names.iter().any(|name| name == profile))
            {
                self.misfit::<()>("program.profile", &entry.node, &names.join(", "));
                program.profile = None;
            }
        }
        settings
    }

    fn passes(&mut self, key: &str, node: &Node) -> Option<Passes> {
        let mut passes = Passes::default();
        self.table(key, node, |reader, key, entry| match entry.key.as_str() {
            "corrections" => passes.corrections = reader.corrections(key, &entry.node),
            _ => reader.unknown(key, entry, "corrections"),
        })
        .then_some(passes)
    }

    fn corrections(&mut self, key: &str, node: &Node) -> Option<Vec<f64>> {
        let expected = "a list of numbers above 0, one for each pass";
        match &node.value {
            Value::Null => None,
            Value::List(items) if !items.is_empty() => {
                let numbers = items
                    .iter()
                    .enumerate()
                    .map(|(index, item)| match item.value {
                        Value::Null => {
                            self.misfit(&format!("{key}[{index}]"), item, "a number above 0")
                        }
                        _ => self.number_above_zero(&format!("{key}[{index}]"), item),
                    });
                // A list of which one pass is wrong says nothing sure about the others.
                let numbers: Vec<Option<f64>> = numbers.collect();
                numbers.into_iter().collect()
            }
            Value::List(_) => {
                self.complain(key, node, format!("{key} is empty, expected {expected}"))
            }
            _ => self.misfit(key, node, expected),
        }
    }

    /// Roles by a name that is taken as it stands.
    fn roles(&mut self, key: &str, node: &Node) -> Option<BTreeMap<String, Role>> {
        let mut roles = BTreeMap::new();
        self.table(key, node, |reader, key, entry| {
            if let Some(role) = reader.name(key, &entry.node) {
                roles.insert(entry.key.clone(), role);
            }
        })
        .then_some(roles)
    }

    fn colors(&mut self, key: &str, node: &Node) -> Option<BTreeMap<String, Role>> {
        let mut colors = BTreeMap::new();
        self.table(key, node, |reader, key, entry| {
            if Color::named(&entry.key).is_none() {
                let expected = "red, yellow, green, cyan, blue, magenta, white, a number from 1 to 255 or #rrggbb";
                reader.unknown(key, entry, expected);
            } else if let Some(role) = reader.name(key, &entry.node) {
                colors.insert(entry.key.clone(), role);
            }
        })
        .then_some(colors)
    }

    /// Coarser than a tenth of a millimetre is no arc of the drawing any more, finer than a nanometre is noise.
    fn arc_fit(&mut self, key: &str, node: &Node) -> Option<f64> {
        self.number(key, node, "a number from 0.000001 to 0.1", |number| {
            (1e-6..=0.1).contains(&number)
        })
    }

    fn rules(&mut self, key: &str, node: &Node) -> Option<BTreeMap<String, RuleSeverity>> {
        let mut rules = BTreeMap::new();
        self.table(key, node, |reader, key, entry| {
            if !Rule::ALL.iter().any(|rule| rule.name() == entry.key) {
                let names: Vec<&str> = Rule::ALL.iter().map(|rule| rule.name()).collect();
                reader.unknown(key, entry, &names.join(", "));
            } else if let Some(severity) = reader.name(key, &entry.node) {
                rules.insert(entry.key.clone(), severity);
            }
        })
        .then_some(rules)
    }

    fn program(&mut self, key: &str, node: &Node) -> Option<ProgramSettings> {
        let mut program = ProgramSettings::default();
        self.table(key, node, |reader, key, entry| {
            let node = &entry.node;
            match camel_case(&entry.key).as_str() {
                "layout" => program.layout = reader.name(key, node),
                "direction" => program.direction = reader.name(key, node),
                "corner" => program.corner = reader.name(key, node),
                "thread" => program.thread = reader.point_setting(key, node),
                "entry" => program.entry = reader.point_setting(key, node),
                "leadIn" => program.lead_in = reader.number_above_zero(key, node),
                "order" => program.order = reader.name(key, node),
                "jumps" => program.jumps = reader.name(key, node),
                "compensation" => program.compensation = reader.name(key, node),
                "digits" => program.digits = reader.whole(key, node, DIGITS).map(|number| number as u8),
                "units" => program.units = reader.name(key, node),
                "profile" => program.profile = reader.text(key, node, "the name of a profile"),
                "end" => program.end = reader.word(key, node),
                "pause" => program.pause = reader.word(key, node),
                _ => {
                    let expected =
                        "layout, direction, corner, thread, entry, lead-in, order, jumps, compensation, digits, units, profile, end or pause";
                    reader.unknown(key, entry, expected);
                }
            }
        })
        .then_some(program)
    }

    fn profiles(&mut self, key: &str, node: &Node) -> Option<BTreeMap<String, ProfileSettings>> {
        let mut profiles = BTreeMap::new();
        self.table(key, node, |reader, key, entry| {
            if let Some(profile) = reader.profile(key, &entry.node) {
                profiles.insert(entry.key.clone(), profile);
            }
        })
        .then_some(profiles)
    }

    fn profile(&mut self, key: &str, node: &Node) -> Option<ProfileSettings> {
        let mut profile = ProfileSettings::default();
        self.table(key, node, |reader, key, entry| {
            let node = &entry.node;
            match camel_case(&entry.key).as_str() {
                "base" => profile.base = reader.base(key, node),
                "coordinates" => profile.coordinates = reader.name(key, node),
                "zero" => profile.zero = reader.name(key, node),
                "unit" => profile.unit = reader.name(key, node),
                "decimals" => {
                    let range = (f64::from(*DECIMALS.start()), f64::from(*DECIMALS.end()));
                    profile.decimals = reader.whole(key, node, range).map(|number| number as u8);
                }
                "center" => profile.center = reader.name(key, node),
                "fullCircles" => profile.full_circles = reader.truth(key, node),
                "modal" => profile.modal = reader.truth(key, node),
                "spaces" => profile.spaces = reader.truth(key, node),
                "numbers" => profile.numbers = reader.whole(key, node, (0.0, 1000.0)).map(|number| number as u32),
                "lineEnd" => profile.line_end = reader.name(key, node),
                "begin" => profile.begin = reader.lines(key, node),
                "contourBegin" => profile.contour_begin = reader.lines(key, node),
                "contourEnd" => profile.contour_end = reader.lines(key, node),
                "pause" => profile.pause = reader.lines(key, node),
                "end" => profile.end = reader.lines(key, node),
                _ => {
                    let expected = "base, coordinates, zero, unit, decimals, center, full-circles, modal, spaces, numbers, line-end, begin, \
                                    contour-begin, contour-end, pause or end";
                    reader.unknown(key, entry, expected);
                }
            }
        })
        .then_some(profile)
    }

    /// The name of a profile that ships.
    fn base(&mut self, key: &str, node: &Node) -> Option<String> {
        let name = self.text(key, node, "the name of a profile")?;
        // The shipped profiles themselves are read by this reader and have no base.
        if shipped_profiles().any(|shipped| shipped == name) {
            return Some(name);
        }
        self.misfit(
            key,
            node,
            &shipped_profiles().collect::<Vec<_>>().join(", "),
        )
    }

    /// Lines of a program in which `{x}`, `{y}` and `{side}` stand for something.
    fn lines(&mut self, key: &str, node: &Node) -> Option<Vec<String>> {
        let items = match &node.value {
            Value::Null => return None,
            Value::List(items) => items,
            _ => return self.misfit(key, node, "a list of lines such as [\"G90\"]"),
        };
        let lines: Vec<Option<String>> = items
            .iter()
            .enumerate()
            .map(|(index, item)| self.line(&format!("{key}[{index}]"), item))
            .collect();
        lines.into_iter().collect()
    }

    fn line(&mut self, key: &str, node: &Node) -> Option<String> {
        let line = self.text(key, node, "one line of text")?;
        if line.chars().any(char::is_control) {
            return self.misfit(key, node, "one line without control characters");
        }
        let mut rest = line.as_str();
        while let Some(open) = rest.find('{') {
            let end = rest[open..]
                .find('}')
                .map_or(rest.len(), |close| open + close + 1);
            let name = &rest[open..end];
            if !["{x}", "{y}", "{side}"].contains(&name) {
                return self.complain(
                    key,
                    node,
                    format!("{key} holds {name}, expected {{x}}, {{y}} or {{side}}"),
                );
            }
            rest = &rest[end..];
        }
        Some(line)
    }

    fn text(&mut self, key: &str, node: &Node, expected: &str) -> Option<String> {
        match &node.value {
            Value::Null => None,
            Value::Text(text) => Some(text.clone()),
            _ => self.misfit(key, node, expected),
        }
    }

    fn truth(&mut self, key: &str, node: &Node) -> Option<bool> {
        match node.value {
            Value::Null => None,
            Value::Truth(truth) => Some(truth),
            _ => self.misfit(key, node, "true or false"),
        }
    }

    fn whole(&mut self, key: &str, node: &Node, (least, most): (f64, f64)) -> Option<f64> {
        self.number(
            key,
            node,
            &format!("a whole number from {least} to {most}"),
            |number| number.fract() == 0.0 && (least..=most).contains(&number),
        )
    }

    /// Hands each entry with its dotted key to `each`; false when there is no table.
    fn table(
        &mut self,
        key: &str,
        node: &Node,
        mut each: impl FnMut(&mut Reader, &str, &Entry),
    ) -> bool {
        match &node.value {
            Value::Table(entries) => {
                for entry in entries {
                    let dotted = if key.is_empty() {
                        entry.key.clone()
                    } else {
                        format!("{key}.{}", entry.key)
                    };
                    each(self, &dotted, entry);
                }
                true
            }
            Value::Null => false,
            _ => self
                .misfit::<()>(
                    if key.is_empty() { "settings" } else { key },
                    node,
                    "a table",
                )
                .is_some(),
        }
    }

    fn number(
        &mut self,
        key: &str,
        node: &Node,
        expected: &str,
        fits: impl Fn(f64) -> bool,
    ) -> Option<f64> {
        match node.value {
            Value::Null => None,
            Value::Number(number) if number.is_finite() && fits(number) => Some(number),
            _ => self.misfit(key, node, expected),
        }
    }

    fn number_above_zero(&mut self, key: &str, node: &Node) -> Option<f64> {
        self.number(key, node, "a number above 0", |number| number > 0.0)
    }

    fn number_from_zero(&mut self, key: &str, node: &Node) -> Option<f64> {
        self.number(key, node, "a number of 0 or above", |number| number >= 0.0)
    }

    /// A word out of a closed set, which the type itself knows.
    fn name<T: DeserializeOwned>(&mut self, key: &str, node: &Node) -> Option<T> {
        let text = match &node.value {
            Value::Null => return None,
            Value::Text(text) => text.as_str(),
            _ => "",
        };
        let deserializer: StrDeserializer<'_, Error> = text.into_deserializer();
        match T::deserialize(deserializer) {
            Ok(name) => Some(name),
            Err(error) => {
                let error = error.to_string();
                let expected = error
                    .split_once("expected ")
                    .map_or("another word", |(_, names)| names)
                    .replace('`', "");
                self.misfit(key, node, &expected)
            }
        }
    }

    fn word(&mut self, key: &str, node: &Node) -> Option<String> {
        match &node.value {
            Value::Null => None,
            Value::Text(text)
                if !text.is_empty() && text.chars().all(|c| c.is_ascii_alphanumeric()) =>
            {
                Some(text.clone())
            }
            _ => self.misfit(key, node, "a word of letters and digits such as \"DD\""),
        }
    }

    fn point_setting(&mut self, key: &str, node: &Node) -> Option<PointSetting> {
        match &node.value {
            Value::Table(_) => {
                let mut points = BTreeMap::new();
                self.table(key, node, |reader, key, entry| {
                    if let Some(point) = reader.point(key, &entry.node) {
                        points.insert(entry.key.clone(), point);
                    }
                });
                Some(PointSetting::ByHandle(points))
            }
            _ => self.point(key, node).map(PointSetting::One),
        }
    }

    fn point(&mut self, key: &str, node: &Node) -> Option<[f64; 2]> {
        match &node.value {
            Value::Null => return None,
            Value::List(items) => {
                if let [
                    Node {
                        value: Value::Number(x),
                        ..
                    },
                    Node {
                        value: Value::Number(y),
                        ..
                    },
                ] = items.as_slice()
                    && x.is_finite()
                    && y.is_finite()
                {
                    return Some([*x, *y]);
                }
            }
            _ => {}
        }
        self.misfit(key, node, "a point [x, y]")
    }

    fn misfit<T>(&mut self, key: &str, node: &Node, expected: &str) -> Option<T> {
        self.complain(
            key,
            node,
            format!("{key} is {}, expected {expected}", node.value.shown()),
        )
    }

    fn complain<T>(&mut self, key: &str, node: &Node, message: String) -> Option<T> {
        self.errors
            .push(SettingsError::new(key, message, node.range.clone()));
        None
    }

    fn unknown(&mut self, key: &str, entry: &Entry, expected: &str) {
        let message = format!("{key} is not known, expected {expected}");
        self.errors
            .push(SettingsError::new(key, message, entry.key_range.clone()));
    }
}

/// The value that a fault of the passes speaks of, else what else the tree says about the passes.
pub(super) fn place_of(root: &Node, fault: &PassFault) -> Option<std::ops::Range<usize>> {
    let corrections =
        entry_of(root, "passes").and_then(|entry| entry_of(&entry.node, "corrections"));
    let of_list = corrections.and_then(|entry| match &entry.node.value {
        Value::List(items) => items.get(fault.pass)?.range.clone(),
        _ => None,
    });
    let of_key = |key: &str| entry_of(root, key).and_then(|entry| entry.node.range.clone());
    of_list
        .or_else(|| of_key("correction"))
        .or_else(|| of_key("wireDiameter"))
}

fn entry_of<'a>(root: &'a Node, key: &str) -> Option<&'a Entry> {
    match &root.value {
        Value::Table(entries) => entries.iter().find(|entry| camel_case(&entry.key) == key),
        _ => None,
    }
}

/// `wire-diameter` as `wireDiameter`; both spellings are taken everywhere.
fn camel_case(key: &str) -> String {
    let mut words = key.split('-');
    let mut camel: String = words.next().unwrap_or_default().into();
    for word in words {
        let mut letters = word.chars();
        camel.extend(letters.next().map(|first| first.to_ascii_uppercase()));
        camel.push_str(letters.as_str());
    }
    camel
}

#[cfg(test)]
mod tests {
    use super::super::{Corner, Layout, SideSetting, UnitSetting, from_json, from_toml};
    use super::*;
    use serde_json::json;

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
            "side = \"left\"",
            "\"left\"",
            "side is \"left\", expected one of both, auto, opening, punch",
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
            "corection is not known, expected correction,",
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
            "rules.small-radii is not known, expected small-radius",
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
        let (settings, errors) =
            from_toml(&format!("correction = 0.2\n{}", "# \n".repeat(400_000)));
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
        check(json!([]), None, 1);
        check(json!("x"), None, 1);
    }
}
