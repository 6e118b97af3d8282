//! One fault put into the text of a program, as a hand or a bad line puts them there.

use super::chance::Chance;
use super::contours::Group;
use std::ops::Range;
use wedm::program::three_b::{Fields, Item, Words, fields_of, read_line};

/// A program with one fault.
#[derive(Clone, Debug)]
pub struct Faulty {
    pub kind: &'static str,
    pub text: String,
    /// The lines, from 0, of which each is the right place to say so.
    pub lines: Vec<usize>,
}

/// The kinds of faults of a group, each by its name and how it is put in.
pub fn kinds(group: Group) -> Vec<&'static str> {
    let numbers: &[&str] = match group {
        Group::Compact | Group::Checking => &["X", "Y", "J"],
        Group::Iso => &["X", "Y", "I", "J"],
    };
    let mut kinds = Vec::new();
    for number in numbers {
        for how in [
            "digit wrong",
            "digit lost",
            "digit doubled",
            "digits exchanged",
        ] {
            kinds.push(named(number, how));
        }
    }
    match group {
        Group::Compact | Group::Checking => kinds.extend(THREE_B),
        Group::Iso => kinds.extend(ISO),
    }
    kinds.extend(["block lost", "block twice", "blocks exchanged"]);
    kinds
}

const THREE_B: [&str; 16] = [
    "X and Y exchanged",
    "G wrong",
    "G lost",
    "Z wrong",
    "Z lost",
    "R lost",
    "NR for SR",
    "line for an arc",
    "J off by 5 to 50 um",
    "J off by 10 %",
    "sign",
    "point",
    "comma",
    "O for 0",
    "B lost",
    "word lost",
];

const ISO: [&str; 13] = [
    "X and Y exchanged",
    "I and J exchanged",
    "G wrong",
    "G lost",
    "line for an arc",
    "I or J off by 5 to 50 um",
    "I or J off by 10 %",
    "sign",
    "point",
    "comma",
    "O for 0",
    "letter lost",
    "word lost",
];

fn named(number: &str, how: &str) -> &'static str {
    const ALL: [[&str; 4]; 4] = [
        [
            "X: digit wrong",
            "X: digit lost",
            "X: digit doubled",
            "X: digits exchanged",
        ],
        [
            "Y: digit wrong",
            "Y: digit lost",
            "Y: digit doubled",
            "Y: digits exchanged",
        ],
        [
            "I: digit wrong",
            "I: digit lost",
            "I: digit doubled",
            "I: digits exchanged",
        ],
        [
            "J: digit wrong",
            "J: digit lost",
            "J: digit doubled",
            "J: digits exchanged",
        ],
    ];
    let row = ["X", "Y", "I", "J"]
        .iter()
        .position(|name| *name == number)
        .expect("a number");
    let column = [
        "digit wrong",
        "digit lost",
        "digit doubled",
        "digits exchanged",
    ]
    .iter()
    .position(|name| *name == how)
    .expect("a way");
    ALL[row][column]
}

/// A fault of this kind somewhere in the program; `None` where there is no place for one.
pub fn inject(group: Group, kind: &'static str, text: &str, chance: &mut Chance) -> Option<Faulty> {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let is_block = |line: &str| match group {
        Group::Iso => is_move(line),
        Group::Compact | Group::Checking => block_of(line).is_some(),
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
            return Some(Faulty {
                kind,
                text: joined(kept),
                lines: vec![line.saturating_sub(1), line],
            });
        }
        "block twice" => {
            let line = chance.of(&blocks);
            let mut more = lines.clone();
            more.insert(line, lines[line]);
            return Some(Faulty {
                kind,
                text: joined(more),
                lines: vec![line, line + 1],
            });
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
            return Some(Faulty {
                kind,
                text: joined(other),
                lines: vec![line, line + 1],
            });
        }
        _ => {}
    }
    // Not every block has a place for every fault.
    for _ in 0..40 {
        let line = chance.of(&blocks);
        let changed = match group {
            Group::Iso => in_words(kind, lines[line], chance),
            Group::Compact | Group::Checking => in_block(kind, lines[line], chance),
        };
        if let Some(changed) = changed.filter(|changed| changed != lines[line]) {
            let mut with: Vec<&str> = lines.clone();
            with[line] = &changed;
            return Some(Faulty {
                kind,
                text: with.concat(),
                lines: vec![line],
            });
        }
    }
    None
}

fn block_of(line: &str) -> Option<Fields> {
    let mut found = None;
    read_line(line.as_bytes(), 1, &Words::default(), |item| {
        if let Item::Block { range, .. } = item {
            found = Some(range.start - 1..range.end - 1);
        }
    });
    fields_of(line.as_bytes(), found?)
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

/// A 3B block with a fault.
fn in_block(kind: &str, line: &str, chance: &mut Chance) -> Option<String> {
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
    let changed = match kind {
        "X and Y exchanged" => {
            let swapped = format!(
                "{}{}{}",
                of(&fields.y),
                &line[fields.x.end..fields.y.start],
                of(&fields.x)
            );
            with(line, fields.x.start..fields.y.end, &swapped)
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
        "R lost" if name.ends_with('R') => {
            with(line, fields.motion.start + 1..fields.motion.start + 2, "")
        }
        "NR for SR" if name.ends_with('R') => with(
            line,
            fields.motion.start..fields.motion.start + 1,
            if name.starts_with('N') { "S" } else { "N" },
        ),
        "line for an arc" if name.ends_with('R') => {
            with(line, fields.motion.clone(), &format!("L{quadrant}"))
        }
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

/// The words of an ISO line: letter, and the bytes of the number behind it. Comments are left out.
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
fn is_move(line: &str) -> bool {
    let words = words(line);
    let has = |letters: &[char]| words.iter().any(|(letter, _)| letters.contains(letter));
    let is_setting = words.iter().any(|(letter, number)| {
        *letter == 'G' && line[number.clone()].trim_start_matches('0') == "92"
    });
    has(&['X', 'Y', 'I', 'J']) && !is_setting
}

/// An ISO line with a fault.
fn in_words(kind: &str, line: &str, chance: &mut Chance) -> Option<String> {
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
