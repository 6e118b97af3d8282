//! The command line as a user meets it: the real binary, small files, what it prints and how it ends.

#[path = "cli/contradictions.rs"]
mod contradictions;
#[path = "cli/electrode.rs"]
mod electrode;
#[path = "cli/holes.rs"]
mod holes;
#[path = "cli/pages.rs"]
mod pages;
#[path = "cli/untrusted.rs"]
mod untrusted;

use serde_json::Value;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A folder of its own with all files of `tests/data`.
struct Desk(tempfile::TempDir);

impl Desk {
    fn new() -> Desk {
        let folder = tempfile::tempdir().unwrap();
        for entry in
            std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data")).unwrap()
        {
            let entry = entry.unwrap();
            if entry.file_type().unwrap().is_file() {
                std::fs::copy(entry.path(), folder.path().join(entry.file_name())).unwrap();
            }
        }
        Desk(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::create_dir_all(self.path(name).parent().unwrap()).unwrap();
        std::fs::write(self.path(name), content).unwrap();
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap()
    }

    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_wedm"));
        command
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .env("LC_ALL", "C")
            .stdin(Stdio::null());
        command
    }

    fn run(&self, arguments: &str) -> Ended {
        Ended::of(self.command(arguments).output().unwrap())
    }
}

#[derive(Debug)]
struct Ended {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Ended {
    fn of(output: Output) -> Ended {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Ended {
            code: output.status.code(),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        }
    }

    fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }
}

/// Runs `arguments` and looks for texts, those that begin with `!` in stderr, the others in stdout.
#[track_caller]
fn check(desk: &Desk, arguments: &str, code: i32, texts: &[&str]) {
    let ended = desk.run(arguments);
    assert_eq!(ended.code, Some(code), "wedm {arguments}: {ended:?}");
    for text in texts {
        let (stream, text) = match text.strip_prefix('!') {
            Some(text) => (&ended.stderr, text),
            None => (&ended.stdout, *text),
        };
        assert!(
            stream.contains(text),
            "wedm {arguments}: no {text:?} in {ended:?}"
        );
    }
    assert!(
        !ended.stdout.contains('\x1b') && !ended.stderr.contains('\x1b'),
        "colours without a terminal: {ended:?}"
    );
}

#[test]
fn commands_print_and_end_as_they_say() {
    let desk = Desk::new();
    let cases: &[(&str, i32, &[&str])] = &[
        ("check clean.dxf", 0, &["1 file checked: nothing found"]),
        ("check hole.3b", 0, &["1 file checked: nothing found"]),
        (
            "--lang en check hole.3b",
            0,
            &["1 file checked: nothing found"],
        ),
        (
            "--lang=en check hole.3b",
            0,
            &["1 file checked: nothing found"],
        ),
        (
            "check hole.3b --lang en",
            0,
            &["1 file checked: nothing found"],
        ),
        ("check hole.3b --lang tlh", 2, &["!possible values: en"]),
        (
            "check tight.dxf",
            1,
            &[
                "error[small-radius]: arc R 0.080 mm is below the correction 0.100 mm",
                "--> tight.dxf:34:1",
                "33 |  42",
                "34 | 0.414213562373",
                "^^^^^^^^^^^^^^ 2A, segment 1, at 19.920, 0.000",
                "1 file checked: 1 error",
                "wedm fix tight.dxf --in-place",
            ],
        ),
        ("check tight.dxf --correction 0.07", 0, &["nothing found"]),
        (
            "check tight.dxf --output concise",
            1,
            &[
                "tight.dxf:34:1: error[small-radius]: arc R 0.080 mm is below",
                "(2A, segment 1, at 19.920, 0.000)\n1 file checked: 1 error",
            ],
        ),
        (
            "check tight.dxf --output grouped",
            1,
            &["tight.dxf\n  34:1: error[small-radius]: arc R 0.080 mm"],
        ),
        (
            "check tight.dxf --output github",
            1,
            &[
                "::error file=tight.dxf,line=34,endLine=34,col=1,endColumn=15,title=small-radius::arc R 0.080 mm",
            ],
        ),
        (
            "check tight.dxf missing.dxf --output junit",
            2,
            &[
                "<testsuites name=\"wedm\" tests=\"1\" failures=\"1\" errors=\"1\">",
                "<testcase classname=\"tight.dxf\" name=\"small-radius\" line=\"34\" column=\"1\"><failure type=\"error\"",
                "<error message=\"missing.dxf: ",
            ],
        ),
        (
            "check tight.dxf --statistics",
            1,
            &["      1  small-radius         error        An arc is tighter than the correction"],
        ),
        (
            "check tight.dxf --ignore small-radius",
            0,
            &["nothing found"],
        ),
        (
            "check tight.dxf --select gap,overlap",
            0,
            &["nothing found"],
        ),
        ("check garbage.dxf --select gap", 1, &["error[syntax]"]),
        (
            "check --select smal-radius",
            2,
            &["!similar value exists: 'small-radius'"],
        ),
        (
            "explain small-radius",
            0,
            &["small-radius\n", "Why it matters for the cut\n"],
        ),
        ("explain", 0, &["gap                  warning     Two ends"]),
        (
            "explain smallradius",
            2,
            &["!similar value exists: 'small-radius'"],
        ),
        ("config schema", 0, &["\"wire-diameter\"", "\"minimum\": 4"]),
        ("check - --watch", 2, &["!stdin cannot be watched"]),
        (
            "check clean.dxf --correction 0.6",
            1,
            &["arc R 0.500 mm is below the correction 0.600 mm"],
        ),
        ("check tight.dxf --side punch", 0, &["nothing found"]),
        (
            "check chain.dxf",
            1,
            &["--> chain.dxf:40:1", "^^^^ 32, segment 0"],
        ),
        ("check inch.dxf", 1, &["arc R 0.080 mm"]),
        (
            "check narrow.dxf",
            1,
            &["narrow-slot", "2 errors, 1 warning"],
        ),
        ("check no_unit.dxf", 0, &["information[units]", "2 notes"]),
        ("check no_unit.dxf --deny warning", 0, &["2 notes"]),
        ("check clean.dxf --deny warning", 0, &[]),
        ("check garbage.dxf", 1, &["1 error\n"]),
        (
            "check missing.dxf",
            2,
            &["!error: missing.dxf: no such file"],
        ),
        (
            "check tight.dxf missing.dxf clean.dxf",
            2,
            &["2 files checked: 1 error", "!missing.dxf"],
        ),
        ("check", 1, &["code_page.dxf:50:1"]),
        ("check clean.dxf --correction -1", 2, &["!above 0"]),
        ("check clean.dxf --correction NaN", 2, &["!above 0"]),
        (
            "check clean.dxf --side inside",
            2,
            &["!both, auto, opening, punch, left, right"],
        ),
        (
            "check clean.dxf --config missing.toml",
            2,
            &["!missing.toml: no such file"],
        ),
        ("fix tight.dxf", 2, &["!--output", "!--in-place", "!--diff"]),
        (
            "fix tight.dxf --in-place --diff",
            2,
            &["!cannot be used with"],
        ),
        ("fix tight.dxf -o tight.dxf", 2, &["!is the input"]),
        ("fix tight.dxf -o ./tight.dxf", 2, &["!is the input"]),
        ("fix hole.3b --diff", 0, &["!nothing to repair"]),
        (
            "fix tight.dxf --diff",
            0,
            &[
                "--- tight.dxf",
                "@@ -",
                "-19.92",
                "+19.899",
                "!1 arc repaired",
            ],
        ),
        ("fix clean.dxf --diff", 0, &["!nothing to repair"]),
        (
            "fix narrow.dxf --diff",
            1,
            &[
                "!nothing could be repaired",
                "!left: narrow.dxf:34:1",
                "!narrow-slot",
            ],
        ),
        (
            "generate tight.dxf --side opening",
            1,
            &[
                "!error[small-radius]",
                "!no program is written, the drawing has 1 error",
            ],
        ),
        (
            "generate clean.dxf",
            1,
            &["!side of contour 2A is not known"],
        ),
        (
            "generate clean.dxf --side opening",
            0,
            &["DD\n", "!written stdout", "!decoded again: at most"],
        ),
        (
            "generate clean.dxf --side opening --format 4b",
            0,
            &["GYDDNR4\n", "DD\n", "!decoded again"],
        ),
        (
            "generate clean.dxf --side opening --format iso",
            0,
            &["G92 X12.250 Y3.000\n", "M02\n", "!decoded again"],
        ),
        (
            "generate clean.dxf --side punch --thread -3,-2 --layout checking",
            0,
            &["Start Point = -3", "DD"],
        ),
        (
            "generate clean.dxf --side punch --thread=-3,-2 --entry -0.0,5",
            0,
            &["DD"],
        ),
        (
            "generate clean.dxf --side punch --thread 3",
            2,
            &["!such as -115,-10"],
        ),
        (
            "generate clean.dxf --side punch --corner intersection",
            0,
            &["DD"],
        ),
        (
            "generate clean.dxf --side punch --end M.2",
            2,
            &["!program.end is \"M.2\", expected a word of letters and digits"],
        ),
        ("generate clean.dxf --side punch --handle 99", 1, &["!99"]),
        (
            "generate clean.dxf --side opening -o clean.dxf",
            2,
            &["!is the input"],
        ),
        (
            "inspect tight.dxf",
            1,
            &[
                "closed, counter-clockwise",
                "layer DIE: 2A",
                "0.080",
                "small-radius",
                "1 not ok",
            ],
        ),
        ("inspect clean.dxf", 0, &["all of them can be cut"]),
        ("inspect missing.dxf", 2, &["!missing.dxf"]),
        (
            "contours chain.dxf",
            0,
            &[
                "contour 0: closed, counter-clockwise, both sides, 6 segments",
                "1 contour\n",
            ],
        ),
        (
            "draw tight.dxf",
            0,
            &["<svg", "R 0.080 mm, the correction is 0.100 mm", "</svg>"],
        ),
        (
            "draw tight.dxf -o tight.bmp",
            2,
            &["!.bmp is not written, expected .svg, .png, .pdf or .dxf"],
        ),
        ("completions bash", 0, &["_wedm"]),
        ("completions zsh", 0, &["#compdef wedm"]),
        (
            "convert hole.3b -o hole.dxf",
            0,
            &["!written hole.dxf: 1 contour"],
        ),
        (
            "simulate hole.3b --feed 2",
            0,
            &[
                "R 9.900 mm, +360.000\u{b0}",
                "3 blocks, cut 82.0 mm, 41.0 min, ends 0, 0 \u{b5}m from its start",
                "19.800 x 19.800 mm",
            ],
        ),
        (
            "simulate hole.3b --output json",
            0,
            &["\"closure\":{\"x\":0.0,\"y\":0.0}", "\"kind\":\"arc\""],
        ),
        (
            "simulate clean.dxf",
            2,
            &["!it is a drawing, expected a program"],
        ),
        ("simulate hole.3b --feed 0", 2, &["!above 0"]),
        ("draw hole.3b", 0, &["<svg", "data-line=\"1\"", "</svg>"]),
        ("--version", 0, &["wedm "]),
        ("--help", 0, &["check", "generate", "Exit codes"]),
    ];
    for (arguments, code, texts) in cases {
        check(&desk, arguments, *code, texts);
    }
}

#[test]
fn what_gitignore_and_its_like_name_is_passed_over() {
    let desk = Desk::new();
    let tight = desk.read("tight.dxf");
    for name in [
        "tight",
        "old/tight",
        "tmp/tight",
        ".cache/tight",
        "kept/tight",
    ] {
        desk.write(&format!("work/{name}.dxf"), &tight);
    }
    desk.write("work/.gitignore", "tmp/\n");
    desk.write("work/.wedmignore", "old\n");
    check(&desk, "check work", 1, &["2 files checked: 2 errors"]);
    check(&desk, "check work --exclude kept", 1, &["1 file checked"]);
    check(&desk, "check work --no-ignore", 1, &["5 files checked"]);
    // What is named itself is checked.
    check(&desk, "check work/old/tight.dxf", 1, &["1 file checked"]);
    let here = desk
        .command("check --output concise")
        .current_dir(desk.path("work"))
        .output();
    let here = Ended::of(here.unwrap());
    assert!(here.stdout.starts_with("kept/tight.dxf:34:1: "), "{here:?}");
}

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
        ("open.iso", vec!["(at 5.000, -1.300)", "(at 15.000, 8.000)"]),
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
fn stdin_is_checked_under_the_name_that_it_is_given() {
    let desk = Desk::new();
    desk.write("fine/wedm.toml", "correction = 0.07\n");
    let said = |arguments: &str, file: &str| {
        let mut command = desk.command(arguments);
        command.stdin(std::fs::File::open(desk.path(file)).unwrap());
        Ended::of(command.output().unwrap())
    };
    let of_drawing = said("check - --output concise", "tight.dxf");
    assert!(
        of_drawing
            .stdout
            .starts_with("stdin:34:1: error[small-radius]"),
        "{of_drawing:?}"
    );
    assert!(!of_drawing.stdout.contains("wedm fix"), "{of_drawing:?}");
    assert_eq!(
        said("check - --stdin-name fine/new.dxf", "tight.dxf").code,
        Some(0)
    );
    for arguments in ["check - --stdin-name hole.3b", "check -"] {
        let of_program = said(arguments, "hole.3b");
        assert_eq!(of_program.code, Some(0), "{of_program:?}");
    }
    assert_eq!(
        said("check - --stdin-name plate.dwg", "tight.dxf").code,
        Some(2)
    );
}

#[test]
fn what_is_watched_is_checked_again_when_it_changes() {
    let desk = Desk::new();
    desk.write("work/plate.dxf", desk.read("clean.dxf"));
    let mut watching = desk
        .command("check --watch work --output concise")
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let (sender, lines) = std::sync::mpsc::channel();
    let stdout = std::io::BufReader::new(watching.stdout.take().unwrap());
    std::thread::spawn(move || {
        for line in std::io::BufRead::lines(stdout).map_while(Result::ok) {
            let _ = sender.send(line);
        }
    });
    let expect = |text: &str| {
        let line = lines.recv_timeout(std::time::Duration::from_secs(20));
        assert!(
            line.as_ref().is_ok_and(|line| line.contains(text)),
            "{line:?}"
        );
    };
    expect("nothing found");
    desk.write("work/plate.dxf", desk.read("tight.dxf"));
    expect("error[small-radius]");
    expect("1 error");
    expect("wedm fix");
    desk.write("work/wedm.toml", "correction = 0.07\n");
    expect("nothing found");
    watching.kill().unwrap();
    watching.wait().unwrap();
}

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
    check(&desk, begin, 0, &["!work/wedm.toml written"]);
    let text = String::from_utf8(desk.read("work/wedm.toml")).unwrap();
    for line in [
        "wire-diameter = 0.25",
        "corrections = [0.2150, 0.1700, 0.1400]",
        "gaps = [0.0300, 0.0150, 0.0150]",
        "profile = \"robofil\"",
        "# margin = 0.001",
    ] {
        assert!(text.contains(&format!("\n{line}\n")), "{line}: {text}");
    }
    assert!(!text.contains("#:schema"), "{text}");
    check(&desk, begin, 2, &["!it is there already"]);
    desk.write(
        "work/wedm.schema.json",
        desk.run("config schema").stdout.as_bytes(),
    );
    check(&desk, &format!("{begin} --force"), 0, &[]);
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
fn manual_pages_are_written_for_every_command() {
    let desk = Desk::new();
    check(&desk, "man pages", 0, &[]);
    for page in ["wedm", "wedm-check", "wedm-generate", "wedm-man"] {
        let text = String::from_utf8(desk.read(&format!("pages/{page}.1"))).unwrap();
        assert!(text.contains(".TH ") && text.contains(".SH NAME"), "{text}");
    }
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

#[test]
fn programs_are_formatted_where_they_are_told_to_be() {
    let desk = Desk::new();
    let untidy =
        "b9900b0b9900gxl1 ; in\r\nB9900B0B39600GYNR1\r\nB99B9900GXL3\r\n9900B0B9900GXL3\r\ndd\r\n";
    desk.write("shop/untidy.3b", untidy);
    desk.write("shop/tidy.3b", "B9900B0B9900GXL1\nDD\n");
    desk.write("shop/plate.dxf", "0\nEOF\n");
    let cases: &[(&str, i32, &[&str])] = &[
        (
            "format hole.3b",
            0,
            &["B9900B0B9900GXL1\nB9900B0B39600GYNR1\n"],
        ),
        (
            "format hole.3b --layout checking",
            0,
            &["N    1: B   9900 B      0 B   9900 GX L1  ;      9.900 ,      0.000\n"],
        ),
        (
            "format --check hole.3b",
            0,
            &["!0 programs would be formatted, 1 unchanged"],
        ),
        (
            "format --check shop",
            1,
            &[
                "would be formatted: shop/untidy.3b\n",
                "!1 program would be formatted, 1 unchanged",
                "!2 lines with a syntax error",
            ],
        ),
        (
            "format --diff shop",
            1,
            &[
                "-b9900b0b9900gxl1 ; in",
                "+B9900B0B9900GXL1 ; in",
                " 9900B0B9900GXL3",
            ],
        ),
        ("format shop", 2, &["!2 programs found, expected one"]),
        (
            "format clean.dxf",
            2,
            &["!clean.dxf: it is a drawing, expected a program"],
        ),
        (
            "format missing.3b --check",
            2,
            &["!missing.3b: no such file"],
        ),
        ("format hole.3b -o hole.3b", 2, &["!is the input"]),
        (
            "format hole.3b --check --diff",
            2,
            &["!cannot be used with"],
        ),
        (
            "format hole.3b --layout wide",
            2,
            &["!compact, aligned, checking"],
        ),
        ("format", 2, &["!PATH"]),
    ];
    for (arguments, code, texts) in cases {
        check(&desk, arguments, *code, texts);
    }
    assert_eq!(desk.read("shop/untidy.3b"), untidy.as_bytes());
    desk.write("shop/wedm.toml", "[program]\nlayout = \"compact\"\n");
    check(
        &desk,
        "format --in-place shop",
        0,
        &["!1 program formatted, 1 unchanged"],
    );
    let tidy =
        "B9900B0B9900GXL1 ; in\r\nB9900B0B39600GYNR1\r\nB99B9900GXL3\r\n9900B0B9900GXL3\r\nDD\r\n";
    assert_eq!(
        String::from_utf8(desk.read("shop/untidy.3b")).unwrap(),
        tidy
    );
    check(
        &desk,
        "format --in-place shop --layout checking --pause D",
        0,
        &["!2 programs formatted"],
    );
    // ISO: words in upper case, apart or closed up; no number is written otherwise, and lines that cannot be read stay.
    let untidy = "%\r\nn10 g01 x1.50y-0 (in)\r\nG02  X3.  Y4. i1.\r\ng01 x1,5\r\nm02\r\n";
    desk.write("iso/untidy.nc", untidy);
    let parted = "%\r\nN10 G01 X1.50 Y-0 (in)\r\nG02 X3. Y4. I1.\r\ng01 x1,5\r\nM02\r\n";
    check(&desk, "format iso/untidy.nc", 0, &[parted]);
    check(
        &desk,
        "format iso/untidy.nc --layout compact",
        0,
        &["N10G01X1.50Y-0 (in)\r\nG02X3.Y4.I1.\r\ng01 x1,5\r\nM02\r\n"],
    );
    check(
        &desk,
        "format --check iso",
        1,
        &["would be formatted: iso/untidy.nc\n"],
    );
    check(&desk, "format --in-place iso", 0, &["!1 program formatted"]);
    assert_eq!(
        String::from_utf8(desk.read("iso/untidy.nc")).unwrap(),
        parted
    );
    check(
        &desk,
        "format --check iso",
        0,
        &["!0 programs would be formatted, 1 unchanged"],
    );
}

/// A program of a square, as an editor of Chinese Windows writes it: its third block stops too early, and its spaces are no layout's.
fn program_in_gb_18030(comment: &[u8]) -> Vec<u8> {
    let line = |block: &str, comment: &[u8]| [block.as_bytes(), b" ; ", comment, b"\r\n"].concat();
    [
        line("B9000B0B9000GXL1", comment),
        line("B0 B9000 B9000 GYL2", b"\x81\x40\x81\x7c"),
        line("B9000B0B900GXL3", b"\x95\x32\x82\x36"),
        line("B0B9000B9000GYL4", comment),
        b"DD\r\n".to_vec(),
    ]
    .concat()
}

#[test]
fn a_program_in_gb_18030_is_written_as_it_was() {
    let punch: &[u8] = b"\xcd\xb9\xc4\xa3 \xb5\xda 1 \xb6\xce";
    let desk = Desk::new();
    let program = program_in_gb_18030(punch);
    desk.write("gb.3b", &program);
    let comments = |bytes: &[u8]| -> Vec<Vec<u8>> {
        let lines = bytes.split(|byte| *byte == b'\n');
        let behind = lines.filter_map(|line| {
            let at = line.iter().position(|byte| *byte == b';')?;
            Some(line[at..].to_vec())
        });
        behind.collect()
    };
    let note = "!note: what is not UTF-8 is read as GB 18030, and written so";
    check(
        &desk,
        "check gb.3b",
        1,
        &["B9000B0B900GXL3 ; \u{20000}", note],
    );
    let checked = desk.run("check gb.3b . --output concise");
    assert_eq!(checked.stderr.matches("GB 18030").count(), 1, "{checked:?}");

    check(&desk, "fix gb.3b --in-place", 0, &[note]);
    let repaired = desk.read("gb.3b");
    let expected = String::from_utf8_lossy(&program).replace("B900G", "B9000G");
    assert_eq!(String::from_utf8_lossy(&repaired), expected);
    assert_eq!(comments(&repaired), comments(&program));

    check(&desk, "format gb.3b --in-place", 0, &[]);
    let formatted = desk.read("gb.3b");
    assert_ne!(formatted, repaired);
    assert_eq!(comments(&formatted), comments(&program));
    desk.write("gb.3b", &program);
    let diff = desk.command("fix gb.3b --diff").output().unwrap();
    assert!(diff.stdout.windows(punch.len()).any(|part| part == punch));

    // One byte that is none of GB 18030: nothing is known of the file, and nothing of it is lost.
    desk.write("odd.3b", program_in_gb_18030(b"\xcd\xb9\xff"));
    let odd = desk.read("odd.3b");
    let ended = desk.run("fix odd.3b --in-place");
    assert!(!ended.stderr.contains("GB 18030"), "{ended:?}");
    assert_eq!(comments(&desk.read("odd.3b")), comments(&odd));

    // The same text in UTF-8 comes out the same, and a byte-order mark stays.
    let text = "\u{feff}B9000B0B9000GXL1 ; 凸模\r\nDD\r\n";
    desk.write("plain.3b", text);
    check(&desk, "format plain.3b --in-place", 0, &[]);
    let plain = String::from_utf8(desk.read("plain.3b")).unwrap();
    assert!(
        plain.starts_with('\u{feff}') && plain.contains("; 凸模"),
        "{plain:?}"
    );
}

#[test]
fn formats_that_are_not_read_are_named_and_not_skipped() {
    let desk = Desk::new();
    for (name, reason) in [("a.dwg", "DWG"), ("a.txt", ".txt"), ("a", "no ending")] {
        desk.write(&format!("strange/{name}"), "x");
        check(
            &desk,
            &format!("check strange/{name}"),
            2,
            &[&format!("!{name}: "), &format!("!{reason}")],
        );
    }
    // In a folder the strange ones are left.
    check(
        &desk,
        "check strange",
        0,
        &[
            "0 files checked",
            "!warning: nothing is found whose name ends with one of .dxf, ",
        ],
    );
    assert!(!desk.run("check strange").stderr.contains("a.txt"));
}

/// Programs come under names that say nothing: what stands in them does, or the command line.
#[test]
fn a_file_is_known_by_what_stands_in_it_where_its_name_does_not_say_it() {
    let desk = Desk::new();
    let iso = "%\nN1 G92 X0 Y0\nN2 G01 X5.\nN3 G01 Y5.\nN4 G01 X0.\nN5 G01 Y0.\nM02\n%\n";
    let (three_b, drawing) = (desk.read("hole.3b"), desk.read("tight.dxf"));
    for (name, content) in [
        ("job.txt", iso.as_bytes()),
        ("job.CNC", iso.as_bytes()),
        ("job.eia", iso.as_bytes()),
        ("hole.cmd", &three_b),
        ("hole.txt", &three_b),
        ("hole", &three_b),
    ] {
        desk.write(name, content);
        check(&desk, &format!("check {name}"), 0, &["1 file checked"]);
        check(&desk, &format!("simulate {name}"), 0, &[]);
    }
    desk.write("plate.txt", &drawing);
    check(&desk, "check plate.txt", 1, &["plate.txt:34:1"]);
    check(&desk, "fix plate.txt -o fixed.txt", 0, &[]);
    check(&desk, "check fixed.txt", 0, &["nothing found"]);
    // One line says too little of itself.
    desk.write("line.txt", "N1\n");
    check(&desk, "check line.txt", 2, &["!--language"]);
    check(
        &desk,
        "check line.txt --language iso",
        0,
        &["1 file checked"],
    );
    check(&desk, "check hole.3b --language dxf", 1, &["syntax"]);
    check(
        &desk,
        "check hole.3b --language tape",
        2,
        &["!dxf, 3b, iso"],
    );
    let mut command = desk.command("check - --stdin-name job.txt");
    command.stdin(std::fs::File::open(desk.path("hole.txt")).unwrap());
    assert_eq!(Ended::of(command.output().unwrap()).code, Some(0));
}

/// What the words of a command are refused with, too; not a word of clap's own is left.
#[test]
fn what_is_refused_is_said_in_chinese_where_that_is_spoken() {
    let desk = Desk::new();
    for (arguments, texts) in [
        (
            "check --corection 1",
            [
                "没有 '--corection' 这个选项",
                "是否想写：--correction",
                "用法：wedm check",
            ],
        ),
        (
            "chek",
            ["没有 'chek' 这个命令", "是否想写：check", "用法：wedm"],
        ),
        (
            "check --output foo",
            [
                "'--output <OUTPUT>' 的值 'foo' 无效",
                "可选：text, concise",
                "详见 '--help'。",
            ],
        ),
        (
            "check --select smal-radius",
            [
                "的值 'smal-radius' 无效",
                "是否想写：small-radius",
                "错误：",
            ],
        ),
        (
            "check --correction",
            [
                "'--correction <MM>' 需要一个值",
                "详见 '--help'。",
                "错误：",
            ],
        ),
        (
            "check --correction=x",
            [
                "'--correction <MM>' 的值 'x' 无效：",
                "详见 '--help'。",
                "错误：",
            ],
        ),
        (
            "draw",
            ["缺少必需的参数：", "用法：wedm draw", "详见 '--help'。"],
        ),
        (
            "fix tight.dxf --in-place --diff",
            ["不能与", "同时使用", "用法：wedm fix"],
        ),
        (
            "draw tight.dxf two.dxf",
            ["'two.dxf'", "用法：wedm draw", "详见 '--help'。"],
        ),
    ] {
        let ended = desk.run(&format!("--lang zh {arguments}"));
        assert_eq!(ended.code, Some(2), "{arguments}: {ended:?}");
        for text in texts {
            assert!(
                ended.stderr.contains(text),
                "{arguments}: no {text} in {}",
                ended.stderr
            );
        }
        for english in [
            "error:", "Usage:", "tip:", "For more", "similar", "possible", "{",
        ] {
            assert!(
                !ended.stderr.contains(english),
                "{arguments}: {english} in {}",
                ended.stderr
            );
        }
        check(&desk, arguments, 2, &["!error:"]);
    }
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
        assert_eq!(
            ended.stdout, "1 file checked: nothing found\n",
            "{arguments}"
        );
    }
}

/// A small part in the program of each profile: its numbers are millimetres, as they are written.
#[test]
fn programs_of_small_parts_are_not_taken_for_inches() {
    let desk = Desk::new();
    let fillet = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pictures/fillet.dxf");
    desk.write("small.dxf", std::fs::read(fillet).unwrap());
    assert_eq!(
        desk.run("fix small.dxf --in-place --side opening").code,
        Some(0)
    );
    for profile in ["robofil", "fast-wire", "generic"] {
        for compensation in ["path", "controller"] {
            let name = format!("{profile}-{compensation}.iso");
            let generate = format!(
                "generate small.dxf --side opening --format iso --profile {profile} --compensation {compensation} -o {name}"
            );
            assert_eq!(desk.run(&generate).code, Some(0), "{generate}");
            let checked = desk.run(&format!("check {name} --output concise"));
            assert!(!checked.stdout.contains("[units]"), "{}", checked.stdout);
        }
    }
}

/// The help speaks the language that is asked for; what is typed stays.
#[test]
fn the_help_is_in_chinese_where_that_is_spoken() {
    let desk = Desk::new();
    for (arguments, texts) in [
        (
            "--lang zh --help",
            ["用法：wedm", "检查图形和程序有什么问题", "退出码"],
        ),
        (
            "check --help --lang zh",
            ["--statistics", "不列出问题", "设置"],
        ),
        (
            "generate --help --lang zh",
            ["写出图形的程序", "[默认：3.0]", "--layout"],
        ),
        (
            "generate -h --lang=zh",
            ["封闭轮廓的切割方向", "示例：", "wedm generate plate.dxf"],
        ),
    ] {
        check(&desk, arguments, 0, &texts);
    }
    let mut command = desk.command("inspect --help");
    command.env("LC_ALL", "zh_CN.UTF-8");
    assert!(
        Ended::of(command.output().unwrap())
            .stdout
            .contains("列出每一段的半径和判定")
    );
    check(
        &desk,
        "check --help",
        0,
        &["Usage: wedm check", "Settings:"],
    );
    let chinese = desk.run("check --help --lang zh").stdout;
    assert!(
        chinese.contains("- concise: 每个问题一行") && chinese.contains("没有时看内容"),
        "{chinese}"
    );
    assert!(
        !chinese.contains("[default") && !chinese.contains("ossible values"),
        "{chinese}"
    );
    check(
        &desk,
        "init zh --wire 0.2 --gap 0.01 --passes 1 --machine 3b --lang zh",
        2,
        &[],
    );
    desk.write("zh/plate.dxf", "");
    check(
        &desk,
        "init zh --wire 0.2 --gap 0.01 --passes 1 --machine 3b --lang zh",
        0,
        &[],
    );
    let written = String::from_utf8(desk.read("zh/wedm.toml")).unwrap();
    assert!(
        written.contains("# 电极丝直径，mm\nwire-diameter = 0.2"),
        "{written}"
    );
}

/// Where the wire is threaded is told whatever the layout, and in the program where the settings want it there.
#[test]
fn the_thread_hole_is_always_told() {
    let desk = Desk::new();
    let generate = "generate clean.dxf --side punch --thread -3,-2";
    let hole = "the wire is threaded at -3.000, -2.000 mm";
    for (header, layout, stands) in [
        ("", "compact", false),
        ("", "aligned", true),
        ("", "checking", true),
        ("header = true", "compact", true),
        ("header = false", "aligned", false),
    ] {
        desk.write("wedm.toml", format!("[program]\n{header}\n"));
        let ended = desk.run(&format!("{generate} --layout {layout}"));
        assert!(ended.stderr.contains(hole), "{ended:?}");
        let comment = ended
            .stdout
            .starts_with("; Start Point = -3.000 , -2.000\n");
        assert_eq!(comment, stands, "{header} {layout}: {ended:?}");
        desk.write("made.3b", &ended.stdout);
        check(&desk, "check made.3b", 0, &["nothing found"]);
    }
    check(
        &desk,
        &format!("{generate} --format iso"),
        0,
        &[&format!("!{hole}")],
    );
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
    let mut run = 0;
    for hint in &hints {
        for command in hint.split("wedm ").skip(1) {
            let end = command.find([')', '\n', ';', ',']).unwrap_or(command.len());
            let line = format!("wedm {}", command[..end].trim()).replace("OUT.dxf", "out.dxf");
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

#[test]
fn a_folder_is_searched_in_all_its_depth_and_every_file_stands_once() {
    let desk = Desk::new();
    desk.write("parts/a.DXF", desk.read("tight.dxf"));
    desk.write("parts/deep/er/b.dxf", desk.read("clean.dxf"));
    desk.write("parts/notes.txt", "nothing");
    check(
        &desk,
        "check parts parts/a.DXF",
        1,
        &["2 files checked: 1 error"],
    );
    for ending in ["dxf", "dxb", "3b", "4b", "iso", "nc"] {
        desk.write(&format!("all/a.{ending}"), "");
    }
    check(&desk, "check all", 1, &["6 files checked"]);
    desk.write("empty/notes.txt", "nothing");
    check(&desk, "check empty", 0, &["0 files checked\n"]);
}

#[cfg(unix)]
#[test]
fn a_link_to_a_file_is_checked_and_a_circle_of_folders_ends() {
    let desk = Desk::new();
    desk.write("parts/notes.txt", "nothing");
    std::os::unix::fs::symlink("../tight.dxf", desk.path("parts/link.dxf")).unwrap();
    std::os::unix::fs::symlink("..", desk.path("parts/up")).unwrap();
    check(
        &desk,
        "check parts",
        1,
        &["--> parts/link.dxf", "1 file checked: 1 error"],
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

#[test]
fn a_fix_changes_its_numbers_and_no_other_byte() {
    let desk = Desk::new();
    for (name, lines) in [
        ("tight.dxf", 2),
        ("chain.dxf", 5),
        ("code_page.dxf", 2),
        ("inch.dxf", 2),
    ] {
        let before = desk.read(name);
        let ended = desk.run(&format!("fix {name} -o fixed.dxf"));
        assert_eq!(ended.code, Some(0), "{ended:?}");
        assert_eq!(desk.read(name), before, "{name} has been changed");
        let after = desk.read("fixed.dxf");
        let (old, new): (Vec<_>, Vec<_>) = (
            before.split(|&byte| byte == b'\n').collect(),
            after.split(|&byte| byte == b'\n').collect(),
        );
        assert_eq!(old.len(), new.len(), "{name}");
        let changed: Vec<_> = old.iter().zip(&new).filter(|(a, b)| a != b).collect();
        assert_eq!(changed.len(), lines, "{name}: {changed:?}");
        assert!(
            changed
                .iter()
                .all(|(a, b)| a.ends_with(b"\r") == b.ends_with(b"\r")),
            "{name}"
        );
        check(&desk, "check fixed.dxf", 0, &["nothing found"]);
    }
}

/// What stands twice goes, and is counted beside the arcs.
#[test]
fn repairs_of_every_rule_are_said() {
    let desk = Desk::new();
    let text = String::from_utf8(desk.read("tight.dxf")).unwrap();
    let circles: String = ["2B", "2C"]
        .iter()
        .map(|handle| format!("  0\nCIRCLE\n  5\n{handle}\n  8\nDIE\n 10\n50\n 20\n0\n 40\n3\n"))
        .collect();
    let end = text.rfind("  0\nENDSEC").unwrap();
    desk.write(
        "doubled.dxf",
        format!("{}{circles}{}", &text[..end], &text[end..]),
    );
    check(
        &desk,
        "fix doubled.dxf -o fixed.dxf",
        0,
        &["!doubled.dxf: 1 arc, 1 double repaired in 2 rounds"],
    );
    check(&desk, "check fixed.dxf", 0, &["nothing found"]);
}

/// A repair that the text cannot take does not stand in the way of the others.
#[test]
fn what_cannot_be_repaired_is_said_and_the_rest_is_repaired() {
    let desk = Desk::new();
    let text = String::from_utf8(desk.read("tight.dxf")).unwrap();
    // A line is missing just before the second of two circles: how the text goes on there is told from the circle's lines.
    let circle =
        |handle: &str| format!("  0\nCIRCLE\n  5\n{handle}\n  8\nDIE\n 10\n50\n 20\n0\n 40\n3\n");
    let damaged = "  0\nLINE\n  5\n2D\n  8\nDIE\n 10\n1\n 20\n2\n 11\n3\n 21\n";
    let end = text.rfind("  0\nENDSEC").unwrap();
    desk.write(
        "both.dxf",
        format!(
            "{}{}{damaged}{}{}",
            &text[..end],
            circle("2B"),
            circle("2C"),
            &text[end..]
        ),
    );
    check(
        &desk,
        "fix both.dxf -o fixed.dxf",
        1,
        &[
            "!1 arc repaired",
            "!not repaired: both.dxf:",
            "!which is damaged: mend that first",
        ],
    );
    check(&desk, "inspect fixed.dxf --output json", 1, &["0.101"]);
    check(
        &desk,
        "fix fixed.dxf -o again.dxf",
        1,
        &[
            "!nothing could be repaired safely",
            "!not repaired: fixed.dxf:",
        ],
    );
}

#[test]
fn a_fix_in_place_writes_what_a_fix_beside_writes() {
    let desk = Desk::new();
    check(
        &desk,
        "fix code_page.dxf -o beside.dxf",
        0,
        &["!1 arc repaired"],
    );
    let printed = desk
        .command("fix code_page.dxf -o -")
        .output()
        .unwrap()
        .stdout;
    check(
        &desk,
        "fix code_page.dxf --in-place",
        0,
        &["!1 arc repaired"],
    );
    assert_eq!(desk.read("code_page.dxf"), desk.read("beside.dxf"));
    assert_eq!(printed, desk.read("beside.dxf"));
    let names: Vec<_> = std::fs::read_dir(desk.0.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    assert!(
        names
            .iter()
            .all(|name| !name.to_string_lossy().starts_with(".wedm")),
        "{names:?}"
    );
}

#[cfg(unix)]
#[test]
fn a_fix_in_place_keeps_permissions_and_links() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    std::fs::set_permissions(
        desk.path("tight.dxf"),
        std::fs::Permissions::from_mode(0o640),
    )
    .unwrap();
    std::os::unix::fs::symlink("tight.dxf", desk.path("link.dxf")).unwrap();
    check(&desk, "fix link.dxf --in-place", 0, &["!1 arc repaired"]);
    assert!(
        std::fs::symlink_metadata(desk.path("link.dxf"))
            .unwrap()
            .is_symlink()
    );
    assert_eq!(
        std::fs::metadata(desk.path("tight.dxf"))
            .unwrap()
            .permissions()
            .mode()
            & 0o777,
        0o640
    );
    check(&desk, "check tight.dxf", 0, &[]);
}

#[test]
fn a_program_decodes_to_where_it_began_and_lands_in_its_file() {
    let desk = Desk::new();
    check(
        &desk,
        "generate clean.dxf --side opening -o clean.3b",
        0,
        &["!written clean.3b", "!1 contour"],
    );
    let program = String::from_utf8(desk.read("clean.3b")).unwrap();
    assert!(
        program
            .lines()
            .all(|line| line == "DD" || line.starts_with('B')),
        "{program}"
    );
    check(&desk, "check clean.3b", 0, &["nothing found"]);
    check(
        &desk,
        "generate tight.dxf --side opening --correction 0.07",
        0,
        &["DD"],
    );
    check(
        &desk,
        "generate tight.dxf --side opening --force",
        0,
        &["DD"],
    );
}

/// Errors of contours that are not cut do not stand in the way of those that are.
/// tight_fillet.dxf as a pair: it does not fit, and fits with a thinner wire; then there are two programs, which stay as they are.
#[test]
fn a_pair_is_held_in_each_other_and_its_programs_are_written_once() {
    let desk = Desk::new();
    let pair = "--drawn-as punch --clearance 0.01";
    let thick = format!("{pair} --wire-diameter 0.18 --gap 0.01");
    let thin = format!("{pair} --wire-diameter 0.1 --gap 0.01");
    let bound = desk.run(&format!("fit tight_fillet.dxf {thick} -o fit.svg"));
    assert_eq!(bound.code, Some(1), "{bound:?}");
    assert!(
        bound.stdout.contains("does not fit: -6.6 µm of 10.0"),
        "{bound:?}"
    );
    let svg = String::from_utf8(desk.read("fit.svg")).unwrap();
    assert!(
        svg.contains("-6.6 µm left of 10.0") && svg.ends_with("</svg>\n"),
        "{svg}"
    );
    let json = desk.run(&format!("fit tight_fillet.dxf {thin} --format json"));
    let fit: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!((json.code, &fit["fits"]), (Some(0), &Value::Bool(true)));
    let refused = desk.run(&format!("pair tight_fillet.dxf {thick}"));
    assert!(
        refused.code == Some(1) && refused.stderr.contains("does-not-fit"),
        "{refused:?}"
    );
    assert!(!desk.path("tight_fillet-punch.3b").exists());
    let written = desk.run(&format!("pair tight_fillet.dxf {thin} --holder 0.005"));
    assert_eq!(written.code, Some(0), "{written:?}");
    for (part, correction) in [
        ("punch", "0.0600"),
        ("plate", "0.0500"),
        ("holder", "0.0650"),
    ] {
        assert!(desk.path(&format!("tight_fillet-{part}.3b")).is_file());
        assert!(
            written
                .stderr
                .contains(&format!("{part}, correction {correction} mm")),
            "{written:?}"
        );
    }
    desk.write("tight_fillet-plate.3b", "mine");
    let again = desk.run(&format!("pair tight_fillet.dxf {thin}"));
    assert!(
        again.code == Some(2) && again.stderr.contains("it is there already"),
        "{again:?}"
    );
    assert_eq!(desk.read("tight_fillet-plate.3b"), b"mine");
    assert_eq!(
        desk.run(&format!("pair tight_fillet.dxf {thin} --overwrite"))
            .code,
        Some(0)
    );
    let missing = desk.run("pair tight_fillet.dxf --drawn-as plate");
    assert!(
        missing.code == Some(2)
            && missing
                .stderr
                .contains("says nothing without pair.clearance"),
        "{missing:?}"
    );
    let missing = desk.run("fit tight_fillet.dxf");
    assert!(
        missing.code == Some(1)
            && missing
                .stderr
                .contains("pair.drawn-as, pair.clearance, wire-diameter and gap"),
        "{missing:?}"
    );
}

#[test]
fn only_what_is_cut_refuses_a_program() {
    let desk = Desk::new();
    let hole = |handle: &str, x: f64, radius: f64| {
        format!("0\nCIRCLE\n5\n{handle}\n8\n0\n10\n{x}\n20\n0\n40\n{radius}\n")
    };
    let holes = [
        hole("2A", 0.0, 5.0),
        hole("2B", 20.0, 0.05),
        hole("2C", 30.0, 0.1),
    ]
    .concat();
    desk.write(
        "holes.dxf",
        format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{holes}0\nENDSEC\n0\nEOF\n"),
    );
    check(
        &desk,
        "generate holes.dxf --side opening",
        1,
        &["!error[small-radius]", "!has 1 error"],
    );
    check(
        &desk,
        "generate holes.dxf --side opening --handle 2B",
        1,
        &["!error[small-radius]"],
    );
    check(
        &desk,
        "generate holes.dxf --side opening --handle 2A",
        0,
        &["DD", "!1 contour"],
    );
    let on_layers = String::from_utf8(desk.read("holes.dxf")).unwrap();
    let on_layers = on_layers.replace("2A\n8\n0\n", "2A\n8\nFINE\n");
    desk.write("layers.dxf", on_layers);
    check(
        &desk,
        "generate layers.dxf --side opening --layer FINE",
        0,
        &["DD", "!1 contour"],
    );
    check(
        &desk,
        "generate layers.dxf --side opening --layer FINE --handle 2C",
        0,
        &["D\n", "!2 contours"],
    );
    check(
        &desk,
        "generate layers.dxf --side opening --layer 0",
        1,
        &["!error[small-radius]"],
    );
    check(
        &desk,
        "generate layers.dxf --side opening --layer FIN",
        1,
        &["!no contour that is cut has an entity on the layer \"FIN\""],
    );
    check(
        &desk,
        "generate holes.dxf --side opening --handle 2C --handle 2A",
        0,
        &["D\n", "!warning[offset-collapse]", "!2 contours"],
    );
    check(
        &desk,
        "check holes.dxf --side opening",
        1,
        &["warning[offset-collapse]", "1 error"],
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

#[cfg(unix)]
#[test]
fn a_folder_that_cannot_be_read_is_named() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    desk.write("closed/a.dxf", desk.read("clean.dxf"));
    std::fs::set_permissions(desk.path("closed"), std::fs::Permissions::from_mode(0o000)).unwrap();
    let readable_anyway = std::fs::read_dir(desk.path("closed")).is_ok();
    if readable_anyway {
        eprintln!("skipped: this user may read every folder");
    } else {
        check(&desk, "check closed", 2, &["!closed: permission denied"]);
    }
    std::fs::set_permissions(desk.path("closed"), std::fs::Permissions::from_mode(0o755)).unwrap();
}

#[test]
fn a_target_that_cannot_be_written_is_named_and_nothing_is_left_behind() {
    let desk = Desk::new();
    check(
        &desk,
        "fix tight.dxf -o no/such/folder/out.dxf",
        2,
        &["!no/such/folder/out.dxf could not be written"],
    );
    desk.write("folder/x", "");
    check(
        &desk,
        "fix tight.dxf -o folder",
        2,
        &["!folder could not be written"],
    );
}

/// A reader that goes away is no reason to panic.
#[test]
fn stdout_may_close_early() {
    let desk = Desk::new();
    for arguments in [
        "check tight.dxf --output sarif",
        "inspect tight.dxf",
        "draw tight.dxf",
        "completions bash",
        "fix tight.dxf -o -",
    ] {
        let mut child = desk
            .command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let mut stderr = String::new();
        child
            .stderr
            .take()
            .unwrap()
            .read_to_string(&mut stderr)
            .unwrap();
        let status = child.wait().unwrap();
        assert!(
            matches!(status.code(), Some(0 | 1)),
            "wedm {arguments}: {status}"
        );
        assert!(
            !stderr.contains("panicked") && !stderr.contains("pipe"),
            "wedm {arguments}: {stderr}"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let desk = Desk::new();
    let full = std::fs::File::options()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let ended = Ended::of(
        desk.command("draw tight.dxf")
            .stdout(full)
            .output()
            .unwrap(),
    );
    assert_eq!(ended.code, Some(2), "{ended:?}");
    assert!(
        ended.stderr.contains("stdout could not be written"),
        "{ended:?}"
    );
}

#[test]
fn a_picture_is_well_formed_enough_to_be_shown() {
    let desk = Desk::new();
    check(
        &desk,
        "draw narrow.dxf -o narrow.svg",
        0,
        &["!drawn without the path of the wire"],
    );
    let picture = String::from_utf8(desk.read("narrow.svg")).unwrap();
    assert!(picture.starts_with("<svg xmlns=") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    check(&desk, "draw clean.dxf --side opening -o clean.svg", 0, &[]);
    assert!(
        String::from_utf8(desk.read("clean.svg"))
            .unwrap()
            .contains("class=\"wire\"")
    );
}

/// Two holes, of which the second is cut first.
const HOLES: &str = "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n5\n2A\n10\n0\n20\n0\n40\n5\n\
    0\nCIRCLE\n5\n2B\n10\n20\n20\n0\n40\n5\n0\nENDSEC\n0\nEOF\n";

#[test]
fn a_picture_says_what_it_is_in_which_order_and_how_long() {
    let desk = Desk::new();
    desk.write("holes.dxf", HOLES);
    desk.write(
        "wedm.toml",
        "side = \"opening\"\n[drawings.\"holes.dxf\".contours.2B]\norder = 1\n",
    );
    let lengths = "cut 81.2 mm";
    desk.run("draw holes.dxf -o holes.svg");
    let picture = String::from_utf8(desk.read("holes.svg")).unwrap();
    for said in [
        "holes.dxf · contours and wire path</text>",
        "2 contours · 30.000 × 10.000 mm · contour 62.8 mm · cut 81.2 mm · jumps 20.0 mm",
        "class=\"jump\"",
        ">1</text>",
        ">2</text>",
    ] {
        assert!(picture.contains(said), "{said}: {picture}");
    }
    // The program of it speaks of the same lengths.
    let made = desk.run("generate holes.dxf --format 3b -o holes.3b");
    let said = made.stderr;
    assert!(
        said.contains(lengths) && said.contains("jumps 20.0 mm"),
        "{said}"
    );
    let told = desk.run("simulate holes.3b");
    let said = told.stdout;
    assert!(
        said.contains(lengths) && said.contains("jumps 20.0 mm"),
        "{said}"
    );
    desk.run("draw holes.3b -o program.svg");
    let picture = String::from_utf8(desk.read("program.svg")).unwrap();
    assert!(picture.contains("holes.3b · path of the wire"), "{picture}");
    assert!(picture.contains("cut 81.2 mm · jumps 20.0 mm"), "{picture}");
    // Where the side is not known there is no path, and the picture says why.
    desk.write("wedm.toml", "");
    desk.run("draw holes.dxf -o none.svg");
    let picture = String::from_utf8(desk.read("none.svg")).unwrap();
    assert!(
        picture.contains("contours, no wire path</text>"),
        "{picture}"
    );
    assert!(
        picture.contains("no wire path: side of contour 2A is not known"),
        "{picture}"
    );
}

#[test]
fn pictures_are_written_as_png_and_pdf_too() {
    let desk = Desk::new();
    desk.write("holes.dxf", HOLES);
    for (target, begins) in [
        ("a.PNG", &b"\x89PNG"[..]),
        ("a.pdf", b"%PDF-"),
        ("a.svg", b"<svg "),
    ] {
        let ended = desk.run(&format!("--lang zh draw holes.dxf -o {target}"));
        assert_eq!(ended.code, Some(0), "{ended:?}");
        let bytes = desk.read(target);
        assert!(bytes.starts_with(begins), "{target}: {} bytes", bytes.len());
    }
    let ended = desk.run("draw holes.dxf -o a.jpg");
    let said = ended.stderr;
    assert!(
        said.contains(".jpg is not written, expected .svg, .png, .pdf or .dxf"),
        "{said}"
    );
}

/// `UPDATE_EXPECT=1 cargo test --test cli` makes the pictures anew.
#[test]
fn the_pictures_of_the_documentation_are_current() {
    let desk = Desk::new();
    let drawing = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pictures/small-radius.dxf");
    desk.write("small-radius.dxf", std::fs::read(drawing).unwrap());
    check(
        &desk,
        "check small-radius.dxf --side opening",
        1,
        &["3 errors"],
    );
    let faulty = desk.run("draw small-radius.dxf --side opening").stdout;
    check(
        &desk,
        "fix small-radius.dxf --side opening --in-place",
        0,
        &["!3 arcs repaired"],
    );
    let fixed = desk.run("draw small-radius.dxf --side opening").stdout;
    expect_test::expect_file!["../docs/pictures/small-radius.svg"].assert_eq(&faulty);
    expect_test::expect_file!["../docs/pictures/small-radius-fixed.svg"].assert_eq(&fixed);
}

#[test]
fn a_new_drawing_holds_the_contours_and_the_path_of_the_wire() {
    let desk = Desk::new();
    check(&desk, "draw clean.dxf --side opening -o path.dxf", 0, &[]);
    let list = desk
        .run("inspect path.dxf --output json --side opening")
        .json();
    let layers = |layer: &str| {
        list["entities"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|entity| entity["layer"] == layer)
            .count()
    };
    // A lead in and out, and a piece of path for each segment and for the one that is cut in two by the entry.
    let contour = desk.run("inspect clean.dxf --output json").json();
    let segments = contour["entities"][0]["segments"].as_array().unwrap().len();
    assert_eq!((layers("DIE"), layers("WIRE")), (1, segments + 3));
}

/// A line costs what it is long, whatever stands in it: each of these took minutes when every word looked at the rest of the line.
#[test]
fn one_long_line_is_formatted_as_fast_as_many_short_ones() {
    let desk = Desk::new();
    for (ending, piece) in [
        ("3b", "D "),
        ("3b", "B"),
        ("3b", "b1000b0b1000gxl1"),
        ("3b", "1.5 "),
        ("3b", "ab B1 "),
        ("iso", "g01x1y1 "),
        ("iso", "(a)"),
    ] {
        desk.write(
            &format!("long.{ending}"),
            piece.repeat(200_000 / piece.len()),
        );
        let begun = std::time::Instant::now();
        let ended = desk.run(&format!("format --check --layout aligned long.{ending}"));
        assert!(matches!(ended.code, Some(0 | 1)), "{piece:?}: {ended:?}");
        assert!(
            begun.elapsed() < std::time::Duration::from_secs(60),
            "{piece:?} took {:?}",
            begun.elapsed()
        );
    }
}

/// A picture of what an electrode mills speaks of no wire and of no hole to thread it through.
#[test]
fn pictures_of_milling_speak_of_the_electrode() {
    let desk = Desk::new();
    desk.write(
        "wedm.toml",
        "[milling]\ntool-diameter = 1.0\ngap = 0.05\nlayer = 0.05\ndepth = 0.2\nwear = 0.001\n",
    );
    desk.write(
        "slot.dxf",
        "0\nSECTION\n2\nENTITIES\n0\nLINE\n5\n2A\n8\n0\n10\n0\n20\n0\n11\n10\n21\n0\n0\nENDSEC\n0\nEOF\n",
    );
    check(
        &desk,
        "generate slot.dxf --format milling -o milled.iso",
        0,
        &[],
    );
    for (file, title, language) in [
        (
            "slot.dxf",
            "slot.dxf · contours and path of the electrode",
            "en",
        ),
        ("milled.iso", "milled.iso · path of the electrode", "en"),
        ("slot.dxf", "slot.dxf · 轮廓和电极路线", "zh"),
        ("milled.iso", "milled.iso · 电极路线", "zh"),
    ] {
        let drawn = desk.run(&format!("--lang {language} draw {file}"));
        assert_eq!(drawn.code, Some(0), "{drawn:?}");
        assert!(
            drawn.stdout.contains(title),
            "no {title} in {}",
            drawn.stdout
        );
        for wire in ["wire<", "wire's", "thread hole", "电极丝", "穿丝"] {
            assert!(!drawn.stdout.contains(wire), "{wire} in {}", drawn.stdout);
        }
    }
}
