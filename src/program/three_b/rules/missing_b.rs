//! `missing-b`: one of a block's three `B` is not there. The reader finds it; this is its repair.

use super::{BlockRule, Site, TextFix};
use crate::finding::{Fault, FixKind, Rule};
use crate::program::three_b::fault::Flaw;
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::words::Words;
use crate::text::TextEdit;

pub(super) const RULE: BlockRule = BlockRule {
    rule: Rule::MissingB,
    check: |_| None,
    fixes,
};

fn fixes(site: &Site, _: &Fault) -> Vec<TextFix> {
    let Some(line) = site.text.get(site.line.clone()) else {
        return Vec::new();
    };
    let mut found = None;
    read_line(line, site.line.start, &Words::default(), |item| {
        if let Item::Fault(fault) = item
            && let Flaw::MissingB { at } = fault.flaw
            && fault.range == site.range
        {
            found = Some(at);
        }
    });
    let Some(at) = found else { return Vec::new() };
    let is_lower = line.contains(&b'b') && !line.contains(&b'B');
    let edit = TextEdit::new(at..at, if is_lower { "b" } else { "B" });
    vec![TextFix::text(FixKind::InsertB, true, edit)]
}
