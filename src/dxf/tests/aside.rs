//! Entities drawn to be read and not cut: linetypes, layers, lone lines.

use crate::document::{Document, Source};
use crate::finding::{Severity, sentence};
use crate::settings::{Effective, from_toml};
use std::sync::Arc;

/// A plate of 100 × 60 mm with a hole, on the layer DIE; AX is drawn in CENTER2.
const TABLE: &str = "0 TABLE 2 LAYER 0 LAYER 2 AX 70 0 62 7 6 CENTER2 0 LAYER 2 DIE 70 0 62 7 6 CONTINUOUS 0 ENDTAB";
const PLATE: &str = "0 LWPOLYLINE 5 A 8 DIE 90 4 70 1 10 0 20 0 10 100 20 0 10 100 20 60 10 0 20 60 0 CIRCLE 5 B 8 DIE 10 30 20 30 40 10 ";

fn text(more: &str) -> String {
    let section = |name: &str, tags: &str| format!("0 SECTION 2 {name} {tags} 0 ENDSEC ");
    let block = "0 BLOCK 2 MARK 10 0 20 0 0 LINE 8 0 6 BYBLOCK 10 -15 20 0 11 15 21 0 0 ENDBLK";
    let all = [
        section("HEADER", "9 $INSUNITS 70 4"),
        section("TABLES", TABLE),
        section("BLOCKS", block),
        section("ENTITIES", &format!("{PLATE}{more}")),
    ];
    format!("{}0 EOF", all.concat())
        .split_whitespace()
        .map(|tag| format!("{tag}\n"))
        .collect()
}

fn opened(text: &str, settings: &str) -> Document {
    let (settings, errors) = from_toml(settings);
    assert!(errors.is_empty(), "{errors:?}");
    let source = Source::Dxf(crate::dxf::Document::read(text.as_bytes().to_vec()));
    Document::new(source, Arc::new(Effective::of(&settings)))
}

/// Handles of what is cut, and the findings above hint.
fn told(document: &mut Document) -> (Vec<String>, Vec<String>) {
    let drawing = document.drawing().unwrap().clone();
    let cut = drawing
        .entities()
        .filter(|(id, _)| document.cuts(*id))
        .map(|(_, entity)| entity.handle.to_string())
        .collect();
    let (findings, _) = document.findings(usize::MAX);
    let said = findings
        .iter()
        .filter(|finding| finding.severity < Severity::Hint)
        .map(|finding| format!("{}: {}", finding.rule.name(), sentence(finding, 1.0)));
    (cut, said.collect())
}

#[test]
fn what_is_drawn_to_be_read_is_not_cut_and_said_once() {
    let line = |more: &str, ends: &str| {
        let tags = ["10", "20", "11", "21"];
        let ends: Vec<String> = tags
            .iter()
            .zip(ends.split(' '))
            .map(|(code, number)| format!("{code} {number}"))
            .collect();
        format!("0 LINE {more} {} ", ends.join(" "))
    };
    let open = "open-contour: contour is open: its ends are ";
    let aside = |parts: &str| {
        let (entities, are) = match parts.starts_with("1 ") && !parts.contains(',') {
            true => ("1 entity", "is"),
            false => ("2 entities", "are"),
        };
        format!("unsupported-entity: {entities} {are} ignored as annotation: {parts}")
    };
    let cross = line("5 C 8 DIE", "18 30 42 30") + &line("5 D 8 DIE", "30 18 30 42");
    let lone = aside("2 lone lines within closed contours");
    let own = line("5 C 8 DIE 6 Center", "18 30 142 30");
    let of_layer = line("5 C 8 AX", "18 30 142 30");
    let dimension = line("5 C 8 DIM", "0 -5 100 -5");
    let marked = "0 INSERT 5 C 8 DIE 6 HIDDEN 2 MARK 10 30 20 30 ".to_owned();
    let (cut_c, cut_cd) = (&["A", "B", "C"][..], &["A", "B", "C", "D"][..]);
    let none = &["A", "B"][..];
    for (more, settings, cut, said) in [
        (cross.clone(), "", none, vec![lone]),
        // Somebody gave this role by handle.
        (
            cross.clone(),
            "[contours]\nC = \"both\"\nD = \"both\"",
            cut_cd,
            vec![format!("{open}24.000 mm apart"); 2],
        ),
        // Where the drawing is the wire's own path, one line may be enough.
        (
            cross,
            "[program]\ncompensation = \"none\"",
            cut_cd,
            vec!["open-contour: contour is open: its ends are 24.000 mm apart".into(); 2],
        ),
        (own.clone(), "", none, vec![aside("1 in linetype Center")]),
        (
            own.clone(),
            "[layers]\nDIE = \"both\"",
            none,
            vec![aside("1 in linetype Center")],
        ),
        (
            own,
            "[linetypes]\nCENTER = \"both\"",
            cut_c,
            vec![format!("{open}124.000 mm apart")],
        ),
        (
            of_layer.clone(),
            "",
            none,
            vec![aside("1 in linetype CENTER2")],
        ),
        (
            of_layer.clone(),
            "[layers]\nAX = \"both\"",
            cut_c,
            vec![format!("{open}124.000 mm apart")],
        ),
        (of_layer, "[layers]\nAX = \"ignore\"", none, vec![]),
        (dimension.clone(), "", none, vec![aside("1 on layer DIM")]),
        (
            dimension.clone(),
            "[layers]\nDIM = \"ignore\"",
            none,
            vec![],
        ),
        (
            dimension,
            "[layers]\nDIM = \"both\"",
            cut_c,
            vec![format!("{open}100.000 mm apart")],
        ),
        (
            marked.clone(),
            "",
            none,
            vec![aside("1 in linetype HIDDEN")],
        ),
        (marked, "[linetypes]\nhidden = \"ignore\"", none, vec![]),
        // Outside of everything, across nothing.
        (
            line("5 C 8 DIE", "200 0 240 0"),
            "",
            cut_c,
            vec![format!("{open}40.000 mm apart")],
        ),
        // A chain, and two ends that face each other, are an outline with something missing.
        (
            line("5 C 8 DIE", "60 20 90 20") + &line("5 D 8 DIE", "90 20 90 40"),
            "",
            cut_cd,
            vec![format!("{open}36.056 mm apart")],
        ),
        (
            line("5 C 8 DIE", "60 20 88 20") + &line("5 D 8 DIE", "90 22 90 50"),
            "",
            cut_cd,
            vec![format!("{open}28.000 mm apart"); 2],
        ),
        // Hatches run beside each other.
        (
            line("5 C 8 DIE", "60 20 90 50") + &line("5 D 8 DIE", "60.5 20 90 49.5"),
            "",
            none,
            vec![aside("2 lone lines within closed contours")],
        ),
        // An outline whose side has another linetype is open.
        (
            line("5 C 8 DIE", "60 20 90 20") + &line("5 D 8 DIE 6 DASHED", "90 20 60 20"),
            "",
            none,
            vec![aside(
                "1 in linetype DASHED, 1 lone line within closed contours",
            )],
        ),
    ] {
        let text = text(&more);
        let (found_cut, found) = told(&mut opened(&text, settings));
        assert_eq!(found_cut, cut, "{settings:?} {more}");
        let mut found: Vec<String> = found
            .into_iter()
            .filter(|said| !said.starts_with("self-intersection") && !said.starts_with("overlap"))
            .collect();
        found.sort();
        assert_eq!(found, said, "{settings:?} {more}");
    }
}

#[test]
fn an_edit_of_what_is_set_aside_tells_as_a_fresh_look_does() {
    let more = "0 LINE 5 C 8 DIE 6 CONTINUOUS 10 18 20 30 11 42 21 30 0 LINE 5 D 8 AX 10 200 20 0 11 240 21 0 ";
    let edits = [
        ("CONTINUOUS\n10\n18", "HIDDEN\n10\n18"),
        ("HIDDEN\n10\n18", "BYLAYER\n10\n18"),
        // The hole and the plate go from the mark, and come back.
        (
            "5\nA\n8\nDIE\n90\n4\n70\n1\n10\n0\n20\n0\n",
            "5\nA\n8\nDIE\n90\n4\n70\n1\n10\n50\n20\n0\n",
        ),
        ("10\n0\n20\n60\n", "10\n50\n20\n60\n"),
        ("40\n10\n", "40\n1\n"),
        ("10\n30\n20\n30\n40\n1\n", "10\n70\n20\n30\n40\n1\n"),
        ("10\n50\n20\n60\n", "10\n0\n20\n60\n"),
        ("8\nAX\n10\n200", "8\nDIE\n10\n200"),
        (
            "0\nLINE\n5\nD\n8\nDIE\n10\n200\n20\n0\n11\n240\n21\n0\n",
            "",
        ),
        ("6\nCENTER2\n", "6\nCONTINUOUS\n"),
    ];
    let mut text = text(more);
    let mut document = opened(&text, "");
    for (from, to) in edits {
        let at = text
            .find(from)
            .unwrap_or_else(|| panic!("{from:?} in {text}"));
        document.edit_text(at..at + from.len(), to);
        text.replace_range(at..at + from.len(), to);
        assert_eq!(
            told(&mut document),
            told(&mut opened(&text, "")),
            "{from:?}"
        );
    }
}

#[test]
fn a_polyline_in_which_a_number_is_typed_comes_back_as_it_looked() {
    let more =
        "0 LWPOLYLINE 5 C 8 DIE 6 HIDDEN 62 3 90 3 70 1 10 50 20 20 10 60 20 20 10 55 20 30 ";
    let mut text = text(more);
    let mut document = opened(&text, "");
    for (from, to) in [
        ("20\n20\n10\n60", "20\n2x\n10\n60"),
        ("20\n2x\n10\n60", "20\n21\n10\n60"),
    ] {
        let at = text.find(from).unwrap();
        // Within the vertex, as it is typed.
        let inner = at + 4..at + 5;
        document.edit_text(inner.clone(), &to[4..5]);
        text.replace_range(inner, &to[4..5]);
        assert_eq!(told(&mut document), told(&mut opened(&text, "")), "{to:?}");
    }
}
