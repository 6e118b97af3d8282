//! The words that a key may be, where they are a closed set.

use super::table;
use crate::drawing::Role;
use crate::finding::Severity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Declares closed sets of words, which are written in kebab-case; of two levels the later one wins.
macro_rules! choices {
    ($($(#[$attribute:meta])* $name:ident $words:tt)*) => {$(
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "kebab-case")]
        pub enum $name $words

        plain!($name);
    )*};
}

choices! {
    /// Side of the contour on which the wire runs, where neither the entity nor its layer says.
    #[derive(Default)]
    SideSetting {
        /// The contour is cut once from inside and once from outside.
        #[default]
        Both,
        /// By nesting: the outermost contour is a punch, contours in it are openings, and so on.
        Auto,
        /// The wire runs inside.
        Opening,
        /// The wire runs outside.
        Punch,
        /// Of open contours: the wire runs to the left of their direction. Closed ones count as `both`.
        Left,
        /// The same to the right.
        Right,
    }

    #[derive(Default)]
    UnitSetting {
        /// Millimetres.
        #[default]
        Mm,
        /// Inches.
        Inch,
    }

    /// What a program is written in.
    ProgramFormat {
        /// 3B programs.
        #[serde(rename = "3b")]
        ThreeB,
        /// 4B: the part's contour, which the control offsets.
        #[serde(rename = "4b")]
        FourB,
        /// ISO, by a profile.
        Iso,
        /// ISO for an electrode that mills.
        Milling,
    }

    #[derive(Default)]
    Layout {
        /// No spaces: `B9900B0B9900GXL1`.
        #[default]
        Compact,
        /// Fixed columns with spaces.
        Aligned,
        /// Aligned, with block number and the absolute end point in mm after the block.
        Checking,
    }

    /// Direction in which a closed contour is cut.
    #[derive(Default)]
    Direction {
        /// Counter-clockwise.
        #[default]
        Ccw,
        /// Clockwise.
        Cw,
        /// As the contour is drawn.
        AsDrawn,
    }

    /// Which contour is cut after which. What lies within a contour always comes before it: the part drops when the contour round it is cut.
    #[derive(Default)]
    Order {
        /// As they are drawn or selected; what lies within one directly before it.
        AsDrawn,
        /// As they are drawn or selected; where that is not possible, one outermost contour after the other, the innermost in it first.
        #[default]
        InsideFirst,
        /// From each to the one with the nearest thread hole.
        Nearest,
        /// In the order of the handles, which also say where in its contour the cut begins, and in which direction it goes where `direction` is not set.
        AsPicked,
    }

    /// How the wire path rounds a convex corner of the part.
    #[derive(Default)]
    Corner {
        /// An arc about the vertex.
        #[default]
        Arc,
        /// The two offset lines are extended until they meet.
        Intersection,
    }

    /// How the wire comes from the thread hole to its path and goes back.
    #[derive(Default)]
    Lead {
        /// Straight from the thread hole to the entry.
        Straight,
        /// At right angles to the contour: a thread hole that is found lies there; where `thread` and `entry` do not lie opposite to each
        /// other the lead has a corner, where there is room for one.
        #[default]
        Perpendicular,
        /// Along an arc that is tangent to the path, on the wire's side, after a straight piece that is tangent to the arc. Its radius is
        /// a third of the lead, halved until it fits, and not below the correction.
        Arc,
    }

    /// What comes between the contours of one program.
    #[derive(Default)]
    Jumps {
        /// The pause word, the jump to the next thread hole as blocks, and the pause word again.
        #[default]
        Blocks,
        /// The pause word alone.
        None,
    }

    /// Direction of the passes of a contour.
    #[derive(Default)]
    Sequence {
        /// To and fro: each pass goes back along the one before it.
        #[default]
        Alternate,
        /// All in the same direction.
        OneWay,
    }

    /// How the passes after the first go through a corner that the wire runs inside of.
    #[derive(Default)]
    SkimCorner {
        /// Each pass turns in a point: as sharp as the wire leaves it, with more stock in the corner than along the walls.
        #[default]
        Sharp,
        /// Each pass runs at one distance beside the first: as much stock in the corner as along the walls, which is left rounder.
        ConstantStock,
    }

    /// Which part of a pair is drawn.
    DrawnAs {
        /// What is drawn is the punch.
        Punch,
        /// What is drawn is the opening of the plate.
        Plate,
    }

    /// How the feed of a milling electrode makes up for its wear.
    #[derive(Default)]
    WearCompensation {
        /// Not at all: each layer is fed its height.
        None,
        /// Each layer is fed its height and the wear of the whole layer, and the next one goes back along it, so that the floor wears even.
        #[default]
        Uniform,
        /// Each layer is fed its height, and on its way, step by step, what has been worn.
        Linear,
    }

    /// Where the correction is applied.
    #[derive(Default)]
    Compensation {
        /// The offset is in the coordinates.
        #[default]
        Path,
        /// The controller offsets: G41 and G42, or 4B; refused for 3B.
        Controller,
        /// The contour is the wire's path.
        None,
    }

    /// Severity of a rule, or off.
    RuleSeverity {
        Error,
        Warning,
        Information,
        Hint,
        Off,
    }

    /// How I and J lead to an arc's centre.
    #[derive(Default)]
    CenterRule {
        /// From the start to the centre.
        #[default]
        StartToCenter,
        /// From the centre to the start.
        CenterToStart,
        /// The centre itself in the coordinates of the program.
        Absolute,
    }

    /// G90 or G91.
    #[derive(Default)]
    Coordinates {
        /// G90.
        #[default]
        Absolute,
        /// G91.
        Incremental,
    }

    /// Where absolute coordinates count from.
    #[derive(Default)]
    Zero {
        /// The zero of the drawing.
        #[default]
        Drawing,
        /// Where the wire is threaded first.
        Start,
    }

    /// Millimetres with a decimal point, or whole micrometres without one.
    #[derive(Default)]
    NumberUnit {
        /// Millimetres.
        #[default]
        Mm,
        /// Micrometres.
        Um,
    }

    #[derive(Default)]
    LineEnd {
        #[default]
        Lf,
        Crlf,
    }
}

impl SideSetting {
    /// The role of every contour that states none; nothing where it depends on nesting.
    pub(crate) fn role(self) -> Option<Role> {
        match self {
            SideSetting::Auto => None,
            SideSetting::Both => Some(Role::Both),
            SideSetting::Opening => Some(Role::Opening),
            SideSetting::Punch => Some(Role::Punch),
            SideSetting::Left => Some(Role::Left),
            SideSetting::Right => Some(Role::Right),
        }
    }
}

impl RuleSeverity {
    pub(crate) fn severity(self) -> Option<Severity> {
        match self {
            RuleSeverity::Error => Some(Severity::Error),
            RuleSeverity::Warning => Some(Severity::Warning),
            RuleSeverity::Information => Some(Severity::Information),
            RuleSeverity::Hint => Some(Severity::Hint),
            RuleSeverity::Off => None,
        }
    }
}
