//! Where the control finds the correction of each pass, and what it has to be.

use super::Lines;
use crate::program::grid::Node;
use crate::program::write::Proved;

impl Lines<'_> {
    pub(super) fn names_registers(&self) -> bool {
        let mut lines = self.profile.contour_begin.iter();
        lines.any(|line| line.contains("{register}"))
    }

    /// The word that says where the control finds the correction of the pass.
    pub(super) fn register(&self, pass: usize) -> String {
        let stated = self.settings.passes.registers.as_ref();
        let stated = stated.and_then(|words| words.get(pass - 1));
        stated
            .cloned()
            .unwrap_or_else(|| counted_on(&self.profile.register, pass - 1))
    }

    /// Notes what stands in each register, and says it in comments where a header is asked for.
    pub(super) fn say_offsets(&mut self, at: Node) -> Proved {
        let register = |pass: usize| match self.names_registers() {
            true => self.register(pass),
            false => String::new(),
        };
        let corrections = self.settings.each_correction().into_iter();
        let offsets = (1..)
            .zip(corrections)
            .map(|(pass, mm)| (register(pass), mm));
        let offsets: Vec<(String, f64)> = offsets.collect();
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
    let digits = &word[name.len()..];
    match digits.parse::<usize>() {
        Ok(number) if by > 0 => format!("{name}{:0width$}", number + by, width = digits.len()),
        _ => word.to_owned(),
    }
}
