//! Reads settings from an option of the command line.

use super::reader::Reader;
use super::value::{Entry, Node, Value};
use super::{Row, Settings};

impl Settings {
    /// A level that sets one key: commas separate the numbers of a list or a point.
    ///
    /// # Errors
    /// A sentence: what was expected.
    pub(crate) fn of_option(row: &Row, text: &str) -> Result<Settings, String> {
        let number = |text: &str| match text.trim().parse() {
            Ok(number) => Value::Number(number),
            Err(_) => Value::Text(text.into()),
        };
        let value = match row.read {
            "number" | "whole" | "length_setting" => number(text),
            "numbers" | "point_setting" => {
                let item = |text| node(number(text));
                Value::List(text.split(',').map(item).collect())
            }
            "truth" => text.parse().map_or(Value::Text(text.into()), Value::Truth),
            _ => Value::Text(text.into()),
        };
        let nest =
            |node_of_key: Node, key: &str| node(Value::Table(vec![Entry::new(key, node_of_key)]));
        let mut reader = Reader::default();
        let root = row.key.rsplit('.').fold(node(value), nest);
        let settings = reader.table("", &root).unwrap_or_default();
        match reader.errors.into_iter().next() {
            None => Ok(settings),
            Some(_) if row.read == "point_setting" => {
                Err(say!(expected_two_numbers_with_a_comma_between).into())
            }
            Some(error) => Err(error.message),
        }
    }
}

fn node(value: Value) -> Node {
    Node { value, range: None }
}
