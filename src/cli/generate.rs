//! `wedm generate`: a program for the machine.

use super::lisp::Answer;
use super::options::{Common, LispEncoding, Program, targets};
use super::output::{self, styled};
use super::{Failure, Verdict, ending, files, report};
use crate::document::{Document, Snapshot};
use crate::dxf::{Group, GroupValue};
use crate::finding::{Detail, Finding, Rule, sentence};
use crate::job::{self, Generated, Refusal, Wanted};
use crate::message::{duration, lengths, readable};
use crate::program::{Format, ProvedProgram};
use crate::protocol::{Milling, Work};
use crate::toolpath;
use clap::Args;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm generate plate.dxf --side opening -o plate.3b
  wedm generate plate.dxf --side opening --format iso --profile robofil --compensation controller -o plate.iso
  wedm generate plate.dxf --handle 2A --thread -115,-10 --layout checking
  wedm generate plate.dxf --side punch --correction 0.12 --corner intersection --direction cw
  wedm generate slot.dxf --format milling -o slot.iso")]
pub(crate) struct Arguments {
    #[arg(value_name = "PATH")]
    path: PathBuf,
    #[arg(long, value_parser = Format::of)]
    format: Option<Format>,
    #[arg(short, long, value_name = "OUT")]
    output: Vec<PathBuf>,
    #[arg(long, requires = "output")]
    overwrite: bool,
    #[arg(long, value_enum, default_value_t, hide_default_value = true)]
    encoding: LispEncoding,
    #[arg(long, value_name = "HANDLE")]
    handle: Vec<String>,
    #[arg(long, value_name = "LAYER")]
    layer: Vec<String>,
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let (target, is_for_lisp) = targets(&arguments.output)?;
    if !is_for_lisp {
        return generate(arguments, target, None);
    }
    let mut answer = Answer::new("generate", arguments.encoding);
    let verdict = generate(arguments, target, Some(&mut answer));
    if let Err(failure) = &verdict {
        answer.push_failure(failure);
    }
    answer.print()?;
    verdict
}

fn generate(
    arguments: &Arguments,
    target: Option<&Path>,
    answer: Option<&mut Answer>,
) -> Result<Verdict, Failure> {
    let path = files::shown(&arguments.path);
    let last = arguments.common.settings_with(&arguments.program);
    if let Some(target) = target {
        output::refuse_input(target, path)?;
    }
    let (mut opened, mut snapshot) =
        files::drawing_to_use(&arguments.path, target, &arguments.common, &last)?;
    let format = ending::format(arguments.format, target, &snapshot.settings)?;
    // Where a wire is set, too, all that is said is about the electrode.
    if format == Format::Milling
        && let Ok(milled) = opened.document.settings().milled()
    {
        opened.document.set_settings(Arc::new(milled));
        snapshot = opened.snapshot()?;
    }
    let document = &opened.document;
    let wanted = Wanted {
        format,
        handles: (!arguments.handle.is_empty()).then_some(&arguments.handle),
        layers: (!arguments.layer.is_empty()).then_some(&arguments.layer),
        force: arguments.force,
    };
    let findings = document.all_findings().to_vec();
    let made = match job::generate(&snapshot, findings, &wanted, &()) {
        Ok(made) => made,
        Err(refusal) => {
            if let Some(answer) = answer {
                add_refusal(answer, path, document, &snapshot, &refusal);
            }
            return report::refuse_programs(path, &mut opened.document, &refusal);
        }
    };
    // With `--output lisp` alone the program is in the answer.
    if target.is_some() || answer.is_none() {
        output::write(target, made.program.text.as_bytes(), arguments.overwrite)?;
    }
    // `wedm check` reports the drawing's findings; these are the program's.
    let of_program = |finding: &&Finding| {
        !output::is_what_holds(finding)
            && matches!(
                finding.rule,
                Rule::Settings | Rule::LeadIn | Rule::StartHole
            )
            || matches!(
                finding.detail,
                Detail::OffsetCollapse { point: true, .. } | Detail::NoPartner { .. }
            )
            || job::is_of_program(finding)
    };
    let said: Vec<Finding> = made.warnings.iter().filter(of_program).cloned().collect();
    report::say(path, document, &said);
    if let Some(answer) = answer {
        add_to(answer, target, format, &made);
        let rows = report::rows_of(path, document, &said);
        rows.iter().for_each(|row| row.add_to(answer));
    }
    summarise((target, format), &made.program, made.contours);
    for finding in made.left_out.iter().take(CUTS) {
        output::say(&say!(
            left_out_of_the_program,
            sentence(finding, document.telling())
        ));
    }
    if let Some(line) = output::offsets(&made.program) {
        output::say(&line);
    }
    output::say_thread_hole(&made.holes, document.unit_mm());
    output::say_what_holds(&made.warnings, document.telling());
    if let Some(milled) = &made.program.milled {
        for line in Milling::new(&snapshot, milled).told(CUTS) {
            output::say(&line);
        }
    }
    told(&snapshot, &made.work);
    for line in &made.unattended {
        output::say(line);
    }
    if let Some(finished) = made.finished {
        let at = finished.at * document.unit_mm();
        output::say(&say!(
            the_finished_part_deviates,
            finished.uncut,
            at.x,
            at.y,
            finished.overcut
        ));
    }
    output::say_against(document);
    Ok(Verdict::Clean)
}

/// The program, for AutoLISP, and the paths of the wire as vertices of polylines.
fn add_to(answer: &mut Answer, target: Option<&Path>, format: Format, made: &Generated) {
    let program = &made.program;
    let about = json!({
        "format": format.name(),
        "path": target.map(|path| path.display().to_string()),
        "text": target.is_none().then_some(&program.text),
        "blocks": program.blocks,
        "contours": made.contours,
        "length": program.length,
        "offChords": Some(program.off_chords).filter(|&off| off > 0.0),
        "holes": made.holes.iter().map(|hole| [hole.at.x, hole.at.y]).collect::<Vec<_>>(),
    });
    answer.push("program", &about);
    for path in &made.paths {
        let ends = path.segments.last().map(|last| last.geometry.end());
        let bends = path.segments.iter();
        let bends = bends.map(|piece| (piece.geometry.start(), piece.geometry.bulge()));
        let vertices = bends.chain(ends.map(|end| (end, 0.0)));
        let groups: Vec<Group> = vertices
            .flat_map(|(at, bulge)| {
                let point = GroupValue::Point(vec![at.x, at.y]);
                [(10, point), (42, GroupValue::Real(bulge))]
            })
            .collect();
        let vertices = format!(" (vertices{})", answer.groups(&groups));
        answer.push_with("wire", &json!({ "pass": path.pass }), &vertices);
    }
}

/// Why there is no program; whether the side of some contour is all that has to be said is in it, too.
fn add_refusal(
    answer: &mut Answer,
    path: &Path,
    document: &Document,
    snapshot: &Snapshot,
    refusal: &Refusal,
) {
    let outlines = snapshot.outlines.iter();
    let can_lack_side = matches!(refusal, Refusal::Sentence(_) | Refusal::Findings(_));
    let lacks_side = can_lack_side && { outlines }.any(|it| it.contour.closed && it.lacks_side());
    let message = refusal.sentence(document.telling());
    let about = json!({ "message": message, "side-is-missing": lacks_side });
    answer.push("refused", &about);
    let rows = report::rows_of(path, document, refusal.findings());
    rows.iter().for_each(|row| row.add_to(answer));
}

/// Up to this many cuts are listed one by one.
const CUTS: usize = 24;

/// The program's totals at the machine, as far as the settings give them.
fn told(snapshot: &Snapshot, work: &toolpath::Work) {
    let work = Work::new(&snapshot.drawing, &snapshot.outlines, work);
    if let Some(minutes) = work.minutes {
        let cost = work.cost.map(|cost| say!(which_costs, cost));
        let cost = cost.unwrap_or_default();
        output::say(&say!(the_cut_takes, work.length, duration(minutes), cost));
        let several = (2..=CUTS).contains(&work.cuts.len());
        for cut in work.cuts.iter().filter(|_| several) {
            let (contour, minutes) = (readable(&cut.contour), cut.minutes.unwrap_or_default());
            output::say(&match cut.cut_off {
                false => say!(
                    the_cut_of_a_pass_takes,
                    contour,
                    cut.pass,
                    cut.length,
                    minutes
                ),
                true => say!(the_tab_takes, contour, cut.pass, cut.length, minutes),
            });
        }
    }
    for slug in work.slugs.iter().take(CUTS) {
        output::say(&say!(the_slug_weighs, readable(&slug.contour), slug.mass));
    }
    if let Some(angle) = work.lead_angle {
        output::say(&say!(leads_turn_at_most, angle));
    }
    if let Some(largest) = &work.largest_wire {
        output::say(&largest.sentence());
    }
    let settings = &snapshot.settings;
    let (job, passes) = (&settings.job, &settings.passes);
    let is_asked = job.thickness.is_some()
        || job.machine_rate.is_some()
        || job.slug_limit.is_some()
        || passes.rates.is_some();
    if is_asked && !work.missing.is_empty() {
        output::say(&say!(keys_are_missing, work.missing.join(", ")));
    }
}

fn summarise((target, format): (Option<&Path>, Format), program: &ProvedProgram, contours: usize) {
    let target = output::target_name(target);
    // A drift that rounds to zero has no sign.
    let [x, y] = program
        .closure
        .map(|drift| (drift * 100.0).round() / 100.0 + 0.0);
    output::say(&say!(
        the_program_is_written,
        styled(output::GOOD, say!(written)),
        target,
        say!(blocks, program.blocks),
        say!(contours, contours),
        lengths(program.length, program.jumps, say!(comma))
    ));
    let drift = match format {
        Format::ThreeB | Format::FourB => {
            say!(the_rounding_of_j_adds_up, x, y)
        }
        Format::Iso | Format::Milling => String::new(),
    };
    output::say(&say!(decoded_again, program.deviation, drift));
    if let Some(line) = output::off_chords(program) {
        output::say(&line);
    }
}
