//! Completion: group codes of this record, names of records, layers, sections.

use super::codes::codes_of;
use super::records::{self, Named, SECTIONS, TABLES};
use super::spot::{Spot, section_of, spot, text_of};
use crate::dxf::Document;
use crate::dxf::lines::Lines;
use crate::dxf::place::own_tags;
use crate::dxf::table::{Became, Item};
use crate::ide::{Completion, CompletionKind};
use crate::message::said;
use std::borrow::Cow;
use std::collections::BTreeSet;

/// The most names of layers and blocks that are listed.
const NAMES: usize = 500;

type Offer = (String, Cow<'static, str>, CompletionKind);

/// What can stand at a byte, the most likely first.
pub(crate) fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    let line = document.text().line_of(offset);
    // After the last line end an editor has a line and the reader has none.
    let spot = spot(document, line).or_else(|| spot(document, line.checked_sub(1)?));
    let Some(spot) = spot else { return Vec::new() };
    let is_own = spot.line == line;
    let range = Some(spot.lines.trimmed_range(line))
        .filter(|range| is_own && range.start <= offset && offset <= range.end)
        .unwrap_or(offset..offset);
    let record = text_of(spot.name);
    let section_at = |item| section_of(document, item).map_or_else(String::new, |(name, _)| name);
    let code = spot.tag.filter(|_| is_own && spot.at_value());
    let list: Vec<Offer> = match code.map(|tag| (tag.code, record.as_str())) {
        // The place of a group code, or of one that is not written yet.
        None => codes_after(&spot, &record, &section_at(spot.item)),
        // To the reader, the unfinished record may have ended the section.
        Some((0, _)) => {
            let section = spot
                .item
                .checked_sub(1)
                .map_or_else(String::new, section_at);
            named(records::records_of(&section), CompletionKind::Record)
        }
        Some((9, "SECTION")) => named(records::VARIABLES, CompletionKind::Name),
        Some((2, "SECTION")) => names(SECTIONS, said::a_section),
        Some((2, "TABLE")) => names(TABLES, said::a_table_of_the_drawing),
        Some((2, "INSERT")) => names(blocks(document), said::block_of_the_drawing),
        Some((8, _)) => names(layers(document), said::layer_of_the_drawing),
        Some(_) => Vec::new(),
    };
    list.into_iter()
        .map(|(text, about, kind)| Completion::new(text, about, &range, kind))
        .collect()
}

fn named(list: &[Named], kind: CompletionKind) -> Vec<Offer> {
    let offer = |(name, about): &Named| ((*name).into(), about().into(), kind);
    list.iter().map(offer).collect()
}

fn names<T: Into<String>>(
    list: impl IntoIterator<Item = T>,
    about: fn() -> &'static str,
) -> Vec<Offer> {
    let offer = |name: T| (name.into(), about().into(), CompletionKind::Name);
    list.into_iter().map(offer).collect()
}

fn codes_after(spot: &Spot<'_>, record: &str, section: &str) -> Vec<Offer> {
    let mut list = codes_of(record);
    if record == "SECTION" && section == "HEADER" {
        list.retain(|(code, _, _)| matches!(code, 0 | 9));
    }
    // A point is written x, y, z.
    let next = spot
        .before
        .map(|tag| tag.code)
        .filter(|code| (10..=28).contains(code))
        .map(|code| code + 10);
    if let Some(next) = next
        && let Some(index) = list.iter().position(|(code, _, _)| *code == next)
    {
        let first = list.remove(index);
        list.insert(0, first);
    }
    list.into_iter()
        .map(|(code, about, _)| (code.to_string(), about, CompletionKind::Code))
        .collect()
}

/// Names of blocks that a user may mean: not those of layouts and those that programs generate.
fn blocks(document: &Document) -> BTreeSet<String> {
    let lines = Lines::new(document.text());
    let items = document.table().items.iter().enumerate();
    let name = |(item, _): (usize, &Item)| {
        let name = own_tags(lines, document.table().lines_of(item, lines.count()))
            .filter(|tag| tag.code == 2)
            .last()?;
        Some(text_of(lines.trimmed(name.value_line())))
    };
    items
        .filter(|(_, item)| item.became == Became::Block)
        .filter_map(name)
        .filter(|name| !name.is_empty() && !name.starts_with('*'))
        .take(NAMES)
        .collect()
}

fn layers(document: &Document) -> BTreeSet<String> {
    let of_table = document.table().layers.iter().take(NAMES);
    let mut found: BTreeSet<String> = of_table.map(|entry| entry.name.to_string()).collect();
    let mut last: Option<&str> = None;
    for (_, entity) in document.drawing().entities() {
        // Entities of one layer mostly come together.
        if last != Some(&*entity.layer) && found.len() < NAMES {
            found.insert(entity.layer.to_string());
            last = Some(&*entity.layer);
        }
    }
    found
}
