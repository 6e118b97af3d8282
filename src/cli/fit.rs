//! `wedm fit`: whether a punch goes into its plate.

use super::options::{Common, Form, Pairing, Program, no_pair};
use super::output::{self, push_line, styled};
use super::{Failure, Verdict, files, report};
use crate::geometry::Xy;
use crate::job;
use crate::message::readable;
use crate::picture::{self, Image};
use crate::protocol::Fit;
use crate::settings::part_title;
use clap::Args;
use std::fmt::Write;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm fit washer.dxf --drawn-as punch --clearance 0.01 --wire-diameter 0.18 --gap 0.01
  wedm fit washer.dxf -o washer-fit.svg")]
pub(super) struct Arguments {
    #[arg(value_name = "PATH")]
    path: PathBuf,
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[arg(long, requires = "output")]
    overwrite: bool,
    #[arg(long, value_enum, default_value_t = Form::Text)]
    format: Form,
    #[command(flatten)]
    pairing: Pairing,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

pub(super) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let path = files::shown(&arguments.path);
    let target = arguments.output.as_deref();
    if let Some(target) = target.filter(|target| form_of(target).is_none()) {
        return Err(Failure::of(target, say!(the_fit_is_drawn_as_svg)));
    }
    let own = arguments.common.settings_with(&arguments.program);
    let last = arguments.pairing.0.overlaid(&own);
    let (opened, snapshot) =
        files::drawing_to_use(&arguments.path, target, &arguments.common, &last)?;
    if let Err(missing) = snapshot.settings.fit() {
        let needed = say!(whether_it_fits_needs, missing.listed());
        return Err(Failure::of(path, no_pair(&last, &missing, needed)));
    }
    let unit_mm = opened.document.unit_mm();
    let fit = match job::fit(&opened.document, &snapshot, &()) {
        Ok(fit) => fit,
        Err(refusal) => {
            let advice = |errors| say!(the_fit_is_not_known, path.display(), errors);
            return report::refuse(path, &opened.document, &refusal, advice);
        }
    };
    let svg = picture::fit_svg(&snapshot.drawing, &fit, unit_mm);
    if let Some(target) = &arguments.output {
        let form = form_of(target).unwrap_or(Image::Svg);
        let picture = form.of_svg(&svg).map_err(Failure)?;
        output::write(Some(target), &picture, arguments.overwrite)?;
    }
    let printed = Fit::new(&snapshot.drawing, &fit, svg, unit_mm);
    match arguments.format {
        Form::Text => output::print(table(&printed))?,
        Form::Json => output::print_json(&printed)?,
    }
    Ok(Verdict::of_errors(!printed.fits))
}

fn form_of(target: &Path) -> Option<Image> {
    Image::of_ending(&target.extension()?.to_string_lossy())
}

fn table(fit: &Fit) -> String {
    let mut text = String::new();
    if !fit.places.is_empty() {
        push_line(&mut text, styled(output::STRONG, say!(heading_of_the_fit)));
    }
    for place in &fit.places {
        let Xy(x, y) = place.at;
        let left = format!("{:+.4}", place.clearance);
        let left = match place.clearance < 0.0 {
            true => styled(output::ERROR, format!("{left:>10}")),
            false => format!("{left:>10}"),
        };
        let _ = writeln!(
            text,
            "{left}  {} {:<10} {:>7}  {x:.4}, {y:.4}",
            output::flush_left(&readable(&part_title(&place.of)), 10),
            readable(&place.handle),
            place.segment
        );
    }
    for alone in &fit.alone {
        let line = say!(a_contour_has_no_partner, alone.handle, alone.of);
        push_line(&mut text, readable(&line));
    }
    let verdict = match fit.fits {
        true => styled(output::GOOD, say!(fits)),
        false => styled(output::ERROR, say!(do_not_fit)),
    };
    text + &of_least(fit, &verdict) + "\n"
}

/// The remaining clearance, and whether it is enough.
pub(super) fn of_least(fit: &Fit, verdict: &str) -> String {
    if fit.compares_nothing() {
        return say!(no_contour_is_of_a_pair).into();
    }
    let (least, wanted) = (fit.least, fit.clearance);
    let places = say!(places, fit.places.len());
    let mut sentence = match least < 0.0 {
        true => say!(verdict_of_an_overlap, verdict, -least, wanted, places),
        false => say!(verdict_of_the_fit, verdict, least, wanted, places),
    };
    // As it is printed.
    if least - wanted >= 1e-4 {
        sentence += &say!(everywhere_more_is_left, least - wanted);
    }
    sentence
}
