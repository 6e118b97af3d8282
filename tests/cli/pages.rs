//! `wedm report`: pages that need nothing beside them.

use super::Desk;

#[test]
fn a_page_tells_what_the_other_commands_tell() {
    let desk = Desk::new();
    let hostile = "<img src=x onerror=alert(1)>.dxf";
    desk.write(&format!("more/{hostile}"), desk.read("clean.dxf"));
    desk.write("more/clean.dxf", desk.read("clean.dxf"));
    let before = desk.read("clean.dxf");
    let ended = desk.run("report clean.dxf more tight_fillet.dxf --side opening -o pages");
    assert_eq!(ended.code, Some(1), "{ended:?}");
    assert!(
        ended.stderr.contains("written 4 pages: pages/index.html"),
        "{ended:?}"
    );
    assert_eq!(desk.read("clean.dxf"), before);
    let mut names: Vec<String> = std::fs::read_dir(desk.path("pages"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names.len(), 5, "{names:?}");
    let page = |name: &str| String::from_utf8(desk.read(&format!("pages/{name}"))).unwrap();
    for name in &names {
        let text = page(name).replace("http://www.w3.org/2000/svg", "");
        assert!(
            !text.contains("http") && !text.contains("<script"),
            "{name} needs something"
        );
        assert!(!text.contains("<img"), "{name} obeys a name");
        assert!(text.ends_with("</html>\n"), "{name}");
    }
    let clean = page("clean.html");
    let program = desk.run("generate clean.dxf --side opening").stdout;
    assert!(clean.contains(program.trim_end()), "{program} in {clean}");
    for part in [
        "<svg",
        "Contours",
        "Radius list",
        "Passes",
        "nothing found",
        "decoded again",
    ] {
        assert!(clean.contains(part), "{part}");
    }
    let faulty = page("tight_fillet.html");
    for part in [
        "small-radius · ",
        "is below the correction",
        "<p class=\"error\">",
    ] {
        assert!(faulty.contains(part), "{part} in {faulty}");
    }
    // Each page stands in the index, under its own name.
    let index = page("index.html");
    for name in names.iter().filter(|name| *name != "index.html") {
        assert!(
            index.contains(&format!("<a href=\"{name}\">")),
            "{name} in {index}"
        );
    }
}

#[test]
fn a_report_without_a_drawing_is_refused() {
    let desk = Desk::new();
    let ended = desk.run("report hole.3b -o pages");
    assert_eq!(ended.code, Some(2), "{ended:?}");
    assert!(
        ended.stderr.contains("no drawing") && !desk.path("pages").exists(),
        "{ended:?}"
    );
}

#[test]
fn a_report_speaks_chinese() {
    let desk = Desk::new();
    let ended = desk.run("report clean.dxf --side opening -o pages --lang zh");
    assert_eq!(ended.code, Some(0), "{ended:?}");
    let page = String::from_utf8(desk.read("pages/clean.html")).unwrap();
    assert!(
        page.contains("<html lang=\"zh\">") && page.contains("半径表"),
        "{page}"
    );
}

#[test]
fn a_page_tells_times_holes_and_whether_the_parts_fit() {
    let desk = Desk::new();
    let job = "wire-diameter = 0.2\ngap = 0.02\ncorrection = 0.12\n[passes]\nrates = [100]\n[job]\nthickness = 40\n";
    desk.write(
        "wedm.toml",
        format!("side = \"opening\"\n{job}[program]\nstart-hole = 2\n"),
    );
    let ended = desk.run("report clean.dxf -o pages");
    assert_eq!(ended.code, Some(0), "{ended:?}");
    let page = |name: &str| String::from_utf8(desk.read(&format!("pages/{name}"))).unwrap();
    let clean = page("clean.html");
    for part in [
        "Time and material",
        " min</p>",
        "slug g",
        "largest wire: Ø ",
        "not known, since not set: job.machine-rate",
        "Start holes",
        "found</td>",
        "class=\"kerf\"",
        "class=\"hole\"",
    ] {
        assert!(clean.contains(part), "{part} in {clean}");
    }
    assert!(!clean.contains("<h2>Fit"), "{clean}");
    assert!(page("index.html").contains(">time</th>"));
    // The holes of the page are those of the drill list.
    let list = desk.run("holes clean.dxf").stdout;
    let row = list.lines().nth(1).unwrap();
    let [x, y] = [1, 2].map(|column| row.split(',').nth(column).unwrap());
    assert!(
        clean.contains(&format!(">{x}</td><td class=\"number\">{y}<")),
        "{row} in {clean}"
    );
    desk.write(
        "wedm.toml",
        format!("{job}[pair]\nclearance = 0.001\ndrawn-as = \"punch\"\n"),
    );
    desk.run("report clean.dxf -o pages");
    let pair = page("clean.html");
    for part in ["<h2>Fit</h2>", "mm left"] {
        assert!(pair.contains(part), "{part} in {pair}");
    }
}

/// A page says one correction and one length, wherever the control offsets.
#[test]
fn a_page_tells_what_the_control_offsets_by() {
    let desk = Desk::new();
    for (options, shown) in [
        (
            "--format iso --compensation controller --correction 0.09",
            &["0.0900", "correction 0.090 mm", "D1 = 0.0900 mm"][..],
        ),
        (
            "--format iso --compensation controller --passes 0.09,0.05",
            &["0.0900", "0.0500", "D2 = 0.0500 mm"],
        ),
        (
            "--format 4b --correction 0.09",
            &["0.0900", "correction = 0.0900 mm"],
        ),
    ] {
        let ended = desk.run(&format!(
            "report clean.dxf --side opening -o pages {options}"
        ));
        assert_eq!(ended.code, Some(0), "{ended:?}");
        let page = String::from_utf8(desk.read("pages/clean.html")).unwrap();
        for part in shown {
            assert!(page.contains(part), "{part} in {page}");
        }
        assert!(
            !page.contains(">0.0000<") && !page.contains("correction 0.000"),
            "{page}"
        );
        // In the head of the picture, beside the times and in the proof of the program.
        let cut = page.split("cut ").skip(1);
        let cut = cut.filter_map(|rest| Some(rest.split_once(" mm")?.0));
        let lengths: std::collections::BTreeSet<&str> =
            cut.filter(|figure| figure.parse::<f64>().is_ok()).collect();
        assert_eq!(lengths.len(), 1, "{lengths:?} {options}");
    }
}

#[test]
fn a_contour_on_a_page_has_its_handle() {
    let desk = Desk::new();
    desk.run("report clean.dxf --side opening -o pages");
    let page = String::from_utf8(desk.read("pages/clean.html")).unwrap();
    assert!(
        page.contains("<td class=\"number\">1</td><td class=\"\">2A</td>"),
        "{page}"
    );
}

/// Where no hole has room, none is listed and none is drawn; the page says what it was made with.
#[test]
fn a_page_has_the_holes_of_the_drill_list_and_says_what_it_was_made_with() {
    let desk = Desk::new();
    let slot = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/pictures/slot.dxf");
    desk.write("slot.dxf", std::fs::read(slot).unwrap());
    desk.write(
        "wedm.toml",
        "side = \"opening\"\nwire-diameter = 0.18\ngap = 0.01\n[program]\nstart-hole = 2.0\nprofile = \"robofil\"\n",
    );
    let listed = desk.run("holes slot.dxf");
    assert_eq!(listed.stdout.lines().count(), 1, "{listed:?}");
    desk.run("report slot.dxf clean.dxf --format iso -o pages");
    let page = |name: &str| String::from_utf8(desk.read(&format!("pages/{name}"))).unwrap();
    let slot = page("slot.html");
    assert!(
        !slot.contains("Start holes") && !slot.contains("class=\"hole\""),
        "{slot}"
    );
    let clean = page("clean.html");
    for part in [
        "Start holes",
        "class=\"hole\"",
        concat!("wedm ", env!("CARGO_PKG_VERSION")),
        "wire Ø 0.18 mm · gap 0.01 mm · profile robofil",
        "<a href=\"index.html\">all drawings</a>",
        "<p>ISO: ",
    ] {
        assert!(clean.contains(part), "{part} in {clean}");
    }
}

/// A severity has one colour on a page, and a fault of settings that all drawings share is said once.
#[test]
fn a_warning_looks_like_one_everywhere_and_shared_faults_are_said_once() {
    let desk = Desk::new();
    desk.write(
        "wedm.toml",
        "side = \"opening\"\n[rules]\nsmall-radius = \"warning\"\n",
    );
    desk.run("report tight.dxf -o pages");
    let page = String::from_utf8(desk.read("pages/tight.html")).unwrap();
    assert!(
        page.contains("<td class=\"warning\">small-radius</td>"),
        "{page}"
    );
    desk.write("wedm.toml", "side = 3\n");
    let ended = desk.run("report clean.dxf tight.dxf inch.dxf -o pages");
    assert_eq!(ended.code, Some(2), "{ended:?}");
    assert_eq!(ended.stderr.matches("side is 3").count(), 1, "{ended:?}");
    assert_eq!(
        ended
            .stderr
            .matches("nothing is made with settings")
            .count(),
        1,
        "{ended:?}"
    );
}

/// What each wire of the shop's table takes, and which places keep it out.
#[test]
fn a_page_says_what_small_radii_cost() {
    let desk = Desk::new();
    let wires = "side = \"opening\"\n[job]\nthickness = 40\nmachine-rate = 60\nwires = [0.25, 0.08]\nwire-gaps = [0.03, 0.01]\nwire-rates = [100, 20]\n";
    desk.write("wedm.toml", wires);
    let page = |desk: &Desk| {
        desk.run("report tight.dxf -o pages");
        String::from_utf8(desk.read("pages/tight.html")).unwrap()
    };
    let priced = page(&desk);
    for part in [
        "<h2>What small radii cost</h2>",
        "<th class=\"number\">wire Ø mm</th>",
        "<td class=\"number\">0.155</td>",
        "1 place: ",
        "cuts this drawing in the least time",
    ] {
        assert!(priced.contains(part), "{part} in {priced}");
    }
    desk.write("wedm.toml", wires.replace("thickness = 40\n", ""));
    assert!(!page(&desk).contains("What small radii cost"));
}

/// A drawing of closed squares, each with its handle, the left edge and the length of its sides.
fn squares(all: &[(&str, f64, f64)]) -> String {
    let square = |&(handle, x, side): &(&str, f64, f64)| {
        let corners = [[x, 0.0], [x + side, 0.0], [x + side, side], [x, side]];
        let corners = corners.map(|[x, y]| format!("10\n{x}\n20\n{y}\n")).concat();
        format!(
            "0\nLWPOLYLINE\n5\n{handle}\n100\nAcDbEntity\n8\n0\n100\nAcDbPolyline\n90\n4\n70\n1\n{corners}"
        )
    };
    let entities: String = all.iter().map(square).collect();
    format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n")
}

/// The contours to begin with so that nobody has to come for longest, said with the program, too.
#[test]
fn an_order_that_runs_longer_alone_is_said() {
    const JOB: &str = "side = \"opening\"\ncorrection = 0.1\n[job]\nthickness = 40\n[passes]\nrates = [100]\n[program]\norder = \"as-drawn\"\n";
    const THREADS: &str =
        "format = \"iso\"\nprofile = \"own\"\n[profiles.own]\npause = [\"M50\", \"M60\"]\n";
    let rows = [
        // The machine waits behind each contour: the longest one first.
        (
            JOB.to_owned(),
            "would run alone for 1 h 06 min, begun with contour A1 (order of",
        ),
        // It threads by itself and stops before each tab.
        (
            format!(
                "{}tab = 2\ntab-stop = \"M00\"\n{THREADS}",
                JOB.replace("[passes]", "slug-limit = 10\n[passes]")
            ),
            "would run alone for 1 h 0",
        ),
        (format!("{JOB}{THREADS}"), "runs alone to its end"),
    ];
    for (settings, expected) in rows {
        let desk = Desk::new();
        desk.write(
            "three.dxf",
            squares(&[("A0", 0.0, 10.0), ("A1", 20.0, 40.0), ("A2", 70.0, 20.0)]),
        );
        desk.write("wedm.toml", settings);
        let said = desk.run("generate three.dxf -o three.iso").stderr;
        assert!(said.contains(expected), "{expected} in {said}");
        desk.run("report three.dxf -o pages");
        let page = String::from_utf8(desk.read("pages/three.html")).unwrap();
        assert!(page.contains(expected), "{expected} in {page}");
    }
}

/// What is loose when, what falls by itself, and until when nobody is needed: of two openings, the second one with a tab or none,
/// by the machine's way to thread.
#[test]
fn a_page_says_what_happens_unattended() {
    const JOB: &str =
        "side = \"opening\"\ncorrection = 0.1\n[job]\nthickness = 40\n[passes]\nrates = [100]\n";
    const TABBED: &str = "side = \"opening\"\ncorrection = 0.1\n[job]\nthickness = 40\nslug-limit = 10\n[passes]\nrates = [100]\n";
    const PAIR: &str = "side = \"opening\"\n[job]\nthickness = 40\n[passes]\ncorrections = [0.12, 0.1]\nrates = [100, 200]\n";
    const THREADS: &str = "[program]\nformat = \"iso\"\nprofile = \"own\"\n[profiles.own]\npause = [\"M50\", \"M60\"]\n";
    let rows: [(&str, &str, &[&str], &str); 5] = [
        // 39.2 mm of path and a lead of 2.9 there and back, times 40, by 100.
        (
            JOB,
            "",
            &[
                "runs alone for 18.0",
                "contour A0, A1;",
                "slug falls 31.4 g",
                "<td class=\"\">waits</td>",
            ],
            "cut off after a stop",
        ),
        (
            TABBED,
            "[program]\ntab = 2\n",
            &[
                "runs alone for 1",
                "slug, cut off after a stop 31.4 g",
                "cut-off, pass 1",
            ],
            "falls while nobody stands by",
        ),
        (
            JOB,
            THREADS,
            &["runs alone to its end, 36.", "contour A0, A1;"],
            "runs alone for",
        ),
        // It threads by itself, and skims without a stop, but not through a tab.
        (
            PAIR,
            THREADS,
            &["runs alone to its end, "],
            "runs alone for",
        ),
        (
            PAIR,
            "[program]\nformat = \"iso\"\nprofile = \"robofil\"\n",
            &["runs alone for 26.92 min", "slug falls"],
            "to its end",
        ),
    ];
    for (job, more, parts, absent) in rows {
        let desk = Desk::new();
        desk.write("two.dxf", squares(&[("A0", 0.0, 10.0), ("A1", 20.0, 10.0)]));
        desk.write("wedm.toml", format!("{job}{more}"));
        let ended = desk.run("report two.dxf -o pages");
        let page = String::from_utf8(desk.read("pages/two.html")).unwrap();
        let night = page.split("<h2>Unattended</h2>").nth(1).unwrap_or_default();
        let night = night.split("<h2>").next().unwrap_or_default();
        for part in parts {
            assert!(night.contains(part), "{more}: {part} in {night}{ended:?}");
        }
        assert!(!night.contains(absent), "{more}: {absent} in {night}");
        // The program that is written stops where the page says that it waits.
        let program = desk.run("generate two.dxf").stdout;
        let stops = program
            .lines()
            .any(|line| line == "D" || line.contains("M00"));
        assert_eq!(
            stops,
            night.contains("then somebody has to come"),
            "{more}: {program}"
        );
    }
    // A single cut has no night of its own.
    let desk = Desk::new();
    desk.write("wedm.toml", JOB);
    desk.run("report clean.dxf -o pages");
    let page = String::from_utf8(desk.read("pages/clean.html")).unwrap();
    assert!(!page.contains("Unattended"));
}
