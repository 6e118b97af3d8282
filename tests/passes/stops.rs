//! Stops of a program, and what else its fixed lines do: all of it is read again before the program is handed out.

use super::{PLATE, THREE, drawing, generated, paths, settings};
use wedm::drawing::Role;
use wedm::program::Format::{self, Iso, ThreeB};

/// Settings of a punch, the format, and what is said where there is no program.
const ROWS: &[(&str, Format, &str)] = &[
    ("tab = 3", ThreeB, ""),
    ("tab = 3", Iso, ""),
    ("tab = 3\ntab-stop = \"M01\"", Iso, ""),
    ("tab = 3\ntab-stop = \"M0\"", Iso, ""),
    ("tab = 3\ntab-stop = \"A\"", ThreeB, ""),
    ("tab = 3\npause = \"HALT\"\ntab-stop = \"halt\"", ThreeB, ""),
    (
        "tab = 3\ntab-stop = \"M01\"",
        ThreeB,
        "program.tab-stop is M01",
    ),
    ("tab = 3\ntab-stop = \"D\"", Iso, "program.tab-stop is D"),
    // The lines of a profile.
    (
        "tab = 3\nprofile = \"s\"\n[profiles.s]\npause = []",
        Iso,
        "its pause does not stop the machine once",
    ),
    (
        "tab = 3\nprofile = \"s\"\n[profiles.s]\npause = [\"M08\"]",
        Iso,
        "its pause does not stop the machine once",
    ),
    (
        "tab = 3\nprofile = \"s\"\n[profiles.s]\npause = [\"(M00)\"]",
        Iso,
        "its pause does not stop the machine once",
    ),
    (
        "tab = 3\nprofile = \"s\"\n[profiles.s]\npause = [\"M00\", \"M01\"]",
        Iso,
        "its pause does not stop the machine once",
    ),
    (
        "tab = 3\nprofile = \"s\"\n[profiles.s]\npause = [\"M50\", \"M00\", \"M60\"]",
        Iso,
        "",
    ),
    (
        "tab = 3\ntab-stop = \"M01\"\nprofile = \"s\"\n[profiles.s]\npause = [\"M08\"]",
        Iso,
        "",
    ),
    (
        "tab = 3\nprofile = \"s\"\n[profiles.s]\npause = [\"M30\"]",
        Iso,
        "ends the program before all of it is cut",
    ),
    (
        "profile = \"s\"\n[profiles.s]\ncontour-begin = [\"M02\"]",
        Iso,
        "`M02` ends the program",
    ),
    (
        "profile = \"s\"\n[profiles.s]\nbegin = [\"G92 X{x} Y{y}\", \"M99\"]",
        Iso,
        "`M99` ends the program",
    ),
    // What tilts, turns or shifts what follows.
    (
        "profile = \"s\"\n[profiles.s]\nbegin = [\"G92 X{x} Y{y}\", \"G51 A3.\"]",
        Iso,
        "`G51 A3.` tilts the wire",
    ),
    (
        "profile = \"s\"\n[profiles.s]\nbegin = [\"G92 X{x} Y{y} U1.\"]",
        Iso,
        "tilts the wire",
    ),
    (
        "profile = \"s\"\n[profiles.s]\nbegin = [\"G92 X{x} Y{y}\", \"G51 A3.\", \"G50\"]",
        Iso,
        "",
    ),
    (
        "profile = \"s\"\n[profiles.s]\nbegin = [\"G40 G50 G92 X{x} Y{y}\", \"T84 T86\"]",
        Iso,
        "",
    ),
    (
        "profile = \"s\"\n[profiles.s]\nbegin = [\"G92 X{x} Y{y}\", \"G68 X0. Y0. R45.\"]",
        Iso,
        "holds G68, which leads what follows elsewhere",
    ),
    (
        "profile = \"s\"\n[profiles.s]\nbegin = [\"G92 X{x} Y{y}\", \"G05\"]",
        Iso,
        "holds G05, which leads what follows elsewhere",
    ),
    (
        "profile = \"s\"\n[profiles.s]\nbegin = [\"G92 X{x} Y{y}\", \"G18\"]",
        Iso,
        "holds G18, which leads what follows elsewhere",
    ),
    (
        "profile = \"s\"\n[profiles.s]\nbegin = [\"G54 G92 X{x} Y{y}\", \"G69\", \"G17\"]",
        Iso,
        "",
    ),
    (
        "profile = \"s\"\n[profiles.s]\nend = [\"G28 X0. Y0.\", \"M02\"]",
        Iso,
        "",
    ),
];

#[test]
fn what_fixed_lines_do_is_read_again() {
    let mut wrong = Vec::new();
    let drawing = drawing(Role::Punch, &PLATE);
    for &(text, format, says) in ROWS {
        let settings = settings(&format!("[program]\n{text}\n"));
        let paths = paths(&drawing, &settings);
        let made = format.write(&paths, 1.0, &settings, &mut |_, _| true);
        let said = made
            .err()
            .map_or_else(String::new, |error| error.to_string());
        if said.is_empty() != says.is_empty() || !said.contains(says) {
            wrong.push(format!("{text}\nexpected {says:?}, found {said:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn the_machine_stops_before_the_tab_by_its_own_word() {
    let text = "[program]\ntab = 3\ntab-stop = \"M01\"\n";
    let made = generated(&drawing(Role::Punch, &PLATE), &settings(text), Iso);
    let lines = made.program.text.lines();
    let stops: Vec<&str> = lines.filter(|line| line.starts_with('M')).collect();
    assert_eq!(stops, ["M01", "M02"]);
}

/// A register holds one correction, however a profile comes to its words.
#[test]
fn two_corrections_are_never_in_one_register() {
    let drawing = drawing(Role::Opening, &PLATE);
    for (profile, is_made) in [
        ("", true),
        ("register = \"H9\"", true),
        ("register = \"D\"", false),
        (
            "register = \"D1\"\ncontour-begin = [\"{side} D7\", \"({register})\"]",
            false,
        ),
    ] {
        let settings = settings(&format!(
            "{THREE}[program]\ncompensation = \"controller\"\nprofile = \"s\"\n[profiles.s]\n{profile}\n"
        ));
        let paths = paths(&drawing, &settings);
        let made = Iso.write(&paths, 1.0, &settings, &mut |_, _| true);
        assert_eq!(made.is_ok(), is_made, "{profile}: {made:?}");
    }
    // Of two equal corrections it may be the same.
    let same = settings(
        "[passes]\ncorrections = [0.2, 0.15, 0.15]\nregisters = [\"D1\", \"D2\", \"D2\"]\n[program]\ncompensation = \"controller\"\n",
    );
    generated(&drawing, &same, Iso);
}
