//! Numbers as CAD programs send them: what is not a number becomes NaN here and is named with its place later.
//!
//! A drawing with one `null` among a million coordinates is refused with the handle and the vertex,
//! which a parser's "invalid type: null" would not tell.

use serde::de::{Deserialize, Deserializer, Visitor};

/// A number, or NaN for null, text and truth values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Number(pub f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Any;
        impl Visitor<'_> for Any {
            type Value = Number;

            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("a number")
            }
            fn visit_f64<E>(self, value: f64) -> Result<Number, E> {
                Ok(Number(value))
            }
            fn visit_i64<E>(self, value: i64) -> Result<Number, E> {
                Ok(Number(value as f64))
            }
            fn visit_u64<E>(self, value: u64) -> Result<Number, E> {
                Ok(Number(value as f64))
            }
            fn visit_bool<E>(self, _: bool) -> Result<Number, E> {
                Ok(Number(f64::NAN))
            }
            fn visit_str<E>(self, _: &str) -> Result<Number, E> {
                Ok(Number(f64::NAN))
            }
            fn visit_unit<E>(self) -> Result<Number, E> {
                Ok(Number(f64::NAN))
            }
        }
        deserializer.deserialize_any(Any)
    }
}

#[cfg(test)]
mod tests {
    use super::Number;

    #[test]
    fn the_number_is_the_one_that_was_written_to_the_last_bit() {
        // Parsers that multiply by a power of ten are a bit off with these: a radius could then
        // fall on the other side of its limit.
        for text in [
            "0.10000000000000009",
            "31.245270191439438",
            "7.2057594037927933e16",
            "123.456789012345678",
            "0.8999999999999999",
        ] {
            let Number(found) = serde_json::from_str(text).unwrap();
            assert_eq!(found, text.parse::<f64>().unwrap(), "{text}");
        }
        let mut state = 1_u64;
        for _ in 0..10_000 {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            let number = (state >> 11) as f64 / 1e13;
            let Number(found) = serde_json::from_str(&number.to_string()).unwrap();
            assert_eq!(found, number);
        }
    }
}
