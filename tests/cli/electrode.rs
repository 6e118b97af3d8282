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
