//! The findings as SARIF 2.1.0, which code hosts and editors read.

use super::Survey;
use crate::cli::Failure;
use crate::cli::report::{RelatedRow, Row, Span};
use crate::finding::{Rule, Severity};
use serde_json::{Value, json};

pub(super) fn log(survey: &Survey) -> Value {
    let notifications: Vec<Value> = survey
        .failures
        .iter()
        .map(|Failure(sentence)| json!({ "level": "error", "message": { "text": sentence } }))
        .collect();
    json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "wedm",
                "semanticVersion": env!("CARGO_PKG_VERSION"),
                "rules": Rule::ALL.iter().map(|&rule| described(rule, survey.docs_url.as_deref())).collect::<Vec<_>>(),
            } },
            "columnKind": "unicodeCodePoints",
            "invocations": [{
                "executionSuccessful": survey.failures.is_empty(),
                "toolExecutionNotifications": notifications,
            }],
            "results": survey.rows.iter().chain(&survey.suppressed).map(result).collect::<Vec<_>>(),
        }],
    })
}

fn described(rule: Rule, docs_url: Option<&str>) -> Value {
    let lines: Vec<String> = rule.lines().into_iter().map(|(_, line)| line).collect();
    let mut described = json!({
        "id": rule.name(),
        "shortDescription": { "text": rule.summary() },
        "help": { "text": lines.join("\n"), "markdown": rule.page() },
        "defaultConfiguration": { "level": level(rule.default_severity()) },
    });
    if let Some(docs_url) = docs_url {
        described["helpUri"] = docs_url.replace("{rule}", rule.name()).into();
    }
    described
}

fn result(row: &Row) -> Value {
    let mut result = json!({
        "ruleId": row.rule.name(),
        "ruleIndex": Rule::ALL.iter().position(|&rule| rule == row.rule),
        "level": level(row.severity),
        "message": { "text": row.message },
        "locations": [{ "physicalLocation": location(row, row.span) }],
        "properties": row.data,
    });
    if !row.related.is_empty() {
        let related = |other: &RelatedRow| {
            json!({
                "physicalLocation": location(row, other.span),
                "message": { "text": other.message },
            })
        };
        result["relatedLocations"] = row.related.iter().map(related).collect();
    }
    if let Some(reason) = &row.suppressed {
        let kind = if row.is_marked {
            "inSource"
        } else {
            "external"
        };
        result["suppressions"] = json!([{ "kind": kind, "justification": reason }]);
    }
    result
}

/// A place in the file of a row.
fn location(row: &Row, span: Span) -> Value {
    json!({
        "artifactLocation": { "uri": uri(&row.path) },
        "region": {
            "startLine": span.line,
            "startColumn": span.column,
            "endLine": span.end_line,
            "endColumn": span.end_column,
        },
    })
}

/// SARIF has no level below `note`.
fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Information | Severity::Hint => "note",
    }
}

/// A path as a URI reference: relative paths stay relative, characters that a URI cannot hold are escaped.
fn uri(path: &str) -> String {
    let forward = if cfg!(windows) {
        path.replace('\\', "/")
    } else {
        path.to_string()
    };
    let mut uri = String::new();
    if forward.starts_with('/') {
        uri.push_str("file://");
    } else if forward.as_bytes().get(1) == Some(&b':') {
        uri.push_str("file:///");
    }
    for byte in forward.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                uri.push(byte as char)
            }
            byte => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::uri;

    #[test]
    fn paths_become_uri_references() {
        let expected = [
            ("a b/ä.dxf", "a%20b/%C3%A4.dxf"),
            ("/parts/x#1.dxf", "file:///parts/x%231.dxf"),
            ("./p.3b", "./p.3b"),
        ];
        for (path, expected) in expected {
            assert_eq!(uri(path), expected);
        }
    }
}
