//! The same moves as text of each language, a line for each move.

use wedm::program::Language;

/// One move in µm: where it leads from where it begins; of an arc also where its centre lies, from its begin, and its turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    pub by: [i64; 2],
    pub arc: Option<([i64; 2], bool)>,
}

impl Move {
    pub fn line(x: i64, y: i64) -> Move {
        Move {
            by: [x, y],
            arc: None,
        }
    }
}

/// A way of writing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Writing {
    ThreeB,
    FourB,
    Incremental,
    Absolute,
}

impl Writing {
    pub const ALL: [Writing; 4] = [
        Writing::ThreeB,
        Writing::FourB,
        Writing::Incremental,
        Writing::Absolute,
    ];

    pub fn language(self) -> Language {
        match self {
            Writing::ThreeB | Writing::FourB => Language::ThreeB,
            Writing::Incremental | Writing::Absolute => Language::Iso,
        }
    }

    pub fn text(self, cuts: &[Vec<Move>]) -> String {
        let mut text = match self {
            Writing::ThreeB | Writing::FourB => String::new(),
            Writing::Incremental => "G21 G91\nG92 X0. Y0.\n".to_owned(),
            Writing::Absolute => "G21 G90\nG92 X0. Y0.\n".to_owned(),
        };
        let mut at = [0, 0];
        for (nth, cut) in cuts.iter().enumerate() {
            if nth > 0 {
                text += match self {
                    Writing::ThreeB | Writing::FourB => "D\n",
                    Writing::Incremental | Writing::Absolute => "M00\n",
                };
            }
            for one in cut {
                text += &self.line(one, at);
                at = [at[0] + one.by[0], at[1] + one.by[1]];
                text.push('\n');
            }
        }
        text += match self {
            Writing::ThreeB | Writing::FourB => "DD\n",
            Writing::Incremental | Writing::Absolute => "M02\n",
        };
        text
    }

    fn line(self, one: &Move, at: [i64; 2]) -> String {
        if matches!(self, Writing::ThreeB | Writing::FourB) {
            return three_b(one, self == Writing::FourB);
        }
        let from = if self == Writing::Absolute {
            at
        } else {
            [0, 0]
        };
        let mm = |um: i64| format!("{:.3}", um as f64 / 1e3);
        let to = format!("X{} Y{}", mm(from[0] + one.by[0]), mm(from[1] + one.by[1]));
        match one.arc {
            None => format!("G01 {to}"),
            Some(([i, j], is_left)) => {
                let word = if is_left { "G03" } else { "G02" };
                format!("{word} {to} I{} J{}", mm(i), mm(j))
            }
        }
    }
}

/// A block of 3B: a line by its end, along an axis by its counted length alone; an arc by its begin from its centre. 4B adds an arc's
/// radius, and on which side of it the part lies.
fn three_b(one: &Move, names_radius: bool) -> String {
    let [x, y] = one.by;
    let Some((center, is_left)) = one.arc else {
        let quadrant = match (x, y) {
            (x, 0) if x > 0 => 1,
            (0, y) if y > 0 => 2,
            (x, 0) if x < 0 => 3,
            (0, y) if y < 0 => 4,
            (x, y) => quadrant_of([x, y]),
        };
        let axis = if x.abs() > y.abs() { 'X' } else { 'Y' };
        let counted = x.abs().max(y.abs());
        return match x == 0 || y == 0 {
            true => format!("B0B0B{counted}G{axis}L{quadrant}"),
            false => format!("B{}B{}B{counted}G{axis}L{quadrant}", x.abs(), y.abs()),
        };
    };
    let start = [-center[0], -center[1]];
    let end = [x - center[0], y - center[1]];
    let axis = usize::from(end[0].abs() > end[1].abs());
    let counted = projection(start, end, is_left, axis);
    let (radius, part) = match names_radius {
        true => {
            let radius = (start[0] as f64).hypot(start[1] as f64).round();
            (format!("B{radius}"), if is_left { "DD" } else { "D" })
        }
        false => (String::new(), ""),
    };
    format!(
        "B{}B{}B{counted}{radius}G{}{part}{}{}",
        start[0].abs(),
        start[1].abs(),
        ['X', 'Y'][axis],
        if is_left { "NR" } else { "SR" },
        quadrant_entered(start, is_left)
    )
}

fn quadrant_of([x, y]: [i64; 2]) -> u8 {
    match (x >= 0, y >= 0) {
        (true, true) => 1,
        (false, true) => 2,
        (false, false) => 3,
        (true, false) => 4,
    }
}

/// The quadrant into which an arc sets out; its begin may lie on an axis.
fn quadrant_entered(start: [i64; 2], is_left: bool) -> u8 {
    let sign = if is_left { 1 } else { -1 };
    let ahead = [-start[1] * sign, start[0] * sign];
    let at = |axis: usize| match start[axis] {
        0 => ahead[axis],
        own => own,
    };
    quadrant_of([at(0), at(1)])
}

/// How far an arc moves along an axis in all, back and forth; turns are below a whole one.
fn projection(start: [i64; 2], end: [i64; 2], is_left: bool, axis: usize) -> i64 {
    let radius = ((start[0] * start[0] + start[1] * start[1]) as f64).sqrt();
    let angle = |[x, y]: [i64; 2]| (y as f64).atan2(x as f64);
    let sign = if is_left { 1.0 } else { -1.0 };
    let sweep = (sign * (angle(end) - angle(start))).rem_euclid(std::f64::consts::TAU);
    let sweep = if sweep < 1e-9 {
        std::f64::consts::TAU
    } else {
        sweep
    };
    // From one end of the axis to the other it turns back.
    let turns = (0..8).map(|quarter| f64::from(quarter) * std::f64::consts::FRAC_PI_2);
    let mut places: Vec<f64> = turns
        .map(|turn| (sign * (turn - angle(start))).rem_euclid(std::f64::consts::TAU))
        .filter(|turn| *turn > 1e-9 && *turn < sweep - 1e-9)
        .collect();
    places.push(sweep);
    places.sort_by(f64::total_cmp);
    let along = |turn: f64| {
        let angle = angle(start) + sign * turn;
        radius * if axis == 0 { angle.cos() } else { angle.sin() }
    };
    let (mut counted, mut from) = (0.0, along(0.0));
    for turn in places {
        let to = along(turn);
        counted += (to - from).abs();
        from = to;
    }
    counted.round() as i64
}
