//! Where a contour closes: the one answer that the rules, the outline, conversion and refactorings of every language go by.
//!
//! A contour is closed where the way behind its way in comes back to the end of the way in, or to the start of all, however many blocks
//! the way in has; a way out may follow. A stop while the contour is open, behind which a block goes on from that very point and comes
//! to close or meet the contour, belongs to the contour: it holds the part while its tab is cut.

use super::way::{Node, Way};
use crate::finding::Fault;
use crate::geometry::Vector;

/// Blocks in the ways in and out together among which an answer is looked for before the whole way is gone through.
const SHORT_LEADS: usize = 6;

/// The most blocks of a way out that leads elsewhere than to the start.
const LONGEST_WAY_OUT: usize = 12;

/// Blocks behind a stop of which one has to meet the contour that is open.
const BEHIND_A_STOP: usize = 16;

/// The ends of a way, which alone tell of nearly all ways that they close.
pub(crate) struct Ends {
    /// Where it begins, and where its first two blocks end.
    pub(crate) begin: [Node; 3],
    /// Where its last block begins and ends.
    pub(crate) end: [Node; 2],
    pub(crate) blocks: usize,
    /// µm.
    pub(crate) tolerance: f64,
}

impl Ends {
    /// True where they come back to the start or to the end of a way in of one or two blocks; a way out that goes elsewhere counts as one
    /// only where it runs neither back along the way in nor on in its direction.
    pub(crate) fn close(&self) -> bool {
        let ([start, first, second], [last, end]) = (self.begin, self.end);
        let is_near = |one: Node, other: Node| one.is_near(&other, self.tolerance);
        self.blocks == 0
            || is_near(start, end)
            || (self.blocks >= 3 && is_near(first, end))
            || (self.blocks >= 6 && is_near(second, end))
            || (self.blocks >= 5
                && is_near(first, last)
                && !runs_along(first.meant - start.meant, end.meant - last.meant))
    }
}

/// True where the second move runs against the first, or on in its direction, through the contour; within a few degrees.
fn runs_along(first: Vector, last: Vector) -> bool {
    first.dot(&last).abs() >= 0.99 * first.norm() * last.norm()
}

/// How a way falls into way in, contour and way out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Closing {
    pub(crate) closed: bool,
    /// Blocks; none where the contour is open.
    pub(crate) lead_in: usize,
    pub(crate) lead_out: usize,
}

/// Whether a way holds a closed contour, and where; `None` where that hangs on blocks that are not held.
pub(crate) fn closing(way: &dyn Way) -> Option<Closing> {
    let count = way.count();
    if count == 0 {
        return Some(Closing::default());
    }
    let tolerance = way.tolerance();
    let is_near =
        |one: usize, other: usize| Some(way.node(one)?.is_near(&way.node(other)?, tolerance));
    let closed = |lead_in, lead_out| {
        Some(Closing {
            closed: true,
            lead_in,
            lead_out,
        })
    };
    if is_near(0, count)? {
        // The way out runs back along the way in.
        let mut leads = 0;
        while 2 * leads + 2 < count
            && is_near(leads + 1, count - leads - 1)?
            && encloses(way, leads + 1, leads + 1)?
        {
            leads += 1;
        }
        if leads == 0
            && let Some(lead_out) = overlapping(way, tolerance)?
        {
            return closed(1, lead_out);
        }
        return closed(leads, leads);
    }
    if count >= 3 && is_near(1, count)? {
        return closed(1, 0);
    }
    // A last block like the first, there or back, was meant to lead to the start.
    let longest_out = if is_mirrored(way, tolerance)? {
        0
    } else {
        LONGEST_WAY_OUT
    };
    for both in 1..=SHORT_LEADS.min(count) {
        for lead_out in 0..=(both - 1).min(longest_out) {
            let lead_in = both - lead_out;
            if lead_in + lead_out < count
                && is_near(lead_in, count - lead_out)?
                && encloses(way, lead_in, lead_out)?
            {
                return closed(lead_in, lead_out);
            }
        }
    }
    if way.writing().names_places && count > 3 {
        // The cut may go on past the place where it closes.
        let first = way.piece(1)?;
        for lead_out in [0, 1] {
            if first.distance_to(way.node(count - lead_out)?.meant) <= tolerance {
                return closed(1, lead_out);
            }
        }
    }
    for lead_out in 0..=longest_out.min(count) {
        let end = way.node(count - lead_out)?.meant;
        let mut found = None;
        way.pieces_about(end, tolerance, &mut |index, piece| {
            let is_it = index > 0
                && (piece.start() - end).norm() <= tolerance
                && encloses(way, index, lead_out) == Some(true);
            found = found.or(is_it.then_some(index));
            found.is_some() || index + lead_out >= count
        })?;
        if let Some(lead_in) = found {
            return closed(lead_in, lead_out);
        }
    }
    Some(meeting(way, tolerance)?.unwrap_or_default())
}

/// Blocks behind the place where a contour closes, where it goes on from there along its first blocks and then back to the thread hole.
fn overlapping(way: &dyn Way, tolerance: f64) -> Option<Option<usize>> {
    let count = way.count();
    for lead_out in 2..=LONGEST_OVERLAP {
        if lead_out + 3 > count {
            break;
        }
        let closes = way
            .node(1)?
            .is_near(&way.node(count - lead_out)?, tolerance);
        if !closes || !encloses(way, 1, lead_out)? {
            continue;
        }
        let mut goes_on = true;
        for nth in 1..lead_out {
            let (along, first) = (way.piece(count - lead_out + nth - 1)?, way.piece(nth)?);
            let is_on = |share| first.distance_to(along.point_at(share)) <= tolerance;
            goes_on &= is_on(0.5) && is_on(1.0);
        }
        if goes_on {
            return Some(Some(lead_out));
        }
    }
    Some(None)
}

/// The most blocks of a way on past the place where a contour closes and out from there.
const LONGEST_OVERLAP: usize = 4;

/// A way whose tab comes to meet what was cut before its stop, elsewhere than where it stopped.
fn meeting(way: &dyn Way, tolerance: f64) -> Option<Option<Closing>> {
    let Some(before) = way
        .stop()
        .filter(|before| (3..way.count()).contains(before))
    else {
        return Some(None);
    };
    let stopped = way.node(before)?.meant;
    for behind in before + 1..=way.count().min(before + BEHIND_A_STOP) {
        let end = way.node(behind)?.meant;
        if (end - stopped).norm() <= tolerance {
            continue;
        }
        let mut met = None;
        way.pieces_about(end, tolerance, &mut |index, piece| {
            met = met.or((index < before && piece.distance_to(end) <= tolerance).then_some(index));
            met.is_some() || index >= before
        })?;
        if let Some(lead_in) = met {
            return Some(Some(Closing {
                closed: true,
                lead_in,
                lead_out: way.count() - behind,
            }));
        }
    }
    Some(None)
}

/// Whether what is left between ways in and out of so many blocks can go round something: there and back does not.
fn encloses(way: &dyn Way, lead_in: usize, lead_out: usize) -> Option<bool> {
    let is_arc = |index: usize| Some(way.piece(index)?.as_arc().is_some());
    let count = way.count().saturating_sub(lead_in + lead_out);
    let goes_round = match count {
        0 => false,
        1 => way
            .piece(lead_in)?
            .as_arc()
            .is_some_and(|arc| arc.is_full_turn()),
        2 => is_arc(lead_in)? || is_arc(lead_in + 1)?,
        _ => true,
    };
    if !goes_round {
        return Some(false);
    }
    // What stays in one place is no contour.
    let begin = way.node(lead_in)?.meant;
    for index in lead_in..lead_in + count.min(LOOKED_THROUGH) {
        let piece = way.piece(index)?;
        if [0.5, 1.0]
            .into_iter()
            .any(|share| (piece.point_at(share) - begin).norm() > 2.0 * way.tolerance())
        {
            return Some(true);
        }
    }
    Some(false)
}

/// Blocks of which one has to lead away from where a contour begins.
const LOOKED_THROUGH: usize = 16;

/// Whether a way holds a closed contour that goes round something. Passes to and fro that leave the tab come back to where they begin,
/// too, on the way on which they went.
pub(crate) fn goes_round(way: &dyn Way) -> Option<bool> {
    let closing = closing(way)?;
    let pieces = closing.lead_in..way.count() - closing.lead_out;
    let looked_at = (pieces.len() / 2).min(LOOKED_THROUGH);
    let mut comes_back = closing.closed && looked_at > 0;
    for nth in 0..looked_at {
        let there = way.piece(pieces.start + nth)?.point_at(0.5);
        let back = way.piece(pieces.end - 1 - nth)?.point_at(0.5);
        comes_back &= (there - back).norm() <= way.tolerance();
    }
    Some(closing.closed && !comes_back)
}

/// Whether the last block runs as far and in the same or the opposite direction as the first.
fn is_mirrored(way: &dyn Way, tolerance: f64) -> Option<bool> {
    let count = way.count();
    let first = way.node(1)?.meant - way.node(0)?.meant;
    let last = way.node(count)?.meant - way.node(count - 1)?.meant;
    Some(count >= 3 && ((first - last).norm() <= tolerance || (first + last).norm() <= tolerance))
}

/// How far a way that does not close ends beside its start, or the end of a way in of one block, whichever is nearer; `None` where that
/// hangs on blocks that are not held.
pub(crate) fn not_closed(way: &dyn Way) -> Option<Fault> {
    let count = way.count();
    let end = way.node(count)?.meant;
    let beside = |index: usize| Some(end - way.node(index)?.meant);
    let (start, lead_in) = (beside(0)?, if count >= 3 { beside(1) } else { None });
    let nearer = lead_in.filter(|lead_in| lead_in.norm() < start.norm());
    let by = nearer.unwrap_or(start);
    Some(Fault::NotClosed { x: by.x, y: by.y })
}

/// Whether a way that goes on behind a stop belongs to the contour before it, which is open: it closes the contour or comes to meet it.
/// `before` are the blocks up to the stop, `whole` those and the ones behind it.
pub(crate) fn is_tab(before: &dyn Way, behind: &dyn Way, whole: &dyn Way) -> Option<bool> {
    if before.count() == 0 || behind.count() == 0 || goes_round(before)? || goes_round(behind)? {
        return Some(false);
    }
    let closing = closing(whole)?;
    Some(closing.closed && closing.lead_in <= before.count())
}

#[cfg(test)]
mod tests {
    use crate::finding::Rule;
    use crate::ide::SymbolKind;
    use crate::ide::program::symbols;
    use crate::program::path::cuts;
    use crate::program::path::tolerance;
    use crate::program::{Document, Language, convert};
    use crate::settings::Effective;
    use proptest::prelude::*;

    /// What every reader of a program says of its one contour: closed or not.
    #[track_caller]
    fn answers(language: Language, text: &str) -> bool {
        let document = Document::read(language, text.into(), &Effective::default());
        let (findings, _) = document.findings(&Effective::default(), usize::MAX);
        let by_rule = !findings
            .iter()
            .any(|finding| finding.rule == Rule::NotClosed);
        let contours: Vec<_> = cuts(&document.trace())
            .into_iter()
            .filter(|cut| !cut.is_way)
            .collect();
        let by_cuts = contours.iter().all(|cut| cut.closed);
        let outline = symbols(&document);
        let mut contours_of_outline = outline
            .iter()
            .filter(|symbol| symbol.kind == SymbolKind::Cut);
        let by_outline = contours_of_outline.all(|symbol| symbol.detail.starts_with("closed"));
        let converted = convert::cuts(&document);
        let by_conversion = converted.cuts.iter().all(|cut| cut.closed);
        let all = [by_rule, by_cuts, by_outline, by_conversion];
        assert!(
            all.iter().all(|one| *one == by_rule),
            "rule, cuts, outline, conversion: {all:?}\n{text}"
        );
        assert_eq!(converted.cuts.len(), contours.len(), "{text}");
        for (own, cut) in converted.cuts.iter().zip(&contours) {
            // Where a cut meets itself within a segment, that is parted.
            assert!(
                own.lead_in - cut.lead_in <= 1 && own.lead_out - cut.lead_out <= 1,
                "{text}"
            );
        }
        by_rule
    }

    /// A way through places in µm; `None` is a stop.
    fn three_b(way: &[Option<[i64; 2]>]) -> String {
        let mut text = String::new();
        let mut at = [0, 0];
        for step in way {
            let Some([x, y]) = *step else {
                text.push_str("D\n");
                continue;
            };
            let (dx, dy) = (x - at[0], y - at[1]);
            at = [x, y];
            let quadrant = match (dx, dy) {
                (dx, dy) if dx > 0 && dy >= 0 => 1,
                (dx, dy) if dx <= 0 && dy > 0 => 2,
                (dx, dy) if dx < 0 && dy <= 0 => 3,
                _ => 4,
            };
            let (a, b) = (dx.abs(), dy.abs());
            let axis = if a > b || (a == b && quadrant % 2 == 0) {
                'X'
            } else {
                'Y'
            };
            text.push_str(&format!("B{a}B{b}B{}G{axis}L{quadrant}\n", a.max(b)));
        }
        text + "DD\n"
    }

    fn iso(way: &[Option<[i64; 2]>]) -> String {
        let line = |step: &Option<[i64; 2]>| match step {
            Some([x, y]) => format!("G01 X{:.3} Y{:.3}\n", *x as f64 / 1e3, *y as f64 / 1e3),
            None => "M00\n".to_owned(),
        };
        format!(
            "G92 X0. Y0.\nG90\n{}M02\n",
            way.iter().map(line).collect::<String>()
        )
    }

    #[track_caller]
    fn check(way: &[Option<[i64; 2]>], expected: bool) {
        assert_eq!(
            answers(Language::ThreeB, &three_b(way)),
            expected,
            "{}",
            three_b(way)
        );
        assert_eq!(answers(Language::Iso, &iso(way)), expected, "{}", iso(way));
    }

    fn some(way: &[[i64; 2]]) -> Vec<Option<[i64; 2]>> {
        way.iter().map(|at| Some(*at)).collect()
    }

    #[test]
    fn the_tolerance_grows_as_a_random_walk() {
        assert_eq!(tolerance(0), 2.0);
        assert_eq!(tolerance(1), 3.0);
        assert_eq!(tolerance(156).round(), 14.0);
    }

    #[test]
    fn ways_run_along_each_other_there_and_back_and_not_beside() {
        use super::runs_along;
        use crate::geometry::Vector;
        let [lead, across, steep] = [[4.0, 5.0], [5.0, -4.0], [4.0, -5.0]].map(Vector::from);
        for along in [2.0, 0.5, -1.0] {
            assert!(runs_along(lead, lead * along));
            assert!(!runs_along(lead, across * along));
            assert!(!runs_along(lead, steep * along));
        }
    }

    #[test]
    fn a_square_closes_behind_a_bent_way_in() {
        let square = [
            [9000, 2000],
            [9000, 12000],
            [-1000, 12000],
            [-1000, 2000],
            [4000, 2000],
        ];
        let bent = [[0, -3000], [4000, -3000], [4000, 2000]];
        check(&some(&[&bent[..], &square[..]].concat()), true);
        // A way out that goes elsewhere, and one back along the way in.
        check(
            &some(&[&bent[..], &square[..], &[[5000, -4000]]].concat()),
            true,
        );
        check(
            &some(&[&bent[..], &square[..], &[[4000, -3000], [0, -3000], [0, 0]]].concat()),
            true,
        );
        // It ends 1 mm beside the end of its way in.
        check(
            &some(&[&bent[..], &square[..4], &[[3000, 2000]]].concat()),
            false,
        );
        check(&some(&square), false);
    }

    #[test]
    fn a_stop_before_the_tab_does_not_end_a_contour() {
        let [hole, entry] = [[0, 0], [4000, 0]];
        let main = [
            entry,
            [4000, 5000],
            [24000, 5000],
            [24000, -15000],
            [4000, -15000],
            [4000, -3000],
        ];
        let with = |behind: &[Option<[i64; 2]>]| [&some(&main)[..], &[None], behind].concat();
        // The tab closes the contour; with and without a way out; or comes to meet it past its entry; or stops twice.
        check(&with(&some(&[entry])), true);
        check(&with(&some(&[entry, hole])), true);
        check(&with(&some(&[[4000, 300]])), true);
        check(
            &with(&[Some([4000, -1000]), None, Some(entry), Some(hole)]),
            true,
        );
        // The tab is left standing.
        check(&[&some(&main)[..], &[None]].concat(), false);
        check(&with(&some(&[[3000, -9000]])), false);
        for (language, text) in [
            (Language::ThreeB, three_b(&with(&some(&[entry, hole])))),
            (Language::Iso, iso(&with(&some(&[entry, hole])))),
        ] {
            let document = Document::read(language, text.clone().into(), &Effective::default());
            let trace = document.trace();
            let contours = cuts(&trace);
            assert_eq!(contours.len(), 1, "{text}");
            assert_eq!(
                (
                    contours[0].lead_in,
                    contours[0].lead_out,
                    contours[0].closed
                ),
                (1, 1, true),
                "{text}"
            );
            assert!(
                trace
                    .steps
                    .iter()
                    .filter(|step| step.moves())
                    .all(|step| step.contour == 0),
                "{text}"
            );
            let converted = convert::cuts(&document);
            assert_eq!(
                (converted.cuts.len(), converted.stops.len()),
                (1, 1),
                "{text}"
            );
            assert_eq!(converted.cuts[0].contour().len(), 6, "{text}");
        }
    }

    #[test]
    fn two_stops_with_a_way_between_are_a_jump() {
        let text = "B4000B0B4000GXL1\nB4000B0B16000GYNR1\nB4000B0B4000GXL3\nD\nB50000B0B50000GXL1\nD\nB4000B0B4000GXL1\n\
                    B4000B0B16000GYNR1\nB4000B0B4000GXL3\nDD\n";
        assert!(answers(Language::ThreeB, text));
        let document = Document::read(Language::ThreeB, text.into(), &Effective::default());
        let contours: Vec<_> = cuts(&document.trace())
            .iter()
            .map(|cut| (cut.contour, cut.is_way))
            .collect();
        assert_eq!(contours, [(0, false), (1, true), (2, false)]);
    }

    /// A ring of places about a middle, none of which lie on one line.
    fn ring() -> impl Strategy<Value = Vec<[i64; 2]>> {
        (
            prop::collection::vec(3_000.0_f64..20_000.0, 3..12),
            0.0_f64..1.0,
        )
            .prop_map(|(radii, turned)| {
                let count = radii.len() as f64;
                let at = |(index, radius): (usize, &f64)| {
                    let angle = (index as f64 + turned) / count * std::f64::consts::TAU;
                    [
                        (radius * angle.cos()).round() as i64,
                        (radius * angle.sin()).round() as i64,
                    ]
                };
                radii.iter().enumerate().map(at).collect()
            })
    }

    fn ways() -> impl Strategy<Value = Vec<[i64; 2]>> {
        prop::collection::vec(
            (20_500_i64..60_000, 20_500_i64..60_000).prop_map(|(x, y)| [x, y]),
            0..10,
        )
    }

    proptest! {
        #[test]
        fn all_say_the_same_however_long_the_ways_are(
            ring in ring(), way_in in ways(), way_out in ways(),
            (back, stop, miss) in (any::<bool>(), 0_usize..40, prop_oneof![3 => Just(0), 1 => 40_i64..900]),
        ) {
            // From the origin, which a ring lies about, or from outside.
            let mut way: Vec<Option<[i64; 2]>> = some(&way_in);
            way.extend(some(&ring));
            let begin = ring[0];
            way.push(Some([begin[0] + miss, begin[1]]));
            if back {
                way.extend(some(&way_in).into_iter().rev().skip(1));
                way.push(Some([0, 0]));
            } else if miss == 0 {
                way.extend(some(&way_out));
            }
            if stop > way_in.len() + 1 && stop < way_in.len() + ring.len() {
                way.insert(stop, None);
            }
            let expected = miss == 0 || back;
            for (language, text) in [(Language::ThreeB, three_b(&way)), (Language::Iso, iso(&way))] {
                let said = answers(language, &text);
                // A way out from a contour that no way leads to is none.
                let is_plain = !way_in.is_empty() || back || way_out.is_empty();
                prop_assert!(!is_plain || said == expected, "{said}, expected {expected}\n{text}");
            }
        }
    }
}
