//! What is said of a drawing that is milled speaks of the electrode, in every language.

use super::Desk;

const MILLED: &str = "side = \"opening\"\n[milling]\ntool-diameter = 1.0\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = 0.02\n";
const CUT: &str = "side = \"opening\"\ncorrection = 0.55\n";

/// The drawings of the pages have a fault of every rule.
#[test]
fn sentences_of_a_milled_drawing_speak_of_the_electrode() {
    let desk = Desk::new();
    let pictures = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pictures");
    for entry in std::fs::read_dir(pictures).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "dxf") {
            let name = path.file_name().unwrap().to_string_lossy();
            desk.write(&format!("drawn/{name}"), std::fs::read(&path).unwrap());
        }
    }
    let said = |settings: &str, tag: &str| -> Vec<String> {
        desk.write("drawn/wedm.toml", settings);
        let ended = desk.run(&format!("check drawn --output concise --lang {tag}"));
        ended
            .stdout
            .lines()
            .map(|line| line.replace("电极丝", "丝"))
            .collect()
    };
    let count =
        |said: &[String], word: &str| said.iter().filter(|line| line.contains(word)).count();
    for (tag, wire, electrode) in [("en", "wire", "electrode"), ("zh", "丝", "电极")] {
        let (milled, cut) = (said(MILLED, tag), said(CUT, tag));
        assert_eq!(count(&milled, wire), 0, "{milled:?}");
        assert_eq!(count(&cut, electrode), 0, "{cut:?}");
        assert!(count(&milled, electrode) > 30, "{milled:?}");
    }
}

/// A page of milling has the electrode's numbers and none of a wire's, where one is set beside it, too.
#[test]
fn a_page_of_milling_is_about_the_electrode() {
    let desk = Desk::new();
    let job = "[job]\nthickness = 30\nmachine-rate = 60\n[passes]\nrates = [60]\n";
    let wire = "wire-diameter = 0.18\ngap = 0.02\n";
    let milling = MILLED.replace("side = \"opening\"\n", "");
    let milling = milling.replace("= 1.0", "= 0.1");
    for (wire, job) in [("", ""), ("", job), (wire, job)] {
        desk.write(
            "wedm.toml",
            format!("side = \"opening\"\n{wire}{job}{milling}"),
        );
        let ended = desk.run("report clean.dxf --format milling -o pages");
        assert_eq!(ended.code, Some(0), "{ended:?}");
        let page = String::from_utf8(desk.read("pages/clean.html")).unwrap();
        for part in [
            "20 layers of ",
            "path of the electrode",
            "0.1000 mm beside the contour",
        ] {
            assert!(page.contains(part), "{part} with {wire}{job}: {page}");
        }
        let body = &page[page.find("<h2>").unwrap()..];
        for part in [
            "<h2>Passes",
            " min",
            "slug",
            "which costs",
            "the wire",
            ">0.0000<",
            "not set",
        ] {
            assert!(!body.contains(part), "{part} with {wire}{job}: {body}");
        }
    }
}

/// Where a wire is set, too, an electrode that is larger than its slot is found, and no program for the wire is refused for it.
#[test]
fn an_electrode_beside_a_wire_is_held_against_the_drawing() {
    let desk = Desk::new();
    let large = MILLED.replace("= 1.0", "= 9.0");
    let found = |settings: &str| {
        desk.write("wedm.toml", settings);
        let checked = desk.run("check fine.dxf --output concise");
        let line = checked.stdout.lines().next().unwrap_or_default().to_owned();
        (checked.code, line)
    };
    let circle = "0\nCIRCLE\n5\n2A\n8\n0\n10\n0\n20\n0\n40\n4\n";
    let header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
    let text = format!("{header}0\nSECTION\n2\nENTITIES\n{circle}0\nENDSEC\n0\nEOF\n");
    desk.write("fine.dxf", text);
    let (code, alone) = found(&large);
    assert!(
        code == Some(1) && alone.contains("the electrode overcuts"),
        "{alone}"
    );
    for wire in [
        "correction = 0.1\n",
        "wire-diameter = 0.18\ngap = 0.01\n",
        "[passes]\ncorrections = [0.15, 0.1]\n",
    ] {
        let settings = match wire.starts_with('[') {
            true => format!("{large}{wire}"),
            false => format!("{wire}{large}"),
        };
        let (code, line) = found(&settings);
        assert!(
            code == Some(1)
                && line.contains("error[settings]: [milling]: ")
                && line.contains("the electrode overcuts"),
            "{wire}: {line}"
        );
        let refused = desk.run("generate fine.dxf --format milling");
        assert!(
            refused.code == Some(1)
                && refused.stderr.contains("electrode")
                && !refused.stderr.contains("wire"),
            "{refused:?}"
        );
        let cut = desk.run("generate fine.dxf --format 3b");
        assert_eq!(cut.code, Some(0), "{wire}: {cut:?}");
        desk.write("wedm.toml", settings.replace("= 9.0", "= 1.0"));
        let fits = desk.run("check fine.dxf");
        assert_eq!(fits.code, Some(0), "{wire}: {fits:?}");
    }
}
