//! Parts that share an edge, cut apart by one cut on it: `program.common-line`.
//!
//! A *block* is what lies within one outline and is parted by *common lines*: punches that touch along edges, or one that lines divide which are
//! drawn once. Its outline is cut with the correction, as a contour of its own; each common line is cut on the line, before it. So each part
//! keeps the correction everywhere but along a common line, where it loses half the kerf. What cannot be cut so stays as it is drawn, with the
//! reason.

mod blocks;
mod told;

use super::Analysis;
use crate::drawing::{Contour, ContourSegment, Drawing, EntityId, Outline, Role};
use crate::finding::Finding;
use crate::geometry::{Grid, Point, shared_stretches};
use crate::settings::{Compensation, Effective};
use rustc_hash::{FxHashMap, FxHashSet};

/// What is said of the common lines of a drawing, and what is not said because of them.
#[derive(Debug, Default)]
pub(super) struct CommonLines {
    pub(super) findings: Vec<Finding>,
    /// The block that an entity is of.
    block_of: FxHashMap<EntityId, usize>,
    /// The entities of dividing lines.
    dividing: FxHashSet<EntityId>,
    /// The ends of the edges that are cut.
    ends: Vec<Point>,
}

impl CommonLines {
    /// True for the entity of a line that divides a contour: it is no open contour.
    pub(super) fn divides(&self, entity: EntityId) -> bool {
        self.dividing.contains(&entity)
    }

    pub(super) fn are_of_one_block(&self, one: EntityId, other: EntityId) -> bool {
        let block = self.block_of.get(&one);
        block.is_some() && block == self.block_of.get(&other)
    }

    /// True for a place, within `near`, where a common edge ends: parts may touch there.
    pub(super) fn ends_at(&self, at: Point, near: f64) -> bool {
        self.ends.iter().any(|end| (end - at).norm() <= near)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.block_of.is_empty()
    }
}

impl Analysis {
    /// The outlines with a contour round each block and its common lines in place of the parts.
    pub(super) fn with_common_lines(
        &self,
        drawing: &Drawing,
        outlines: Vec<Outline>,
    ) -> (Vec<Outline>, CommonLines) {
        let settings = &*self.settings;
        // A pair is compared part for part. What is cut as drawn, and what an electrode mills, has no correction to lose.
        let is_beside = settings.compensation != Compensation::None && !settings.mills;
        if !settings.common_line || !is_beside || settings.pair.clearance.is_some() {
            return (outlines, CommonLines::default());
        }
        let tolerances = &self.limits.tolerances;
        let search = Search {
            drawing,
            outlines: &outlines,
            settings,
            unit_mm: self.limits.unit_mm,
            same_place: tolerances.same_place,
            touch: tolerances.touch,
            least: tolerances.same_place.max(tolerances.resolution),
        };
        let mut common = CommonLines::default();
        let parts = search.parts();
        let (mut blocks, mut single) = (Vec::new(), Vec::new());
        for members in blocks_of(&parts) {
            match &members[..] {
                [only] => single.push(*only),
                _ => match search.block(&parts, &members) {
                    Ok(block) => blocks.push(block),
                    Err(refused) => common.findings.push(refused),
                },
            }
        }
        search.divide(&parts, &single, &mut blocks, &mut common.findings);
        for (number, block) in blocks.iter().enumerate() {
            let dividing = block.lines.iter().filter_map(|line| line.divider);
            for &outline in block.parts.iter() {
                let pieces = &outlines[outline].contour.pieces;
                let own = pieces.iter().map(|piece| (piece.entity, number));
                common.block_of.extend(own);
            }
            for outline in dividing {
                for piece in &outlines[outline].contour.pieces {
                    common.block_of.insert(piece.entity, number);
                    common.dividing.insert(piece.entity);
                }
            }
            let edges = block.lines.iter().flat_map(|line| &line.segments);
            let ends = edges.flat_map(|edge| [edge.geometry.start(), edge.geometry.end()]);
            common.ends.extend(ends);
            let said = block
                .lines
                .iter()
                .map(|line| search.said(&parts, block, line));
            common.findings.extend(said.flatten());
            common.findings.extend(search.held_by_a_tab(block));
        }
        let outlines = search.replaced(&blocks);
        (outlines, common)
    }
}

struct Search<'a> {
    drawing: &'a Drawing,
    outlines: &'a [Outline],
    settings: &'a Effective,
    unit_mm: f64,
    /// These three in drawing units. Edges that lie this near to each other are one edge.
    same_place: f64,
    /// What ends this near to an outline ends on it.
    touch: f64,
    /// A shorter stretch is not shared.
    least: f64,
}

/// A punch that is cut.
struct Part {
    /// Index of its outline.
    outline: usize,
    workpiece: u16,
    /// Counter-clockwise.
    walls: Vec<ContourSegment>,
    /// In the order of the walls.
    shared: Vec<Shared>,
}

/// A stretch of a wall that another part has as well, by the shares of the wall where it begins and ends.
struct Shared {
    wall: usize,
    from: f64,
    to: f64,
    /// The other part.
    with: usize,
    /// Both parts lie on the same side of it.
    is_alike: bool,
}

impl Part {
    fn stretch(&self, shared: &Shared) -> ContourSegment {
        part_of(&self.walls[shared.wall], shared.from, shared.to)
    }
}

fn part_of(wall: &ContourSegment, from: f64, to: f64) -> ContourSegment {
    let geometry = match (from, to) {
        (0.0, 1.0) => wall.geometry,
        _ => wall.geometry.part(from, to),
    };
    ContourSegment { geometry, ..*wall }
}

struct Block {
    /// The outlines of its parts, by their indices: one that is divided, or several.
    parts: Vec<usize>,
    workpiece: u16,
    /// Round all of them, counter-clockwise.
    outline: Vec<ContourSegment>,
    lines: Vec<CommonLine>,
}

struct CommonLine {
    segments: Vec<ContourSegment>,
    /// The places among all parts of those that have an edge on it.
    parts: Vec<usize>,
    /// The outline of a line that is drawn once.
    divider: Option<usize>,
}

/// The places of parts by blocks; a part that shares nothing is one by itself.
fn blocks_of(parts: &[Part]) -> Vec<Vec<usize>> {
    let mut block: Vec<usize> = (0..parts.len()).collect();
    fn first(block: &[usize], mut at: usize) -> usize {
        while block[at] != at {
            at = block[at];
        }
        at
    }
    for (place, part) in parts.iter().enumerate() {
        for shared in &part.shared {
            let both = [place, shared.with].map(|at| first(&block, at));
            block[both[0].max(both[1])] = both[0].min(both[1]);
        }
    }
    let mut blocks: Vec<Vec<usize>> = vec![Vec::new(); parts.len()];
    for place in 0..parts.len() {
        blocks[first(&block, place)].push(place);
    }
    blocks.retain(|members| !members.is_empty());
    blocks
}

impl Search<'_> {
    fn parts(&self) -> Vec<Part> {
        let is_part = |outline: &Outline| {
            outline.contour.closed
                && outline.role == Role::Punch
                && outline.is_cut()
                && outline.twice_area != 0.0
        };
        let all = self.outlines.iter().enumerate();
        let part = |(index, outline): (usize, &Outline)| Part {
            outline: index,
            workpiece: self.workpiece(outline),
            walls: match outline.twice_area > 0.0 {
                true => outline.contour.segments(self.drawing).collect(),
                false => outline.contour.reversed().segments(self.drawing).collect(),
            },
            shared: Vec::new(),
        };
        let mut parts: Vec<Part> = all
            .filter(|(_, outline)| is_part(outline))
            .map(part)
            .collect();
        let mut walls = Grid::default();
        for (place, part) in parts.iter().enumerate() {
            for (wall, own) in part.walls.iter().enumerate() {
                walls.insert((place, wall), own.geometry.bounds());
            }
        }
        let each = (0..parts.len()).map(|place| self.shared(&parts, place, &walls));
        let shared: Vec<Vec<Shared>> = each.collect();
        for (part, shared) in parts.iter_mut().zip(shared) {
            part.shared = shared;
        }
        parts
    }

    fn workpiece(&self, outline: &Outline) -> u16 {
        let workpieces = &self.settings.workpieces;
        workpieces.of_contour(self.drawing, &outline.contour)
    }

    fn shared(&self, parts: &[Part], place: usize, walls: &Grid<(usize, usize)>) -> Vec<Shared> {
        let part = &parts[place];
        let mut shared = Vec::new();
        for (wall, own) in part.walls.iter().enumerate() {
            let own = &own.geometry;
            walls.near(&own.bounds().grown(self.same_place), |(with, at), _| {
                if with == place || parts[with].workpiece != part.workpiece {
                    return;
                }
                let other = &parts[with].walls[at].geometry;
                for &[from, to] in shared_stretches(own, other, self.same_place).iter() {
                    let middle = own.point_at((from + to) / 2.0);
                    let [ahead, theirs] =
                        [own, other].map(|it| it.tangent_at(it.share_of(middle).clamp(0.0, 1.0)));
                    if (to - from) * own.length() > self.least {
                        shared.push(Shared {
                            wall,
                            from,
                            to,
                            with,
                            is_alike: ahead.dot(&theirs) > 0.0,
                        });
                    }
                }
            });
        }
        shared.sort_by(|a, b| a.wall.cmp(&b.wall).then(a.from.total_cmp(&b.from)));
        shared
    }

    /// The outlines with those of blocks in the place of the first part of each.
    fn replaced(&self, blocks: &[Block]) -> Vec<Outline> {
        let mut block_at: FxHashMap<usize, Option<&Block>> = FxHashMap::default();
        for block in blocks {
            let dividers = block.lines.iter().filter_map(|line| line.divider);
            block_at.extend(
                dividers
                    .chain(block.parts.iter().copied())
                    .map(|at| (at, None)),
            );
            block_at.extend(block.parts.first().map(|&first| (first, Some(block))));
        }
        let mut replaced = Vec::with_capacity(self.outlines.len());
        for (index, outline) in self.outlines.iter().enumerate() {
            match block_at.get(&index) {
                None => replaced.push(outline.clone()),
                Some(None) => {}
                Some(Some(block)) => {
                    replaced.push(self.outline_of(block, outline));
                    replaced.extend(block.lines.iter().map(common_line));
                }
            }
        }
        replaced
    }

    /// Round a block, in the direction of its first part and by its name.
    fn outline_of(&self, block: &Block, first: &Outline) -> Outline {
        if block.parts.len() == 1 {
            return first.clone();
        }
        let pieces = block.parts.iter();
        let pieces = pieces.flat_map(|&part| &self.outlines[part].contour.pieces);
        let is_turned = first.twice_area < 0.0;
        let walls = match is_turned {
            true => turned(&block.outline),
            false => block.outline.clone(),
        };
        let contour = Contour::composed(pieces.map(|piece| piece.entity), walls, true);
        Outline {
            twice_area: contour.twice_area(self.drawing),
            role: Role::Punch,
            contour,
        }
    }
}

fn turned(segments: &[ContourSegment]) -> Vec<ContourSegment> {
    segments.iter().rev().map(ContourSegment::turned).collect()
}

fn common_line(line: &CommonLine) -> Outline {
    let mut entities: Vec<EntityId> = line.segments.iter().map(|it| it.entity).collect();
    entities.dedup();
    Outline {
        contour: Contour::composed(entities, line.segments.clone(), false),
        role: Role::Line,
        twice_area: 0.0,
    }
}
