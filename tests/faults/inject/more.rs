//! Faults that reach over a line: leads, a block typed again, several slips at once.

use super::{Faulty, in_line, iso, kinds, three_b};
use crate::faults::chance::Chance;
use crate::faults::contours::Group;

type How = fn(Group, &[&str], &[usize], &mut Chance) -> Option<Faulty>;

/// How a kind of this file is put in; `None` for the others.
pub(super) fn of_lines(_: Group, kind: &str) -> Option<How> {
    let how: How = match kind {
        "way in lost" => |group, lines, blocks, chance| {
            let (first, _) = chance.of(&contours(group, lines, blocks));
            without("way in lost", lines, first)
        },
        "way out lost" => |group, lines, blocks, chance| {
            let (_, last) = chance.of(&contours(group, lines, blocks));
            without("way out lost", lines, last)
        },
        "lead cut short" => |group, lines, blocks, chance| {
            let (first, last) = chance.of(&contours(group, lines, blocks));
            changed(
                group,
                "lead cut short",
                "lead cut short",
                lines,
                &[first, last],
                1,
                chance,
            )
        },
        "equal to the former" => equal_to_the_former,
        "an arc lost" => |group, lines, blocks, chance| {
            let arcs: Vec<usize> = blocks
                .iter()
                .copied()
                .filter(|&line| is_arc(group, lines[line]))
                .collect();
            match arcs.is_empty() {
                true => None,
                false => without("an arc lost", lines, chance.of(&arcs)),
            }
        },
        "two slips" => {
            |group, lines, blocks, chance| changed(group, "two slips", "", lines, blocks, 2, chance)
        }
        "three slips" => |group, lines, blocks, chance| {
            changed(group, "three slips", "", lines, blocks, 3, chance)
        },
        _ => return None,
    };
    Some(how)
}

fn is_arc(group: Group, line: &str) -> bool {
    match group {
        Group::Iso => iso::is_arc(line),
        Group::Compact | Group::Checking => three_b::is_arc(line),
    }
}

/// The first and the last block between two stops.
fn contours(group: Group, lines: &[&str], blocks: &[usize]) -> Vec<(usize, usize)> {
    let is_stop = |line: &&str| match group {
        Group::Iso => line.contains("M00") || line.contains("G00") || line.contains("G0 "),
        Group::Compact | Group::Checking => line.trim_start().starts_with(['D', 'A']),
    };
    let mut found: Vec<(usize, usize)> = Vec::new();
    for &block in blocks {
        match found.last_mut() {
            Some((_, last)) if !lines[*last + 1..block].iter().any(is_stop) => *last = block,
            _ => found.push((block, block)),
        }
    }
    found.retain(|(first, last)| last - first > 2);
    match found.is_empty() {
        true => blocks
            .first()
            .zip(blocks.last())
            .map(|(a, b)| (*a, *b))
            .into_iter()
            .collect(),
        false => found,
    }
}

fn without(kind: &'static str, lines: &[&str], line: usize) -> Option<Faulty> {
    let mut kept = lines.to_vec();
    kept.remove(line);
    let places = vec![line.saturating_sub(1), line];
    Some(Faulty::of(kind, kept.concat(), places))
}

fn equal_to_the_former(
    group: Group,
    lines: &[&str],
    blocks: &[usize],
    chance: &mut Chance,
) -> Option<Faulty> {
    for _ in 0..40 {
        let line = chance.of(blocks);
        let Some(before) = line.checked_sub(1).filter(|before| blocks.contains(before)) else {
            continue;
        };
        let other = match group {
            Group::Iso => iso::equal_to(lines[line], lines[before]),
            Group::Compact | Group::Checking => three_b::with_block_of(lines[line], lines[before]),
        };
        if let Some(other) = other.filter(|other| other != lines[line]) {
            let mut with = lines.to_vec();
            with[line] = &other;
            let places = vec![before, line];
            return Some(Faulty::of("equal to the former", with.concat(), places));
        }
    }
    None
}

/// So many of some lines with a fault each, of any kind where none is given.
fn changed(
    group: Group,
    kind: &'static str,
    how: &'static str,
    lines: &[&str],
    of: &[usize],
    count: usize,
    chance: &mut Chance,
) -> Option<Faulty> {
    let mut slips: Vec<(usize, String)> = Vec::new();
    for _ in 0..80 {
        let line = chance.of(of);
        let own = match how {
            "" => chance.of(&kinds(group)),
            how => how,
        };
        let other = in_line(group, own, lines[line], chance);
        let is_free = slips.iter().all(|(known, _)| *known != line);
        if let Some(other) = other.filter(|other| other != lines[line] && is_free) {
            slips.push((line, other));
            if slips.len() == count {
                break;
            }
        }
    }
    let text = |which: usize| {
        let mut with = lines.to_vec();
        for (nth, (line, other)) in slips.iter().enumerate() {
            if which & (1 << nth) != 0 {
                with[*line] = other;
            }
        }
        with.concat()
    };
    let all = (1 << count) - 1;
    (slips.len() == count).then(|| Faulty {
        between: (1..all).map(text).collect(),
        ..Faulty::of(
            kind,
            text(all),
            slips.iter().map(|(line, _)| *line).collect(),
        )
    })
}
