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
