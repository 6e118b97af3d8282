//! What others have named or made: names that would steer a terminal, files that are none, files that change or belong to somebody.

use super::{Desk, Ended, check};
use std::process::Command;

/// A name with an end of line, a colour, a conceal, a cursor movement, a C1 control and a turn of direction in it.
const EVIL: &str = "A\u{1b}[8mB\u{1b}[2J\u{9b}31m\u{202e}C\u{2066}\u{7}";
const EVIL_FILE: &str = "p\u{1b}[31m\u{202e}q\u{9b}8m\u{7}";

/// Like what a terminal would get: with colours.
fn run_in_colour(desk: &Desk, arguments: &[&str]) -> Ended {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wedm"));
    let command = command
        .args(arguments)
        .current_dir(desk.path("."))
        .env("CLICOLOR_FORCE", "1")
        .env_remove("NO_COLOR");
    Ended::of(command.stdin(std::process::Stdio::null()).output().unwrap())
}

/// Everything that is not ours: `text` without the colours that its own words are given.
fn without_colours(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once("\u{1b}[") {
        plain += before;
        let end = behind
            .find(|character: char| !character.is_ascii_digit() && character != ';')
            .unwrap_or(behind.len());
        assert!(
            behind[end..].starts_with('m'),
            "an escape that is no colour in {text:?}"
        );
        assert!(
            !["8", "28"].contains(&&behind[..end]),
            "hidden text in {text:?}"
        );
        rest = &behind[end + 1..];
    }
    plain + rest
}

fn is_hidden(character: char) -> bool {
    (character.is_control() && character != '\t' && character != '\n')
        || matches!(character, '\u{200e}' | '\u{200f}' | '\u{61c}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A drawing in which everything that can have a name has an evil one.
fn evil_drawing() -> String {
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\n{EVIL}\n70\n1\n62\n7\n\
         0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n\
         0\nLWPOLYLINE\n5\n2A{EVIL}\n8\nX{EVIL}\n90\n4\n70\n1\n10\n0\n20\n0\n10\n20\n20\n0\n10\n20\n20\n9.92\n42\n0.414213562373\n10\n19.92\n20\n10\n10\n0\n20\n10\n\
         0\nLINE\n5\n3{EVIL}\n8\n{EVIL}\n10\n0\n20\n0\n11\n5\n21\n5\n0\nLINE\n5\n4{EVIL}\n8\nX{EVIL}\n10\n50\n20\n0\n11\n55\n21\n5\n\
         0\nINSERT\n5\n5{EVIL}\n8\n0\n2\nB{EVIL}\n10\n0\n20\n0\n0\n{EVIL}\n5\n6\n0\nENDSEC\n0\nEOF\n"
    )
}

#[test]
fn no_name_steers_the_terminal() {
    let desk = Desk::new();
    let (dxf, program) = (format!("{EVIL_FILE}.dxf"), format!("{EVIL_FILE}.3b"));
    desk.write(&dxf, evil_drawing());
    desk.write(
        &program,
        format!("B1000B0B1000GXL1\nB1000{EVIL}\n; {EVIL}\nDD\n"),
    );
    desk.write(
        &format!("{EVIL_FILE}.toml"),
        format!("side = \"{EVIL_FILE}\"\n\"{EVIL_FILE}\" = 1\n"),
    );
    let (toml, missing) = (
        format!("{EVIL_FILE}.toml"),
        format!("{EVIL_FILE}-missing.dxf"),
    );
    let cases: &[&[&str]] = &[
        &["check", &dxf],
        &["check", &dxf, &program, "."],
        &["check", &dxf, "--config", &toml],
        &["check", &missing],
        &["check", EVIL_FILE, "--correction", EVIL_FILE],
        &["check", "--output", "json", &dxf],
        &["check", "--output", "sarif", &dxf],
        &["inspect", &dxf],
        &["inspect", "--output", "json", &dxf],
        &["contours", &dxf],
        &["contours", "--output", "json", &dxf],
        &["generate", &dxf],
        &[
            "generate",
            &dxf,
            "--force",
            "--side",
            "opening",
            "-o",
            &format!("{EVIL_FILE}.out"),
        ],
        &[
            "generate", &dxf, "--force", "--side", "opening", "--handle", EVIL,
        ],
        &[
            "generate",
            &dxf,
            "--profile",
            EVIL_FILE,
            "--format",
            "iso",
            "--force",
            "--side",
            "punch",
        ],
        &["fix", &dxf, "--diff"],
        &["fix", &dxf, "-o", &format!("{EVIL_FILE}.fixed.dxf")],
        &["fix", &dxf, "-o", &dxf],
        &["fix", &program, "--diff"],
        &["draw", &dxf, "-o", &format!("{EVIL_FILE}.svg")],
        &["draw", &dxf, "-o", EVIL_FILE],
        &["format", &program, "--check"],
        &["format", &program, "--in-place"],
        &["convert", &program, "--format", EVIL_FILE],
        &["convert", &program, "-o", &format!("{EVIL_FILE}.iso")],
        &[
            "convert",
            &program,
            "--force",
            "-o",
            &format!("{EVIL_FILE}.new.iso"),
        ],
        &["simulate", &program],
        &["simulate", "--output", "json", &program],
        &[EVIL_FILE],
    ];
    for arguments in cases {
        let ended = run_in_colour(&desk, arguments);
        assert!(
            matches!(ended.code, Some(0..=2)),
            "{arguments:?}: {ended:?}"
        );
        for text in [&ended.stdout, &ended.stderr] {
            let plain = without_colours(text);
            assert!(!plain.contains(is_hidden), "{arguments:?}: {plain:?}");
        }
    }
    // What is said in JSON is the name itself.
    let ended = run_in_colour(&desk, &["check", "--output", "json", &dxf]);
    assert_eq!(ended.json()["diagnostics"][0]["path"], dxf.as_str());
    assert!(
        ended.json()["diagnostics"]
            .as_array()
            .unwrap()
            .iter()
            .any(|row| row["data"]["handle"] == format!("2A{EVIL}")),
        "{ended:?}"
    );
}

/// Errors are passed over with `--force`; whatever comes of them is no fault of the program.
#[test]
fn what_is_forced_is_never_an_internal_error() {
    let desk = Desk::new();
    let drawings = [
        "10\n0\n20\n0\n42\n1e17\n10\n1\n20\n0\n10\n1\n20\n1\n",
        "10\n0\n20\n0\n42\n50\n10\n1e-7\n20\n0\n10\n1\n20\n1\n",
        "10\n0\n20\n0\n10\n1\n20\n1\n10\n1\n20\n0\n10\n0\n20\n1\n",
        "10\n1e15\n20\n0\n10\n1e15\n20\n1\n10\n0\n20\n1\n",
        "10\n0\n20\n0\n10\n0.0000001\n20\n0\n10\n0\n20\n0.0000001\n",
        "10\n0\n20\n0\n42\n0.4\n10\n0.01\n20\n0\n42\n-0.4\n10\n0.02\n20\n0\n10\n5\n20\n5\n",
        "10\n0\n20\n0\n10\n0\n20\n0\n10\n0\n20\n0\n",
    ];
    for (index, vertices) in drawings.iter().enumerate() {
        let count = vertices.matches("10\n").count();
        desk.write(
            &format!("d{index}.dxf"),
            format!("0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n5\n2A\n90\n{count}\n70\n1\n{vertices}0\nENDSEC\n0\nEOF\n"),
        );
        for side in ["opening", "punch"] {
            for format in ["3b", "4b", "iso"] {
                let ended = desk.run(&format!(
                    "generate d{index}.dxf --force --side {side} --format {format}"
                ));
                assert!(
                    !ended.stderr.contains("internal") && matches!(ended.code, Some(0 | 1)),
                    "{index} {side} {format}: {ended:?}"
                );
            }
        }
    }
    let programs = [
        "B1000B0B1000GXL1\nB0B1000B1GYNR1\nDD\n",
        "B999999999B0B999999999GXL1\nB1B999999999B999999999GYNR1\nDD\n",
        "B0B0B0GXNR1\nB0B0B1000GXNR1\nDD\n",
        "B1000B0B99999999GXNR1\nB1000B1000B1000GXL1\nB1000\nDD\n",
        "B1B1B1GXSR1\nB1B1B1GXSR3\nB5B5B500GYNR2\nDD\n",
        "B1000B0B3900GXNR1\nB100B0B100GXL1\nD\nB100B0B100GXL3\nDD\n",
    ];
    for (index, text) in programs.iter().enumerate() {
        desk.write(&format!("p{index}.3b"), text);
        for format in ["dxf", "3b", "4b", "iso"] {
            let ended = desk.run(&format!("convert p{index}.3b --force --format {format}"));
            assert!(
                !ended.stderr.contains("internal") && matches!(ended.code, Some(0 | 1)),
                "{index} {format}: {ended:?}"
            );
        }
    }
    let iso = [
        "G01 X1e9 Y0\nG02 X1 Y1 I0 J0\nM02\n",
        "G92 X0 Y0\nG02 X10. Y0 I1. J0\nG03 X0 Y0 R0.001\nM02\n",
        "G41 D1\nG02 X5. Y5. R1.\nX0 Y0\nM02\n",
    ];
    for (index, text) in iso.iter().enumerate() {
        desk.write(&format!("i{index}.iso"), text);
        for format in ["dxf", "3b", "4b", "iso"] {
            let ended = desk.run(&format!("convert i{index}.iso --force --format {format}"));
            assert!(
                !ended.stderr.contains("internal") && matches!(ended.code, Some(0 | 1)),
                "{index} {format}: {ended:?}"
            );
        }
    }
}

#[cfg(unix)]
mod unix {
    use super::super::{Desk, check};
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};

    fn make_pipe(desk: &Desk, name: &str) {
        assert!(
            std::process::Command::new("mkfifo")
                .arg(desk.path(name))
                .status()
                .unwrap()
                .success()
        );
    }

    #[test]
    fn a_folder_is_searched_for_regular_files_and_no_other_is_changed_in_its_place() {
        let desk = Desk::new();
        desk.write("parts/a.3b", "B1000B0B1000GXL1\nB1000B0B1000GXL3\nDD\n");
        for name in ["parts/pipe.3b", "parts/pipe.dxf", "pipe.3b", "pipe.dxf"] {
            make_pipe(&desk, name);
        }
        symlink("/dev/zero", desk.path("parts/zero.dxf")).unwrap();
        symlink("/dev/zero", desk.path("zero.3b")).unwrap();
        std::fs::create_dir(desk.path("parts/folder.dxf")).unwrap();
        check(&desk, "check parts", 0, &["1 file checked"]);
        check(
            &desk,
            "format parts --in-place --layout aligned",
            0,
            &["!1 program formatted"],
        );
        for name in ["pipe.3b", "zero.3b"] {
            check(
                &desk,
                &format!("format {name} --in-place"),
                2,
                &["!it is not a regular file"],
            );
            check(
                &desk,
                &format!("fix {name} --in-place"),
                2,
                &["!it is not a regular file"],
            );
        }
        check(
            &desk,
            "fix pipe.dxf --in-place",
            2,
            &["!it is not a regular file"],
        );
    }

    #[test]
    fn a_device_or_a_pipe_that_is_named_is_read_up_to_the_cap() {
        let desk = Desk::new();
        symlink("/dev/zero", desk.path("zero.dxf")).unwrap();
        symlink("/dev/null", desk.path("null.3b")).unwrap();
        symlink("/dev/zero", desk.path("zero.toml")).unwrap();
        check(
            &desk,
            "check zero.dxf",
            2,
            &["!zero.dxf: it has more than 268435456 bytes"],
        );
        check(
            &desk,
            "check clean.dxf --config zero.toml",
            2,
            &["!zero.toml: it is not a regular file"],
        );
        check(&desk, "check null.3b", 0, &[]);
        make_pipe(&desk, "pipe.dxf");
        let (from, to) = (desk.path("tight.dxf"), desk.path("pipe.dxf"));
        let writer = std::thread::spawn(move || std::fs::write(to, std::fs::read(from).unwrap()));
        check(&desk, "check pipe.dxf", 1, &["1 error"]);
        writer.join().unwrap().unwrap();
    }

    #[test]
    fn a_file_that_is_repaired_in_its_place_keeps_owner_and_mode_and_says_its_other_names() {
        let desk = Desk::new();
        let path = desk.path("tight.dxf");
        std::fs::set_permissions(&path, PermissionsExt::from_mode(0o604)).unwrap();
        // Only root may give a file away.
        let is_given = std::os::unix::fs::chown(&path, Some(12_345), Some(54_321)).is_ok();
        std::fs::hard_link(&path, desk.path("second.dxf")).unwrap();
        let before = desk.read("tight.dxf");
        check(
            &desk,
            "fix tight.dxf --in-place",
            0,
            &["!note: tight.dxf had 1 name besides this one (hard links)"],
        );
        assert_ne!(desk.read("tight.dxf"), before);
        assert_eq!(desk.read("second.dxf"), before);
        let metadata = std::fs::metadata(&path).unwrap();
        assert_eq!(metadata.mode() & 0o7777, 0o604);
        if is_given {
            assert_eq!((metadata.uid(), metadata.gid()), (12_345, 54_321));
        }
        let left: Vec<_> = std::fs::read_dir(desk.path("."))
            .unwrap()
            .map(|entry| entry.unwrap().file_name())
            .collect();
        assert!(
            !left
                .iter()
                .any(|name| name.to_string_lossy().starts_with(".wedm")),
            "{left:?}"
        );
    }
}

/// A kilometre in numbers of six digits, and layers of a micrometre: what no machine takes is refused before it is
/// written, and beside a program it is not written to be compared.
#[test]
fn a_program_without_end_is_refused() {
    let desk = Desk::new();
    let vertex = |[x, y]: [f64; 2]| format!("10\n{x}\n20\n{y}\n");
    let drawing = |closed: u8, vertices: &[[f64; 2]]| {
        let vertices: String = vertices.iter().copied().map(vertex).collect();
        format!(
            "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n70\n{closed}\n{vertices}0\nENDSEC\n0\nEOF\n"
        )
    };
    let far = 9e8;
    desk.write(
        "far.dxf",
        drawing(1, &[[0.0, 0.0], [far, 0.0], [far, far], [0.0, far]]),
    );
    desk.write(
        "far.3b",
        "B1000B0B1000GXL1\nB0B1000B1000GYL2\nB1000B0B1000GXL3\nB0B1000B1000GYL4\nDD\n",
    );
    let refused = &[
        "!error: far.dxf: the program would have more than 2000000 blocks: no machine takes that many",
    ];
    check(
        &desk,
        "generate far.dxf --side opening --format 3b -o out.3b --overwrite",
        1,
        refused,
    );
    check(&desk, "check far.3b", 0, &[]);
    desk.write(
        "far.iso",
        "G01 X9000000. Y0\nG01 X-9000000. Y0\n".repeat(200),
    );
    let refused =
        &["!far.iso: the program would have more than 2000000 blocks: no machine takes that many"];
    check(
        &desk,
        "convert far.iso --force --format 3b -o out.3b --overwrite",
        1,
        refused,
    );
    desk.write("line.dxf", drawing(0, &[[0.0, 0.0], [1000.0, 0.0]]));
    desk.write(
        "wedm.toml",
        "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.001\ndepth = 1\nwear = 0.02\nwear-compensation = \"linear\"\nstep = 0.001\n",
    );
    let refused =
        &["!line.dxf: the program would have more than 2000000 blocks: no machine takes that many"];
    check(
        &desk,
        "generate line.dxf --format milling -o out.iso --overwrite",
        1,
        refused,
    );
}
