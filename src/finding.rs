//! What a rule or a reader has found, as data: the rule, the place, the numbers.
//!
//! The sentence that a person reads is made from it in [`crate::message`]; the protocol's form in `server`.

use crate::drawing::{DrawingEdit, EntityId};
use crate::geometry::Point;
use std::ops::Range;

/// The rules by the names that users see. Order is that of the documentation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Rule {
    SmallRadius,
    LeadIn,
    UnsupportedEntity,
    Units,
    /// Damaged DXF or 3B text.
    Syntax,
    /// A value in `wedm.toml` or in the client's settings that does not fit.
    Settings,
    /// Stands for the findings beyond the 500 of one publish.
    More,
}

impl Rule {
    pub const ALL: [Rule; 7] =
        [Rule::SmallRadius, Rule::LeadIn, Rule::UnsupportedEntity, Rule::Units, Rule::Syntax, Rule::Settings, Rule::More];

    pub fn name(self) -> &'static str {
        match self {
            Rule::SmallRadius => "small-radius",
            Rule::LeadIn => "lead-in",
            Rule::UnsupportedEntity => "unsupported-entity",
            Rule::Units => "units",
            Rule::Syntax => "syntax",
            Rule::Settings => "settings",
            Rule::More => "more",
        }
    }

    pub fn default_severity(self) -> Severity {
        match self {
            Rule::SmallRadius | Rule::LeadIn | Rule::Syntax | Rule::Settings => Severity::Error,
            Rule::Units => Severity::Warning,
            Rule::UnsupportedEntity | Rule::More => Severity::Information,
        }
    }
}

/// How bad a finding is; the order is from worst to mildest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    Error,
    Warning,
    Information,
    Hint,
}

/// Where a finding lies.
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

/// On which side of its contour's direction of travel the wire runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Left,
    Right,
}

impl Side {
    /// +1 for left, −1 for right.
    pub fn sign(self) -> f64 {
        match self {
            Side::Left => 1.0,
            Side::Right => -1.0,
        }
    }

    pub fn reversed(self) -> Side {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }
}

/// Why no fix is offered for an arc that is too tight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoFix {
    /// A slot, hole or pocket narrower than twice the correction: no arc of the required radius fits (`narrow-slot`).
    NarrowSlot,
    /// The arc that fits would move the contour by more than the correction, or remove more of it than a short neighbour.
    SealsContour,
    /// The arc ends an open contour: there is no neighbour to be tangent to.
    NoNeighbour,
    /// The entity cannot be edited (part of a block, or of a kind that has no such edit).
    NotEditable,
}

/// An arc tighter than the correction, in drawing units. Lengths for people are made in mm by the message.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallRadius {
    pub radius: f64,
    /// The correction that the radius is held against.
    pub required: f64,
    pub center: Point,
    pub start: Point,
    pub end: Point,
    /// Signed sweep in the entity's own direction, radians.
    pub sweep: f64,
    /// Wire side in the entity's own direction.
    pub side: Side,
    /// What an untrimmed offset cuts beyond the wire's contour: `(c − r)(1 − cos θ)`, at most `2 (c − r)`.
    pub overcut: f64,
    /// What stays when the control trims: `(c − r)(1 / cos(θ/2) − 1)`; infinite at a half turn and beyond.
    pub stock_left: f64,
    /// The pass (1-based) whose correction is the largest, where several passes are set.
    pub pass: Option<usize>,
    /// Why no fix is offered; `None` where one is.
    pub no_fix: Option<NoFix>,
}

/// The numbers of a finding. One variant for each kind of sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum Detail {
    SmallRadius(Box<SmallRadius>),
    LeadIn(String),
    /// `kind` of entity, and how many of it; the place is the first.
    UnsupportedEntity {
        kind: String,
        count: usize,
        why: &'static str,
    },
    Units(String),
    /// What was found and what was expected, lower-case, no final dot.
    Syntax(String),
    Settings(String),
    More {
        count: usize,
    },
}

#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub rule: Rule,
    pub severity: Severity,
    pub place: Place,
    pub detail: Detail,
}

/// A repair that a user may choose.
#[derive(Clone, Debug, PartialEq)]
pub struct Fix {
    pub kind: FixKind,
    /// The one that a user most likely wants.
    pub preferred: bool,
    /// False where "fix all" leaves it out.
    pub in_fix_all: bool,
    pub edit: DrawingEdit,
}

/// What a fix does, as data for its title. Lengths in drawing units.
#[derive(Clone, Debug, PartialEq)]
pub enum FixKind {
    /// One arc of `radius` replaces `arcs` arcs; the contour moves by at most `moved`.
    Refillet { radius: f64, arcs: usize, moved: f64 },
    /// The end points stay, only the bulge changes; the contour kinks by `kink` radians at each end.
    KeepEndPoints { radius: f64, kink: f64 },
}
