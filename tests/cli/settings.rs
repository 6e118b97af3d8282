//! Settings of the project, of a file that an option names, and of options.

use super::{Desk, check};

#[test]
fn a_settings_file_is_begun() {
    let desk = Desk::new();
    check(
        &desk,
        "init --wire 0.25 --gap 0.03 --passes 3 --machine robofil work",
        2,
        &["!work/wedm.toml"],
    );
    std::fs::create_dir(desk.path("work")).unwrap();
    let begin = "init --wire 0.25 --gap 0.03 --passes 3 --machine robofil work";
    check(
        &desk,
        begin,
        0,
        &["!work/wedm.toml written", "!side is not set"],
    );
    let text = String::from_utf8(desk.read("work/wedm.toml")).unwrap();
    for line in [
        "wire-diameter = 0.25",
        "corrections = [0.2150, 0.1700, 0.1400]",
        "gaps = [0.0300, 0.0150, 0.0150]",
        "profile = \"robofil\"",
        "# side = \"both\"",
    ] {
        assert!(text.contains(&format!("\n{line}\n")), "{line}: {text}");
    }
    assert!(!text.contains("#:schema"), "{text}");
    assert!(text.lines().count() < 45, "{text}");
    let on_top: Vec<&str> = text.lines().filter(|line| line.contains(" = ")).collect();
    let keys = ["wire-diameter = 0.25", "gap = 0.03", "# side = \"both\""];
    assert_eq!(on_top.get(..3), Some(&keys[..]), "{text}");
    std::fs::create_dir(desk.path("aside")).unwrap();
    check(
        &desk,
        "init --side auto aside",
        0,
        &["!side = \"auto\" (option)"],
    );
    check(&desk, "init --side left other", 2, &[]);
    check(&desk, begin, 2, &["!it already exists"]);
    desk.write(
        "work/wedm.schema.json",
        desk.run("config schema").stdout.as_bytes(),
    );
    check(&desk, &format!("{begin} --overwrite"), 0, &[]);
    let text = String::from_utf8(desk.read("work/wedm.toml")).unwrap();
    assert!(
        text.starts_with("#:schema ./wedm.schema.json\n# "),
        "{text}"
    );
    desk.write("work/clean.dxf", desk.read("clean.dxf"));
    check(&desk, "check work", 0, &["nothing found"]);
    // The table leaves the part as it is drawn: the finished part says nothing is cut beyond.
    let written = desk.run("generate work/clean.dxf --side punch --format iso");
    assert!(
        written
            .stderr
            .contains("finished part: at most 0.0000 mm stay uncut")
            && written.stderr.contains("; 0.0000 mm cut beyond"),
        "{}",
        written.stderr
    );
}

#[test]
fn settings_come_from_the_project_then_the_option_file_then_the_options() {
    let desk = Desk::new();
    desk.write("job/deep/tight.dxf", desk.read("tight.dxf"));
    desk.write("job/wedm.toml", "correction = 0.05\n");
    desk.write("fine.toml", "correction = 0.2\n");
    check(&desk, "check job/deep/tight.dxf", 0, &["nothing found"]);
    check(
        &desk,
        "check job/deep/tight.dxf --config fine.toml",
        1,
        &["the correction 0.200 mm"],
    );
    check(
        &desk,
        "check job/deep/tight.dxf --config fine.toml --correction 0.3",
        1,
        &["the correction 0.300 mm"],
    );
}

#[test]
fn a_fault_in_the_settings_is_a_finding_in_them() {
    let desk = Desk::new();
    for (toml, line) in [
        ("side = \"both\"\ncorrection = \"thick\"\n", 2),
        ("correction = \n", 1),
        ("corection = 0.1\n", 1),
    ] {
        desk.write("job/wedm.toml", toml);
        desk.write("job/clean.dxf", desk.read("clean.dxf"));
        desk.write("job/again.dxf", desk.read("clean.dxf"));
        check(
            &desk,
            "check job",
            1,
            &["error[settings]", "wedm.toml:", "2 files checked: 1 error"],
        );
        let json = desk.run("check job/clean.dxf --output json").json();
        assert_eq!(json["diagnostics"][0]["line"], line, "{json}");
        assert!(
            json["diagnostics"][0]["path"]
                .as_str()
                .unwrap()
                .ends_with("wedm.toml")
        );
        // Nothing is made with settings that may not be those that were meant.
        check(
            &desk,
            "generate job/clean.dxf --side opening",
            2,
            &["!error[settings]", "!settings that do not fit"],
        );
        check(
            &desk,
            "fix job/clean.dxf --diff",
            2,
            &["!settings that do not fit"],
        );
    }
}

#[test]
fn a_correction_on_the_command_line_comes_before_the_passes_of_the_file() {
    let desk = Desk::new();
    desk.write("wedm.toml", "passes.corrections = [0.09, 0.05]\n");
    let generate = "generate clean.dxf --side opening --format iso --compensation controller";
    for (options, told) in [
        (
            "",
            "to be entered at the control: D1 = 0.0900 mm, D2 = 0.0500 mm",
        ),
        (
            "--correction 0.08",
            "to be entered at the control: D1 = 0.0800 mm\n",
        ),
        ("--passes 0.08,0.06", "D1 = 0.0800 mm, D2 = 0.0600 mm"),
    ] {
        check(
            &desk,
            &format!("{generate} {options}"),
            0,
            &[&format!("!{told}")],
        );
    }
    let both = format!("{generate} --correction 0.08 --passes 0.08,0.06");
    check(&desk, &both, 2, &["!--correction", "!cannot be used with"]);
}

#[test]
fn settings_that_cannot_be_read_are_said_and_nothing_is_made_without_them() {
    let desk = Desk::new();
    std::fs::create_dir(desk.path("job")).unwrap();
    desk.write("job/clean.dxf", desk.read("clean.dxf"));
    let file = desk.path("job/wedm.toml");
    let refused = |why: &str| {
        for command in ["check job/clean.dxf", "generate job/clean.dxf --side punch"] {
            check(&desk, command, 2, &["!job/wedm.toml", why]);
        }
        check(&desk, "init job", 2, &["!wedm.toml"]);
    };
    std::fs::create_dir(&file).unwrap();
    refused("!it is a folder");
    std::fs::remove_dir(&file).unwrap();
    check(&desk, "check job/clean.dxf", 0, &[]);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("nowhere.toml", &file).unwrap();
        refused("!a link to a file that is not there");
    }
}

/// A table of passes that would be refused is not written, and a number without a digit before its point is said once.
#[test]
fn what_would_be_refused_is_not_written() {
    let desk = Desk::new();
    let made = desk.run(
        "init . --wire 0.1 --gap 0.01 --fine-gap 0.02 --stock 0.005 --passes 3 --machine generic",
    );
    assert_eq!(made.code, Some(2), "{made:?}");
    assert!(made.stderr.contains("corrections decrease"), "{made:?}");
    assert!(!desk.path("wedm.toml").exists());
    for value in [".2", "2.", "+.2", "0.2.1", "02"] {
        let (_, errors) = wedm::settings::from_toml(&format!("wire-diameter = {value}\n"));
        assert_eq!(errors.len(), 1, "{value}: {errors:?}");
    }
}

/// The order in which contours are picked, where none is.
#[test]
fn an_order_of_picks_without_picks_is_said() {
    let desk = Desk::new();
    desk.write(
        "wedm.toml",
        "side = \"opening\"\nprogram.order = \"as-picked\"\n",
    );
    desk.write(
        "x.dxf",
        "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n5\n2A\n10\n0\n20\n0\n40\n5\n0\nENDSEC\n0\nEOF\n",
    );
    let said = "no contour is picked";
    let made = desk.run("generate x.dxf -o x.3b --overwrite");
    assert!(
        made.code == Some(0) && made.stderr.contains(said),
        "{made:?}"
    );
    let made = desk.run("generate x.dxf --handle 2A -o y.3b");
    assert!(
        made.code == Some(0) && !made.stderr.contains(said),
        "{made:?}"
    );
}
