//! What stands until a tab is cut off: the neck between the two ends of the cut, and the slug that it is to hold.
//!
//! A tab is measured along the contour; what stands is less, by a kerf at least, and by more beside a large start hole. Where the
//! cut of a slug meets itself, as a lead in a narrow arm does that reaches the other side, the slug is in pieces, of which
//! the tab holds one.

use super::job::Job;
use super::leads::{fault, finding};
use super::path::{PathSegment, Source, WirePath};
use crate::drawing::{Drawing, Outline};
use crate::finding::{Finding, Rule, Severity};
use crate::geometry::{Point, Vector, cross, left_normal};
use crate::settings::Effective;
use rustc_hash::FxHashMap;

/// A neck below this share of its tab is said.
const THIN: f64 = 1.0 / 3.0;

/// The least area of a piece that is said to be loose, mm²: less is a crumb.
const LEAST_LOOSE: f64 = 1.0;

/// The most places of one path that are looked at.
const MOST_PLACES: usize = 100_000;

/// A neck.
struct Neck {
    /// mm; 0 or less where nothing stands.
    width: f64,
    /// mm.
    tab: f64,
    /// mm on both sides together that are cut from the tab.
    cut: f64,
    /// At its beginning.
    source: Option<Source>,
}

impl Job<'_> {
    /// The tabs of which nothing is left standing.
    pub(super) fn cut_through(&self, paths: &[WirePath]) -> Vec<Finding> {
        let found = necks(self.settings, self.unit_mm, paths);
        let gone = found.filter(|(_, neck)| neck.width <= 0.0);
        let said = gone.map(|(path, neck)| {
            let handle = self.name(path.outline);
            let sentence = say!(
                nothing_of_the_tab_is_left_standing,
                self.set_tab(path.outline),
                handle,
                neck.cut
            );
            fault(self.severity(), neck.source, sentence, None)
        });
        said.collect()
    }
}

/// Warnings of tabs that hold by much less than their length, and of slugs that are in pieces before the tab is cut.
pub(crate) fn weak_tabs(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    paths: &[WirePath],
) -> Vec<Finding> {
    let Some(severity) = settings.severity_over(Rule::LeadIn, Severity::Warning) else {
        return Vec::new();
    };
    let job = Job::of(drawing, outlines, settings);
    let unit_mm = job.unit_mm;
    let said = |source: Option<Source>, sentence: String| {
        let place = source.and_then(Source::place);
        finding(Rule::LeadIn, severity, place, sentence, None)
    };
    let handle = |path: &WirePath| job.name(path.outline);
    let is_thin = |neck: &Neck| neck.width > 0.0 && neck.width < THIN * neck.tab;
    let thin = necks(settings, unit_mm, paths).filter(|(_, neck)| is_thin(neck));
    let mut found: Vec<Finding> = thin
        .map(|(path, neck)| {
            let tab = job.set_tab(path.outline);
            let sentence = say!(the_tab_stands_by_a_neck, tab, handle(path), neck.width);
            said(neck.source, sentence)
        })
        .collect();
    let kept = kept(paths).filter(|(path, _)| {
        let role = outlines.get(path.outline).map(|outline| outline.role);
        role.is_some_and(|role| settings.has_waste_inside(role))
    });
    found.extend(kept.filter_map(|(path, _)| {
        let Loose { at, area, source } = loose(settings, unit_mm, path)?;
        let at = job.in_mm(at);
        let sentence = say!(the_cut_meets_itself, handle(path), at.x, at.y, area);
        Some(said(source, sentence))
    }));
    found
}

/// The first pass of each contour that keeps a tab, and the length of the tab in drawing units.
fn kept(paths: &[WirePath]) -> impl Iterator<Item = (&WirePath, f64)> {
    let is_off = |path: &&WirePath| path.cut_off && path.pass == 1;
    paths.iter().filter(is_off).filter_map(|off| {
        let of_contour = |path: &&WirePath| path.outline == off.outline && path.is_first();
        let along = off.segments.iter().filter(|piece| is_held(piece.source));
        let length = along.map(|piece| piece.geometry.length()).sum();
        Some((paths.iter().find(of_contour)?, length))
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

/// The thinnest neck of each tab, over all passes that leave it.
fn necks<'a>(
    settings: &'a Effective,
    unit_mm: f64,
    paths: &'a [WirePath],
) -> impl Iterator<Item = (&'a WirePath, Neck)> {
    kept(paths).filter_map(move |(first, tab)| {
        let of_contour = |path: &&WirePath| path.outline == first.outline && !path.cut_off;
        let necks = paths.iter().filter(of_contour).filter_map(|path| {
            let half = half_kerf(settings, unit_mm, path.pass);
            let mut pieces = path.segments.iter().filter(|piece| is_held(piece.source));
            let begin = pieces.next()?;
            let end = pieces.next_back().unwrap_or(begin);
            let across = |tangent: Vector| match path.side {
                Some(side) => {
                    left_normal(tangent) * (side.sign() * beside(settings, unit_mm, path))
                }
                None => Vector::zeros(),
            };
            let (from, to) = (&begin.geometry, &end.geometry);
            let from = from.start() + across(from.start_tangent());
            let last = to.end() + across(to.end_tangent());
            let between = (last - from).norm() - 2.0 * half;
            // The hole is at the entry, where the first pass begins.
            let hole = settings.start_hole.filter(|_| path.pass == 1);
            let of_hole = hole
                .map(|diameter| (last - path.thread_hole).norm() - diameter / unit_mm / 2.0 - half);
            let width = of_hole.map_or(between, |of_hole| between.min(of_hole));
            Some(Neck {
                width: width * unit_mm,
                tab: tab * unit_mm,
                cut: (tab - width) * unit_mm,
                source: Some(end.source),
            })
        });
        let thinnest = necks.min_by(|a, b| a.width.total_cmp(&b.width))?;
        Some((first, thinnest))
    })
}

/// A piece of a slug that nothing holds, or the whole of it.
struct Loose {
    /// Where the cut meets itself.
    at: Point,
    /// mm².
    area: f64,
    source: Option<Source>,
}

/// A place of a path.
struct Spot {
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
    let body = |from: &Spot, to: &Spot| {
        let across = cross(to.at.coords, from.at.coords);
        let within = (to.twice_area - from.twice_area + across).abs() / 2.0;
        within - (to.erased - from.erased)
    };
    let hole = settings.start_hole.map(|diameter| diameter / unit_mm / 2.0);
    let mut worst: Option<(f64, &Spot)> = None;
    let mut look = |from: &Spot, to, reach: f64| {
        let to: &Spot = to;
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
    let cell = |at: Point| {
        let of = |number: f64| (number / (2.0 * wide)).floor() as i64;
        (of(at.x), of(at.y))
    };
    let mut cells: FxHashMap<(i64, i64), Vec<usize>> = FxHashMap::default();
    for (nth, spot) in spots.iter().enumerate() {
        let (x, y) = cell(spot.at);
        for near in (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y))) {
            let before = cells.get(&near).into_iter().flatten();
            before.for_each(|&before| look(&spots[before], spot, 0.0));
        }
        cells.entry((x, y)).or_default().push(nth);
    }
    let (area, spot) = worst?;
    let area = area * unit_mm * unit_mm;
    (area >= LEAST_LOOSE).then_some(Loose {
        at: spot.at,
        area,
        source: Some(spot.source),
    })
}

/// Places of a path, close enough to each other that nothing passes between them; `None` where they would be too many.
fn spots(path: &WirePath, half: f64, wide: f64) -> Option<Vec<Spot>> {
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
    let mut spots: Vec<Spot> = Vec::with_capacity(all as usize + 1);
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
            spots.push(Spot {
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
