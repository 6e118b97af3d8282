//! Drawings and their contours.

use super::*;
use crate::size::by_day;

#[test]
fn what_was_drawn_later_in_between_is_told_as_if_it_had_always_stood_there() {
    let triangle = |corners: [(f64, f64); 3]| {
        entity(
            Geometry::Polyline {
                closed: true,
                vertices: corners.map(|(x, y)| Vertex::new(x, y, 0.0)).into(),
            },
            None,
        )
    };
    let outlines = [
        triangle([(0.0, 0.0), (4.0, 4.0), (4.0, 0.0)]),
        triangle([(0.0, 4.0), (4.0, 0.0), (0.0, 0.0)]),
        triangle([(1.0, -1.0), (1.0, 5.0), (2.0, 5.0)]),
        triangle([(0.0, 0.0), (4.0, 4.0), (4.0, 0.0)]),
    ];
    let mut fresh = Drawing::new(None);
    outlines.iter().for_each(|outline| {
        fresh.push(outline.clone());
    });
    for drawn in [[3, 2, 1, 0], [2, 3, 0, 1], [1, 3, 0, 2]] {
        let mut drawing = Drawing::new(None);
        let mut stand: Vec<usize> = Vec::new();
        for at in drawn {
            let position = stand.iter().filter(|&&other| other < at).count();
            stand.push(at);
            drawing.insert_at(position, outlines[at].clone());
        }
        assert_eq!(told(&drawing), told(&fresh), "drawn as {drawn:?}");
    }
    assert!(told(&fresh).len() > 5);
}

#[test]
fn ranks_rise_in_machining_order_however_often_something_goes_in_between() {
    let mut drawing = Drawing::new(None);
    let line = entity(
        Geometry::Line {
            start: Point::origin(),
            end: Point::new(1.0, 0.0),
        },
        None,
    );
    for _ in 0..3 {
        drawing.push(line.clone());
    }
    for at in 0..200 {
        drawing.insert_at(1 + at % 2, line.clone());
    }
    let ranks: Vec<u64> = drawing.order().iter().map(|&id| drawing.rank(id)).collect();
    assert!(ranks.windows(2).all(|pair| pair[0] < pair[1]), "{ranks:?}");
}

/// Contours in the machining order of their first entities.
fn contours(drawing: &Drawing, chains: &Chains) -> Vec<Contour> {
    let mut keys: Vec<_> = drawing
        .order()
        .iter()
        .filter_map(|&id| chains.contour_of(id))
        .collect();
    let mut seen = std::collections::HashSet::new();
    keys.retain(|key| seen.insert(*key));
    keys.iter()
        .filter_map(|&key| chains.get(key).cloned())
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(120, 300)), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn many_entities_that_move_at_once_are_chained_as_if_afresh(
        start in proptest::collection::vec(geometry(), 30..60),
        moves in proptest::collection::vec(proptest::collection::vec((0..60usize, geometry(), 0..4usize), 17..40), 1..4),
        join in prop_oneof![Just(0.01), Just(0.05), Just(0.6)],
    ) {
        let mut drawing = Drawing::new(None);
        for geometry in start {
            drawing.push(entity(geometry, None));
        }
        let is_cut = |drawing: &Drawing, id: EntityId| drawing.get(id).is_some_and(|entity| entity.geometry.segment_count() > 0);
        let mut chains = Chains::new(&drawing, join, &|id| is_cut(&drawing, id));
        for batch in moves {
            let touched: Vec<EntityId> = batch
                .into_iter()
                .filter_map(|(at, geometry, kind)| {
                    let id = drawing.order().get(at).copied();
                    match (kind, id) {
                        (0, _) => Some(drawing.insert_at(at, entity(geometry, None))),
                        (1, Some(id)) => drawing.remove(id).map(|_| id),
                        (_, Some(id)) => {
                            drawing.replace(id, entity(geometry, None));
                            Some(id)
                        }
                        (_, None) => None,
                    }
                })
                .collect();
            let rechained = chains.update(&drawing, &touched, &|id| is_cut(&drawing, id));
            let fresh = Chains::new(&drawing, join, &|id| is_cut(&drawing, id));
            prop_assert_eq!(contours(&drawing, &chains), contours(&drawing, &fresh));
            prop_assert!(rechained.gone.iter().all(|&key| chains.get(key).is_none()));
            for &id in drawing.order() {
                prop_assert_eq!(chains.piece_of(id).map(|piece| piece.entity), chains.contour_of(id).map(|_| id));
            }
        }
    }
}

/// Polylines that come near themselves and each other, and a line. Those without their bit in `closed` are open; the last one lies on a
/// frozen layer.
fn typed_text(closed: u8) -> String {
    let outlines: [&[(f64, f64)]; 4] = [
        &[
            (0.0, 0.0),
            (10.0, 0.0),
            (10.0, 4.0),
            (5.1, 4.0),
            (5.1, 1.0),
            (5.0, 1.0),
            (5.0, 4.0),
            (0.0, 4.0),
        ],
        &[(0.0, 4.1), (10.0, 4.1), (10.0, 8.0), (0.0, 8.0)],
        &[(2.0, 9.0), (4.0, 9.0), (4.0, 12.0), (2.0, 9.001)],
        &[(20.0, 0.0), (21.0, 0.0), (20.5, 0.9)],
    ];
    let mut text = String::from(
        "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nOFF\n70\n1\n0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
    );
    for (number, outline) in outlines.iter().enumerate() {
        let _ = write!(
            text,
            "0\nLWPOLYLINE\n5\n{:X}\n8\n{}\n90\n{}\n70\n{}\n",
            number + 1,
            if number == 3 { "OFF" } else { "DIE" },
            outline.len(),
            closed >> number & 1
        );
        for (at, (x, y)) in outline.iter().enumerate() {
            let _ = write!(
                text,
                "10\n{x}\n20\n{y}\n42\n{}\n",
                if at % 3 == 2 { 0.4 } else { 0.0 }
            );
        }
    }
    text + "0\nLINE\n5\nA\n8\nDIE\n10\n0.0\n20\n9.0\n11\n3.0\n21\n4.05\n0\nENDSEC\n0\nEOF\n"
}

/// Findings with their places in the text, and the contours.
pub(super) fn shown(document: &mut Document) -> (Vec<String>, Vec<String>) {
    let (findings, _) = document.findings(usize::MAX);
    let line = |finding: &wedm::finding::Finding| {
        let related: Vec<_> = finding
            .related
            .iter()
            .map(|place| document.range_of(place))
            .collect();
        format!(
            "{:?} {:?} {:?} {:?} {related:?}",
            finding.rule,
            finding.severity,
            document.range_of(&finding.place),
            finding.detail
        )
    };
    let findings = findings.iter().map(line).collect();
    let Some(snapshot) = document.snapshot() else {
        return (findings, Vec::new());
    };
    let handles = |contour: &Contour| {
        let pieces = contour.pieces.iter().map(|piece| {
            snapshot
                .drawing
                .get(piece.entity)
                .map(|entity| entity.handle.to_string())
        });
        format!("{:?} {}", pieces.collect::<Vec<_>>(), contour.closed)
    };
    (
        findings,
        snapshot
            .outlines
            .iter()
            .map(|outline| handles(&outline.contour))
            .collect(),
    )
}

/// What is said of a line that is missing may depend on the lines of the next polyline.
#[test]
fn what_is_typed_behind_a_damaged_polyline_is_read_as_if_afresh() {
    let settings = Arc::new(Effective::of(&Settings::default()));
    let read = |text: &str| {
        let text = text.to_owned().into_bytes();
        Document::new(Source::Dxf(dxf::Document::read(text)), settings.clone())
    };
    for (first, second) in [(0, 1), (1, 2), (2, 3)] {
        let whole = typed_text(15);
        let begins = |text: &str, number| {
            let found = text.match_indices("0\nLWPOLYLINE").nth(number);
            found.map_or(0, |(at, _)| at)
        };
        let lines_from = |text: &str, at: usize| -> Vec<usize> {
            let behind = text[at..].match_indices('\n').map(|(end, _)| at + end + 1);
            std::iter::once(at).chain(behind).collect()
        };
        let ends = lines_from(&whole, begins(&whole, first));
        let last = ends.partition_point(|&at| at < begins(&whole, second));
        for lost in last.saturating_sub(8)..last {
            let mut damaged = whole.clone();
            damaged.replace_range(ends[lost]..ends[lost + 1], "");
            let lines = lines_from(&damaged, begins(&damaged, second));
            for line in lines.windows(2).take(34).map(|it| it[0]..it[1]) {
                for (range, new) in [(line.clone(), ""), (line.start..line.start, "x")] {
                    let (mut document, mut text) = (read(&damaged), damaged.clone());
                    text.replace_range(range.clone(), new);
                    document.edit_text(range, new);
                    assert_eq!(shown(&mut document), shown(&mut read(&text)), "{text}");
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(120, 300)), failure_persistence: None, ..ProptestConfig::default() })]

    /// Somebody types in the tags of one vertex, now and then elsewhere: a number or a code is none for a while, and is one again.
    #[test]
    fn a_number_that_is_being_typed_is_read_as_if_afresh(
        polyline in 0..4usize,
        vertex in 0..9usize,
        side in 0..3usize,
        closed in prop_oneof![Just(15u8), 0..15u8],
        before in prop::sample::select(vec![0usize, 0, 3]),
        strokes in proptest::collection::vec((0..24usize, 0..3usize, prop::sample::select(vec!["", "1", "-", ".", "x", "0.5", "\n"]), 0..12usize), 1..14),
    ) {
        let side = [SideSetting::Both, SideSetting::Auto, SideSetting::Opening][side];
        let settings = Arc::new(Effective::of(&Settings { side: Some(side), ..Settings::default() }));
        let mut text = typed_text(closed);
        let at = text.match_indices("LWPOLYLINE").nth(polyline).map_or(0, |(at, _)| at);
        let home = at + text[at..].match_indices("\n10\n").nth(vertex).map_or(0, |(at, _)| at + 4 - before);
        let mut document = Document::new(Source::Dxf(dxf::Document::read(text.clone().into_bytes())), settings.clone());
        for (along, count, new, elsewhere) in strokes {
            let start = if elsewhere == 0 { along * text.len() / 24 } else { home + along };
            let start = start.min(text.len());
            let range = start..(start + count).min(text.len());
            text.replace_range(range.clone(), new);
            document.edit_text(range, new);
            let mut fresh = Document::new(Source::Dxf(dxf::Document::read(text.clone().into_bytes())), settings.clone());
            prop_assert_eq!(shown(&mut document), shown(&mut fresh), "{}", text);
        }
    }
}
