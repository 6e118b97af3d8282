//! Converts a program to another language or to a drawing.

use super::Refusal;
use crate::document::Document;
use crate::dxf;
use crate::finding::{Detail, Fault, Finding, FixKind, Severity, TextFix};
use crate::program::convert::{self, Cuts, Dropped};
use crate::program::{Format, ProofError};
use crate::rule::Rule;
use crate::settings::Effective;

/// The target of a conversion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Target {
    Drawing,
    Program(Format),
}

impl Target {
    /// The program formats that a program can be converted to; milling needs more than the path of
    /// a wire.
    const PROGRAMS: [Format; 3] = [Format::ThreeB, Format::FourB, Format::Iso];

    fn program(name: &str) -> Option<Target> {
        let format = Target::PROGRAMS
            .into_iter()
            .find(|format| format.name() == name);
        format.map(Target::Program)
    }

    /// The target for a name, or for the ending of a file's name. The error lists them.
    pub(crate) fn of(name: &str) -> Result<Target, String> {
        match name.to_ascii_lowercase().as_str() {
            "dxf" => Ok(Target::Drawing),
            "nc" => Ok(Target::Program(Format::Iso)),
            lower => Target::program(lower).ok_or_else(|| {
                let names = Target::PROGRAMS.map(Format::name).join(", ");
                say!(a_target_that_is_not_written, name, names)
            }),
        }
    }
}

/// A program as a drawing, or in another language.
pub(crate) struct Converted {
    pub(crate) bytes: Vec<u8>,
    /// Blocks of the new program.
    pub(crate) blocks: Option<usize>,
    pub(crate) cuts: Cuts,
    /// Where the control finds its corrections otherwise than in the program, in sentences.
    pub(crate) corrections: Vec<String>,
    /// What the old program holds besides its moves: a newly written program has none of it.
    pub(crate) dropped: Dropped,
}

/// True of a block whose numbers are too long for the digits that are set, and not for those of most controllers: it is
/// sound, and is split when it is written.
fn is_split(finding: &Finding) -> bool {
    let usual = 10_i64.pow(Effective::default().digits);
    match &finding.detail {
        Detail::Program(fault) => {
            matches!(**fault, Fault::TooManyDigits { value, .. } if value < usual)
        }
        _ => false,
    }
}

/// Turns a program into a drawing, or into a program of another language by the settings, which is proved. What the program itself means
/// is decided by the settings that the document has been read with.
pub(crate) fn convert(
    document: &Document,
    target: Target,
    settings: &Effective,
    force: bool,
) -> Result<Converted, Refusal> {
    let Some(program) = document.program() else {
        return Err(Refusal::Sentence(say!(a_drawing_is_no_program).into()));
    };
    let findings = document.all_findings();
    let mut errors = findings.to_vec();
    errors.retain(|finding| finding.severity == Severity::Error);
    let any_errors = errors
        .iter()
        .any(|finding| finding.rule != Rule::NotTheDrawing);
    // Neither a radius that the wire cannot follow nor a difference from the drawing changes where
    // the wire goes, nor do numbers that are long for another controller alone.
    errors.retain(|finding| {
        !matches!(finding.rule, Rule::SmallRadius | Rule::NotTheDrawing) && !is_split(finding)
    });
    if !force && !errors.is_empty() {
        return Err(Refusal::Errors(errors));
    }
    // Whatever severity the settings give it: its move would be missing.
    if let Some(line) = program.unread_line().filter(|_| !force) {
        let reason = say!(the_line_cannot_be_read);
        return Err(Refusal::Sentence(say!(line_by_number, line + 1, reason)));
    }
    if let Some(line) = program.unfollowed_line().filter(|_| !force) {
        let reason = say!(the_program_is_not_followed_as_a_whole);
        return Err(Refusal::Sentence(say!(line_by_number, line + 1, reason)));
    }
    if program.mills() {
        return Err(Refusal::Sentence(say!(it_is_milled).into()));
    }
    // What was cut off would be missing, and the end that is written would say that nothing is.
    let adds_end = |fix: &TextFix| matches!(fix.kind, FixKind::AddEnd { .. });
    let breaks_off = |finding: &&Finding| {
        finding.rule == Rule::MissingEnd && !program.fixes(finding).iter().any(adds_end)
    };
    if target != Target::Drawing
        && !force
        && let Some(finding) = findings.iter().find(breaks_off)
        && let Some(range) = finding.place.in_text()
    {
        let line = program.text().line_of(range.start);
        let reason = say!(the_program_breaks_off_there);
        return Err(Refusal::Sentence(say!(line_by_number, line + 1, reason)));
    }
    let is_iso = target == Target::Program(Format::Iso);
    let mut cuts = convert::cuts_to_write(program, is_iso);
    if let Some(taper) = cuts.taper.as_ref().filter(|_| cuts.leans && !force) {
        return Err(Refusal::Sentence(say!(no_conversion_of_a_taper, taper)));
    }
    let dropped = Dropped::of(program);
    if let Some(reason) = dropped.refusal().filter(|_| !force) {
        return Err(Refusal::Sentence(say!(no_conversion_of_such_a_way, reason)));
    }
    if cuts.cuts.is_empty() {
        return Err(Refusal::Sentence(say!(it_cuts_nothing).into()));
    }
    let format = match target {
        Target::Drawing => {
            cuts.place_parts(settings.correction);
            let bytes = dxf::write(&cuts.drawing()).map_err(Refusal::Fault)?;
            return Ok(Converted {
                bytes,
                blocks: None,
                cuts,
                corrections: Vec::new(),
                dropped,
            });
        }
        Target::Program(format) => format,
    };
    if let Some(reason) = cuts.refusal(format, settings) {
        return Err(Refusal::Sentence(reason));
    }
    let lost = cuts.lost_correction(format, settings);
    if let Some(reason) = lost.as_ref().filter(|_| !force) {
        return Err(Refusal::Sentence(say!(
            no_conversion_of_such_a_correction,
            reason
        )));
    }
    let mut corrections = Vec::from_iter(lost.map(|reason| say!(not_kept_the_corrections, reason)));
    if format == Format::Iso {
        corrections.extend(cuts.renamed_corrections(settings));
    }
    let written = cuts.write(format, settings).map_err(|error| {
        let reason = cuts.reason_of_mismatch();
        if let (ProofError::Mismatch(_), Some(reason)) = (&error, reason) {
            return Refusal::Sentence(reason);
        }
        let errors = (force || any_errors).then_some(errors);
        Refusal::of_proof(error, errors, |reason| say!(no_other_program, reason))
    })?;
    Ok(Converted {
        bytes: written.text.into_bytes(),
        blocks: Some(written.blocks),
        cuts,
        corrections,
        dropped,
    })
}
