//! The corrections of the passes, checked against each other and the wire; and a computed table of them.

use super::{Passes, Settings};
use std::borrow::Cow;

impl Passes {
    /// Where a later level says one correction for all, the corrections of an earlier one no longer apply, nor what
    /// that said of each of its passes.
    pub(super) fn reset(&mut self, earlier: &Passes, later: &Passes, is_one: bool) {
        let count = earlier.corrections.as_ref().map(Vec::len);
        if !is_one || later.corrections.is_some() || count.is_none() {
            return;
        }
        let of_one = |count: usize| count == 1;
        self.corrections = None;
        self.gaps = later
            .gaps
            .clone()
            .or(self.gaps.take().filter(|gaps| of_one(gaps.len())));
        self.rates = later
            .rates
            .clone()
            .or(self.rates.take().filter(|rates| of_one(rates.len())));
        let registers = self.registers.take().filter(|words| of_one(words.len()));
        self.registers = later.registers.clone().or(registers);
    }
}

/// Two lengths in mm that differ by less are equal: halving a diameter may round.
const ROUNDING: f64 = 1e-9;

/// A pass that cannot follow the one before it, or that no wire can cut.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PassFault {
    /// The dotted key that it is about.
    pub(crate) key: Cow<'static, str>,
    /// Index of the pass.
    pub(crate) pass: usize,
    /// In lower case without a full stop.
    pub(crate) message: String,
}

impl PassFault {
    /// A fault that concerns no single pass.
    pub(super) fn of(key: impl Into<Cow<'static, str>>, message: String) -> PassFault {
        PassFault {
            key: key.into(),
            pass: usize::MAX,
            message,
        }
    }
}

/// The faults in the corrections of the passes from rough to finish, mm: one above that of the pass before it, and one
/// below the wire's radius, where the diameter is known. The corrections are those of `passes`, if any, else the single
/// `correction`; each other list in `passes` must be as long.
pub(crate) fn pass_faults(
    corrections: &[f64],
    passes: &Passes,
    wire_diameter: Option<f64>,
) -> Vec<PassFault> {
    let are_listed = passes.corrections.is_some();
    let key = match are_listed {
        true => "passes.corrections",
        false => "correction",
    };
    let name = |pass: usize| match are_listed {
        true => format!("{key}[{pass}]"),
        false => key.into(),
    };
    let mut faults = Vec::new();
    for (pass, &correction) in corrections.iter().enumerate() {
        if let Some(before) = pass
            .checked_sub(1)
            .and_then(|before| corrections.get(before))
            && correction > before + ROUNDING
        {
            let message = say!(is_more_than_the_pass_before, name(pass), correction, before);
            faults.push(PassFault {
                key: key.into(),
                pass,
                message,
            });
        }
        if let Some(radius) = wire_diameter.map(|diameter| diameter / 2.0)
            && correction < radius - ROUNDING
        {
            let message = say!(is_less_than_the_wire_radius, name(pass), correction, radius);
            faults.push(PassFault {
                key: key.into(),
                pass,
                message,
            });
        }
    }
    let lists = [
        ("passes.gaps", passes.gaps.as_ref().map(Vec::len)),
        ("passes.registers", passes.registers.as_ref().map(Vec::len)),
        ("passes.rates", passes.rates.as_ref().map(Vec::len)),
    ];
    for (key, count) in lists {
        if let Some(count) = count.filter(|&count| count != corrections.len()) {
            let message = say!(
                is_of_passes_expected_one_for_each,
                key,
                count,
                corrections.len()
            );
            faults.push(PassFault::of(key, message));
        }
    }
    faults.extend(shared_registers(corrections, passes));
    faults
}

/// The faults of the registers: words that are no register, and registers that two corrections would share.
fn shared_registers(corrections: &[f64], passes: &Passes) -> Vec<PassFault> {
    let key = "passes.registers";
    let words = passes.registers.as_deref().unwrap_or_default();
    let name = |pass: usize| format!("{key}[{pass}]");
    let mut faults = Vec::new();
    for (pass, (word, correction)) in words.iter().zip(corrections).enumerate() {
        let (letters, number) = register_of(word);
        if ["G", "I", "J", "M", "N", "O", "R", "X", "Y"].contains(&&*letters) {
            let message = say!(is_no_place_of_a_correction, name(pass), word);
            faults.push(PassFault {
                key: key.into(),
                pass,
                message,
            });
            continue;
        }
        let before = words.iter().zip(corrections).take(pass);
        let shares = |(_, (other, own)): &(usize, (&String, &f64))| {
            register_of(other) == (letters.clone(), number) && (*own - correction).abs() > ROUNDING
        };
        if let Some((other, (_, own))) = before.enumerate().find(shares) {
            let (name, other) = (name(pass), name(other));
            let message = say!(
                a_register_of_two_corrections,
                name,
                word,
                correction,
                other,
                own
            );
            faults.push(PassFault {
                key: key.into(),
                pass,
                message,
            });
        }
    }
    faults
}

/// A register as controls read it: its letters, and the number after them.
fn register_of(word: &str) -> (String, Option<u64>) {
    let letters = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let number = word.strip_prefix(letters).unwrap_or_default();
    (letters.to_ascii_uppercase(), number.parse().ok())
}

/// The passes whose wire, with its gap, cuts further than to the contour by more than `allowed` mm: a clearance of a pair.
pub(super) fn cuts_beyond(settings: &Settings, allowed: f64) -> Vec<PassFault> {
    let Some(diameter) = settings.wire_diameter else {
        return Vec::new();
    };
    let passes = settings.passes.clone().unwrap_or_default();
    let (key, corrections) = match (&passes.corrections, settings.correction) {
        (Some(list), _) => ("passes.corrections", list.clone()),
        (None, Some(single)) => ("correction", vec![single]),
        (None, None) => return Vec::new(),
    };
    let beyond = |(pass, correction): (usize, f64)| {
        let gap = match &passes.gaps {
            Some(gaps) => gaps.get(pass).copied(),
            None => settings.gap,
        };
        let half = diameter / 2.0 + gap?;
        let name = match key {
            "correction" => key.to_owned(),
            _ => format!("{key}[{pass}]"),
        };
        // Below the wire's radius it is an error of its own.
        let is_said = correction < diameter / 2.0 - ROUNDING;
        let beyond = half - correction;
        let message = || {
            say!(
                the_wire_and_its_gap_cut_beyond,
                name,
                correction,
                half,
                beyond
            )
        };
        (beyond > allowed && !is_said).then(|| PassFault {
            key: key.into(),
            pass,
            message: message(),
        })
    };
    corrections
        .into_iter()
        .enumerate()
        .filter_map(beyond)
        .collect()
}

/// The corrections of a rough pass and `skims` skims for a wire of radius `wire`, mm: the rough one leaves the `stock`,
/// each skim takes its share and the last one the rest. `gaps` are the spark gaps of the rough pass and of the skims.
///
/// Rough: ρ + δ rough + stock; skim i of n: ρ + δ skim + stock · (n − i) / n. Without skims there is no stock: ρ + δ
/// rough.
pub(crate) fn passes_table(wire: f64, gaps: [f64; 2], stock: f64, skims: usize) -> Vec<f64> {
    let [rough, fine] = gaps;
    let left = |skim: usize| stock * (skims - skim) as f64 / skims as f64;
    let first = wire + rough + if skims > 0 { stock } else { 0.0 };
    let skim = (1..=skims).map(|skim| wire + fine + left(skim));
    std::iter::once(first).chain(skim).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Effective, from_toml};
    use super::*;

    fn listed() -> Passes {
        Passes {
            corrections: Some(Vec::new()),
            ..Passes::default()
        }
    }

    #[test]
    fn corrections_fall_and_stay_above_the_radius_of_the_wire() {
        let check = |corrections: &[f64], diameter: Option<f64>, expected: &[usize]| {
            let passes: Vec<usize> = pass_faults(corrections, &listed(), diameter)
                .iter()
                .map(|fault| fault.pass)
                .collect();
            assert_eq!(passes, expected, "{corrections:?} {diameter:?}");
        };
        check(&[0.175, 0.146, 0.140], None, &[]);
        check(&[0.175, 0.146, 0.140], Some(0.25), &[]);
        check(&[0.14], Some(0.28), &[]);
        check(&[0.14, 0.14, 0.14], Some(0.25), &[]);
        check(&[0.140, 0.146, 0.175], None, &[1, 2]);
        check(&[0.2, 0.1, 0.15], None, &[2]);
        check(&[0.175, 0.12], Some(0.25), &[1]);
        check(&[0.1, 0.12], Some(0.25), &[0, 1, 1]);
        check(&[], Some(0.25), &[]);
    }

    #[test]
    fn lists_beside_the_corrections_are_of_as_many_passes() {
        let check = |gaps: Option<Vec<f64>>, registers: Option<Vec<String>>, expected: &[&str]| {
            let passes = Passes {
                gaps,
                registers,
                ..listed()
            };
            let faults = pass_faults(&[0.2, 0.17, 0.14], &passes, None);
            let found: Vec<&str> = faults.iter().map(|fault| fault.message.as_str()).collect();
            assert_eq!(found, expected);
        };
        check(Some(vec![0.03, 0.015, 0.015]), None, &[]);
        check(
            Some(vec![0.03, 0.015]),
            Some(vec!["D1".into()]),
            &[
                "passes.gaps is a list of 2, expected one for each of the 3 passes",
                "passes.registers is a list of 1, expected one for each of the 3 passes",
            ],
        );
    }

    /// The file, what lies over it, and the corrections, gaps and registers that apply then.
    #[test]
    fn what_a_later_level_says_of_the_correction_applies() {
        const FILE: &str = "correction = 0.11\n[passes]\ncorrections = [0.2, 0.15]\ngaps = [0.02, 0.01]\nregisters = [\"D3\", \"D4\"]\nsequence = \"one-way\"\n";
        for (file, later, corrections, gap, registers) in [
            (FILE, "", &[0.2, 0.15][..], Some(0.02), Some("D3")),
            (FILE, "correction = 0.3\n", &[0.3], None, None),
            (
                FILE,
                "wire-diameter = 0.3\ngap = 0.03\n",
                &[0.2, 0.15],
                Some(0.03),
                Some("D3"),
            ),
            (
                FILE,
                "wire-diameter = 0.3\n",
                &[0.2, 0.15],
                Some(0.02),
                Some("D3"),
            ),
            (
                FILE,
                "correction = 0.3\n[passes]\nregisters = [\"D7\"]\n",
                &[0.3],
                None,
                Some("D7"),
            ),
            (
                FILE,
                "passes.corrections = [0.3, 0.25]\n",
                &[0.3, 0.25],
                Some(0.02),
                Some("D3"),
            ),
            (
                FILE,
                "correction = 0.3\npasses.corrections = [0.21, 0.2]\n",
                &[0.21, 0.2],
                Some(0.02),
                Some("D3"),
            ),
            (
                "passes.gaps = [0.02]\n",
                "gap = 0.03\ncorrection = 0.3\n",
                &[0.3],
                Some(0.03),
                None,
            ),
            (
                "correction = 0.3\n",
                "passes.corrections = [0.2]\n",
                &[0.2],
                None,
                None,
            ),
            (
                "[passes]\ncorrections = [0.2]\nregisters = [\"D3\"]\n",
                "correction = 0.3\n",
                &[0.3],
                None,
                Some("D3"),
            ),
        ] {
            let [file, later] = [file, later].map(|text| from_toml(text).0);
            let laid = Effective::of(&file.overlaid(&later));
            let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9;
            let are_same = laid.corrections.len() == corrections.len();
            assert!(
                are_same && laid.corrections.iter().zip(corrections).all(near),
                "{later:?} {:?}",
                laid.corrections
            );
            let first = laid
                .passes
                .gaps
                .as_ref()
                .map_or(laid.gap, |gaps| gaps.first().copied());
            assert_eq!(first, gap, "{later:?}");
            let stated = laid
                .passes
                .registers
                .as_ref()
                .and_then(|words| words.first());
            assert_eq!(stated.map(String::as_str), registers, "{later:?}");
        }
    }

    #[test]
    fn a_table_leaves_each_skim_its_share_of_the_stock() {
        let check = |gaps: [f64; 2], stock: f64, skims: usize, expected: &[f64]| {
            let table = passes_table(0.125, gaps, stock, skims);
            let same = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
            assert!(
                table.len() == expected.len() && table.iter().zip(expected).all(same),
                "{table:?}, expected {expected:?}"
            );
        };
        check([0.03, 0.015], 0.06, 2, &[0.215, 0.170, 0.140]);
        check([0.03, 0.015], 0.06, 1, &[0.215, 0.140]);
        check([0.03, 0.015], 0.06, 0, &[0.155]);
        check([0.02, 0.01], 0.0, 3, &[0.145, 0.135, 0.135, 0.135]);
    }
}
