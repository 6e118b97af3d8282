//! Milling by an electrode that wears: the program as a control runs it, held against path, feeds and a simulation of our own.

#[path = "support/generate.rs"]
mod support;

use std::sync::Arc;
use support::generate;
use wedm::beside::{Traced, compare};
use wedm::document::{Document, Source};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Role, Unit, Vertex};
use wedm::finding::{Finding, Rule, Severity};
use wedm::job::{Generated, Refusal};
use wedm::program::{Format, Language};
use wedm::settings::{Effective, from_toml};

const ELECTRODE: &str =
    "[milling]\ntool-diameter = 1.0\ngap = 0.05\nlayer = 0.010\ndepth = 0.2\nwear = 0.02\n";

fn settings(text: &str) -> Effective {
    let (settings, errors) = from_toml(text);
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

/// Polylines `[x, y, bulge]`, closed or not; the closed ones are openings.
fn drawing(contours: &[(bool, &[[f64; 3]])]) -> Drawing {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for (number, (closed, vertices)) in contours.iter().enumerate() {
        drawing.push(Entity {
            handle: format!("A{number}").into(),
            layer: "0".into(),
            role: closed.then_some(Role::Opening),
            kind: Kind::LightPolyline,
            geometry: Geometry::Polyline {
                closed: *closed,
                vertices: vertices
                    .iter()
                    .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
                    .collect(),
            },
        });
    }
    drawing
}

const SLOT: &[[f64; 3]] = &[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0]];

/// The path of half the electrode and a gap in it is a circle of R 1 about (5, 5).
fn ring(radius: f64) -> Vec<[f64; 3]> {
    vec![[5.0 + radius, 5.0, 1.0], [5.0 - radius, 5.0, 1.0]]
}

fn generated(drawing: &Drawing, text: &str, format: Format) -> Result<Generated, Refusal> {
    let source = Source::Cad(Arc::new(drawing.clone()));
    let document = Document::new(source, Arc::new(settings(text)));
    generate(&document, format, false)
}

fn milled(drawing: &Drawing, text: &str) -> Generated {
    match generated(drawing, text, Format::Milling) {
        Ok(made) => made,
        Err(refusal) => panic!("{text}: {refusal:?}"),
    }
}

fn refused(drawing: &Drawing, text: &str, format: Format) -> Refusal {
    match generated(drawing, text, format) {
        Ok(made) => panic!("{text}: {}", made.program.text),
        Err(refusal) => refusal,
    }
}

/// One move: from and to `[x, y, z]` in mm, centre of an arc, whether it is a rapid.
#[derive(Debug)]
struct Move {
    from: [f64; 3],
    to: [f64; 3],
    /// The centre of an arc, and 1 where it turns left, −1 where right.
    center: Option<([f64; 2], f64)>,
    is_rapid: bool,
}

impl Move {
    fn is_level(&self) -> bool {
        self.from[2] == self.to[2]
    }

    /// Where it goes at its begin or its end.
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
    fn length(&self) -> f64 {
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
fn run(text: &str, unit: f64) -> Vec<Move> {
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
fn what_is_missing_or_contradicts_itself_is_said_where_it_stands() {
    for (text, place, says) in [
        (
            "[milling]\ntool-diameter = 1\n",
            "milling",
            "expected milling.gap, milling.layer, milling.depth, milling.wear to be set",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\n",
            "milling",
            "expected milling.wear to be set",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = 0.1\nwear-compensation = \"linear\"\n",
            "milling",
            "expected milling.step to be set",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.3\ndepth = 0.2\nwear = 0.1\n",
            "layer",
            "milling.layer is 0.3, expected at most milling.depth 0.2",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.000001\ndepth = 2\nwear = 0.1\n",
            "layer",
            "2000000 layers",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = -0.1\n",
            "-0.1",
            "milling.wear is -0.1, expected a number of 0 or above",
        ),
        (
            "[milling]\ntool-diameter = 0\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = 0\n",
            "0\ngap",
            "milling.tool-diameter is 0, expected a number above 0",
        ),
        (
            "[milling]\nwear-compensation = \"uni\"\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = 0\n",
            "\"uni\"",
            "none, uniform, linear",
        ),
    ] {
        let (set, errors) = from_toml(text);
        let error = errors
            .iter()
            .find(|error| error.message.contains(says))
            .unwrap_or_else(|| panic!("{text}: {errors:?}"));
        let range = error
            .range
            .clone()
            .unwrap_or_else(|| panic!("{text}: no place"));
        assert!(text[range.start..].starts_with(place), "{text}: {range:?}");
        // And nothing is made with it.
        let Err(sentence) = Effective::of(&set).electrode() else {
            continue;
        };
        let drawing = drawing(&[(false, SLOT)]);
        let source = Source::Cad(Arc::new(drawing));
        let document = Document::new(source, Arc::new(Effective::of(&set)));
        let refusal = generate(&document, Format::Milling, true);
        assert!(
            matches!(refusal, Err(Refusal::Sentence(said)) if said == sentence),
            "{text}"
        );
    }
    assert!(Effective::default().electrode().is_err());
}

fn rules(findings: &[Finding]) -> Vec<Rule> {
    let mut rules: Vec<Rule> = findings.iter().map(|finding| finding.rule).collect();
    rules.dedup();
    rules
}

#[test]
fn what_cannot_be_milled_is_refused_at_its_place() {
    // An electrode that is larger than its slot, whatever the wire beside it is.
    let narrow: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 0.8, 0.0],
        [0.0, 0.8, 0.0],
    ];
    for text in [
        ELECTRODE.to_owned(),
        format!("correction = 0.1\n{ELECTRODE}"),
    ] {
        match refused(&drawing(&[(true, narrow)]), &text, Format::Milling) {
            Refusal::Errors(found) => {
                assert!(rules(&found).contains(&Rule::NarrowSlot), "{found:?}");
                assert!(rules(&found).contains(&Rule::OffsetCollapse), "{found:?}");
            }
            other => panic!("{other:?}"),
        }
    }
    let small = ring(0.3);
    let refusal = refused(&drawing(&[(true, &small)]), ELECTRODE, Format::Milling);
    assert!(matches!(refusal, Refusal::Errors(_)), "{refusal:?}");
    // Steps that are longer than the way.
    let text = format!("{ELECTRODE}wear-compensation = \"linear\"\nstep = 12\n");
    match refused(&drawing(&[(false, SLOT)]), &text, Format::Milling) {
        Refusal::Findings(found) => {
            assert_eq!(rules(&found), [Rule::Settings]);
            assert_eq!(found[0].severity, Severity::Error);
        }
        other => panic!("{other:?}"),
    }
    // A contour that was most likely meant to be closed is not milled along its line.
    let nearly: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
        [0.0, 0.5, 0.0],
    ];
    match refused(&drawing(&[(false, nearly)]), ELECTRODE, Format::Milling) {
        Refusal::Errors(found) => assert_eq!(rules(&found), [Rule::OpenContour]),
        other => panic!("{other:?}"),
    }
    // Layers finer than the numbers of the program.
    let text = ELECTRODE.replace("layer = 0.010", "layer = 0.0005");
    let refusal = refused(&drawing(&[(false, SLOT)]), &text, Format::Milling);
    assert!(matches!(refusal, Refusal::Sentence(_)), "{refusal:?}");
    // Where only an electrode is known no wire cuts, and a program of heights becomes no other.
    for format in [Format::ThreeB, Format::FourB, Format::Iso] {
        let refusal = refused(&drawing(&[(true, &ring(3.0))]), ELECTRODE, format);
        assert!(matches!(refusal, Refusal::Sentence(_)), "{refusal:?}");
        let text = format!("correction = 0.1\n{ELECTRODE}");
        assert!(generated(&drawing(&[(true, &ring(3.0))]), &text, format).is_ok());
    }
}

/// What a drawing says while one draws it for an electrode.
#[test]
fn a_drawing_is_judged_for_the_electrode_where_nothing_is_said_of_a_wire() {
    let judged = |contours: &[(bool, &[[f64; 3]])], text: &str| {
        let source = Source::Cad(Arc::new(drawing(contours)));
        let document = Document::new(source, Arc::new(settings(text)));
        rules(&document.all_findings())
    };
    // A radius below that of the electrode's path in a pocket; along a slot it is as it is drawn, and slots may lie side by side.
    let rounded: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [9.7, 0.0, 0.41421356],
        [10.0, 0.3, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ];
    assert!(judged(&[(true, rounded)], ELECTRODE).contains(&Rule::SmallRadius));
    assert!(
        !judged(
            &[(true, rounded)],
            &format!("correction = 0.1\n{ELECTRODE}")
        )
        .contains(&Rule::SmallRadius)
    );
    let open: &[[f64; 3]] = &rounded[..4];
    let beside: &[[f64; 3]] = &[[0.0, -0.7, 0.0], [9.0, -0.7, 0.0]];
    assert_eq!(
        judged(&[(false, open), (false, beside)], ELECTRODE),
        [Rule::OpenContour]
    );
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
    for number in 0..24 {
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

/// A milling program follows its drawing as it was written, and one whose numbers were changed by 3 µm is told at its line; one that was
/// written under other settings is not compared, and nothing in it is named.
#[test]
fn a_milling_program_is_held_against_its_drawing() {
    let ring = ring(1.27);
    for (contours, way) in [
        (vec![(false, SLOT)], "none"),
        (vec![(true, &ring[..])], "uniform"),
        (vec![(true, &ring[..]), (false, SLOT)], "linear"),
    ] {
        let of = |depth: f64| {
            format!(
                "side = \"opening\"\n[milling]\ntool-diameter = 0.5\ngap = 0.02\nlayer = 0.05\ndepth = {depth}\nwear = 0.02\n\
                 wear-compensation = \"{way}\"\nstep = 0.5\n"
            )
        };
        let (text, drawing) = (of(0.2), drawing(&contours));
        let program = milled(&drawing, &text).program.text;
        let told = |program: &str, text: &str| {
            let settings = Arc::new(settings(text));
            let source = Source::Cad(Arc::new(drawing.clone()));
            let drawn = Document::new(source, settings.clone()).drawn().unwrap();
            let read = wedm::program::Document::read(Language::Iso, program.into(), &settings);
            let found = compare(&drawn, &Traced::of(&read))?.differences;
            Some(found.iter().map(|one| one.line).collect::<Vec<_>>())
        };
        assert_eq!(told(&program, &text), Some(Vec::new()), "{way}\n{program}");
        assert_eq!(told(&program, &of(0.3)), None, "{way}");
        let mut changed = 0;
        for (line, own) in program.lines().enumerate() {
            for letter in ['X', 'Y', 'I', 'J'] {
                let Some(at) = own
                    .find(letter)
                    .filter(|_| own.starts_with("G01") || own.starts_with("G03"))
                else {
                    continue;
                };
                let end = own[at..].find(' ').map_or(own.len(), |end| at + end);
                let number: f64 = own[at + 1..end].parse().unwrap();
                changed += 1;
                if changed % 5 != 0 {
                    continue;
                }
                let new = format!("{}{:.3}{}", &own[..=at], number + 0.003, &own[end..]);
                let mut lines: Vec<&str> = program.lines().collect();
                lines[line] = &new;
                let found = told(&(lines.join("\n") + "\n"), &text);
                assert_eq!(
                    found,
                    Some(vec![line]),
                    "{way}: line {}: {own} {new}",
                    line + 1
                );
            }
        }
        assert!(changed > 7, "{way}");
    }
}
