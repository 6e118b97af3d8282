//! Faults in a 3B block.

use super::{damaged, with};
use crate::faults::chance::Chance;
use std::ops::Range;
use wedm::program::three_b::{Fields, Item, Words, fields_of, read_line};

pub(super) fn block_of(line: &str) -> Option<Fields> {
    let mut found = None;
    read_line(line.as_bytes(), 1, &Words::default(), |item| {
        if let Item::Block { range, .. } = item {
            found = Some(range.start - 1..range.end - 1);
        }
    });
    fields_of(line.as_bytes(), found?)
}

/// Whether a line is an arc.
pub(super) fn is_arc(line: &str) -> bool {
    block_of(line).is_some_and(|fields| line[fields.motion].contains(['R', 'r']))
}

/// A line with the block of another one.
pub(super) fn with_block_of(line: &str, other: &str) -> Option<String> {
    let range = |line: &str| Some(block_of(line)?.x.start..block_of(line)?.motion.end);
    Some(with(line, range(line)?, &other[range(other)?]))
}

/// A 3B block with a fault.
pub(super) fn in_block(kind: &str, line: &str, chance: &mut Chance) -> Option<String> {
    let fields = block_of(line)?;
    let of = |range: &Range<usize>| &line[range.clone()];
    let number = |name: &str| match name {
        "X" => fields.x.clone(),
        "Y" => fields.y.clone(),
        _ => fields.j.clone(),
    };
    if let Some((name, how)) = kind.split_once(": ") {
        let range = number(name);
        return Some(with(
            line,
            range.clone(),
            &damaged(of(&range), how, chance)?,
        ));
    }
    let any = number(chance.of(&["X", "Y", "J"]));
    let motion = of(&fields.motion).to_owned();
    let (name, quadrant) = motion.split_at(motion.len() - 1);
    let quadrant: usize = quadrant.parse().ok()?;
    let j: f64 = of(&fields.j).parse().ok()?;
    let is_arc = name.ends_with('R');
    let swapped = |one: &Range<usize>, other: &Range<usize>| {
        let swapped = format!("{}{}{}", of(other), &line[one.end..other.start], of(one));
        with(line, one.start..other.end, &swapped)
    };
    let changed = match kind {
        "arc: X and Y exchanged" if !is_arc => return None,
        "X and Y exchanged" | "arc: X and Y exchanged" => swapped(&fields.x, &fields.y),
        "X and J exchanged" => swapped(&fields.x, &fields.j),
        "Y and J exchanged" => swapped(&fields.y, &fields.j),
        "arc: digit lost" if !is_arc => return None,
        "digit lost anywhere" | "arc: digit lost" => {
            with(line, any.clone(), &damaged(of(&any), "digit lost", chance)?)
        }
        "lead cut short" => {
            let numbers = [&fields.x, &fields.y, &fields.j].map(|range| of(range).parse::<i64>());
            let [Ok(x), Ok(y), Ok(j)] = numbers else {
                return None;
            };
            // Along an axis both of its numbers are shorter.
            if is_arc || (x != 0 && y != 0) || x.max(y) != j {
                return None;
            }
            let short = (j as f64 * (0.3 + 0.5 * chance.share())).round() as i64;
            let [x, y] = [x, y].map(|own| if own == 0 { 0 } else { short });
            let mut made = with(line, fields.j.clone(), &short.to_string());
            made = with(&made, fields.y.clone(), &y.to_string());
            with(&made, fields.x.clone(), &x.to_string())
        }
        "numbers at random" => {
            let number = |chance: &mut Chance| (chance.below(20_000)).to_string();
            let mut made = with(line, fields.j.clone(), &number(chance));
            made = with(&made, fields.y.clone(), &number(chance));
            with(&made, fields.x.clone(), &number(chance))
        }
        "G wrong" => {
            let other = if of(&fields.axis).ends_with(['X', 'x']) {
                "GY"
            } else {
                "GX"
            };
            with(line, fields.axis.clone(), other)
        }
        "G lost" => {
            let Range { start, end } = fields.axis.clone();
            let gone = chance.of(&[(start, start + 1), (end - 1, end), (start, end)]);
            with(line, gone.0..gone.1, "")
        }
        "Z wrong" => with(
            line,
            fields.motion.end - 1..fields.motion.end,
            &format!("{}", (quadrant + chance.below(3)) % 4 + 1),
        ),
        "Z lost" => {
            let gone = if chance.one_in(2) {
                fields.motion.start
            } else {
                fields.motion.end - 1
            };
            with(line, gone..fields.motion.end, "")
        }
        "R lost" if is_arc => with(line, fields.motion.start + 1..fields.motion.start + 2, ""),
        "NR for SR" if is_arc => with(
            line,
            fields.motion.start..fields.motion.start + 1,
            if name.starts_with('N') { "S" } else { "N" },
        ),
        "line for an arc" if is_arc => with(line, fields.motion.clone(), &format!("L{quadrant}")),
        "line for an arc" => with(
            line,
            fields.motion.clone(),
            &format!("{}{quadrant}", chance.of(&["NR", "SR"])),
        ),
        "J off by 5 to 50 um" => {
            let off = (5.0 + chance.share() * 45.0).round() * chance.of(&[-1.0, 1.0]);
            with(line, fields.j.clone(), &format!("{}", (j + off).max(1.0)))
        }
        "J off by 10 %" => with(
            line,
            fields.j.clone(),
            &format!("{}", (j * chance.of(&[0.9, 1.1])).round()),
        ),
        "sign" if !any.is_empty() => with(line, any.start..any.start, "-"),
        "point" if any.len() > 1 => {
            let at = any.start + 1 + chance.below(any.len() - 1);
            with(line, at..at, ".")
        }
        "comma" if any.len() > 1 => {
            let at = any.start + 1 + chance.below(any.len() - 1);
            with(line, at..at, ",")
        }
        "O for 0" => {
            let zeros: Vec<usize> = any
                .clone()
                .filter(|at| line.as_bytes()[*at] == b'0')
                .collect();
            let at = if zeros.is_empty() {
                return None;
            } else {
                chance.of(&zeros)
            };
            with(line, at..at + 1, "O")
        }
        "B lost" => {
            let b = line[..any.start].rfind(['B', 'b'])?;
            with(line, b..b + 1, "")
        }
        "word lost" => match chance.below(5) {
            3 => with(line, fields.axis.clone(), ""),
            4 => with(line, fields.motion.clone(), ""),
            _ => {
                let b = line[..any.start].rfind(['B', 'b'])?;
                with(line, b..any.end, "")
            }
        },
        _ => return None,
    };
    Some(changed)
}
