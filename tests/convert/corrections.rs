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
            "the offset register 5",
        ),
        (&five, "4b", Ok(""), ""),
        (&three, "iso", Ok("G41 D1, G42 D2, G41 D11"), ""),
        (
            &three,
            "iso --profile fixed",
            Err("G41 D5, G42 D5, G41 D5"),
            "the offset register 1",
        ),
        (&three, "4b", Err(""), "those of D1, D2, D11"),
        (&stated, "iso", Ok("G41 D1, G42 D2"), "H1 as D1, H2 as D2"),
        (&alone, "iso", Ok("G41 D7"), ""),
        (&modal, "iso", Ok("G41 D3, G42 D3, G41 D4"), ""),
        (
            &both,
            "iso",
            Err("G41 D1, G42 D1"),
            "D1, H1 would become one offset register",
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

/// Blocks of cuts in the profile `generic`, by the places that they lead to.
fn blocks(places: &str) -> String {
    let line = |word: &str| match word.split_once(',') {
        Some((x, y)) => format!("G01 X{x}.000 Y{y}.000\n"),
        None => format!("{}\n", word.replace('_', " ")),
    };
    let lines: String = places.split_whitespace().map(line).collect();
    format!("%\nG21\nG90\nG92 X0.000 Y0.000\n{lines}M02\n%\n")
}

/// A program in the words of the profile becomes itself: each pass has its side and its place, and no stop is put
/// between them.
#[test]
fn passes_stay_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    for places in [
        // To and fro, without a stop.
        "G41_D1 5,0 5,5 -5,5 -5,-5 5,-5 5,0 G40 0,0 G42_D2 5,0 5,-5 -5,-5 -5,5 5,5 5,0 G40 0,0",
        // One way, the last two with one correction; then another contour.
        "G41_D1 5,0 5,5 -5,5 -5,-5 5,-5 5,0 G40 0,0 G41_D3 5,0 5,5 -5,5 -5,-5 5,-5 5,0 G40 0,0 \
         G41_D3 5,0 5,5 -5,5 -5,-5 5,-5 5,0 G40 0,0 M00 G00_X20.000_Y0.000 M00 \
         G42_D11 25,0 25,-5 15,-5 15,5 25,5 25,0 G40 20,0",
        // Up to a tab, back from there, and up to it; then the tab in three passes.
        "G41_D1 5,0 5,5 -5,5 -5,-5 5,-5 5,-2 G40 6,-2 M00 G42_D2 5,-2 5,-5 -5,-5 -5,5 5,5 5,0 G40 8,0 \
         G41_D3 5,0 5,5 -5,5 -5,-5 5,-5 5,-2 G40 6,-2 M00 G41_D1 5,-2 5,0 G40 8,0 G42_D2 5,0 5,-2 G40 6,-2 \
         G41_D3 5,-2 5,0 G40 8,0",
        // Up to a tab, and back to the thread hole, twice.
        "G41_D1 5,0 5,5 -5,5 -5,-5 5,-5 5,-2 G40 0,0 G41_D2 5,0 5,5 -5,5 -5,-5 5,-5 5,-2 G40 0,0 M00 \
         G41_D1 5,-2 5,0 G40 0,0",
        // Off at once on a way of several blocks.
        "G42_D1 5,0 5,-5 -5,-5 -5,5 5,5 5,0 G40 3,1 1,1 0,0 G41_D2 5,0 5,5 -5,5 -5,-5 5,-5 5,0 G40 0,0",
    ] {
        let text = blocks(places);
        std::fs::write(folder.path().join("in.iso"), &text).unwrap();
        let (code, made, told) = wedm(folder.path(), "convert in.iso --format iso");
        assert_eq!((code, made), (0, text), "{told}");
    }
}

/// Passes without a stop between them are passes in a drawing, and contours of 4B where they have one correction.
#[test]
fn passes_without_a_stop_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    for (skim, four_b) in [("D1", Ok("2 contours")), ("D2", Err("those of D1, D2"))] {
        let text = blocks(&format!(
            "G41_D1 5,0 5,5 -5,5 -5,-5 5,-5 5,0 G40 0,0 G42_{skim} 5,0 5,-5 -5,-5 -5,5 5,5 5,0 G40 0,0"
        ));
        std::fs::write(folder.path().join("in.iso"), &text).unwrap();
        let (code, _, told) = wedm(folder.path(), "convert in.iso -o out.dxf --overwrite");
        assert!(code == 0 && told.contains(": 1 contour\n"), "{told}");
        let made = dxf::Document::read(std::fs::read(folder.path().join("out.dxf")).unwrap());
        let closed = |(_, entity): (EntityId, &wedm::drawing::Entity)| match &entity.geometry {
            Geometry::Polyline {
                closed: true,
                vertices,
            } => Some((entity.layer.to_string(), vertices.len())),
            _ => None,
        };
        let closed: Vec<_> = made.drawing().entities().filter_map(closed).collect();
        assert_eq!(closed, [("PASS1".to_owned(), 5), ("CUT".to_owned(), 5)]);
        let (code, _, told) = wedm(folder.path(), "convert in.iso --format 4b");
        let (Ok(said) | Err(said)) = four_b;
        assert!(
            code == i32::from(four_b.is_err()) && told.contains(said),
            "{told}"
        );
        // 3B is refused for what it is.
        let (code, _, told) = wedm(folder.path(), "convert in.iso --format 3b");
        assert!(
            code == 1 && told.contains("which no 3B controller does"),
            "{told}"
        );
    }
}

/// The first block of a way in may come before the correction, and the way out lead elsewhere.
#[test]
fn a_way_in_without_a_correction_belongs_to_no_contour() {
    let folder = tempfile::tempdir().unwrap();
    for places in [
        "3,1 G41_D4 5,0 5,5 -5,5 -5,-5 5,-5 5,0 G40 0,0",
        "1,1 2,1 G41_D4 5,0 5,5 -5,5 -5,-5 5,-5 5,0 G40 0,0",
        "3,1 G41_D4 5,0 5,5 -5,5 -5,-5 5,-5 5,0 G40 9,9",
        "3,1 G41_D4 5,0 5,5 -5,5 -5,-5 G40 9,9",
    ] {
        std::fs::write(folder.path().join("in.iso"), blocks(places)).unwrap();
        let (code, made, told) = wedm(folder.path(), "convert in.iso --format iso");
        assert_eq!(code, 0, "{places}: {told}");
        let moves = |text: &str| {
            let moves = text.lines().filter(|line| line.starts_with("G01"));
            moves.map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(moves(&made), moves(&blocks(places)), "{places}: {told}");
        assert_eq!(switches(&made), ["G41 D4"], "{places}");
    }
}
