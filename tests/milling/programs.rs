//! The programs: layers, heights and feeds, milled in a model.

use super::*;
use crate::size::by_day;

/// One move: from and to `[x, y, z]` in mm, centre of an arc, whether it is a rapid.
#[derive(Debug)]
pub(super) struct Move {
    pub(super) from: [f64; 3],
    pub(super) to: [f64; 3],
    /// The centre of an arc, and 1 where it turns left, −1 where right.
    pub(super) center: Option<([f64; 2], f64)>,
    is_rapid: bool,
}

impl Move {
    pub(super) fn is_level(&self) -> bool {
        self.from[2] == self.to[2]
    }

    /// Where it goes at its beginning or its end.
    fn direction(&self, at: [f64; 3]) -> [f64; 2] {
        let [dx, dy] = match self.center {
            None => [0, 1].map(|axis| self.to[axis] - self.from[axis]),
            Some(([x, y], turn)) => [-turn * (at[1] - y), turn * (at[0] - x)],
        };
        let length = dx.hypot(dy);
        [dx / length, dy / length]
    }

    /// It goes back along the one before.
    fn goes_back(&self, before: &Move) -> bool {
        let [one, other] = [before.direction(before.to), self.direction(self.from)];
        one[0] * other[0] + one[1] * other[1] < -0.9
    }

    /// Length in the plane.
    pub(super) fn length(&self) -> f64 {
        let [dx, dy] = [0, 1].map(|axis| self.to[axis] - self.from[axis]);
        let chord = dx.hypot(dy);
        match self.center {
            None => chord,
            Some(([x, y], _)) => {
                let radius = (self.from[0] - x).hypot(self.from[1] - y);
                2.0 * radius * (chord / 2.0 / radius).min(1.0).asin()
            }
        }
    }
}

/// A control of our own, for the words that are written here: arcs of at most a half turn.
pub(super) fn run(text: &str, unit: f64) -> Vec<Move> {
    let (mut at, mut motion, mut incremental) = ([0.0; 3], 0, false);
    let mut moves = Vec::new();
    for line in text.lines() {
        let mut words = Vec::new();
        for word in line.split_whitespace().filter(|word| *word != "%") {
            let (letter, number) = word.split_at(1);
            words.push((letter.to_owned(), number.parse::<f64>().expect(word)));
        }
        let of = |wanted: &str| {
            words
                .iter()
                .find(|(letter, _)| letter == wanted)
                .map(|(_, number)| *number)
        };
        let mut sets = false;
        for (letter, number) in &words {
            match (letter.as_str(), *number as u32) {
                ("G", 0..=3) => motion = *number as u32,
                ("G", 90) => incremental = false,
                ("G", 91) => incremental = true,
                ("G", 92) => sets = true,
                _ => {}
            }
        }
        let mut to = at;
        for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
            if let Some(number) = of(letter).map(|number| number * unit) {
                to[axis] = if incremental && !sets {
                    at[axis] + number
                } else {
                    number
                };
            }
        }
        if !sets && to != at {
            let center = (motion > 1).then(|| {
                let [i, j] = ["I", "J"].map(|letter| of(letter).unwrap_or(0.0) * unit);
                let turn = if motion == 3 { 1.0 } else { -1.0 };
                ([at[0] + i, at[1] + j], turn)
            });
            moves.push(Move {
                from: at,
                to,
                center,
                is_rapid: motion == 0,
            });
        }
        at = to;
    }
    moves
}

/// The mean depth that moves along one contour leave: small steps of the way, each eroded at once down to where the tip then is.
fn eroded(moves: &[Move], length: f64, [diameter, gap, wear]: [f64; 3]) -> f64 {
    const CELLS: usize = 500;
    let area = std::f64::consts::PI * diameter * diameter / 4.0;
    let lost = wear * (diameter + 2.0 * gap) * length / CELLS as f64 / area;
    let mut cells = [0.0_f64; CELLS];
    let (mut worn, mut at, mut forward) = (0.0, 0.0_f64, true);
    let mut before: Option<&Move> = None;
    for step in moves.iter().filter(|step| step.is_level()) {
        if before.is_some_and(|before| step.goes_back(before)) {
            at = if forward { length } else { 0.0 };
            forward = !forward;
        }
        before = Some(step);
        let to = if forward {
            at + step.length()
        } else {
            at - step.length()
        };
        let index = |at: f64| ((at / length * CELLS as f64).round() as usize).min(CELLS);
        let (from, end) = (index(at), index(to.max(0.0)));
        let visit: Vec<usize> = match forward {
            true => (from..end).collect(),
            false => (end..from).rev().collect(),
        };
        for cell in visit {
            // The tip is at the floor when lost · (its way down) has been worn.
            let left = (-step.to[2] - worn - cells[cell]).max(0.0) / (1.0 + lost / 2.0);
            cells[cell] += left;
            worn += lost * left;
        }
        at = to;
    }
    cells.iter().sum::<f64>() / CELLS as f64
}

/// Checks of a program whatever it mills: read again without a finding, at most a rounding beside path and feeds, deep as it says.
fn hold(made: &Generated, text: &str) {
    let program = &made.program;
    let read = wedm::program::Document::read(
        Language::Iso,
        program.text.clone().into_bytes(),
        &settings(text),
    );
    let found = read.findings(&settings(text), usize::MAX).0;
    assert_eq!(found, [], "{}", program.text);
    let milled = program.milled.as_ref().expect("milled");
    let moves = run(&program.text, 1.0);
    assert_eq!(moves.len(), program.blocks);
    // It goes over the surface alone from one contour to the next, and comes up at the end.
    for step in &moves {
        assert!(
            step.is_level() || step.from[..2] == step.to[..2],
            "{step:?}"
        );
        assert!(!step.is_rapid || step.to[2] > 0.0, "{step:?}");
        assert!(step.is_rapid || step.to[2] < 0.0, "{step:?}");
    }
    assert!(moves.last().is_some_and(|step| step.to[2] > 0.0));
    let electrode = &milled.electrode;
    let mut contours = moves
        .split(|step| step.is_rapid)
        .filter(|cut| !cut.is_empty());
    for (number, contour) in milled.contours.iter().enumerate() {
        let cut = contours.next().expect("a contour");
        let along: f64 = cut.iter().map(Move::length).sum();
        let expected = contour.length * electrode.layers() as f64;
        assert!(
            (along - expected).abs() < 2e-3 * cut.len() as f64,
            "{along} {expected}"
        );
        let deepest = cut.last().expect("a move").to[2];
        assert!(
            (deepest + contour.fed).abs() <= 5.1e-4,
            "{deepest} {}",
            contour.fed
        );
        let [mean, least, most] = contour.floor;
        assert!(least <= mean && mean <= most);
        // Round ends wear it, too, and it is worn already along the others.
        if number == 0 && !electrode.slot_ends {
            let own = eroded(
                cut,
                contour.length,
                [electrode.diameter, electrode.gap, electrode.wear],
            );
            assert!((own - mean).abs() < 1e-3, "{own} {mean}");
        }
    }
    assert!(contours.next().is_none());
}

#[test]
fn published_cases_come_out_of_a_drawing() {
    let row_2 = "side = \"opening\"\n[milling]\ntool-diameter = 0.5\ngap = 0.02\nlayer = 0.005\ndepth = 0.2\nwear = 0.1\n";
    let ring = ring(1.27);
    for (contours, text, layers, wear, feed, depths) in [
        (
            vec![(false, SLOT)],
            ELECTRODE,
            20,
            0.280113,
            12.8011,
            [0.1570, 0.2010, 0.1999],
        ),
        (
            vec![(true, &ring[..])],
            row_2,
            40,
            1.7280,
            13.6400,
            [0.0737, 0.2010, 0.1999],
        ),
    ] {
        let drawing = drawing(&contours);
        for (way, depth) in ["none", "uniform", "linear"].into_iter().zip(depths) {
            let text = format!("{text}wear-compensation = \"{way}\"\nstep = 0.5\n");
            let made = milled(&drawing, &text);
            hold(&made, &text);
            assert_eq!(made.holes, []);
            let milled = made.program.milled.as_ref().expect("milled");
            let [contour] = &milled.contours[..] else {
                panic!("{milled:?}")
            };
            assert_eq!(milled.electrode.layers(), layers);
            assert!((contour.wear_of_layer - wear).abs() < 6e-5, "{contour:?}");
            if way == "uniform" {
                assert!((contour.feed * 1e3 - feed).abs() < 2e-4, "{contour:?}");
            }
            assert!((contour.floor[0] - depth).abs() < 7e-5, "{way} {contour:?}");
            // An electrode that wears more than a layer in each leaves an uneven floor.
            let warned = made
                .warnings
                .iter()
                .filter(|one| one.rule == Rule::Settings);
            assert_eq!(warned.count(), usize::from(wear > 1.0));
        }
    }
}

#[test]
fn the_program_of_a_slot_stands_as_it_is() {
    let text = "[milling]\ntool-diameter = 1\ngap = 0\nlayer = 0.1\ndepth = 0.25\nwear = 0\n";
    let made = milled(&drawing(&[(false, SLOT)]), text);
    let expected = "%\nG21\nG90\nG92 X0.000 Y0.000\nG00 Z1.000\nG01 Z-0.100\nG01 X10.000 Y0.000\nG01 Z-0.200\nG01 X0.000 Y0.000\nG01 Z-0.250\nG01 X10.000 Y0.000\nG00 Z1.000\nM02\n%\n";
    assert_eq!(made.program.text, expected);
    assert_eq!(made.program.blocks, 8);
    hold(&made, text);
}

/// Closed contours are gone along beside their line, the one way round and the other; open ones along it.
#[test]
fn pockets_and_slots_of_one_drawing_are_milled_one_after_the_other() {
    let pocket: &[[f64; 3]] = &[
        [20.0, 0.0, 0.0],
        [40.0, 0.0, 0.0],
        [40.0, 10.0, 0.0],
        [20.0, 10.0, 0.0],
    ];
    let bent: &[[f64; 3]] = &[
        [50.0, 0.0, 0.0],
        [53.0, 0.0, 0.5],
        [53.0, 4.0, 0.0],
        [51.0, 4.0, 0.0],
    ];
    let drawing = drawing(&[(false, SLOT), (true, pocket), (false, bent)]);
    for (way, profile) in [
        ("uniform", "generic"),
        ("linear", "generic"),
        ("none", "generic"),
    ] {
        let text = format!(
            "program.profile = \"{profile}\"\n{ELECTRODE}wear-compensation = \"{way}\"\nstep = 0.7\nslot-ends = true\n"
        );
        let made = milled(&drawing, &text);
        hold(&made, &text);
        assert_eq!(made.contours, 3);
        let moves = run(&made.program.text, 1.0);
        let beside = |step: &&Move| !step.is_rapid && step.from[0] > 15.0 && step.from[0] < 45.0;
        let mut turns = Vec::new();
        for step in moves.iter().filter(beside) {
            for [x, y, _] in [step.from, step.to] {
                let inside = (x - 20.0).min(40.0 - x).min(y).min(10.0 - y);
                assert!((inside - 0.55).abs() < 1e-3, "{step:?}");
            }
            let [[x, y, _], [x1, y1, _]] = [step.from, step.to];
            if step.is_level() && step.length() > 0.1 {
                turns.push(((x - 30.0) * (y1 - 5.0) - (x1 - 30.0) * (y - 5.0)).signum());
            }
        }
        turns.dedup();
        assert_eq!(turns.len(), 20, "to and fro in each layer");
        let milled = made.program.milled.as_ref().expect("milled");
        let lengths: Vec<f64> = milled.contours.iter().map(|one| one.length).collect();
        let expected = [10.0, 2.0 * (18.9 + 8.9), 5.0 + 2.5 * 4.0 * 0.5_f64.atan()];
        // What lies within others comes first; nothing does here.
        for (found, expected) in lengths.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{lengths:?}");
        }
        if way != "none" {
            for one in &milled.contours {
                assert!((one.floor[0] - 0.2).abs() < 0.01, "{way}: {one:?}");
            }
        }
    }
}

#[test]
fn every_profile_writes_heights_as_it_writes_lengths() {
    let drawing = drawing(&[
        (false, &[[3.0, 4.0, 0.0], [13.0, 4.0, 0.0]]),
        (false, &[[3.0, 9.0, 0.0], [13.0, 9.0, 0.0]]),
    ]);
    let mut deepest = Vec::new();
    for (profile, unit) in [("generic", 1.0), ("robofil", 1.0), ("fast-wire", 1e-3)] {
        let text = format!("program.profile = \"{profile}\"\n{ELECTRODE}");
        let made = milled(&drawing, &text);
        let moves = run(&made.program.text, unit);
        assert_eq!(moves.len(), made.program.blocks, "{profile}");
        let depths: Vec<i64> = moves
            .iter()
            .map(|step| (step.to[2] * 1e3).round() as i64)
            .collect();
        deepest.push(depths);
        let read = wedm::program::Document::read(
            Language::Iso,
            made.program.text.clone().into_bytes(),
            &settings(&text),
        );
        assert_eq!(
            read.findings(&settings(&text), 9).0,
            [],
            "{}",
            made.program.text
        );
    }
    assert_eq!(deepest[0], deepest[1]);
    assert_eq!(deepest[0], deepest[2]);
}

#[test]
fn other_electrodes_come_out_by_the_same_formulas() {
    let mut seed = 7_u64;
    let mut chance = move |least: f64, most: f64| {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        least + (most - least) * ((seed >> 40) as f64 / (1_u64 << 24) as f64)
    };
    for number in 0..by_day(6, 24) {
        let [diameter, gap] = [chance(0.3, 3.0), chance(0.0, 0.1)];
        let [layer, wear] = [chance(0.004, 0.05), chance(0.0, 0.05)];
        let (length, count) = (chance(2.0, 40.0), chance(3.0, 30.0).floor());
        let way = ["uniform", "linear"][number % 2];
        let text = format!(
            "[milling]\ntool-diameter = {diameter}\ngap = {gap}\nlayer = {layer}\ndepth = {}\nwear = {wear}\nwear-compensation = \"{way}\"\nstep = 0.25\n",
            layer * count
        );
        let slot = [[0.0, 0.0, 0.0], [length * 0.6, length * 0.8, 0.0]];
        let made = milled(&drawing(&[(false, &slot)]), &text);
        hold(&made, &text);
        let one = made.program.milled.as_ref().expect("milled").contours[0];
        let width = diameter + 2.0 * gap;
        let area = std::f64::consts::PI * diameter * diameter / 4.0;
        let wear_of_layer = wear * width * length / area;
        assert!((one.wear_of_layer - wear_of_layer).abs() < 1e-9, "{text}");
        let expected = match way {
            "uniform" => layer * (1.0 + wear_of_layer),
            _ => layer,
        };
        assert!((one.feed - expected).abs() < 1e-9, "{text}");
        // Linear compensation comes as near as a step; the uniform one has half a layer's wear too much at most.
        let near = layer * (0.02 + wear_of_layer);
        assert!(
            (one.floor[0] - layer * count).abs() < near,
            "{text}: {one:?}"
        );
    }
}
