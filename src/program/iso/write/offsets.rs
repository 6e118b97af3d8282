//! Where the control finds the correction of each pass, and what it has to be.

use super::Lines;
use crate::program::grid::Node;
use crate::program::iso::block::{Block, Register};
use crate::program::iso::limits::example_of;
use crate::program::write::Proved;
use crate::settings::Profile;

/// What a path keeps of the program that it comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Carried {
    /// The number of the place of the correction in the control's table.
    pub(crate) register: Option<u32>,
    /// The correction that the program states there, mm.
    pub(crate) correction: Option<f64>,
    /// It goes on where the path before it ends, without a stop.
    pub(crate) goes_on: bool,
}

/// The place of the correction that a control reads from the lines of a profile at the begin of a contour, where the
/// program that they come from names the place of a number.
pub(crate) fn read_of_profile(profile: &Profile, register: u32) -> Option<Register> {
    let word = numbered(&profile.register, register);
    let offset = |line: &String| Block::of(example_of(line, &word).as_bytes()).offset;
    profile.contour_begin.iter().filter_map(offset).next_back()
}

impl Lines<'_> {
    pub(super) fn names_registers(&self) -> bool {
        let mut lines = self.profile.contour_begin.iter();
        lines.any(|line| line.contains("{register}"))
    }

    /// The word that says where the control finds the correction of the pass.
    pub(super) fn register(&self, pass: usize) -> String {
        if let Some(register) = self.own.register {
            return numbered(&self.profile.register, register);
        }
        let stated = self.settings.passes.registers.as_ref();
        let stated = stated.and_then(|words| words.get(pass - 1));
        stated
            .cloned()
            .unwrap_or_else(|| counted_on(&self.profile.register, pass - 1))
    }

    /// A refusal where the register that the control reads has to hold another correction than for a pass before.
    pub(super) fn hold_one_correction(&mut self) -> Proved {
        let corrections = self.settings.each_correction();
        let Some((offset, &own)) = self.machine.offset.zip(corrections.get(self.pass - 1)) else {
            return Ok(());
        };
        let is_same = |(register, _): &&(Register, f64)| *register == offset;
        match self.holding.iter().find(is_same) {
            Some((_, held)) if (held - own).abs() > 1e-9 => {
                let Register { letter, index } = offset;
                let word = format!("{}{index}", char::from(letter));
                Err(self.refused(&say!(its_register_is_of_two_corrections, word, held, own)))
            }
            Some(_) => Ok(()),
            None => {
                self.holding.push((offset, own));
                Ok(())
            }
        }
    }

    /// What stands in the registers that the program named: as it says, or, where there is but one, by the settings.
    fn kept_offsets(&self, kept: &[Carried]) -> Vec<(String, f64)> {
        let mut registers: Vec<(u32, Option<f64>)> = Vec::new();
        for own in kept {
            if let Some(register) = own.register
                && !registers.iter().any(|(other, _)| *other == register)
            {
                registers.push((register, own.correction));
            }
        }
        let of_settings = (registers.len() == 1).then_some(self.settings.correction);
        let known = registers.into_iter().filter_map(|(register, stated)| {
            let word = numbered(&self.profile.register, register);
            Some((word, stated.map(f64::abs).or(of_settings)?))
        });
        known.collect()
    }

    /// Notes what stands in each register, and says it in comments where a header is asked for.
    pub(super) fn say_offsets(&mut self, kept: &[Carried], at: Node) -> Proved {
        let register = |pass: usize| match self.names_registers() {
            true => self.register(pass),
            false => String::new(),
        };
        let corrections = self.settings.each_correction().into_iter();
        let offsets = (1..)
            .zip(corrections)
            .map(|(pass, mm)| (register(pass), mm));
        let offsets: Vec<(String, f64)> = match kept.iter().any(|own| own.register.is_some()) {
            true => self.kept_offsets(kept),
            false => offsets.collect(),
        };
        if self.settings.header {
            let comment = |(register, mm): &(String, f64)| match register.as_str() {
                "" => format!("(CORRECTION = {mm:.4})"),
                register => format!("({register} = {mm:.4})"),
            };
            let comments: Vec<String> = offsets.iter().map(comment).collect();
            self.fixed(&comments, at)?;
        }
        self.made.offsets = offsets;
        Ok(())
    }
}

/// A word with the number at its end increased.
fn counted_on(word: &str, by: usize) -> String {
    let name = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let number = word
        .strip_prefix(name)
        .and_then(|number| number.parse::<u32>().ok());
    let number = number.filter(|_| by > 0);
    let number = number.and_then(|number| number.checked_add(u32::try_from(by).ok()?));
    number.map_or_else(|| word.to_owned(), |number| numbered(word, number))
}

/// A word with another number at its end, of as many digits.
fn numbered(word: &str, number: u32) -> String {
    let name = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
    match word.len() - name.len() {
        0 => word.to_owned(),
        width => format!("{name}{number:0width$}"),
    }
}
