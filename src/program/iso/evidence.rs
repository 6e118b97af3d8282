//! Finds from the lines of a program what its numbers mean: the unit of whole numbers, the finest step, and the meaning
//! of I and J.
//!
//! Nothing is assumed: each reading is tested on the arcs, and the one that fits the most of them wins.

use super::block::{Block, Motion};
use super::limits::Limits;
use super::moves::{Bend, CenterRule, MICROMETRE, Move, Place, Reading, apart, distance};
use super::word::{Number, Term, Value};
use crate::settings::NumberUnit;

/// The distances of an arc's ends from its centre differ by at most this many steps of the finest number: each of the
/// three points may be off by half a step on both axes.
const STEPS: i64 = 3;

/// The coarsest tolerance, nm: a program of whole millimetres must fit better than its numbers are fine.
const COARSEST: i64 = 20 * MICROMETRE;

/// This many numbers with the same decimals show the program's format.
const ENOUGH: u32 = 12;

/// This many may be written otherwise.
const SLIPS: u32 = 2;

/// No machine travels this far, mm.
const LONG: i64 = 1_000;

/// In µm all of a part that is smaller is hardly larger than a wire is thick; in mm few machines travel as far.
const SMALL: i64 = 500;

/// No correction is as large, mm.
const LARGE_CORRECTION: i64 = 5;

/// Beyond this many numbers without a point among others, the first stands for all.
pub(crate) const FEW_BARE: u32 = 20;

/// Counts over some lines of a program. They add up in any order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Evidence {
    /// Coordinates, and those of them with a decimal point.
    pub(crate) numbers: u32,
    pub(crate) with_point: u32,
    /// Numbers that are not 0 without a point, and those of them that no machine travels in mm.
    pub(crate) bare: u32,
    pub(crate) long: u32,
    /// Those of them that are at least [`SMALL`].
    pub(crate) at_least_small: u32,
    /// Corrections without a point that are at least [`LARGE_CORRECTION`].
    pub(crate) corrections: u32,
    /// How far those under G91 lead, added up.
    pub(crate) travel: u64,
    /// How many numbers with a point, `0.` left out, have each number of decimals.
    pub(crate) places: [u32; 8],
    /// How many numbers with each number of decimals end in a 0 behind the point.
    pub(crate) ending_in_zero: [u32; 8],
    /// Numbers that have four decimals or more.
    pub(crate) fine: u32,
    /// How many lines state inches, and how many inches or mm.
    pub(crate) inches: u32,
    pub(crate) units: u32,
    /// Under G90 and under G91, where there are any: each cut keeps its counts.
    pub(crate) arcs: [Option<Box<Arcs>>; 2],
}

/// Arcs with I and J: what speaks against each rule, and how many fit under two rules about different centres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Arcs {
    all: u32,
    /// In the order of [`PAIRS`].
    unclear: [u32; 3],
    of_all: AgainstRules,
    /// How many come back to where they began: these fit any centre.
    closed: u32,
    /// How many end beside where they began, far from each of their centres, and what of these speaks against each rule.
    beside: u32,
    of_beside: AgainstRules,
    /// How many G90.1 and G91.1 say the rule of, in the order of [`RULES`]: they tell nothing of the others.
    stated: [u32; 3],
}

/// What speaks against each rule, in numbers of arcs: they do not fit; they are of a few micrometres, with a centre so far
/// away that they would be lines, as both ends of such an arc fit nearly any centre; they turn by more than a half, as
/// between rules that fit the ends equally well, the intended one turns less.
type AgainstRules = [[u32; 3]; 3];

fn add(own: &mut [u32], its: &[u32]) {
    own.iter_mut()
        .zip(its)
        .for_each(|(count, more)| *count += more);
}

/// How many decimals the numbers with a point have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct UsualDecimals {
    /// Of nearly all of them.
    pub(crate) usual: u8,
    /// How many numbers have others.
    pub(crate) others: u32,
    /// A writer that leaves zeros at the end out has numbers with fewer: only as many as some number that ends in a 0
    /// are not too few.
    least: u8,
    /// The usual ones, where some number is filled up with zeros to them, or where they are the finest steps of a control;
    /// otherwise any number may have more: `X7.5` among `X20.`
    most: u8,
}

impl UsualDecimals {
    /// True of a number to which a digit was added, or from which one was taken.
    pub(crate) fn is_odd(&self, number: Number) -> bool {
        number.point
            && !is_short_nought(number)
            && !(self.least..=self.most).contains(&number.decimals)
    }
}

/// `0.`
fn is_short_nought(number: Number) -> bool {
    number.mantissa == 0 && number.decimals == 0
}

const RULES: [CenterRule; 3] = [
    CenterRule::StartToCenter,
    CenterRule::CenterToStart,
    CenterRule::Absolute,
];

const PAIRS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

impl Arcs {
    fn add(&mut self, other: &Arcs) {
        self.all += other.all;
        self.closed += other.closed;
        self.beside += other.beside;
        add(&mut self.unclear, &other.unclear);
        add(&mut self.stated, &other.stated);
        add(self.of_all.as_flattened_mut(), other.of_all.as_flattened());
        add(
            self.of_beside.as_flattened_mut(),
            other.of_beside.as_flattened(),
        );
    }

    /// What speaks against a rule: misfits, centres far away, wide turns. Among full circles, which fit under any rule,
    /// one or two that do not quite come back are slips, and tell nothing either.
    fn against(&self, rule: usize) -> [u32; 3] {
        let are_slips =
            self.beside <= SLIPS.min(self.closed) && self.closed + self.beside == self.all;
        let told = |kind: usize| match (self.of_all[kind][rule], self.of_beside[kind][rule]) {
            (all, slips) if are_slips => all.saturating_sub(slips),
            (all, _) => all,
        };
        std::array::from_fn(told)
    }

    fn fit(&self, rule: usize) -> [u32; 2] {
        let [off, far, _] = self.against(rule);
        [off, far]
    }

    /// True where two rules fit equally many arcs, more than any other, and give different centres.
    fn is_open(&self, rules: usize) -> bool {
        let least = (0..rules).map(|rule| self.fit(rule)).min();
        let is_least = |rule: usize| Some(self.fit(rule)) == least;
        let open = |(&(a, b), &unclear): (&(usize, usize), &u32)| {
            unclear > 0 && b < rules && is_least(a) && is_least(b)
        };
        PAIRS.iter().zip(&self.unclear).any(open)
    }

    /// The arcs fit one rule better than the others.
    fn tells(&self, rules: usize) -> bool {
        self.all > 0 && !self.is_open(rules)
    }

    /// The rule with the fewest misfits, then the fewest arcs far from their centre, then the fewest wide turns; on a
    /// tie `preferred`, then the first. Between the centre's own coordinates and the way from the centre to the start
    /// turns decide nothing: the latter is rare.
    fn rule(&self, preferred: CenterRule, rules: &[CenterRule]) -> CenterRule {
        let stated = |rule: &&CenterRule| self.stated.get(**rule as usize).copied();
        if self.all == 0
            && let Some(most) = rules.iter().max_by_key(stated)
            && stated(&most) > Some(0)
        {
            return *most;
        }
        let against = |rule: CenterRule| self.against(rule as usize);
        // An arc that ends in the zero fits both of these: one about the mirrored centre, the rest of a whole turn.
        let fit = |rule: CenterRule| self.fit(rule as usize);
        let fits_absolute = rules.contains(&CenterRule::Absolute)
            && fit(CenterRule::Absolute) == fit(CenterRule::CenterToStart)
            && preferred != CenterRule::CenterToStart;
        let is_rarer = |rule: CenterRule| rule == CenterRule::CenterToStart && fits_absolute;
        let rules = || rules.iter().copied().filter(|rule| !is_rarer(*rule));
        let least = rules().map(against).min().unwrap_or_default();
        if rules().any(|rule| rule == preferred) && against(preferred) == least {
            return preferred;
        }
        rules()
            .find(|&rule| against(rule) == least)
            .unwrap_or(CenterRule::StartToCenter)
    }
}

impl Evidence {
    /// Adds what other lines say.
    pub(crate) fn add(&mut self, other: &Evidence) {
        self.numbers += other.numbers;
        self.with_point += other.with_point;
        self.bare += other.bare;
        self.long += other.long;
        self.at_least_small += other.at_least_small;
        self.corrections += other.corrections;
        self.travel = self.travel.wrapping_add(other.travel);
        self.fine += other.fine;
        self.inches += other.inches;
        self.units += other.units;
        add(&mut self.places, &other.places);
        add(&mut self.ending_in_zero, &other.ending_in_zero);
        for (own, its) in self.arcs.iter_mut().zip(&other.arcs) {
            if let Some(its) = its {
                own.get_or_insert_default().add(its);
            }
        }
    }

    /// The most decimals of a number, up to 7.
    pub(super) fn decimals(&self) -> u8 {
        self.places
            .iter()
            .rposition(|count| *count > 0)
            .unwrap_or(0) as u8
    }

    /// Counts the value of a correction.
    pub(crate) fn correction(&mut self, terms: &[Term]) {
        let is_large = |term: &Term| matches!(term.value, Value::Number(number) if !number.point && number.mantissa.abs() >= LARGE_CORRECTION);
        self.corrections += u32::from(terms.iter().any(is_large));
    }

    /// Counts a line's numbers.
    pub(crate) fn numbers(&mut self, block: &Block, incremental: bool) {
        if incremental && !block.sets_position && !block.takes_coordinates {
            let steps = [block.x, block.y].into_iter().flatten();
            let bare = steps.filter(|number| !number.point);
            let lengths = bare.map(|number| number.mantissa.unsigned_abs());
            self.travel = lengths.fold(self.travel, u64::wrapping_add);
        }
        for number in [block.x, block.y, block.i, block.j, block.r]
            .into_iter()
            .flatten()
        {
            self.numbers += 1;
            self.with_point += u32::from(number.point);
            self.fine += u32::from(number.decimals >= 4);
            // `X0.` stands among numbers of three decimals, and says nothing of them.
            if number.point && !is_short_nought(number) {
                let places = usize::from(number.decimals).min(7);
                self.places[places] += 1;
                self.ending_in_zero[places] += u32::from(places > 0 && number.mantissa % 10 == 0);
            }
            self.bare += u32::from(!number.point && number.mantissa != 0);
            self.at_least_small += u32::from(!number.point && number.mantissa.abs() >= SMALL);
            self.long += u32::from(!number.point && number.mantissa.abs() >= LONG);
        }
        self.units += u32::from(block.inch.is_some());
        self.inches += u32::from(block.inch == Some(true));
    }

    /// Counts an arc about a centre whose rule is stated.
    pub(crate) fn states(&mut self, arc: &Move, rule: CenterRule) {
        let arcs = self.arcs[usize::from(arc.incremental)].get_or_insert_default();
        if let (Some(count), Bend::Center { .. }) = (arcs.stated.get_mut(rule as usize), arc.bend) {
            *count += 1;
        }
    }

    /// Counts an arc; false where it has no centre in words, so that it tells nothing.
    pub(crate) fn arc(&mut self, arc: &Move, tolerance: i64) -> bool {
        if arc.center(CenterRule::StartToCenter).is_none() {
            return false;
        }
        let arcs = self.arcs[usize::from(arc.incremental)].get_or_insert_default();
        arcs.all += 1;
        let centers = RULES.map(|rule| arc.center(rule));
        let off = RULES.map(|rule| arc.difference(rule).abs() > tolerance as f64);
        // Under G91 nothing is absolute.
        let compared = if arc.incremental { 2 } else { 3 };
        let about = |is: fn(&Move, Place) -> bool| {
            centers.map(|center| center.is_some_and(|center| is(arc, center)))
        };
        let own: AgainstRules = [off, about(lies_far), about(turns_widely)]
            .map(|are| std::array::from_fn(|rule| u32::from(rule < compared && are[rule])));
        add(arcs.of_all.as_flattened_mut(), own.as_flattened());
        let mut compared_centers = centers[..compared].iter().flatten();
        if arc.from == arc.to {
            arcs.closed += 1;
        } else if compared_centers.all(|center| ends_beside(arc, *center)) {
            arcs.beside += 1;
            add(arcs.of_beside.as_flattened_mut(), own.as_flattened());
        }
        for (count, (a, b)) in arcs.unclear.iter_mut().zip(PAIRS) {
            *count += u32::from(b < compared && !off[a] && !off[b] && centers[a] != centers[b]);
        }
        true
    }

    /// How the program is to be read. The settings say what its arcs and its whole numbers leave open.
    pub(crate) fn reading(&self, limits: &Limits) -> Reading {
        let preferred = limits.center();
        let whole_numbers_are_fine = match limits.settings.whole_numbers {
            Some(unit) => unit == NumberUnit::Um,
            None => {
                let is_open = limits.writes_micrometres() && self.may_be_whole_units();
                is_open || self.whole_numbers_are_fine()
            }
        };
        let [under_g90, under_g91] = self.arcs();
        let absolute = under_g90.rule(preferred, &RULES);
        // The arcs under G90 give evidence for those under G91 of the same program.
        let shown = if under_g90.tells(3) {
            absolute
        } else {
            preferred
        };
        let incremental = under_g91.rule(shown, &RULES[..2]);
        let absolute = if !under_g90.tells(3) && under_g91.tells(2) {
            under_g90.rule(incremental, &RULES)
        } else {
            absolute
        };
        let step = match (whole_numbers_are_fine, self.inches > 0) {
            (true, false) => MICROMETRE,
            (true, true) => 2_540,
            (false, inch) => {
                (if inch { 25_400_000 } else { 1_000_000 })
                    / 10_i64.pow(u32::from(self.finest_places()))
            }
        };
        Reading {
            whole_numbers_are_fine,
            absolute,
            incremental,
            tolerance: (STEPS * step).clamp(STEPS * MICROMETRE, COARSEST),
        }
    }

    /// The decimals that numbers are rounded to: one with more may be a slip.
    fn finest_places(&self) -> u8 {
        let told = self.usual_decimals();
        told.filter(|decimals| decimals.usual > 1 && decimals.most == decimals.usual)
            .map_or(self.decimals(), |decimals| decimals.usual)
    }

    /// Whole numbers are the finest steps where no number has a point, unless all would be too small for a part, or where
    /// each that has one stands among at least four without that are too long for anything else.
    fn whole_numbers_are_fine(&self) -> bool {
        // Under G91 numbers are steps: those of a way round the part add up to twice its length and width.
        let is_small = self.at_least_small == 0 && self.travel < 4 * SMALL.unsigned_abs();
        match self.with_point {
            0 => !self.may_be_whole_units() || !is_small,
            with_point => with_point.saturating_mul(4) <= self.long,
        }
    }

    /// No number has a point, and none is too long for whole mm: nothing in the text says what they are.
    pub(crate) fn may_be_whole_units(&self) -> bool {
        let is_told = self.long > 0 || self.corrections > 0 || self.inches > 0;
        self.with_point == 0 && self.bare > 0 && !is_told
    }

    /// The decimals of the numbers, where all but one or two have as many.
    pub(crate) fn usual_decimals(&self) -> Option<UsualDecimals> {
        let all: u32 = self.places.iter().sum();
        let (usual, count) = self
            .places
            .iter()
            .enumerate()
            .max_by_key(|(_, count)| **count)?;
        if *count < ENOUGH || all - count > SLIPS {
            return None;
        }
        let usual = usual as u8;
        let padded = self.ending_in_zero.iter().rposition(|count| *count > 0);
        let padded = padded.unwrap_or(0) as u8;
        let finest = if self.inches > 0 { 4 } else { 3 };
        Some(UsualDecimals {
            usual,
            others: all - count,
            least: padded.min(usual),
            most: match padded >= usual.max(1) || usual >= finest {
                true => usual,
                false => u8::MAX,
            },
        })
    }

    /// Whether lengths have a decimal point, where nearly all are written alike.
    pub(crate) fn pointed(&self) -> Option<bool> {
        if self.whole_numbers_are_fine() {
            return (self.numbers > 0).then_some(false);
        }
        (self.bare <= FEW_BARE && self.bare.saturating_mul(8) <= self.with_point).then_some(true)
    }

    /// True where the arcs fit under two rules equally well, as full circles do.
    pub(crate) fn leaves_centers_open(&self) -> bool {
        let [under_g90, under_g91] = self.arcs();
        let told = under_g90.tells(3) || under_g91.tells(2);
        !told && (under_g90.is_open(3) || under_g91.is_open(2))
    }

    /// Whether some arcs under G90 have I and J.
    pub(crate) fn has_absolute_arcs(&self) -> bool {
        self.arcs[0].as_ref().is_some_and(|arcs| arcs.all > 0)
    }

    fn arcs(&self) -> [Arcs; 2] {
        let of = |arcs: &Option<Box<Arcs>>| arcs.as_deref().copied().unwrap_or_default();
        self.arcs.each_ref().map(of)
    }
}

/// True of an arc of at most 10 µm about a centre a hundred times as far away.
fn lies_far(arc: &Move, center: Place) -> bool {
    let chord = distance(arc.from, arc.to);
    let is_short = chord > 0.0 && chord <= (10 * MICROMETRE) as f64;
    is_short && distance(arc.from, center) > 100.0 * chord
}

/// True of an arc that ends a little beside where it began, seen from a centre: the whole of a circle but for a slip,
/// or a very short arc.
fn ends_beside(arc: &Move, center: Place) -> bool {
    10.0 * distance(arc.from, arc.to) < distance(arc.from, center)
}

/// True where an arc about a centre turns by more than a half, and by less than a whole.
fn turns_widely(arc: &Move, center: Place) -> bool {
    let from_center = |place: Place| apart(place, center).map(i128::from);
    let ([ax, ay], [bx, by]) = (from_center(arc.from), from_center(arc.to));
    let cross = ax * by - ay * bx;
    if arc.motion == Motion::CounterClockwise {
        cross < 0
    } else {
        cross > 0
    }
}
