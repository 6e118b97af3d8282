//! The requested thread hole and entry of a contour: from the settings, and from the marks in the drawing.

use super::containment::Places;
use super::job::Job;
use super::path::Refusal;
use crate::drawing::{Geometry, Kind, Outline, is_layer_of_start_holes, winding};
use crate::geometry::Point;
use crate::settings::{Compensation, ContourSettings, NEAR, PointSetting, point_of};
use rustc_hash::FxHashMap;

/// What settings and start marks give for one contour, in drawing units; settings are in mm.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Requested {
    pub(crate) thread: Option<Point>,
    pub(crate) entry: Option<Point>,
    /// A mark for the nearest point of the contour, where no entry is given.
    pub(crate) beside: Option<Point>,
    /// The proposed start hole.
    pub(crate) proposed: Option<Point>,
}

impl<'a> Job<'a> {
    /// Thread hole and entry of each of the `chosen` outlines, from the settings, then from the marks.
    pub(super) fn wanted(&self, chosen: &[usize]) -> Result<Vec<Requested>, Refusal> {
        let settings = self.settings;
        let threads = self.points(chosen, settings.thread.as_ref(), say!(thread_hole))?;
        let entries = self.points(chosen, settings.entry.as_ref(), say!(entry))?;
        let said = self.own();
        let marks = self.marks(usize::MAX).unwrap_or_default();
        let points = threads.into_iter().zip(entries);
        let wanted = chosen.iter().zip(points).map(|(index, (thread, entry))| {
            let own = said.get(index);
            let thread = own
                .and_then(|own| own.thread)
                .map(|at| self.place(at))
                .or(thread);
            let entry = own
                .and_then(|own| own.entry)
                .map(|at| self.place(at))
                .or(entry);
            let mark = own_mark(&marks, *index);
            let is_entry = |mark: &&Mark| self.means_entry(mark);
            let beside = mark.filter(is_entry).map(|mark| mark.at);
            Requested {
                thread: thread.or(if beside.is_some() {
                    None
                } else {
                    mark.map(|mark| mark.at)
                }),
                entry,
                beside,
                proposed: None,
            }
        });
        Ok(wanted.collect())
    }

    /// The settings of single outlines of this drawing, by their index. One that names no outline has a finding of its own.
    fn own(&self) -> FxHashMap<usize, &'a ContourSettings> {
        let said = self.settings.own.iter();
        said.filter_map(|(key, said)| Some((self.key_outline(key)?, said)))
            .collect()
    }

    /// The outline that a key names, by a handle or by a point on it.
    pub(super) fn key_outline(&self, key: &str) -> Option<usize> {
        let near = self.units(NEAR);
        let through = |at: Point| {
            let runs_there = |outline: &Outline| {
                outline.contour.double_of.is_none()
                    && outline
                        .contour
                        .segments(self.drawing)
                        .any(|segment| segment.geometry.distance_to(at) <= near)
            };
            self.outlines.iter().position(runs_there)
        };
        match point_of(key) {
            Some(at) => through(self.place(at.into())),
            None => self.outline_of(key).ok(),
        }
    }

    /// The places in the order that the settings give to single outlines.
    pub(super) fn places(&self) -> Places {
        let said = self.own().into_iter();
        said.filter_map(|(index, own)| Some((index, own.order?)))
            .collect()
    }

    /// A mark within the correction of its contour, or on the part's side of it, is the entry: no wire can be threaded
    /// there. Where the side is not known, or the contour is the wire's own path, it is the thread hole.
    pub(super) fn means_entry(&self, mark: &Mark) -> bool {
        let (settings, outline) = (self.settings, &self.outlines[mark.outline]);
        if settings.compensation == Compensation::None || outline.wire_side().is_none() {
            return false;
        }
        let is_on_part = || {
            let is_inside = winding(self.drawing, &outline.contour, mark.at) != 0;
            outline.contour.closed && is_inside != settings.has_waste_inside(outline.role)
        };
        mark.distance * self.unit_mm <= settings.correction || is_on_part()
    }

    fn points(
        &self,
        chosen: &[usize],
        setting: Option<&PointSetting>,
        what: &str,
    ) -> Result<Vec<Option<Point>>, Refusal> {
        let mut points = vec![None; chosen.len()];
        match setting {
            None => {}
            Some(PointSetting::One(at)) => match &mut points[..] {
                [only] => *only = Some(self.place(*at)),
                several => {
                    let count = several.len();
                    return Err(Refusal::Sentence(say!(
                        one_is_given_for_several_contours,
                        what,
                        count
                    )));
                }
            },
            Some(PointSetting::ByHandle(table)) => {
                for (handle, at) in table {
                    let outline = self.outline_of(handle)?;
                    if let Some(place) = chosen.iter().position(|&index| index == outline) {
                        points[place] = Some(self.place(*at));
                    }
                }
            }
        }
        Ok(points)
    }

    /// Every text "O", with the contour that it marks; `None` where there are more than `most`. A POINT is a mark on a layer of
    /// start holes, or where its contour has no other.
    pub(super) fn marks(&self, most: usize) -> Option<Vec<Mark>> {
        let drawing = self.drawing;
        let seen = drawing
            .entities()
            .filter(|(id, _)| drawing.visibility(*id).is_seen());
        let texts = seen.filter_map(|(_, entity)| match &entity.geometry {
            Geometry::Text { at, text } if text.trim().eq_ignore_ascii_case("o") => {
                let is_doubtful =
                    entity.kind == Kind::Point && !is_layer_of_start_holes(&entity.layer);
                Some((*at, is_doubtful))
            }
            _ => None,
        });
        let texts: Vec<(Point, bool)> = texts.collect();
        if texts.len() > most {
            return None;
        }
        let marks = texts.into_iter().filter_map(|(at, is_doubtful)| {
            let distance = |outline: &Outline| {
                outline
                    .contour
                    .segments(drawing)
                    .map(|s| s.geometry.distance_to(at))
                    .fold(f64::INFINITY, f64::min)
            };
            let outlines = self.outlines.iter().enumerate();
            let nearest = outlines
                .filter(|(_, outline)| outline.contour.double_of.is_none())
                .map(|(index, outline)| (index, distance(outline)))
                .min_by(|a, b| a.1.total_cmp(&b.1));
            let mark = |(outline, distance)| Mark {
                at,
                outline,
                distance,
            };
            nearest.map(|found| (mark(found), is_doubtful))
        });
        let marks: Vec<(Mark, bool)> = marks.collect();
        let mut counts: FxHashMap<usize, usize> = FxHashMap::default();
        for (mark, _) in &marks {
            *counts.entry(mark.outline).or_default() += 1;
        }
        let is_only = |mark: &Mark| counts.get(&mark.outline) == Some(&1);
        let counts_as_one =
            |(mark, is_doubtful): (Mark, bool)| (!is_doubtful || is_only(&mark)).then_some(mark);
        Some(marks.into_iter().filter_map(counts_as_one).collect())
    }
}

/// The mark of one outline: the nearest of several.
pub(super) fn mark_of(marks: &[Mark], outline: usize) -> Option<Point> {
    own_mark(marks, outline).map(|mark| mark.at)
}

fn own_mark(marks: &[Mark], outline: usize) -> Option<&Mark> {
    let own = marks.iter().filter(|mark| mark.outline == outline);
    own.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

pub(super) struct Mark {
    pub(super) at: Point,
    /// The outline nearest to it.
    pub(super) outline: usize,
    pub(super) distance: f64,
}
