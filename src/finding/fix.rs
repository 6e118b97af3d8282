//! A repair as data: what it does, its title, and its edit.

use super::lengths::mm;
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

told! {
    /// The effect of a fix, as data for its title. Lengths in drawing units.
    enum FixKind;
    /// The title of a fix, for its code action.
    fn title(unit_mm: f64);

    /// One arc of `radius` replaces `arcs` arcs; the contour moves by at most `moved`.
    Refillet { radius: f64, arcs: usize, moved: f64 } => {
        let what = match arcs {
            1 => say!(arc).to_owned(),
            arcs => say!(arcs, arcs),
        };
        say!(replace_arcs_by_one_of_r, what, mm(radius * unit_mm), mm(moved * unit_mm))
    };
    /// The end points stay, only the bulge changes; the contour kinks by `kink` radians at each end.
    KeepEndPoints { radius: f64, kink: f64 }
        => say!(change_only_the_bulge, mm(radius * unit_mm), kink.to_degrees());
    /// A sharp corner gets a fillet of `radius`; the contour moves by at most `moved`.
    Fillet { radius: f64, moved: f64 }
        => say!(round_the_corner_with_r_mm, mm(radius * unit_mm), mm(moved * unit_mm));
    /// The corner of a part gets the least `radius` that fits, that of its partner the `other`, where it is drawn.
    FitCorner { radius: f64, other: Option<f64> } => match (mm(radius * unit_mm), other) {
        (radius, None) => say!(give_the_corner_the_least_radius_that_fits, radius),
        (radius, Some(other)) => say!(give_both_corners_radii_that_fit, radius, mm(other * unit_mm)),
    };
    /// The corner of one part `of` two that are drawn gets the least `radius` that fits.
    FitCornerOf { of: Arc<str>, radius: f64 }
        => say!(give_the_corner_of_a_part_the_least_radius, of, mm(radius * unit_mm));
    /// A line of `length` joins the ends of an open contour; with length 0 they become one point.
    Close { length: f64 } => match *length == 0.0 {
        true => say!(close_the_contour).to_owned(),
        false => say!(close_the_contour_with_a_line_of_mm, mm(length * unit_mm)),
    };
    /// Two ends are moved onto each other.
    Snap { distance: f64 } => say!(snap_the_ends_together, mm(distance * unit_mm));
    /// One of two entities in the same place goes.
    DeleteDouble => say!(delete_the_double);
    /// A segment too short to cut goes, its neighbours meet.
    Merge => say!(remove_the_short_segment_its_neighbours_meet);
    /// An arc is changed so that it leaves its neighbour without a kink.
    MakeTangent { moved: f64 } => say!(make_the_segments_tangent, mm(moved * unit_mm));
    /// One arc replaces `chords` lines.
    OneArc { chords: usize, radius: f64 }
        => say!(replace_the_chords_by_one_arc_of_r_mm, chords, mm(radius * unit_mm));
    /// A program gets the word that ends it.
    AddEnd { word: String } => say!(end_the_program_with, word);
    /// Letters and digits that only look like those of a program become plain ones.
    PlainLetters => say!(write_plain_letters_and_digits);
    /// Decimal commas become points.
    DecimalPoints => say!(write_decimal_points);
    /// Everything after the end of a program goes.
    DeleteBehindEnd => say!(delete_what_stands_behind_the_end);
    /// J of a block becomes `j`, µm.
    SetJ { j: i64 } => say!(set_j_to, j);
    /// X or Y of a block becomes `value`, µm.
    SetEnd { axis: Axis, value: i64 } => say!(set_to, axis.letter(), value);
    /// G of a block becomes the other axis; J with it where it is given, µm.
    SetAxis { axis: Axis, j: Option<i64> } => match j {
        None => say!(count_g, axis.letter()),
        Some(j) => say!(count_g_j, axis.letter(), j),
    };
    /// Z of a block becomes `name`.
    SetMotion { name: &'static str } => say!(set_z_to, name);
    /// The coordinates after a block become its end, mm.
    SetCoordinates { at: [f64; 2] } => say!(set_the_coordinates_to_where_the_block, at[0], at[1]);
    /// A block becomes one that ends at the coordinates after it.
    FollowCoordinates => say!(change_the_block_to_end_at_its_coordinates);
    /// X and Y of a block change places.
    ExchangeXAndY => say!(exchange_x_and_y);
    /// A block that cannot be read becomes `block`.
    RestoreBlock { block: String }
        => say!(write_the_block_as, block.split_whitespace().collect::<String>());
    /// One of two equal blocks goes.
    DeleteTwin => say!(delete_the_block_which_stands_twice);
    /// Two blocks in a row change places.
    ExchangeBlocks => say!(exchange_the_two_blocks);
    /// A lost block is put back: its ends are `length` mm apart.
    InsertBlock { length: f64, is_arc: bool } => {
        let what = if *is_arc { say!(arc) } else { say!(line) };
        say!(put_the_lost_block_in, what, mm(*length))
    };
    /// The lost `B` is put back.
    InsertB => say!(put_the_lost_b_back);
    /// `B25` becomes `N25`.
    NumberWithN => say!(write_the_block_number_with_n);
    /// The letter O becomes a zero.
    ZeroForO => say!(write_a_zero_for_the_letter_o);
    DeleteBlock => say!(delete_the_block);
    /// A block becomes several that fit.
    SplitBlock { pieces: usize } => say!(split_the_block_into_that_fit, pieces);
    /// A block gets the number of its turn.
    SetNumber { number: u32 } => say!(number_the_block_n, number);
    /// All blocks are renumbered.
    Renumber { first: u32, step: u32 } => match step {
        1 => say!(number_all_blocks_from_n_on, first),
        step => say!(number_all_blocks_from_n_on_in_steps, first, step),
    };
    /// A rapid becomes a cut.
    CutRapid => say!(cut_there_g01_instead_of_the_rapid);
    /// I and J of an ISO arc lead to a centre `radius` mm from both its ends.
    SetCenter { radius: f64, how: CenterFix } => match (how, mm(*radius)) {
        (CenterFix::OtherConvention, radius) => say!(take_i_and_j_as_other_controls_do, radius),
        (CenterFix::Sign, radius) => say!(put_the_sign_of_i_and_j_right, radius),
        (CenterFix::Swap, radius) => say!(swap_i_and_j_r, radius),
        (CenterFix::Nearest { moved }, radius) => say!(move_the_centre, mm(*moved), radius),
    };
    /// G41 becomes G42 or the other way round.
    SwapSide => say!(let_the_wire_run_on_the_other_side);
    /// Words of a block become `meant`; `meant` is empty for a removal, `found` for an insertion.
    Rewrite { found: String, meant: String } => match (found.as_str(), meant.as_str()) {
        (found, "") => say!(delete, found),
        ("", meant) => say!(write, meant),
        (found, meant) => say!(write_for, meant, found),
    };
    InsertLine { block: String } => say!(insert_the_block, block);
    /// Entities drawn to be read are cut.
    CutAllTheSame { why: Aside } => match why {
        Aside::Linetype(name) => say!(cut_what_is_drawn_in_a_linetype, name),
        Aside::Layer(name) => say!(cut_what_lies_on_a_layer, name),
        Aside::Lone => say!(cut_the_lone_lines).to_owned(),
    };
    /// A finding is suppressed, for a reason that the user writes.
    Suppress { rule: Rule } => say!(suppress_here_with_a_reason, rule.name());
    /// A layer is not cut.
    IgnoreLayer { layer: Arc<str> } => say!(ignore_the_layer, layer);
}
