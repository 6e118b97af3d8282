//! Thread holes and entries that one contour is given twice: the one that counts, and the other.

use super::job::Job;
use super::leads::finding;
use crate::drawing::{Drawing, Outline};
use crate::finding::{Finding, Place, Rule, Severity};
use crate::geometry::Point;
use crate::settings::{ContourSettings, Effective, NEAR, PointSetting};

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
    let job = Job::of(drawing, outlines, settings);
    let mut found = Vec::new();
    for (what, given) in [
        (say!(thread_hole), job.threads()),
        (say!(entry), job.set("entry")),
    ] {
        let near = job.units(NEAR);
        let mut firsts: Vec<&Given> = Vec::new();
        for other in &given {
            let Some(first) = firsts.iter().find(|first| first.0 == other.0) else {
                firsts.push(other);
                continue;
            };
            if (first.1 - other.1).norm() <= near {
                continue;
            }
            let [at, elsewhere] = [first, other].map(|given| job.in_mm(given.1));
            let [at, elsewhere] = [at, elsewhere].map(|at| format!("({}, {})", at.x, at.y));
            let sentence = say!(
                a_point_that_is_given_twice,
                what,
                job.name(other.0),
                at,
                first.2,
                elsewhere,
                other.2
            );
            let entity = outlines[other.0]
                .contour
                .pieces
                .first()
                .map(|piece| piece.entity);
            let place = entity.map(|entity| Place::Entity { entity });
            found.push(finding(Rule::Settings, severity, place, sentence, None));
        }
    }
    found
}

impl Job<'_> {
    fn threads(&self) -> Vec<Given> {
        let mut given = self.set("thread");
        let mut marks = self.marks(MOST_MARKS).unwrap_or_default();
        marks.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let threads = marks.iter().filter(|mark| !self.means_entry(mark));
        given.extend(threads.map(|mark| (mark.outline, mark.at, say!(a_mark_o).to_owned())));
        given
    }

    /// The points of `thread` or `entry` in the settings: those of single contours count before those of the program.
    fn set(&self, key: &str) -> Vec<Given> {
        let settings = self.settings;
        let (of_all, of_one): (_, fn(&ContourSettings) -> _) = match key {
            "thread" => (settings.thread.as_ref(), |own| own.thread),
            _ => (settings.entry.as_ref(), |own| own.entry),
        };
        // Where two keys name one contour, the later one counts.
        let document = settings.document.as_deref().unwrap_or_default();
        let said = settings.own.iter().rev().filter_map(|(contour, own)| {
            let at = of_one(own)?;
            let outline = self.key_outline(contour)?;
            let by = format!("drawings.\"{document}\".contours.\"{contour}\".{key}");
            Some((outline, self.place(at), by))
        });
        let mut given: Vec<Given> = said.collect();
        let key = format!("program.{key}");
        match of_all {
            // One that is given to several contours is refused.
            Some(PointSetting::One(at)) if self.outlines.len() == 1 => {
                given.push((0, self.place(*at), key));
            }
            Some(PointSetting::ByHandle(table)) => {
                let said = table.iter().rev().filter_map(|(handle, at)| {
                    let outline = self.outline_of(handle).ok()?;
                    Some((outline, self.place(*at), format!("{key}.{handle}")))
                });
                given.extend(said);
            }
            _ => {}
        }
        given
    }
}
