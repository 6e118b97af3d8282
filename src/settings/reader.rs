//! Reads tables of settings from a tree of values: each key is checked, a value that does not fit
//! is left out and reported.

use super::row::{LARGEST, Range, Row};
use super::spelling::{is_slip, listed, named, nearest, snake_case};
use super::value::{Entry, Node, Value};
use super::{LengthSetting, PointSetting, RuleSeverity, SettingsError, shipped_profiles};
use crate::disk::leads_to_the_network;
use crate::drawing::{Color, Role};
use crate::finding::Rule;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;

/// A table with declared keys.
pub(super) trait Table: Default {
    /// The keys in their order, kebab-case.
    fn keys() -> Vec<String>;
    fn rows(prefix: &str) -> Vec<Row>;
    /// Reads the value of a key in snake_case; false where there is no such key. `dotted` is the key as it is written.
    fn read(&mut self, reader: &mut Reader, key: &str, dotted: &str, node: &Node) -> bool;
}

/// The values at fault so far. A method reads one kind of value: its dotted key, the value, and the
/// range where numbers have one.
#[derive(Default)]
pub(super) struct Reader {
    pub(super) errors: Vec<SettingsError>,
    /// Makes the list of all keys, where one that is not known may be one of another table.
    pub(super) all_keys: Option<fn() -> Vec<Row>>,
}

impl Reader {
    /// A table with declared keys.
    pub(crate) fn table<T: Table>(&mut self, key: &str, node: &Node) -> Option<T> {
        let mut table = T::default();
        self.entries(key, node, |reader, dotted, entry| {
            if !table.read(reader, &snake_case(&entry.key), dotted, &entry.node) {
                reader.unknown(dotted, entry, &listed(&T::keys()));
            }
        })
        .then_some(table)
    }

    /// Tables with declared keys, under names that the user gives.
    pub(crate) fn tables<T: Table>(
        &mut self,
        key: &str,
        node: &Node,
    ) -> Option<BTreeMap<String, T>> {
        self.by_name(key, node, |_| None, Reader::table)
    }

    /// Roles by a name that is taken literally.
    pub(crate) fn roles(&mut self, key: &str, node: &Node) -> Option<BTreeMap<String, Role>> {
        self.by_name(key, node, |_| None, Reader::name)
    }

    pub(crate) fn colors(&mut self, key: &str, node: &Node) -> Option<BTreeMap<String, Role>> {
        let misfit = |name: &str| {
            let is_color = Color::named(name).is_some();
            (!is_color).then(|| say!(colors_that_are_known).to_owned())
        };
        self.by_name(key, node, misfit, Reader::name)
    }

    pub(crate) fn rules(
        &mut self,
        key: &str,
        node: &Node,
    ) -> Option<BTreeMap<String, RuleSeverity>> {
        let names = Rule::ALL.map(Rule::name);
        let misfit = |name: &str| (!names.contains(&name)).then(|| names.join(", "));
        self.by_name(key, node, misfit, Reader::name)
    }

    /// By handle and by rule the reason of a suppression.
    pub(crate) fn reasons(
        &mut self,
        key: &str,
        node: &Node,
    ) -> Option<BTreeMap<String, BTreeMap<String, String>>> {
        let names = Rule::ALL.map(Rule::name);
        let misfit = |name: &str| (!names.contains(&name)).then(|| names.join(", "));
        self.by_name(
            key,
            node,
            |_| None,
            |reader, key, node| reader.by_name(key, node, misfit, Reader::reason),
        )
    }

    fn reason(&mut self, key: &str, node: &Node) -> Option<String> {
        let expected = say!(the_reason_in_words);
        let reason = self.text(key, node, expected)?;
        if reason.trim().is_empty() {
            return self.complain(key, node, say!(is_empty, key, expected));
        }
        Some(reason)
    }

    /// Names of layers by a name.
    pub(crate) fn layers_by_name(
        &mut self,
        key: &str,
        node: &Node,
    ) -> Option<BTreeMap<String, Vec<String>>> {
        let misfit = |_: &str| None;
        self.by_name(key, node, misfit, |reader, key, node| {
            let expected = say!(a_list_of_layers);
            reader.texts(key, node, expected, |reader, key, node| {
                reader.text(key, node, say!(the_name_of_a_layer))
            })
        })
    }

    /// Values by name. `misfit` lists the expected names where one is unknown.
    fn by_name<T>(
        &mut self,
        key: &str,
        node: &Node,
        misfit: impl Fn(&str) -> Option<String>,
        read: impl Fn(&mut Reader, &str, &Node) -> Option<T>,
    ) -> Option<BTreeMap<String, T>> {
        let mut values = BTreeMap::new();
        self.entries(key, node, |reader, dotted, entry| {
            if let Some(expected) = misfit(&entry.key) {
                reader.unknown(dotted, entry, &expected);
            } else if let Some(value) = read(reader, dotted, &entry.node) {
                values.insert(entry.key.clone(), value);
            }
        })
        .then_some(values)
    }

    /// A number for each pass.
    pub(crate) fn numbers(&mut self, key: &str, node: &Node, range: &Range) -> Option<Vec<f64>> {
        let expected = match key.starts_with("job.") {
            true => say!(a_list_of_numbers_one_for_each_wire),
            false => say!(a_list_of_numbers_one_for_each_pass),
        };
        match &node.value {
            Value::Null => None,
            Value::List(items) if !items.is_empty() => {
                let numbers = items.iter().enumerate().map(|(index, item)| {
                    let key = format!("{key}[{index}]");
                    match item.value {
                        Value::Null => self.misfit(&key, item, &range.expected(None)),
                        _ => self.number(&key, item, range),
                    }
                });
                // One wrong number in a list makes the others doubtful.
                let numbers: Vec<Option<f64>> = numbers.collect();
                numbers.into_iter().collect()
            }
            Value::List(_) => self.complain(key, node, say!(is_empty, key, expected)),
            _ => self.misfit(key, node, expected),
        }
    }

    pub(crate) fn profile_name(&mut self, key: &str, node: &Node) -> Option<String> {
        self.text(key, node, say!(the_name_of_a_profile))
    }

    /// An address with `{rule}` in it.
    pub(crate) fn page_address(&mut self, key: &str, node: &Node) -> Option<String> {
        let expected = say!(an_address_with_rule_in_it);
        let address = self.text(key, node, expected)?;
        let is_address = ["https://", "http://", "file://"]
            .iter()
            .any(|scheme| address.starts_with(scheme));
        if is_address && address.contains("{rule}") {
            return Some(address);
        }
        self.misfit(key, node, expected)
    }

    /// The path of a drawing on this computer: settings may lie beside a drawing of a stranger.
    pub(super) fn path(&mut self, key: &str, node: &Node) -> Option<String> {
        let expected = say!(the_path_of_a_drawing);
        let path = self.text(key, node, expected)?;
        let lower = path.to_ascii_lowercase();
        let is_drawing = lower.ends_with(".dxf") || lower.ends_with(".dxb");
        if is_drawing && !leads_to_the_network(&path) {
            return Some(path);
        }
        self.misfit(key, node, expected)
    }

    /// The name of a shipped profile. The shipped profiles themselves are read by this reader and have no base.
    pub(crate) fn base(&mut self, key: &str, node: &Node) -> Option<String> {
        let name = self.profile_name(key, node)?;
        if shipped_profiles().any(|shipped| shipped == name) {
            return Some(name);
        }
        let names: Vec<&str> = shipped_profiles().collect();
        self.misfit(key, node, &names.join(", "))
    }

    /// Lines of a program in which `{x}`, `{y}`, `{side}` and `{register}` are placeholders.
    pub(crate) fn lines(&mut self, key: &str, node: &Node) -> Option<Vec<String>> {
        self.texts(key, node, say!(a_list_of_lines), Reader::line)
    }

    pub(crate) fn words(&mut self, key: &str, node: &Node) -> Option<Vec<String>> {
        self.texts(key, node, say!(a_list_of_words), |reader, key, node| {
            reader.word(key, node)
        })
    }

    fn texts(
        &mut self,
        key: &str,
        node: &Node,
        expected: &str,
        read: impl Fn(&mut Reader, &str, &Node) -> Option<String>,
    ) -> Option<Vec<String>> {
        let items = match &node.value {
            Value::Null => return None,
            Value::List(items) => items,
            _ => return self.misfit(key, node, expected),
        };
        let texts: Vec<Option<String>> = items
            .iter()
            .enumerate()
            .map(|(index, item)| read(self, &format!("{key}[{index}]"), item))
            .collect();
        texts.into_iter().collect()
    }

    fn line(&mut self, key: &str, node: &Node) -> Option<String> {
        let line = self.text(key, node, say!(one_line_of_text))?;
        if line.chars().any(char::is_control) {
            return self.misfit(key, node, say!(one_line_without_control_characters));
        }
        let mut rest = line.as_str();
        while let Some((_, behind)) = rest.split_once('{') {
            let (name, behind) = match behind.split_once('}') {
                Some((name, behind)) => (format!("{{{name}}}"), behind),
                None => (format!("{{{behind}"), ""),
            };
            if !["{x}", "{y}", "{side}", "{register}"].contains(&&*name) {
                return self.complain(key, node, say!(holds_an_unknown_name, key, name));
            }
            rest = behind;
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

    pub(crate) fn truth(&mut self, key: &str, node: &Node) -> Option<bool> {
        match node.value {
            Value::Null => None,
            Value::Truth(truth) => Some(truth),
            _ => self.misfit(key, node, say!(true_or_false)),
        }
    }

    pub(crate) fn number(&mut self, key: &str, node: &Node, range: &Range) -> Option<f64> {
        match node.value {
            Value::Null => None,
            Value::Number(number) if range.holds(number) => Some(number),
            Value::Number(number) => self.misfit(key, node, &range.expected(Some(number))),
            _ => self.misfit(key, node, &range.expected(None)),
        }
    }

    pub(crate) fn whole<T: TryFrom<u32>>(
        &mut self,
        key: &str,
        node: &Node,
        range: &Range,
    ) -> Option<T> {
        match node.value {
            Value::Null => return None,
            Value::Number(number) if number.fract() == 0.0 && range.holds(number) => {
                if let Ok(whole) = T::try_from(number as u32) {
                    return Some(whole);
                }
            }
            _ => {}
        }
        self.misfit(
            key,
            node,
            &say!(a_whole_number_from_to, range.least, range.most),
        )
    }

    /// Hands each entry with its dotted key to `each`; false when there is no table.
    fn entries(
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
                return true;
            }
            Value::Null => {}
            // An empty table of Lua or PHP is sent as a list; what was sent has no place in a text.
            Value::List(items) if items.is_empty() && node.range.is_none() => return true,
            _ => {
                let key = if key.is_empty() { "settings" } else { key };
                self.misfit::<()>(key, node, say!(a_table));
            }
        }
        false
    }

    /// A word out of a closed set, which its type defines.
    pub(crate) fn name<T: DeserializeOwned>(&mut self, key: &str, node: &Node) -> Option<T> {
        let text = match &node.value {
            Value::Null => return None,
            Value::Text(text) => text.as_str(),
            _ => "",
        };
        match named(text) {
            Ok(name) => Some(name),
            Err(names) => match nearest(text, &names) {
                Some(near) => self.misfit(key, node, &say!(did_you_mean_of, names, near)),
                None => self.misfit(key, node, &names),
            },
        }
    }
    pub(crate) fn word(&mut self, key: &str, node: &Node) -> Option<String> {
        match &node.value {
            Value::Null => None,
            Value::Text(text)
                if !is_of_a_block(text) && text.chars().all(|c| c.is_ascii_alphanumeric()) =>
            {
                Some(text.clone())
            }
            _ => self.misfit(key, node, say!(a_word_of_letters_and_digits)),
        }
    }

    /// A text for people on one line.
    pub(crate) fn label(&mut self, key: &str, node: &Node) -> Option<String> {
        match &node.value {
            Value::Null => None,
            Value::Text(text)
                if text.chars().count() <= LONGEST_LABEL && !text.chars().any(char::is_control) =>
            {
                Some(text.trim().to_owned())
            }
            _ => self.misfit(key, node, &say!(a_text_on_one_line, LONGEST_LABEL)),
        }
    }

    /// A word, or an empty one for none.
    pub(crate) fn word_or_nothing(&mut self, key: &str, node: &Node) -> Option<String> {
        match &node.value {
            Value::Text(text) if text.is_empty() => Some(String::new()),
            _ => self.word(key, node),
        }
    }

    pub(crate) fn point_setting(&mut self, key: &str, node: &Node) -> Option<PointSetting> {
        match &node.value {
            Value::Table(_) => {
                let mut points = BTreeMap::new();
                self.entries(key, node, |reader, key, entry| {
                    if let Some(point) = reader.point(key, &entry.node) {
                        points.insert(entry.key.clone(), point);
                    }
                });
                Some(PointSetting::ByHandle(points))
            }
            _ => self.point(key, node).map(PointSetting::One),
        }
    }

    pub(crate) fn length_setting(
        &mut self,
        key: &str,
        node: &Node,
        range: &Range,
    ) -> Option<LengthSetting> {
        let Value::Table(_) = &node.value else {
            return self.number(key, node, range).map(LengthSetting::One);
        };
        let number = |reader: &mut Reader, key: &str, node: &Node| reader.number(key, node, range);
        self.by_name(key, node, |_| None, number)
            .map(LengthSetting::ByHandle)
    }

    pub(crate) fn point(&mut self, key: &str, node: &Node) -> Option<[f64; 2]> {
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
                    if x.abs().max(y.abs()) <= LARGEST {
                        return Some([*x, *y]);
                    }
                    return self.misfit(key, node, &say!(a_point_of_numbers_up_to, LARGEST));
                }
            }
            _ => {}
        }
        self.misfit(key, node, say!(a_point))
    }

    pub(super) fn misfit<T>(&mut self, key: &str, node: &Node, expected: &str) -> Option<T> {
        self.complain(
            key,
            node,
            say!(is_not_what_is_expected, key, node.value.shown(), expected),
        )
    }

    fn complain<T>(&mut self, key: &str, node: &Node, message: String) -> Option<T> {
        self.errors
            .push(SettingsError::new(key, message, node.range.clone()));
        None
    }

    /// The whole name of a key that stands in another table than where it was written; the first of several.
    fn elsewhere(&self, key: &str) -> Option<String> {
        let key = snake_case(key);
        let is_it = |row: &Row| row.key.rsplit('.').next().map(snake_case).as_ref() == Some(&key);
        self.all_keys?().into_iter().find(is_it).map(|row| row.key)
    }

    fn unknown(&mut self, key: &str, entry: &Entry, expected: &str) {
        let near = nearest(&entry.key, expected);
        // A key of another table is likelier than one of this that differs in several letters.
        let is_slip = near.is_some_and(|near| is_slip(&entry.key, near));
        let elsewhere = match is_slip {
            true => None,
            false => self.elsewhere(&entry.key),
        };
        let message = match elsewhere.as_deref().or(near) {
            Some(likely) => say!(is_not_known_did_you_mean, key, likely),
            None => say!(is_not_known, key, expected),
        };
        self.errors
            .push(SettingsError::new(key, message, entry.key_range.clone()));
    }
}

/// The most characters of a text for people.
const LONGEST_LABEL: usize = 200;

/// True of what a block of 3B consists of: a program could not be told from its end.
fn is_of_a_block(word: &str) -> bool {
    let word = word.to_ascii_uppercase();
    let letters = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let digits = word.get(letters.len()..).unwrap_or_default();
    match letters {
        "" | "B" | "J" | "N" | "G" | "GX" | "GY" => true,
        "L" | "SR" | "NR" => digits.len() == 1,
        _ => false,
    }
}

#[cfg(test)]
mod tests;
