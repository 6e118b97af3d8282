//! The places of the control's table where it finds the corrections: what a new program keeps of them.

use super::{CutPath, Cuts};
use crate::program::format::Format;
use crate::program::iso::{self, Carried, Offset};
use crate::program::path::Step;
use crate::program::write::{Proved, ProvedProgram};
use crate::settings::Effective;

impl CutPath {
    /// Takes the place that the program has named before a step of the cut.
    pub(super) fn name(&mut self, step: &Step, offset: Option<Offset>) {
        let Some(offset) = offset.filter(|_| step.side.is_some()) else {
            return;
        };
        if *self.offset.get_or_insert(offset) != offset {
            self.renamed.get_or_insert((step.line, offset));
        }
    }
}

impl Cuts {
    /// Why a program of a language does not find each correction where this one does: in lower case without a full
    /// stop.
    pub(crate) fn lost_correction(&self, format: Format, settings: &Effective) -> Option<String> {
        let switched = |cut: &CutPath| Some((cut.offset?, cut.renamed?));
        if let Some((first, (line, other))) = self.offset_cuts().find_map(switched) {
            let reason = say!(another_correction_within_a_contour, first, other);
            return Some(say!(line_by_number, line + 1, reason));
        }
        let offsets = self.offsets();
        let several = |offsets: &[Offset]| {
            let names: Vec<String> = offsets.iter().take(5).map(Offset::to_string).collect();
            names.join(", ")
        };
        match format {
            Format::FourB => (offsets.len() > 1)
                .then(|| say!(one_correction_for_all_contours, several(&offsets))),
            Format::Iso => {
                let profile = settings.profile.as_ref().ok()?;
                let is_named = |offset: &&Offset| {
                    iso::read_of_profile(profile, offset.index)
                        .is_some_and(|read| read.index == offset.index)
                };
                if let Some(offset) = offsets.iter().find(|offset| !is_named(offset)) {
                    let reason = say!(its_contour_begin_names_no_register, offset.index);
                    return Some(say!(of_profile, profile.name, reason));
                }
                let is_same = |one: &&Offset| {
                    let same = |other: &Offset| other.index == one.index && other != *one;
                    offsets.iter().any(same)
                };
                let same: Vec<Offset> = offsets.iter().filter(is_same).copied().collect();
                (!same.is_empty()).then(|| say!(one_place_of_several_corrections, several(&same)))
            }
            _ => None,
        }
    }

    /// How a program of ISO names the corrections otherwise, in sentences.
    pub(crate) fn renamed_corrections(&self, settings: &Effective) -> Vec<String> {
        let Ok(profile) = &settings.profile else {
            return Vec::new();
        };
        let mut sentences = Vec::new();
        let renamed = |offset: Offset| {
            let read = iso::read_of_profile(profile, offset.index)?;
            let is_other = read.index == offset.index && read.letter != offset.letter;
            is_other.then(|| say!(a_correction_under_another_name, offset, read))
        };
        let renamed: Vec<String> = self
            .offsets()
            .into_iter()
            .filter_map(renamed)
            .take(8)
            .collect();
        if !renamed.is_empty() {
            sentences.push(say!(the_corrections_have_other_names, renamed.join(", ")));
        }
        if self.offset_cuts().any(|cut| cut.offset.is_none()) {
            sentences.push(say!(the_program_names_no_correction, profile.register));
        }
        sentences
    }

    /// Writes the cuts as a program of a language, and proves it.
    pub(crate) fn write(&self, format: Format, settings: &Effective) -> Proved<ProvedProgram> {
        // µm are the unit of the cuts.
        let paths = self.paths_of(format);
        if format != Format::Iso {
            return format.write(&paths, 1e-3, settings, &mut |_, _| true);
        }
        let profile = settings.profile.as_ref().ok();
        let is_named = |register: &u32| {
            let read = profile.and_then(|profile| iso::read_of_profile(profile, *register));
            read.is_some_and(|read| read.index == *register)
        };
        let kept = |cut: &CutPath| Carried {
            register: cut.offset.map(|offset| offset.index).filter(is_named),
            correction: cut.offset.and_then(|offset| {
                let name = offset.to_string();
                let stated = self.corrections.iter().find(|(other, _)| *other == name);
                stated.map(|(_, mm)| *mm)
            }),
            goes_on: cut.goes_on,
        };
        let kept = self.cuts.iter().flat_map(|cut| {
            let runs = cut.runs(cut.stops_in(format)).enumerate();
            runs.map(move |(nth, _)| match nth {
                0 => kept(cut),
                _ => Carried::default(),
            })
        });
        let kept: Vec<Carried> = kept.collect();
        iso::write_keeping(&paths, &kept, 1e-3, settings)
    }

    /// The cuts that the control offsets.
    fn offset_cuts(&self) -> impl Iterator<Item = &CutPath> {
        self.cuts.iter().filter(|cut| cut.side.is_some())
    }

    /// The places of their corrections, each once.
    fn offsets(&self) -> Vec<Offset> {
        let mut offsets = Vec::new();
        for offset in self.offset_cuts().filter_map(|cut| cut.offset) {
            if !offsets.contains(&offset) {
                offsets.push(offset);
            }
        }
        offsets
    }
}
