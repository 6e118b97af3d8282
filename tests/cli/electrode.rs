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
