//! `wedm pair`: the programs of all parts of a pair.

use super::options::{Common, Pairing, Program, no_pair};
use super::output::{self, styled};
use super::{Failure, Verdict, ending, files, report};
use crate::disk;
use crate::document::Document;
use crate::finding::{Detail, Finding, Rule};
use crate::job::{self, PartProgram, Wanted};
use crate::message::lengths;
use crate::program::Format;
use crate::settings::part_title;
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm pair washer.dxf --drawn-as plate --clearance 0.09 --wire-diameter 0.18 --gap 0.01
  wedm pair washer.dxf --format iso -o programs        programs/washer-punch.iso and so on")]
pub(super) struct Arguments {
    #[arg(value_name = "PATH")]
    path: PathBuf,
    #[arg(long, value_parser = Format::of)]
    format: Option<Format>,
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    #[arg(long)]
    overwrite: bool,
    #[arg(long, value_name = "HANDLE")]
    handle: Vec<String>,
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    pairing: Pairing,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

pub(super) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let path = files::shown(&arguments.path);
    if let Some(folder) = &arguments.output {
        ending::folder(folder)?;
    }
    let own = arguments.common.settings_with(&arguments.program);
    let last = arguments.pairing.0.overlaid(&own);
    let (mut opened, snapshot) =
        files::drawing_to_use(&arguments.path, None, &arguments.common, &last)?;
    let format = arguments.format;
    let format = format.unwrap_or_else(|| ending::of_settings(&snapshot.settings));
    if let (Err(missing), true) = (snapshot.settings.fit(), format != Format::Milling) {
        let needed = say!(a_pair_needs, missing.listed());
        return Err(Failure::of(path, no_pair(&last, &missing, needed)));
    }
    let document = &opened.document;
    let wanted = Wanted {
        format,
        handles: (!arguments.handle.is_empty()).then_some(&arguments.handle),
        layers: None,
        force: arguments.force,
    };
    let findings = document.all_findings();
    let is_alone = |finding: &&Finding| matches!(finding.detail, Detail::NoPartner { .. });
    let alone: Vec<Finding> = findings.iter().filter(is_alone).cloned().collect();
    report::say(path, document, &alone);
    let made = match job::pair(&snapshot, &findings, &wanted, &()) {
        Ok(made) => made,
        Err(refusal) => return report::refuse_programs(path, &mut opened.document, &refusal),
    };
    let folder = match (&arguments.output, path.parent()) {
        (Some(folder), _) => folder.clone(),
        (None, Some(folder)) => folder.to_path_buf(),
        (None, None) => PathBuf::new(),
    };
    let target = |part: &str| folder.join(file_name(path, part, format));
    let targets: Vec<PathBuf> = made.iter().map(|part| target(&part.part)).collect();
    let parts: Vec<&str> = made.iter().map(|part| &*part.part).collect();
    refuse_one_file_for_two(&parts, &targets)?;
    for target in &targets {
        output::refuse_input(target, path)?;
    }
    // All or none: a program of an earlier run beside new ones does not fit them.
    let mut written = made.iter().zip(&targets);
    let is_other =
        written.find(|(part, target)| disk::holds_else(target, part.made.program.text.as_bytes()));
    if let Some((_, target)) = is_other.filter(|_| !arguments.overwrite) {
        return Err(Failure::of(target, say!(it_is_there_already)));
    }
    if !folder.as_os_str().is_empty() {
        std::fs::create_dir_all(&folder)
            .map_err(|error| Failure::of(&folder, disk::plain(&error)))?;
    }
    for (part, target) in made.iter().zip(&targets) {
        let program = &part.made.program;
        output::write(Some(target), program.text.as_bytes(), true)?;
        say_written(path, document, part, target);
    }
    output::say_against(document);
    Ok(Verdict::Clean)
}

/// Says what was written for a part, what it rests upon, and where its wire runs otherwise than expected.
fn say_written(path: &Path, document: &Document, part: &PartProgram, target: &Path) {
    let program = &part.made.program;
    let corrections: Vec<String> = part
        .corrections
        .iter()
        .map(|correction| format!("{correction:.4}"))
        .collect();
    output::say(&say!(
        the_program_of_a_part_is_written,
        styled(output::GOOD, say!(written)),
        output::target_name(Some(target)),
        part_title(&part.part),
        corrections.join(" / "),
        say!(blocks, program.blocks),
        lengths(program.length, program.jumps, say!(comma))
    ));
    let mut said = part.made.warnings.clone();
    said.retain(|finding| {
        let is_of_tab = finding.rule == Rule::LeadIn && !output::is_what_holds(finding);
        is_of_tab || job::is_of_program(finding)
    });
    report::say(path, document, &said);
    let lines = [output::off_chords(program), output::offsets(program)];
    lines.iter().flatten().for_each(|line| output::say(line));
    output::say_thread_hole(&part.made.holes, document.unit_mm());
    output::say_what_holds(&part.made.warnings, document.telling());
    let beyond: Vec<String> = (1..)
        .zip(&part.corrections)
        .filter(|(_, correction)| **correction < 0.0)
        .map(|(pass, _): (usize, _)| pass.to_string())
        .collect();
    if !beyond.is_empty() {
        output::say(&say!(
            some_passes_run_on_the_other_side,
            part_title(&part.part),
            beyond.join(say!(comma))
        ));
    }
    if part.is_other_side {
        output::say(&say!(
            the_wire_runs_on_the_other_side,
            part_title(&part.part)
        ));
    }
}

/// Refuses parts whose names differ in nothing that a name of a file can hold, on every machine.
fn refuse_one_file_for_two(parts: &[&str], targets: &[PathBuf]) -> Result<(), Failure> {
    let plain = |target: &PathBuf| target.to_string_lossy().to_lowercase();
    for (index, target) in targets.iter().enumerate() {
        let before = targets[..index].iter();
        if let Some(other) = before.map(plain).position(|other| other == plain(target)) {
            let [one, other] = [other, index].map(|part| part_title(parts[part]));
            let sentence = say!(two_parts_in_one_file, one, other);
            return Err(Failure::of(target, sentence));
        }
    }
    Ok(())
}

/// `washer-punch.3b`; characters that a file name cannot hold become `_`.
fn file_name(drawing: &Path, part: &str, format: Format) -> String {
    let stem = drawing.file_stem().unwrap_or_default().to_string_lossy();
    let safe = |letter: char| match letter {
        letter if letter.is_alphanumeric() || "-_.".contains(letter) => letter,
        _ => '_',
    };
    let part: String = part.chars().map(safe).collect();
    format!("{stem}-{part}.{}", format.name())
}
