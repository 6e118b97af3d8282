//! One slip in the moves of a path, the same whatever the language.

use super::written::Move;
use crate::faults::chance::Chance;

pub const SLIPS: [&str; 8] = [
    "sound",
    "block twice",
    "block lost",
    "digit wrong",
    "digit lost",
    "sign",
    "blocks exchanged",
    "arc turned",
];

/// The path with this slip somewhere; `None` where it has no place for it.
pub fn slipped(slip: &str, cuts: &[Vec<Move>], chance: &mut Chance) -> Option<Vec<Vec<Move>>> {
    let mut cuts = cuts.to_vec();
    let cut = chance.below(cuts.len());
    let moves = &mut cuts[cut];
    let at = 1 + chance.below(moves.len() - 2);
    match slip {
        "sound" => {}
        "block twice" => moves.insert(at, moves[at]),
        "block lost" => drop(moves.remove(at)),
        "blocks exchanged" => {
            if at + 2 >= moves.len() || moves[at] == moves[at + 1] {
                return None;
            }
            moves.swap(at, at + 1);
        }
        "arc turned" => {
            let at = (0..moves.len()).find(|at| moves[*at].arc.is_some())?;
            let (center, is_left) = moves[at].arc?;
            moves[at].arc = Some((center, !is_left));
        }
        // The one number of a line along an axis, or that of a slanted one which 3B does not count.
        "digit wrong" | "digit lost" | "sign" => {
            let is_line = |at: &usize| moves[*at].arc.is_none();
            let lines: Vec<usize> = (1..moves.len() - 1).filter(is_line).collect();
            if lines.is_empty() {
                return None;
            }
            let at = chance.of(&lines);
            let [x, y] = moves[at].by;
            let axis = match (x, y) {
                (_, 0) => 0,
                (0, _) => 1,
                (x, y) => usize::from(x.abs() > y.abs()),
            };
            let number = moves[at].by[axis];
            let changed = match slip {
                "sign" => -number,
                _ => number.signum() * damaged(number.abs(), slip, chance),
            };
            if changed == number || changed == 0 {
                return None;
            }
            moves[at].by[axis] = changed;
            let [x, y] = moves[at].by;
            // In 3B the larger one is counted, and would be another number.
            let is_still_counted =
                x == 0 || y == 0 || moves[at].by[axis].abs() < moves[at].by[1 - axis].abs();
            if !is_still_counted {
                return None;
            }
        }
        _ => return None,
    }
    Some(cuts)
}

/// A number with one of its digits lost or another one.
fn damaged(number: i64, slip: &str, chance: &mut Chance) -> i64 {
    let mut digits = number.to_string().into_bytes();
    let at = chance.below(digits.len());
    if slip == "digit lost" {
        digits.remove(at);
    } else {
        digits[at] = b'0' + (digits[at] - b'0' + 1 + chance.below(9) as u8) % 10;
    }
    String::from_utf8(digits)
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(0)
}
