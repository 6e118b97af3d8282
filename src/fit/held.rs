//! Two outlines, one held in the other.
//!
//! A place of the punch binds where it is farther than half a kerf from the way of the wire that cut the plate, and the other way round. Along
//! walls that both wires follow, the clearance is what the kerfs leave. It is missing where a wire turned in a point and left its own
//! radius: how much is missing follows from the places of the other part that are nearest to that point, and of these from the farthest; and
//! where walls lie folded, from how near the two outlines come to each other there, or how deep one stands in the other.

use super::Spot;
use super::about::{About, FitLimits};
use super::observations::{Lies, Verdict, verdict_on};
use super::penetration::{Deep, depth};
use super::places::own_places;
use super::walls::{nearest_places, sharper, wall};
use crate::geometry::{
    Bounds, Few, Point, Segment, Vector, cross, line_circle, line_line, meetings, reached,
};
use crate::toolpath::Part;
use rayon::iter::{IntoParallelIterator, ParallelExtend, ParallelIterator};
use rayon::slice::ParallelSlice;
use std::ops::Range;
use std::sync::Arc;

/// The result for two parts, one laid in the other.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    /// The least clearance where no edge stands too far out.
    unless: f64,
    /// What was seen of corners of the punch, of those of the plate, and of walls of the punch.
    verdicts: [Vec<Verdict>; 3],
    /// The numbers of those of walls that are not about the same place as another one.
    places: Vec<u32>,
    /// One place that stands for all walls, where they lie too near to each other everywhere.
    apart: Option<Spot>,
    /// What the two are called.
    names: [Arc<str>; 2],
}

/// A corner is examined up to this many half kerfs from where the wire turned.
const FARTHEST: f64 = 16.0;

/// Edges that one core takes at a time.
const AT_A_TIME: usize = 256;

/// How often the required clearance is doubled to find out how much is left: partners lie within five clearances of each other.
const DOUBLINGS: u32 = 6;

/// Corners lie on their edges except for rounding, so edges are looked for farther away by this factor.
const WIDER: f64 = 1.0 + 1e-3;

/// Lays the punch in the plate. `names` are what the two are called.
pub(super) fn held(parts: [&Part; 2], names: &[Arc<str>; 2], limits: &FitLimits) -> Held {
    let verdicts = [0, 1, 2].map(|which| match which {
        2 if limits.along_walls.is_some() => Vec::new(),
        which => verdicts(which, parts, limits),
    });
    let (unless, apart) = all_apart(parts, names, limits);
    Held {
        unless,
        places: own_places(&verdicts, parts[0].edges.len() as u32, limits.rounding),
        verdicts,
        apart,
        names: names.clone(),
    }
}

/// The clearance where no edge stands too far out, and the place that stands for all walls where that is less than there should be.
fn all_apart(
    [punch, plate]: [&Part; 2],
    [of_punch, of_plate]: &[Arc<str>; 2],
    limits: &FitLimits,
) -> (f64, Option<Spot>) {
    let is_less = |apart: &f64| *apart < limits.clearance - limits.rounding;
    let Some(apart) = limits.along_walls.filter(is_less) else {
        return (limits.clearance, None);
    };
    let spot = || {
        let at = punch.edges.first()?.geometry.point_at(0.5);
        let (_, near) = plate.near.nearest_to(at, plate.half)?;
        Some(Spot {
            at,
            turn: 0.0,
            clearance: apart,
            is_of_plate: false,
            segment: punch.segment_at(0, at)?,
            of: of_punch.clone(),
            other: plate.segment_at(near, at)?,
            partner: of_plate.clone(),
            sharper: None,
        })
    };
    (apart, spot())
}

impl Held {
    /// The least clearance all round, at most the required one.
    pub(crate) fn least(&self) -> f64 {
        let clearances = self.clearances().map(|(_, clearance)| clearance);
        clearances.fold(self.unless, f64::min)
    }

    /// The least clearance all round of the parts that were compared, even where it is more than the required one.
    pub(super) fn least_left(&self, parts: [&Part; 2], limits: &FitLimits) -> f64 {
        match self.clearances().next() {
            Some(_) => self.least(),
            None => more_than_wanted(parts, &self.names, limits),
        }
    }

    /// Where less clearance is left than there should be, and how much, in the order of the outline of the punch, then of that of the plate.
    pub(crate) fn clearances(&self) -> impl Iterator<Item = (Point, f64)> {
        let apart = self.apart.iter().map(|spot| (spot.at, spot.clearance));
        let verdicts = self.verdicts();
        apart.chain(verdicts.map(|(_, verdict)| (verdict.at, verdict.clearance)))
    }

    /// What was seen of corners of the punch (0), of those of the plate (1), and of walls (2): each place once.
    fn verdicts(&self) -> impl Iterator<Item = (usize, &Verdict)> {
        let [of_punch, of_plate, of_walls] = &self.verdicts;
        let of_walls = self
            .places
            .iter()
            .filter_map(|&number| of_walls.get(number as usize));
        let corners = of_punch.iter().map(|verdict| (0, verdict));
        let corners = corners.chain(of_plate.iter().map(|verdict| (1, verdict)));
        corners.chain(of_walls.map(|verdict| (2, verdict)))
    }

    /// The name of the part whose wire turned in a corner within `wide` of a place; the first of the two, if both did.
    pub(crate) fn corner_near(&self, parts: [&Part; 2], at: Point, wide: f64) -> Option<&Arc<str>> {
        let of_each = self.verdicts.iter().zip(parts).zip(&self.names);
        let mut first = of_each.filter_map(|((verdicts, part), name)| {
            let mut is_any = false;
            part.near.find(&Bounds::of_disc(at, wide * WIDER), |edge| {
                let verdict = verdict_on(verdicts, edge);
                is_any |= verdict.is_some_and(|verdict| (verdict.at - at).norm() <= wide);
                is_any
            });
            is_any.then_some(name)
        });
        first.next()
    }

    /// All places where clearance is missing, of the parts that were compared.
    pub(crate) fn spots<'a>(&'a self, parts: [&'a Part; 2]) -> impl Iterator<Item = Spot> + 'a {
        let verdicts = self.verdicts();
        let spots =
            verdicts.filter_map(move |(which, verdict)| spot(which, verdict, parts, &self.names));
        self.apart.iter().cloned().chain(spots)
    }

    /// The same on all cores.
    pub(super) fn all_spots(&self, parts: [&Part; 2]) -> Vec<Spot> {
        let verdicts: Vec<(usize, &Verdict)> = self.verdicts().collect();
        let mut all = Vec::with_capacity(1 + verdicts.len());
        all.extend(self.apart.clone());
        all.par_extend(verdicts.par_chunks(AT_A_TIME).flat_map_iter(|some| {
            // Each core has names of its own: counting the uses of a shared one, they would wait for each other.
            let names = self.names.each_ref().map(|name| Arc::from(&**name));
            let spots = some.iter();
            spots.filter_map(move |(which, verdict)| spot(*which, verdict, parts, &names))
        }));
        all
    }
}

/// The place that a look is about.
fn spot(
    which: usize,
    verdict: &Verdict,
    [punch, plate]: [&Part; 2],
    [of_punch, of_plate]: &[Arc<str>; 2],
) -> Option<Spot> {
    let is_of_plate = which == 1;
    let ([one, other], [of, partner]) = match is_of_plate {
        true => ([plate, punch], [of_plate, of_punch]),
        false => ([punch, plate], [of_punch, of_plate]),
    };
    let edge = &one.edges[verdict.edge as usize];
    let turn = edge.turned_about.and(edge.geometry.as_arc());
    let segment = one.segment_at(verdict.edge as usize, verdict.at)?;
    let nearest = verdict.other as usize;
    let mut partner_segment = other.segment_at(nearest, verdict.at_other)?;
    // Two segments meet in a corner of a contour that is cut twice; before its first one comes the last.
    if partner_segment == segment && turn.is_some() {
        let before = nearest.checked_sub(1).unwrap_or(other.edges.len() - 1);
        partner_segment = other.segment_at(before, verdict.at_other)?;
    }
    Some(Spot {
        at: verdict.at,
        turn: turn.map_or(0.0, |arc| arc.sweep.abs()),
        clearance: verdict.clearance,
        is_of_plate,
        segment,
        of: of.clone(),
        other: partner_segment,
        partner: partner.clone(),
        sharper: match which {
            2 => sharper(verdict, [punch, plate]),
            _ => None,
        },
    })
}

/// How much is left at the tightest place of parts that have the clearance everywhere: more and more is required until it is missing.
fn more_than_wanted(parts: [&Part; 2], names: &[Arc<str>; 2], limits: &FitLimits) -> f64 {
    let least = |clearance: f64| {
        let more = FitLimits {
            clearance,
            ..*limits
        };
        let held = held(parts, names, &more);
        Some(held.least()).filter(|least| *least < clearance)
    };
    match limits.along_walls {
        Some(apart) if apart > limits.clearance => least(apart).unwrap_or(apart),
        Some(_) => limits.clearance,
        None => {
            let mut asked = (1..=DOUBLINGS).map(|nth| limits.clearance * f64::from(1 << nth));
            asked.find_map(least).unwrap_or(limits.clearance)
        }
    }
}

/// What one kind of look says of an edge.
fn look(
    which: usize,
    [punch, plate]: [&Part; 2],
    edge: usize,
    about: &mut About,
    limits: &FitLimits,
) -> Option<Verdict> {
    match which {
        0 => corner([punch, plate], edge, about, limits),
        1 => corner([plate, punch], edge, about, limits),
        _ => wall([punch, plate], edge, about, limits),
    }
}

/// What a look at each edge says of those that stand too far out.
fn verdicts(which: usize, parts: [&Part; 2], limits: &FitLimits) -> Vec<Verdict> {
    let count = parts[usize::from(which == 1)].edges.len();
    let some = |edges: Range<usize>| {
        let mut about = About::of(which, parts);
        let verdicts = edges.filter_map(|edge| look(which, parts, edge, &mut about, limits));
        verdicts.collect::<Vec<_>>()
    };
    if count <= AT_A_TIME {
        // Waking a core would take longer.
        return some(0..count);
    }
    let steps = (0..count.div_ceil(AT_A_TIME)).into_par_iter();
    let parts: Vec<Vec<Verdict>> = steps
        .map(|step| some(step * AT_A_TIME..((step + 1) * AT_A_TIME).min(count)))
        .collect();
    parts.concat()
}

/// A place where the wire turned in a point, and left less than the clearance to the other part: the tightest of those straight before that
/// point, of those where the two outlines are nearest to each other, and of those where one stands in the other.
fn corner(
    [one, other]: [&Part; 2],
    edge: usize,
    about: &mut About,
    limits: &FitLimits,
) -> Option<Verdict> {
    let turned = one.edges[edge].turned_about?;
    let before = farthest([one, other], edge, turned, about, limits);
    let before = before.map(|(far, at_other, on)| Verdict {
        edge: edge as u32,
        at: turned + (at_other - turned) * (one.radius_of(edge) / far),
        clearance: one.radius_of(edge) - far,
        other: on as u32,
        at_other,
        lies: Lies::InCorner { away: far },
    });
    let nearest = nearest([one, other], edge, about, limits);
    let is_tighter = |it: &Verdict| {
        let known = before.as_ref().map_or(limits.clearance, |it| it.clearance);
        it.clearance < known - limits.rounding
    };
    nearest.filter(is_tighter).or(before)
}

/// Where an edge comes nearest to the other part, or how deep one of the two stands in the other there.
fn nearest(
    [one, other]: [&Part; 2],
    edge: usize,
    about: &mut About,
    limits: &FitLimits,
) -> Option<Verdict> {
    let geometry = &one.edges[edge].geometry;
    let area = geometry.bounds().grown(limits.clearance);
    let (mut nearest, mut crossed) = (None, Vec::new());
    let mut least = limits.clearance - limits.rounding;
    about.edges.find(&area, |on| {
        if let Some(away) = other.near.distance_below(geometry, on, least) {
            least = away.max(limits.rounding);
            nearest = Some((away, on));
            if away <= limits.rounding {
                crossed.push(on);
            }
        }
        false
    });
    let mut deepest: Option<Deep> = None;
    let mut look = |parts: [&Part; 2], begins: (usize, f64)| {
        let deep = depth(parts, begins, limits);
        let is_deeper = |it: &Deep| deepest.is_none_or(|known| it.depth > known.depth);
        deepest = deep.filter(is_deeper).or(deepest);
    };
    for on in crossed {
        let partner = &other.edges[on].geometry;
        for at in meetings(geometry, partner) {
            look([other, one], (on, partner.share_of(at)));
            look([one, other], (edge, geometry.share_of(at)));
        }
    }
    let (away, on) = nearest?;
    let verdict = |clearance: f64, at: Point, at_other: Point| Verdict {
        edge: edge as u32,
        at,
        clearance,
        other: on as u32,
        at_other,
        lies: Lies::InCorner {
            away: one.radius_of(edge) - clearance,
        },
    };
    match deepest {
        Some(Deep { depth, at, way }) => Some(verdict(-depth, at - way, at)),
        None => {
            let (at, at_other) = nearest_places(geometry, &other.edges[on].geometry);
            Some(verdict(away, at, at_other))
        }
    }
}

/// Of the places of the other part that are nearest to where the wire turned, the farthest one: how far away it is, where, and on which edge.
/// `None` where the clearance is kept.
fn farthest(
    [one, other]: [&Part; 2],
    index: usize,
    turned: Point,
    about: &mut About,
    limits: &FitLimits,
) -> Option<(f64, Point, usize)> {
    let arc = one.edges[index].geometry.as_arc()?;
    let (from, to) = (arc.start - turned, arc.end - turned);
    let sense = arc.sweep.signum();
    let is_whole = arc.is_full_turn();
    let own = one.radius_of(index);
    let slack = limits.rounding * own;
    let is_within = |way: Vector| {
        is_whole || cross(from, way) * sense >= -slack && cross(way, to) * sense >= -slack
    };
    let kept = own - limits.clearance + limits.rounding;
    let widest = (arc.sweep / 2.0).cos().max(1.0 / FARTHEST);
    let reach = (own + 2.0 * limits.clearance) / widest;
    let mut places: Vec<(f64, Point, usize)> = Vec::new();
    let area = Bounds::of_disc(turned, reach);
    about.edges.find(&area, |edge| {
        let geometry = &other.edges[edge].geometry;
        let ends = [geometry.start(), geometry.end()];
        let mut own: Few<Point, 8> = ends.into_iter().collect();
        let is_far = |end: &Point| (end - turned).norm() > kept;
        match geometry {
            // No place of a line is farther than one of its ends.
            Segment::Line(_) if !ends.iter().any(is_far) => return false,
            _ if is_whole => {}
            _ => own.extend(
                [from, to]
                    .into_iter()
                    .flat_map(|ray| crossed(geometry, turned, ray)),
            ),
        }
        if let Segment::Arc(round) = geometry
            && let Some(axis) = (round.center - turned).try_normalize(0.0)
        {
            own.extend(
                [axis, -axis]
                    .into_iter()
                    .filter_map(|way| reached(round, way)),
            );
        }
        for at in own {
            let far = (at - turned).norm();
            if far > kept && is_within(at - turned) {
                places.push((far, at, edge));
            }
        }
        false
    });
    places.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.2.cmp(&b.2)));
    let mut is_nearest = |&(far, at, _): &(f64, Point, usize)| {
        let from_way = far - one.edges[index].swing;
        about.way.nearer(at, from_way - limits.rounding).is_none()
    };
    places.into_iter().find(|place| is_nearest(place))
}

/// Where a segment meets a ray.
fn crossed(segment: &Segment, from: Point, ray: Vector) -> Few<Point, 2> {
    let found: Few<Point, 2> = match segment {
        Segment::Line(line) => line_line(line.start, line.end - line.start, from, ray)
            .into_iter()
            .collect(),
        Segment::Arc(arc) => line_circle(from, ray, arc.center, arc.radius),
    };
    found.into_iter().filter(|at| segment.spans(*at)).collect()
}
