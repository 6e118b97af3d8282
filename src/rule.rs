//! Every rule of every document, listed once: its name, its default severity, the kinds of documents it applies to, and
//! its summary. The page of a rule is `docs/rules/<name>.md`, in Chinese below `docs/zh`. The check of a rule lives in
//! the room that has the data for it.

mod page;

pub(crate) use page::Line;

use crate::message::Language;

/// How bad a finding is, from worst to mildest.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    serde::Serialize,
    serde::Deserialize,
    schemars::JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    Error,
    Warning,
    Information,
    Hint,
}

/// A kind of document that has findings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    Drawing,
    ThreeB,
    FourB,
    Iso,
    Settings,
}

/// Makes the rules from rows: variant, name, severity, summary (a row of `message/en/`), kinds of
/// documents.
macro_rules! rules {
    ($($rule:ident $name:literal $severity:ident $summary:ident $($subject:ident)+;)+) => {
        /// The rules under the names that users see, in the order of the documentation.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Rule {
            $(#[doc = $name] $rule,)+
        }

        impl Rule {
            pub const ALL: [Rule; [$(Rule::$rule),+].len()] = [$(Rule::$rule),+];

            fn row(self) -> &'static Row {
                match self {
                    $(Rule::$rule => &Row {
                        name: $name,
                        severity: Severity::$severity,
                        subjects: &[$(Subject::$subject),+],
                    },)+
                }
            }

            /// The source of its documentation page.
            fn written(self, language: Language) -> &'static str {
                match (language, self) {
                    $((Language::English, Rule::$rule) => include_str!(concat!("../docs/rules/", $name, ".md")),)+
                    $((Language::Chinese, Rule::$rule) => include_str!(concat!("../docs/zh/rules/", $name, ".md")),)+
                }
            }

            /// Its summary, for lists of rules.
            pub fn summary(self) -> &'static str {
                match self {
                    $(Rule::$rule => say!($summary),)+
                }
            }
        }
    };
}

struct Row {
    name: &'static str,
    severity: Severity,
    subjects: &'static [Subject],
}

rules! {
    SmallRadius "small-radius" Error an_arc_is_tighter_than_the_correction_the_wire_cannot_follow_it Drawing ThreeB FourB Iso;
    SharpCorner "sharp-corner" Warning a_corner_that_the_wire_leaves_rounded Drawing;
    NarrowSlot "narrow-slot" Error a_slot_narrower_than_the_wire_s_way_through_it Drawing ThreeB FourB Iso;
    LostPocket "lost-pocket" Error the_offset_loses_a_part_of_the_outline Drawing ThreeB FourB Iso;
    OffsetCollapse "offset-collapse" Error nothing_is_left_of_the_outline_at_this_correction Drawing ThreeB FourB Iso;
    OpenContour "open-contour" Error a_contour_that_does_not_close Drawing;
    Gap "gap" Warning two_ends_that_belong_together_do_not_meet Drawing;
    DuplicateEntity "duplicate-entity" Warning two_entities_lie_in_the_same_place Drawing;
    Overlap "overlap" Warning two_segments_run_on_one_another Drawing;
    ShortSegment "short-segment" Warning a_segment_too_short_to_cut Drawing;
    NearTangent "near-tangent" Hint two_segments_are_nearly_tangent_but_not_quite Drawing;
    SelfIntersection "self-intersection" Error a_contour_touches_or_crosses_itself_or_another Drawing;
    ArcAsChords "arc-as-chords" Hint an_arc_drawn_as_short_lines Drawing;
    UnprovedPath "unproved-path" Error no_path_of_the_wire_holds_its_proof_here Drawing;
    DoesNotFit "does-not-fit" Error a_punch_does_not_go_into_its_plate Drawing;
    LeadIn "lead-in" Error the_lead_in_is_too_short_or_crosses_a_contour Drawing;
    StartHole "start-hole" Error a_start_hole_has_no_room_beside_the_contours Drawing;
    PassOrder "pass-order" Error the_corrections_of_the_passes_do_not_fall_or_no_wire_is_so_thin Iso Settings;
    UnsupportedEntity "unsupported-entity" Information something_in_the_drawing_is_not_cut Drawing;
    Units "units" Warning the_unit_is_missing_or_absurd Drawing ThreeB FourB Iso;
    ArcOffRadius "arc-off-radius" Error the_ends_of_an_arc_are_not_on_one_circle_about_its_centre FourB Iso;
    ArcWithoutRadius "arc-without-radius" Error an_arc_whose_centre_is_its_start ThreeB FourB Iso;
    CompensationSwitch "compensation-switch" Error the_correction_is_switched_by_an_arc_or_a_rapid Iso;
    WrongSide "wrong-side" Error the_correction_sends_the_wire_to_the_side_of_the_part Iso;
    CenterOnLine "center-on-line" Error i_or_j_beside_a_straight_cut Iso;
    WordTwice "word-twice" Error a_word_stands_twice_in_a_line Iso;
    ReversedArc "reversed-arc" Error an_arc_that_runs_the_wrong_way_round ThreeB FourB Iso;
    Spur "spur" Warning a_cut_that_goes_out_and_back_on_the_same_way ThreeB FourB Iso;
    DoubledBlock "doubled-block" Warning a_block_that_stands_twice ThreeB FourB Iso;
    MissingOffset "missing-offset" Warning g41_or_g42_without_the_place_of_its_correction Iso;
    SideChange "side-change" Error the_correction_changes_its_side_within_a_cut Iso;
    MissingCancel "missing-cancel" Warning the_correction_is_still_on_at_the_end Iso;
    MissingReturn "missing-return" Error a_subprogram_without_its_return Iso;
    Taper "taper" Error an_arc_has_no_room_for_a_wire_that_leans Iso;
    CornerWord "corner-word" Error the_word_for_a_corner_finds_none Iso;
    MixedNumbers "mixed-numbers" Warning numbers_with_and_without_a_decimal_point Iso;
    SuspectBlock "suspect-block" Warning a_block_that_may_be_wrong ThreeB FourB Iso;
    AmbiguousCenter "ambiguous-center" Information the_arcs_do_not_tell_how_their_centres_are_meant Iso;
    MachineDependent "machine-dependent" Information a_word_that_machines_take_in_different_ways Iso;
    MissingB "missing-b" Error a_block_that_has_lost_a_b ThreeB FourB;
    BlockNumberAsB "block-number-as-b" Error a_block_number_that_is_written_with_b ThreeB FourB;
    LengthInJ "length-in-j" Error j_holds_the_length_of_a_line_not_its_projection ThreeB FourB;
    WrongJ "wrong-j" Error j_is_not_what_the_block_counts ThreeB FourB;
    JOverTurn "j-over-turn" Error j_of_an_arc_counts_more_than_one_turn ThreeB FourB;
    WrongCountingAxis "wrong-counting-axis" Error g_counts_the_wrong_axis ThreeB FourB;
    WrongQuadrant "wrong-quadrant" Error z_names_the_wrong_quadrant ThreeB FourB;
    ZeroBlock "zero-block" Error a_block_that_moves_nothing ThreeB FourB;
    TooManyDigits "too-many-digits" Error a_number_with_more_digits_than_the_controller_has ThreeB FourB Iso;
    PositionMismatch "position-mismatch" Warning coordinates_that_are_not_where_the_block_ends ThreeB FourB;
    PathCrossesItself "path-crosses-itself" Warning a_path_that_goes_through_itself ThreeB FourB Iso;
    NotClosed "not-closed" Warning a_cut_that_does_not_close ThreeB FourB Iso;
    MissingEnd "missing-end" Warning a_program_without_its_end ThreeB FourB Iso;
    TextAfterEnd "text-after-end" Warning text_behind_the_end_of_a_program ThreeB FourB Iso;
    BlockNumber "block-number" Warning a_block_number_that_stands_twice_is_out_of_turn_or_missing ThreeB FourB Iso;
    NotTheDrawing "not-the-drawing" Error a_program_and_its_drawing_are_not_alike Drawing ThreeB FourB Iso;
    Syntax "syntax" Error the_file_is_damaged Drawing ThreeB FourB Iso;
    Settings "settings" Error a_setting_does_not_fit Settings;
    NotJudged "not-judged" Warning a_part_that_was_left_out_since_it_would_have_taken_too_much Drawing ThreeB FourB Iso;
    More "more" Information stands_for_further_findings Drawing ThreeB FourB Iso;
}

impl Rule {
    pub fn name(self) -> &'static str {
        self.row().name
    }

    pub fn default_severity(self) -> Severity {
        self.row().severity
    }

    /// The kinds of documents that it applies to.
    pub fn subjects(self) -> &'static [Subject] {
        self.row().subjects
    }
}
