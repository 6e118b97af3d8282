//! The path along one contour, proved, or the fault that prevents it.

use super::clearance::Walls;
use super::cores::{first_fault, sum};
use super::corners::{Element, Joining, Offsets, Raw, elements};
use super::crowd::{MOST_IN_A_SQUARE, crowd};
use super::job::{Job, ROUNDING};
use super::loops::{self, Found};
use super::nest::{Before, Nest};
use super::offset::Wall;
use super::open_contour::{Lost, one_side, there_and_back};
use super::path::Refusal;
use super::proof::{Beside, Proof, Unproved};
use super::ring::{Pieces, trimmed};
use super::skim_sweep::along_before;
use crate::drawing::ContourSegment;
use crate::finding::{Detail, Finding, NotJudged, Place, Rule, Severity};
use crate::geometry::{Bounds, Point, Segment, cross};
use std::borrow::Cow;
use std::sync::atomic::Ordering::Relaxed;

/// Walls up to this long, mm, are left out where there is no path otherwise.
const CRUMB: f64 = 4e-6;

/// Walls up to this long, mm, are left out where a path does not pass its proof otherwise.
const SPECK: f64 = 4e-5;

/// How a path runs along a contour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Along {
    /// +1 where the wire runs to the left of the walls, −1 to the right.
    pub(crate) side: f64,
    /// Drawing units; below 0 where the wire runs on the other side.
    pub(crate) correction: f64,
    pub(crate) closed: bool,
}

impl Along {
    /// The same by the side on which the wire runs.
    pub(super) fn on_own_side(self) -> Along {
        match self.correction < 0.0 {
            true => Along {
                side: -self.side,
                correction: -self.correction,
                ..self
            },
            false => self,
        }
    }
}

/// What a contour gives the wire.
pub(super) enum Laid {
    Path(Vec<Element>),
    /// The one place where the wire's centre may be.
    Point(Point),
}

/// The result for a contour.
pub(super) type Outcome = Result<Laid, Fault>;

/// Why a contour has no path, with the wall where that shows.
#[derive(Clone, Debug)]
pub(super) enum Fault {
    /// Nowhere along it does the wire fit.
    Nothing,
    /// There are several places for the wire with no way from one to the other: one in each that is lost.
    Several(Vec<Lost>),
    /// There is a path, but it does not pass its proof.
    Unproved { wall: usize },
    /// So many walls lie within the correction of each other that it would take too long to find out.
    Crowded,
}

impl Job<'_> {
    /// The walls of a contour with the wire on the given side (+1 left, −1 right), and the path
    /// along them, proved. Where there is none because of crumbs, they are left out: their
    /// neighbours move by less than what any control can follow.
    pub(crate) fn along(
        &self,
        count: usize,
        segment: impl Fn(usize) -> Option<ContourSegment> + Sync + Send,
        side: f64,
        correction: f64,
        closed: bool,
    ) -> Result<(Vec<Wall>, Walls, Outcome), Refusal> {
        let of = |shortest: f64| {
            let walls = self.walls_of(count, &segment, closed, shortest);
            let own = Walls::of(&walls);
            (walls, own)
        };
        let (walls, own) = of(self.settings.tolerances.zero_length);
        let along = Along {
            side,
            correction,
            closed,
        };
        let laid = self.laid(&walls, &own, along)?;
        let left_out: &[f64] = match laid {
            Ok(_) => &[],
            Err(Fault::Unproved { .. }) => &[CRUMB, SPECK],
            Err(Fault::Nothing | Fault::Several(_)) => &[CRUMB],
            Err(Fault::Crowded) => &[],
        };
        let mut longer = 0.0;
        for &most in left_out {
            let lengths = longer..=self.units(most);
            if walls
                .iter()
                .any(|wall| lengths.contains(&wall.geometry.length()))
            {
                let (walls, own) = of(most);
                if let Ok(path) = self.laid(&walls, &own, along)? {
                    return Ok((walls, own, Ok(path)));
                }
            }
            longer = self.units(most);
        }
        Ok((walls, own, laid))
    }

    /// How the corners of a path are made.
    pub(super) fn joining(&self, along: Along) -> Joining {
        Joining {
            correction: along.correction,
            side: along.side,
            touch: self.units(1e-7),
            tolerance: self.units(self.settings.tolerances.report),
        }
    }

    /// The path at just the correction, as `laid_within` has it.
    pub(super) fn laid_at(
        &self,
        walls: &[Wall],
        own: &Walls,
        along: Along,
        before: Option<Before>,
    ) -> Result<Outcome, Refusal> {
        let Along {
            side,
            correction,
            closed,
        } = along;
        if walls.is_empty() {
            return Ok(Err(Fault::Nothing));
        }
        if correction <= self.units(ROUNDING) {
            return Ok(Ok(Laid::Path(elements(walls))));
        }
        if crowd(own, 2.0 * correction) > MOST_IN_A_SQUARE {
            return Ok(Err(Fault::Crowded));
        }
        let round = match closed {
            true => Cow::Borrowed(walls),
            false => Cow::Owned(there_and_back(walls)),
        };
        let joining = self.joining(along);
        self.go_on()?;
        let rounding = self.units(ROUNDING);
        let of_round = || {
            let ends = |wall: &Wall| [wall.geometry.start_tangent(), wall.geometry.end_tangent()];
            round.iter().map(ends).collect()
        };
        let tangents = match closed {
            true => Cow::Borrowed(own.tangents()),
            false => Cow::Owned(of_round()),
        };
        let offsets = Offsets {
            walls: &round,
            tangents: &tangents,
            joining: &joining,
        };
        let place = Beside {
            walls: &round,
            own,
            correction,
            side,
            rounding,
            closed,
        };
        let proof = Proof { place, offsets };
        // One that was looked for among all crossings has its corners less exactly.
        if let Some(before) = before
            && closed
            && !self.searched.load(Relaxed)
            && let Some(path) = along_before(&proof, before, self.goes_on)
            && keeps_its_side(&path, walls, own, side)
        {
            return Ok(Ok(Laid::Path(path)));
        }
        self.go_on()?;
        let raw = Raw::new(offsets);
        let circle = || {
            let circle = raw.geometry(0);
            (circle.length() > 0.0).then(|| Pieces::of(vec![(0, offsets.element(0, circle))]))
        };
        let found = match raw.len() {
            1 => circle(),
            _ => trimmed(&raw),
        };
        let found = match closed {
            true => found.filter(|path| keeps_its_side(&path.elements, walls, own, side)),
            false => found.and_then(|path| {
                let path = one_side(vec![path.pairs().collect()], &raw, walls, correction);
                path.ok().map(Pieces::of)
            }),
        };
        if let Some(path) = found
            && self.holds(&proof, &raw, &path, before)?.is_ok()
        {
            return Ok(Ok(Laid::Path(path.elements)));
        }
        self.searched.store(true, Relaxed);
        self.among_crossings(&proof, &raw, walls)
    }

    /// The path among all crossings of the raw offsets of some walls, where cutting neighbours with each other is not enough.
    fn among_crossings(
        &self,
        proof: &Proof,
        raw: &Raw,
        walls: &[Wall],
    ) -> Result<Outcome, Refusal> {
        let mut loops = match loops::find(proof, raw, self.goes_on) {
            Found::Loops(loops) => loops,
            Found::Point(point) => return Ok(Ok(Laid::Point(point))),
            // Outside of a contour there is always room: one that is turned inside out somewhere is so where it is finest.
            Found::Nothing if !proof.is_inside() => {
                return Ok(Err(Fault::Unproved {
                    wall: shortest(walls),
                }));
            }
            Found::Nothing => return Ok(Err(Fault::Nothing)),
            Found::Torn(raw_element) => {
                return Ok(Err(Fault::Unproved {
                    wall: raw.key(raw_element) / 2,
                }));
            }
            Found::Cancelled => return Err(Refusal::Cancelled),
        };
        if !proof.closed {
            let path = match one_side(loops, raw, walls, proof.correction) {
                Ok(path) => path,
                Err(None) => return Ok(Err(Fault::Nothing)),
                Err(Some(lost)) => return Ok(Err(Fault::Several(vec![lost]))),
            };
            return self.vouched(proof, raw, Pieces::of(path));
        }
        if loops.len() > 1 {
            loops.retain(|path| {
                path.first()
                    .is_none_or(|(_, piece)| proof.is_on_wire_side(piece.geometry.point_at(0.5)))
            });
        }
        // The wire is threaded into the largest; outside a punch that is the one round it.
        let size = |path: &Vec<(usize, Element)>| {
            path.iter()
                .map(|(_, element)| element.geometry.length())
                .sum::<f64>()
        };
        loops.sort_by(|a, b| size(b).total_cmp(&size(a)));
        let mut loops = loops.into_iter();
        let Some(path) = loops.next() else {
            return Ok(Err(Fault::Nothing));
        };
        let path = Pieces::of(path);
        let lost: Vec<Lost> = loops.filter_map(|lost| farthest(&lost, &path)).collect();
        if !lost.is_empty() {
            return Ok(Err(Fault::Several(lost)));
        }
        if !keeps_its_side(&path.elements, walls, proof.own, proof.side) {
            return Ok(Err(Fault::Unproved { wall: 0 }));
        }
        self.vouched(proof, raw, path)
    }

    /// A path, where it passes its proof.
    fn vouched(&self, proof: &Proof, raw: &Raw, path: Pieces) -> Result<Outcome, Refusal> {
        Ok(self
            .holds(proof, raw, &path, None)?
            .map(|()| Laid::Path(path.elements))
            .map_err(|Unproved { wall }| Fault::Unproved { wall }))
    }

    /// Checks a path against its proof.
    fn holds(
        &self,
        proof: &Proof,
        raw: &Raw,
        path: &Pieces,
        before: Option<Before>,
    ) -> Result<Result<(), Unproved>, Refusal> {
        let go_on = || self.go_on();
        let place = &proof.place;
        let nest = before.map(|before| Nest::new(before, place.walls.len()));
        let Pieces {
            elements: pieces,
            raw: of,
        } = path;
        if place.closed {
            place.own.know_about(place.correction - place.rounding);
        }
        let held = first_fault(pieces.len(), go_on, |range| {
            place.pieces_hold(pieces[range].iter(), nest.as_ref())
        })?;
        if held.is_err() {
            return Ok(held);
        }
        if self.a_loop_will_do {
            return Ok(Ok(()));
        }
        let mut sorted = None;
        if !of.is_sorted_by(|one, next| one < next) {
            let share = |(index, piece): &(usize, Element)| {
                let whole = raw.geometry(*index);
                whole.share_of(piece.geometry.start())
            };
            let by_share = |a: &_, b: &_| share(a).total_cmp(&share(b));
            let mut pairs: Vec<(usize, Element)> = path.pairs().collect();
            pairs.sort_by(|a, b| a.0.cmp(&b.0).then_with(|| by_share(a, b)));
            sorted = Some(Pieces::of(pairs));
        }
        let by_raw = sorted.as_ref().unwrap_or(path);
        // Of an open contour those on the side of the wire.
        let followed = match place.closed {
            true => raw.len(),
            false => raw.end_roll(place.walls.len() / 2),
        };
        first_fault(followed, go_on, |range| {
            proof.nothing_is_missing(raw, by_raw, range)
        })
    }

    /// The findings for a path that cannot be made.
    pub(crate) fn no_path(&self, fault: &Fault, walls: &[Wall], required: f64) -> Vec<Finding> {
        let finding = |rule: Rule, detail: Detail, wall: usize| {
            let place = walls.get(wall).and_then(|wall| wall.source.place());
            let severity = match fault {
                Fault::Crowded => Severity::Error,
                _ => self.settings.severity(rule).unwrap_or(Severity::Error),
            };
            Finding {
                rule,
                severity,
                place: place.unwrap_or(Place::Document),
                detail,
                related: Vec::new(),
            }
        };
        let one = match fault {
            Fault::Nothing => {
                let point = false;
                let detail = Detail::OffsetCollapse { required, point };
                finding(Rule::OffsetCollapse, detail, 0)
            }
            Fault::Several(lost) => {
                let lost = lost.iter();
                let pocket = |&Lost { near, wall }: &Lost| {
                    finding(Rule::LostPocket, Detail::LostPocket { near }, wall)
                };
                return lost.map(pocket).collect();
            }
            &Fault::Unproved { wall } => {
                let near = walls.get(wall).map(|wall| wall.geometry.point_at(0.5));
                let near = near.unwrap_or_else(Point::origin);
                finding(Rule::UnprovedPath, Detail::UnprovedPath { near }, wall)
            }
            Fault::Crowded => {
                let detail = Detail::NotJudged(NotJudged::Path {
                    segments: walls.len(),
                    most: MOST_IN_A_SQUARE,
                });
                finding(Rule::NotJudged, detail, 0)
            }
        };
        vec![one]
    }
}

/// The place of a way that is lost which is farthest from the middle of the path: away from the neck, which is a finding of its own.
fn farthest(lost: &[(usize, Element)], path: &Pieces) -> Option<Lost> {
    let mut all = Bounds::EMPTY;
    let pieces = path.elements.iter();
    pieces.for_each(|piece| all.merge(&piece.geometry.bounds()));
    let middle = nalgebra::center(&all.min, &all.max);
    let places = lost.iter().flat_map(|(_, piece)| {
        [0.0, 0.5].map(|share| Lost {
            near: piece.geometry.point_at(share),
            wall: piece.wall,
        })
    });
    let away = |place: &Lost| (place.near - middle).norm();
    places.max_by(|a, b| away(a).total_cmp(&away(b)))
}

/// The shortest of the walls.
fn shortest(walls: &[Wall]) -> usize {
    let length = |wall: &usize| walls[*wall].geometry.length();
    (0..walls.len())
        .min_by(|a, b| length(a).total_cmp(&length(b)))
        .unwrap_or(0)
}

/// True for the path in a slot that is just as wide as the wire: it goes round nothing.
pub(super) fn goes_out_and_back(path: &[Element]) -> bool {
    let Some(origin) = path.first().map(|element| element.geometry.start()) else {
        return false;
    };
    let area = twice_area(path, origin);
    let length = sum(path.len(), |at| path[at].geometry.length());
    area.abs() <= 1e-9 * length * length
}

/// Twice the area that a path goes round. The sine of an arc's turn is known from its ends, well
/// enough where it turns by more than a little.
fn twice_area(path: &[Element], origin: Point) -> f64 {
    sum(path.len(), |at| match path[at].geometry {
        Segment::Arc(arc) if arc.sweep.abs() > 0.1 => {
            let chord = cross(arc.start - origin, arc.end - origin);
            let triangle = cross(arc.start - arc.center, arc.end - arc.center);
            chord + arc.radius * arc.radius * arc.sweep - triangle
        }
        segment => segment.twice_area(origin),
    })
}

/// True when a path runs round as its contour does, inside an opening and outside a punch. Out and back along a line is no way round.
fn keeps_its_side(path: &[Element], walls: &[Wall], own: &Walls, side: f64) -> bool {
    let Some(origin) = walls.first().map(|wall| wall.geometry.start()) else {
        return false;
    };
    let contour = own.twice_area();
    let area = twice_area(path, origin);
    let grows = (area - contour) * contour.signum();
    let inside = grows * side * contour.signum() <= 0.0;
    // To the left of a counter-clockwise contour lies its inside.
    inside && (area * contour > 0.0 || goes_out_and_back(path))
}
