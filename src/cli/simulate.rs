//! `wedm simulate`: the path of the machine, block by block.

use super::options::{Common, Form};
use super::output::{self, FAINT, WARNING, flush_left, flush_right, push_line, styled};
use super::{Failure, Verdict, files};
use crate::message::lengths;
use crate::protocol::{SimulatedBlock, Simulation, StepKind};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm simulate plate.3b
  wedm simulate plate.3b --feed 2.5            with the time at 2.5 mm/min
  wedm simulate plate.3b --output json | jq '.closure'")]
pub(crate) struct Arguments {
    #[arg(value_name = "PROG")]
    path: PathBuf,
    #[arg(long, value_enum, default_value_t = Form::Text)]
    output: Form,
    #[arg(long, value_name = "MM/MIN", value_parser = feed)]
    feed: Option<f64>,
    #[command(flatten)]
    common: Common,
}

fn feed(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|feed: &f64| *feed > 0.0 && feed.is_finite())
        .ok_or_else(|| say!(expected_a_number_above_0).into())
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let common = &arguments.common;
    let opened = files::open(&arguments.path, common, &common.settings())?;
    let simulation = Simulation::of(&opened.program()?.trace(), arguments.feed);
    match arguments.output {
        Form::Json => output::print_json(&simulation)?,
        Form::Text => output::print(table(&simulation))?,
    }
    Ok(Verdict::Clean)
}

/// Deviations below this are rounding, µm.
const SHOWN: f64 = 0.01;

fn table(simulation: &Simulation) -> String {
    let columns = format!(
        "{} {:>6}  {:<6} {} {}",
        flush_right(say!(column_of_lines), 6),
        "N",
        "",
        flush_right(say!(column_of_end_x), 12),
        flush_right(say!(column_of_end_y), 12)
    );
    let mut text = styled(FAINT, columns) + "\n";
    simulation
        .blocks
        .iter()
        .for_each(|block| row(&mut text, block));
    let closure = &simulation.closure;
    let moving = simulation
        .blocks
        .iter()
        .filter(|block| !matches!(block.kind, StepKind::Pause | StepKind::End))
        .count();
    let lengths = lengths(simulation.cut, simulation.jumps, say!(comma));
    text += &say!(length_of_blocks, say!(blocks, moving), lengths);
    if let Some(minutes) = simulation.minutes {
        text += &say!(takes_minutes, minutes);
    }
    let end = say!(
        where_it_ends_and_how_far_beside,
        closure.x,
        closure.y,
        simulation.deviation
    );
    push_line(&mut text, end);
    if let Some(bounds) = &simulation.bounds {
        let [width, height] =
            [bounds.max.0 - bounds.min.0, bounds.max.1 - bounds.min.1].map(|um| um / 1000.0);
        let corner = [bounds.min.0, bounds.min.1].map(|um| um / 1000.0);
        let size = say!(size_and_corner_in_mm, width, height, corner[0], corner[1]);
        push_line(&mut text, size);
    }
    text
}

fn row(text: &mut String, block: &SimulatedBlock) {
    let number = block
        .number
        .map_or_else(String::new, |number| number.to_string());
    let kind = match block.kind {
        StepKind::Line => say!(line),
        StepKind::Arc => say!(arc),
        StepKind::Rapid => say!(a_way),
        StepKind::Pause => say!(pause),
        StepKind::End => say!(end),
    };
    let kind = flush_left(kind, 6);
    let mm = |um: f64| um / 1000.0;
    let _ = write!(
        text,
        "{:>6} {number:>6}  {kind} {:>12.3} {:>12.3}",
        block.line + 1,
        mm(block.end.0),
        mm(block.end.1)
    );
    if let (Some(radius), Some(sweep)) = (block.radius, block.sweep) {
        let _ = write!(text, "  R {:.3} mm, {sweep:+.3}°", mm(radius));
    }
    if let Some(upper) = block.upper_end {
        text.push_str(&format!(
            "  {}",
            say!(upper_end_at, mm(upper.0), mm(upper.1))
        ));
    }
    if let Some(ideal) = block.ideal_end.filter(|_| block.deviation > SHOWN) {
        let meant = say!(meant_elsewhere, mm(ideal.0), mm(ideal.1), block.deviation);
        let style = match block.deviation > 2.0 {
            true => WARNING,
            false => FAINT,
        };
        text.push_str(&styled(style, format!("  {meant}")));
    }
    text.push('\n');
}
