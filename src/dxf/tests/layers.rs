//! Layers that are frozen, switched off or not plotted, invisible entities, colours.

use super::reading::findings;
use crate::analysis::is_cut;
use crate::drawing::Visibility;
use crate::dxf::Document;
use crate::settings::{Effective, from_toml};

const TABLE: &str = "0 TABLE 2 LAYER 70 4 \
     0 LAYER 2 COLD 70 1 62 3 6 CONTINUOUS 0 LAYER 2 DARK 70 0 62 -7 0 LAYER 2 AIDS 70 0 62 30 290 0 0 LAYER 2 Locked 70 4 62 1 \
     0 LAYER 2 Defpoints 70 0 62 7 0 ENDTAB";
const BLOCKS: &str = "0 BLOCK 2 B 10 0 20 0 0 CIRCLE 8 0 10 0 20 0 40 1 0 CIRCLE 8 DARK 10 5 20 0 40 1 0 CIRCLE 8 X 62 0 10 9 20 0 40 1 \
     0 CIRCLE 8 X 60 1 10 20 20 0 40 1 0 ENDBLK";

pub(super) fn with_layers(blocks: &str, entities: &str) -> String {
    let section = |name: &str, tags: &str| format!("0 SECTION 2 {name} {tags} 0 ENDSEC ");
    let parts = [
        ("HEADER", "9 $INSUNITS 70 4"),
        ("TABLES", TABLE),
        ("BLOCKS", blocks),
        ("ENTITIES", entities),
    ];
    let all: String = parts
        .iter()
        .map(|(name, tags)| section(name, tags))
        .collect();
    format!("{all}0 EOF")
        .split_whitespace()
        .map(|tag| format!("{tag}\n"))
        .collect()
}

/// Visibility and cut or not of each entity.
fn check(
    entities: &str,
    settings: &str,
    expected: &[(Visibility, bool)],
    expected_findings: &[&str],
) {
    let text = with_layers(BLOCKS, entities);
    let (settings, errors) = from_toml(settings);
    assert!(errors.is_empty(), "{errors:?}");
    let settings = Effective::of(&settings);
    let look = |document: &Document| {
        let drawing = document.drawing();
        drawing
            .order()
            .iter()
            .map(|&id| (drawing.visibility(id), is_cut(drawing, &settings, id)))
            .collect::<Vec<_>>()
    };
    let document = Document::read(text.clone().into_bytes());
    assert_eq!(look(&document), expected, "{entities}");
    assert_eq!(findings(&document), expected_findings, "{entities}");
    // A table may stand after the entities that use it.
    let (from, to) = (
        text.find("0\nSECTION\n2\nTABLES").unwrap(),
        text.find("0\nSECTION\n2\nBLOCKS").unwrap(),
    );
    let end = text.rfind("0\nEOF").unwrap();
    let late = [&text[..from], &text[to..end], &text[from..to], &text[end..]].concat();
    assert_eq!(
        look(&Document::read(late.into_bytes())),
        expected,
        "late: {entities}"
    );
}

const FROZEN: &str = r#"information at "COLD": layer COLD is frozen: 1 entity on it is not cut, unless the layer has a role ([layers])"#;

#[test]
fn what_is_not_seen_is_not_cut_and_said_once_for_each_layer() {
    use Visibility::*;
    let line = |more: &str| format!("0 LINE {more} 10 1 20 1 11 2 21 2 ");
    check(&line("8 COLD"), "", &[(Frozen, false)], &[FROZEN]);
    check(
        &line("8 cold"),
        "",
        &[(Frozen, false)],
        &[&FROZEN.replace("layer COLD", "layer cold")],
    );
    check(
        &line("8 COLD"),
        "[layers]\nCOLD = \"punch\"",
        &[(Frozen, true)],
        &[FROZEN],
    );
    check(&line("8 Locked"), "", &[(Shown, true)], &[]);
    check(
        &[line("8 DARK"), line("8 DARK")].concat(),
        "",
        &[(Off, false), (Off, false)],
        &[
            r#"information at "DARK": layer DARK is switched off: 2 entities on it are not cut, unless the layer has a role ([layers])"#,
        ],
    );
    for aid in ["AIDS", "Defpoints"] {
        let finding = format!(
            r#"information at "{aid}": layer {aid} is not plotted: 1 entity on it is cut all the same, unless its role is ignore ([layers])"#
        );
        check(
            &line(&format!("8 {aid}")),
            "",
            &[(Unplotted, true)],
            &[&finding],
        );
    }
    check(
        &line("8 A 60 1"),
        "",
        &[(Invisible, false)],
        &[r#"information at "LINE": 1 entity is invisible (group code 60): not cut"#],
    );
    // Nor where its layer has a role.
    check(
        &line("8 A 60 1"),
        "[layers]\nA = \"opening\"",
        &[(Invisible, false)],
        &[r#"information at "LINE": 1 entity is invisible (group code 60): not cut"#],
    );
    check(
        &line("8 COLD 60 1"),
        "[layers]\nCOLD = \"opening\"",
        &[(Invisible, false)],
        &[r#"information at "LINE": 1 entity is invisible (group code 60): not cut"#],
    );
    // A text is not cut anyway.
    check("0 TEXT 8 COLD 10 1 20 1 1 X", "", &[(Frozen, false)], &[]);
}

#[test]
fn a_frozen_reference_hides_all_and_one_that_is_off_what_lies_on_its_layer() {
    use Visibility::*;
    let of_part = r#"information at "DARK": layer DARK is switched off: 1 entity on it is not cut, unless the layer has a role ([layers])"#;
    let invisible = r#"information at "INSERT": 1 entity is invisible (group code 60): not cut"#;
    check(
        "0 INSERT 8 A 2 B 10 0 20 0",
        "",
        &[
            (Shown, true),
            (Off, false),
            (Shown, true),
            (Invisible, false),
        ],
        &[of_part, invisible],
    );
    check(
        "0 INSERT 8 COLD 2 B 10 0 20 0",
        "",
        &[
            (Frozen, false),
            (Frozen, false),
            (Frozen, false),
            (Invisible, false),
        ],
        &[
            &FROZEN.replace("1 entity on it is", "3 entities on it are"),
            invisible,
        ],
    );
    // A role of the layer of the reference brings back what lies on it, one of another layer nothing.
    for (role, is_cut) in [("COLD", true), ("X", false)] {
        let frozen = FROZEN.replace("1 entity on it is", "3 entities on it are");
        check(
            "0 INSERT 8 COLD 2 B 10 0 20 0",
            &format!("[layers]\n{role} = \"punch\""),
            &[
                (Frozen, is_cut),
                (Frozen, false),
                (Frozen, false),
                (Invisible, false),
            ],
            &[&*frozen, invisible],
        );
    }
    let two = of_part.replace("1 entity on it is", "2 entities on it are");
    check(
        "0 INSERT 8 DARK 2 B 10 0 20 0",
        "",
        &[
            (Off, false),
            (Off, false),
            (Shown, true),
            (Invisible, false),
        ],
        &[&two, invisible],
    );
}

#[test]
fn colours_are_those_of_the_entity_its_block_or_its_layer() {
    let circle = "10 1 20 1 40 5";
    let entities = format!(
        "0 CIRCLE 5 A 8 Locked {circle} 0 CIRCLE 5 B 8 Locked 62 5 {circle} 0 CIRCLE 5 C 8 Locked 62 5 420 255 {circle} \
         0 CIRCLE 5 D 8 Q {circle} 0 CIRCLE 5 E 8 AIDS 62 256 {circle} 0 INSERT 5 F 62 4 2 B 10 0 20 0"
    );
    let document = Document::read(with_layers(BLOCKS, &entities).into_bytes());
    let drawing = document.drawing();
    let roles = |settings: &str| {
        let settings = Effective::of(&from_toml(settings).0);
        drawing
            .order()
            .iter()
            .map(|&id| {
                if is_cut(drawing, &settings, id) {
                    'x'
                } else {
                    '-'
                }
            })
            .collect::<String>()
    };
    // A to E, then the four circles of the block, the second and the last of which are invisible.
    assert_eq!(roles(""), "xxxxxx-x-");
    assert_eq!(roles("[colors]\nred = \"ignore\""), "-xxxxx-x-");
    assert_eq!(roles("[colors]\nblue = \"ignore\""), "x--xxx-x-");
    assert_eq!(
        roles("[colors]\n\"30\" = \"ignore\"\ncyan = \"ignore\""),
        "xxxx-x---"
    );
    assert_eq!(
        roles("[colors]\nred = \"ignore\"\n[layers]\nLocked = \"punch\""),
        "xxxxxx-x-"
    );
    assert_eq!(roles("[colors]\nwhite = \"punch\""), "xxxxxx-x-");
    // Case does not matter in the name of a layer.
    assert_eq!(roles("[layers]\nLOCKED = \"ignore\""), "---xxx-x-");
    // A handle comes before layer and colour, and does not bring back an invisible entity.
    assert_eq!(
        roles("[contours]\nB = \"ignore\"\nF = \"punch\"\n[layers]\nLocked = \"punch\""),
        "x-xxxx-x-"
    );
    assert_eq!(
        roles("[contours]\nA = \"opening\"\n[colors]\nred = \"ignore\""),
        "xxxxxx-x-"
    );
}

#[test]
fn a_change_of_a_layer_reaches_what_lies_on_it() {
    let mut document =
        Document::read(with_layers("", "0 LINE 5 A 8 COLD 10 1 20 1 11 2 21 2").into_bytes());
    let flags = document.text().as_str_lossy().find("COLD\n70\n1").unwrap() + "COLD\n70\n".len();
    assert_eq!(
        document.drawing().visibility(document.drawing().order()[0]),
        Visibility::Frozen
    );
    document.edit(flags..flags + 1, "0");
    assert_eq!(
        document.drawing().visibility(document.drawing().order()[0]),
        Visibility::Shown
    );
    assert!(document.findings().is_empty());
}
