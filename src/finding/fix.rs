//! A repair as data: what it does, and its edit.

use super::{Aside, Axis, Rule, SetAside};
use crate::drawing::{Change, DrawingEdit, Role};
use crate::text::TextEdit;
use std::sync::Arc;

/// How the centre that fits an arc's ends was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CenterFix {
    /// I and J as other controls take them.
    OtherConvention,
    /// A sign was lost.
    Sign,
    /// I stands for J and J for I.
    Swap,
    /// The nearest one that fits, `moved` mm from the programmed one.
    Nearest { moved: f64 },
}

/// A repair that a user may choose. Rules on drawings edit the drawing, rules on programs edit the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Fix<E = DrawingEdit> {
    pub kind: FixKind,
    /// The most likely choice of the user.
    pub preferred: bool,
    /// False where "fix all" leaves it out.
    pub in_fix_all: bool,
    pub edit: E,
}

/// The change of a fix: to a drawing, which each kind of document turns into its own edit, or to the text itself.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    Drawing(DrawingEdit),
    /// Sorted and disjoint.
    Text(Vec<TextEdit>),
    /// Lines of the `wedm.toml` that applies to the document.
    Settings(Vec<Keep>),
}

/// A key of a table of the settings, and its new value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keep {
    /// A dotted key, each part of it written as in TOML.
    pub table: String,
    pub key: String,
    pub value: String,
}

impl Keep {
    pub(crate) fn new(table: &str, key: &str, value: &str) -> Keep {
        Keep {
            table: table.into(),
            key: key.into(),
            value: value.into(),
        }
    }
}

/// A repair of a program.
pub(crate) type TextFix = Fix<Vec<TextEdit>>;

impl TextFix {
    /// The most likely choice of the user.
    pub(crate) fn text(kind: FixKind, in_fix_all: bool, edit: impl Into<Vec<TextEdit>>) -> TextFix {
        Fix {
            kind,
            preferred: true,
            in_fix_all,
            edit: edit.into(),
        }
    }

    pub(crate) fn preferred_if(self, preferred: bool) -> TextFix {
        Fix { preferred, ..self }
    }
}

impl Fix {
    /// The most likely choice of the user, which "fix all" makes.
    pub(crate) fn new(kind: FixKind, changes: Vec<Change>) -> Fix {
        Fix {
            kind,
            preferred: true,
            in_fix_all: true,
            edit: DrawingEdit { changes },
        }
    }
}

impl Fix<Vec<Keep>> {
    /// A repair in the settings: only made by choice.
    pub(crate) fn keeping(kind: FixKind, edit: Vec<Keep>) -> Fix<Vec<Keep>> {
        Fix {
            kind,
            preferred: false,
            in_fix_all: false,
            edit,
        }
    }
}

impl<E> Fix<E> {
    /// The same repair with its edit in another form.
    pub(crate) fn map<F>(self, form: impl FnOnce(E) -> F) -> Fix<F> {
        Fix {
            kind: self.kind,
            preferred: self.preferred,
            in_fix_all: self.in_fix_all,
            edit: form(self.edit),
        }
    }
}

impl SetAside {
    /// The repairs that the settings can hold: cut it all the same, as `role`; or ignore its layer.
    pub(crate) fn keeps(&self, role: Role) -> Vec<Fix<Vec<Keep>>> {
        let role = role.name();
        let what = FixKind::CutAllTheSame {
            why: self.why.clone(),
        };
        let keeps = match &self.why {
            Aside::Linetype(name) => vec![(what, vec![Keep::new("linetypes", name, role)])],
            Aside::Layer(name) => {
                vec![ignored(name), (what, vec![Keep::new("layers", name, role)])]
            }
            Aside::Lone => {
                let ignore = self.spare_layers.iter().map(ignored);
                let cut = (self.handles.len() == self.count).then(|| {
                    let keep = |handle: &Arc<str>| Keep::new("contours", handle, role);
                    (what, self.handles.iter().map(keep).collect())
                });
                ignore.chain(cut).collect()
            }
        };
        keeps
            .into_iter()
            .map(|(kind, keeps)| Fix::keeping(kind, keeps))
            .collect()
    }
}

/// The repair that leaves a layer out.
pub(crate) fn ignored(layer: &Arc<str>) -> (FixKind, Vec<Keep>) {
    let layer = layer.clone();
    let keep = Keep::new("layers", &layer, "ignore");
    (FixKind::IgnoreLayer { layer }, vec![keep])
}

/// The effect of a fix, as data for its title. Lengths in drawing units.
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
    /// The corner of a part gets the least `radius` that fits, that of its partner the `other`, where it is drawn.
    FitCorner {
        radius: f64,
        other: Option<f64>,
    },
    /// A line of `length` joins the ends of an open contour; with length 0 they become one point.
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
    /// One arc replaces `chords` lines.
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
    /// Everything behind the end of a program goes.
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
    /// G of a block becomes the other axis; J with it where it is given, µm.
    SetAxis {
        axis: Axis,
        j: Option<i64>,
    },
    /// Z of a block becomes `name`.
    SetMotion {
        name: &'static str,
    },
    /// The coordinates behind a block become its end, mm.
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
    /// A lost block is put back: its ends are `length` mm apart.
    InsertBlock {
        length: f64,
        is_arc: bool,
    },
    /// The lost `B` is put back.
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
    /// All blocks are renumbered.
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
    /// Words of a block become `meant`; `meant` is empty for a removal, `found` for an insertion.
    Rewrite {
        found: String,
        meant: String,
    },
    InsertLine {
        block: String,
    },
    /// Entities drawn to be read are cut.
    CutAllTheSame {
        why: Aside,
    },
    /// A finding is suppressed, for a reason that the user writes.
    Suppress {
        rule: Rule,
    },
    /// A layer is not cut.
    IgnoreLayer {
        layer: Arc<str>,
    },
}
