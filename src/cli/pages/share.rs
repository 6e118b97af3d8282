//! The section of a page about what is cut together: one part of a pair, or everything in a drawing that is no pair.

use super::super::{contours, output};
use super::html::{cell, more, number, section, table, text};
use super::job as of_job;
use crate::analysis;
use crate::document::Snapshot;
use crate::drawing::Role;
use crate::finding::{Finding, Side, Telling};
use crate::job::{self, Cut, Generated, Refusal, Wanted, drill};
use crate::message::{duration, lengths};
use crate::program::Format;
use crate::protocol::{StartHole, Work};
use crate::settings::part_title;
use crate::toolpath::{self, WirePath};
use std::collections::BTreeMap;

/// The most lines of a program: no browser shows more at ease.
const MOST_LINES: usize = 10_000;

/// A program of at most so many lines is printed whole; a longer one is named by its file and its checksum.
const PRINTED_LINES: usize = 150;

/// One pass of the passes table.
#[derive(Default)]
struct Pass {
    correction: f64,
    /// Drawing units.
    length: f64,
    count: usize,
    minutes: Option<f64>,
    /// The words of the control for the side, or what the contours are where the offset is in the coordinates.
    sides: Vec<&'static str>,
    is_offset: bool,
}

/// What is cut together.
pub(super) struct PageShare {
    /// Its name, and whether the wire runs on the other side of the drawn outline; nothing where the drawing is no pair.
    part: Option<(String, bool)>,
    paths: Vec<WirePath>,
    /// For each path the distance of the wire's centre from the contour, mm.
    corrections: Vec<f64>,
    /// With their numbers.
    holes: Vec<(usize, StartHole)>,
    /// For each path the side of the part on which the wire runs.
    sides: Vec<Role>,
    /// The totals of the paths, if there are any.
    pub(super) work: Option<Work>,
    /// What happens while nobody stands by.
    night: String,
    /// The program, or why there is none.
    pub(super) program: Result<Generated, String>,
}

impl PageShare {
    /// Those of a drawing, by the paths that are known of it.
    pub(super) fn all(
        snapshot: &Snapshot,
        cuts: Result<Vec<Cut>, Refusal>,
        findings: &[Finding],
        wanted: &Wanted,
        telling: Telling,
    ) -> Vec<PageShare> {
        let mut cuts = cuts.unwrap_or_default();
        // The numbers of the holes go on from part to part, as in the picture.
        let first = |name: &str| {
            let before = cuts.iter().take_while(|cut| cut.name() != Some(name));
            1 + before.map(|cut| cut.planned.holes.len()).sum::<usize>()
        };
        let told = |refusal: Refusal| refusal.sentence(telling);
        if cuts.iter().any(|cut| cut.part.is_some()) {
            let made = job::programs(snapshot, findings, wanted, &());
            return match made.map_err(told) {
                Ok(made) => {
                    let of = made.into_iter().map(|(part, made)| {
                        let cut = cuts.iter().find(|cut| cut.name() == Some(&*part.name));
                        PageShare::of(cut, first(&part.name), made.map_err(told), wanted.format)
                    });
                    of.collect()
                }
                Err(reason) => {
                    let cuts = cuts.iter();
                    cuts.map(|cut| {
                        let first = cut.name().map_or(1, first);
                        PageShare::of(Some(cut), first, Err(reason.clone()), wanted.format)
                    })
                    .collect()
                }
            };
        }
        let made = job::generate(snapshot, findings.to_vec(), wanted, &()).map_err(told);
        vec![PageShare::of(cuts.pop().as_ref(), 1, made, wanted.format)]
    }

    fn of(
        cut: Option<&Cut>,
        first: usize,
        program: Result<Generated, String>,
        format: Format,
    ) -> PageShare {
        let mut share = PageShare {
            part: None,
            paths: Vec::new(),
            corrections: Vec::new(),
            holes: Vec::new(),
            sides: Vec::new(),
            work: None,
            night: String::new(),
            program,
        };
        let Some(cut) = cut else {
            return share;
        };
        let Snapshot {
            drawing,
            outlines,
            settings,
        } = &cut.snapshot;
        let unit_mm = settings.unit_of(drawing).mm;
        let paths = &cut.planned.paths;
        // An electrode goes its way once for each layer, which the program counts.
        let work = match (format, &share.program) {
            (Format::Milling, Ok(made)) => Some(made.work.clone()),
            (Format::Milling, Err(_)) => None,
            _ => (!paths.is_empty()).then(|| analysis::work(drawing, outlines, settings, paths)),
        };
        let hole = |(number, hole): (usize, &_)| {
            let hole: &toolpath::StartHole = hole;
            let hole = StartHole::new(drawing, outlines, settings, hole);
            (number, hole)
        };
        let side = |path: &WirePath| {
            let outline = outlines.get(path.outline);
            outline.map_or(Role::Both, |outline| outline.role)
        };
        let correction = |path: &WirePath| path.offset(settings, unit_mm);
        share.part = cut
            .part
            .as_ref()
            .map(|part| (part.name.clone(), part.is_other_side));
        share.corrections = paths.iter().map(correction).collect();
        share.holes = drill::numbered(&cut.planned.holes, first)
            .map(hole)
            .collect();
        share.sides = paths.iter().map(side).collect();
        if let Some(work) = work.as_ref().filter(|_| format != Format::Milling) {
            share.night = of_job::night(&cut.snapshot, paths, work, format);
        }
        share.work = work.map(|work| Work::new(drawing, outlines, &work));
        share.paths.clone_from(paths);
        share
    }

    /// The blocks of its program.
    pub(super) fn blocks(&self) -> Option<usize> {
        self.program.as_ref().ok().map(|made| made.program.blocks)
    }

    /// True for a part of a pair.
    pub(super) fn is_part(&self) -> bool {
        self.part.is_some()
    }

    /// Its name and all of it.
    pub(super) fn of_part(&self, format: Format, unit_mm: f64, drawing: &str) -> String {
        let Some((name, is_other_side)) = &self.part else {
            return String::new();
        };
        let file = format!("{drawing}-{name}");
        let title = part_title(name);
        let other = is_other_side.then(|| say!(the_wire_runs_on_the_other_side, &title));
        format!(
            "<h1>{}</h1>\n{}{}{}",
            text(&title),
            of_job::facts(other.as_slice()),
            self.way(format, unit_mm),
            self.text(format, unit_mm, &file)
        )
    }

    /// Passes, totals and holes.
    pub(super) fn way(&self, format: Format, unit_mm: f64) -> String {
        let work = self.work.as_ref().map(of_job::time_and_material);
        [
            section(say!(head_passes), self.passes(format, unit_mm)),
            section(say!(head_time_and_material), work.unwrap_or_default()),
            section(say!(head_night), self.night.clone()),
            section(
                say!(head_start_holes),
                of_job::drill_list(&self.holes, unit_mm),
            ),
        ]
        .concat()
    }

    /// The program under its heading.
    pub(super) fn text(&self, format: Format, unit_mm: f64, file: &str) -> String {
        section(say!(head_program), self.program(format, unit_mm, file))
    }

    /// The path of the wire, pass by pass.
    fn passes(&self, format: Format, unit_mm: f64) -> String {
        // The layers of an electrode have a section of their own.
        if format == Format::Milling {
            return String::new();
        }
        let mut passes: BTreeMap<(bool, usize), Pass> = BTreeMap::new();
        let paths = self.paths.iter().zip(&self.corrections).zip(&self.sides);
        // What goes back along what has been cut has no minutes either.
        for ((path, correction), role) in paths.filter(|((path, _), _)| !path.is_way_back) {
            let pass = passes.entry((path.cut_off, path.pass)).or_default();
            pass.correction = *correction;
            pass.count += 1;
            pass.length += path
                .segments
                .iter()
                .map(|segment| segment.geometry.length())
                .sum::<f64>();
            let side = match path.side {
                Some(Side::Left) => "G41",
                Some(Side::Right) => "G42",
                None => contours::role(*role),
            };
            if !pass.sides.contains(&side) {
                pass.sides.push(side);
            }
            pass.is_offset |= path.side.is_some();
        }
        for cut in self.work.iter().flat_map(|work| &work.cuts) {
            if let (Some(own), Some(pass)) = (cut.minutes, passes.get_mut(&(cut.cut_off, cut.pass)))
            {
                *pass.minutes.get_or_insert(0.0) += own;
            }
        }
        let program = self.program.as_ref().ok().map(|made| &made.program);
        let offsets = program.map_or(&[][..], |program| &program.offsets);
        let heads = [
            say!(column_pass),
            say!(column_correction),
            say!(column_register),
            say!(column_offset),
            say!(column_side),
            say!(column_contours),
            say!(column_length_with_leads),
            say!(column_time),
        ];
        let has_times = passes.values().any(|pass| pass.minutes.is_some());
        let columns = heads.len() - usize::from(!has_times);
        let row = |((cut_off, number_of), pass): ((bool, usize), Pass)| {
            let name: String = match (cut_off, number_of) {
                (false, number) => number.to_string(),
                (true, number) => say!(cut_off_in_pass, number),
            };
            let offset = match offsets.len() {
                1 => offsets.first(),
                _ => offsets.get(number_of - 1),
            };
            let (register, offset) = match (pass.is_offset, offset) {
                (true, Some((register, mm))) => (register.clone(), format!("{mm:.4}")),
                (true, None) => (String::new(), format!("{:.4}", pass.correction)),
                (false, _) => ("–".into(), say!(in_the_coordinates).into()),
            };
            let mut cells = vec![
                cell(name),
                number(format!("{:.4}", pass.correction)),
                cell(register),
                cell(offset),
                cell(pass.sides.join(" + ")),
                number(pass.count),
                number(format!("{:.3}", pass.length * unit_mm)),
                number(pass.minutes.map(duration).unwrap_or_default()),
            ];
            cells.truncate(columns);
            cells
        };
        table(&heads[..columns], passes.into_iter().map(row))
    }

    /// Why it has no program.
    pub(super) fn refusal(&self) -> Option<&str> {
        self.program.as_ref().err().map(String::as_str)
    }

    fn program(&self, format: Format, unit_mm: f64, file: &str) -> String {
        match &self.program {
            Err(reason) => format!("<p class=\"error\">{}</p>\n", text(reason)),
            Ok(made) => {
                let program = &made.program;
                // 4B holds the part's contour, whose length is another one than the wire's way.
                let [length, jumps] = match format {
                    Format::FourB => {
                        let (cut, jumps) = toolpath::lengths(&self.paths);
                        [cut, jumps].map(|length| length * unit_mm)
                    }
                    _ => [program.length, program.jumps],
                };
                let facts = say!(
                    a_program_and_its_proof,
                    format.title(),
                    say!(blocks, program.blocks),
                    say!(contours, made.contours),
                    lengths(length, jumps, say!(comma)),
                    program.deviation
                );
                let arcs = output::off_chords(program);
                let arcs = arcs.map(|line| format!("<p>{}</p>\n", text(line)));
                let finished = made.finished.as_ref().map(|finished| {
                    let at = finished.at * unit_mm;
                    say!(
                        the_finished_part_deviates,
                        finished.uncut,
                        at.x,
                        at.y,
                        finished.overcut
                    )
                });
                let offsets = output::offsets(program);
                let offsets = offsets.map(|line| format!("<p>{}</p>\n", text(line)));
                let lines: Vec<String> = program.text.lines().take(MOST_LINES).map(text).collect();
                let count = program.text.lines().count();
                let left_out = more(count, MOST_LINES);
                let open = if count <= PRINTED_LINES { " open" } else { "" };
                let ending = format.endings().first().copied().unwrap_or_default();
                let named = say!(
                    a_program_by_its_checksum,
                    format!("{file}.{ending}"),
                    say!(lines, count),
                    format!("{:08X}", crc32fast::hash(program.text.as_bytes()))
                );
                format!(
                    "<p>{}</p>\n{}<p>{}</p>\n{}<p class=\"faint\">{}</p>\n<details{open}><summary>{}</summary>\n<pre>{}</pre>\n{left_out}</details>\n",
                    text(facts),
                    arcs.unwrap_or_default(),
                    text(named),
                    offsets.unwrap_or_default(),
                    text(finished.unwrap_or_default()),
                    text(say!(its_text)),
                    lines.join("\n")
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_checksum_is_that_of_zip() {
        assert_eq!(crc32fast::hash(b"123456789"), 0xCBF4_3926);
    }
}
