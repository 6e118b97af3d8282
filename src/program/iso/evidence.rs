//! What the lines of a program show about how its numbers are meant: the unit of whole numbers, the finest step, and where I and J lead.
//!
//! Nothing of it is assumed: the readings are held against the arcs, and the one that fits the most of them is taken.

use super::block::Block;
use super::machine::{CenterRule, MICROMETRE, Move, Reading};

/// Ends of an arc lie no more unlike far from its centre than this many steps of the finest number: each of the three points may be
/// off by half a step on both axes.
const STEPS: i64 = 3;

/// The coarsest tolerance, nm: a program of whole millimetres must fit better than its numbers are fine.
const COARSEST: i64 = 20 * MICROMETRE;

/// Counts over some lines of a program. They add up in any order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Evidence {
    /// Coordinates with a decimal point.
    pub with_point: u32,
    /// The most decimals of a coordinate.
    pub decimals: u8,
    pub inch: bool,
    pub absolute: Arcs,
    pub incremental: Arcs,
}

/// Arcs whose centre tells the rules apart, and how many of them do not fit under each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Arcs {
    pub telling: u32,
    pub off: [u32; 3],
    /// Arcs with a centre in all.
    pub all: u32,
}

const RULES: [CenterRule; 3] = [CenterRule::StartToCenter, CenterRule::CenterToStart, CenterRule::Absolute];

impl Arcs {
    fn add(&mut self, other: &Arcs) {
        self.telling += other.telling;
        self.all += other.all;
        for (count, more) in self.off.iter_mut().zip(other.off) {
            *count += more;
        }
    }

    /// The rule that the fewest arcs are off under; `preferred` where others are no better, then the first.
    fn rule(&self, preferred: CenterRule, rules: &[CenterRule]) -> CenterRule {
        let off = |rule: CenterRule| self.off[rule as usize];
        let least = rules.iter().copied().map(off).min().unwrap_or(0);
        if rules.contains(&preferred) && off(preferred) == least {
            return preferred;
        }
        rules.iter().copied().find(|&rule| off(rule) == least).unwrap_or(CenterRule::StartToCenter)
    }
}

impl Evidence {
    pub fn add(&mut self, other: &Evidence) {
        self.with_point += other.with_point;
        self.decimals = self.decimals.max(other.decimals);
        self.inch |= other.inch;
        self.absolute.add(&other.absolute);
        self.incremental.add(&other.incremental);
    }

    /// Takes note of a line's numbers.
    pub fn numbers(&mut self, block: &Block) {
        for number in [block.x, block.y, block.i, block.j, block.r].into_iter().flatten() {
            self.with_point += u32::from(number.point);
            self.decimals = self.decimals.max(number.decimals);
        }
        self.inch |= block.inch == Some(true);
    }

    /// Takes note of an arc.
    pub fn arc(&mut self, arc: &Move, tolerance: i64) {
        let arcs = if arc.incremental { &mut self.incremental } else { &mut self.absolute };
        if arc.center(CenterRule::StartToCenter).is_none() {
            return;
        }
        arcs.all += 1;
        let off = RULES.map(|rule| arc.difference(rule).abs() > tolerance as f64);
        // Under G91 nothing is absolute.
        let compared = if arc.incremental { &off[..2] } else { &off[..] };
        arcs.telling += u32::from(compared.iter().any(|&is_off| is_off != off[0]));
        for (count, &is_off) in arcs.off.iter_mut().zip(compared) {
            *count += u32::from(is_off);
        }
    }

    /// How the program is to be read. `preferred` is what holds where its arcs fit under several rules.
    pub fn reading(&self, preferred: CenterRule) -> Reading {
        let whole_numbers_are_fine = self.with_point == 0;
        let absolute = self.absolute.rule(preferred, &RULES);
        // What the arcs under G90 show, those under G91 of the same program need not show again.
        let shown = if self.absolute.telling > 0 { absolute } else { preferred };
        let incremental = self.incremental.rule(shown, &RULES[..2]);
        let absolute = if self.absolute.telling == 0 && self.incremental.telling > 0 {
            self.absolute.rule(incremental, &RULES)
        } else {
            absolute
        };
        let step = match (whole_numbers_are_fine, self.inch) {
            (true, false) => MICROMETRE,
            (true, true) => 2_540,
            (false, inch) => (if inch { 25_400_000 } else { 1_000_000 }) / 10_i64.pow(u32::from(self.decimals.min(7))),
        };
        Reading { whole_numbers_are_fine, absolute, incremental, tolerance: (STEPS * step).clamp(STEPS * MICROMETRE, COARSEST) }
    }

    /// True where there are arcs and none of them shows where I and J lead: full circles only, which fit under several rules.
    pub fn leaves_centers_open(&self) -> bool {
        let open = |arcs: &Arcs| arcs.all > 0 && arcs.telling == 0;
        let told = self.absolute.telling > 0 || self.incremental.telling > 0;
        !told && (open(&self.absolute) || open(&self.incremental))
    }
}
