//! The section of a page about what is cut together: one part of a pair, or everything in a drawing that is no pair.

use super::super::output;
use super::html::{cell, more, number, section, table, text};
use super::job as of_job;
use crate::analysis;
use crate::document::Snapshot;
use crate::finding::{Finding, Telling};
use crate::job::{self, Cut, Generated, Refusal, Wanted, drill};
use crate::message::lengths;
use crate::program::Format;
use crate::protocol::{StartHole, Work};
use crate::settings::part_title;
use crate::toolpath::{self, WirePath};
use std::collections::BTreeMap;

/// The most lines of a program: no browser shows more at ease.
const MOST_LINES: usize = 10_000;

/// What is cut together.
pub(super) struct PageShare {
    /// Its name, and whether the wire runs on the other side of the drawn outline; nothing where the drawing is no pair.
    part: Option<(String, bool)>,
    paths: Vec<WirePath>,
    /// For each path the distance of the wire's centre from the contour, mm.
    corrections: Vec<f64>,
    holes: Vec<StartHole>,
    /// The totals of the paths, if there are any.
    pub(super) work: Option<Work>,
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
        let told = |refusal: Refusal| refusal.sentence(telling);
        if cuts.iter().any(|cut| cut.part.is_some()) {
            let made = job::programs(snapshot, findings, wanted, &());
            return match made.map_err(told) {
                Ok(made) => {
                    let of = made.into_iter().map(|(part, made)| {
                        let cut = cuts.iter().find(|cut| cut.name() == Some(&*part.name));
                        PageShare::of(cut, made.map_err(told), wanted.format)
                    });
                    of.collect()
                }
                Err(reason) => {
                    let cuts = cuts.iter();
                    cuts.map(|cut| PageShare::of(Some(cut), Err(reason.clone()), wanted.format))
                        .collect()
                }
            };
        }
        let made = job::generate(snapshot, findings.to_vec(), wanted, &()).map_err(told);
        vec![PageShare::of(cuts.pop().as_ref(), made, wanted.format)]
    }

    fn of(cut: Option<&Cut>, program: Result<Generated, String>, format: Format) -> PageShare {
        let mut share = PageShare {
            part: None,
            paths: Vec::new(),
            corrections: Vec::new(),
            holes: Vec::new(),
            work: None,
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
        let holes = drill::drilled(cut.planned.holes.clone());
        let hole = |hole| StartHole::new(drawing, outlines, settings, hole);
        let correction = |path: &WirePath| path.offset(settings, unit_mm);
        share.part = cut
            .part
            .as_ref()
            .map(|part| (part.name.clone(), part.is_other_side));
        share.corrections = paths.iter().map(correction).collect();
        share.holes = holes.iter().map(hole).collect();
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
    pub(super) fn of_part(&self, format: Format, unit_mm: f64) -> String {
        let Some((name, is_other_side)) = &self.part else {
            return String::new();
        };
        let title = part_title(name);
        let other = is_other_side.then(|| say!(the_wire_runs_on_the_other_side, &title));
        format!(
            "<h1>{}</h1>\n{}{}{}",
            text(&title),
            of_job::facts(other.as_slice()),
            self.way(format, unit_mm),
            self.text(format, unit_mm)
        )
    }

    /// Passes, totals and holes.
    pub(super) fn way(&self, format: Format, unit_mm: f64) -> String {
        let work = self.work.as_ref().map(of_job::time_and_material);
        [
            section(say!(head_passes), self.passes(format, unit_mm)),
            section(say!(head_time_and_material), work.unwrap_or_default()),
            section(
                say!(head_start_holes),
                of_job::drill_list(&self.holes, unit_mm),
            ),
        ]
        .concat()
    }

    /// The program under its heading.
    pub(super) fn text(&self, format: Format, unit_mm: f64) -> String {
        section(say!(head_program), self.program(format, unit_mm))
    }

    /// The path of the wire, pass by pass.
    fn passes(&self, format: Format, unit_mm: f64) -> String {
        // The layers of an electrode have a section of their own.
        if format == Format::Milling {
            return String::new();
        }
        let mut passes: BTreeMap<(bool, usize), (f64, f64, usize)> = BTreeMap::new();
        let paths = self.paths.iter().zip(&self.corrections);
        // What goes back along what has been cut has no minutes either.
        for (path, correction) in paths.filter(|(path, _)| !path.is_way_back) {
            let length: f64 = path
                .segments
                .iter()
                .map(|segment| segment.geometry.length())
                .sum();
            let pass = passes.entry((path.cut_off, path.pass)).or_default();
            *pass = (*correction, pass.1 + length, pass.2 + 1);
        }
        let mut minutes: BTreeMap<(bool, usize), f64> = BTreeMap::new();
        for cut in self.work.iter().flat_map(|work| &work.cuts) {
            if let Some(own) = cut.minutes {
                *minutes.entry((cut.cut_off, cut.pass)).or_default() += own;
            }
        }
        let heads = [
            say!(column_pass),
            say!(column_correction),
            say!(column_contours),
            say!(column_length_with_leads),
            say!(column_minutes),
        ];
        let columns = heads.len() - usize::from(minutes.is_empty());
        let row = |((cut_off, pass), (correction, length, count)): (_, (f64, f64, usize))| {
            let name: String = match (cut_off, pass) {
                (false, pass) => usize::to_string(&pass),
                (true, pass) => say!(cut_off_in_pass, pass),
            };
            let minutes = minutes.get(&(cut_off, pass));
            let mut cells = vec![
                cell(name),
                number(format!("{correction:.4}")),
                number(count),
                number(format!("{:.3}", length * unit_mm)),
                number(
                    minutes
                        .map(|minutes| format!("{minutes:.2}"))
                        .unwrap_or_default(),
                ),
            ];
            cells.truncate(columns);
            cells
        };
        table(&heads[..columns], passes.into_iter().map(row))
    }

    fn program(&self, format: Format, unit_mm: f64) -> String {
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
                let left_out = more(program.text.lines().count(), MOST_LINES);
                format!(
                    "<p>{}</p>\n{}<p class=\"faint\">{}</p>\n<details><summary>{}</summary>\n<pre>{}</pre>\n{left_out}</details>\n",
                    text(facts),
                    offsets.unwrap_or_default(),
                    text(finished.unwrap_or_default()),
                    text(say!(its_text)),
                    lines.join("\n")
                )
            }
        }
    }
}
