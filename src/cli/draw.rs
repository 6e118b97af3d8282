//! `wedm draw`: a picture of contour, faults and wire path.

use super::options::{Common, Program};
use super::output::{self, styled};
use super::{Failure, Verdict, files};
use crate::settings::Settings;
use crate::toolpath::{self, Refusal};
use crate::{message::en, picture};
use clap::Args;
use std::path::{Path, PathBuf};

/// Draw contours, faults and wire path as SVG
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm draw plate.dxf -o plate.svg
  wedm draw plate.dxf --side opening -o plate.svg      with the path of the wire")]
pub struct Arguments {
    /// The drawing
    #[arg(value_name = "PATH")]
    path: PathBuf,
    /// Write the picture there, as .svg [default: stdout]
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    program: Program,
    #[command(flatten)]
    common: Common,
}

pub fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    if let Some(target) = &arguments.output {
        refuse_other_formats(target)?;
        output::refuse_input(target, &arguments.path)?;
    }
    let last = Settings { program: Some(arguments.program.settings()), ..arguments.common.settings() };
    let opened = files::open_drawing(&arguments.path, &arguments.common, &last)?;
    files::refuse_faulty_settings(&opened)?;
    let mut document = opened.document;
    let (findings, _) = document.findings(usize::MAX);
    let Some(snapshot) = document.snapshot() else {
        return Err(Failure(format!("{}: there is no drawing in it", arguments.path.display())));
    };
    let unit_mm = snapshot.settings.unit_of(&snapshot.drawing).mm;
    let paths = toolpath::plan(&snapshot.drawing, &snapshot.outlines, &snapshot.settings, None).unwrap_or_else(|refusal| {
        let reason = match &refusal {
            Refusal::Sentence(sentence) => sentence.clone(),
            Refusal::Findings(findings) => findings.first().map_or_else(String::new, |finding| en::sentence(finding, unit_mm)),
        };
        output::say(&format!("{} drawn without the path of the wire: {reason}", styled(output::NOTE, "note:")));
        Vec::new()
    });
    let svg = picture::svg(&snapshot.drawing, &snapshot.outlines, &findings, &paths, unit_mm);
    output::write(arguments.output.as_deref(), svg.as_bytes())?;
    Ok(Verdict::Clean)
}

fn refuse_other_formats(target: &Path) -> Result<(), Failure> {
    let ending = target.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("svg") => Ok(()),
        _ if target == Path::new("-") => Ok(()),
        Some(ending) => Err(Failure(format!("{}: .{ending} is not written, expected .svg", target.display()))),
        None => Err(Failure(format!("{}: its name has no ending, expected .svg", target.display()))),
    }
}
