//! Pictures of drawings and of programs, with what is found in them.

use super::{Cut, Refusal, Watch, cuts};
use crate::document::{Document, Snapshot};
use crate::finding::{self, Finding, Telling};
use crate::picture::{self, Drawn, PartShare, View};
use crate::program;
use crate::settings::part_title;

/// The paths of what is cut, or why there are none, and the picture with them.
pub(crate) fn picture(
    snapshot: &Snapshot,
    findings: &[Finding],
    watch: &dyn Watch,
) -> (Result<Vec<Cut>, Refusal>, String) {
    let (cuts, drawn) = drawn(snapshot, findings, watch, false);
    (cuts, drawn.svg)
}

/// The same; `in_pieces` as [`picture::drawn`] has it.
pub(crate) fn drawn(
    snapshot: &Snapshot,
    findings: &[Finding],
    watch: &dyn Watch,
    in_pieces: bool,
) -> (Result<Vec<Cut>, Refusal>, Drawn) {
    let settings = &snapshot.settings;
    let cuts = cuts(snapshot, watch);
    let why = cuts.as_ref().err().map(|refusal| {
        let telling = Telling {
            unit_mm: settings.unit_of(&snapshot.drawing).mm,
            mills: settings.mills,
        };
        (refusal.severity(), refusal.sentence(telling))
    });
    let all = || cuts.iter().flatten();
    let paths: Vec<_> = all().flat_map(Cut::paths_of_whole).collect();
    let holes: Vec<_> = all().flat_map(|cut| cut.planned.holes.clone()).collect();
    let share = |cut| {
        let Cut {
            planned, snapshot, ..
        }: &'_ Cut = cut;
        Some(PartShare {
            title: part_title(cut.name()?),
            paths: planned.paths.len(),
            settings: &snapshot.settings,
        })
    };
    let parts: Vec<PartShare> = all().filter_map(share).collect();
    let view = View {
        name: settings.document.as_deref(),
        drawing: &snapshot.drawing,
        outlines: &snapshot.outlines,
        findings,
        paths: &paths,
        parts: &parts,
        holes: &holes,
        why: why
            .as_ref()
            .map(|(severity, why)| (*severity, why.as_str())),
        settings,
    };
    let drawn = picture::drawn(&view, in_pieces);
    (cuts, drawn)
}

/// The picture of a program.
pub(crate) fn picture_of_program(document: &Document, program: &program::Document) -> String {
    program_drawn(document, program, false).svg
}

/// The same; `in_pieces` as [`picture::drawn`] has it.
pub(crate) fn program_drawn(
    document: &Document,
    program: &program::Document,
    in_pieces: bool,
) -> Drawn {
    let of = |finding: &Finding| {
        let line = document
            .text()?
            .line_of(document.range_of(&finding.place)?.start);
        Some((line, finding.severity, finding::sentence(finding, 1.0)))
    };
    let findings = document.all_findings();
    let faults: Vec<_> = findings.iter().filter_map(of).collect();
    let name = document.settings().document.as_deref();
    picture::program(&program.trace(), &faults, name, program.mills(), in_pieces)
}
