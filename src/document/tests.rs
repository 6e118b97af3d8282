use super::*;
use crate::finding::Severity;
use crate::settings::{Settings, from_toml};

/// Severities of what the reader finds in a sound drawing with a byte-order mark.
fn check(settings: &str, expected: &[Severity]) {
    let text = "\u{feff}0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nEOF\n";
    let (settings, errors): (Settings, _) = from_toml(settings);
    assert!(errors.is_empty(), "{errors:?}");
    let source = Source::Dxf(dxf::Document::read(text.into()));
    let (findings, _) =
        Document::new(source, Arc::new(Effective::of(&settings))).findings(usize::MAX);
    let severities: Vec<Severity> = findings.iter().map(|finding| finding.severity).collect();
    assert_eq!(severities, expected, "{settings:?}");
}

#[test]
fn an_oddity_keeps_its_own_severity_where_none_is_set() {
    check("", &[Severity::Hint]);
    check("[rules]\nsyntax = \"warning\"", &[Severity::Warning]);
    check("[rules]\nsyntax = \"off\"", &[]);
}

const PLATE: &str = "0\nSECTION\n2\nENTITIES\n\
    0\nCIRCLE\n5\n2A\n10\n0\n20\n0\n40\n5\n\
    0\nCIRCLE\n5\n2B\n10\n20\n20\n0\n40\n5\n\
    0\nCIRCLE\n5\n2C\n10\n40\n20\n0\n40\n5\n0\nENDSEC\n0\nEOF\n";

fn plate(toml: &str) -> Document {
    let (settings, errors) = from_toml(toml);
    assert!(errors.is_empty(), "{errors:?}");
    let settings = Effective::of_document(&settings, Some("plate.dxf".into()));
    Document::new(
        Source::Dxf(dxf::Document::read(PLATE.into())),
        Arc::new(settings),
    )
}

/// Sides, thread holes and order of single contours, set by handle and by a point.
#[test]
fn what_is_said_of_one_contour_holds_for_it() {
    let of = |head: &str, keys: &str| format!("[drawings.\"plate.dxf\".contours.{head}]\n{keys}\n");
    let toml = [
        "side = \"punch\"\n".to_owned(),
        of("2A", "side = \"opening\"\nthread = [1, 0]\nentry = [5, 0]"),
        of("\"40,5\"", "side = \"opening\"\norder = 1"),
        of("2B", "order = 2"),
    ];
    let document = plate(&toml.concat());
    let snapshot = document.snapshot().unwrap();
    let roles: Vec<Role> = snapshot.outlines.iter().map(|it| it.role).collect();
    assert_eq!(roles, [Role::Opening, Role::Punch, Role::Opening]);
    let paths = crate::job::planned(&snapshot, document.settings(), None, false, &())
        .unwrap()
        .paths;
    let cut: Vec<usize> = paths.iter().map(|path| path.outline).collect();
    assert_eq!(cut, [2, 1, 0]);
    assert_eq!(paths[2].thread_hole, crate::geometry::Point::new(1.0, 0.0));
    assert_eq!(
        document
            .all_findings()
            .iter()
            .filter(|it| it.rule == crate::rule::Rule::Settings)
            .count(),
        0
    );
    let nearest = plate(&(toml.concat() + "[program]\norder = \"nearest\"\n"));
    let paths = crate::job::planned(
        &nearest.snapshot().unwrap(),
        nearest.settings(),
        None,
        false,
        &(),
    )
    .unwrap()
    .paths;
    let cut: Vec<usize> = paths.iter().map(|path| path.outline).collect();
    assert_eq!(cut, [2, 1, 0]);
}

#[test]
fn a_contour_that_is_not_there_is_a_warning() {
    let document = plate(
        "side = \"punch\"\n[drawings.\"plate.dxf\".contours.2D]\norder = 1\n\
         [drawings.\"plate.dxf\".contours.\"7,7\"]\nside = \"opening\"\n\
         [drawings.\"other.dxf\".contours.2D]\norder = 1\n",
    );
    let said: Vec<String> = document
        .all_findings()
        .iter()
        .filter(|finding| finding.rule == crate::rule::Rule::Settings)
        .map(|finding| {
            assert_eq!(finding.severity, Severity::Warning);
            finding::sentence(finding, 1.0)
        })
        .collect();
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(
        said[0].contains("2D") && said[1].contains("7,7"),
        "{said:?}"
    );
}

/// A hole given on the command line replaces the one that the file sets for the contour.
#[test]
fn a_later_thread_hole_takes_the_place_of_those_of_single_contours() {
    let (file, _) =
        from_toml("[drawings.\"plate.dxf\".contours.2A]\nthread = [1, 0]\nentry = [5, 0]\n");
    let (last, _) = from_toml("[program]\nthread = [2, 0]\n");
    let laid = file.overlaid(&last);
    let said = &laid.drawings.unwrap()["plate.dxf"]
        .contours
        .clone()
        .unwrap()["2A"];
    assert_eq!((said.thread, said.entry), (None, Some([5.0, 0.0])));
}
