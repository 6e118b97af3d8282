//! What is found: the numbers of each kind of finding, and the sentence that they make.

use super::aside::{SetAside, set_aside};
use super::fault::Fault;
use super::lengths::{Telling, absurd, between_walls, told_apart};
use super::misfit::Misfit;
use super::not_judged::NotJudged;
use super::small_radius::SmallRadius;
use super::unlike::Unlike;
use super::unwritable::Unwritable;
use crate::drawing::Visibility;
use crate::geometry::Point;
use std::sync::Arc;

told! {
    /// The numbers of a finding. One variant for each kind of sentence.
    enum Detail;
    fn sentence(telling: Telling);

    SmallRadius(numbers: Box<SmallRadius>) => numbers.sentence(telling);
    /// A corner concave to the wire turns by `turn` (radians): the wire leaves `radius` and does not cut `uncut`. Where
    /// the wire side is not known, one finding stands for the `count` corners of its contour, and `uncut` is that of a
    /// corner if the wire runs inside of it; else `count` is `None`.
    SharpCorner { turn: f64, radius: f64, uncut: f64, count: Option<usize> }
        => match (count, telling.mm(*radius)) {
            (None, radius) => {
                let (angle, uncut) = (between_walls(*turn), telling.mm(*uncut));
                say!(an_inside_corner_is_left_rounded, angle, radius, uncut)
            }
            (Some(1), radius) => {
                let angle = between_walls(*turn);
                say!(a_sharp_corner_that_the_wire_runs_inside, angle, radius, telling.tool())
            }
            (Some(count), radius) => {
                say!(sharp_corners_that_the_wire_runs_inside, count, radius, telling.tool())
            }
        };
    /// `count` inside corners of one contour, of which most stays at `at`.
    SharpCorners { radius: f64, uncut: f64, at: Point, count: usize } => {
        let at = at * telling.unit_mm;
        say!(inside_corners_come_out_rounded, count, telling.mm(*radius), telling.mm(*uncut), at.x, at.y)
    };
    /// Facing walls are `width` apart, the wire needs `required`. Those of two parts may lie on one another: 0. Of the two, `middles` are
    /// the middle of a milled slot.
    NarrowSlot { width: f64, required: f64, middles: usize } => {
        let is_without_room = *width == 0.0;
        let (width, required) = told_apart(width * telling.unit_mm, required * telling.unit_mm);
        match (is_without_room, middles) {
            (true, 0) => say!(walls_lie_on_one_another, telling.tool(), required),
            (_, 1) => say!(the_middle_of_a_slot_is_too_near_a_wall, width, required, telling.tool()),
            (_, 2) => say!(no_wall_is_left_between_slots, width, required, telling.tool()),
            _ => say!(the_slot_is_too_narrow, width, required, telling.tool())
        }
    };
    /// The offset loses a part of the outline, near a point.
    LostPocket { near: Point } => say!(the_offset_loses_this_part_of_the_outline, telling.tool());
    /// The wire gets no further between two walls: the rest stays uncut, and `near` is farthest from the wire, by this
    /// much.
    DeadEnd { near: Point, uncut: f64 } => say!(
        the_wire_does_not_reach_this_part_of_the_outline,
        telling.mm(*uncut),
        telling.tool()
    );
    /// The offset of the outline is empty at this correction.
    OffsetCollapse {
        required: f64,
        /// A point is left: the wire can stand there, and cuts nothing more.
        point: bool
    } => match (point, telling.mm(*required)) {
        (true, required) => say!(a_point_is_left_of_the_outline, required, telling.tool()),
        (false, required) => say!(nothing_is_left_of_the_outline, required, telling.tool()),
    };
    /// The planned path of the wire fails its proof, near a point.
    UnprovedPath { near: Point }
        => say!(no_path_of_the_wire_along_this_contour_holds, telling.tool());
    /// There is a path, but the language of the program cannot express it.
    Unwritable(what: Unwritable) => what.sentence();
    /// The ends of a contour are `distance` apart; `next` is the distance of other ends, where these would be joined under another setting.
    OpenContour { distance: f64, next: Option<f64> }
        => say!(contour_is_open_its_ends_are_mm, telling.mm(*distance)) + &to_join(*next, telling);
    /// So many that they are no slips, by layers.
    OpenContours { count: usize, layers: Vec<(Arc<str>, usize)>, next: Option<f64> } => {
        let more = layers.len().saturating_sub(LISTED);
        let named = layers.iter().take(LISTED);
        let mut listed: Vec<String> = named.map(|(name, own)| say!(on_its_layer, name, own)).collect();
        listed.extend((more > 0).then(|| say!(and_more_of_them, more)));
        say!(open_contours_name_the_layer, count, listed.join(say!(comma))) + &to_join(*next, telling)
    };
    /// Two ends that belong together are `distance` apart.
    Gap { distance: f64 } => say!(ends_do_not_meet, telling.mm(*distance));
    /// This many entities of a contour lie there more than once.
    DuplicateEntity { count: usize } => match count {
        1 => say!(entity_lies_in_the_same_place_as_another, telling.tool()),
        count => say!(entities_of_the_outline_lie_there_twice, count, telling.tool()),
    };
    /// Two segments coincide over `length`.
    Overlap { length: f64 } => say!(segment_runs_on_another_one_over_mm, telling.mm(*length));
    NotJudged(what: NotJudged) => what.sentence();
    ShortSegment { length: f64 } => say!(the_segment_is_too_short, telling.mm(*length));
    /// Two segments meet at `turn` radians: nearly tangent, but not quite.
    NearTangent { turn: f64 }
        => say!(contour_kinks_by_degrees, turn.abs().to_degrees(), telling.tool());
    /// `count` of one contour, the largest at `at`.
    NearTangents { turn: f64, at: Point, count: usize } => {
        let (turn, at) = (turn.abs().to_degrees(), at * telling.unit_mm);
        say!(contour_kinks_in_several_places, count, turn, at.x, at.y, telling.tool())
    };
    /// Segments cross, or only touch, at a point: the first of `count` along one of the two, where
    /// that one meets many.
    SelfIntersection { at: Point, touches: bool, count: usize, on_line: bool } => {
        if *on_line {
            return match *count {
                1 => say!(a_cut_on_the_line_meets_a_contour).into(),
                count => say!(a_cut_on_the_line_meets_contours, count),
            };
        }
        let how = match touches {
            true => say!(touches_itself_or_another),
            false => say!(crosses_itself_or_another),
        };
        match *count > 1 {
            true => say!(the_wire_would_cut_into_the_part_each_time, how, count, telling.tool()),
            false => say!(the_wire_would_cut_into_the_part, how, telling.tool()),
        }
    };
    /// `chords` lines in a row lie on one circle, within `deviation`.
    ArcAsChords {
        chords: usize,
        center: Point,
        radius: f64,
        deviation: f64,
        /// How far the middle of the longest chord lies from the circle.
        facet: f64
    } => {
        // Less than a nanometre is rounding.
        let within = match deviation * telling.unit_mm < 1e-6 {
            true => String::new(),
            false => say!(within_mm, telling.mm(*deviation)),
        };
        let facets = match facet * telling.unit_mm < FACET {
            true => String::new(),
            false => say!(the_wire_leaves_facets, telling.tool(), telling.mm(*facet)),
        };
        say!(chords_lie_on_one_arc, chords, telling.mm(*radius), within, facets)
    };
    /// So many runs of chords of one contour, with all their chords; the numbers are those of the longest.
    ArcsAsChords { chords: usize, arcs: usize, center: Point, radius: f64, deviation: f64 } => {
        say!(chords_lie_on_several_arcs, chords, arcs, telling.mm(*radius))
    };
    /// A fault in a block or contour of a program.
    Program(fault: Box<Fault>) => fault.sentence();
    DoesNotFit(parts: Box<Misfit>) => parts.sentence(telling);
    /// A contour of the workpiece `of` has no partner in another.
    NoPartner {
        of: Arc<str>,
        /// Workpieces without any entity.
        missing: Vec<String>
    } => match (say!(the_contour_has_no_partner, of), missing.is_empty()) {
        (sentence, true) => sentence,
        (sentence, false) => sentence + &say!(nothing_is_drawn_of, missing.join(", ")),
    };
    /// A program and its drawing differ.
    NotTheDrawing(what: Box<Unlike>) => what.sentence(telling.unit_mm);
    /// The `kind` of entity, and the number of them; the place is the first.
    UnsupportedEntity { kind: String, count: usize, why: &'static str } => match count {
        1 => say!(is_not_cut, kind, why),
        count => say!(of_them_is_not_cut, kind, count, why),
    };
    /// `count` entities are drawn on a layer that is not simply shown, or are invisible themselves.
    Unseen { layer: Arc<str>, visibility: Visibility, count: usize }
        => unseen(layer, *visibility, *count);
    /// `count` polylines are drawn with a width, the largest of which is given.
    Wide { count: usize, width: f64 }
        => say!(polylines_with_a_width_are_cut_along_their_middle, count, telling.mm(*width));
    /// Entities drawn only to be read, not to be cut.
    SetAside(parts: Vec<SetAside>) => set_aside(parts);
    /// The larger side of the largest contour, which suggests another unit.
    Size { size: f64 } => {
        let what = absurd(size * telling.unit_mm);
        say!(the_size_of_the_part_is_absurd, telling.mm(*size), what)
    };
    /// Only a sentence: what was found and what was expected, in lower case without a full stop.
    Said(sentence: String) => sentence.as_str();
    More { count: usize } => say!(more_findings_are_not_shown, count);
}

/// The most layers that are named.
const LISTED: usize = 6;

/// mm; facets below this cannot be felt or measured.
const FACET: f64 = 0.001;

/// That ends this far apart would be one contour under another `join`, in mm with two digits.
fn to_join(next: Option<f64>, telling: Telling) -> String {
    let join = |next: f64| ((next * telling.unit_mm * 100.0).floor() + 1.0) / 100.0;
    let sentence = |next| say!(an_end_would_be_joined, telling.mm(next), join(next));
    next.map_or_else(String::new, sentence)
}

fn unseen(layer: &str, visibility: Visibility, count: usize) -> String {
    let entities = say!(entities, count);
    let are = if count == 1 { say!(is) } else { say!(are) };
    let of_layer = |what: &str| say!(entities_of_a_layer_are_not_cut, layer, what, entities, are);
    match visibility {
        Visibility::Frozen => of_layer(say!(frozen)),
        Visibility::Off => of_layer(say!(switched_off)),
        Visibility::Invisible => say!(invisible_entities_are_not_cut, entities, are),
        Visibility::Unplotted | Visibility::Shown => {
            say!(
                entities_of_a_layer_that_is_not_plotted_are_cut,
                layer,
                entities,
                are
            )
        }
    }
}
