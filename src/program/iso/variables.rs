//! Variables of the control, as far as the text gives them constants: what `#1=10.` says of `X-#1` and `R[#1+2.]`.
//!
//! They are part of the state of the control: a value holds from its line on, in the order in which lines run. Where a
//! macro jumps or repeats, lines run in an order that nobody follows, and no value is known any more.

use super::word::Number;

/// The most that are kept at a time; a program of constants has a few.
const MOST: usize = 16;

/// The values that are known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Variables {
    /// The first ones, in rising order of their numbers; the others are all alike, so that equal values are equal states.
    own: [Variable; MOST],
    count: u8,
    /// A macro has jumped: nothing is known from there on.
    is_open: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Variable {
    number: u16,
    decimals: u8,
    point: bool,
    mantissa: i64,
}

impl Variables {
    fn known(&self) -> &[Variable] {
        self.own.get(..usize::from(self.count)).unwrap_or_default()
    }

    /// The value of `#number`, where it is known.
    pub(super) fn value(&self, number: u16) -> Option<Number> {
        let known = self.known();
        let at = known.binary_search_by_key(&number, |own| own.number).ok()?;
        known.get(at).map(|own| Number {
            mantissa: own.mantissa,
            decimals: own.decimals,
            point: own.point,
        })
    }

    /// `#number` gets a value; `None` where nobody knows it.
    pub(super) fn set(&mut self, number: u16, value: Option<Number>) {
        let others = |own: &&Variable| own.number != number;
        let mut all: Vec<Variable> = self.known().iter().filter(others).copied().collect();
        let value = value.filter(|_| all.len() < MOST && !self.is_open);
        all.extend(value.map(|value| Variable {
            number,
            decimals: value.decimals,
            point: value.point,
            mantissa: value.mantissa,
        }));
        all.sort_by_key(|own| own.number);
        self.own = [Variable::default(); MOST];
        self.own
            .iter_mut()
            .zip(&all)
            .for_each(|(own, is)| *own = *is);
        self.count = all.len() as u8;
    }

    /// From here on nobody knows in which order lines run.
    pub(super) fn forget(&mut self) {
        *self = Variables {
            is_open: true,
            ..Variables::default()
        };
    }
}
