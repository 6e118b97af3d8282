//! What can be written at a place: group codes of this record, names of records, layers, sections.

use super::codes::{self, SECTIONS, TABLES};
use super::spot::{Spot, section_of, spot, text_of};
use crate::dxf::Document;
use crate::dxf::lines::Lines;
use crate::dxf::place::own_tags;
use crate::dxf::table::{Became, Item};
use crate::ide::{Completion, CompletionKind};
use std::collections::BTreeSet;

/// Names of layers and blocks that are listed at most.
const NAMES: usize = 500;

/// What can stand at a byte, what belongs there most first.
pub fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    let line = document.text().line_of(offset);
    // Behind the last line end there is a line for an editor, and none for the reader.
    let spot = spot(document, line).or_else(|| spot(document, line.checked_sub(1)?));
    let Some(spot) = spot else { return Vec::new() };
    let range = if spot.line == line {
        spot.lines.trimmed_range(line)
    } else {
        offset..offset
    };
    let range = if range.start <= offset && offset <= range.end {
        range
    } else {
        offset..offset
    };
    let record = text_of(spot.name);
    let value_of = if line == spot.line && spot.at_value() {
        spot.tag
    } else {
        None
    };
    let section = || section_of(document, spot.item).map_or_else(String::new, |(name, _)| name);
    let list: Vec<(String, &'static str, CompletionKind)> = match value_of {
        // The place of a group code, or of one that is not written yet.
        None => codes_after(&spot, &record, &section()),
        Some(tag) => match (tag.code, record.as_str()) {
            (0, _) => {
                // The record that is being written may have ended the section in the eyes of the reader.
                let section = spot
                    .item
                    .checked_sub(1)
                    .and_then(|item| section_of(document, item))
                    .map_or_else(String::new, |(name, _)| name);
                codes::records_of(&section)
                    .iter()
                    .map(|(name, about)| ((*name).into(), *about, CompletionKind::Record))
                    .collect()
            }
            (2, "INSERT") => blocks(document)
                .into_iter()
                .map(|name| (name, "block of the drawing", CompletionKind::Name))
                .collect(),
            (8, _) => layers(document)
                .into_iter()
                .map(|name| (name, "layer of the drawing", CompletionKind::Name))
                .collect(),
            (2, "SECTION") => SECTIONS
                .iter()
                .map(|name| ((*name).into(), "section", CompletionKind::Name))
                .collect(),
            (2, "TABLE") => TABLES
                .iter()
                .map(|name| ((*name).into(), "table", CompletionKind::Name))
                .collect(),
            (9, "SECTION") => codes::VARIABLES
                .iter()
                .map(|(name, about)| ((*name).into(), *about, CompletionKind::Name))
                .collect(),
            _ => Vec::new(),
        },
    };
    list.into_iter()
        .map(|(text, about, kind)| Completion {
            label: text.clone(),
            text,
            about: about.into(),
            kind,
            range: range.clone(),
        })
        .collect()
}

fn codes_after(
    spot: &Spot<'_>,
    record: &str,
    section: &str,
) -> Vec<(String, &'static str, CompletionKind)> {
    let in_header = record == "SECTION" && section == "HEADER";
    if in_header {
        return vec![
            (
                "9".into(),
                "name of a header variable; its value follows",
                CompletionKind::Code,
            ),
            (
                "0".into(),
                "name of the record that begins here",
                CompletionKind::Code,
            ),
        ];
    }
    // A point is written x, y, z.
    let next = spot
        .before
        .map(|tag| tag.code)
        .filter(|code| (10..=28).contains(code))
        .map(|code| code + 10);
    let mut list: Vec<_> = codes::codes_of(record).collect();
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

/// Names of blocks that somebody may mean: not those of layouts and of what programs make for themselves.
fn blocks(document: &Document) -> BTreeSet<String> {
    let lines = Lines::new(document.text());
    let items = document
        .table()
        .items
        .iter()
        .enumerate()
        .filter(|(_, item)| item.became == Became::Block);
    let name = |(item, _): (usize, &Item)| {
        let name = own_tags(lines, document.table().lines_of(item, lines.count()))
            .filter(|tag| tag.code == 2)
            .last()?;
        Some(text_of(lines.trimmed(name.value_line())))
    };
    items
        .filter_map(name)
        .filter(|name| !name.is_empty() && !name.starts_with('*'))
        .take(NAMES)
        .collect()
}

fn layers(document: &Document) -> BTreeSet<String> {
    let mut found: BTreeSet<String> = BTreeSet::new();
    found.extend(
        document
            .table()
            .layers
            .iter()
            .take(NAMES)
            .map(|entry| entry.name.to_string()),
    );
    let mut last: Option<&str> = None;
    for (_, entity) in document.drawing().entities() {
        // Entities of one layer mostly stand together.
        if last != Some(&*entity.layer) && found.len() < NAMES {
            found.insert(entity.layer.to_string());
            last = Some(&*entity.layer);
        }
    }
    found
}
