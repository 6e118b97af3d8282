//! The control finds each correction where the program says, in a program that is made of it too.

use super::*;

const SQUARE: &str = "G01 X5. Y0.\nY5.\nX-5.\nY-5.\nX5.\nY0.\n";

/// Cuts, each as the line before it and the words in its third block; a stop between them.
fn program(begin: &str, cuts: &[(&str, &str)]) -> String {
    let cut = |(before, within): &(&str, &str)| {
        let square = SQUARE.replace("X-5.\n", &format!("X-5. {within}\n"));
        format!("{before}\n{square}G40\nG01 X0.\n")
    };
    let cuts: Vec<String> = cuts.iter().map(cut).collect();
    format!("{begin}G92 X0 Y0\nG90\n{}M02\n", cuts.join("M00\n"))
}

/// The lines of a program that switch the correction on.
fn switches(text: &str) -> Vec<&str> {
    let is_switch = |line: &&str| line.starts_with("G41") || line.starts_with("G42");
    text.lines().filter(is_switch).collect()
}

#[test]
fn each_place_of_a_correction_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("wedm.toml"),
        "[profiles.wide]\nbegin = [\"G92 X{x} Y{y}\"]\nregister = \"H001\"\ncontour-begin = [\"{register}\", \"{side}\"]\n\
         [profiles.fixed]\nbegin = [\"G92 X{x} Y{y}\"]\ncontour-begin = [\"{side} D5\"]\n\
         [profiles.bare]\nbegin = [\"G92 X{x} Y{y}\"]\ncontour-begin = [\"{side}\"]\n",
    )
    .unwrap();
    let five = program("", &[("G41 D5", "")]);
    let three = program("", &[("G41 D1", ""), ("G42 D2", ""), ("G41 D11", "")]);
    let stated = program(
        "H001=0.2\nH002=0.1\n",
        &[("G41 H001", ""), ("G42 H002", "")],
    );
    let alone = program("", &[("D7\nG41", "")]);
    let modal = program("", &[("G41 D3", ""), ("G42", ""), ("G41 D4", "")]);
    let both = program("", &[("G41 D1", ""), ("G42 H1", "")]);
    let none = program("", &[("G41", "")]);
    let within = program("", &[("G41 D1", "D2")]);
    for (text, to, expected, said) in [
        (&five, "iso", Ok("G41 D5"), ""),
        (&five, "iso --profile robofil", Ok("G41 D5"), ""),
        (&five, "iso --profile fast-wire", Ok("G41 D5"), ""),
        (&five, "iso --profile fixed", Ok("G41 D5"), ""),
        (&five, "iso --profile wide", Ok("G41"), "D5 as H5"),
        (
            &five,
            "iso --profile bare",
            Err("G41"),
            "the place 5 of the correction",
        ),
        (&five, "4b", Ok(""), ""),
        (&three, "iso", Ok("G41 D1, G42 D2, G41 D11"), ""),
        (
            &three,
            "iso --profile fixed",
            Err("G41 D5, G42 D5, G41 D5"),
            "the place 1 of the correction",
        ),
        (&three, "4b", Err(""), "those of D1, D2, D11"),
        (&stated, "iso", Ok("G41 D1, G42 D2"), "H1 as D1, H2 as D2"),
        (&alone, "iso", Ok("G41 D7"), ""),
        (&modal, "iso", Ok("G41 D3, G42 D3, G41 D4"), ""),
        (
            &both,
            "iso",
            Err("G41 D1, G42 D1"),
            "D1, H1 would be one place",
        ),
        (&none, "iso", Ok("G41 D1"), "D1 of the profile is written"),
        (
            &within,
            "iso",
            Err("G41 D1"),
            "line 6: D2 takes the place of D1",
        ),
        (&within, "4b", Err(""), "line 6: D2 takes the place of D1"),
        (&within, "dxf", Ok(""), "the correction is not in them"),
    ] {
        std::fs::write(folder.path().join("in.iso"), text).unwrap();
        let convert = |more: &str| {
            wedm(
                folder.path(),
                &format!("convert in.iso --format {to}{more}"),
            )
        };
        let (mut code, mut made, mut told) = convert("");
        if expected.is_err() {
            assert!(
                code == 1 && told.contains(said) && told.contains("--force"),
                "{to}: {told}\n{text}"
            );
            (code, made, told) = convert(" --force");
        }
        assert!(code == 0 && told.contains(said), "{to}: {told}\n{text}");
        let (Ok(expected) | Err(expected)) = expected;
        assert_eq!(switches(&made).join(", "), expected, "{to}: {told}\n{text}");
    }
    // The register of a line of its own is read again.
    std::fs::write(folder.path().join("in.iso"), &stated).unwrap();
    let (_, made, _) = wedm(folder.path(), "convert in.iso --format iso --profile wide");
    let lines: Vec<&str> = made.lines().filter(|line| line.starts_with('H')).collect();
    assert_eq!(lines, ["H001", "H002"], "{made}");
}

/// What a header says of the corrections is what the program says of them.
#[test]
fn a_header_names_the_corrections_of_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let settings = "correction = 0.12\n[program]\nheader = true\n";
    std::fs::write(folder.path().join("wedm.toml"), settings).unwrap();
    for (text, expected) in [
        (program("", &[("G41 D5", "")]), "(D5 = 0.1200)"),
        (program("D5=0.2\n", &[("G41 D5", "")]), "(D5 = 0.2000)"),
        (
            program("D1=0.2\n", &[("G41 D1", ""), ("G42 D2", "")]),
            "(D1 = 0.2000)",
        ),
        (program("", &[("G41 D1", ""), ("G42 D2", "")]), ""),
    ] {
        std::fs::write(folder.path().join("in.iso"), &text).unwrap();
        let (code, made, told) = wedm(folder.path(), "convert in.iso --format iso");
        let comments: Vec<&str> = made.lines().filter(|line| line.contains(" = ")).collect();
        assert!(
            code == 0 && comments.join("\n") == expected,
            "{told}\n{made}"
        );
    }
}
