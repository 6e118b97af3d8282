//! Thread holes and entries that one contour is given twice: the one that counts, and the other.

use super::leads::finding;
use super::order::{name, outline_of};
use super::requested::{key_outline, marks, means_entry};
use crate::drawing::{Drawing, Outline};
use crate::finding::{Finding, Place, Rule, Severity};
use crate::geometry::Point;
use crate::settings::{Effective, NEAR, PointSetting};

/// In drawings of more segments this is only said when a path is requested.
pub(crate) const MOST_SEGMENTS: usize = 2_000;

/// More marks than these are not compared.
const MOST_MARKS: usize = 200;

/// A point that an outline is given, and by whom.
type Given = (usize, Point, String);

/// The contours whose thread hole or entry is given in two places, in the order in which these count.
pub(crate) fn said_twice(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
) -> Vec<Finding> {
    let Some(severity) = settings.severity_over(Rule::Settings, Severity::Warning) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for (what, given) in [
        (say!(thread_hole), threads(drawing, outlines, settings)),
        (say!(entry), set(drawing, outlines, settings, "entry")),
    ] {
        let near = NEAR / settings.unit_of(drawing).mm;
        let mut firsts: Vec<&Given> = Vec::new();
        for other in &given {
            let Some(first) = firsts.iter().find(|first| first.0 == other.0) else {
                firsts.push(other);
                continue;
            };
            if (first.1 - other.1).norm() <= near {
                continue;
            }
            let outline = &outlines[other.0];
            let [at, elsewhere] =
                [first, other].map(|given| format!("({}, {})", given.1.x, given.1.y));
            let sentence = say!(
                a_point_that_is_given_twice,
                what,
                name(drawing, outline),
                at,
                first.2,
                elsewhere,
                other.2
            );
            let entity = outline.contour.pieces.first().map(|piece| piece.entity);
            let place = entity.map(|entity| Place::Entity { entity });
            found.push(finding(Rule::Settings, severity, place, sentence, None));
        }
    }
    found
}

fn threads(drawing: &Drawing, outlines: &[Outline], settings: &Effective) -> Vec<Given> {
    let mut given = set(drawing, outlines, settings, "thread");
    let mut marks = marks(drawing, outlines, MOST_MARKS).unwrap_or_default();
    marks.sort_by(|a, b| a.distance.total_cmp(&b.distance));
    let threads = marks
        .iter()
        .filter(|mark| !means_entry(drawing, &outlines[mark.outline], mark, settings));
    given.extend(threads.map(|mark| (mark.outline, mark.at, say!(a_mark_o).to_owned())));
    given
}

/// The points of `thread` or `entry` in the settings: those of single contours count before those of the program.
fn set(drawing: &Drawing, outlines: &[Outline], settings: &Effective, key: &str) -> Vec<Given> {
    let of_all = match key {
        "thread" => settings.thread.as_ref(),
        _ => settings.entry.as_ref(),
    };
    let mut given = own(drawing, outlines, settings, key);
    let key = format!("program.{key}");
    given.extend(of_program(drawing, outlines, of_all, &key));
    given
}

/// What is said of single contours of the drawing; where two keys name one, the later one counts.
fn own(drawing: &Drawing, outlines: &[Outline], settings: &Effective, key: &str) -> Vec<Given> {
    let document = settings.document.as_deref().unwrap_or_default();
    let said = settings.own.iter().rev().filter_map(|(contour, own)| {
        let at = if key == "thread" {
            own.thread
        } else {
            own.entry
        }?;
        let outline = key_outline(drawing, outlines, settings, contour)?;
        let by = format!("drawings.\"{document}\".contours.\"{contour}\".{key}");
        Some((outline, Point::from(at), by))
    });
    said.collect()
}

fn of_program(
    drawing: &Drawing,
    outlines: &[Outline],
    setting: Option<&PointSetting>,
    key: &str,
) -> Vec<Given> {
    match setting {
        // One that is given to several contours is refused.
        Some(PointSetting::One(at)) if outlines.len() == 1 => {
            vec![(0, Point::from(*at), key.to_owned())]
        }
        Some(PointSetting::ByHandle(table)) => {
            let said = table.iter().rev().filter_map(|(handle, at)| {
                let outline = outline_of(drawing, outlines, handle).ok()?;
                Some((outline, Point::from(*at), format!("{key}.{handle}")))
            });
            said.collect()
        }
        _ => Vec::new(),
    }
}
