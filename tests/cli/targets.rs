//! What a command writes to: the ending of a name tells the truth, and nobody's files are overwritten unasked.

use super::{Desk, check};

/// What is written begins so, by its kind.
const DXF: &str = "0\nSECTION";
const THREE_B: &str = "B";

#[test]
fn the_ending_decides_and_never_lies() {
    let desk = Desk::new();
    let generate = "generate clean.dxf --side opening";
    for (arguments, written, begins) in [
        (format!("{generate} -o a.3b"), "a.3b", THREE_B),
        (
            format!("{generate} -o a.4b --correction 0.05"),
            "a.4b",
            THREE_B,
        ),
        (format!("{generate} -o a.iso"), "a.iso", "G"),
        (format!("{generate} -o a.NC"), "a.NC", "G"),
        (format!("{generate} -o a.txt"), "a.txt", THREE_B),
        (format!("{generate} -o a"), "a", THREE_B),
        (format!("{generate} --format iso -o b.txt"), "b.txt", "G"),
        (format!("{generate} --format iso -o b.nc"), "b.nc", "G"),
        ("convert hole.3b -o c.dxf".into(), "c.dxf", DXF),
        ("convert hole.3b --format iso -o c.nc".into(), "c.nc", "G"),
        ("convert hole.3b --format dxf -o c.any".into(), "c.any", DXF),
        ("format hole.3b -o d.3b".into(), "d.3b", ""),
        ("format hole.3b -o d.txt".into(), "d.txt", ""),
        ("fix clean.dxf -o e.dxf".into(), "e.dxf", ""),
    ] {
        check(&desk, &arguments, 0, &[]);
        let text = String::from_utf8(desk.read(written)).unwrap();
        // Beside the head of an ISO program.
        let text = text
            .replace('\r', "")
            .trim_start_matches(['%', '\n', ' ', 'O', '1', 'N'])
            .to_owned();
        assert!(text.starts_with(begins), "{arguments}: {text}");
    }
    for (arguments, target, says) in [
        (
            format!("{generate} -o p.dxf"),
            "p.dxf",
            "a program is written there: expected .3b, .4b, .iso, .nc",
        ),
        (
            format!("{generate} -o p.svg"),
            "p.svg",
            "a program is written there",
        ),
        (
            format!("{generate} --format 3b -o p.iso"),
            "p.iso",
            "3B is written there: expected .3b",
        ),
        (
            format!("{generate} --format iso -o p.3b"),
            "p.3b",
            "ISO is written there: expected .iso, .nc",
        ),
        (
            format!("{generate} --format milling -o p.3b"),
            "p.3b",
            "ISO (milling) is written there",
        ),
        (
            "convert hole.3b -o x.dxf --format iso".into(),
            "x.dxf",
            "ISO is written there",
        ),
        (
            "convert hole.3b -o x.3b --format dxf".into(),
            "x.3b",
            "DXF is written there: expected .dxf",
        ),
        (
            "fix clean.dxf -o x.svg".into(),
            "x.svg",
            "DXF is written there",
        ),
        (
            "fix hole.3b -o x.iso".into(),
            "x.iso",
            "3B is written there: expected .3b, .4b",
        ),
        (
            "format hole.3b -o x.nc".into(),
            "x.nc",
            "3B is written there",
        ),
        (
            "pair clean.dxf -o x.iso".into(),
            "x.iso",
            "expected the name of a folder",
        ),
        (
            "report clean.dxf -o x.html".into(),
            "x.html",
            "expected the name of a folder",
        ),
        (
            "holes clean.dxf --side opening -o x.3b".into(),
            "x.3b",
            "not as .3b",
        ),
        ("draw clean.dxf -o x.iso".into(), "x.iso", "expected .svg"),
    ] {
        check(
            &desk,
            &arguments,
            2,
            &[&format!("!{target}: "), &format!("!{says}")],
        );
        assert!(!desk.path(target).exists(), "{arguments} wrote");
    }
}

#[test]
fn files_of_others_are_not_overwritten() {
    let desk = Desk::new();
    let rows = [
        ("demo own", "own/wedm.toml"),
        ("demo own", "own/demo.dxf"),
        ("demo own", "own/demo.3b"),
        ("demo own", "own/demo.svg"),
        ("report clean.dxf -o own", "own/index.html"),
        ("report clean.dxf -o own", "own/clean.html"),
        ("init own", "own/wedm.toml"),
    ];
    for (command, name) in rows {
        desk.write(name, "correction = 0.2\n");
        check(
            &desk,
            command,
            2,
            &[&format!("!{name}: it already exists"), "!--overwrite"],
        );
        assert_eq!(desk.read(name), b"correction = 0.2\n", "{command}");
        assert_eq!(
            std::fs::read_dir(desk.path("own")).unwrap().count(),
            1,
            "{command}"
        );
        check(&desk, &format!("{command} --overwrite"), 0, &[]);
        assert_ne!(
            desk.read(name),
            b"correction = 0.2\n",
            "{command} --overwrite"
        );
        // What an earlier run has written may be written again; `init` is asked each time.
        if !command.starts_with("init") {
            check(&desk, command, 0, &[]);
        }
        std::fs::remove_dir_all(desk.path("own")).unwrap();
    }
}

#[test]
fn a_file_that_holds_something_else_is_not_overwritten() {
    let desk = Desk::new();
    for (command, name) in [
        ("generate clean.dxf --side opening -o x.3b", "x.3b"),
        ("fix tight.dxf -o x.dxf", "x.dxf"),
        ("format hole.3b -o x.3b", "x.3b"),
        ("convert hole.3b -o x.dxf", "x.dxf"),
        ("draw clean.dxf -o x.svg", "x.svg"),
        ("holes clean.dxf --side opening -o x.csv", "x.csv"),
    ] {
        desk.write(name, "of somebody else\n");
        check(
            &desk,
            command,
            2,
            &[&format!("!{name}: it already exists"), "!--overwrite"],
        );
        assert_eq!(desk.read(name), b"of somebody else\n", "{command}");
        check(&desk, &format!("{command} --overwrite"), 0, &[]);
        let made = desk.read(name);
        assert_ne!(made, b"of somebody else\n", "{command}");
        // The same again overwrites nothing.
        check(&desk, command, 0, &[]);
        assert_eq!(desk.read(name), made, "{command}");
        std::fs::remove_file(desk.path(name)).unwrap();
    }
}

/// An input that is read from stdin is a file like any other, of the kind that its content has.
#[test]
fn stdin_is_an_input_of_every_command_that_takes_one_text() {
    let desk = Desk::new();
    let hole = String::from_utf8(desk.read("hole.3b")).unwrap();
    for (arguments, input, says) in [
        ("check -", "clean.dxf", "nothing found"),
        ("fix - -o -", "tight.dxf", "1 arc repaired"),
        ("format -", "hole.3b", hole.lines().next().unwrap()),
        ("convert - --format dxf", "hole.3b", "LWPOLYLINE"),
        ("simulate -", "hole.3b", "blocks"),
        ("generate - --side opening", "clean.dxf", "DD"),
        ("inspect -", "clean.dxf", "all of them can be cut"),
        ("contours -", "clean.dxf", "contour 1"),
        ("draw -", "clean.dxf", "<svg"),
        ("draw -", "hole.3b", "<svg"),
    ] {
        let file = std::fs::File::open(desk.path(input)).unwrap();
        let ended = super::Ended::of(desk.command(arguments).stdin(file).output().unwrap());
        assert_eq!(ended.code, Some(0), "{arguments}: {ended:?}");
        let said = format!("{}{}", ended.stdout, ended.stderr);
        assert!(said.contains(says), "{arguments}: {ended:?}");
    }
    check(
        &desk,
        "fix - --in-place",
        2,
        &["!-: it is not a regular file"],
    );
    check(
        &desk,
        "format - --in-place",
        2,
        &["!-: it is not a regular file"],
    );
    check(
        &desk,
        "format hole.3b missing.3b",
        2,
        &["!missing.3b: no such file or directory"],
    );
}

#[test]
fn an_option_that_does_not_fit_is_named_and_no_line_of_a_file() {
    let desk = Desk::new();
    desk.write("job/wedm.toml", "gap = 0.01\nwire-diameter = 0.18\n");
    desk.write("job/clean.dxf", desk.read("clean.dxf"));
    desk.write("job/again.dxf", desk.read("clean.dxf"));
    for command in [
        "check job",
        "generate job/clean.dxf --side opening",
        "fix job/clean.dxf --diff",
    ] {
        for (options, says) in [
            (
                "--passes 0.1,0.2",
                "--passes: passes.corrections[1] is 0.2, expected at most 0.1",
            ),
            (
                "--correction 0.05",
                "--correction: correction is 0.05, expected at least the wire's radius 0.09",
            ),
        ] {
            let ended = desk.run(&format!("{command} {options}"));
            assert_eq!(ended.code, Some(2), "{command}: {ended:?}");
            assert_eq!(
                ended.stderr.matches(says).count(),
                1,
                "{command}: {ended:?}"
            );
            let said = ended.stdout + &ended.stderr;
            assert!(!said.contains("wedm.toml"), "{command}: {said}");
        }
    }
}

/// The wire's radius and the gap of a pass reach farther than its correction.
#[test]
fn passes_that_cut_beyond_the_contour_are_said() {
    let desk = Desk::new();
    let wire = "wire-diameter = 0.18\ngap = 0.01\n";
    for (settings, says) in [
        (
            "[passes]\ncorrections = [0.16, 0.125, 0.095]\n",
            Some("passes.corrections[2] is 0.095"),
        ),
        ("[passes]\ncorrections = [0.16, 0.125, 0.1]\n", None),
        (
            "[passes]\ncorrections = [0.16, 0.125, 0.095]\ngaps = [0.01, 0.007, 0.005]\n",
            None,
        ),
        (
            "correction = 0.097\n",
            Some("it would cut 0.0030 mm beyond the contour"),
        ),
        ("", None),
    ] {
        let top = if settings.starts_with("correction") {
            settings
        } else {
            ""
        };
        let rest = if top.is_empty() { settings } else { "" };
        desk.write("wedm.toml", format!("{wire}{top}{rest}"));
        let checked = desk.run("check clean.dxf");
        assert_eq!(checked.code, Some(0), "{checked:?}");
        let made = desk.run("generate clean.dxf --side opening");
        assert_eq!(made.code, Some(0), "{made:?}");
        match says {
            Some(says) => {
                assert!(
                    checked.stdout.contains("warning[pass-order]") && checked.stdout.contains(says),
                    "{checked:?}"
                );
                assert!(made.stderr.contains(says), "{made:?}");
            }
            None => {
                assert!(checked.stdout.contains("nothing found"), "{checked:?}");
                assert!(!made.stderr.contains("pass-order"), "{made:?}");
            }
        }
    }
    desk.write("wedm.toml", wire);
    check(
        &desk,
        "generate clean.dxf --side opening --passes 0.16,0.095",
        0,
        &["!warning: --passes: passes.corrections[1] is 0.095"],
    );
}

#[test]
fn what_is_no_text_of_a_program_is_said_once_and_left_alone() {
    let desk = Desk::new();
    // Bytes without an order: 32 of 256 are control characters.
    let mut state = 1_u32;
    let mut byte = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    let bytes: Vec<u8> = (0..20_000).map(|_| byte()).collect();
    for (name, rule) in [
        ("r.iso", "error[syntax]"),
        ("r.3b", "error[syntax]"),
        ("r.dxf", "error[syntax]"),
    ] {
        desk.write(name, &bytes);
        check(
            &desk,
            &format!("check {name}"),
            1,
            &[rule, "1 file checked: 1 error"],
        );
        let ended = desk.run(&format!("check {name}"));
        assert!(!ended.stdout.contains("wedm fix"), "{ended:?}");
        assert!(ended.stdout.len() < 1000, "{ended:?}");
        desk.run(&format!("fix {name} --in-place"));
        assert_eq!(desk.read(name), bytes, "{name} is changed");
    }
    desk.run("format r.iso --in-place");
    assert_eq!(desk.read("r.iso"), bytes);
    for name in ["e.iso", "e.3b"] {
        desk.write(name, "");
        check(
            &desk,
            &format!("check {name}"),
            0,
            &["information[syntax]: no block is found", "1 note"],
        );
    }
}

/// What does not decide the exit code is no failure to a build server either.
#[test]
fn junit_fails_where_the_command_does() {
    let desk = Desk::new();
    for (arguments, code, failures) in [
        ("check tight.dxf", 1, 1),
        ("check e.3b", 0, 0),
        ("check inverse.dxf", 0, 0),
        ("check inverse.dxf --deny warning", 1, 1),
    ] {
        desk.write("e.3b", "");
        // An arc that the wire cannot follow, where that is a warning.
        desk.write("inverse.dxf", desk.read("tight.dxf"));
        desk.write(
            "wedm.toml",
            match arguments.contains("inverse") {
                true => "[rules]\nsmall-radius = \"warning\"\n",
                false => "",
            },
        );
        let ended = desk.run(&format!("{arguments} --output junit"));
        assert_eq!(ended.code, Some(code), "{arguments}: {ended:?}");
        let failed = ended.stdout.matches("<failure").count();
        assert_eq!(failed, failures, "{arguments}: {ended:?}");
        let counted = format!("failures=\"{failures}\" errors=\"0\"");
        assert!(ended.stdout.contains(&counted), "{arguments}: {ended:?}");
        assert!(ended.stdout.contains("<testcase"), "{arguments}: {ended:?}");
    }
}

/// One mistake ends `fit` and `pair` alike, and their help promises nothing that is not so.
#[test]
fn fit_and_pair_ask_for_what_they_need_alike() {
    let desk = Desk::new();
    for command in ["fit", "pair"] {
        let run = format!("{command} clean.dxf");
        check(
            &desk,
            &run,
            2,
            &["!set pair.drawn-as, pair.clearance, wire-diameter and gap"],
        );
        check(
            &desk,
            &format!("{run} --drawn-as punch"),
            2,
            &["!pair.clearance"],
        );
        let help = desk.run(&format!("{command} --help")).stdout;
        assert!(help.contains("Spark gap, mm"), "{help}");
        for key in ["--gap", "--wire-diameter"] {
            let of_key = help.split(&format!("{key} <MM>")).nth(1).unwrap();
            let of_key = of_key.split("--").next().unwrap();
            assert!(!of_key.contains("[default"), "{key}: {help}");
        }
    }
}

#[test]
fn an_answer_for_autolisp_stands_alone_or_beside_a_file() {
    let desk = Desk::new();
    let generate = "generate clean.dxf --side opening --output lisp";
    check(&desk, generate, 0, &["(text . \"B", "\\nDD\\n\")"]);
    let beside = format!("{generate} -o beside.3b");
    let says = [
        "(path . \"beside.3b\") (text . nil)",
        "(wire (pass . 1) (vertices (10 ",
    ];
    check(&desk, &beside, 0, &says);
    check(
        &desk,
        "generate clean.dxf --side opening -o alone.3b",
        0,
        &[],
    );
    assert_eq!(desk.read("beside.3b"), desk.read("alone.3b"));
    let refused = "generate clean.dxf --output lisp";
    check(&desk, refused, 1, &["(side-is-missing . T)", "!--side"]);
    let fix = "fix tight.dxf --output lisp";
    check(
        &desk,
        fix,
        0,
        &["\n(entmod \"2A\" (0 . \"LWPOLYLINE\")", "!1 arc repaired"],
    );
    assert!(!desk.path("lisp").exists());
    check(&desk, &format!("{fix} -o fixed.dxf"), 0, &["(entmod "]);
    check(
        &desk,
        "check fixed.dxf --output lisp",
        0,
        &["(\n(wedm (version . \"", "\n)\n"],
    );
    check(&desk, "fix tight.dxf -o ./lisp", 0, &[]);
    assert_eq!(desk.read("lisp"), desk.read("fixed.dxf"));
    check(
        &desk,
        "check none.dxf --output lisp",
        2,
        &["(failure (message . \"none.dxf: "],
    );
    check(
        &desk,
        "fix none.dxf --output lisp",
        2,
        &["(failure (message . \"none.dxf: "],
    );
    check(
        &desk,
        "generate none.dxf --output lisp",
        2,
        &["(failure (message . \"none.dxf: "],
    );
    let two = "generate clean.dxf --side opening -o one.3b -o other.3b";
    check(
        &desk,
        two,
        2,
        &["!-o names one.3b and other.3b, expected one file"],
    );
}
