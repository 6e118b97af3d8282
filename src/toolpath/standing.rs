//! What holds a part until its tab is cut off: the narrowest neck between the two ends of all that is cut up to the stop, and the
//! slug that it is to hold.
//!
//! The *beginning* of the cut is the start hole, the way in, and the first quarter of each pass; its *end* is the last quarter, and what
//! leads on from there. Where a piece of the one comes near to a piece of the other, the cut between the two goes round the part, and only what stands
//! between them holds it: mostly the tab, which is measured along the contour, less a kerf; less than that beside a slanted lead, a
//! wide arc or a large start hole. Where the cut of a slug meets itself elsewhere, as a lead in a narrow arm does that reaches the other
//! side, the slug is in pieces, of which the tab holds one.

use super::clearance::Walls;
use super::job::Job;
use super::leads::{fault, finding};
use super::offset::normal;
use super::path::{PathSegment, Source, WirePath};
use crate::drawing::{Drawing, Outline};
use crate::finding::{Finding, Rule, Severity};
use crate::geometry::{Bounds, Grid, Point, Segment, Vector, cross};
use crate::settings::Effective;

/// A neck below this share of its tab is a warning.
const THIN: f64 = 1.0 / 3.0;

/// The least area of a piece that is said to be loose, mm²: less is a crumb.
const LEAST_LOOSE: f64 = 1.0;

/// The most places of one path that are looked at.
const MOST_PLACES: usize = 100_000;

/// How much of a pass counts to its beginning, and to its end.
const SHARE_OF_ENDS: f64 = 0.25;

/// What a neck holds is at least this share of what the passes go round: a narrow place of the part itself is none.
const LEAST_HELD: f64 = 0.9;

/// Pieces of a cut are no longer than this share of it.
const PIECE: f64 = 1.0 / 100.0;

/// A neck. Lengths in mm.
struct Neck {
    outline: usize,
    /// 0 or less where nothing stands.
    width: f64,
    tab: f64,
    /// Between the two ends of the cut, drawing units.
    at: Point,
    /// At its end.
    source: Source,
}

impl Job<'_> {
    /// The tabs of which nothing is left standing.
    pub(super) fn cut_through(&self, paths: &[WirePath]) -> Vec<Finding> {
        let gone = self.necks(paths).filter(|neck| neck.width <= 0.0);
        let said = gone.map(|neck| {
            let Neck { tab, at, width, .. } = neck;
            let at = self.in_mm(at);
            let sentence = say!(
                nothing_of_the_tab_is_left_standing,
                tab,
                self.name(neck.outline),
                at.x,
                at.y,
                tab - width
            );
            fault(self.severity(), Some(neck.source), sentence, None)
        });
        said.collect()
    }

    /// The narrowest neck of each contour that keeps a tab.
    fn necks(&self, paths: &[WirePath]) -> impl Iterator<Item = Neck> {
        let (settings, unit_mm) = (self.settings, self.unit_mm);
        kept(paths).filter_map(move |first| {
            let mut cut = CutUpToStop::about(first.thread_hole);
            let of_contour = |path: &&WirePath| path.outline == first.outline;
            let up_to_stop = paths.iter().filter(of_contour);
            for path in up_to_stop.filter(|path| !path.cut_off && !path.is_way_back) {
                let half = half_kerf(settings, unit_mm, path.pass);
                let is_back = path.counter_clockwise != first.counter_clockwise;
                let wire = wire_of(path, beside(settings, unit_mm, path), is_back);
                cut.add(&wire, half);
            }
            if let (Some(diameter), Some(entered)) = (settings.start_hole, cut.beginning.first()) {
                let hole = first.thread_hole;
                cut.beginning.push(CutPiece {
                    geometry: Segment::line(hole, hole),
                    radius: self.units(diameter) / 2.0,
                    ..*entered
                });
            }
            let (width, at, source) = cut.narrowest()?;
            Some(Neck {
                outline: first.outline,
                width: width * unit_mm,
                tab: self.set_tab(first.outline),
                at,
                source,
            })
        })
    }
}

/// What holds by tabs: warnings of those that hold by much less than their length, and of slugs that are in pieces before the tab is cut; where
/// there is none, the narrowest neck of all as information.
pub(crate) fn holds(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    paths: &[WirePath],
) -> Vec<Finding> {
    let Some(severity) = settings.severity_over(Rule::LeadIn, Severity::Warning) else {
        return Vec::new();
    };
    let job = Job::of(drawing, outlines, settings);
    let said = |severity: Severity, source: Source, sentence: String| {
        finding(Rule::LeadIn, severity, source.place(), sentence, None)
    };
    let of_neck = |severity: Severity, neck: &Neck| {
        let (handle, at) = (job.name(neck.outline), job.in_mm(neck.at));
        let sentence = say!(
            the_tab_stands_by_a_neck,
            neck.tab,
            handle,
            neck.width,
            at.x,
            at.y
        );
        said(severity, neck.source, sentence)
    };
    let mut necks: Vec<Neck> = job.necks(paths).collect();
    necks.sort_by(|one, other| one.width.total_cmp(&other.width));
    let thin = necks.iter().filter(|neck| neck.width < THIN * neck.tab);
    let mut found: Vec<Finding> = thin.map(|neck| of_neck(severity, neck)).collect();
    let slugs = kept(paths).filter(|path| {
        let role = outlines.get(path.outline).map(|outline| outline.role);
        role.is_some_and(|role| settings.has_waste_inside(role))
    });
    found.extend(slugs.filter_map(|path| {
        let Loose { at, area, source } = loose(settings, job.unit_mm, path)?;
        let at = job.in_mm(at);
        let sentence = say!(
            the_cut_meets_itself,
            job.name(path.outline),
            at.x,
            at.y,
            area
        );
        Some(said(severity, source, sentence))
    }));
    if found.is_empty() {
        let narrowest = necks
            .first()
            .map(|neck| of_neck(Severity::Information, neck));
        found.extend(narrowest);
    }
    found
}

/// The first pass of each contour that keeps a tab.
fn kept(paths: &[WirePath]) -> impl Iterator<Item = &WirePath> {
    let is_off = |path: &&WirePath| path.cut_off && path.pass == 1;
    paths.iter().filter(is_off).filter_map(|off| {
        let of_contour = |path: &&WirePath| path.outline == off.outline && path.is_first();
        paths.iter().find(of_contour)
    })
}

/// It follows the contour for the first time.
fn is_held(source: Source) -> bool {
    matches!(source, Source::Segment { .. } | Source::Corner { .. })
}

/// Half the kerf of a pass; where it is not known, the last correction: a rough pass takes no stock of the others.
fn half_kerf(settings: &Effective, unit_mm: f64, pass: usize) -> f64 {
    let half = settings.half_kerf(pass - 1);
    half.unwrap_or_else(|| settings.last_correction()) / unit_mm
}

/// How far the wire runs beside what is written, drawing units.
fn beside(settings: &Effective, unit_mm: f64, path: &WirePath) -> f64 {
    path.side
        .map_or(0.0, |_| path.offset(settings, unit_mm) / unit_mm)
}

/// The way of the wire in a pass, in the direction of the first one. Where the control offsets the path, it comes to the wire's side along the
/// first piece and leaves it along the last one, if these are leads.
fn wire_of(path: &WirePath, beside: f64, is_back: bool) -> Vec<PathSegment> {
    let pieces = &path.segments;
    let side = path.side.map_or(0.0, |side| side.sign());
    let is_lead = |index: usize| !is_held(pieces[index].source);
    let across = |index: usize, share: f64| normal(&pieces[index].geometry, share, side) * beside;
    let moved = |(index, piece): (usize, &PathSegment)| {
        let whole = piece.geometry;
        let (is_first, is_last) = (index == 0, index + 1 == pieces.len());
        // A lead ends where the wire goes on, and begins where it was.
        let by_start = match is_lead(index) {
            true if is_first => Vector::zeros(),
            true => across(index - 1, 1.0),
            false => across(index, 0.0),
        };
        let by_end = match is_lead(index) {
            true if is_last => Vector::zeros(),
            true => across(index + 1, 0.0),
            false => across(index, 1.0),
        };
        let (start, end) = (whole.start() + by_start, whole.end() + by_end);
        let geometry = match beside == 0.0 {
            true => whole,
            false => Segment::from_bulge(start, end, whole.bulge()),
        };
        PathSegment { geometry, ..*piece }
    };
    let mut wire: Vec<PathSegment> = pieces.iter().enumerate().map(moved).collect();
    if is_back {
        wire.reverse();
        wire.iter_mut()
            .for_each(|piece| piece.geometry = piece.geometry.reversed());
    }
    wire
}

/// A piece of what is cut.
#[derive(Clone, Copy)]
struct CutPiece {
    geometry: Segment,
    /// How far it is cut about the way of the wire.
    radius: f64,
    /// Twice the area that the way from the entry to this piece covers, seen from the thread hole.
    twice_area: f64,
    source: Source,
}

/// What is cut along one contour up to the stop.
struct CutUpToStop {
    beginning: Vec<CutPiece>,
    end: Vec<CutPiece>,
    /// Areas are those about this point.
    origin: Point,
    /// Twice the area that the last pass goes round, closed across the tab.
    twice_area: f64,
}

impl CutUpToStop {
    fn about(origin: Point) -> CutUpToStop {
        CutUpToStop {
            beginning: Vec::new(),
            end: Vec::new(),
            origin,
            twice_area: 0.0,
        }
    }

    /// Adds the way of the wire in one pass.
    fn add(&mut self, wire: &[PathSegment], radius: f64) {
        let origin = self.origin;
        let lengths = wire.iter().filter(|piece| is_held(piece.source));
        let length: f64 = lengths.map(|piece| piece.geometry.length()).sum();
        if length <= 0.0 {
            return;
        }
        let before = wire.iter().take_while(|piece| !is_held(piece.source));
        let area = |piece: &PathSegment| piece.geometry.twice_area(origin);
        let mut twice_area: f64 = -before.map(area).sum::<f64>();
        let (mut along, mut entry) = (0.0, None);
        for piece in wire {
            let (whole, is_held) = (piece.geometry, is_held(piece.source));
            if is_held {
                entry.get_or_insert(whole.start() - origin);
            }
            let count = (whole.length() / (PIECE * length))
                .ceil()
                .clamp(1.0, MOST_PLACES as f64);
            for nth in 0..count as usize {
                let [from, to] = [nth, nth + 1].map(|nth| nth as f64 / count);
                let geometry = if count == 1.0 {
                    whole
                } else {
                    whole.part(from, to)
                };
                let share = along / length;
                let side = match share {
                    _ if entry.is_none() || share < SHARE_OF_ENDS => Some(&mut self.beginning),
                    _ if share > 1.0 - SHARE_OF_ENDS => Some(&mut self.end),
                    _ => None,
                };
                if let Some(side) = side {
                    side.push(CutPiece {
                        geometry,
                        radius,
                        twice_area,
                        source: piece.source,
                    });
                }
                twice_area += geometry.twice_area(origin);
                along += if is_held { geometry.length() } else { 0.0 };
            }
            if let Some(entry) = entry.filter(|_| is_held) {
                self.twice_area = twice_area + cross(whole.end() - origin, entry);
            }
        }
    }

    /// The narrowest place between the beginning and the end: how wide it is, drawing units, where, and what the end follows there.
    fn narrowest(&self) -> Option<(f64, Point, Source)> {
        let geometries = self.beginning.iter().map(|piece| piece.geometry);
        let beginning = Walls::by_one_core(geometries.collect());
        let radii = self.beginning.iter().map(|piece| piece.radius);
        let widest = radii.fold(0.0, f64::max);
        // The cut from the one to the other, closed between them, goes round the part.
        let goes_round = |from: &CutPiece, to: &CutPiece| {
            let [one, other] = [to, from].map(|piece| piece.geometry.start() - self.origin);
            let twice_area = to.twice_area - from.twice_area + cross(one, other);
            twice_area / self.twice_area >= LEAST_HELD
        };
        // Nothing is wider than the tab itself, straight across: what lies farther apart is not looked at.
        let entry = self.beginning.iter().find(|piece| is_held(piece.source))?;
        let end = self.end.last()?;
        let across = (entry.geometry.start() - end.geometry.end()).norm();
        let mut width = across - entry.radius - end.radius;
        let mut narrowest = (entry, end);
        for to in self.end.iter().rev() {
            let reach = to.geometry.bounds().grown(width + widest + to.radius);
            beginning.find(&reach, |index| {
                let from = &self.beginning[index];
                let radii = from.radius + to.radius;
                let away = beginning.distance_below(&to.geometry, index, width + radii);
                if let Some(away) = away.filter(|_| goes_round(from, to)) {
                    width = away - radii;
                    narrowest = (from, to);
                }
                false
            });
        }
        let (from, to) = narrowest;
        Some((
            width,
            nearest_place(&to.geometry, &from.geometry),
            to.source,
        ))
    }
}

/// The place of a segment that is nearest to another one, which it does not cross, but for stretches that run beside each other.
fn nearest_place(segment: &Segment, other: &Segment) -> Point {
    let feet = [other.start(), other.end()].map(|end| segment.share_of(end).clamp(0.0, 1.0));
    let places = [0.0, 1.0].into_iter().chain(feet);
    let away = |share: &f64| other.distance_to(segment.point_at(*share));
    let nearest = places.min_by(|one, two| away(one).total_cmp(&away(two)));
    segment.point_at(nearest.unwrap_or_default())
}

/// A piece of a slug that nothing holds, or the whole of it.
struct Loose {
    /// Where the cut meets itself.
    at: Point,
    /// mm².
    area: f64,
    source: Source,
}

/// A place of a path.
struct CutPlace {
    at: Point,
    /// How far it is cut about the place.
    radius: f64,
    /// Twice the area between the way so far and the origin.
    twice_area: f64,
    /// What is cut of it, from the beginning on.
    erased: f64,
    source: Source,
}

/// The largest piece that a path cuts out between two places where it meets itself. The tab lies beyond its end, so it holds none
/// of them.
fn loose(settings: &Effective, unit_mm: f64, path: &WirePath) -> Option<Loose> {
    let half = half_kerf(settings, unit_mm, path.pass);
    let wide = half + beside(settings, unit_mm, path);
    let spots = spots(path, half, wide)?;
    let body = |from: &CutPlace, to: &CutPlace| {
        let across = cross(to.at.coords, from.at.coords);
        let within = (to.twice_area - from.twice_area + across).abs() / 2.0;
        within - (to.erased - from.erased)
    };
    let hole = settings.start_hole.map(|diameter| diameter / unit_mm / 2.0);
    let mut worst: Option<(f64, &CutPlace)> = None;
    let mut look = |from: &CutPlace, to, reach: f64| {
        let to: &CutPlace = to;
        if (to.at - from.at).norm() >= from.radius + to.radius + reach {
            return;
        }
        let area = body(from, to);
        if worst.is_none_or(|(most, _)| area > most) {
            worst = Some((area, to));
        }
    };
    if let Some((first, hole)) = spots.first().zip(hole) {
        let more = (hole - first.radius).max(0.0);
        spots.iter().for_each(|spot| look(first, spot, more));
    }
    let mut before = Grid::default();
    for (nth, spot) in spots.iter().enumerate() {
        let cut = Bounds::of_disc(spot.at, wide);
        before.near(&cut, |nth: usize, _| look(&spots[nth], spot, 0.0));
        before.insert(nth, cut);
    }
    let (area, spot) = worst?;
    let area = area * unit_mm * unit_mm;
    (area >= LEAST_LOOSE).then_some(Loose {
        at: spot.at,
        area,
        source: spot.source,
    })
}

/// Places of a path, close enough to each other that nothing passes between them; `None` where they would be too many.
fn spots(path: &WirePath, half: f64, wide: f64) -> Option<Vec<CutPlace>> {
    let step = half / 2.0;
    let radius = |piece: &PathSegment| match is_held(piece.source) {
        true => wide,
        false => half,
    };
    let lengths = path.segments.iter().map(|piece| piece.geometry.length());
    let all: f64 = lengths.sum::<f64>() / step + path.segments.len() as f64;
    if all.is_nan() || all > MOST_PLACES as f64 {
        return None;
    }
    let mut spots: Vec<CutPlace> = Vec::with_capacity(all as usize + 1);
    for piece in &path.segments {
        if piece.source == Source::LeadOut {
            break;
        }
        let (length, radius) = (piece.geometry.length(), radius(piece));
        let count = (length / step).ceil().max(1.0);
        for nth in 0..=count as usize {
            let at = piece.geometry.point_at(nth as f64 / count);
            let (twice_area, erased) = spots.last().map_or((0.0, 0.0), |before| {
                let way = (at - before.at).norm();
                let area = cross(before.at.coords, at.coords);
                (before.twice_area + area, before.erased + way * radius)
            });
            spots.push(CutPlace {
                at,
                radius,
                twice_area,
                erased,
                source: piece.source,
            });
        }
    }
    Some(spots)
}
