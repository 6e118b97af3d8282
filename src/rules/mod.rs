//! The rules of the wire: a folder or file each, with its check and its fix.
//!
//! A rule works on geometry: it takes contours, returns observations at segments, and turns an
//! observation into a finding with fixes, which are edits of the drawing. It knows nothing of text,
//! protocols, or the wording of its messages.

pub(crate) mod arc_as_chords;
pub(crate) mod dead_end;
mod disc;
mod duplicate_entity;
mod ends;
mod gap;
mod narrow_slot;
mod near_tangent;
mod open_contour;
mod overlap;
mod self_intersection;
pub(crate) mod sharp_corner;
mod short_segment;
pub(crate) mod small_radius;
pub(crate) mod units;
mod wall;

pub(crate) use open_contour::ends_apart;
pub(crate) use wall::{Wall, part_for_good};

use crate::drawing::{Contour, ContourIndex, ContourSegment, Drawing, EntityId};
use crate::finding::{Detail, Fix, Place, Rule, Severity, Side};
use crate::geometry::{Point, Segment, Tolerances, turn};
use crate::settings::{Compensation, Effective, SkimCorner};
use std::ops::Range;

/// The limits that rules measure against, in the units of one drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limits {
    /// The largest correction of all passes.
    pub(crate) correction: f64,
    /// The smallest correction of all passes. Earlier passes may leave what the last one takes.
    pub(crate) last_correction: f64,
    /// The radius that the last pass leaves in a sharp corner.
    pub(crate) corner_radius: f64,
    /// An electrode mills along the middle of what is open.
    mills: bool,
    /// Each pass runs its own path beside the contour: the control does not offset the drawn one, and no skim keeps to the path of the first pass.
    skims_follow: bool,
    /// What the passes after the first take of what it leaves in a corner.
    pub(crate) taken_later: f64,
    /// Radius that a fix gives: correction + margin.
    pub(crate) fix_radius: f64,
    /// 1-based number of the pass with the largest correction, where several are set.
    pub(crate) pass: Option<usize>,
    pub(crate) tolerances: Tolerances,
    /// Millimetres in one unit of the drawing.
    pub(crate) unit_mm: f64,
}

impl Limits {
    /// The limits of `settings` in a drawing whose unit is `unit_mm` millimetres.
    pub(crate) fn new(settings: &Effective, unit_mm: f64) -> Limits {
        Limits {
            correction: settings.correction / unit_mm,
            last_correction: settings.last_correction() / unit_mm,
            taken_later: match settings.passes.skim_corner() {
                SkimCorner::Sharp => (settings.correction - settings.last_correction()) / unit_mm,
                SkimCorner::ConstantStock => 0.0,
            },
            corner_radius: settings.corner_radius() / unit_mm,
            mills: settings.mills,
            skims_follow: settings.compensation == Compensation::Path
                && settings.passes.skim_corner() == SkimCorner::Sharp,
            fix_radius: (settings.correction + settings.margin) / unit_mm,
            pass: settings.pass,
            tolerances: settings.tolerances.in_units(unit_mm),
            unit_mm,
        }
    }

    /// What is shorter is no part of a contour: the resolution, but never what a control could stumble over.
    pub(crate) fn least(&self) -> f64 {
        let Tolerances {
            resolution,
            short,
            zero_length,
            ..
        } = self.tolerances;
        resolution.min(short).max(zero_length)
    }

    /// An arc below the correction that a later pass can follow.
    pub(crate) fn is_for_skims(&self, radius: f64) -> bool {
        self.skims_follow
            && self.last_correction < self.correction
            && radius >= self.last_correction - self.tolerances.report
    }
}

/// One contour as a rule sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outlook<'a> {
    pub(crate) drawing: &'a Drawing,
    pub(crate) contour: &'a Contour,
    pub(crate) index: &'a ContourIndex,
    pub(crate) limits: &'a Limits,
    /// The number of its workpiece; contours of other workpieces are not compared with it.
    pub(crate) part: u16,
    /// The wire's centre runs on it, without correction.
    pub(crate) on_line: bool,
    /// Segments that need not be worked out again.
    pub(crate) at_hand: Option<&'a AtHand>,
}

/// A stretch of segments of a contour and the turns between them, worked out once for all rules.
#[derive(Debug)]
pub(crate) struct AtHand {
    first: usize,
    segments: Vec<ContourSegment>,
    /// The contour's turn at the start of each segment but the first.
    turns: Vec<Option<f64>>,
}

impl AtHand {
    pub(crate) fn of(
        drawing: &Drawing,
        contour: &Contour,
        limits: &Limits,
        range: Range<usize>,
    ) -> AtHand {
        let first = range.start;
        let count = range.len();
        let mut segments: Vec<ContourSegment> = Vec::with_capacity(count);
        segments.extend(contour.segments_in(drawing, range));
        // Where an entity is missing, the indices are not those of the contour.
        if segments.len() != count {
            segments.clear();
        }
        let turns = segments
            .windows(2)
            .map(|pair| turn_between(limits, &pair[0].geometry, &pair[1].geometry))
            .collect();
        AtHand {
            first,
            segments,
            turns,
        }
    }

    pub(crate) fn segments(&self) -> &[ContourSegment] {
        &self.segments
    }

    fn segment(&self, index: usize) -> Option<ContourSegment> {
        self.segments.get(index.checked_sub(self.first)?).copied()
    }

    fn turn(&self, index: usize) -> Option<Option<f64>> {
        self.turns.get(index.checked_sub(self.first + 1)?).copied()
    }
}

/// The angle from the end of a segment to the beginning of the next; `None` beside one that is too short.
fn turn_between(limits: &Limits, before: &Segment, behind: &Segment) -> Option<f64> {
    let least = limits.tolerances.short;
    let long_enough = before.length() >= least && behind.length() >= least;
    long_enough.then(|| turn(before.end_tangent(), behind.start_tangent()))
}

impl Outlook<'_> {
    /// An index that wraps round on a closed contour; `None` past the ends of an open one.
    fn wrapped(&self, index: isize) -> Option<usize> {
        let count = self.contour.len() as isize;
        let is_there = count > 0 && (self.contour.closed || (0..count).contains(&index));
        is_there.then(|| index.rem_euclid(count) as usize)
    }

    /// Segment at `index`, which wraps round on a closed contour; `None` past the ends of an open one.
    pub(crate) fn segment(&self, index: isize) -> Option<ContourSegment> {
        let index = self.wrapped(index)?;
        self.at_hand
            .and_then(|at_hand| at_hand.segment(index))
            .or_else(|| self.contour.segment(self.drawing, index))
    }

    /// The entity of the segment at `index`, and which of its segments that is.
    pub(crate) fn segment_id(&self, index: usize) -> Option<(EntityId, usize)> {
        let index = self.wrapped(index as isize)?;
        self.contour.segment_id(self.drawing, index)
    }

    /// True for the middle of a slot that an electrode mills.
    pub(crate) fn is_middle(&self) -> bool {
        self.limits.mills && !self.contour.closed
    }

    /// The place of the segment at `index`.
    pub(crate) fn place(&self, index: usize) -> Option<Place> {
        let (entity, segment) = self.segment_id(index)?;
        Some(Place::Segment { entity, segment })
    }

    /// The angle (radians, positive to the left) by which the contour turns where the segment at `index` begins.
    /// `None` at the start of an open contour, and beside a segment too short to have a direction that counts.
    pub(crate) fn turn_at(&self, index: usize) -> Option<f64> {
        if let Some(turn) = self.at_hand.and_then(|at_hand| at_hand.turn(index)) {
            return turn;
        }
        let before = self.segment(index as isize - 1)?.geometry;
        let behind = self.segment(index as isize)?.geometry;
        turn_between(self.limits, &before, &behind)
    }
}

/// An observation of a rule at one segment of a contour. Small, since a contour may have one at every segment; its
/// numbers are worked out when it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Observation {
    /// Index of the segment within the contour.
    pub(crate) index: u32,
    /// The side of travel that it concerns, `None` where it holds on either side.
    pub(crate) side: Option<Side>,
    /// Silent where the wire side is not known.
    pub(crate) needs_side: bool,
    /// How bad it is among those of its rule: where one finding stands for all of a contour, it is at the worst.
    pub(crate) weight: f32,
}

impl Observation {
    /// An observation at the segment with this index, whichever side the wire runs on.
    pub(crate) fn at(index: usize) -> Observation {
        Observation {
            index: index as u32,
            side: None,
            needs_side: false,
            weight: 0.0,
        }
    }
}

/// The place and the numbers of one finding that stands for this many observations, of which some are given, the worst
/// first.
pub(crate) type Together =
    fn(&Outlook, &[(Observation, Detail)], usize) -> Option<(Observation, Detail)>;

/// A rule on a segment and its near neighbours. `LOCAL_RULES` lists them all.
pub(crate) struct LocalRule {
    pub(crate) rule: Rule,
    /// Checks the segments `range` of a contour and adds its observations. An observation at a segment may depend only
    /// on that segment and those within `reach` of it.
    pub(crate) check: fn(&Outlook, Range<usize>, &mut Vec<Observation>),
    /// How many segments before and after a changed one must be checked again.
    pub(crate) reach: fn(&Outlook, Range<usize>) -> (usize, usize),
    /// Whether the observation at the first segment of a closed contour holds, where that depends
    /// on the whole contour.
    pub(crate) holds: fn(&Outlook, Observation) -> bool,
    /// The other places that are concerned.
    pub(crate) related: fn(&Outlook, Observation) -> Vec<Place>,
    /// The numbers of an observation. A count means that the wire side is not known and one finding stands for that
    /// many observations.
    pub(crate) detail: fn(&Outlook, Observation, Option<usize>) -> Option<Detail>,
    /// Repairs, the preferred one first.
    pub(crate) fixes: fn(&Outlook, Observation) -> Vec<Fix>,
    /// Where the wire side is not known: one hint for each contour instead of a finding for each observation.
    pub(crate) one_hint_when_side_unknown: bool,
    /// How one finding stands for all of a contour; `None` for rules that name each.
    pub(crate) together: Option<Together>,
    /// Where the case is milder than the rule.
    pub(crate) mildest: Option<Severity>,
}

impl LocalRule {
    /// The defaults of a rule on a segment by itself.
    const PLAIN: LocalRule = LocalRule {
        rule: Rule::More,
        check: |_, _, _| {},
        reach: |_, _| (0, 0),
        holds: |_, _| true,
        related: |_, _| Vec::new(),
        detail: |_, _, _| None,
        fixes: |_, _| Vec::new(),
        one_hint_when_side_unknown: false,
        together: None,
        mildest: None,
    };
}

/// The segment before the joint of an observation, where it belongs to another entity.
fn other_at_joint(outlook: &Outlook, observation: Observation) -> Vec<Place> {
    let (before, own) = (
        outlook.segment(observation.index as isize - 1),
        outlook.segment(observation.index as isize),
    );
    let other = before.filter(|before| own.is_some_and(|own| own.entity != before.entity));
    other.iter().map(Place::from).collect()
}

/// Every rule on single segments and their neighbours.
pub(crate) const LOCAL_RULES: &[LocalRule] = &[
    sharp_corner::RULE,
    gap::RULE,
    short_segment::RULE,
    near_tangent::RULE,
    arc_as_chords::RULE,
];

/// A place, and the other places that are concerned.
pub(crate) type Places = (Place, Vec<Place>);

/// A rule on a whole contour, cheap enough to run at every report. `CONTOUR_RULES` lists them all.
pub(crate) struct ContourRule {
    pub(crate) rule: Rule,
    pub(crate) holds: fn(&Outlook) -> bool,
    /// The severity that it has at most under some settings, unless the user has set the rule.
    pub(crate) mildest: fn(&Effective) -> Option<Severity>,
    /// The place, and the other places that are concerned.
    pub(crate) places: fn(&Outlook) -> Option<Places>,
    pub(crate) detail: fn(&Outlook) -> Option<Detail>,
    /// Repairs, the preferred one first.
    pub(crate) fixes: fn(&Outlook) -> Vec<Fix>,
    /// From this many contours on one finding stands for all of them.
    pub(crate) many: usize,
}

/// Every rule on whole contours.
pub(crate) const CONTOUR_RULES: &[ContourRule] = &[open_contour::RULE];

/// What a pair rule has observed between two segments.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PairObservation {
    /// Sides of travel that it concerns, of the first and of the second segment; `None` for either.
    pub(crate) sides: (Option<Side>, Option<Side>),
    /// A disc (centre, radius) that must be empty: no segment of the drawing may reach into it,
    /// else the observation is dropped.
    pub(crate) disc: Option<(Point, f64)>,
    /// Only the contour's own segments count for the disc.
    pub(crate) own_disc: bool,
    /// Where the case is milder than the rule.
    pub(crate) mildest: Option<Severity>,
}

/// A rule on segments that come near each other. `PAIR_RULES` lists them all.
pub(crate) struct PairRule {
    pub(crate) rule: Rule,
    /// Two segments are checked together up to this distance. A disc that must be empty lies within it of both.
    pub(crate) reach: fn(&Limits) -> f64,
    /// Checks two segments, that of the earlier entity first; the flag says that they are of one contour. The
    /// observation may depend only on the two and on the `NEIGHBOURS` before and after each in its contour.
    pub(crate) check: fn(&Wall, &Wall, bool) -> Vec<PairObservation>,
    pub(crate) detail: fn(&Wall, &Wall, bool) -> Option<Detail>,
    pub(crate) fixes: fn(&Wall, &Wall) -> Vec<Fix>,
    /// Neighbouring pairs observe the same thing: the narrowest stands for all.
    pub(crate) one_per_place: bool,
    /// Silent for two entities that are duplicates of each other as a whole.
    pub(crate) silent_for_doubles: bool,
    /// Silent for neighbours that part for good at their joint, as most do.
    pub(crate) silent_where_they_part: bool,
    /// At most a warning where the wire side is not known.
    pub(crate) warning_when_side_unknown: bool,
    /// Each observed pair is a finding; otherwise the caller makes the findings.
    pub(crate) pair_by_pair: bool,
}

impl PairRule {
    /// The defaults of a rule that makes a finding of each pair.
    const PLAIN: PairRule = PairRule {
        rule: Rule::More,
        reach: |_| 0.0,
        check: |_, _, _| Vec::new(),
        detail: |_, _, _| None,
        fixes: |_, _| Vec::new(),
        one_per_place: false,
        silent_for_doubles: false,
        silent_where_they_part: false,
        warning_when_side_unknown: false,
        pair_by_pair: true,
    };
}

/// How many segments before and after a segment a pair rule may look at.
pub(crate) const NEIGHBOURS: usize = 4;

/// Every rule on pairs of segments. `duplicate-entity` comes first, since others are silent for its pairs.
pub(crate) const PAIR_RULES: &[PairRule] = &[
    duplicate_entity::RULE,
    overlap::RULE,
    self_intersection::RULE,
    narrow_slot::RULE,
    dead_end::RULE,
];
