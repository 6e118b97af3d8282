//! The finding of a rule or a reader as data: the rule, the place, the numbers.
//!
//! [`sentence()`] turns it into text for people, the server into its form in the protocol.

mod aside;
mod fault;
mod fix;
mod lengths;
mod not_judged;
mod program_sentence;
mod sentence;
mod small_radius;
mod title;
mod unlike;
mod unwritable;

pub(crate) use aside::MOST_HANDLES;
pub use aside::{Aside, SetAside};
pub use fault::Axis;
pub(crate) use fault::Fault;
pub(crate) use fix::{CenterFix, TextFix, ignored};
pub use fix::{Edit, Fix, FixKind, Keep};
pub(crate) use not_judged::NotJudged;
pub(crate) use sentence::related;
pub use sentence::{Telling, sentence};
pub use small_radius::NoFix;
pub(crate) use small_radius::SmallRadius;
pub(crate) use title::title;
pub use unlike::Unlike;
pub(crate) use unwritable::Unwritable;

pub use crate::geometry::Side;
pub use crate::rule::{Rule, Severity};

use crate::drawing::{ContourSegment, EntityId, Visibility};
use crate::geometry::Point;
use rustc_hash::FxHashSet;
use std::ops::Range;
use std::sync::Arc;

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
    /// True if it concerns one of the `entities`, or any where they are `None`; always if it concerns the document as a
    /// whole or its text.
    pub(crate) fn concerns(&self, entities: Option<&FxHashSet<EntityId>>) -> bool {
        let of_entities = |entities| {
            self.place.is_of(entities) || self.related.iter().any(|place| place.is_of(entities))
        };
        self.place.entity().is_none() || entities.is_none_or(of_entities)
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

/// The numbers of a finding. One variant for each kind of sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum Detail {
    SmallRadius(Box<SmallRadius>),
    /// A corner concave to the wire turns by `turn` (radians): the wire leaves `radius` and does not cut `uncut`. Where
    /// the wire side is not known, one finding stands for the `count` corners of its contour, and `uncut` is that of a
    /// corner if the wire runs inside of it; else `count` is `None`.
    SharpCorner {
        turn: f64,
        radius: f64,
        uncut: f64,
        count: Option<usize>,
    },
    /// Facing walls are `width` apart, the wire needs `required`.
    NarrowSlot {
        width: f64,
        required: f64,
    },
    /// The offset loses a part of the outline, near a point.
    LostPocket {
        near: Point,
    },
    /// The wire comes no further between two walls: the rest stays uncut, and `near` is farthest from the wire, by this
    /// much.
    DeadEnd {
        near: Point,
        uncut: f64,
    },
    /// The offset of the outline is empty at this correction.
    OffsetCollapse {
        required: f64,
        /// A point is left: the wire can stand there, and cuts nothing more.
        point: bool,
    },
    /// The planned path of the wire fails its proof, near a point.
    UnprovedPath {
        near: Point,
    },
    /// There is a path, but the language of the program cannot express it.
    Unwritable(Unwritable),
    /// The ends of a contour are `distance` apart.
    OpenContour {
        distance: f64,
    },
    /// Two ends that belong together are `distance` apart.
    Gap {
        distance: f64,
    },
    /// This many entities of a contour lie there more than once.
    DuplicateEntity {
        count: usize,
    },
    /// Two segments coincide over `length`.
    Overlap {
        length: f64,
    },
    NotJudged(NotJudged),
    ShortSegment {
        length: f64,
    },
    /// Two segments meet at `turn` radians: nearly tangent, but not quite.
    NearTangent {
        turn: f64,
    },
    /// Segments cross, or only touch, at a point: the first of `count` along one of the two, where that meets many.
    SelfIntersection {
        at: Point,
        touches: bool,
        count: usize,
    },
    /// `chords` lines in a row lie on one circle, within `deviation`.
    ArcAsChords {
        chords: usize,
        center: Point,
        radius: f64,
        deviation: f64,
    },
    /// A fault in a block or contour of a program.
    Program(Box<Fault>),
    DoesNotFit(Box<Misfit>),
    /// A contour of the workpiece `of` has no partner in another.
    NoPartner {
        of: Arc<str>,
        /// Workpieces without any entity.
        missing: Vec<String>,
    },
    /// A program and its drawing differ.
    NotTheDrawing(Box<Unlike>),
    /// The `kind` of entity, and the number of them; the place is the first.
    UnsupportedEntity {
        kind: String,
        count: usize,
        why: &'static str,
    },
    /// `count` entities are drawn on a layer that is not simply shown, or are invisible themselves.
    Unseen {
        layer: Arc<str>,
        visibility: Visibility,
        count: usize,
    },
    /// Entities drawn to be read and not to be cut.
    SetAside(Vec<SetAside>),
    /// The larger side of the largest contour, which suggests another unit.
    Size {
        size: f64,
    },
    /// Only what the sentence says: what was found and what was expected, lower-case, no final dot.
    Said(String),
    More {
        count: usize,
    },
}

/// Two parts of a pair bind. Lengths in drawing units.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    /// On the outline that protrudes.
    pub at: Point,
    /// The remaining clearance; below 0.
    pub clearance: f64,
    /// The required clearance.
    pub wanted: f64,
    /// The part at whose segment the finding stands, and its partner: `punch` and `plate`, or names of workpieces.
    pub of: Arc<str>,
    pub partner: Arc<str>,
    pub(crate) cause: Cause,
}

/// Why two parts bind.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cause {
    /// The wire leaves too much in a corner of this part.
    Corner(Arc<str>),
    /// Both are drawn as arcs there, of radii that do not differ by the clearance: that of the part at whose segment the finding stands first.
    /// Drawing units.
    Radii([f64; 2]),
    /// They lie too near to each other, which no corner radius mends.
    Wall,
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
