//! Which files are checked: names, folders, links, stdin, and what is watched.

use super::{Desk, Ended, check};
use std::process::Stdio;

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
    let next = || lines.recv_timeout(std::time::Duration::from_secs(20));
    let expect = |text: &str| {
        let mut line = next();
        while line
            .as_ref()
            .is_ok_and(|line| line.starts_with("against: "))
        {
            line = next();
        }
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
            "!warning: no file is found whose name ends with one of .dxf, ",
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
    check(
        &desk,
        "check plate.txt",
        1,
        &["plate.txt: error[small-radius]"],
    );
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
        &[
            "parts/link.dxf: error[small-radius]",
            "1 file checked: 1 error",
        ],
    );
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
