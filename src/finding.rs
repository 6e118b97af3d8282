//! What a rule or a reader has found, as data: the rule, the place, the numbers.
//!
//! [`sentence`] makes of it what a person reads, the server its form in the protocol.

mod fault;
mod not_judged;
mod sentence;
mod unwritable;

pub use fault::{Axis, Fault};
pub use not_judged::NotJudged;
pub use sentence::{related, sentence, title};
pub use unwritable::Unwritable;

pub use crate::geometry::Side;
pub use crate::rule::{Rule, Severity};

use crate::drawing::{Change, ContourSegment, DrawingEdit, EntityId, Visibility};
use crate::geometry::{Arc, Point};
use crate::text::TextEdit;
use rustc_hash::FxHashSet;
use std::f64::consts::PI;
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
    fn is_of(&self, entities: &FxHashSet<EntityId>) -> bool {
        matches!(self, Place::Segment { entity, .. } | Place::Entity { entity } if entities.contains(entity))
    }
}

impl Finding {
    /// True for what is said of one of the `entities`, of all where there are none named, and of the document as a whole or its text.
    pub fn concerns(&self, entities: Option<&FxHashSet<EntityId>>) -> bool {
        let of_entities = |entities| {
            self.place.is_of(entities) || self.related.iter().any(|place| place.is_of(entities))
        };
        matches!(self.place, Place::Text { .. } | Place::Document)
            || entities.is_none_or(of_entities)
    }
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
    /// The arc that fits would leave a segment too short to cut.
    ShortSegment,
    /// The arc that fits would bring another fault: it crosses another outline, or puts another arc at fault.
    Spoils,
    /// It stands in a program: the drawing that it was made of has to change.
    Program,
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

impl SmallRadius {
    /// The numbers of an arc whose radius counts as `radius`; of a length in them there are `unit` in one of theirs.
    pub(crate) fn of(arc: &Arc, radius: f64, required: f64, unit: f64) -> SmallRadius {
        let (short, turn) = ((required - radius).max(0.0) / unit, arc.sweep.abs().min(PI));
        let stock_left = if turn < PI {
            short * (1.0 / (turn / 2.0).cos() - 1.0)
        } else {
            f64::INFINITY
        };
        SmallRadius {
            radius: radius / unit,
            required: required / unit,
            center: arc.center / unit,
            start: arc.start / unit,
            end: arc.end / unit,
            sweep: arc.sweep,
            side: if arc.sweep > 0.0 {
                Side::Left
            } else {
                Side::Right
            },
            overcut: short * (1.0 - turn.cos()),
            stock_left,
            pass: None,
            no_fix: None,
        }
    }
}

/// The numbers of a finding. One variant for each kind of sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum Detail {
    SmallRadius(Box<SmallRadius>),
    /// A corner concave to the wire turns by `turn` (radians): it is left with `radius`, and `uncut` of it stands.
    /// Where the wire side is not known, one finding stands for the `count` corners of its contour, and `uncut` holds for
    /// those that the wire runs inside of; else `count` is `None`.
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
    /// The wire comes no further between two walls: what lies beyond stays uncut, `near` the farthest by so much.
    DeadEnd {
        near: Point,
        uncut: f64,
    },
    /// Nothing is left of the outline at this correction.
    OffsetCollapse {
        required: f64,
        /// A point is left: the wire can stand there, and cuts nothing more.
        point: bool,
    },
    /// The path that the wire would run does not hold its proof, near a point.
    UnprovedPath {
        near: Point,
    },
    /// There is a path, but not in the language that it is to be written in.
    Unwritable(Unwritable),
    /// The ends of a contour are `distance` apart.
    OpenContour {
        distance: f64,
    },
    /// Two ends that belong together are `distance` apart.
    Gap {
        distance: f64,
    },
    DuplicateEntity,
    /// Two segments run on one another over `length`.
    Overlap {
        length: f64,
    },
    NotJudged(NotJudged),
    ShortSegment {
        length: f64,
    },
    /// Two segments meet at `turn` radians: nearly tangent, not quite.
    NearTangent {
        turn: f64,
    },
    /// Segments cross, or only touch, at a point.
    SelfIntersection {
        at: Point,
        touches: bool,
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
    LeadIn(String),
    /// A program holds one of `passes`, that of `correction` mm.
    OnePass {
        passes: usize,
        correction: f64,
    },
    /// `kind` of entity, and how many of it; the place is the first.
    UnsupportedEntity {
        kind: String,
        count: usize,
        why: &'static str,
    },
    /// `count` entities are drawn on a layer that is not simply shown, or are invisible by themselves.
    Unseen {
        layer: std::sync::Arc<str>,
        visibility: Visibility,
        count: usize,
    },
    Units(String),
    /// The larger side of the largest contour, which speaks for another unit.
    Size {
        size: f64,
    },
    /// What was found and what was expected, lower-case, no final dot.
    Syntax(String),
    Settings(String),
    More {
        count: usize,
    },
}

/// How the centre was found to which an arc's ends fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CenterFix {
    /// I and J as other controls take them.
    OtherConvention,
    /// A sign was lost.
    Sign,
    /// I stands for J and J for I.
    Swap,
    /// The nearest one that fits, `moved` mm from the one that stands.
    Nearest { moved: f64 },
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
        Finding {
            rule: fault.rule(),
            severity: fault.severity(),
            place: Place::Text { range },
            detail: Detail::Program(Box::new(fault)),
            related: Vec::new(),
        }
    }
}

/// A repair that a user may choose. Rules on drawings make edits of the drawing, rules on programs edits of the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Fix<E = DrawingEdit> {
    pub kind: FixKind,
    /// The one that a user most likely wants.
    pub preferred: bool,
    /// False where "fix all" leaves it out.
    pub in_fix_all: bool,
    pub edit: E,
}

/// What a fix changes: a drawing, which each kind of document turns into its own edit, or the text itself.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    Drawing(DrawingEdit),
    /// Sorted and disjoint.
    Text(Vec<TextEdit>),
}

impl Fix {
    /// The repair that a user most likely wants, and that "fix all" makes.
    pub(crate) fn new(kind: FixKind, changes: Vec<Change>) -> Fix {
        Fix {
            kind,
            preferred: true,
            in_fix_all: true,
            edit: DrawingEdit { changes },
        }
    }
}

impl<E> Fix<E> {
    /// The same repair with its edit in another form.
    pub fn map<F>(self, form: impl FnOnce(E) -> F) -> Fix<F> {
        Fix {
            kind: self.kind,
            preferred: self.preferred,
            in_fix_all: self.in_fix_all,
            edit: form(self.edit),
        }
    }
}

/// What a fix does, as data for its title. Lengths in drawing units.
#[derive(Clone, Debug, PartialEq)]
pub enum FixKind {
    /// One arc of `radius` replaces `arcs` arcs; the contour moves by at most `moved`.
    Refillet {
        radius: f64,
        arcs: usize,
        moved: f64,
    },
    /// The end points stay, only the bulge changes; the contour kinks by `kink` radians at each end.
    KeepEndPoints {
        radius: f64,
        kink: f64,
    },
    /// A sharp corner gets a fillet of `radius`.
    Fillet {
        radius: f64,
    },
    /// The ends of an open contour are joined by a line of `length`, or become one where it is 0.
    Close {
        length: f64,
    },
    /// Two ends are moved onto each other.
    Snap {
        distance: f64,
    },
    /// One of two entities in the same place goes.
    DeleteDouble,
    /// A segment too short to cut goes, its neighbours meet.
    Merge,
    /// An entity without length goes.
    DeletePoint,
    /// An arc is changed so that it leaves its neighbour without a kink.
    MakeTangent {
        moved: f64,
    },
    /// One arc takes the place of `chords` lines.
    OneArc {
        chords: usize,
        radius: f64,
    },
    /// A program gets the word that ends it.
    AddEnd {
        word: String,
    },
    /// Letters and digits that only look like those of a program become plain ones.
    PlainLetters,
    /// Decimal commas become points.
    DecimalPoints,
    /// What stands behind the end of a program goes.
    DeleteBehindEnd,
    /// J of a block becomes `j`, µm.
    SetJ {
        j: i64,
    },
    /// X or Y of a block becomes `value`, µm.
    SetEnd {
        axis: Axis,
        value: i64,
    },
    /// G of a block becomes the other axis; J with it where it is there, µm.
    SetAxis {
        axis: Axis,
        j: Option<i64>,
    },
    /// Z of a block becomes `name`.
    SetMotion {
        name: &'static str,
    },
    /// The coordinates behind a block become those where it ends, mm.
    SetCoordinates {
        at: [f64; 2],
    },
    /// A block becomes one that ends at the coordinates behind it.
    FollowCoordinates,
    /// X and Y of a block change places.
    ExchangeXAndY,
    /// A block that cannot be read becomes `block`.
    RestoreBlock {
        block: String,
    },
    /// One of two equal blocks goes.
    DeleteTwin,
    /// Two blocks in a row change places.
    ExchangeBlocks,
    /// A block that is lost is put back: its ends are `length` mm apart.
    InsertBlock {
        length: f64,
        is_arc: bool,
    },
    /// The `B` that is lost is put back.
    InsertB,
    /// `B25` becomes `N25`.
    NumberWithN,
    /// The letter O becomes a zero.
    ZeroForO,
    DeleteBlock,
    /// A block becomes several that fit.
    SplitBlock {
        pieces: usize,
    },
    /// A block gets the number of its turn.
    SetNumber {
        number: u32,
    },
    /// All blocks are numbered anew.
    Renumber {
        first: u32,
        step: u32,
    },
    /// A rapid becomes a cut.
    CutRapid,
    /// I and J of an ISO arc lead to a centre `radius` mm from both its ends.
    SetCenter {
        radius: f64,
        how: CenterFix,
    },
    /// G41 becomes G42 or the other way round.
    SwapSide,
    /// Words of a block as they are meant; `meant` is empty where they go, `found` where they come.
    Rewrite {
        found: String,
        meant: String,
    },
    InsertLine {
        block: String,
    },
}
