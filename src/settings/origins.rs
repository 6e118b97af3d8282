//! Where the values come from that every answer rests on: which level has the last word on the correction, the side and
//! the unit.

use super::{FILE_NAME, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A level of settings, or what else says a value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Nobody has set one.
    #[default]
    Default,
    /// `initializationOptions`, `workspace/didChangeConfiguration` or `workspace/configuration`.
    Client,
    /// `wedm.toml`.
    File,
    /// The file of `--config`.
    Config,
    /// An option of the command line, or of a request.
    Option,
    /// The drawing itself.
    Drawing,
}

/// The level that each value comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origins {
    pub(crate) correction: Origin,
    pub(crate) side: Origin,
    pub(crate) unit: Origin,
    /// There is a `wedm.toml`, whatever it says.
    pub(crate) has_file: bool,
}

impl Origins {
    /// Of levels that are laid over each other, the last one wins. Passes replace a single correction, but one of a
    /// later level, which replaces them; an electrode counts where nothing is said of a wire.
    pub(crate) fn of<'a>(levels: impl IntoIterator<Item = (&'a Settings, Origin)>) -> Origins {
        let (mut passes, mut single, mut electrode) = (None, None, None);
        let mut origins = Origins::default();
        for (level, origin) in levels {
            let has_passes = (level.passes.as_ref()).is_some_and(|own| own.corrections.is_some());
            if has_passes {
                passes = Some(origin);
            } else if level.correction.is_some() {
                (passes, single) = (None, Some(origin));
            } else if level.wire_diameter.or(level.gap).is_some() {
                single = Some(origin);
            }
            if level.milling.as_ref().is_some_and(|own| own.is_said()) {
                electrode = Some(origin);
            }
            origins.has_file |= origin == Origin::File;
            if level.side.is_some() {
                origins.side = origin;
            } else if level.is_pair() {
                origins.side = Origin::Default;
            }
            if level.units.is_some() {
                origins.unit = origin;
            }
        }
        origins.correction = passes.or(single).or(electrode).unwrap_or_default();
        origins
    }
}

impl Origin {
    /// For people.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Origin::Default => say!(the_default),
            Origin::Client => say!(the_settings_of_the_editor),
            Origin::File => FILE_NAME,
            Origin::Config => "--config",
            Origin::Option => say!(an_option),
            Origin::Drawing => say!(the_drawing),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::from_toml;

    #[test]
    fn the_last_level_that_says_a_value_is_named() {
        let of = |file: &str, option: &str| {
            let [file, option] = [file, option].map(|text| from_toml(text).0);
            let origins = Origins::of([(&file, Origin::File), (&option, Origin::Option)]);
            (origins.correction, origins.side, origins.unit)
        };
        use Origin::{Default, File, Option};
        for (file, option, expected) in [
            ("", "", (Default, Default, Default)),
            ("gap = 0.02", "side = \"punch\"", (File, Option, Default)),
            (
                "[passes]\ncorrections = [0.2, 0.1]",
                "gap = 0.02",
                (File, Default, Default),
            ),
            (
                "[passes]\ncorrections = [0.2, 0.1]",
                "correction = 0.1",
                (Option, Default, Default),
            ),
            (
                "units = \"inch\"\ncorrection = 0.1",
                "wire-diameter = 0.2",
                (Option, Default, File),
            ),
            (
                "[milling]\ntool-diameter = 1\ngap = 0.05",
                "",
                (File, Default, Default),
            ),
            // A later side ends a pair that is cut on both, and a later pair a side.
            (
                "[pair]\ndrawn-as = \"plate\"",
                "side = \"auto\"",
                (Default, Option, Default),
            ),
            (
                "side = \"auto\"",
                "[pair]\ndrawn-as = \"plate\"",
                (Default, Default, Default),
            ),
        ] {
            assert_eq!(of(file, option), expected, "{file} | {option}");
        }
    }
}
