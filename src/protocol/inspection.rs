//! The radius list: every segment of every entity with its verdict.

use super::segment::SegmentShape;
use super::work::LargestWire;
use crate::analysis;
use crate::document::Document;
use crate::drawing::{Drawing, Entity, EntityId};
use crate::finding::{Finding, Place, Rule, Severity};
use rustc_hash::FxHashMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Every entity that has plane geometry, in machining order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct Inspection {
    /// Millimetres in one drawing unit.
    pub(crate) units_to_mm: f64,
    pub(crate) entities: Vec<InspectedEntity>,
    /// The thickest wire that still cuts every arc of a contour, where the gap is set.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) largest_wire: Option<LargestWire>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct InspectedEntity {
    pub(crate) handle: String,
    /// The DXF name: LINE, ARC, CIRCLE, LWPOLYLINE, POLYLINE.
    pub(crate) r#type: String,
    pub(crate) layer: String,
    pub(crate) closed: bool,
    /// False where it is no part of a contour: its layer is frozen or switched off, its role is `ignore`, it is drawn to be read (as centre
    /// lines are) and not to be cut, or it is a point.
    pub(crate) cut: bool,
    pub(crate) segments: Vec<InspectedSegment>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct InspectedSegment {
    /// Index within the entity: that of the vertex it starts in.
    pub(crate) index: usize,
    #[serde(flatten)]
    pub(crate) shape: SegmentShape,
    /// `ok`, or the names of the rules of which an error or a warning lies here, with a comma between.
    pub(crate) verdict: String,
}

impl Inspection {
    /// The list of an open document; `None` for a program, which holds no drawing.
    pub fn of(document: &Document, handle: Option<&str>) -> Option<Inspection> {
        let findings = document.all_findings();
        let drawing = document.drawing()?;
        let unit = document.settings().unit_of(drawing);
        let zero_length = document.settings().tolerances.in_units(unit.mm).zero_length;
        let is_cut = |id| document.cuts(id);
        let snapshot = document.snapshot()?;
        let largest =
            analysis::largest_wire(drawing, &snapshot.outlines, document.settings(), &|_| true);
        Some(Inspection {
            largest_wire: largest.map(|largest| LargestWire::new(drawing, &largest)),
            ..Inspection::new(drawing, unit.mm, zero_length, &findings, &is_cut, handle)
        })
    }

    /// The list of all of `drawing`, or of the entity `handle`. `findings` are all of the drawing's; a segment shorter
    /// than `zero_length` (drawing units) is left out, its neighbours keep their index.
    pub(crate) fn new(
        drawing: &Drawing,
        unit_mm: f64,
        zero_length: f64,
        findings: &[Finding],
        is_cut: &dyn Fn(EntityId) -> bool,
        handle: Option<&str>,
    ) -> Inspection {
        let mut rules: FxHashMap<(EntityId, usize), Vec<&'static str>> = FxHashMap::default();
        for finding in findings
            .iter()
            .filter(|finding| finding.severity <= Severity::Warning)
        {
            if let Place::Segment { entity, segment } = finding.place {
                let names = rules.entry((entity, segment)).or_default();
                if !names.contains(&finding.rule.name()) {
                    names.push(finding.rule.name());
                }
            }
        }
        let segments_of = |id: EntityId, entity: &Entity| -> Vec<InspectedSegment> {
            if let Some(at) = entity.point_of_arc() {
                return vec![InspectedSegment {
                    index: 0,
                    shape: SegmentShape::point(at.into()),
                    verdict: Rule::Syntax.name().into(),
                }];
            }
            let segments = entity
                .geometry
                .segments_of(drawing.flat())
                .enumerate()
                .filter(|(_, segment)| segment.length() > zero_length);
            let inspected = segments.map(|(index, segment)| InspectedSegment {
                index,
                shape: SegmentShape::from(&segment),
                verdict: rules
                    .get(&(id, index))
                    .map_or_else(|| "ok".into(), |names| names.join(",")),
            });
            inspected.collect()
        };
        let asked_for = drawing
            .entities()
            .filter(|(_, entity)| handle.is_none_or(|handle| *entity.handle == *handle));
        let with_geometry = asked_for.filter(|(_, entity)| {
            entity.geometry.segment_count() > 0 || entity.point_of_arc().is_some()
        });
        let entities = with_geometry.map(|(id, entity)| InspectedEntity {
            handle: entity.handle.to_string(),
            r#type: entity.kind.name().into(),
            layer: entity.layer.to_string(),
            closed: entity.geometry.is_closed(),
            cut: is_cut(id),
            segments: segments_of(id, entity),
        });
        Inspection {
            largest_wire: None,
            units_to_mm: unit_mm,
            entities: entities.collect(),
        }
    }
}
