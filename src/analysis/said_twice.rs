//! Contours that are given two roles: the one that decides, and the other; and roles that are given to no contour.

use super::Analysis;
use super::contours::role_of_linetype;
use super::report::Report;
use crate::drawing::{ContourKey, Drawing, EntityId, Role};
use crate::finding::{Detail, Place, Rule, Severity};
use crate::settings::Effective;
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Contours of more segments in all are not looked through at every edit.
const MOST_SEGMENTS: usize = 2_000;

/// A role, who gives it, and the entity that it is given to.
struct Said {
    role: Role,
    by: String,
    to: EntityId,
    /// It is given to this contour alone, as an exception to what is said of others.
    is_own: bool,
}

impl Analysis {
    /// The contours to which another role is given than the one that decides.
    pub(super) fn report_roles_said_twice(
        &self,
        drawing: &Drawing,
        ordered: &[ContourKey],
        report: &mut Report,
    ) {
        if self.segments > MOST_SEGMENTS || self.stated == 0 || !report.shows_findings() {
            return;
        }
        let severity = Some(Severity::Warning);
        for contour in ordered.iter().filter_map(|&key| self.chains.get(key)) {
            let mut entities: Vec<EntityId> = contour.pieces.iter().map(|it| it.entity).collect();
            entities.sort_unstable_by_key(|&id| drawing.rank(id));
            let mut all = entities
                .iter()
                .flat_map(|&id| said_of(drawing, &self.settings, id));
            let Some(first) = all.next() else { continue };
            // What is said of one contour may well differ from what is said of all on its layer.
            let Some(other) = all.find(|it| it.role != first.role && it.is_own == first.is_own)
            else {
                continue;
            };
            if !report.counts(Rule::Settings, severity) {
                continue;
            }
            let name = drawing.get(first.to).map_or("", |entity| &entity.handle);
            let sentence = say!(
                a_contour_of_two_roles,
                name,
                first.role.name(),
                first.by,
                other.role.name(),
                other.by
            );
            let place = Place::Entity { entity: first.to };
            let related = match other.to == first.to {
                true => Vec::new(),
                false => vec![Place::Entity { entity: other.to }],
            };
            report.add(
                Rule::Settings,
                severity,
                place,
                Detail::Said(sentence),
                related,
            );
        }
    }
}

/// Up to this many layers are listed.
const MOST_LAYERS: usize = 12;

impl Analysis {
    /// Roles of layers that the drawing does not have, where contours have none: a name that is spelled otherwise, or that was
    /// read in another code page.
    pub(super) fn report_roles_of_no_layer(&self, drawing: &Drawing, report: &mut Report) {
        let severity = Some(Severity::Warning);
        let roles = &self.settings.layers;
        let is_whole = self.known.values().all(|known| known.stated.is_some());
        if is_whole || roles.is_empty() || !report.shows_findings() {
            return;
        }
        // Neighbours mostly share the name of their layer.
        let mut layers: BTreeSet<&Arc<str>> = BTreeSet::new();
        let mut last = None;
        for (_, entity) in drawing.entities() {
            if !last.is_some_and(|last| Arc::ptr_eq(last, &entity.layer)) {
                layers.insert(&entity.layer);
                last = Some(&entity.layer);
            }
        }
        let upper: FxHashSet<String> = layers.iter().map(|layer| layer.to_uppercase()).collect();
        let has_none = |name: &&str| !upper.contains(&name.to_uppercase());
        let idle: Vec<&str> = roles.names().filter(has_none).collect();
        if idle.is_empty() || !report.counts(Rule::Settings, severity) {
            return;
        }
        let idle = listed(idle.into_iter());
        let layers = listed(layers.into_iter().map(|layer| &**layer));
        let sentence = say!(roles_of_no_layer, "[layers]", idle, layers);
        let detail = Detail::Said(sentence);
        report.add(
            Rule::Settings,
            severity,
            Place::Document,
            detail,
            Vec::new(),
        );
    }
}

fn listed<'a>(mut names: impl Iterator<Item = &'a str>) -> String {
    let first: Vec<&str> = names.by_ref().take(MOST_LAYERS).collect();
    let more = if names.next().is_some() { " …" } else { "" };
    format!("{}{more}", first.join(say!(comma)))
}

/// The roles that an entity is given, in the order in which they decide.
fn said_of(drawing: &Drawing, settings: &Effective, id: EntityId) -> Vec<Said> {
    let Some(entity) = drawing.get(id) else {
        return Vec::new();
    };
    let said = |role: Role, by: String, is_own: bool| Said {
        role,
        by,
        to: id,
        is_own,
    };
    let handle = &*entity.handle;
    let is_own = settings
        .own
        .get(handle)
        .is_some_and(|own| own.side.is_some());
    let by_handle = settings
        .contours
        .get(handle)
        .copied()
        .map(|role| match is_own {
            true => {
                let document = settings.document.as_deref().unwrap_or_default();
                said(
                    role,
                    format!("drawings.\"{document}\".contours.{handle}"),
                    true,
                )
            }
            false => said(role, format!("contours.{handle}"), false),
        });
    let linetype = drawing.linetype(id);
    let by_linetype = linetype.and_then(|linetype| {
        let role = role_of_linetype(settings, &linetype.name)?;
        Some(said(role, format!("linetypes.{}", linetype.name), false))
    });
    let by_layer = settings
        .layers
        .get(&entity.layer)
        .map(|role| said(role, format!("layers.{}", entity.layer), false));
    let by_color = drawing.color(id).and_then(|color| {
        let role = *settings.colors.get(&color)?;
        Some(said(role, say!(its_color).into(), false))
    });
    let by_entity = entity
        .role
        .map(|role| said(role, say!(the_entity_itself).into(), true));
    [by_entity, by_handle, by_linetype, by_layer, by_color]
        .into_iter()
        .flatten()
        .collect()
}
