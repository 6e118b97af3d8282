//! The places of the control's table where it finds the corrections: what a new program keeps of them.

use super::{CutPath, Cuts};
use crate::program::format::Format;
use crate::program::iso::{self, Carried, Register};
use crate::program::path::Step;
use crate::program::write::{Proved, ProvedProgram};
use crate::settings::Effective;

impl CutPath {
    /// Takes the place that the program has named before a step of the cut.
    pub(super) fn name(&mut self, step: &Step) {
        let Some(offset) = step.register.filter(|_| step.side.is_some()) else {
            return;
        };
        if *self.offset.get_or_insert(offset) != offset {
            self.renamed.get_or_insert((step.line, offset));
        }
    }
}

/// A place of the table as the profile of the settings names it in a program; `None` where it names none, or another.
fn named(offset: Register, settings: &Effective) -> Option<Register> {
    let profile = settings.profile.as_ref().ok()?;
    let read = iso::read_of_profile(profile, offset.index)?;
    (read.index == offset.index).then_some(read)
}

/// The first of some places in a row.
fn several(offsets: &[Register]) -> String {
    let names: Vec<String> = offsets.iter().take(5).map(Register::to_string).collect();
    names.join(", ")
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
        match format {
            Format::FourB => (offsets.len() > 1)
                .then(|| say!(one_correction_for_all_contours, several(&offsets))),
            Format::Iso => {
                let profile = settings.profile.as_ref().ok()?;
                let mut all = offsets.iter();
                if let Some(offset) = all.find(|offset| named(**offset, settings).is_none()) {
                    let reason = say!(its_contour_begin_names_no_register, offset.index);
                    return Some(say!(of_profile, profile.name, reason));
                }
                let of_index = |index: u32| offsets.iter().filter(move |own| own.index == index);
                let is_same = |own: &&Register| of_index(own.index).count() > 1;
                let same: Vec<Register> = offsets.iter().filter(is_same).copied().collect();
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
        let renamed = self.offsets().into_iter().filter_map(|offset| {
            let read = named(offset, settings).filter(|read| *read != offset)?;
            Some(say!(a_correction_under_another_name, offset, read))
        });
        let renamed: Vec<String> = renamed.take(8).collect();
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
        let kept = |cut: &CutPath| Carried {
            register: cut
                .offset
                .and_then(|offset| named(offset, settings))
                .map(|named| named.index),
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
    fn offsets(&self) -> Vec<Register> {
        let mut offsets = Vec::new();
        for offset in self.offset_cuts().filter_map(|cut| cut.offset) {
            if !offsets.contains(&offset) {
                offsets.push(offset);
            }
        }
        offsets
    }
}
