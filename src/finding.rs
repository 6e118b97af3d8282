//! The finding of a rule or a reader as data: the rule, the place, the numbers.
//!
//! [`sentence()`] turns it into text for people, the server into its form in the protocol.

#[macro_use]
mod told;
mod aside;
mod detail;
mod fault;
mod fix;
mod lengths;
mod misfit;
mod not_judged;
mod sentence;
mod small_radius;
mod unlike;
mod unwritable;

pub(crate) use aside::MOST_HANDLES;
pub use aside::{Aside, SetAside};
pub use detail::Detail;
pub use fault::Axis;
pub(crate) use fault::Fault;
pub(crate) use fix::{CenterFix, TextFix, ignored};
pub use fix::{Edit, Fix, FixKind, Keep};
pub use lengths::Telling;
pub(crate) use misfit::Cause;
pub use misfit::Misfit;
pub(crate) use not_judged::NotJudged;
pub(crate) use sentence::related;
pub use sentence::sentence;
pub use small_radius::NoFix;
pub(crate) use small_radius::SmallRadius;
pub use unlike::{DifferenceKind, Unlike};
pub(crate) use unwritable::Unwritable;

pub use crate::geometry::Side;
pub use crate::rule::{Rule, Severity};

use crate::drawing::{ContourSegment, EntityId, Unseen, Wide};
use rustc_hash::FxHashSet;
use std::ops::Range;

impl From<&ContourSegment> for Place {
    fn from(segment: &ContourSegment) -> Place {
        Place::Segment {
            entity: segment.entity,
            segment: segment.segment,
        }
    }
}

impl Place {
    /// The entity at which it lies in a drawing, and the segment, if any.
    pub(crate) fn entity(&self) -> Option<(EntityId, Option<usize>)> {
        match *self {
            Place::Segment { entity, segment } => Some((entity, Some(segment))),
            Place::Entity { entity } => Some((entity, None)),
            Place::Text { .. } | Place::Document => None,
        }
    }

    fn is_of(&self, entities: &FxHashSet<EntityId>) -> bool {
        self.entity()
            .is_some_and(|(entity, _)| entities.contains(&entity))
    }
}

impl Finding {
    /// True if it concerns one of the `entities`, or any entity where that is `None`; always true
    /// if it concerns the document as a whole or its text.
    pub(crate) fn concerns(&self, entities: Option<&FxHashSet<EntityId>>) -> bool {
        let of_entities = |entities| {
            self.place.is_of(entities) || self.related.iter().any(|place| place.is_of(entities))
        };
        self.place.entity().is_none() || entities.is_none_or(of_entities)
    }
}

impl From<Unseen> for Finding {
    fn from(unseen: Unseen) -> Finding {
        Finding {
            rule: Rule::UnsupportedEntity,
            severity: Severity::Information,
            place: Place::Entity {
                entity: unseen.first,
            },
            detail: Detail::Unseen {
                layer: unseen.layer,
                visibility: unseen.visibility,
                count: unseen.count,
            },
            related: Vec::new(),
        }
    }
}

impl From<Wide> for Finding {
    fn from(wide: Wide) -> Finding {
        let Wide {
            count,
            width,
            first: entity,
        } = wide;
        Finding {
            rule: Rule::UnsupportedEntity,
            severity: Severity::Information,
            place: Place::Entity { entity },
            detail: Detail::Wide { count, width },
            related: Vec::new(),
        }
    }
}

/// The place of a finding.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// A segment of an entity, by its index within the entity.
    Segment {
        entity: EntityId,
        segment: usize,
    },
    Entity {
        entity: EntityId,
    },
    /// A range of bytes of the document's text.
    Text {
        range: Range<usize>,
    },
    /// The document as a whole.
    Document,
}

impl Place {
    /// Its bytes, where it is one of the text.
    pub(crate) fn in_text(&self) -> Option<&Range<usize>> {
        match self {
            Place::Text { range } => Some(range),
            _ => None,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub rule: Rule,
    pub severity: Severity,
    pub place: Place,
    pub detail: Detail,
    /// The other places that are concerned, where there are two.
    pub related: Vec<Place>,
}

impl Finding {
    /// A fault of a program, at some bytes of its text.
    pub(crate) fn of(fault: Fault, range: Range<usize>) -> Finding {
        let (rule, severity) = (fault.rule(), fault.severity());
        Finding::in_text(rule, range, Detail::Program(Box::new(fault))).with(severity)
    }

    /// A finding of a rule at some bytes of a text, with the default severity of the rule.
    pub(crate) fn in_text(rule: Rule, range: Range<usize>, detail: Detail) -> Finding {
        Finding {
            rule,
            severity: rule.default_severity(),
            place: Place::Text { range },
            detail,
            related: Vec::new(),
        }
    }

    /// The same with another severity.
    pub(crate) fn with(self, severity: Severity) -> Finding {
        Finding { severity, ..self }
    }
}
