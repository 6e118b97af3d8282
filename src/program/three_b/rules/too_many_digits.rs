//! `too-many-digits`: a number with more digits than the controller has.

use super::projection::is_misfit;
use super::{Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Fault, FixKind};
use crate::geometry::Point;
use crate::program::three_b::block::Node;
use crate::program::three_b::decode::{DecodeFault, decode, meant};
use crate::program::three_b::encode::{encode, snap};
use crate::program::three_b::layout::{layout_in, push_fields};

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    let block = outlook.block;
    let numbers = [
        (Spot::J, "J", block.j),
        (Spot::X, "X", block.x),
        (Spot::Y, "Y", block.y),
    ];
    let (spot, field, value) = numbers
        .into_iter()
        .find(|(_, _, value)| *value > outlook.settings.largest_number())?;
    Some(Observation::at(
        spot,
        Fault::TooManyDigits {
            field,
            value,
            digits: outlook.settings.digits,
        },
    ))
}

/// The way in pieces that fit. Beyond this many the number is wrong, not just large.
const MOST_PIECES: usize = 64;

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    // Where J contradicts X and Y a digit is wrong, not the block too long.
    if decode(&site.block, Point::origin()) == Err(DecodeFault::WrongLength)
        || is_misfit(&site.block)
    {
        return Vec::new();
    }
    let Some(segment) = meant(&site.block, Point::origin())
        .filter(|segment| segment.length() <= site.largest as f64 * MOST_PIECES as f64)
    else {
        return Vec::new();
    };
    let mut pieces = Vec::new();
    let made = snap(segment.end()).and_then(|end| {
        encode(
            &segment,
            Node { x: 0, y: 0 },
            end,
            site.largest,
            &mut pieces,
        )
    });
    if made.is_none() || pieces.len() < 2 || pieces.len() > MOST_PIECES {
        return Vec::new();
    }
    let line_end: &[u8] = match site.text.get(site.line.clone()) {
        Some(line) if line.ends_with(b"\r\n") => b"\r\n",
        Some(line) if line.ends_with(b"\r") => b"\r",
        _ => b"\n",
    };
    let layout = layout_in(site.text.get(site.range.clone()).unwrap_or_default());
    let mut text = Vec::new();
    for (index, piece) in pieces.iter().enumerate() {
        if index > 0 {
            text.extend_from_slice(line_end);
        }
        push_fields(&mut text, layout, &piece.block, None);
    }
    let Ok(text) = String::from_utf8(text) else {
        return Vec::new();
    };
    let pieces = pieces.len();
    let edit = site.replace(&site.range, text);
    vec![TextFix::text(FixKind::SplitBlock { pieces }, true, edit)]
}
