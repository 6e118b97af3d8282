//! The formats that programs are written in, by name.

use super::write::{Proved, ProvedProgram};
use super::{Language, iso, three_b};
pub use crate::settings::ProgramFormat as Format;
use crate::settings::{Compensation, Effective};
use crate::toolpath::{Source, WirePath};
use std::borrow::Cow;

impl Format {
    pub(crate) const ALL: [Format; 4] =
        [Format::ThreeB, Format::FourB, Format::Iso, Format::Milling];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Format::ThreeB => "3b",
            Format::FourB => "4b",
            Format::Iso => "iso",
            Format::Milling => "milling",
        }
    }

    /// How people write it.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Format::ThreeB => "3B",
            Format::FourB => "4B",
            Format::Iso => "ISO",
            Format::Milling => "ISO (milling)",
        }
    }

    /// The language that its programs are read in.
    pub fn language(self) -> Language {
        match self {
            Format::ThreeB | Format::FourB => Language::ThreeB,
            Format::Iso | Format::Milling => Language::Iso,
        }
    }

    /// Endings of the names of its files, lower-case, the usual one first.
    pub(crate) fn endings(self) -> &'static [&'static str] {
        match self {
            Format::ThreeB => &["3b"],
            Format::FourB => &["4b"],
            Format::Iso | Format::Milling => self.language().endings(),
        }
    }

    /// The format that an ending in lower case alone says.
    pub(crate) fn of_ending(ending: &str) -> Option<Format> {
        let mut all = Format::ALL.into_iter();
        all.find(|format| format.endings().contains(&ending))
    }

    /// The format of a name, in either letter case. The error lists them.
    pub(crate) fn of(name: &str) -> Result<Format, String> {
        let found = Format::ALL
            .into_iter()
            .find(|format| format.name().eq_ignore_ascii_case(name));
        found.ok_or_else(|| {
            let names = Format::ALL.map(|format| format!("\"{}\"", format.name()));
            say!(the_format_is_not_known, name, names.join(", "))
        })
    }

    /// The settings for planning paths in this format: 4B holds the part's contour, whatever is set for the others.
    pub(crate) fn settings<'a>(self, settings: &'a Effective) -> Cow<'a, Effective> {
        match (self, settings.compensation) {
            (Format::FourB, Compensation::Path) => Cow::Owned(Effective {
                compensation: Compensation::Controller,
                ..settings.clone()
            }),
            (Format::Iso, _)
                if settings
                    .profile
                    .as_ref()
                    .is_ok_and(|profile| !profile.stops()) =>
            {
                Cow::Owned(Effective {
                    stays_threaded: true,
                    ..settings.clone()
                })
            }
            _ => Cow::Borrowed(settings),
        }
    }

    /// Writes the paths as one program and proves it; `go_on` gets the progress, and ends the work with `false`.
    pub fn write(
        self,
        paths: &[WirePath],
        unit_mm: f64,
        settings: &Effective,
        go_on: &mut dyn FnMut(usize, usize) -> bool,
    ) -> Proved<ProvedProgram> {
        self.write_with_sources(paths, unit_mm, settings, None, go_on)
    }

    /// The same to be compared: it is not written where it is far too long, and `sources` get what each block that moves
    /// follows, in the order of the program.
    pub(crate) fn write_with_sources(
        self,
        paths: &[WirePath],
        unit_mm: f64,
        settings: &Effective,
        sources: Option<&mut Vec<Source>>,
        go_on: &mut dyn FnMut(usize, usize) -> bool,
    ) -> Proved<ProvedProgram> {
        match self {
            Format::ThreeB => three_b::write_with(paths, unit_mm, settings, sources, go_on),
            Format::FourB => three_b::write_four_b(paths, unit_mm, settings, sources, go_on),
            Format::Iso => iso::write_with(paths, unit_mm, settings, sources, go_on),
            Format::Milling => iso::write_milled(paths, unit_mm, settings, sources, go_on),
        }
    }
}
