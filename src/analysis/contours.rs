//! The contours of a drawing in machining order, with their roles.

use super::Analysis;
use super::common_line::CommonLines;
use super::suppressed::own_role;
use crate::drawing::{
    Contour, ContourKey, Drawing, EntityId, Outline, Role, is_drafting_layer, is_drafting_linetype,
    is_layer_of_ways, nesting_depths, twins,
};
use crate::finding::{Aside, Side};
use crate::geometry::Bounds;
use crate::settings::Effective;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The contours of a drawing as they are cut.
#[derive(Clone, Debug)]
pub(super) struct Outlined {
    outlines: Arc<Vec<Outline>>,
    common_lines: Arc<CommonLines>,
}

impl Analysis {
    /// Contours with their roles, in machining order. Cheap to keep as a snapshot.
    pub fn outlines(&self, drawing: &Drawing) -> &Arc<Vec<Outline>> {
        &self.outlined(drawing).outlines
    }

    /// What is said of edges that parts share.
    pub(super) fn common_lines(&self, drawing: &Drawing) -> Arc<CommonLines> {
        match self.settings.common_line {
            true => self.outlined(drawing).common_lines.clone(),
            false => Arc::default(),
        }
    }

    fn outlined(&self, drawing: &Drawing) -> &Outlined {
        self.outlines.get_or_init(|| {
            let ordered = self.in_machining_order(drawing);
            let roles = self.roles(drawing, ordered);
            let outline = |(key, role): (ContourKey, Role)| {
                let contour = self.chains.get(key)?.clone();
                let twice_area = if contour.closed {
                    self.known.get(&key)?.index.twice_area()
                } else {
                    0.0
                };
                Some(Outline {
                    contour,
                    role,
                    twice_area,
                })
            };
            let outlines = ordered.iter().copied().zip(roles).filter_map(outline);
            let mut outlines: Vec<Outline> = outlines.collect();
            self.mark_doubles(drawing, &mut outlines);
            let (outlines, common_lines) = self.with_common_lines(drawing, outlines);
            Outlined {
                outlines: Arc::new(outlines),
                common_lines: Arc::new(common_lines),
            }
        })
    }

    /// Of closed contours in one place, whatever their entities, the first is cut.
    fn mark_doubles(&self, drawing: &Drawing, outlines: &mut [Outline]) {
        let part_of = |at: usize| {
            let contour = outlines.get(at).map(|outline| &outline.contour)?;
            Some(self.settings.workpieces.of_contour(drawing, contour))
        };
        let with_box = |outline: &Outline| {
            let first = outline.contour.pieces.first()?;
            let known = self.known.get(&self.chains.contour_of(first.entity)?)?;
            Some(known.index.bounds())
        };
        let contours = outlines
            .iter()
            .map(|outline| (&outline.contour, with_box(outline).unwrap_or(Bounds::EMPTY)));
        let contours: Vec<_> = contours.collect();
        let mut pairs = twins(drawing, &contours, self.limits.tolerances.same_place);
        pairs.retain(|[first, later]| part_of(*first) == part_of(*later));
        for [first, later] in pairs {
            let kept = outlines.get(first).and_then(|it| it.contour.pieces.first());
            let kept = kept.map(|piece| piece.entity);
            if let Some(outline) = outlines.get_mut(later) {
                outline.contour.double_of = kept;
            }
        }
    }

    /// True for a contour that is cut on the line.
    pub(super) fn is_on_line(&self, key: ContourKey) -> bool {
        self.known.get(&key).is_some_and(|known| known.is_on_line())
    }

    pub(super) fn wire_side(&self, key: ContourKey, role: Role) -> Option<Side> {
        if matches!(role, Role::Both | Role::Ignore) {
            return None;
        }
        let closed = self.chains.get(key)?.closed;
        crate::drawing::wire_side(role, closed, self.known.get(&key)?.index.twice_area())
    }

    /// Keys of all contours in machining order: that of the first entity of each.
    pub(super) fn in_machining_order(&self, drawing: &Drawing) -> &[ContourKey] {
        self.order.get_or_init(|| {
            let mut last = None;
            let mut keys = Vec::new();
            for &id in drawing.order() {
                let key = self.chains.contour_of(id).filter(|&key| !self.is_lone(key));
                if key != last
                    && let Some(key) = key
                    && self.chains.first_of(key) == Some(id)
                {
                    keys.push(key);
                }
                last = key;
            }
            keys
        })
    }

    /// The number of contours of its own workpiece around each.
    fn depths_by_part(&self, drawing: &Drawing, contours: &[(&Contour, Bounds)]) -> Vec<usize> {
        let tolerance = self.limits.tolerances.same_place;
        if self.settings.workpieces.is_empty() {
            return nesting_depths(drawing, contours, tolerance);
        }
        let mut parts: BTreeMap<u16, Vec<usize>> = BTreeMap::new();
        for (at, (contour, _)) in contours.iter().enumerate() {
            let part = self.settings.workpieces.of_contour(drawing, contour);
            parts.entry(part).or_default().push(at);
        }
        let mut depths = vec![0; contours.len()];
        for of_part in parts.values() {
            let own: Vec<_> = of_part.iter().map(|&at| contours[at]).collect();
            let of_own = nesting_depths(drawing, &own, tolerance);
            for (&at, depth) in of_part.iter().zip(of_own) {
                depths[at] = depth;
            }
        }
        depths
    }

    /// The role of each contour: stated by an entity, by its layer, by the `side` setting, or by
    /// nesting. A side of the direction (left, right) does not apply to a closed one.
    pub(super) fn roles(&self, drawing: &Drawing, keys: &[ContourKey]) -> Vec<Role> {
        let everywhere = self.settings.side.role();
        let depths: FxHashMap<ContourKey, usize> = match everywhere {
            Some(_) => FxHashMap::default(),
            None => {
                // What is cut on the line encloses nothing.
                let (keys, contours): (Vec<ContourKey>, Vec<_>) = keys
                    .iter()
                    .filter(|key| !self.is_on_line(**key))
                    .filter_map(|key| {
                        let bounds = self.known.get(key)?.index.bounds();
                        Some((*key, (self.chains.get(*key)?, bounds)))
                    })
                    .unzip();
                let depths = self.depths_by_part(drawing, &contours);
                keys.into_iter().zip(depths).collect()
            }
        };
        let nested = |key: &ContourKey| {
            if depths.get(key).is_some_and(|depth| depth % 2 == 1) {
                Role::Opening
            } else {
                Role::Punch
            }
        };
        let is_closed = |key: &ContourKey| self.chains.get(*key).is_none_or(|it| it.closed);
        let role = |key: &ContourKey| {
            let said = self.known.get(key).and_then(|known| known.stated);
            match said.or(everywhere) {
                Some(Role::Left | Role::Right) if is_closed(key) => Role::Both,
                Some(role) => role,
                None => nested(key),
            }
        };
        keys.iter().map(role).collect()
    }
}

/// The role that an entity states, else that of its handle, its linetype, its layer, its colour.
pub(super) fn role_of(drawing: &Drawing, settings: &Effective, id: EntityId) -> Option<Role> {
    let entity = drawing.get(id)?;
    let by_color = || {
        if settings.colors.is_empty() {
            None
        } else {
            settings.colors.get(&drawing.color(id)?).copied()
        }
    };
    let by_handle = || own_role(drawing, settings, id);
    let by_linetype = || role_of_linetype(settings, &drawing.linetype(id)?.name);
    entity
        .role
        .or_else(by_handle)
        .or_else(by_linetype)
        .or_else(|| settings.layers.get(&entity.layer))
        .or_else(by_color)
}

/// Whether an entity is set aside by its linetype or its layer: neither it nor its linetype or
/// layer has been given a role.
///
/// A role of the layer does not bring back an entity with such a linetype of its own.
pub(crate) fn set_aside(drawing: &Drawing, settings: &Effective, id: EntityId) -> Option<Aside> {
    let entity = drawing.get(id)?;
    let is_asked_for = entity.role.is_some() || own_role(drawing, settings, id).is_some();
    if is_asked_for {
        return None;
    }
    let layer_has_role = || settings.layers.contains(&entity.layer);
    if let Some(linetype) = drawing.linetype(id) {
        if role_of_linetype(settings, &linetype.name).is_some() {
            return None;
        }
        if is_drafting_linetype(&linetype.name) && !(linetype.of_layer && layer_has_role()) {
            return Some(Aside::Linetype(linetype.name.clone()));
        }
    }
    let is_way = || entity.geometry.segment_count() == 1 && is_layer_of_ways(&entity.layer);
    ((is_drafting_layer(&entity.layer) || is_way()) && !layer_has_role())
        .then(|| Aside::Layer(entity.layer.clone()))
}

/// The role that the settings give to a linetype.
pub(super) fn role_of_linetype(settings: &Effective, name: &str) -> Option<Role> {
    if settings.linetypes.is_empty() {
        return None;
    }
    settings.linetypes.get(&name.to_uppercase()).copied()
}

/// The workpiece of an entity that is cut.
pub(super) fn part_of(drawing: &Drawing, settings: &Effective, id: EntityId) -> Option<u16> {
    let layer = || Some(&*drawing.get(id)?.layer);
    is_cut(drawing, settings, id)
        .then(|| layer().map_or(0, |layer| settings.workpieces.of_layer(layer)))
}

/// What is cut on the line is chained by itself: a slit that begins at a corner is no part of the contour there.
const ON_LINE: u16 = 1 << 15;

/// The entities of one number are chained to each other: those of one workpiece that are all cut on the line, or none of them.
pub(super) fn chained_with(drawing: &Drawing, settings: &Effective, id: EntityId) -> Option<u16> {
    let part = part_of(drawing, settings, id)?;
    Some(chain_number(part, role_of(drawing, settings, id)))
}

pub(super) fn chain_number(part: u16, role: Option<Role>) -> u16 {
    match role {
        Some(Role::Line) => part | ON_LINE,
        _ => part,
    }
}

/// True when an entity is part of a contour, which may be a lone line: it has segments, its role is not `ignore`, it is
/// visible, or it has been given a role, or its own layer hides it and has, and it is not set aside by its linetype or
/// its layer. A colour or a handle alone does not bring back a frozen entity, nor does a role of its layer one that is invisible itself.
pub(crate) fn is_cut(drawing: &Drawing, settings: &Effective, id: EntityId) -> bool {
    let Some(entity) = drawing
        .get(id)
        .filter(|entity| entity.geometry.segment_count() > 0)
    else {
        return false;
    };
    if settings
        .only
        .is_some_and(|only| settings.workpieces.of_layer(&entity.layer) != only)
    {
        return false;
    }
    let hiding_layer_has_role = || {
        let layer = drawing.hiding_layer(id);
        layer.is_some_and(|layer| *layer == entity.layer && settings.layers.contains(layer))
    };
    let is_asked_for = || entity.role.is_some() || hiding_layer_has_role();
    role_of(drawing, settings, id) != Some(Role::Ignore)
        && (drawing.visibility(id).is_seen() || is_asked_for())
        && set_aside(drawing, settings, id).is_none()
}
