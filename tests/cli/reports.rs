//! What is told of findings, in each form that is asked for.

use super::{Desk, Ended, check};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};

/// In the frame of `simulate`: from the program's start, or absolute where the program says where it begins.
#[test]
fn a_finding_of_a_program_says_where_the_machine_stands() {
    let desk = Desk::new();
    let open = "B10000B0B10000GXL1\nB0B10000B10000GYL2\nB10000B0B10000GXL3\nB0B9300B9300GYL4\nDD\n";
    desk.write("open.3b", open);
    desk.write("open.4b", format!("; Start Point = 5.0 , -2.0\n{open}"));
    let iso = "G92X5.Y-2.\nG01X15.\nY8.\nX5.\nY-1.3\nM02\n";
    desk.write("open.iso", iso);
    let unread = open
        .replace("GXL1", "GXL7")
        .replace("B10000GXL3", "B9000GXL3");
    desk.write("unread.3b", unread);
    for (name, places) in [
        ("open.3b", vec!["(at 0.000, 0.700)"]),
        ("open.4b", vec!["(at 5.000, -1.300)"]),
        ("open.iso", vec!["(at 5.000, -1.300)"]),
        ("unread.3b", vec!["(at 0.000, 0.000)", ""]),
    ] {
        let said = desk.run(&format!("check {name} --output concise"));
        let found = said
            .stdout
            .lines()
            .filter(|line| line.contains("["))
            .map(|line| {
                let at = line.rfind("(at ").unwrap_or(line.len());
                &line[at..]
            });
        assert_eq!(found.collect::<Vec<_>>(), places, "{said:?}");
    }
    let json = desk.run("check open.iso --output json").stdout;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let data = &json["diagnostics"][0]["data"];
    assert_eq!(data["start"], serde_json::json!([5.0, 8.0]));
    assert_eq!(data["end"], serde_json::json!([5.0, -1.3]));
    assert_eq!(data["at"], data["end"]);
}

#[test]
fn sarif_leads_to_the_pages_where_they_are_published() {
    let desk = Desk::new();
    let rule = |desk: &Desk| {
        desk.run("check tight.dxf --output sarif").json()["runs"][0]["tool"]["driver"]["rules"][0]
            .clone()
    };
    let without = rule(&desk);
    assert!(without.get("helpUri").is_none() && without["help"]["markdown"].is_string());
    desk.write(
        "wedm.toml",
        "docs-url = \"https://edm.example/{rule}.html\"\n",
    );
    assert_eq!(
        rule(&desk)["helpUri"],
        "https://edm.example/small-radius.html"
    );
    desk.write("wedm.toml", "docs-url = \"https://edm.example/\"\n");
    check(
        &desk,
        "check tight.dxf",
        1,
        &["expected an address such as"],
    );
}

/// What can be repaired is told with what is said; where some rules alone are asked about, nothing is known of it.
#[test]
fn the_way_to_a_repair_is_told_where_all_rules_are_asked() {
    let desk = Desk::new();
    check(
        &desk,
        "check tight.dxf",
        1,
        &["wedm fix tight.dxf --in-place"],
    );
    for arguments in [
        "check tight.dxf --ignore small-radius",
        "check tight.dxf --select gap",
    ] {
        let ended = desk.run(arguments);
        assert_eq!(ended.code, Some(0));
        let first = ended.stdout.lines().next();
        assert_eq!(first, Some("1 file checked: nothing found"), "{arguments}");
    }
}

#[test]
fn of_more_than_a_hundred_thousand_findings_the_rest_is_counted() {
    let desk = Desk::new();
    desk.write(
        "heap.dxf",
        format!(
            "0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n",
            "0\nLINE\n".repeat(100_050)
        ),
    );
    let ended = desk.run("check heap.dxf --output json");
    let json = ended.json();
    let rows = json["diagnostics"].as_array().unwrap();
    let last = rows.last().unwrap();
    assert_eq!((ended.code, rows.len()), (Some(1), 100_001));
    assert_eq!(
        (last["rule"].as_str(), last["message"].as_str()),
        (Some("more"), Some("51 more findings are not shown"))
    );
}

#[test]
fn json_holds_each_finding_with_its_place_and_its_numbers() {
    let desk = Desk::new();
    let ended = desk.run("check tight.dxf chain.dxf clean.dxf --output json");
    assert_eq!(ended.code, Some(1));
    let json = ended.json();
    let rows = json["diagnostics"].as_array().unwrap();
    let places: Vec<_> = rows
        .iter()
        .map(|row| (row["path"].as_str().unwrap(), row["line"].as_u64().unwrap()))
        .collect();
    assert_eq!(places, [("tight.dxf", 34), ("chain.dxf", 40)]);
    let row = &rows[0];
    let keys: Vec<&String> = row.as_object().unwrap().keys().collect();
    assert_eq!(keys.len(), 9, "{keys:?}");
    assert_eq!(
        (
            row["column"].as_u64(),
            row["endLine"].as_u64(),
            row["endColumn"].as_u64()
        ),
        (Some(1), Some(34), Some(15))
    );
    assert_eq!(
        (row["rule"].as_str(), row["severity"].as_str()),
        (Some("small-radius"), Some("error"))
    );
    assert_eq!(
        (
            row["data"]["handle"].as_str(),
            row["data"]["segment"].as_u64()
        ),
        (Some("2A"), Some(1))
    );
    assert!((row["data"]["radius"].as_f64().unwrap() - 0.08).abs() < 1e-9);
    assert_eq!(row["data"]["required"].as_f64(), Some(0.1));
}

#[test]
fn json_is_printed_also_when_the_command_fails() {
    let desk = Desk::new();
    for (arguments, code) in [
        ("inspect tight.dxf --output json", 1),
        ("inspect missing.dxf --output json", 2),
        ("inspect hole.3b --output json", 2),
    ] {
        let ended = desk.run(arguments);
        assert_eq!(ended.code, Some(code), "{ended:?}");
        assert!(
            ended.json()["entities"].is_array()
                && ended.json()["diagnostics"].is_array()
                && ended.json()["unitsToMm"].is_number()
        );
    }
    assert_eq!(
        desk.run("check missing.dxf --output json").json()["diagnostics"],
        serde_json::json!([])
    );
}

#[test]
fn the_radius_list_names_vertex_radius_and_verdict() {
    let desk = Desk::new();
    let json = desk.run("inspect tight.dxf --output json").json();
    let segments = json["entities"][0]["segments"].as_array().unwrap();
    let verdicts: Vec<_> = segments
        .iter()
        .map(|segment| segment["verdict"].as_str().unwrap())
        .collect();
    assert_eq!(verdicts, ["ok", "small-radius", "ok", "ok", "ok", "ok"]);
    assert_eq!(segments[1]["kind"], "arc");
    assert_eq!(json["diagnostics"].as_array().unwrap().len(), 1);
    assert_eq!(
        desk.run("inspect inch.dxf --output json").json()["unitsToMm"],
        25.4
    );
    // What is there and not cut is listed: an arc that is a point.
    let tags = "0\nSECTION\n2\nENTITIES\n0\nARC\n5\nA\n10\n1\n20\n2\n40\n0\n50\n90\n51\n90\n0\nENDSEC\n0\nEOF\n";
    desk.write("point.dxf", tags);
    let listed = desk.run("inspect point.dxf --output json").json()["entities"][0].clone();
    assert_eq!(
        (
            &listed["type"],
            &listed["cut"],
            &listed["segments"][0]["radius"]
        ),
        (&"ARC".into(), &false.into(), &0.0.into())
    );
}

/// Every command that a hint names, as it is said, in the folder that it is said in.
#[test]
fn commands_in_hints_run() {
    let desk = Desk::new();
    let odd = "my plate's.dxf";
    desk.write(odd, desk.read("tight.dxf"));
    let shell = |line: &str| {
        let path = Path::new(env!("CARGO_BIN_EXE_wedm")).parent().unwrap();
        let paths = std::env::var("PATH").unwrap_or_default();
        let mut command = Command::new("sh");
        command
            .args(["-c", line])
            .current_dir(desk.0.path())
            .stdin(Stdio::null());
        command.env("PATH", format!("{}:{paths}", path.display()));
        Ended::of(command.output().unwrap())
    };
    let said = |arguments: &[&str]| {
        let output = desk.command("").args(arguments).output().unwrap();
        let ended = Ended::of(output);
        format!("{}{}", ended.stdout, ended.stderr)
    };
    let program = [
        "generate",
        "clean.dxf",
        "--side",
        "opening",
        "--compensation",
        "controller",
    ];
    desk.run("generate clean.dxf --side opening --format iso --compensation controller -o g41.iso");
    let hints = [
        said(&["check", "tight.dxf"]),
        said(&["check", odd]),
        said(&["generate", odd, "--side", "opening"]),
        said(&["draw", "hole.3b", "-o", "hole.dxf"]),
        said(&program),
        said(&["convert", "g41.iso", "-o", "g41.3b"]),
    ];
    let (mut run, mut known) = (0, std::collections::BTreeSet::new());
    for hint in &hints {
        for command in hint.split("wedm ").skip(1) {
            let end = command.find([')', '\n', ';', ',']).unwrap_or(command.len());
            let line = format!("wedm {}", command[..end].trim()).replace("OUT.dxf", "out.dxf");
            if !known.insert(line.clone()) {
                continue;
            }
            let ended = shell(&line);
            assert!(ended.code == Some(0), "{line}: {ended:?}");
            run += 1;
        }
    }
    assert!(run >= 4, "{hints:?}");
    // What a hint says to set, it may be set to.
    assert!(
        hints[4].contains("set compensation to path"),
        "{}",
        hints[4]
    );
    check(
        &desk,
        "generate clean.dxf --side opening --compensation path",
        0,
        &["DD\n"],
    );
    assert!(hints[5].contains("convert it to .dxf"), "{}", hints[5]);
    check(&desk, "convert g41.iso -o g41.dxf", 0, &[]);
    check(&desk, "generate g41.dxf --side opening", 0, &["DD\n"]);
}

#[test]
fn what_is_suppressed_with_a_reason_is_told_where_it_is_asked_for() {
    let desk = Desk::new();
    check(
        &desk,
        "check tight.dxf",
        1,
        &["error[small-radius]", "1 error"],
    );
    let found = desk.run("check tight.dxf --output json").json();
    let error = &found["diagnostics"].as_array().unwrap()[0];
    let (handle, rule) = (
        error["data"]["handle"].as_str().unwrap(),
        error["rule"].as_str().unwrap(),
    );
    let table = format!("[drawings.\"tight.dxf\".suppress.{handle}]\n");
    // Without a reason it is none.
    desk.write("wedm.toml", format!("{table}{rule} = \"\"\n"));
    check(
        &desk,
        "check tight.dxf",
        1,
        &["is empty, expected the reason", "small-radius"],
    );
    desk.write(
        "wedm.toml",
        format!("{table}{rule} = \"the wire is thin\"\n"),
    );
    check(
        &desk,
        "check tight.dxf",
        0,
        &["nothing found, 1 suppressed"],
    );
    let shown = [
        "error[small-radius]",
        "suppressed: the wire is thin",
        "nothing found",
    ];
    check(&desk, "check tight.dxf --show-suppressed", 0, &shown);
    let json = desk
        .run("check tight.dxf --show-suppressed --output json")
        .json();
    assert_eq!(json["suppressed"][0]["suppressed"], "the wire is thin");
    assert_eq!(json["diagnostics"], Value::Array(Vec::new()));
    let sarif = desk.run("check tight.dxf --output sarif").json();
    let result = &sarif["runs"][0]["results"][0];
    assert_eq!(
        result["suppressions"][0]["justification"],
        "the wire is thin"
    );
    assert_eq!(result["suppressions"][0]["kind"], "external");
    let marked = String::from_utf8(desk.read("tight.dxf")).unwrap();
    let layer = format!("\nWEDM_SUPPRESS_{rule}_the wire is thin\n");
    desk.write("marked.dxf", marked.replace("\nDIE\n", &layer));
    let sarif = desk.run("check marked.dxf --output sarif").json();
    let suppressed = &sarif["runs"][0]["results"][0]["suppressions"][0];
    assert_eq!(suppressed["kind"], "inSource", "{sarif}");
    check(&desk, "fix tight.dxf --diff", 0, &["!nothing to repair"]);
    check(
        &desk,
        "generate tight.dxf --side opening",
        0,
        &["DD\n", "!written stdout"],
    );
    // Of another drawing it says nothing, and what suppresses nothing is told.
    check(&desk, "check narrow.dxf", 1, &["2 errors, 1 warning"]);
    desk.write("wedm.toml", format!("{table}gap = \"filled\"\n"));
    let useless = format!("the suppression of gap at {handle} suppresses nothing here");
    check(
        &desk,
        "check tight.dxf",
        1,
        &["warning[settings]", &useless, "1 error, 1 warning"],
    );
}

#[test]
fn sarif_names_rules_places_and_what_could_not_be_read() {
    let desk = Desk::new();
    desk.write("sub folder/tight.dxf", desk.read("tight.dxf"));
    let mut command = desk.command("check --output sarif missing.dxf");
    let log = Ended::of(command.arg("sub folder").output().unwrap()).json();
    assert_eq!(log["version"], "2.1.0");
    let run = &log["runs"][0];
    let result = &run["results"][0];
    let index = result["ruleIndex"].as_u64().unwrap() as usize;
    assert_eq!(
        run["tool"]["driver"]["rules"][index]["id"],
        result["ruleId"]
    );
    let place = &result["locations"][0]["physicalLocation"];
    assert_eq!(place["artifactLocation"]["uri"], "sub%20folder/tight.dxf");
    assert_eq!(place["region"]["startLine"], 34);
    assert_eq!(result["level"], "error");
    assert_eq!(run["invocations"][0]["executionSuccessful"], false);
    assert!(
        run["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"]
            .as_str()
            .unwrap()
            .contains("missing.dxf")
    );
}

/// `check` knows no limit of findings.
#[test]
fn check_sees_all_findings() {
    let desk = Desk::new();
    let circle = |index: usize| {
        format!(
            "  0\nCIRCLE\n  5\n{:X}\n  8\nDIE\n 10\n{index}\n 20\n0\n 40\n0.05\n",
            256 + index
        )
    };
    let circles: String = (0..700).map(circle).collect();
    let text = format!(
        "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n4\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n{circles}  0\nENDSEC\n  0\nEOF\n"
    );
    desk.write("many.dxf", text);
    let rows = desk.run("check many.dxf --output json").json();
    assert_eq!(rows["diagnostics"].as_array().unwrap().len(), 700);
}
