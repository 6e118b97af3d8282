//! Repairs of corners in which a punch and its plate bind.

use super::Analysis;
use super::fits::KnownFit;
use crate::drawing::{ContourSegment, Drawing, DrawingEdit};
use crate::finding::{Detail, Finding, Fix, FixKind, Place, Side};
use crate::fit::{Fitted, SegmentOf, Sharper, Spot};
use crate::geometry::Point;
use crate::rules::small_radius::{self, Travel};
use crate::settings::Partners;
use std::sync::Arc;

impl Analysis {
    /// The repair of a corner in which two parts bind: the least radius with which they no longer
    /// do, enlarged by the clearance where the other part is drawn, too, and is not that round already.
    pub(super) fn fit_fix(&self, drawing: &Drawing, finding: &Finding) -> Option<Fix> {
        let Place::Segment { entity, segment } = finding.place else {
            return None;
        };
        let (_, clearance) = self.settings.fit().ok()?;
        let partner = finding.related.first().and_then(|place| match place {
            Place::Segment { entity, segment } => Some((*entity, *segment)),
            _ => None,
        });
        let before = self.pair_at(drawing, (entity, segment), partner)?;
        let spot = spot_of(&before, finding, (entity, segment))?;
        let turn = spot.sharper.map_or(spot.turn, |sharper| sharper.turn);
        if turn <= 0.0 {
            return None;
        }
        let corner = BindingCorner {
            binding: self.binding_about(drawing, &spot),
            spot: &spot,
            clearance: clearance / self.limits.unit_mm,
            is_drawn: self.chains.contour_of(spot.segment.0)
                != self.chains.contour_of(spot.other.0),
        };
        let [sharper, rounder] = corner.sides();
        let drawn = |at: SegmentOf| radius_drawn(drawing, at).unwrap_or(0.0);
        let enough = self
            .settings
            .correction
            .max(self.settings.half_kerf(0).unwrap_or(0.0));
        let margin = self.settings.margin / self.limits.unit_mm;
        let most = enough / self.limits.unit_mm + corner.clearance + margin;
        let most = match spot.sharper {
            Some(_) => most.max(drawn(rounder)),
            None => most,
        };
        let left = |radius: f64| Some(self.with_corner(drawing, &corner, radius)?.1);
        let rounding = self.limits.tolerances.report;
        let mut radius = most;
        let steep = 1.0 / (turn / 2.0).cos() - 1.0;
        // Between straight walls the remaining clearance grows linearly with the radius.
        let mut found = None;
        for _ in 0..6 {
            let found_left = left(radius);
            match found_left {
                Some(more) if more.abs() <= 0.1 * rounding => {
                    found = Some(radius);
                    break;
                }
                Some(more) => radius -= more / steep,
                None => break,
            }
            if !(radius > 0.0 && radius <= most) {
                break;
            }
        }
        let found = found.or_else(|| {
            let (mut least, mut most) = (0.0, most);
            left(most).filter(|left| *left >= 0.0)?;
            for _ in 0..24 {
                let middle = (least + most) / 2.0;
                match left(middle) {
                    Some(left) if left >= 0.0 => most = middle,
                    _ => least = middle,
                }
            }
            Some(most)
        })?;
        let radius = found + margin;
        let (edit, left) = self.with_corner(drawing, &corner, radius)?;
        let kind = match corner.is_drawn && !corner.is_round(drawing, radius) {
            false if corner.is_drawn => FixKind::FitCornerOf {
                of: corner.name_of_sharper(),
                radius,
            },
            is_of_both => FixKind::FitCorner {
                radius,
                other: is_of_both.then_some(radius + corner.clearance),
            },
        };
        // How far the fix moves a corner between straight walls, or the arc in it, and another one that makes a tight arc larger after it.
        let of_corner = match corner.is_drawn {
            true => [sharper; 2],
            false => [sharper, rounder],
        };
        let was = of_corner.map(drawn).into_iter().filter(|was| *was < radius);
        let was = was.fold(0.0, f64::max);
        let next = steep * (self.limits.fix_radius - radius);
        let is_tight = radius < self.limits.correction && next <= self.limits.correction;
        let moves = steep * (radius - was) + if is_tight { next } else { 0.0 };
        (left >= -rounding).then_some(Fix {
            kind,
            preferred: true,
            in_fix_all: moves <= self.limits.correction,
            edit,
        })
    }

    /// The knowledge of the pair to which a segment belongs: of several that with a segment of its partner.
    fn pair_at(
        &self,
        drawing: &Drawing,
        own: SegmentOf,
        partner: Option<SegmentOf>,
    ) -> Option<Arc<Fitted>> {
        let pairs = self.pairs_about(drawing, &[own]);
        let with_both = partner.and_then(|partner| {
            let at = self.outline_at(drawing, partner)?;
            pairs.iter().find(|pair| pair.contains(&at))
        });
        self.laid_pair(drawing, *with_both.or(pairs.first())?)
    }

    /// The pairs to whose outlines some segments belong.
    fn pairs_about(&self, drawing: &Drawing, segments: &[SegmentOf]) -> Vec<[usize; 2]> {
        let outlines = segments
            .iter()
            .filter_map(|at| self.outline_at(drawing, *at));
        let mut outlines: Vec<usize> = outlines.collect();
        outlines.dedup();
        match self.settings.partners() {
            Some(Partners::CutTwice(_)) => outlines.into_iter().map(|at| [at; 2]).collect(),
            Some(Partners::Drawn) => {
                let mut pairs = self.drawn_partners(drawing).pairs;
                pairs.retain(|pair| outlines.iter().any(|at| pair.contains(at)));
                pairs
            }
            None => Vec::new(),
        }
    }

    fn outline_at(&self, drawing: &Drawing, (entity, segment): SegmentOf) -> Option<usize> {
        let (key, _) = self.chains.index_of(entity, segment)?;
        let keys = self.in_machining_order(drawing);
        keys.iter().position(|other| *other == key)
    }

    /// The knowledge of a pair; worked out if necessary.
    fn laid_pair(&self, drawing: &Drawing, both: [usize; 2]) -> Option<Arc<Fitted>> {
        let outlines = self.outlines(drawing);
        let keys = self.in_machining_order(drawing);
        let answer = self.fits.get(&(keys[both[0]], keys[both[1]]));
        if let Some(known) = answer.and_then(KnownFit::holds) {
            return known.clone();
        }
        let both = both.map(|index| (keys[index], &outlines[index]));
        self.fitted(drawing, both, [None, None]).map(Arc::new)
    }

    /// In how many places the pairs bind to whose outlines the segments of a spot belong.
    fn binding_about(&self, drawing: &Drawing, spot: &Spot) -> usize {
        let both = [spot.segment, spot.other].map(|(entity, _)| (entity, 0));
        let pairs = self.pairs_about(drawing, &both).into_iter();
        let binds = |(_, left): &(Point, f64)| *left < -self.limits.tolerances.report;
        let laid = pairs.filter_map(|pair| self.laid_pair(drawing, pair));
        laid.map(|pair| pair.held.clearances().filter(binds).count())
            .sum()
    }

    /// The edit that gives a corner a radius, and what is then left of the clearance there: at most the clearance that
    /// is set. `None` where it cannot be made, or brings errors.
    fn with_corner(
        &self,
        drawing: &Drawing,
        corner: &BindingCorner,
        radius: f64,
    ) -> Option<(DrawingEdit, f64)> {
        let of = |at: SegmentOf, radius: f64| self.corner_edits(drawing, corner, at, radius);
        let [sharper, rounder] = corner.sides();
        let edits = match corner.is_drawn {
            false => of(corner.spot.segment, radius),
            true if corner.is_round(drawing, radius) => of(sharper, radius),
            true => {
                let partner = of(sharper, radius);
                let own = of(rounder, radius + corner.clearance);
                let both = own.into_iter().flat_map(|own| {
                    partner.clone().into_iter().map(move |partner| {
                        let changes = own.changes.iter().cloned().chain(partner.changes);
                        DrawingEdit {
                            changes: changes.collect(),
                        }
                    })
                });
                both.collect()
            }
        };
        let tried = edits.into_iter().filter_map(|edit| {
            let left = self.left_behind(drawing, corner, &edit)?;
            Some((edit, left))
        });
        // Of equally good ones the first: the radius of a part that its wire has spoiled changes nothing of the fit.
        let rounding = self.limits.tolerances.report;
        tried.reduce(|best, other| {
            if other.1 > best.1 + rounding {
                other
            } else {
                best
            }
        })
    }

    /// Edits that may give a part of a pair a radius near one of its segments: in place of the arcs there, or at the corner where the
    /// segment begins or ends.
    fn corner_edits(
        &self,
        drawing: &Drawing,
        corner: &BindingCorner,
        (entity, segment): SegmentOf,
        radius: f64,
    ) -> Vec<DrawingEdit> {
        let place = || {
            let (key, index) = self.chains.index_of(entity, segment)?;
            Some((self.outlook(drawing, key)?, index))
        };
        let Some((outlook, index)) = place() else {
            return Vec::new();
        };
        // Both parts are rounded about one point, which lies where the wire of the one turned.
        let inside = match outlook.index.twice_area() > 0.0 {
            true => Side::Left,
            false => Side::Right,
        };
        let side = match corner.sharper_is_punch() {
            true => inside,
            false => inside.reversed(),
        };
        let travel = Travel {
            drawing,
            contour: outlook.contour,
            index: outlook.index,
            side,
        };
        let mut limits = self.limits;
        limits.fix_radius = radius;
        let position = travel.position_of(index);
        let wide = self.wide(corner.clearance, corner.spot.clearance);
        // The finding may stand at a wall beside the arc.
        let mut near = [position, position - 1, position + 1]
            .into_iter()
            .filter(|at| {
                let segment = travel.segment(*at);
                let is_near = |it: &ContourSegment| it.geometry.distance_to(corner.spot.at) <= wide;
                *at == position || segment.as_ref().is_some_and(is_near)
            });
        let run = near.find_map(|at| small_radius::run_of(&travel, at, &limits));
        let arcs = run.and_then(|run| {
            let replacement = small_radius::refillet(&travel, &run, &limits).ok()?;
            small_radius::drawing_edit(drawing, &[(travel, replacement)])
        });
        match arcs {
            Some(edit) => vec![edit],
            None => {
                let joint = |before: isize| {
                    let segment = travel.segment(before + 1)?;
                    let away = (segment.geometry.start() - corner.spot.at).norm();
                    Some((away, before)).filter(|(away, _)| *away <= wide)
                };
                let mut joints: Vec<(f64, isize)> = [position - 1, position]
                    .into_iter()
                    .filter_map(joint)
                    .collect();
                joints.sort_by(|one, other| one.0.total_cmp(&other.0));
                let nearest_first = joints.into_iter().map(|(_, before)| before);
                nearest_first
                    .filter_map(|before| small_radius::fillet(&travel, before, &limits))
                    .map(|(edit, _)| edit)
                    .collect()
            }
        }
    }

    fn left_behind(
        &self,
        drawing: &Drawing,
        corner: &BindingCorner,
        edit: &DrawingEdit,
    ) -> Option<f64> {
        let mut edited = drawing.clone();
        let delta = edited.apply(edit).ok()?;
        let mut after = self.updated(&edited, &delta);
        if after.tally(&edited).errors > self.tallied(drawing).errors {
            return None;
        }
        let spot = corner.spot;
        let pair = after.pair_at(&edited, (spot.segment.0, 0), Some((spot.other.0, 0)))?;
        let wide = self.wide(corner.clearance, spot.clearance);
        let near = |(at, _): &(Point, f64)| (at - spot.at).norm() <= wide;
        let left = pair.held.clearances().filter(near).map(|(_, left)| left);
        let left = left.fold(corner.clearance, f64::min);
        let now = after.binding_about(&edited, spot);
        (now < corner.binding || (left < 0.0 && now == corner.binding)).then_some(left)
    }
}

/// A corner in which two parts bind.
struct BindingCorner<'a> {
    /// In how many places its pairs bind before it is mended.
    binding: usize,
    spot: &'a Spot,
    clearance: f64,
    /// Both parts are drawn.
    is_drawn: bool,
}

impl BindingCorner<'_> {
    /// The corner of the punch is too sharp, not that of the plate: where a wire has turned, that of the part that it has not spoiled.
    fn sharper_is_punch(&self) -> bool {
        let spot = self.spot;
        spot.sharper
            .map_or(spot.is_of_plate, |sharper| !sharper.is_of_plate)
    }

    /// The part that is too sharp stands at the segment of the spot, and not at the other.
    fn is_at_own(&self) -> bool {
        let is_own = |sharper: Sharper| !sharper.is_of_plate;
        self.spot.sharper.is_some_and(is_own)
    }

    /// The segment of the part that is too sharp, and that of its partner.
    fn sides(&self) -> [SegmentOf; 2] {
        let Spot { segment, other, .. } = *self.spot;
        match self.is_at_own() {
            true => [segment, other],
            false => [other, segment],
        }
    }

    fn name_of_sharper(&self) -> Arc<str> {
        match self.is_at_own() {
            true => self.spot.of.clone(),
            false => self.spot.partner.clone(),
        }
    }

    /// The partner is drawn round enough for this radius.
    fn is_round(&self, drawing: &Drawing, radius: f64) -> bool {
        let [_, rounder] = self.sides();
        let drawn = radius_drawn(drawing, rounder);
        drawn.is_some_and(|drawn| drawn >= radius + self.clearance)
    }
}

/// The radius of an arc.
fn radius_drawn(drawing: &Drawing, (entity, segment): SegmentOf) -> Option<f64> {
    let geometry = drawing.segment(entity, segment)?;
    Some(geometry.as_arc()?.radius)
}

/// The spot that a finding tells of: both corners of a segment may bind.
fn spot_of(pair: &Fitted, finding: &Finding, at: SegmentOf) -> Option<Spot> {
    let Detail::DoesNotFit(misfit) = &finding.detail else {
        return None;
    };
    let is_there = |spot: &Spot| spot.segment == at || spot.other == at;
    let apart = |spot: &Spot| (spot.at - misfit.at).norm();
    let there = pair.spots().filter(is_there);
    there.min_by(|a, b| apart(a).total_cmp(&apart(b)))
}
