//! Rewrite an ISO program by a profile.

use super::convert::{Cuts, Dropped, cuts_to_write};
use super::document::Document;
use super::format::Format;
use super::iso::taper::{Words, refuse_anywhere};
use super::refactor::moves::Edits;
use crate::settings::{Effective, Profile, shipped_profiles};
use crate::text::TextEdit;
use std::cell::LazyCell;
use std::rc::Rc;

pub(super) const ID: &str = "refactor.rewrite.profile";

/// The title, and how it is made.
type Titled<'a> = (String, Box<dyn Fn() -> Edits + 'a>);

/// One for each shipped profile and for that of the settings.
pub(super) fn offers<'a>(
    document: &'a Document,
    settings: &'a Effective,
) -> impl Iterator<Item = Titled<'a>> {
    let own = settings
        .profile
        .iter()
        .filter(|own| shipped_profiles().all(|name| name != own.name))
        .cloned();
    let shipped = shipped_profiles().filter_map(|name| match &settings.profile {
        Ok(own) if own.name == name => Some(own.clone()),
        _ => Profile::of(name, None).ok(),
    });
    let cuts = Rc::new(LazyCell::new(|| sound_cuts(document, settings)));
    shipped.chain(own).map(move |profile| {
        let title = say!(write_anew_as_profile, profile.name);
        let profile = Ok(profile);
        let settings = Effective {
            profile,
            ..settings.clone()
        };
        let cuts = cuts.clone();
        let make = move || {
            let cuts = (**cuts).as_ref().map_err(String::clone)?;
            written(document, cuts, &settings)
        };
        (title, Box::new(make) as Box<dyn Fn() -> Edits + 'a>)
    })
}

/// The whole text anew; no edits where it is written so already.
fn written(document: &Document, cuts: &Cuts, settings: &Effective) -> Edits {
    if let Some(reason) = cuts.lost_correction(Format::Iso, settings) {
        return Err(reason);
    }
    let written = cuts.write(Format::Iso, settings);
    let written = written.map_err(|error| error.to_string())?.text;
    let text = document.text();
    Ok(if text.bytes() == written.as_bytes() {
        Vec::new()
    } else {
        vec![TextEdit::new(0..text.len(), written)]
    })
}

fn sound_cuts(document: &Document, settings: &Effective) -> Result<Cuts, String> {
    if let Some(line) = document.unfollowed_line() {
        let reason = say!(the_program_is_not_followed_as_a_whole);
        return Err(say!(line_by_number, line + 1, reason));
    }
    let cuts = cuts_to_write(document, true);
    if let Some(line) = cuts.lost.first() {
        return Err(say!(the_arc_of_a_line_leads_nowhere, line + 1));
    }
    if let Document::Iso(program) = document {
        refuse_anywhere(program, Words::All)?;
    }
    if let Some(reason) = Dropped::of(document).refusal() {
        return Err(reason);
    }
    if let Some(reason) = cuts.refusal(Format::Iso, settings) {
        return Err(reason);
    }
    if let Some(line) = cuts.stops.first() {
        return Err(say!(the_stop_before_the_tab_would_be_lost, line + 1));
    }
    if cuts.cuts.is_empty() {
        return Err(say!(the_program_cuts_nothing).into());
    }
    Ok(cuts)
}
