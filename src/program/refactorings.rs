//! The refactorings of a program in any language, by the ids of their code actions.

use crate::drawing::Role;
use crate::program::document::{Document, Language};
use crate::program::iso::moves::CenterRule;
use crate::program::iso::refactor::{centered, counted};
use crate::program::profile;
use crate::program::refactor::merge::merged;
use crate::program::refactor::mirror::transformed;
use crate::program::refactor::moves::{Edits, INCH};
use crate::program::refactor::number::{numbered, without_numbers};
use crate::program::refactor::reverse::reversed;
use crate::program::refactor::scale::{self, between_units};
use crate::program::refactor::sheet::Sheet;
use crate::program::refactor::start_here::begun_here;
use crate::program::three_b::refactor::{corrected, laid_out, split};
use crate::settings::{Effective, Layout};
use crate::text::TextEdit;
use std::cell::LazyCell;
use std::ops::{Deref, Range};
use std::rc::Rc;

/// A refactoring that may be possible at a selection: it is not tried before its edits are asked for.
pub struct Offer<'a> {
    /// Kind of its code action.
    pub id: &'static str,
    pub title: String,
    make: Box<dyn Fn() -> Edits + 'a>,
}

impl Offer<'_> {
    /// The edits, empty where there is nothing to do, or why it cannot be done.
    pub fn edits(&self) -> Edits {
        (self.make)()
    }

    /// The refactoring with its edits; nothing where it would change nothing.
    pub fn tried(self) -> Option<Proposal> {
        let edits = self.edits();
        let changes = edits.as_ref().map_or(true, |edits| !edits.is_empty());
        let Offer { id, title, .. } = self;
        changes.then_some(Proposal { id, title, edits })
    }
}

/// A refactoring that has been tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    pub id: &'static str,
    pub title: String,
    pub edits: Edits,
}

/// Those of every language by their ids, in the order in which they are offered.
const OF_MOVES: [&str; 10] = [
    "refactor.rewrite.reverse",
    "refactor.rewrite.startHere",
    "refactor.rewrite.mirror.x",
    "refactor.rewrite.mirror.y",
    "refactor.rewrite.rotate.left",
    "refactor.rewrite.rotate.right",
    "refactor.rewrite.rotate.half",
    "refactor.rewrite.scale.inchToMm",
    "refactor.rewrite.scale.mmToInch",
    "refactor.rewrite.merge",
];

const OF_THREE_B: [&str; 6] = [
    "refactor.rewrite.split",
    "refactor.rewrite.correct.opening",
    "refactor.rewrite.correct.punch",
    "refactor.rewrite.layout.compact",
    "refactor.rewrite.layout.aligned",
    "refactor.rewrite.layout.checking",
];

const OF_ISO: [&str; 5] = [
    "refactor.rewrite.coordinates.absolute",
    "refactor.rewrite.coordinates.incremental",
    "refactor.rewrite.centers.startToCenter",
    "refactor.rewrite.centers.centerToStart",
    "refactor.rewrite.centers.absolute",
];

const OF_NUMBERS: [&str; 2] = ["refactor.rewrite.number", "refactor.rewrite.withoutNumbers"];

/// What is common to all ids.
const PREFIX: &str = "refactor.rewrite.";

fn title(id: &str, language: Language, settings: &Effective) -> String {
    let title = match id.trim_start_matches(PREFIX) {
        "reverse" => say!(reverse_the_direction_of_the_contour),
        "startHere" => say!(begin_the_contour_with_this_block),
        "mirror.x" => say!(mirror_left_and_right),
        "mirror.y" => say!(mirror_up_and_down),
        "rotate.left" => say!(rotate_by_90_counter_clockwise),
        "rotate.right" => say!(rotate_by_90_clockwise),
        "rotate.half" => say!(rotate_by_180),
        "scale.inchToMm" => say!(scale_from_inch_to_mm),
        "scale.mmToInch" => say!(scale_from_mm_to_inch),
        "merge" => say!(merge_collinear_blocks),
        "split" => return say!(split_blocks_over, settings.largest_number()),
        "correct.opening" => return say!(apply_the_correction_inside, settings.correction),
        "correct.punch" => return say!(apply_the_correction_outside, settings.correction),
        "layout.compact" => say!(convert_to_the_compact_layout),
        "layout.aligned" => say!(convert_to_the_aligned_layout),
        "layout.checking" => say!(convert_to_the_checking_layout),
        "coordinates.absolute" => say!(make_all_coordinates_absolute_g90),
        "coordinates.incremental" => say!(let_all_coordinates_count_from_where_the_wire_stands),
        "centers.startToCenter" => say!(let_i_and_j_lead_from_the_start_to_the_centre),
        "centers.centerToStart" => say!(let_i_and_j_lead_from_the_centre_to_the_start),
        "centers.absolute" => say!(let_i_and_j_be_coordinates_of_the_centre),
        "number" if language == Language::Iso => say!(number_the_blocks_in_tens),
        "number" => say!(number_the_blocks_from_1),
        _ => say!(leave_the_block_numbers_out),
    };
    title.to_owned()
}

/// No edits where there is nothing to do. What changes no move needs no sheet.
fn made<'a>(
    id: &str,
    document: &Document,
    settings: &Effective,
    sheet: &impl Deref<Target = Result<Sheet<'a>, String>>,
) -> Edits {
    let sheet = || (**sheet).as_ref().map_err(String::clone);
    match (id.trim_start_matches(PREFIX), document) {
        ("reverse", _) => reversed(sheet()?),
        ("startHere", _) => begun_here(sheet()?),
        ("mirror.x", _) => transformed(sheet()?, [[-1, 0], [0, 1]]),
        ("mirror.y", _) => transformed(sheet()?, [[1, 0], [0, -1]]),
        ("rotate.left", _) => transformed(sheet()?, [[0, -1], [1, 0]]),
        ("rotate.right", _) => transformed(sheet()?, [[0, 1], [-1, 0]]),
        ("rotate.half", _) => transformed(sheet()?, [[-1, 0], [0, -1]]),
        ("scale.inchToMm", _) => between_units(sheet()?, INCH),
        ("scale.mmToInch", _) => between_units(sheet()?, 1.0 / INCH),
        ("merge", _) => merged(sheet()?),
        ("number", _) => numbered(document, settings),
        ("withoutNumbers", _) => without_numbers(document, settings),
        ("split", Document::ThreeB(own)) => split(own, sheet()?),
        ("correct.opening", Document::ThreeB(own)) => corrected(own, sheet()?, Role::Opening),
        ("correct.punch", Document::ThreeB(own)) => corrected(own, sheet()?, Role::Punch),
        ("layout.compact", Document::ThreeB(own)) => laid_out(own, settings, Layout::Compact),
        ("layout.aligned", Document::ThreeB(own)) => laid_out(own, settings, Layout::Aligned),
        ("layout.checking", Document::ThreeB(own)) => laid_out(own, settings, Layout::Checking),
        ("coordinates.absolute", Document::Iso(own)) => counted(own, sheet()?, false),
        ("coordinates.incremental", Document::Iso(own)) => counted(own, sheet()?, true),
        ("centers.startToCenter", Document::Iso(own)) => {
            centered(own, sheet()?, CenterRule::StartToCenter)
        }
        ("centers.centerToStart", Document::Iso(own)) => {
            centered(own, sheet()?, CenterRule::CenterToStart)
        }
        ("centers.absolute", Document::Iso(own)) => centered(own, sheet()?, CenterRule::Absolute),
        _ => Ok(Vec::new()),
    }
}

/// What may be possible at a selection of bytes, nothing of it tried. `wanted` chooses by id.
pub fn offers<'a>(
    document: &'a Document,
    settings: &'a Effective,
    selection: Range<usize>,
    wanted: impl Fn(&str) -> bool,
) -> Vec<Offer<'a>> {
    // The heights of an electrode belong to the moves as they are.
    if document.mills() {
        return Vec::new();
    }
    let sheet = Rc::new(LazyCell::new(move || {
        Sheet::new(document, settings, selection.clone())
    }));
    let language = document.language();
    let own = match language {
        Language::ThreeB => &OF_THREE_B[..],
        Language::Iso => &OF_ISO,
    };
    let all = OF_MOVES.iter().chain(own).chain(&OF_NUMBERS).copied();
    let offer = |id: &'static str| {
        let sheet = sheet.clone();
        Offer {
            id,
            title: title(id, language, settings),
            make: Box::new(move || made(id, document, settings, &*sheet)),
        }
    };
    let mut offers: Vec<Offer<'a>> = all.filter(|id| wanted(id)).map(offer).collect();
    if language == Language::Iso && wanted(profile::ID) {
        let profiles = profile::offers(document, settings);
        offers.extend(profiles.map(|(title, make)| Offer {
            id: profile::ID,
            title,
            make,
        }));
    }
    offers
}

/// All of them tried, except those that would change nothing.
pub fn refactorings(
    document: &Document,
    settings: &Effective,
    selection: Range<usize>,
    wanted: impl Fn(&str) -> bool,
) -> Vec<Proposal> {
    let offers = offers(document, settings, selection, wanted).into_iter();
    offers.filter_map(Offer::tried).collect()
}

/// The edits that scale a program.
pub fn scaled(
    document: &Document,
    settings: &Effective,
    factor: f64,
) -> Result<Vec<TextEdit>, String> {
    if document.mills() {
        return Err(say!(it_is_milled).into());
    }
    scale::refuse(factor)?;
    scale::scaled(&Sheet::new(document, settings, 0..0)?, factor)
}
