//! Changes of a drawing: as a CAD program sends them, and as a fix asks for them.

use super::drawing::Entity;
use crate::drawing::{self as core, Change, Delta, EntityId, Geometry, Touched, Vertex};
use rustc_hash::FxHashMap;
use schemars::JsonSchema;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;

/// One change to a drawing.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub(crate) enum DrawingChange {
    /// Vertices of one polyline give way to others.
    Vertices { handle: String, vertices: Splice },
    /// The entity is added or replaced; null deletes it.
    Entity {
        handle: String,
        entity: Option<Entity>,
        /// Handle of the entity before which it comes in machining order; at the end, or where it was, when left out.
        #[serde(skip_serializing_if = "Option::is_none")]
        before: Option<String>,
    },
}

/// `delete_count` vertices from `start` on give way to `insert`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Splice {
    pub(crate) start: usize,
    pub(crate) delete_count: usize,
    pub(crate) insert: Vec<Vertex>,
}

#[derive(Deserialize)]
struct Keys {
    handle: String,
    vertices: Option<Splice>,
    #[serde(default, deserialize_with = "given")]
    entity: Option<Option<Entity>>,
    before: Option<String>,
}

/// Distinguishes `"entity": null` from a missing entity.
fn given<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Option<Entity>>, D::Error> {
    Option::deserialize(deserializer).map(Some)
}

impl<'de> Deserialize<'de> for DrawingChange {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Keys {
            handle,
            vertices,
            entity,
            before,
        } = Keys::deserialize(deserializer)?;
        match (vertices, entity) {
            (Some(vertices), None) => Ok(DrawingChange::Vertices { handle, vertices }),
            (None, Some(entity)) => Ok(DrawingChange::Entity {
                handle,
                entity,
                before,
            }),
            _ => Err(D::Error::custom(say!(
                a_change_needs_vertices_or_an_entity,
                handle
            ))),
        }
    }
}

/// What a handle refers to while changes are tried.
#[derive(Clone, Copy)]
enum Standing {
    Nothing,
    Polyline(usize),
    Other,
}

impl Standing {
    fn of(drawing: &core::Drawing, handle: &str) -> Standing {
        match drawing
            .find(handle)
            .and_then(|id| drawing.get(id))
            .map(|entity| &entity.geometry)
        {
            None => Standing::Nothing,
            Some(Geometry::Polyline { vertices, .. }) => Standing::Polyline(vertices.len()),
            Some(_) => Standing::Other,
        }
    }
}

/// Applies changes one after another: all of them, or none and the reason, which names the change by its index.
pub(crate) fn apply(
    drawing: &mut core::Drawing,
    changes: Vec<DrawingChange>,
) -> Result<Delta, String> {
    // All are first tried on what the handles refer to: undoing half of them would need new ids for removed entities.
    let mut standing: FxHashMap<&str, Standing> = FxHashMap::default();
    for (index, change) in changes.iter().enumerate() {
        try_change(drawing, &mut standing, change)
            .map_err(|reason| say!(change_by_number, index, reason))?;
    }
    let mut delta = Delta::default();
    for change in changes {
        apply_one(drawing, change, &mut delta)?;
    }
    Ok(delta)
}

fn try_change<'a>(
    drawing: &core::Drawing,
    standing: &mut FxHashMap<&'a str, Standing>,
    change: &'a DrawingChange,
) -> Result<(), String> {
    let mut stands = |handle: &'a str| {
        *standing
            .entry(handle)
            .or_insert_with(|| Standing::of(drawing, handle))
    };
    match change {
        DrawingChange::Vertices { handle, vertices } => {
            let (start, delete_count) = (vertices.start, vertices.delete_count);
            let count = match stands(handle) {
                Standing::Polyline(count) => count,
                Standing::Nothing => return Err(say!(there_is_no_entity, handle)),
                Standing::Other => {
                    return Err(say!(entity_is_not_a_polyline, handle));
                }
            };
            if start
                .checked_add(delete_count)
                .is_none_or(|end| end > count)
            {
                return Err(say!(
                    vertices_are_out_of_range,
                    start,
                    delete_count,
                    handle,
                    count
                ));
            }
            let insert = &vertices.insert;
            if let Some(index) = insert.iter().position(|vertex| !vertex.is_finite()) {
                return Err(say!(an_inserted_vertex_is_not_finite, index, handle));
            }
            let count = count - delete_count + insert.len();
            standing.insert(handle, Standing::Polyline(count));
        }
        DrawingChange::Entity {
            handle,
            entity,
            before,
        } => {
            if let Some(before) = before
                && matches!(stands(before), Standing::Nothing)
            {
                return Err(say!(no_entity_to_put_it_before, before, handle));
            }
            let becomes = match entity {
                None if matches!(stands(handle), Standing::Nothing) => {
                    return Err(say!(there_is_no_entity_to_delete, handle));
                }
                None => Standing::Nothing,
                Some(entity) if entity.handle != *handle => {
                    return Err(say!(the_entity_has_another_handle, entity.handle, handle));
                }
                Some(entity) => {
                    entity.check()?;
                    match &entity.shape.geometry {
                        Geometry::Polyline { vertices, .. } => Standing::Polyline(vertices.len()),
                        _ => Standing::Other,
                    }
                }
            };
            standing.insert(handle, becomes);
        }
    }
    Ok(())
}

fn apply_one(
    drawing: &mut core::Drawing,
    change: DrawingChange,
    delta: &mut Delta,
) -> Result<(), String> {
    let found = |drawing: &core::Drawing, handle: &str| {
        let id = drawing.find(handle);
        id.ok_or_else(|| say!(there_is_no_entity, handle))
    };
    match change {
        DrawingChange::Vertices { handle, vertices } => {
            let id = found(drawing, &handle)?;
            let Splice {
                start,
                delete_count,
                insert,
            } = vertices;
            let touched = drawing.splice(id, start, delete_count, &insert);
            delta
                .touched
                .push(touched.map_err(|error| error.to_string())?);
        }
        DrawingChange::Entity {
            handle,
            entity: None,
            ..
        } => {
            let id = found(drawing, &handle)?;
            drawing.remove(id);
            delta.touched.push(Touched::Removed { entity: id });
        }
        DrawingChange::Entity {
            handle,
            entity: Some(entity),
            before,
        } => {
            let (entity, appearance) = entity.into_core()?;
            let id = match (
                drawing.find(&handle),
                before.filter(|before| *before != handle),
            ) {
                (Some(id), None) => {
                    drawing.replace(id, entity);
                    id
                }
                (old, before) => {
                    if let Some(old) = old {
                        drawing.remove(old);
                        delta.touched.push(Touched::Removed { entity: old });
                    }
                    let next = before.and_then(|before| drawing.find(&before));
                    let position =
                        next.and_then(|next| drawing.order().iter().position(|&id| id == next));
                    drawing.insert_at(position.unwrap_or(drawing.len()), entity)
                }
            };
            drawing.set_appearance(id, appearance);
            delta.touched.push(Touched::Entity { entity: id });
        }
    }
    Ok(())
}

/// A fix as changes that are valid one after another and touch nothing that stays: neighbouring vertices of one polyline
/// are one splice, lines and arcs are replaced whole.
pub(crate) fn changes_of(drawing: &core::Drawing, edit: &core::DrawingEdit) -> Vec<DrawingChange> {
    let mut vertices = AtVertices::new();
    let mut entities: BTreeMap<EntityId, Option<Geometry>> = BTreeMap::new();
    let mut added = Vec::new();
    for change in &edit.changes {
        let id = change.entity();
        let Some(old) = drawing.get(id) else { continue };
        match change {
            Change::SetVertex { index, vertex, .. } => {
                let at = at(&mut vertices, id, *index);
                at.own = at.own.or(Some(Some(*vertex)));
            }
            Change::RemoveVertex { index, .. } => at(&mut vertices, id, *index).own = Some(None),
            Change::InsertVertex { index, vertex, .. } => {
                at(&mut vertices, id, *index).before.push(*vertex)
            }
            Change::SetClosed { closed, .. } => {
                if let Geometry::Polyline { vertices, .. } = &old.geometry {
                    let geometry = Geometry::Polyline {
                        closed: *closed,
                        vertices: vertices.clone(),
                    };
                    entities.insert(id, Some(geometry));
                }
            }
            Change::AddEntity { .. } => added.push((id, change)),
            Change::Reshape { geometry, .. } => {
                entities.insert(id, Some(geometry.clone()));
            }
            Change::RemoveEntity { .. } => {
                entities.insert(id, None);
            }
        }
    }
    let mut changes = Vec::new();
    for (id, by_index) in &vertices {
        let Some(entity) = drawing.get(*id).filter(|_| !entities.contains_key(id)) else {
            continue;
        };
        let change = |vertices| DrawingChange::Vertices {
            handle: entity.handle.to_string(),
            vertices,
        };
        changes.extend(splices(by_index).into_iter().map(change));
    }
    for (id, geometry) in entities {
        let Some(old) = drawing.get(id) else { continue };
        changes.push(DrawingChange::Entity {
            handle: old.handle.to_string(),
            entity: geometry.and_then(|geometry| Entity::reshaped(drawing, id, geometry)),
            before: None,
        });
    }
    // New entities come first, while their neighbours are still there; their handles are those that the core gives.
    let mut grown = drawing.clone();
    let mut new = Vec::new();
    for (after, change) in added {
        let Ok(delta) = grown.apply(&core::DrawingEdit {
            changes: vec![change.clone()],
        }) else {
            continue;
        };
        let Some(core::Touched::Entity { entity: id }) = delta.touched.first() else {
            continue;
        };
        let geometry = grown.get(*id).map(|entity| entity.geometry.clone());
        let Some(entity) = geometry.and_then(|it| Entity::reshaped(&grown, *id, it)) else {
            continue;
        };
        let next = drawing
            .order()
            .iter()
            .skip_while(|&&id| id != after)
            .nth(1)
            .and_then(|&id| drawing.get(id));
        let before = next.map(|next| next.handle.to_string());
        new.push(DrawingChange::Entity {
            handle: entity.handle.clone(),
            entity: Some(entity),
            before,
        });
    }
    new.append(&mut changes);
    new
}

/// What becomes of one vertex, and what comes before it.
#[derive(Default)]
struct AtVertex {
    before: Vec<Vertex>,
    /// `Some(None)` removes it, `None` leaves it.
    own: Option<Option<Vertex>>,
}

type AtVertices = BTreeMap<EntityId, BTreeMap<usize, AtVertex>>;

fn at(vertices: &mut AtVertices, entity: EntityId, index: usize) -> &mut AtVertex {
    vertices
        .entry(entity)
        .or_default()
        .entry(index)
        .or_default()
}

/// One splice for each run of neighbouring vertices, from the last run to the first, so that
/// indices stay valid.
fn splices(by_index: &BTreeMap<usize, AtVertex>) -> Vec<Splice> {
    let mut splices: Vec<Splice> = Vec::new();
    for (&index, at) in by_index {
        let insert = at.before.iter().copied().chain(at.own.flatten());
        let delete_count = usize::from(at.own.is_some());
        match splices.last_mut() {
            Some(last) if last.start + last.delete_count == index => {
                last.delete_count += delete_count;
                last.insert.extend(insert);
            }
            _ => splices.push(Splice {
                start: index,
                delete_count,
                insert: insert.collect(),
            }),
        }
    }
    splices.reverse();
    splices
}

#[cfg(test)]
mod tests;
