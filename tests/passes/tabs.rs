//! Tabs: what is left standing, and the passes that cut it off.

use super::{PLATE, THREE, drawing, generated, held, length, outlines, paths, settings};
use wedm::drawing::Role;
use wedm::finding::{Finding, Rule};
use wedm::geometry::Point;
use wedm::program::Format;
use wedm::toolpath::{Source, WirePath, plan};

fn is_of_contour(source: &Source) -> bool {
    matches!(source, Source::Segment { .. } | Source::Corner { .. })
}

#[test]
fn a_punch_stands_on_its_tab_until_it_is_cut_off() {
    let text = "correction = 0.155\n[program]\nlead-in = 4\ntab = 3\n";
    let settings = settings(text);
    let drawing = drawing(Role::Punch, &PLATE);
    let found = paths(&drawing, &settings);
    let [cut, tab] = &found[..] else {
        panic!("{found:?}")
    };
    assert_eq!((cut.cut_off, tab.cut_off, tab.pass), (false, true, 1));
    // The lead is counted from the wire's path.
    assert!((cut.thread_hole - Point::new(20.0, -4.155)).norm() < 1e-9);
    assert!((length(tab, is_of_contour) - 3.0).abs() < 1e-9, "{tab:?}");
    let round = 2.0 * (40.0 + 20.0) + 2.0 * std::f64::consts::PI * 0.155;
    let both = length(cut, is_of_contour) + length(tab, is_of_contour);
    assert!((both - round).abs() < 1e-9);
    // It goes on where the others stopped, and ends where the wire was threaded.
    assert_eq!(cut.end(), tab.begin());
    assert_eq!((cut.begin(), tab.end()), (cut.thread_hole, cut.thread_hole));
    for format in [Format::ThreeB, Format::Iso] {
        let document = held(&drawing, &settings, format);
        let contours = document.trace().steps.last().map_or(0, |step| step.contour);
        assert_eq!(contours, 0, "one contour");
    }
}

#[test]
fn passes_leave_the_tab_and_cut_it_off_in_passes_of_its_own() {
    {
        for corrections in ["0.17, 0.14", "0.215, 0.17, 0.14"] {
            for compensation in ["path", "controller"] {
                let text = format!(
                    "[passes]\ncorrections = [{corrections}]\n[program]\ntab = 3\ncompensation = \"{compensation}\"\n"
                );
                let settings = settings(&text);
                let drawing = drawing(Role::Punch, &PLATE);
                let found = paths(&drawing, &settings);
                let count = settings.corrections.len();
                assert_eq!(found.len(), 2 * count, "{text}");
                for (number, path) in found.iter().enumerate() {
                    assert_eq!(path.cut_off, number >= count);
                    assert_eq!(path.pass, number % count + 1);
                    let own = length(path, is_of_contour);
                    assert!((own - 3.0).abs() < 1e-9 || own > 116.0, "{own}: {text}");
                    // Nothing is left out between one path and the next but jumps from the thread hole or to it.
                    if let Some(next) = found.get(number + 1) {
                        assert_eq!(path.end(), next.begin(), "{number}: {text}");
                    }
                }
                held(&drawing, &settings, Format::Iso);
                if compensation == "path" {
                    held(&drawing, &settings, Format::ThreeB);
                }
            }
        }
    }
}

/// Each pass goes the same way up to the tab, and back along what it has cut: the straight way from there to the thread hole would cut off the
/// punch, and what hangs on it, with the first pass.
#[test]
fn passes_one_way_go_back_along_what_they_have_cut() {
    for corrections in ["0.17, 0.14", "0.215, 0.17, 0.14", "0.2, 0.18, 0.16, 0.14"] {
        for compensation in ["path", "controller"] {
            for lead in ["straight", "perpendicular", "arc"] {
                let text = format!(
                    "wire-diameter = 0.25\ngap = 0.015\n[passes]\ncorrections = [{corrections}]\nsequence = \"one-way\"\n\
                     [program]\ntab = 3\ncompensation = \"{compensation}\"\nlead = \"{lead}\"\n"
                );
                let settings = settings(&text);
                let drawing = drawing(Role::Punch, &PLATE);
                let found = paths(&drawing, &settings);
                let count = settings.corrections.len();
                let (cuts, back): (Vec<_>, Vec<_>) =
                    found.iter().partition(|path| !path.is_way_back);
                assert_eq!(cuts.len(), 2 * count, "{text}");
                // The tab is cut to and fro, so that the wire ends in the thread hole.
                assert_eq!(back.len(), count - count % 2, "{text}");
                let first = cuts[0].counter_clockwise;
                assert!(
                    cuts[..count]
                        .iter()
                        .all(|path| path.counter_clockwise == first)
                );
                let of_contour = |path: &WirePath| -> Vec<[Point; 2]> {
                    let pieces = path.segments.iter();
                    let pieces = pieces.filter(|piece| is_of_contour(&piece.source));
                    pieces
                        .map(|piece| [piece.geometry.start(), piece.geometry.end()])
                        .collect()
                };
                for way in &back {
                    assert_ne!(way.counter_clockwise, first, "{text}");
                    let own = cuts.iter().find(|path| path.pass == way.pass);
                    let own = own.map(|path| of_contour(path)).unwrap_or_default();
                    let reversed: Vec<[Point; 2]> =
                        own.iter().rev().map(|[from, to]| [*to, *from]).collect();
                    assert_eq!(of_contour(way), reversed, "{text}");
                    assert_eq!(way.end(), way.thread_hole, "{text}");
                }
                // Before the tab is cut off it stands between the ends of every pass.
                for path in cuts.iter().filter(|path| !path.cut_off) {
                    assert!(length(path, is_of_contour) > 116.0, "{text}");
                }
                for pair in found.windows(2) {
                    assert_eq!(pair[0].end(), pair[1].begin(), "{text}");
                }
                assert_eq!(found.last().map(WirePath::end), Some(found[0].thread_hole));
                held(&drawing, &settings, Format::Iso);
                if compensation == "path" {
                    held(&drawing, &settings, Format::ThreeB);
                }
            }
        }
    }
}

#[test]
fn a_punch_without_a_tab_is_said_to_drop_in_its_first_pass() {
    let said = |role: Role, text: &str| {
        let made = generated(&drawing(role, &PLATE), &settings(text), Format::Iso);
        let of_settings = |said: &&Finding| said.rule == Rule::Settings;
        made.warnings.iter().filter(of_settings).count()
    };
    let tab = format!("{THREE}[program]\ntab = 3\n");
    assert_eq!(said(Role::Punch, THREE), 1);
    assert_eq!(said(Role::Punch, &tab), 0);
    assert_eq!(said(Role::Opening, THREE), 0);
    assert_eq!(said(Role::Punch, "correction = 0.14\n"), 0);
}

#[test]
fn four_b_stops_before_its_tab_and_goes_on_in_one_contour() {
    let drawing = drawing(Role::Punch, &PLATE);
    let whole = generated(&drawing, &settings(""), Format::FourB).program;
    let tab = generated(&drawing, &settings("[program]\ntab = 3\n"), Format::FourB).program;
    let lines: Vec<&str> = tab.text.lines().collect();
    let stop = lines.iter().position(|line| *line == "D").expect("a stop");
    assert_eq!(lines.iter().filter(|line| **line == "D").count(), 1);
    // What stands after it is the tab and the way out.
    assert!(
        lines[stop + 1].starts_with("B3000B0B3000GX"),
        "{}",
        tab.text
    );
    assert_eq!(tab.blocks, whole.blocks + 1);
    assert!((tab.length - whole.length).abs() < 1e-9);
    let several = settings(
        "[passes]\ncorrections = [0.17, 0.14]\n[program]\ntab = 3\ncompensation = \"controller\"\n",
    );
    let refused = Format::FourB
        .write(&paths(&drawing, &several), 1.0, &several, &mut |_, _| true)
        .expect_err("one contour for all passes");
    assert!(refused.to_string().contains("a single pass"), "{refused}");
}

#[test]
fn a_slug_above_its_limit_keeps_a_tab_and_a_tab_is_shorter_than_its_contour() {
    let count = |text: &str| paths(&drawing(Role::Opening, &PLATE), &settings(text)).len();
    // 7.85 g/cm³ × 8 cm² × 4 cm = 251.2 g.
    let tab = "[program]\ntab = 3\n";
    assert_eq!(count(tab), 1);
    assert_eq!(
        count(&format!("{tab}[job]\nthickness = 40\nslug-limit = 251\n")),
        2
    );
    assert_eq!(
        count(&format!("{tab}[job]\nthickness = 40\nslug-limit = 252\n")),
        1
    );
    for (text, says) in [
        (
            "[program]\ntab = 120\n",
            "the tab of 120.000 mm leaves nothing of contour 2A, which is 120.000 mm long",
        ),
        (
            "[program]\nclosing-overlap = 130\n",
            "the overlap of 130.000 mm goes all round contour 2A",
        ),
    ] {
        let settings = settings(text);
        let drawing = drawing(Role::Punch, &PLATE);
        let refused = plan(&drawing, &outlines(&drawing, &settings), &settings, None);
        assert!(format!("{refused:?}").contains(says), "{refused:?}");
    }
}
