//! What a conversion loses is said or refused.

use super::*;

#[test]
fn the_correction_is_never_lost_without_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    put(
        "part.4b",
        "B10000B0B10000GXL1\nB10000B0B40000B10000GYDDNR1\nB10000B0B10000GXL3\nDD\n",
    );
    let square = "G01 X5. Y0.\nY5.\nX-5.\nY-5.\nX5.\nY0.\n";
    put(
        "side.iso",
        &format!("G92 X0 Y0\nG90\nG41 D1\n{square}G40\nG01 X0.\nM02\n"),
    );
    put(
        "late.iso",
        &format!("G92 X0 Y0\nG90\nG01 X1. Y0.\nG41 D1\n{square}G40\nG01 X1. Y0.\nX0.\nM02\n"),
    );
    put(
        "own.iso",
        &format!("H1=0.155\nG92 X0 Y0\nG90\nG41 H1\n{square}G40\nG01 X0.\nM02\n"),
    );
    put(
        "mixed.iso",
        "G92 X0 Y0\nG90\nG01 X5. Y0.\nY5.\nG41 D1\nG01 X-5.\nY-5.\nX5.\nG40\nG01 Y0.\nX0.\nM02\n",
    );
    put(
        "calls.iso",
        "N1 G92 X0 Y0\nM98 P2 L99999\nM02\nO2\nM98 P3 L99999\nM99\nO3\nG91 G01 X.001\nM99\n",
    );
    for (from, to, said) in [
        (
            "part.4b",
            "iso",
            "line 2: a 4B program holds the part's contour",
        ),
        (
            "part.4b",
            "3b",
            "line 2: a 4B program holds the part's contour",
        ),
        (
            "side.iso",
            "3b",
            "the control adds the correction of this program (G41, G42)",
        ),
        (
            "late.iso",
            "3b",
            "the control adds the correction of this program (G41, G42)",
        ),
        (
            "mixed.iso",
            "3b",
            "the correction is switched within the contour",
        ),
        (
            "mixed.iso",
            "iso",
            "the correction is switched within the contour",
        ),
        (
            "own.iso",
            "4b",
            "the program's own correction H1 is 0.155 mm",
        ),
    ] {
        let (code, out, errors) = wedm(
            folder.path(),
            &format!("convert {from} --force --format {to} -o out.{to} --overwrite"),
        );
        assert_eq!(code, 1, "{from} to {to}: {out}{errors}");
        assert!(errors.contains(said), "{from} to {to}: {errors}");
        assert!(!folder.path().join(format!("out.{to}")).exists());
    }
    // Nor what a program does after the calls that are followed.
    let (code, _, errors) = wedm(folder.path(), "convert calls.iso --format 3b -o out.calls");
    let said = "line 5: the program is not followed as a whole";
    assert!(code == 1 && errors.contains(said), "{errors}");
    for (from, to, said) in [
        (
            "part.4b",
            "dxf",
            "at a correction of 0.1000 mm beside the wire's path",
        ),
        ("late.iso", "dxf", "the correction is not in them"),
        ("own.iso", "iso --profile generic", "H1 = 0.155 mm"),
    ] {
        let (code, out, errors) = wedm(
            folder.path(),
            &format!("convert {from} --force --format {to} -o out.x --overwrite"),
        );
        let all = format!("{out}{errors}");
        assert_eq!(code, 0, "{from} to {to}: {all}");
        assert!(all.contains(said), "{from} to {to}: {all}");
    }
}

/// What tilts the wire is not in a conversion: nothing is made of it unless somebody forces it, and then it is said. Planes by which
/// nothing leans lose nothing but their words.
#[test]
fn a_taper_is_dropped_only_where_it_is_forced() {
    let folder = tempfile::tempdir().unwrap();
    for (name, words, end, leans) in [
        ("angle", "G51 A2.\n", "G50\n", true),
        ("right", "G52 A0.5\n", "G50\n", true),
        ("guides", "", "G01 X5. Y5. U0.3 V0.\n", true),
        ("no-angle", "G51\n", "", true),
        ("planes", "TP0.\nTN40.\n", "", false),
    ] {
        let text = format!(
            "G92 X0 Y0\nG90\n{words}G01 X5. Y0.\nY5.\n{end}X-5.\nY-5.\nX5.\nY0.\nX0.\nM02\n"
        );
        std::fs::write(folder.path().join("in.iso"), text).unwrap();
        std::fs::write(folder.path().join("wedm.toml"), "[job]\nthickness = 40\n").unwrap();
        for to in ["iso", "3b", "dxf"] {
            let (code, _, said) = wedm(
                folder.path(),
                &format!("convert in.iso -o {name}.{to} --overwrite"),
            );
            assert_eq!(code, i32::from(leans), "{name} as {to}: {said}");
            assert_eq!(folder.path().join(format!("{name}.{to}")).exists(), !leans);
            assert_eq!(said.contains("--force"), leans, "{name} as {to}: {said}");
            let (code, _, said) = wedm(
                folder.path(),
                &format!("convert in.iso --force -o {name}.{to} --overwrite"),
            );
            assert_eq!(code, 0, "{name} as {to}: {said}");
            assert!(said.contains("not written: the taper"), "{said}");
        }
    }
}

/// A move that only the control knows is not left out of a program, whatever the settings say of such lines.
#[test]
fn a_line_that_cannot_be_read_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [
        (
            "variable.iso",
            "G92 X0 Y0\nG90\nG01 X3. Y-7.\nG01 X#1 Y2.\nG01 X7. Y3.\nG01 X0. Y0.\nM02\n",
        ),
        (
            "damaged.3b",
            "B9900B0B9900GXL1\nB9900BB\nB9900B0B9900GXL3\nDD\n",
        ),
    ] {
        for level in ["error", "warning", "off"] {
            let settings = format!("[rules]\nsyntax = \"{level}\"\n");
            std::fs::write(folder.path().join("wedm.toml"), settings).unwrap();
            std::fs::write(folder.path().join(name), text).unwrap();
            for to in ["3b", "iso", "dxf"] {
                let arguments = format!("convert {name} -o new.{to} --overwrite");
                let (code, out, said) = wedm(folder.path(), &arguments);
                assert_eq!(code, 1, "{arguments}, {level}: {out}{said}");
                let says = if level == "error" {
                    "1 error"
                } else {
                    "cannot be read"
                };
                assert!(said.contains(says), "{arguments}, {level}: {out}{said}");
                assert!(!folder.path().join(format!("new.{to}")).exists());
            }
        }
    }
}

#[test]
fn the_command_converts_and_refuses() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    put(
        "hole.3b",
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n",
    );
    put(
        "off.iso",
        "G92 X0 Y0\nG91\nG01 X1000\nG02 X1000 I400 J0\nG01 X-2000\nM02\n",
    );
    put("empty.3b", "DD\n");
    put("part.dxf", "0\nEOF\n");
    let check = |arguments: &str, code: i32, expected: &str| {
        let (ended, stdout, stderr) = wedm(folder.path(), arguments);
        assert!(
            ended == code && (stdout.contains(expected) || stderr.contains(expected)),
            "{arguments}: {ended}\n{stdout}\n{stderr}"
        );
    };
    check(
        "convert hole.3b -o hole.dxf",
        0,
        "written hole.dxf: 1 contour",
    );
    check(
        "convert hole.3b -o hole.iso --overwrite --profile fast-wire",
        0,
        "written hole.iso: 4 blocks, 1 contour",
    );
    check(
        "convert hole.iso -o again.3b --layout checking",
        0,
        "written again.3b: 4 blocks",
    );
    check(
        "convert hole.3b --format iso --profile robofil",
        0,
        "G03 X-9.900 Y0.000 I0.000 J0.000",
    );
    // A part's contour under G42, its corners rounded, becomes 4B; a path of the wire does not say where the part is.
    put(
        "part.iso",
        "G92 X0. Y-5.\nG90\nG42 D1\nG01 X0. Y0.\nX9. Y0.\nG03 X10. Y1. I0. J1.\nG01 Y10.\nX-10. Y10.\nY0.\nX0.\nG40\nG01 Y-5.\nM02\n",
    );
    check(
        "convert part.iso -o part.4b --overwrite --correction 0.15",
        0,
        "written part.4b: 11 blocks, 1 contour",
    );
    let four_b = std::fs::read_to_string(folder.path().join("part.4b")).unwrap();
    assert!(
        four_b.contains("B0B1000B1000B1000GYDNR4\n") && four_b.contains("B151GYDNR"),
        "{four_b}"
    );
    check("check part.4b", 0, "1 file checked");
    check(
        "convert part.4b -o again.dxf",
        0,
        "written again.dxf: 1 contour",
    );
    check(
        "convert hole.3b -o hole.4b",
        1,
        "4B holds the part's contour",
    );
    check(
        "convert hole.3b --format 4b",
        1,
        "wedm generate DRAWING --format 4b",
    );
    check("convert off.iso -o off.dxf", 1, "the program has 1 error");
    check(
        "convert off.iso -o off.dxf --overwrite --force",
        0,
        "left out, since they lead nowhere: lines 4",
    );
    check("convert empty.3b -o empty.dxf", 1, "it cuts nothing");
    // No end is written where the rest is missing; a contour that is whole lacks nothing but the end.
    let without_end = |name: &str, whole: &str, lines: usize| {
        let text: Vec<&str> = whole.lines().take(lines).collect();
        std::fs::write(folder.path().join(name), text.join("\n") + "\n").unwrap();
    };
    let whole = "B1000B0B1000GXL1\nB0B5000B5000GYL2\nB5000B0B5000GXL1\nB0B5000B5000GYL4\nB5000B0B5000GXL3\nB1000B0B1000GXL3\n";
    without_end("cut_off.3b", whole, 3);
    without_end("no_end.3b", whole, 6);
    let whole = "G92 X0 Y0\nG90\nG01 X1. Y0.\nX1. Y5.\nX6. Y5.\nX6. Y0.\nX1. Y0.\nX0. Y0.\n";
    without_end("cut_off.iso", whole, 5);
    without_end("no_end.iso", whole, 8);
    check(
        "convert cut_off.3b -o forced.iso --force",
        0,
        "written forced.iso",
    );
    check(
        "convert cut_off.3b -o x.iso",
        1,
        "line 3: the program breaks off there",
    );
    check(
        "convert cut_off.iso -o x.3b",
        1,
        "line 5: the program breaks off there",
    );
    check(
        "convert no_end.3b -o no_end_3b.iso",
        0,
        "written no_end_3b.iso",
    );
    check(
        "convert no_end.iso -o no_end_iso.3b",
        0,
        "written no_end_iso.3b",
    );
    check("convert part.dxf -o part.3b", 2, "it is a drawing");
    check(
        "convert hole.3b -o hole.step",
        2,
        "\"step\" is not written, expected dxf, ",
    );
    check("convert hole.3b -o hole", 2, "no ending");
    check("convert hole.3b", 2, "expected -o OUT or --format");
    let iso = std::fs::read_to_string(folder.path().join("hole.iso")).unwrap();
    assert_eq!(
        iso,
        "G92 X0 Y0\nG91\nG01 X9900 Y0\nG03 X-19800 Y0 I-9900 J0\nG03 X19800 Y0 I9900 J0\nG01 X-9900 Y0\nM02\n"
    );
    check("check hole.iso again.3b", 0, "2 files checked");
}

/// What stands beside the moves is told of where it is left out; what moves the wire elsewhere is refused.
#[test]
fn words_beside_the_moves_are_not_lost_without_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let square =
        |words: &str| format!("G92 X0 Y0\nG90\nG01 X5. Y0.{words}X-5.\nY-5.\nX5.\nY0.\nX0.\nM02\n");
    let words = "words of the machine: ";
    for (beside, said) in [
        ("\nY5.\n", ""),
        (
            "\nM50\nY5.\nM80\n",
            &*format!("{words}M50 (line 4), M80 (line 6)"),
        ),
        (" F3.\nY5. F2.\n", &format!("{words}F3. (line 3)\n")),
        (
            "\nG04 X2.\nT84\nY5.\n",
            &format!("{words}G04 (line 4), T84 (line 5)"),
        ),
        ("\n/Y5.\n", "lines 4: the new program always cuts them"),
        ("\nY5. (the corner)\n", "not written: the comments"),
        ("\nG28\nY5.\n", "line 4: G28 moves the wire"),
        ("\nY5.\nG53 X0 Y0\n", "line 5: G53 moves the wire"),
    ] {
        std::fs::write(folder.path().join("in.iso"), square(beside)).unwrap();
        let is_refused = said.contains("moves the wire");
        for to in ["iso", "3b", "dxf"] {
            let arguments = format!("convert in.iso --format {to} -o out.{to} --overwrite");
            let (code, _, told) = wedm(folder.path(), &arguments);
            assert_eq!(code, i32::from(is_refused), "{beside:?} as {to}: {told}");
            let is_told = !said.is_empty();
            assert_eq!(
                told.contains("not written") || is_refused,
                is_told,
                "{told}"
            );
            assert!(
                !is_told || told.contains(said),
                "{beside:?} as {to}: {told}"
            );
            if is_refused {
                let (code, _, told) = wedm(folder.path(), &format!("{arguments} --force"));
                let is_told = told.contains("not written: words of the machine: G");
                assert!(code == 0 && is_told, "{told}");
            }
        }
    }
    let remark = "B9900B0B9900GXL1 ; in\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n";
    std::fs::write(folder.path().join("hole.3b"), remark).unwrap();
    let (code, _, told) = wedm(folder.path(), "convert hole.3b -o hole.iso --overwrite");
    assert!(
        code == 0 && told.contains("not written: the comments"),
        "{told}"
    );
}

/// What plans a path has nothing to plan where a program holds its own.
#[test]
fn options_that_a_conversion_does_not_follow_are_not_offered() {
    let folder = tempfile::tempdir().unwrap();
    let hole = "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n";
    std::fs::write(folder.path().join("hole.3b"), hole).unwrap();
    for option in [
        "direction cw",
        "entry 1,1",
        "thread 1,1",
        "lead arc",
        "lead-in 2",
        "tab 3",
        "passes 0.15,0.12",
        "compensation controller",
        "corner arc",
        "order short",
        "start-hole 1",
        "side opening",
    ] {
        for to in ["iso", "3b", "4b", "dxf"] {
            let arguments =
                format!("convert hole.3b --format {to} -o out.{to} --overwrite --{option}");
            let (code, _, told) = wedm(folder.path(), &arguments);
            assert!(
                code == 2 && told.contains("unexpected argument"),
                "{arguments}: {told}"
            );
        }
    }
    for (option, to, code, said) in [
        ("correction 0.2", "iso", 2, "--correction is for 4B, to it"),
        ("correction 0.2", "dxf", 0, "--correction does nothing here"),
        ("layout checking", "iso", 0, "--layout does nothing here"),
        ("layout checking", "3b", 0, ""),
        ("digits 4", "dxf", 0, "--digits does nothing here"),
        ("digits 4", "3b", 0, ""),
        ("profile robofil", "3b", 0, "--profile does nothing here"),
        ("profile robofil", "iso", 0, ""),
        ("end E", "3b", 0, ""),
    ] {
        let arguments = format!("convert hole.3b --format {to} -o out.{to} --overwrite --{option}");
        let (ended, _, told) = wedm(folder.path(), &arguments);
        assert_eq!(ended, code, "{arguments}: {told}");
        assert_eq!(
            told.contains("does nothing"),
            said.contains("does nothing"),
            "{told}"
        );
        assert!(told.contains(said), "{arguments}: {told}");
    }
    // The keys of a file are for all commands.
    let keys = "correction = 0.2\nside = \"opening\"\n[program]\ndirection = \"cw\"\ntab = 3\n";
    std::fs::write(folder.path().join("wedm.toml"), keys).unwrap();
    let (code, _, told) = wedm(folder.path(), "convert hole.3b -o hole.iso --overwrite");
    assert!(code == 0 && !told.contains("does nothing"), "{told}");
}

/// Numbers that are long for the controller that is written for are no fault of the source.
#[test]
fn blocks_that_are_long_for_other_digits_are_split() {
    let folder = tempfile::tempdir().unwrap();
    let long = "B25000B0B25000GXL1\nB0B12000B12000GYL2\nB25000B12000B25000GXL3\nDD\n";
    std::fs::write(folder.path().join("long.3b"), long).unwrap();
    for (to, blocks) in [("3b", 8), ("iso", 3)] {
        let arguments = format!("convert long.3b --format {to} -o new.{to} --overwrite --digits 4");
        let (code, _, told) = wedm(folder.path(), &arguments);
        let said = format!("written new.{to}: {blocks} blocks");
        assert!(code == 0 && told.contains(&said), "{arguments}: {told}");
    }
    std::fs::write(folder.path().join("wedm.toml"), "[program]\ndigits = 4\n").unwrap();
    let (code, out, told) = wedm(folder.path(), "check new.3b");
    assert!(code == 0 && !out.contains("too-many-digits"), "{out}{told}");
    // A number that no usual controller takes is more likely wrong than long.
    let odd = "B2500000B0B2500000GXL1\nB2500000B0B2500000GXL3\nDD\n";
    std::fs::write(folder.path().join("odd.3b"), odd).unwrap();
    let (code, out, told) = wedm(folder.path(), "convert odd.3b -o odd.iso --overwrite");
    let all = format!("{out}{told}");
    assert!(code == 1 && all.contains("too-many-digits"), "{all}");
}

/// Arcs of a post with two decimals: their ends lie on two circles about their centres, up to as far apart as the rules let pass.
#[test]
fn arcs_with_rounded_centres_are_fitted() {
    let folder = tempfile::tempdir().unwrap();
    for (name, arcs) in [
        ("a", "G01 X5.00 Y0.\nG03 X3.54 Y3.54 I-5.00 J0.\n"),
        ("spiral", "G01 X5. Y0.\nG03 X0. Y5.02 I-5. J0.\n"),
        ("half", "G01 X5. Y0.\nG03 X-5.02 Y0. I-5. J0.\n"),
        ("long", "G01 X5. Y0.\nG03 X4.85 Y-1.25 I-5. J0.\n"),
        (
            "real",
            "G01 X7.31 Y0.\nG03 X5.29 Y5.05 I-7.31 J0.00\nG03 X0.34 Y7.30 I-5.29 J-5.05\nG03 X-4.79 Y5.52 I-0.34 J-7.30\n",
        ),
    ] {
        let text = format!("G90 G21\nG92 X0. Y0.\n{arcs}G01 X0. Y0.\nM02\n");
        std::fs::write(folder.path().join("in.iso"), text).unwrap();
        for to in ["iso", "3b", "dxf"] {
            // A drawing of the same name would be compared with the programs.
            let arguments = format!("convert in.iso -o {name}-{to}.{to} --overwrite");
            let (code, _, told) = wedm(folder.path(), &arguments);
            assert_eq!(code, 0, "{arguments}: {told}");
        }
        let (code, _, told) = wedm(folder.path(), &format!("check {name}-iso.iso {name}-3b.3b"));
        assert_eq!(code, 0, "{name}: {told}");
    }
}

/// Where a full circle alone leaves open what I and J mean, the profile of the new program does not decide it: half of R 10 about the
/// origin leads to (-10, 0).
#[test]
fn the_profile_of_the_new_program_does_not_say_how_the_given_one_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let text = "G21\nG90\nG92 X0. Y0.\nG01 X10. Y0.\nG03 I-10. J0.\nG01 X0. Y0.\nM02\n";
    std::fs::write(folder.path().join("in.iso"), text).unwrap();
    for (profile, half) in [
        ("robofil", "G03 X-10.000 Y0.000 I0.000 J0.000"),
        ("generic", "G03 X-10.000 Y0.000 I-10.000 J0.000"),
        ("fast-wire", "G03X-20000Y0I-10000J0"),
    ] {
        let arguments = format!("convert in.iso --format iso --profile {profile}");
        let (code, out, said) = wedm(folder.path(), &arguments);
        assert_eq!(code, 0, "{arguments}: {said}");
        let packed = |text: &str| text.replace(' ', "");
        assert!(packed(&out).contains(&packed(half)), "{arguments}: {out}");
    }
    // What is set for the program decides it.
    let settings = "[program]\nprofile = \"robofil\"\n";
    std::fs::write(folder.path().join("wedm.toml"), settings).unwrap();
    let arguments = "convert in.iso --format iso --profile generic";
    let (code, out, said) = wedm(folder.path(), arguments);
    assert!(code == 0 && out.contains("X-30.000"), "{out}{said}");
}
