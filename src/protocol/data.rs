//! The `data` of a diagnostic: a finding's numbers, the same object in text documents, drawings and `--output json`.

use super::drawing::Point;
use crate::drawing::Drawing;
use crate::finding::{Detail, Finding, NoFix, Place, Side, SmallRadius};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Side of the entity's own direction on which the wire runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SideName {
    Left,
    Right,
}

/// What a finding is about, in drawing units and degrees. Only what the finding has is there.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase", default)]
pub struct FindingData {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub handle: Option<String>,
    /// Index of the segment within its entity: that of the vertex it starts in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub segment: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// The correction that the radius is held against.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub required: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<Point>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<Point>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<Point>,
    /// Degrees, positive counter-clockwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweep: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<SideName>,
    /// What an untrimmed offset cuts beyond the wire's contour.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overcut: Option<f64>,
    /// What stays when the control trims; left out where it is without bound.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stock_left: Option<f64>,
    /// 1-based number of the pass with the largest correction, where several are set.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pass: Option<usize>,
    /// Why no fix is offered: `narrow-slot`, `seals-contour`, `no-neighbour` or `not-editable`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_fix: Option<String>,
    /// Kind of entity that is not cut.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// How many the finding stands for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
}

impl FindingData {
    /// The data of one finding; `drawing` is where its place lies, `None` for a program or a settings file.
    pub fn of(drawing: Option<&Drawing>, finding: &Finding) -> FindingData {
        let mut data = FindingData::default();
        if let (Place::Segment { entity, .. } | Place::Entity { entity }, Some(drawing)) = (&finding.place, drawing)
            && let Some(entity) = drawing.get(*entity)
        {
            data.handle = Some(entity.handle.to_string());
            if let Place::Segment { segment, .. } = finding.place {
                data.segment = Some(segment);
                let geometry = entity.geometry.segment(segment);
                data.start = geometry.map(|geometry| geometry.start().into());
                data.end = geometry.map(|geometry| geometry.end().into());
            }
        }
        match &finding.detail {
            Detail::SmallRadius(detail) => data.small_radius(detail),
            Detail::UnsupportedEntity { kind, count, .. } => {
                data.kind = Some(kind.clone());
                data.count = Some(*count);
            }
            Detail::More { count } => data.count = Some(*count),
            Detail::LeadIn(_) | Detail::Units(_) | Detail::Syntax(_) | Detail::Settings(_) => {}
        }
        data
    }

    fn small_radius(&mut self, detail: &SmallRadius) {
        self.radius = Some(detail.radius);
        self.required = Some(detail.required);
        self.center = Some(detail.center.into());
        self.start = Some(detail.start.into());
        self.end = Some(detail.end.into());
        self.sweep = Some(detail.sweep.to_degrees());
        self.side = Some(match detail.side {
            Side::Left => SideName::Left,
            Side::Right => SideName::Right,
        });
        self.overcut = Some(detail.overcut);
        self.stock_left = Some(detail.stock_left).filter(|stock| stock.is_finite());
        self.pass = detail.pass;
        self.no_fix = detail.no_fix.map(|reason| no_fix_name(reason).into());
    }

    pub fn is_empty(&self) -> bool {
        *self == FindingData::default()
    }
}

fn no_fix_name(reason: NoFix) -> &'static str {
    match reason {
        NoFix::NarrowSlot => "narrow-slot",
        NoFix::SealsContour => "seals-contour",
        NoFix::NoNeighbour => "no-neighbour",
        NoFix::NotEditable => "not-editable",
    }
}
