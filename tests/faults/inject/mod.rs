//! One fault put into the text of a program, as a hand or a bad line puts them there.

mod iso;
mod kinds;
mod more;
mod three_b;

use crate::faults::chance::Chance;
use crate::faults::contours::Group;
pub use kinds::{is_one_slip, kinds, more_kinds};
use std::ops::Range;

/// A program with one fault.
#[derive(Clone, Debug)]
pub struct Faulty {
    pub kind: &'static str,
    pub text: String,
    /// The lines, from 0, of which each is the right place to say so.
    pub lines: Vec<usize>,
    /// Of several slips, the programs in which only some of them are undone.
    pub between: Vec<String>,
}

impl Faulty {
    fn of(kind: &'static str, text: String, lines: Vec<usize>) -> Faulty {
        Faulty {
            kind,
            text,
            lines,
            between: Vec::new(),
        }
    }
}

/// A fault of this kind somewhere in the program; `None` where there is no place for one.
pub fn inject(group: Group, kind: &'static str, text: &str, chance: &mut Chance) -> Option<Faulty> {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let is_block = |line: &str| match group {
        Group::Iso => iso::is_move(line),
        Group::Compact | Group::Checking => three_b::block_of(line).is_some(),
    };
    let blocks: Vec<usize> = (0..lines.len())
        .filter(|&line| is_block(lines[line]))
        .collect();
    let joined = |lines: Vec<&str>| lines.concat();
    match kind {
        "block lost" => {
            let line = chance.of(&blocks);
            let mut kept = lines.clone();
            kept.remove(line);
            return Some(Faulty::of(
                kind,
                joined(kept),
                vec![line.saturating_sub(1), line],
            ));
        }
        "block twice" => {
            let line = chance.of(&blocks);
            let mut more = lines.clone();
            more.insert(line, lines[line]);
            return Some(Faulty::of(kind, joined(more), vec![line, line + 1]));
        }
        "blocks exchanged" => {
            let pairs: Vec<usize> = blocks
                .windows(2)
                .filter(|pair| pair[0] + 1 == pair[1])
                .map(|pair| pair[0])
                .collect();
            if pairs.is_empty() {
                return None;
            }
            let line = chance.of(&pairs);
            let mut other = lines.clone();
            other.swap(line, line + 1);
            return Some(Faulty::of(kind, joined(other), vec![line, line + 1]));
        }
        _ => {}
    }
    if let Some(how) = more::of_lines(group, kind) {
        return how(group, &lines, &blocks, chance);
    }
    // Not every block has a place for every fault.
    for _ in 0..40 {
        let line = chance.of(&blocks);
        let changed = in_line(group, kind, lines[line], chance);
        if let Some(changed) = changed.filter(|changed| changed != lines[line]) {
            let mut with: Vec<&str> = lines.clone();
            with[line] = &changed;
            return Some(Faulty::of(kind, with.concat(), vec![line]));
        }
    }
    None
}

fn in_line(group: Group, kind: &str, line: &str, chance: &mut Chance) -> Option<String> {
    match group {
        Group::Iso => iso::in_words(kind, line, chance),
        Group::Compact | Group::Checking => three_b::in_block(kind, line, chance),
    }
}

fn with(line: &str, range: Range<usize>, text: &str) -> String {
    format!("{}{text}{}", &line[..range.start], &line[range.end..])
}

/// A number with one of its digits damaged; `None` where it has none that can be.
fn damaged(number: &str, how: &str, chance: &mut Chance) -> Option<String> {
    let digits: Vec<usize> = number
        .bytes()
        .enumerate()
        .filter(|(_, byte)| byte.is_ascii_digit())
        .map(|(at, _)| at)
        .collect();
    if digits.is_empty() {
        return None;
    }
    let at = chance.of(&digits);
    let mut bytes = number.as_bytes().to_vec();
    match how {
        "digit wrong" => {
            let other = b'0' + (bytes[at] - b'0' + 1 + chance.below(9) as u8) % 10;
            bytes[at] = other;
        }
        "digit lost" => {
            bytes.remove(at);
        }
        "digit doubled" => bytes.insert(at, bytes[at]),
        _ => {
            let next = digits.iter().copied().find(|next| *next > at)?;
            bytes.swap(at, next);
        }
    }
    String::from_utf8(bytes).ok().filter(|text| text != number)
}
