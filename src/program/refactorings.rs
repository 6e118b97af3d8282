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
use crate::program::three_b;
use crate::program::three_b::refactor::{corrected, split, with_ends, without_ends};
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

/// What is common to all ids.
const PREFIX: &str = "refactor.rewrite.";

/// The table of the refactorings, in the order in which they are offered. A row has the documents that have it, its id,
/// its title and its edits: none where there is nothing to do. What changes no move needs no sheet.
macro_rules! refactorings {
    (
        fn($document:ident, $settings:ident, $sheet:ident);
        $($of:pat, $id:literal, $title:expr => $edits:expr;)+
    ) => {
        const ALL: &[&str] = &[$(concat!("refactor.rewrite.", $id)),+];

        /// `None` for one that the language of a program does not have.
        #[allow(unused_variables, reason = "titles do not need the programs")]
        fn title(id: &str, $document: &Document, $settings: &Effective) -> Option<String> {
            match ($document, id.trim_start_matches(PREFIX)) {
                $(($of, $id) => Some(String::from($title)),)+
                _ => None,
            }
        }

        fn made<'a>(
            id: &str,
            $document: &Document,
            $settings: &Effective,
            sheet: &impl Deref<Target = Result<Sheet<'a>, String>>,
        ) -> Edits {
            let $sheet = || (**sheet).as_ref().map_err(String::clone);
            match ($document, id.trim_start_matches(PREFIX)) {
                $(($of, $id) => $edits,)+
                _ => Ok(Vec::new()),
            }
        }
    };
}

refactorings! {
    fn(document, settings, sheet);
    _, "reverse", say!(reverse_the_direction_of_the_contour) => reversed(sheet()?);
    _, "startHere", say!(begin_the_contour_with_this_block) => begun_here(sheet()?);
    _, "mirror.x", say!(mirror_left_and_right) => transformed(sheet()?, [[-1, 0], [0, 1]]);
    _, "mirror.y", say!(mirror_up_and_down) => transformed(sheet()?, [[1, 0], [0, -1]]);
    _, "rotate.left", say!(rotate_by_90_counter_clockwise) => transformed(sheet()?, [[0, -1], [1, 0]]);
    _, "rotate.right", say!(rotate_by_90_clockwise) => transformed(sheet()?, [[0, 1], [-1, 0]]);
    _, "rotate.half", say!(rotate_by_180) => transformed(sheet()?, [[-1, 0], [0, -1]]);
    _, "scale.inchToMm", say!(scale_from_inch_to_mm) => between_units(sheet()?, INCH);
    _, "scale.mmToInch", say!(scale_from_mm_to_inch) => between_units(sheet()?, 1.0 / INCH);
    _, "merge", say!(merge_collinear_blocks) => merged(sheet()?);
    Document::ThreeB(own), "split", say!(split_blocks_over, settings.largest_number()) => split(own, sheet()?);
    Document::ThreeB(own), "correct.opening", say!(apply_the_correction_inside, settings.correction)
        => corrected(own, sheet()?, Role::Opening);
    Document::ThreeB(own), "correct.punch", say!(apply_the_correction_outside, settings.correction)
        => corrected(own, sheet()?, Role::Punch);
    Document::ThreeB(own), "layout.compact", say!(convert_to_the_compact_layout)
        => Ok(laid_out(own, Layout::Compact));
    Document::ThreeB(own), "layout.aligned", say!(convert_to_the_aligned_layout)
        => Ok(laid_out(own, Layout::Aligned));
    Document::ThreeB(own), "coordinates.insert", say!(write_the_end_of_each_block) => with_ends(own, sheet()?);
    Document::ThreeB(own), "coordinates.remove", say!(leave_the_ends_of_blocks_out) => without_ends(own, sheet()?);
    Document::Iso(own), "coordinates.absolute", say!(make_all_coordinates_absolute_g90)
        => counted(own, sheet()?, false);
    Document::Iso(own), "coordinates.incremental", say!(let_all_coordinates_count_from_where_the_wire_stands)
        => counted(own, sheet()?, true);
    Document::Iso(own), "centers.startToCenter", say!(let_i_and_j_lead_from_the_start_to_the_centre)
        => centered(own, sheet()?, CenterRule::StartToCenter);
    Document::Iso(own), "centers.centerToStart", say!(let_i_and_j_lead_from_the_centre_to_the_start)
        => centered(own, sheet()?, CenterRule::CenterToStart);
    Document::Iso(own), "centers.absolute", say!(let_i_and_j_be_coordinates_of_the_centre)
        => centered(own, sheet()?, CenterRule::Absolute);
    Document::Iso(_), "number", say!(number_the_blocks_in_tens) => numbered(document, settings);
    _, "number", say!(number_the_blocks_from_1) => numbered(document, settings);
    _, "withoutNumbers", say!(leave_the_block_numbers_out) => without_numbers(document, settings);
}

fn laid_out(program: &three_b::Document, layout: Layout) -> Vec<TextEdit> {
    let (text, words) = (program.text(), program.words());
    three_b::format::format(text, Some(layout), &words, 0..text.line_count())
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
    let offer = |id: &&'static str| {
        let (id, sheet) = (*id, sheet.clone());
        Some(Offer {
            id,
            title: title(id, document, settings).filter(|_| wanted(id))?,
            make: Box::new(move || made(id, document, settings, &*sheet)),
        })
    };
    // The numbers of ISO have a title of their own.
    let mut ids = ALL.to_vec();
    ids.dedup();
    let mut offers: Vec<Offer<'a>> = ids.iter().filter_map(offer).collect();
    if document.language() == Language::Iso && wanted(profile::ID) {
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
