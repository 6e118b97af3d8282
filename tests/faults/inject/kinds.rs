//! The kinds of faults, by their names.

use crate::faults::contours::Group;

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

/// Kinds that `kinds` does not hold, of which a table and the goals for repairs are made: most of them are likely and hard to tell
/// apart from another slip.
pub fn more_kinds(group: Group) -> Vec<&'static str> {
    let mut kinds = vec!["digit lost anywhere", "equal to the former"];
    match group {
        Group::Compact | Group::Checking => kinds.extend([
            "X and J exchanged",
            "Y and J exchanged",
            "arc: digit lost",
            "arc: X and Y exchanged",
        ]),
        Group::Iso => kinds.extend(["arc: digit lost"]),
    }
    kinds.extend(["way in lost", "way out lost", "lead cut short"]);
    kinds.extend(SEVERAL);
    kinds
}

/// More than one slip, or none that anybody has listed.
const SEVERAL: [&str; 4] = [
    "two slips",
    "three slips",
    "an arc lost",
    "numbers at random",
];

/// Whether a kind is one slip of a hand, which a repair should undo.
pub fn is_one_slip(kind: &str) -> bool {
    !SEVERAL.contains(&kind)
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
