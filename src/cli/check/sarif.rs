//! The findings as SARIF 2.1.0, which code hosts and editors read.

use super::Survey;
use crate::cli::Failure;
use crate::cli::report::{RelatedRow, Row};
use crate::finding::{Rule, Severity};
use serde_json::{Value, json};

pub(super) fn render(survey: &Survey) -> String {
    let notifications: Vec<Value> = survey
        .failures
        .iter()
        .map(|Failure(sentence)| json!({ "level": "error", "message": { "text": sentence } }))
        .collect();
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "wedm",
                "semanticVersion": env!("CARGO_PKG_VERSION"),
                "rules": Rule::ALL.iter().map(|&rule| described(rule)).collect::<Vec<_>>(),
            } },
            "columnKind": "unicodeCodePoints",
            "invocations": [{
                "executionSuccessful": survey.failures.is_empty(),
                "toolExecutionNotifications": notifications,
            }],
            "results": survey.rows.iter().map(result).collect::<Vec<_>>(),
        }],
    });
    format!("{log:#}\n")
}

fn described(rule: Rule) -> Value {
    json!({
        "id": rule.name(),
        "shortDescription": { "text": summary(rule) },
        "defaultConfiguration": { "level": level(rule.default_severity()) },
    })
}

fn result(row: &Row) -> Value {
    let mut result = json!({
        "ruleId": row.rule.name(),
        "ruleIndex": Rule::ALL.iter().position(|&rule| rule == row.rule),
        "level": level(row.severity),
        "message": { "text": row.message },
        "locations": [{ "physicalLocation": {
            "artifactLocation": { "uri": uri(&row.path) },
            "region": {
                "startLine": row.line,
                "startColumn": row.column,
                "endLine": row.end_line,
                "endColumn": row.end_column,
            },
        } }],
        "properties": row.data,
    });
    if !row.related.is_empty() {
        let location = |related: &RelatedRow| {
            json!({
                "physicalLocation": {
                    "artifactLocation": { "uri": uri(&row.path) },
                    "region": {
                        "startLine": related.line,
                        "startColumn": related.column,
                        "endLine": related.end_line,
                        "endColumn": related.end_column,
                    },
                },
                "message": { "text": related.message },
            })
        };
        result["relatedLocations"] = row.related.iter().map(location).collect();
    }
    result
}

/// SARIF has no level below `note`.
fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Information | Severity::Hint => "note",
    }
}

fn summary(rule: Rule) -> &'static str {
    match rule {
        Rule::SmallRadius => "An arc is tighter than the correction: the wire cannot follow it",
        Rule::SharpCorner => "A corner that the wire leaves rounded",
        Rule::NarrowSlot => "A slot narrower than the wire's way through it",
        Rule::LostPocket => "The offset loses a part of the outline",
        Rule::UnprovedPath => "No path of the wire holds its proof here",
        Rule::OffsetCollapse => "Nothing is left of the outline at this correction",
        Rule::OpenContour => "A contour that does not close",
        Rule::Gap => "Two ends that belong together do not meet",
        Rule::DuplicateEntity => "Two entities lie in the same place",
        Rule::Overlap => "Two segments run on one another",
        Rule::ShortSegment => "A segment too short to cut",
        Rule::NearTangent => "Two segments are nearly tangent, but not quite",
        Rule::SelfIntersection => "A contour touches or crosses itself or another",
        Rule::ArcAsChords => "An arc drawn as short lines",
        Rule::LeadIn => "The lead-in is too short or crosses a contour",
        Rule::PassOrder => "The corrections of the passes do not fall, or no wire is so thin",
        Rule::UnsupportedEntity => "Something in the drawing is not cut",
        Rule::Units => "The drawing's unit is missing or absurd",
        Rule::ArcOffRadius => "The ends of an arc are not on one circle about its centre",
        Rule::ArcWithoutRadius => "An arc whose centre is its start",
        Rule::CompensationSwitch => "The correction is switched by an arc or a rapid",
        Rule::WrongSide => "The correction sends the wire to the side of the part",
        Rule::CenterOnLine => "I or J beside a straight cut",
        Rule::WordTwice => "A word stands twice in a line",
        Rule::ReversedArc => "G02 where G03 is meant, or the other way round",
        Rule::Spur => "A cut that goes out and back on the same way",
        Rule::DoubledBlock => "A block that stands twice",
        Rule::MissingOffset => "G41 or G42 without the place of its correction",
        Rule::SideChange => "The correction changes its side within a cut",
        Rule::MissingCancel => "The correction is still on at the end",
        Rule::MissingReturn => "A subprogram without its return",
        Rule::CornerWord => "The word for a corner finds none",
        Rule::MixedNumbers => "Numbers with and without a decimal point",
        Rule::SuspectBlock => "A block that may be wrong",
        Rule::AmbiguousCenter => "The arcs do not tell how their centres are meant",
        Rule::MachineDependent => "A word that machines take in different ways",
        Rule::MissingB => "A block that has lost a B",
        Rule::BlockNumberAsB => "A block number that is written with B",
        Rule::LengthInJ => "J holds the length of a line, not its projection",
        Rule::WrongJ => "J is not what the block counts",
        Rule::JOverTurn => "J of an arc counts more than one turn",
        Rule::WrongCountingAxis => "G counts the wrong axis",
        Rule::WrongQuadrant => "Z names the wrong quadrant",
        Rule::ZeroBlock => "A block that moves nothing",
        Rule::TooManyDigits => "A number with more digits than the controller has",
        Rule::PositionMismatch => "Coordinates that are not where the block ends",
        Rule::PathCrossesItself => "A path that goes through itself",
        Rule::NotClosed => "A cut that does not close",
        Rule::MissingEnd => "A program without its end",
        Rule::TextAfterEnd => "Text behind the end of a program",
        Rule::BlockNumber => "A block number that stands twice",
        Rule::Syntax => "The file is damaged",
        Rule::Settings => "A setting does not fit",
        Rule::NotJudged => "A part that was left out, since it would have taken too much",
        Rule::More => "Stands for further findings",
    }
}

/// A path as a URI reference: relative paths stay relative, what a URI cannot hold is escaped.
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
