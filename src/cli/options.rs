//! Options that several commands share, and the settings that come of them.

use crate::settings::{
    Compensation, Corner, Direction, Layout, Order, Passes, PointSetting, ProgramSettings,
    Settings, SideSetting, words_of,
};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde::de::DeserializeOwned;
use std::path::PathBuf;

/// What every command that looks at a drawing takes.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Settings")]
pub(crate) struct Common {
    /// Wire radius + spark gap in mm: how far the wire's centre runs from the contour
    #[arg(long, value_name = "MM", value_parser = positive, allow_hyphen_values = true)]
    pub(crate) correction: Option<f64>,
    /// Correction of each pass in mm, from rough to finish, in place of --correction
    #[arg(long, value_name = "MM,MM", value_delimiter = ',', value_parser = positive)]
    pub(crate) passes: Vec<f64>,
    /// Side on which the wire runs, where neither entity nor layer says
    #[arg(long, value_parser = words::<SideSetting>())]
    pub(crate) side: Option<SideSetting>,
    /// Settings file, laid over the `wedm.toml` found upwards from the input
    #[arg(long, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
}

/// How a program is written.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Program")]
pub(crate) struct Program {
    /// Direction in which closed contours are cut
    #[arg(long, value_parser = words::<Direction>())]
    pub(crate) direction: Option<Direction>,
    /// How the wire goes round convex corners
    #[arg(long, value_parser = words::<Corner>())]
    pub(crate) corner: Option<Corner>,
    /// Thread hole, in drawing units [default: the "O" mark, else found from the entry]
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub(crate) thread: Option<[f64; 2]>,
    /// Point of the contour where the cut begins, in drawing units
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub(crate) entry: Option<[f64; 2]>,
    /// Length of the lead-in in mm, where no thread hole is given
    #[arg(long, value_name = "MM", value_parser = positive, allow_hyphen_values = true)]
    pub(crate) lead_in: Option<f64>,
    /// Length of a punch's contour in mm that stands until all passes are cut, then is cut off
    #[arg(long, value_name = "MM", value_parser = positive)]
    pub(crate) tab: Option<f64>,
    /// Order of the contours; what lies within one always comes before it [default: inside-first]
    #[arg(long, value_parser = words::<Order>())]
    pub(crate) order: Option<Order>,
    /// Form of the blocks
    #[arg(long, value_parser = words::<Layout>())]
    pub(crate) layout: Option<Layout>,
    /// Where the correction is applied
    #[arg(long, value_parser = words::<Compensation>())]
    pub(crate) compensation: Option<Compensation>,
    /// Digits of the controller's numbers in 3B: longer blocks are split [default: 6]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(4..=9))]
    pub(crate) digits: Option<u8>,
    /// How an ISO program is written: fast-wire, robofil, generic, or one of the settings' [profiles]
    #[arg(long, value_name = "NAME")]
    pub(crate) profile: Option<String>,
    /// Word that ends the program [default: DD]
    #[arg(long, value_name = "WORD")]
    pub(crate) end: Option<String>,
    /// Word that pauses it, to thread the wire [default: D]
    #[arg(long, value_name = "WORD")]
    pub(crate) pause: Option<String>,
}

impl Common {
    /// The last level of settings: what the command line says.
    pub(crate) fn settings(&self) -> Settings {
        Settings {
            correction: self.correction,
            side: self.side,
            passes: (!self.passes.is_empty()).then(|| Passes {
                corrections: Some(self.passes.clone()),
                ..Passes::default()
            }),
            ..Settings::default()
        }
    }
}

impl Common {
    /// The same with what the command line says of the program.
    pub(crate) fn settings_with(&self, program: &Program) -> Settings {
        Settings {
            program: Some(program.settings()),
            ..self.settings()
        }
    }
}

impl Program {
    fn settings(&self) -> ProgramSettings {
        ProgramSettings {
            layout: self.layout,
            direction: self.direction,
            corner: self.corner,
            thread: self.thread.map(PointSetting::One),
            entry: self.entry.map(PointSetting::One),
            lead_in: self.lead_in,
            tab: self.tab,
            order: self.order,
            compensation: self.compensation,
            digits: self.digits,
            profile: self.profile.clone(),
            end: self.end.clone(),
            pause: self.pause.clone(),
            ..ProgramSettings::default()
        }
    }
}

/// Words that a setting may have, read as the setting's own type reads them.
pub(crate) fn words<T>() -> impl TypedValueParser<Value = T>
where
    T: DeserializeOwned + Clone + Send + Sync + 'static,
{
    // They are as long-lived as the parser of the command line, which is made once.
    let words = words_of::<T>().into_iter().map(|word| &*word.leak());
    PossibleValuesParser::new(words).try_map(|word| serde_json::from_value::<T>(word.into()))
}

pub(crate) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length.is_finite() && length > 0.0 => Ok(length),
        _ => Err(say!(expected_a_length_in_mm_above_0).into()),
    }
}

/// `X,Y`, both finite; either may be negative.
pub(crate) fn point(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| {
        text.trim()
            .parse::<f64>()
            .ok()
            .filter(|number| number.is_finite())
    };
    let both = text
        .split_once(',')
        .and_then(|(x, y)| Some([number(x)?, number(y)?]));
    both.ok_or_else(|| say!(expected_two_numbers_with_a_comma_between_such).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_two_finite_numbers() {
        let expected = [
            ("1,2", Some([1.0, 2.0])),
            ("-115,-10.5", Some([-115.0, -10.5])),
            ("1, 2", Some([1.0, 2.0])),
        ];
        for (text, point_of_text) in expected {
            assert_eq!(point(text).ok(), point_of_text, "{text}");
        }
        for text in ["", "1", "1,2,3", "nan,1", "1,inf", "a,b", "1;2"] {
            assert!(point(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_correction_is_above_zero() {
        assert_eq!(positive("0.1"), Ok(0.1));
        for text in ["0", "-0.1", "nan", "inf", "thick"] {
            assert!(positive(text).is_err(), "{text}");
        }
    }
}
