//! The passes of a contour with their leads: to and fro, on past the start, and without the tab,
//! which is cut off after a stop.
//!
//! With a tab the passes end where it begins, and go back from there: a step leads from the path of one to that of the next. Then the tab is
//! cut in passes of its own, to and fro from where the wire stands. Where several passes all go one way, each goes back along what it has
//! cut: the straight way from where the tab begins to the thread hole would cut off what hangs on the tab.

use super::contours::Contours;
use super::corners::Element;
use super::entry::{Entry, path_point};
use super::job::{Job, ROUNDING};
use super::lead_form::{Landing, lead_in, lead_out};
use super::leads::Kerfs;
use super::offset::normal;
use super::path::{PathSegment, Refusal, Source, WirePath};
use super::paths::{Pass, Unled};
use super::requested::Requested;
use super::rotated::Rotated;
use super::threading::lead;
use crate::drawing::Role;
use crate::geometry::{Point, Segment, Side};
use crate::settings::{Compensation, Lead, LengthSetting, Sequence};
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};

/// How much further than the correction the wire goes from a part's contour at a tab, where the control switches the correction, mm.
const CLEAR: f64 = 0.01;

/// One pass, from the entry on.
#[derive(Default)]
struct Round {
    /// All of it except the tab, in the order of travel.
    main: Vec<PathSegment>,
    /// The first piece of `main` is the straight way from the thread hole.
    is_led: bool,
    /// Along the tab, which ends at the entry.
    held: Rotated,
    /// Drawing units; 0 where the control offsets the contour.
    correction: f64,
    /// Where the wire goes at the tab to have its correction switched.
    aside: Option<Point>,
}

impl Job<'_> {
    /// The paths of all passes, each in its own direction, and those that cut off the tab.
    pub(super) fn led(
        &self,
        mut unled: Unled,
        wanted: &Requested,
        thread: Point,
        contours: &Contours,
        kerfs: &Kerfs,
    ) -> Result<Vec<WirePath>, Refusal> {
        let tab = self.tab(&unled)?;
        // From the far end of an open contour the wire goes straight to the thread hole, not back along the contour.
        let is_one_way = self.is_one_way(unled.passes.len());
        let returns = is_one_way && tab.is_none();
        let form = self.lead(wanted);
        let is_straight = form == Lead::Straight;
        let overlap = self.overlap(&unled)?;
        let passes = std::mem::take(&mut unled.passes);
        let count = passes.len();
        let (mut rounds, mut side) = (Vec::with_capacity(count), None);
        let is_open = !self.outlines[unled.outline].contour.closed;
        let made = passes.into_par_iter().enumerate().map(|(number, pass)| {
            let back = self.settings.runs_back(number);
            // The far end of an open contour is where a tab would begin, and there is none.
            let is_led = is_straight && !((tab.is_some() || is_open) && back);
            let form = Form {
                back,
                thread: is_led.then_some(thread),
                count,
                is_last: number + 1 == count,
            };
            self.round(&unled, wanted, pass, tab.as_ref(), form)
        });
        for made in made.collect::<Vec<_>>() {
            let (round, of_control) = made?;
            rounds.push(round);
            side = of_control;
        }
        let outline = &self.outlines[unled.outline];
        let closed = outline.contour.closed;
        let counter_clockwise = (outline.twice_area > 0.0) != self.directed(unled.outline).1;
        let mut paths = Vec::with_capacity(2 * count);
        // Where the wire is, if it is at the tab.
        let mut at_tab: Option<Point> = None;
        for stage in stages(count, tab.is_some(), is_one_way) {
            let Stage {
                number,
                cut_off,
                is_way_back,
            } = stage;
            let round = &mut rounds[number];
            let back = match cut_off {
                true => at_tab.is_none(),
                false => self.settings.runs_back(number) || is_way_back,
            };
            let from_tab = (tab.is_some() || !closed) && cut_off != back;
            let to_tab = (tab.is_some() || !closed) && !from_tab;
            let overlaps = overlap > 0.0 && closed && !to_tab && (cut_off || tab.is_none());
            let main = round.main.iter().skip(usize::from(round.is_led));
            let beyond = match back == self.settings.runs_back(number) {
                _ if !overlaps => Vec::new(),
                true => beyond(main.clone().copied(), overlap),
                false => beyond(main.clone().rev().map(reversed), overlap),
            };
            let is_led = round.is_led && !cut_off && !is_way_back;
            let mut segments = match cut_off {
                true => std::mem::take(&mut round.held).into_segments(back, None),
                false if is_way_back => main.rev().map(reversed).collect(),
                // Kept, since the wire goes back along it, or on beyond the tab.
                false if tab.is_some() && (overlap > 0.0 || is_one_way) => round.main.clone(),
                false => std::mem::take(&mut round.main),
            };
            let (begin, end) = match (segments.get(usize::from(is_led)), segments.last()) {
                (Some(first), Some(last)) => (first.geometry.start(), last.geometry.end()),
                _ => (thread, thread),
            };
            // The side of travel from which the wire comes, and how far to that side of the programmed path it runs.
            let across = self.across();
            let of_travel = across * if back { -unled.side } else { unled.side };
            let wire = self.units(self.settings.each_correction()[number]);
            let surroundings = self.surroundings(&unled, contours, kerfs, form, wire);
            let wire = wire.abs();
            let control = match self.settings.compensation {
                Compensation::Controller => across * wire,
                _ => 0.0,
            };
            let entry = unled.entry.unwrap_or(Entry {
                wall: 0,
                share: 0.0,
                point: begin,
            });
            let hold = |landing: &Landing| {
                let way = surroundings.hold(thread, landing, &entry, &unled.walls, wire);
                way.map(|way| way.pieces(thread, landing, true))
            };
            let to_begin: Vec<PathSegment> = match (from_tab && !returns, round.aside) {
                (false, _) if begin == thread || is_led => Vec::new(),
                (false, _) if is_straight && !from_tab => {
                    lead(thread, begin, Source::LeadIn).into_iter().collect()
                }
                (false, _) => {
                    let along = segments.first().map(|first| first.geometry.start_tangent());
                    let along = along.unwrap_or_default();
                    let landing = Landing::of_begin(begin, along, of_travel, control);
                    lead_in(hold(&landing)?).collect()
                }
                (true, aside) => {
                    let source = aside.map_or(Source::Tab, |_| Source::LeadIn);
                    let step = lead(at_tab.unwrap_or(begin), begin, source);
                    step.into_iter().collect()
                }
            };
            if !to_begin.is_empty() {
                segments.splice(0..0, to_begin);
            }
            segments.extend(beyond);
            let last = segments.last().map_or(end, |piece| piece.geometry.end());
            at_tab = match (to_tab && !returns, round.aside) {
                (true, Some(aside)) => {
                    segments.extend(lead(last, aside, Source::LeadOut));
                    Some(aside)
                }
                (true, None) => Some(last),
                (false, _) => {
                    let along = segments.last().map(|last| last.geometry.end_tangent());
                    let landing =
                        Landing::of_end(last, along.unwrap_or_default(), of_travel, control);
                    if last == thread {
                    } else if !closed && to_tab {
                        let back = surroundings.straight_back();
                        let way = back.hold(thread, &landing, &entry, &unled.walls, wire);
                        segments.extend(lead_out(way?.pieces(thread, &landing, true)));
                    } else if is_straight {
                        // The control moves the way out as it moves the contour.
                        let is_held = control == 0.0;
                        if (overlaps || to_tab) && is_held && unled.entry.is_some() {
                            hold(&landing)?;
                        }
                        segments.extend(lead(last, thread, Source::LeadOut));
                    } else {
                        segments.extend(lead_out(hold(&landing)?));
                    }
                    None
                }
            };
            paths.push(WirePath {
                outline: unled.outline,
                pass: number + 1,
                counter_clockwise: closed.then_some(counter_clockwise != back),
                cut_off,
                is_way_back,
                correction: round.correction,
                on_line: false,
                thread_hole: thread,
                side: if back { side.map(Side::reversed) } else { side },
                segments,
            });
        }
        Ok(paths)
    }

    /// One pass from its entry on, and the side of travel on which the control lets the wire run.
    fn round(
        &self,
        unled: &Unled,
        wanted: &Requested,
        pass: Pass,
        tab: Option<&Entry>,
        form: Form,
    ) -> Result<(Round, Option<Side>), Refusal> {
        let Form {
            back,
            thread,
            count,
            is_last,
        } = form;
        let main = |way: Rotated| {
            let led = thread.zip(way.begin_of(back));
            let led = led.and_then(|(thread, begin)| lead(thread, begin, Source::LeadIn));
            (led.is_some(), way.into_segments(back, led))
        };
        let wire = pass.correction;
        let closed = self.outlines[unled.outline].contour.closed;
        let (ring, tab_at, correction, side) =
            if self.settings.compensation == Compensation::Controller {
                let (ring, side) = self.controlled(unled.outline, wanted)?;
                (ring, tab.map(|tab| tab.point), 0.0, side)
            } else {
                let at =
                    tab.and_then(|tab| path_point(&pass.path, &unled.walls, tab, wire, unled.side));
                let ring = match closed {
                    true => Rotated::at(pass.path, pass.element, pass.begin),
                    false => Rotated::whole(pass.path),
                };
                (ring, at.map(|(_, at)| at), wire.abs(), None)
            };
        let returns = self.is_one_way(count) && tab.is_none();
        // The control brings the wire to the correction of the next cut on the way back, and after the last pass the tab is cut with the first
        // one. Across the contour corrections rise.
        let reach = match is_last || self.settings.comes_across {
            true => wire.max(self.units(self.settings.correction)),
            false => wire,
        };
        let aside = |at: &Entry| {
            let from = unled.side * self.across();
            let away = normal(&unled.walls[at.wall].geometry, at.share, from);
            let aside = at.point + away * (reach + self.units(CLEAR));
            (side.is_some() && count > 1 && !returns).then_some(aside)
        };
        let (Some(at), Some(tab)) = (tab_at, tab) else {
            let last = unled.walls.last().filter(|_| !closed);
            let far_end = last.map(|last| Entry {
                wall: unled.walls.len() - 1,
                share: 1.0,
                point: last.geometry.end(),
            });
            let (is_led, main) = main(ring);
            let round = Round {
                main,
                is_led,
                held: Rotated::default(),
                correction,
                aside: far_end.as_ref().and_then(aside),
            };
            return Ok((round, side));
        };
        let (before, held) = split(ring.into_path(), at, self.units(ROUNDING));
        let wall = &unled.walls[tab.wall];
        if before.is_empty() || held.is_empty() {
            let at = self.in_mm(tab.point);
            let sentence = say!(no_tab_fits_at, at.x, at.y);
            return Err(self.refused(Some(wall.source), sentence));
        }
        let (is_led, main) = main(Rotated::whole(before));
        let round = Round {
            main,
            is_led,
            held: Rotated::whole(held),
            correction,
            aside: aside(tab),
        };
        Ok((round, side))
    }

    /// Whether each of this many passes comes back to the thread hole, to go the same way as the one before.
    fn is_one_way(&self, passes: usize) -> bool {
        self.settings.passes.sequence() == Sequence::OneWay && passes > 1
    }

    /// Where on the walls the tab begins; `None` for a contour that keeps none.
    fn tab(&self, unled: &Unled) -> Result<Option<Entry>, Refusal> {
        let settings = self.settings;
        let outline = &self.outlines[unled.outline];
        let cut_out = self
            .cut_out
            .get(&unled.outline)
            .copied()
            .unwrap_or_default();
        let area = (outline.twice_area.abs() / 2.0 - cut_out).max(0.0) * self.unit_mm.powi(2);
        let length_mm = self.set_tab(unled.outline);
        if length_mm > 0.0 && !outline.contour.closed {
            let sentence = say!(an_open_contour_keeps_no_tab, self.name(unled.outline));
            let source = unled.walls.first().map(|wall| wall.source);
            return Err(self.refused(source, sentence));
        }
        // A contour that is named keeps its tab, whatever drops.
        let is_named = matches!(settings.tab, LengthSetting::ByHandle(_));
        let keeps_one = length_mm > 0.0
            && matches!(outline.role, Role::Punch | Role::Opening)
            && (!self.has_waste_inside(unled.outline) || settings.keeps_slug(area) || is_named);
        let stands = unled.passes.iter().any(|pass| pass.path.is_empty());
        let Some(entry) = unled.entry.filter(|_| keeps_one && !stands) else {
            return Ok(None);
        };
        let length = self.hold_shorter(unled, length_mm, |tab, handle, length| {
            say!(the_tab_is_longer_than_contour, tab, handle, length)
        })?;
        let (mut left, mut wall, mut share) = (self.units(length_mm), entry.wall, entry.share);
        loop {
            let geometry = &unled.walls[wall].geometry;
            let along = geometry.length();
            if share * along >= left || left <= 1e-12 * length {
                let share = (share - left / along).clamp(0.0, 1.0);
                return Ok(Some(Entry {
                    wall,
                    share,
                    point: geometry.point_at(share),
                }));
            }
            left -= share * along;
            wall = (wall + unled.walls.len() - 1) % unled.walls.len();
            share = 1.0;
        }
    }

    /// How far each pass goes on past its start, drawing units.
    fn overlap(&self, unled: &Unled) -> Result<f64, Refusal> {
        let overlap = self.settings.closing_overlap;
        if overlap > 0.0 && self.outlines[unled.outline].contour.closed {
            self.hold_shorter(unled, overlap, |overlap, handle, length| {
                say!(the_overlap_is_longer_than_contour, overlap, handle, length)
            })?;
        }
        Ok(self.units(overlap))
    }

    /// The length of its tab that the settings give an outline, mm.
    pub(super) fn set_tab(&self, outline: usize) -> f64 {
        let pieces = self.outlines[outline].contour.pieces.iter();
        let of = pieces.filter_map(|piece| Some(&*self.drawing.get(piece.entity)?.handle));
        self.settings.tab_of(of)
    }

    /// The length of a contour in drawing units; an error where `mm` is at least as long.
    fn hold_shorter(
        &self,
        unled: &Unled,
        mm: f64,
        sentence: impl Fn(f64, &str, f64) -> String,
    ) -> Result<f64, Refusal> {
        let length: f64 = unled.walls.iter().map(|wall| wall.geometry.length()).sum();
        if self.units(mm) < length {
            return Ok(length);
        }
        let source = unled.walls.first().map(|wall| wall.source);
        let sentence = sentence(mm, self.name(unled.outline), length * self.unit_mm);
        Err(self.refused(source, sentence))
    }
}

/// One path along a contour.
#[derive(Clone, Copy)]
struct Stage {
    /// The number of the pass, from 0.
    number: usize,
    cut_off: bool,
    is_way_back: bool,
}

/// The paths of this many passes in their order. Passes that all go one way to a tab go back before the next one. The tab is cut to and fro, so
/// that the last cut ends at the thread hole: it begins there for an even number of passes, else where the last pass ends.
fn stages(count: usize, keeps_tab: bool, is_one_way: bool) -> Vec<Stage> {
    let mut stages = Vec::new();
    let mut add = |number: usize, cut_off: bool, is_way_back: bool| {
        stages.push(Stage {
            number,
            cut_off,
            is_way_back,
        });
    };
    for number in 0..count {
        add(number, false, false);
        let is_last = number + 1 == count;
        if keeps_tab && is_one_way && (!is_last || count.is_multiple_of(2)) {
            add(number, false, true);
        }
    }
    if keeps_tab {
        (0..count).for_each(|number| add(number, true, false));
    }
    stages
}

/// How a pass is travelled.
struct Form {
    back: bool,
    /// The thread hole, where a straight way leads from it to the pass.
    thread: Option<Point>,
    /// How many passes there are.
    count: usize,
    is_last: bool,
}

fn reversed(piece: &PathSegment) -> PathSegment {
    PathSegment {
        geometry: piece.geometry.reversed(),
        ..*piece
    }
}

/// The parts of a way before and after a point; where the way comes there several times, the last time counts.
fn split(mut way: Vec<Element>, at: Point, rounding: f64) -> (Vec<Element>, Vec<Element>) {
    let is_there = |element: &Element| element.geometry.distance_to(at) <= rounding;
    let Some(index) = way.iter().rposition(is_there) else {
        return (way, Vec::new());
    };
    let element = way[index];
    let length = element.geometry.length();
    let share = element.geometry.share_of(at).clamp(0.0, 1.0);
    if share * length <= rounding {
        let behind = way.split_off(index);
        return (way, behind);
    }
    if (1.0 - share) * length <= rounding {
        let behind = way.split_off(index + 1);
        return (way, behind);
    }
    let mut behind = way.split_off(index);
    behind[0].geometry = with_ends(
        element.geometry.part(share, 1.0),
        at,
        element.geometry.end(),
    );
    let before = with_ends(
        element.geometry.part(0.0, share),
        element.geometry.start(),
        at,
    );
    way.push(Element {
        geometry: before,
        ..element
    });
    (way, behind)
}

/// A segment with these ends, which differ from its own by rounding alone.
fn with_ends(mut segment: Segment, start: Point, end: Point) -> Segment {
    match &mut segment {
        Segment::Line(line) => (line.start, line.end) = (start, end),
        Segment::Arc(arc) => (arc.start, arc.end) = (start, end),
    }
    segment
}

/// The beginning of a way once more, in this length.
fn beyond(way: impl Iterator<Item = PathSegment>, length: f64) -> Vec<PathSegment> {
    let (mut left, mut pieces) = (length, Vec::new());
    for PathSegment { geometry, source } in way {
        let along = geometry.length();
        let geometry = match left < along {
            true => geometry.part(0.0, left / along),
            false => geometry,
        };
        let source = match source {
            Source::Segment { entity, segment } | Source::Corner { entity, segment } => {
                Source::Overlap { entity, segment }
            }
            other => other,
        };
        pieces.push(PathSegment { geometry, source });
        left -= along;
        if left <= 0.0 {
            break;
        }
    }
    pieces
}
