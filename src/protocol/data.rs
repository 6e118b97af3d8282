//! The `data` of a diagnostic: a finding's numbers, the same object in text documents, drawings and `--output json`.

use crate::document::Document;
use crate::finding::{Detail, Fault, Finding, NoFix, NotJudged, Place, Side, SmallRadius};
use crate::geometry::{Point, Xy};
use crate::program::{Stand, Whereabouts};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Another place that a finding concerns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct RelatedPlace {
    pub(crate) handle: String,
    /// Index of the segment within its entity; not there where the entity as a whole is meant.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) segment: Option<usize>,
}

/// What a finding is about, in drawing units and degrees; in a program in mm, points from its start or, where it says where it begins,
/// absolute. Only what the finding has is there.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct FindingData {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) handle: Option<String>,
    /// Index of the segment within its entity: that of the vertex it starts in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) segment: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) radius: Option<f64>,
    /// The correction that the radius is compared with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) required: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) center: Option<Xy>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) start: Option<Xy>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) end: Option<Xy>,
    /// Degrees, positive counter-clockwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sweep: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) side: Option<Side>,
    /// What an untrimmed offset cuts beyond the wire's contour.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) overcut: Option<f64>,
    /// What stays when the control trims; left out where it is without bound.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) stock_left: Option<f64>,
    /// 1-based number of the pass with the largest correction, where several are set.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) pass: Option<usize>,
    /// Why no fix is offered: `narrow-slot`, `seals-contour`, `short-segment`, `spoils`, `no-neighbour`, `not-editable` or `program`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<String>")]
    pub(crate) no_fix: Option<NoFix>,
    /// Degrees by which the contour turns at a corner, positive counter-clockwise in the entity's own direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) turn: Option<f64>,
    /// How much the wire leaves standing in a corner, or of a part that it does not reach: the distance of the farthest point from
    /// what is cut.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) uncut: Option<f64>,
    /// The point where two segments meet, or near which a part is lost.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) at: Option<Xy>,
    /// Width of a slot, distance of two ends, deviation of chords from their circle, the clearance left between two parts, or how far a
    /// program is beside its drawing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) distance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) length: Option<f64>,
    /// Kind of entity that is not cut, or the part of a pair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) kind: Option<String>,
    /// How many the finding stands for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) count: Option<usize>,
    /// The other segment or entity, where two are concerned.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) related: Vec<RelatedPlace>,
}

impl FindingData {
    /// The data of one finding of a document; `whereabouts` are those in its program.
    pub(crate) fn of(
        document: &Document,
        finding: &Finding,
        whereabouts: &mut Option<Whereabouts<'_>>,
    ) -> FindingData {
        let mut data = FindingData::default();
        let drawing = document.drawing();
        if let (Place::Segment { entity, .. } | Place::Entity { entity }, Some(drawing)) =
            (&finding.place, drawing)
            && let Some(found) = drawing.get(*entity)
        {
            data.handle = Some(found.handle.to_string());
            if let Place::Segment { segment, .. } = finding.place {
                data.segment = Some(segment);
                let geometry = drawing.segment(*entity, segment);
                data.start = geometry.map(|geometry| geometry.start().into());
                data.end = geometry.map(|geometry| geometry.end().into());
            }
        }
        let related = |place: &Place| {
            let (entity, segment) = place.entity()?;
            Some(RelatedPlace {
                handle: drawing?.get(entity)?.handle.to_string(),
                segment,
            })
        };
        data.related = finding.related.iter().filter_map(related).collect();
        data.detail(&finding.detail);
        if let (Place::Text { range }, Some(whereabouts)) = (&finding.place, whereabouts)
            && let Some(stand) = whereabouts.of(range)
        {
            data.stand(&finding.detail, stand);
        }
        data
    }

    fn detail(&mut self, detail: &Detail) {
        match detail {
            Detail::SmallRadius(tight) => self.small_radius(tight),
            Detail::UnsupportedEntity { kind, count, .. } => {
                self.kind = Some(kind.clone());
                self.count = Some(*count);
            }
            Detail::SetAside(parts) => {
                self.count = Some(parts.iter().map(|part| part.count).sum());
            }
            Detail::Unseen { count, .. } | Detail::More { count } => self.count = Some(*count),
            Detail::Wide { count, width } => {
                self.count = Some(*count);
                self.distance = Some(*width);
            }
            Detail::SharpCorner {
                turn,
                radius,
                uncut,
                count,
            } => {
                self.turn = Some(turn.to_degrees());
                self.radius = Some(*radius);
                self.uncut = Some(*uncut);
                self.count = *count;
            }
            Detail::SharpCorners {
                radius,
                uncut,
                at,
                count,
            } => {
                self.radius = Some(*radius);
                self.uncut = Some(*uncut);
                self.at = Some((*at).into());
                self.count = Some(*count);
            }
            Detail::NarrowSlot {
                width, required, ..
            } => {
                self.distance = Some(*width);
                self.required = Some(*required);
            }
            Detail::LostPocket { near } | Detail::UnprovedPath { near } => {
                self.at = Some((*near).into())
            }
            Detail::DeadEnd { near, uncut } => {
                self.at = Some((*near).into());
                self.uncut = Some(*uncut);
            }
            Detail::OffsetCollapse { required, .. } => self.required = Some(*required),
            Detail::OpenContour { distance, .. } | Detail::Gap { distance } => {
                self.distance = Some(*distance)
            }
            Detail::DoesNotFit(misfit) => {
                self.at = Some(misfit.at.into());
                self.distance = Some(misfit.clearance);
                self.required = Some(misfit.wanted);
                self.kind = Some(misfit.of.to_string());
            }
            Detail::NoPartner { of, .. } => self.kind = Some(of.to_string()),
            Detail::Unwritable(_) | Detail::Said(_) => {}
            Detail::NotJudged(what) => self.count = left_out(what),
            Detail::DuplicateEntity { count } => self.count = (*count > 1).then_some(*count),
            Detail::Overlap { length } | Detail::ShortSegment { length } => {
                self.length = Some(*length)
            }
            Detail::Size { size } => self.length = Some(*size),
            Detail::NearTangent { turn } => self.turn = Some(turn.to_degrees()),
            Detail::NearTangents { turn, at, count } => {
                self.turn = Some(turn.to_degrees());
                self.at = Some((*at).into());
                self.count = Some(*count);
            }
            Detail::OpenContours { count, .. } => self.count = Some(*count),
            Detail::SelfIntersection { at, count, .. } => {
                self.at = Some((*at).into());
                self.count = (*count > 1).then_some(*count);
            }
            Detail::ArcAsChords {
                chords,
                center,
                radius,
                deviation,
                ..
            }
            | Detail::ArcsAsChords {
                chords,
                center,
                radius,
                deviation,
                ..
            } => {
                self.count = Some(*chords);
                self.center = Some((*center).into());
                self.radius = Some(*radius);
                self.distance = Some(*deviation);
            }
            Detail::Program(fault) => self.program(fault),
            Detail::NotTheDrawing(unlike) => self.distance = unlike.off(),
        }
    }

    /// Adds the place in the program and moves all points to its frame: a block of 3B gives its own
    /// points from its start only.
    fn stand(&mut self, detail: &Detail, stand: Stand) {
        if let (Some(center), Some(start)) = (self.center, self.start) {
            let [center, start] = [center, start].map(Into::<Point>::into);
            self.center = Some((stand.start + (center - start)).into());
        }
        self.start = Some(stand.start.into());
        self.end = stand.end.map(Into::into);
        if let (Detail::LostPocket { near }, None) = (detail, self.handle.as_ref()) {
            self.at = Some((stand.start + near.coords).into());
        }
        let Detail::Program(fault) = detail else {
            return;
        };
        self.at = match **fault {
            Fault::NotClosed { .. } | Fault::PositionMismatch { .. } => self.end,
            Fault::PathCrossesItself { from_block, .. } => {
                from_block.map(|by| (stand.start + by).into())
            }
            _ => None,
        };
    }

    /// Lengths in mm, as in every text.
    fn program(&mut self, fault: &Fault) {
        let mm = |um: i64| um as f64 / 1000.0;
        match *fault {
            Fault::LengthInJ { j, projection, .. } | Fault::WrongJ { j, projection, .. } => {
                self.length = Some(mm(j));
                self.required = Some(mm(projection));
            }
            Fault::FieldKeepsOpen {
                numbers: Some([length, required]),
                ..
            }
            | Fault::JOverTurn {
                j: length,
                turn: required,
            } => {
                self.length = Some(mm(length));
                self.required = Some(mm(required));
            }
            Fault::SmallerProjection {
                counted, larger, ..
            } => {
                self.length = Some(mm(counted));
                self.required = Some(mm(larger));
            }
            Fault::AbsurdSize { size } => self.length = Some(size),
            Fault::TooManyDigits { value, .. } => self.length = Some(mm(value)),
            Fault::NotClosed { x, y } | Fault::PositionMismatch { x, y } => {
                self.distance = Some(x.hypot(y) / 1000.0);
            }
            Fault::RadiusOff { radius, meant } => {
                self.radius = Some(mm(radius));
                self.required = Some(mm(meant));
            }
            Fault::OffRadius { start, end } => {
                self.radius = Some(start / 1e3);
                self.distance = Some((start - end).abs() / 1e3);
            }
            Fault::Foreign { ref word, count } => {
                self.kind = Some(word.clone());
                self.count = Some(count);
            }
            _ => {}
        }
    }

    fn small_radius(&mut self, detail: &SmallRadius) {
        self.radius = Some(detail.radius);
        self.required = Some(detail.required);
        self.center = Some(detail.center.into());
        self.start = Some(detail.start.into());
        self.end = Some(detail.end.into());
        self.sweep = Some(detail.sweep.to_degrees());
        self.side = Some(detail.side);
        self.overcut = Some(detail.overcut);
        self.stock_left = Some(detail.stock_left).filter(|stock| stock.is_finite());
        self.pass = detail.pass;
        self.no_fix = detail.no_fix;
    }

    pub(crate) fn is_empty(&self) -> bool {
        *self == FindingData::default()
    }
}

/// How much was left out, where that is counted.
fn left_out(what: &NotJudged) -> Option<usize> {
    match *what {
        NotJudged::Pairs { count }
        | NotJudged::Offsets { contours: count }
        | NotJudged::Path {
            segments: count, ..
        }
        | NotJudged::Losses { blocks: count }
        | NotJudged::Crossings { blocks: count } => Some(count),
        NotJudged::Reference { copies, .. } => usize::try_from(copies).ok(),
        NotJudged::Curve { arcs, .. } => Some(arcs),
        NotJudged::Calls { .. } => None,
    }
}
