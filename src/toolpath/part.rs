//! The outline of a part as the wire leaves it: everything within half the kerf of the last pass's path is gone.
//!
//! The path of the last pass is the one that is written: laid beside the contour as for a program, and refused where one would be. The outline is
//! laid half a kerf beside the path, on the side of the part. Where the path turns in a point the wire leaves its own radius: such an edge
//! remembers the point.

use super::clearance::Walls;
use super::contour_path::{Along, Fault, Laid};
use super::corners::{Element, elements};
use super::job::Job;
use super::offset::Wall;
use super::path::{Refusal, Source};
use super::skim::Rough;
use crate::drawing::{Contour, ContourSegment, Drawing, EntityId};
use crate::geometry::{Arc, Point, Segment, Side};
use crate::settings::{Effective, SkimCorner};

/// One edge of the outline of a part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub geometry: Segment,
    /// Where the wire turned, and left its own radius.
    pub(crate) turned_about: Option<Point>,
    /// By how much that radius is larger, where the first pass turned in that point and the last one ran beside it.
    pub(crate) swing: f64,
    /// The walls that the path follows before and after, by index.
    walls: [usize; 2],
}

/// A part as the wire leaves it. Lengths in drawing units.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Along the contour.
    pub edges: Vec<Edge>,
    /// The edges, to ask what is near.
    pub near: Walls,
    /// The way of the wire's centre in the last pass, to ask what is near.
    pub path: Walls,
    /// Half the kerf of the last pass.
    pub half: f64,
    /// The contour as it is drawn.
    drawn: Vec<Wall>,
}

impl Edge {
    /// The edge of an element beside a path.
    fn of(element: &Element, path: &[Element]) -> Edge {
        let next = match element.wall + 1 {
            next if next < path.len() => next,
            _ => 0,
        };
        let before = path[element.wall].wall;
        let geometry = element.geometry;
        let turn = geometry.as_arc().filter(|_| element.is_roll());
        Edge {
            geometry,
            turned_about: turn.map(|arc| arc.center),
            swing: 0.0,
            walls: [
                before,
                if element.is_roll() {
                    path[next].wall
                } else {
                    before
                },
            ],
        }
    }
}

impl Part {
    /// The radius that the wire has left where it turned about a point.
    pub(crate) fn radius_of(&self, edge: usize) -> f64 {
        self.half + self.edges[edge].swing
    }

    /// The segment of the drawing that an edge stands for at a point of it: the nearest of those that the wire does not follow, else the
    /// one after the corner.
    pub(crate) fn segment_at(&self, edge: usize, at: Point) -> Option<(EntityId, usize)> {
        let [before, behind] = self.edges[edge].walls;
        let count = self.drawn.len();
        let skipped = match behind >= before {
            true => behind - before,
            false => behind + count - before,
        };
        let between = (1..skipped).map(|step| (before + step) % count);
        let nearest = between.min_by(|&a, &b| {
            let away = |wall: usize| self.drawn[wall].geometry.distance_to(at);
            away(a).total_cmp(&away(b))
        });
        match self.drawn.get(nearest.unwrap_or(behind))?.source {
            Source::Segment { entity, segment } => Some((entity, segment)),
            _ => None,
        }
    }
}

/// How a part is cut out of a contour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cutting<'a> {
    /// The side of the contour's own direction that the part does not lie on.
    pub side: Side,
    /// The wire runs on the side of the part.
    pub is_other: bool,
    pub settings: &'a Effective,
    /// The segments of the contour, where they are known.
    pub walls: Option<&'a Walls>,
}

/// The part that all passes leave of a closed contour.
pub(crate) fn part(
    drawing: &Drawing,
    contour: &Contour,
    cutting: Cutting,
    goes_on: &(dyn Fn() -> bool + Sync),
) -> Result<Part, Refusal> {
    let cut = Cut::of(drawing, cutting, goes_on)?;
    // What falls off beside the part is no part of it.
    let job = &Job {
        a_loop_will_do: true,
        goes_on,
        ..Job::of(drawing, &[], cutting.settings)
    };
    let half = cut.half;
    let Cutting { side, walls, .. } = cutting;
    let segment = |at: usize| match walls {
        Some(walls) => contour.segment_with(drawing, at, *walls.segment(at)),
        None => contour.segment(drawing, at),
    };
    let contour = Segments {
        count: contour.len(),
        segment: &segment,
    };
    let Last {
        walls: drawn,
        path,
        swing,
    } = cut.last_path(contour)?;
    let beside: Vec<Wall> = path
        .iter()
        .map(|element| Wall {
            geometry: element.geometry,
            source: drawn[element.wall].source,
        })
        .collect();
    let near_path = Walls::of(&beside);
    if let [
        Wall {
            geometry: Segment::Line(stand),
            ..
        },
    ] = beside.as_slice()
    {
        // The wire only stands still, and leaves a hole as large as its kerf.
        let start = stand.start + crate::geometry::direction(0.0) * half;
        let circle = Segment::Arc(Arc::about(stand.start, start, start, true));
        return Ok(Part {
            edges: vec![Edge {
                geometry: circle,
                turned_about: Some(stand.start),
                swing: 0.0,
                walls: [path[0].wall; 2],
            }],
            near: Walls::new(vec![circle]),
            path: near_path,
            half,
            drawn,
        });
    }
    let back = Along {
        side: -side.sign(),
        correction: half,
        closed: true,
    };
    let outline = match job.laid(&beside, &near_path, back)? {
        Ok(Laid::Path(outline)) => Ok(outline),
        Ok(Laid::Point(_)) => Err(Fault::Nothing),
        Err(fault) => Err(fault),
    };
    let outline = outline.map_err(|fault| job.no_path(&fault, &beside, half))?;
    let rounding = job.units(super::job::ROUNDING);
    let edge = |element: &Element| {
        let edge = Edge::of(element, &path);
        let piece = beside[element.wall].geometry;
        let swung = piece.as_arc().filter(|arc| {
            let is_inside = arc.sweep.signum() == side.sign();
            swing > 0.0 && is_inside && (arc.radius - swing).abs() <= rounding
        });
        match swung.filter(|_| !element.is_roll()) {
            Some(arc) => Edge {
                turned_about: Some(arc.center),
                swing,
                ..edge
            },
            None => edge,
        }
    };
    let edges: Vec<Edge> = outline.iter().map(edge).collect();
    Ok(Part {
        near: Walls::new(edges.iter().map(|edge| edge.geometry).collect()),
        edges,
        path: near_path,
        half,
        drawn,
    })
}

/// What a part is cut by.
struct Cut<'a> {
    job: Job<'a>,
    /// Half the kerf of the last pass, drawing units.
    half: f64,
    /// How the last pass runs along the contour.
    last: Along,
    /// The correction of the first pass, from the same side.
    rough: f64,
}

impl<'a> Cut<'a> {
    fn of(
        drawing: &'a Drawing,
        cutting: Cutting<'a>,
        goes_on: &'a (dyn Fn() -> bool + Sync),
    ) -> Result<Cut<'a>, Refusal> {
        let settings = cutting.settings;
        let job = Job {
            goes_on,
            ..Job::of(drawing, &[], settings)
        };
        let passes = settings.each_correction();
        let half = settings.half_kerf(passes.len() - 1);
        let (Some(&rough), Some(&last), Some(half)) = (passes.first(), passes.last(), half) else {
            return Err(Refusal::Sentence(say!(no_path_can_be_made).into()));
        };
        let from = match cutting.is_other {
            true => cutting.side.reversed(),
            false => cutting.side,
        };
        Ok(Cut {
            half: job.units(half),
            last: Along {
                side: from.sign(),
                correction: job.units(last),
                closed: true,
            },
            rough: job.units(rough),
            job,
        })
    }
}

/// The path of the last pass along a closed contour.
struct Last {
    walls: Vec<Wall>,
    path: Vec<Element>,
    /// The radius of its way about a point in which the first pass turned; 0 where it turns there itself.
    swing: f64,
}

/// The segments of a closed contour in the direction of travel.
#[derive(Clone, Copy)]
struct Segments<'a> {
    count: usize,
    segment: &'a (dyn Fn(usize) -> Option<ContourSegment> + Sync),
}

impl Cut<'_> {
    /// The walls of a closed contour, and the path of the last pass along them; one line without length where the wire can only stand.
    fn last_path(&self, contour: Segments) -> Result<Last, Refusal> {
        let Cut {
            job, rough, last, ..
        } = self;
        let rounding = job.units(super::job::ROUNDING);
        let swing = (rough - last.correction).abs();
        let is_after_rough = swing > rounding;
        let is_beside_rough =
            job.settings.passes.skim_corner() == SkimCorner::ConstantStock && is_after_rough;
        if last.correction.abs() <= rounding && !is_after_rough {
            let shortest = job.settings.tolerances.zero_length;
            let walls = job.walls_of(contour.count, contour.segment, true, shortest);
            let path = elements(&walls);
            return Ok(Last {
                walls,
                path,
                swing: 0.0,
            });
        }
        let first = Along {
            correction: *rough,
            ..*last
        };
        let first = first.on_own_side();
        let (walls, own, laid) = job.along(
            contour.count,
            contour.segment,
            first.side,
            first.correction,
            true,
        )?;
        let skimmed = |path: Vec<Element>| {
            let rough = Rough {
                correction: *rough,
                path,
            };
            job.skim(&walls, &own, &rough, *last)
        };
        let laid = match laid {
            Ok(Laid::Path(path)) if is_after_rough => skimmed(path)?,
            Ok(Laid::Point(_)) if is_after_rough => skimmed(Vec::new())?,
            laid => laid,
        };
        match laid {
            Ok(Laid::Path(path)) => {
                let path =
                    job.with_corners(path, (&walls, &own), last.correction, &|_: &Segment| false);
                Ok(Last {
                    walls,
                    path,
                    swing: if is_beside_rough { swing } else { 0.0 },
                })
            }
            Ok(Laid::Point(stand)) => {
                let element = Element {
                    geometry: Segment::line(stand, stand),
                    source: Source::Tab,
                    wall: 0,
                };
                Ok(Last {
                    walls,
                    path: vec![element],
                    swing: 0.0,
                })
            }
            Err(fault) => Err(job.no_path(&fault, &walls, first.correction).into()),
        }
    }
}
