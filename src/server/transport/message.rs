//! Reads a JSON-RPC message from a body: request, notification, reply, or an error.

use super::weight::{LIMIT, is_too_heavy};
use serde_json::Value;
use std::borrow::Cow;
use tower_lsp::jsonrpc::{Error, ErrorCode, Id, Request};

/// What the client sent.
#[derive(Debug)]
pub(super) enum Incoming {
    /// A request, or a notification where it has no id.
    Request(Request),
    /// The answer to a request of ours.
    Reply {
        id: String,
        result: Result<Value, Value>,
    },
    /// None of these; the id is null where it cannot be known.
    Invalid { id: Id, error: Error },
}

/// Reads a body. A body that is not JSON is `Err`; one whose values would fill the memory is not read.
pub(super) fn parse(body: &[u8]) -> Result<Incoming, Error> {
    if is_too_heavy(body) {
        return Ok(invalid(
            Id::Null,
            say!(a_message_holds_too_much, body.len(), LIMIT),
        ));
    }
    let value = parse_json(body).map_err(|reason| Error {
        code: ErrorCode::ParseError,
        message: Cow::Owned(say!(invalid_json, reason)),
        data: None,
    })?;
    let Value::Object(mut message) = value else {
        return Ok(invalid(Id::Null, say!(a_message_is_an_object)));
    };
    let id = match message.remove("id") {
        None => None,
        Some(Value::String(id)) => Some(Id::String(id)),
        Some(Value::Number(number)) if number.as_i64().is_some() => number.as_i64().map(Id::Number),
        Some(Value::Null) => Some(Id::Null),
        Some(_) => {
            return Ok(invalid(Id::Null, say!(the_id_is_neither_number_nor_string)));
        }
    };
    let method = match message.remove("method") {
        Some(Value::String(method)) => method,
        Some(_) => {
            return Ok(invalid(
                id.unwrap_or_default(),
                say!(the_method_is_not_a_string),
            ));
        }
        None => return Ok(reply(id, message)),
    };
    if message.get("jsonrpc").and_then(Value::as_str) != Some("2.0") {
        return Ok(invalid(id.unwrap_or_default(), say!(jsonrpc_is_not_2_0)));
    }
    // Many clients send `{}` or `[]` to a method that takes nothing, which the framework refuses.
    let takes_nothing = matches!(method.as_str(), "shutdown" | "exit");
    let params = message.remove("params").filter(|_| !takes_nothing);
    let mut request = Request::build(method);
    if let Some(params) = params {
        request = request.params(params);
    }
    if let Some(id) = id {
        request = request.id(id);
    }
    Ok(Incoming::Request(request.finish()))
}

fn reply(id: Option<Id>, mut message: serde_json::Map<String, Value>) -> Incoming {
    // A reply whose result is "undefined" comes without the key. Ids of ours are strings.
    match (id, message.remove("error")) {
        (Some(Id::String(id)), Some(error)) if !error.is_null() => Incoming::Reply {
            id,
            result: Err(error),
        },
        (Some(Id::String(id)), _) => Incoming::Reply {
            id,
            result: Ok(message.remove("result").unwrap_or_default()),
        },
        // The client's id could be that of a request that still waits: it is not echoed.
        _ => invalid(Id::Null, say!(a_message_without_a_method)),
    }
}

fn invalid(id: Id, reason: impl Into<Cow<'static, str>>) -> Incoming {
    let error = Error {
        code: ErrorCode::InvalidRequest,
        message: reason.into(),
        data: None,
    };
    Incoming::Invalid { id, error }
}

fn parse_json(body: &[u8]) -> Result<Value, String> {
    serde_json::from_slice(body).or_else(|error| {
        let quoted = quote_overflowing_numbers(body);
        let whole = replace_halves_of_letters(quoted.as_deref().unwrap_or(body));
        match whole.or(quoted) {
            Some(body) => serde_json::from_slice(&body).map_err(|error| error.to_string()),
            None => Err(error.to_string()),
        }
    })
}

/// The body with U+FFFD in place of each escape of a surrogate without its other half; `None` where there is none.
///
/// Editors that count in UTF-16 send such halves, and the parser would refuse the message. Either counts as one there.
fn replace_halves_of_letters(body: &[u8]) -> Option<Vec<u8>> {
    let unit_at = |at: usize| {
        let digits = body.get(at..)?.strip_prefix(b"\\u")?.get(..4)?;
        u16::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()
    };
    let mut replaced: Option<Vec<u8>> = None;
    let mut at = 0;
    while let Some(next) = memchr::memchr(b'\\', body.get(at..)?) {
        at += next;
        at += match (unit_at(at), unit_at(at + 6)) {
            (Some(0xd800..0xdc00), Some(0xdc00..0xe000)) => 12,
            (Some(0xd800..0xe000), _) => {
                let replaced = replaced.get_or_insert_with(|| body.to_vec());
                replaced.get_mut(at + 2..at + 6)?.copy_from_slice(b"fffd");
                6
            }
            _ => 2,
        };
    }
    replaced
}

/// The body with every number that no `f64` can hold (`1e999`) in quotes; `None` where there is none.
///
/// Such a number is valid JSON. The parser would refuse the message without naming the coordinate; as text it reaches
/// the code that can.
fn quote_overflowing_numbers(body: &[u8]) -> Option<Vec<u8>> {
    let mut quoted = Vec::new();
    let mut copied = 0;
    let mut at = 0;
    while let Some(&byte) = body.get(at) {
        match byte {
            b'"' => {
                at += 1;
                while let Some(&inside) = body.get(at).filter(|&&inside| inside != b'"') {
                    at += if inside == b'\\' { 2 } else { 1 };
                }
                at += 1;
            }
            b'-' | b'0'..=b'9' => {
                let begin = at;
                while body.get(at).is_some_and(|byte| {
                    matches!(byte, b'-' | b'+' | b'.' | b'e' | b'E' | b'0'..=b'9')
                }) {
                    at += 1;
                }
                let token = body.get(begin..at).unwrap_or_default();
                let number = std::str::from_utf8(token)
                    .ok()
                    .and_then(|token| token.parse::<f64>().ok());
                if number.is_some_and(f64::is_infinite) {
                    quoted.extend_from_slice(body.get(copied..begin).unwrap_or_default());
                    quoted.push(b'"');
                    quoted.extend_from_slice(token);
                    quoted.push(b'"');
                    copied = at;
                }
            }
            _ => at += 1,
        }
    }
    (copied > 0).then(|| {
        quoted.extend_from_slice(body.get(copied..).unwrap_or_default());
        quoted
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_of_message_is_told_from_the_others() {
        let check = |body: &str, expected: &str| {
            let seen = match parse(body.as_bytes()) {
                Err(error) => format!("{}", error.code),
                Ok(Incoming::Request(request)) => {
                    format!("{} {:?}", request.method(), request.id())
                }
                Ok(Incoming::Reply { id, result }) => format!("{id} {result:?}"),
                Ok(Incoming::Invalid { id, error }) => format!("{} {id}", error.code),
            };
            assert_eq!(seen, expected, "{}", &body[..body.len().min(200)]);
        };
        check(
            r#"{"jsonrpc":"2.0","id":1,"method":"a","params":{}}"#,
            "a Some(Number(1))",
        );
        check(r#"{"jsonrpc":"2.0","method":"a"}"#, "a None");
        check(
            r#"{"jsonrpc":"2.0","id":"wedm-1","result":null}"#,
            "wedm-1 Ok(Null)",
        );
        check(r#"{"jsonrpc":"2.0","id":"wedm-1"}"#, "wedm-1 Ok(Null)");
        check(
            r#"{"jsonrpc":"2.0","id":"wedm-1","error":{"code":1}}"#,
            r#"wedm-1 Err(Object {"code": Number(1)})"#,
        );
        check(r#"{"jsonrpc":"2.0","id":7}"#, "-32600 null");
        check(r#"{"jsonrpc":"1.0","id":7,"method":"a"}"#, "-32600 7");
        check(r#"{"jsonrpc":"2.0","id":1.5,"method":"a"}"#, "-32600 null");
        check(r#"{"jsonrpc":"2.0","id":7,"method":3}"#, "-32600 7");
        check("[]", "-32600 null");
        check(
            &format!(
                r#"{{"jsonrpc":"2.0","id":7,"method":"a","params":[{}[]]}}"#,
                "[],".repeat(4_000_000)
            ),
            "-32600 null",
        );
        check("42", "-32600 null");
        check("{", "-32700");
        check("", "-32700");
        check(r#"{"a":NaN}"#, "-32700");
        check("\u{0}", "-32700");
    }

    #[test]
    fn half_a_letter_arrives_as_the_sign_for_one() {
        let check = |body: &str, expected: Option<&str>| {
            let read = parse_json(body.as_bytes()).ok();
            let read = read.map(|value| value.as_str().unwrap_or_default().to_owned());
            assert_eq!(read.as_deref(), expected, "{body}");
        };
        check(r#""a\ud83d""#, Some("a\u{fffd}"));
        check(r#""\ude00a""#, Some("\u{fffd}a"));
        check(r#""\ud83d\ud83d\ude00\ude00""#, Some("\u{fffd}😀\u{fffd}"));
        check(r#""\ud83d\\ude00""#, Some("\u{fffd}\\ude00"));
        check(r#""\ud83d\n""#, Some("\u{fffd}\n"));
        check(r#""\ud83""#, None);
        check(r#""\ud83d"#, None);
    }

    #[test]
    fn a_number_that_overflows_arrives_as_text() {
        let check = |body: &str, expected: &str| {
            assert_eq!(
                parse_json(body.as_bytes()).map(|value| value.to_string()),
                Ok(expected.into()),
                "{body}"
            );
        };
        check(r#"[1e999,-1e999, 2]"#, r#"["1e999","-1e999",2]"#);
        check(r#"["1e999 \" 1e999",1]"#, r#"["1e999 \" 1e999",1]"#);
        check(r#"{"a":[0.5,1e400]}"#, r#"{"a":[0.5,"1e400"]}"#);
    }
}
