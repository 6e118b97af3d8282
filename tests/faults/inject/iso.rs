//! Faults in an ISO line.

use super::{damaged, with};
use crate::faults::chance::Chance;
use std::ops::Range;

/// The words of an ISO line: letter, and the bytes of the number after it. Comments are left out.
fn words(line: &str) -> Vec<(char, Range<usize>)> {
    let bytes = line.as_bytes();
    let mut words = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        match bytes[at] {
            b'(' => at += line[at..].find(')').map_or(line.len(), |end| end + 1),
            b';' => break,
            letter if letter.is_ascii_alphabetic() => {
                let start = at + 1;
                let is_part =
                    |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+');
                let length = bytes[start..]
                    .iter()
                    .take_while(|byte| is_part(byte))
                    .count();
                words.push((letter as char, start..start + length));
                at = start + length;
            }
            _ => at += 1,
        }
    }
    words
}

/// A line that moves the wire.
pub(super) fn is_move(line: &str) -> bool {
    let words = words(line);
    let has = |letters: &[char]| words.iter().any(|(letter, _)| letters.contains(letter));
    let is_setting = words.iter().any(|(letter, number)| {
        *letter == 'G' && line[number.clone()].trim_start_matches('0') == "92"
    });
    has(&['X', 'Y', 'I', 'J']) && !is_setting
}

/// Whether a line has a centre or a radius.
pub(super) fn is_arc(line: &str) -> bool {
    words(line)
        .iter()
        .any(|(letter, _)| "IJR".contains(*letter))
}

/// A line with a coordinate of the one before: none of its own differs then.
pub(super) fn equal_to(line: &str, before: &str) -> Option<String> {
    let (own, its) = (words(line), words(before));
    let number = |text: &str, (letter, range): &(char, Range<usize>)| {
        (*letter, text[range.clone()].to_owned())
    };
    let is_same_shape = own.len() == its.len() && own.iter().zip(&its).all(|(a, b)| a.0 == b.0);
    let others: Vec<usize> = (0..own.len().min(its.len()))
        .filter(|&at| own[at].0 != 'N' && number(line, &own[at]) != number(before, &its[at]))
        .collect();
    match &others[..] {
        &[at] if is_same_shape && "XY".contains(own[at].0) => {
            Some(with(line, own[at].1.clone(), &before[its[at].1.clone()]))
        }
        _ => None,
    }
}

/// An ISO line with a fault.
pub(super) fn in_words(kind: &str, line: &str, chance: &mut Chance) -> Option<String> {
    let words = words(line);
    let word = |letter: char| {
        words
            .iter()
            .find(|(own, _)| *own == letter)
            .map(|(_, number)| number.clone())
    };
    if let Some((name, how)) = kind.split_once(": ") {
        let range = word(name.chars().next()?)?;
        return Some(with(
            line,
            range.clone(),
            &damaged(&line[range], how, chance)?,
        ));
    }
    let coordinates: Vec<&(char, Range<usize>)> = words
        .iter()
        .filter(|(letter, _)| "XYIJ".contains(*letter))
        .collect();
    let any = if coordinates.is_empty() {
        return None;
    } else {
        chance.of(&coordinates)
    };
    let any_range = any.1.clone();
    let swapped = |one: Range<usize>, other: Range<usize>| {
        let (one, other) = if one.start < other.start {
            (one, other)
        } else {
            (other, one)
        };
        let text = format!(
            "{}{}{}",
            &line[other.clone()],
            &line[one.end..other.start],
            &line[one.clone()]
        );
        with(line, one.start..other.end, &text)
    };
    let motion = words.iter().find(|(letter, number)| {
        *letter == 'G'
            && matches!(
                line[number.clone()].trim_start_matches('0'),
                "" | "1" | "2" | "3"
            )
    });
    let is_arc = word('I').is_some() || word('J').is_some();
    let changed = match kind {
        "arc: digit lost" if !is_arc => return None,
        "digit lost anywhere" | "arc: digit lost" => {
            let lost = damaged(&line[any_range.clone()], "digit lost", chance)?;
            with(line, any_range, &lost)
        }
        "lead cut short" => {
            let text = &line[any_range.clone()];
            let decimals = text.split_once('.').map_or(0, |(_, places)| places.len());
            let value: f64 = text.parse().ok()?;
            let short = value * (0.3 + 0.5 * chance.share());
            with(line, any_range, &format!("{short:.decimals$}"))
        }
        "numbers at random" => {
            let mut made = line.to_owned();
            for (letter, range) in words.iter().rev() {
                if "XYIJ".contains(*letter) {
                    let text = &line[range.clone()];
                    let point = text.find('.');
                    let number = format!("{}", chance.below(20_000));
                    let number = match point {
                        Some(_) => format!("{}.{}", number, chance.below(1000)),
                        None => number,
                    };
                    made = with(&made, range.clone(), &number);
                }
            }
            made
        }
        "X and Y exchanged" => swapped(word('X')?, word('Y')?),
        "I and J exchanged" => swapped(word('I')?, word('J')?),
        "G wrong" if is_arc => {
            let number = motion?.1.clone();
            let other = if line[number.clone()].ends_with('2') {
                "03"
            } else {
                "02"
            };
            with(line, number, other)
        }
        "G lost" => {
            let number = motion?.1.clone();
            with(line, number.start - 1..number.end, "")
        }
        "line for an arc" if is_arc => with(line, motion?.1.clone(), "01"),
        "I or J off by 5 to 50 um" | "I or J off by 10 %" => {
            let range = word(chance.of(&['I', 'J']))?;
            let text = &line[range.clone()];
            let decimals = text.split_once('.').map(|(_, places)| places.len());
            let value: f64 = text.parse().ok()?;
            let um = if decimals.is_some() { 0.001 } else { 1.0 };
            let value = if kind.ends_with('%') {
                value * chance.of(&[0.9, 1.1])
            } else {
                value + (5.0 + chance.share() * 45.0).round() * um * chance.of(&[-1.0, 1.0])
            };
            with(line, range, &format!("{value:.*}", decimals.unwrap_or(0)))
        }
        "sign" => {
            let text = &line[any_range.clone()];
            let other = text
                .strip_prefix('-')
                .map_or_else(|| format!("-{text}"), str::to_owned);
            with(line, any_range, &other)
        }
        "point" => {
            let text = &line[any_range.clone()];
            // Lost where it has one, else put in somewhere.
            let other = match text.find('.') {
                Some(_) => text.replace('.', ""),
                None if text.len() > 2 => {
                    format!("{}.{}", &text[..text.len() - 1], &text[text.len() - 1..])
                }
                None => return None,
            };
            with(line, any_range, &other)
        }
        "comma" => {
            let text = &line[any_range.clone()];
            text.find('.')?;
            with(line, any_range.clone(), &text.replace('.', ","))
        }
        "O for 0" => {
            let zeros: Vec<usize> = any_range
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
        "letter lost" => with(line, any_range.start - 1..any_range.start, ""),
        "word lost" => with(line, any_range.start - 1..any_range.end, ""),
        _ => return None,
    };
    Some(changed)
}
