//! What changes the way of the wire and is not followed is refused, and said where it is forced.

use super::*;

/// The first word that nobody follows, and its line; none where all are followed.
type Told = Option<(&'static str, usize)>;

/// Programs by name. A and B stand for the two parts of a contour.
const PROGRAMS: [(&str, &str, Told); 65] = [
    (
        "a call of nothing",
        "A\nM98 P7777\nB",
        Some(("M98 P7777", 7)),
    ),
    (
        "a call without a number",
        "A\nM98 H100\nB",
        Some(("M98 H100", 7)),
    ),
    (
        "a call of a subprogram that is named by L",
        "A\nM98 P200\nB\nM02\nL200\nG01 X3.\nM99",
        Some(("M98 P200", 7)),
    ),
    (
        "a call that is followed",
        "A\nM98 P1 L2\nB\nM02\nO1\nG91 G01 X.5\nG90\nM99",
        None,
    ),
    (
        "a subprogram by a label",
        "A\nM98P0005\nB\nM02\nN5\nG91 G01 X.5\nG90\nM99",
        None,
    ),
    (
        "K times",
        "A\nM98 P1 K3\nB\nM02\nO1\nG91 G01 X.5\nG90\nM99",
        Some(("M98 P1 K3", 7)),
    ),
    (
        "L of a variable",
        "A\nM98 P1 L#3\nB\nM02\nO1\nG91 G01 X.5\nG90\nM99",
        Some(("M98 P1 L#3", 7)),
    ),
    (
        "missing in a subprogram",
        "A\nM98 P1\nB\nM02\nO1\nM98 P2\nM99",
        Some(("M98 P2", 13)),
    ),
    (
        "the Chinese call",
        "A\nM96 SUB1.\nB\nM02\nSUB1.\nG01 X3.\nM97",
        Some(("M96 SUB1.", 7)),
    ),
    ("a jump back", "A\nB\nM99 P5", Some(("M99 P5", 10))),
    ("a jump", "A\nGOTO5\nB", Some(("GOTO5", 7))),
    (
        "a jump of another control",
        "A\nJUMP 5\nB",
        Some(("JUMP 5", 7)),
    ),
    (
        "a condition",
        "A\nif #1 eq 2\nB\nENDIF",
        Some(("IF #1 EQ 2", 7)),
    ),
    ("its other case", "A\nELSE\nB", Some(("ELSE", 7))),
    ("a return", "A\nRETURN\nB", Some(("RETURN", 7))),
    (
        "a loop of another control",
        "A\nLOOP 3\nB",
        Some(("LOOP 3", 7)),
    ),
    (
        "a call by name",
        "A\nGOSUB 7 X5.\nB",
        Some(("GOSUB 7 X5.", 7)),
    ),
    (
        "a shift by name",
        "A\nSHIFT X5. Y0.\nB",
        Some(("SHIFT X5. Y0", 7)),
    ),
    ("a mirror by name", "A\nMIRROR X\nB", Some(("MIRROR X", 7))),
    (
        "a repeated block",
        "A\nG91 G01 X1. L3\nG90\nB",
        Some(("L3", 7)),
    ),
    ("a name, or a call", "L100\nA\nB", Some(("L100", 3))),
    ("mirror in X", "G05\nA\nB", Some(("G05", 3))),
    ("mirror in Y", "A\nG06\nB", Some(("G06", 7))),
    ("axes exchanged", "A\nG7\nB", Some(("G7", 7))),
    ("both mirrors", "A\nG08\nB", Some(("G08", 7))),
    ("mirror and exchange", "A\nG09\nB", Some(("G09", 7))),
    ("another of them", "A\nG10\nB", Some(("G10", 7))),
    ("the last of them", "A\nG11\nB", Some(("G11", 7))),
    ("mirrors off", "G12\nA\nB", None),
    ("fast feed", "G05 P10000\nG08 P1\nA\nB", None),
    ("a value of the table", "G10 P1 R0.155\nA\nB", None),
    (
        "a shifted zero",
        "A\nG10 L2 P1 X5. Y0.\nB",
        Some(("G10", 7)),
    ),
    ("mirror", "A\nG51.1 X5.\nB", Some(("G51.1", 7))),
    ("mirror off", "A\nG50.1\nB", None),
    ("turned", "A\nG68 R45.\nB", Some(("G68", 7))),
    ("polar", "A\nG16\nB", Some(("G16", 7))),
    ("another plane", "G18\nA\nB", Some(("G18", 3))),
    ("its own plane", "G17\nA\nB", None),
    ("a local zero", "A\nG52 X5. Y0.\nB", Some(("G52", 7))),
    ("one zero", "G54\nA\nG54\nB", None),
    ("one zero of another number", "G55\nA\nG55\nB", None),
    ("two zeros", "G54\nA\nG55\nB", Some(("G55", 8))),
    ("the second zero", "A\nG55\nB", Some(("G55", 7))),
    (
        "a zero of a table",
        "G54.1 P1\nA\nG54.1 P2\nB",
        Some(("G54.1", 8)),
    ),
    (
        "another zero behind a call",
        "G54\nM98 P1\nG55\nM98 P1\nM02\nO1\nA\nB\nM99",
        Some(("G55", 5)),
    ),
    ("a shift", "A\nG93 X5. Y0.\nB", Some(("G93", 7))),
    ("feed in minutes", "A\nG93 G01 X5. Y5.\nB", None),
    ("canceled cycles", "G40 G80\nA\nB", None),
    (
        "a call by G22",
        "A\nG22 L100\nB\nM02\nL100\nG01 X3.\nG23",
        Some(("G22", 7)),
    ),
    ("P by itself", "A\nP20001\nB", Some(("P20001", 7))),
    ("L by itself", "A\nL100\nB", Some(("L100", 7))),
    ("a macro of M", "A\nM198 P5\nB", Some(("M198", 7))),
    ("corners", "A\nG48 R0.5\nB", Some(("G48", 7))),
    ("G of nobody", "A\nG117\nB", Some(("G117", 7))),
    ("a zero without a point", "A\nG92.1\nB", Some(("G92.1", 7))),
    (
        "a mirror of another control",
        "A\nMIRX\nB",
        Some(("MIRX", 7)),
    ),
    ("a move by name", "A\nMOV X1.\nB", Some(("MOV", 7))),
    ("a turn by name", "A\nRA90.\nB", Some(("RA90.", 7))),
    ("an axis that turns", "A\nB90.\nB", Some(("B90.", 7))),
    ("an upright wire", "G50 A0\nA\nB", None),
    (
        "a zero of the system",
        "A\n#5221=1.\nB",
        Some(("#5221=1.", 7)),
    ),
    ("a constant", "#1=1.\nA\nB", None),
    ("a variable of the operator", "S#500 F#9\nA\nB", None),
    (
        "a condition of the generator",
        "E0012 C007\nA\nSTOP\nB",
        None,
    ),
    ("a word of the profiles", "A\nG38\nB", None),
];

#[test]
fn what_is_not_followed_is_refused_and_said() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text, expected) in PROGRAMS {
        let line = |line: &str| match line {
            "A" => "G01 X5. Y0.\nX5. Y5.\nX-5. Y5.\nG01 X-5. Y-5.".to_owned(),
            "B" => "G01 X5. Y-5.\nX5. Y0.\nX0. Y0.".to_owned(),
            line => line.to_owned(),
        };
        let lines: Vec<String> = text.lines().map(line).collect();
        let text = format!("G92 X0 Y0\nG90\n{}\nM02\n", lines.join("\n"));
        std::fs::write(folder.path().join("in.iso"), &text).unwrap();
        for to in ["iso", "3b", "dxf"] {
            let arguments = format!("convert in.iso --format {to} -o out.{to} --overwrite");
            let out = folder.path().join(format!("out.{to}"));
            _ = std::fs::remove_file(&out);
            let (code, _, told) = wedm(folder.path(), &arguments);
            let Some((word, line)) = expected else {
                assert_eq!(code, 0, "{name} as {to}: {told}");
                assert!(!told.contains("not there"), "{name} as {to}: {told}");
                continue;
            };
            // A taper is said first.
            let is_told = told.contains(&format!("line {line}: {word} ")) || word == "G52";
            assert!(code == 1 && is_told, "{name} as {to}: {told}\n{text}");
            assert!(
                told.contains("--force") && !out.exists(),
                "{name} as {to}: {told}"
            );
            let (code, _, told) = wedm(folder.path(), &format!("{arguments} --force"));
            let said = "written as if these words were not there: ";
            let is_told = told.contains(said) && told.contains(&format!("{word} (line {line})"));
            assert!(code == 0 && is_told, "{name} as {to}: {told}");
        }
    }
}
