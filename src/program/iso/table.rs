//! The control's table of corrections, as far as a program gives it.

use super::block::Register;
use super::cut::Definition;
use super::document::Document;
use super::limits::Table;
use super::moves::{FARTHEST, Reading};
use super::word::Value;
use std::collections::BTreeMap;
use std::fmt;

/// Lines that are searched for the places of the table that a program uses.
const LOOKED_AT: usize = 2_000;

impl fmt::Display for Register {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.letter as char, self.index)
    }
}

impl Document {
    /// The values that the program puts into the table.
    pub(super) fn stated_table(&self) -> Table {
        self.filled_table(|_, _, _| {})
    }

    /// The same; hands out each value that is not known, with its cut.
    pub(super) fn filled_table(
        &self,
        mut unknown: impl FnMut(usize, &Definition, NoValue),
    ) -> Table {
        let mut table = Table::default();
        for (cut, own) in self.cuts.iter().enumerate() {
            for definition in &own.rare().definitions {
                match value(&table, definition, self.reading()) {
                    Ok(value) => _ = table.insert(definition.offset, value),
                    Err(why) => {
                        table.remove(&definition.offset);
                        unknown(cut, definition, why);
                    }
                }
            }
        }
        table
    }

    /// The correction in nm that the program itself puts into a place of the control's table.
    pub(crate) fn table_value(&self, offset: Register) -> Option<i64> {
        self.control.table.get(&offset).copied()
    }

    /// The places of the control's table that the program fills, with their values in nm, and those that its first lines use.
    pub(crate) fn table_places(&self, letter: u8) -> Vec<(u32, Option<i64>)> {
        let mut places: BTreeMap<u32, Option<i64>> = self
            .used_places()
            .filter(|its| its.letter == letter)
            .map(|its| (its.index, None))
            .collect();
        for (offset, &value) in self
            .control
            .table
            .iter()
            .filter(|(offset, _)| offset.letter == letter)
        {
            places.insert(offset.index, Some(value));
        }
        places.into_iter().collect()
    }

    /// The corrections that the program itself puts into the control's table: their names, and mm.
    pub(crate) fn stated_corrections(&self) -> Vec<(String, f64)> {
        let mut places: Vec<_> = self
            .control
            .table
            .iter()
            .map(|(offset, &value)| (*offset, value))
            .collect();
        places.sort_by_key(|(offset, _)| (offset.letter, offset.index));
        places
            .into_iter()
            .map(|(offset, nm)| (offset.to_string(), nm as f64 / 1e6))
            .collect()
    }

    /// `D` or `H`, as the program names places of the control's table.
    pub(crate) fn table_letter(&self) -> u8 {
        let defined = self
            .cuts
            .iter()
            .flat_map(|cut| &cut.rare().definitions)
            .map(|definition| definition.offset)
            .next();
        defined
            .or_else(|| self.used_places().next())
            .map_or(b'D', |offset| offset.letter)
    }

    /// The place of the table that a program names, where it names but one.
    pub(crate) fn only_offset(&self) -> Option<Register> {
        let mut all = self
            .control
            .table
            .keys()
            .copied()
            .chain(self.used_places().filter(|offset| offset.index > 0));
        let first = all.next()?;
        all.all(|offset| offset == first).then_some(first)
    }

    fn used_places(&self) -> impl Iterator<Item = Register> + '_ {
        let lines = 0..self.text().line_count().min(LOOKED_AT);
        lines.filter_map(|line| self.block(line).offset)
    }
}

/// Why a value for the table is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoValue {
    /// It depends on a place that is not filled.
    Unfilled,
    /// It is beyond any machine.
    TooFar,
}

/// The value for the table, nm.
fn value(table: &Table, definition: &Definition, reading: &Reading) -> Result<i64, NoValue> {
    definition.terms.iter().try_fold(0_i64, |sum, term| {
        let value = match term.value {
            Value::Number(number) => reading
                .length_within(number, definition.inch)
                .ok_or(NoValue::TooFar)?,
            Value::Place { letter, index } => *table
                .get(&Register { letter, index })
                .ok_or(NoValue::Unfilled)?,
        };
        // Each is far below what overflows.
        let sum = match term.is_negative {
            true => sum - value,
            false => sum + value,
        };
        match sum.unsigned_abs() <= FARTHEST.unsigned_abs() {
            true => Ok(sum),
            false => Err(NoValue::TooFar),
        }
    })
}
