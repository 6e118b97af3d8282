//! What every command prints and how it ends, as a table.

use super::{Desk, check};

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
            "check tight.dxf --output text",
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
        (
            "check tight.dxf",
            1,
            &[
                "tight.dxf: error[small-radius]: arc R 0.080 mm is below the correction 0.100 mm",
                "(layer DIE, contour 1, 2A, segment 1, at 19.920, 0.000)",
                "against: correction 0.100 mm (default; wedm init), both sides (default), mm (drawing)",
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
        ("check chain.dxf", 1, &["chain.dxf: ", "32, segment 0"]),
        ("check inch.dxf", 1, &["arc R 0.080 mm"]),
        (
            "check narrow.dxf",
            1,
            &["narrow-slot", "2 errors, 1 warning"],
        ),
        (
            "check no_unit.dxf --output concise",
            0,
            &["information[units]", "2 notes"],
        ),
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
        ("check", 1, &["code_page.dxf: "]),
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
        ("generate clean.dxf", 1, &["!is not known: --side auto"]),
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
                "contour 1: closed, counter-clockwise, both sides, 6 segments",
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
                "3 blocks, cut 82.0 mm, 41.0 min, counted step by step it ends 0, 0 \u{b5}m from its start",
                "19.800 \u{d7} 19.800 mm",
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
